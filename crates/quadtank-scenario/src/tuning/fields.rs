use crate::ScenarioError;
use crate::fields::{Fields, ITSELF, Part, names};
use crate::limits::{self, Limits};
use quadtank::control::Pairing;
use quadtank::plant::PresetId;
use quadtank::tuning::{Action, PlacementMethod, PublishedPlant, TuningRule};

use super::{
    Behind, CompareSpec, CriticalSpec, DecouplerSpec, DesignSpec, Element, ResponseSpec, TestKind, TestSpec,
    TuningPlant, TuningScenario, TuningSetup,
};

/// Largest number of most fields, and smallest where only positive ones make sense.
const LARGEST: f64 = 1e6;
const SMALLEST: f64 = 1e-6;
const ANY: Limits = Limits::new(-LARGEST, LARGEST);
const NOT_NEGATIVE: Limits = Limits::new(0.0, LARGEST);
const POSITIVE: Limits = Limits::new(SMALLEST, LARGEST);
/// The longest record: rows.
const MOST_ROWS: f64 = 100_000.0;
/// Most passes of a sequence.
const MOST_PASSES: u32 = 20;
/// Rows of all records of a sequence together.
const MOST_ROWS_OF_ALL: Limits = Limits::new(0.0, 500_000.0);
/// Largest coefficient, and smallest that is not zero: products of them stay numbers.
const COEFFICIENT: f64 = 1e12;
/// Longest list of coefficients.
const MOST_COEFFICIENTS: usize = 8;
/// How much quicker than a record, and than a dead time, the quickest part of a plant may be: it asks for more steps than anyone
/// waits for.
const QUICKEST_IN_RECORD: Limits = Limits::new(0.0, 2e6);
const QUICKEST_IN_DEAD_TIME: Limits = Limits::new(0.0, 1e4);

impl Part for TuningScenario {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.version(&mut self.version, Self::VERSION);
        f.part("tuning", &mut self.tuning);
        let blank = || Self::default().tuning;
        f.spare().list("pinned", &mut self.pinned, Self::MAX_PINNED, blank, Part::fields);
    }
}

impl Part for TuningSetup {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("plant", &mut self.plant);
        f.part("test", &mut self.test);
        f.part("design", &mut self.design);
        f.part("response", &mut self.response);
        if f.is_checking() {
            // A plant that is none is told when it is used.
            let (quickest, dead_time) = self.plant.pace().unwrap_or_default();
            let longest = self.test.duration.max(self.response.duration);
            f.check("plant: quickest pole * duration", quickest * longest, QUICKEST_IN_RECORD);
            f.check("plant: quickest pole * dead time", quickest * dead_time, QUICKEST_IN_DEAD_TIME);
        }
    }
}

impl Part for TuningPlant {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let rig = Self::QuadrupleTank {
            preset: PresetId::JohanssonMinimumPhase,
            valves: None,
            pairing: Pairing::Diagonal,
            dead_time_s: 0.0,
            lag_s: 0.0,
            nonlinear: false,
        };
        let table = [
            ("published", Self::Published(PublishedPlant::WoodBerry)),
            ("quadruple_tank", rig),
            ("elements", Self::Elements(Default::default())),
        ];
        f.choice(self, &table, |plant, f| match plant {
            Self::Published(plant) => plant.fields(f),
            Self::QuadrupleTank { preset, valves, pairing, dead_time_s, lag_s, nonlinear } => {
                f.part("preset", preset);
                f.option("valves", valves, Default::default, |valves, f| f.pair(ITSELF, valves, limits::VALVE));
                f.part("pairing", pairing);
                f.spare().number("dead_time_s", dead_time_s, NOT_NEGATIVE);
                f.spare().number("lag_s", lag_s, NOT_NEGATIVE);
                f.spare().flag("nonlinear", nonlinear);
                if *nonlinear {
                    f.check("dead_time_s", *dead_time_s, Limits::new(0.0, 0.0));
                    f.check("lag_s", *lag_s, Limits::new(0.0, 0.0));
                }
            }
            Self::Elements(rows) => rows.fields(f),
        });
    }
}

names!(PublishedPlant: "wood-berry" WoodBerry, "process-two" ProcessTwo);

