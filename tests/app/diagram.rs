//! The chromaticity diagram: what it shows, and where marks and texts stand.

use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::catalog::Catalog;
use chromascope::document::{Diagram, Document, Light, Overlays, SetKind, Subset};
use chromascope::figures::chromaticity::{self, Built};
use chromascope::paint::Emphasis;
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::view::{DiagramFit, View};
use chromascope::workspaces::PaneKind;
use chromascope_figure::{Ink, InkRole, Mark, Marker, Panel, Rect, Shape, text_width};
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::driven_with;

const SIZES: [[f64; 2]; 4] = [[440.0, 300.0], [680.0, 350.0], [640.0, 480.0], [1400.0, 1100.0]];

fn built(document: &Document, view: &View, size: [f64; 2]) -> Built {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document, catalog: &catalog, results: &results };
    chromaticity::build(&scene, &view.look(PaneKind::CHROMATICITY), size)
}

fn whole() -> View {
    let mut view = View::default();
    view.saved.diagram_fit = DiagramFit::Whole;
    view
}

/// The paper's document with all patches of its chart.
fn all_patches() -> Document {
    Document { subset: Subset::All, ..Document::paper() }
}

/// Eight sensors beside the reference and 24 patches.
fn many() -> Document {
    let mut document = all_patches();
    for camera in ["Nikon D850", "Sony ILCE-7M3", "Fujifilm X-T4", "Sony DSC-RX100M4"] {
        document.compare(camera, SetKind::Camera);
    }
    document
}

fn documents() -> Vec<Document> {
    let mut marked = Document::colorimetry();
    marked.overlays =
        Overlays { whites: true, isotherms: true, daylight: true, srgb: true, rec2020: true, ..marked.overlays };
    let mut all = vec![Document::paper(), Document::colorimetry(), all_patches(), many(), marked];
    all.extend(all.clone().into_iter().map(|document| Document { diagram: Diagram::UvPrime, ..document }));
    all
}

fn dcs200() -> SensorId {
    SensorId { kind: SetKind::Camera, name: "Kodak DCS200".to_owned() }
}

/// Points of a plot, y downward.
fn at(panel: &Panel, size: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
    [share(x, panel.x.range) * (size[0] - 45.0), (1.0 - share(y, panel.y.range)) * (size[1] - 25.0)]
}

/// Texts with their rectangles in the plot.
fn texts(panel: &Panel, size: [f64; 2]) -> Vec<(String, Rect)> {
    let text = |mark: &Mark| match &mark.shape {
        Shape::Text { at: place, text, anchor, offset, size: font, .. } => {
            let [width, height] = [text_width(text, *font), f64::from(font.points())];
            let [x, y] = at(panel, size, *place);
            let min = [x + offset[0] - anchor.0 * width, y + offset[1] - anchor.1 * height];
            Some((text.clone(), Rect::from_min_size(min, [width, height])))
        }
        _ => None,
    };
    panel.marks.iter().filter_map(text).collect()
}

/// Diameters of the camera's and the reference's patches in the order in which they are drawn, rims included.
fn patches(built: &Built) -> Vec<(&Mark, f64)> {
    let patch = |mark: &&Mark| matches!(built.things.get(mark.tag), Some(PlotItem::Patch { .. }));
    let marks = built.panel.marks.iter().filter(patch).filter(|mark| !mark.name.contains("outside"));
    marks
        .filter_map(|mark| match mark.shape {
            Shape::Points { radius, .. } => Some((mark, 2.0 * radius + mark.stroke.map_or(0.0, |rim| rim.width))),
            _ => None,
        })
        .collect()
}

#[test]
fn only_the_point_under_the_pointer_has_a_ring() {
    use chromascope::paint::Emphasis;
    use chromascope::plot_item::PlotItem;
    let [a, b] = ["Canon EOS 5D Mark II", "Kodak DCS200"].map(crate::inspector::camera);
    let patch = |source: &chromascope::plot_item::SensorId, name: &str| PlotItem::Patch {
        source: Some(source.clone()),
        patch: name.to_owned(),
    };
    let mut view = chromascope::view::View::default();
    let emphasis = |view: &chromascope::view::View, item: &PlotItem| view.emphasis(item, "CIE 1931 2°");
    view.hovered = Some(PlotItem::Sensor(a.clone()));
    assert_eq!(emphasis(&view, &PlotItem::Sensor(a.clone())), Emphasis::Hovered);
    assert_eq!(emphasis(&view, &patch(&a, "red")), Emphasis::Pointed, "its line is thicker, its points have no rings");
    assert_eq!(emphasis(&view, &patch(&b, "red")), Emphasis::Normal);
    view.hovered = Some(patch(&a, "red"));
    assert_eq!(emphasis(&view, &patch(&a, "red")), Emphasis::Hovered);
    assert_ne!(emphasis(&view, &patch(&a, "green")), Emphasis::Hovered);
}

