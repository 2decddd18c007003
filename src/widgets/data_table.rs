use leptos::prelude::*;

use super::Picture;
use super::folded::folded;
use super::html::{cells, element, escape, headings};
use crate::format::NumberStyle;
use crate::lab::use_lab;
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
    folded(
        id,
        say!(lab, chart.table),
        say!(lab, chart.table_caption),
        Box::new(move || {
            let caption = element("caption", "class=\"visually-hidden\"", &escape(tr!(lab, chart.table_caption)));
            caption + &rows(&picture.visit(|charts| table(charts, ROWS)), lab.number_style())
        }),
    )
}

fn rows(table: &Table, style: NumberStyle) -> String {
    let row = |values: &Vec<f64>| {
        let texts: Vec<String> = values.iter().map(|&value| style.significant(value, DIGITS)).collect();
        element("tr", "", &cells(&texts))
    };
    let rows: String = table.rows.iter().map(row).collect();
    element("thead", "", &headings(&table.columns)) + &element("tbody", "", &rows)
}
