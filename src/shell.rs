//! The page around the bench: header, notices, footer; and how it all starts.

use leptos::ev;
use leptos::html::Input;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use quadtank_lesson::LESSON_IDS;

use super::benches::{BENCHES, BenchEntry};
use super::depth::Depth;
use super::glossary::Glossary;
use super::handout::{self, Handout};
use super::keep;
use super::lab::{Lab, Notice, use_lab};
use super::lessons::{self, Catalogue, Classroom, LessonPanel, SidePage, Teachers, use_classroom};
use super::messages;
use super::naming::{ExperimentName, NameFields};
use super::notices::Notices;
use super::offline;
use super::share;
use super::start::StartFlags;
use super::stopped::Stopped;
use super::storage::{DEPTH, LANGUAGE, THEME};
use super::texts::{Language, say, tr};
use super::widgets::Segmented;

/// The element of the page that the laboratory fills; it holds the static outline until then.
const ROOT: &str = "app";

/// Starts the laboratory in the page: reads the address, fills the root element, and removes the outline.
pub fn mount() {
    console_error_panic_hook::set_once();
    let Some(root) = document().get_element_by_id(ROOT).and_then(|e| e.dyn_into::<web_sys::HtmlElement>().ok()) else {
        return;
    };
    root.set_text_content(None);
    leptos::mount::mount_to(root, || view! { <Laboratory /> }).forget();
}

/// The whole laboratory.
#[component]
pub fn Laboratory(
    /// The benches, the first of which is the home bench.
    #[prop(default = &BENCHES)]
    benches: &'static [BenchEntry],
) -> impl IntoView {
    let lab = start(benches);
    provide_context(lab);
    let room = Classroom::new(lab);
    provide_context(room);
    lessons::begin_asked(lab, room);
    messages::talk(lab, room);
    offline::keep_site(lab);
    Effect::new(move || show_on_root("data-lesson", if lab.stage.with(Option::is_some) { "yes" } else { "no" }));
    Effect::new(move || show_on_root("data-theme", if lab.dark.get() { "dark" } else { "light" }));
    Effect::new(move || show_on_root("data-view", lab.shown_depth().name()));
    Effect::new(move || show_on_root("data-present", if lab.is_presenting() { "yes" } else { "no" }));
    Effect::new(move || show_on_root("lang", lab.language.get().tag()));
    Effect::new(move || document().set_title(&tr!(lab, app.page_title)));
    keep::keep(lab);
    // A link that is pasted over the address, and Back and Forward.
    let on_address = window_event_listener(ev::popstate, move |_| share::follow_address(lab));
    let on_press = window_event_listener(ev::pointerdown, |event| close_menus(event.target()));
    // What a menu offers is done, and the menu not needed any more.
    let on_click = window_event_listener(ev::click, |event| {
        let target = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
        if target.is_some_and(|target| target.matches(".menu > div > :is(button, a), .menu > nav *").unwrap_or(false)) {
            close_menus(None);
        }
    });
    // What was done is handed over also when the page goes.
    let on_hide = window_event_listener(ev::pagehide, move |_| room.close());
    let on_key = window_event_listener(ev::keydown, move |event| match event.key().as_str() {
        "Escape" => {
            close_menus(None);
            lab.large.set(None);
            lab.present(false);
        }
        "f" | "F" if is_plain(&event) => lab.present(!untrack(|| lab.is_presenting())),
        _ => {}
    });
    on_cleanup(move || {
        on_address.remove();
        on_hide.remove();
        on_press.remove();
        on_click.remove();
        on_key.remove();
    });
    let embed = lab.flags.with_value(|f| f.embed);
    view! {
        <div class=if embed { "embed" } else { "page" }>
            {if embed {
                view! { <header class="visually-hidden"><h1>{say!(lab, app.title)}</h1></header> }.into_any()
            } else {
                view! { <Header /> }.into_any()
            }}
            <Stopped />
            <button
                type="button"
                class="button end-presenting"
                data-testid="end-presenting"
                hidden=move || !lab.is_presenting()
                on:click=move |_| lab.present(false)
            >
                {say!(lab, app.end_presenting)}
            </button>
            <Notices />
            <LessonHeader />
            <div class="desk" hidden=move || lab.side.get().is_some()>
                <LessonPanel />
                {benches.iter().map(|bench| view! { <KeptBench bench /> }).collect_view()}
            </div>
            {move || lab.side.get().map(side_page)}
            {embed.then(|| view! { <EmbedFooter /> })}
            <Handout />
        </div>
    }
}

