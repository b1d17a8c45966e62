//! Figures on paper: what a PDF holds, and what lies where on a page.

use std::io::Read as _;
use std::sync::Arc;

use chromascope_figure::pdf::{PdfFonts, write};
use chromascope_figure::{
    Anchor, Axis, AxisTitles, Figure, Image, Ink, InkRole, LegendEntry, LegendPlace, Mark, Page, PageStyle, Panel,
    Rect, Shape, Stroke, Tag, TextSize,
};

use super::{Gray, written, written_with};

const FONTS: PdfFonts = PdfFonts {
    text: include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
    mono: include_bytes!("../../assets/fonts/DejaVuSansMono.ttf"),
    fallback: include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
};

fn word(text: &str, at: [f64; 2]) -> Mark {
    let shape = Shape::Text {
        at,
        text: text.to_owned(),
        anchor: Anchor::CENTER,
        offset: [0.0; 2],
        size: TextSize::Body,
        ink: InkRole::Text.into(),
    };
    Mark::new(Tag(0), text, shape).with_halo(InkRole::Plot)
}

/// A translucent ground, words with halos, a line that runs far off, a legend.
fn figure() -> Figure {
    let mut figure = Figure::new("A figure", [300.0, 200.0]);
    let area = Rect::from_min_size([0.0, 0.0], figure.size);
    let mut panel = Panel::new("panel", area, Axis::new("u′", [0.0, 1.0]), Axis::new("v′", [0.0, 1.0]));
    let image = Image { width: 2, height: 2, rgba: Arc::from([200, 100, 50, 40].repeat(4)) };
    let ground = Shape::Image { min: [-1.0, -1.0], max: [2.0, 2.0], image };
    panel.marks.push(Mark::new(Tag(0), "ground", ground));
    panel.marks.extend([word("ΔE*00", [0.3, 0.3]), word("λ", [0.5, 0.5]), word("far", [40.0, 0.5])]);
    let line = Shape::Line { points: vec![[-50.0, -50.0], [50.0, 50.0]], closed: false };
    panel.marks.push(Mark::new(Tag(0), "line", line).with_stroke(InkRole::Reference, 2.0));
    let corners = vec![[-9.0, 0.4], [9.0, 0.4], [9.0, 9.0], [-9.0, 9.0]];
    let area = Mark::new(Tag(0), "area", Shape::Polygon { points: corners });
    panel.marks.push(area.with_fill(Ink::new(InkRole::Weak).faded(0.2)));
    figure.panels.push(panel);
    figure.legend = ["one", "another", "third"]
        .map(|name| LegendEntry {
            name: name.to_owned(),
            stroke: Some(Stroke::solid(InkRole::Text, 1.0)),
            marker: None,
            fill: None,
        })
        .to_vec();
    figure.legend_place = LegendPlace::Below;
    figure
}

/// The streams of a PDF, decompressed, each with the dictionary before it.
fn streams(pdf: &[u8]) -> Vec<(String, Vec<u8>)> {
    let find = |from: usize, what: &[u8]| pdf[from..].windows(what.len()).position(|w| w == what).map(|at| from + at);
    let (mut found, mut from) = (Vec::new(), 0);
    while let Some(start) = find(from, b"\nstream\n") {
        let end = find(start, b"endstream").expect("a stream ends");
        let dictionary = String::from_utf8_lossy(&pdf[from..start]);
        let dictionary = dictionary.rsplit(" obj").next().unwrap_or_default().to_owned();
        let mut bytes = pdf[start + 8..end].to_vec();
        if dictionary.contains("FlateDecode") {
            let mut plain = Vec::new();
            let _trailing = flate2::read::ZlibDecoder::new(&*bytes).read_to_end(&mut plain);
            bytes = plain;
        }
        found.push((dictionary, bytes));
        from = end + 9;
    }
    found
}

