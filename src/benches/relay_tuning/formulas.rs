//! A plant of one's own: its elements as formulas, or lines of MATLAB or python-control.

use leptos::prelude::*;

use super::flags::locks;
use super::session::{Session, use_session};
use crate::errors::{of_error, of_fault};
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::is_open;
use quadtank::literature::DisplayUnit;
use quadtank::study::relay_tuning::{Element, TuningPlant, TuningSetup};
use quadtank_formula::{FormulaError, FormulaFault, Position, element_from_formula, elements_from_script, formula_of};
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{BenchDocument, ScenarioError};

/// Why a text was not taken over.
#[derive(Clone, Debug, PartialEq)]
enum Refusal {
    /// It is no formula or script.
    Formula(FormulaError),
    /// Its plant is none that a document can hold.
    Document(ScenarioError),
}

/// The editor, folded away.
#[component]
pub fn OwnPlant() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let open = RwSignal::new(false);
    view! {
        <details class="more formulas" on:toggle=move |event| open.set(is_open(&event))>
            <summary data-testid="own-plant">{say!(lab, relay.formulas)}</summary>
            <Show when=move || open.get()>
                <p class="remark">{say!(lab, relay.formulas_remark)}</p>
                <div class="matrix">
                    <FormulaField row=0 column=0 />
                    <FormulaField row=0 column=1 />
                    <FormulaField row=1 column=0 />
                    <FormulaField row=1 column=1 />
                </div>
                <ScriptField />
            </Show>
        </details>
    }
}

/// What is being typed into the field of an element.
#[derive(Clone)]
struct Draft {
    text: String,
    refusal: Option<Refusal>,
    /// The formula in force. The draft is void when another takes its place.
    formula: String,
}

/// One element, taken over as it is typed. A text that is refused stays, with the reason, and the plant as it was.
#[component]
fn FormulaField(row: usize, column: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    // Points stand in numbers only.
    let written =
        move |element: &Element| formula_of(element).replace('.', lab.number_style().decimal.encode_utf8(&mut [0; 4]));
    let formula =
        session.part(move |s| s.plant.elements().map_or_else(|_| String::new(), |e| written(&e[row][column])));
    let draft = RwSignal::new(None::<Draft>);
    let typed = move || draft.get().filter(|draft| draft.formula == formula.get());
    let refusal = Memo::new(move |_| typed().and_then(|draft| draft.refusal));
    let text = Memo::new(move |_| typed().map_or_else(|| formula.get(), |draft| draft.text));
    let on_input = move |event| {
        let text = event_target_value(&event);
        let refusal = take_element(session, row, column, &text).err();
        draft.set(Some(Draft { text, refusal, formula: formula.get_untracked() }));
    };
    let id = format!("g{}{}", row + 1, column + 1);
    let problem_id = format!("{id}-problem");
    let described = problem_id.clone();
    view! {
        <div>
            <label for=id.clone()>"g"<sub>{row + 1}{column + 1}</sub></label>
            <input
                type="text"
                id=id.clone()
                data-testid=id
                class="text-field code"
                spellcheck="false"
                autocomplete="off"
                aria-label=say!(lab, relay.formula_of, input = column + 1, output = row + 1)
                aria-invalid=move || refusal.get().map(|_| "true")
                aria-describedby=move || refusal.get().map(|_| described.clone())
                prop:value=text
                disabled=lab.locks(locks::PLANT)
                on:input=on_input
                on:keydown=move |event| {
                    if event.key() == "Escape" && draft.with_untracked(Option::is_some) {
                        event.stop_propagation();
                        draft.set(None);
                    }
                }
            />
            {move || refusal.get().map(|refusal| view! { <Problem id=problem_id.clone() refusal text=text.get() /> })}
        </div>
    }
}

