//! Uncertainties in the words of a header: standard deviations, standard errors, standard and expanded uncertainties.

use crate::header_terms;
use crate::text::{is_one, lower, spaced};

/// Kinds of stated uncertainties, the least telling first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Standard deviation of repeated measurements.
    Deviation,
    /// Standard error of their mean.
    Error,
    /// Nothing says which.
    Unsaid,
    /// Standard uncertainty u.
    Standard,
    /// Expanded uncertainty U = k u.
    Expanded,
}

/// How surely words mean an uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sense {
    /// They may be a name: `SE` is a direction, too.
    Open,
    /// Behind a curve they mean nothing else: no samples are called so.
    Usual,
    /// They mean nothing else.
    Clear,
}

/// What a column's header says of an uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Term {
    pub(super) kind: Kind,
    pub(super) sense: Sense,
    /// The words about the curve it belongs to, as [`key`] has them; empty if there are none.
    pub(super) of: String,
    /// Coverage factor, if it is named.
    pub(super) coverage: Option<f64>,
    /// Coverage factor of a normal distribution at the level of confidence, if that is named.
    pub(super) level: Option<f64>,
    pub(super) relative: bool,
    pub(super) percent: bool,
}

/// What a head of the program's own says: that numbers are U = k u.
pub(super) fn expanded(coverage: f64) -> Term {
    let (kind, coverage) = (Kind::Expanded, Some(coverage));
    Term { kind, sense: Sense::Clear, of: String::new(), coverage, level: None, relative: false, percent: false }
}

/// Words for uncertainties with their kind, and whether they mean nothing else.
const WORDS: [(Kind, bool, &str); 11] = [
    (
        Kind::Deviation,
        true,
        "standard deviation|standard deviations|std dev|stddev|stdev|st dev|stdv|stddevs|std deviation|sdev|rsd|stand dev|\
         coefficient of variation|standardabweichung|standardabw|stabw|écart type|ecart type|desviación estándar|desv est|desv estándar|deviazione standard|desvio padrão|標準偏差|标准偏差",
    ),
    (Kind::Deviation, false, "sd|s d|std|sigma|σ|cv"),
    (
        Kind::Error,
        true,
        "standard error of the mean|standard error of mean|standard error|standard errors|std error|std err|stderr|standardfehler",
    ),
    (Kind::Error, false, "se|s e|sem|s e m"),
    (
        Kind::Expanded,
        true,
        "expanded uncertainty|expanded uncertainties|expanded unc|exp unc|erweiterte messunsicherheit|erweiterte unsicherheit|\
         incertitude élargie|incertezza estesa|incertidumbre expandida|拡張不確かさ",
    ),
    (
        Kind::Standard,
        true,
        "standard uncertainty|standard uncertainties|std unc|std uncertainty|standardunsicherheit|incertitude type|標準不確かさ",
    ),
    (
        Kind::Unsaid,
        true,
        "uncertainty|uncertainties|uncert|uncerts|messunsicherheit|unsicherheit|incertitude|incertidumbre|incertezza|incerteza|\
         不確かさ|不确定度",
    ),
    (Kind::Unsaid, false, "unc|err|error|errors|error bar|±"),
    (Kind::Standard, true, "urel|u rel"),
    // By the letters of the GUM, U is expanded.
    (Kind::Standard, false, "u|uc|u c"),
    (Kind::Error, false, "mean se|mean sem"),
];

/// Returns whether a title or the name of a file is that of uncertainties, and no remark on their size: `Expanded uncertainty (k=2)`,
/// `k2 uncertainty`, `Standard uncertainties of the reflectances`.
pub(super) fn is_title(text: &str) -> bool {
    const REMARKS: &str = "is|are|was|were|has|have|with|and|without|see|not|about|less|than|below|percent";
    const MOST_WORDS: usize = 12;
    let text = lower(text);
    let words = || text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    // `Uncertainty: 2 %` tells how large they are.
    let remark =
        text.contains([':', '=', '%', '±']) && !text.contains("k=") || words().any(|word| is_one(word, REMARKS));
    let mut at = words().take(MOST_WORDS + 1).enumerate().filter(|(_, word)| word.starts_with("uncertaint"));
    // Behind what they are of, or before it.
    at.next().is_some_and(|(at, _)| at < 3 || at + 1 == words().count()) && !remark && words().count() <= MOST_WORDS
}

