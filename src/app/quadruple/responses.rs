//! The step responses: levels and pump voltages, with cursor, zoom, pinned runs, metrics and a data table.

use leptos::ev::{KeyboardEvent, PointerEvent, WheelEvent};
use leptos::prelude::*;

use super::metrics::MetricsTable;
use super::moment::{Moment, use_moment};
use super::pictures;
use super::set_points::SetPoints;
use crate::app::lab::{Lab, use_lab};
use crate::app::shown::{length_digits, to_shown, unit_name};
use crate::app::texts::{say, tr};
use crate::app::widgets::{ChartCanvas, ChartMenu, Picture, rich};
use crate::figure::{Frame, Table, table};
use crate::scenario::Scenario;
use crate::sim::{EventKind, LoopMetrics, Settling, Stability};

/// Share of the shown time that an arrow key moves the cursor, and with Shift.
const CURSOR_STEPS: (f64, f64) = (0.005, 0.05);
/// How much of the shown time remains after zooming in once.
const ZOOM: f64 = 0.6;
/// The shortest stretch of time that can be shown (s).
const SHORTEST_S: f64 = 5.0;
/// A drag shorter than this (CSS px) moves the cursor; a longer one selects what to zoom into.
const DRAG_PX: f64 = 6.0;
/// Rows of the data table.
const TABLE_ROWS: usize = 25;

/// The step responses.
#[component]
pub fn ResponsesCard() -> impl IntoView {
    let lab = use_lab();
    let frames = RwSignal::new(Vec::<Frame>::new());
    let held = RwSignal::new(None);
    let picture = pictures::responses(lab, held);
    let table_picture = picture.clone();
    let title = say!(lab, responses.title);
    let summary = say!(lab, responses.summary, sentence = sentence(lab).replace("**", ""));
    view! {
        <section class="card responses" aria-labelledby="responses-title">
            <header>
                <h2 id="responses-title">{title}</h2>
                <Toolbar />
                <ChartMenu picture=picture.clone() file="responses" title />
            </header>
            <div class="charts">
                <div class="chart">
                    <ChartCanvas picture frames summary name="responses" />
                    <Surface frames />
                    <SetPoints frames held />
                </div>
            </div>
            <p class="sentence" role="status" data-testid="responses-sentence">{move || rich(&sentence(lab))}</p>
            <MetricsTable />
            <DataTable picture=table_picture />
        </section>
    }
}

#[component]
fn Toolbar() -> impl IntoView {
    let lab = use_lab();
    let pinned = lab.words.pinned;
    let count = move || pinned.with(|p| p.len());
    let pin = move |_| {
        lab.scenario.update(|s| {
            let setup = s.setup.clone();
            s.pinned.push(setup);
            if s.pinned.len() > Scenario::MAX_PINNED {
                s.pinned.remove(0);
            }
        });
    };
    let linear = move || lab.scenario.with(|s| !s.view.hide_linear);
    view! {
        <div class="toolbar">
            <button type="button" class="button small" data-testid="pin" on:click=pin>{say!(lab, responses.pin)}</button>
            {move || (count() > 0).then(|| view! {
                <button type="button" class="button small" data-testid="unpin" on:click=move |_| lab.scenario.update(|s| s.pinned.clear())>
                    {tr!(lab, responses.unpin)}
                </button>
            })}
            <button
                type="button"
                class="button small"
                data-testid="linear"
                aria-pressed=move || if linear() { "true" } else { "false" }
                on:click=move |_| lab.scenario.update(|s| s.view.hide_linear = !s.view.hide_linear)
            >
                {say!(lab, responses.hide_linear)}
            </button>
            <button type="button" class="button small" data-testid="zoom-in" aria-label=say!(lab, responses.zoom_in) on:click=move |_| zoom(lab, ZOOM, None)>"+"</button>
            <button type="button" class="button small" data-testid="zoom-out" aria-label=say!(lab, responses.zoom_out) on:click=move |_| zoom(lab, 1.0 / ZOOM, None)>"−"</button>
            <button type="button" class="button small" data-testid="zoom-reset" on:click=move |_| show(lab, None)>{say!(lab, responses.zoom_reset)}</button>
        </div>
    }
}

