//! The header of the page: benches, depth, steps, files, language and theme; during a lesson the lesson.

use std::sync::Arc;

use leptos::html::Input;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use quadtank_lesson::LESSON_IDS;

use super::benches::BenchEntry;
use super::depth::Depth;
use super::download::is_single_file;
use super::handout;
use super::keep;
use super::lab::{Lab, use_lab};
use super::lessons::{LessonFiles, SidePage, is_for_here, use_classroom};
use super::naming::{ExperimentName, NameFields};
use super::scenes;
use super::scripts::Scripts;
use super::share;
use super::storage::{DEPTH, LANGUAGE, THEME};
use super::tables::CsvStyleChoice;
use super::texts::{Language, say, tr};
use super::tour;
use super::widgets::{MODEL, Segmented};

/// A link to a page beside the benches.
#[component]
fn SideLink(page: SidePage, name: Signal<String>) -> impl IntoView {
    let lab = use_lab();
    let go = move |event| {
        if is_for_here(&event) {
            share::go_to_page(lab, page);
        }
    };
    view! {
        <a
            class="button"
            href=page.address()
            data-testid=format!("to-{}", page.name())
            aria-current=move || (lab.side.get() == Some(page)).then_some("page")
            on:click=go
        >
            {name}
        </a>
    }
}

/// The header during a lesson: which one, points, and the way out.
#[component]
pub fn LessonHeader() -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let embed = lab.flags.with_value(|flags| flags.embed);
    move || {
        let lesson = room.lesson.get()?;
        let number = LESSON_IDS.iter().position(|id| *id == lesson.id);
        let which = move || number.map(|index| tr!(lab, lesson.number, number = index + 1, count = LESSON_IDS.len()));
        let files = (!embed && !is_single_file()).then(|| Arc::clone(&lesson));
        let menu = files.map(|lesson| {
            view! {
                <details class="menu" data-testid="lesson-menu">
                    <summary>{say!(lab, lesson.files)}</summary>
                    <div><LessonFiles lesson /></div>
                </details>
            }
        });
        let (of, count, minutes) = (lesson.points(), lesson.steps.len(), lesson.minutes as usize);
        let state = move || {
            let (points, step) = room.progress.with(|p| p.as_ref().map_or((0, 0), |p| (p.points(&lesson), p.step)));
            let is_over = room.progress.with(|p| p.as_ref().is_some_and(|p| p.is_complete(&lesson)));
            let left = if is_over { 0 } else { (minutes * (count - step.min(count))).div_ceil(count) };
            tr!(lab, lesson.state_of_play, points = points, of = of, minutes = left)
        };
        Some(view! {
            <header class="top lesson-top">
                <span class="brand">{say!(lab, app.title)}</span>
                <span class="remark">{which}</span>
                <span class="spacer"></span>
                <span class="remark" data-testid="lesson-points">{state}</span>
                {menu}
                <LanguageChoice />
                // In a frame there is no laboratory to go back to.
                <button type="button" class="button" data-testid="leave-lesson" hidden=embed on:click=move |_| room.leave()>{say!(lab, lesson.leave)}</button>
            </header>
        })
    }
}