#[test]
fn no_text_covers_another_or_leaves_the_plot() {
    for document in documents() {
        for view in [View::default(), whole()] {
            for size in SIZES {
                let built = built(&document, &view, size);
                let lens =
                    built.lens.map(|lens| (lens.panel.clone(), [lens.panel.area.width(), lens.panel.area.height()]));
                for (panel, size) in [(built.panel, size)].into_iter().chain(lens) {
                    let texts = texts(&panel, size);
                    for (i, (name, a)) in texts.iter().enumerate() {
                        let inside = a.min[0] >= 0.0 && a.min[1] >= 0.0;
                        assert!(inside && a.max[0] <= size[0] - 45.0 && a.max[1] <= size[1] - 25.0, "{name} at {a:?}");
                        for (other, b) in &texts[i + 1..] {
                            let apart = (0..2).any(|axis| a.max[axis] <= b.min[axis] || b.max[axis] <= a.min[axis]);
                            assert!(apart, "{name} covers {other} in {size:?}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn each_line_has_its_name_clear_of_the_data() {
    for document in documents().into_iter().filter(|document| !document.overlays.whites) {
        let (labels, count) = {
            let (catalog, results) = (Catalog::built_in(), Results::default());
            let scene = Scene { document: &document, catalog: &catalog, results: &results };
            let mut sources = scene.sources();
            let count = sources.len();
            // Above six beside the reference the legend names them.
            sources.retain(|source| source.is_reference || count <= 7);
            (sources.into_iter().map(|source| [source.label, source.short]).collect::<Vec<_>>(), count)
        };
        for (view, size) in [View::default(), whole()].iter().flat_map(|view| SIZES.map(|size| (view, size))) {
            let built = built(&document, view, size);
            // A whole diagram without a lens only hints at the data; the smallest pane names few.
            if view.saved.diagram_fit == DiagramFit::Whole && built.lens.is_none() {
                continue;
            }
            let panel = built.lens.map_or(built.panel, |lens| lens.panel);
            let size = [panel.area.width(), panel.area.height()];
            let texts = texts(&panel, size);
            // Shortened where there is little room.
            let named = |label: &[String; 2]| texts.iter().find(|(text, _)| label.contains(text));
            let missing: Vec<&[String; 2]> = labels.iter().filter(|label| named(label).is_none()).collect();
            let has_room = size[0] >= 640.0 || size[0] >= 440.0 && count <= 5;
            assert!(missing.is_empty() || !has_room, "{missing:?} in {size:?}");
            let leaders = panel.marks.iter().filter(|mark| mark.name.ends_with(", leader"));
            for ends in leaders.filter_map(|mark| match &mark.shape {
                Shape::Segments { segments } => Some(segments[0].map(|end| at(&panel, size, end))),
                _ => None,
            }) {
                for share in (0..=20).map(|i| f64::from(i) / 20.0) {
                    let p = [0, 1].map(|i| ends[0][i] + share * (ends[1][i] - ends[0][i]));
                    let crossed =
                        texts.iter().find(|(_, area)| (0..2).all(|i| area.min[i] < p[i] && p[i] < area.max[i]));
                    assert!(crossed.is_none(), "a leader crosses {crossed:?} in {size:?}");
                }
            }
            for (name, area) in labels.iter().filter_map(named) {
                let markers = panel.marks.iter().filter_map(|mark| match &mark.shape {
                    Shape::Points { points, radius, .. } if *radius > 3.4 => Some(at(&panel, size, points[0])),
                    _ => None,
                });
                let covered = |p: &[f64; 2]| (0..2).all(|i| area.min[i] < p[i] && p[i] < area.max[i]);
                assert!(!markers.into_iter().any(|p| covered(&p)), "{name} on a marker in {size:?}");
            }
        }
    }
}

#[test]
fn the_reference_s_temperatures_stand_on_the_outer_side_of_its_line() {
    let mut document = Document { overlays: Overlays { patches: false, ..Overlays::default() }, ..Document::paper() };
    document.compared.retain(|compared| compared.name != "CIE 1931 2°");
    let built = built(&document, &View::default(), [900.0, 700.0]);
    let ticks: Vec<[[f64; 2]; 2]> = built
        .panel
        .marks
        .iter()
        .filter(|mark| mark.name.ends_with(" K") && mark.stroke.is_some_and(|s| s.ink.role == InkRole::Reference))
        .filter_map(|mark| match &mark.shape {
            Shape::Segments { segments } => Some(segments[0]),
            _ => None,
        })
        .collect();
    assert_eq!(ticks.len(), 6, "1000, 2000, 3000, 5000, 10000 and 20000 K");
    // The line bulges upward and, where it climbs, to the left.
    assert!(ticks.iter().all(|[from, to]| to[1] > from[1]), "{ticks:?}");
    let labels: Vec<String> = texts(&built.panel, [900.0, 700.0]).into_iter().map(|(text, _)| text).collect();
    for label in ["1000 K", "2000 K", "3000 K", "S&B 1955", "Canon 10D (2007)", "Nikon D70 (2007)", "Kodak DCS200"] {
        assert!(labels.iter().any(|text| text == label), "{label} in {labels:?}");
    }
}

#[test]
fn markers_shrink_with_their_number_and_small_ones_lie_over_large_ones() {
    let few = built(&Document::paper(), &View::default(), SIZES[1]);
    let sizes = patches(&few);
    assert_eq!(sizes[0].1, 15.0, "five patches");
    assert!(sizes[..20].windows(2).all(|pair| pair[1].1 <= pair[0].1), "cameras");
    let last = sizes.last().expect("patches");
    assert_eq!((last.0.stroke.map(|s| s.ink.role), last.1), (Some(InkRole::Reference), 15.0), "the reference on top");
    let many = built(&many(), &View::default(), SIZES[1]);
    assert_eq!(patches(&many)[0].1, 6.0, "24 patches through nine sensors");
    let [few, many] = [few, many].map(|built| {
        let patches: Vec<Option<Ink>> = patches(&built).into_iter().map(|(mark, _)| mark.fill).collect();
        patches.into_iter().flatten().any(|ink| matches!(ink.role, InkRole::Rgb(_)))
    });
    assert!(few && !many, "more than twelve patches are dots in the sensor's color");
}

#[test]
fn each_line_has_its_marker_halfway() {
    let size = SIZES[1];
    let built = built(&many(), &View::default(), size);
    let markers: Vec<(Marker, [f64; 2])> = built
        .panel
        .marks
        .iter()
        .filter(|mark| mark.name.ends_with(", line"))
        .filter_map(|mark| match &mark.shape {
            Shape::Points { points, marker, .. } => Some((*marker, at(&built.panel, size, points[0]))),
            _ => None,
        })
        .collect();
    assert_eq!(markers.len(), 8, "all but the reference");
    for (i, (a, p)) in markers.iter().enumerate() {
        for (b, q) in &markers[i + 1..] {
            assert!(a != b && (p[0] - q[0]).hypot(p[1] - q[1]) > 9.0, "{a:?} {b:?}");
        }
    }
}

#[test]
fn nothing_below_zero_is_shown_and_the_fit_ignores_what_is_not_compared() {
    for document in documents() {
        for view in [View::default(), whole()] {
            for size in SIZES.into_iter().chain([[2000.0, 300.0], [300.0, 900.0]]) {
                let panel = built(&document, &view, size).panel;
                assert!(panel.x.range[0] >= -0.02 - 1e-12 && panel.y.range[0] >= -0.02 - 1e-12, "{:?}", panel.x.range);
            }
        }
    }
    let with_observer = Document::paper();
    let mut without = Document::paper();
    without.compared.retain(|compared| compared.name != "CIE 1931 2°");
    assert_ne!(with_observer.compared.len(), without.compared.len());
    let ranges = |document| built(document, &View::default(), SIZES[1]).panel.x.range;
    assert_eq!(ranges(&with_observer), ranges(&without), "Eq 13 does not take an XYZ observer");
}

#[test]
fn the_whole_diagram_has_a_lens_where_half_of_the_pane_is_free() {
    let document = Document { diagram: Diagram::UvPrime, ..all_patches() };
    let shown = built(&document, &whole(), [700.0, 350.0]);
    let lens = shown.lens.expect("a lens");
    let data = built(&document, &View::default(), [700.0, 350.0]);
    let [inside, all] = [&lens.panel, &data.panel].map(|panel| panel.y.range);
    assert!(inside[0] < all[0] + 1e-9 && inside[1] > all[1] - 1e-9, "the lens holds the data: {inside:?} {all:?}");
    assert!(lens.panel.y.range[1] - lens.panel.y.range[0] < 0.7 * (shown.panel.y.range[1] - shown.panel.y.range[0]));
    assert!(built(&document, &whole(), [400.0, 380.0]).lens.is_none(), "no room");
    assert!(data.lens.is_none());
}

#[test]
fn what_is_chosen_takes_its_own_color_and_only_it_a_ring() {
    let patch =
        |source: &SensorId, patch: &str| PlotItem::Patch { source: Some(source.clone()), patch: patch.to_owned() };
    let mut view = View { selected: Some(patch(&dcs200(), "red")), ..View::default() };
    let emphasis = |view: &View, thing: &PlotItem| view.emphasis(thing, "Stiles & Burch 1955 2°");
    assert_eq!(emphasis(&view, &patch(&dcs200(), "red")), Emphasis::Selected);
    assert_eq!(emphasis(&view, &PlotItem::Sensor(dcs200())), Emphasis::Related);
    assert_eq!(emphasis(&view, &patch(&dcs200(), "blue")), Emphasis::Faded);
    view.selected = Some(PlotItem::Sensor(dcs200()));
    assert_eq!(emphasis(&view, &PlotItem::Sensor(dcs200())), Emphasis::Selected);
    assert_eq!(emphasis(&view, &patch(&dcs200(), "blue")), Emphasis::Related);
}

#[test]
fn the_diagram_holds_still_while_data_move() {
    let (_executor, mut window) = driven_with(Document::paper(), [1280.0, 800.0], egui::Theme::Dark);
    let shown = |window: &egui_kittest::Harness<'_, chromascope::app::ChromascopeApp>| {
        window.state().view.diagram.fit().expect("a fit").shown
    };
    let before = shown(&window);
    window.key_down(egui::Key::B);
    window.run_steps(2);
    assert!(window.state().view.blink);
    assert_eq!(shown(&window), before, "B");
    window.key_up(egui::Key::B);
    for action in [SceneAction::SetLight(Light::BlackBody), SceneAction::SetTemperature(1390.0)] {
        window.state_mut().push(Action::Scene(action));
        window.run_steps(2);
    }
    assert_eq!(shown(&window), before, "a dragged temperature");
    let document = window.state().history.document().clone();
    let marks = built(&document, &window.state().view, [680.0, 350.0]).panel.marks;
    assert!(marks.iter().any(|mark| mark.name == "S&B 1955 green, outside"), "points that leave have arrows");
    window.state_mut().push(chromascope::command::Command::ResetView);
    window.run_steps(3);
    let home = shown(&window);
    assert_ne!(home, before, "Home");
    window.state_mut().push(Action::Scene(SceneAction::SetTemperature(5500.0)));
    window.run_steps(2);
    assert_eq!(shown(&window), home);
    window.state_mut().push(Action::Compare(CompareAction::Add(SetKind::Camera, "Sony ILCE-7M3".to_owned())));
    window.run_steps(3);
    assert_ne!(shown(&window), home, "another camera");
}

#[test]
fn the_pointer_reads_name_and_difference_unless_it_is_pressed() {
    let (_executor, mut window) = driven_with(Document::paper(), [1280.0, 800.0], egui::Theme::Dark);
    let document = window.state().history.document().clone();
    let rect = window.get_by_role_and_label(egui::Role::Canvas, "Chromaticity").rect();
    let size = [f64::from(rect.width()) + 45.0, f64::from(rect.height()) + 25.0];
    let panel = built(&document, &window.state().view, size).panel;
    let mark = panel.marks.iter().find(|mark| mark.name == "Kodak DCS200 red").expect("a patch");
    let Shape::Points { points, .. } = &mark.shape else { panic!("a point") };
    let [x, y] = at(&panel, size, points[0]);
    let pointer = rect.min + egui::Vec2::new(x as f32, y as f32);
    window.hover_at(pointer);
    window.run_steps(4);
    let tooltip = window.get_by_label("Kodak DCS200, red").rect();
    assert!(!tooltip.expand(4.0).contains(pointer));
    window.drag_at(pointer);
    window.run_steps(2);
    assert!(window.query_by_label("Kodak DCS200, red").is_none(), "none while the button is down");
}
