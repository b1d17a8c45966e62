//! Columns of a table on screen: form of the numbers, width.

use chromascope_figure::{Cell, Column, Table, TextSize, text_width};

use crate::format::{aligned, number, whole};
use crate::theme::UNIT;

/// Maximum width of a text column, in points; longer text is cut and shown under the pointer.
pub(super) const WIDEST_TEXT: f64 = 260.0;
/// Maximum width of a header above shorter cells.
const WIDEST_HEAD: f64 = 150.0;
const NARROWEST: f64 = 40.0;
/// Rows that the width of a column of text is taken from.
const MEASURED_ROWS: usize = 2000;
/// Significant digits of numbers without a fixed number of decimals.
const DIGITS: i32 = 6;
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// Text, flush left.
    Text,
    /// Numbers with this many decimals, right-aligned, so that decimal points line up.
    Fixed(usize),
    /// Numbers over many powers of ten.
    Scientific,
}

/// Padding left and right of a cell's content, in points.
pub(super) fn air(compact: bool) -> [f32; 2] {
    if compact { [0.0, 3.0 * UNIT] } else { [2.0 * UNIT; 2] }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout {
    pub(super) form: Form,
    pub(super) width: f32,
    /// Width of the uncertainties behind the numbers.
    pub(super) uncertainty: f32,
    /// Best number, and the one from which on the gray is darkest.
    pub(super) shades: Option<[f64; 2]>,
}

impl Layout {
    pub(super) const HIDDEN: Self = Self { form: Form::Text, width: 0.0, uncertainty: 0.0, shades: None };

    /// Where rows hold quantities of their own, their points need not line up.
    pub(super) fn of(table: &Table, index: usize, (compact, ragged): (bool, bool)) -> Self {
        let column = &table.columns[index];
        let size = if compact { TextSize::Small } else { TextSize::Body };
        let cells = || (0..table.rows.len()).map(|row| table.cell(row, index));
        let numbers = || cells().filter_map(Cell::number);
        let own: Vec<Option<i32>> =
            cells().filter(|cell| cell.number().is_some()).map(|cell| cell.note().own_decimals()).collect();
        let form = match form(column, numbers(), cells().any(|cell| cell.text().is_some())) {
            Form::Fixed(decimals) => {
                let ends = own.iter().map(|own| own.map_or(decimals, |own| own.max(0) as usize));
                Form::Fixed(ends.max().unwrap_or(decimals))
            }
            other => other,
        };
        let texts = cells().take(MEASURED_ROWS).filter(|cell| cell.note().swatch.is_none());
        let texts = texts.filter_map(|cell| Some(text_width(cell.text()?, size)));
        let text = texts.fold(0.0, f64::max).min(WIDEST_TEXT);
        let extremes = numbers().fold([0.0_f64; 2], |[low, high], value| [low.min(value), high.max(value)]);
        let written = |value: f64| text_width(&words(value, form, None), TextSize::Mono);
        let number = if form == Form::Text { numbers().map(written).fold(0.0, f64::max) } else { 0.0 };
        let number = if ragged {
            let words = numbers().zip(&own).map(|(value, own)| words(value, form, *own));
            words.map(|words| text_width(words.trim_end(), TextSize::Mono)).fold(number, f64::max)
        } else {
            extremes.into_iter().map(written).fold(number, f64::max)
        };
        let number = if numbers().next().is_some() { number } else { 0.0 };
        let behind = cells().filter_map(|cell| cell.note().behind());
        let behind = behind.map(|words| text_width(&words, TextSize::Small) + f64::from(UNIT)).fold(0.0, f64::max);
        let (arrow, least) = if compact { (0.0, 0.0) } else { (12.0, NARROWEST) };
        let head = text_width(&column.name, TextSize::Small).max(text_width(&column.unit, TextSize::Small)) + arrow;
        let content = text.max(number) + behind;
        let width = content.max(head.min(WIDEST_HEAD)).max(least) + f64::from(air(compact).iter().sum::<f32>());
        let shades = column.shaded.then(|| shades(numbers().map(f64::abs).collect(), column.largest_first)).flatten();
        Self { form, width: width.ceil() as f32, uncertainty: behind.ceil() as f32, shades }
    }

    /// Share of the darkest gray behind a number.
    pub(super) fn shade(&self, value: f64) -> Option<f32> {
        let [best, worst] = self.shades?;
        Some(((value.abs() - best) / (worst - best)).clamp(0.0, 1.0) as f32)
    }
}

/// The best of magnitudes, and the worst tenth's: one bad row does not make all others look alike. None where all are one number.
fn shades(mut values: Vec<f64>, largest_first: bool) -> Option<[f64; 2]> {
    values.sort_by(f64::total_cmp);
    if largest_first {
        values.reverse();
    }
    let best = *values.first()?;
    let worst = values[(values.len() - 1) * 9 / 10];
    (worst != best).then_some([best, worst])
}

/// Numbers of a column have one form, so that they can be read down the column.
fn form(column: &Column, numbers: impl Iterator<Item = f64> + Clone, has_text: bool) -> Form {
    let magnitudes = numbers.clone().map(f64::abs).filter(|value| *value > 0.0);
    let (mut least, mut largest, mut whole) = (f64::INFINITY, 0.0_f64, true);
    for value in magnitudes {
        (least, largest) = (least.min(value), largest.max(value));
        whole &= value.fract() == 0.0;
    }
    let none = numbers.into_iter().next().is_none();
    match column.decimals {
        _ if has_text || none => Form::Text,
        Some(decimals) => Form::Fixed(decimals),
        None if whole && largest < 1e9 => Form::Fixed(0),
        None if !(1e-3..1e6).contains(&largest) || (least < 1e-5 && largest / least > 1e7) => Form::Scientific,
        None => Form::Fixed((DIGITS - 1 - largest.log10().floor() as i32).clamp(0, DIGITS) as usize),
    }
}

/// A number in its column's format, or with its own decimals: then padded, so that decimal points line up.
pub(super) fn words(value: f64, form: Form, decimals: Option<i32>) -> String {
    match (form, decimals) {
        (Form::Fixed(column), own) => aligned(value, own.unwrap_or(whole(column)), column),
        (Form::Scientific, _) if value == 0.0 => "0".to_owned(),
        (Form::Scientific, _) => format!("{value:.3e}").replace('-', "−"),
        (Form::Text, _) => number(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_column_align() {
        let form_of = |values: &[f64]| form(&Column::default(), values.iter().copied(), false);
        assert_eq!(form_of(&[0.1, 0.25]), Form::Fixed(6));
        assert_eq!(form_of(&[1000.0, 20_000.0]), Form::Fixed(0));
        assert_eq!(form_of(&[12.5, -310.0]), Form::Fixed(3));
        assert_eq!(form_of(&[1e-12, 0.1]), Form::Scientific);
        assert_eq!(form_of(&[]), Form::Text);
        assert_eq!(words(-0.3, Form::Fixed(2), None), "−0.30");
        assert_eq!(words(41.5, Form::Fixed(4), Some(2)), "41.50  ");
        assert_eq!(words(41.5, Form::Fixed(4), Some(0)), "42     ");
    }

    #[test]
    fn the_worst_tenth_is_darkest() {
        let values: Vec<f64> = (0..=10).map(f64::from).collect();
        assert_eq!(shades(values.clone(), false), Some([0.0, 9.0]));
        assert_eq!(shades(values, true), Some([10.0, 1.0]));
        assert_eq!(shades(vec![2.0, 2.0], false), None);
        let layout = Layout { form: Form::Text, width: 0.0, uncertainty: 0.0, shades: Some([0.0, 9.0]) };
        assert_eq!([layout.shade(0.0), layout.shade(10.0)], [Some(0.0), Some(1.0)]);
    }
}
