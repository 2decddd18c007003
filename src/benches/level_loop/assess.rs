//! Step 5: how well the loop does, for the right objective and for the wrong one, and on a model that errs.

use leptos::prelude::*;
use quadtank::study::level_loop::{LevelLoopAnswer, LevelLoopSetup, Objective};
use quadtank_scenario::Limits;

use super::errors;
use super::flags::{locks, panels};
use super::mends;
use super::sentences::{self, short_variance};
use super::session::{Session, use_session};
use crate::controls::{ParamControl, ParamRow};
use crate::mends::MendButton;
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Figure, Figures, ReasonedRow, Scale, Sentence, TableContent, Text, Verdict, marked};

const REFERENCE: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "reference-gain"), ("", "reference-time")],
    label: |_, k| ["Kp*", "Ti*"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, level.reference_gain) } else { tr!(lab, level.reference_time) },
    path: |_, k| ["reference.gain", "reference.integral_time_s"][k],
    read: |s, k| [s.reference.gain, s.reference.integral_time_s][k],
    write: |s, k, value| *if k == 0 { &mut s.reference.gain } else { &mut s.reference.integral_time_s } = value,
    within: |_, _| Limits::NONE,
    shown_unit: Some(|_| ShownUnit::called("")),
    ..ParamControl::locked_by(locks::GAINS)
};
const MODEL_ERROR: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("error-area", "error-area-number"), ("error-flow", "error-flow-number")],
    label: |_, k| ["A", "Cv"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, level.error_area) } else { tr!(lab, level.error_flow) },
    path: |_, k| ["model_error.area_factor", "model_error.flow_factor"][k],
    read: |s, k| [s.model_error.area_factor, s.model_error.flow_factor][k],
    write: |s, k, value| *if k == 0 { &mut s.model_error.area_factor } else { &mut s.model_error.flow_factor } = value,
    travel: Some(|_| (0.5, 1.5)),
    scale: Some(Scale::Linear(0.01)),
    digits: Some(2),
    ..REFERENCE
};

/// Dead time of the Harris index, in rows of the log.
const DEAD_TIME: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "harris-rows"); 2],
    label: |_, _| "θ".to_owned(),
    name: |lab, _| tr!(lab, level.harris_rows_name),
    path: |_, _| "harris.dead_time_rows",
    read: |s, _| s.harris.dead_time_rows as f64,
    write: |s, _, rows| s.harris.dead_time_rows = whole_rows(rows),
    digits: Some(0),
    scale: Some(Scale::Linear(1.0)),
    ..REFERENCE
};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::variance_index, terms::harris, terms::margins, terms::peak, terms::travel];

/// Indices, margins and travel.
#[component]
pub fn AssessCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let found = Memo::new(move |_| sentences::of_index(session));
    let quality = Memo::new(move |_| sentences::of_quality(session));
    let steps = lab.throttled(session.part(LevelLoopSetup::steps_set_point));
    let take_reference = move |_| session.edit(|s| s.set_pi_tuning(s.reference));
    let make_reference = move |_| {
        session.edit(|s| {
            if let Some(tuning) = s.pi_tuning() {
                s.reference = tuning;
            }
        });
    };
    view! {
        <Card name="assessment" panel=panels::ASSESSMENT title=say!(lab, level.assess_title) terms=TERMS>
            <Verdict id="level-index" warm=Signal::derive(move || !found.get().0)>
                {move || marked(&found.get().1)}
            </Verdict>
            <Figures name="level-indices" caption=say!(lab, level.indices)>{move || indices(session)}</Figures>
            <p class="remark" data-testid="level-index-step" hidden=move || !steps.get()>
                {move || marked(&tr!(lab, level.step_in_index))}
            </p>
            <Sentence
                id="level-quality"
                warm=Signal::derive(move || !quality.get().0)
                text=Signal::derive(move || quality.get().1)
            />
            <MendButton session id="mend-quality" offer=mends::of_loop />
            <p class="remark" data-testid="level-travel">{move || travel(session)}</p>
            <details class="more">
                <summary data-testid="level-error-fold">{say!(lab, level.reference_title)}</summary>
                <div class="pairs">
                    <ParamRow session control=&REFERENCE index=0 />
                    <ParamRow session control=&REFERENCE index=1 />
                </div>
                <div class="toolbar">
                    <button
                        type="button"
                        class="button small"
                        data-testid="take-reference"
                        disabled=lab.locks(locks::GAINS)
                        on:click=take_reference
                    >
                        {say!(lab, level.take_reference)}
                    </button>
                    <button
                        type="button"
                        class="button small"
                        data-testid="make-reference"
                        disabled=lab.locks(locks::GAINS)
                        on:click=make_reference
                    >
                        {say!(lab, level.make_reference)}
                    </button>
                </div>
                <p class="remark">{say!(lab, level.model_error)}</p>
                <ParamRow session control=&MODEL_ERROR index=0 />
                <ParamRow session control=&MODEL_ERROR index=1 />
                <p class="remark">{say!(lab, level.harris_rows_name)}</p>
                <div class="pairs"><ParamRow session control=&DEAD_TIME /></div>
            </details>
        </Card>
    }
}

