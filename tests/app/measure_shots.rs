//! Shots of a measurement as new users bring them: of two models, without a chart, damaged, under two lights.

use std::path::{Path, PathBuf};

use chromascope::catalog::Catalog;
use chromascope::command::Command;
use chromascope::document::session::{from_json, to_json};
use chromascope::document::{Light, SetKind};
use chromascope::export::profile::unique_camera_model;
use chromascope::panes::widgets::pick_list::{Line, found};
use chromascope::view::Status;
use egui_kittest::kittest::Queryable as _;

use crate::cli::recover::{dng, recording};
use crate::measure::{Window, cameras, name_light, picture, until, window};

const ADD: &str = "Add to the library and compare";
const UPDATE: &str = "Update in the library";

/// Photograph of the chart under a light as a DNG that states a model, and no maker.
fn photograph(name: &str, light: &str, model: Option<&str>) -> PathBuf {
    let (rows, path) = (recording(&format!("illuminants/{light}.csv")), folder().join(name));
    let pixel = |at: u32| {
        let (x, y) = (at % 600, at / 600);
        if !(60..540).contains(&x) || !(40..360).contains(&y) {
            return [9000, 12000, 8000];
        }
        let ((column, u), (row, v)) = (((x - 60) / 80, (x - 60) % 80), ((y - 40) / 80, (y - 40) % 80));
        let noise = 1.0 + 0.01 * (f64::from(at % 13) / 6.0 - 1.0);
        let patch = rows[(row * 6 + column) as usize].1.map(|value| (value * noise) as u16);
        if [u, v].iter().all(|at| (6..74).contains(at)) { patch } else { [900, 1100, 800] }
    };
    let samples = (0..600 * 400).flat_map(pixel).flat_map(u16::to_le_bytes).collect();
    let tags: Vec<_> = model.map(|model| dng::text(50708, model)).into_iter().collect();
    std::fs::write(&path, dng::Dng::linear(600, 400, 16, samples).with(&tags).bytes()).unwrap();
    path
}

fn folder() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

fn open(window: &mut Window, path: PathBuf, words: &str) {
    window.state_mut().push(Command::OpenPath(path));
    until(window, words);
}

fn has(window: &Window, words: &str) -> bool {
    window.query_all_by_label_contains(words).next().is_some()
}

/// Once the page around it has its place: what it says of an empty page comes a frame after a picture that failed.
fn click(window: &mut Window, words: &str) {
    window.run_steps(2);
    window.get_by_label(words).click();
    window.run_steps(3);
}

fn light(name: &str) -> Light {
    Light::Set(name.to_owned())
}

#[test]
fn shots_of_two_models_are_one_camera_only_by_the_users_word() {
    let mut window = window();
    open(&mut window, photograph("own.dng", "d65", Some("Own Model 1")), "Choose the light that own.dng");
    name_light(&mut window, 0, light("D65"));
    until(&mut window, "Which table is this camera?");
    assert!(has(&window, "raw files of the model \"Own Model 1\", as the picture states it"));
    assert!(has(&window, "Each patch of own.dng by the curves of all others: ΔE*00"));
    click(&mut window, ADD);
    until(&mut window, "(measured) is one of your cameras, ");
    let set = window.state().history.document().own[0].clone();
    assert_eq!(set.model.as_deref(), Some("Own Model 1"), "so that the page Matrix writes it too");

    let other = photograph("other.dng", "a", Some("Other Model"));
    open(&mut window, other, "other.dng from a \"Other Model\": remove");
    name_light(&mut window, 1, light("A"));
    window.run_steps(5);
    assert!(!has(&window, "Curves, profile and patches") && !has(&window, "Computing"), "nothing is solved");
    // Shots are kept in the session: so are their models, and the user's word.
    let kept = |window: &Window| {
        let document = window.state().history.document();
        let again = from_json(&to_json(document).unwrap()).unwrap().measurement;
        assert_eq!(again, document.measurement);
        again.mixed().is_some()
    };
    assert!(kept(&window));
    click(&mut window, "They are one camera");
    until(&mut window, "in the library has the curves of before");
    // The button is drawn before the answer is taken in.
    window.run_steps(3);
    assert!(!kept(&window));
    // Of two lights each has its own files.
    for label in ["DCP…", "ICC v4 under D65…", "ACES CLF under D65…", "ICC v4 under A…", "ACES CLF under A…"]
    {
        assert!(window.query_by_label(label).is_some(), "{label}");
    }
    click(&mut window, UPDATE);
    until(&mut window, "(measured) is one of your cameras, ");
    let document = window.state().history.document();
    assert_eq!((document.own.len(), document.own[0].name.clone()), (1, set.name.clone()));
    assert_ne!(document.own[0].curves, set.curves);
    assert_eq!(window.state().history.undo_name(), Some(&*format!("Update camera {}", set.name)));
    window.state_mut().push(Command::Undo);
    until(&mut window, "in the library has the curves of before");
    assert_eq!(window.state().history.document().own[0].curves, set.curves, "one step");
    // As in documents of earlier versions, which know no models.
    let mut json: serde_json::Value =
        serde_json::from_str(&to_json(window.state().history.document()).unwrap()).unwrap();
    for shot in json["measurement"]["shots"].as_array_mut().unwrap() {
        shot.as_object_mut().unwrap().remove("model").unwrap();
    }
    let old = from_json(&json.to_string()).unwrap().measurement;
    assert!(old.model().is_none() && old.mixed().is_none() && old.shots.len() == 2);
}