#[component]
pub fn Header() -> impl IntoView {
    let lab = use_lab();
    let is_open = RwSignal::new(false);
    // The home bench has one.
    let has_no_tour = move || lab.bench.get() != &lab.benches[0] || lab.side.get().is_some();
    view! {
        <header class="top">
            <button type="button" class="button skip" data-testid="skip" on:click=|_| focus_bench()>{say!(lab, app.skip)}</button>
            <h1>{say!(lab, app.title)}</h1>
            <BenchMenu />
            <SideLink page=SidePage::Lessons name=say!(lab, lesson.lessons) />
            <ExperimentName />
            <span class="spacer"></span>
            // On a phone the rest is folded: it would take half of the first screen.
            <button
                type="button"
                class="button unfold"
                data-testid="header-more"
                aria-label=say!(lab, app.more)
                title=say!(lab, app.more)
                aria-expanded=move || is_open.get().to_string()
                aria-controls="header-rest"
                on:click=move |_| is_open.update(|open| *open = !*open)
            >
                "☰"
            </button>
            // What is done to a bench has no place on the pages beside them.
            <div class="of-bench" hidden=move || lab.side.get().is_some()><DepthSwitch /><Steps /></div>
            <div class="rest" id="header-rest" class:open=is_open>
                <button type="button" class="button" data-testid="share" hidden=move || lab.side.get().is_some() on:click=move |_| share::share(lab)>
                    {say!(lab, app.share)}
                </button>
                <FileMenu />
                <button
                    type="button"
                    class="button present"
                    data-testid="present"
                    title=say!(lab, app.present_name)
                    hidden=move || !lab.bench.get().can_present || lab.side.get().is_some()
                    on:click=move |_| lab.present(true)
                >
                    {say!(lab, app.present)}
                </button>
                <details class="menu about">
                    <summary>{say!(lab, app.about)}</summary>
                    <div>
                        <button type="button" data-testid="begin-tour" hidden=has_no_tour on:click=move |_| tour::begin(lab)>
                            {say!(lab, tour.begin)}
                        </button>
                        <p class="links">
                            <SideLink page=SidePage::Glossary name=say!(lab, lesson.glossary) />
                            <SideLink page=SidePage::Teachers name=say!(lab, lesson.teachers) />
                        </p>
                        // The single file has no page beside it.
                        {(!is_single_file()).then(|| view! {
                            <p><a href=MODEL target="_blank" rel="noopener" data-testid="to-model">{say!(lab, app.model)}</a></p>
                        })}
                        <p>{say!(lab, app.footer)}</p>
                        <p hidden=move || !lab.offline.get() data-testid="offline">{say!(lab, app.offline)}</p>
                        <p>{say!(lab, app.keys)}</p>
                        <p>{say!(lab, app.links)}</p>
                        <p>{say!(lab, app.privacy)}</p>
                        <p>{say!(lab, app.version, version = env!("CARGO_PKG_VERSION"))} " " {say!(lab, app.licence)}</p>
                    </div>
                </details>
                <LanguageChoice />
                <ThemeSwitch />
            </div>
        </header>
    }
}

/// Puts the focus on the bench, past the header.
fn focus_bench() {
    let bench = document().get_element_by_id("bench").and_then(|bench| bench.dyn_into::<web_sys::HtmlElement>().ok());
    if let Some(bench) = bench {
        let _ = bench.focus();
    }
}

/// The benches, with what one does there.
#[component]
fn BenchMenu() -> impl IntoView {
    let lab = use_lab();
    view! {
        <details class="menu benches" data-testid="benches">
            <summary>{move || (lab.bench.get().title)(lab)} " ▾"</summary>
            <nav aria-label=say!(lab, app.benches)>
                {lab.benches.iter().map(|bench| view! { <BenchLink bench /> }).collect_view()}
            </nav>
        </details>
    }
}

/// The link to a bench. It is an address, so it can be opened beside and bookmarked.
#[component]
fn BenchLink(bench: &'static BenchEntry) -> impl IntoView {
    let lab = use_lab();
    let go = move |event| {
        if is_for_here(&event) {
            share::go_to(lab, bench);
        }
    };
    view! {
        <a
            href=format!("?bench={}", bench.id)
            data-testid=format!("bench-{}", bench.id)
            aria-current=move || (lab.bench.get() == bench).then(|| "page".to_owned())
            on:click=go
        >
            <svg viewBox="0 0 48 32" aria-hidden="true"><path d=bench.picture /></svg>
            <b>{move || (bench.title)(lab)}</b>
            <span>{move || (bench.about)(lab)}</span>
        </a>
    }
}

/// How much of the bench is shown, where there is a choice.
#[component]
fn DepthSwitch() -> impl IntoView {
    let lab = use_lab();
    let name = move |depth: Depth| match depth {
        Depth::Explore => (depth, "view-explore", say!(lab, app.explore)),
        Depth::Lab => (depth, "view-lab", say!(lab, app.lab)),
        Depth::Full => (depth, "view-full", say!(lab, app.full)),
    };
    let choose = Callback::new(move |depth: Depth| {
        lab.depth.set(depth);
        DEPTH.write(depth.name());
    });
    let value = Signal::derive(move || lab.shown_depth());
    let switch = move || {
        let depths = lab.bench.get().depths;
        let choices = depths.iter().map(|&depth| name(depth)).collect::<Vec<_>>();
        (depths.len() > 1).then(|| {
            view! { <Segmented label=say!(lab, app.depth) choices value on_choose=choose disabled=false /> }
        })
    };
    view! { <div class="depth">{switch}</div> }
}

