use serde::Serialize;

/// When a response stays within its band.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Settling {
    /// It settled this long after the step (s).
    After {
        /// Seconds after the step.
        time_s: f64,
    },
    /// It is still outside the band at the end of the run.
    Never,
}

/// How one loop answered its (first) set-point step; sums over the whole run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LoopMetrics {
    /// Time of the step that the response figures refer to (s); `None` when this reference never moves.
    pub step_time_s: Option<f64>,
    /// From 10 % to 90 % of the step (s); `None` when it is never reached.
    pub rise_time_s: Option<f64>,
    /// Into the 2 % band of the step.
    pub settling_2_percent: Option<Settling>,
    /// Into the 5 % band of the step.
    pub settling_5_percent: Option<Settling>,
    /// Furthest beyond the new reference, as a fraction of the step; 0 for none.
    pub overshoot: Option<f64>,
    /// Furthest in the wrong direction, as a fraction of the step; 0 for none.
    pub undershoot: Option<f64>,
    /// Σ |r − h| Ts (m s).
    pub iae: f64,
    /// Σ (r − h)² Ts (m² s).
    pub ise: f64,
    /// Σ (t − t_step) |r − h| Ts from the step on (m s²).
    pub itae: f64,
    /// Furthest that the *other* level moves from its own reference because of this step (m).
    pub other_peak: f64,
    /// Σ |Δu| of the controller output of this loop (V).
    pub total_variation: f64,
    /// How long the output of this loop was at a limit (s).
    pub saturated_s: f64,
}
