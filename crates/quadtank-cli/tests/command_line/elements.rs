//! The commands on plants of one's own, and on a response that is compared with another.

use approx::assert_relative_eq;
use serde_json::{Value, json};

use super::{pipe, run, stderr, stdout};

/// The published session of Table 12, row 2, with four elements in the place of its plant.
fn session(elements: &Value) -> Value {
    let mut session: Value = serde_json::from_str(&stdout(&run(&["cases", "table-12-row-2"]))).unwrap();
    session["tuning"]["plant"] = json!({ "elements": elements });
    session
}

fn element(numerator: &[f64], denominator: &[f64], dead_time: f64) -> Value {
    json!({ "numerator": numerator, "denominator": denominator, "dead_time": dead_time })
}

fn report(command: &str, session: &Value) -> Value {
    serde_json::from_str(&stdout(&pipe(&[command, "-"], session.to_string().as_bytes()))).unwrap()
}

/// Wood and Berry with the coefficients of the denominators in either order.
fn column(denominator: fn(f64) -> [f64; 2]) -> Value {
    let of = |gain, time, dead_time| element(&[gain], &denominator(time), dead_time);
    json!([[of(12.8, 16.7, 1.0), of(-18.9, 21.0, 3.0)], [of(6.6, 10.9, 7.0), of(-19.4, 14.4, 3.0)]])
}

