use crate::control::Pairing;
use crate::plant::{OperatingPoint, QuadrupleTank};
use crate::sim::HeldTank;

use super::TuningPlant;

/// The nonlinear rig that a session runs on, at rest.
pub(super) struct Rig {
    plant: QuadrupleTank,
    op: OperatingPoint,
    pairing: Pairing,
}

impl Rig {
    /// The rig with its pumps in the order of the loops that drive the inputs of the session.
    pub(super) fn paired(self, pairing: Pairing) -> Self {
        match pairing {
            Pairing::Diagonal => self,
            Pairing::Swapped => Self { pairing: self.pairing.other(), ..self },
        }
    }

    /// The rig between relays and controllers.
    pub(super) fn held(&self) -> HeldTank<'_> {
        HeldTank::new(&self.plant, &self.op, self.pairing)
    }
}

/// The rig of a session that runs on the nonlinear plant.
pub(super) fn nonlinear(plant: &TuningPlant) -> Option<Rig> {
    let tank = plant.tank().filter(|tank| tank.nonlinear)?;
    let op = tank.rig.free_equilibrium(tank.pump_voltage);
    Some(Rig { plant: tank.rig, op, pairing: tank.pairing })
}