#[test]
fn a_pdf_embeds_its_fonts_and_says_each_word_once() {
    let figure = figure();
    let layout = PageStyle { width_mm: Some(85.0), ..PageStyle::default() };
    let pdf = write(&figure, &Gray, FONTS, &layout).expect("it can be written");
    assert_eq!(pdf, write(&figure, &Gray, FONTS, &layout).expect("a PDF"), "the same bytes each time");
    assert!(pdf.starts_with(b"%PDF-"));
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.contains("/FontFile") && text.contains("+DejaVuSans"), "a subset is embedded");
    assert!(!text.contains("CreationDate") && !text.contains("ModDate"));
    assert!(pdf.len() < 60_000, "{} bytes: not the whole font of 750 kB", pdf.len());
    let streams = streams(&pdf);
    let all: Vec<String> = streams.iter().map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned()).collect();
    let map = all.iter().find(|text| text.contains("beginbfchar")).expect("glyphs have characters");
    for c in "ΔE*00′λuv".chars() {
        let code = format!("<{:04X}>", u32::from(c));
        assert!(map.contains(&code), "{c} cannot be searched for: {code} in {map}");
    }
    let content = all.iter().find(|text| text.contains(" Tf")).expect("a page");
    let shown = content.matches("Tj").count() + content.matches("TJ").count();
    let words = written(&figure).matches("</text>").count();
    assert_eq!(shown, words, "halos are outlines, not text");
    let images: Vec<_> = streams.iter().filter(|(dictionary, _)| dictionary.contains("/Image")).collect();
    assert_eq!(images.len(), 1, "one picture, without a mask");
    assert!(!images[0].0.contains("SMask"));
}

#[test]
fn a_pdf_has_the_width_it_is_given() {
    for mm in [85.0, 174.0] {
        let layout = PageStyle { width_mm: Some(mm), ..PageStyle::default() };
        let pdf = write(&figure(), &Gray, FONTS, &layout).expect("a PDF");
        let text = String::from_utf8_lossy(&pdf);
        let media = text.split("/MediaBox [").nth(1).and_then(|rest| rest.split(']').next()).expect("a page");
        let width: f64 = media.split_whitespace().nth(2).and_then(|side| side.parse().ok()).expect("a width");
        assert!((width * 25.4 / 72.0 - mm).abs() < 1e-3, "{media} for {mm} mm");
    }
}

#[test]
fn nothing_lies_off_the_page() {
    let figure = figure();
    let page = Page::new(&figure, &PageStyle::default()).area;
    let svg = written_with(&figure, &|_| Some("data:".to_owned()));
    let numbers = |text: &str| -> Vec<f64> {
        text.split(['M', 'L', 'Z', ' '])
            .filter(|part| !part.is_empty())
            .map(|part| part.parse().expect("a number"))
            .collect()
    };
    let paths: Vec<&str> = svg.split(" d=\"").skip(1).map(|rest| rest.split('"').next().unwrap_or_default()).collect();
    assert!(paths.len() > 5);
    for point in paths.iter().flat_map(|path| numbers(path).chunks(2).map(<[f64]>::to_vec).collect::<Vec<_>>()) {
        let inside = (0..2).all(|axis| (page.min[axis]..=page.max[axis]).contains(&point[axis]));
        assert!(inside, "{point:?} is off {page:?}");
    }
    assert!(!svg.contains(">far</text>"), "a word off the plot is not written");
    assert_eq!(svg.matches(">λ</text>").count(), 1);
    assert!(svg.contains("paint-order=\"stroke\""));
}

