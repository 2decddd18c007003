//! What formulas and scripts are read as, and what is said of those that are none.

use quadtank::study::relay_tuning::Element;
use quadtank_formula::{FormulaFault, MAX_BYTES, Position, element_from_formula, elements_from_script, formula_of};

fn element(numerator: &[f64], denominator: &[f64], dead_time: f64) -> Element {
    Element { numerator: numerator.to_vec(), denominator: denominator.to_vec(), dead_time }
}

/// The column of Wood and Berry (1973).
fn wood_berry() -> [[Element; 2]; 2] {
    [
        [element(&[12.8], &[1.0, 16.7], 1.0), element(&[-18.9], &[1.0, 21.0], 3.0)],
        [element(&[6.6], &[1.0, 10.9], 7.0), element(&[-19.4], &[1.0, 14.4], 3.0)],
    ]
}

#[test]
fn an_element_can_be_written_in_many_ways() {
    let expected = element(&[12.8], &[1.0, 16.7], 1.0);
    for text in [
        "12.8 exp(-s)/(16.7 s + 1)",
        "12,8 exp(-s)/(16,7 s + 1)",
        "12.8*exp(-1*s)/(16.7*s+1)",
        "exp(-s)*12.8/(1 + 16.7s)",
        "12.8 e^(-s) / (16.7 s + 1)",
        "  12.8·exp(−s)/(16.7·s+1)  % in minutes",
        "tf(12.8, [16.7 1], 'InputDelay', 1)",
        "tf([12.8], [16.7, 1]) exp(-s)",
        "12.8/(16.7 s + 1) exp(-2 s/2)",
    ] {
        assert_eq!(element_from_formula(text).as_ref(), Ok(&expected), "{text}");
    }
    let read = |text: &str| element_from_formula(text).unwrap();
    assert_eq!(read("2/((5 s + 1)^2)"), element(&[2.0], &[1.0, 10.0, 25.0], 0.0));
    assert_eq!(read("2 (5s+1)^-2"), element(&[2.0], &[1.0, 10.0, 25.0], 0.0));
    assert_eq!(read("s(5s+1)"), element(&[0.0, 1.0, 5.0], &[1.0], 0.0));
    assert_eq!(read("-s^2"), element(&[0.0, 0.0, -1.0], &[1.0], 0.0));
    assert_eq!(read("1/(s+1) + 2/(s+1)"), element(&[3.0], &[1.0, 1.0], 0.0));
    assert_eq!(read("1/(s+1) - 1/(s+2)"), element(&[1.0], &[2.0, 3.0, 1.0], 0.0));
    assert_eq!(read("4e-3/(2s) exp(-0*s)"), element(&[4e-3], &[0.0, 2.0], 0.0));
    assert_eq!(read("0"), element(&[0.0], &[1.0], 0.0));
}

