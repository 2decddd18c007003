//! Step 3: the target of the placement in the plane of the loci and the controllers that follow, or given controllers.

use leptos::prelude::*;

use super::compared::SideBySide;
use super::details::OtherForms;
use super::errors;
use super::flags::{locks, panels};
use super::given::{GivenControllers, Origin, is_given};
use super::mends;
use super::pictures::{self, short_name};
use super::session::{Session, use_session};
use super::step::Step;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::lab::Lab;
use crate::texts::{say, symbol, terms, tr};
use crate::widgets::{Choice, Figures, Nudge, PointHandle, Row, Scale, Select, TableContent, Text};
use quadtank::linear::{LociClosure, LoopStability, Margins};
use quadtank::study::relay_tuning::{DesignRoot, LoopPeaks, TuningSetup, rule_targets};
use quadtank::tuning::{Action, PlacementMethod, PlacementWarning, TuningRule};
use quadtank_figure::Frame;

/// Step of the arrow keys, and the grid of dragging.
const STEP: f64 = 0.01;
/// Parts of the target that the handle reaches.
const TARGETS: (f64, f64) = (-10.0, 10.0);

const TARGET: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "target-re"), ("", "target-im")],
    label: |_, k| ["Re λ", "Im λ"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, relay.target_re) } else { tr!(lab, relay.target_im) },
    read: |s, k| s.design.target[k],
    write: |s, k, part| s.design.target[k] = part,
    path: |_, _| "design.target[]",
    scale: Some(Scale::Linear(STEP)),
    ..ParamControl::locked_by(locks::TARGET)
};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::locus, terms::target, terms::margins, terms::peak, terms::log_modulus];

/// The placement.
#[component]
pub fn PlacementCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    view! {
        <Step
            name="placement"
            panel=panels::PLACEMENT
            number=3
            terms=TERMS
            title=say!(lab, relay.placement)
            toolbar=move || view! { <span class="remark" hidden=session.throttled_part(is_given)>{say!(lab, relay.placement_remark)}</span> }
            picture=pictures::loci(session)
            frames
            place="chart square"
            overlay=move || {
                view! { <svg class="over"><Show when=move || session.read(|s| !is_given(s))><TargetHandle frames /></Show></svg> }
            }
            verdict=Signal::derive(move || sentence(session))
            offers=Signal::derive(move || mends::of_design(session, "mend-placement"))
            below=|| view! { <OtherForms /> <SideBySide /> }
        >
            <Settings />
        </Step>
    }
}

#[component]
fn Settings() -> impl IntoView {
    let session = use_session();
    let caption = Signal::derive(move || caption(session));
    view! {
        <Origin />
        <div class="stack" hidden=session.throttled_part(is_given)><PlacedControllers /></div>
        <div class="stack" hidden=session.throttled_part(|s| !is_given(s))><GivenControllers /></div>
        <Figures name="gains" caption>{move || table(session)}</Figures>
    }
}

/// Method, action, root and target of a placement.
#[component]
fn PlacedControllers() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let lock = locks::TARGET;
    view! {
        <Switch
            session
            label=say!(lab, relay.method)
            choices=vec![
                (PlacementMethod::OneLocus, "method-a", say!(lab, relay.method_a)),
                (PlacementMethod::BothLoci, "method-b", say!(lab, relay.method_b)),
            ]
            read=|s| s.design.method
            write=|s, method| s.design.method = method
            lock
        />
        <div class="pairs">
            <Switch
                session
                label=say!(lab, relay.action)
                choices=vec![(Action::Pi, "action-pi", symbol("PI")), (Action::Pid, "action-pid", symbol("PID"))]
                read=|s| s.design.action
                write=|s, action| s.design.action = action
                lock
            />
            <Switch
                session
                label=say!(lab, relay.roots)
                choices=vec![
                    (1, "root1", say!(lab, relay.root, number = 1)),
                    (2, "root2", say!(lab, relay.root, number = 2)),
                ]
                read=|s| s.design.root
                write=|s, root| s.design.root = root
                lock
            />
            <ParamRow session control=&TARGET index=0 />
            <ParamRow session control=&TARGET index=1 />
        </div>
        <RuleSelect />
    }
}

