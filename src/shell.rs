//! The page around the bench: header, notices, footer; and how it all starts.

use leptos::ev;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;

use super::benches::{BENCHES, BenchEntry};
use super::depth::Depth;
use super::download::is_single_file;
use super::enlarged::Enlarged;
use super::events::is_at;
use super::glossary::Glossary;
use super::handout::Handout;
use super::header::{Header, LessonHeader};
use super::keep;
use super::lab::{Lab, Notice, use_lab};
use super::lessons::{self, Catalogue, Classroom, LessonPanel, SidePage, Teachers};
use super::live_region::LiveRegion;
use super::messages;
use super::notices::Notices;
use super::offline;
use super::scenes::{self, SceneBar, ScenesPage};
use super::share;
use super::start::StartFlags;
use super::stopped::Stopped;
use super::storage::{DEPTH, LANGUAGE, THEME};
use super::tables::remembered_style;
use super::texts::{Language, say, tr};
use super::tour::Tour;

/// The element of the page that the laboratory fills; it holds the static outline until then.
const ROOT: &str = "app";

/// Starts the laboratory in the page: reads the address, fills the root element, and removes the outline.
pub fn mount() {
    console_error_panic_hook::set_once();
    let Some(root) = document().get_element_by_id(ROOT).and_then(|e| e.dyn_into::<web_sys::HtmlElement>().ok()) else {
        return;
    };
    root.set_text_content(None);
    // A file from a disk may not show itself in a frame.
    match StartFlags::parse(&query(), &BENCHES).scale.filter(|scale| *scale > 1.0 && !is_single_file()) {
        Some(scale) => leptos::mount::mount_to(root, move || view! { <Enlarged scale /> }).forget(),
        None => leptos::mount::mount_to(root, || view! { <Laboratory /> }).forget(),
    }
}

fn query() -> String {
    window().location().search().unwrap_or_default()
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
    show_on_root("data-grows", if lab.flags.with_value(|flags| flags.grows) { "yes" } else { "no" });
    Effect::new(move || show_on_root("data-lesson", if lab.stage.with(Option::is_some) { "yes" } else { "no" }));
    Effect::new(move || show_on_root("data-theme", if lab.dark.get() { "dark" } else { "light" }));
    Effect::new(move || show_on_root("data-view", lab.shown_depth().name()));
    Effect::new(move || show_on_root("data-present", if lab.is_presenting() { "yes" } else { "no" }));
    Effect::new(move || show_on_root("lang", lab.language.get().tag()));
    Effect::new(move || document().set_title(&tr!(lab, app.page_title)));
    keep::keep(lab);
    // A link that is pasted over the address, and Back and Forward.
    let on_address = window_event_listener(ev::popstate, move |_| lessons::follow_address(lab, room));
    let on_press = window_event_listener(ev::pointerdown, |event| close_menus(event.target()));
    // What a menu offers is done, and the menu not needed any more.
    let on_click = window_event_listener(ev::click, |event| {
        if is_at(&event, ".menu > div > :is(button, a), .menu > nav *") {
            close_menus(None);
        }
        // By the next frame a menu that was pressed is open.
        request_animation_frame(keep_menus_in_sight);
    });
    // The progress of a lesson is saved when the page is left, too.
    let on_hide = window_event_listener(ev::pagehide, move |event| room.close(event.persisted()));
    let on_key = window_event_listener(ev::keydown, move |event| match event.key().as_str() {
        "Escape" => {
            close_menus(None);
            lab.large.set(None);
            lab.tour.set(None);
            lab.present(false);
        }
        "f" | "F" if is_plain(&event) => lab.present(!untrack(|| lab.is_presenting())),
        // Wireless presenters send Page Up and Page Down. Sliders and handles have a use for them of their own.
        key @ ("PageDown" | "PageUp") if is_plain(&event) && !is_slider(&event) && scenes::is_in_sight(lab) => {
            event.prevent_default();
            scenes::step(lab, key == "PageDown");
        }
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
                // A lesson is the title of its page.
                view! { <header class="visually-hidden" hidden=move || lab.stage.with(Option::is_some)><h1>{say!(lab, app.title)}</h1></header> }.into_any()
            } else {
                view! { <Header /> }.into_any()
            }}
            <Stopped />
            // The header, with the title of the page, is away then.
            <header class="visually-hidden" hidden=move || !lab.is_presenting()><h1>{say!(lab, app.title)}</h1></header>
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
            <LiveRegion />
            <SceneBar />
            <Tour />
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
    let content = match page {
        SidePage::Lessons => view! { <Catalogue /> }.into_any(),
        SidePage::Glossary => view! { <Glossary /> }.into_any(),
        SidePage::Teachers => view! { <Teachers /> }.into_any(),
        SidePage::Scenes => view! { <ScenesPage /> }.into_any(),
    };
    view! { {content} <p class="paper-link" aria-hidden="true">{lessons::absolute(&page.address())}</p> }.into_any()
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
        let (is_covered, is_alone) =
            stage.with(|s| s.as_ref().map_or((false, false), |s| (s.is_covered, s.panels.len() == 1)));
        let is_chosen = has_choice || stage.with(Option::is_some);
        let mut class = bench.class.to_owned();
        class.push_str(if is_chosen { " chosen" } else { "" });
        class.push_str(if is_alone && !is_covered { " alone" } else { "" });
        let cover = move || {
            is_covered.then(|| view! { <p class="covered" data-testid="covered">{say!(lab, lesson.covered)}</p> })
        };
        // The id is that of the bench that is shown.
        seen.get().then(|| {
            view! {
                <main class=class tabindex="-1" id=move || (is_shown() && lab.side.get().is_none()).then(|| "bench".to_owned())>
                    {(bench.cards)(lab)}
                    {cover()}
                </main>
            }
        })
    };
    view! { <div hidden=move || !is_shown()>{content}</div> }
}

