//! Margins of random stable loops against a brute-force search that shares nothing with the library: its own evaluation of
//! G(jω) K(jω), its own eigenvalues, a dense grid with local refinement. Also the bounds on work of margins and encirclements.

use std::f64::consts::{PI, TAU};

use nalgebra::Matrix2;
use num_complex::Complex64;
use quadtank::control::{ParallelPid, PidMatrix};
use quadtank::linear::{LoopStability, Margins, TransferFunction, TransferMatrix};
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::study::relay_tuning::PlantStudy;
use quadtank::tuning::{Action, Design, PlacementMethod, propose, response_at};
use quadtank_scenario::{Document, document_from_json};

/// Random numbers (Steele, Lea and Flood 2014, `SplitMix64`).
pub struct Random(pub u64);

impl Random {
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn logarithmic(&mut self, low: f64, high: f64) -> f64 {
        self.uniform(low.ln(), high.ln()).exp()
    }

    fn chance(&mut self, share: f64) -> bool {
        self.uniform(0.0, 1.0) < share
    }
}

/// `gain (1 − zero s) e^(−θ s)/(Π (T s + 1) Π (s²/ω² + 2 ζ s/ω + 1))`.
#[derive(Clone, Debug)]
pub struct Element {
    gain: f64,
    zero: f64,
    lags: Vec<f64>,
    /// ω and ζ.
    resonance: Option<(f64, f64)>,
    pub dead_time: f64,
}

impl Element {
    fn random(random: &mut Random, gain: f64, has_dead_time: bool) -> Self {
        let slowest = random.logarithmic(0.5, 20.0);
        let order = if random.chance(0.5) { 1 } else { 2 + usize::from(random.chance(0.5)) };
        let lags = (0..order).map(|k| if k == 0 { slowest } else { slowest * random.uniform(0.1, 1.0) }).collect();
        let resonance =
            random.chance(0.25).then(|| (random.logarithmic(0.2, 5.0) / slowest, random.logarithmic(0.05, 0.7)));
        let zero = if order > 1 && random.chance(0.3) { slowest * random.uniform(-1.0, 1.0) } else { 0.0 };
        let dead_time = if has_dead_time { slowest * random.logarithmic(0.02, 20.0) } else { 0.0 };
        Self { gain, zero, lags, resonance, dead_time }
    }

    fn at(&self, w: f64) -> Complex64 {
        let s = Complex64::new(0.0, w);
        let mut value = self.gain * (1.0 - s * self.zero) * Complex64::from_polar(1.0, -w * self.dead_time);
        for lag in &self.lags {
            value /= s * *lag + 1.0;
        }
        if let Some((natural, damping)) = self.resonance {
            value /= (s / natural).powi(2) + s * (2.0 * damping / natural) + 1.0;
        }
        value
    }

    fn transfer_function(&self) -> TransferFunction {
        let zero = TransferFunction::new(vec![1.0, -self.zero], vec![1.0], 0.0).unwrap();
        let mut function = TransferFunction::lags(self.gain, &self.lags, self.dead_time).unwrap().times(&zero);
        if let Some((w, damping)) = self.resonance {
            let resonance = vec![1.0, 2.0 * damping / w, 1.0 / (w * w)];
            function = function.times(&TransferFunction::new(vec![1.0], resonance, 0.0).unwrap());
        }
        function
    }
}

/// A loop of four elements and two PI or PID controllers.
#[derive(Clone, Debug)]
pub struct Loop {
    plant: [[Element; 2]; 2],
    pub controllers: [ParallelPid; 2],
}

impl Loop {
    /// A stable loop, at a random share of the gains at which it stops to be stable.
    pub fn random(random: &mut Random) -> Self {
        loop {
            let drawn = Self::drawn(random);
            let share = random.uniform(0.1, 0.98);
            if let Some(limit) = drawn.limit() {
                let scaled = drawn.scaled(share * limit);
                if scaled.stability() == LoopStability::Stable {
                    return scaled;
                }
            }
        }
    }

