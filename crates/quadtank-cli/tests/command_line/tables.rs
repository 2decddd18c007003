//! Tables in the styles of spreadsheets.

use quadtank::literature::PresetId;
use quadtank_record::{Mapping, Table};

use super::{pipe, preset, run, stderr, stdout};

const STYLES: [&[&str]; 6] = [
    &["--separator", "comma"],
    &["--decimal", "comma"],
    &["--separator", "semicolon", "--decimal", "comma"],
    &["--separator", "semicolon"],
    &["--separator", "tab"],
    &["--separator", "tab", "--decimal", "comma"],
];

/// What is not a number equals itself here.
fn bits(table: &Table) -> Vec<Vec<u64>> {
    table.columns.iter().map(|column| column.values.iter().map(|value| value.to_bits()).collect()).collect()
}

#[test]
fn a_run_in_any_style_is_the_same_record() {
    let documents = [
        (preset(PresetId::JohanssonMinimumPhase), "time_s,level_1_m"),
        (stdout(&run(&["cases", "junqueira-b-s3"])), "time_s,level_1_m"),
        (stdout(&run(&["cases", "andreis-sine-l"])), "time_s,level_m"),
        (stdout(&run(&["cases", "wood-berry-blt"])), "time,output_1"),
    ];
    for (document, head) in documents {
        let written = |style: &[&str]| stdout(&pipe(&[&["simulate", "-"], style].concat(), document.as_bytes()));
        let plain = written(&[]);
        assert!(plain.starts_with(head), "{}", plain.lines().next().unwrap());
        assert_eq!(written(STYLES[0]), plain);
        let expected = Table::read(plain.as_bytes()).unwrap();
        for style in STYLES {
            let found = Table::read(written(style).as_bytes()).unwrap();
            assert_eq!(bits(&found), bits(&expected), "{style:?}");
            assert_eq!(Mapping::guess(&found), Mapping::guess(&expected));
        }
    }
}

#[test]
fn a_decimal_comma_brings_semicolons() {
    let document = preset(PresetId::JohanssonMinimumPhase);
    let csv = stdout(&pipe(&["simulate", "-", "--decimal", "comma"], document.as_bytes()));
    let mut lines = csv.lines();
    assert!(lines.next().unwrap().starts_with("time_s;level_1_m;"));
    assert!(lines.next().unwrap().starts_with("0;0,12262967"));
    let test = stdout(&run(&["cases", "table-6-row-1"]));
    let csv = stdout(&pipe(&["tune", "-", "--format", "csv", "--separator", "tab"], test.as_bytes()));
    assert!(csv.starts_with("time\toutput_1\t"));
}

#[test]
fn a_comma_cannot_be_both_signs() {
    let document = preset(PresetId::JohanssonMinimumPhase);
    let output = pipe(&["simulate", "-", "--separator", "comma", "--decimal", "comma"], document.as_bytes());
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    assert!(stderr(&output).contains("a comma cannot separate columns and be the decimal sign too"));
}
