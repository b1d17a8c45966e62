//! Figures on screen and in files.

use std::{cell::RefCell, rc::Rc, sync::Arc};

use chromascope::{
    export::{self, Paper},
    paint::{self, Emphasis, PlotOptions, PlotOutput, View},
    theme::{self, Theme},
};
use chromascope_figure::{
    Anchor, Axis, Dash, Figure, Image, Ink, InkRole, LegendEntry, Mark, Marker, Panel, Rect, Shape, Stroke, Tag,
    TextSize, Ticks,
};
use egui::{Id, Pos2, Vec2};
use egui_kittest::Harness;

use super::cpu_renderer::Cpu;

const PATCHES: [([f64; 2], [u8; 3], &str); 4] = [
    ([0.48, 0.345], [160, 70, 60], "red"),
    ([0.34, 0.45], [100, 140, 75], "green"),
    ([0.20, 0.18], [50, 70, 145], "blue"),
    ([0.44, 0.435], [210, 165, 70], "orange yellow"),
];

/// A curve like a Planckian locus.
fn locus(shift: f64) -> Vec<[f64; 2]> {
    (0..60)
        .map(|i| f64::from(i) / 59.0)
        .map(|t| [0.25 + 0.32 * t, 0.26 + shift + 0.62 * t - (0.56 + shift) * t * t])
        .collect()
}

fn gradient_image() -> Image {
    let side = 64_u8;
    let pixels = (0..side).flat_map(|y| (0..side).flat_map(move |x| [4 * x, 255 - 4 * y, 128, 41]));
    Image { width: side.into(), height: side.into(), rgba: Arc::from(pixels.collect::<Vec<u8>>()) }
}

fn chromaticity(area: Rect) -> Panel {
    let mut panel = Panel::new("Chromaticity", area, Axis::new("x", [0.1, 0.7]), Axis::new("y", [0.15, 0.48]));
    panel.equal_aspect = true;
    let marks = &mut panel.marks;
    let fill = Shape::Image { min: [0.0, 0.0], max: [0.75, 0.8], image: gradient_image() };
    marks.push(Mark::new(Tag(90), "diagram", fill));
    let rim = (0..40).map(|i| ([0.5 + 0.006 * f64::from(i), 0.5 - 0.006 * f64::from(i)], [255, 200 - 5 * i as u8, 0]));
    let rim = Mark::new(Tag(91), "spectral locus", Shape::Gradient { points: rim.collect() });
    marks.push(rim.with_stroke(InkRole::Text, 2.0));
    for (tag, role, width, shift) in
        [(1, InkRole::Sensor(0), 2.0, -0.02), (2, InkRole::Sensor(1), 2.0, -0.04), (0, InkRole::Reference, 4.0, 0.0)]
    {
        let line = Shape::Line { points: locus(shift), closed: false };
        marks.push(Mark::new(Tag(tag), "locus", line).with_stroke(role, width).with_halo(InkRole::Plot));
    }
    let estimated = Shape::Line { points: locus(0.03), closed: false };
    marks.push(Mark::new(Tag(3), "estimated", estimated).with_stroke(InkRole::Sensor(2), 2.0).with_dash(Dash::Dashed));
    for (at, rgb, name) in PATCHES {
        let camera = [at[0] - 0.02, at[1] - 0.05];
        let tail = Shape::Segments { segments: vec![[at, camera]] };
        marks
            .push(Mark::new(Tag(1), name, tail).with_stroke(Ink::new(InkRole::Sensor(0)).faded(0.7), theme::LINE_TAIL));
        let point = |at, marker| Shape::Points { points: vec![at], marker, radius: 6.0 };
        let camera = Mark::new(Tag(10), name, point(camera, Marker::Circle));
        marks.push(camera.with_stroke(InkRole::Sensor(0), 2.0).with_fill(Ink::rgb(rgb)).with_halo(InkRole::Plot));
        let reference = Mark::new(Tag(11), name, point(at, Marker::Plus));
        marks.push(reference.with_stroke(InkRole::Reference, 2.0).with_halo(InkRole::Plot));
        let label = Shape::Text {
            at,
            text: name.to_owned(),
            anchor: Anchor::LEFT_BOTTOM,
            offset: [8.0, -6.0],
            size: TextSize::Body,
            ink: InkRole::Text.into(),
        };
        marks.push(Mark::new(Tag(11), name, label).with_halo(InkRole::Plot));
    }
    panel
}

