//! The published tables that sum up others: an entry for each disturbance and objective, printed and computed.

use leptos::prelude::*;
use quadtank::assess::IndexVerdict;
use quadtank::literature::andreis::{PublishedModel, PublishedObjective};
use quadtank::study::level_loop::{ComparedSummary, SummaryEntry};

use super::published::{disturbance_name, table_name};
use crate::lab::Lab;
use crate::texts::tr;
use crate::widgets::{Row, TableContent};

/// The content of such a table.
pub fn summary_table(lab: Lab, found: &ComparedSummary) -> impl IntoView + use<> {
    let rows = found.rows.iter().map(|row| {
        let objective = match row.objective {
            PublishedObjective::Tight => tr!(lab, level.tight),
            PublishedObjective::Averaging => tr!(lab, level.averaging),
        };
        let model = match row.model {
            Some(PublishedModel::Nominal) => tr!(lab, level.nominal),
            Some(PublishedModel::Uncertain) => tr!(lab, level.uncertain),
            None => tr!(lab, level.both_models),
        };
        let figures = vec![objective, model, entry(lab, row.printed), entry(lab, row.computed)];
        view! { <Row name=disturbance_name(row.disturbance).to_owned() figures /> }.into_any()
    });
    let columns = vec![
        tr!(lab, level.column_disturbance),
        tr!(lab, level.column_objective),
        tr!(lab, level.column_model),
        tr!(lab, level.column_printed),
        tr!(lab, level.column_computed),
    ];
    view! { <TableContent caption=table_name(lab, found.table) columns rows=rows.collect() /> }
}

fn entry(lab: Lab, entry: SummaryEntry) -> String {
    match entry {
        SummaryEntry::Change(percent) => format!("{} %", lab.number_style().fixed(percent, 1)),
        SummaryEntry::Verdict(IndexVerdict::Keep) => tr!(lab, level.need_keep),
        SummaryEntry::Verdict(IndexVerdict::Fair) => tr!(lab, level.need_fair),
        SummaryEntry::Verdict(IndexVerdict::Retune) => tr!(lab, level.need_retune),
        SummaryEntry::Verdict(IndexVerdict::WrongIndex) => tr!(lab, level.need_wrong),
    }
}
