//! An integration of the quadruple tank for comparison only: classical Runge–Kutta steps far below every time constant, with
//! tanks at the wall as a mode of its own, whose beginning and end are found by bisection.

use std::array::from_fn;

use quadtank::plant::{Disturbance, QuadrupleTank};

/// Longest step (s), and the longest as a share of the smallest time constant, which leaves about 1e-11 of a transient.
const LONGEST_STEP: f64 = 0.05;
const SHARE: f64 = 5e-3;
/// Level at which a tank counts as empty (m).
const EMPTY: f64 = 1e-6;
/// Shortest step (s): what a tank holds at its last such step before it is empty is below 1e-12 m.
const SHORTEST_STEP: f64 = 1e-6;
/// Halvings of a step in which a tank meets its wall or leaves it.
const BISECTIONS: u32 = 40;

/// The water of a plant.
#[derive(Clone, Debug)]
pub struct Reference {
    plant: QuadrupleTank,
    /// Levels (m).
    pub levels: [f64; 4],
    is_full: [bool; 4],
    /// Time (s).
    pub time: f64,
    /// Water lost over the walls so far (m³).
    pub overflow: [f64; 4],
    /// When each tank first overflowed (s), and how fast its level then rose (m/s).
    pub first_overflow: [Option<(f64, f64)>; 4],
    /// When each tank first fell to 1 µm (s), and how fast (m/s).
    pub first_empty: [Option<(f64, f64)>; 4],
}

impl Reference {
    pub fn new(plant: &QuadrupleTank, levels: [f64; 4]) -> Self {
        Self {
            plant: *plant,
            levels: from_fn(|i| levels[i].min(plant.tanks[i].height)),
            is_full: [false; 4],
            time: 0.0,
            overflow: [0.0; 4],
            first_overflow: [None; 4],
            first_empty: [None; 4],
        }
    }

    /// Pumps, outlets and valves are those of another plant from now on.
    pub fn set_plant(&mut self, plant: &QuadrupleTank) {
        self.plant = *plant;
    }