/// The shown stretch of time (s).
fn window_s(lab: Lab) -> (f64, f64) {
    lab.scenario.with_untracked(|s| s.view.zoom_s.map_or((0.0, s.setup.experiment.duration_s), Into::into))
}

fn show(lab: Lab, stretch: Option<(f64, f64)>) {
    lab.scenario.update(|s| {
        let end = s.setup.experiment.duration_s;
        s.view.zoom_s = stretch.and_then(|(from, to)| {
            let length = (to - from).clamp(SHORTEST_S.min(end), end);
            let from = from.clamp(0.0, end - length);
            (length < end * 0.999).then_some([from, from + length])
        });
    });
}

/// Shows `factor` times as much, about `centre`; where it is not given about the cursor, else the first step in sight, else
/// the middle.
fn zoom(lab: Lab, factor: f64, centre: Option<f64>) {
    let (from, to) = window_s(lab);
    let cursor = lab.scenario.with_untracked(|s| s.view.cursor_s).filter(|t| (from..=to).contains(t));
    let step = lab.scenario.with_untracked(|s| {
        let times = s.setup.experiment.set_point_steps.iter().map(|step| step.time_s);
        times.filter(|t| (from..=to).contains(t)).reduce(f64::min)
    });
    let centre = centre.or(cursor).or(step).unwrap_or(f64::midpoint(from, to));
    show(lab, Some((centre - (centre - from) * factor, centre + (to - centre) * factor)));
}

fn set_cursor(lab: Lab, time_s: Option<f64>) {
    lab.scenario.update(|s| {
        let end = s.setup.experiment.duration_s;
        s.view.cursor_s = time_s.map(|t| t.clamp(0.0, end));
    });
}

/// What lies over the charts: the cursor with its values, and whatever mouse, finger and keyboard do to them.
#[component]
fn Surface(frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let lab = use_lab();
    let drag = RwSignal::new(None::<(f64, f64)>);
    let cursor = Memo::new(move |_| lab.scenario.with(|s| s.view.cursor_s));
    let frame = move || frames.with(|f| f.first().copied());
    let plots = move || frames.with(|f| Some((f.first()?.plot.top, f.last()?.plot.bottom())));
    let x_of = move |event: &PointerEvent| {
        let target = event_target::<web_sys::Element>(event);
        f64::from(event.client_x()) - target.get_bounding_client_rect().left()
    };
    let time_at = move |x: f64| untrack(frame).map(|f| f.to_data((x, 0.0)).0);
    let on_down = move |event: PointerEvent| {
        let x = x_of(&event);
        let _ = event_target::<web_sys::Element>(&event).set_pointer_capture(event.pointer_id());
        drag.set(Some((x, x)));
        set_cursor(lab, time_at(x));
    };
    let on_move = move |event: PointerEvent| {
        let x = x_of(&event);
        match drag.get_untracked() {
            Some((from, _)) => drag.set(Some((from, x))),
            None if event.pointer_type() == "mouse" => set_cursor(lab, time_at(x)),
            None => {}
        }
    };
    let on_up = move |event: PointerEvent| {
        if let Some((from, to)) = drag.try_update(Option::take).flatten()
            && (to - from).abs() > DRAG_PX
            && event.pointer_type() == "mouse"
            && let (Some(a), Some(b)) = (time_at(from.min(to)), time_at(from.max(to)))
        {
            show(lab, Some((a, b)));
        }
    };
    let on_wheel = move |event: WheelEvent| {
        if event.ctrl_key() {
            event.prevent_default();
            zoom(lab, if event.delta_y() < 0.0 { ZOOM } else { 1.0 / ZOOM }, cursor.get_untracked());
        }
    };
    let on_key = move |event: KeyboardEvent| {
        let (from, to) = window_s(lab);
        let step = (to - from) * if event.shift_key() { CURSOR_STEPS.1 } else { CURSOR_STEPS.0 };
        let at = cursor.get_untracked().unwrap_or(from);
        match event.key().as_str() {
            "ArrowLeft" => set_cursor(lab, Some(at - step)),
            "ArrowRight" => set_cursor(lab, Some(at + step)),
            "Home" => set_cursor(lab, Some(from)),
            "End" => set_cursor(lab, Some(to)),
            "+" | "=" => zoom(lab, ZOOM, None),
            "-" => zoom(lab, 1.0 / ZOOM, None),
            "0" => show(lab, None),
            "Escape" => set_cursor(lab, None),
            _ => return,
        }
        event.prevent_default();
    };
    let line = move || {
        let (frame, (top, bottom)) = (frame()?, plots()?);
        let x = frame.x_px(cursor.get()?);
        (frame.plot.left..=frame.plot.right())
            .contains(&x)
            .then(|| view! { <line class="cursor-line" x1=x x2=x y1=top y2=bottom /> })
    };
    let band = move || {
        let ((top, bottom), (from, to)) = (plots()?, drag.get()?);
        ((to - from).abs() > DRAG_PX).then(|| {
            view! { <rect class="zoom-band" x=from.min(to) width=(to - from).abs() y=top height=bottom - top /> }
        })
    };
    view! {
        <svg
            class="over surface"
            tabindex="0"
            role="slider"
            data-testid="responses-surface"
            aria-label=say!(lab, responses.cursor)
            aria-valuemin="0"
            aria-valuemax=move || lab.scenario.with(|s| s.setup.experiment.duration_s).to_string()
            aria-valuenow=move || cursor.get().unwrap_or(0.0).to_string()
            aria-valuetext=move || readout_text(lab)
            on:pointerdown=on_down
            on:pointermove=on_move
            on:pointerup=on_up
            on:pointercancel=move |_| drag.set(None)
            on:pointerleave=move |event: PointerEvent| if event.pointer_type() == "mouse" && drag.get_untracked().is_none() { set_cursor(lab, None) }
            on:wheel=on_wheel
            on:keydown=on_key
        >
            {band}
            {line}
        </svg>
        <Readout frames />
    }
}

