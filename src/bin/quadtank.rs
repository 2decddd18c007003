//! The laboratory without a screen: analyse, simulate and plot a scenario file.

#[cfg(not(target_arch = "wasm32"))]
#[path = "quadtank/command.rs"]
mod command;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    command::main()
}

/// A browser has no command line.
#[cfg(target_arch = "wasm32")]
fn main() {}
