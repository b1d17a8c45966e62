//! Scale of maps of differences.

use super::*;

#[test]
fn data_reach_near_the_end_of_the_scale() {
    let ratio = |largest: f32| largest / Scale::holding(largest, largest, Metric::DELTA_E_2000).end;
    assert!((200..3000).all(|hundredths| (0.6..=1.0).contains(&ratio(hundredths as f32 / 100.0))));
}

#[test]
fn ground_and_hatch_are_no_colors_of_the_scale() {
    let far = |a: [u8; 4], b: [u8; 3]| (0..3).any(|i| a[i].abs_diff(b[i]) > 40);
    let colors = || (0..=100).map(|share| difference_ramp(share as f32 / 100.0));
    assert!(colors().all(|color| far(GROUND, color)));
}

#[test]
fn ticks_are_round_in_the_metrics_units() {
    let ticks =
        |largest, metric| Scale::holding(largest, largest, metric).ticks().map(|(_, words)| words).collect::<Vec<_>>();
    assert_eq!(ticks(12.1, Metric::DELTA_E_2000), ["0", "5", "10", "15"]);
    assert_eq!(ticks(0.9, Metric::DELTA_E_2000), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
    assert_eq!(ticks(0.14, Metric::XY), ["0", "0.05", "0.1", "0.15"]);
    assert_eq!(ticks(10.6, Metric::DELTA_E_2000), ["0", "3", "6", "9", "12"]);
    assert_eq!(ticks(7e9, Metric::UV_PRIME).last().map(String::as_str), Some("≥ 1"));
    let few_are_larger = Scale::holding(0.05, 0.12, Metric::XY).ticks().last();
    assert_eq!(few_are_larger, Some((1.0, "≥ 0.05".to_owned())));
}
