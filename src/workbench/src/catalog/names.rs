//! Lookup of data sets by typed name.

use super::Entry;
use crate::document::SetKind;

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    #[error("no {kind} is named \"{name}\"{}", suggest(.name, .nearest))]
    Unknown { kind: &'static str, name: String, nearest: Vec<String> },
    #[error("\"{name}\" could be {}; type more of the name", .candidates.join(", "))]
    Ambiguous { name: String, candidates: Vec<String> },
}

fn suggest(name: &str, nearest: &[String]) -> String {
    match nearest {
        _ if is_for_phone(name) => "; no phone is among the built-in cameras: name a file with a table of your own \
                                     (wavelength, R, G, B)"
            .to_owned(),
        [] => String::new(),
        names => format!("; did you mean {}?", names.join(", ")),
    }
}

/// Camera model of a set: its name without the parenthesis that distinguishes tables of one model.
pub fn model_of(name: &str) -> &str {
    name.split_once(" (").map_or(name, |(model, _)| model)
}

/// A name without case, spaces and punctuation, for comparing. A multiplication sign is the x that is typed for it.
pub fn folded(name: &str) -> String {
    let typed = name.chars().map(|c| if c == '×' { 'x' } else { c });
    typed.filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Orders numbers within names by their value: `FL2` before `FL10`.
pub fn sort_key(name: &str) -> Vec<(String, u64)> {
    let mut key = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let digits_at = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
        let (word, tail) = rest.split_at(digits_at);
        let end = tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len());
        key.push((word.to_lowercase(), tail[..end].parse().unwrap_or(0)));
        rest = &tail[end..];
    }
    key
}

/// Lights in the order in which they are commonly used, before all others.
const IN_USE: [&str; 8] = ["D65", "D50", "A", "E", "D55", "FL2", "FL11", "LED-B3"];

/// Place of a light among those in common use, or after them.
pub fn rank_in_use(entry: &Entry) -> usize {
    let is_it = |name: &&str| entry.kind == SetKind::Illuminant && *name == entry.name;
    IN_USE.iter().position(is_it).unwrap_or(IN_USE.len())
}

/// How well a name fits a search; the best comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fit {
    /// It is the name, or what stands behind its colon or before its comma: "A" of "A, incandescent 2856 K".
    Exact,
    /// The name begins with it.
    Start,
    /// Each word is one of the name's.
    Words,
    /// Each word begins where one of the name's does.
    WordStarts,
    /// Each word is within one of the name's.
    Inside,
    /// Words of the gloss alone.
    Gloss,
    /// A letter of a word differs.
    Similar,
}

pub fn typed_words(text: &str) -> Vec<String> {
    text.split_whitespace().map(folded).filter(|word| !word.is_empty()).collect()
}

/// How typed words fit a name, if they do: the ranking of every search. Words of the gloss find the name and leave the rank to the
/// others, so that "illuminant A" is as exact as "A".
pub fn fit(typed: &[String], name: &str, gloss: &str) -> Option<Fit> {
    let (gloss, known) = (words(gloss), words(name));
    let tells = |word: &&String| known.contains(word) || !gloss.contains(word);
    let telling: Vec<String> = typed.iter().filter(tells).cloned().collect();
    let by_name = fit_of_name(typed, name, &gloss);
    match telling.as_slice() {
        [] => by_name.or(Some(Fit::Gloss)),
        telling if telling.len() == typed.len() => by_name,
        telling => by_name.into_iter().chain(fit_of_name(telling, name, &gloss)).min(),
    }
}

fn fit_of_name(typed: &[String], name: &str, gloss: &[String]) -> Option<Fit> {
    let text = typed.concat();
    let value = name.split_once(": ").map_or(name, |(_, value)| value);
    let parts = [name, value].map(|part| [part, part.split_once(", ").map_or(part, |(head, _)| head)]);
    let whole = parts.as_flattened().iter().filter_map(|part| match folded(part).strip_prefix(&text)? {
        "" => Some(Fit::Exact),
        _ => Some(Fit::Start),
    });
    let known = words(name);
    let begins = |known: &[String], word: &str| (0..known.len()).any(|at| known[at..].concat().starts_with(word));
    let within = |known: &[String], word: &str| known.iter().any(|known| known.contains(word));
    let of_word = |word: &String| match () {
        () if known.contains(word) => Some(Fit::Words),
        () if begins(&known, word) => Some(Fit::WordStarts),
        () if within(&known, word) => Some(Fit::Inside),
        () if begins(gloss, word) || within(gloss, word) => Some(Fit::Gloss),
        () => known.iter().any(|known| is_similar(known, word)).then_some(Fit::Similar),
    };
    whole.min().or_else(|| typed.iter().try_fold(Fit::Exact, |worst, word| Some(worst.max(of_word(word)?))))
}

