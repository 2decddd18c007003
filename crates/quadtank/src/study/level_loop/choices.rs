use crate::literature::LevelPresetId;
use crate::literature::andreis::{
    CURRENT_TUNING, PublishedDisturbance, PublishedMethod, PublishedModel, PublishedObjective, PublishedVariance,
};
use crate::plant::level::{LevelPlant, OutflowLaw};
use crate::sim::level::{InflowSignal, LevelController, LevelExperiment};
use crate::tuning::{CostMeasure, ModelRule, ProcessModel};

use super::{LevelLoopSetup, LevelPlantSpec, Objective, PiTuning, PlantAnswer};

/// SIMC for tight and Lambda tuning for averaging control (Andreis 2017, Tables 5.1 and 5.2), for a loop without
/// published tunings.
const USUAL_TUNINGS: [PiTuning; 2] =
    [PiTuning { gain: 17.4, integral_time_s: 23.5 }, PiTuning { gain: 0.2, integral_time_s: 588.0 }];

/// SIMC for tight and Lambda tuning for averaging control, see [`take_reference`](LevelLoopSetup::take_reference).
fn usual_rules(model: &ProcessModel) -> [ModelRule; 2] {
    let theta = model.dead_time_s();
    let averaging_s = match *model {
        ProcessModel::SelfRegulating { time_constant_s, .. } => 3.0 * theta.max(time_constant_s),
        ProcessModel::Integrating { .. } => 30.0 * theta,
    };
    [ModelRule::Simc { closed_loop_time_s: theta }, ModelRule::Lambda { closed_loop_time_s: averaging_s }]
}

/// A published tuning of the loop that a setup is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedTuning {
    /// How it was found.
    pub method: PublishedMethod,
    /// What for.
    pub objective: PublishedObjective,
    /// The tuning.
    pub tuning: PiTuning,
}

/// A disturbance of one's own, by its kind alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnDisturbance {
    /// A step of the inflow.
    Step,
    /// A sine.
    Sine,
    /// Random numbers.
    Random,
    /// None.
    None,
}

impl OwnDisturbance {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Step, Self::Sine, Self::Random, Self::None];

    /// The kind of a signal.
    pub const fn of(signal: &InflowSignal) -> Self {
        match signal {
            InflowSignal::None => Self::None,
            InflowSignal::Step { .. } => Self::Step,
            InflowSignal::Sine { .. } => Self::Sine,
            InflowSignal::SimulinkNormal { .. } | InflowSignal::Normal { .. } => Self::Random,
        }
    }
}

impl Objective {
    /// The objective of the source.
    pub const fn published(self) -> PublishedObjective {
        match self {
            Self::Tight => PublishedObjective::Tight,
            Self::Averaging { .. } => PublishedObjective::Averaging,
        }
    }

    /// The variance that it is about.
    pub const fn measure(self) -> CostMeasure {
        match self {
            Self::Tight => CostMeasure::LevelVariance,
            Self::Averaging { .. } => CostMeasure::OutflowVariance,
        }
    }
}

impl LevelLoopSetup {
    /// The published disturbance that the experiment is, wherever it starts; `None` for one of its own.
    pub fn published_disturbance(&self) -> Option<PublishedDisturbance> {
        let is_same = |known: &PublishedDisturbance| {
            let published = known.experiment();
            let experiment =
                LevelExperiment { level: published.level, inflow: published.inflow, ..self.experiment.clone() };
            experiment == published
        };
        PublishedDisturbance::ALL.into_iter().find(is_same)
    }

    /// The tunings that Andreis (2017) prints for this loop and disturbance, for either objective, each once; the current one first.
    pub fn published_tunings(&self) -> Vec<PublishedTuning> {
        let LevelPlantSpec::Preset(LevelPresetId::Andreis | LevelPresetId::AndreisUncertain) = self.plant else {
            return Vec::new();
        };
        let Some(disturbance) = self.published_disturbance() else { return Vec::new() };
        let current = PublishedTuning {
            method: PublishedMethod::Current,
            objective: PublishedObjective::Tight,
            tuning: CURRENT_TUNING,
        };
        let methods =
            [PublishedMethod::Gradient, PublishedMethod::Genetic, PublishedMethod::Skogestad, PublishedMethod::Lambda];
        let both = [PublishedObjective::Tight, PublishedObjective::Averaging];
        let rows = both.into_iter().flat_map(|objective| methods.map(|method| (objective, method)));
        let printed = rows.filter_map(|(objective, method)| {
            let row = PublishedVariance::find(disturbance, objective, method, PublishedModel::Nominal)?;
            Some(PublishedTuning { method, objective, tuning: row.tuning })
        });
        std::iter::once(current).chain(printed).fold(Vec::new(), |mut known, next| {
            if known.iter().all(|one: &PublishedTuning| one.tuning != next.tuning) {
                known.push(next);
            }
            known
        })
    }