#[test]
fn coefficients_in_the_other_order_are_told_beside_the_answer() {
    let meant = session(&column(|time| [1.0, time]));
    let turned = session(&column(|time| [time, 1.0]));
    let field = "tuning.plant.elements[0][0].denominator";
    for command in ["analyse", "tune"] {
        assert_eq!(report(command, &meant)["warnings"], json!([]));
        let expected = json!([{
            "warning": "coefficient-order", "field": field, "read_as": "16.7 + 1 s", "reversed": "1 + 16.7 s",
        }]);
        assert_eq!(report(command, &turned)["warnings"], expected);
    }
    assert_relative_eq!(report("analyse", &meant)["rga_11"].as_f64().unwrap(), 2.0094, epsilon = 5.1e-5);
    for command in
        [&["analyse", "-"][..], &["tune", "-", "--format", "csv"], &["simulate", "-"], &["plot", "-", "--svg", "-"]]
    {
        assert_eq!(stderr(&pipe(command, meant.to_string().as_bytes())), "");
        let said = stderr(&pipe(command, turned.to_string().as_bytes()));
        assert!(
            said.starts_with(&format!("quadtank: standard input: warning: {field}: read by rising powers of s")),
            "{said}"
        );
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    for help in [&["--help"][..], &["analyse", "--help"], &["tune", "--help"]] {
        let text = stdout(&run(help));
        assert!(text.contains("rising powers of s"), "{text}");
    }
}

#[test]
fn an_element_that_is_not_supported_is_named() {
    let improper = json!([
        [element(&[1.0], &[5.0, 1.0], 0.0), element(&[1.0, 0.0, 2.0], &[1.0, 1.0], 0.0)],
        [element(&[1.0], &[2.0, 1.0], 0.0), element(&[1.0], &[1.0], 0.0)],
    ]);
    for command in ["analyse", "tune", "simulate"] {
        let output = pipe(&[command, "-"], session(&improper).to_string().as_bytes());
        assert_eq!(output.status.code(), Some(2));
        let expected = "quadtank: standard input: tuning.plant.elements[0][1]: an improper element";
        assert!(stderr(&output).starts_with(expected), "{}", stderr(&output));
    }
}

#[test]
fn biproper_elements_answer_and_say_what_cannot_work() {
    // (s + 1)/(s + 5), 1; (s + 1)/(s + 2), 1: λ11 = 0.2/(0.2 − 0.5) at rest.
    let one = element(&[1.0], &[1.0], 0.0);
    let leading = |pole: f64| element(&[1.0, 1.0], &[pole, 1.0], 0.0);
    let mut session = session(&json!([[leading(5.0), one], [leading(2.0), one]]));
    let found = report("analyse", &session);
    assert_eq!(found["feedthrough"], json!([[1.0, 1.0], [1.0, 1.0]]));
    assert_relative_eq!(found["rga_11"].as_f64().unwrap(), -2.0 / 3.0, max_relative = 1e-12);
    let real = |name: &str, k: usize| found[name][k]["re"].as_f64().unwrap();
    assert_relative_eq!(real("zeros", 0), -1.0, max_relative = 1e-9);
    assert_relative_eq!(real("poles", 0), -5.0, max_relative = 1e-9);
    assert_relative_eq!(real("poles", 1), -2.0, max_relative = 1e-9);
    let warning = json!({ "warning": "switches-itself", "number": 1, "half_width": 1.0 });
    assert_eq!(found["warnings"][0], warning);
    // Relays switch at once, and the loop through the feedthrough has an eigenvalue of 2 K = −2.
    session["tuning"]["design"] = json!({ "controllers": [{ "gain": -1.0 }, { "gain": -1.0 }] });
    let found = report("tune", &session);
    assert_eq!(found["test"]["reading"]["verdict"], json!("chattering"));
    let stability = &found["design"]["roots"][0]["stability"];
    assert_eq!(*stability, json!({ "stable": false, "eigenvalue_at_infinity": -2.0 }));
    assert_eq!(found["design"]["roots"][0]["gain_margin"], Value::Null);
    session["tuning"]["design"] = json!({ "controllers": [{ "gain": 0.5 }, { "gain": 0.5, "integral_time": 2.0 }] });
    let found = report("tune", &session);
    assert_eq!(found["design"]["roots"][0]["stability"], json!({ "stable": true }));
}

#[test]
fn integrating_elements_answer_with_what_they_are_in_the_limit() {
    let rising = |rate: f64, dead_time: f64| element(&[rate], &[0.0, 1.0], dead_time);
    let elements =
        json!([[rising(1.0, 0.5), rising(0.5, 1.0)], [element(&[1.0], &[1.0, 2.0], 0.0), rising(-2.0, 0.4)]]);
    let mut session = session(&elements);
    for (name, value) in [("duration", 40.0), ("step", 0.01)] {
        session["tuning"]["test"][name] = json!(value);
        session["tuning"]["response"][name] = json!(value);
    }
    session["tuning"]["design"]["controllers"] =
        json!([{ "gain": 0.8, "integral_time": 6.0 }, { "gain": -0.4, "integral_time": 6.0 }]);
    let found = report("analyse", &session);
    assert_eq!(found["dc_gain"], json!([[null, null], [1.0, null]]));
    assert_eq!(found["integrators"], json!([[1, 1], [0, 1]]));
    // g12 g21 is infinitely smaller than g11 g22 for s → 0.
    assert_eq!((&found["rga_11"], &found["niederlinski_diagonal"]), (&json!(1.0), &json!(1.0)));
    assert_eq!(found["critical_curve"].as_array().unwrap().len(), 200);
    let found = report("tune", &session);
    let root = &found["design"]["roots"][0];
    assert_eq!(root["stability"], json!({ "stable": true }));
    assert!(root["phase_margin_rad"].as_f64().unwrap() > 0.3 && root["sensitivity_peak"].as_f64().unwrap() < 4.0);
    assert!(
        found["design"]["figures"][0]["settling_time_2_percent"].as_f64().is_some(),
        "{}",
        found["design"]["figures"]
    );
    assert!(found["test"]["reading"]["oscillation"].is_object(), "{}", found["test"]);
    let simc = found["rules"].as_array().unwrap().iter().find(|rule| rule["rule"] == "simc").unwrap();
    // 1/(2 k′ θ) and 8 θ.
    assert_eq!(simc["controllers"][0], json!({ "gain": 1.0, "integral_time": 4.0, "derivative_time": 0.0 }));
}

#[test]
fn analyse_answers_in_place_where_the_gain_is_singular() {
    let one = element(&[1.0], &[1.0, 1.0], 0.0);
    let found = report("analyse", &session(&json!([[one, one], [one, one]])));
    assert_eq!(found["rga_11"]["error"], "singular-gain");
    assert_eq!(found["niederlinski_diagonal"], Value::Null);
    assert_eq!(found["dc_gain"], json!([[1.0, 1.0], [1.0, 1.0]]));
    assert_eq!(found["critical_curve"].as_array().unwrap().len(), 200);
    // A loop without a gain of its own has no curve, but a relative gain: λ11 = 0.
    let none = element(&[0.0], &[1.0, 1.0], 0.0);
    let found = report("analyse", &session(&json!([[none, one], [one, one]])));
    assert_eq!((&found["rga_11"], &found["niederlinski_diagonal"]), (&json!(0.0), &Value::Null));
    let expected = json!({ "error": "no-own-gain", "number": 1, "other_pairing": true });
    assert_eq!(found["critical_curve"], expected);
}

#[test]
fn a_comparison_is_in_the_report_and_in_the_table() {
    let mut session: Value = serde_json::from_str(&stdout(&run(&["cases", "table-12-row-2"]))).unwrap();
    assert_eq!(report("tune", &session)["design"]["comparison"], Value::Null);
    let alone = stdout(&pipe(&["simulate", "-"], session.to_string().as_bytes()));
    session["tuning"]["response"]["compare"] = json!("tyreus-luyben");
    let comparison = report("tune", &session)["design"]["comparison"].clone();
    // Kc/2.2, 2.2 Tc and Tc/6.3 (Campestrini 2006, Table 2) of Kc = 0.71 and −0.264, Tc = 12.7.
    for (row, gain) in [(0, 0.71 / 2.2), (1, -0.264 / 2.2)] {
        let controller = &comparison["controllers"][row][row];
        let value = |name: &str| controller[name].as_f64().unwrap();
        assert_relative_eq!(value("kp"), gain, max_relative = 1e-12);
        assert_relative_eq!(value("ki"), gain / (2.2 * 12.7), max_relative = 1e-12);
        assert_relative_eq!(value("kd"), gain * 12.7 / 6.3, max_relative = 1e-12);
    }
    assert_eq!(comparison["stability"]["stable"], json!(true));
    assert!(comparison["figures"][0]["iae"].as_f64().unwrap() > 0.0);

    let table = stdout(&pipe(&["simulate", "-"], session.to_string().as_bytes()));
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(header[5..], ["compared_output_1", "compared_output_2", "compared_input_1", "compared_input_2"]);
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 9));
    // The columns of the design are those of the table without a comparison.
    let of_design: Vec<String> = rows.iter().filter(|row| !row[1].is_empty()).map(|row| row[..5].join(",")).collect();
    assert_eq!(of_design, alone.lines().skip(1).collect::<Vec<_>>());
    let times: Vec<f64> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
    assert!(times.is_sorted());
    // It follows the step.
    let compared: Vec<f64> = rows.iter().filter(|row| !row[5].is_empty()).map(|row| row[5].parse().unwrap()).collect();
    assert!((compared.last().unwrap() - 1.0).abs() < 0.1, "{:?}", compared.last());
    let svg = |session: &Value| {
        stdout(&pipe(&["plot", "-", "--svg", "-", "--picture", "response"], session.to_string().as_bytes()))
    };
    session["tuning"]["response"]["compare"] = json!("nothing");
    let without = svg(&session).matches("<path").count();
    session["tuning"]["response"]["compare"] = json!("full");
    assert!(svg(&session).matches("<path").count() > without);
}

