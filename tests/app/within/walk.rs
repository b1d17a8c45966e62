//! Arrows among rows of items.

use super::*;

#[test]
fn arrows_stay_within_rows_of_unequal_length() {
    let patch = |name: &str| PlotItem::Patch { source: None, patch: name.to_owned() };
    let rows = [vec![patch("a"), patch("b"), patch("c")], vec![patch("d")]];
    let go = |from: Option<&str>, step| moved(&rows, from.map(patch).as_ref(), step);
    assert_eq!(go(None, [1, 0]), Some(patch("a")));
    assert_eq!(go(Some("elsewhere"), [0, 1]), Some(patch("a")));
    assert_eq!(go(Some("b"), [1, 0]), Some(patch("c")));
    assert_eq!(go(Some("c"), [1, 0]), Some(patch("c")));
    assert_eq!(go(Some("c"), [0, 1]), Some(patch("d")));
    assert_eq!(go(Some("d"), [-1, -1]), Some(patch("a")));
    assert_eq!(moved(&[], None, [1, 0]), None);
}
