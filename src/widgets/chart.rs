use std::sync::Arc;

use leptos::html::Canvas;
use leptos::prelude::*;
use web_sys::HtmlCanvasElement;

use super::element_size::follow_size;
use crate::canvas;
use crate::download::{download_canvas, download_text};
use crate::lab::{Figure, use_lab};
use crate::naming::file_name;
use crate::share::address_of;
use crate::tables::save_csv;
use crate::texts::tr;
use quadtank_figure::{Axis, Chart, Frame, Rect, Sheet, Size, Style, hold_value_axes, layout, to_svg};

/// Builds charts in place and hands them to a visitor.
type Build = dyn Fn(&mut dyn FnMut(&mut [Chart])) + Send + Sync;

/// How the charts of a picture are had: a function that builds them, in place, for whoever paints or exports them, and
/// one for the numbers behind them as CSV. Building reads signals, so whoever calls it inside an effect follows them.
#[derive(Clone)]
pub struct Picture {
    build: Arc<Build>,
    csv: Arc<dyn Fn() -> String + Send + Sync>,
}

impl Picture {
    /// A picture that `build` hands to its visitor, and whose numbers `csv` writes.
    pub fn new(
        build: impl Fn(&mut dyn FnMut(&mut [Chart])) + Send + Sync + 'static,
        csv: impl Fn() -> String + Send + Sync + 'static,
    ) -> Self {
        Self { build: Arc::new(build), csv: Arc::new(csv) }
    }

    /// What `visitor` makes of the charts, which are its own; the default where there is nothing to show.
    pub fn visit<T: Default>(&self, mut visitor: impl FnMut(&mut [Chart]) -> T) -> T {
        let mut result = T::default();
        (self.build)(&mut |charts| result = visitor(charts));
        result
    }
}

/// Charts on two canvases that lie upon each other, repainted whenever what they read, their size, the pixel ratio or the theme changes.
#[component]
pub fn ChartCanvas(
    /// The charts.
    picture: Picture,
    /// The same with what is laid over it here, for paper.
    #[prop(optional)]
    on_paper: Option<Picture>,
    /// Where the charts stand, for what is laid over them; set after each painting.
    frames: RwSignal<Vec<Frame>>,
    /// What the picture says, for those who do not see it.
    #[prop(into)]
    summary: Signal<String>,
    /// Name for tests.
    name: &'static str,
    /// Whether the value axes stand still while something on the page is dragged: they grow at once, and shrink when it is let go.
    #[prop(optional)]
    steady: bool,
) -> impl IntoView {
    let lab = use_lab();
    let (lower, canvas) = (NodeRef::<Canvas>::new(), NodeRef::<Canvas>::new());
    let ground = StoredValue::new_local(None::<Ground>);
    let size = RwSignal::new(Size { width: 0.0, height: 0.0 });
    canvas.on_load(move |canvas| follow_size(&canvas, size));
    let is_shown = Signal::derive(move || size.with(|size| size.width >= 1.0));
    lab.add_figure(Figure { picture: on_paper.unwrap_or_else(|| picture.clone()), summary, is_shown });
    let repaint = Trigger::new();
    // A window that moves to another screen is resized or zoomed in the eyes of the browser.
    let on_resize = window_event_listener(leptos::ev::resize, move |_| repaint.notify());
    on_cleanup(move || on_resize.remove());
    let shown = StoredValue::new(ShownAxes::default());
    Effect::new(move || {
        if !lab.is_dragging.get() && shown.with_value(|shown| shown.are_wider) {
            repaint.notify();
        }
    });
    Effect::new(move || {
        let (size, magnification) = (size.get(), lab.magnification());
        repaint.track();
        let ratio = window().device_pixel_ratio() * magnification;
        let size = Size { width: size.width / magnification, height: size.height / magnification };
        if size.width < 1.0 || size.height < 1.0 {
            return;
        }
        let (Some(lower), Some(canvas)) = (lower.get_untracked(), canvas.get_untracked()) else { return };
        let style = lab.chart_style();
        let placed = picture.visit(|charts| {
            if steady {
                shown.update_value(|shown| shown.follow(charts, lab.is_dragging.get_untracked()));
            }
            let surface = (size, ratio, style);
            if !ground.with_value(|known| known.as_ref().is_some_and(|known| known.is_of(charts, surface))) {
                canvas::paint(&lower, charts, size, ratio, &style, Sheet::Ground);
                ground.set_value(Some(Ground { charts: charts.iter().map(Chart::ground).collect(), surface }));
            }
            canvas::paint(&canvas, charts, size, ratio, &style, Sheet::Curves);
            layout(charts, size).into_iter().map(|frame| magnified(frame, magnification)).collect::<Vec<_>>()
        });
        if frames.with_untracked(|f| *f != placed) {
            frames.set(placed);
        }
    });
    view! {
        <canvas node_ref=lower aria-hidden="true"></canvas>
        <canvas node_ref=canvas role="img" aria-label=summary data-testid=name></canvas>
    }
}

