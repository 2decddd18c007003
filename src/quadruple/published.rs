//! Exact equilibrium beside the printed figures of the source.

use leptos::prelude::*;

use crate::lab::Lab;
use crate::preset::chosen;
use crate::shown::{length_digits, to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::figures;
use crate::widgets::html::{element, headings};
use quadtank::plant::{Preset, PresetId};

/// A row: what, computed, printed.
type Row = (String, String, Option<String>);

/// The table of computed and printed figures of the rig.
pub fn published_figures(lab: Lab) -> AnyView {
    let rig = chosen(lab);
    let preset = move || rig.get().map(PresetId::preset);
    let table = Signal::derive(move || {
        let columns = [tr!(lab, process.quantity), tr!(lab, process.exact), tr!(lab, process.printed)];
        let rows: String = rows(lab, preset().as_ref()).into_iter().map(row_html).collect();
        element("thead", "", &headings(&columns.map(str::to_owned))) + &element("tbody", "", &rows)
    });
    let note = Signal::derive(move || {
        preset().map_or_else(String::new, |p| {
            if p.printed.is_none() {
                return tr!(lab, process.none_printed, source = p.source).to_string();
            }
            let at_home = lab.words.setup.with(|s| **s == quadtank_scenario::setup_of(p.id));
            let lead = tr!(lab, process.charts_use, source = p.source, table = p.table).to_string();
            let rest = if at_home { String::new() } else { format!(" {}", tr!(lab, process.printed_for)) };
            lead + &rest
        })
    });
    let caption = say!(lab, process.operating_point);
    vec![figures("published", caption, table), view! { <p class="remark">{note}</p> }.into_any()].into_any()
}

fn row_html((name, exact, printed): Row) -> String {
    let printed = printed.unwrap_or_else(|| "–".to_owned());
    format!("<tr><td>{name}</td><td data-exact=\"{name}\">{exact}</td><td data-printed=\"{name}\">{printed}</td></tr>")
}

fn rows(lab: Lab, preset: Option<&Preset>) -> Vec<Row> {
    let style = lab.number_style();
    let unit = lab.unit.get();
    let printed = preset.and_then(|p| p.printed);
    let length = |m: f64| style.fixed(to_shown(m, unit), length_digits(unit));
    lab.words
        .with_analysis(|a| {
            let mut rows: Vec<Row> = Vec::new();
            for tank in 0..4 {
                let name = format!("h{} ({})", ["₁", "₂", "₃", "₄"][tank], unit_name(unit));
                rows.push((name, length(a.operating_point.levels[tank]), printed.map(|p| length(p.levels[tank]))));
            }
            for tank in 0..4 {
                let name = format!("T{} (s)", ["₁", "₂", "₃", "₄"][tank]);
                let exact = a.time_constants_s[tank].map_or_else(|| "0".to_owned(), |t| style.fixed(t, 2));
                rows.push((name, exact, printed.map(|p| style.fixed(p.time_constants_s[tank], 0))));
            }
            if let Ok(zeros) = &a.zeros {
                for (k, zero) in zeros.iter().enumerate() {
                    let text = style.significant(zero.value.re, 4);
                    let source = printed.and_then(|p| p.zeros.get(k).map(|&z| style.significant(z, 2)));
                    rows.push((format!("z{} (1/s)", ["₁", "₂"].get(k).unwrap_or(&"")), text, source));
                }
            }
            let rga = a.rga_11.as_ref().map_or_else(|_| "∞".to_owned(), |l| style.fixed(*l, 4));
            rows.push(("λ₁₁".to_owned(), rga, printed.map(|p| style.significant(p.rga_11, 3))));
            rows
        })
        .unwrap_or_default()
}
