use serde::Serialize;

/// A three-way valve that sends a fraction γ of the flow of its pump to a lower tank and the rest to an upper one. The fraction may
/// depend on the flow `q`, because the two branches do not lose their pressure alike: `γ(q) = γ + s q`, within [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Valve {
    /// Fraction γ to which that of the flow tends as the flow goes to 0, in [0, 1].
    pub fraction: f64,
    /// Growth `s` of the fraction with the flow (s/m³); 0 for a valve that divides any flow alike.
    pub slope: f64,
}

impl Valve {
    /// Fraction γ(q) of a flow (m³/s) that goes to the lower tank.
    #[inline]
    pub fn fraction_at(&self, flow: f64) -> f64 {
        if self.slope == 0.0 { self.fraction } else { (self.fraction + self.slope * flow).clamp(0.0, 1.0) }
    }

    /// Fraction of a small change of the flow (m³/s) that goes to the lower tank, `γ̃ = d(γ q)/dq`: `γ + 2 s q` where γ(q) is between
    /// its ends, so that it can be outside [0, 1]. In a linear model it takes the place of γ.
    pub fn incremental_fraction(&self, flow: f64) -> f64 {
        let fraction = self.fraction_at(flow);
        if 0.0 < fraction && fraction < 1.0 { fraction + self.slope * flow } else { fraction }
    }

    /// Least flow of the pump (m³/s) of which the lower tank gets `lower` (m³/s): the smaller root of `γ q + s q² = lower`. Not a
    /// number where the lower tank gets less of any flow.
    pub fn flow_for(&self, lower: f64) -> f64 {
        if self.slope == 0.0 || lower <= 0.0 {
            return lower / self.fraction;
        }
        let root = (self.fraction * self.fraction + 4.0 * self.slope * lower).sqrt();
        let flow = 2.0 * lower / (self.fraction + root);
        // From where the fraction would pass 1 all of the flow goes to the lower tank.
        if flow < lower { lower } else { flow }
    }
}

/// How valves divide flows where that depends on the flow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlowFractions {
    /// γ1(q1), γ2(q2): share of the flow that goes to the lower tank.
    pub of_flow: [f64; 2],
    /// γ̃1, γ̃2: share of a small change of the flow that goes there. In the linear model they take the place of γ1 and γ2.
    pub incremental: [f64; 2],
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Flow (m³/s) about which the valves of these tests are looked at.
    const FLOW: f64 = 1e-5;
    const VALVES: [Valve; 4] = [
        Valve { fraction: 0.6, slope: 0.0 },
        Valve { fraction: 0.6, slope: 1e4 },
        Valve { fraction: 0.6, slope: -1e4 },
        Valve { fraction: 0.0, slope: 2e4 },
    ];

    #[test]
    fn the_incremental_fraction_is_the_slope_of_the_lower_flow() {
        for valve in VALVES {
            let lower = |flow: f64| valve.fraction_at(flow) * flow;
            let step = 1e-4 * FLOW;
            let slope = (lower(FLOW + step) - lower(FLOW - step)) / (2.0 * step);
            assert_relative_eq!(valve.incremental_fraction(FLOW), slope, max_relative = 1e-9);
        }
        assert_relative_eq!(VALVES[1].incremental_fraction(FLOW), 0.8, max_relative = 1e-14);
    }

    #[test]
    fn a_fraction_stays_between_its_ends() {
        let [_, growing, falling, _] = VALVES;
        assert_eq!([growing.fraction_at(1e-4), falling.fraction_at(1e-4)], [1.0, 0.0]);
        assert_eq!([growing.incremental_fraction(1e-4), falling.incremental_fraction(1e-4)], [1.0, 0.0]);
        assert_eq!(growing.fraction_at(0.0), 0.6);
    }

    #[test]
    fn the_flow_for_a_lower_flow_brings_it() {
        for valve in VALVES {
            for flow in [1e-7, 1e-6, FLOW] {
                let lower = valve.fraction_at(flow) * flow;
                assert_relative_eq!(valve.flow_for(lower), flow, max_relative = 1e-12);
            }
        }
        // Beyond 1 all of it; and a falling fraction passes at most γ²/(4 |s|).
        assert_eq!(VALVES[1].flow_for(1e-4), 1e-4);
        assert!(VALVES[2].flow_for(1e-4).is_nan());
        assert_relative_eq!(VALVES[2].flow_for(0.999_999 * 0.09e-4), 3e-5, max_relative = 2e-3);
    }
}
