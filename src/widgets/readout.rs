use leptos::prelude::*;

use super::time_surface::TimeAxis;
use quadtank_figure::Frame;

/// The values at a cursor: the time, then a pair of values of the two loops in each line.
#[derive(Clone, Debug, PartialEq)]
pub struct Readout {
    /// The time with its unit.
    pub time: String,
    /// The values with their symbols.
    pub pairs: Vec<[String; 2]>,
}

impl Readout {
    /// The same in words.
    pub fn spoken(&self) -> String {
        let pairs = self.pairs.iter().map(|pair| pair.join(" · "));
        std::iter::once(self.time.clone()).chain(pairs).collect::<Vec<_>>().join(" ")
    }

    fn view(self) -> impl IntoView {
        let pairs = self.pairs.into_iter().map(|[one, two]| {
            view! { <div><span class="loop1">{one}</span>" · "<span class="loop2">{two}</span></div> }
        });
        view! {
            <div class="readout" data-testid="readout" aria-hidden="true">
                <div>{self.time}</div>
                {pairs.collect_view()}
            </div>
        }
    }
}

/// The values at the cursor, beside it on whichever side has room.
#[component]
pub fn BesideCursor(
    /// The time axis of the charts.
    axis: TimeAxis,
    /// Where the charts stand.
    frames: RwSignal<Vec<Frame>>,
    /// The values; nothing where there is no cursor.
    readout: Signal<Option<Readout>>,
) -> impl IntoView {
    let inset = move || {
        let frame = frames.with(|f| f.first().copied());
        let (Some(frame), Some(time)) = (frame, axis.cursor.get()) else { return String::new() };
        let share = 100.0 * (frame.x_px(time) - frame.outer.left) / frame.outer.width;
        if share < 50.0 {
            format!("4px auto auto {:.1}%", share + 1.5)
        } else {
            format!("4px {:.1}% auto auto", 101.5 - share)
        }
    };
    view! { <div class="beside-cursor" style:inset=inset>{move || readout.get().map(Readout::view)}</div> }
}
