//! Quadtank: a laboratory for multivariable control around Johansson's quadruple-tank process.
//!
//! The modules stand on floors; each imports only from the floors below its own. In reading order:
//!
//! | floor | module | purpose |
//! |---|---|---|
//! | 1 | [`plant`] | what is really there: tanks, outlets, pumps, valves, sensors, and their nonlinear equations |
//! | 1 | [`linear`] | what a linear model says: poles, transmission zeros and directions, frequency response, closed loops |
//! | 2 | [`interaction`] | what couples the loops: relative gain array, Niederlinski index, pairing |
//! | 2 | [`control`] | what acts: sampled PI and PID controllers, alone, decentralised or as a matrix; relays; the linear loops they close |
//! | 3 | [`sim`] | plant + controller + experiment → trajectories, events, metrics |
//! | 4 | [`tuning`] | how gains are found: relay tests, ultimate points, critical curve, rules, placement |
//! | 4 | [`assess`] | how well a running loop does: variance indices, Harris index, margins, valve travel |
//! | 5 | [`literature`] | what is printed, by source: rigs, cases, printed numbers and what is to be known about them |
//! | 6 | [`study`] | what each bench computes: from the setup of its document to results, and the verdicts on them |
//!
//! Under all of them lies `numeric`: roots, matrix exponential, singular values, guarded eigenvalues.
//!
//! The crate compiles without a browser, holds no text for people, and is in SI units (m, m², m³/s, s,
//! V, rad/s) unless a name says otherwise. Tanks 1 and 2 are the lower ones; indices in code start at 0.

mod numeric;

pub mod assess;
pub mod control;
pub mod interaction;
pub mod linear;
pub mod literature;
pub mod plant;
pub mod sim;
pub mod study;
pub mod tuning;
