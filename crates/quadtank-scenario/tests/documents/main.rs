//! Documents of every version: what is read, refused, and answered; margins against brute force.

mod answers;
mod bounded_work;
mod every_version;
mod examples;
mod extremes;
mod given;
mod junqueira;
mod level_loop;
mod margins;
mod model_free;
mod model_free_properties;
mod noise;
mod nothing_ignored;
mod parameters;
mod peaks;
mod quadruple;
mod quantities;
mod random;
mod rest;
mod rigs_of_others;
mod tuning;
mod tuning_elements;
mod valve_corners;

#[path = "../seeded/mod.rs"]
mod seeded;