fn strip(area: Rect) -> Panel {
    let kelvins = [1000.0, 1500.0, 2000.0, 3000.0, 5000.0, 10000.0, 20000.0];
    let ticks = Ticks::At(kelvins.map(|k| (1e6 / k, format!("{k} K"))).to_vec());
    let x = Axis::new("", [1040.0, 40.0]).with_ticks(ticks);
    let mut panel = Panel::new("Distance over temperature", area, x, Axis::new("", [0.0, 0.1]));
    panel.note = "distance to truth (Δu′v′) over temperature".into();
    let points = (0..100).map(|i| 50.0 + 9.5 * f64::from(i)).map(|m| [m, 0.00009 * (m - 200.0).abs()]);
    let line = Shape::Line { points: points.collect(), closed: false };
    panel.marks.push(Mark::new(Tag(3), "Kodak", line).with_stroke(InkRole::Sensor(2), 2.0));
    panel
}

fn spectra(area: Rect) -> Panel {
    let y = Axis::new("sensitivity", [-0.1, 1.1]);
    let mut panel = Panel::new("Sensitivities", area, Axis::new("wavelength (nm)", [380.0, 780.0]), y);
    panel.note = "sensitivities, scaled to peak 1".into();
    for (slot, shift) in [(0_u8, 0.0), (1, 12.0), (5, 25.0)] {
        for peak in [450.0, 540.0, 600.0] {
            let curve = (0..101).map(|i| 380.0 + 4.0 * f64::from(i));
            let points = curve.map(|nm| [nm, (-((nm - peak - shift) / 40.0).powi(2)).exp()]).collect();
            let line = Mark::new(Tag(u32::from(slot)), "curve", Shape::Line { points, closed: false });
            panel.marks.push(line.with_stroke(InkRole::Sensor(slot), 2.0));
        }
    }
    let arrow = [[700.0, 0.5], [760.0, 0.5], [730.0, 0.6], [760.0, 0.9], [700.0, 0.9]];
    let concave = Mark::new(Tag(50), "band", Shape::Polygon { points: arrow.to_vec() });
    panel.marks.push(concave.with_fill(Ink::new(InkRole::Sensor(3)).faded(0.4)).with_stroke(InkRole::Sensor(3), 1.0));
    panel
}

fn swatches(area: Rect) -> Panel {
    let mut board = Panel::board("Swatches", area, InkRole::Surround.into());
    for (i, (_, rgb, name)) in PATCHES.iter().enumerate() {
        let left = 100.0 + 90.0 * i as f64;
        let label = Shape::Text {
            at: [left + 42.0, 12.0],
            text: (*name).to_owned(),
            anchor: Anchor::CENTER,
            offset: [0.0, 0.0],
            size: TextSize::Body,
            ink: InkRole::OnSurround.into(),
        };
        board.marks.push(Mark::new(Tag(100), "label", label));
        for row in 0..2 {
            let top = 26.0 + 36.0 * f64::from(row);
            let tag = Tag(100 + 10 * row as u32 + i as u32);
            let shape = Shape::Rect { min: [left, top], max: [left + 86.0, top + 32.0] };
            board.marks.push(Mark::new(tag, *name, shape).with_fill(Ink::rgb(*rgb)));
        }
    }
    for (slot, name) in [(0_usize, "Truth"), (1, "Kodak DCS200")] {
        let at = [12.0, 42.0 + 36.0 * slot as f64];
        let marker = if slot == 0 { Marker::Plus } else { Marker::TriangleUp };
        let key = Shape::Points { points: vec![at], marker, radius: 5.0 };
        board.marks.push(
            Mark::new(Tag(slot as u32), name, key).with_stroke(InkRole::OnSurround, 2.0).with_fill(InkRole::OnSurround),
        );
        let text = Shape::Text {
            at,
            text: name.to_owned(),
            anchor: Anchor::LEFT,
            offset: [9.0, 0.0],
            size: TextSize::Small,
            ink: InkRole::OnSurround.into(),
        };
        board.marks.push(Mark::new(Tag(slot as u32), name, text));
    }
    board
}

fn box_at(x: f64, y: f64, width: f64, height: f64) -> Rect {
    Rect::from_min_size([x, y], [width, height])
}