#[test]
fn what_is_no_element_is_explained_at_its_place() {
    let wrong = |text: &str| {
        let error = element_from_formula(text).unwrap_err();
        let Position { column, width, .. } = error.position(text);
        (error.fault, column, width)
    };
    let unexpected = |found: &str| FormulaFault::Unexpected { found: found.to_owned() };
    assert_eq!(wrong(""), (FormulaFault::UnexpectedEnd, 1, 1));
    assert_eq!(wrong("12.8/(16.7 s + "), (FormulaFault::UnexpectedEnd, 16, 1));
    assert_eq!(wrong("12.8/(16.7 s + 1))"), (unexpected(")"), 18, 1));
    assert_eq!(wrong("12.8 / * 3"), (unexpected("*"), 8, 1));
    assert_eq!(wrong("3 ° s"), (unexpected("°"), 3, 1));
    assert_eq!(wrong("é + 2 §"), (unexpected("§"), 7, 1));
    assert_eq!(wrong("12.8/(tau s + 1)"), (FormulaFault::UnknownName { name: "tau".to_owned() }, 7, 3));
    assert_eq!(wrong("sin(s)"), (FormulaFault::UnknownName { name: "sin".to_owned() }, 1, 3));
    assert_eq!(wrong("1/(s - s)"), (FormulaFault::DivisionByZero, 1, 9));
    assert_eq!(wrong("s^0.5"), (FormulaFault::Exponent { max: 16 }, 1, 5));
    assert_eq!(wrong("s^s"), (FormulaFault::Exponent { max: 16 }, 1, 3));
    assert_eq!(wrong("2 exp(-s^2)"), (FormulaFault::NoDeadTime, 7, 4));
    assert_eq!(wrong("2 exp(3)"), (FormulaFault::NoDeadTime, 7, 1));
    assert_eq!(wrong("2 exp(3 s)"), (FormulaFault::Future { dead_time: -3.0 }, 7, 3));
    let apart = FormulaFault::DifferentDeadTimes { first: 1.0, second: 2.0 };
    assert_eq!(wrong("exp(-s) + exp(-2 s)"), (apart, 1, 19));
    assert_eq!(wrong("(s+1)^16 (s+1)^16 (s+1)"), (FormulaFault::DegreeTooHigh { degree: 33, max: 32 }, 1, 23));
    assert_eq!(wrong("1e999"), (FormulaFault::NotFinite, 1, 5));
    assert_eq!(wrong("1e200^9"), (FormulaFault::NotFinite, 1, 7));
    assert_eq!(wrong("[1, 2]"), (FormulaFault::NoElement, 1, 6));
    assert_eq!(wrong("tf('s"), (FormulaFault::OpenQuotation, 4, 1));
    assert_eq!(wrong("tf(1, [5 1], 'Delay', 3)"), (FormulaFault::UnknownOption { name: "Delay".to_owned() }, 14, 10));
    assert_eq!(wrong("tf([1 s], [5 1])").0, FormulaFault::NoCoefficients);
    assert_eq!(wrong("tf(1, [5 1], 0.1)").0, unexpected("…"));
    assert_eq!(wrong(&"(".repeat(500)).0, FormulaFault::TooDeep { max: 40 });
    assert_eq!(wrong(&"-".repeat(500)).0, FormulaFault::TooDeep { max: 40 });
    let long = " ".repeat(MAX_BYTES + 1);
    assert_eq!(wrong(&long).0, FormulaFault::TooLong { length: MAX_BYTES + 1, max: MAX_BYTES });
}

#[test]
fn a_plant_is_read_from_matlab_and_python() {
    let scripts = [
        "% the column\ns = tf('s');\nG = [12.8*exp(-s)/(16.7*s+1) -18.9*exp(-3*s)/(21*s+1)\n     6.6*exp(-7*s)/(10.9*s+1), -19.4*exp(-3*s)/(14.4*s+1)];",
        "G = tf({12.8, -18.9; 6.6, -19.4}, {[16.7 1], [21 1]; ...\n  [10.9 1], [14.4 1]}, 'IODelay', [1 3; 7 3])",
        "num = {[12.8] [-18.9]; [6.6] [-19.4]};\nden = {[16.7 1] [21 1]; [10.9 1] [14.4 1]};\nG = tf(num, den);\nG.IODelay = [1, 3; 7, 3];",
        "clear; clc\ng11 = tf(12.8,[16.7 1],'IODelay',1);\ng12 = tf(-18.9,[21 1],'OutputDelay',3);\ng21 = tf(6.6,[10.9 1],'InputDelay',7);\ng22 = tf(-19.4,[14.4 1],'InputDelay',3);\nG = [g11 g12; g21 g22];",
        "G_11 = 12.8*exp(-s)/(16.7*s+1)\nG_12 = -18.9*exp(-3*s)/(21*s+1)\nG_21 = 6.6*exp(-7*s)/(10.9*s+1)\nG_22 = -19.4*exp(-3*s)/(14.4*s+1)",
        "import numpy as np\ns = ct.tf('s')\nG = np.array([\n    [12.8*np.exp(-s)/(16.7*s + 1), -18.9*np.exp(-3*s)/(21*s + 1)],\n    [6.6*np.exp(-7*s)/(10.9*s + 1), -19.4*np.exp(-3*s)/(14.4*s + 1)],\n])  # minutes",
    ];
    for script in scripts {
        assert_eq!(elements_from_script(script).as_ref(), Ok(&wood_berry()), "{script}");
    }
    let undelayed = "import control\nG = control.tf([[[12.8], [-18.9]],\n    [[6.6], [-19.4]]],\n  [[[16.7, 1], [21, 1]], [[10.9, 1], [14.4, 1]]])\n";
    let expected = wood_berry().map(|row| row.map(|of| Element { dead_time: 0.0, ..of }));
    assert_eq!(elements_from_script(undelayed), Ok(expected));
    let input_delay = format!("{undelayed}G.InputDelay = [1 3]");
    let delays = elements_from_script(&input_delay).unwrap().map(|row| row.map(|of| of.dead_time));
    assert_eq!(delays, [[1.0, 3.0], [1.0, 3.0]]);
    let output_delay = format!("{undelayed}G.outputdelay = [1; 3]");
    let delays = elements_from_script(&output_delay).unwrap().map(|row| row.map(|of| of.dead_time));
    assert_eq!(delays, [[1.0, 1.0], [3.0, 3.0]]);
}

