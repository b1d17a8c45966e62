//! Rust as words and signs: enough to see what a module uses and how long its functions are.

/// A file as words (names and numbers) and single signs, each with its line. Without comments, test modules, and what
/// is inside quotes.
pub(super) struct Code {
    pub(super) tokens: Vec<(String, usize)>,
    /// The words and signs of test modules.
    pub(super) tests: Vec<(String, usize)>,
    /// Lines of test modules.
    pub(super) skipped_lines: usize,
}

pub(super) fn code(text: &str) -> Code {
    let mut tokens = tokens(&blanked(text));
    let (mut tests, mut skipped_lines) = (Vec::new(), 0);
    let test = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut at = 0;
    while at < tokens.len() {
        let is = |at: usize, word: &str| tokens.get(at).is_some_and(|(token, _)| token == word);
        let mut start = at + test.len();
        if !test.iter().enumerate().all(|(offset, word)| is(at + offset, word)) {
            at += 1;
            continue;
        }
        while is(start, "#") {
            start = closing(&tokens, start + 1) + 1;
        }
        if is(start, "mod") && is(start + 2, "{") {
            let end = closing(&tokens, start + 2);
            skipped_lines += tokens[end].1 - tokens[at].1 + 1;
            tests.extend(tokens.drain(at..=end));
        } else {
            at = start;
        }
    }
    Code { tokens, tests, skipped_lines }
}

/// All words and signs of a file, those of test modules with them.
pub(super) fn words(text: &str) -> Vec<(String, usize)> {
    tokens(&blanked(text))
}

/// Comments and everything between quotes as spaces; lines stay where they are.
fn blanked(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut kept = chars.clone();
    let mut at = 0;
    let mut previous = ' ';
    while at < chars.len() {
        let word = previous.is_alphanumeric() || previous == '_';
        let end = match chars[at] {
            '/' if chars.get(at + 1) == Some(&'/') => line_end(&chars, at),
            '/' if chars.get(at + 1) == Some(&'*') => comment_end(&chars, at),
            '"' => string_end(&chars, at),
            'r' | 'b' | 'c' if !word => raw_string_end(&chars, at).unwrap_or(at),
            '\'' => char_end(&chars, at).unwrap_or(at),
            _ => at,
        };
        if end == at {
            previous = chars[at];
            at += 1;
            continue;
        }
        let end = end.min(chars.len());
        for sign in &mut kept[at..end] {
            if *sign != '\n' {
                *sign = ' ';
            }
        }
        previous = ' ';
        at = end;
    }
    kept.into_iter().collect()
}

fn line_end(chars: &[char], start: usize) -> usize {
    chars[start..].iter().position(|c| *c == '\n').map_or(chars.len(), |length| start + length)
}