#[test]
fn a_file_without_a_model_takes_the_typed_name_and_says_so() {
    let mut window = window();
    open(&mut window, photograph("modelless.dng", "d65", None), "Choose the light that modelless.dng");
    name_light(&mut window, 0, light("D65"));
    until(&mut window, "Which table is this camera?");
    let words = format!("model \"{}\", by the camera's name: no picture states it", unique_camera_model("My camera"));
    assert!(has(&window, &words));
}

#[test]
fn a_picture_without_a_chart_is_discarded() {
    let flat = folder().join("flat.png");
    image::ImageBuffer::from_fn(300, 200, |x, _| image::Rgb([9000 + (x as u16), 9000, 8000])).save(&flat).unwrap();
    let mut window = window();
    assert!(!has(&window, "Drop a photograph") || has(&window, "NEF, CR3, ARW"));
    open(&mut window, flat, "flat.png is not measured yet");
    open(&mut window, picture("beside_flat.png", 12), "Choose the light that beside_flat.png");
    assert!(has(&window, "flat.png is not measured yet"), "beside the others");
    click(&mut window, "Discard");
    assert!(!has(&window, "flat.png is not measured yet") && has(&window, "Choose the light that beside_flat.png"));
    until(&mut window, "Picture: beside_flat.png");
    // A picture that was removed is taken again when it is opened again.
    click(&mut window, "Remove");
    until(&mut window, "Adobe DNG Converter or dnglab");
    assert!(cameras(&window).is_empty());
    open(&mut window, picture("beside_flat.png", 12), "Choose the light that beside_flat.png");
}

#[test]
fn a_picture_that_fails_is_told_in_one_place_until_the_next() {
    let broken = folder().join("damaged.dng");
    std::fs::write(&broken, b"II*\0 no picture").unwrap();
    let mut window = window();
    for again in [false, true] {
        open(&mut window, broken.clone(), "damaged.dng: ");
        assert_eq!(window.query_all_by_label_contains("damaged.dng").count(), 1, "beside the list alone");
        assert_eq!(window.state().view.status.text, Status::default().text);
        if again {
            open(&mut window, picture("after_damaged.png", 12), "Choose the light that after_damaged.png");
        } else {
            click(&mut window, "Discard");
        }
        assert!(!has(&window, "damaged.dng:"));
    }
}

#[test]
fn lights_are_found_by_what_they_are_called() {
    let catalog = Catalog::built_in();
    let lights: Vec<Line> = catalog.of_kind(SetKind::Illuminant).map(|entry| Line::of_set(entry, false)).collect();
    let names = |text: &str| found(&lights, text).into_iter().map(|at| lights[at].words.as_str()).collect::<Vec<_>>();
    for (word, wanted) in [
        ("halogen", "A, incandescent 2856 K"),
        ("tungsten", "A, incandescent 2856 K"),
        ("light bulb", "A, incandescent 2856 K"),
        ("incandescent", "A, incandescent 2856 K"),
        ("daylight", "D65, daylight 6504 K"),
        ("sun", "D55, daylight 5503 K"),
        ("sunshine", "Direct sun (ASTM G173), direct sunlight, air mass 1.5"),
        ("flash", "D55, daylight 5503 K"),
        ("strobe", "Xenon projector (Kinoton 75P)"),
        ("cloudy", "D65, daylight 6504 K"),
        ("fluorescent tube", "FL11, CIE fluorescent lamps"),
        ("led bulb", "LED-B3, CIE LED lamps"),
    ] {
        assert!(names(word).contains(&wanted), "{word}: {:?}", names(word));
    }
}