fn sample() -> Figure {
    let mut figure = Figure::new("Sample", [740.0, 760.0]);
    figure.panels = vec![
        chromaticity(box_at(0.0, 0.0, 740.0, 360.0)),
        strip(box_at(0.0, 370.0, 740.0, 100.0)),
        spectra(box_at(0.0, 480.0, 740.0, 170.0)),
        swatches(box_at(0.0, 660.0, 740.0, 100.0)),
    ];
    figure.legend = legend();
    figure.caption = "Light E, equal energy. White unity. Cameras: Jiang et al. 2013; Stiles and Burch 1955 as truth. \
                      Chromaticities after Eq 13, with M of sRGB."
        .into();
    figure
}

fn legend() -> Vec<LegendEntry> {
    let key = |name: &str, role, width, marker| LegendEntry {
        name: name.to_owned(),
        stroke: Some(Stroke::solid(role, width)),
        marker: Some(marker),
        fill: Some(Ink::new(role)),
    };
    vec![
        key("S&B 1955", InkRole::Reference, 4.0, Marker::Plus),
        key("Canon EOS 10D (2007 figure)", InkRole::Sensor(0), 2.0, Marker::Circle),
        key("Nikon D70 (2007 figure)", InkRole::Sensor(1), 2.0, Marker::Square),
        LegendEntry { fill: None, ..key("Kodak DCS200", InkRole::Sensor(2), 2.0, Marker::TriangleUp) },
    ]
}

/// The last output of a plot shown in a harness.
type Shown = Rc<RefCell<Option<PlotOutput>>>;

const PLOT: egui::Rect = egui::Rect { min: Pos2::new(10.0, 10.0), max: Pos2::new(610.0, 410.0) };

/// A window with a plot; the panel can be exchanged from outside.
fn harness(panel: Panel, dark: bool) -> (Harness<'static, Panel>, Shown) {
    let shown = Shown::default();
    let output = Rc::clone(&shown);
    let theme = if dark { egui::Theme::Dark } else { egui::Theme::Light };
    let mut ready = false;
    // Short steps: clicks must come close together to be a double click.
    let builder = Harness::builder().with_step_dt(0.02).with_size([640.0, 420.0]).with_theme(theme);
    let harness = builder.renderer(Cpu::default()).build_ui_state(
        move |ui, panel: &mut Panel| {
            if !std::mem::replace(&mut ready, true) {
                theme::apply(ui.ctx());
                return;
            }
            let theme = Theme::of(ui.visuals());
            ui.painter().rect_filled(ui.max_rect(), 0.0, theme.panel);
            let id = Id::unique("plot");
            let plot = paint::plot(ui, id, panel, &theme, PLOT, PlotOptions::default());
            *output.borrow_mut() = Some(plot);
        },
        panel,
    );
    (harness, shown)
}

fn view(shown: &Shown) -> View {
    shown.borrow().as_ref().expect("the plot was shown").view
}

#[test]
fn a_figure_becomes_a_picture_in_both_themes() {
    for theme in [Theme::LIGHT, Theme::DARK] {
        let svg = export::svg(&sample(), &theme.colors, Paper::default());
        let picture = export::png(&svg, 1.0).expect("the SVG is well-formed");
        assert_eq!(picture.width(), 740 + 16);
        assert!(picture.height() > 780, "the caption stands below the figure");
        let [r, g, b, _] = theme.plot.to_array();
        let caption = picture.rows().skip(772).flatten().filter(|p| p.0 != [r, g, b, 255]).count();
        assert!(caption > 500, "the caption is drawn in the bundled font: {caption}");
        let filled = picture.get_pixel(400, 50);
        assert_ne!(filled.0, [r, g, b, 255], "the picture inside the diagram is drawn");
    }
}

#[test]
fn a_figure_has_the_width_of_its_paper() {
    let paper = Paper { width_mm: Some(85.0), line_scale: 1.2, ..Paper::default() };
    let svg = export::svg(&sample(), &Theme::LIGHT.colors, paper);
    assert!(svg.contains("width=\"85mm\""));
    let picture = export::png(&svg, 300.0 / 72.0).expect("the SVG is well-formed");
    let expected = 85.0 / 25.4 * 300.0;
    assert!((f64::from(picture.width()) - expected).abs() < 2.0, "{}", picture.width());
    assert!(export::png_file(&picture).is_ok_and(|file| file.starts_with(b"\x89PNG")));
    assert!(export::png(&svg, 1000.0).is_err(), "too large is an error");
    assert!(export::png("<svg", 1.0).is_err());
}

