//! What tuning rules suggest, by the model of the test or by that of the place where the loop works.

use leptos::prelude::*;
use quadtank::study::level_loop::{LevelLoopSetup, ModelSource, PiTuning, SuggestedRule, Suggestion};
use quadtank::tuning::{ModelRule, TuningRule};

use super::errors;
use super::flags::locks;
use super::session::{Session, use_session};
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::shown::ShownUnit;
use crate::texts::{say, tr};
use crate::widgets::Scale;

/// The closed-loop time constant that is asked of the rules.
const WISH: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-wish", "level-wish-number"); 2],
    label: |_, _| "τc".to_owned(),
    name: |lab, _| tr!(lab, level.closed_loop_time),
    path: |_, _| "closed_loop_time_s",
    read: |s, _| s.closed_loop_time_s,
    write: |s, _, time| s.closed_loop_time_s = time,
    travel: Some(|_| (1.0, 5000.0)),
    scale: Some(Scale::Logarithmic),
    shown_unit: Some(|_| ShownUnit::called("s")),
    ..ParamControl::locked_by(locks::GAINS)
};
/// Which model the rules take.
#[component]
fn SourceSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, level.model_source)
            choices=vec![
                (ModelSource::Test, "model-test", say!(lab, level.model_of_test)),
                (ModelSource::Local, "model-local", say!(lab, level.model_local)),
            ]
            read=|s| s.model_source
            write=|s, source| s.model_source = source
            lock=locks::GAINS
        />
    }
}

/// What the rules suggest, each a click away.
#[component]
pub fn Rules() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let rows = move || {
        let setup = session.throttled.setup.get();
        let suggestions = session.throttled.suggestions.get();
        suggestions
            .iter()
            .map(|suggestion| view! { <Rule suggestion=*suggestion setup=(*setup).clone() /> })
            .collect_view()
    };
    let is_empty = move || session.throttled.suggestions.with(|suggestions| suggestions.is_empty());
    view! {
        <h3>{say!(lab, level.rules)}</h3>
        <SourceSwitch />
        <ParamRow session control=&WISH />
        <ul class="rules" data-testid="level-rules">{rows}</ul>
        <p class="remark" hidden=move || !is_empty()>{say!(lab, level.no_rules)}</p>
    }
}

#[component]
fn Rule(suggestion: Suggestion, setup: LevelLoopSetup) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let (name, id) = rule_name(suggestion.rule);
    let clipped = suggestion.clipped(&setup);
    let text = move || match (suggestion.settings, clipped) {
        (Ok(settings), Some((tuning, cut))) => {
            let style = lab.number_style();
            let number = |value: f64| style.significant(value, 3);
            let (gain, time) = (number(tuning.gain), number(tuning.integral_time_s));
            let text = format!("Kp {gain} · Ti {time} s");
            if cut { format!("{text} ({})", tr!(lab, level.cut, gain = number(settings.gain))) } else { text }
        }
        (Err(error), _) => errors::of_rule(lab, error),
        (Ok(_), None) => String::new(),
    };
    let choose = move |_| {
        if let Some((tuning, _)) = clipped {
            session.edit(|s| s.set_pi_tuning(tuning));
        }
    };
    view! {
        <li>
            <b>{name}</b>
            <span>{text}</span>
            <button
                type="button"
                class="button small"
                data-testid=format!("rule-{id}")
                disabled=clipped.is_none() || lab.locks(locks::GAINS)
                on:click=choose
            >
                {say!(lab, level.take)}
                <span class="visually-hidden">" " {name}</span>
            </button>
        </li>
    }
}

/// The name of a rule, and the one for tests.
pub const fn rule_name(rule: SuggestedRule) -> (&'static str, &'static str) {
    match rule {
        SuggestedRule::Model(ModelRule::Simc { .. }) => ("SIMC", "simc"),
        SuggestedRule::Model(ModelRule::Lambda { .. }) => ("Lambda", "lambda"),
        SuggestedRule::Model(ModelRule::Amigo) => ("AMIGO", "amigo"),
        SuggestedRule::Ultimate(TuningRule::TyreusLuybenPi | TuningRule::TyreusLuybenPid) => ("Tyreus–Luyben", "tl"),
        SuggestedRule::Ultimate(_) => ("Ziegler–Nichols", "zn"),
    }
}

/// The suggestions as tunings that can be taken up, with their names.
pub fn suggested(session: Session) -> Vec<(&'static str, PiTuning)> {
    let setup = session.throttled.setup.get();
    session.throttled.suggestions.with(|suggestions| {
        let of = |suggestion: &Suggestion| Some((rule_name(suggestion.rule).0, suggestion.clipped(&setup)?.0));
        suggestions.iter().filter_map(of).collect()
    })
}
