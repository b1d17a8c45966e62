//! Names of cameras, shortened by what distinguishes them.

/// Words that tell a series or an edition, not a model.
const SERIES: [&str; 3] = ["EOS", "Mark", "Digital"];

/// The short form of each name: the shortest that no other of them has, without what stands in brackets, without its maker,
/// without words that name a series.
pub fn shortest<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let all: Vec<&str> = names.collect();
    let forms =
        [(true, false, false), (false, true, false), (true, true, false), (false, true, true), (true, true, true)];
    let short = |name: &&str| {
        let forms = forms.map(|form| (form, formed(name, form)));
        let alone = forms.into_iter().filter(|(form, short)| {
            !short.is_empty() && all.iter().filter(|other| formed(other, *form) == *short).count() <= 1
        });
        alone.map(|(_, short)| short).min_by_key(|short| short.chars().count()).unwrap_or_else(|| (*name).to_owned())
    };
    all.iter().map(short).collect()
}

fn formed(name: &str, (brackets, maker, series): (bool, bool, bool)) -> String {
    let model = if brackets { name.split_once(" (").map_or(name, |(model, _)| model) } else { name };
    // What follows a lone model in brackets is no name.
    let rest = model.split_once(' ').map(|(_, rest)| rest).filter(|rest| maker && !rest.starts_with('('));
    let model = rest.unwrap_or(model);
    let words = model.split(' ').filter(|word| !series || !SERIES.contains(word));
    words.collect::<Vec<_>>().join(" ")
}