/// A frame of a picture that is painted larger.
fn magnified(frame: Frame, by: f64) -> Frame {
    let larger = |r: Rect| Rect { left: r.left * by, top: r.top * by, width: r.width * by, height: r.height * by };
    Frame { outer: larger(frame.outer), plot: larger(frame.plot), ..frame }
}

/// The value axes of a steady picture as they were painted last.
#[derive(Default)]
struct ShownAxes {
    axes: Vec<Axis>,
    /// Whether one is wider than its chart asked for.
    are_wider: bool,
}

impl ShownAxes {
    fn follow(&mut self, charts: &mut [Chart], is_dragging: bool) {
        self.are_wider = is_dragging && hold_value_axes(charts, &self.axes);
        self.axes = charts.iter().map(|chart| chart.y.clone()).collect();
    }
}

/// What the lower of the two canvases shows. Most frames leave it as it is, and text is what costs a browser most.
struct Ground {
    charts: Vec<Chart<'static>>,
    /// Size, pixels for each CSS px, and look.
    surface: (Size, f64, Style),
}

impl Ground {
    fn is_of(&self, charts: &[Chart], surface: (Size, f64, Style)) -> bool {
        self.surface == surface
            && self.charts.len() == charts.len()
            && charts.iter().zip(&self.charts).all(|(chart, ground)| chart.has_ground(ground))
    }
}

/// Width and height of exported pictures (CSS px).
const EXPORT: Size = Size { width: 900.0, height: 600.0 };
/// Pixels of an exported PNG for each CSS px.
const EXPORT_RATIO: f64 = 2.0;

/// The menu that exports a picture as CSV, SVG or PNG.
#[component]
pub fn ChartMenu(
    /// The charts.
    picture: Picture,
    /// Stem of the file names.
    file: &'static str,
    /// Title inside the exported picture.
    #[prop(into)]
    title: Signal<String>,
) -> impl IntoView {
    let lab = use_lab();
    let (for_csv, for_svg, for_png) = (picture.clone(), picture.clone(), picture);
    let save_table = move |_| {
        save_csv(lab, &format!("{file}.csv"), &untrack(|| (for_csv.csv)()));
    };
    let save_svg = move |_| {
        let text = untrack(|| {
            let style = lab.chart_style();
            // A picture on a slide still leads to its experiment.
            let link = address_of(lab).unwrap_or_default();
            for_svg.visit(|charts| to_svg(charts, EXPORT, &style, &title.get(), &link))
        });
        download_text(&file_name(lab, &format!("{file}.svg")), "image/svg+xml", &text);
    };
    let save_png = move |_| {
        let style = untrack(|| lab.chart_style());
        if let Some(canvas) = untrack(|| for_png.visit(|charts| off_screen(charts, &style))) {
            download_canvas(&file_name(lab, &format!("{file}.png")), &canvas);
        }
    };
    view! {
        <details class="menu small" data-testid=format!("{file}-menu")>
            <summary aria-label=Signal::derive(move || format!("{}: {}", tr!(lab, chart.export), title.get()))>"⤓"</summary>
            <div>
                <button type="button" data-testid=format!("{file}-csv") on:click=save_table>"CSV"</button>
                <button type="button" data-testid=format!("{file}-svg") on:click=save_svg>"SVG"</button>
                <button type="button" data-testid=format!("{file}-png") on:click=save_png>"PNG"</button>
            </div>
        </details>
    }
}

fn off_screen(charts: &[Chart], style: &Style) -> Option<HtmlCanvasElement> {
    let canvas = canvas::new_canvas()?;
    canvas::paint(&canvas, charts, EXPORT, EXPORT_RATIO, style, Sheet::Both);
    canvas::fill_background(&canvas, style);
    Some(canvas)
}
