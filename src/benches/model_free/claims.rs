//! What the paper claims, and what is left of it when it is computed.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::sentences::in_cm;
use super::session::{Session, load, use_session};
use crate::texts::{say, tr};
use crate::widgets::{Card, marked};
use quadtank::study::model_free::{CheckedClaim, Claim, ClaimFigures, Standing, check_claims};

const IDS: [&str; 5] = ["claim-a", "claim-b", "claim-zero", "claim-c", "claim-alpha"];

/// The claims, each with its verdict, the figures behind it and the case that shows it.
#[component]
pub fn ClaimsCard() -> impl IntoView {
    let lab = use_session().lab;
    // No published case is refused.
    let claims = check_claims().unwrap_or_default();
    let items = claims.into_iter().zip(IDS).map(|(claim, id)| view! { <Item claim id /> }).collect_view();
    let about = move || view! { <span class="remark">{say!(lab, free.claims_remark)}</span> };
    view! {
        <Card name="claims" panel=panels::CLAIMS title=say!(lab, free.claims) beside=about>
            <ol>{items}</ol>
        </Card>
    }
}

#[component]
fn Item(claim: CheckedClaim, id: &'static str) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let content = move || {
        let (said, found) = texts(session, &claim);
        view! {
            <b>{marked(&said)}</b>
            " "
            <span class=if claim.standing == Standing::Reproduced { "badge good" } else { "badge warm" }>
                {standing(session, &claim)}
            </span>
            <br />
            {marked(&found)}
        }
    };
    let show = move |_| {
        load(session, claim.setup());
        // The list stands below what it shows.
        if let Ok(Some(course)) = document().query_selector(".bench.free .course") {
            course.scroll_into_view();
        }
    };
    view! {
        <li>
            <span data-testid=id>{content}</span>
            <button
                type="button"
                class="button small"
                data-testid=format!("{id}-show")
                disabled=lab.locks(locks::EXPERIMENT)
                on:click=show
            >
                {say!(lab, free.show)}
            </button>
        </li>
    }
}

fn standing(session: Session, claim: &CheckedClaim) -> String {
    let lab = session.lab;
    match (claim.claim(), claim.standing) {
        (Claim::ModelGain, Standing::Reproduced) => tr!(lab, free.enough),
        (_, Standing::Reproduced) => tr!(lab, free.reproduced),
        (_, Standing::EqualSetPoints) => tr!(lab, free.equal_set_points),
        (_, Standing::LimitedTime) => tr!(lab, free.limited_time),
        (_, Standing::Refuted) => tr!(lab, free.refuted),
    }
}

/// The claim, and what was found.
fn texts(session: Session, claim: &CheckedClaim) -> (String, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let number = |value: f64, digits| style.fixed(value, digits);
    match claim.figures {
        ClaimFigures::CaseA { iae, overshoot, share_at_limit, settling_s } => {
            let (iae, overshoot) = (number(in_cm(iae), 0), number(100.0 * overshoot, 0));
            let (share, time) = (number(100.0 * share_at_limit, 0), number(settling_s, 0));
            let found = tr!(lab, free.found_a, iae = iae, overshoot = overshoot, share = share, time = time);
            (tr!(lab, free.claim_a), found)
        }
        ClaimFigures::CaseB { iae, iae_of_case_a, ends_s, lost_s } => {
            let (b, a) = (number(in_cm(iae), 0), number(in_cm(iae_of_case_a), 0));
            let found = tr!(lab, free.found_b, b = b, a = a, ends = number(ends_s, 0), lost = number(lost_s, 0));
            (tr!(lab, free.claim_b), found)
        }
        ClaimFigures::AnyZero { lost_after_s, rga_11, niederlinski, rightmost_pole } => {
            let (after, rga) = (number(lost_after_s, 0), number(rga_11, 2));
            let (index, pole) = (number(niederlinski, 2), style.significant(rightmost_pole, 2));
            let found = tr!(lab, free.found_zero, after = after, rga = rga, index = index, pole = pole);
            (tr!(lab, free.claim_zero), found)
        }
        ClaimFigures::CaseC { error, apart, error_unequal } => {
            let (equal, apart) = (number(in_cm(error), 2), number(in_cm(apart), 1));
            let found = tr!(lab, free.found_c, equal = equal, apart = apart, unequal = number(in_cm(error_unequal), 2));
            (tr!(lab, free.claim_c), found)
        }
        ClaimFigures::ModelGain { smallest, smallest_of_tank_1 } => {
            let (smallest, alone) = (number(in_cm(smallest), 4), number(in_cm(smallest_of_tank_1), 4));
            let found = tr!(lab, free.found_alpha, smallest = smallest, alone = alone);
            (tr!(lab, free.claim_alpha), found)
        }
    }
}
