//! Exact equilibrium beside the printed figures of the source.

use leptos::prelude::*;

use super::preset::chosen;
use super::session::{Session, use_session};
use crate::shown::{length_digits, to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Figures, Headings};
use quadtank::literature::{Preset, PresetId};
use quadtank::study::quadruple_tank::OperatingPointSpec;

/// A row: what, computed, printed.
type Row = (String, String, Option<String>);

/// The table of computed and printed figures of the rig.
#[component]
pub fn PublishedFigures() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let rig = chosen(session);
    let preset = move || rig.get().map(PresetId::preset);
    let table = move || {
        let columns = [tr!(lab, process.quantity), tr!(lab, process.exact), tr!(lab, process.printed)];
        view! {
            <thead><Headings texts=columns.to_vec() /></thead>
            <tbody>{rows(session, preset().as_ref()).into_iter().map(row_view).collect_view()}</tbody>
        }
    };
    let note = move || {
        preset().map_or_else(String::new, |p| {
            if p.printed.is_none() {
                return tr!(lab, process.none_printed, source = p.source);
            }
            let at_home = session.throttled.setup.with(|s| **s == quadtank::study::quadruple_tank::setup_of(p.id));
            let is_state = session.throttled.setup.with(|s| matches!(s.operating_point, OperatingPointSpec::State(_)));
            let lead = if is_state {
                tr!(lab, process.charts_use_state, source = p.source, table = p.table)
            } else {
                tr!(lab, process.charts_use, source = p.source, table = p.table)
            };
            let rest = if at_home || is_state { String::new() } else { format!(" {}", tr!(lab, process.printed_for)) };
            lead + &rest
        })
    };
    view! {
        <Figures name="published" caption=say!(lab, process.operating_point)>{table}</Figures>
        <p class="remark">{note}</p>
    }
}

fn row_view((name, exact, printed): Row) -> impl IntoView {
    let printed = printed.unwrap_or_else(|| "–".to_owned());
    view! {
        <tr>
            <td>{name.clone()}</td>
            <td data-exact=name.clone()>{exact}</td>
            <td data-printed=name>{printed}</td>
        </tr>
    }
}

fn rows(session: Session, preset: Option<&Preset>) -> Vec<Row> {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.own.unit.get();
    let printed = preset.and_then(|p| p.printed);
    // As many decimals as are printed, and of the exact figure no fewer than elsewhere on the page.
    let decimals = printed.map_or(0, |p| p.level_decimals);
    let length = |m: f64, decimals: usize| style.fixed(to_shown(m, unit), decimals);
    session
        .throttled
        .with_analysis(|a| {
            let mut rows: Vec<Row> = Vec::new();
            for tank in 0..4 {
                let name = format!("h{} ({})", ["₁", "₂", "₃", "₄"][tank], unit_name(unit));
                let exact = length(a.operating_point.levels[tank], decimals.max(length_digits(unit)));
                rows.push((name, exact, printed.map(|p| length(p.levels[tank], decimals))));
            }
            for tank in 0..4 {
                let name = format!("T{} (s)", ["₁", "₂", "₃", "₄"][tank]);
                let exact = a.time_constants_s[tank].map_or_else(|| "0".to_owned(), |t| style.fixed(t, 2));
                let source = printed.and_then(|p| p.time_constants_s).map(|times| style.fixed(times[tank], 0));
                rows.push((name, exact, source));
            }
            if let Ok(zeros) = &a.linear.zeros {
                for (k, zero) in zeros.iter().enumerate() {
                    let text = style.significant(zero.value.re, 4);
                    let source = printed.and_then(|p| p.zeros?.get(k).map(|&z| style.significant(z, 2)));
                    rows.push((format!("z{} (1/s)", ["₁", "₂"].get(k).unwrap_or(&"")), text, source));
                }
            }
            let rga = a.linear.rga_11.as_ref().map_or_else(|_| "∞".to_owned(), |l| style.fixed(*l, 4));
            rows.push(("λ₁₁".to_owned(), rga, printed.and_then(|p| p.rga_11).map(|l| style.significant(l, 3))));
            rows
        })
        .unwrap_or_default()
}
