//! The ratio between the channels of each built-in camera table, and the rule that judges it.

use chromascope_core::camera::channel_ratio::{RatioDeviation, RatioLoss, has_equal_maxima};
use chromascope_core::camera::{ChannelRatio, RatioTable};
use chromascope_core::spectral::{Primaries, Response, Sensor};

use crate::support::{assert_near, dataset, light, sensors};

/// Maker, name and table of each built-in camera.
fn tables() -> Vec<(String, String, RatioTable)> {
    let d65 = light("illuminants/d65.csv");
    let table = |(path, sensor): (String, Sensor)| {
        let header = dataset(&path).header;
        let maker = header.title.split(' ').next().unwrap().to_owned();
        (maker, header.title.clone(), RatioTable::new(&sensor, &d65, header.is_digitized()))
    };
    sensors("cameras").into_iter().map(table).collect()
}

fn all() -> Vec<(String, ChannelRatio)> {
    let tables = tables();
    let ratio = |(maker, name, own): &(String, String, RatioTable)| {
        let others = tables.iter().filter(|other| other.0 == *maker && other.1 != *name).map(|other| other.2);
        (name.clone(), ChannelRatio::new(own, others))
    };
    tables.iter().map(ratio).collect()
}

/// Independent figures: a sum of linearly interpolated tables in Python.
#[test]
fn ratios_of_the_library() {
    let all = all();
    let named = |is: fn(&ChannelRatio) -> bool| -> Vec<&str> {
        all.iter().filter(|(_, ratio)| is(ratio)).map(|(name, _)| name.as_str()).collect()
    };
    let equal = ["ARRI D21", "Nikon D5100", "Nikon D5100 (NPL)", "Sigma SD1 Merrill (NPL)"];
    assert_eq!(named(|ratio| *ratio == ChannelRatio::Lost(RatioLoss::EqualMaxima)), equal);
    let figure = ["Canon EOS 10D (2007 figure)", "Nikon D70 (2007 figure)"];
    assert_eq!(named(|ratio| *ratio == ChannelRatio::Lost(RatioLoss::PrintedFigure)), figure);
    let implausible = ["Canon PowerShot S90", "Nikon D200", "Nikon D70 (UPenn 2011)"];
    assert_eq!(named(|ratio| matches!(ratio, ChannelRatio::Implausible(_))), implausible);
    assert_eq!(named(|ratio| matches!(ratio, ChannelRatio::Unchecked)).len(), 8);
    assert_eq!(all.len(), 58);
    let upenn = &all.iter().find(|(name, _)| name == "Nikon D70 (UPenn 2011)").unwrap().1;
    let ChannelRatio::Implausible(RatioDeviation { deviation: [red, blue], tables }) = upenn else { panic!("{upenn}") };
    assert_near("R/G", *red, 1.54, 0.02);
    assert_near("B/G", *blue, 0.05, 0.01);
    assert_eq!(*tables, 10);
    assert_eq!(
        upenn.to_string(),
        "implausible: neutral under D65 +153 % in R/G and +5 % in B/G from the median of 10 other tables of the maker"
    );
}

#[test]
fn the_rule_needs_three_other_tables_and_fifteen_percent() {
    let table = |neutral: [f64; 2]| RatioTable { neutral: Some(neutral), loss: None };
    let others = [[0.4, 0.7], [0.5, 0.8], [0.6, 0.9]].map(table);
    let of = |neutral: [f64; 2], others: &[RatioTable]| ChannelRatio::new(&table(neutral), others.iter().copied());
    assert_eq!(of([5.0, 5.0], &others[..2]), ChannelRatio::Unchecked);
    assert!(matches!(of([0.5 * 1.1499, 0.8], &others), ChannelRatio::Plausible(_)));
    for neutral in [[0.5 * 1.1501, 0.8], [0.5 * 0.8499, 0.8], [0.5, 0.8 * 1.1501], [0.5, 0.8 * 0.8499]] {
        assert!(!of(neutral, &others).is_credible(), "{neutral:?}");
    }
    // One that lost its ratio is no evidence for another.
    let lost = RatioTable { loss: Some(RatioLoss::EqualMaxima), ..others[2] };
    assert_eq!(of([5.0, 5.0], &[others[0], others[1], lost]), ChannelRatio::Unchecked);
    let blind = RatioTable { neutral: None, loss: None };
    assert_eq!(ChannelRatio::new(&blind, others), ChannelRatio::Unchecked);
}

#[test]
fn maxima_are_equal_to_a_millionth() {
    let [_, (_, of)] = sensors("cameras").into_iter().take(2).collect::<Vec<_>>().try_into().unwrap();
    let scaled = |factor: f64| {
        let [red, green, blue] = of.curves().clone();
        let blue = blue.map(|_, value| value * factor).unwrap();
        Sensor::new(Primaries::Camera, [red, green, blue], Response::PerEnergy).unwrap()
    };
    assert!(has_equal_maxima(&scaled(1.0)) && has_equal_maxima(&scaled(1.0 + 9e-7)));
    assert!(!has_equal_maxima(&scaled(1.0 + 2e-6)));
}