/// Words beside those for an uncertainty that say no more than they do.
const BESIDE: &str = "combined|measurement|total|estimated|spectral|confidence|level|of|in|for|the|on";

/// Uncertainty that the header of a column names, with its name without a unit and its whole label.
pub(super) fn term(name: &str, label: &str) -> Option<Term> {
    const LONGEST: usize = 80;
    if name.len() > LONGEST {
        return None;
    }
    let text = lower(label);
    let level = level(&text);
    let symbol = name.split(|c: char| !c.is_alphanumeric()).any(|word| matches!(word, "U" | "U95" | "Urel"));
    let words = key(name);
    let padded = format!(" {words} ");
    let found = WORDS.iter().flat_map(|(kind, clear, list)| list.split('|').map(|word| (*kind, *clear, word)));
    let whole = |at: usize, word: &str| padded[..at].ends_with(' ') && padded[at + word.len()..].starts_with(' ');
    let found = found.filter(|(.., word)| padded.match_indices(word).any(|(at, _)| whole(at, word)));
    let (kind, clear, word) = found.max_by_key(|(_, _, word)| word.len())?;
    let (before, after) = padded.split_once(&format!(" {word} "))?;
    let is_relative = |word: &str| is_one(word, "relative|rel|fractional|percent|percentage");
    let beside = |word: &&&str| is_relative(word) || is_one(word, BESIDE);
    let [before, after] = [before, after].map(|part| part.split_whitespace().collect::<Vec<_>>());
    let about = before.iter().rev().take_while(beside).count();
    let (before, last) = before.split_at(before.len() - about);
    let (first, after) = after.split_at(after.iter().take_while(beside).count());
    // Of how many measurements.
    let counted = matches!(after, ["n", count] if count.bytes().all(|byte| byte.is_ascii_digit()));
    let after = if counted { &[][..] } else { after };
    // A deviation divided by the mean.
    let quotient = || text.split_once('/').is_some_and(|(_, mean)| is_one(mean.trim(), MEAN));
    let relative = is_one(word, "rsd|cv|coefficient of variation|urel|u rel")
        || quotient()
        || [last, first].concat().iter().any(|word| is_relative(word));
    // Words on both sides are a sentence.
    if !before.is_empty() && !after.is_empty() {
        return None;
    }
    let kind = if kind == Kind::Standard && symbol && is_one(word, "u|urel") { Kind::Expanded } else { kind };
    let of = without_mean(&[before, after].concat().join(" "));
    let percent = header_terms::says_percent(&without_level(&text));
    let clear = clear || percent && kind == Kind::Unsaid;
    // Sigma makes cameras.
    let usual = of.is_empty() && (is_one(word, "err|error|errors|error bar|unc|std|σ|±") || name.starts_with("sigma"));
    let sense = match (clear, usual) {
        (true, _) => Sense::Clear,
        (false, true) => Sense::Usual,
        (false, false) => Sense::Open,
    };
    Some(Term { kind, sense, of, coverage: coverage(&text), level, relative, percent })
}

/// The words of a name in lower case, those joined by capitals or figures apart, without what is said of a coverage factor.
pub(super) fn key(name: &str) -> String {
    // A unit that stands right behind, whatever it is: `mua_std[cm-1]`.
    let ended = name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
    let bare = ended.filter(|(bare, unit)| bare.ends_with(char::is_alphanumeric) || unit.contains(['/', '^', '²']));
    let name = bare.map_or(name, |(bare, _)| bare);
    let mut text = String::with_capacity(name.len() + 8);
    let mut digits = false;
    for c in without_level(&spaced(name).replace("+/-", "±")).chars() {
        if c.is_ascii_digit() != digits && !text.ends_with(' ') {
            text.push(' ');
        }
        digits = c.is_ascii_digit();
        if c == '±' || c == '=' {
            text.extend([' ', c, ' ']);
        } else {
            text.push(if c.is_alphanumeric() { c } else { ' ' });
        }
    }
    let mut words: Vec<&str> = text.split_whitespace().collect();
    // `k = 2` and its decimals, `2 σ`, or `one sigma uncertainty`.
    if let Some(at) = words.windows(2).position(|pair| is_one(pair[0], "k|factor") && pair[1] == "=") {
        let figures = words[at + 2..].iter().take_while(|word| word.bytes().all(|b| b.is_ascii_digit())).count();
        words.drain(at..at + 2 + figures);
    }
    if let Some(at) = words.windows(2).position(|pair| is_one(pair[1], "σ|sigma") && is_one(pair[0], SIGMAS)) {
        let told = words.get(at + 2).is_some_and(|word| is_one(word, "uncertainty|uncertainties|unc|error"));
        words.drain(at..=at + usize::from(told));
    }
    words.retain(|word| *word != "=");
    words.join(" ")
}

