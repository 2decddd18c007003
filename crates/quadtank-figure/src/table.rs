use super::{Chart, Course, Pen, Role, Series};

/// What a curve amounts to, in the unit of its axis: for a sentence in place of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// What the curve stands for.
    pub role: Role,
    /// How it is drawn.
    pub pen: Pen,
    /// Lowest value.
    pub lowest: f64,
    /// Highest value.
    pub highest: f64,
    /// First value.
    pub first: f64,
    /// Last value.
    pub last: f64,
}

/// The curves of a chart as a table of numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns; the first is the label of the x axis.
    pub columns: Vec<String>,
    /// Rows, as long as `columns`; where a curve has no value, NaN.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// The table as spreadsheets take it from the clipboard: tabs between columns, all digits, numbers with this decimal sign, and an
    /// empty cell where there is no value.
    pub fn to_tsv(&self, decimal: char) -> String {
        let cell = |value: &f64| {
            if value.is_finite() { value.to_string().replace('.', &decimal.to_string()) } else { String::new() }
        };
        let name = |name: &String| name.split_whitespace().collect::<Vec<_>>().join(" ");
        let rows = self.rows.iter().map(|row| row.iter().map(cell).collect::<Vec<_>>());
        let lines = std::iter::once(self.columns.iter().map(name).collect()).chain(rows);
        lines.map(|cells: Vec<String>| cells.join("\t") + "\n").collect()
    }
}

impl Chart<'_> {
    /// A summary of every curve that has a finite value, from the back to the front.
    pub fn summary(&self) -> Vec<Summary> {
        self.series().filter_map(Series::summary).collect()
    }
}

impl Series<'_> {
    fn summary(&self) -> Option<Summary> {
        let values = || self.y.iter().map(|y| y * self.y_scale).filter(|y| y.is_finite());
        Some(Summary {
            role: self.role,
            pen: self.pen,
            lowest: values().reduce(f64::min)?,
            highest: values().reduce(f64::max)?,
            first: values().next()?,
            last: values().next_back()?,
        })
    }

    /// The value at an abscissa, in the unit of the axis, if the curve has rising abscissae and reaches there.
    pub fn at(&self, x: f64) -> Option<f64> {
        let next = self.x.partition_point(|&other| other <= x);
        let (x0, y0) = (*self.x.get(next.checked_sub(1)?)?, *self.y.get(next - 1)?);
        let value = match (self.x.get(next), self.y.get(next)) {
            (Some(x1), Some(y1)) if self.course == Course::Straight => y0 + (x - x0) / (x1 - x0) * (y1 - y0),
            (Some(_), Some(_)) => y0,
            _ if x == x0 => y0,
            _ => return None,
        };
        Some(value * self.y_scale).filter(|value| value.is_finite())
    }
}

/// The named curves of charts that share their x axis, at the abscissae of the first of them inside the range of its
/// chart: every n-th, and the last, at most `most` rows.
pub fn table(charts: &[Chart], most: usize) -> Table {
    let named = || charts.iter().flat_map(Chart::series).filter(|series| !series.name.is_empty());
    let (Some(chart), Some(lead)) = (charts.first(), named().next()) else { return Table::default() };
    let label = charts.iter().map(|chart| &chart.x.label).find(|label| !label.is_empty()).cloned().unwrap_or_default();
    let (from, to) = chart.x.span();
    let inside: Vec<f64> = lead.x.iter().copied().filter(|x| (from..=to).contains(x)).collect();
    let stride = inside.len().saturating_sub(1).div_ceil(most.max(2) - 1).max(1);
    let last = inside.len().saturating_sub(1);
    let chosen = inside.iter().enumerate().filter(|(number, _)| number % stride == 0 || *number == last);
    let row = |x: f64| std::iter::once(x).chain(named().map(|series| series.at(x).unwrap_or(f64::NAN))).collect();
    Table {
        columns: std::iter::once(label).chain(named().map(|series| series.name.to_string())).collect(),
        rows: chosen.map(|(_, &x)| row(x)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_for_the_clipboard_has_tabs_and_the_decimal_sign_of_the_reader() {
        let table = Table {
            columns: vec!["time (s)".to_owned(), "level\t1".to_owned()],
            rows: vec![vec![0.5, -12.25], vec![1.0, f64::NAN]],
        };
        assert_eq!(table.to_tsv(','), "time (s)\tlevel 1\n0,5\t-12,25\n1\t\n");
        assert_eq!(table.to_tsv('.').lines().nth(1), Some("0.5\t-12.25"));
    }
}
