//! The least-squares problem: recorded less simulated levels over the free parameters.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra_of_solver::{DMatrix, DVector, Dyn, Owned};
use quadtank::sim::Trajectory;
use quadtank::study::quadruple_tank::{PlantSpec, Setup, nonlinear_run};

use super::{Parameter, Sought};
use crate::{Record, first_levels, interpolated};

/// Rows of the record that are compared, at most.
const MAX_ROWS: usize = 2000;
/// Levels are compared in this (m), so that sums of squares are of ordinary size.
const SCALE: f64 = 0.01;
/// Step of a numerical derivative, as a share of the range of the parameter.
const STEP: f64 = 1e-5;

/// Delays of a hose that are tried before the search.
const PLACES: u32 = 10;

impl Sought {
    fn width(&self) -> f64 {
        self.bounds[1] - self.bounds[0]
    }

    /// The value at a coordinate that may be any number: a logistic curve from bound to bound keeps the solver inside.
    pub(super) fn value(&self, coordinate: f64) -> f64 {
        self.bounds[0] + self.width() / (1.0 + (-coordinate).exp())
    }

    /// The coordinate of a value, which is kept off the bounds.
    pub(super) fn coordinate(&self, value: f64) -> f64 {
        let share = ((value - self.bounds[0]) / self.width()).clamp(1e-3, 1.0 - 1e-3);
        (share / (1.0 - share)).ln()
    }

    /// Slope of the value over the coordinate.
    fn slope(&self, coordinate: f64) -> f64 {
        let share = 1.0 / (1.0 + (-coordinate).exp());
        self.width() * share * (1.0 - share)
    }
}

/// Recorded less simulated levels over the free parameters.
#[derive(Clone, Debug)]
pub struct Problem {
    pub free: Vec<Sought>,
    /// The experiment of the record, with the rig as it was; it begins at the levels of [`first_levels`].
    setup: Setup,
    record: Record,
    /// Compared values: tank, row.
    compared: Vec<(usize, usize)>,
    /// Coordinates of the free parameters.
    at: DVector<f64>,
}

impl Problem {
    pub fn new(setup: Setup, record: &Record, free: Vec<Sought>) -> Self {
        let stride = record.time_s.len().div_ceil(MAX_ROWS).max(1);
        let end = setup.experiment.duration_s;
        let rows = (0..record.time_s.len()).step_by(stride).filter(|&row| record.time_s[row] <= end);
        let has = |tank: usize, row: usize| record.levels[tank].get(row).is_some_and(|level| !level.is_nan());
        let compared =
            rows.flat_map(|row| (0..4).map(move |tank| (tank, row))).filter(|&(tank, row)| has(tank, row)).collect();
        let start = free.iter().map(|free| free.coordinate(free.start));
        let at = DVector::from_iterator(free.len(), start);
        Self { free, setup, record: record.clone(), compared, at }
    }

    /// Begins with the best of some delays, one pump after the other: beyond the next move of a pump the sum of squares has other minima.
    /// What the other parameters can explain, to first order, is not counted against a delay.
    pub fn place_delays(&mut self) {
        for index in 0..self.free.len() {
            let free = self.free[index];
            if !matches!(free.parameter, Parameter::PumpDelay(_)) {
                continue;
            }
            let explained = self.slopes(&self.values()).map(|slopes| slopes.remove_column(index).qr().q());
            let unexplained = |problem: &Self| {
                let all = problem.differences(&problem.values())?;
                let part = explained.as_ref().map_or(0.0, |basis| basis.tr_mul(&all).norm_squared());
                Some(all.norm_squared() - part)
            };
            let shares = (0..PLACES).map(|k| (f64::from(k) + 0.5) / f64::from(PLACES));
            let places = shares.map(|share| free.coordinate(free.bounds[0] + share * free.width()));
            let mut best = (f64::INFINITY, self.at[index]);
            for at in std::iter::once(self.at[index]).chain(places) {
                self.at[index] = at;
                let size = unexplained(self).unwrap_or(f64::INFINITY);
                if size < best.0 {
                    best = (size, at);
                }
            }
            self.at[index] = best.1;
        }
    }

