use std::f64::consts::TAU;

use crate::control::{IsaPid, Pairing};
use crate::literature::PresetId;
use crate::literature::campestrini::{PublishedCase, PublishedPlacement, PublishedPlant};
use crate::literature::wood_berry::PublishedControllers;
use crate::plant::QuadrupleTank;
use crate::tuning::{GainLimit, TuningRule, importance_direction};

use super::{
    CompareSpec, CriticalSpec, DesignSpec, GivenPid, PlantStudy, ResponseSpec, SeriesElement, TestKind, TestSpec,
    TuningPlant, TuningSetup,
};

/// Dead time that a rig begins with (s): without one its minimum-phase setting has no ultimate point, and relays chatter.
pub(super) const DEAD_TIME_S: f64 = 5.0;
/// Lengths of records in critical periods, rows in a period of a test, and the period where there is none.
const TEST_PERIODS: f64 = 25.0;
const RESPONSE_PERIODS: f64 = 12.0;
const ROWS: f64 = 200.0;
const NO_PERIOD: f64 = 100.0;
/// The longest such period in time constants of the quickest pole, so that its record can be followed.
const QUICKEST_IN_PERIOD: f64 = 1000.0;

/// The period that records are made for where nothing oscillates.
fn period_without_oscillation(plant: &TuningPlant) -> f64 {
    let quickest = plant.fastest_rate_and_dead_time().map_or(0.0, |(quickest, _)| quickest);
    NO_PERIOD.min(QUICKEST_IN_PERIOD / quickest)
}

impl TestSpec {
    /// Ideal relays of amplitude 1 in both loops.
    pub fn simultaneous(duration: f64, release: f64, step: f64) -> Self {
        Self {
            kind: TestKind::Simultaneous,
            number: 1,
            behind: SeriesElement::Nothing,
            amplitudes: [1.0; 2],
            hysteresis: [0.0; 2],
            bias: [0.0; 2],
            rule: TuningRule::ZieglerNicholsPi,
            detuning: [1.0; 2],
            passes: 1,
            duration,
            release,
            step,
        }
    }
}

impl TuningPlant {
    /// A published rig with the pairing that its relative gains suggest.
    pub fn rig(preset: PresetId) -> Self {
        let [one, two] = preset.preset().plant.valves;
        let pairing = if one + two > 1.0 { Pairing::Diagonal } else { Pairing::Swapped };
        Self::QuadrupleTank { preset, valves: None, pairing, dead_time_s: DEAD_TIME_S, lag_s: 0.0, nonlinear: false }
    }

    /// A rig of one's own, at rest at these voltages (V), with the pairing that its valves suggest. It begins with a dead time of
    /// 5 s, or with that of its hoses where both pumps have one.
    pub fn own_rig(rig: QuadrupleTank, pump_voltage: [f64; 2]) -> Self {
        let [one, two] = rig.incremental_fractions(pump_voltage);
        let pairing = if one + two > 1.0 { Pairing::Diagonal } else { Pairing::Swapped };
        let has_hoses = rig.pumps.iter().all(|pump| pump.delay_s > 0.0);
        let dead_time_s = if has_hoses { 0.0 } else { DEAD_TIME_S };
        Self::Parameters { rig: Box::new(rig), pump_voltage, pairing, dead_time_s, lag_s: 0.0, nonlinear: false }
    }
}

impl TuningSetup {
    /// A session to begin with on a plant: its records are long enough for what oscillates at equal importance.
    pub fn on(plant: TuningPlant) -> Self {
        match plant {
            TuningPlant::Published(PublishedPlant::WoodBerry) => Self::default(),
            TuningPlant::Published(PublishedPlant::ProcessTwo) => Self::published(PublishedCase { table: 16, row: 1 }),
            plant => Self::paced(plant),
        }
    }

    fn paced(plant: TuningPlant) -> Self {
        let limit = PlantStudy::of(&plant).map(|study| study.search.limit(importance_direction(&study.rest_gain, 1.0)));
        let period = match limit {
            Ok(GainLimit::Oscillation(point)) => TAU / point.frequency,
            _ => period_without_oscillation(&plant),
        };
        Self {
            plant,
            test: TestSpec::simultaneous(TEST_PERIODS * period, 0.1 * period, period / ROWS),
            design: DesignSpec::default(),
            response: ResponseSpec {
                references: [1.0, 0.0],
                duration: RESPONSE_PERIODS * period,
                step: period / ROWS,
                compare: CompareSpec::Nothing,
            },
        }
    }

    /// The session of a published case, with a simultaneous test of equal amplitudes beside it.
    pub fn published(case: PublishedCase) -> Self {
        let PublishedPlacement { plant, critical_gains, critical_period, method, action, target, root } =
            case.placement();
        let (duration, step, response) = match plant {
            PublishedPlant::WoodBerry => (400.0, 0.05, 200.0),
            PublishedPlant::ProcessTwo => (40.0, 0.005, 20.0),
        };
        Self {
            plant: TuningPlant::Published(plant),
            test: TestSpec::simultaneous(duration, 0.01 * duration, step),
            design: DesignSpec {
                critical: CriticalSpec::Point { gains: critical_gains, period: critical_period },
                method,
                action,
                target,
                root,
                ..DesignSpec::default()
            },
            response: ResponseSpec {
                references: [1.0, 0.0],
                duration: response,
                step: 2.0 * step,
                compare: CompareSpec::Nothing,
            },
        }
    }
}

impl TuningSetup {
    /// A session on the column of Wood and Berry with published controllers.
    pub fn with_published(controllers: PublishedControllers) -> Self {
        let given = |pid| GivenPid { filter_time: controllers.filter_time(), ..GivenPid::from(pid) };
        let design = DesignSpec::given(controllers.settings().map(given));
        Self { design, ..Self::default() }
    }

    /// Gives the controllers that the placement of the session finds, to go on from; open loops where it finds none. A negative integral
    /// or derivative time is left out, because a given controller has none.
    pub fn give_placed_controllers(&mut self) {
        let found = PlantStudy::of(&self.plant).and_then(|study| study.design(self));
        let placed = found.ok().flatten().map(|design| design.chosen_root().forms.map(|forms| forms.isa));
        let given = |isa: Option<IsaPid>| {
            let GivenPid { gain, integral_time, derivative_time, .. } =
                isa.map_or_else(GivenPid::default, GivenPid::from);
            let integral_time = integral_time.filter(|&time| time > 0.0);
            GivenPid { gain, integral_time, derivative_time: derivative_time.max(0.0), ..GivenPid::default() }
        };
        self.design.controllers = Some(placed.unwrap_or_default().map(given));
    }
}

impl Default for TuningSetup {
    /// What the source recommends: both loci, PID, a target in the third quadrant (Campestrini 2006, Table 12).
    fn default() -> Self {
        Self::published(PublishedCase { table: 12, row: 2 })
    }
}
