//! Controllers side by side in the experiment of the session: those at work, published ones, and those by rules, to take over.

use leptos::prelude::*;

use super::flags::locks;
use super::given::{name_of, within_limits};
use super::session::{Session, use_session};
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::{Figure, FigureCells, Folded, TableContent};
use quadtank::control::Pairing;
use quadtank::linear::LoopStability;
use quadtank::study::relay_tuning::{ControllerAssessment, GivenPid, TuningSetup};
use quadtank::tuning::{PairRule, PairRuleError, TuningRule};

/// The table, folded away.
#[component]
pub fn SideBySide() -> impl IntoView {
    let session = use_session();
    let summary = say!(session.lab, relay.side_by_side);
    view! { <Folded id="side-by-side" summary caption=summary content=move || table(session) /> }
}

/// A row: controllers with what they do, or why there are none.
struct Compared {
    name: String,
    /// Name of the button for tests, the controllers that it takes over and their pairing; nothing for those at work.
    offer: Option<(&'static str, [GivenPid; 2], Pairing)>,
    outcome: Result<ControllerAssessment, PairRuleError>,
}

fn table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let rows = rows(session).into_iter().map(|row| row_of(session, row)).collect::<Vec<_>>();
    let columns = [&*tr!(lab, relay.controllers), "Lc (dB)", "Ms", "IAE y₁", "IAE y₂", &*tr!(lab, relay.use_these)];
    view! { <TableContent caption=tr!(lab, relay.side_by_side) columns=columns.map(str::to_owned).to_vec() rows /> }
}

fn rows(session: Session) -> Vec<Compared> {
    let lab = session.lab;
    let setup = session.throttled.setup.get();
    session.throttled.study.with(|study| {
        let Ok(study) = study.as_ref() else { return Vec::new() };
        let judged = session.throttled.with_design(|design| study.judge_root(design.chosen_root(), &setup));
        let present = judged.map(|judged| Compared {
            name: tr!(lab, relay.present_controllers),
            offer: None,
            outcome: judged.map_err(PairRuleError::from),
        });
        let published = study.compare_published(&setup).unwrap_or_default().into_iter().map(|row| Compared {
            name: name_of(lab, row.published),
            offer: TuningSetup::with_published(row.published)
                .design
                .controllers
                .map(|given| (row.published.name(), given, Pairing::Diagonal)),
            outcome: Ok(row.judged),
        });
        let ruled = study.compare_rules(&setup).into_iter().map(|row| Compared {
            name: name_of_rule(lab, row.rule),
            offer: row.outcome.ok().map(|(given, _)| (row.rule.name(), given.map(within_limits), setup.design.pairing)),
            outcome: row.outcome.map(|(_, judged)| judged),
        });
        present.into_iter().chain(published).chain(ruled).collect()
    })
}

fn row_of(session: Session, row: Compared) -> AnyView {
    let lab = session.lab;
    match row.outcome {
        Ok(judged) => {
            let name = format!("{} {}", row.name, sign(judged.stability));
            let button = row.offer.map(|(id, given, pairing)| {
                let take = move |_| {
                    session.edit(|s| (s.design.controllers, s.design.pairing) = (Some(given), pairing));
                };
                view! {
                    <button
                        type="button"
                        class="button small"
                        data-testid=format!("take-{id}")
                        disabled=lab.locks(locks::TARGET)
                        on:click=take
                    >
                        {say!(lab, relay.use_these)}
                        <span class="visually-hidden">" " {row.name}</span>
                    </button>
                }
            });
            view! { <tr><th scope="row">{name}</th><FigureCells figures=figures(lab, &judged) /><td>{button}</td></tr> }
                .into_any()
        }
        Err(error) => {
            view! { <tr><th scope="row">{row.name}</th><td class="reason" colspan="5">{refusal(lab, &error)}</td></tr> }
                .into_any()
        }
    }
}

/// Lc, Ms, and the IAE of both outputs.
fn figures(lab: Lab, judged: &ControllerAssessment) -> Vec<Figure> {
    let style = lab.number_style();
    let shown = |value: Option<f64>| {
        let why = || Figure::None(tr!(lab, relay.why_unbounded));
        value.map_or_else(why, |value| Figure::Shown(style.fixed(value, 2)))
    };
    let iae = |output: usize| judged.is_bounded.then_some(judged.figures[output].iae);
    vec![
        shown(judged.peaks.log_modulus.map(|peak| peak.value)),
        shown(judged.peaks.sensitivity.map(|peak| peak.value)),
        shown(iae(0)),
        shown(iae(1)),
    ]
}

/// Whether a loop is stable, as a sign.
fn sign(stability: LoopStability) -> &'static str {
    match stability {
        LoopStability::Stable => "✓",
        LoopStability::NotComputed { .. } => "?",
        LoopStability::Unstable { .. } | LoopStability::Marginal { .. } | LoopStability::AlgebraicLoop { .. } => "✗",
    }
}

/// Who found a rule, and its factors where there are variants.
fn name_of_rule(lab: Lab, rule: PairRule) -> String {
    match rule {
        PairRule::Ultimate(TuningRule::ZieglerNicholsP) => tr!(lab, relay.rule_zn_p),
        PairRule::Ultimate(TuningRule::ZieglerNicholsPi) => tr!(lab, relay.rule_zn_pi),
        PairRule::Ultimate(TuningRule::ZieglerNichols1942Pi) => tr!(lab, relay.rule_zn_1942_pi),
        PairRule::Ultimate(TuningRule::ZieglerNicholsPid) => tr!(lab, relay.rule_zn_pid),
        PairRule::Ultimate(TuningRule::TyreusLuybenPi) => tr!(lab, relay.rule_tl_pi),
        PairRule::Ultimate(TuningRule::TyreusLuybenPid) => tr!(lab, relay.rule_tl_pid),
        PairRule::Blt => tr!(lab, relay.rule_blt),
        PairRule::Simc => tr!(lab, relay.rule_simc),
        PairRule::Imc => tr!(lab, relay.rule_imc),
    }
}

/// Why a rule makes no controllers of the plant.
fn refusal(lab: Lab, error: &PairRuleError) -> String {
    match error {
        PairRuleError::NoUltimatePoint { number } => tr!(lab, relay.no_ultimate_point, number = number),
        PairRuleError::NotReducible { number } => tr!(lab, relay.not_reducible, number = number),
        PairRuleError::Integrating { number } => tr!(lab, relay.rule_needs_gain, number = number),
        PairRuleError::NoDeadTime { number } => tr!(lab, relay.no_dead_time, number = number),
        PairRuleError::NotDetuned { target_db, largest_factor } => {
            tr!(lab, relay.not_detuned, target = target_db, factor = largest_factor)
        }
        PairRuleError::Plant(error) => super::errors::sentence(lab, error),
    }
}
