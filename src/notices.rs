//! Notices over the page: what happened to a link or a file, and what can be done about it.

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use quadtank::literature::DisplayUnit;
use quadtank_scenario::{ScenarioError, Scenes, document_from_link};

use super::benches::{load, name_of};
use super::errors::of_error;
use super::keep;
use super::lab::{Lab, Notice, use_lab};
use super::lessons::{LoadError, SidePage};
use super::offline;
use super::scenes;
use super::share;
use super::texts::tr;

/// How long a notice stays that needs no answer (ms): it lies over the page.
const PASSING_MS: u32 = 10_000;

/// What happened to a link or a file.
#[component]
pub fn Notices() -> impl IntoView {
    let lab = use_lab();
    let passing = StoredValue::new_local(None::<Timeout>);
    Effect::new(move || {
        let goes = matches!(
            lab.notice.get(),
            Some(
                Notice::Copied
                    | Notice::CopiedFileLink
                    | Notice::TableCopied
                    | Notice::Loaded(_)
                    | Notice::SceneAdded(_)
                    | Notice::ValvesOf(_)
                    | Notice::DeadTimeAdded(_)
            )
        );
        let close = move || lab.notice.set(None);
        passing.set_value(goes.then(|| Timeout::new(PASSING_MS, close)));
    });
    view! {
        <div role="status" aria-live="polite" class="notices">
            {move || lab.notice.get().map(|notice| {
                let is_bad = matches!(notice, Notice::Refused(_) | Notice::NotWritten(_) | Notice::NoLesson(_) | Notice::NotRead | Notice::NotUnderstood(_) | Notice::NotKept { .. } | Notice::TableNotCopied);
                let class = if is_bad { "notice" } else { "notice good" };
                view! {
                    <div class=class data-testid="notice">
                        {content(lab, notice)}
                        <button
                            type="button"
                            class="button small"
                            aria-label=tr!(lab, app.close)
                            on:click=move |_| lab.notice.set(None)
                        >
                            "✕"
                        </button>
                    </div>
                }
            })}
        </div>
    }
}

fn see_scenes(lab: Lab) {
    lab.notice.set(None);
    share::go_to_page(lab, SidePage::Scenes);
}

/// A sentence on scenes that are not in the list any more, and the way back to them.
fn bring_back(lab: Lab, said: String, name: String, former: Scenes) -> AnyView {
    view! {
        <div>{said}</div>
        <button type="button" class="button small" data-testid="bring-back" on:click=move |_| scenes::bring_back(lab, former.clone())>
            {name}
        </button>
    }
    .into_any()
}

