//! The laboratory without a screen.
fn main() {}