/// Words of a curve's name without those for a mean.
pub(super) fn without_mean(key: &str) -> String {
    let words = key.split(' ').filter(|word| !is_one(word, MEAN));
    words.collect::<Vec<_>>().join(" ")
}

const MEAN: &str = "mean|avg|ave|average|median|averaged|mittelwert|moyenne|media";

/// Returns whether a name says that values are means or uncertainties and nothing of which sample.
pub(super) fn is_statistic(name: &str) -> bool {
    term(name, name).map_or_else(|| without_mean(&key(name)).is_empty(), |term| term.of.is_empty())
}

/// Returns whether a name has a word that other names hardly have, unlike the `SE` of a direction, the Sigma of cameras and the `Std` of
/// a standard solution.
pub(super) fn has_usual_word(name: &str) -> bool {
    const WORDS: &str = "stdev|stddev|err|error|errors|unc|uncertainty|rms|rmse|noise|residual|residuals|chi2";
    let key = key(name);
    key.split(' ').any(|word| is_one(word, WORDS))
        || key.split(' ').next_back().is_some_and(|word| is_one(word, "std|sd|sem"))
}

/// Returns whether words of a curve's name say that it is the mean of others.
pub(super) fn names_mean(key: &str) -> bool {
    key.split(' ').any(|word| is_one(word, MEAN))
}

const SIGMAS: &str = "1|2|3|one|two|three";

/// The coverage factor k in a text in lower case: `k=2`, `k = 1.96`, `coverage factor: 2`, `2σ`.
pub(super) fn coverage(lower: &str) -> Option<f64> {
    let number = |text: &str| {
        let text = text.trim_start_matches([' ', ':', '=', '(']).trim_start_matches("of ").trim_start_matches("is ");
        let text = text.trim_start_matches("k =").trim_start_matches("k=").trim_start();
        let end = text.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ','))).unwrap_or(text.len());
        text[..end].trim_end_matches(['.', ',']).replace(',', ".").parse::<f64>().ok()
    };
    let letter = || {
        lower.match_indices('k').find_map(|(at, _)| {
            let rest = lower[at + 1..].trim_start();
            let alone = !lower[..at].ends_with(char::is_alphanumeric) && rest.starts_with(['=', ':']);
            number(rest).filter(|_| alone)
        })
    };
    let named = || lower.split_once("coverage factor").and_then(|(_, rest)| number(rest));
    let sigmas = || {
        let at = lower.find('σ').or_else(|| lower.find("sigma"))?;
        let before = lower[..at].trim_end_matches([' ', '-']);
        let word = before.rsplit(|c: char| !c.is_alphanumeric()).next()?;
        let place = SIGMAS.split('|').position(|sigmas| sigmas == word)?;
        Some((place % 3 + 1) as f64)
    };
    letter().or_else(named).or_else(sigmas).filter(|k| (0.5..=10.0).contains(k))
}

/// Levels of confidence with their coverage factors, that of 95 % as laboratories round it.
const LEVELS: [(&str, f64); 3] = [("95", 2.0), ("99", 2.576), ("90", 1.645)];

fn level(lower: &str) -> Option<f64> {
    if without_level(lower) == lower {
        return None;
    }
    LEVELS.iter().find(|(level, _)| lower.contains(level)).map(|(_, k)| *k)
}

/// A text in lower case without a level of confidence: `95 %`, `95%`, `U95`.
fn without_level(lower: &str) -> String {
    let Some((level, at)) = LEVELS.iter().find_map(|(level, _)| Some((*level, lower.find(level)?))) else {
        return lower.to_owned();
    };
    let (before, after) = (&lower[..at], &lower[at + level.len()..]);
    let after_sign = after.trim_start().strip_prefix('%');
    let symbol = before.ends_with(['u', 'U']) || before.ends_with("u_");
    match after_sign.or(Some(after).filter(|after| symbol && !after.starts_with(char::is_alphanumeric))) {
        Some(rest) if !before.ends_with(|c: char| c.is_ascii_digit() || c == '.') => {
            format!("{before} {rest}")
        }
        _ => lower.to_owned(),
    }
}
