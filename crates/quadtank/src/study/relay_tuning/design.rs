use std::borrow::Cow;
use std::f64::consts::TAU;

use nalgebra::Matrix2;

use crate::control::{IsaPid, Pairing, ParallelPid, PidMatrix, SeriesPid};
use crate::linear::{Complex, Loci, LociClosure, LoopStability, TransferMatrix};
use crate::tuning::{
    Design, GainLimit, PlacementWarning, TuningError, dynamic_relative_gain, importance_direction, propose,
    response_at, warnings_of_gains,
};

use super::{Comparison, CriticalSpec, DesignSpec, GivenPid, PlantStudy, StepResponse, Tested, TuningSetup};

/// The controllers of a session, both roots of a placement or given ones, with what they do.
#[derive(Clone, Debug, PartialEq)]
pub struct Designed {
    /// The critical point of the session. `None` is possible with given controllers only: the critical curve has no point of the
    /// importance r2 that the session names.
    pub critical: Option<CriticalResponse>,
    /// Root 1, with the larger controller in loop 1, and root 2; given controllers alone.
    pub roots: Vec<DesignRoot>,
    /// Index of the root at work.
    pub chosen: usize,
    /// Characteristic loci at the critical gains, and with the chosen root, around the critical frequency. Without a critical point
    /// the first are empty, and the others are over all frequencies of the plant.
    pub loci: [Loci; 2],
    /// The response with the chosen root.
    pub response: StepResponse,
    /// The response with what it is compared with.
    pub comparison: Option<Comparison>,
}

/// A critical point, and the plant at its frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalResponse {
    /// Gains of the critical point.
    pub gains: [f64; 2],
    /// Critical frequency (rad per unit of time of the plant).
    pub frequency: f64,
    /// G(jω) there.
    pub g: Matrix2<Complex>,
    /// Relative gain λ11(jω) there.
    pub dynamic_relative_gain_11: Complex,
}

/// One root with what it does to the loop, without a decoupler.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignRoot {
    /// The controllers.
    pub controllers: [ParallelPid; 2],
    /// Which input of the plant each of them drives; diagonal for those of a placement.
    pub pairing: Pairing,
    /// The same in other forms.
    pub forms: [ControllerForms; 2],
    /// What to beware of.
    pub warnings: Vec<PlacementWarning>,
    /// Whether the loop is stable.
    pub stability: LoopStability,
    /// How its loci close.
    pub closure: LociClosure,
}

/// A controller in the forms of other textbooks (Campestrini 2006, eqs. 9 to 11).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerForms {
    /// ISA; `None` where the proportional gain is 0.
    pub isa: Option<IsaPid>,
    /// Series; `None` where its zeros are complex.
    pub series: Option<SeriesPid>,
}

impl From<ParallelPid> for ControllerForms {
    fn from(pid: ParallelPid) -> Self {
        let isa = IsaPid::from_parallel(pid);
        Self { isa, series: isa.and_then(SeriesPid::from_isa) }
    }
}

/// Frequencies that a picture of the loci shows, as multiples of the critical one: far beyond it a dead time winds them round
/// the origin.
const SHOWN: (f64, f64) = (0.02, 6.0);

impl CriticalResponse {
    /// Critical period.
    pub fn period(&self) -> f64 {
        TAU / self.frequency
    }
}

impl Designed {
    /// The root that was chosen.
    pub fn chosen_root(&self) -> &DesignRoot {
        &self.roots[self.chosen]
    }
}

impl PlantStudy {
    /// The controllers of a session; `None` where the curve has no ultimate point in the direction that a placement asks for.
    ///
    /// # Errors
    /// [`TuningError::OutOfRange`] for a root that is neither 1 nor 2 or a target of 0, or what is wrong with the plant.
    pub fn design(&self, setup: &TuningSetup) -> Result<Option<Designed>, TuningError> {
        let spec = &setup.design;
        let critical = self.critical(spec.critical);
        let (roots, chosen) = match (spec.controllers, &critical) {
            (Some(controllers), _) => (vec![self.given(controllers, spec.pairing)?], 0),
            (None, Some(critical)) => (self.placed(spec, critical)?, spec.root - 1),
            (None, None) => return Ok(None),
        };
        let root = &roots[chosen];
        let loci = self.loci(critical.as_ref(), root)?;
        let response = self.response_of(root, setup)?;
        let comparison = self.comparison(setup, critical.as_ref(), root)?;
        Ok(Some(Designed { critical, roots, chosen, loci, response, comparison }))
    }

