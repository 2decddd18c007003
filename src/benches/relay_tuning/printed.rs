//! What the source prints for the chosen case, beside what is computed, and why they differ where they do.

use leptos::prelude::*;

use super::session::{Session, use_session};
use crate::format::NumberStyle;
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::{Caption, Cells, Figures};
use quadtank::literature::campestrini::{PrintedRemark, PublishedCase};
use quadtank::study::relay_tuning::{PrintedFigure, printed_figures};
use quadtank::tuning::{Action, PlacementMethod};

/// The figures of the chosen case; nothing where none is chosen.
#[component]
pub fn PrintedFigures() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let remarks = move || {
        let remarks = session.own.case.get().map_or(&[][..], PublishedCase::remarks);
        remarks.iter().map(|&remark| of_remark(lab, remark)).collect::<Vec<_>>().join(" ")
    };
    // A lesson asks about the plant, not about the print.
    let hidden = move || session.own.case.get().is_none() || lab.stage.with(Option::is_some);
    view! {
        <div class="printed" hidden=hidden>
            <Figures name="printed" caption=say!(lab, relay.printed_caption)>{move || table(session)}</Figures>
            <p class="remark" data-testid="printed-remark">{remarks}</p>
        </div>
    }
}

/// Symbols across, printed and computed numbers below them.
fn table(session: Session) -> Option<impl IntoView> {
    let (lab, case) = (session.lab, session.own.case.get()?);
    let study = session.throttled.study.get();
    let figures = printed_figures(case, study.as_ref().as_ref().ok()?).ok()?;
    let style = lab.number_style();
    let symbols = figures.iter().map(|f| view! { <th scope="col">{f.printed.symbol}</th> }).collect_view();
    let printed = figures.iter().map(|f| style.fixed(f.printed.value, f.printed.decimals.into())).collect::<Vec<_>>();
    let computed = figures.iter().map(|f| computed(style, f)).collect_view();
    Some(view! {
        <Caption text=tr!(lab, relay.printed_caption) />
        <thead><tr><td></td>{symbols}</tr></thead>
        <tbody>
            <tr><th scope="row">{tr!(lab, relay.printed)}</th><Cells texts=printed /></tr>
            <tr><th scope="row">{tr!(lab, relay.computed)}</th>{computed}</tr>
        </tbody>
    })
}

/// A computed number, which agrees with the printed one or not.
fn computed(style: NumberStyle, figure: &PrintedFigure) -> impl IntoView + use<> {
    let agrees = figure.agrees();
    let number = style.fixed(figure.computed, usize::from(figure.printed.decimals) + 1);
    let sign = if agrees { "=" } else { "≠" };
    view! { <td class=if agrees { "good" } else { "warm" } data-agrees=agrees.to_string()>{format!("{sign} {number}")}</td> }
}

/// What a case shows, and where it is printed.
pub fn name_of_case(lab: Lab, case: PublishedCase) -> String {
    let PublishedCase { table, row } = case;
    let placement = case.placement();
    let action = match placement.action {
        Action::Pi => "PI",
        Action::Pid => "PID",
    };
    match (table, row) {
        (0, _) => tr!(lab, relay.case_usol),
        (88, _) => tr!(lab, relay.case_full),
        (3, _) => tr!(lab, relay.case_locus, table = table, row = row),
        (4, row) => {
            let rule = ["ZN PI", "ZN PID", "TL PI", "TL PID"][(row - 1).min(3)];
            tr!(lab, relay.case_rule, table = table, rule = rule)
        }
        (7 | 13, _) => tr!(lab, relay.case_point, table = table, row = row),
        (5 | 9, _) => tr!(lab, relay.case_one_locus, table = table, action = action),
        (6 | 11, _) => tr!(lab, relay.case_root, table = table, row = row, action = action),
        (14, 4) => tr!(lab, relay.case_other_target, table = table, action = action),
        _ if placement.method == PlacementMethod::OneLocus => {
            tr!(lab, relay.case_one_locus_at, table = table, row = row, action = action)
        }
        _ => tr!(lab, relay.case_both_loci_at, table = table, row = row, action = action),
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
}
