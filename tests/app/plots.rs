//! Strip, swatches, spectra and difference maps: what a reader must be able to read off them.

use chromascope::catalog::Catalog;
use chromascope::document::{Diagram, Document, Light, SetKind};
use chromascope::figures::look::{FigureLook, SpectraLayout, SwatchLayout};
use chromascope::figures::{chromaticity, data_set, spectra, strip, swatches};
use chromascope::plot_item::PlotItem;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope_figure::{Dash, FigureRoom, InkRole, Mark, Panel, Shape, TextSize, annotations, text_width};

fn with<T>(document: &Document, read: impl FnOnce(&Scene<'_>) -> T) -> T {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    read(&Scene { document, catalog: &catalog, results: &results })
}

fn texts(panel: &Panel) -> Vec<&str> {
    let text = |mark: &'_ Mark| matches!(mark.shape, Shape::Text { .. });
    panel.marks.iter().filter(|mark| text(mark)).map(|mark| mark.name.as_str()).collect()
}

fn line(mark: &Mark) -> Option<&[[f64; 2]]> {
    if let Shape::Line { points, .. } = &mark.shape { Some(points) } else { None }
}

const STRIP: [f64; 2] = [700.0, 120.0];

#[test]
fn no_line_of_the_strip_erases_another() {
    with(&Document::paper(), |scene| {
        let panel = strip::build(scene, STRIP).expect("cameras compare").panel;
        assert!(panel.marks.iter().filter(|mark| line(mark).is_some()).all(|mark| mark.halo.is_none()));
        let signs = panel.marks.iter().filter(|m| matches!(&m.shape, Shape::Points { radius, .. } if *radius == 4.0));
        let mut markers: Vec<String> = signs.map(|m| format!("{:?}", m.shape)).collect();
        markers.dedup();
        assert_eq!(markers.len(), 3, "gray prints tell the lines apart");
    });
}

#[test]
fn the_strip_says_what_is_visible_and_where_minima_are() {
    for diagram in [Diagram::Xy, Diagram::UvPrime] {
        let document = Document { light: Light::Set("A".to_owned()), diagram, ..Document::colorimetry() };
        with(&document, |scene| {
            let panel = strip::build(scene, STRIP).expect("cameras compare").panel;
            let visible =
                panel.marks.iter().find(|mark| mark.name.starts_with("just visible to half")).expect("a hairline");
            // Independent: the area-equivalent radius from finite differences of u′v′ about a blackbody of 2856 K.
            let uv = |x: f64, y: f64| [4.0 * x, 9.0 * y].map(|v| v / (-2.0 * x + 12.0 * y + 3.0));
            let (x, y, h) = (0.4476, 0.4074, 1e-5);
            let [a, b] = [(h, 0.0), (0.0, h)].map(|(dx, dy)| {
                let (p, q) = (uv(x + dx, y + dy), uv(x - dx, y - dy));
                [0, 1].map(|i| (p[i] - q[i]) / (2.0 * h))
            });
            let scale = (a[0] * b[1] - a[1] * b[0]).abs().sqrt();
            let expected = if diagram == Diagram::Xy { 0.0013 / scale } else { 0.0013 };
            let points = line(visible).expect("a line");
            let off = |p: &[f64; 2]| (strip::kelvin(p[0]) - 2856.0).abs();
            let near = points.iter().min_by(|p, q| off(p).total_cmp(&off(q))).expect("points");
            assert!((near[1].powi(2) / expected - 1.0).abs() < 0.02, "{near:?} {expected}");
            assert!(texts(&panel).contains(&"just visible"));
            assert!(
                texts(&panel).iter().any(|text| text.starts_with("28") && text.ends_with(" K")),
                "{:?}",
                texts(&panel)
            );
        });
    }
}

#[test]
fn distances_stand_at_square_roots() {
    with(&Document::paper(), |scene| {
        let panel = strip::build(scene, STRIP).expect("cameras compare").panel;
        let id = chromascope::plot_item::SensorId { kind: SetKind::Camera, name: "Kodak DCS200".to_owned() };
        let own = scene.locus(id.kind, &id.name).expect("a locus");
        let reference = scene.locus(SetKind::Observer, &scene.document.reference).expect("a locus");
        let drawn =
            panel.marks.iter().find(|mark| mark.name == "Kodak DCS200" && line(mark).is_some()).expect("a line");
        for (point, (a, b)) in line(drawn).expect("a line").iter().zip(own.points.iter().zip(&reference.points)) {
            let (a, b) = (a.xy.expect("a chromaticity"), b.xy.expect("a chromaticity"));
            assert!((point[1].powi(2) - (a.x - b.x).hypot(a.y - b.y)).abs() < 1e-12);
        }
        let ticks = panel.y.vertical_ticks_over(panel.y.range, 80.0);
        let read = |text: &str| text.parse::<f64>().expect("a number");
        assert!(ticks.len() == 3 && ticks.iter().all(|tick| (tick.value.powi(2) - read(&tick.label)).abs() < 1e-12));
    });
}

#[test]
fn a_line_that_leaves_the_strip_is_marked() {
    // A matrix fitted under one spectral line throws a locus far out.
    let mut document = Document::colorimetry();
    document.light = Light::Set("Low-pressure sodium".to_owned());
    for entry in Catalog::built_in().of_kind(SetKind::Camera) {
        document.compare(&entry.name, SetKind::Camera);
    }
    with(&document, |scene| {
        let panel = strip::build(scene, STRIP).expect("cameras compare").panel;
        let top = panel.y.range[1];
        let leaves = |mark: &&Mark| line(mark).is_some_and(|points| points.iter().any(|point| point[1] > top));
        let gone: Vec<&str> = panel.marks.iter().filter(leaves).map(|mark| mark.name.as_str()).collect();
        let said: Vec<&str> =
            panel.marks.iter().filter_map(|m| m.name.split_once(": beyond the strip")).map(|m| m.0).collect();
        assert!(!gone.is_empty(), "a line leaves");
        assert_eq!(gone, said);
    });
}

/// The board with all patches of the chart.
fn board(scene: &Scene<'_>, layout: SwatchLayout, size: [f64; 2]) -> swatches::Built {
    swatches::build(scene, &FigureLook { swatch_layout: layout, ..FigureLook::default() }, size)
}

#[test]
fn nothing_lies_across_the_edge_that_the_eye_compares() {
    with(&Document::paper(), |scene| {
        let built = board(scene, SwatchLayout::Rows, [700.0, 200.0]);
        // What can be framed when pointed at or chosen: whole swatches, each once.
        let framed: Vec<[[f64; 2]; 2]> = built
            .panel
            .marks
            .iter()
            .filter_map(|mark| {
                let Shape::Rect { min, max } = mark.shape else { return None };
                matches!(built.things.get(mark.tag), Some(PlotItem::Patch { .. })).then_some([min, max])
            })
            .collect();
        assert_eq!(framed.len(), 20, "five patches through the reference and three cameras");
        let edges = built.panel.marks.iter().filter(|mark| mark.name == "reference").map(|mark| {
            let Shape::Rect { min, max } = mark.shape else { panic!("an area") };
            [max[0], 0.5 * (min[1] + max[1])]
        });
        for [x, y] in edges {
            assert!(
                framed.iter().all(|[min, max]| y < min[1]
                    || y > max[1]
                    || ((x - min[0]).abs() > 2.0 && (x - max[0]).abs() > 2.0))
            );
        }
    });
}

#[test]
fn each_bar_has_its_number_and_each_column_its_name() {
    with(&Document::colorimetry(), |scene| {
        let patches: Vec<String> = scene.patches().expect("a chart").patches().iter().map(|p| p.name.clone()).collect();
        let cameras = scene.sources().iter().filter(|source| source.visible && !source.is_reference).count();
        let charts = [[724.0, 154.0], [656.0, 92.0], [420.0, 400.0]].map(|size| (SwatchLayout::Charts, size));
        for (layout, size) in charts.into_iter().chain([(SwatchLayout::Rows, [724.0, 154.0])]) {
            let built = board(scene, layout, size);
            // Charts number what is clearly seen; other numbers are read by pointing.
            let least = if layout == SwatchLayout::Rows { 0.0 } else { 2.0 };
            let sources = scene.sources();
            let all = sources.iter().flat_map(|of| scene.differences(of.kind, &of.name).expect("differences"));
            let expected = all.filter(|one| one.expect("a difference") >= least).count();
            let expected = expected - if least > 0.0 { 0 } else { 24 };
            let bars = built.panel.marks.iter().filter(|mark| mark.name == "difference").count();
            let numbers = texts(&built.panel).into_iter().filter(|text| text.parse::<f64>().is_ok()).count();
            assert_eq!((bars, numbers), (24 * cameras, expected), "{layout:?}");
        }
        let built = board(scene, SwatchLayout::Rows, [724.0, 154.0]);
        let words = texts(&built.panel).concat();
        for name in patches {
            assert!(name.split(' ').all(|word| words.contains(word)), "{name}");
        }
        assert!(built.height > 154.0, "it scrolls");
        let (worst, thing) = swatches::worst(scene).expect("a worst patch");
        assert_eq!(worst, "Worst of 3 cameras: ΔE*00 8.3, Kodak DCS200, cyan");
        assert!(matches!(thing, PlotItem::Patch { source: Some(_), patch } if patch == "cyan"));
        assert_eq!(swatches::bar_scale(scene), "bar: ΔE*00 from 0 to 5");
    });
}

#[test]
fn charts_of_many_sensors_keep_their_numbers() {
    let mut document = Document::colorimetry();
    for camera in ["Nikon D850", "Sony ILCE-7M3", "Fujifilm X-T4", "Canon EOS 5D"] {
        document.compare(camera, SetKind::Camera);
    }
    with(&document, |scene| {
        let built = board(scene, SwatchLayout::Charts, [724.0, 154.0]);
        let numbers: Vec<&Mark> = built.panel.marks.iter().filter(|mark| mark.name.parse::<f64>().is_ok()).collect();
        assert!(numbers.len() > 20, "{}", numbers.len());
        for (i, a) in numbers.iter().enumerate() {
            let [a, b] = [Some(a), numbers.get(i + 1)].map(|mark| match mark.map(|mark| &mark.shape) {
                Some(Shape::Text { at, text, anchor, .. }) => {
                    let width = text_width(text, TextSize::Small);
                    let left = at[0] - anchor.0 * width;
                    Some(([left, left + width], at[1]))
                }
                _ => None,
            });
            let (Some((a, y)), Some((b, z))) = (a, b) else { continue };
            assert!(y != z || a[1] <= b[0], "{a:?} {b:?}");
        }
    });
}

#[test]
fn texts_of_the_strip_stand_clear_of_its_lines() {
    for (start, diagram) in [Document::paper(), Document::colorimetry()]
        .into_iter()
        .flat_map(|start| [Diagram::Xy, Diagram::UvPrime].map(|diagram| (start.clone(), diagram)))
    {
        // A minimum whose number has no room in the strip is read in the caption.
        with(&Document { diagram, ..start.clone() }, |scene| {
            let panel = strip::build(scene, STRIP).expect("cameras compare").panel;
            let figure = strip::KIND.figure(scene, &FigureLook::default(), FigureRoom::default()).expect("a figure");
            let rings = panel.marks.iter().filter(|mark| mark.name.contains(": minimum at "));
            for words in rings.map(|ring| ring.name.replace(": minimum at ", " ")) {
                assert!(figure.caption.contains(&words), "{words}: {}", figure.caption);
            }
        });
        for (temperature_k, size) in [1500.0, 3000.0, 5500.0, 9000.0]
            .into_iter()
            .flat_map(|t| [(t, STRIP), (t, [620.0, 110.0]), (t, [1100.0, 130.0])])
        {
            let document = Document { diagram, temperature_k, ..start.clone() };
            with(&document, |scene| {
                let panel = strip::build(scene, size).expect("cameras compare").panel;
                let projection = chromascope_figure::Projection::new(&panel, 1.0);
                let mut kelvins = 0;
                for mark in &panel.marks {
                    let Shape::Text { at, text, anchor, offset, .. } = &mark.shape else { continue };
                    kelvins += usize::from(text.ends_with(" K"));
                    let [x, y] = projection.at(*at);
                    let width = text_width(text, TextSize::Small);
                    let min = [x + offset[0] - anchor.0 * width, y + offset[1] - anchor.1 * 12.0];
                    let lines = panel.marks.iter().filter_map(line).flatten().map(|point| projection.at(*point));
                    let mut inside = lines.filter(|p| {
                        p[0] > min[0] && p[0] < min[0] + width && p[1] > min[1] + 1.0 && p[1] < min[1] + 11.0
                    });
                    assert_eq!(inside.next(), None, "{text} at {temperature_k} K in {size:?}");
                }
                // No number is led across curves: those of minima that have no room are left out.
                assert!(kelvins >= 1, "{diagram:?} {temperature_k} K in {size:?}");
            });
        }
    }
}

#[test]
fn channels_have_their_letters_in_a_small_pane() {
    with(&Document::colorimetry(), |scene| {
        for size in [[245.0, 230.0], [300.0, 420.0], [700.0, 640.0]] {
            let panels = plots(scene, SpectraLayout::Overlay, size);
            let letters = texts(&panels[2]).concat();
            let count = |letter| letters.matches(letter).count();
            // One for all cameras where theirs have no room.
            let counts = ["R", "G", "B"].map(count);
            assert!(counts == [1; 3] || size[0] > 400.0 && counts == [3; 3], "{size:?}: {counts:?}");
            assert_eq!(["x\u{304}", "y\u{304}", "z\u{304}"].map(count), [1; 3], "{size:?}");
        }
        let entry = scene.entry(SetKind::Camera, "Kodak DCS200").expect("a camera");
        let panel = data_set::panel(scene.results, &entry, InkRole::Text, [240.0, 104.0]);
        assert_eq!(texts(&panel.expect("curves").expect("curves")).concat().len(), 3, "R, G and B");
    });
}

fn plots(scene: &Scene<'_>, layout: SpectraLayout, size: [f64; 2]) -> Vec<Panel> {
    spectra::build(scene, &FigureLook { spectra_layout: layout, ..FigureLook::default() }, size).panels
}

#[test]
fn axes_have_titles() {
    with(&Document::paper(), |scene| {
        let panels = plots(scene, SpectraLayout::Overlay, [700.0, 640.0]);
        let titles: Vec<&str> = panels.iter().map(|panel| panel.y.label.as_str()).collect();
        assert_eq!(titles, ["relative power", "reflectance", "relative sensitivity", ""]);
        assert_eq!(panels[3].x.label, "wavelength (nm)");
        let strip = strip::build(scene, STRIP).expect("cameras compare").panel;
        assert_eq!(strip.x.label, "blackbody temperature (1000 K)");
        // The title stands below the tick labels, inside the panel.
        let projection = chromascope_figure::Projection::new(&strip, 1.0);
        let notes = annotations(&strip, projection.plot, 1.0);
        let title = notes.iter().find(|note| note.text == strip.x.label).expect("a title");
        assert!(title.at[1] > projection.plot.max[1] + 20.0 && title.at[1] + 14.0 <= strip.area.max[1] + 0.5);
        assert_eq!(
            chromaticity::coordinates(Diagram::Xy).map(|name| name.chars().count()),
            [1, 1],
            "symbols stay in corners"
        );
    });
}

#[test]
fn channels_are_labeled_at_their_peaks_with_the_reference_behind() {
    with(&Document::paper(), |scene| {
        let panels = plots(scene, SpectraLayout::Each, [700.0, 640.0]);
        let canon = panels.iter().find(|panel| panel.note == "Canon 10D (2007)").expect("a panel");
        let at = |name: &str| {
            canon.marks.iter().find_map(|mark| match &mark.shape {
                Shape::Text { at, text, .. } if text == name => Some(at[0]),
                _ => None,
            })
        };
        let [blue, green, red] = ["B", "G", "R"].map(|name| at(name).expect("a letter"));
        assert!((440.0..490.0).contains(&blue) && (510.0..550.0).contains(&green) && (580.0..620.0).contains(&red));
        let ghosts = canon.marks.iter().filter(|mark| mark.name.starts_with("S&B 1955") && line(mark).is_some());
        let gray = |mark: &&Mark| {
            mark.stroke.is_some_and(|s| s.ink.role == InkRole::Weak && s.ink.alpha < 1.0 && s.dash == Dash::Solid)
        };
        assert_eq!(ghosts.filter(gray).count(), 3);
        let reference = panels.iter().find(|panel| panel.note == "S&B 1955").expect("a panel");
        let own = reference.marks.iter().filter(|mark| mark.name.starts_with("S&B 1955") && line(mark).is_some());
        assert_eq!(own.count(), 3, "no ghost behind itself");
    });
}

#[test]
fn patches_are_named_beside_their_curves_and_white_is_cased() {
    with(&Document::paper(), |scene| {
        let panels = plots(scene, SpectraLayout::Overlay, [700.0, 640.0]);
        let panel = &panels[1];
        assert_eq!(texts(panel).len(), 5, "{:?}", texts(panel));
        let casing = |name: &str| {
            let curve = panel.marks.iter().find(|mark| mark.name == name && line(mark).is_some()).expect("a curve");
            curve.halo.map(|casing| casing.alpha)
        };
        // Only a color that is nearly a ground's own has one.
        assert!(casing("white").is_some_and(|alpha| alpha > 0.3) && casing("red").is_none());
        // No name covers another.
        let projection = chromascope_figure::Projection::new(panel, 1.0);
        let boxes: Vec<[f64; 4]> = panel
            .marks
            .iter()
            .filter_map(|mark| match &mark.shape {
                Shape::Text { at, text, anchor, offset, .. } => {
                    let [x, y] = projection.at(*at);
                    let (x, y) =
                        (x + offset[0] - anchor.0 * text_width(text, TextSize::Small), y + offset[1] - 13.0 * anchor.1);
                    Some([x, y, x + text_width(text, TextSize::Small), y + 13.0])
                }
                _ => None,
            })
            .collect();
        for (i, a) in boxes.iter().enumerate() {
            assert!(boxes[..i].iter().all(|b| a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3]));
        }
    });
}
