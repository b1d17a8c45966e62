//! The figure that the page keeps.

use super::*;

#[test]
fn a_figure_is_fresh_for_a_while_and_an_equal_one_leaves_it_in_place() {
    let mut view = LastPage::default();
    let of = (PaneKind::SPECTRA, Paper::default());
    assert!(view.fresh(of, 1.0).is_none());
    let first = view.keep(of, 1.0, Some(Figure::new("Spectra", [1.0; 2]))).expect("a figure");
    let (fresh, rest) = view.fresh(of, 1.04).expect("fresh");
    assert!(Arc::ptr_eq(&fresh.expect("a figure"), &first) && (rest.as_secs_f64() - 0.06).abs() < 1e-9);
    assert!(view.fresh((of.0, Paper { dpi: 600.0, ..of.1 }), 1.04).is_none(), "another paper");
    assert!(view.fresh(of, 1.11).is_none(), "some time later");
    let again = view.keep(of, 1.11, Some(Figure::new("Spectra", [1.0; 2]))).expect("a figure");
    assert!(Arc::ptr_eq(&again, &first));
    let other = view.keep(of, 1.3, Some(Figure::new("Spectra", [2.0; 2]))).expect("a figure");
    assert!(!Arc::ptr_eq(&other, &first));
}
