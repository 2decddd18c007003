use std::borrow::Cow;

use crate::RecordError;
use crate::number::{Cell, read};

/// Most bytes of a file: some 300,000 rows of eight columns.
pub const MAX_BYTES: usize = 24 * 1024 * 1024;

/// Rows that a separator is judged by.
const JUDGED_ROWS: usize = 20;

/// Separators of columns, in the order in which they are tried: a comma may be a decimal sign, and blanks may stand beside any other.
const SEPARATORS: [u8; 4] = *b"\t;, ";

/// A column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name in the file, with its unit if that stands there; empty for a table without names.
    pub name: String,
    /// Its values from row to row; not a number where the file has a hole.
    pub values: Vec<f64>,
}

/// A table of numbers with columns of one length.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Its columns, two at least.
    pub columns: Vec<Column>,
    /// Line of the file of each row, from 1.
    pub lines: Vec<usize>,
}

/// A line that is neither blank nor a remark, with its cells.
struct Row {
    line: usize,
    cells: Vec<String>,
}

impl Row {
    fn is_numeric(&self) -> bool {
        self.cells.iter().any(|cell| matches!(read(cell), Cell::Number(_) | Cell::TwoDecimalSigns))
    }
}

impl Table {
    /// Reads a table: columns separated by tab, semicolon, comma or blank; decimal point or comma; names of columns in the first rows or
    /// none; a second row of units; remarks behind `#` or `%`; with or without a byte order mark.
    ///
    /// # Errors
    /// [`RecordError`] with the line at fault.
    ///
    /// ```
    /// use quadtank_record::Table;
    ///
    /// let table = Table::read("t (s);h1 (cm)\n0;12,4\n0,5;12,5\n".as_bytes())?;
    /// assert_eq!(table.columns[1].name, "h1 (cm)");
    /// assert_eq!(table.columns[1].values, [12.4, 12.5]);
    /// # Ok::<(), quadtank_record::RecordError>(())
    /// ```
    pub fn read(bytes: &[u8]) -> Result<Self, RecordError> {
        if bytes.len() > MAX_BYTES {
            return Err(RecordError::TooLarge { bytes: bytes.len(), max: MAX_BYTES });
        }
        let text = text_of(bytes)?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let Some(separator) = separator_of(text) else {
            let has_numbers = rows(text, b'\t').iter().any(Row::is_numeric);
            return Err(if has_numbers { RecordError::OneColumn } else { RecordError::Empty });
        };
        let rows = rows(text, separator);
        let first = rows.iter().position(Row::is_numeric).ok_or(RecordError::Empty)?;
        let (heads, rows) = rows.split_at(first);
        let count = rows[0].cells.len();
        let mut columns: Vec<Column> = (0..count)
            .map(|index| Column { name: name_of(heads, index), values: Vec::with_capacity(rows.len()) })
            .collect();
        for row in rows {
            take(row, &mut columns)?;
        }
        Ok(Self { columns, lines: rows.iter().map(|row| row.line).collect() })
    }

    /// How many rows it has.
    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }
}

/// The text of a file: UTF-8, or else Latin-1, in which Windows writes names with accents.
fn text_of(bytes: &[u8]) -> Result<Cow<'_, str>, RecordError> {
    match str::from_utf8(bytes) {
        Ok(text) => Ok(text.into()),
        Err(_) if bytes.contains(&0) => Err(RecordError::NotText),
        Err(_) => Ok(bytes.iter().copied().map(char::from).collect::<String>().into()),
    }
}

/// Adds a row to the columns.
fn take(row: &Row, columns: &mut [Column]) -> Result<(), RecordError> {
    let Row { line, cells } = row;
    if cells.len() != columns.len() {
        return Err(RecordError::Ragged { line: *line, expected: columns.len(), found: cells.len() });
    }
    for (index, (cell, column)) in cells.iter().zip(columns).enumerate() {
        let (line, column_number) = (*line, index + 1);
        column.values.push(match read(cell) {
            Cell::Number(number) => number,
            Cell::Missing => f64::NAN,
            Cell::TwoDecimalSigns => {
                return Err(RecordError::TwoDecimalSigns { line, column: column_number, cell: cell.clone() });
            }
            Cell::Text => {
                return Err(RecordError::NotANumber { line, column: column_number, cell: cell.trim().to_owned() });
            }
        });
    }
    Ok(())
}

/// The name of a column from the rows above the numbers: the last but a row of units, with the unit behind it.
fn name_of(heads: &[Row], index: usize) -> String {
    let cells = heads.iter().rev().take(2).rev().filter_map(|row| row.cells.get(index));
    let words: Vec<&str> = cells.map(|cell| cell.trim()).filter(|word| !word.is_empty()).collect();
    words.join(" ")
}

/// The cells of all lines that hold some.
fn rows(text: &str, separator: u8) -> Vec<Row> {
    let reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let records = reader.into_records().filter_map(Result::ok);
    let rows = records.map(|record| {
        let line = record.position().map_or(0, |position| usize::try_from(position.line()).unwrap_or(usize::MAX));
        let is_blank = separator == b' ';
        let cells = record.iter().filter(|cell| !(is_blank && cell.trim().is_empty()));
        Row { line, cells: without_empty_end(cells.map(str::to_owned).collect()) }
    });
    rows.filter(|row| row.cells.iter().any(|cell| !cell.trim().is_empty()) && !row.cells[0].starts_with('%')).collect()
}