    /// The critical point of a session; `None` where the curve has no ultimate point in its direction.
    fn critical(&self, spec: CriticalSpec) -> Option<CriticalResponse> {
        let (gains, frequency) = match spec {
            CriticalSpec::Point { gains, period } => (gains, TAU / period),
            CriticalSpec::Importance(r) => match self.search.limit(importance_direction(&self.rest_gain, r)) {
                GainLimit::Oscillation(point) => (point.gains, point.frequency),
                GainLimit::RealPole { .. } | GainLimit::AlgebraicLoop { .. } | GainLimit::None => return None,
            },
        };
        let g = response_at(&self.plant, frequency);
        Some(CriticalResponse { gains, frequency, g, dynamic_relative_gain_11: dynamic_relative_gain(&g) })
    }

    /// Both roots of a placement.
    fn placed(&self, spec: &DesignSpec, critical: &CriticalResponse) -> Result<Vec<DesignRoot>, TuningError> {
        if !(1..=2).contains(&spec.root) {
            return Err(TuningError::OutOfRange { field: "design.root", value: spec.root as f64 });
        }
        let &CriticalResponse { frequency, g, .. } = critical;
        let target = Complex::new(spec.target[0], spec.target[1]);
        let proposals = propose(&self.rest_gain, &g, frequency, spec.method, spec.action, target)?;
        proposals.into_iter().map(|root| self.root(root.controllers, Pairing::Diagonal, root.warnings)).collect()
    }

    /// Given controllers.
    fn given(&self, controllers: [GivenPid; 2], pairing: Pairing) -> Result<DesignRoot, TuningError> {
        let controllers = controllers.map(ParallelPid::from);
        let warnings = warnings_of_gains(&self.wired(pairing).rest_gain(), controllers);
        self.root(controllers, pairing, warnings)
    }

    /// The loop with the settings of both loops that a test ends in; `None` for a test that does not, see [`Tested::settings`].
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`].
    pub fn pair_of_test(&self, test: &Tested) -> Result<Option<DesignRoot>, TuningError> {
        test.settings().map(|settings| self.given(settings.map(GivenPid::from), Pairing::Diagonal)).transpose()
    }

    fn root(
        &self,
        controllers: [ParallelPid; 2],
        pairing: Pairing,
        warnings: Vec<PlacementWarning>,
    ) -> Result<DesignRoot, TuningError> {
        let plant = self.wired(pairing);
        let design = Design::new(&plant, PidMatrix::decentralised(controllers))?;
        let (stability, closure) = (design.stability(), design.closure());
        let forms = controllers.map(ControllerForms::from);
        Ok(DesignRoot { controllers, pairing, forms, warnings, stability, closure })
    }

    /// The plant with its inputs in the order of the loops that drive them.
    pub(super) fn wired(&self, pairing: Pairing) -> Cow<'_, TransferMatrix> {
        match pairing {
            Pairing::Diagonal => Cow::Borrowed(&self.plant),
            Pairing::Swapped => Cow::Owned(self.plant.swapped()),
        }
    }

    fn loci(&self, critical: Option<&CriticalResponse>, root: &DesignRoot) -> Result<[Loci; 2], TuningError> {
        let plant = self.wired(root.pairing);
        let after = Design::new(&plant, PidMatrix::decentralised(root.controllers))?;
        let Some(&CriticalResponse { gains, frequency, .. }) = critical else {
            let none = Loci { frequency: Vec::new(), branches: [Vec::new(), Vec::new()] };
            return Ok([none, after.loci()?]);
        };
        let proportional = gains.map(|proportional| ParallelPid { proportional, ..ParallelPid::default() });
        let before = Design::new(&self.plant, PidMatrix::decentralised(proportional))?;
        Ok([before, after].map(|design| design.loci_between(SHOWN.0 * frequency, SHOWN.1 * frequency)))
    }
}
