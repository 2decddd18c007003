use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::control::Pairing;
use crate::tuning::{Action, PlacementMethod};

use super::GivenPid;

/// The critical point that a design starts from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum CriticalSpec {
    /// The point of the curve where loop 2 has this importance r2.
    Importance(f64),
    /// A point as printed or measured.
    Point {
        /// Gains kc1, kc2.
        gains: [f64; 2],
        /// Period Tc.
        period: f64,
    },
}

/// What stands between controllers and plant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DecouplerSpec {
    /// Nothing.
    #[default]
    None,
    /// Constant gains.
    Static,
    /// Both cross paths removed.
    Dynamic,
    /// Only the way from loop 2 to output 1.
    FirstOutput,
    /// Only the way from loop 1 to output 2.
    SecondOutput,
}

/// The controllers of a session: by a placement of the critical point, or given.
///
/// In a document given controllers need nothing else; what a placement has is written beside them only where it differs from
/// [`DesignSpec::default`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignSpec {
    /// The critical point that a placement starts from, and that rules make the controllers of that a response is compared with.
    pub critical: CriticalSpec,
    /// Which loci a placement moves.
    pub method: PlacementMethod,
    /// With which controllers.
    pub action: Action,
    /// Target λ: real and imaginary part.
    pub target: [f64; 2],
    /// Root 1 or 2; root 1 has the larger controller in loop 1.
    pub root: usize,
    /// Decoupler of the response.
    pub decoupler: DecouplerSpec,
    /// Controllers of loops 1 and 2 that take the place of those of a placement.
    pub controllers: Option<[GivenPid; 2]>,
    /// Which input of the plant each of them drives.
    pub pairing: Pairing,
}

impl Default for DesignSpec {
    /// A placement from the point of the curve where both loops are equally important.
    fn default() -> Self {
        Self {
            critical: CriticalSpec::Importance(1.0),
            method: PlacementMethod::BothLoci,
            action: Action::Pid,
            target: [-0.3, -0.3],
            root: 1,
            decoupler: DecouplerSpec::None,
            controllers: None,
            pairing: Pairing::Diagonal,
        }
    }
}

impl DesignSpec {
    /// Given controllers on the diagonal, without a decoupler.
    pub fn given(controllers: [GivenPid; 2]) -> Self {
        Self { controllers: Some(controllers), ..Self::default() }
    }
}

/// A design as it stands in a document.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename = "DesignSpec", deny_unknown_fields)]
struct WrittenDesign {
    /// The critical point that a placement starts from; may be absent with given controllers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "CriticalSpec"))]
    critical: Option<CriticalSpec>,
    /// Which loci a placement moves; without effect on given controllers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "PlacementMethod"))]
    method: Option<PlacementMethod>,
    /// With which controllers; without effect on given ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "Action"))]
    action: Option<Action>,
    /// Target λ: real and imaginary part; without effect on given controllers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "[f64; 2]"))]
    target: Option<[f64; 2]>,
    /// Root 1 or 2; root 1 has the larger controller in loop 1; without effect on given controllers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "usize"))]
    root: Option<usize>,
    /// Decoupler of the response.
    #[serde(default)]
    decoupler: DecouplerSpec,
    /// Controllers of loops 1 and 2 that are given instead of placed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "[GivenPid; 2]"))]
    controllers: Option<[GivenPid; 2]>,
    /// Which input of the plant each given controller drives; diagonal where it is absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "Pairing"))]
    pairing: Option<Pairing>,
}

impl From<DesignSpec> for WrittenDesign {
    fn from(spec: DesignSpec) -> Self {
        /// A value that is always written, or only where it is not what its absence means.
        fn written<T: PartialEq>(value: T, absent: &T, always: bool) -> Option<T> {
            (always || value != *absent).then_some(value)
        }
        let (absent, placed) = (DesignSpec::default(), spec.controllers.is_none());
        Self {
            critical: written(spec.critical, &absent.critical, placed),
            method: written(spec.method, &absent.method, placed),
            action: written(spec.action, &absent.action, placed),
            target: written(spec.target, &absent.target, placed),
            root: written(spec.root, &absent.root, placed),
            decoupler: spec.decoupler,
            controllers: spec.controllers,
            pairing: written(spec.pairing, &absent.pairing, false),
        }
    }
}

impl Serialize for DesignSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        WrittenDesign::from(*self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for DesignSpec {
    /// What a placement needs may be absent with given controllers only.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let WrittenDesign { critical, method, action, target, root, decoupler, controllers, pairing } =
            WrittenDesign::deserialize(deserializer)?;
        let absent = Self::default();
        let is_given = controllers.is_some();
        Ok(Self {
            critical: needed(critical, absent.critical, is_given, "critical")?,
            method: needed(method, absent.method, is_given, "method")?,
            action: needed(action, absent.action, is_given, "action")?,
            target: needed(target, absent.target, is_given, "target")?,
            root: needed(root, absent.root, is_given, "root")?,
            decoupler,
            controllers,
            pairing: pairing.unwrap_or(absent.pairing),
        })
    }
}

