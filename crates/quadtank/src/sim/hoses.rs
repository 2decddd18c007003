//! The hoses between the pumps and the tanks: what the voltage of a pump does arrives a transport delay later.

use std::collections::VecDeque;

use crate::plant::{OperatingPoint, QuadrupleTank};

use super::experiment::{Experiment, PumpVoltageStep};

/// The voltages (V) whose flows are in the hoses.
pub(super) struct Hoses {
    delay_s: [f64; 2],
    /// Voltages whose flows reach the tanks now.
    acting: [f64; 2],
    /// The last voltages of the pumps.
    sent: [f64; 2],
    /// When which voltage begins to act, by pump.
    under_way: [VecDeque<(f64, f64)>; 2],
}

impl Hoses {
    /// The hoses at the start of an experiment, full of what the pumps did before it: what they do at the operating point, or what a
    /// sequence says that begins with the experiment.
    pub(super) fn new(plant: &QuadrupleTank, op: &OperatingPoint, experiment: &Experiment) -> Self {
        let before = [0, 1].map(|i| {
            let pump = &plant.pumps[i];
            // The operating point counts as it is, within the limits of the pump or not.
            first_voltage(&experiment.pump_voltage_steps, i)
                .map_or(op.pump_voltage[i], |voltage| voltage.max(pump.voltage_min).min(pump.voltage_max))
        });
        let delay_s = plant.pumps.map(|pump| pump.delay_s);
        Self { delay_s, acting: before, sent: before, under_way: Default::default() }
    }

    /// The pumps have these voltages (V) from `time` (s) on.
    pub(super) fn send(&mut self, time: f64, voltage: [f64; 2]) {
        for (pump, voltage) in voltage.into_iter().enumerate() {
            if self.delay_s[pump] == 0.0 {
                self.acting[pump] = voltage;
            } else if voltage != self.sent[pump] {
                self.under_way[pump].push_back((time + self.delay_s[pump], voltage));
            }
            self.sent[pump] = voltage;
        }
    }

    /// When the next arrival is (s), where that is before `time`.
    pub(super) fn next_before(&self, time: f64) -> Option<f64> {
        // Most rigs have no delay, and every row asks.
        if self.delay_s == [0.0; 2] {
            return None;
        }
        let arrivals = self.under_way.iter().filter_map(VecDeque::front).map(|&(arrival, _)| arrival);
        arrivals.filter(|&arrival| arrival < time).min_by(f64::total_cmp)
    }

    /// The voltages that act at `time` (V).
    pub(super) fn at(&mut self, time: f64) -> [f64; 2] {
        for (acting, under_way) in self.acting.iter_mut().zip(&mut self.under_way) {
            while let Some((_, voltage)) = under_way.pop_front_if(|(arrival, _)| *arrival <= time) {
                *acting = voltage;
            }
        }
        self.acting
    }
}

