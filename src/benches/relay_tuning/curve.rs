//! Step 2: the critical curve, and the point on it that the placement starts from.

use leptos::ev::MouseEvent;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;

use super::errors;
use super::flags::{locks, panels};
use super::mends;
use super::pictures;
use super::session::{Session, time_unit, use_session};
use super::step::Step;
use crate::controls::{ParamControl, ParamRow};
use crate::texts::{say, terms, tr};
use crate::widgets::{Figures, Nudge, PointHandle, Row, TableContent, Text, first_frame};
use quadtank::study::relay_tuning::{CriticalSpec, TuningSetup};
use quadtank::tuning::GainLimit;
use quadtank_figure::Frame;

/// Importances that the slider covers.
const IMPORTANCES: (f64, f64) = (0.001, 1000.0);
/// Ratio of one step of the arrow keys.
const STEP: f64 = 1.05;

const IMPORTANCE: ParamControl<TuningSetup> = ParamControl {
    ids: [("importance", "importance-number"); 2],
    label: |_, _| "r₂".to_owned(),
    name: |lab, _| tr!(lab, relay.importance),
    read: |s, _| importance(s),
    write: |s, _, r| s.design.critical = CriticalSpec::Importance(r),
    path: |_, _| "design.critical.importance",
    travel: Some(|_| IMPORTANCES),
    ..ParamControl::locked_by(locks::POINT)
};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::critical_curve, terms::importance, terms::ultimate];

/// The critical curve.
#[component]
pub fn CurveCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let chosen = Signal::from(Memo::new(move |_| pictures::chosen_point(session.charts)));
    view! {
        <Step
            name="curve"
            panel=panels::CURVE
            number=2
            terms=TERMS
            title=say!(lab, relay.curve)
            toolbar=move || view! { <span class="remark">{say!(lab, relay.curve_remark)}</span> }
            picture=pictures::curve(session, chosen)
            frames
            overlay=move || view! { <Plane frames chosen /> }
            verdict=Signal::derive(move || sentence(session))
            offers=Signal::derive(move || mends::of_curve(session))
        >
            <ParamRow session control=&IMPORTANCE />
            <Figures name="critical-point" caption=say!(lab, relay.curve_caption)>{move || table(session)}</Figures>
            <span class="remark">{say!(lab, relay.importance_formula)}</span>
        </Step>
    }
}

/// Magnitude of r2 of the critical point; none where it is 0/0, as for gains of zero.
fn known_importance(setup: &TuningSetup) -> Option<f64> {
    setup.importance().ok().filter(|r| !r.is_nan()).map(f64::abs)
}

/// r2 of the critical point as the slider shows it, 1 where there is none.
fn importance(setup: &TuningSetup) -> f64 {
    known_importance(setup).map_or(1.0, |r| r.clamp(IMPORTANCES.0, IMPORTANCES.1))
}

/// The chosen point, and the plane around it: a click anywhere, on an estimate say, chooses the importance there.
#[component]
fn Plane(frames: RwSignal<Vec<Frame>>, chosen: Signal<Option<(f64, f64)>>) -> impl IntoView {
    let session = use_session();
    let on_click = move |event: MouseEvent| {
        let drawing = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
        // A click on the point itself ends a drag.
        let Some(drawing) = drawing.filter(|drawing| drawing.tag_name() == "svg") else { return };
        let corner = drawing.get_bounding_client_rect();
        let at = (f64::from(event.client_x()) - corner.left(), f64::from(event.client_y()) - corner.top());
        choose(session, untrack(|| first_frame(frames)).to_data(at));
    };
    view! { <svg class="over" on:click=on_click><CriticalHandle frames chosen /></svg> }
}

/// Starts the placement from the importance of a point of the plane.
fn choose(session: Session, (x, y): (f64, f64)) {
    set_importance(session, y.max(0.0) / x.max(f64::MIN_POSITIVE));
}

fn set_importance(session: Session, r: f64) {
    if r.is_finite() && !session.lab.locks(locks::POINT) {
        session.edit(|s| s.design.critical = CriticalSpec::Importance(r.clamp(IMPORTANCES.0, IMPORTANCES.1)));
    }
}

