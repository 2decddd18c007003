use crate::literature::andreis::{
    self, AndreisRemark, CURRENT_TUNING, INDICES, PublishedDisturbance, PublishedFeatures, PublishedIndex,
    PublishedMethod, PublishedModel, PublishedObjective, PublishedVariance, VARIANCES, WRONG_INDICES, remarks_on_table,
};
use crate::literature::{LevelPresetId, level_slides};
use crate::plant::level::LevelPlant;
use crate::sim::level::{
    InflowDisturbance, LevelController, LevelExperiment, LevelRunError, LevelSimulation, SampleStatistics,
    SetPointScale, SignalStep,
};
use crate::tuning::{CostMeasure, ReactionMethod};

use super::summaries::{compare_hundredths, compare_ticks};
use super::{
    Harris, LevelLoopSetup, LevelPlantSpec, ModelError, ModelSource, Objective, PiTuning, SearchSpec, StepTestSpec,
};

/// A printed number beside the computed one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// Disturbance of the row.
    pub disturbance: PublishedDisturbance,
    /// Method of the row.
    pub method: PublishedMethod,
    /// Model of the row.
    pub model: PublishedModel,
    /// The tuning.
    pub tuning: PiTuning,
    /// As printed.
    pub printed: f64,
    /// As computed.
    pub computed: f64,
}

impl Compared {
    /// Relative distance of the computed number from the printed one.
    pub fn deviation(&self) -> f64 {
        self.computed / self.printed - 1.0
    }
}

/// What the numbers of a published table are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComparedQuantity {
    /// Variances of the level (m²).
    LevelVariance,
    /// Variances of the outflow ((m³/s)²).
    OutflowVariance,
    /// Indices: ratios of variances.
    Index,
    /// Indices in hundredths, printed without decimals.
    Hundredths,
    /// Ticks: 4 for the best method, one less for each better one, 0 for what is worse than the current tuning.
    Ticks,
}

/// A published table, every number beside the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedTable {
    /// Its number, 1 for 5.1.
    pub table: u32,
    /// The objective of its tunings.
    pub objective: PublishedObjective,
    /// What its numbers are.
    pub quantity: ComparedQuantity,
    /// Its numbers, by rows.
    pub numbers: Vec<Compared>,
    /// What is to be known about the print.
    pub remarks: &'static [AndreisRemark],
}

/// The tables that [`compare_table`] computes, 1 for 5.1.
pub const COMPARED_TABLES: [u32; 16] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 17, 18];

/// Computes a table of chapter 5 of Andreis (2017) anew, one of [`COMPARED_TABLES`]. Others are empty.
///
/// # Errors
/// [`LevelRunError`], which no published case has.
pub fn compare_table(table: u32) -> Result<ComparedTable, LevelRunError> {
    let variances = VARIANCES.iter().filter(|row| row.table() == table).map(compare_variance);
    let indices = INDICES.iter().filter(|row| row.table == table);
    let indices = indices.flat_map(|row| [0, 1].map(|k| compare_index(row, k)));
    let wrong_objective = match table {
        17 => Some(PublishedObjective::Tight),
        18 => Some(PublishedObjective::Averaging),
        _ => None,
    };
    let methods = [PublishedMethod::Current, PublishedMethod::Gradient, PublishedMethod::Genetic];
    let wrong = WRONG_INDICES.iter().filter(|row| Some(row.objective) == wrong_objective).flat_map(|row| {
        methods.into_iter().zip(row.variances).map(|(method, printed)| {
            // The variance of the variable that is not the objective.
            let is_level = row.objective == PublishedObjective::Averaging;
            let number = |level, outflow| if is_level { level } else { outflow };
            compare(row.disturbance, row.objective, method, PublishedModel::Nominal, printed, number)
        })
    });
    let mut numbers = variances.chain(indices).chain(wrong).collect::<Result<Vec<_>, _>>()?;
    numbers.extend(compare_ticks(table)?);
    numbers.extend(compare_hundredths(table)?);
    let (objective, quantity) = kind_of_table(table);
    Ok(ComparedTable { table, objective, quantity, numbers, remarks: remarks_on_table(table) })
}

/// The objective of the tunings of a table, and what its numbers are.
const fn kind_of_table(table: u32) -> (PublishedObjective, ComparedQuantity) {
    use ComparedQuantity::{Hundredths, Index, LevelVariance, OutflowVariance, Ticks};
    use PublishedObjective::{Averaging, Tight};
    match table {
        2 | 4 | 6 => (Averaging, OutflowVariance),
        7 => (Tight, Ticks),
        8 => (Averaging, Ticks),
        11 => (Tight, Hundredths),
        14 => (Averaging, Hundredths),
        9 | 10 => (Tight, Index),
        12 | 13 => (Averaging, Index),
        17 => (Tight, OutflowVariance),
        18 => (Averaging, LevelVariance),
        _ => (Tight, LevelVariance),
    }
}

