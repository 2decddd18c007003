//! The tables of Andreis (2017), every printed number beside the computed one.

use std::fmt::Write as _;

use quadtank::assess::IndexVerdict;
use quadtank::literature::andreis::{
    AndreisRemark, PublishedDisturbance, PublishedMethod, PublishedModel, PublishedObjective,
};
use quadtank::sim::level::LevelRunError;
use quadtank::study::level_loop::{
    COMPARED_TABLES, Compared, ComparedQuantity, SUMMARY_TABLES, SummaryEntry, SummaryRow, compare_summary,
    compare_table,
};

/// The tables of chapter 5 that are computed.
fn tables() -> impl Iterator<Item = u32> {
    let mut tables = [&COMPARED_TABLES[..], &SUMMARY_TABLES].concat();
    tables.sort_unstable();
    tables.into_iter()
}

/// The number of a table of chapter 5, such as 5.1.
#[derive(Clone, Copy)]
pub struct TableNumber(u32);

/// Reads a number such as 5.1.
pub fn table_of(text: &str) -> Result<TableNumber, String> {
    let number = text.strip_prefix("5.").and_then(|number| number.parse().ok());
    number.filter(|&number| tables().any(|known| known == number)).map(TableNumber).ok_or_else(|| {
        let known: Vec<String> = tables().map(|number| format!("5.{number}")).collect();
        format!("no computed table; one of {}", known.join(", "))
    })
}

/// A table as text, with what is to be known about the print.
pub fn table(TableNumber(number): TableNumber) -> Result<String, LevelRunError> {
    let (rows, remarks) = if SUMMARY_TABLES.contains(&number) {
        let found = compare_summary(number)?;
        (summary_rows(&found.rows), found.remarks)
    } else {
        let found = compare_table(number)?;
        (number_rows(&found.numbers, found.quantity), found.remarks)
    };
    let mut text = format!("Andreis (2017), Table 5.{number}: {}\n\n{rows}", title(number));
    for (index, &remark) in remarks.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}{}", if index == 0 { "\n" } else { "" }, words(remark));
    }
    Ok(text)
}

fn number_rows(rows: &[Compared], quantity: ComparedQuantity) -> String {
    let mut text =
        "disturbance  method     model       Kp     Ti (s)    printed      computed     deviation\n".to_owned();
    for row in rows {
        let (disturbance, method, model) = (disturbance(row.disturbance), method(row.method), model(row.model));
        let (gain, time) = (row.tuning.gain, row.tuning.integral_time_s);
        let [printed, computed] = [row.printed, row.computed].map(|value| match quantity {
            ComparedQuantity::Ticks if value == 0.0 => "X".to_owned(),
            ComparedQuantity::Ticks => format!("{value:.0}"),
            ComparedQuantity::Hundredths => format!("{value:.2}"),
            _ => format!("{value:.4e}"),
        });
        let deviation = match quantity {
            ComparedQuantity::Ticks => format!("{:+.0}", row.computed - row.printed),
            ComparedQuantity::Hundredths => format!("{:+.2}", row.computed - row.printed),
            _ => format!("{:+.2} %", 100.0 * row.deviation()),
        };
        let _ = writeln!(
            text,
            "{disturbance:<12} {method:<10} {model:<10} {gain:>5} {time:>8}  {printed:>11}  {computed:>11}  {deviation:>11}"
        );
    }
    text
}

fn summary_rows(rows: &[SummaryRow]) -> String {
    let mut text = "disturbance  objective  model       printed      computed\n".to_owned();
    for row in rows {
        let objective = match row.objective {
            PublishedObjective::Tight => "tight",
            PublishedObjective::Averaging => "averaging",
        };
        let model = row.model.map_or("both", model);
        let [printed, computed] = [row.printed, row.computed].map(|entry| match entry {
            SummaryEntry::Change(percent) => format!("{percent:+.1} %"),
            SummaryEntry::Verdict(IndexVerdict::Keep) => "keep".to_owned(),
            SummaryEntry::Verdict(IndexVerdict::Fair) => "fair".to_owned(),
            SummaryEntry::Verdict(IndexVerdict::Retune) => "retune".to_owned(),
            SummaryEntry::Verdict(IndexVerdict::WrongIndex) => "wrong index".to_owned(),
        });
        let disturbance = disturbance(row.disturbance);
        let _ = writeln!(text, "{disturbance:<12} {objective:<10} {model:<10} {printed:>11}  {computed:>11}");
    }
    text
}

fn title(number: u32) -> &'static str {
    match number {
        1 | 3 | 5 => "variance of the level (m²), tight control",
        2 | 4 | 6 => "variance of the outflow ((m³/s)²), averaging control",
        7 => "ticks for the methods, tight control (X: worse than the current tuning)",
        8 => "ticks for the methods, averaging control (X: worse than the current tuning)",
        11 => "index of the level in hundredths, tight control",
        14 => "index of the outflow in hundredths, averaging control",
        15 => "mean change of the variances by the model error",
        16 => "whether the current tuning is to be changed",
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
        AndreisRemark::RoundedDown => {
            "The mean change of Random and averaging control is printed as 14 %; the printed variances give 14.6 %."
        }
        AndreisRemark::VerdictsByTheText => {
            "The verdicts are those of the text; the signs of the table itself are not legible. The bounds between them are ours."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_computed_table_has_rows_and_a_title_of_its_own_objective() {
        for number in tables() {
            let text = table(TableNumber(number)).unwrap();
            assert!(text.lines().count() > 9, "{text}");
            assert!(table_of(&format!("5.{number}")).is_ok());
        }
        assert!(table_of("5.19").is_err() && table_of("1").is_err());
    }
}