/// The values at the cursor, beside it on whichever side has room.
#[component]
fn Readout(frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let lab = use_lab();
    let moment = use_moment();
    let content = move || {
        let frame = frames.with(|f| f.first().copied())?;
        let m = moment.get()?;
        let share = (frame.x_px(m.time_s?) - frame.outer.left) / frame.outer.width;
        let (left, right) = if share < 0.5 {
            (format!("{:.1}%", 100.0 * share + 1.5), "auto".to_owned())
        } else {
            ("auto".to_owned(), format!("{:.1}%", 101.5 - 100.0 * share))
        };
        Some(view! {
            <div class="readout" data-testid="readout" aria-hidden="true" style:left=left style:right=right>
                {readout_rows(lab, &m)}
            </div>
        })
    };
    view! { {content} }
}

fn readout_rows(lab: Lab, m: &Moment) -> impl IntoView + use<> {
    let style = lab.number_style();
    let unit = lab.unit.get();
    let level = |k: usize| {
        format!(
            "h{} {} {}",
            ["₁", "₂"][k],
            style.fixed(to_shown(m.levels[k], unit), length_digits(unit)),
            unit_name(unit)
        )
    };
    let pump = |k: usize| format!("v{} {} V", ["₁", "₂"][k], style.fixed(m.pump_voltage[k], 2));
    view! {
        <div>{format!("t = {} s", style.fixed(m.time_s.unwrap_or(0.0), 0))}</div>
        <div><span class="loop1">{level(0)}</span>" · "<span class="loop2">{level(1)}</span></div>
        <div><span class="loop1">{pump(0)}</span>" · "<span class="loop2">{pump(1)}</span></div>
    }
}

fn readout_text(lab: Lab) -> Option<String> {
    let m = use_context::<Memo<Option<Moment>>>()?.get()?;
    let style = lab.number_style();
    let unit = lab.unit.get();
    let level = |k: usize| style.fixed(to_shown(m.levels[k], unit), length_digits(unit));
    m.time_s.map(|t| {
        format!(
            "t = {} s: h₁ {} {u}, h₂ {} {u}, v₁ {} V, v₂ {} V",
            style.fixed(t, 0),
            level(0),
            level(1),
            style.fixed(m.pump_voltage[0], 2),
            style.fixed(m.pump_voltage[1], 2),
            u = unit_name(unit)
        )
    })
}