/// The targets of the rules, to take over.
#[component]
fn RuleSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let choices = Signal::derive(move || {
        let of_rule = |(rule, _)| {
            let name = short_name(rule);
            Choice::new(Some(rule), name, tr!(lab, relay.point_of_rule, rule = name))
        };
        let own = Choice::new(None, "", tr!(lab, relay.own_target));
        std::iter::once(own).chain(rule_targets().map(of_rule)).collect::<Vec<_>>()
    });
    let chosen = Signal::derive(move || {
        let target = session.document.with(|s| s.tuning.design.target);
        rule_targets().into_iter().find(|(_, at)| target == [at.re, at.im]).map(|(rule, _)| rule)
    });
    let choose = move |chosen: Option<TuningRule>| {
        if let Some((_, at)) = rule_targets().into_iter().find(|(rule, _)| Some(*rule) == chosen) {
            session.edit(|s| s.design.target = [at.re, at.im]);
        }
    };
    view! {
        <Select
            id="target-rule"
            name=say!(lab, relay.target_rule)
            choices
            chosen
            on_choose=choose
            disabled=lab.locks(locks::TARGET)
        />
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
            locked=lab.locks(locks::TARGET)
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

/// What the controllers at work do, what to beware of, and whether all is well.
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let is_given = session.throttled.setup.with(|s| is_given(s));
    let found = session.throttled.design.get();
    let design = match found.as_ref() {
        Ok(Some(design)) => design,
        Ok(None) => return (false, tr!(lab, relay.no_point)),
        Err(error) => return (false, errors::sentence(lab, error)),
    };
    let chosen = design.chosen_root();
    let style = lab.number_style();
    let mut text = match session.throttled.critical.get() {
        Err(_) if chosen.stability == LoopStability::Stable => String::new(),
        reading => {
            let reading = reading.ok();
            let margins = reading.as_ref().and_then(|reading| reading.margins);
            of_loop(lab, chosen.stability, margins, reading.and_then(|reading| reading.peaks))
        }
    };
    if chosen.closure == LociClosure::Joint {
        text = text + " " + &tr!(lab, relay.joint);
    }
    for &warning in &chosen.warnings {
        text = text + " " + &of_warning(lab, warning);
    }
    if let (false, Some(critical)) = (is_given, design.critical) {
        let gain = critical.dynamic_relative_gain_11;
        let sign = if gain.im < 0.0 { "−" } else { "+" };
        let gain = format!("{} {sign} {}j", style.fixed(gain.re, 3), style.fixed(gain.im.abs(), 3));
        text = text + " " + &tr!(lab, relay.dynamic_gain, gain = gain);
    }
    let mild = |warning: &PlacementWarning| matches!(warning, PlacementWarning::DoubleEigenvalue);
    (chosen.stability == LoopStability::Stable && chosen.warnings.iter().all(mild), text)
}

/// Sentence on stability and margins of a closed loop.
pub fn of_loop(lab: Lab, stability: LoopStability, margins: Option<Margins>, peaks: Option<LoopPeaks>) -> String {
    let style = lab.number_style();
    match stability {
        LoopStability::Stable => {
            let Some(margins) = margins else { return tr!(lab, relay.margins_not_computed) };
            let distance = style.significant(margins.distance, 3);
            let degrees = margins.phase.map_or_else(|| "–".to_owned(), |p| style.fixed(p.to_degrees(), 0));
            let gain = margins.gain_up.map_or_else(|| "∞".to_owned(), |g| style.significant(g, 3));
            tr!(lab, relay.stable, distance = distance, degrees = degrees, gain = gain) + &of_peaks(lab, peaks)
        }
        LoopStability::Unstable { poles } => tr!(lab, relay.unstable, poles = poles),
        LoopStability::Marginal { .. } => tr!(lab, relay.marginal),
        LoopStability::NotComputed { .. } => tr!(lab, relay.not_computed),
        LoopStability::AlgebraicLoop { eigenvalue } => {
            tr!(lab, relay.algebraic_loop, eigenvalue = style.significant(eigenvalue, 3))
        }
    }
}