#[test]
fn a_plot_shows_all_the_panel_asks_for() {
    let area = box_at(0.0, 0.0, 600.0, 400.0);
    for panel in [chromaticity(area), strip(area), spectra(area)] {
        let (asked_x, asked_y) = (panel.x.range, panel.y.range);
        let equal = panel.equal_aspect;
        let (mut harness, shown) = harness(panel, true);
        harness.run();
        let view = view(&shown);
        for (asked, seen) in [(asked_x, view.x), (asked_y, view.y)] {
            assert_eq!(asked[0] < asked[1], seen[0] < seen[1], "the direction stays");
            assert!(seen[0].min(seen[1]) <= asked[0].min(asked[1]) + 1e-9);
            assert!(seen[0].max(seen[1]) >= asked[0].max(asked[1]) - 1e-9);
        }
        assert!(PLOT.contains_rect(view.rect));
        if equal {
            let units = (view.at([0.3, 0.3]) - view.at([0.2, 0.2])).abs();
            assert!((units.x - units.y).abs() < 0.05, "{units:?}");
        }
        let there = view.value(view.at([0.4, 0.05]));
        assert!((there[0] - 0.4).abs() < 1.0 && (there[1] - 0.05).abs() < 1e-3, "{there:?}");
    }
}

#[test]
fn a_plot_follows_its_panel_until_the_user_zooms() {
    let area = box_at(0.0, 0.0, 600.0, 400.0);
    let (mut harness, shown) = harness(spectra(area), true);
    harness.run();
    assert_eq!(view(&shown).x, [380.0, 780.0]);
    harness.state_mut().x.range = [400.0, 700.0];
    harness.run();
    assert_eq!(view(&shown).x, [400.0, 700.0]);
    *harness.state_mut() = strip(area);
    harness.run();
    assert_eq!((view(&shown).x, view(&shown).y), ([1040.0, 40.0], [0.0, 0.1]));
}

#[test]
fn dragging_pans_the_wheel_zooms_a_double_click_resets() {
    let (mut harness, shown) = harness(chromaticity(box_at(0.0, 0.0, 600.0, 400.0)), true);
    harness.run();
    let before = view(&shown);
    let middle = before.rect.center();
    harness.hover_at(middle);
    harness.run();
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: Vec2::new(0.0, 100.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: egui::Modifiers::NONE,
    });
    harness.run_steps(30);
    let zoomed = view(&shown);
    let span = |view: &View| [view.x[1] - view.x[0], view.y[1] - view.y[0]];
    assert!(span(&zoomed)[0] < 0.9 * span(&before)[0], "{zoomed:?}");
    assert!((span(&zoomed)[0] / span(&zoomed)[1] - span(&before)[0] / span(&before)[1]).abs() < 1e-3);
    harness.drag_at(middle);
    harness.run_steps(2);
    harness.hover_at(middle + Vec2::new(50.0, 0.0));
    harness.run_steps(2);
    harness.drop_at(middle + Vec2::new(50.0, 0.0));
    harness.run();
    assert!(view(&shown).x[0] < zoomed.x[0], "dragged right, smaller values come in from the left");
    for pressed in [true, false, true, false] {
        harness.event(egui::Event::PointerButton {
            pos: middle,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::NONE,
        });
        harness.step();
    }
    harness.run();
    assert_eq!(view(&shown), before);
}

#[test]
fn the_pointer_finds_points_before_lines() {
    let panel = chromaticity(box_at(0.0, 0.0, 600.0, 400.0));
    let view = View { rect: PLOT, x: [0.1, 0.7], y: [0.15, 0.55] };
    let at = view.at(PATCHES[2].0);
    let hit = paint::nearest(&panel, &view, at + Vec2::new(3.0, 0.0), 8.0).expect("a point is near");
    assert_eq!((hit.tag, hit.index), (Tag(11), 0));
    assert!((hit.distance - 3.0).abs() < 1e-3);
    let on_locus = view.at(locus(0.0)[50]);
    assert_eq!(paint::nearest(&panel, &view, on_locus, 4.0).map(|hit| hit.tag), Some(Tag(0)));
    assert_eq!(paint::nearest(&panel, &view, PLOT.min - Vec2::splat(5.0), 50.0), None);
    let board = swatches(box_at(0.0, 0.0, 600.0, 100.0));
    let view = View { rect: PLOT, x: [0.0, 600.0], y: [400.0, 0.0] };
    let hit = paint::nearest(&board, &view, PLOT.min + Vec2::new(200.0, 40.0), 4.0);
    assert_eq!(hit.map(|hit| (hit.tag, hit.distance)), Some((Tag(101), 0.0)));
}