/// The nearest number of rows; the control keeps it within its limits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
fn whole_rows(rows: f64) -> usize {
    rows.round() as usize
}

/// Both indices, that of the objective first marked, and the Harris index.
fn indices(session: Session) -> impl IntoView {
    let lab = session.lab;
    let style = lab.number_style();
    let (objective, dead_time_s) = session.throttled.setup.with(|setup| (setup.objective, setup.harris_dead_time_s()));
    let columns = vec![
        tr!(lab, level.index),
        tr!(lab, level.column_reference),
        tr!(lab, level.column_actual),
        tr!(lab, level.column_index),
    ];
    let rows = session.throttled.with_answer(|answer| {
        let of_both = [0, 1].map(|k| both_row(session, answer, k));
        let names = [tr!(lab, level.index_level_row), tr!(lab, level.index_outflow_row)];
        let chosen = usize::from(objective != Objective::Tight);
        let mut rows: Vec<AnyView> = Vec::new();
        for (k, (figures, name)) in of_both.into_iter().zip(names).enumerate() {
            let class = if k == chosen { "chosen" } else { "other" };
            rows.push(view! { <ReasonedRow class name figures /> }.into_any());
        }
        let harris = match &answer.harris {
            Ok(harris) => vec![
                Figure::Shown(short_variance(lab, harris.index.reference)),
                Figure::Shown(short_variance(lab, harris.index.actual)),
                Figure::Shown(style.fixed(harris.index.quality(), 3)),
            ],
            Err(error) => vec![Figure::None(errors::of_harris(lab, error)); 3],
        };
        let name = tr!(lab, level.harris_dead_time, time = style.significant(dead_time_s, 3));
        rows.push(view! { <ReasonedRow name figures=harris /> }.into_any());
        rows
    });
    view! { <TableContent caption=tr!(lab, level.indices) columns rows=rows.unwrap_or_default() /> }
}

fn both_row(session: Session, answer: &LevelLoopAnswer, which: usize) -> Vec<Figure> {
    let lab = session.lab;
    match (&answer.reference, answer.indices) {
        (_, Some(Ok(both))) => {
            let index = [both.level, both.outflow][which];
            vec![
                Figure::Shown(short_variance(lab, index.reference)),
                Figure::Shown(short_variance(lab, index.actual)),
                Figure::Shown(lab.number_style().fixed(index.quality(), 4)),
            ]
        }
        (_, Some(Err(error))) => vec![Figure::None(errors::of_index(lab, error)); 3],
        (Err(error), None) => vec![Figure::None(errors::of_run(lab, error)); 3],
        (Ok(_), None) => vec![Figure::None(String::new()); 3],
    }
}

/// How much the valve moves.
fn travel(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let of = |answer: &LevelLoopAnswer| {
        let travel = answer.travel;
        let (total, at_end) = (style.fixed(travel.total, 2), style.significant(100.0 * travel.at_end, 2));
        tr!(lab, level.travel, total = total, reversals = travel.reversals, share = at_end)
    };
    session.throttled.with_answer(of).unwrap_or_default()
}
