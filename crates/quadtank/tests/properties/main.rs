//! Properties over random plants, controllers and experiments; figures of an independent computation; the floors of the crate.

mod architecture;
mod full_and_dry;
mod level;
mod level_runs;
mod linear;
mod oracle;
mod plant;
mod sim;
mod tuning;
