use serde::Serialize;

/// How a valve moves in a run, from row to row of its log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ValveTravel {
    /// Sum of all moves; 1 is once through its range.
    pub total: f64,
    /// How often it turns round.
    pub reversals: usize,
    /// Share of the rows at which it is fully open or fully closed.
    pub at_end: f64,
}

/// A move below this share of the range is rounding.
const ROUNDING: f64 = 1e-12;

impl ValveTravel {
    /// Of the travel X of each row, 0 to 1.
    pub fn of(travel: &[f64]) -> Self {
        let moves = || travel.windows(2).map(|pair| pair[1] - pair[0]).filter(|by| by.abs() > ROUNDING);
        let at_end = travel.iter().filter(|&&x| x <= 0.0 || x >= 1.0).count();
        Self {
            total: moves().map(f64::abs).sum(),
            reversals: moves().zip(moves().skip(1)).filter(|(a, b)| a.signum() != b.signum()).count(),
            at_end: at_end as f64 / travel.len().max(1) as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moves_reversals_and_ends() {
        let found = ValveTravel::of(&[0.5, 0.75, 0.75, 0.5, 0.5, 0.25, 1.0]);
        assert_eq!(found, ValveTravel { total: 1.5, reversals: 2, at_end: 1.0 / 7.0 });
        assert_eq!(ValveTravel::of(&[]), ValveTravel::default());
        // The last digit of a valve at rest is no reversal.
        let still = ValveTravel::of(&[0.3, 0.1 + 0.2, 0.3, 0.1 + 0.2]);
        assert_eq!((still.total, still.reversals), (0.0, 0));
    }
}
