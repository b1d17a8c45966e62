//! Tests of the effect of actions on the document, and of undo.

use chromascope::action::history::History;
use chromascope::action::{Action, CompareAction, ImportedAction, SceneAction};
use chromascope::catalog::Catalog;
use chromascope::document::imported::{ImportOverrides, ImportedCurve, ImportedSet, ReadAs, Role, WavelengthUnit};
use chromascope::document::names::BuiltInNames;
use chromascope::document::names::PLACES;
use chromascope::document::{CHART, Document, Light, PAPER_REFERENCE, SetKind, Subset, WhiteBalanceChoice, session};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope_core::query::Shared;
use chromascope_figure::{InkRole, Marker};

/// The document after an action on the first screen, checked.
fn check(action: &Action, expect: impl Fn(&Document)) {
    let mut document = Document::paper();
    action.apply(&mut document);
    expect(&document);
}

fn own(name: &str, role: Role) -> ImportedSet {
    let curve = |name: &str| ImportedCurve {
        name: name.to_owned(),
        wavelengths: vec![400.0, 550.0, 700.0],
        values: vec![0.2, 0.9, 0.4],
        unit: None,
        uncertainty: None,
        unknown: serde_json::Map::new(),
    };
    ImportedSet {
        name: name.to_owned(),
        file: "file.csv".to_owned(),
        path: None,
        fingerprint: None,
        overrides: ImportOverrides::default(),
        role,
        read_as: ReadAs { unit: WavelengthUnit::Nanometer, percent: false },
        unit: WavelengthUnit::Nanometer,
        percent: false,
        per_photon: false,
        channels: [0, 1, 2],
        curves: ["r", "g", "b"].map(curve).into(),
        measured: None,
        model: None,
        covariance: None,
        decisions: Vec::new(),
    }
}

fn import(names: &[&str], role: Role) -> Action {
    crate::import_sets(names.iter().map(|name| own(name, role)).collect())
}

