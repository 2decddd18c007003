//! The published tables: every printed number beside the computed one, and a click to the loop behind it.

use leptos::prelude::*;
use quadtank::literature::LevelPresetId;
use quadtank::literature::andreis::{AndreisRemark, PublishedDisturbance, PublishedModel, remarks_on_table};
use quadtank::literature::level_slides;
use quadtank::sim::level::LevelController;
use quadtank::study::level_loop::{
    COMPARED_TABLES, Compared, ComparedFeatures, ComparedQuantity, ComparedTable, LevelLoopSetup, SUMMARY_TABLES,
    compare_features, compare_summary, compare_table, published_setup,
};

use super::flags::{locks, panels};
use super::pictures::method_name;
use super::sentences::{short_variance, variance};
use super::session::{Session, load, use_session};
use super::summary_table::summary_table;
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::{Card, Choice, Row, Select, TableContent};

/// The tables and the loop of the lecture slides.
#[component]
pub fn PublishedCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let table = RwSignal::new(COMPARED_TABLES[0]);
    // No published case is refused.
    let numbers = Memo::new(move |_| compare_table(table.get()).ok().filter(|found| !found.numbers.is_empty()));
    let summary = Memo::new(move |_| compare_summary(table.get()).ok().filter(|found| !found.rows.is_empty()));
    let choices = Signal::derive(move || {
        let mut tables = [&COMPARED_TABLES[..], &SUMMARY_TABLES].concat();
        tables.sort_unstable();
        tables.iter().map(|&table| Choice::new(table, table.to_string(), table_name(lab, table))).collect::<Vec<_>>()
    });
    let content = move || {
        // Functions in place of components: they are worked out here, so that the language is followed.
        let numbers = numbers.get().map(|found| number_table(session, &found));
        let summary = summary.get().map(|found| summary_table(lab, &found));
        (numbers, summary)
    };
    let remarks = move || {
        let remarks = remarks_on_table(table.get());
        remarks.iter().map(|remark| view! { <li>{remark_text(lab, *remark)}</li> }).collect_view()
    };
    view! {
        <Card name="tables" panel=panels::PUBLISHED title=say!(lab, level.published)>
            <Select
                id="published-table"
                name=say!(lab, level.published)
                choices
                chosen=table
                on_choose=move |chosen| table.set(chosen)
                disabled=false
            />
            <div class="scroll" tabindex="0" role="region" aria-label=say!(lab, level.printed_computed)>
                <table class="plain" data-testid="published-numbers">{content}</table>
            </div>
            <ul class="remarks">{remarks}</ul>
            <Features />
            <Slides />
        </Card>
    }
}

fn number_table(session: Session, found: &ComparedTable) -> impl IntoView + use<> {
    let lab = session.lab;
    let headings = [
        tr!(lab, level.column_disturbance),
        tr!(lab, level.column_method),
        tr!(lab, level.column_model),
        "Kp · Ti (s)".to_owned(),
        tr!(lab, level.column_printed),
        tr!(lab, level.column_computed),
        tr!(lab, level.column_deviation),
    ];
    let table = found.table;
    let rows = found.numbers.iter().map(|row| number_row(session, *row, found.quantity, found.setup_of(row)));
    let rows = rows.collect_view();
    let headings = headings.map(|text| view! { <th scope="col">{text}</th> });
    view! {
        <caption class="visually-hidden">{table_name(lab, table)}</caption>
        <thead><tr>{headings}<th scope="col"><span class="visually-hidden">{tr!(lab, free.show)}</span></th></tr></thead>
        <tbody>{rows}</tbody>
    }
}

