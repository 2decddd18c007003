//! What a new bench costs on the page: a study, a few lines of [`Bench`], and an entry in the list.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::study::quadruple_tank::Setup;
use quadtank::study::{Quantity, Study};
use quadtank_lab::{Bench, BenchEntry, Lab, Lock, Panel, Session, part_of};
use quadtank_scenario::{BenchDocument, Scenario, to_link};
use wasm_bindgen_test::wasm_bindgen_test;

use crate::page::Page;

/// γ1 + γ2, which is 1 where the plant is singular at steady state (Johansson 2000).
struct GammaSum;

#[derive(Clone)]
struct Results {
    setup: Arc<Setup>,
    sum: Arc<f64>,
}

impl Study for GammaSum {
    type Setup = Setup;
    type Results = Results;
    const QUANTITIES: &'static [Quantity<Results>] =
        &[Quantity { name: "valves.sum", unit: "1", description: "γ1 + γ2.", read: |results| Some(*results.sum) }];

    fn setup_of(results: &Results) -> &Arc<Setup> {
        &results.setup
    }

    fn update(setup: &Setup, _: &[Setup], _: Option<&Results>) -> Results {
        Results { setup: Arc::new(setup.clone()), sum: Arc::new(setup.valves.iter().sum()) }
    }
}

struct GammaSumBench;

const SUM: Panel = Panel("sum");
const OPENING: Lock = Lock("opening");

impl Bench for GammaSumBench {
    const ID: &'static str = "gamma-sum";
    const PICTURE: &'static str = "M4 4H44V28H4Z";
    const CLASS: &'static str = "bench";
    const PANELS: &'static [Panel] = &[SUM];
    const LOCKS: &'static [Lock] = &[OPENING];
    type Document = Scenario;
    type Study = GammaSum;
    type Found = Memo<Arc<f64>>;
    type Own = ();

    fn found(results: RwSignal<Results>) -> Memo<Arc<f64>> {
        part_of(results, |results| &results.sum)
    }

    fn own(_: RwSignal<Scenario>) {}

    fn title(_: Lab) -> String {
        "γ1 + γ2".to_owned()
    }

    fn about(_: Lab) -> String {
        "The sum of the valve fractions".to_owned()
    }

    fn cards(session: Session<Self>) -> AnyView {
        let open = move |event| session.edit(|setup| setup.valves[0] = event_target_value(&event).parse().unwrap());
        let lab = session.lab;
        let sum = move || view! { <p data-testid="sum">{move || format!("{:.2}", session.throttled.get())}</p> };
        view! {
            <input type="range" min=0 max=1 step="any" data-testid="valve" disabled=lab.locks(OPENING) on:input=open />
            {lab.shows(SUM).then(sum)}
        }
        .into_any()
    }
}

static BENCHES: [BenchEntry; 1] = [BenchEntry::of::<GammaSumBench>()];

#[wasm_bindgen_test]
async fn a_new_bench_is_shown_and_follows_its_document() {
    let page = Page::with(&BENCHES, "lang=en").await;
    assert_eq!(page.text("sum"), "1.30");
    page.set("valve", "0.4").await;
    assert_eq!(page.text("sum"), "1.00");
    assert_eq!(page.text("bench-gamma-sum"), "γ1 + γ2The sum of the valve fractions");
}

#[wasm_bindgen_test]
async fn a_link_opens_on_the_new_bench() {
    let mut scenario = Scenario::default();
    scenario.setup_mut().valves = [0.25, 0.5];
    let link = to_link(&scenario).unwrap();
    let page = Page::with(&BENCHES, &format!("lang=en#lab={link}")).await;
    assert_eq!(page.text("sum"), "0.75");
}

#[wasm_bindgen_test]
async fn a_new_bench_has_cards_and_locks_of_its_own() {
    let page = Page::with(&BENCHES, "panels=sum&lock=opening").await;
    assert_eq!(page.text("sum"), "1.30");
    assert!(page.is_disabled("valve"));
    let page = Page::with(&BENCHES, "panels=valves&lock=valves").await;
    assert_eq!(page.text("sum"), "1.30");
    assert!(!page.is_disabled("valve"));
}