/// A value of a placement, which may be absent where controllers are given.
fn needed<T, E: Error>(value: Option<T>, absent: T, is_given: bool, name: &'static str) -> Result<T, E> {
    match value {
        Some(value) => Ok(value),
        None if is_given => Ok(absent),
        None => Err(E::missing_field(name)),
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for DesignSpec {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        WrittenDesign::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let mut schema = WrittenDesign::json_schema(generator);
        let complete = schemars::json_schema!({ "anyOf": [
            { "required": ["critical", "method", "action", "target", "root"] },
            { "required": ["controllers"] },
        ] });
        for (name, value) in complete.as_object().into_iter().flatten() {
            schema.insert(name.clone(), value.clone());
        }
        schema
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::LoopStability;
    use crate::literature::campestrini::PublishedPlant;
    use crate::literature::wood_berry::PublishedControllers;
    use crate::study::relay_tuning::{Designed, PlantStudy, TuningPlant, TuningSetup};

    fn designed(setup: &TuningSetup) -> Designed {
        PlantStudy::of(&setup.plant).unwrap().design(setup).unwrap().unwrap()
    }

    #[test]
    fn given_controllers_that_a_placement_found_do_what_they_do_there() {
        let mut setup = TuningSetup::default();
        let placed = designed(&setup);
        setup.give_placed_controllers();
        let given = designed(&setup);
        assert_eq!((given.roots.len(), given.chosen), (1, 0));
        assert_eq!((given.critical, given.chosen_root().closure), (placed.critical, placed.chosen_root().closure));
        for (one, other) in placed.response.figures.iter().zip(given.response.figures) {
            assert!((one.iae - other.iae).abs() < 1e-9 * one.iae, "{one:?} {other:?}");
        }
    }

    #[test]
    fn given_controllers_need_no_critical_point() {
        // Without a dead time two lags under proportional control are stable for every gain.
        let lag = |gain: f64| crate::study::relay_tuning::Element {
            numerator: vec![gain],
            denominator: vec![1.0, 10.0],
            dead_time: 0.0,
        };
        let mut setup = TuningSetup::on(TuningPlant::Elements([[lag(2.0), lag(0.5)], [lag(-0.5), lag(1.0)]]));
        let study = PlantStudy::of(&setup.plant).unwrap();
        assert_eq!(study.design(&setup), Ok(None));
        setup.design = DesignSpec::given([GivenPid { gain: 1.0, integral_time: Some(5.0), ..GivenPid::default() }; 2]);
        let design = study.design(&setup).unwrap().unwrap();
        assert_eq!((design.critical, design.chosen_root().stability), (None, LoopStability::Stable));
        assert!(
            design.response.is_bounded && design.loci[0].frequency.is_empty() && !design.loci[1].frequency.is_empty()
        );
    }

    #[test]
    fn the_other_pairing_is_that_of_the_plant_with_its_inputs_exchanged() {
        let mut setup = TuningSetup::on(TuningPlant::Published(PublishedPlant::ProcessTwo));
        let pid = |gain: f64| GivenPid { gain, integral_time: Some(1.0), derivative_time: 0.1, ..GivenPid::default() };
        setup.design = DesignSpec { pairing: Pairing::Swapped, ..DesignSpec::given([pid(-0.2), pid(0.3)]) };
        let study = PlantStudy::of(&setup.plant).unwrap();
        let swapped = study.design(&setup).unwrap().unwrap();
        assert_eq!(swapped.chosen_root().stability, LoopStability::Stable);
        assert_eq!(swapped.chosen_root().warnings, []);
        assert!(study.peaks(swapped.chosen_root()).unwrap().sensitivity.is_some());
        // Loop 1 drives input 2, which moves before anything else does.
        let inputs = &swapped.response.trace.inputs;
        assert!(inputs[0][0].abs() < 1e-12 && inputs[1][0] < -0.2, "{} {}", inputs[0][0], inputs[1][0]);
        setup.design.pairing = Pairing::Diagonal;
        assert!(!study.design(&setup).unwrap().unwrap().chosen_root().warnings.is_empty());
    }

    #[test]
    fn published_controllers_keep_their_filter() {
        let setup = TuningSetup::with_published(PublishedControllers::BoydHastAstrom);
        let found = designed(&setup);
        let gains = PublishedControllers::BoydHastAstrom.gains();
        for (found, printed) in found.chosen_root().controllers.iter().zip(gains) {
            assert_eq!(found.filter_time(), 0.3);
            assert!(
                (found.integral - printed.integral).abs() < 1e-15
                    && (found.derivative - printed.derivative).abs() < 1e-15
            );
        }
    }
}