#[test]
fn everything_is_drawn_with_any_emphasis() {
    for emphasis in [Emphasis::Normal, Emphasis::Hovered, Emphasis::Selected, Emphasis::Related, Emphasis::Faded] {
        let area = box_at(0.0, 0.0, 600.0, 120.0);
        let panels = [chromaticity(area), spectra(area)];
        let board = swatches(area);
        let mut ready = false;
        let mut harness = Harness::builder().with_size([640.0, 460.0]).renderer(Cpu::default()).build_ui(move |ui| {
            if !std::mem::replace(&mut ready, true) {
                theme::apply(ui.ctx());
                return;
            }
            let theme = Theme::of(ui.visuals());
            let place =
                |row: u32| egui::Rect::from_min_size(Pos2::new(10.0, 130.0 * row as f32), Vec2::new(600.0, 120.0));
            let of = move |_| emphasis;
            for (row, panel) in (0..).zip(&panels) {
                let options = PlotOptions { emphasis: &of, zoomable: row == 0, ..PlotOptions::default() };
                paint::plot(ui, Id::unique(("plot", row)), panel, &theme, place(row), options);
            }
            paint::board(ui, Id::unique("board"), &board, &theme, place(2), &of);
            for (i, entry) in (0_u8..).zip(legend()) {
                let rect =
                    egui::Rect::from_min_size(Pos2::new(10.0 + 60.0 * f32::from(i), 400.0), Vec2::new(28.0, 24.0));
                paint::key(ui.painter(), rect, &entry, &theme);
            }
        });
        harness.run();
        let picture = harness.render().expect("the CPU renderer draws");
        let colors: std::collections::HashSet<[u8; 4]> = picture.pixels().map(|p| p.0).collect();
        assert!(colors.len() > 100, "{}", colors.len());
    }
}

#[test]
fn the_pointer_reads_the_nearest_black_body() {
    let (executor, mut window) = crate::screenshots::driven([1280.0, 800.0], egui::Theme::Dark);
    let mut at = egui::pos2(560.0, 240.0);
    let mut rounds = 0;
    let read = loop {
        window.event(egui::Event::PointerMoved(at));
        window.run_steps(1);
        executor.run_all();
        window.run_steps(1);
        let read = window.state().view.point.clone().unwrap_or_default();
        if read.contains("Duv +0.00") || read.contains("Duv −0.00") {
            break read;
        }
        // Not every place is near a blackbody, and some are on a thing.
        at.x += 5.0;
        if at.x > 640.0 {
            at = egui::pos2(400.0, at.y - 9.0);
            if at.y < 220.0 {
                at.y = 330.0;
                rounds += 1;
                assert!(rounds < 2, "no place in the diagram is near a blackbody: {read}");
            }
        }
    };
    let number = |key: &str| -> f64 {
        let rest = read.split(key).nth(1).unwrap_or_else(|| panic!("{key} in {read}"));
        rest.trim().split(' ').next().unwrap().replace('−', "-").parse().unwrap()
    };
    let (x, y, kelvin) = (number("x "), number("y "), number("CCT "));
    // McCamy (1992), good to some percent this near the locus.
    let n = (x - 0.3320) / (0.1858 - y);
    let expected = 449.0 * n.powi(3) + 3525.0 * n * n + 6823.3 * n + 5520.33;
    assert!((kelvin / expected - 1.0).abs() < 0.05, "{read}: {expected}");
}

/// Points of lines and corners of areas that were handed to the painter.
fn handed(shape: &egui::Shape) -> usize {
    match shape {
        egui::Shape::Vec(shapes) => shapes.iter().map(handed).sum(),
        egui::Shape::Path(path) => path.points.len(),
        egui::Shape::Mesh(mesh) => mesh.vertices.len(),
        _ => 1,
    }
}

