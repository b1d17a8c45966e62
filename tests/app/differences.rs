//! Differences large enough: the exaggeration of what is drawn, and each camera's differences from the reference.

use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::catalog::Catalog;
use chromascope::document::{Document, Exaggeration, SensorId, SetKind, TransformChoice};
use chromascope::figures::differences::{self, KIND};
use chromascope::figures::look::{DifferencePlane, FigureLook};
use chromascope::figures::{chromaticity, swatches};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::workspaces::PaneKind;
use chromascope_core::colorimetry::Xyz;
use chromascope_core::light::RadiationConstants;
use chromascope_core::query::{Ask as _, Displacements, LocusDeviationsQuery, LocusQuery, NearestBlackBodyQuery};
use chromascope_figure::{FigureRoom, Shape, text_area};
use egui_kittest::kittest::Queryable as _;

use crate::import_switches::says;
use crate::keyboard::press_like_keyboard;
use crate::screenshots::open_with;

fn with<T>(document: &Document, read: impl FnOnce(&Scene<'_>) -> T) -> T {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    read(&Scene { document, catalog: &catalog, results: &results })
}

fn exaggerated(to: Exaggeration) -> Document {
    let mut document = Document::colorimetry();
    Action::Scene(SceneAction::SetExaggeration(to)).apply(&mut document);
    document
}

fn look(difference_plane: DifferencePlane) -> FigureLook {
    FigureLook { difference_plane, ..FigureLook::default() }
}

#[test]
fn on_the_first_screen_each_cameras_mean_displacement_is_ten_pixels_long() {
    let harness = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    let rect = harness.get_by_role_and_label(egui::accesskit::Role::Canvas, "Differences").rect();
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    let lengths =
        with(&Document::colorimetry(), |scene| differences::mean_lengths(scene, &look(DifferencePlane::UvPrime), size));
    assert_eq!(lengths.len(), 3);
    assert!(lengths.iter().all(|length| *length >= 10.0), "{lengths:?} in {size:?}");
}

/// From the first screen alone: how far off each camera is, toward which hue, and how far the ring that is cut reaches.
#[test]
fn each_head_tells_mean_length_and_hue_and_a_cut_ring_its_radius() {
    for (size, mean) in [([1280.0, 800.0], "mean length 0.0091"), ([900.0, 600.0], "mean 0.0091")] {
        let harness = open_with(Document::colorimetry(), size, egui::Theme::Dark);
        let rect = harness.get_by_role_and_label(egui::accesskit::Role::Canvas, "Differences").rect();
        let size = [f64::from(rect.width()), f64::from(rect.height())];
        with(&Document::colorimetry(), |scene| {
            let built = differences::build(scene, &look(DifferencePlane::UvPrime), size).unwrap();
            let marks = built.panels.iter().flat_map(|panel| &panel.marks);
            let texts: Vec<&str> = marks
                .filter_map(|mark| if let Shape::Text { text, .. } = &mark.shape { Some(text.as_str()) } else { None })
                .collect();
            let count = |words: &str| texts.iter().filter(|text| text.contains(words)).count();
            assert_eq!(count(&format!("{mean}; shift toward red")), 1, "{texts:?}");
            assert_eq!(count("no dominant hue"), 2, "{texts:?}");
            assert!(count("0.0221") > 0, "{texts:?}");
            let kodak = SensorId { kind: SetKind::Camera, name: "Kodak DCS200".to_owned() };
            let words = differences::explained(scene, DifferencePlane::UvPrime, &kodak).join("\n");
            for part in ["mean length Δu′v′ 0.0091", "lengths, 0.0221", "toward red", "just visible"] {
                assert!(words.contains(part), "{words}");
            }
        });
    }
}

#[test]
fn the_papers_start_keeps_the_strip_and_the_switch_exchanges_both() {
    let shown = |document: Document| {
        let harness = open_with(document, [1280.0, 800.0], egui::Theme::Dark);
        ["Differences", "Distance to the reference over temperature"]
            .map(|name| harness.query_by_role_and_label(egui::accesskit::Role::Canvas, name).is_some())
    };
    assert_eq!(shown(Document::paper()), [false, true]);
    let mut document = Document::colorimetry();
    document.overlays.multiples = false;
    assert_eq!(shown(document), [false, true]);
}

#[test]
fn swatches_of_24_are_large_on_the_first_screen_and_no_words_touch() {
    let harness = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    let rect = harness.get_by_role_and_label(egui::accesskit::Role::Canvas, "Swatches").rect();
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    with(&Document::colorimetry(), |scene| {
        let built = swatches::build(scene, &FigureLook::default(), size);
        assert!(built.height <= size[1] + 0.5, "all in sight: {} of {}", built.height, size[1]);
        let mut count = 0;
        for mark in built.panel.marks.iter().filter(|mark| built.things.get(mark.tag).is_some()) {
            let Shape::Rect { min, max } = mark.shape else { continue };
            let [width, height] = [max[0] - min[0], max[1] - min[1]];
            assert!(width >= 36.0 && height >= 28.0, "{}: {width} × {height} in {size:?}", mark.name);
            count += 1;
        }
        assert_eq!(count, 3 * 24, "no chart of the reference: each swatch has its color");
        let texts = built.panel.marks.iter().filter_map(|mark| match &mark.shape {
            Shape::Text { at, text, anchor, size, .. } => Some((text.clone(), text_area(text, *size, *at, *anchor))),
            _ => None,
        });
        let texts: Vec<_> = texts.collect();
        for (index, (words, area)) in texts.iter().enumerate() {
            assert!(area.max[0] <= size[0] && area.min[0] >= 0.0, "{words} is cut");
            let other = texts[..index].iter().find(|(_, other)| area.overlaps(other));
            assert!(other.is_none(), "{words} touches {other:?}");
        }
    });
}

#[test]
fn charts_of_a_fourth_camera_and_those_of_a_small_window_are_all_in_sight() {
    let mut fourth = Document::colorimetry();
    let camera = CompareAction::Add(SetKind::Camera, "Sony ILCE-9".to_owned());
    Action::Compare(camera).apply(&mut fourth);
    for (document, size) in [(fourth, [1280.0, 800.0]), (Document::colorimetry(), [900.0, 600.0])] {
        let harness = open_with(document.clone(), size, egui::Theme::Dark);
        let rect = harness.get_by_role_and_label(egui::accesskit::Role::Canvas, "Swatches").rect();
        let size = [f64::from(rect.width()), f64::from(rect.height())];
        with(&document, |scene| {
            let built = swatches::build(scene, &FigureLook::default(), size);
            assert!(built.height <= size[1] + 0.5, "{} of {}", built.height, size[1]);
        });
        assert!(!says(&harness, "more below"), "in {size:?}");
    }
}

#[test]
fn what_has_no_room_is_named_and_what_is_seen_is_explained() {
    let window = open_with(Document::colorimetry(), [900.0, 600.0], egui::Theme::Dark);
    let plots = window.get_by_role_and_label(egui::accesskit::Role::Canvas, "Differences").rect();
    assert!(!says(&window, "No room") && plots.width() > 200.0 && plots.height() > 200.0, "{plots:?}");
    let mut window = open_with(Document::paper(), [900.0, 600.0], egui::Theme::Dark);
    assert!(says(&window, "No room for the strip over the temperature"));
    window.state_mut().view.show(PaneKind::SPECTRA);
    window.run_steps(3);
    assert!(!says(&window, "No room"));
    let mut window = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    assert!(!says(&window, "No room"));
    assert!(says(&window, "thick line: ") && says(&window, "arrows: ") && says(&window, "swatches: "));
    window.state_mut().view.show(PaneKind::SPECTRA);
    window.run_steps(3);
    assert!(!says(&window, "thick line: ") && !says(&window, "arrows: "));
}

/// Unique hues measured otherwise than CIECAM02 was made: their angles in CIELAB (Fairchild, *Color Appearance Models*) and their
/// wavelengths, near 575, 515 and 475 nm (Kuehni 2004), with the CIE 1931 functions there.
#[test]
fn mean_vectors_have_the_hues_of_their_planes() {
    let d65 = Xyz::new(0.9504, 1.0, 1.0888);
    let of = |plane, to: &[[f64; 2]]| {
        let shift = Displacements::new(to.iter().map(|to| (Some([0.0; 2]), Some(*to))));
        differences::hue::of(plane, &shift, 50.0, d65)
    };
    let [uv, xy, lab] = [DifferencePlane::UvPrime, DifferencePlane::Xy, DifferencePlane::Lab];
    let unique = ["toward red", "toward yellow", "toward green", "toward blue"];
    for (angle, hue) in [24.0_f64, 90.0, 162.0, 246.0].into_iter().zip(unique) {
        let (sin, cos) = angle.to_radians().sin_cos();
        for length in [0.1, 2.0, 20.0] {
            assert_eq!(of(lab, &[[length * cos, length * sin]]), hue, "{angle}° at {length}");
        }
    }
    let white = d65.uv_prime().unwrap();
    let spectrum = [("toward yellow", 0.8425, 0.9154, 0.0018), ("toward green", 0.0291, 0.6082, 0.1117)];
    for (hue, x, y, z) in spectrum.into_iter().chain([("toward blue", 0.1421, 0.1126, 1.0419)]) {
        let far = Xyz::new(x, y, z).uv_prime().unwrap();
        assert_eq!(of(uv, &[[0.01 * (far.u - white.u), 0.01 * (far.v - white.v)]]), hue);
    }
    assert_eq!(of(uv, &[[0.01, 0.001]]), "toward red");
    assert_eq!(of(xy, &[[0.01, 0.0]]), "toward red");
    assert_eq!(of(xy, &[[0.0, 0.01]]), "toward yellow-green");
    assert_eq!(of(lab, &[[1.0, -1.0]]), "toward purple");
    assert_eq!(of(lab, &[[1.0, 0.0], [-1.0, 0.1]]), "no dominant hue");
}

#[test]
fn x10_typed_as_letters_exaggerates() {
    let mut window = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::K);
    window.run_steps(3);
    press_like_keyboard(&mut window, "x10");
    window.key_press(egui::Key::Enter);
    window.run_steps(3);
    assert_eq!(window.state().history.document().exaggeration, Exaggeration::Ten);
}