/// Whether a key is pressed alone, and not into a field.
fn is_plain(event: &ev::KeyboardEvent) -> bool {
    let has_modifier = event.ctrl_key() || event.meta_key() || event.alt_key();
    !has_modifier && !is_at(event, "input:not([type=range]), select, textarea")
}

/// Whether a key is pressed on a slider or a handle.
fn is_slider(event: &ev::KeyboardEvent) -> bool {
    is_at(event, "input[type=range], [role=slider]")
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

/// Least distance of an open menu from the sides of the window (CSS px).
const MENU_MARGIN: f64 = 8.0;

/// Moves open menus sideways into the window: they hang from the right end of their button, which may stand at the left.
fn keep_menus_in_sight() {
    let Some(width) = document().document_element().map(|root| f64::from(root.client_width())) else { return };
    let Ok(open) = document().query_selector_all("details.menu[open] > :is(div, nav)") else { return };
    for menu in (0..open.length()).filter_map(|k| open.get(k)?.dyn_into::<web_sys::HtmlElement>().ok()) {
        // Fails for no such property, and then the menu stays where it is.
        let move_by = |shift: f64| menu.style().set_property("translate", &format!("{shift}px")).unwrap_or_default();
        move_by(0.0);
        let place = menu.get_bounding_client_rect();
        let into_left = (MENU_MARGIN - place.left()).max(0.0);
        let into_right = (place.right() - (width - MENU_MARGIN)).max(0.0);
        move_by(if into_left > 0.0 { into_left } else { -into_right });
    }
}

/// The state that the address and the remembered choices ask for.
fn start(benches: &'static [BenchEntry]) -> Lab {
    let flags = StartFlags::parse(&query(), benches);
    let usual_tag = || LANGUAGE.read().or_else(|| window().navigator().language()).unwrap_or_default();
    let language = flags.language.unwrap_or_else(|| Language::of_tag(&usual_tag()));
    let prefers_dark =
        || window().match_media("(prefers-color-scheme: dark)").ok().flatten().is_some_and(|query| query.matches());
    let remembered = || THEME.read().map(|theme| theme == "dark");
    let dark = flags.dark.or_else(remembered).unwrap_or_else(prefers_dark);
    let linked = share::from_address();
    let depth = Depth::at_start(&flags, linked.is_some(), DEPTH.read().as_deref());
    let lab = Lab::new(benches, language, dark, depth, flags);
    lab.csv_style.set(remembered_style());
    lab.scenes.set(scenes::remembered());
    // Before any bench is shown, so that its document is computed at once.
    if let Some(outcome) = linked {
        share::open(lab, outcome);
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
                lab.notice.set(Some(Notice::NotWritten(error)));
            }
        }
    };
    view! {
        <footer class="page">
            <a href=share::BARE target="_blank" rel="noopener" data-testid="full-lab" on:click=on_click>{say!(lab, app.embedded)}</a>
        </footer>
    }
}