/// True if a word was mistyped by one letter. Numbers must be right.
fn is_similar(known: &str, typed: &str) -> bool {
    const LEAST: usize = 5;
    let is_long = typed.chars().count() >= LEAST && typed.chars().all(char::is_alphabetic);
    is_long && known.len().abs_diff(typed.len()) <= 2 && strsim::osa_distance(known, typed) == 1
}

/// The items that fit a search in groups, the best first, else in the given order; similar words only where nothing else fits.
/// `facts` are an item's group, name and gloss.
pub fn ranked<T, G: PartialEq>(
    text: &str,
    items: impl Iterator<Item = T>,
    facts: impl Fn(&T) -> (G, String, String),
) -> Vec<(G, Vec<T>)> {
    let typed = typed_words(text);
    let found = items.filter_map(|item| {
        let (group, name, gloss) = facts(&item);
        Some((fit(&typed, &name, &gloss)?, group, item))
    });
    let mut found: Vec<(Fit, G, T)> = found.collect();
    found.sort_by_key(|(fit, ..)| *fit);
    let is_exact = found.first().is_some_and(|(fit, ..)| *fit < Fit::Similar);
    let mut groups: Vec<(G, Vec<T>)> = Vec::new();
    for (_, group, item) in found.into_iter().filter(|(fit, ..)| !is_exact || *fit < Fit::Similar) {
        match groups.iter_mut().find(|(known, _)| *known == group) {
            Some((_, items)) => items.push(item),
            None => groups.push((group, vec![item])),
        }
    }
    groups
}

pub const NO_PHONES: &str = "No phone is among the built-in cameras";

pub fn is_for_phone(text: &str) -> bool {
    const MAKES: [&str; 8] = ["nokia", "samsung", "pixel", "galaxy", "huawei", "xiaomi", "oneplus", "smartphone"];
    let is_phone = |word: &String| word.contains("phone") || MAKES.iter().any(|make| word.starts_with(make));
    typed_words(text).iter().any(is_phone)
}

pub fn no_match(text: &str) -> String {
    let phones = format!("No match. {NO_PHONES}. Open a table of your own (Ctrl+O): wavelength, R, G, B.");
    if is_for_phone(text) { phones } else { "No match.".to_owned() }
}

/// The entry that a typed name matches.
#[derive(Clone, Debug)]
pub struct Found<'a> {
    pub entry: &'a Entry,
    /// True if its own name was typed, ignoring case, punctuation and words such as "illuminant".
    pub exact: bool,
    /// Other tables of the same model.
    pub others: Vec<&'a str>,
}

impl<'a> Found<'a> {
    fn near(entry: &'a Entry) -> Self {
        Self { entry, exact: false, others: Vec::new() }
    }

    /// The choice in words, if another name than the entry's was typed.
    pub fn note(&self) -> Option<String> {
        let others = match self.others.as_slice() {
            [] => String::new(),
            others => format!("; also there: {}", others.join(", ")),
        };
        (!self.exact).then(|| format!("using {}{others}", self.entry.name))
    }
}

/// Words that distinguish no two sets.
const NOISE: [&str; 8] = ["cie", "illuminant", "standard", "observer", "light", "deg", "degree", "degrees"];

/// The words of a name, in lower case. Periods join: `A.M.P.A.S.` and `FL3.10` are one word each.
fn words(text: &str) -> Vec<String> {
    let joined = text.replace('.', "");
    // The masculine ordinal is typed for a degree sign, and counts as a letter.
    let between = |c: char| !c.is_alphanumeric() || c == 'º';
    joined.split(between).filter(|word| !word.is_empty()).map(str::to_lowercase).collect()
}

/// The distinguishing words of a name: without "CIE", "illuminant" and the like, unless there are no others.
pub fn telling_words(text: &str) -> Vec<String> {
    let all = words(text);
    let angle = |word: &str| {
        let number = word.trim_end_matches(|c: char| c.is_alphabetic());
        let degrees = !number.is_empty() && matches!(&word[number.len()..], "deg" | "degree" | "degrees");
        if degrees { number.to_owned() } else { word.to_owned() }
    };
    let telling: Vec<String> =
        all.iter().filter(|word| !NOISE.contains(&word.as_str())).map(|word| angle(word)).collect();
    if telling.is_empty() { all } else { telling }
}