fn number_row(session: Session, row: Compared, quantity: ComparedQuantity, setup: LevelLoopSetup) -> impl IntoView {
    let lab = session.lab;
    let style = lab.number_style();
    let number = |value: f64| match quantity {
        ComparedQuantity::Index => style.fixed(value, 4),
        ComparedQuantity::LevelVariance | ComparedQuantity::OutflowVariance => variance(lab, value),
        ComparedQuantity::Hundredths => style.fixed(value, 2),
        ComparedQuantity::Ticks if value == 0.0 => "×".to_owned(),
        ComparedQuantity::Ticks => style.fixed(value, 0),
    };
    let difference = row.computed - row.printed;
    let deviation = match quantity {
        ComparedQuantity::Ticks => style.fixed(difference, 0),
        ComparedQuantity::Hundredths => style.fixed(difference, 2),
        _ => format!("{} %", style.fixed(100.0 * row.deviation(), 3)),
    };
    let disturbance = disturbance_name(row.disturbance);
    let model = match row.model {
        PublishedModel::Nominal => tr!(lab, level.nominal),
        PublishedModel::Uncertain => tr!(lab, level.uncertain),
    };
    let tuning =
        format!("{} · {}", style.significant(row.tuning.gain, 3), style.significant(row.tuning.integral_time_s, 5));
    let show = move |_| {
        load(session, setup.clone());
        // The table stands below what it shows.
        if let Ok(Some(course)) = document().query_selector(".bench.level .course") {
            course.scroll_into_view();
        }
    };
    view! {
        <tr>
            <th scope="row">{disturbance}</th>
            <td>{method_name(lab, row.method)}</td>
            <td>{model}</td>
            <td>{tuning}</td>
            <td>{number(row.printed)}</td>
            <td>{number(row.computed)}</td>
            <td>{deviation}</td>
            <td>
                <button type="button" class="button small" disabled=lab.locks(locks::GAINS) on:click=show>
                    {say!(lab, free.show)}
                </button>
            </td>
        </tr>
    }
}

pub(super) const fn disturbance_name(disturbance: PublishedDisturbance) -> &'static str {
    match disturbance {
        PublishedDisturbance::SineL => "Sine L",
        PublishedDisturbance::SineH => "Sine H",
        PublishedDisturbance::Random => "Random",
    }
}

pub(super) fn table_name(lab: Lab, table: u32) -> String {
    let what = match table {
        1 | 3 | 5 => tr!(lab, level.table_tight),
        2 | 4 | 6 => tr!(lab, level.table_averaging),
        7 | 8 => tr!(lab, level.table_ticks),
        11 | 14 => tr!(lab, level.table_hundredths),
        15 => tr!(lab, level.table_change),
        16 => tr!(lab, level.table_needed),
        9 | 10 => tr!(lab, level.table_index_tight),
        12 | 13 => tr!(lab, level.table_index_averaging),
        _ => tr!(lab, level.table_wrong_index),
    };
    format!("Andreis (2017), {} 5.{table}: {what}", tr!(lab, level.table))
}

fn remark_text(lab: Lab, remark: AndreisRemark) -> String {
    match remark {
        AndreisRemark::OperatingPoint => tr!(lab, level.remark_operating_point),
        AndreisRemark::UnitOfLevelVariance => tr!(lab, level.remark_unit),
        AndreisRemark::CutToBox => tr!(lab, level.remark_cut),
        AndreisRemark::RandomSequence => tr!(lab, level.remark_random),
        AndreisRemark::FlatIntegralTime => tr!(lab, level.remark_flat),
        AndreisRemark::LimitOfStability => tr!(lab, level.remark_stability),
        AndreisRemark::NoLevelConstraint => tr!(lab, level.remark_no_constraint),
        AndreisRemark::SkogestadIsBetterOnce => tr!(lab, level.remark_skogestad),
        AndreisRemark::WrongRanking => tr!(lab, level.remark_ranking),
        AndreisRemark::LevelVariancesInPlace => tr!(lab, level.remark_level_variances),
        AndreisRemark::GradientValuesInPlace => tr!(lab, level.remark_gradient_values),
        AndreisRemark::WrongLabel => tr!(lab, level.remark_label),
        AndreisRemark::LostDensity => tr!(lab, level.remark_density),
        AndreisRemark::DoubleGain => tr!(lab, level.remark_double_gain),
        AndreisRemark::SimcCondition => tr!(lab, level.remark_simc),
        AndreisRemark::LambdaWithoutBound => tr!(lab, level.remark_lambda),
        AndreisRemark::RoundedDown => tr!(lab, level.remark_rounded),
        AndreisRemark::VerdictsByTheText => tr!(lab, level.remark_verdicts),
    }
}

