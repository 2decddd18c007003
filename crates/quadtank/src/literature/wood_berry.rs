//! Controllers that are published for the column of Wood and Berry (1973), the plant
//! [`PublishedPlant::WoodBerry`](super::campestrini::PublishedPlant::WoodBerry). Times in minutes.

use crate::control::{IsaPid, ParallelPid};

/// A published pair of controllers, loop 1 from the reflux to the distillate, loop 2 from the steam to the bottoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedControllers {
    /// PI by the biggest log modulus, BLT (Luyben 1986, Ind. Eng. Chem. Process Des. Dev. 25, 654–660).
    Blt,
    /// PI, each loop alone by Ziegler and Nichols, 0.45 Ku and Tu/1.2 (Luyben 1986). As a pair they are nearly unstable.
    ZieglerNichols,
    /// PI by Nyquist stability analysis (Chen and Seborg 2003, J. Process Control 13, 27–39).
    ChenSeborg,
    /// PID, the decentralised pair of an iterated restriction to linear matrix inequalities with Ms = 1.4 (Boyd, Hast and Åström
    /// 2016, Int. J. Robust Nonlinear Control 26, 1718–1731), printed in parallel form with a derivative filter of 0.3 min.
    BoydHastAstrom,
}

impl PublishedControllers {
    /// All of them, by the year of print.
    pub const ALL: [Self; 4] = [Self::Blt, Self::ZieglerNichols, Self::ChenSeborg, Self::BoydHastAstrom];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Blt => "wood-berry-blt",
            Self::ZieglerNichols => "wood-berry-ziegler-nichols",
            Self::ChenSeborg => "wood-berry-chen-seborg",
            Self::BoydHastAstrom => "wood-berry-boyd-hast-astrom",
        }
    }

    /// The controllers with a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|controllers| controllers.name() == name)
    }

    /// Where they are printed.
    pub const fn source(self) -> &'static str {
        match self {
            Self::Blt => "Luyben (1986), BLT",
            Self::ZieglerNichols => "Luyben (1986), Ziegler–Nichols",
            Self::ChenSeborg => "Chen and Seborg (2003)",
            Self::BoydHastAstrom => "Boyd, Hast and Åström (2016)",
        }
    }

    /// The settings of loops 1 and 2 as printed; those in parallel form are converted.
    pub fn settings(self) -> [IsaPid; 2] {
        let pi = |gain, integral_time| IsaPid { gain, integral_time, derivative_time: 0.0 };
        let parallel = |proportional: f64, integral: f64, derivative: f64| IsaPid {
            gain: proportional,
            integral_time: proportional / integral,
            derivative_time: derivative / proportional,
        };
        match self {
            Self::Blt => [pi(0.375, 8.29), pi(-0.075, 23.6)],
            Self::ZieglerNichols => [pi(0.96, 3.25), pi(-0.19, 9.2)],
            Self::ChenSeborg => [pi(0.436, 11.0), pi(-0.0945, 15.5)],
            Self::BoydHastAstrom => [parallel(0.1535, 0.0210, 0.1714), parallel(-0.0692, -0.0136, -0.1725)],
        }
    }

    /// The printed time constant of the derivative filter; `None` for PI.
    pub const fn filter_time(self) -> Option<f64> {
        match self {
            Self::BoydHastAstrom => Some(0.3),
            Self::Blt | Self::ZieglerNichols | Self::ChenSeborg => None,
        }
    }

    /// The settings in parallel form, with their filter.
    pub fn gains(self) -> [ParallelPid; 2] {
        self.settings().map(|pid| ParallelPid { filter: self.filter_time(), ..pid.into() })
    }
}
