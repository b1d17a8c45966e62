//! Figures: where ticks stand, how points are laid out, what is written.

use std::sync::Arc;

use chromascope_figure::{
    Anchor, Axis, Cell, Dash, Field, Figure, Image, Ink, InkRole, LegendEntry, LegendPlace, MIN_LABEL_SPACING, Mark,
    Marker, MarkerOutline, PageStyle, Palette, Panel, Projection, Rect, Shape, Stroke, Table, Tag, TextSize, Ticks,
    annotations, auto_ticks, finite_runs, fit_equal, svg, text_width, wrapped,
};
use proptest::prelude::*;

mod faults;
mod labels;
mod number;
mod pdf;

struct Gray;

impl Palette for Gray {
    fn rgb(&self, role: InkRole) -> [u8; 3] {
        match role {
            InkRole::Rgb(rgb) => rgb,
            InkRole::Plot => [255; 3],
            InkRole::Sensor(slot) => [slot; 3],
            _ => [20; 3],
        }
    }
}

fn no_image(_: &Image) -> Option<String> {
    None
}

fn written_with(figure: &Figure, encode: &dyn Fn(&Image) -> Option<String>) -> String {
    let style = svg::SvgStyle { font_family: "DejaVu Sans", mono_family: "DejaVu Sans Mono", encode };
    svg::write(figure, &Gray, &style, &PageStyle::default())
}

fn written(figure: &Figure) -> String {
    written_with(figure, &no_image)
}

fn with_mark(mark: Mark) -> Figure {
    let area = Rect::from_min_size([0.0, 0.0], [300.0, 200.0]);
    let mut panel = Panel::new("panel", area, Axis::new("x", [0.0, 1.0]), Axis::new("y", [0.0, 1.0]));
    panel.marks.push(mark);
    let mut figure = Figure::new("A figure", [300.0, 200.0]);
    figure.panels.push(panel);
    figure
}

fn labels(range: [f64; 2], length: f64) -> Vec<String> {
    auto_ticks(range, length).into_iter().map(|tick| tick.label).collect()
}

/// Every element that is opened is closed in the right order.
fn assert_balanced(svg: &str) {
    let mut open: Vec<String> = Vec::new();
    for tag in svg.split('<').skip(1) {
        let inner = tag.split('>').next().expect("split yields at least one part");
        let name = inner.split_whitespace().next().unwrap_or("").trim_end_matches('/');
        if let Some(closed) = name.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(closed), "in {svg}");
        } else if !inner.ends_with('/') {
            open.push(name.to_owned());
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
}