#[test]
fn importing_depends_on_the_document_and_the_action_alone() {
    let names_of = |built_in: BuiltInNames| {
        let mut document = Document::paper();
        let sets = vec![own("Kodak DCS200", Role::Camera), own("my camera", Role::Camera)];
        Action::Imported(ImportedAction::Import { sets, built_in }).apply(&mut document);
        document.own.iter().map(|set| set.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names_of(BuiltInNames::default()), ["Kodak DCS200", "my camera"], "no catalog is asked");
    let other = BuiltInNames::new([(SetKind::Camera, "MY CAMERA"), (SetKind::Chart, "Kodak DCS200")].into_iter());
    assert_eq!(names_of(other), ["Kodak DCS200", "my camera (own)"]);
    assert_eq!(names_of(crate::built_in_names()), ["Kodak DCS200 (own)", "my camera"]);
}

#[test]
fn the_truth_stays_and_others_go() {
    let remove = |kind, name: &str| Action::Compare(CompareAction::Remove(kind, name.to_owned()));
    check(&remove(SetKind::Observer, PAPER_REFERENCE), |document| assert_eq!(document.compared.len(), 5));
    check(&remove(SetKind::Camera, "Nikon D70 (2007 figure)"), |document| assert_eq!(document.compared.len(), 4));
    let reference = CompareAction::SetReference { name: "CIE 1964 10°".to_owned(), counts_in_xyz: true };
    check(&Action::Compare(reference), |document| {
        assert_eq!(document.reference, "CIE 1964 10°");
        assert!(document.compared(SetKind::Observer, "CIE 1964 10°").is_some());
    });
}

#[test]
fn temperatures_stay_where_the_light_is_defined() {
    let set = |kelvin| Action::Scene(SceneAction::SetTemperature(kelvin));
    check(&set(10.0), |document| assert_eq!(document.temperature_k, 1000.0));
    check(&set(1e9), |document| assert_eq!(document.temperature_k, 20_000.0));
    check(&set(f64::NAN), |document| assert_eq!(document.temperature_k, 5500.0));
    let mut document = Document { temperature_k: 2000.0, ..Document::paper() };
    Action::Scene(SceneAction::SetLight(Light::Daylight)).apply(&mut document);
    assert_eq!(document.temperature_k, 4000.0);
}

#[test]
fn a_slot_is_kept_and_the_ninth_takes_color_1_with_marker_5() {
    let mut document = Document::paper();
    let names: Vec<String> = Catalog::built_in().of_kind(SetKind::Camera).map(|entry| entry.name.clone()).collect();
    Action::Compare(CompareAction::Remove(SetKind::Camera, "Canon EOS 10D (2007 figure)".to_owned()))
        .apply(&mut document);
    assert_eq!(document.compared(SetKind::Camera, "Nikon D70 (2007 figure)").map(|c| c.slot), Some(1));
    for name in names.iter().take(9) {
        Action::Compare(CompareAction::Add(SetKind::Camera, name.clone())).apply(&mut document);
    }
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let ninth = document.compared.iter().find(|c| c.kind == SetKind::Camera && c.slot == 8).unwrap();
    let source = scene.sources().into_iter().find(|source| source.name == ninth.name).unwrap();
    assert_eq!((source.role, source.marker), (InkRole::Sensor(0), Marker::TriangleDown));
}

/// Puts a set of the library to use.
fn put_to_use(kind: SetKind, name: &str, document: &mut Document) {
    Action::Imported(ImportedAction::Use(kind, name.to_owned())).apply(document);
}

#[test]
fn a_camera_is_compared_when_opened_and_all_else_is_used_at_a_word() {
    check(&import(&["mine"], Role::Camera), |document| assert!(document.compared(SetKind::Camera, "mine").is_some()));
    for role in [Role::Illuminant, Role::Reflectance, Role::Transmittance] {
        check(&import(&["mine"], role), |document| {
            assert_eq!(Document { own: Vec::new(), ..document.clone() }, Document::paper());
            let mut used = document.clone();
            put_to_use(SetKind::of_own(&document.own[0]), "mine", &mut used);
            match role {
                Role::Illuminant => assert_eq!(used.light, Light::Set("mine".to_owned())),
                Role::Reflectance => assert_eq!((used.chart.as_str(), used.subset), ("mine", Subset::All)),
                _ => assert_eq!(used.filters, ["mine"]),
            }
        });
    }
}

#[test]
fn of_several_only_cameras_are_put_on_show_while_there_are_places() {
    for role in [Role::Reflectance, Role::Illuminant, Role::Unknown] {
        check(&import(&["mine", "mine"], role), |document| {
            let names: Vec<&str> = document.own.iter().map(|set| set.name.as_str()).collect();
            assert_eq!(names, ["mine", "mine (2)"]);
            assert_eq!(Document { own: Vec::new(), ..document.clone() }, Document::paper());
        });
    }
    let many: Vec<String> = (0..12).map(|i| format!("camera {i}")).collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    check(&import(&many, Role::Camera), |document| {
        let shown = document.compared.iter().filter(|compared| compared.kind == SetKind::Camera);
        assert_eq!((shown.count(), document.own.len()), (PLACES, 12));
    });
}

#[test]
fn an_own_set_has_a_name_of_its_own_among_all_of_its_kind() {
    let mut document = Document::paper();
    for _ in 0..3 {
        import(&["Nikon D70 (2007 figure)"], Role::Camera).apply(&mut document);
    }
    // A chart may be called as a camera is, not as a material is: patches are chosen from both.
    let material = Catalog::built_in().of_kind(SetKind::Material).next().unwrap().name.clone();
    import(&["Sony ILCE-7M3", &material], Role::Reflectance).apply(&mut document);
    let names: Vec<&str> = document.own.iter().map(|set| set.name.as_str()).collect();
    let marked = format!("{material} (own)");
    assert_eq!(
        names,
        [
            "Nikon D70 (2007 figure) (own)",
            "Nikon D70 (2007 figure) (2)",
            "Nikon D70 (2007 figure) (3)",
            "Sony ILCE-7M3",
            &marked
        ]
    );
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    assert!(!scene.entry(SetKind::Camera, "Nikon D70 (2007 figure)").unwrap().is_own());
    assert!(scene.entry(SetKind::Camera, "Nikon D70 (2007 figure) (own)").unwrap().is_own());
    // A role that makes a name a double gives it up too.
    let with = Box::new(ImportedSet { role: Role::Camera, ..(*document.own[3]).clone() });
    Action::Imported(ImportedAction::Replace {
        name: "Sony ILCE-7M3".to_owned(),
        with,
        built_in: crate::built_in_names(),
    })
    .apply(&mut document);
    assert_eq!(document.own[3].name, "Sony ILCE-7M3 (own)");
    assert!(document.compared(SetKind::Camera, "Sony ILCE-7M3 (own)").is_some());
}

#[test]
fn what_has_one_name_is_used_by_its_kind() {
    let mut document = Document::paper();
    import(&["E"], Role::Camera).apply(&mut document);
    let with = Box::new(own("F", Role::Camera));
    Action::Imported(ImportedAction::Replace { name: "E".to_owned(), with, built_in: crate::built_in_names() })
        .apply(&mut document);
    assert_eq!(document.light, Light::Set("E".to_owned()), "the light is another set");
    assert!(document.compared(SetKind::Camera, "F").is_some());
}

#[test]
fn own_sets_of_an_older_session_are_told_from_the_built_in_ones() {
    let mut document = Document::paper();
    document.own.push(Shared::new(own("Nikon D70 (2007 figure)", Role::Camera)));
    let mut again = session::from_json(&session::to_json(&document).unwrap()).unwrap();
    again.part_names(&crate::built_in_names());
    assert_eq!(again.own[0].name, "Nikon D70 (2007 figure) (own)");
    assert!(
        again.compared(SetKind::Camera, "Nikon D70 (2007 figure) (own)").is_some(),
        "what stood in its place stays on show"
    );
    assert_eq!(session::from_json(&session::to_json(&again).unwrap()).unwrap(), again);
}

#[test]
fn what_is_removed_is_no_longer_used() {
    let mut document = Document::paper();
    import(&["leaf"], Role::Reflectance).apply(&mut document);
    import(&["lamp"], Role::Illuminant).apply(&mut document);
    put_to_use(SetKind::Chart, "leaf", &mut document);
    put_to_use(SetKind::Illuminant, "lamp", &mut document);
    document.white = WhiteBalanceChoice::Light("lamp".to_owned());
    for name in ["leaf", "lamp"] {
        Action::Imported(ImportedAction::Remove(name.to_owned())).apply(&mut document);
    }
    assert_eq!(document, Document::paper());
}

#[test]
fn another_role_moves_a_set() {
    let mut document = Document::paper();
    import(&["x"], Role::Reflectance).apply(&mut document);
    put_to_use(SetKind::Chart, "x", &mut document);
    let with = Box::new(own("x", Role::Camera));
    Action::Imported(ImportedAction::Replace { name: "x".to_owned(), with, built_in: crate::built_in_names() })
        .apply(&mut document);
    assert_eq!(document.chart, CHART);
    assert!(document.compared(SetKind::Camera, "x").is_some());
}

#[test]
fn units_can_be_flipped_and_flipped_back() {
    let mut set = own("leaf", Role::Reflectance);
    let before = set.curves_in_nm().unwrap();
    set.percent = true;
    assert_eq!(set.curves_in_nm().unwrap()[0].1.values(), [0.2 / 100.0, 0.9 / 100.0, 0.4 / 100.0]);
    set.unit = WavelengthUnit::Micrometer;
    assert_eq!(set.curves_in_nm().unwrap()[0].1.range_nm(), [400_000.0, 700_000.0]);
    (set.percent, set.unit) = (false, WavelengthUnit::Nanometer);
    assert_eq!(set.curves_in_nm().unwrap(), before, "to the bit");
}

#[test]
fn reset_keeps_what_the_user_brought() {
    let mut document = Document::paper();
    import(&["mine"], Role::Camera).apply(&mut document);
    Action::Reset.apply(&mut document);
    assert_eq!((document.own.len(), document.compared.len()), (1, 5));
}

#[test]
fn a_drag_is_one_step() {
    let mut history = History::new(Document::paper());
    for kelvin in [5000.0, 4000.0, 3000.0] {
        history.apply(&Action::Scene(SceneAction::SetTemperature(kelvin)));
    }
    history.end_gesture();
    history.apply(&Action::Scene(SceneAction::SetTemperature(2500.0)));
    history.undo();
    assert_eq!(history.document().temperature_k, 3000.0);
    history.undo();
    assert_eq!((history.document().temperature_k, history.undo_name()), (5500.0, None));
    history.redo();
    assert_eq!(history.document().temperature_k, 3000.0);
    history.apply(&Action::Scene(SceneAction::SetSubset(Subset::All)));
    assert_eq!(history.redo_name(), None, "another way was taken");
}

#[test]
fn nothing_changed_is_no_step() {
    let mut history = History::new(Document::paper());
    history.apply(&Action::Scene(SceneAction::SetSubset(Subset::Five)));
    assert_eq!(history.undo_name(), None);
}

#[test]
fn a_session_keeps_all_even_what_it_does_not_know() {
    let mut document = Document::paper();
    import(&["mine"], Role::Camera).apply(&mut document);
    document.unknown.insert("hologram".to_owned(), serde_json::json!({ "mesh": "head" }));
    let json = session::to_json(&document).unwrap();
    assert_eq!(session::from_json(&json).unwrap(), document);
    assert!(session::from_json("{}").unwrap() == Document::default(), "missing fields have defaults");
}

#[test]
fn other_sessions_are_refused() {
    let refused = |json: &str| session::from_json(json).unwrap_err().to_string();
    assert!(refused(r#"{"format":"other"}"#).contains("not a Chromascope session"));
    assert!(refused(r#"{"version":99}"#).contains("newer version of Chromascope"));
    assert!(refused("{\n  oops").contains("line 2"));
    let spoiled = session::from_json(r#"{"temperature_k": 1e300, "truth": "CIE 1964 10°"}"#).unwrap();
    assert_eq!(spoiled.temperature_k, 20_000.0);
    assert!(spoiled.compared(SetKind::Observer, "CIE 1964 10°").is_some());
}

#[test]
fn a_set_that_is_renamed_keeps_its_uses_and_gets_no_others() {
    let mut document = Document::paper();
    import(&["leaf"], Role::Reflectance).apply(&mut document);
    import(&["bark"], Role::Reflectance).apply(&mut document);
    put_to_use(SetKind::Chart, "bark", &mut document);
    let rename = |from: &str, to: &str, document: &mut Document| {
        let set = document.own.iter().find(|set| set.name == from).unwrap();
        let with = Box::new(ImportedSet { name: to.to_owned(), ..(**set).clone() });
        Action::Imported(ImportedAction::Replace { name: from.to_owned(), with, built_in: crate::built_in_names() })
            .apply(document);
    };
    rename("leaf", "oak", &mut document);
    assert_eq!(document.chart, "bark");
    rename("bark", "stem", &mut document);
    assert_eq!(document.chart, "stem");
}

#[test]
fn an_imported_set_of_another_kind_does_not_keep_a_camera_from_its_present_name() {
    let mut document = Document::paper();
    document.own.push(Shared::new(own("Nikon D70", Role::Reflectance)));
    let mut json: serde_json::Value = serde_json::from_str(&session::to_json(&document).unwrap()).unwrap();
    json["version"] = 1.into();
    json["compared"] = serde_json::json!([{"name": "Nikon D70", "kind": "camera", "slot": 0}]);
    let document = session::from_json(&json.to_string()).unwrap();
    assert!(document.compared(SetKind::Camera, "Nikon D70 (2007 figure)").is_some(), "{:?}", document.compared);
}

/// Puts a name in the place of each name of a set in JSON, by kinds of sets that share names. Returns how many there were.
fn replace_names(value: &mut serde_json::Value, of: &dyn Fn(&str) -> bool, with: &str) -> usize {
    match value {
        serde_json::Value::String(text) if of(text) => {
            with.clone_into(text);
            1
        }
        serde_json::Value::Array(items) => items.iter_mut().map(|item| replace_names(item, of, with)).sum(),
        serde_json::Value::Object(fields) => fields.values_mut().map(|field| replace_names(field, of, with)).sum(),
        _ => 0,
    }
}

/// A document in which each reference to a set is there, in JSON.
fn document_with_all_references() -> serde_json::Value {
    let mut document = Document::colorimetry();
    document.white = WhiteBalanceChoice::Light("D55".to_owned());
    document.correction.second_light = Some("A".to_owned());
    document.render.garment.get_or_insert_with(|| "Cotton".to_owned());
    let filter = Catalog::built_in().of_kind(SetKind::Filter).next().map(|entry| entry.name.clone());
    document.filters = filter.into_iter().collect();
    serde_json::to_value(document).unwrap()
}

#[test]
fn no_reference_to_a_set_is_forgotten_when_it_is_renamed_or_removed() {
    let catalog = Catalog::built_in();
    for (role, kinds, least) in [
        (Role::Camera, &[SetKind::Camera][..], 3),
        (Role::Illuminant, &[SetKind::Illuminant][..], 3),
        (Role::Transmittance, &[SetKind::Filter][..], 1),
        (Role::Reflectance, &[SetKind::Chart, SetKind::Material][..], 4),
    ] {
        // Every name of a set in the JSON is the own set's: of a field that is added and names sets, too.
        let mut value = document_with_all_references();
        let names: Vec<&str> =
            kinds.iter().flat_map(|kind| catalog.of_kind(*kind)).map(|entry| entry.name.as_str()).collect();
        let found = replace_names(&mut value, &|text| names.contains(&text), "before");
        assert!(found >= least, "{role}: {found} references");
        let mut document: Document = serde_json::from_value(value).unwrap();
        document.own = vec![Shared::new(own("before", role))];
        let json = |document: &Document| serde_json::to_string(document).unwrap();
        let mut renamed = document.clone();
        let (name, with) = ("before".to_owned(), Box::new(own("after", role)));
        let built_in = BuiltInNames::default();
        Action::Imported(ImportedAction::Replace { name: name.clone(), with, built_in }).apply(&mut renamed);
        assert!(!json(&renamed).contains("\"before\""), "{role}: {}", json(&renamed));
        assert_eq!(json(&renamed).matches("\"after\"").count(), found + 1, "each use and the set itself");
        let mut removed = document;
        Action::Imported(ImportedAction::Remove(name)).apply(&mut removed);
        assert!(!json(&removed).contains("\"before\""), "{role}: {}", json(&removed));
    }
}
