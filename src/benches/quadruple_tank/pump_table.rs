//! Steps of the pumps that are typed or pasted, a line for each.

use leptos::prelude::*;
use quadtank_record::{RecordError, pump_sequence, pump_sequence_text};

use super::flags::locks;
use super::record_errors::why;
use super::session::use_session;
use crate::texts::{say, tr};
use crate::widgets::is_open;

/// Most steps that are written into the field: those of a record are in its file.
const MOST_WRITTEN: usize = 1000;

/// A field for the steps, folded away; it begins with those that the experiment has.
#[component]
pub fn PumpTable() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let text = RwSignal::new(String::new());
    let outcome = RwSignal::new(None::<Result<usize, RecordError>>);
    let write_present = move |event| {
        if is_open(&event) {
            let present = session.document.with_untracked(|document| {
                let steps = &document.setup.experiment.pump_voltage_steps;
                (steps.len() <= MOST_WRITTEN).then(|| pump_sequence_text(steps))
            });
            text.set(present.unwrap_or_default());
            outcome.set(None);
        }
    };
    let take = move |_| {
        let steps = text.with_untracked(|text| pump_sequence(text));
        outcome.set(Some(steps.as_ref().map(Vec::len).map_err(Clone::clone)));
        if let Ok(steps) = steps {
            session.edit(|setup| setup.experiment.pump_voltage_steps = steps);
        }
    };
    let told = move || match outcome.get()? {
        Ok(count) => Some(tr!(lab, experiment.table_used, count = count)),
        // What is missing is said above the field.
        Err(RecordError::Empty | RecordError::OneColumn) => Some(tr!(lab, experiment.table_lines)),
        Err(error) => Some(why(lab, &error)),
    };
    let is_refused = move || outcome.with(|outcome| matches!(outcome, Some(Err(_))));
    let disabled = lab.locks(locks::EXPERIMENT);
    view! {
        <details class="more" data-testid="pump-table" on:toggle=write_present>
            <summary>{say!(lab, experiment.table)}</summary>
            <label class="text">
                {say!(lab, experiment.table_lines)}
                <textarea
                    rows="6"
                    class="text-field"
                    data-testid="pump-table-text"
                    spellcheck="false"
                    aria-invalid=move || is_refused().then_some("true")
                    disabled=disabled
                    prop:value=text
                    on:input=move |event| {
                        text.set(event_target_value(&event));
                        outcome.set(None);
                    }
                ></textarea>
            </label>
            <p class="links">
                <button type="button" class="button small" data-testid="pump-table-use" disabled=disabled on:click=take>
                    {say!(lab, experiment.table_use)}
                </button>
                <span class="remark" role="status" data-testid="pump-table-told" class:warm=is_refused>{told}</span>
            </p>
        </details>
    }
}
