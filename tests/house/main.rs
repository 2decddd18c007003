//! What holds of the sources of the page: what they import, and the generator of their texts.

mod architecture;
mod texts;
