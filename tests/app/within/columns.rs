//! Form of the numbers of a column.

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