#[test]
fn ticks_are_round_and_have_the_decimals_they_need() {
    assert_eq!(labels([0.0, 0.8], 640.0), ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8"]);
    assert_eq!(labels([380.0, 780.0], 400.0), ["400", "500", "600", "700"]);
    assert_eq!(labels([0.1, 0.0], 75.0), ["0.0", "0.1"]);
    assert_eq!(labels([-1.0, 1.0], 120.0), ["−1", "0", "1"]);
    assert_eq!(labels([0.0, 4e-7], 130.0), ["0", "2e-7", "4e-7"]);
    assert_eq!(labels([0.0, 3e9], 190.0), ["0", "1e9", "2e9", "3e9"]);
}

#[test]
fn a_range_without_round_numbers_still_has_a_tick() {
    assert_eq!(labels([0.17, 0.48], 55.0), ["0.2"]);
    assert_eq!(auto_ticks([f64::NAN, 1.0], 10.0).len(), 1);
    assert_eq!(auto_ticks([3.0, 3.0], 0.0).len(), 1);
}

#[test]
fn crowded_given_ticks_are_left_out_between_the_ends_first() {
    let at = [(1000.0, "1000 K"), (60.0, "17000 K"), (200.0, "5000 K"), (50.0, "20000 K")];
    let axis = Axis::new("mired", [1000.0, 50.0]).with_ticks(Ticks::At(at.map(|(v, s)| (v, s.to_owned())).to_vec()));
    let ticks = axis.ticks_over(axis.range, 600.0);
    let read: Vec<(f64, &str)> = ticks.iter().map(|t| (t.value, t.label.as_str())).collect();
    assert_eq!(read, [(50.0, "20000 K"), (200.0, "5000 K"), (1000.0, "1000 K")]);
}

#[test]
fn ticks_of_an_axis_have_the_same_decimals() {
    assert_eq!(
        labels([-0.25, 0.3], 700.0),
        ["−0.25", "−0.20", "−0.15", "−0.10", "−0.05", "0.00", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30"]
    );
}

#[test]
fn zero_is_labeled_before_its_neighbors() {
    let at = [-0.4, 0.0, 1.0].map(|value| (value, format!("{value:.1}")));
    let axis = Axis::new("", [-0.4, 1.0]).with_ticks(Ticks::At(at.to_vec()));
    let read: Vec<String> = axis.ticks_over(axis.range, 70.0).into_iter().map(|tick| tick.label).collect();
    assert_eq!(read, ["0.0", "1.0"]);
}

#[test]
fn wide_labels_at_an_end_push_others_away() {
    let at = Ticks::At(vec![(0.8, "5000 K".to_owned()), (1.0, "20000 K".to_owned())]);
    let axis = Axis::new("", [0.0, 1.0]).with_ticks(at);
    let labelled = |length| axis.ticks_over(axis.range, length).iter().filter(|t| !t.label.is_empty()).count();
    assert_eq!((labelled(330.0), labelled(500.0)), (1, 2));
}

proptest! {
    #[test]
    fn ticks_lie_inside_in_order_and_apart(
        start in -1e6..1e6_f64, scale in -9..6_i32, unit in 0.1..1.0_f64, length in 1.0..3000.0_f64,
        flip in any::<bool>(),
    ) {
        let span = unit * 10_f64.powi(scale);
        let range = if flip { [start + span, start] } else { [start, start + span] };
        let (low, high) = (range[0].min(range[1]), range[0].max(range[1]));
        let ticks = auto_ticks(range, length);
        prop_assert!(!ticks.is_empty());
        prop_assert!(ticks.iter().all(|t| (low..=high).contains(&t.value)));
        prop_assert!(ticks.iter().all(|t| !t.label.is_empty()));
        let points_per_unit = length / (high - low);
        for pair in ticks.windows(2) {
            let gap = (pair[1].value - pair[0].value) * points_per_unit;
            prop_assert!(gap >= MIN_LABEL_SPACING * (1.0 - 1e-3), "{gap}");
            prop_assert_ne!(&pair[0].label, &pair[1].label);
        }
    }

    #[test]
    fn labels_read_back_as_their_values(low in -1e4..1e4_f64, span in 1e-2..1e5_f64) {
        for tick in auto_ticks([low, low + span], 500.0) {
            let read: f64 = tick.label.replace('−', "-").parse().expect("a number");
            prop_assert!((read - tick.value).abs() <= 1e-9 * span, "{} {}", tick.label, tick.value);
        }
    }

    #[test]
    fn equal_units_only_ever_enlarge(
        x in prop::array::uniform2(-1e3..1e3_f64), y in prop::array::uniform2(-1e3..1e3_f64),
        width in 1.0..2000.0_f64, height in 1.0..2000.0_f64,
    ) {
        prop_assume!((x[0] - x[1]).abs() > 1e-6 && (y[0] - y[1]).abs() > 1e-6);
        let (fx, fy) = fit_equal(x, y, [width, height]);
        for (before, after) in [(x, fx), (y, fy)] {
            prop_assert_eq!(before[0] < before[1], after[0] < after[1]);
            prop_assert!(after[0].min(after[1]) <= before[0].min(before[1]) + 1e-9);
            prop_assert!(after[0].max(after[1]) >= before[0].max(before[1]) - 1e-9);
        }
        let units = [(fx[1] - fx[0]).abs() / width, (fy[1] - fy[0]).abs() / height];
        prop_assert!((units[0] / units[1] - 1.0).abs() < 1e-9);
    }

    #[test]
    fn numbers_survive_csv(values in prop::collection::vec(any::<f64>(), 1..20)) {
        let mut table = Table::new(["v"]);
        for value in &values {
            table.push([Cell::Number(*value)]);
        }
        let csv = table.to_csv();
        let read: Vec<&str> = csv.lines().skip(1).collect();
        prop_assert_eq!(read.len(), values.len());
        for (text, value) in read.iter().zip(&values) {
            if value.is_finite() {
                prop_assert_eq!(text.parse::<f64>(), Ok(*value));
            } else {
                prop_assert!(text.is_empty());
            }
        }
    }

    #[test]
    fn any_text_is_escaped(text in any::<String>()) {
        let escaped = svg::escape(&text);
        let forbidden = ['<', '>', '"', '\u{0}', '\u{1b}'];
        prop_assert!(!escaped.contains(forbidden));
        let mark = Mark::new(Tag(0), text.clone(), Shape::Text {
            at: [0.5, 0.5], text, anchor: Anchor::CENTER, offset: [0.0, 0.0],
            size: TextSize::Body, ink: InkRole::Text.into(),
        });
        assert_balanced(&written(&with_mark(mark)));
    }

    #[test]
    fn nothing_that_is_not_finite_is_written(points in prop::collection::vec(
        prop::array::uniform2(prop_oneof![any::<f64>(), -1.0..2.0_f64]), 0..12,
    )) {
        let shapes = [
            Shape::Line { points: points.clone(), closed: true },
            Shape::Gradient { points: points.iter().map(|p| (*p, [1, 2, 3])).collect() },
            Shape::Points { points: points.clone(), marker: Marker::Hexagon, radius: 4.0 },
            Shape::Polygon { points: points.clone() },
            Shape::Segments { segments: points.windows(2).map(|w| [w[0], w[1]]).collect() },
        ];
        for shape in shapes {
            let mark = Mark::new(Tag(1), "m", shape).with_stroke(InkRole::Reference, 2.0)
                .with_fill(InkRole::Sensor(3)).with_halo(InkRole::Plot);
            let svg = written(&with_mark(mark));
            prop_assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", svg);
            assert_balanced(&svg);
        }
    }
}

#[test]
fn a_gap_breaks_a_line_in_two() {
    let points = [[0.0, 0.0], [0.1, 0.1], [f64::NAN, 0.0], [0.3, 0.3], [0.4, 0.4]];
    let runs: Vec<usize> = finite_runs(&points).map(<[_]>::len).collect();
    assert_eq!(runs, [2, 2]);
    let mark = Mark::new(Tag(0), "locus", Shape::Line { points: points.to_vec(), closed: true })
        .with_stroke(InkRole::Reference, 7.0);
    let svg = written(&with_mark(mark));
    assert!(svg.contains("<g><title>locus</title>"));
    assert_eq!(svg.matches("stroke-width=\"7\"").count(), 2);
    assert!(!svg.contains('Z'), "an interrupted outline is not closed");
}

#[test]
fn a_panel_is_laid_out_left_to_right_and_upward() {
    let figure = with_mark(Mark::new(Tag(0), "", Shape::Rect { min: [0.0, 0.0], max: [1.0, 1.0] }));
    let projection = Projection::new(&figure.panels[0], 1.0);
    assert_eq!(projection.plot, Rect { min: [Projection::LEFT, 0.0], max: [300.0, 200.0 - Projection::BOTTOM] });
    assert_eq!(projection.at([0.0, 0.0]), [Projection::LEFT, 176.0]);
    assert_eq!(projection.at([1.0, 1.0]), [300.0, 0.0]);
}

#[test]
fn a_board_is_points_downward_from_its_corner() {
    let board = Panel::board("b", Rect::from_min_size([10.0, 20.0], [100.0, 50.0]), InkRole::Surround.into());
    let projection = Projection::new(&board, 1.0);
    assert_eq!(projection.at([0.0, 0.0]), [10.0, 20.0]);
    assert_eq!(projection.at([100.0, 50.0]), [110.0, 70.0]);
}

#[test]
fn a_document_has_title_axes_legend_and_caption() {
    let points = Shape::Points { points: vec![[0.5, 0.5]], marker: Marker::Circle, radius: 5.0 };
    let mut figure = with_mark(
        Mark::new(Tag(0), "red & <orange>", points)
            .with_stroke(InkRole::Sensor(5), 2.0)
            .with_dash(Dash::Dashed)
            .with_fill(Ink::rgb([10, 200, 30]).faded(0.5)),
    );
    figure.legend.push(LegendEntry {
        name: "Canon".to_owned(),
        stroke: Some(Stroke::solid(InkRole::Sensor(0), 2.0)),
        marker: Some(Marker::source(0)),
        fill: None,
    });
    figure.caption = "Light E. ".repeat(40);
    let svg = written(&figure);
    assert_balanced(&svg);
    for part in [
        "<title>A figure</title>",
        "<title>red &amp; &lt;orange&gt;</title>",
        "fill=\"#0ac81e\" fill-opacity=\"0.5\"",
        "stroke=\"#050505\" stroke-width=\"2\"",
        "stroke-dasharray=\"7 5\"",
        ">Canon</text>",
        ">0.5</text>",
        "font-family=\"DejaVu Sans\"",
        "clip-path=\"url(#panel0)\"",
    ] {
        assert!(svg.contains(part), "{part} is missing in {svg}");
    }
    assert!(svg.matches(">Light E.").count() >= 3, "the caption is wrapped");
    figure.legend_place = LegendPlace::Outside;
    assert_ne!(written(&figure), svg);
}

#[test]
fn pictures_go_through_the_encoder() {
    let image = Image { width: 1, height: 1, rgba: Arc::from([1, 2, 3, 255]) };
    let broken = Image { width: 2, ..image.clone() };
    let encode = |image: &Image| Some(format!("data:{}", image.rgba[1]));
    for (image, expected) in [(image, true), (broken, false)] {
        let shape = Shape::Image { min: [0.0, 0.0], max: [1.0, 1.0], image };
        let figure = with_mark(Mark::new(Tag(0), "", shape));
        let svg = written_with(&figure, &encode);
        assert_eq!(svg.contains("href=\"data:2\""), expected);
    }
}

#[test]
fn a_tables_text_is_quoted_where_it_must_be() {
    let mut table = Table::new(["name", "x", "note"]);
    table.push(["a, \"b\"".into(), 0.1.into(), Cell::Empty]);
    table.push(["c".into(), Cell::Number(1.0 / 3.0)]);
    assert_eq!(table.to_csv(), "name,x,note\n\"a, \"\"b\"\"\",0.1,\nc,0.3333333333333333,\n");
    assert_eq!(table.to_tsv().lines().nth(1), Some("\"a, \"\"b\"\"\"\t0.1\t"));
}

/// A quantity with its uncertainty.
type Measured = (&'static str, f64, f64);

const COLUMNS: [Field<Measured>; 2] = [
    Field::new("name", |(name, ..)| (*name).into()),
    Field::quantity(["length_mm", "length", "mm"], |(_, value, by)| {
        Cell::from(*value).with(|note| note.uncertainty = Some(*by))
    }),
];

#[test]
fn a_column_is_one_entry_for_text_csv_and_tabs() {
    let rows = [("a", 12.3456, 0.21), ("b, c", 4.0, 0.013)];
    let mut table = Table::of(&COLUMNS, rows);
    table.insert(2, "note", [Cell::Missing("not measured".to_owned())]);
    assert_eq!(table.to_text(), "name  length [mm]  note\na          12.35      –\nb, c        4.000     –\n");
    table.columns[1].uncertainty = "length_mm_uncertainty".to_owned();
    let text = "name     length [mm]  note\na     12.35  ± 0.21      –\nb, c   4.000 ± 0.013     –\n";
    assert_eq!(table.to_text(), text);
    assert_eq!(table.to_csv(), "name,length_mm,length_mm_uncertainty,note\na,12.3456,0.21,\n\"b, c\",4,0.013,\n");
    assert_eq!(table.to_tsv().lines().nth(2), Some("b, c\t4\t0.013\t"));
    assert_eq!((table.cell(0, 2).hint(), table.cell(1, 1).in_words().as_str()), ("not measured", "4.000 ± 0.013"));
    assert_eq!(table.part(&[1], &[1]).to_csv(), "length_mm,length_mm_uncertainty\n4,0.013\n");
}

#[test]
fn sixteen_sources_differ_in_color_or_marker() {
    let keys: Vec<(usize, Marker)> = (0..16).map(|slot| (slot % 8, Marker::source(slot))).collect();
    assert!(keys.iter().enumerate().all(|(i, key)| !keys[..i].contains(key)));
    assert_eq!(Marker::source(8), Marker::TriangleDown);
    assert_eq!([Marker::observer(0), Marker::observer(1)], [Marker::Cross, Marker::Asterisk]);
}

#[test]
fn markers_stay_near_their_radius() {
    let sources = (0..8).map(Marker::source);
    for marker in sources.chain([Marker::Plus, Marker::Cross, Marker::Asterisk, Marker::Dot]) {
        let corners: Vec<[f64; 2]> = match marker.outline() {
            MarkerOutline::Disk(radius) => vec![[radius, 0.0]],
            MarkerOutline::Area(corners) => corners,
            MarkerOutline::Strokes(lines) => lines.into_flattened(),
        };
        let reach = corners.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        assert!((0.5..=1.45).contains(&reach), "{marker:?} {reach}");
        assert_eq!(marker.has_inside(), !matches!(marker.outline(), MarkerOutline::Strokes(_)));
    }
}

#[test]
fn notes_and_labels_do_not_meet() {
    let area = Rect::from_min_size([0.0, 0.0], [220.0, 200.0]);
    let mut panel =
        Panel::new("p", area, Axis::new("wavelength (nm)", [0.0, 1.0]), Axis::new("relative power", [0.0, 1.0]));
    panel.note = "distance to truth over temperature".to_owned();
    let placed = annotations(&panel, area, 1.0);
    assert_eq!(placed.len(), 3);
    assert!(placed[1].at[1] > placed[0].at[1] + 11.5, "the note moves below the label");
    assert!(text_width("mmm", TextSize::Body) > text_width("iii", TextSize::Body));
    assert_eq!(wrapped("one two three", TextSize::Body, 60.0), ["one two", "three"]);
    // What belongs together stays in one line.
    for (lead, bound) in
        [("whiskers:", "± u"), ("with", "τ = 10 µm"), ("of 14;", "† extrapolated"), ("Canon", "5D III")]
    {
        let width =
            text_width(&format!("{lead} {}", bound.rsplit_once(' ').map_or(bound, |(head, _)| head)), TextSize::Body)
                + 1.0;
        let room = width.max(text_width(bound, TextSize::Body));
        assert_eq!(wrapped(&format!("{lead} {bound}"), TextSize::Body, room), [lead, bound]);
    }
}

#[test]
fn constants_stand_at_the_end_of_every_row() {
    let mut table = Table::new(["a", "b"]);
    table.push([Cell::from(1.0), Cell::from(2.0)]);
    table.push([Cell::from(3.0)]);
    let table = table.with_constants([("light", "E, equal".to_owned())]);
    assert_eq!(table.to_csv(), "a,b,light\n1,2,\"E, equal\"\n3,,\"E, equal\"\n");
}

#[test]
fn a_text_begins_where_its_anchor_says() {
    let attribute = |line: &str, name: &str| {
        line.split_once(&format!(" {name}=\""))
            .and_then(|(_, rest)| rest.split('"').next())
            .unwrap_or_default()
            .to_owned()
    };
    let left = |anchor: f64| {
        let words = "Kodak DCS200";
        let mark = Mark::text(words, [0.5, 0.5], Anchor(anchor, 0.0), TextSize::Small, InkRole::Text);
        let svg = written(&with_mark(mark));
        let line = svg.lines().find(|line| line.starts_with("<text") && line.contains(words)).expect("written");
        let share = match attribute(line, "text-anchor").as_str() {
            "start" => 0.0,
            "middle" => 0.5,
            _ => 1.0,
        };
        attribute(line, "x").parse::<f64>().expect("a number") - share * text_width(words, TextSize::Small)
    };
    let width = text_width("Kodak DCS200", TextSize::Small);
    for anchor in [0.1, 0.2, 0.37, 0.5, 0.63, 0.8, 0.95, 1.0] {
        assert!((left(0.0) - left(anchor) - anchor * width).abs() < 0.02, "{anchor}");
    }
}

#[test]
fn tables_are_written_as_latex() {
    let mut table = Table::new(["metric", "A", "A uncertainty", "light"]);
    for (name, value, by) in [("ΔE*00 95 %", 2.043, 0.21), ("x_y", -0.5, 0.04)] {
        table.push([name.into(), Cell::from(value).with(|note| note.uncertainty = Some(by)), by.into(), "D65".into()]);
    }
    let rows = "metric & A \\\\\n\\midrule\n$\\Delta$E*00 95 \\% & 2.04 $\\pm$ 0.21 \\\\\nx\\_y & $-$0.500 $\\pm$ 0.040 \\\\\n";
    let text = table.to_latex("A & B");
    assert!(text.contains(rows) && text.contains("\\caption{A \\& B. light: D65.}") && text.contains("{lr}"), "{text}");
}
