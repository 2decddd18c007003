//! The Leptos user interface: benches, charts on screen, widgets, the drawing of the plant, texts.
//!
//! `lab` holds the state, `pace` the way of one change from an event to pixels; `quadruple` is the home bench, `relay` the
//! one for relay tuning, `model_free` the one for model-free control; `widgets` are the parts that any bench is made of. There
//! is no control arithmetic here: every number comes from [`quadtank_scenario`].

mod canvas;
mod controls;
mod download;
mod errors;
mod format;
mod lab;
mod model_free;
mod pace;
mod preset;
mod quadruple;
mod relay;
mod results;
mod share;
mod shell;
mod shown;
mod start;
mod stopped;
mod storage;
mod texts;
mod timing;
mod widgets;

pub use shell::{Laboratory, mount};
