//! Step 3: the target of the placement in the plane of the loci, and the controllers that follow.

use leptos::prelude::*;

use super::card::{Step, card, hideable};
use super::controls::{choice, symbol};
use super::details;
use super::errors;
use super::pictures::{self, short_name};
use super::session::{Session, use_session};
use crate::controls::{Knob, knob, segmented};
use crate::lab::Lab;
use crate::start::Control;
use crate::texts::{say, tr};
use crate::widgets::html::option;
use crate::widgets::{Nudge, PointHandle, Scale, figures, html, remark};
use quadtank::linear::{Closure, Complex, LoopStability};
use quadtank::tuning::{Action, PlacementMethod, PlacementWarning, dynamic_relative_gain};
use quadtank_figure::Frame;
use quadtank_scenario::tuning::{DesignRoot, TuningSetup, rule_targets};

/// Step of the arrow keys, and the grid of dragging.
const STEP: f64 = 0.01;
/// Parts of the target that can be entered.
const TARGETS: (f64, f64) = (-10.0, 10.0);

const TARGET: Knob<TuningSetup> = Knob {
    ids: [("", "target-re"), ("", "target-im")],
    label: |_, k| ["Re λ", "Im λ"][k],
    name: |lab, k| if k == 0 { tr!(lab, relay.target_re) } else { tr!(lab, relay.target_im) }.to_owned(),
    read: |s, k| s.design.target[k],
    write: |s, k, part| s.design.target[k] = part,
    limits: |_, _| TARGETS,
    scale: Scale::Linear(STEP),
    lock: Control::Target,
    ..Knob::PLAIN
};

/// The placement.
pub fn placement_card() -> AnyView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    card(Step {
        name: "placement",
        number: 3,
        title: say!(lab, relay.placement),
        toolbar: remark(say!(lab, relay.placement_remark)),
        picture: pictures::loci(session),
        frames,
        place: "chart square",
        overlay: view! { <svg class="over"><TargetHandle frames /></svg> }.into_any(),
        settings: settings(session),
        verdict: Signal::derive(move || sentence(session)),
        below: vec![details::of_controllers(session)],
    })
}

fn settings(session: Session) -> AnyView {
    let lab = session.lab;
    let methods = vec![("method-a", say!(lab, relay.method_a)), ("method-b", say!(lab, relay.method_b))];
    let roots = vec![("root1", say!(lab, relay.root, number = 1)), ("root2", say!(lab, relay.root, number = 2))];
    let actions = vec![("action-pi", symbol("PI")), ("action-pid", symbol("PID"))];
    let lock = Control::Target;
    let pairs = vec![
        segmented(
            session,
            say!(lab, relay.action),
            actions,
            |s| usize::from(s.design.action == Action::Pid),
            set_action,
            lock,
        ),
        segmented(session, say!(lab, relay.roots), roots, |s| s.design.root - 1, |s, k| s.design.root = k + 1, lock),
        knob(session, &TARGET, 0),
        knob(session, &TARGET, 1),
    ];
    let choose = move |name: String| choose_rule(session, &name);
    let rule = choice("target-rule", say!(lab, relay.target_rule), rules(session), choose, lock);
    let table = Signal::derive(move || table(session));
    vec![
        segmented(
            session,
            say!(lab, relay.method),
            methods,
            |s| usize::from(s.design.method == PlacementMethod::BothLoci),
            set_method,
            lock,
        ),
        hideable("pairs", Signal::stored(false), pairs),
        rule,
        figures("gains", say!(lab, relay.gains_caption), table),
    ]
    .into_any()
}

fn set_method(setup: &mut TuningSetup, index: usize) {
    setup.design.method = if index == 1 { PlacementMethod::BothLoci } else { PlacementMethod::OneLocus };
}

fn set_action(setup: &mut TuningSetup, index: usize) {
    setup.design.action = if index == 1 { Action::Pid } else { Action::Pi };
}

/// The targets of the rules, to take over.
fn rules(session: Session) -> Signal<String> {
    let lab = session.lab;
    Signal::derive(move || {
        let target = lab.tuning.with(|s| s.tuning.design.target);
        let chosen = |at: Complex| target == [at.re, at.im];
        let rules: String = rule_targets()
            .iter()
            .map(|&(rule, at)| {
                option(short_name(rule), &tr!(lab, relay.point_of_rule, rule = short_name(rule)), chosen(at))
            })
            .collect();
        option("", tr!(lab, relay.own_target), rule_targets().iter().all(|&(_, at)| !chosen(at))) + &rules
    })
}

fn choose_rule(session: Session, name: &str) {
    if let Some((_, at)) = rule_targets().into_iter().find(|(rule, _)| short_name(*rule) == name) {
        session.edit(|s| s.design.target = [at.re, at.im]);
    }
}