    /// Takes another objective up: the cost of the search is its variance, and the reference that of it, see
    /// [`take_reference`](Self::take_reference).
    pub fn set_objective(&mut self, objective: Objective) {
        self.objective = objective;
        self.search.measure = objective.measure();
        self.take_reference();
    }

    /// Takes the reference up that belongs to loop, experiment and objective: the tuning that the source found best, where it has one.
    /// Else SIMC with τc = θ for tight control, and Lambda tuning with λ = 3 max(θ, τ), the robust choice of Andreis (2017, §2.5.2), for
    /// averaging control (thirty dead times where the tank integrates), by the half rule where the loop works, within the box.
    pub fn take_reference(&mut self) {
        let of_objective = |one: &PublishedTuning| {
            one.method == PublishedMethod::Gradient && one.objective == self.objective.published()
        };
        let published = self.published_tunings().into_iter().find(of_objective).map(|best| best.tuning);
        if let Some(tuning) = published.or_else(|| self.tuning_by_rule()) {
            self.reference = tuning;
        }
    }

    /// The best tuning known for the objective: the reference where the source has tunings for the loop and its
    /// disturbance, else one of a usual kind.
    pub fn best_known_tuning(&self) -> PiTuning {
        let [tight, averaging] = USUAL_TUNINGS;
        match self.objective {
            _ if !self.published_tunings().is_empty() => self.reference,
            Objective::Tight => tight,
            Objective::Averaging { .. } => averaging,
        }
    }

    fn tuning_by_rule(&self) -> Option<PiTuning> {
        self.tunings_by_rule()[0]
    }

    /// The tunings by the rules of both objectives, that of the present one first; `None` for one that does not exist.
    pub(super) fn tunings_by_rule(&self) -> [Option<PiTuning>; 2] {
        let Ok(PlantAnswer { model, .. }) = PlantAnswer::of(self) else { return [None; 2] };
        let [tight, averaging] = usual_rules(&model).map(|rule| self.settings_within_box(rule, &model));
        if self.objective == Objective::Tight { [tight, averaging] } else { [averaging, tight] }
    }

    fn settings_within_box(&self, rule: ModelRule, model: &ProcessModel) -> Option<PiTuning> {
        let settings = rule.settings(model).ok()?;
        Some(self.search.clip(PiTuning { gain: settings.gain, integral_time_s: settings.integral_time }))
    }

    /// Takes a published disturbance up, at the level and the inflow at which the experiment starts now, with the reference that
    /// belongs to it.
    pub fn set_published_disturbance(&mut self, disturbance: PublishedDisturbance) {
        let start = &self.experiment;
        self.experiment = LevelExperiment { level: start.level, inflow: start.inflow, ..disturbance.experiment() };
        self.set_objective(self.objective);
    }

    /// Takes a disturbance of one's own up, as large as a tenth of the outflow at the level of the start with the valve open, with the
    /// reference that belongs to it. It acts as long as the one before, and all the time where that did not act.
    pub fn set_own_disturbance(&mut self, kind: OwnDisturbance) {
        let tenth = 0.1 * self.plant().flows(self.experiment.level, 1.0)[1];
        let experiment = &mut self.experiment;
        experiment.disturbance.signal = match kind {
            OwnDisturbance::Step => InflowSignal::Step { size: tenth },
            OwnDisturbance::Sine => InflowSignal::Sine { amplitude: tenth, period_s: 60.0 },
            OwnDisturbance::Random => InflowSignal::Normal { std: tenth, sample_time_s: 1.0, seed: 1 },
            OwnDisturbance::None => InflowSignal::None,
        };
        if experiment.disturbance.until_s <= experiment.disturbance.from_s {
            (experiment.disturbance.from_s, experiment.disturbance.until_s) = (0.0, experiment.duration_s);
        }
        self.take_reference();
    }

