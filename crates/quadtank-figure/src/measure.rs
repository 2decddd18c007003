//! Heights and widths of what surrounds a plot (CSS px).

/// Font size of ticks, labels and legends.
pub const FONT: f64 = 11.0;
/// Width of a digit at that size, on the wide side.
pub const DIGIT: f64 = 6.4;
/// Width of a character of running text at that size, on the wide side.
pub const CHARACTER: f64 = 6.0;
/// The same in bold.
pub const BOLD: f64 = 7.5;
/// Space between the plot and its tick numbers.
pub const TICK_GAP: f64 = 6.0;
/// Room for a line of text.
pub const LINE: f64 = 16.0;
/// Least space around the plot, for half a number beyond its corners.
pub const TOP: f64 = 8.0;
/// The same to the right: half of a number of four digits.
pub const RIGHT: f64 = 16.0;
/// Tick numbers with fewer characters than this do not move the plot.
pub const MIN_CHARACTERS: usize = 4;
/// Least distance of ticks on an upright axis, and of the numbers on a level one.
pub const TICK_DISTANCE: f64 = 22.0;
/// Least gap between the numbers on a level axis.
pub const NUMBER_GAP: f64 = 14.0;
/// Most ticks on an axis.
pub const MAX_TICKS: f64 = 10.0;
