//! The ranking and the residuals as text, CSV and JSON.

use std::fmt::Write as _;

use chromascope_core::camera::recorded::{Freedom, Link, LinkKind, RESAMPLES, RankRange, RecordedFit, RecordedPatch};
use chromascope_figure::number::significant;
use chromascope_figure::{Cell, Column, Field, Table};
use serde_json::{Value, json};

use crate::format::{fixed, rank_in_words};
use crate::scene::recorded::{CHANNELS, RANK_CAUTION, RankedCamera, cause_in_words, range_in_words};

/// Cameras that the table shows; CSV and JSON have all.
const SHOWN: usize = 15;
/// Share of the squares below which a cause is not named in the table.
const NOTABLE: f64 = 0.25;

fn names(patches: &[RecordedPatch]) -> Vec<String> {
    patches.iter().map(|patch| patch.name.clone()).collect()
}

fn cameras<'a>(ranked: &'a [RankedCamera], patches: &'a [String]) -> impl Iterator<Item = Ranked<'a>> {
    let fitted =
        ranked.iter().filter_map(|camera| Some((camera.rank?, camera.name.as_str(), camera.fit.as_ref().ok()?)));
    fitted.enumerate().map(move |(place, (rank, name, fit))| Ranked { place, rank, name, fit, patches })
}

/// Percent of a logarithm; a dash for none.
fn percent(log: Option<f64>) -> String {
    log.map_or_else(|| "–".to_owned(), |log| fixed(log * 100.0, 2))
}

struct Ranked<'a> {
    place: usize,
    rank: RankRange,
    name: &'a str,
    fit: &'a RecordedFit,
    patches: &'a [String],
}

impl Ranked<'_> {
    /// The patch with the largest residuals.
    fn worst(&self) -> Option<(&str, f64)> {
        self.fit.worst_patches().first().map(|(patch, rms)| (self.patches[*patch].as_str(), *rms))
    }
}

fn column(name: &str, width: usize, decimals: usize) -> Column {
    Column { width, decimals: Some(decimals), ..Column::from(name) }
}

fn in_percent(log: Option<f64>) -> Cell {
    log.map(|log| log * 100.0).into()
}

/// Aligned columns: the ranking, then residuals and causes of the first.
pub(super) fn table(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let names = names(patches);
    let heads = [("RMS %", 5), ("R %", 5), ("G %", 5), ("B %", 5)].map(|(name, width)| column(name, width, 2));
    let mut best =
        Table::new([column("rank", 5, 0), "camera".into()].into_iter().chain(heads).chain(["worst patch".into()]));
    for camera in cameras(ranked, &names).take(SHOWN) {
        let [first, _] = camera.rank.range;
        let rank = Cell::from(first as f64).with(|note| note.words = Some(rank_in_words(Some(camera.rank.range))));
        let worst = camera.worst().map(|(name, rms)| format!("{name}, {} %", percent(Some(rms))));
        let [r, g, b] = camera.fit.channel_rms();
        let percents = [Some(camera.fit.rms()), r, g, b].map(in_percent).into_iter();
        best.push([rank, camera.name.into()].into_iter().chain(percents).chain([worst.unwrap_or_default().into()]));
    }
    let mut text = best.to_text();
    let left = cameras(ranked, &names).count().saturating_sub(SHOWN);
    if left > 0 {
        let _ = writeln!(text, "       {left} more cameras: --format csv");
    }
    let Some(Ranked { rank, name, fit, .. }) = cameras(ranked, &names).next() else { return text };
    let _ = write!(text, "\n{name}: {}.\n{RANK_CAUTION}\n", range_in_words(rank));
    let _ = write!(text, "\nResiduals of {name} in percent (recorded over modeled)\n\n");
    let heads = ["R", "G", "B"].map(|name| column(name, 6, 2)).into_iter();
    let mut residuals = Table::new(heads.chain([column("brightness", 10, 3)]));
    for (row, brightness) in fit.residuals.iter().zip(&fit.brightness) {
        residuals.push(row.map(|log| in_percent(log.ok())).into_iter().chain([Cell::from(*brightness)]));
    }
    residuals.insert(0, column("patch", 5, 0), names.iter().map(|name| name.as_str().into()));
    text += &residuals.to_text();
    let gains = fit.gains.map(|gain| gain.map_or_else(|| "–".to_owned(), |gain| format!("{gain:.5e}")));
    let _ = write!(text, "\nGains {}; {} values, {} fitted parameters, ", gains.join(", "), fit.values, fit.parameters);
    let _ = writeln!(text, "standard deviation {} % by the degrees of freedom", percent(Some(fit.deviation())));
    for (reason, places) in excluded(patches, fit) {
        let _ = writeln!(text, "Excluded, {reason}: {}", places.join(", "));
    }
    for link in fit.links.iter().filter(|link| link.share >= NOTABLE) {
        let cause = cause_in_words(link.kind, link.amount, &names);
        let _ = writeln!(text, "{} % of the squares would be explained by: {cause}", fixed(link.share * 100.0, 0));
    }
    text
}