/// Finds the entry that a typed name matches.
///
/// Case, punctuation and words that distinguish no two sets are ignored. In this order: the exact name; the name that contains all the
/// words as whole words; the only name that contains the text. Of several names with all the words, the one whose words are contained
/// in all others is used (`EOS R5`, not `EOS R5 Mark II`); of several tables of one model, which differ in parentheses only, the first
/// measured.
pub fn find<'a>(
    entries: impl Iterator<Item = &'a Entry>,
    kind: &'static str,
    name: &str,
) -> Result<Found<'a>, NameError> {
    let entries: Vec<&Entry> = entries.collect();
    let telling = telling_words(name);
    let wanted = telling.concat();
    if wanted.is_empty() {
        return Err(NameError::Unknown { kind, name: name.to_owned(), nearest: Vec::new() });
    }
    if let Some(entry) = exact(&entries, &folded(name), &wanted) {
        // A short name is not listed, and may omit the words that distinguish two sets.
        let is_short = folded(&entry.name) != folded(name) && telling_words(&entry.name).concat() != wanted;
        return Ok(Found { exact: !is_short, ..Found::near(entry) });
    }
    let all_in = |text: &str| {
        let words = words(text);
        telling.iter().all(|word| words.contains(word))
    };
    let glossed = |e: &Entry| format!("{} {}", e.name, e.synonyms());
    let having = |test: &dyn Fn(&Entry) -> bool| entries.iter().copied().filter(|e| test(e)).collect::<Vec<_>>();
    let whole_words: [&dyn Fn(&Entry) -> bool; 2] = [&|e| all_in(&e.name), &|e| all_in(&glossed(e))];
    for test in whole_words {
        let candidates = having(test);
        if let Some(found) = plainest(&candidates) {
            return Ok(found);
        }
        if !candidates.is_empty() {
            return Err(ambiguous(name, &candidates));
        }
    }
    // Words with others between them come last.
    let fits = |name: &str, gloss: &str| fit(&telling, name, gloss).filter(|fit| *fit < Fit::Similar);
    let parts: [&dyn Fn(&Entry) -> bool; 2] =
        [&|e| fits(&e.name, "").is_some(), &|e| fits(&e.name, &glossed(e)).is_some()];
    for test in parts {
        let mut candidates = having(test);
        candidates.sort_by_key(|e| fits(&e.name, &glossed(e)));
        match candidates.as_slice() {
            [] => {}
            [only] => return Ok(Found::near(only)),
            several => return Err(ambiguous(name, several)),
        }
    }
    Err(NameError::Unknown { kind, name: name.to_owned(), nearest: nearest(&entries, &wanted) })
}

/// The entry of exactly this name or short name, else the only one whose distinguishing words equal the typed ones.
fn exact<'a>(entries: &[&'a Entry], typed: &str, wanted: &str) -> Option<&'a Entry> {
    let by = |text: fn(&Entry) -> &str| entries.iter().copied().find(|e| folded(text(e)) == typed);
    by(|e| &e.name).or_else(|| by(|e| &e.short)).or_else(|| {
        let mut alike = entries.iter().copied().filter(|e| telling_words(&e.name).concat() == wanted);
        alike.next().filter(|_| alike.next().is_none())
    })
}

/// The candidate whose words outside parentheses all others have too; of several that differ in parentheses alone, the first
/// that was measured and not digitized from a figure.
fn plainest<'a>(candidates: &[&'a Entry]) -> Option<Found<'a>> {
    let models: Vec<Vec<String>> = candidates.iter().map(|e| words(&without_remarks(&e.name))).collect();
    let shortest = models.iter().min_by_key(|words| words.len())?;
    if !models.iter().all(|words| shortest.iter().all(|word| words.contains(word))) {
        return None;
    }
    let tables: Vec<&Entry> =
        candidates.iter().zip(&models).filter(|(_, model)| *model == shortest).map(|(entry, _)| *entry).collect();
    let entry = tables.iter().copied().find(|e| !e.is_digitized()).or_else(|| tables.first().copied())?;
    let others = tables.iter().filter(|e| e.name != entry.name).map(|e| e.name.as_str()).collect();
    Some(Found { others, ..Found::near(entry) })
}

fn without_remarks(name: &str) -> String {
    let mut depth = 0_u32;
    let outside = |c: &char| {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => return depth == 0,
        }
        false
    };
    name.chars().filter(outside).collect()
}

fn ambiguous(name: &str, candidates: &[&Entry]) -> NameError {
    const NAMED: usize = 5;
    let mut named: Vec<String> = candidates.iter().take(NAMED).map(|e| e.name.clone()).collect();
    if candidates.len() > NAMED {
        named.push(format!("or {} others", candidates.len() - NAMED));
    }
    NameError::Ambiguous { name: name.to_owned(), candidates: named }
}

fn nearest(entries: &[&Entry], wanted: &str) -> Vec<String> {
    let alike = |name: &str| strsim::jaro_winkler(&folded(name), wanted);
    let score = |name: &str| alike(name).max(alike(&without_remarks(name)));
    let mut scored: Vec<(f64, &str)> = entries.iter().map(|e| (score(&e.name), e.name.as_str())).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.iter().filter(|s| s.0 > 0.7).take(3).map(|s| s.1.to_owned()).collect()
}