/// The page that is shown in place of the benches.
fn side_page(page: SidePage) -> AnyView {
    match page {
        SidePage::Lessons => view! { <Catalogue /> }.into_any(),
        SidePage::Glossary => view! { <Glossary /> }.into_any(),
        SidePage::Teachers => view! { <Teachers /> }.into_any(),
    }
}

/// A link to a page beside the benches.
#[component]
fn SideLink(page: SidePage, name: Signal<String>) -> impl IntoView {
    let lab = use_lab();
    let go = move |event: ev::MouseEvent| {
        if !(event.ctrl_key() || event.meta_key() || event.shift_key()) {
            event.prevent_default();
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
fn LessonHeader() -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let embed = lab.flags.with_value(|flags| flags.embed);
    move || {
        let lesson = room.lesson.get()?;
        let number = LESSON_IDS.iter().position(|id| *id == lesson.id);
        let which = move || number.map(|index| tr!(lab, lesson.number, number = index + 1, count = LESSON_IDS.len()));
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
                <LanguageChoice />
                // In a frame there is no laboratory to go back to.
                <button type="button" class="button" data-testid="leave-lesson" hidden=embed on:click=move |_| room.leave()>{say!(lab, lesson.leave)}</button>
            </header>
        })
    }
}

/// A bench, made when it is shown first and hidden while another one is. It stays, because signals that outlive a view keep
/// what is left of its effects until they change: going to and fro would leave kilobytes behind each time.
#[component]
fn KeptBench(bench: &'static BenchEntry) -> impl IntoView {
    let lab = use_lab();
    let is_shown = move || lab.bench.get() == bench;
    let seen = RwSignal::new(false);
    Effect::new(move || {
        if is_shown() && !seen.get_untracked() {
            seen.set(true);
        }
    });
    let has_choice = lab.flags.with_value(|f| !f.panels.is_empty());
    // A step of a lesson may show other cards; they are made anew then.
    let stage = Memo::new(move |_| lab.stage.get().filter(|stage| stage.bench == bench.id));
    let content = move || {
        let is_chosen = has_choice || stage.with(Option::is_some);
        let class = if is_chosen { format!("{} chosen", bench.class) } else { bench.class.to_owned() };
        // The id is that of the bench that is shown.
        seen.get().then(|| {
            view! {
                <main class=class tabindex="-1" id=move || (is_shown() && lab.side.get().is_none()).then(|| "bench".to_owned())>{(bench.cards)(lab)}</main>
            }
        })
    };
    view! { <div hidden=move || !is_shown()>{content}</div> }
}

/// Whether a key is pressed alone, and not into a field.
fn is_plain(event: &ev::KeyboardEvent) -> bool {
    let is_field = || {
        let element = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
        element.is_some_and(|e| e.matches("input:not([type=range]), select, textarea").unwrap_or(false))
    };
    !(event.ctrl_key() || event.meta_key() || event.alt_key() || is_field())
}

/// Closes the menus that are open, but for the one that was pressed.
fn close_menus(pressed: Option<web_sys::EventTarget>) {
    let pressed = pressed.and_then(|target| target.dyn_into::<web_sys::Node>().ok());
    let Ok(open) = document().query_selector_all("details.menu[open]") else { return };
    for menu in (0..open.length()).filter_map(|k| open.get(k)) {
        let is_pressed = pressed.is_some() && menu.contains(pressed.as_ref());
        if let Some(menu) = menu.dyn_ref::<web_sys::Element>().filter(|_| !is_pressed) {
            let _ = menu.remove_attribute("open");
        }
    }
}