impl Part for Element {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.list("numerator", &mut self.numerator, MOST_COEFFICIENTS, f64::default, coefficient);
        f.list("denominator", &mut self.denominator, MOST_COEFFICIENTS, f64::default, coefficient);
        f.spare().number("dead_time", &mut self.dead_time, NOT_NEGATIVE);
        if f.is_checking()
            && let Some(fault) = self.fault()
        {
            f.refuse(ITSELF, |field| ScenarioError::Element { field, fault });
        }
    }
}

fn coefficient(value: &mut f64, f: &mut Fields<'_>) {
    f.number(ITSELF, value, Limits::new(-COEFFICIENT, COEFFICIENT));
    if *value != 0.0 {
        f.check(ITSELF, value.abs(), Limits::new(COEFFICIENT.recip(), COEFFICIENT));
    }
}

impl Part for TestSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("kind", &mut self.kind);
        f.spare().index("number", &mut self.number, 1, 2);
        f.spare().part("behind", &mut self.behind);
        f.pair("amplitudes", &mut self.amplitudes, POSITIVE);
        f.spare().pair("hysteresis", &mut self.hysteresis, NOT_NEGATIVE);
        f.spare().pair("bias", &mut self.bias, ANY);
        f.part("rule", &mut self.rule);
        f.spare().pair("detuning", &mut self.detuning, POSITIVE);
        f.spare().index("passes", &mut self.passes, 1, MOST_PASSES);
        f.number("duration", &mut self.duration, POSITIVE);
        f.number("release", &mut self.release, NOT_NEGATIVE);
        f.number("step", &mut self.step, NOT_NEGATIVE);
        f.check("release", self.release, Limits::new(0.0, self.duration));
        check_step(f, self.step, self.duration);
        let rows = self.passes as f64 * self.duration / self.step;
        f.check(": passes * duration / step", rows, MOST_ROWS_OF_ALL);
    }
}

/// A record has at least one row, and not too many.
fn check_step(f: &mut Fields<'_>, step: f64, duration: f64) {
    f.check("step", step, Limits::new(duration / MOST_ROWS, duration));
}

names!(TestKind: "single" Single, "independent" Independent, "sequential" Sequential, "simultaneous" Simultaneous);

impl Part for Behind {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let table =
            [("nothing", Self::Nothing), ("integrator", Self::Integrator), ("modulus", Self::Modulus(SMALLEST))];
        f.choice(self, &table, |choice, f| {
            if let Self::Modulus(modulus) = choice {
                f.number(ITSELF, modulus, POSITIVE);
            }
        });
    }
}

names! {
    TuningRule:
    "ziegler-nichols-p" ZieglerNicholsP,
    "ziegler-nichols-pi" ZieglerNicholsPi,
    "ziegler-nichols-pid" ZieglerNicholsPid,
    "tyreus-luyben-pi" TyreusLuybenPi,
    "tyreus-luyben-pid" TyreusLuybenPid,
}

impl Part for DesignSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("critical", &mut self.critical);
        f.part("method", &mut self.method);
        f.part("action", &mut self.action);
        f.pair("target", &mut self.target, ANY);
        f.index("root", &mut self.root, 1, 2);
        f.spare().part("decoupler", &mut self.decoupler);
    }
}

impl Part for CriticalSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let point = Self::Point { gains: [0.0; 2], period: SMALLEST };
        f.choice(self, &[("importance", Self::Importance(SMALLEST)), ("point", point)], |critical, f| match critical {
            Self::Importance(importance) => f.number(ITSELF, importance, POSITIVE),
            Self::Point { gains, period } => {
                f.pair("gains", gains, ANY);
                f.number("period", period, POSITIVE);
            }
        });
    }
}

names!(PlacementMethod: "one-locus" OneLocus, "both-loci" BothLoci);

names!(Action: "pi" Pi, "pid" Pid);

names! {
    DecouplerSpec:
    "none" None,
    "static" Static,
    "dynamic" Dynamic,
    "first-output" FirstOutput,
    "second-output" SecondOutput,
}

impl Part for ResponseSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.pair("references", &mut self.references, ANY);
        f.number("duration", &mut self.duration, POSITIVE);
        f.number("step", &mut self.step, NOT_NEGATIVE);
        f.spare().part("compare", &mut self.compare);
        check_step(f, self.step, self.duration);
    }
}

names!(CompareSpec: "nothing" Nothing, "ziegler-nichols" ZieglerNichols, "tyreus-luyben" TyreusLuyben, "full" Full);