fn excluded(patches: &[RecordedPatch], fit: &RecordedFit) -> Vec<(String, Vec<String>)> {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for (patch, row) in patches.iter().zip(&fit.residuals) {
        for (why, channel) in row.iter().zip(CHANNELS).filter_map(|(value, channel)| Some((value.err()?, channel))) {
            let (why, place) = (why.to_string(), format!("{} {channel}", patch.name));
            match reasons.iter_mut().find(|(reason, _)| *reason == why) {
                Some((_, places)) => places.push(place),
                None => reasons.push((why, vec![place])),
            }
        }
    }
    reasons
}

fn columns<'a>() -> [Field<Ranked<'a>>; 19] {
    [
        Field::new("rank", |camera| (camera.place + 1).to_string().into()),
        Field::new("rank_first", |camera| camera.rank.range[0].to_string().into()),
        Field::new("rank_last", |camera| camera.rank.range[1].to_string().into()),
        Field::new("first_share", |camera| camera.rank.first.into()),
        Field::new("camera", |camera| camera.name.into()),
        Field::new("rms_percent", |camera| (camera.fit.rms() * 100.0).into()),
        Field::new("deviation_percent", |camera| (camera.fit.deviation() * 100.0).into()),
        Field::new("rms_r_percent", |camera| in_percent(camera.fit.channel_rms()[0])),
        Field::new("rms_g_percent", |camera| in_percent(camera.fit.channel_rms()[1])),
        Field::new("rms_b_percent", |camera| in_percent(camera.fit.channel_rms()[2])),
        Field::new("gain_r", |camera| camera.fit.gains[0].into()),
        Field::new("gain_g", |camera| camera.fit.gains[1].into()),
        Field::new("gain_b", |camera| camera.fit.gains[2].into()),
        Field::new("values", |camera| camera.fit.values.to_string().into()),
        Field::new("parameters", |camera| camera.fit.parameters.to_string().into()),
        Field::new("worst_patch", |camera| camera.worst().map_or("", |(name, _)| name).into()),
        Field::new("worst_patch_percent", |camera| in_percent(camera.worst().map(|(_, rms)| rms))),
        Field::new("cause", |camera| {
            camera
                .fit
                .links
                .first()
                .map_or_else(String::new, |link| cause_in_words(link.kind, link.amount, camera.patches))
                .into()
        }),
        Field::new("cause_share", |camera| camera.fit.links.first().map(|link| link.share).into()),
    ]
}

pub(super) fn csv(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    Table::of(&columns(), cameras(ranked, &names(patches))).csv(significant)
}

pub(super) fn residuals(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let mut table = Table::new(["camera", "patch", "channel", "residual_percent", "excluded"]);
    for Ranked { name, fit, .. } in cameras(ranked, &[]) {
        for (patch, row) in patches.iter().zip(&fit.residuals) {
            for (value, channel) in row.iter().zip(CHANNELS) {
                let why = value.err().map_or_else(String::new, |why| why.to_string());
                let residual = in_percent(value.ok());
                table.push([name.into(), patch.name.as_str().into(), channel.into(), residual, why.into()]);
            }
        }
    }
    table.csv(significant)
}

pub(super) fn json(patches: &[RecordedPatch], ranked: &[RankedCamera], freedom: Freedom) -> String {
    let names = names(patches);
    let cameras: Vec<Value> = cameras(ranked, &names).map(camera).collect();
    let recorded = |patch: &RecordedPatch| {
        let rgb = patch.rgb.map(|signal| signal.value().ok());
        let excluded = patch.rgb.map(|signal| signal.value().err().map(|why| why.to_string()));
        json!({ "name": patch.name, "rgb": rgb, "excluded": excluded })
    };
    let value = json!({
        "free": { "gains": freedom.gains, "brightness": freedom.brightness },
        "resamples": RESAMPLES,
        "patches": patches.iter().map(recorded).collect::<Vec<_>>(),
        "cameras": cameras,
    });
    format!("{value:#}\n")
}

fn camera(Ranked { place, rank, name, fit, patches }: Ranked<'_>) -> Value {
    let percent = |log: Option<f64>| log.map(|log| log * 100.0);
    let link = |link: &Link| {
        let kind = match link.kind {
            LinkKind::Light => "light",
            LinkKind::Channel(_) => "sensitivity",
            LinkKind::Patch(_) => "patch",
        };
        let words = cause_in_words(link.kind, link.amount, patches);
        json!({ "link": kind, "cause": words, "amount": link.amount, "share_of_squares": link.share })
    };
    json!({
        "rank": place + 1,
        "rank_range": rank.range,
        "first_share": rank.first,
        "camera": name,
        "rms_percent": fit.rms() * 100.0,
        "deviation_percent": fit.deviation() * 100.0,
        "channel_rms_percent": fit.channel_rms().map(percent),
        "gains": fit.gains,
        "brightness": fit.brightness,
        "values": fit.values,
        "parameters": fit.parameters,
        "residuals_percent": fit.residuals.iter().map(|row| row.map(|r| percent(r.ok()))).collect::<Vec<_>>(),
        "causes": fit.links.iter().map(link).collect::<Vec<_>>(),
    })
}