#[test]
fn as_they_are_outputs_do_not_speak_of_differences_and_exaggerated_they_do_but_numbers_stay() {
    let all = [Exaggeration::One, Exaggeration::Ten].map(|to| {
        with(&exaggerated(to), |scene| {
            [&chromaticity::KIND, &swatches::KIND, &KIND].map(|kind| {
                let figure = kind.figure(scene, &FigureLook::default(), FigureRoom::default()).unwrap();
                let words = |mark: &chromascope_figure::Mark| mark.name.contains("differences ×10");
                let said =
                    figure.panels.iter().any(|panel| panel.note == "differences ×10" || panel.marks.iter().any(words));
                (said, figure.caption.contains("Differences ×10"), figure.table.to_csv())
            })
        })
    });
    for (plain, large) in all[0].iter().zip(&all[1]) {
        assert_eq!((plain.0, plain.1), (false, false));
        assert_eq!((large.0, large.1), (true, true));
        assert_eq!(plain.2, large.2, "numbers are never multiplied");
    }
}

#[test]
fn drawn_patches_are_the_reference_and_so_many_times_the_difference() {
    let document = exaggerated(Exaggeration::Three);
    with(&document, |scene| {
        let of = |kind, name: &str| scene.patch_colors(kind, name).unwrap();
        let reference = of(SetKind::Observer, &document.reference);
        let (own, drawn) =
            (of(SetKind::Camera, "Kodak DCS200"), scene.drawn_patch_colors(SetKind::Camera, "Kodak DCS200"));
        for ((own, drawn), reference) in own.iter().zip(drawn.unwrap()).zip(&reference) {
            let [own_uv, drawn_uv, from] = [own.uv, drawn.uv, reference.uv].map(Option::unwrap);
            assert!((drawn_uv.u - from.u - 3.0 * (own_uv.u - from.u)).abs() < 1e-12);
            assert!((drawn_uv.v - from.v - 3.0 * (own_uv.v - from.v)).abs() < 1e-12);
            let back = drawn.xy.unwrap().uv_prime().unwrap();
            assert!((back.u - drawn_uv.u).abs() < 1e-12 && (back.v - drawn_uv.v).abs() < 1e-12);
            assert_eq!((drawn.xyz, drawn.lab), (own.xyz, own.lab), "numbers stay");
        }
        let unmoved = scene.drawn_patch_colors(SetKind::Observer, &document.reference).unwrap();
        assert_eq!(unmoved, reference);
    });
}

