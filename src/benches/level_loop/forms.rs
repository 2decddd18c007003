//! Forms of PI controllers: what the present tuning is on the dials of commercial ones, and what happens where they are mistaken.

use leptos::prelude::*;
use quadtank::control::{IntegralDial, PiDials, PiForm, ProportionalDial};
use quadtank::literature::andreis::{COMMERCIAL_CONTROLLERS, CommercialController};
use quadtank::study::level_loop::{LevelLoopSetup, PiTuning};

use super::flags::{locks, panels};
use super::session::{Session, use_session};
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Figures, Row, TableContent, Text};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::pi_forms, terms::proportional_band, terms::integral_time];

/// Gain and time of a parallel controller, as its dials have them.
const PARALLEL: PiDials =
    PiDials { form: PiForm::Parallel, proportional: ProportionalDial::Gain, integral: IntegralDial::Time };

/// The forms.
#[component]
pub fn FormsCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let tuning = session.part(LevelLoopSetup::pi_tuning);
    let mistake = move |_| {
        session.edit(|s| {
            if let Some(tuning) = s.pi_tuning() {
                let [gain, integral_time_s] = PARALLEL.settings([tuning.gain, tuning.integral_time_s]);
                s.set_pi_tuning(PiTuning { gain, integral_time_s });
            }
        });
    };
    view! {
        <Card name="forms" panel=panels::FORMS title=say!(lab, level.forms) terms=TERMS>
            <p class="sentence">{move || sentence(session)}</p>
            <Figures name="level-forms" caption=say!(lab, level.dials_caption)>{move || table(session)}</Figures>
            <p class="remark">{move || common(session)}</p>
            <div class="toolbar">
                <button
                    type="button"
                    class="button small"
                    data-testid="forms-mistake"
                    disabled=move || tuning.get().is_none() || lab.locks(locks::GAINS)
                    on:click=mistake
                >
                    {say!(lab, level.mistake)}
                </button>
            </div>
            <p class="remark">{say!(lab, level.mistake_remark)}</p>
        </Card>
    }
}

/// The tuning in all forms.
fn sentence(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let Some(tuning) = session.throttled.setup.with(|setup| setup.pi_tuning()) else {
        return tr!(lab, level.no_pi);
    };
    let number = |value: f64| style.significant(value, 4);
    let [band, rate] = PiDials {
        form: PiForm::Series,
        proportional: ProportionalDial::Band,
        integral: IntegralDial::RepeatsPerMinute,
    }
    .of(tuning.gain, tuning.integral_time_s);
    let [_, parallel] = PARALLEL.of(tuning.gain, tuning.integral_time_s);
    tr!(
        lab,
        level.form_values,
        gain = number(tuning.gain),
        time = number(tuning.integral_time_s),
        band = number(band),
        rate = number(rate),
        parallel = number(parallel)
    )
}

/// The dials of the commercial controllers of Andreis (2017, Tables 4.3 and 4.4) for the present tuning.
fn table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let style = lab.number_style();
    let number = |value: f64| style.significant(value, 4);
    let tuning = session.throttled.setup.with(|setup| setup.pi_tuning());
    let columns = vec![
        tr!(lab, level.column_maker),
        tr!(lab, level.column_form),
        tr!(lab, level.column_dials),
        tr!(lab, level.column_gain_range),
        tr!(lab, level.column_time_range),
    ];
    let row = |controller: &CommercialController| {
        let form = match controller.dials.form {
            PiForm::Series => tr!(lab, level.series),
            PiForm::Parallel => tr!(lab, level.parallel),
        };
        let integral_unit = match controller.dials.integral {
            IntegralDial::Time => "s",
            IntegralDial::RepeatsPerMinute => "rep/min",
        };
        let [gains, times] = controller.ranges();
        let dials = tuning.map_or_else(
            || "–".to_owned(),
            |tuning| {
                let fits = gains[0] <= tuning.gain
                    && tuning.gain <= gains[1]
                    && times[0] <= tuning.integral_time_s
                    && tuning.integral_time_s <= times[1];
                let [band, integral] = controller.dials.of(tuning.gain, tuning.integral_time_s);
                let text = format!("PB {} % · {} {integral_unit}", number(band), number(integral));
                if fits { text } else { format!("{text} ({})", tr!(lab, level.out_of_range)) }
            },
        );
        let range = |[low, high]: [f64; 2]| format!("{} – {}", number(low), number(high));
        let figures = vec![form, dials, range(gains), range(times)];
        view! { <Row name=controller.name figures /> }.into_any()
    };
    let rows = COMMERCIAL_CONTROLLERS.iter().map(row).collect();
    view! { <TableContent caption=tr!(lab, level.dials_caption) columns rows /> }
}

/// What all controllers of the table can be set to.
fn common(session: Session) -> String {
    let lab = session.lab;
    let number = |value: f64| lab.number_style().significant(value, 3);
    let [gains, times] = CommercialController::common_ranges();
    tr!(
        lab,
        level.common_box,
        least = number(gains[0]),
        most = number(gains[1]),
        shortest = number(times[0]),
        longest = number(times[1])
    )
}