/// Undo, do again, begin again.
#[component]
fn Steps() -> impl IntoView {
    let lab = use_lab();
    let possible = Memo::new(move |_| (lab.bench.get().can_undo_redo)(lab));
    let button = move |id: &'static str, sign: &'static str, name: Signal<String>, off: Signal<bool>, act: fn(Lab)| {
        view! {
            <button type="button" class="button" data-testid=id aria-label=name title=name disabled=off on:click=move |_| act(lab)>
                {sign}
            </button>
        }
    };
    let begin_again = |lab: Lab| (lab.bench.get_untracked().reset)(lab);
    view! {
        <div class="steps">
            {button("undo", "↶", say!(lab, app.undo), Signal::derive(move || !possible.get().0), keep::undo)}
            {button("redo", "↷", say!(lab, app.redo), Signal::derive(move || !possible.get().1), keep::redo)}
            {button("reset", "⟲", say!(lab, app.reset), Signal::from(false), begin_again)}
        </div>
    }
}

#[component]
fn FileMenu() -> impl IntoView {
    let lab = use_lab();
    let picker = NodeRef::<Input>::new();
    let on_file = move |_| {
        let Some(input) = picker.get_untracked() else { return };
        if let Some(file) = input.files().and_then(|files| files.get(0)) {
            share::open_file(lab, &file);
        }
        // The same file can then be opened again.
        input.set_value("");
    };
    let single = is_single_file();
    let to_scenes = move |event| {
        if is_for_here(&event) {
            share::go_to_page(lab, SidePage::Scenes);
        }
    };
    view! {
        <details class="menu" data-testid="file-menu">
            <summary>{say!(lab, app.export)}</summary>
            <div>
                <button type="button" data-testid="save" on:click=move |_| share::save(lab)>{say!(lab, app.export_scenario)}</button>
                <button type="button" data-testid="open" on:click=move |_| if let Some(input) = picker.get_untracked() { input.click() }>
                    {say!(lab, app.open_scenario)}
                </button>
                {(!single).then(|| view! {
                    <a href="quadtank.html" download="quadtank.html" data-testid="single-file">
                        {say!(lab, app.single_file)}
                    </a>
                })}
                <Scripts />
                <button type="button" data-testid="print" on:click=move |_| handout::print()>{say!(lab, handout.print)}</button>
                <CsvStyleChoice />
                <button type="button" data-testid="add-scene" disabled=move || scenes::is_full(lab) on:click=move |_| scenes::add_shown(lab)>
                    {say!(lab, scenes.add)}
                </button>
                <a href=SidePage::Scenes.address() data-testid="to-scenes" on:click=to_scenes>{say!(lab, scenes.see)}</a>
                <NameFields />
            </div>
            <input type="file" accept=".json,application/json" hidden node_ref=picker data-testid="open-input" on:change=on_file />
        </details>
    }
}

#[component]
fn LanguageChoice() -> impl IntoView {
    let lab = use_lab();
    let choose = move |event| {
        let language = Language::of_tag(&event_target_value(&event));
        lab.language.set(language);
        LANGUAGE.write(language.tag());
    };
    let option = move |language: Language| {
        let (tag, name) = (language.tag(), language.name());
        view! { <option value=tag lang=tag prop:selected=move || lab.language.get() == language>{name}</option> }
    };
    view! {
        <select data-testid="language" aria-label=say!(lab, app.language) on:change=choose>
            {Language::ALL.map(option)}
        </select>
    }
}

#[component]
fn ThemeSwitch() -> impl IntoView {
    let lab = use_lab();
    let name =
        Signal::derive(move || if lab.dark.get() { tr!(lab, app.theme_light) } else { tr!(lab, app.theme_dark) });
    let switch = move |_| {
        lab.dark.update(|d| *d = !*d);
        THEME.write(if lab.dark.get_untracked() { "dark" } else { "light" });
    };
    view! {
        <button type="button" class="button" data-testid="theme" aria-label=name title=name on:click=switch>
            {move || if lab.dark.get() { "☀" } else { "☾" }}
        </button>
    }
}
