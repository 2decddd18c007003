use crate::control::{IntegralDial, PiDials, PiForm, ProportionalDial};

/// A commercial controller with the limits of its dials (Andreis 2017, Table 4.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommercialController {
    /// Maker and model.
    pub name: &'static str,
    /// How it writes its settings.
    pub dials: PiDials,
    /// Limits of the proportional dial, a band (%).
    pub band: [f64; 2],
    /// Limits of the integral dial: s, or repeats per minute.
    pub integral: [f64; 2],
}

const fn parallel(name: &'static str, band: [f64; 2], integral: [f64; 2]) -> CommercialController {
    let dials = PiDials { form: PiForm::Parallel, proportional: ProportionalDial::Band, integral: IntegralDial::Time };
    CommercialController { name, dials, band, integral }
}

/// The controllers of Table 4.3.
pub const COMMERCIAL_CONTROLLERS: [CommercialController; 6] = [
    parallel("Autonics TK", [0.1, 999.9], [1.0, 9999.0]),
    parallel("Coel HW4300", [1.0, 9999.0], [1.0, 9999.0]),
    parallel("Contemp C504", [0.1, 999.9], [1.0, 9999.0]),
    parallel("Inova INV-40101", [1.0, 500.0], [1.0, 600.0]),
    CommercialController {
        name: "Novus N1030",
        dials: PiDials {
            form: PiForm::Series,
            proportional: ProportionalDial::Band,
            integral: IntegralDial::RepeatsPerMinute,
        },
        band: [0.1, 500.0],
        integral: [0.01, 99.99],
    },
    parallel("Samrello CPS-4", [0.1, 2000.0], [1.0, 3600.0]),
];

impl CommercialController {
    /// Ranges of gain and integral time (s) of the series form (Table 4.4).
    pub fn ranges(&self) -> [[f64; 2]; 2] {
        self.dials.ranges(self.band, self.integral)
    }

    /// The settings that all controllers of the table can have: gains, and integral times (s).
    pub fn common_ranges() -> [[f64; 2]; 2] {
        COMMERCIAL_CONTROLLERS.iter().map(Self::ranges).fold([[0.0, f64::INFINITY]; 2], |common, ranges| {
            [0, 1].map(|axis| [common[axis][0].max(ranges[axis][0]), common[axis][1].min(ranges[axis][1])])
        })
    }
}