/// Biggest log modulus and sensitivity peak, after the margins; nothing where they are not computed.
fn of_peaks(lab: Lab, peaks: Option<LoopPeaks>) -> String {
    let Some(LoopPeaks { sensitivity: Some(sensitivity), log_modulus: Some(modulus) }) = peaks else {
        return String::new();
    };
    let style = lab.number_style();
    let (modulus, peak) = (style.fixed(modulus.value, 2), style.fixed(sensitivity.value, 2));
    " ".to_owned() + &tr!(lab, relay.peaks, modulus = modulus, peak = peak)
}

fn of_warning(lab: Lab, warning: PlacementWarning) -> String {
    match warning {
        PlacementWarning::WrongSign { number } => tr!(lab, relay.warn_sign, number = number),
        PlacementWarning::WrongIntegralSign { number } => {
            tr!(lab, relay.warn_integral_sign, number = number)
        }
        PlacementWarning::IntegralActionUnstable => tr!(lab, relay.warn_integral),
        PlacementWarning::AmbiguousRoot => tr!(lab, relay.warn_ambiguous),
        PlacementWarning::DoubleEigenvalue => tr!(lab, relay.warn_double),
        PlacementWarning::BeyondPi { number } => tr!(lab, relay.warn_beyond_pi, number = number),
        PlacementWarning::OnMinusOne => tr!(lab, relay.warn_minus_one),
    }
}

fn caption(session: Session) -> String {
    let lab = session.lab;
    if session.throttled.setup.with(|s| is_given(s)) {
        tr!(lab, relay.given_caption)
    } else {
        tr!(lab, relay.gains_caption)
    }
}

/// The gains of both roots, or of given controllers.
fn table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let columns = [&*tr!(lab, relay.col_root), "kp", "ki", "kd"].map(str::to_owned).to_vec();
    let rows = session.throttled.with_design(|design| {
        let roots = design.roots.iter().enumerate();
        let is_alone = design.roots.len() == 1;
        let rows = |(index, root): (usize, &DesignRoot)| {
            let number = (!is_alone).then_some(index + 1);
            rows_of_root(lab, number, root, !is_alone && index == design.chosen)
        };
        roots.flat_map(rows).collect::<Vec<_>>()
    });
    view! { <TableContent caption=caption(session) columns rows=rows.unwrap_or_default() /> }
}

/// Rows of a root with its number; given controllers have none.
fn rows_of_root(lab: Lab, number: Option<usize>, root: &DesignRoot, chosen: bool) -> [AnyView; 2] {
    let style = lab.number_style();
    let verdict = match root.stability {
        LoopStability::Stable => "✓",
        LoopStability::NotComputed { .. } => "?",
        LoopStability::Unstable { .. } | LoopStability::Marginal { .. } | LoopStability::AlgebraicLoop { .. } => "✗",
    };
    [0, 1].map(|k| {
        let pid = &root.controllers[k];
        let number = number.map_or_else(String::new, |number| format!("{number}, "));
        let name = format!("{number}p{} {verdict}", ["₁", "₂"][k]);
        let loop_class = ["loop1", "loop2"][k];
        let class = if chosen { format!("{loop_class} chosen") } else { loop_class.to_owned() };
        let figures = [pid.proportional, pid.integral, pid.derivative].map(|v| style.fixed(v, 4));
        view! { <Row class name figures /> }.into_any()
    })
}