/// The chosen point: dragged to another importance, moved along the curve by keys.
#[component]
fn CriticalHandle(frames: RwSignal<Vec<Frame>>, chosen: Signal<Option<(f64, f64)>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let value = session.part(importance);
    let known = Signal::derive(move || session.document.with(|s| known_importance(&s.tuning)));
    let spoken = move || match known.get() {
        Some(r) if r.is_infinite() => "r₂ ∞".to_owned(),
        Some(r) => format!("r₂ {}", lab.number_style().significant(r, 3)),
        None => tr!(lab, relay.no_importance),
    };
    let at = Signal::derive(move || chosen.get().unwrap_or((0.0, 0.0)));
    view! {
        <PointHandle
            id="critical-handle"
            label=say!(lab, relay.critical_handle)
            at
            value
            limits=IMPORTANCES
            spoken=Signal::derive(spoken)
            locked=lab.locks(locks::POINT)
            on_move=move |place: (f64, f64)| choose(session, place)
            on_nudge=move |by: Nudge| {
                let steps = (by.up - by.right + by.page).clamp(-200.0, 200.0);
                set_importance(session, value.get_untracked() * STEP.powf(steps));
            }
            frames
        />
    }
}

/// What bounds the gains in the chosen direction, and whether all is well.
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let reading = match session.throttled.critical.get() {
        Ok(reading) => reading,
        Err(error) => return (false, errors::sentence(lab, &error)),
    };
    let style = lab.number_style();
    let unit = session.throttled.setup.with(|s| time_unit(&s.plant));
    let mut sentence = match reading.limit {
        GainLimit::Oscillation(point) => {
            (true, tr!(lab, relay.ultimate, period = style.significant(point.period(), 4), unit = unit))
        }
        GainLimit::RealPole { .. } => (false, tr!(lab, relay.real_pole)),
        GainLimit::AlgebraicLoop { .. } => (false, tr!(lab, relay.limit_at_infinity)),
        GainLimit::None => (false, tr!(lab, relay.no_ultimate)),
    };
    let study = session.throttled.study.get();
    if let Some(corner) = study.as_ref().as_ref().ok().and_then(|study| study.curve.corners.first()) {
        let [slow, quick] = corner.points.map(|point| style.significant(point.period(), 4));
        let importance = style.significant(corner.importance, 3);
        sentence.1 += " ";
        sentence.1 += &tr!(lab, relay.corner_at, importance = importance, slow = slow, quick = quick, unit = unit);
    }
    sentence
}

/// Gains and period of the chosen point as it is in the document, and where the curve is in its direction.
fn table(session: Session) -> Option<impl IntoView> {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.throttled.setup.with(|s| time_unit(&s.plant));
    let on_curve = session.throttled.critical.with(|reading| reading.as_ref().ok()?.on_curve);
    let (gains, frequency, period) = session
        .throttled
        .with_design(|design| design.critical)
        .flatten()
        .map(|at| (at.gains, at.frequency, at.period()))?;
    let number = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| style.significant(v, 4));
    let row = |name: String, chosen: f64, curve: Option<f64>| {
        view! { <Row name figures=[number(Some(chosen)), number(curve)] /> }.into_any()
    };
    let rows = vec![
        row("kc₁".to_owned(), gains[0], on_curve.map(|p| p.gains[0])),
        row("kc₂".to_owned(), gains[1], on_curve.map(|p| p.gains[1])),
        row(format!("Tc ({unit})"), period, on_curve.map(|p| p.period())),
        row(format!("ωc (rad/{unit})"), frequency, on_curve.map(|p| p.frequency)),
    ];
    let columns = vec![tr!(lab, process.quantity), tr!(lab, relay.col_chosen), tr!(lab, relay.col_curve)];
    Some(view! { <TableContent caption=tr!(lab, relay.curve_caption) columns rows /> })
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadtank_scenario::tuning::TuningScenario;

    fn with_gains(gains: [f64; 2]) -> TuningSetup {
        let mut setup = TuningScenario::default().tuning;
        setup.design.critical = CriticalSpec::Point { gains, period: 10.0 };
        setup
    }

    #[test]
    fn the_slider_has_a_number_for_any_critical_point() {
        assert_eq!(known_importance(&with_gains([0.0, 0.0])), None);
        for gains in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [-1e-300, 1e300], [1e-6, -1e6], [-0.0, -1.0]] {
            let r = importance(&with_gains(gains));
            assert!((IMPORTANCES.0..=IMPORTANCES.1).contains(&r), "{gains:?} gives {r}");
        }
    }
}
