//! Numbers with their uncertainties.

use chromascope_figure::number::{aligned, behind, decimals_by, rounded};

#[test]
fn a_value_ends_where_its_uncertainty_ends() {
    let cases = [
        (0.90512, Some(0.1149), "0.91", Some("± 0.11")),
        (0.90512, Some(0.0996), "0.91", Some("± 0.10")),
        (0.90512, Some(0.003_54), "0.9051", Some("± 0.0035")),
        (246.39, Some(123.0), "250", Some("± 120")),
        (-16.4348, Some(14.6), "−16", Some("± 15")),
        (20.8626, Some(2.3), "20.9", Some("± 2.3")),
        (-0.4, Some(15.0), "0", Some("± 15")),
        (99.96, Some(0.996), "100.0", Some("± 1.0")),
        (1.5, Some(0.0), "1.50", None),
        (1.5, Some(f64::NAN), "1.50", None),
        (1.5, Some(f64::INFINITY), "1.50", None),
        (1.5, None, "1.50", None),
    ];
    for (value, uncertainty, number, by) in cases {
        let own = uncertainty.and_then(decimals_by).unwrap_or(2);
        let written = uncertainty.and_then(|by| behind(by, false));
        assert_eq!(
            (rounded(value, own), written),
            (number.to_owned(), by.map(str::to_owned)),
            "{value} {uncertainty:?}"
        );
    }
    assert_eq!(behind(0.0996, true).as_deref(), Some("± 0.10†"));
    let column = [(12.3, 2), (4.52, 1), (7.1, 0), (123.0, -1)].map(|(value, own)| aligned(value, own, 2));
    assert_eq!(column, ["12.30", "4.5 ", "7   ", "120   "]);
    assert_eq!(aligned(123.0, -1, 0), "120");
}