/// The state that the address and the remembered choices ask for.
fn start(benches: &'static [BenchEntry]) -> Lab {
    let query = window().location().search().unwrap_or_default();
    let flags = StartFlags::parse(&query, benches);
    let usual_tag = || LANGUAGE.read().or_else(|| window().navigator().language()).unwrap_or_default();
    let language = flags.language.unwrap_or_else(|| Language::of_tag(&usual_tag()));
    let prefers_dark =
        || window().match_media("(prefers-color-scheme: dark)").ok().flatten().is_some_and(|query| query.matches());
    let remembered = || THEME.read().map(|theme| theme == "dark");
    let dark = flags.dark.or_else(remembered).unwrap_or_else(prefers_dark);
    let linked = share::from_address();
    let depth = Depth::at_start(&flags, linked.is_some(), DEPTH.read().as_deref());
    let lab = Lab::new(benches, language, dark, depth, flags);
    // Before any bench is shown, so that its document is computed at once.
    if let Some(outcome) = linked {
        lab.open(outcome);
    }
    let unknown = lab.flags.with_value(|flags| flags.unknown.clone());
    // A link that was refused matters more.
    if !unknown.is_empty() && lab.notice.with_untracked(Option::is_none) {
        lab.notice.set(Some(Notice::NotUnderstood(unknown)));
    }
    lab
}

fn show_on_root(attribute: &str, value: &str) {
    if let Some(root) = document().document_element() {
        let _ = root.set_attribute(attribute, value);
    }
}

#[component]
fn Header() -> impl IntoView {
    let lab = use_lab();
    view! {
        <header class="top">
            <button type="button" class="button skip" data-testid="skip" on:click=|_| focus_bench()>{say!(lab, app.skip)}</button>
            <h1>{say!(lab, app.title)}</h1>
            <BenchMenu />
            <SideLink page=SidePage::Lessons name=say!(lab, lesson.lessons) />
            <ExperimentName />
            <span class="spacer"></span>
            <DepthSwitch />
            <Steps />
            <button type="button" class="button" data-testid="share" on:click=move |_| share::share(lab)>
                {say!(lab, app.share)}
            </button>
            <FileMenu />
            <button
                type="button"
                class="button present"
                data-testid="present"
                title=say!(lab, app.present_name)
                hidden=move || !lab.bench.get().can_present
                on:click=move |_| lab.present(true)
            >
                {say!(lab, app.present)}
            </button>
            <details class="menu about">
                <summary>{say!(lab, app.about)}</summary>
                <div>
                    <p class="links">
                        <SideLink page=SidePage::Glossary name=say!(lab, lesson.glossary) />
                        <SideLink page=SidePage::Teachers name=say!(lab, lesson.teachers) />
                    </p>
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
    let go = move |event: ev::MouseEvent| {
        if !(event.ctrl_key() || event.meta_key() || event.shift_key()) {
            event.prevent_default();
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
                <button type="button" data-testid="print" on:click=move |_| handout::print()>{say!(lab, handout.print)}</button>
                <NameFields />
            </div>
            <input type="file" accept=".json,application/json" hidden node_ref=picker data-testid="open-input" on:change=on_file />
        </details>
    }
}

/// Whether the page is the one-file build, which has nothing beside it to download.
fn is_single_file() -> bool {
    document().document_element().is_some_and(|root| root.has_attribute("data-single"))
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

/// In a course page: the link to the whole laboratory, which is this page without its query, with what is shown here.
#[component]
fn EmbedFooter() -> impl IntoView {
    let lab = use_lab();
    // The link is made when it is followed: to make it at every change would take a millisecond of each frame.
    let on_click = move |event: ev::MouseEvent| {
        let anchor = event.current_target().and_then(|target| target.dyn_into::<web_sys::HtmlAnchorElement>().ok());
        match share::bare_reference(lab) {
            Ok(reference) => {
                if let Some(anchor) = anchor {
                    anchor.set_href(&reference);
                }
            }
            Err(error) => {
                event.prevent_default();
                lab.notice.set(Some(Notice::Refused(error)));
            }
        }
    };
    view! {
        <footer class="page">
            <a href=share::BARE target="_blank" rel="noopener" data-testid="full-lab" on:click=on_click>{say!(lab, app.embedded)}</a>
        </footer>
    }
}
