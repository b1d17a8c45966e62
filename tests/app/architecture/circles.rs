//! Circles of modules: files that use one another, found as strongly connected components of the graph of `use` lines and
//! of paths from `crate`, `self` and `super`.

use std::collections::{BTreeMap, BTreeSet};

use super::rust_text::{code, paths};
use super::{Violation, hold, module, sources};

/// No circle has more files.
const LARGEST: usize = 2;

const CRATES: &[&str] = &[
    "src",
    "core/color/src",
    "core/data/src",
    "core/figure/src",
    "core/math/src",
    "core/measure/src",
    "core/mesh/src",
    "core/profile/src",
    "core/query/src",
    "core/raw-image/src",
    "core/render/src",
    "core/spectral-file/src",
    "core/spectral-image/src",
    "core/text/src",
];

#[test]
fn no_circle_of_files_is_larger_than_two() {
    for krate in CRATES {
        let circles = circles(&graph(&sources(krate)));
        let large = circles.into_iter().filter(|circle| circle.len() > LARGEST);
        hold(large.map(|circle| {
            let names: Vec<String> = circle.into_iter().collect();
            Violation { file: (*krate).to_owned(), line: 0, rule: format!("a circle of {}", names.join(", ")) }
        }));
    }
}

#[test]
fn a_planted_circle_is_found() {
    let planted = |files: &[(&str, &str)]| {
        let files: Vec<(String, String)> =
            files.iter().map(|(path, text)| (format!("src/{path}.rs"), (*text).to_owned())).collect();
        let found = circles(&graph(&files));
        found.into_iter().map(|circle| circle.into_iter().collect::<Vec<_>>().join(" ")).collect::<Vec<_>>()
    };
    let through_use = [("a", "use crate::b::B;"), ("b", "use super::c::{C, D as E};"), ("c", "pub use crate::a::A;")];
    assert_eq!(planted(&through_use), ["a b c"]);
    let through_a_path = [("a", "fn f() -> super::b::B { g() }"), ("b", "mod inner { use super::super::a::A; }")];
    assert_eq!(planted(&through_a_path), ["a b"]);
    let through_a_parent =
        [("a", "mod b; mod c; use b::B; pub struct A;"), ("a/b", "use super::c::C;"), ("a/c", "use super::A;")];
    assert_eq!(planted(&through_a_parent), ["a a::b a::c"]);
    let none = [
        ("a", "//! crate::b\nuse crate::b::B; // use crate::c::C\n#[cfg(test)]\nmod tests { use crate::c::C; }"),
        ("b", "mod inner { use super::B; }\npub(in crate::a) struct B;"),
        ("c", "use crate::a::A; use other::b::B;"),
    ];
    assert_eq!(planted(&none), [""; 0]);
}

type Graph = BTreeMap<String, BTreeSet<String>>;

/// The files that each file uses, by module.
fn graph(files: &[(String, String)]) -> Graph {
    let modules: BTreeSet<Vec<String>> = files.iter().map(|(path, _)| module(path)).collect();
    let mut graph = Graph::new();
    for (path, text) in files {
        let own = module(path);
        let used = graph.entry(own.join("::")).or_default();
        for path in paths(&own, &code(text)) {
            let names = match path.names.split_first() {
                Some((first, rest)) if first == "crate" => rest.to_vec(),
                // An import from a module below.
                Some((first, _))
                    if path.import && modules.contains(&[&own[..], std::slice::from_ref(first)].concat()) =>
                {
                    [&own[..], &path.names].concat()
                }
                _ => continue,
            };
            let target = (0..=names.len()).rev().map(|length| &names[..length]).find(|names| modules.contains(*names));
            used.extend(target.filter(|target| **target != own[..]).map(|target| target.join("::")));
        }
    }
    graph
}

/// The sets of files each of which is reached from each other.
fn circles(graph: &Graph) -> Vec<BTreeSet<String>> {
    let reached: BTreeMap<&str, BTreeSet<&str>> =
        graph.keys().map(|from| (from.as_str(), reachable(graph, from))).collect();
    let mut found: Vec<BTreeSet<String>> = Vec::new();
    for (from, targets) in &reached {
        let circle = targets.iter().filter(|target| reached.get(*target).is_some_and(|back| back.contains(from)));
        let circle: BTreeSet<String> = circle.map(|name| (*name).to_owned()).collect();
        if circle.len() > 1 && !found.contains(&circle) {
            found.push(circle);
        }
    }
    found
}

fn reachable<'a>(graph: &'a Graph, from: &'a str) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(at) = open.pop() {
        for next in graph.get(at).into_iter().flatten() {
            if reached.insert(next.as_str()) {
                open.push(next);
            }
        }
    }
    reached
}
