//! What the source prints for the chosen case, beside what is computed, and why they differ where they do.

use leptos::prelude::*;

use super::session::{Session, use_session};
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::figures;
use crate::widgets::html::{cells, element, escape};
use quadtank_scenario::tuning::{PrintedFigure, PrintedRemark, PublishedCase};

/// The figures of the chosen case; nothing where none is chosen.
#[component]
pub fn PrintedFigures() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let table = Signal::derive(move || table(session).unwrap_or_default());
    let remarks = Signal::derive(move || {
        let remarks = session.case.get().map_or(&[][..], PublishedCase::remarks);
        remarks.iter().map(|&remark| of_remark(lab, remark)).collect::<Vec<_>>().join(" ")
    });
    view! {
        <div class="printed" hidden=Signal::derive(move || session.case.get().is_none())>
            {figures("printed", say!(lab, relay.printed_caption), table)}
            <p class="remark" data-testid="printed-remark">{remarks}</p>
        </div>
    }
}

/// Symbols across, printed and computed numbers below them.
fn table(session: Session) -> Option<String> {
    let (lab, case) = (session.lab, session.case.get()?);
    let study = session.words.study.get();
    let figures = case.figures(study.as_ref().as_ref().ok()?).ok()?;
    let style = lab.number_style();
    let head: String = figures.iter().map(|f| element("th", "scope=\"col\"", &escape(f.symbol))).collect();
    let heading = |text: &str| element("th", "scope=\"row\"", &escape(text));
    let printed: Vec<String> = figures.iter().map(|f| style.fixed(f.printed, f.decimals.into())).collect();
    let printed = cells(&printed);
    let computed: String = figures
        .iter()
        .map(|f: &PrintedFigure| {
            let number = escape(&style.fixed(f.computed, usize::from(f.decimals) + 1));
            let agrees = f.agrees();
            let sign = if agrees { "=" } else { "≠" };
            let class = format!("class=\"{}\" data-agrees=\"{agrees}\"", if agrees { "good" } else { "warm" });
            element("td", &class, &format!("{sign} {number}"))
        })
        .collect();
    let caption = element("caption", "class=\"visually-hidden\"", &escape(tr!(lab, relay.printed_caption)));
    Some(format!(
        "{caption}<thead><tr><td></td>{head}</tr></thead><tbody><tr>{}{printed}</tr><tr>{}{computed}</tr></tbody>",
        heading(tr!(lab, relay.printed)),
        heading(tr!(lab, relay.computed))
    ))
}

/// Name of a case in the language of the laboratory.
pub fn name_of_case(lab: Lab, case: PublishedCase) -> String {
    let PublishedCase { table, row } = case;
    match (table, row) {
        (0, _) => tr!(lab, relay.case_usol).to_owned(),
        (88, _) => tr!(lab, relay.case_full).to_owned(),
        (3, _) => tr!(lab, relay.case_locus, table = table, row = row).to_string(),
        (4, row) => {
            let rule = ["ZN PI", "ZN PID", "TL PI", "TL PID"][(row - 1).min(3)];
            tr!(lab, relay.case_rule, table = table, rule = rule).to_string()
        }
        (6 | 11, _) => tr!(lab, relay.case_controller, table = table, row = row).to_string(),
        (14, 4) => tr!(lab, relay.case_other_target, table = table).to_string(),
        (5 | 9, _) => tr!(lab, relay.case_table, table = table).to_string(),
        _ => tr!(lab, relay.case_point, table = table, row = row).to_string(),
    }
}

fn of_remark(lab: Lab, remark: PrintedRemark) -> String {
    match remark {
        PrintedRemark::OtherPeriod => tr!(lab, relay.print_other_period),
        PrintedRemark::LostSign => tr!(lab, relay.print_lost_sign),
        PrintedRemark::Rounded => tr!(lab, relay.print_rounded),
        PrintedRemark::NearRule => tr!(lab, relay.print_near_rule),
        PrintedRemark::UnstatedPoint => tr!(lab, relay.print_unstated_point),
        PrintedRemark::OtherImportance => tr!(lab, relay.print_other_importance),
        PrintedRemark::Corner => tr!(lab, relay.print_corner),
        PrintedRemark::PeriodsAsFrequencies => tr!(lab, relay.print_periods),
        PrintedRemark::Slip => tr!(lab, relay.print_slip),
        PrintedRemark::UnroundedTarget => tr!(lab, relay.print_unrounded),
        PrintedRemark::Heading => tr!(lab, relay.print_heading),
        PrintedRemark::Unstable => tr!(lab, relay.print_unstable),
        PrintedRemark::Usol => tr!(lab, relay.print_usol),
    }
    .to_owned()
}
