//! The tables of Andreis (2017), every printed number beside the computed one.

use std::fmt::Write as _;

use quadtank::literature::andreis::{AndreisRemark, PublishedDisturbance, PublishedMethod, PublishedModel};
use quadtank::sim::level::LevelRunError;
use quadtank::study::level_loop::compare_table;

/// The tables of chapter 5 that are computed.
const TABLES: [u32; 12] = [1, 2, 3, 4, 5, 6, 9, 10, 12, 13, 17, 18];

/// The number of a table of chapter 5, such as 5.1.
#[derive(Clone, Copy)]
pub struct TableNumber(u32);

/// Reads a number such as 5.1.
pub fn table_of(text: &str) -> Result<TableNumber, String> {
    let number = text.strip_prefix("5.").and_then(|number| number.parse().ok());
    number.filter(|number| TABLES.contains(number)).map(TableNumber).ok_or_else(|| {
        let known = TABLES.map(|number| format!("5.{number}"));
        format!("no computed table; one of {}", known.join(", "))
    })
}

/// A table as text, with what is to be known about the print.
pub fn table(TableNumber(number): TableNumber) -> Result<String, LevelRunError> {
    let compared = compare_table(number)?;
    let mut text = format!("Andreis (2017), Table 5.{number}: {}\n\n", title(number));
    // Writing to a String cannot fail.
    let _ = writeln!(text, "disturbance  method     model       Kp     Ti (s)    printed      computed     deviation");
    for row in &compared.numbers {
        let (disturbance, method, model) = (disturbance(row.disturbance), method(row.method), model(row.model));
        let (gain, time) = (row.tuning.gain, row.tuning.integral_time_s);
        let _ = writeln!(
            text,
            "{disturbance:<12} {method:<10} {model:<10} {gain:>5} {time:>8}  {:>11.4e}  {:>11.4e}  {:>+9.2} %",
            row.printed,
            row.computed,
            100.0 * row.deviation(),
        );
    }
    for (index, &remark) in compared.remarks.iter().enumerate() {
        let _ = writeln!(text, "{}{}", if index == 0 { "\n" } else { "" }, words(remark));
    }
    Ok(text)
}

fn title(number: u32) -> &'static str {
    match number {
        1 | 3 | 5 => "variance of the level (m²), tight control",
        2 | 4 | 6 => "variance of the outflow ((m³/s)²), averaging control",
        9 | 10 => "index of the level, tight control",
        12 | 13 => "index of the outflow, averaging control",
        17 => "variance of the outflow ((m³/s)²) under tight control",
        _ => "variance of the level (m²) under averaging control",
    }
}

fn disturbance(of: PublishedDisturbance) -> &'static str {
    match of {
        PublishedDisturbance::SineL => "Sine L",
        PublishedDisturbance::SineH => "Sine H",
        PublishedDisturbance::Random => "Random",
    }
}

fn method(of: PublishedMethod) -> &'static str {
    match of {
        PublishedMethod::Current => "current",
        PublishedMethod::Gradient => "gradient",
        PublishedMethod::Genetic => "genetic",
        PublishedMethod::Skogestad => "SIMC",
        PublishedMethod::Lambda => "Lambda",
    }
}

fn model(of: PublishedModel) -> &'static str {
    match of {
        PublishedModel::Nominal => "nominal",
        PublishedModel::Uncertain => "uncertain",
    }
}

fn words(remark: AndreisRemark) -> &'static str {
    match remark {
        AndreisRemark::OperatingPoint => {
            "The step test ran at 0.006 m³/s, all simulations at 0.017: K/τ is 2.4 times as large there."
        }
        AndreisRemark::UnitOfLevelVariance => "Variances of the level are printed in (m³/s)²; they are m².",
        AndreisRemark::CutToBox => "Gains were rounded or cut to the box, so SIMC and Lambda tuning coincide.",
        AndreisRemark::RandomSequence => {
            "Neither generator nor instant of switching is printed: the random rows differ by up to 0.5 %."
        }
        AndreisRemark::FlatIntegralTime => {
            "The best Ti of every row is the bound of 6000 s, and the cost hardly knows it; 2999.7 is where fmincon started."
        }
        AndreisRemark::LimitOfStability => {
            "The tight optimum is on the limit of stability; robustness is not looked at."
        }
        AndreisRemark::NoLevelConstraint => {
            "Nothing asks for the level: the optimum is the lower bound of Kp, and no control is better still."
        }
        AndreisRemark::SkogestadIsBetterOnce => {
            "The text says that SIMC is never better than the current tuning; with the uncertain model it is."
        }
        AndreisRemark::WrongRanking => "The row Sine H, nominal, should read 4, 3, X, X.",
        AndreisRemark::LevelVariancesInPlace => {
            "The columns of variances hold variances of the level; the indices are those of the outflow."
        }
        AndreisRemark::GradientValuesInPlace => {
            "The columns of the genetic search hold values of the gradient; the indices are those of the genetic search."
        }
        AndreisRemark::WrongLabel => "The left-hand side of the worked example should be Id_varMV.",
        AndreisRemark::LostDensity => "Equation 83 keeps G under the root; it must be ρ as in Eq. 84.",
        AndreisRemark::DoubleGain => "Equations 25 and 26 multiply by the gain twice.",
        AndreisRemark::SimcCondition => "The condition of SIMC is printed as θ < τc; it is −θ < τc (Skogestad 2003).",
        AndreisRemark::LambdaWithoutBound => {
            "λ = 1 s is no recommendation of the rule: without dead time it has no lower bound."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_computed_table_has_rows_and_a_title_of_its_own_objective() {
        for number in TABLES {
            let text = table(TableNumber(number)).unwrap();
            assert!(text.lines().count() > 9, "{text}");
            assert!(table_of(&format!("5.{number}")).is_ok());
        }
        assert!(table_of("5.7").is_err() && table_of("1").is_err());
    }
}
