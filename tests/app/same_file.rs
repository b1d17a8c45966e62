//! A file that is opened again is the set that it was, and names that differ by case are one.

use chromascope::action::{Action, ImportedAction};
use chromascope::catalog::Catalog;
use chromascope::catalog::import::{Origin, imported};
use chromascope::document::imported::{ImportOverrides, ImportedSet, Role};
use chromascope::document::names::caseless;
use chromascope::document::{Compared, Document, Light, MOST_COMPARED, SetKind, session};
use chromascope::plot_item::{PickIndex, PlotItem, SensorId};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope_core::query::Shared;
use chromascope_figure::Tag;
use spectral_file::{ReadOptions, read};

const LEAF: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n";

/// A file as it is read, from a place on disk or from nowhere.
fn set(name: &str, path: Option<&str>, text: &str) -> ImportedSet {
    let table = read(text.as_bytes(), &ReadOptions::default()).unwrap();
    let origin = Origin { path: path.map(Into::into), ..Origin::named(name, text.as_bytes()) };
    imported(&origin, &table, &ImportOverrides::default()).set
}

fn open(document: &mut Document, sets: &[ImportedSet]) {
    crate::import_sets(sets.to_vec()).apply(document);
}

fn names(document: &Document) -> Vec<&str> {
    document.own.iter().map(|set| set.name.as_str()).collect()
}

#[test]
fn the_same_file_is_the_same_set() {
    let mut document = Document::paper();
    open(&mut document, &[set("leaf.csv", Some("/a/leaf.csv"), LEAF)]);
    // The user made something of it.
    let with = ImportedSet { name: "my leaf".to_owned(), role: Role::Illuminant, ..(*document.own[0]).clone() };
    Action::Imported(ImportedAction::Replace {
        name: "leaf".to_owned(),
        with: Box::new(with),
        built_in: crate::built_in_names(),
    })
    .apply(&mut document);
    document.light = Light::BlackBody;
    let before = document.own.clone();
    for again in [Some("/a/leaf.csv"), Some("/b/copy.csv"), None] {
        open(&mut document, &[set("leaf.csv", again, LEAF)]);
        assert_eq!(document.own, before, "{again:?}: nothing that was chosen for it is lost");
        assert_eq!(document.light, Light::BlackBody, "{again:?}: the light stays");
    }
    // Twice at once, too.
    let mut document = Document::paper();
    open(&mut document, &[set("a.csv", Some("/a.csv"), LEAF), set("b.csv", Some("/b.csv"), LEAF)]);
    assert_eq!(names(&document), ["a"]);
}

#[test]
fn a_file_with_other_contents_takes_the_place_of_what_it_was() {
    let mut document = Document::paper();
    open(&mut document, &[set("leaf.csv", Some("/a/leaf.csv"), LEAF)]);
    open(&mut document, &[set("leaf.csv", Some("/a/leaf.csv"), &LEAF.replace("50,0", "60,0"))]);
    assert_eq!((names(&document), document.own[0].curves[0].values[3]), (vec!["leaf"], 0.6));
    // Another file of that name is another set, and so is another part of one file.
    open(&mut document, &[set("leaf.csv", Some("/b/leaf.csv"), &LEAF.replace("50,0", "70,0"))]);
    assert_eq!(names(&document), ["leaf", "leaf (2)"]);
    let mut part = set("leaf.csv", Some("/a/leaf.csv"), LEAF);
    part.overrides.options.part = Some(2);
    open(&mut document, &[part]);
    assert_eq!(names(&document), ["leaf", "leaf (2)", "leaf (3)"]);
}

#[test]
fn names_that_differ_by_case_are_one() {
    for (a, b) in [("leaf", "LEAF"), ("Straße", "STRASSE"), ("ΣΊΣΥΦΟΣ", "σίσυφος"), ("Ünï", "üNÏ")] {
        assert_eq!(caseless(a), caseless(b));
    }
    assert!(caseless("leaf") != caseless("leaf 2") && caseless("a") != caseless("á"));
    let mut document = Document::paper();
    let own = |name: &str, k: u64| {
        let text = LEAF.replace("5,0", &format!("5,{k}"));
        ImportedSet { name: name.to_owned(), ..set("x", None, &text) }
    };
    open(
        &mut document,
        &[own("Straße", 1), own("STRASSE", 2), own("strasse (2)", 3), own("colorchecker 24 (ohta 1997)", 4)],
    );
    assert_eq!(names(&document), ["Straße", "STRASSE (2)", "strasse (2) (2)", "colorchecker 24 (ohta 1997) (own)"]);
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    assert_eq!(scene.entry(SetKind::Chart, "strasse").unwrap().name, "Straße");
    assert_eq!(scene.entry(SetKind::Illuminant, "d65").unwrap().name, "D65");
    assert!(scene.entry(SetKind::Chart, "strass").is_err());
}

#[test]
fn a_session_of_many_sets_of_one_name_opens() {
    let one = ImportedSet { fingerprint: None, ..set("leaf", None, LEAF) };
    let mut document = Document::paper();
    // By a look at all others for each, this would take hours.
    document.own = (0..20_000).map(|_| Shared::new(one.clone())).collect();
    let again = session::from_json(&session::to_json(&document).unwrap()).unwrap();
    assert_eq!(
        (again.own.len(), again.own[0].name.as_str(), again.own[19_999].name.as_str()),
        (20_000, "leaf", "leaf (20000)")
    );
    let free = again.free_name(SetKind::Chart, "LEAF", None, &crate::built_in_names());
    assert_eq!(free, "LEAF (20001)");
}

#[test]
fn more_sensors_than_the_palette_has_places_are_refused_with_a_reason() {
    let mut document = Document::paper();
    let compared = |i: usize| {
        let name = format!("camera {i}");
        Compared { name, kind: SetKind::Camera, slot: 0, visible: true, label: None }
    };
    document.compared = (0..100_000).map(compared).collect();
    let refused = session::from_json(&session::to_json(&document).unwrap()).unwrap_err().to_string();
    assert!(refused.contains("100000 sensors") && refused.contains("256"), "{refused}");
    // No way through the window leads there.
    let mut document = Document::paper();
    (0..1000).for_each(|i| document.compare(&format!("camera {i}"), SetKind::Camera));
    assert_eq!(document.compared.len(), MOST_COMPARED);
    session::from_json(&session::to_json(&document).unwrap()).unwrap();
}

/// By a look at all others for each, twenty thousand things would take minutes in each frame.
#[test]
fn equal_things_share_a_tag_however_many_there_are() {
    let patch = |i: u32| PlotItem::Patch { source: None, patch: format!("patch {i}") };
    let mut things = PickIndex::default();
    let tags: Vec<Tag> = (0..100_000).map(|i| things.tag(patch(i))).collect();
    assert_eq!((tags[0], tags[99_999]), (Tag(1), Tag(100_000)));
    assert_eq!((things.tag(patch(77_777)), things.get(tags[5])), (tags[77_777], Some(&patch(5))));
    let source = SensorId { kind: SetKind::Camera, name: "patch 1".to_owned() };
    let radiator = |kelvin| PlotItem::Radiator { source: source.clone(), kelvin };
    assert_eq!(things.tag(radiator(0.0)), things.tag(radiator(-0.0)));
    assert_ne!(things.tag(radiator(0.0)), things.tag(PlotItem::Sensor(source.clone())));
}