/// Curves of noise, each as one line, or as many short ones, which are drawn as they are.
fn noise(curves: usize, samples: usize, whole: bool, amplitude: f64) -> Panel {
    let mut panel =
        Panel::new("noise", box_at(0.0, 0.0, 600.0, 300.0), Axis::new("", [0.0, 1.0]), Axis::new("", [0.0, 1.0]));
    for curve in 0..curves {
        let value = |i: usize| {
            let mixed =
                ((i + samples * curve) as u32).wrapping_mul(2_654_435_761).rotate_left(13).wrapping_mul(2_246_822_519);
            let base = 0.5 + 0.2 * (6.0 * i as f64 / samples as f64 + curve as f64).sin();
            base + amplitude * (f64::from(mixed) / f64::from(u32::MAX) - 0.5)
        };
        let points: Vec<[f64; 2]> = (0..samples).map(|i| [i as f64 / (samples - 1) as f64, value(i)]).collect();
        let length = if whole { samples } else { 500 };
        for start in (0..samples).step_by(length) {
            let run = points[start..samples.min(start + length + 1)].to_vec();
            let shape = Shape::Line { points: run, closed: false };
            panel.marks.push(
                Mark::new(Tag(curve as u32 + 1), "noise", shape).with_stroke(InkRole::Sensor(curve as u8 % 8), 1.0),
            );
        }
    }
    panel
}

/// A picture of a panel, and how much was handed to the painter for it.
fn drawn(panel: Panel) -> (image::RgbaImage, usize) {
    let mut ready = false;
    let mut harness = Harness::builder().with_size([640.0, 340.0]).renderer(Cpu::default()).build_ui(move |ui| {
        if !std::mem::replace(&mut ready, true) {
            theme::apply(ui.ctx());
            return;
        }
        let theme = Theme::of(ui.visuals());
        let place = egui::Rect::from_min_size(Pos2::new(20.0, 20.0), Vec2::new(600.0, 300.0));
        paint::still(ui.painter(), &panel, &theme, place);
    });
    harness.run();
    let handed = harness.output().shapes.iter().map(|clipped| handed(&clipped.shape)).sum();
    (harness.render().expect("the CPU renderer draws"), handed)
}

/// The largest difference between two pictures in the mean color of squares of 10 pixels.
fn difference(a: &image::RgbaImage, b: &image::RgbaImage) -> f64 {
    let mean = |picture: &image::RgbaImage, x: u32, y: u32, channel: usize| {
        let sum: u32 = (0..100).map(|i| u32::from(picture.get_pixel(x + i % 10, y + i / 10).0[channel])).sum();
        f64::from(sum) / 100.0
    };
    let squares = (0..a.width() / 10).flat_map(|x| (0..a.height() / 10).map(move |y| (10 * x, 10 * y)));
    squares
        .flat_map(|(x, y)| (0..3).map(move |c| (x, y, c)))
        .map(|(x, y, c)| (mean(a, x, y, c) - mean(b, x, y, c)).abs())
        .fold(0.0, f64::max)
}

#[test]
fn a_line_of_many_points_looks_as_before_and_costs_less() {
    for (amplitude, allowed) in [(0.5, 60.0), (0.01, 50.0), (0.0, 4.0)] {
        let [(now, few), (before, many)] = [true, false].map(|whole| drawn(noise(2, 20_000, whole, amplitude)));
        assert!(few < 6000 && many > 40_000, "{amplitude}: {few} and {many} points");
        let difference = difference(&now, &before);
        assert!(difference < allowed, "{amplitude}: {difference}");
    }
}

/// Two hundred curves of noise of 4,000 samples: what is handed on is bounded by the columns of the screen, what is kept is not.
#[test]
fn many_curves_of_noise_cost_no_more_than_the_screen_has_columns() {
    let panel = noise(200, 4000, true, 0.5);
    let kept: usize = panel
        .marks
        .iter()
        .map(|mark| if let Shape::Line { points, .. } = &mark.shape { points.len() } else { 0 })
        .sum();
    let (_, handed) = drawn(panel);
    assert!(handed < 200 * 4 * 610, "{handed} points");
    assert_eq!(kept, 800_000);
}