#[test]
fn a_plant_is_taken_from_a_script() {
    let script = "s = tf('s');\n\
        G = [12.8*exp(-s)/(16.7*s + 1), -18.9*exp(-3*s)/(21*s + 1);\n  \
             6.6*exp(-7*s)/(10.9*s + 1), -19.4*exp(-3*s)/(14.4*s + 1)];\n";
    let session: Value = serde_json::from_str(&stdout(&pipe(&["elements", "-"], script.as_bytes()))).unwrap();
    assert_eq!(session["tuning"]["plant"]["elements"], column(|time| [1.0, time]));
    let analysis = report("analyse", &session);
    assert_relative_eq!(analysis["rga_11"].as_f64().unwrap(), 2.0094, epsilon = 5.1e-5);
    // The rules are those of the column.
    let tuned = report("tune", &session);
    let rules = tuned["rules"].as_array().unwrap();
    let blt = rules.iter().find(|rule| rule["rule"] == "blt").unwrap();
    assert_relative_eq!(blt["controllers"][0]["gain"].as_f64().unwrap(), 0.375, max_relative = 0.02);
    assert_relative_eq!(blt["biggest_log_modulus_db"].as_f64().unwrap(), 4.0, max_relative = 1e-4);
    assert!(rules.iter().all(|rule| rule["refused"].is_null()), "{rules:?}");
}

#[test]
fn a_script_without_a_plant_is_one_line_with_the_place() {
    let said = |script: &str| stderr(&pipe(&["elements", "-"], script.as_bytes()));
    let expected = "quadtank: standard input: line 2, column 9: `tau` is not known; the variable is s, functions are exp, tf and zpk\n";
    assert_eq!(said("a = 1;\nG = 1/(1tau*s + 1)\n"), expected);
    let improper = "G = [s^2/(s + 1), 0; 0, 1/s]";
    assert!(said(improper).contains("an improper element"), "{}", said(improper));
    assert_eq!(said("G = [1/s, 0; 0, (s + 1)/(s + 5)]"), "");
    assert!(said("% nothing\n").contains("no plant with two inputs and two outputs is defined"));
    assert_eq!(said(&" ".repeat(30_000)).lines().count(), 1);
    let bytes = stderr(&pipe(&["elements", "-"], b"\xff\xfe\x00"));
    assert_eq!(bytes, "quadtank: standard input: not UTF-8 text\n");
}