impl ComparedTable {
    /// The loop behind one of its numbers.
    pub fn setup_of(&self, row: &Compared) -> LevelLoopSetup {
        let plant = match row.model {
            PublishedModel::Nominal => LevelPresetId::Andreis,
            PublishedModel::Uncertain => LevelPresetId::AndreisUncertain,
        };
        let mut setup = published_setup(plant, row.disturbance);
        setup.set_objective(match self.objective {
            PublishedObjective::Tight => Objective::Tight,
            PublishedObjective::Averaging => Objective::Averaging { band: setup.usual_band() },
        });
        setup.set_pi_tuning(row.tuning);
        setup
    }
}

pub(super) fn plant_of(model: PublishedModel) -> LevelPlant {
    match model {
        PublishedModel::Nominal => andreis::plant(),
        PublishedModel::Uncertain => andreis::uncertain_plant(),
    }
}

/// Variances of level and outflow.
pub(super) fn variances(
    plant: &LevelPlant,
    disturbance: PublishedDisturbance,
    tuning: PiTuning,
) -> Result<[f64; 2], LevelRunError> {
    let experiment = disturbance.experiment();
    let controller = LevelController::pi(tuning.gain, tuning.integral_time_s);
    let log = LevelSimulation::new(plant, &experiment)?.run(&controller)?;
    Ok(log.statistics(0..log.len()).ok_or_else(|| experiment.empty_log())?.map(|of| of.variance))
}

fn compare(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    method: PublishedMethod,
    model: PublishedModel,
    printed: f64,
    number: impl Fn(f64, f64) -> f64,
) -> Result<Compared, LevelRunError> {
    let tuning =
        PublishedVariance::find(disturbance, objective, method, model).map_or(CURRENT_TUNING, |row| row.tuning);
    let [level, outflow] = variances(&plant_of(model), disturbance, tuning)?;
    Ok(Compared { disturbance, method, model, tuning, printed, computed: number(level, outflow) })
}

fn compare_variance(row: &PublishedVariance) -> Result<Compared, LevelRunError> {
    let is_tight = row.objective == PublishedObjective::Tight;
    let number = |level, outflow| if is_tight { level } else { outflow };
    compare(row.disturbance, row.objective, row.method, row.model, row.variance, number)
}

/// The index with a model, 0 or 1; the current loop is always the plant.
pub(super) fn compare_index(row: &PublishedIndex, model: usize) -> Result<Compared, LevelRunError> {
    let is_tight = row.objective == PublishedObjective::Tight;
    let current = variances(&andreis::plant(), row.disturbance, CURRENT_TUNING)?;
    let number = |level: f64, outflow: f64| if is_tight { level / current[0] } else { outflow / current[1] };
    let models = PublishedIndex::MODELS;
    compare(row.disturbance, row.objective, row.method, models[model], row.printed[model], number)
}

/// Features of a run that are printed, beside the computed ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedFeatures {
    /// As printed.
    pub printed: PublishedFeatures,
    /// The same of the level, computed.
    pub level: [f64; 6],
    /// The same of the outflow, computed.
    pub outflow: [f64; 6],
}

impl ComparedFeatures {
    /// The loop behind them.
    pub fn setup(&self) -> LevelLoopSetup {
        let mut setup = published_setup(LevelPresetId::Andreis, PublishedDisturbance::SineL);
        setup.set_pi_tuning(self.printed.tuning);
        setup
    }
}

/// Computes Tables 5.19 and 5.20 of Andreis (2017) anew: a tight and an averaging tuning, each with what the other is for.
///
/// # Errors
/// [`LevelRunError`], which no published case has.
pub fn compare_features() -> Result<[ComparedFeatures; 2], LevelRunError> {
    let of = |printed: PublishedFeatures| -> Result<ComparedFeatures, LevelRunError> {
        let experiment = PublishedDisturbance::SineL.experiment();
        let controller = LevelController::pi(printed.tuning.gain, printed.tuning.integral_time_s);
        let log = LevelSimulation::new(&andreis::plant(), &experiment)?.run(&controller)?;
        let [from, until] = andreis::FEATURES_WINDOW_S;
        let empty = LevelRunError::EmptyLog { duration_s: until - from, log_step_s: experiment.log_step_s };
        let [level, outflow] = log.statistics(log.rows(from, until)).ok_or(empty)?;
        Ok(ComparedFeatures { printed, level: features(&level), outflow: features(&outflow) })
    };
    let [tight, averaging] = andreis::FEATURES.map(of);
    Ok([tight?, averaging?])
}

