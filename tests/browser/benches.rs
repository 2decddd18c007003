//! Each bench by itself: move a control, read a result.

use wasm_bindgen_test::wasm_bindgen_test;

use crate::page::Page;

#[wasm_bindgen_test]
async fn on_the_home_bench_the_zero_crosses_with_the_valves() {
    let page = Page::open("preset=johansson-2000-minimum-phase&lang=en").await;
    assert!(page.text("process-sentence").contains("minimum phase"), "{}", page.text("process-sentence"));
    assert!(page.number("lambda-11") > 1.0);
    page.set("gamma1-number", "0.4").await;
    page.set("gamma2-number", "0.3").await;
    assert!(page.text("process-sentence").contains("right half-plane"), "{}", page.text("process-sentence"));
    // λ11 = γ1 γ2/(γ1 + γ2 − 1) = −0.4 (Johansson 2000), to half a unit of the last digit that the page shows.
    assert!((page.number("lambda-11") + 0.4).abs() < 0.005, "{}", page.text("lambda-11"));
    assert!(page.text("rga-verdict").contains("level 1 – pump 2"), "{}", page.text("rga-verdict"));
}

#[wasm_bindgen_test]
async fn on_the_relay_bench_a_smaller_ratio_ends_the_simple_oscillation() {
    let page = Page::open("bench=relay-tuning&lang=en&view=full").await;
    assert!(page.text("test-verdict").contains("Unimodal"), "{}", page.text("test-verdict"));
    // Between 0.6 and 0.15 no test of Wood and Berry's column is unimodal (Campestrini 2006, §4.3).
    page.set("ratio-number", "0.4").await;
    let verdict = page.text("test-verdict");
    assert!(verdict.starts_with("Multimodal") || verdict.starts_with("Not periodic"), "{verdict}");
}

#[wasm_bindgen_test]
async fn on_the_model_free_bench_case_b_loses_a_level() {
    let page = Page::open("bench=model-free&lang=en&view=full").await;
    for button in ["free-b", "free-s3"] {
        page.press(button).await;
    }
    assert!(page.text("free-verdict").contains("Level 1 is lost at 135 s"), "{}", page.text("free-verdict"));
    page.press("free-a").await;
    assert!(!page.text("free-verdict").contains("is lost"), "{}", page.text("free-verdict"));
}

#[wasm_bindgen_test]
async fn on_the_level_loop_the_outflow_takes_what_the_level_does_not() {
    let page = Page::open("bench=level-loop&lang=en&view=full").await;
    // Andreis (2017, Table 5.9): the current tuning has 0.0130 of the quality of the best one under Sine L.
    assert!(page.text("level-index").contains("0.013"), "{}", page.text("level-index"));
    page.press("objective-averaging").await;
    // Table 5.12.
    assert!(page.text("level-index").contains("0.015"), "{}", page.text("level-index"));
    page.press("kind-off").await;
    assert!(page.text("level-quality").contains("No loop is closed"), "{}", page.text("level-quality"));
    page.set("level-inflow-number", "60").await;
    assert!(page.text("level-verdict").contains("No run."), "{}", page.text("level-verdict"));
}

#[wasm_bindgen_test]
async fn a_lock_of_an_instructor_disables_the_valves() {
    let page = Page::open("lock=valves&lang=en").await;
    assert!(page.is_disabled("gamma1") && page.is_disabled("gamma1-number"));
    assert!(!page.is_disabled("gain1"));
}