    fn drawn(random: &mut Random) -> Self {
        let has_dead_time = random.chance(0.85);
        let coupling = if random.chance(0.1) { 0.0 } else { random.uniform(0.1, 1.2) };
        let mut element = |gain: f64| {
            let sign = if random.chance(0.5) { 1.0 } else { -1.0 };
            let gain = sign * gain * random.logarithmic(0.5, 2.0);
            let delayed = has_dead_time && random.chance(0.9);
            Element::random(random, gain, delayed)
        };
        let plant = [[element(1.0), element(coupling)], [element(coupling), element(1.0)]];
        let controllers = [0, 1].map(|i| {
            let own = &plant[i][i];
            let time = own.lags[0] + own.dead_time;
            let integral_time = time * random.logarithmic(0.2, 5.0);
            let proportional = random.logarithmic(0.2, 5.0) / own.gain;
            let derivative = if random.chance(0.4) { proportional * integral_time / 4.0 } else { 0.0 };
            ParallelPid { proportional, integral: proportional / integral_time, derivative, ..ParallelPid::default() }
        });
        Self { plant, controllers }
    }

    fn scaled(&self, factor: f64) -> Self {
        let controllers = self.controllers.map(|pid| ParallelPid {
            proportional: factor * pid.proportional,
            integral: factor * pid.integral,
            derivative: factor * pid.derivative,
            ..pid
        });
        Self { plant: self.plant.clone(), controllers }
    }

    pub fn transfer_matrix(&self) -> TransferMatrix {
        TransferMatrix(self.plant.each_ref().map(|row| row.each_ref().map(Element::transfer_function)))
    }

    fn stability(&self) -> LoopStability {
        Design::new(&self.transfer_matrix(), PidMatrix::decentralised(self.controllers)).unwrap().stability()
    }

    fn margins(&self) -> Option<Margins> {
        Design::new(&self.transfer_matrix(), PidMatrix::decentralised(self.controllers)).unwrap().margins()
    }