    /// Lets time pass until `end` (s) with the flows from the pumps (m³/s) as a function of time, which must be smooth.
    pub fn run_until(&mut self, end: f64, pumped: impl Fn(f64) -> [f64; 4], leak_area: &[f64; 4]) {
        while self.time < end {
            let inflow = pumped(self.time);
            self.choose_modes(&inflow, leak_area);
            let step = self.step_size(&inflow, leak_area).min(end - self.time);
            let after = self.after(step, &pumped, leak_area);
            let step = if self.stays(&after, self.time + step, &pumped, leak_area) {
                step
            } else {
                let (mut low, mut high) = (0.0, step);
                for _ in 0..BISECTIONS {
                    let middle = f64::midpoint(low, high);
                    let after = self.after(middle, &pumped, leak_area);
                    if self.stays(&after, self.time + middle, &pumped, leak_area) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                high
            };
            self.take(step, &pumped, leak_area);
            if end - self.time < 1e-12 * end {
                self.time = end;
            }
        }
    }

    fn take(&mut self, step: f64, pumped: &impl Fn(f64) -> [f64; 4], leak_area: &[f64; 4]) {
        let after = self.after(step, pumped, leak_area);
        let middle = self.time + 0.5 * step;
        for i in (0..4).filter(|&i| self.is_full[i]) {
            self.overflow[i] +=
                step * self.net(i, &self.after(0.5 * step, pumped, leak_area), &pumped(middle), leak_area);
        }
        for i in 0..4 {
            if self.levels[i] > EMPTY && after[i] <= EMPTY {
                let slope = self.net(i, &after, &pumped(self.time + step), leak_area) / self.area(i);
                self.first_empty[i].get_or_insert((self.time + step, -slope));
            }
        }
        self.time += step;
        self.levels = from_fn(|i| after[i].clamp(0.0, self.plant.tanks[i].height));
    }

    fn choose_modes(&mut self, inflow: &[f64; 4], leak_area: &[f64; 4]) {
        for i in 0..4 {
            let at_wall = self.levels[i] >= self.plant.tanks[i].height;
            self.is_full[i] = at_wall && self.net(i, &self.levels, inflow, leak_area) > 0.0;
            if self.is_full[i] {
                let slope = self.net(i, &self.levels, inflow, leak_area) / self.area(i);
                self.first_overflow[i].get_or_insert((self.time, slope));
            }
        }
    }

    /// Whether the modes still hold at the end of a step, and no tank has fallen to [`EMPTY`].
    fn stays(&self, after: &[f64; 4], end: f64, pumped: &impl Fn(f64) -> [f64; 4], leak_area: &[f64; 4]) -> bool {
        (0..4).all(|i| {
            if self.is_full[i] {
                self.net(i, after, &pumped(end), leak_area) >= 0.0
            } else {
                after[i] <= self.plant.tanks[i].height && (after[i] > EMPTY || self.levels[i] <= EMPTY)
            }
        })
    }

    fn step_size(&self, inflow: &[f64; 4], leak_area: &[f64; 4]) -> f64 {
        let quickest = (0..4).filter(|&i| self.levels[i] > 0.0 || self.net(i, &self.levels, inflow, leak_area) > 0.0);
        let shortest = quickest.map(|i| {
            let tank = &self.plant.tanks[i];
            let drain = tank.outlet.effective_area() + leak_area[i];
            tank.section.area(self.levels[i]) / drain * (2.0 * self.levels[i] / self.plant.gravity).sqrt()
        });
        (SHARE * shortest.fold(f64::INFINITY, f64::min)).clamp(SHORTEST_STEP, LONGEST_STEP)
    }

    fn area(&self, i: usize) -> f64 {
        self.plant.tanks[i].section.area(self.levels[i])
    }

    /// Inflow less outflow (m³/s) of a tank, as if it had no wall.
    fn net(&self, i: usize, levels: &[f64; 4], pumped: &[f64; 4], leak_area: &[f64; 4]) -> f64 {
        let speed = |tank: usize| (2.0 * self.plant.gravity * levels[tank].max(0.0)).sqrt();
        let outlet = |tank: usize| self.plant.tanks[tank].outlet.effective_area();
        let above = if i < 2 { outlet(i + 2) * speed(i + 2) } else { 0.0 };
        pumped[i] + above - (outlet(i) + leak_area[i]) * speed(i)
    }

    fn after(&self, step: f64, pumped: &impl Fn(f64) -> [f64; 4], leak_area: &[f64; 4]) -> [f64; 4] {
        let slopes = |levels: &[f64; 4], inflow: &[f64; 4]| -> [f64; 4] {
            from_fn(|i| {
                if self.is_full[i] {
                    0.0
                } else {
                    self.net(i, levels, inflow, leak_area) / self.plant.tanks[i].section.area(levels[i])
                }
            })
        };
        let by = |k: &[f64; 4], share: f64| -> [f64; 4] { from_fn(|i| self.levels[i] + share * step * k[i]) };
        let [begin, middle, end] = [0.0, 0.5, 1.0].map(|share| pumped(self.time + share * step));
        let k1 = slopes(&self.levels, &begin);
        let k2 = slopes(&by(&k1, 0.5), &middle);
        let k3 = slopes(&by(&k2, 0.5), &middle);
        let k4 = slopes(&by(&k3, 1.0), &end);
        from_fn(|i| self.levels[i] + step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    }
}

/// Flows from the pumps at given voltages (m³/s). What rounding leaves of a flow that a load takes away counts as none.
pub fn pumped(plant: &QuadrupleTank, voltage: [f64; 2], pump_flow: [f64; 2]) -> [f64; 4] {
    let flows = plant.valve_flows(&voltage, &Disturbance { pump_flow, ..Disturbance::default() });
    flows.map(|flow| if flow < 1e-18 { 0.0 } else { flow })
}
