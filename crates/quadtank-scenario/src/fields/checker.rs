use super::visitor::{Path, Step, Visitor};
use crate::ScenarioError;
use crate::limits::Limits;

/// Holds every number against its limits, which also means that it is a finite number.
pub struct Checker;

impl Visitor for Checker {
    fn checks(&self) -> bool {
        true
    }

    fn enter(&mut self, _: &Path, step: Step) -> Result<bool, ScenarioError> {
        Ok(!matches!(step, Step::Choice(_, false)))
    }

    fn leave(&mut self, _: &Path) -> Result<(), ScenarioError> {
        Ok(())
    }

    fn number(&mut self, at: &Path, &mut value: &mut f64, limits: Limits) -> Result<(), ScenarioError> {
        if limits.contains(value) { Ok(()) } else { Err(out_of_range(at.to(""), value, limits)) }
    }

    fn whole(&mut self, at: &Path, value: &mut u32, limits: Limits) -> Result<(), ScenarioError> {
        self.number(at, &mut f64::from(*value), limits)
    }

    fn flag(&mut self, _: &Path, _: &mut bool) -> Result<(), ScenarioError> {
        Ok(())
    }

    fn length(&mut self, at: &Path, count: usize, _: usize, max: usize) -> Result<usize, ScenarioError> {
        if count <= max { Ok(count) } else { Err(ScenarioError::TooMany { field: at.to(""), count, max }) }
    }

    fn option(&mut self, _: &Path, is_some: bool) -> Result<bool, ScenarioError> {
        Ok(is_some)
    }
}

pub fn out_of_range(field: String, value: f64, limits: Limits) -> ScenarioError {
    ScenarioError::OutOfRange { field, value, min: limits.min, max: limits.max }
}