    /// A factor on the gains beyond which the loop is not stable, `None` where it never is.
    fn limit(&self) -> Option<f64> {
        let is_stable = |factor: f64| self.scaled(factor).stability() == LoopStability::Stable;
        let mut low = 1e-3;
        if !is_stable(low) {
            return None;
        }
        let mut high = (1..20).map(|k| low * 2.0_f64.powi(k)).find(|&factor| !is_stable(factor))?;
        low = 0.5 * high;
        for _ in 0..6 {
            let middle = f64::midpoint(low, high);
            if is_stable(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    pub fn ratio(&self, w: f64) -> Matrix2<Complex64> {
        let s = Complex64::new(0.0, w);
        let controller = |pid: &ParallelPid| {
            let filter = (pid.derivative / pid.proportional).abs() / 100.0;
            pid.proportional + pid.integral / s + s * pid.derivative / (s * filter + 1.0)
        };
        let k = self.controllers.each_ref().map(controller);
        Matrix2::from_fn(|row, column| self.plant[row][column].at(w) * k[column])
    }

    /// The loci, in any order.
    fn loci(&self, w: f64) -> [Complex64; 2] {
        let ratio = self.ratio(w);
        let (half, determinant) = (ratio.trace() / 2.0, ratio.determinant());
        let root = (half * half - determinant).sqrt();
        let larger = if (half + root).norm() > (half - root).norm() { half + root } else { half - root };
        [larger, if larger == Complex64::ZERO { larger } else { determinant / larger }]
    }

    pub fn elements(&self) -> impl Iterator<Item = &Element> {
        self.plant.iter().flatten()
    }
}

/// Steps of the grid, relative to the frequency, and for each turn of the longest dead time.
const STEP: f64 = 3e-3;
const PER_TURN: f64 = 200.0;

/// Margins on a dense grid with local refinement.
fn by_brute_force(of: &Loop) -> Margins {
    let slowest = of.elements().flat_map(|g| g.lags.iter().copied().chain([g.dead_time])).fold(0.0, f64::max)
        + of.controllers.iter().map(|pid| pid.proportional / pid.integral).fold(0.0, f64::max);
    let quickest = of.elements().flat_map(|g| g.lags.iter().map(|t| 1.0 / t).chain(g.resonance.map(|(w, _)| w)));
    let quickest = quickest.fold(0.0, f64::max);
    let longest = of.elements().map(|g| g.dead_time).fold(0.0, f64::max);
    let distance = |w: f64| of.loci(w).map(|x| (x + 1.0).norm()).into_iter().fold(f64::INFINITY, f64::min);
    let mut found =
        Margins { distance: 1.0, distance_frequency: f64::INFINITY, gain_up: None, gain_down: None, phase: None };
    let mut w = 1e-8 / slowest;
    let mut loci = of.loci(w);
    let mut before = loci;
    let mut last = [(w, distance(w)); 2];
    for value in loci.into_iter().filter(|x| x.im.abs() <= 1e-6 * x.re.abs()) {
        on_real_axis(&mut found, value);
    }
    loop {
        let next = w + (STEP * w).min(TAU / (longest * PER_TURN));
        let ratio = of.ratio(next);
        let size = (0..2).map(|row| ratio[(row, 0)].norm() + ratio[(row, 1)].norm()).fold(0.0, f64::max);
        let reach = (1.0 - found.distance).min(found.gain_up.map_or(0.0, f64::recip));
        // Beyond the corners of the plant no controller lets the loop grow again.
        if next > 5.0 * quickest && size < (0.9 * reach).max(1e-4) {
            return found;
        }
        let there = ordered(of.loci(next), [0, 1].map(|i| loci[i] * 2.0 - before[i]));
        let at_next = distance(next);
        let [(left, at_left), (_, at_here)] = last;
        if at_here <= at_left && at_here <= at_next && at_here < 1.5 * found.distance {
            let (refined, at) = smallest(distance, left, next);
            if refined < found.distance {
                (found.distance, found.distance_frequency) = (refined, at);
            }
        }
        for branch in 0..2 {
            let ends = [(w, loci[branch]), (next, there[branch])];
            if let Some(value) = crossing(of, ends, |x| x.im) {
                on_real_axis(&mut found, value);
            }
            if let Some(value) = crossing(of, ends, |x| x.norm() - 1.0) {
                let lag = (value.arg() + PI).rem_euclid(TAU);
                found.phase = Some(found.phase.map_or(lag, |best| best.min(lag)));
            }
        }
        last = [last[1], (next, at_next)];
        (w, before, loci) = (next, loci, there);
    }
}

fn on_real_axis(found: &mut Margins, value: Complex64) {
    let factor = -1.0 / value.re;
    if factor > 1.0 {
        found.gain_up = Some(found.gain_up.map_or(factor, |best| best.min(factor)));
    } else if factor > 0.0 {
        found.gain_down = Some(found.gain_down.map_or(factor, |best| best.max(factor)));
    }
}

fn ordered([a, b]: [Complex64; 2], [first, second]: [Complex64; 2]) -> [Complex64; 2] {
    let straight = (a - first).norm() + (b - second).norm();
    if (b - first).norm() + (a - second).norm() < straight { [b, a] } else { [a, b] }
}

/// A minimum by trisection: its value and its place.
fn smallest(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    for _ in 0..60 {
        let third = (high - low) / 3.0;
        if function(low + third) < function(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    (function(low), low)
}

/// The value of a locus where `side` changes its sign between two points of it, by bisection.
fn crossing(of: &Loop, ends: [(f64, Complex64); 2], side: impl Fn(Complex64) -> f64) -> Option<Complex64> {
    let [(mut low, mut at_low), (mut high, mut at_high)] = ends;
    if side(at_low) * side(at_high) >= 0.0 {
        return None;
    }
    for _ in 0..40 {
        let middle = f64::midpoint(low, high);
        let guess = (at_low + at_high) / 2.0;
        let [a, b] = of.loci(middle);
        let at_middle = if (a - guess).norm() <= (b - guess).norm() { a } else { b };
        if side(at_middle) * side(at_low) > 0.0 {
            (low, at_low) = (middle, at_middle);
        } else {
            (high, at_high) = (middle, at_middle);
        }
    }
    Some((at_low + at_high) / 2.0)
}

/// Counts of loops in which distance, gain margin, lower gain margin and phase margin differ by more than 0.1 %.
fn deviations(seed: u64, loops: u32) -> ([u32; 4], Vec<String>) {
    let mut random = Random(seed);
    let (mut counts, mut told) = ([0; 4], Vec::new());
    for number in 0..loops {
        let of = Loop::random(&mut random);
        let Some(found) = of.margins() else {
            told.push(format!("{number}: beyond the bound on work, {of:?}"));
            continue;
        };
        let exact = by_brute_force(&of);
        let pairs = [
            (Some(found.distance), Some(exact.distance)),
            (found.gain_up, exact.gain_up),
            (found.gain_down, exact.gain_down),
            (found.phase, exact.phase),
        ];
        for (count, (found, exact)) in counts.iter_mut().zip(pairs) {
            let agrees = match (found, exact) {
                (Some(found), Some(exact)) => (found - exact).abs() <= 1e-3 * exact.abs(),
                // Factors that no grid reaches.
                (Some(found), None) => !(1e-3..=1e3).contains(&found),
                (None, exact) => exact.is_none(),
            };
            *count += u32::from(!agrees);
        }
        if counts.iter().sum::<u32>() as usize > told.len() {
            told.push(format!("{number}: {found:?} is not {exact:?} of {of:?}"));
        }
    }
    (counts, told)
}

#[test]
fn margins_of_200_random_loops_are_those_of_a_brute_force_search() {
    let (counts, told) = deviations(1, 200);
    assert!(told.is_empty(), "{counts:?} {}", told.join("\n"));
}

/// `make bench` runs it.
#[test]
#[ignore = "takes minutes"]
fn margins_of_1000_random_loops_are_those_of_a_brute_force_search() {
    let (counts, told) = deviations(2, 1000);
    assert!(told.is_empty(), "{counts:?} {}", told.join("\n"));
}

/// The controllers of a session that is placed at a target.
fn placed(plant: &TransferMatrix, period: f64, target: Complex64) -> [PidMatrix; 2] {
    let frequency = TAU / period;
    let g = response_at(plant, frequency);
    let roots = propose(&plant.dc_gain(), &g, frequency, PlacementMethod::BothLoci, Action::Pi, target).unwrap();
    roots.map(|root| PidMatrix::decentralised(root.controllers))
}

#[test]
fn a_dip_between_grid_points_is_found() {
    // Root 2: recomputed by an independent program on a grid of 1e-5 rad, from these controllers. Found from outside, on a
    // coarser grid: distance 0.02684 at ω = 21.836, gain margin 1.0273.
    let text = include_str!("../data/margins-between-grid-points.json");
    let Document::Tuning(scenario) = document_from_json(text).unwrap() else { panic!("a session of tuning") };
    let study = PlantStudy::of(&scenario.tuning.plant).unwrap();
    let design = study.design(&scenario.tuning).unwrap().unwrap();
    let root = &design.roots[1];
    assert_eq!(root.stability, LoopStability::Stable);
    let found = study.margins(root).unwrap().unwrap();
    assert!((found.distance - 0.026_568_42).abs() <= 0.5e-8, "{found:?}");
    assert!((found.distance_frequency - 21.835_19).abs() <= 0.5e-5, "{found:?}");
    assert!((found.gain_up.unwrap() - 1.0273).abs() <= 0.5e-4, "{found:?}");
}

#[test]
fn loops_of_far_targets_are_not_computed() {
    // Gains a million times the critical ones: the dead times turn the loci millions of times before the loop becomes small.
    let plant = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
    for target in [Complex64::new(999_999.999_999_999_9, 0.01), Complex64::new(-458_281.0, 0.0)] {
        for controllers in placed(&plant, 11.57, target) {
            let design = Design::new(&plant, controllers).unwrap();
            assert!(matches!(design.stability(), LoopStability::NotComputed { .. }), "{:?}", design.stability());
            assert_eq!(design.margins(), None);
        }
    }
}