/// Tables 5.19 and 5.20: what a tight tuning does to the outflow, and an averaging one to the level.
#[component]
fn Features() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    // No published case is refused.
    let found = compare_features().ok();
    let buttons = found.iter().flatten().enumerate().map(|(k, features)| {
        let setup = features.setup();
        let text = if k == 0 { say!(lab, level.show_tight) } else { say!(lab, level.show_averaging) };
        view! {
            <button
                type="button"
                class="button small"
                data-testid=format!("features-{}", k + 1)
                disabled=lab.locks(locks::GAINS)
                on:click=move |_| load(session, setup.clone())
            >
                {text}
            </button>
        }
    });
    let buttons = buttons.collect_view();
    view! {
        <h3>{say!(lab, level.features)}</h3>
        <div class="scroll" tabindex="0" role="region" aria-label=say!(lab, level.features)>
            <table class="plain" data-testid="published-features">{move || found.map(|found| features(lab, &found))}</table>
        </div>
        <div class="toolbar">{buttons}</div>
    }
}

/// A row for each feature: level and outflow under either tuning, printed and computed.
fn features(lab: Lab, found: &[ComparedFeatures; 2]) -> impl IntoView + use<> {
    let style = lab.number_style();
    let names = [
        tr!(lab, level.column_least),
        tr!(lab, level.column_most),
        tr!(lab, level.feature_range),
        tr!(lab, level.feature_variance),
        tr!(lab, level.column_mean),
        tr!(lab, level.feature_deviation),
    ];
    let [tight, averaging] = found;
    let columns = [
        (tight.printed.level, tight.level),
        (averaging.printed.level, averaging.level),
        (tight.printed.outflow, tight.outflow),
        (averaging.printed.outflow, averaging.outflow),
    ];
    let number = |value: f64| if value < 0.001 { short_variance(lab, value) } else { style.significant(value, 4) };
    let rows: Vec<AnyView> = names
        .into_iter()
        .enumerate()
        .map(|(k, name)| {
            let figures: Vec<String> =
                columns.iter().flat_map(|(printed, computed)| [number(printed[k]), number(computed[k])]).collect();
            view! { <Row name figures /> }.into_any()
        })
        .collect();
    let (printed, computed) = (tr!(lab, level.column_printed), tr!(lab, level.column_computed));
    let of = [
        tr!(lab, level.features_level_tight),
        tr!(lab, level.features_level_averaging),
        tr!(lab, level.features_outflow_tight),
        tr!(lab, level.features_outflow_averaging),
    ];
    let headings = of.into_iter().flat_map(|of| [format!("{of}, {printed}"), computed.clone()]);
    let columns = std::iter::once(tr!(lab, level.feature)).chain(headings).collect();
    view! { <TableContent caption=tr!(lab, level.features) columns rows /> }
}

/// The four settings of the lecture slides, each a click away.
#[component]
fn Slides() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let buttons = level_slides::settings().into_iter().enumerate().map(move |(k, pid)| {
        let show = move |_| load(session, slides_setup(k));
        let text = format!("({}, {}, {})", pid.proportional, 60.0 * pid.integral, pid.derivative / 60.0);
        view! {
            <button
                type="button"
                class="button small"
                data-testid=format!("slides-{}", k + 1)
                disabled=lab.locks(locks::GAINS)
                on:click=show
            >
                {text}
            </button>
        }
    });
    view! {
        <h3>{say!(lab, level.slides)}</h3>
        <p class="remark">{say!(lab, level.slides_remark)}</p>
        <div class="toolbar">{buttons.collect_view()}</div>
    }
}

/// The loop of the lecture slides with one of its settings (index).
fn slides_setup(index: usize) -> LevelLoopSetup {
    let mut setup = published_setup(LevelPresetId::LectureSlides, PublishedDisturbance::SineL);
    let pid = level_slides::settings()[index];
    setup.controller = LevelController::pid(pid, level_slides::DERIVATIVE_FILTER_S);
    setup
}