#[test]
fn a_script_without_a_plant_is_explained_at_its_place() {
    let wrong = |script: &str| {
        let error = elements_from_script(script).unwrap_err();
        let Position { line, column, .. } = error.position(script);
        (error.fault, line, column)
    };
    let unexpected = |found: &str| FormulaFault::Unexpected { found: found.to_owned() };
    assert_eq!(wrong("").0, FormulaFault::NoPlant);
    assert_eq!(wrong("s = tf('s')\nG = 1/(s+1)\n"), (FormulaFault::NoPlant, 2, 12));
    assert_eq!(wrong("G = 1/(s+1)\nstep(G)"), (FormulaFault::UnknownName { name: "step".to_owned() }, 2, 1));
    assert_eq!(wrong("z = tf('z')").0, FormulaFault::NoElement);
    assert_eq!(wrong("a = 1\nb = 2 = 3"), (unexpected("="), 2, 7));
    assert_eq!(wrong("G = [1, 2\n"), (FormulaFault::UnexpectedEnd, 2, 1));
    assert_eq!(wrong("G = tf({1,2;3,4}, [5 1])"), (FormulaFault::Shape, 1, 5));
    assert_eq!(
        wrong("G = [1/(s+1), 2/(s+1); 3/(s+1), 4/(s+1)];\nG.InputDelay = [1 2 3]"),
        (FormulaFault::Shape, 2, 16)
    );
    let excerpt = elements_from_script("a = 1;\nb = a*tau;").unwrap_err().excerpt("a = 1;\nb = a*tau;");
    assert_eq!(excerpt, "b = a*tau;\n      ^^^");
}

#[test]
fn a_plant_is_written_as_in_textbooks() {
    let written = wood_berry().map(|row| row.map(|of| formula_of(&of)));
    assert_eq!(written[0], ["12.8 exp(-s)/(16.7 s + 1)", "-18.9 exp(-3 s)/(21 s + 1)"]);
    assert_eq!(formula_of(&element(&[1.0, -2.0], &[0.0, 0.0, 1.0], 0.0)), "(-2 s + 1)/s^2");
    assert_eq!(formula_of(&element(&[1.0], &[1.0], 2.5)), "exp(-2.5 s)");
    assert_eq!(formula_of(&element(&[0.0], &[1.0, 1e-9], 0.0)), "0/(1e-9 s + 1)");
}

#[cfg(not(target_arch = "wasm32"))]
mod properties {
    use super::*;
    use proptest::prelude::*;

    fn coefficient() -> impl Strategy<Value = f64> {
        (-1.0e3..1.0e3, -12..12_i32).prop_map(|(mantissa, exponent)| mantissa * 10f64.powi(exponent))
    }