    /// Changes the plant. One that is as a published plant is that, by its name.
    pub fn edit_plant(&mut self, change: impl FnOnce(&mut LevelPlant)) {
        let mut plant = self.plant();
        change(&mut plant);
        let known = LevelPresetId::ALL.into_iter().find(|id| id.plant() == plant);
        self.plant = known.map_or(LevelPlantSpec::Parameters(plant), LevelPlantSpec::Preset);
    }

    /// Gives the tank another law of outflow, with the flow that the present one has at the level of the experiment.
    pub fn set_outflow_law(&mut self, law: OutflowLaw) {
        let level = self.experiment.level.max(f64::MIN_POSITIVE);
        self.edit_plant(|plant| {
            let flow = plant.tank.outflow.flow(level);
            if plant.tank.outflow.law() != law {
                plant.tank.outflow = law.through(level, flow);
            }
        });
        self.take_reference();
    }

    /// Whether a map of the cost and a search of another setup are those of this one, whatever the controller is now.
    pub fn has_same_problem(&self, other: &Self) -> bool {
        (&self.plant, &self.experiment, self.cost(), self.search)
            == (&other.plant, &other.experiment, other.cost(), other.search)
            && self.anti_windup() == other.anti_windup()
    }

    /// The tuning of a continuous PI controller; `None` for any other.
    pub fn pi_tuning(&self) -> Option<PiTuning> {
        match self.controller {
            LevelController::Pi { gain, integral_time_s, .. } => Some(PiTuning { gain, integral_time_s }),
            _ => None,
        }
    }

    /// Makes the controller a continuous PI controller with a tuning; the anti-windup stays.
    pub fn set_pi_tuning(&mut self, tuning: PiTuning) {
        let PiTuning { gain, integral_time_s } = tuning;
        self.controller = LevelController::Pi { gain, integral_time_s, anti_windup: self.anti_windup() };
    }

