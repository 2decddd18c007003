//! The published tables that sum up others: ranks, hundredths, the mean effect of the model error, and verdicts.

use crate::assess::{IndexVerdict, VarianceIndex};
use crate::literature::andreis::{
    AndreisRemark, CHANGES, CURRENT_TUNING, HUNDREDTHS, INDICES, PublishedChange, PublishedDisturbance,
    PublishedMethod, PublishedModel, PublishedObjective, PublishedRanks, PublishedVariance, PublishedVerdict, RANKS,
    VERDICTS, remarks_on_table,
};
use crate::sim::level::LevelRunError;

use super::PiTuning;
use super::published::{Compared, compare_index, plant_of, variances};

/// The tables that [`compare_summary`] computes, 15 for 5.15.
pub const SUMMARY_TABLES: [u32; 2] = [15, 16];

/// An entry of a table that sums up others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SummaryEntry {
    /// Mean change of the variances by the model error (%).
    Change(f64),
    /// Whether the current controller needs another tuning.
    Verdict(IndexVerdict),
}

/// A printed entry beside the computed one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SummaryRow {
    /// Disturbance of the row.
    pub disturbance: PublishedDisturbance,
    /// Objective of the row.
    pub objective: PublishedObjective,
    /// Model of the row; `None` for a comparison of both.
    pub model: Option<PublishedModel>,
    /// As printed.
    pub printed: SummaryEntry,
    /// As computed.
    pub computed: SummaryEntry,
}

/// A published table that sums up others, every entry beside the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedSummary {
    /// Its number, 15 for 5.15.
    pub table: u32,
    /// Its entries, by rows.
    pub rows: Vec<SummaryRow>,
    /// What is to be known about the print.
    pub remarks: &'static [AndreisRemark],
}

/// Computes Table 5.15 or 5.16 of Andreis (2017) anew. Others are empty.
///
/// # Errors
/// [`LevelRunError`], which no published case has.
pub fn compare_summary(table: u32) -> Result<ComparedSummary, LevelRunError> {
    let rows = match table {
        15 => CHANGES.iter().map(compare_change).collect::<Result<_, _>>()?,
        16 => VERDICTS.into_iter().map(compare_verdict).collect::<Result<_, _>>()?,
        _ => Vec::new(),
    };
    Ok(ComparedSummary { table, rows, remarks: remarks_on_table(table) })
}

/// The variance that an objective makes small.
fn variance(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    model: PublishedModel,
    tuning: PiTuning,
) -> Result<f64, LevelRunError> {
    let [level, outflow] = variances(&plant_of(model), disturbance, tuning)?;
    Ok(if objective == PublishedObjective::Tight { level } else { outflow })
}

/// The tuning of a method. SIMC and Lambda tuning share a row in averaging control.
fn tuning_of(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    method: PublishedMethod,
    model: PublishedModel,
) -> PiTuning {
    PublishedVariance::find(disturbance, objective, method, model)
        .or_else(|| PublishedVariance::find(disturbance, objective, PublishedMethod::Skogestad, model))
        .map_or(CURRENT_TUNING, |row| row.tuning)
}

/// Tables 5.7 and 5.8.
pub(super) fn compare_ticks(table: u32) -> Result<Vec<Compared>, LevelRunError> {
    let objective = match table {
        7 => PublishedObjective::Tight,
        8 => PublishedObjective::Averaging,
        _ => return Ok(Vec::new()),
    };
    let mut numbers = Vec::new();
    for &PublishedRanks { disturbance, model, ticks, .. } in RANKS.iter().filter(|row| row.objective == objective) {
        let current = variance(disturbance, objective, PublishedModel::Nominal, CURRENT_TUNING)?;
        let tunings = PublishedRanks::METHODS.map(|method| tuning_of(disturbance, objective, method, model));
        let mut found = Vec::new();
        for tuning in tunings {
            found.push(variance(disturbance, objective, model, tuning)?);
        }
        let mut order = found.clone();
        order.sort_by(f64::total_cmp);
        // Equal tunings share a rank.
        order.dedup();
        for (k, method) in PublishedRanks::METHODS.into_iter().enumerate() {
            let better = order.iter().filter(|&&other| other < found[k]).count();
            let computed = if found[k] < current { 4.0 - better as f64 } else { 0.0 };
            let printed = f64::from(ticks[k]);
            numbers.push(Compared { disturbance, method, model, tuning: tunings[k], printed, computed });
        }
    }
    Ok(numbers)
}

/// Tables 5.11 and 5.14.
pub(super) fn compare_hundredths(table: u32) -> Result<Vec<Compared>, LevelRunError> {
    let mut numbers = Vec::new();
    for (_, objective, hundredths) in HUNDREDTHS.iter().filter(|printed| printed.0 == table) {
        for (disturbance, &printed) in PublishedDisturbance::ALL.into_iter().zip(hundredths) {
            for row in INDICES.iter().filter(|row| (row.objective, row.disturbance) == (*objective, disturbance)) {
                let index = compare_index(row, 0)?;
                numbers.push(Compared { printed: f64::from(printed), computed: 100.0 * index.computed, ..index });
            }
        }
    }
    Ok(numbers)
}

/// In the mean of the four methods.
fn compare_change(printed: &PublishedChange) -> Result<SummaryRow, LevelRunError> {
    let PublishedChange { disturbance, objective, percent } = *printed;
    let mut sum = 0.0;
    for method in PublishedRanks::METHODS {
        let of = |model| variance(disturbance, objective, model, tuning_of(disturbance, objective, method, model));
        sum += of(PublishedModel::Uncertain)? / of(PublishedModel::Nominal)? - 1.0;
    }
    let computed = SummaryEntry::Change(100.0 * sum / PublishedRanks::METHODS.len() as f64);
    Ok(SummaryRow { disturbance, objective, model: None, printed: SummaryEntry::Change(percent), computed })
}

/// By the index of the gradient search, from which that of the genetic one hardly differs.
fn compare_verdict(printed: PublishedVerdict) -> Result<SummaryRow, LevelRunError> {
    let PublishedVerdict { disturbance, objective, model, verdict } = printed;
    let tuning = tuning_of(disturbance, objective, PublishedMethod::Gradient, model);
    let reference = variance(disturbance, objective, model, tuning)?;
    let actual = variance(disturbance, objective, PublishedModel::Nominal, CURRENT_TUNING)?;
    let computed = SummaryEntry::Verdict(VarianceIndex { reference, actual }.verdict());
    Ok(SummaryRow { disturbance, objective, model: Some(model), printed: SummaryEntry::Verdict(verdict), computed })
}