#[test]
fn a_translucent_ground_becomes_opaque_under_the_grid() {
    let seen = std::cell::RefCell::new(Vec::new());
    let encode = |image: &Image| {
        seen.borrow_mut().push(image.clone());
        Some("data:".to_owned())
    };
    let svg = written_with(&figure(), &encode);
    let image = seen.borrow()[0].clone();
    let over = |value: f64| (255.0 + 40.0 / 255.0 * (value - 255.0)).round() as u8;
    let expected = [over(200.0), over(100.0), over(50.0), 255];
    assert!(image.rgba.chunks_exact(4).all(|pixel| pixel == expected), "over white");
    assert!(image.width > 300, "a coarse ground is refined");
    let [picture, grid] =
        ["<image", "stroke=\"#141414\" stroke-width=\"1\""].map(|what| svg.find(what).expect("it is drawn"));
    assert!(picture < grid);
}

#[test]
fn a_legend_below_and_titles_outside_enlarge_the_page() {
    let mut figure = figure();
    let height = |figure: &Figure, style: &PageStyle| Page::new(figure, style).area.height();
    let style = PageStyle::default();
    let below = height(&figure, &style);
    let outside = PageStyle { axis_titles: AxisTitles::Outside, ..style };
    figure.legend_place = LegendPlace::None;
    assert!(height(&figure, &style) < below - 20.0);
    assert!(height(&figure, &outside) > height(&figure, &style) + 10.0);
    assert!(Page::new(&figure, &outside).area.width() > Page::new(&figure, &style).area.width() + 10.0);
    assert!(!written(&figure).contains(">third<"));
    let none = PageStyle { axis_titles: AxisTitles::None, ..style };
    let svg = |style: &PageStyle| {
        let fonts = chromascope_figure::svg::SvgStyle { font_family: "a", mono_family: "b", encode: &super::no_image };
        chromascope_figure::svg::write(&figure, &Gray, &fonts, style)
    };
    assert!(svg(&style).contains(">u′<") && !svg(&none).contains(">u′<"));
    assert!(svg(&outside).contains("rotate(-90"), "the title of y runs upward");
}

#[test]
fn a_legend_inside_covers_no_point_and_stands_below_where_none_is_free() {
    let mut figure = figure();
    let page = |figure: &Figure| Page::new(figure, &PageStyle::default()).area.height();
    figure.panels[0].marks = vec![word("a word", [0.1, 0.9])];
    let below = page(&figure);
    figure.legend_place = LegendPlace::Inside;
    assert!(page(&figure) < below - 20.0, "a corner is free");
    let points = (0..100).map(|i| [f64::from(i % 10) / 9.0, f64::from(i / 10) / 9.0]).collect();
    figure.panels[0].marks.push(Mark::new(Tag(0), "all over", Shape::Line { points, closed: false }));
    assert_eq!(page(&figure), below, "none is");
}

#[test]
fn a_legend_below_a_narrow_figure_has_as_few_rows_as_fit() {
    let mut figure = figure();
    let entry = figure.legend[0].clone();
    let names = ["CIE 1931 2° (reference)", "Canon EOS 5D Mark II", "Nikon D70 (A.M.P.A.S.)", "Kodak DCS200"];
    figure.legend = names.map(|name| LegendEntry { name: name.to_owned(), ..entry.clone() }).to_vec();
    let height = |width: f64| {
        let figure = Figure { size: [width, 200.0], ..figure.clone() };
        let area = Page::new(&figure, &PageStyle::default()).area;
        assert!(area.width() <= width + 16.5, "{width} {}", area.width());
        area.height()
    };
    let [wide, column, narrow] = [1000.0, 375.0, 250.0].map(height);
    assert!(wide + 15.0 < column && column + 30.0 < narrow, "one row, two rows, four rows: {wide} {column} {narrow}");
}

#[test]
fn titles_of_y_stay_in_the_plot_where_they_are_longer_than_it_is_high() {
    let mut figure = figure();
    let outside = PageStyle { axis_titles: AxisTitles::Outside, ..PageStyle::default() };
    let width = |figure: &Figure| Page::new(figure, &outside).area.width();
    let beside = width(&figure);
    figure.panels[0].y.label = "a quantity whose name is longer than its plot is high".to_owned();
    assert!(width(&figure) < beside);
}