    proptest! {
        #[test]
        fn what_is_written_is_read_with_all_digits(
            numerator in prop::collection::vec(coefficient(), 1..5),
            denominator in prop::collection::vec(coefficient(), 2..7),
            dead_time in prop_oneof![Just(0.0), Just(1.0), 0.0..1e4],
        ) {
            let written = Element { numerator, denominator, dead_time };
            let text = formula_of(&written);
            prop_assert_eq!(element_from_formula(&text), Ok(written), "{}", text);
        }

        #[test]
        fn no_text_is_a_panic(text in "[-s0-9+*/^()\\[\\]{};,.='e \ntfxp%#é]{0,60}") {
            let wrong = element_from_formula(&text).err().into_iter().chain(elements_from_script(&text).err());
            for error in wrong {
                prop_assert!(!error.excerpt(&text).is_empty());
            }
        }
    }
}

#[test]
fn zeros_poles_and_gains_are_an_element() {
    let meant = element(&[6.0, 9.0, 3.0], &[0.0, 20.0, 9.0, 1.0], 0.0);
    for text in ["zpk([-1 -2], [0 -4 -5], 3)", "ct.zpk([-1, -2], [0, -4, -5], 3)", "zpk([-1; -2], [0; -4; -5], 3)"] {
        assert_eq!(element_from_formula(text), Ok(meant.clone()), "{text}");
    }
    assert_eq!(element_from_formula("zpk([], -0.5, 2)").unwrap(), element(&[2.0], &[0.5, 1.0], 0.0));
    let late = element_from_formula("zpk([], [-0.5], 2, 'InputDelay', 1.5)").unwrap();
    assert_eq!(late, element(&[2.0], &[0.5, 1.0], 1.5));
    let plant = elements_from_script("G = zpk({[], -1; [], 0}, {-2, -3; [-4 -5], -6}, [1 2; 3 4])").unwrap();
    assert_eq!(plant[0][1], element(&[2.0, 2.0], &[3.0, 1.0], 0.0));
    assert_eq!(plant[1][0], element(&[3.0], &[20.0, 9.0, 1.0], 0.0));
    let refused = element_from_formula("zpk([-1+2i, -1-2i], [-1 -2], 1)").unwrap_err();
    assert_eq!(refused.fault, FormulaFault::ImaginaryUnit { name: "i".to_owned() });
    assert_eq!(element_from_formula("zpk([1], {1, 2; 3, 4}, 1)").unwrap_err().fault, FormulaFault::Shape);
}

#[test]
fn a_plant_is_filled_element_by_element() {
    let script = "s = tf('s');\nG(1,1) = 1/(5*s + 1);\nG(1,2) = zpk([], -2, 4);\nG(2,2) = 2/s;\nG(1,2) = G(1,2);";
    assert!(elements_from_script(script).is_err(), "an element is not read by its place");
    let script = "s = tf('s');\nG(1,1) = 1/(5*s + 1);\nG(1,2) = zpk([], -2, 4);\nG(2,2) = 2/s;\nG.InputDelay = [1; 2];";
    let plant = elements_from_script(script).unwrap();
    assert_eq!(plant[0], [element(&[1.0], &[1.0, 5.0], 1.0), element(&[4.0], &[2.0, 1.0], 2.0)]);
    assert_eq!((&plant[1][0].numerator, &plant[1][1].denominator), (&vec![0.0], &vec![0.0, 1.0]));
    // A row alone is no plant; a third row none with two outputs.
    let fault = |script: &str| elements_from_script(script).unwrap_err().fault;
    assert_eq!(fault("G(1,1) = 1;\nG(1,2) = 2;"), FormulaFault::NoPlant);
    assert_eq!(fault("G(3,1) = 1;"), FormulaFault::Shape);
}

#[test]
fn what_is_no_transfer_function_is_refused_by_name() {
    let error = elements_from_script("[num, den] = pade(1, 2);\nG = tf(num, den);").unwrap_err();
    assert_eq!((error.fault, error.span), (FormulaFault::PadeApproximation, 13..17));
    assert_eq!(elements_from_script("sys = ct.ss(A, B, C, D)").unwrap_err().fault, FormulaFault::StateSpaceModel);
    assert_eq!(element_from_formula("pade(exp(-s), 3)/(s + 1)").unwrap_err().fault, FormulaFault::PadeApproximation);
}
