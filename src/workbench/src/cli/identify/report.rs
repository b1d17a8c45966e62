//! The ranking and the residuals as text, CSV and JSON.

use std::fmt::Write as _;

use chromascope_core::camera::recorded::{Freedom, Link, LinkKind, RESAMPLES, RankRange, RecordedFit, RecordedPatch};
use serde_json::{Value, json};

use crate::cli::tables::{field, significant};
use crate::format::{fixed, rank_in_words};
use crate::scene::recorded::{CHANNELS, RANK_CAUTION, RankedCamera, cause_in_words, range_in_words};

/// Cameras that the table shows; CSV and JSON have all.
const SHOWN: usize = 15;
/// Share of the squares below which a cause is not named in the table.
const NOTABLE: f64 = 0.25;

fn names(patches: &[RecordedPatch]) -> Vec<String> {
    patches.iter().map(|patch| patch.name.clone()).collect()
}

/// Cameras that have a fit, with their ranks by the bootstrap.
fn fitted(ranked: &[RankedCamera]) -> impl Iterator<Item = (RankRange, &str, &RecordedFit)> {
    ranked.iter().filter_map(|camera| Some((camera.rank?, camera.name.as_str(), camera.fit.as_ref().ok()?)))
}

/// Percent of a logarithm, aligned; a dash for none.
fn percent(log: Option<f64>) -> String {
    log.map_or_else(|| "–".to_owned(), |log| fixed(log * 100.0, 2))
}

/// Aligned columns: the ranking, then residuals and causes of the first.
pub(super) fn table(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let names = names(patches);
    let widest = fitted(ranked).take(SHOWN).map(|(_, name, _)| name.chars().count()).max().unwrap_or(0);
    let mut text = format!(" rank  {:widest$}  RMS %    R %    G %    B %  worst patch\n", "camera");
    for (rank, name, fit) in fitted(ranked).take(SHOWN) {
        let rank = rank_in_words(Some(rank.range));
        let [r, g, b] = fit.channel_rms().map(percent);
        let worst =
            fit.worst_patches().first().map(|(patch, rms)| format!("{}, {} %", names[*patch], percent(Some(*rms))));
        let worst = worst.unwrap_or_default();
        let rms = percent(Some(fit.rms()));
        let _ = writeln!(text, "{rank:>5}  {name:widest$}  {rms:>5}  {r:>5}  {g:>5}  {b:>5}  {worst}");
    }
    let left = fitted(ranked).count().saturating_sub(SHOWN);
    if left > 0 {
        let _ = writeln!(text, "       {left} more cameras: --format csv");
    }
    let Some((rank, name, fit)) = fitted(ranked).next() else { return text };
    let _ = write!(text, "\n{name}: {}.\n{RANK_CAUTION}\n", range_in_words(rank));
    let _ = write!(text, "\nResiduals of {name} in percent (recorded over modeled)\n\n");
    let widest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(5);
    let _ = writeln!(text, "{:widest$}       R       G       B  brightness", "patch");
    for (patch, name) in names.iter().enumerate() {
        let cells = fit.residuals[patch].map(|residual| match residual {
            Ok(log) => fixed(log * 100.0, 2),
            Err(_) => "–".to_owned(),
        });
        let brightness = fit.brightness[patch].map_or_else(|| "–".to_owned(), |b| fixed(b, 3));
        let _ = writeln!(text, "{name:widest$}  {:>6}  {:>6}  {:>6}  {brightness:>10}", cells[0], cells[1], cells[2]);
    }
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

/// Excluded values, by reason.
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

/// Rows of numbers, empty where there is none.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, significant)
}

pub(super) fn csv(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let names = names(patches);
    let mut text = "rank,rank_first,rank_last,first_share,camera,rms_percent,deviation_percent,rms_r_percent,rms_g_percent,rms_b_percent,\
                    gain_r,gain_g,gain_b,values,parameters,worst_patch,worst_patch_percent,cause,cause_share\n"
        .to_owned();
    for (index, (rank, name, fit)) in fitted(ranked).enumerate() {
        let RankRange { range: [first, last], first: share_first } = rank;
        let (rank, share_first) = (index + 1, significant(share_first));
        let logs = [Some(fit.rms()), Some(fit.deviation())].into_iter().chain(fit.channel_rms());
        let numbers = logs.map(|log| number(log.map(|log| log * 100.0))).chain(fit.gains.map(number));
        let numbers: Vec<String> = numbers.collect();
        let worst = fit.worst_patches().first().copied();
        let patch = worst.map_or_else(String::new, |(patch, _)| field(&names[patch]));
        let worst = number(worst.map(|(_, rms)| rms * 100.0));
        let link = fit.links.first();
        let cause = link.map_or_else(String::new, |link| field(&cause_in_words(link.kind, link.amount, &names)));
        let share = number(link.map(|link| link.share));
        let (values, parameters) = (fit.values, fit.parameters);
        let _ = writeln!(
            text,
            "{rank},{first},{last},{share_first},{},{},{values},{parameters},{patch},{worst},{cause},{share}",
            field(name),
            numbers.join(",")
        );
    }
    text
}

/// All residuals as CSV.
pub(super) fn residuals(patches: &[RecordedPatch], ranked: &[RankedCamera]) -> String {
    let mut text = "camera,patch,channel,residual_percent,excluded\n".to_owned();
    for (_, name, fit) in fitted(ranked) {
        for (patch, row) in patches.iter().zip(&fit.residuals) {
            for (value, channel) in row.iter().zip(CHANNELS) {
                let (residual, why) = match value {
                    Ok(log) => (significant(log * 100.0), String::new()),
                    Err(why) => (String::new(), why.to_string()),
                };
                let _ = writeln!(text, "{},{},{channel},{residual},{why}", field(name), field(&patch.name));
            }
        }
    }
    text
}

/// Everything as JSON.
pub(super) fn json(patches: &[RecordedPatch], ranked: &[RankedCamera], freedom: Freedom) -> String {
    let names = names(patches);
    let numbered = fitted(ranked).enumerate();
    let cameras: Vec<Value> =
        numbered.map(|(index, (rank, name, fit))| camera(index + 1, rank, (name, fit), &names)).collect();
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

fn camera(rank: usize, by_bootstrap: RankRange, (name, fit): (&str, &RecordedFit), names: &[String]) -> Value {
    let percent = |log: Option<f64>| log.map(|log| log * 100.0);
    let link = |link: &Link| {
        let kind = match link.kind {
            LinkKind::Light => "light",
            LinkKind::Channel(_) => "sensitivity",
            LinkKind::Patch(_) => "patch",
        };
        let words = cause_in_words(link.kind, link.amount, names);
        json!({ "link": kind, "cause": words, "amount": link.amount, "share_of_squares": link.share })
    };
    json!({
        "rank": rank,
        "rank_range": by_bootstrap.range,
        "first_share": by_bootstrap.first,
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
