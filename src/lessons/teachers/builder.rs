//! Makes the address and the HTML of a bench or lesson in a course page.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::literature::PresetId;
use quadtank_lesson::{LESSON_IDS, Lesson};

use crate::benches::{BenchEntry, name_of};
use crate::download::copy;
use crate::lab::{Lab, use_lab};
use crate::lessons::classroom::tongue;
use crate::lessons::place::absolute;
use crate::session::{Lock, Panel};
use crate::texts::{Language, say, tr};
use crate::widgets::{Choice, Select};

/// Sizes of all in a frame that are offered (%): on a projector text has to be larger than on a desk.
const SCALES: [u32; 4] = [100, 125, 150, 200];

/// A frame in a page.
#[derive(Clone, Copy, PartialEq)]
pub struct FrameSize {
    /// Height (CSS px of the page).
    height_px: u32,
    /// Size of all in it (%).
    scale_percent: u32,
}

impl FrameSize {
    /// As large as usual.
    pub const USUAL: Self = Self { height_px: 720, scale_percent: 100 };

    fn scale(self) -> f64 {
        f64::from(self.scale_percent) / 100.0
    }

    fn width(self) -> String {
        format!("{:.3}%", 100.0 / self.scale())
    }

    fn height(self) -> String {
        format!("{}px", self.content_height_px())
    }

    /// Height of what is scaled (CSS px of the frame): it is laid out as in a smaller window, as by the zoom of a browser.
    fn content_height_px(self) -> f64 {
        (f64::from(self.height_px) / self.scale()).round()
    }

    fn transform(self) -> String {
        format!("scale({})", self.scale())
    }

    /// The page keeps free what the frame covers beyond the place of its content.
    fn margin_bottom(self) -> String {
        format!("{}px", f64::from(self.height_px) - self.content_height_px())
    }

    fn style(self) -> String {
        let (width, height) = (self.width(), self.height());
        if self.scale_percent == 100 {
            return format!("border:0;width:100%;height:{height}");
        }
        let (transform, margin) = (self.transform(), self.margin_bottom());
        format!(
            "border:0;width:{width};height:{height};transform:{transform};transform-origin:0 0;margin-bottom:{margin}"
        )
    }
}