    /// The band that averaging control is usually given: 30 to 70 % of the range of the transmitter (Foley 2000; Horton 2003).
    pub fn usual_band(&self) -> [f64; 2] {
        let [low, high] = self.plant().transmitter.level_range;
        [0.3, 0.7].map(|share| low + share * (high - low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::level_loop::published_setup;

    #[test]
    fn another_objective_brings_its_variance_and_the_reference_of_the_source() {
        let mut setup = LevelLoopSetup::default();
        assert_eq!(setup.published_disturbance(), Some(PublishedDisturbance::SineL));
        setup.set_objective(Objective::Averaging { band: setup.usual_band() });
        assert_eq!(setup.search.measure, CostMeasure::OutflowVariance);
        assert_eq!(setup.reference, PiTuning { gain: 0.2, integral_time_s: 2999.7 });
        setup.set_objective(Objective::Tight);
        assert_eq!(setup, LevelLoopSetup::default());
    }

    /// The open valve lets 0.0301 m³/s through at 1 m (Andreis 2017, Eq. 84, with Table 4.2).
    #[test]
    fn a_disturbance_of_ones_own_is_a_tenth_of_the_largest_outflow_and_acts_when_the_one_before_did() {
        let mut setup = LevelLoopSetup::default();
        for kind in OwnDisturbance::ALL {
            setup.set_own_disturbance(kind);
            assert_eq!(OwnDisturbance::of(&setup.experiment.disturbance.signal), kind);
            assert_eq!((setup.experiment.disturbance.from_s, setup.experiment.disturbance.until_s), (50.0, 150.0));
        }
        setup.set_own_disturbance(OwnDisturbance::Step);
        let InflowSignal::Step { size } = setup.experiment.disturbance.signal else { panic!() };
        assert!((size - 0.1 * 2.40153e-5 * 400.0 * 9.8_f64.sqrt()).abs() < 1e-7, "{size}");
    }

    #[test]
    fn only_steps_of_the_set_point_within_the_run_count() {
        let mut setup = LevelLoopSetup::default();
        assert!(!setup.steps_set_point());
        let step = |time_s, size| crate::sim::level::SignalStep { time_s, size };
        for (step, counts) in [(step(301.0, 0.1), false), (step(0.0, 0.0), false), (step(0.0, 0.1), true)] {
            setup.experiment.set_point_steps = vec![step];
            assert_eq!(setup.steps_set_point(), counts);
        }
    }

    #[test]
    fn the_controller_does_not_change_the_problem_of_a_search_but_the_objective_does() {
        let setup = LevelLoopSetup::default();
        let mut other = setup.clone();
        other.set_pi_tuning(PiTuning { gain: 3.0, integral_time_s: 40.0 });
        assert!(setup.has_same_problem(&other));
        other.set_objective(Objective::Averaging { band: other.usual_band() });
        assert!(!setup.has_same_problem(&other));
    }

    #[test]
    fn a_loop_without_published_tunings_has_references_by_rules_whatever_came_before() {
        let reference = |path: &[PublishedDisturbance]| {
            let mut setup = LevelLoopSetup::default();
            for disturbance in path {
                setup.set_published_disturbance(*disturbance);
            }
            setup.experiment.disturbance.until_s = 120.0;
            setup.set_objective(Objective::Tight);
            setup.reference
        };
        let direct = reference(&[]);
        assert_eq!(direct, reference(&[PublishedDisturbance::Random]));
        // SIMC by the half rule at 0.017 m³/s: (7.36, 24 s), Ms 1.8 (docs/model.md, §15).
        assert!((direct.gain - 7.36).abs() < 0.01 && (direct.integral_time_s - 24.0).abs() < 0.05, "{direct:?}");
        let mut setup = LevelLoopSetup::default();
        setup.set_outflow_law(OutflowLaw::Pumped);
        let tight = setup.reference;
        setup.set_objective(Objective::Averaging { band: setup.usual_band() });
        assert!(setup.reference.gain < tight.gain / 5.0, "{:?}", setup.reference);
    }

    #[test]
    fn a_plant_that_is_changed_and_changed_back_keeps_its_name() {
        let mut setup = LevelLoopSetup::default();
        setup.edit_plant(|plant| plant.transmitter.lag_s = 0.0);
        assert!(matches!(setup.plant, LevelPlantSpec::Parameters(_)) && setup.published_tunings().is_empty());
        setup.edit_plant(|plant| plant.transmitter.lag_s = 0.5);
        assert_eq!(setup, LevelLoopSetup::default());
    }

    #[test]
    fn another_law_of_outflow_leaves_the_loop_at_rest() {
        let mut setup = LevelLoopSetup::default();
        for law in [OutflowLaw::Pumped, OutflowLaw::Linear, OutflowLaw::SquareRoot] {
            setup.set_outflow_law(law);
            let rest = setup.plant().rest(setup.experiment.level, setup.experiment.inflow).unwrap();
            assert!((rest.output - 7.353_98).abs() < 1e-5, "{law:?}: {rest:?}");
        }
    }

    #[test]
    fn another_disturbance_keeps_where_the_experiment_starts() {
        let mut setup = LevelLoopSetup::default();
        setup.experiment.inflow = 0.012;
        setup.set_published_disturbance(PublishedDisturbance::SineH);
        assert_eq!(
            (setup.experiment.inflow, setup.published_disturbance()),
            (0.012, Some(PublishedDisturbance::SineH))
        );
        assert_eq!(setup.reference, PiTuning { gain: 5.0, integral_time_s: 2999.7 });
    }

    #[test]
    fn published_tunings_are_listed_once_and_only_for_the_loop_of_the_source() {
        let tunings = LevelLoopSetup::default().published_tunings();
        let gains: Vec<f64> = tunings.iter().map(|one| one.tuning.gain).collect();
        assert_eq!(gains[0], 10.0);
        for (k, one) in tunings.iter().enumerate() {
            assert!(tunings[k + 1..].iter().all(|other| other.tuning != one.tuning), "{gains:?}");
        }
        let slides = published_setup(LevelPresetId::LectureSlides, PublishedDisturbance::SineL);
        assert_eq!((slides.published_tunings(), slides.published_disturbance()), (Vec::new(), None));
    }
}
