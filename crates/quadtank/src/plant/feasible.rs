use super::QuadrupleTank;

impl QuadrupleTank {
    /// The outline of what the pumps can hold: levels 1 and 2 (m) at rest along the edges of the square of pump voltages, each
    /// edge in `steps` steps, from both pumps at their lowest voltage around by pump 1. Every pair of levels inside is held by
    /// some pair of voltages, and none outside; where γ1 + γ2 = 1 the outline collapses to a curve, on which two inputs hold one
    /// ratio of flows. Walls are ignored, those of the upper tanks too.
    ///
    /// The map from voltages to flows is linear, and flows rise with levels, so edges bound what corners span. Where fractions depend
    /// on the flow this holds as long as γ̃1 + γ̃2 stays on one side of 1.
    pub fn feasible_outline(&self, steps: u32) -> Vec<[f64; 2]> {
        let [(low_1, high_1), (low_2, high_2)] = self.pumps.map(|pump| pump.acting_range());
        let corners = [[low_1, low_2], [high_1, low_2], [high_1, high_2], [low_1, high_2]];
        let edges = (0..4).map(|k| (corners[k], corners[(k + 1) % 4]));
        let along = |(from, to): ([f64; 2], [f64; 2])| {
            (0..steps).map(move |step| {
                let share = f64::from(step) / f64::from(steps.max(1));
                let voltage = [0, 1].map(|pump: usize| from[pump] + share * (to[pump] - from[pump]));
                let levels = self.free_equilibrium(voltage).levels;
                [levels[0], levels[1]]
            })
        };
        edges.flat_map(along).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::literature::PresetId;

    /// Twice the area inside, in terms of flows: levels as √h.
    fn area(outline: &[[f64; 2]]) -> f64 {
        let roots: Vec<[f64; 2]> = outline.iter().map(|levels| levels.map(f64::sqrt)).collect();
        let next = roots.iter().cycle().skip(1);
        roots.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
    }

    #[test]
    fn what_is_inside_can_be_held_and_what_is_outside_cannot() {
        let mut plant = PresetId::JunqueiraA.preset().plant;
        plant.tanks = plant.tanks.map(|tank| crate::plant::Tank { height: 10.0, ..tank });
        for gamma in [0.6, 0.4] {
            let plant = plant.with_valves([gamma, gamma]);
            let outline = plant.feasible_outline(16);
            let centre = plant.free_equilibrium([6.0, 6.0]).levels;
            // Beyond empty tanks there is nothing.
            for levels in outline.iter().filter(|levels| levels[0] > 0.0) {
                let at = |share: f64| {
                    [0, 1].map(|i: usize| {
                        let root = centre[i].sqrt() + share * (levels[i].sqrt() - centre[i].sqrt());
                        root * root
                    })
                };
                assert!(plant.inputs_for_levels(at(0.999)).is_ok(), "{levels:?}");
                assert!(plant.inputs_for_levels(at(1.001)).is_err(), "{levels:?}");
            }
        }
    }

    #[test]
    fn as_the_valves_pass_the_line_it_turns_over() {
        let plant = PresetId::JunqueiraA.preset().plant;
        let turned = |gamma| area(&plant.with_valves([gamma, gamma]).feasible_outline(16));
        assert!(turned(0.6) > 0.01 && turned(0.4) < -0.01);
        assert!(turned(0.5).abs() < 1e-12);
    }
}