/// The target λ: dragged, or moved by the arrow keys.
#[component]
fn TargetHandle(frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let [re, im] = [session.part(|s| s.design.target[0]), session.part(|s| s.design.target[1])];
    let set = move |at: [f64; 2]| {
        let on_grid = at.map(|v| ((v / STEP).round() * STEP).clamp(TARGETS.0, TARGETS.1));
        session.edit(|s| s.design.target = on_grid);
    };
    let spoken = move || {
        let (re, im, style) = (re.get(), im.get(), lab.number_style());
        format!("λ {} {} {}j", style.fixed(re, 2), if im < 0.0 { "−" } else { "+" }, style.fixed(im.abs(), 2))
    };
    view! {
        <PointHandle
            id="target-handle"
            label=say!(lab, relay.target_handle)
            at=Signal::derive(move || (re.get(), im.get()))
            value=re
            limits=TARGETS
            spoken=Signal::derive(spoken)
            locked=lab.locks(Control::Target)
            on_move=move |(x, y): (f64, f64)| set([x, y])
            on_nudge=move |by: Nudge| {
                let (re, im) = (re.get_untracked(), im.get_untracked());
                let page = if by.page.is_finite() { by.page } else { 0.0 };
                set([re + STEP * (by.right + page), im + STEP * (by.up + page)]);
            }
            frames
        />
    }
}

/// What the chosen root does, what to beware of, and whether all is well.
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let root = session.words.setup.with(|s| s.design.root);
    let found = session.words.design.get();
    let design = match found.as_ref() {
        Ok(Some(design)) => design,
        Ok(None) => return (false, tr!(lab, relay.no_point).to_owned()),
        Err(error) => return (false, errors::sentence(lab, error)),
    };
    let chosen = &design.roots[(root - 1).min(1)];
    let style = lab.number_style();
    let mut text = match chosen.stability {
        LoopStability::Stable => session.words.study.with(|study| {
            let Ok(margins) = study.as_ref().as_ref().map_err(|&e| e).and_then(|study| study.margins(chosen)) else {
                return String::new();
            };
            let Some(margins) = margins else { return tr!(lab, relay.margins_not_computed).to_owned() };
            let distance = style.significant(margins.distance, 3);
            let degrees = margins.phase.map_or_else(|| "–".to_owned(), |p| style.fixed(p.to_degrees(), 0));
            let gain = margins.gain_up.map_or_else(|| "∞".to_owned(), |g| style.significant(g, 3));
            tr!(lab, relay.stable, distance = distance, degrees = degrees, gain = gain).to_string()
        }),
        LoopStability::Unstable { poles } => tr!(lab, relay.unstable, poles = poles).to_string(),
        LoopStability::Marginal { .. } => tr!(lab, relay.marginal).to_owned(),
        LoopStability::NotComputed { .. } => tr!(lab, relay.not_computed).to_owned(),
    };
    if chosen.closure == Closure::Joint {
        text = text + " " + tr!(lab, relay.joint);
    }
    for &warning in &chosen.warnings {
        text = text + " " + &of_warning(lab, warning);
    }
    let gain = dynamic_relative_gain(&design.g);
    let sign = if gain.im < 0.0 { "−" } else { "+" };
    let gain = format!("{} {sign} {}j", style.fixed(gain.re, 3), style.fixed(gain.im.abs(), 3));
    text = text + " " + &tr!(lab, relay.dynamic_gain, gain = gain);
    let mild = |warning: &PlacementWarning| matches!(warning, PlacementWarning::DoubleEigenvalue);
    (chosen.stability == LoopStability::Stable && chosen.warnings.iter().all(mild), text)
}

fn of_warning(lab: Lab, warning: PlacementWarning) -> String {
    match warning {
        PlacementWarning::WrongSign { number } => tr!(lab, relay.warn_sign, number = number).to_string(),
        PlacementWarning::WrongIntegralSign { number } => {
            tr!(lab, relay.warn_integral_sign, number = number).to_string()
        }
        PlacementWarning::IntegralActionUnstable => tr!(lab, relay.warn_integral).to_owned(),
        PlacementWarning::AmbiguousRoot => tr!(lab, relay.warn_ambiguous).to_owned(),
        PlacementWarning::DoubleEigenvalue => tr!(lab, relay.warn_double).to_owned(),
        PlacementWarning::BeyondPi { number } => tr!(lab, relay.warn_beyond_pi, number = number).to_string(),
        PlacementWarning::OnMinusOne => tr!(lab, relay.warn_minus_one).to_owned(),
    }
}

/// The gains of both roots.
fn table(session: Session) -> String {
    let lab = session.lab;
    let chosen = session.words.setup.with(|s| s.design.root);
    let names = [tr!(lab, relay.col_root).to_owned(), "kp".to_owned(), "ki".to_owned(), "kd".to_owned()];
    let rows = session.words.with_design(|design| {
        let row = |(k, root): (usize, &DesignRoot)| rows_of_root(lab, k + 1, root, chosen == k + 1);
        design.roots.iter().enumerate().map(row).collect::<String>()
    });
    html::table(tr!(lab, relay.gains_caption), &names, &rows.unwrap_or_default())
}

fn rows_of_root(lab: Lab, number: usize, root: &DesignRoot, chosen: bool) -> String {
    let style = lab.number_style();
    let verdict = match root.stability {
        LoopStability::Stable => "✓",
        LoopStability::NotComputed { .. } => "?",
        LoopStability::Unstable { .. } | LoopStability::Marginal { .. } => "✗",
    };
    let row = |(k, pid): (usize, &quadtank::control::ParallelPid)| {
        let name = format!("{number}, p{} {verdict}", ["₁", "₂"][k]);
        let loop_class = ["loop1", "loop2"][k];
        let class = if chosen { format!("{loop_class} chosen") } else { loop_class.to_owned() };
        let gains = [pid.proportional, pid.integral, pid.derivative].map(|v| style.fixed(v, 4));
        html::row(&class, &name, &gains)
    };
    root.controllers.iter().enumerate().map(row).collect()
}