/// A script, taken over with a button.
#[component]
fn ScriptField() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let text = RwSignal::new(String::new());
    let outcome = RwSignal::new(None::<Result<(), Refusal>>);
    let is_refused = move || outcome.with(|outcome| matches!(outcome, Some(Err(_))));
    let take = move |_| outcome.set(Some(text.with_untracked(|text| take_script(session, text))));
    let answer = move || {
        outcome.get().map(|outcome| match outcome {
            Ok(()) => {
                view! { <p role="status" data-testid="script-taken">{tr!(lab, relay.script_taken)}</p> }.into_any()
            }
            Err(refusal) => {
                view! { <Problem id="script-problem".to_owned() refusal text=text.get_untracked() /> }.into_any()
            }
        })
    };
    view! {
        <label class="script">
            {say!(lab, relay.script)}
            <textarea
                rows="5"
                class="code"
                data-testid="script"
                spellcheck="false"
                placeholder="s = tf('s');  G = [1/(5*s + 1), 0.2/(2*s + 1); 0.3/(3*s + 1), 1/(4*s + 1)]"
                aria-invalid=move || is_refused().then_some("true")
                aria-describedby=move || is_refused().then_some("script-problem")
                prop:value=text
                disabled=lab.locks(locks::PLANT)
                on:input=move |event| {
                    text.set(event_target_value(&event));
                    outcome.set(None);
                }
            ></textarea>
        </label>
        <p class="remark">{say!(lab, relay.script_remark)}</p>
        <button type="button" class="button" data-testid="take-script" disabled=lab.locks(locks::PLANT) on:click=take>
            {say!(lab, relay.take_script)}
        </button>
        {answer}
    }
}

/// Why a text is refused, and where.
#[component]
fn Problem(id: String, refusal: Refusal, text: String) -> impl IntoView {
    let lab = use_session().lab;
    let excerpt = match &refusal {
        Refusal::Formula(error) if !text.trim().is_empty() => Some(error.excerpt(&text)),
        _ => None,
    };
    let is_long = text.lines().count() > 1;
    view! {
        <div class="problem" role="alert" id=id>
            {excerpt.map(|excerpt| view! { <pre aria-hidden="true">{excerpt}</pre> })}
            {move || sentence(lab, &refusal, is_long.then_some(&text))}
        </div>
    }
}

/// The reason, with the place in a text of several lines.
fn sentence(lab: Lab, refusal: &Refusal, text: Option<&String>) -> String {
    match (refusal, text) {
        (Refusal::Formula(error), Some(text)) => {
            let Position { line, column, .. } = error.position(text);
            tr!(lab, formula.place, line = line, column = column, reason = of_formula(lab, &error.fault))
        }
        (Refusal::Formula(error), None) => of_formula(lab, &error.fault),
        (Refusal::Document(ScenarioError::Element { fault, .. }), _) => {
            tr!(lab, formula.element, reason = of_fault(lab, *fault))
        }
        (Refusal::Document(error), _) => of_error(lab, DisplayUnit::Cm, error),
    }
}

/// What is wrong with a formula or script.
fn of_formula(lab: Lab, fault: &FormulaFault) -> String {
    let number = |value: f64| lab.number_style().significant(value, 4);
    match fault {
        FormulaFault::TooLong { length, max } => tr!(lab, formula.too_long, length = length, max = max),
        FormulaFault::UnexpectedEnd => tr!(lab, formula.end),
        FormulaFault::Unexpected { found } => tr!(lab, formula.unexpected, found = found),
        FormulaFault::UnknownName { name } => tr!(lab, formula.unknown_name, name = name),
        FormulaFault::PadeApproximation => tr!(lab, formula.pade),
        FormulaFault::StateSpaceModel => tr!(lab, formula.state_space),
        FormulaFault::ImaginaryUnit { name } => tr!(lab, formula.imaginary, name = name),
        FormulaFault::OpenQuotation => tr!(lab, formula.quotation),
        FormulaFault::TooDeep { max } => tr!(lab, formula.deep, max = max),
        FormulaFault::NoElement => tr!(lab, formula.no_element),
        FormulaFault::NoCoefficients => tr!(lab, formula.no_coefficients),
        FormulaFault::Exponent { max } => tr!(lab, formula.exponent, max = max),
        FormulaFault::DivisionByZero => tr!(lab, formula.division),
        FormulaFault::NoDeadTime => tr!(lab, formula.no_dead_time),
        FormulaFault::Future { dead_time } => tr!(lab, formula.future, time = number(*dead_time)),
        FormulaFault::DifferentDeadTimes { first, second } => {
            tr!(lab, formula.different, first = number(*first), second = number(*second))
        }
        FormulaFault::DegreeTooHigh { degree, max } => tr!(lab, formula.degree, degree = degree, max = max),
        FormulaFault::NotFinite => tr!(lab, formula.not_finite),
        FormulaFault::UnknownOption { name } => tr!(lab, formula.option, name = name),
        FormulaFault::Shape => tr!(lab, formula.shape),
        FormulaFault::NoPlant => tr!(lab, formula.no_plant),
    }
}