/// A separator at the end of a line makes no column.
fn without_empty_end(mut cells: Vec<String>) -> Vec<String> {
    if cells.len() > 2 && cells.last().is_some_and(|last| last.trim().is_empty()) {
        cells.pop();
    }
    cells
}

/// The separator that makes two columns or more of the first rows, and numbers of their cells if any does.
fn separator_of(text: &str) -> Option<u8> {
    let beginning = beginning_of(text);
    let judged = SEPARATORS.map(|separator| (separator, quality(beginning, separator)));
    let best = judged.into_iter().rev().max_by(|one, other| one.1.total_cmp(&other.1))?;
    (best.1 > 0.0).then_some(best.0)
}

/// The lines that a separator is judged by, and some more for names and remarks.
fn beginning_of(text: &str) -> &str {
    let end = text.match_indices('\n').nth(2 * JUDGED_ROWS).map_or(text.len(), |(at, _)| at);
    &text[..end]
}

/// The share of cells that are numbers where rows have two cells or more; 0 where they have not.
fn quality(text: &str, separator: u8) -> f64 {
    let rows = rows(text, separator);
    let numeric: Vec<&Row> = rows.iter().filter(|row| row.is_numeric()).collect();
    let wide = numeric.iter().filter(|row| row.cells.len() >= 2).count();
    if wide == 0 || 2 * wide < numeric.len() {
        return 0.0;
    }
    let cells = numeric.iter().flat_map(|row| &row.cells);
    let (all, good) = cells.fold((0_u32, 0_u32), |(all, good), cell| {
        (all + 1, good + u32::from(matches!(read(cell), Cell::Number(_) | Cell::Missing)))
    });
    // A separator of which no cell is a number still says where the fault is.
    f64::from(good) / f64::from(all) + 1e-3
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<Vec<f64>> {
        Table::read(text.as_bytes()).unwrap().columns.into_iter().map(|column| column.values).collect()
    }

    #[test]
    fn separators_and_decimal_signs() {
        let expected = vec![vec![0.0, 0.5], vec![12.4, 12.5]];
        for text in [
            "0,12.4\n0.5,12.5",
            "0;12,4\n0,5;12,5\n",
            "0\t12.4\r\n0.5\t12.5\r\n",
            "0\t12,4\n0,5\t12,5",
            "0 12.4\n0.5  12.5",
            "  0,0   12,4\n  0,5   12,5\n",
            "\u{feff}t;h\n0;12,4\n0,5;12,5",
            "# rig 3\nt, h1\n0, 12.4\n\n0.5, 12.5",
            "% MATLAB\n0;12.4;\n0.5;12.5;\n",
        ] {
            assert_eq!(values(text), expected, "{text:?}");
        }
    }

    #[test]
    fn names_and_units_above_the_numbers() {
        let names = |text: &str| -> Vec<String> {
            Table::read(text.as_bytes()).unwrap().columns.into_iter().map(|column| column.name).collect()
        };
        assert_eq!(names("t (s);h1 (cm)\n0;1"), ["t (s)", "h1 (cm)"]);
        assert_eq!(names("time,level\ns,cm\n0,1"), ["time s", "level cm"]);
        assert_eq!(names("0,1\n1,2"), ["", ""]);
        assert_eq!(names("a title of its own\nt,h\n0,1"), ["a title of its own t", "h"]);
    }

    #[test]
    fn holes_are_not_numbers() {
        let columns = values("t,h\n0,1\n1,\n2,nan\n3,4");
        assert_eq!(columns[0], [0.0, 1.0, 2.0, 3.0]);
        assert!(columns[1][1].is_nan() && columns[1][2].is_nan() && columns[1][3] == 4.0);
    }

    #[test]
    fn faults_are_named_with_their_place() {
        let fault = |text: &str| Table::read(text.as_bytes()).unwrap_err();
        assert_eq!(fault(""), RecordError::Empty);
        assert_eq!(fault("t,h\n"), RecordError::Empty);
        assert_eq!(fault("1\n2\n3"), RecordError::OneColumn);
        assert_eq!(fault("t,h\n0,1\n1,2,3"), RecordError::Ragged { line: 3, expected: 2, found: 3 });
        let cell = "open".to_owned();
        assert_eq!(fault("t,h\n0,1\n1,open"), RecordError::NotANumber { line: 3, column: 2, cell });
        let cell = "1.234,5".to_owned();
        assert_eq!(fault("t;h\n0;1,5\n1;1.234,5"), RecordError::TwoDecimalSigns { line: 3, column: 2, cell });
        assert_eq!(Table::read(&[0xff, 0xfe, 0x00]), Err(RecordError::NotText));
        let latin = b"t;n\xedvel\n0;1\n";
        assert_eq!(Table::read(latin).unwrap().columns[1].name, "nível");
        let huge = vec![b'1'; MAX_BYTES + 1];
        assert_eq!(Table::read(&huge), Err(RecordError::TooLarge { bytes: MAX_BYTES + 1, max: MAX_BYTES }));
    }
}