/// In the order of the tables.
fn features(of: &SampleStatistics) -> [f64; 6] {
    [of.minimum, of.maximum, of.range(), of.variance, of.mean, of.standard_deviation()]
}

/// The setup that shows a published loop: the plant of Andreis (2017) or its model with errors under a disturbance of the source with
/// the current controller; the loop of the lecture slides with its third setting and a step of the set-point.
pub fn published_setup(id: LevelPresetId, disturbance: PublishedDisturbance) -> LevelLoopSetup {
    match id {
        LevelPresetId::Andreis | LevelPresetId::AndreisUncertain => of_andreis(id, disturbance),
        LevelPresetId::LectureSlides => of_slides(),
    }
}

fn of_andreis(id: LevelPresetId, disturbance: PublishedDisturbance) -> LevelLoopSetup {
    LevelLoopSetup {
        plant: LevelPlantSpec::Preset(id),
        test: StepTestSpec {
            level: andreis::NOMINAL_LEVEL,
            inflow: andreis::STEP_TEST_INFLOW,
            step: 1.28,
            step_time_s: 500.0,
            return_time_s: None,
            duration_s: 4407.0,
            method: ReactionMethod::OnePoint { dead_time_s: 0.0 },
        },
        objective: Objective::Tight,
        model_source: ModelSource::Test,
        closed_loop_time_s: 5.88,
        controller: LevelController::pi(CURRENT_TUNING.gain, CURRENT_TUNING.integral_time_s),
        reference: PiTuning { gain: 93.7, integral_time_s: 2999.7 },
        model_error: ModelError::NONE,
        experiment: disturbance.experiment(),
        search: SearchSpec {
            gain: [0.2, 100.0],
            integral_time_s: [0.6, 6000.0],
            measure: CostMeasure::LevelVariance,
            move_penalty: 0.0,
            largest_sensitivity: None,
            keep_band: false,
        },
        harris: Harris { dead_time_rows: 6, order: 20 },
    }
}

fn of_slides() -> LevelLoopSetup {
    const LEVEL: f64 = 0.3;
    let minute = level_slides::MINUTE;
    LevelLoopSetup {
        plant: LevelPlantSpec::Preset(LevelPresetId::LectureSlides),
        test: StepTestSpec {
            level: LEVEL,
            inflow: 0.0,
            step: 1.5,
            step_time_s: 5.0 * minute,
            return_time_s: None,
            duration_s: 65.0 * minute,
            method: ReactionMethod::TwoPoint,
        },
        objective: Objective::Tight,
        model_source: ModelSource::Local,
        closed_loop_time_s: minute,
        controller: LevelController::pid(level_slides::settings()[2], level_slides::DERIVATIVE_FILTER_S),
        reference: PiTuning { gain: 2.0, integral_time_s: 2.0 * minute },
        model_error: ModelError::NONE,
        experiment: LevelExperiment {
            level: LEVEL,
            inflow: 0.0,
            duration_s: 60.0 * minute,
            log_step_s: 0.1 * minute,
            disturbance: InflowDisturbance::NONE,
            set_point_steps: vec![SignalStep { time_s: 0.0, size: 0.3 }],
            set_point_scale: SetPointScale::Level,
        },
        search: SearchSpec {
            gain: [0.1, 200.0],
            integral_time_s: [minute, 60.0 * minute],
            measure: CostMeasure::Iae,
            move_penalty: 0.0,
            largest_sensitivity: None,
            keep_band: false,
        },
        harris: Harris { dead_time_rows: 1, order: 10 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::level_loop::run_level_loop;

    /// To four digits as printed; the tests of the published tables look at each digit.
    #[test]
    fn printed_features_are_beside_the_same_features() {
        for found in compare_features().unwrap() {
            for (printed, computed) in [(found.printed.level, found.level), (found.printed.outflow, found.outflow)] {
                for (printed, computed) in printed.into_iter().zip(computed) {
                    assert!((printed - computed).abs() < 1e-4, "{printed} {computed}");
                }
            }
        }
    }

    #[test]
    fn the_loop_behind_a_variance_has_that_variance() {
        for table in COMPARED_TABLES {
            let found = compare_table(table).unwrap();
            assert!(!found.numbers.is_empty(), "{table}");
            for row in &found.numbers {
                let figures = run_level_loop(&found.setup_of(row)).unwrap().figures;
                let computed = match found.quantity {
                    ComparedQuantity::LevelVariance => figures.level.variance,
                    ComparedQuantity::OutflowVariance => figures.outflow.variance,
                    _ => continue,
                };
                assert_eq!(computed, row.computed, "{table}: {row:?}");
            }
        }
    }
}
