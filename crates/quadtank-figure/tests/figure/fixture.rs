//! Runs and charts to paint: made up, but of the size and the shape of the real ones.

use std::f64::consts::PI;

use nalgebra::Complex;
use quadtank_figure::{
    Chart, Palette, PoleZero, PoleZeroTexts, ResponseTexts, Responses, RunColumns, Size, Style, ValvePlane,
    ValvePlaneTexts, pole_zero, responses, valve_plane,
};

pub const SIZE: Size = Size { width: 790.0, height: 320.0 };
pub const STYLE: Style = Style { palette: Palette::LIGHT, decimal: '.', scale: 8 };

/// A run of 3,001 rows.
pub struct Run {
    pub time_s: Vec<f64>,
    pub levels: [Vec<f64>; 2],
    pub references: [Vec<f64>; 2],
    pub voltages: [Vec<f64>; 2],
}

impl Run {
    /// Level 1 follows a step of 1 cm at 100 s, `slow` times slower than usual; level 2 is pushed and comes back.
    pub fn step(slow: f64) -> Self {
        let time_s: Vec<f64> = (0..=3000).map(f64::from).collect();
        let column = |f: &dyn Fn(f64) -> f64| time_s.iter().map(|&t| f((t - 100.0).max(0.0) / slow)).collect();
        let stepped = time_s.iter().map(|&t| if t < 100.0 { 0.124 } else { 0.134 }).collect();
        Self {
            levels: [
                column(&|t| 0.124 + 0.01 * (1.0 - (-t / 200.0).exp() * (PI * t / 900.0).cos())),
                column(&|t| 0.13 + 0.000_02 * t * (-t / 250.0).exp()),
            ],
            references: [stepped, column(&|_| 0.13)],
            voltages: [column(&|t| 3.0 - 0.2 * t / (t + 100.0)), column(&|t| 3.0 + 0.5 * t / (t + 100.0))],
            time_s,
        }
    }

    /// The same, running away.
    pub fn diverging() -> Self {
        let mut run = Self::step(1.0);
        for (level, t) in run.levels[0].iter_mut().zip(&run.time_s) {
            *level += 1e-4 * (t / 20.0).exp();
        }
        run
    }

    pub fn columns(&self) -> RunColumns<'_> {
        RunColumns {
            time_s: &self.time_s,
            levels: [&self.levels[0], &self.levels[1]],
            voltages: [&self.voltages[0], &self.voltages[1]],
        }
    }
}

pub fn response_spec<'a>(run: &'a Run, linear: Option<&'a Run>, pinned: Option<&'a Run>) -> Responses<'a> {
    Responses {
        nonlinear: run.columns(),
        recorded: None,
        references: [&run.references[0], &run.references[1]],
        linear: linear.map(Run::columns),
        pinned: pinned.map(|run| (run.columns(), "pinned")).into_iter().collect(),
        level_scale: 100.0,
        walls: [0.2, 0.2],
        voltage_limits: (0.0, 10.0),
        window_s: None,
        flags: &[],
        steps: &[],
        texts: ResponseTexts {
            time: "time (s)",
            level: "level (cm)",
            voltage: "pump (V)",
            levels: ["level 1", "level 2"],
            references: ["reference 1", "reference 2"],
            voltages: ["pump 1", "pump 2"],
            reference: "reference",
            linear: "linear",
        },
    }
}

pub fn response_charts<'a>(run: &'a Run, linear: Option<&'a Run>, pinned: Option<&'a Run>) -> [Chart<'a>; 2] {
    responses(&response_spec(run, linear, pinned))
}

pub fn s_plane(poles: &[Complex<f64>], zeros: &[Complex<f64>], closed_loop: &[Complex<f64>]) -> Chart<'static> {
    let texts = PoleZeroTexts {
        real: "Re s (1/s)",
        imaginary: "Im s (1/s)",
        poles: "poles",
        zeros: "zeros",
        closed_loop: "closed loop",
        beyond: "further out",
    };
    let path: Vec<_> = (-10..=4).map(|k| Complex::new(f64::from(k) * 0.005, 0.0)).collect();
    pole_zero(&PoleZero { poles, zeros, zero_paths: &[path], closed_loop, decimal: '.', texts })
}

/// Time constants and zeros of P+ as Johansson (2000) prints them; closed-loop poles made up.
pub fn johansson_s_plane() -> Chart<'static> {
    let real = |re| Complex::new(re, 0.0);
    let poles = [-1.0 / 63.0, -1.0 / 91.0, -1.0 / 39.0, -1.0 / 56.0].map(real);
    s_plane(&poles, &[-0.057, 0.013].map(real), &[Complex::new(-0.003, 0.01), Complex::new(-0.003, -0.01)])
}

pub fn plane(right_most_zero: &dyn Fn([f64; 2]) -> Option<f64>, setting: Option<[f64; 2]>) -> Chart<'static> {
    plane_with(right_most_zero, setting, 1.0)
}

pub fn plane_with(
    right_most_zero: &dyn Fn([f64; 2]) -> Option<f64>,
    setting: Option<[f64; 2]>,
    singular_sum: f64,
) -> Chart<'static> {
    let texts = ValvePlaneTexts {
        gamma_1: "γ₁",
        gamma_2: "γ₂",
        boundary: "the line",
        minimum_phase: "minimum phase",
        right_half_plane: "zero < right & wrong",
    };
    let published = [("P−", [0.7, 0.6]), ("P+", [0.43, 0.34])];
    valve_plane(&ValvePlane { right_most_zero, singular_sum, published: &published, setting, texts })
}

/// The right-most zero for T3 = T4 = 50 s: (50 s + 1)² = η.
pub fn right_most_zero([gamma_1, gamma_2]: [f64; 2]) -> Option<f64> {
    let product = gamma_1 * gamma_2;
    (product > 0.0).then(|| (((1.0 - gamma_1) * (1.0 - gamma_2) / product).sqrt() - 1.0) / 50.0)
}
