use super::{LoopStability, Margins, ReturnRatio, TransferFunction, TransferMatrix};

/// A loop with one input and one output, as the first of two loops of which the second is empty, so that it has their margins.
#[derive(Clone, Debug)]
pub struct SingleLoop {
    plant: TransferMatrix,
    controller: TransferMatrix,
    integrators: u32,
}

impl SingleLoop {
    /// From a plant without poles in the right half-plane and a controller without dead time. `integrators` is the order of the
    /// pole of their product at the origin.
    ///
    /// ```
    /// use quadtank::linear::{SingleLoop, TransferFunction};
    ///
    /// let plant = TransferFunction::lags(2.0, &[1.0; 3], 0.0)?;
    /// let controller = TransferFunction::new(vec![1.0], vec![1.0], 0.0)?;
    /// let margins = SingleLoop::new(plant, controller, 0).margins().expect("it has margins");
    /// assert!((margins.gain_up.unwrap() - 4.0).abs() < 1e-9);
    /// # Ok::<(), quadtank::linear::LinearError>(())
    /// ```
    pub fn new(plant: TransferFunction, controller: TransferFunction, integrators: u32) -> Self {
        let none = plant.scaled(0.0);
        let nothing = controller.scaled(0.0);
        Self {
            plant: TransferMatrix([[plant, none.clone()], [none.clone(), none]]),
            controller: TransferMatrix([[controller, nothing.clone()], [nothing.clone(), nothing]]),
            integrators,
        }
    }

    fn ratio(&self) -> ReturnRatio<'_> {
        ReturnRatio::new(&self.plant, self.controller.clone(), self.integrators)
    }

    /// Whether the closed loop is stable.
    pub fn stability(&self) -> LoopStability {
        LoopStability::of(&self.ratio())
    }

    /// Margins over all frequencies; `None` where the search is beyond its bound on work. Meant for stable loops.
    pub fn margins(&self) -> Option<Margins> {
        Margins::of(&self.ratio())
    }

    /// Sensitivity peak Ms, the reciprocal of the shortest distance of L(jω) from −1; `None` for a loop that is not
    /// stable, and where the search is beyond its bound on work.
    pub fn sensitivity_peak(&self) -> Option<f64> {
        let margins = if self.stability() == LoopStability::Stable { self.margins() } else { None };
        margins.map(|margins| margins.distance.recip())
    }
}
