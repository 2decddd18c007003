use leptos::prelude::*;

use super::{Caption, Cells, Folded, Headings, Picture};
use crate::format::NumberStyle;
use crate::lab::use_lab;
use crate::tables::copy_table;
use crate::texts::{say, tr};
use quadtank_figure::{Table, table};

/// Rows of the table at most.
const ROWS: usize = 25;
/// Significant digits of its numbers.
const DIGITS: usize = 4;

/// The curves of a picture as numbers, for those who do not see it.
#[component]
pub fn DataTable(
    /// The charts.
    picture: Picture,
    /// Name for tests.
    id: &'static str,
) -> impl IntoView {
    let lab = use_lab();
    let for_copy = picture.clone();
    let content = move || {
        view! {
            <Caption text=tr!(lab, chart.table_caption) />
            {rows(picture.visit(|charts| table(charts, ROWS)), lab.number_style())}
        }
    };
    let copy = move |_| copy_table(lab, &untrack(|| for_copy.visit(|charts| table(charts, ROWS))));
    view! {
        <Folded id summary=say!(lab, chart.table) caption=say!(lab, chart.table_caption) content>
            <button type="button" class="button small" data-testid=format!("{id}-copy") on:click=copy>{say!(lab, chart.copy)}</button>
        </Folded>
    }
}

fn rows(table: Table, style: NumberStyle) -> impl IntoView {
    let row = |values: Vec<f64>| {
        let texts = values.into_iter().map(|value| style.significant(value, DIGITS)).collect();
        view! { <tr><Cells texts /></tr> }
    };
    view! {
        <thead><Headings texts=table.columns /></thead>
        <tbody>{table.rows.into_iter().map(row).collect_view()}</tbody>
    }
}