fn comment_end(chars: &[char], start: usize) -> usize {
    let mut depth = 0;
    let mut at = start;
    while at < chars.len() {
        match (chars[at], chars.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 2),
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    at
}

fn string_end(chars: &[char], start: usize) -> usize {
    let mut at = start + 1;
    while at < chars.len() && chars[at] != '"' {
        at += if chars[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

/// The end of `r"…"`, `r#"…"#` and their kind, or nothing if the letter begins something else.
fn raw_string_end(chars: &[char], start: usize) -> Option<usize> {
    let mut at = start;
    if chars[at] != 'r' {
        at += 1;
    }
    if chars.get(at) != Some(&'r') {
        return None;
    }
    let hashes = chars[at + 1..].iter().take_while(|c| **c == '#').count();
    let open = at + 1 + hashes;
    if chars.get(open) != Some(&'"') {
        return None;
    }
    let close: Vec<char> = ['"'].into_iter().chain(std::iter::repeat_n('#', hashes)).collect();
    let length = chars[open + 1..].windows(close.len()).position(|window| window == close);
    Some(length.map_or(chars.len(), |length| open + 1 + length + close.len()))
}

/// The end of `'x'` or `'\n'`, or nothing for a lifetime.
fn char_end(chars: &[char], start: usize) -> Option<usize> {
    if chars.get(start + 1) == Some(&'\\') {
        let close = chars[start + 3..].iter().position(|c| *c == '\'')?;
        return Some(start + 3 + close + 1);
    }
    (chars.get(start + 2) == Some(&'\'')).then_some(start + 3)
}

fn tokens(text: &str) -> Vec<(String, usize)> {
    let mut tokens = Vec::new();
    for (line, text) in text.lines().enumerate() {
        let mut word = String::new();
        for sign in text.chars().chain([' ']) {
            if sign.is_alphanumeric() || sign == '_' {
                word.push(sign);
                continue;
            }
            if !word.is_empty() {
                tokens.push((std::mem::take(&mut word), line + 1));
            }
            if !sign.is_whitespace() {
                tokens.push((sign.to_string(), line + 1));
            }
        }
    }
    tokens
}

/// Index of the bracket that closes the one at `open`.
fn closing(tokens: &[(String, usize)], open: usize) -> usize {
    let mut depth = 0;
    for (at, (token, _)) in tokens.iter().enumerate().skip(open) {
        match token.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    tokens.len() - 1
}

/// A path as written out from the root of a crate, `a::b::c`.
pub(super) struct UsedPath {
    pub(super) names: Vec<String>,
    pub(super) line: usize,
    /// True within a `use`.
    pub(super) import: bool,
}

impl UsedPath {
    pub(super) fn starts_with(&self, path: &str) -> bool {
        let mut names = self.names.iter();
        path.split("::").all(|name| names.next().is_some_and(|own| own == name))
    }
}

/// Every path in the code, whether imported or written where it is used; groups taken apart, `self` and `super`
/// resolved against the module.
pub(super) fn paths(module: &[String], code: &Code) -> Vec<UsedPath> {
    let mut found = Vec::new();
    let mut inline: Vec<(String, usize)> = Vec::new();
    let tokens = &code.tokens;
    let mut at = 0;
    while at < tokens.len() {
        inline.retain(|(_, end)| *end > at);
        let word = tokens[at].0.as_str();
        if word == "mod" && tokens.get(at + 2).is_some_and(|(token, _)| token == "{") {
            inline.push((tokens[at + 1].0.clone(), closing(tokens, at + 2)));
            at += 3;
            continue;
        }
        let import = word == "use" && tokens.get(at + 1).is_some_and(|(token, _)| token != "<");
        let start = if import { at + 1 } else { at };
        // `pub(in crate::a)` says who may use something, and uses nothing.
        if word == "in" && at > 1 && tokens[at - 1].0 == "(" && tokens[at - 2].0 == "pub" {
            at = closing(tokens, at - 1);
            continue;
        }
        if import || (is_word(word) && joined(tokens, at + 1)) {
            let inline: Vec<String> = inline.iter().map(|(name, _)| name.clone()).collect();
            let here = [module, &inline].concat();
            let mut written = Vec::new();
            at = tree(tokens, start, &[], import, &mut written).max(at + 1);
            found.extend(written.into_iter().filter_map(|path| resolved(&here, path)));
        } else {
            at += 1;
        }
    }
    found
}

fn is_word(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

fn joined(tokens: &[(String, usize)], at: usize) -> bool {
    tokens.len() > at + 2 && tokens[at].0 == ":" && tokens[at + 1].0 == ":"
}

/// Reads a path, or in an import a tree of them, and returns where it ends.
fn tree(
    tokens: &[(String, usize)],
    mut at: usize,
    before: &[String],
    import: bool,
    found: &mut Vec<UsedPath>,
) -> usize {
    let mut names = before.to_vec();
    let line = tokens[at].1;
    if joined(tokens, at) {
        at += 2;
    }
    while at < tokens.len() {
        match tokens[at].0.as_str() {
            "{" if import => {
                let end = closing(tokens, at);
                at += 1;
                while at < end {
                    at = if tokens[at].0 == "," { at + 1 } else { tree(tokens, at, &names, import, found).max(at + 1) };
                }
                return end + 1;
            }
            "*" if import => names.push("*".to_owned()),
            word if is_word(word) => names.push(word.to_owned()),
            _ => break,
        }
        at += 1;
        if !joined(tokens, at) {
            break;
        }
        at += 2;
    }
    if tokens.get(at).is_some_and(|(token, _)| import && token == "as") {
        at += 2;
    }
    found.push(UsedPath { names, line, import });
    at
}

/// With `self` and `super` replaced by what they stand for, below `crate`.
fn resolved(here: &[String], path: UsedPath) -> Option<UsedPath> {
    let relative = ["self", "super"].contains(&path.names.first()?.as_str());
    if !relative {
        return Some(path);
    }
    let mut names = here.to_vec();
    names.insert(0, "crate".to_owned());
    for name in &path.names {
        match name.as_str() {
            "self" => {}
            "super" => {
                names.pop();
            }
            _ => names.push(name.clone()),
        }
    }
    Some(UsedPath { names, ..path })
}

/// Name, first line and number of lines of every function with a body.
pub(super) fn functions(code: &Code) -> Vec<(String, usize, usize)> {
    let mut found = Vec::new();
    for (at, pair) in code.tokens.windows(2).enumerate() {
        if pair[0].0 != "fn" || !is_word(&pair[1].0) {
            continue;
        }
        let mut open = at;
        while open < code.tokens.len() {
            match code.tokens[open].0.as_str() {
                "(" | "[" => open = closing(&code.tokens, open),
                "{" | ";" => break,
                _ => {}
            }
            open += 1;
        }
        if code.tokens.get(open).is_some_and(|(token, _)| token == "{") {
            let end = closing(&code.tokens, open);
            found.push((pair[1].0.clone(), pair[0].1, code.tokens[end].1 - pair[0].1 + 1));
        }
    }
    found
}
