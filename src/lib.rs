//! The Leptos user interface: benches, charts on screen, widgets, the drawing of the plant, texts.
//!
//! `benches` is the list of the benches, a folder for each; `session` is the document of a bench with its results, `frames` takes
//! one change from an event to pixels, `lab` what all benches share; `widgets` are the parts that any bench is made of. There is
//! no control theory here: every number comes from [`quadtank::study`].

mod benches;
mod canvas;
mod controls;
mod depth;
mod download;
mod enlarged;
mod errors;
mod events;
mod format;
mod frames;
mod ghosts;
mod glossary;
mod handout;
mod header;
mod history;
mod keep;
mod lab;
mod lessons;
mod live_region;
mod mends;
mod messages;
mod naming;
mod notices;
mod offline;
mod pinned;
mod scenes;
mod scripts;
mod session;
mod share;
mod shell;
mod shown;
mod slices;
mod start;
mod stopped;
mod storage;
mod tables;
mod texts;
mod timing;
mod tour;
mod widgets;

pub use benches::{BENCHES, BenchEntry};
pub use lab::Lab;
pub use session::{Bench, Lock, Panel, ResultsOf, Session, SetupOf, part_of};
pub use shell::{Laboratory, LaboratoryProps, mount};