/// What is embedded.
#[derive(Clone, Copy, PartialEq)]
enum Subject {
    Lesson(&'static str),
    Bench(&'static BenchEntry),
}

impl Subject {
    fn name(self) -> String {
        match self {
            Self::Lesson(id) => format!("lesson-{id}"),
            Self::Bench(bench) => format!("bench-{}", bench.id),
        }
    }
}

/// A lesson or a bench with its cards, locks and rig; language, height; what to paste, and how it looks.
#[component]
pub fn Builder(lessons: RwSignal<Vec<Option<Arc<Lesson>>>>) -> impl IntoView {
    let lab = use_lab();
    let subject = RwSignal::new(Subject::Lesson(LESSON_IDS[0]));
    // That of the page, as long as no other one is chosen.
    let chosen_language = RwSignal::new(None::<Language>);
    let language = Signal::derive(move || chosen_language.get().unwrap_or(lab.language.get()));
    let preset = RwSignal::new(None::<PresetId>);
    let panels = RwSignal::new(Vec::<Panel>::new());
    let locks = RwSignal::new(Vec::<Lock>::new());
    let height = RwSignal::new(FrameSize::USUAL.height_px.to_string());
    let scale = RwSignal::new(FrameSize::USUAL.scale_percent);
    let size = Signal::derive(move || FrameSize { height_px: height_px(&height.get()), scale_percent: scale.get() });
    let scales = Signal::derive(|| SCALES.map(|s| Choice::new(s, s.to_string(), format!("{s} %"))).to_vec());
    let is_previewed = RwSignal::new(false);
    let name = move |subject: Subject| match subject {
        Subject::Bench(bench) => (bench.title)(lab),
        Subject::Lesson(id) => lessons.with(|lessons| title_of(lab, lessons, id)),
    };
    let subjects = Signal::derive(move || {
        let of_lessons = LESSON_IDS.into_iter().map(Subject::Lesson);
        let all = of_lessons.chain(lab.benches.iter().map(Subject::Bench));
        all.map(|subject| Choice::new(subject, subject.name(), name(subject))).collect::<Vec<_>>()
    });
    let take = Callback::new(move |chosen: Subject| {
        subject.set(chosen);
        preset.set(None);
        panels.set(Vec::new());
        locks.set(Vec::new());
    });
    let languages = Signal::derive(|| Language::ALL.map(|l| Choice::new(l, l.tag(), l.name())).to_vec());
    let query = Memo::new(move |_| {
        let mut query = format!("?embed=1&lang={}", language.get().tag());
        match subject.get() {
            Subject::Lesson(id) => query.extend(["&lesson=", id]),
            Subject::Bench(bench) => {
                query.extend(["&bench=", bench.id]);
                query.extend(preset.get().map(|id| format!("&preset={}", id.name())));
                query.push_str(&list("panels", panels.get().iter().map(|panel| panel.0)));
                query.push_str(&list("lock", locks.get().iter().map(|lock| lock.0)));
            }
        }
        query
    });
    let code = Memo::new(move |_| frame_of(&query.get(), &name(subject.get()), size.get()));
    let copied = RwSignal::new(false);
    let on_copy = move |_| copy(&code.get_untracked(), move |done| copied.set(done));
    let choices = move || match subject.get() {
        Subject::Lesson(_) => None,
        Subject::Bench(bench) => Some(view! { <BenchChoices bench preset panels locks /> }),
    };
    let preview = move || is_previewed.get().then(|| view! { <Preview query size /> });
    view! {
        <section data-testid="builder">
            <h3>{say!(lab, lesson.builder)}</h3>
            <p>{say!(lab, lesson.builder_lead)}</p>
            <div class="builder">
                <Select id="builder-subject" name=say!(lab, lesson.what) choices=subjects chosen=subject on_choose=take disabled=false />
                <Select
                    id="builder-language"
                    name=say!(lab, app.language)
                    choices=languages
                    chosen=language
                    on_choose=Callback::new(move |chosen| chosen_language.set(Some(chosen)))
                    disabled=false
                />
                <label>
                    {say!(lab, lesson.height)} " "
                    <input type="number" min="200" max="3000" step="20" class="text-field" data-testid="builder-height"
                        prop:value=move || height.get() on:input=move |event| height.set(event_target_value(&event)) />
                    " px"
                </label>
                <Select id="builder-scale" name=say!(lab, lesson.scale) choices=scales chosen=scale
                    on_choose=Callback::new(move |chosen| scale.set(chosen)) disabled=false />
            </div>
            {choices}
            <textarea readonly rows="3" class="code" data-testid="builder-code" aria-label=say!(lab, lesson.embed) prop:value=move || code.get()></textarea>
            <p class="links">
                <button type="button" class="button strong" data-testid="builder-copy" on:click=on_copy>
                    {move || if copied.get() { tr!(lab, lesson.copied) } else { tr!(lab, lesson.copy_html) }}
                </button>
                <button type="button" class="button" data-testid="builder-preview" aria-pressed=move || is_previewed.get().to_string()
                    on:click=move |_| is_previewed.update(|shown| *shown = !*shown)>
                    {say!(lab, lesson.preview)}
                </button>
                <a class="button" target="_blank" rel="noopener" href=move || query.get()>{say!(lab, lesson.open_alone)}</a>
            </p>
            {preview}
        </section>
    }
}

/// The frame as it will be.
#[component]
fn Preview(query: Memo<String>, size: Signal<FrameSize>) -> impl IntoView {
    let lab = use_lab();
    // Each part of the style by itself: the policy of the page allows no attribute with a style.
    view! {
        <iframe
            class="preview"
            title=say!(lab, lesson.preview)
            style:width=move || size.get().width()
            style:height=move || size.get().height()
            style:transform=move || size.get().transform()
            style:margin-bottom=move || size.get().margin_bottom()
            src=query
        ></iframe>
    }
}

/// The number and the title of a lesson, as far as its file is there.
pub fn title_of(lab: Lab, lessons: &[Option<Arc<Lesson>>], id: &'static str) -> String {
    let index = LESSON_IDS.iter().position(|known| *known == id).unwrap_or_default();
    match &lessons[index] {
        Some(lesson) => format!("{}. {}", index + 1, lesson.title.shown(tongue(lab, lesson))),
        None => format!("{}. {id}", index + 1),
    }
}

/// The HTML of a frame with the laboratory.
pub fn frame_of(query: &str, title: &str, size: FrameSize) -> String {
    let (address, title) = (absolute(query).replace('&', "&amp;"), title.replace('&', "&amp;").replace('"', "&quot;"));
    let style = size.style();
    format!("<iframe src=\"{address}\" title=\"{title}\" style=\"{style}\" allow=\"clipboard-write\"></iframe>")
}

/// The height that was typed, within limits (CSS px).
fn height_px(typed: &str) -> u32 {
    typed.parse().unwrap_or(FrameSize::USUAL.height_px).clamp(200, 3000)
}

/// A flag with a list; nothing for an empty one.
fn list<'a>(flag: &str, names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    if names.is_empty() { String::new() } else { format!("&{flag}={}", names.join(",")) }
}

/// Rig, cards and locks of a bench.
#[component]
fn BenchChoices(
    bench: &'static BenchEntry,
    preset: RwSignal<Option<PresetId>>,
    panels: RwSignal<Vec<Panel>>,
    locks: RwSignal<Vec<Lock>>,
) -> impl IntoView {
    let lab = use_lab();
    let rigs = Signal::derive(move || {
        let none = Choice::new(None, "usual", tr!(lab, lesson.usual_rig));
        let known = PresetId::ALL.into_iter().map(|id| Choice::new(Some(id), id.name(), name_of(lab, id)));
        std::iter::once(none).chain(known).collect::<Vec<_>>()
    });
    // The other benches begin with a rig of their own.
    let has_rigs = bench == &lab.benches[0];
    let panel_title = move |panel: Panel| Signal::derive(move || (bench.panel_title)(lab, panel));
    let lock_title = move |lock: Lock| Signal::derive(move || lock_title(lab, lock));
    let panel_boxes =
        bench.panels.iter().map(|&panel| boxed(panel.0, panel_title(panel), panel, panels)).collect_view();
    let lock_boxes = bench.locks.iter().map(|&lock| boxed(lock.0, lock_title(lock), lock, locks)).collect_view();
    view! {
        {has_rigs.then(|| view! {
            <Select id="builder-preset" name=say!(lab, lesson.rig) choices=rigs chosen=preset
                on_choose=Callback::new(move |chosen| preset.set(chosen)) disabled=false />
        })}
        <fieldset class="boxes"><legend>{say!(lab, lesson.cards)}</legend>{panel_boxes}</fieldset>
        <fieldset class="boxes"><legend>{say!(lab, lesson.locked)}</legend>{lock_boxes}</fieldset>
    }
}

/// What a group of controls is called.
fn lock_title(lab: Lab, lock: Lock) -> String {
    match lock.0 {
        "preset" => tr!(lab, lock.preset),
        "valves" => tr!(lab, lock.valves),
        "voltages" => tr!(lab, lock.voltages),
        "pairing" => tr!(lab, lock.pairing),
        "gains" => tr!(lab, lock.gains),
        "sampling" => tr!(lab, lock.sampling),
        "experiment" => tr!(lab, lock.experiment),
        "plant" => tr!(lab, lock.plant),
        "test" => tr!(lab, lock.test),
        "point" => tr!(lab, lock.point),
        "target" => tr!(lab, lock.target),
        "objective" => tr!(lab, lock.objective),
        other => other.to_owned(),
    }
}

fn boxed<T: Copy + PartialEq + Send + Sync + 'static>(
    name: &'static str,
    title: Signal<String>,
    item: T,
    chosen: RwSignal<Vec<T>>,
) -> impl IntoView {
    let change = move |event| {
        let ticked = event_target_checked(&event);
        chosen.update(|chosen| {
            chosen.retain(|other| *other != item);
            chosen.extend(ticked.then_some(item));
        });
    };
    view! {
        <label class="check">
            <input type="checkbox" data-testid=format!("box-{name}") prop:checked=move || chosen.with(|chosen| chosen.contains(&item)) on:change=change />
            {title}
        </label>
    }
}