    /// The levels that it began with (m).
    pub fn levels_before(&self) -> [f64; 4] {
        self.setup.experiment.initial_levels.unwrap_or_default()
    }

    pub fn record(&self) -> &Record {
        &self.record
    }

    /// How many values are compared.
    pub fn count(&self) -> usize {
        self.compared.len()
    }

    /// The parameters where it stands.
    pub fn values(&self) -> Vec<f64> {
        self.free.iter().zip(self.at.iter()).map(|(free, &at)| free.value(at)).collect()
    }

    /// The setup with other values of the free parameters.
    pub fn setup_with(&self, values: &[f64]) -> Setup {
        let mut setup = self.setup.clone();
        let mut rig = setup.plant();
        for (free, &value) in self.free.iter().zip(values) {
            free.parameter.put(&mut rig, value);
        }
        setup.valves = rig.valves;
        setup.plant = PlantSpec::Parameters { rig, display_unit: setup.plant.display_unit() };
        setup
    }

    /// The levels that a run begins at (m). Levels that were not recorded begin at the rest of the setup, and the water stood lower than
    /// a sensor says that shows too much.
    pub fn first_levels(&self, setup: &Setup, values: &[f64]) -> Option<[f64; 4]> {
        let heights = setup.plant().tanks.map(|tank| tank.height);
        let offsets = self.offsets(values);
        let mut levels = first_levels(&self.record, setup)?;
        for tank in 0..4 {
            levels[tank] -= offsets[tank];
        }
        for (free, &value) in self.free.iter().zip(values) {
            if let Parameter::StartLevel(tank) = free.parameter {
                levels[tank] = value;
            }
        }
        Some([0, 1, 2, 3].map(|tank| levels[tank].clamp(0.0, heights[tank])))
    }

    fn offsets(&self, values: &[f64]) -> [f64; 4] {
        let mut offsets = [0.0; 4];
        for (free, &value) in self.free.iter().zip(values) {
            if let Parameter::LevelOffset(index) = free.parameter {
                offsets[index] = value;
            }
        }
        offsets
    }

    /// Recorded less simulated levels, in centimetres; `None` where the rig cannot be run.
    pub fn differences(&self, values: &[f64]) -> Option<DVector<f64>> {
        let offsets = self.offsets(values);
        let mut setup = self.setup_with(values);
        setup.experiment.initial_levels = self.first_levels(&setup, values);
        let run = nonlinear_run(&setup).ok()?;
        let difference = |&(tank, row): &(usize, usize)| {
            let simulated = self.simulated(&run, tank, row)? + offsets[tank];
            Some((self.record.levels[tank][row] - simulated) / SCALE)
        };
        let all = self.compared.iter().map(difference).collect::<Option<Vec<_>>>()?;
        Some(DVector::from_vec(all))
    }

    fn simulated(&self, run: &Trajectory, tank: usize, row: usize) -> Option<f64> {
        interpolated(run, &run.levels[tank], self.record.time_s[row])
    }

    /// Slopes of the differences over the parameters themselves, by differences to both sides within the bounds.
    pub fn slopes(&self, values: &[f64]) -> Option<DMatrix<f64>> {
        let columns = self.free.iter().enumerate().map(|(index, free)| {
            let step = STEP * free.width();
            let aside = |side: f64| {
                let mut values = values.to_vec();
                values[index] = (values[index] + side * step).clamp(free.bounds[0], free.bounds[1]);
                Some((self.differences(&values)?, values[index]))
            };
            let ((above, high), (below, low)) = (aside(1.0)?, aside(-1.0)?);
            Some((above - below) / (high - low))
        });
        let columns = columns.collect::<Option<Vec<_>>>()?;
        Some(DMatrix::from_columns(&columns))
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, at: &DVector<f64>) {
        self.at.copy_from(at);
    }

    fn params(&self) -> DVector<f64> {
        self.at.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.differences(&self.values())
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut slopes = self.slopes(&self.values())?;
        for (index, (free, &at)) in self.free.iter().zip(self.at.iter()).enumerate() {
            slopes.column_mut(index).scale_mut(free.slope(at));
        }
        Some(slopes)
    }
}