/// The voltage (V) that a sequence gives a pump at the very beginning.
fn first_voltage(steps: &[PumpVoltageStep], pump: usize) -> Option<f64> {
    let first = steps.iter().filter(|step| step.pump == pump && step.time_s <= 0.0);
    first.max_by(|one, other| one.time_s.total_cmp(&other.time_s)).map(|step| step.voltage)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::plant::Disturbance;
    use crate::sim::Trajectory;
    use crate::study::quadruple_tank::{PlantSpec, Prepared, Run, setup_of};

    #[test]
    fn each_hose_has_its_own_delay() {
        let mut rig = PresetId::JohanssonMinimumPhase.preset();
        rig.plant.pumps[1].delay_s = 2.5;
        let rest = rig.plant.free_equilibrium([3.0, 3.0]);
        let mut hoses = Hoses::new(&rig.plant, &rest, &Experiment::at_rest(10.0));
        hoses.send(1.0, [4.0, 4.0]);
        hoses.send(2.0, [5.0, 5.0]);
        assert_eq!((hoses.at(2.0), hoses.next_before(3.5)), ([5.0, 3.0], None));
        assert_eq!((hoses.next_before(3.6), hoses.at(3.5)), (Some(3.5), [5.0, 4.0]));
        assert_eq!((hoses.at(4.5), hoses.next_before(f64::INFINITY)), ([5.0, 5.0], None));
    }

    #[test]
    fn a_sequence_that_begins_with_the_experiment_has_filled_the_hose() {
        let mut rig = PresetId::JohanssonMinimumPhase.preset();
        rig.plant.pumps.iter_mut().for_each(|pump| pump.delay_s = 7.0);
        let rest = rig.plant.free_equilibrium([3.0, 3.0]);
        let step = |time_s: f64| PumpVoltageStep { pump: 0, time_s, voltage: 12.0 };
        let mut experiment = Experiment::at_rest(100.0);
        experiment.pump_voltage_steps = vec![step(0.0)];
        // Within the limits of the pump, which are 0 to 10 V.
        assert_eq!(Hoses::new(&rig.plant, &rest, &experiment).at(0.0), [10.0, 3.0]);
        experiment.pump_voltage_steps = vec![step(5.0)];
        assert_eq!(Hoses::new(&rig.plant, &rest, &experiment).at(0.0), [3.0, 3.0]);
    }

    /// Slopes of a model at given levels and flowing voltages.
    type Slopes<'a> = dyn Fn(&[f64; 4], &[f64; 2]) -> [f64; 4] + 'a;

    /// Levels at the rows of a run by short steps of Runge and Kutta, from nothing but the voltages that the pumps had: whatever they
    /// did acts a delay later.
    fn by_brute_force(run: &Trajectory, delays: [f64; 2], before: [f64; 2], slopes: &Slopes) -> Vec<[f64; 4]> {
        let sent = |pump: usize, time: f64| {
            let row = run.time_s.partition_point(|&row| row <= time + 1e-9);
            row.checked_sub(1).map_or(before[pump], |row| run.pump_voltage[pump][row])
        };
        let mut levels: [f64; 4] = std::array::from_fn(|tank| run.levels[tank][0]);
        let mut found = vec![levels];
        for pair in run.time_s.windows(2) {
            // A voltage arrives within a row where the delay is no whole number of rows.
            let arrivals = run.time_s.iter().flat_map(|&row| delays.map(|delay| row + delay));
            let mut breaks: Vec<f64> = arrivals.filter(|&at| pair[0] + 1e-9 < at && at < pair[1] - 1e-9).collect();
            breaks.push(pair[1]);
            breaks.sort_by(f64::total_cmp);
            let mut now = pair[0];
            for end in breaks {
                let middle = f64::midpoint(now, end);
                let voltage = [0, 1].map(|pump| sent(pump, middle - delays[pump]));
                let step = (end - now) / 4.0;
                for _ in 0..4 {
                    let aside =
                        |slope: [f64; 4], h: f64| -> [f64; 4] { std::array::from_fn(|i| levels[i] + h * slope[i]) };
                    let k1 = slopes(&levels, &voltage);
                    let k2 = slopes(&aside(k1, step / 2.0), &voltage);
                    let k3 = slopes(&aside(k2, step / 2.0), &voltage);
                    let k4 = slopes(&aside(k3, step), &voltage);
                    levels =
                        std::array::from_fn(|i| levels[i] + step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
                }
                now = end;
            }
            found.push(levels);
        }
        found
    }

    #[test]
    fn both_runs_are_those_of_an_independent_integration() {
        for delays in [[3.4, 0.0], [12.0, 7.75], [0.3, 250.5]] {
            let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
            let mut rig = setup.plant.rig();
            for (pump, delay) in rig.pumps.iter_mut().zip(delays) {
                pump.delay_s = delay;
            }
            setup.plant = PlantSpec::Parameters { rig, display_unit: setup.plant.display_unit() };
            setup.controller.loops.iter_mut().for_each(|settings| settings.gain *= 0.2);
            setup.experiment.duration_s = 600.0;
            let prepared = Prepared::of(&setup).unwrap();
            let (plant, rest) = (prepared.plant, prepared.operating_point);
            let run = Run::of(&prepared, &setup, None).unwrap();
            let still = Disturbance::default();
            let nonlinear = |levels: &[f64; 4], voltage: &[f64; 2]| plant.derivative(levels, voltage, &still);
            let jacobian = prepared.jacobian;
            let linear = |levels: &[f64; 4], voltage: &[f64; 2]| -> [f64; 4] {
                let x = nalgebra::Vector4::from_fn(|i, _| levels[i] - rest.levels[i]);
                let u = nalgebra::Vector2::from_fn(|i, _| voltage[i] - rest.pump_voltage[i]);
                (jacobian.a * x + jacobian.b * u).into()
            };
            for (run, slopes) in [(&run.nonlinear, &nonlinear as &Slopes), (&run.linear, &linear)] {
                let expected = by_brute_force(run, delays, rest.pump_voltage, slopes);
                let largest_move = run.levels[0].iter().map(|level| (level - rest.levels[0]).abs()).fold(0.0, f64::max);
                assert!(largest_move > 5e-3);
                for (row, expected) in expected.iter().enumerate() {
                    for (tank, expected) in expected.iter().enumerate() {
                        // The bar of trajectories, 10⁻⁶ of the step, which is 10 mm here.
                        let off = (run.levels[tank][row] - expected).abs();
                        assert!(off < 1e-8, "{delays:?} row {row} tank {tank}: {off}");
                    }
                }
            }
        }
    }
}
