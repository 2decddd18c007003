//! How tables leave the page: as CSV in the style of the reader's spreadsheet, or over the clipboard into one.

use leptos::prelude::*;
use quadtank_figure::Table;
use quadtank_scenario::{CsvStyle, DecimalSign, Separator};

use super::download::{copy, download_text};
use super::lab::{Lab, Notice, use_lab};
use super::naming::file_name;
use super::storage::CSV;
use super::texts::{say, tr};
use super::widgets::{Choice, Select};

/// What a style is called in the storage of the browser and in tests: `semicolon-comma` has semicolons and decimal commas.
fn name(style: CsvStyle) -> &'static str {
    match (style.separator(), style.decimal()) {
        (Separator::Comma, _) => "comma-point",
        (Separator::Semicolon, DecimalSign::Comma) => "semicolon-comma",
        (Separator::Semicolon, DecimalSign::Point) => "semicolon-point",
        (Separator::Tab, DecimalSign::Point) => "tab-point",
        (Separator::Tab, DecimalSign::Comma) => "tab-comma",
    }
}

/// The style of CSV that was chosen at another visit, if any was.
pub fn remembered_style() -> Option<CsvStyle> {
    let known = CSV.read()?;
    CsvStyle::ALL.into_iter().find(|style| name(*style) == known)
}

/// The style of CSV: the chosen one, or the usual one of the language.
pub fn style(lab: Lab) -> CsvStyle {
    lab.csv_style.get().unwrap_or_else(|| CsvStyle::usual(decimal(lab)))
}

/// The decimal sign of the language.
fn decimal(lab: Lab) -> DecimalSign {
    if lab.number_style().decimal == ',' { DecimalSign::Comma } else { DecimalSign::Point }
}

/// Hands a table of the laboratory over as a file.
pub fn save_csv(lab: Lab, name: &str, table: &str) {
    let style = untrack(|| style(lab));
    download_text(&file_name(lab, name), "text/csv", &style.apply(table));
}

/// Puts a table on the clipboard as spreadsheets take it, or says how else to get it.
pub fn copy_table(lab: Lab, table: &Table) {
    let decimal = untrack(|| decimal(lab)).sign();
    copy(&table.to_tsv(decimal), move |copied| {
        lab.notice.set(Some(if copied { Notice::TableCopied } else { Notice::TableNotCopied }));
    });
}

/// The choice of the style of CSV.
#[component]
pub fn CsvStyleChoice() -> impl IntoView {
    let lab = use_lab();
    let signs = move |style: CsvStyle| {
        let separator = match style.separator() {
            Separator::Comma => tr!(lab, chart.comma),
            Separator::Semicolon => tr!(lab, chart.semicolon),
            Separator::Tab => tr!(lab, chart.tab),
        };
        tr!(lab, chart.csv_signs, separator = separator, number = format!("1{}5", style.decimal().sign()))
    };
    let choices = Signal::derive(move || {
        let usual = Choice::new(None, "usual", tr!(lab, chart.csv_usual, signs = signs(CsvStyle::usual(decimal(lab)))));
        let others = CsvStyle::ALL.map(|style| Choice::new(Some(style), name(style), signs(style)));
        std::iter::once(usual).chain(others).collect()
    });
    let choose = move |chosen: Option<CsvStyle>| {
        lab.csv_style.set(chosen);
        CSV.write(chosen.map_or("usual", name));
    };
    view! {
        <label class="text">
            {say!(lab, chart.csv)}
            <Select id="csv-style" choices chosen=lab.csv_style on_choose=choose disabled=false />
        </label>
    }
}
