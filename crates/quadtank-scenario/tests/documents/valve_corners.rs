//! Corners of the valve plane: pairs that add up to 1 in decimals, and shares of next to nothing.

use approx::assert_relative_eq;
use quadtank::interaction::{PairingReason, PairingVerdict};
use quadtank::linear::{Complex, LinearError, Stability};
use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::{Analysis, Setup, ValveMap, analyse, setup_of};

/// Bar of the project for zeros (relative).
const ORACLE: f64 = 1e-9;

fn with_valves(id: PresetId, valves: [f64; 2]) -> Setup {
    Setup { valves, ..setup_of(id) }
}

fn analysed(id: PresetId, valves: [f64; 2]) -> Analysis {
    analyse(&with_valves(id, valves)).unwrap_or_else(|error| panic!("{id:?} {valves:?}: {error}"))
}

/// Pairs of decimals that add up to 1, some of which do not in binary.
fn on_the_line() -> impl Iterator<Item = [f64; 2]> {
    let pair = |digits: u32, share: u64| {
        let of = |share: u64| format!("{share}e-{digits}").parse::<f64>().unwrap();
        [of(share), of(10_u64.pow(digits) - share)]
    };
    let shares = |digits: u32| [1, 3, 7, 10_u64.pow(digits) / 3].into_iter().map(move |share| (digits, share));
    let pairs = (1..=16).flat_map(shares).map(move |(digits, share)| pair(digits, share));
    pairs.flat_map(|[one, other]| [[one, other], [other, one]])
}

#[test]
fn a_pair_that_adds_up_to_one_in_decimals_is_on_the_line() {
    for valves in on_the_line().filter(|valves| valves.iter().all(|&valve| valve > 0.0 && valve < 1.0)) {
        for id in PresetId::ALL {
            let analysis = analysed(id, valves);
            let zeros = analysis.linear.zeros.unwrap();
            assert!(zeros.iter().any(|zero| zero.value == Complex::ZERO), "{id:?} {valves:?}: {zeros:?}");
            assert!(matches!(analysis.linear.rga_11, Err(LinearError::SingularGain { .. })), "{valves:?}");
            assert_eq!(analysis.linear.niederlinski, [None; 2]);
            assert_eq!(analysis.linear.verdict, PairingVerdict::None(PairingReason::SingularGain));
            assert_ne!(analysis.closed_loop.stability, Stability::Stable, "{id:?} {valves:?}");
            assert!(analysis.time_constants_s.iter().all(|time| time.is_some_and(|time| time > 0.0)));
            let setup = with_valves(id, valves);
            assert_eq!(ValveMap::of(&setup).unwrap().rightmost_zero(valves), Some(0.0));
        }
    }
}

/// The closed form is exact at any flow (Cocota 2009, eqs. 3.22 and 3.23). The model is good to 1e-9, and to 1e-8 where an
/// upper tank has become quasi-steady; its own zero is beyond all others.
#[test]
fn a_share_of_next_to_nothing_moves_the_zeros_as_in_the_closed_form() {
    let id = PresetId::JohanssonMinimumPhase;
    for digits in 1..=15 {
        let small = 10_f64.powi(-digits);
        for valves in [[1.0 - small, 0.6], [0.6, 1.0 - small], [1.0 - small, 3.0 * small], [4.0 * small, 1.0 - small]] {
            let analysis = analysed(id, valves);
            assert!(analysis.time_constants_s.iter().all(Option::is_some), "{valves:?}");
            let zeros = analysis.linear.zeros.unwrap();
            let expected = ValveMap::of(&with_valves(id, valves)).unwrap().rightmost_zero(valves).unwrap();
            let tolerance = if zeros.len() == 2 { ORACLE } else { 1e-8 };
            assert_relative_eq!(zeros.last().unwrap().value.re, expected, max_relative = tolerance);
        }
    }
}

/// With almost all water through the upper tanks the zeros go to ±√(η/(T3 T4)).
#[test]
fn a_lower_tank_with_next_to_no_inflow_of_its_own_sends_the_zeros_far_away() {
    let id = PresetId::JohanssonMinimumPhase;
    for digits in 1..=9 {
        let valves = [10_f64.powi(-digits), 0.6];
        let zeros = analysed(id, valves).linear.zeros.unwrap();
        let expected = ValveMap::of(&with_valves(id, valves)).unwrap().rightmost_zero(valves).unwrap();
        // A feedthrough of γ1 is known to the rounding of the other entries.
        let tolerance = ORACLE.max(f64::EPSILON / valves[0]);
        assert_relative_eq!(zeros.last().unwrap().value.re, expected, max_relative = tolerance);
    }
}