/// What a notice says, and what can be done about it.
fn content(lab: Lab, notice: Notice) -> AnyView {
    match notice {
        Notice::Refused(error) => view! { <div>{tr!(lab, refused.lead)} " " {of_error(lab, DisplayUnit::Cm, &error)}</div> }.into_any(),
        // This sentence says all of it.
        Notice::NotWritten(error @ ScenarioError::NoLink { .. }) => view! { <div>{of_error(lab, DisplayUnit::Cm, &error)}</div> }.into_any(),
        Notice::NotWritten(error) => view! { <div>{tr!(lab, refused.not_written)} " " {of_error(lab, DisplayUnit::Cm, &error)}</div> }.into_any(),
        Notice::NewEdition => view! {
            <div>{tr!(lab, app.new_edition)}</div>
            <button type="button" class="button small" data-testid="begin-anew" on:click=|_| offline::begin_anew()>
                {tr!(lab, app.begin_anew)}
            </button>
        }
        .into_any(),
        Notice::NoLesson(LoadError::Refused(error)) => {
            view! { <div>{tr!(lab, lesson.refused)} " " {of_error(lab, DisplayUnit::Cm, &error)}</div> }.into_any()
        }
        Notice::NoLesson(LoadError::Unknown(id)) => view! { <div>{tr!(lab, lesson.unknown, id = id)}</div> }.into_any(),
        Notice::NoLesson(LoadError::NotAtHand(id)) => view! { <div>{tr!(lab, lesson.not_at_hand, id = id)}</div> }.into_any(),
        Notice::NoLesson(LoadError::NotArrived(name)) => view! { <div>{tr!(lab, lesson.not_arrived, name = name)}</div> }.into_any(),
        Notice::NotRead => view! { <div>{tr!(lab, refused.not_read)}</div> }.into_any(),
        Notice::NotUnderstood(names) => view! { <div>{tr!(lab, app.not_understood, names = names.join(", "))}</div> }.into_any(),
        Notice::Copied => view! { <div>{tr!(lab, app.copied)}</div> }.into_any(),
        Notice::CopiedFileLink => view! { <div>{tr!(lab, app.copied_file_link)}</div> }.into_any(),
        Notice::TableCopied => view! { <div>{tr!(lab, chart.copied)}</div> }.into_any(),
        Notice::TableNotCopied => view! { <div>{tr!(lab, chart.not_copied)}</div> }.into_any(),
        Notice::CopyByHand(link) => view! {
            <div>
                {tr!(lab, app.copy_by_hand)}
                <input type="text" class="text-field" readonly data-testid="link" aria-label=tr!(lab, app.share) value=link />
            </div>
        }
        .into_any(),
        Notice::Continue(link) => view! {
            <div>{tr!(lab, app.last)} " " {name_of_bench(lab, &link)}</div>
            <button type="button" class="button small" data-testid="continue" on:click=move |_| go_on(lab, &link)>
                {tr!(lab, app.go_on)}
            </button>
        }
        .into_any(),
        Notice::SceneAdded(number) => view! {
            <div>{tr!(lab, scenes.added, number = number)}</div>
            <button type="button" class="button small" data-testid="see-scenes" on:click=move |_| see_scenes(lab)>
                {tr!(lab, scenes.see)}
            </button>
        }
        .into_any(),
        Notice::SceneRemoved(former) => bring_back(lab, tr!(lab, scenes.removed), tr!(lab, app.undo), former),
        Notice::ScenesReplaced(former) => bring_back(lab, tr!(lab, scenes.replaced), tr!(lab, scenes.bring_back), former),
        Notice::Loaded(name) => view! {
            <div>{tr!(lab, app.loaded, name = name)}</div>
            <button type="button" class="button small" data-testid="undo-load" on:click=move |_| undo_load(lab)>
                {tr!(lab, app.undo)}
            </button>
        }
        .into_any(),
        Notice::ValvesOf(id) => view! {
            <div>{tr!(lab, valves.moved, name = name_of(lab, id))}</div>
            <button type="button" class="button small" data-testid="load-all" on:click=move |_| load(lab.session(), id)>
                {tr!(lab, valves.load_all)}
            </button>
        }
        .into_any(),
        Notice::DeadTimeAdded(dead_time_s) => {
            let time = lab.number_style().fixed(dead_time_s, 0);
            view! { <div>{tr!(lab, handover.dead_time, time = time)}</div> }.into_any()
        }
        Notice::NotKept { is_embedded: true } => view! { <div>{tr!(lab, app.frame_not_kept)}</div> }.into_any(),
        Notice::NotKept { is_embedded: false } => view! { <div>{tr!(lab, app.not_kept)}</div> }.into_any(),
    }
}

/// The bench of a link, in brackets.
fn name_of_bench(lab: Lab, link: &str) -> Option<String> {
    let document = document_from_link(link).ok()?;
    scenes::bench_of(lab, &document).map(|bench| format!("({})", (bench.title)(lab)))
}

fn go_on(lab: Lab, link: &str) {
    lab.open(document_from_link(link));
}

fn undo_load(lab: Lab) {
    lab.notice.set(None);
    keep::undo(lab);
}