#[test]
fn the_exaggeration_is_kept_in_sessions_and_left_out_as_it_is_by_default() {
    use chromascope::document::session;
    let json = |document: &Document| session::to_json(document).unwrap();
    assert!(!json(&Document::colorimetry()).contains("exaggeration"));
    let document = exaggerated(Exaggeration::Ten);
    assert_eq!(session::from_json(&json(&document)).unwrap().exaggeration, Exaggeration::Ten);
}

#[test]
fn without_a_camera_the_plots_say_why_they_are_empty() {
    let why = |document: &Document| {
        with(document, |scene| differences::build(scene, &FigureLook::default(), [600.0, 300.0]).err())
    };
    let mut alone = Document::colorimetry();
    alone.compared.truncate(1);
    assert_eq!(why(&alone).as_deref(), Some("No camera is compared with the reference."));
    let mut hidden = Document::colorimetry();
    hidden.compared.iter_mut().skip(1).for_each(|one| one.visible = false);
    assert_eq!(why(&hidden).as_deref(), Some("All cameras are hidden."));
    let mut apart = Document::colorimetry();
    apart.set_transform(TransformChoice::Paper);
    assert!(why(&apart).unwrap().contains("differ by construction"));
}

/// A second way: the solver of correlated color temperatures, on the blackbody locus of CIE 1931, finds the same.
#[test]
fn offsets_of_loci_agree_with_the_cct_of_each_point() {
    with(&Document::colorimetry(), |scene| {
        let observer = scene.sensor(SetKind::Observer, "CIE 1931 2°").unwrap();
        let query = NearestBlackBodyQuery { observer, constants: RadiationConstants::Paper };
        let ohno = scene.results.ask(&query);
        let ohno = (*ohno).as_ref().unwrap();
        let rendering = |kind, name: &str| scene.rendering_of(kind, name).unwrap();
        let reference = rendering(SetKind::Observer, "CIE 1931 2°");
        let mut compared = 0;
        for camera in ["Canon EOS 5D Mark II", "Nikon D70 (A.M.P.A.S.)", "Kodak DCS200"] {
            let (temperatures, constants) = (Scene::locus_temperatures().unwrap(), RadiationConstants::Paper);
            let locus = LocusQuery { rendering: rendering(SetKind::Camera, camera), temperatures, constants };
            let offsets = scene.results.ask(&LocusDeviationsQuery { locus, reference: reference.clone() });
            let points = &scene.locus(SetKind::Camera, camera).unwrap().points;
            for (point, (temperature, offset)) in points.iter().zip((*offsets).as_ref().unwrap()) {
                let Some((along, duv)) = offset.and_then(|offset| offset.cct_error_k.zip(offset.duv)) else { continue };
                let Ok(cct) = ohno.cct(point.uv.unwrap().uv60()) else { continue };
                let kelvin = temperature.get() + along;
                assert!((duv - cct.duv).abs() < 1e-7, "{camera} {kelvin}: {duv} {}", cct.duv);
                assert!(
                    (kelvin / cct.temperature.get() - 1.0).abs() < 1e-5,
                    "{camera} {kelvin}: {:?}",
                    cct.temperature
                );
                compared += 1;
            }
        }
        assert!(compared > 400, "{compared}");
    });
}
