//! Properties over random plants, controllers and experiments.

mod full_and_dry;
mod linear;
mod plant;
mod sim;
mod tuning;
