//! Names of cameras, shortened by what distinguishes them.

use crate::format::cut_in_middle;

/// Words that tell a series or an edition, not a model.
const SERIES: [&str; 3] = ["EOS", "Mark", "Digital"];

/// Shorter forms of a name, the longest first, each only where no other name has it: without what stands in brackets, without its
/// maker, without words that name a series.
pub fn shortened(name: &str, all: &[String]) -> Vec<String> {
    let forms =
        [(true, false, false), (false, true, false), (true, true, false), (false, true, true), (true, true, true)];
    let is_alone = |form, short: &str| all.iter().filter(|other| formed(other, form) == short).count() <= 1;
    let shorts = forms.into_iter().map(|form| (form, formed(name, form)));
    let mut shorts: Vec<String> =
        shorts.filter(|(form, short)| !short.is_empty() && is_alone(*form, short)).map(|(_, short)| short).collect();
    shorts.sort_by_key(|short| std::cmp::Reverse(short.chars().count()));
    shorts.dedup();
    shorts
}

/// Each name as short as it is told from the others.
pub fn shortest<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let all: Vec<String> = names.map(str::to_owned).collect();
    all.iter().map(|name| shortened(name, &all).pop().unwrap_or_else(|| name.clone())).collect()
}

/// The longest form of a name that fits, else the shortest with its middle cut.
pub fn fitted(name: &str, all: &[String], fits: impl Fn(&str) -> bool) -> String {
    let forms: Vec<String> = std::iter::once(name.to_owned()).chain(shortened(name, all)).collect();
    let form = forms.iter().find(|form| fits(form)).unwrap_or(&forms[forms.len() - 1]);
    cut_in_middle(form, fits).into_owned()
}

fn formed(name: &str, (brackets, maker, series): (bool, bool, bool)) -> String {
    let model = if brackets { name.split_once(" (").map_or(name, |(model, _)| model) } else { name };
    // What follows a lone model in brackets is no name.
    let rest = model.split_once(' ').map(|(_, rest)| rest).filter(|rest| maker && !rest.starts_with('('));
    let model = rest.unwrap_or(model);
    let words = model.split(' ').filter(|word| !series || !SERIES.contains(word));
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_what_distinguishes_them() {
        let all = [
            "Canon EOS 5D Mark III",
            "Canon EOS 5D Mark IV",
            "Nikon D70 (2007 figure)",
            "Nikon D70 (UPenn 2011)",
            "Nikon D700",
        ];
        let all = all.map(str::to_owned);
        let shortest = |name: &String| shortened(name, &all).pop();
        assert_eq!(shortened("D70 (2007)", &["D70 (2007)".to_owned()]), ["D70 (2007)", "D70"]);
        let expected = ["5D III", "5D IV", "D70 (2007 figure)", "D70 (UPenn 2011)", "D700"];
        assert_eq!(all.each_ref().map(shortest), expected.map(|short| Some(short.to_owned())));
        assert_eq!(fitted(&all[0], &all, |form| form.len() < 14), "5D III");
        assert_eq!(fitted(&all[0], &all, |form| form.chars().count() <= 5), "5D…I");
        let own = ["TEST (measured)", "TEST (measured 2)"].map(str::to_owned);
        assert_eq!(fitted(&own[0], &own[..1], |form| form.len() < 12), "TEST");
        assert_eq!(fitted(&own[1], &own, |form| form.chars().count() <= 11), "TEST (me…2)");
    }
}