/// What the run says, in words: how each stepped level did, then what went wrong first.
fn sentence(lab: Lab) -> String {
    lab.words.run.with(|outcome| {
        let Ok(run) = outcome.as_ref() else { return tr!(lab, responses.none).to_string() };
        let mut parts: Vec<String> =
            run.metrics.iter().enumerate().filter_map(|(k, m)| of_metrics(lab, k, m)).collect();
        let unstable = lab.words.with_analysis(|a| a.closed_loop.stability == Stability::Unstable);
        if unstable == Some(true) {
            parts = vec![tr!(lab, responses.unstable).to_string()];
        } else if parts.is_empty() {
            parts.push(tr!(lab, responses.sentence_still).to_string());
        } else if lab.words.setup.with(|s| s.experiment.is_disturbed()) {
            parts.push(tr!(lab, responses.disturbed).to_string());
        }
        parts.extend(run.nonlinear.events.iter().take(2).map(|event| {
            let time = lab.number_style().fixed(event.time_s, 0);
            match event.kind {
                EventKind::Overflow { tank } => {
                    tr!(lab, responses.event_overflow, tank = tank + 1, time = time).to_string()
                }
                EventKind::Empty { tank } => tr!(lab, responses.event_empty, tank = tank + 1, time = time).to_string(),
                EventKind::Saturated { pump } => {
                    tr!(lab, responses.event_saturated, pump = pump + 1, time = time).to_string()
                }
            }
        }));
        parts.join(" ")
    })
}

fn of_metrics(lab: Lab, index: usize, metrics: &LoopMetrics) -> Option<String> {
    let style = lab.number_style();
    let unit = lab.unit.get();
    metrics.step_time_s?;
    let cross = style.fixed(to_shown(metrics.other_peak, unit), length_digits(unit));
    let (level, other) = (index + 1, 2 - index);
    Some(match metrics.settling_2_percent? {
        Settling::After { time_s } => {
            // As many digits as in the table below.
            let percent = 100.0 * metrics.overshoot.unwrap_or(0.0);
            let overshoot = if percent < 0.05 {
                tr!(lab, responses.without_overshoot).to_string()
            } else {
                let share = format!("{}\u{a0}%", style.fixed(percent, 1));
                tr!(lab, responses.with_overshoot, share = share).to_string()
            };
            let time = style.significant(time_s, 3);
            tr!(
                lab,
                responses.sentence_settles,
                level = level,
                time = time,
                overshoot = overshoot,
                other = other,
                cross = cross,
                unit = unit_name(unit)
            )
            .to_string()
        }
        Settling::Never => {
            tr!(lab, responses.sentence_never, level = level, other = other, cross = cross, unit = unit_name(unit))
                .to_string()
        }
    })
}

/// The run as numbers, for those who do not see the picture; computed only while it is open.
#[component]
fn DataTable(picture: Picture) -> impl IntoView {
    let lab = use_lab();
    let open = RwSignal::new(false);
    let content = move || {
        let style = lab.number_style();
        let Table { columns, rows } = picture.visit(|charts| table(charts, TABLE_ROWS));
        let headings = columns.into_iter().map(|name| view! { <th scope="col">{name}</th> }).collect_view();
        let rows = rows
            .into_iter()
            .map(|row| {
                let cells =
                    row.into_iter().map(|value| view! { <td>{style.significant(value, 4)}</td> }).collect_view();
                view! { <tr>{cells}</tr> }
            })
            .collect_view();
        view! {
            <div class="scroll" tabindex="0" role="region" aria-label=tr!(lab, responses.table_caption)>
                <table class="plain">
                    <caption class="visually-hidden">{tr!(lab, responses.table_caption)}</caption>
                    <thead><tr>{headings}</tr></thead>
                    <tbody>{rows}</tbody>
                </table>
            </div>
        }
    };
    view! {
        <details class="more" on:toggle=move |_| open.update(|o| *o = !*o)>
            <summary data-testid="data-table">{say!(lab, responses.table)}</summary>
            {move || open.get().then(content.clone())}
        </details>
    }
}