fn take_element(session: Session, row: usize, column: usize, text: &str) -> Result<(), Refusal> {
    let element = element_from_formula(text).map_err(Refusal::Formula)?;
    let setup = session.document.with_untracked(|s| with_element(&s.tuning, row, column, element));
    take(session, setup.map_err(Refusal::Document)?);
    Ok(())
}

fn take_script(session: Session, text: &str) -> Result<(), Refusal> {
    let elements = elements_from_script(text).map_err(Refusal::Formula)?;
    let setup = checked(TuningSetup::on(TuningPlant::Elements(elements)));
    take(session, setup.map_err(Refusal::Document)?);
    Ok(())
}

/// The session of another plant.
fn take(session: Session, setup: TuningSetup) {
    session.edit(|s| *s = setup);
}

/// The session with another element: with its tests and controllers where these suit the plant, else with those that a session on it
/// begins with.
fn with_element(
    setup: &TuningSetup,
    row: usize,
    column: usize,
    element: Element,
) -> Result<TuningSetup, ScenarioError> {
    let mut elements = setup.plant.elements().unwrap_or_default();
    elements[row][column] = element;
    let plant = TuningPlant::Elements(elements);
    let kept = TuningSetup { plant: plant.clone(), ..setup.clone() };
    checked(kept).or_else(|_| checked(TuningSetup::on(plant)))
}

fn checked(setup: TuningSetup) -> Result<TuningSetup, ScenarioError> {
    let document = TuningScenario::from(setup);
    document.validate()?;
    Ok(document.tuning)
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadtank::literature::campestrini::PublishedPlant;

    #[test]
    fn another_element_keeps_the_session_where_it_suits_the_plant() {
        let setup = TuningSetup::default();
        let element = element_from_formula("13 exp(-s)/(16.7 s + 1)").unwrap();
        let changed = with_element(&setup, 0, 0, element.clone()).unwrap();
        let TuningPlant::Elements(rows) = &changed.plant else { panic!("{:?}", changed.plant) };
        let column = TuningPlant::Published(PublishedPlant::WoodBerry).elements().unwrap();
        assert_eq!((&rows[0][0], &rows[0][1], &rows[1]), (&element, &column[0][1], &column[1]));
        assert_eq!((changed.test, changed.design, changed.response), (setup.test, setup.design, setup.response));

        // A lag of a microsecond cannot be followed for 400 minutes, so that the records become shorter.
        let quick = ["1/(1e-6 s + 1)", "0", "0", "1/(1e-6 s + 1)"].map(|text| element_from_formula(text).unwrap());
        let [g11, g12, g21, g22] = quick;
        let own =
            TuningSetup { plant: TuningPlant::Elements([[g11.clone(), g12.clone()], [g21, g22.clone()]]), ..setup };
        assert!(checked(own.clone()).is_err());
        assert!(with_element(&own, 0, 1, g12).is_ok_and(|fresh| fresh.test.duration < 1.0));
    }

    #[test]
    fn a_plant_that_no_document_holds_is_refused() {
        let refused = |text: &str| with_element(&TuningSetup::default(), 0, 0, element_from_formula(text).unwrap());
        assert!(matches!(refused("(s^2 + 1)/(2 s + 1)"), Err(ScenarioError::Element { .. })));
        assert!(matches!(refused("1/(s - 1)"), Err(ScenarioError::Element { .. })));
        assert!(matches!(refused("1/(s + 1)^12"), Err(ScenarioError::TooMany { .. })));
    }
}
