//! Faults of a written figure's texts: on a mark, on another text, beyond the edge, under a halo.

use chromascope_figure::{Rect, TextSize, text_width};

/// What is drawn, in points of the page.
#[derive(Clone, Debug)]
enum Shape {
    Line { points: Vec<[f64; 2]>, half: f64, filled: bool },
    Area(Rect),
    Disk { center: [f64; 2], radius: f64 },
}

/// A shape with the order in which it is drawn, the plot that it shows in, and its name.
#[derive(Clone, Debug)]
struct Drawn {
    shape: Shape,
    order: usize,
    clip: Option<Rect>,
    name: String,
    /// True for one in the color of the ground, such as a halo: it hides texts drawn before it.
    is_ground: bool,
}

#[derive(Clone, Debug)]
struct Text {
    words: String,
    area: Rect,
    order: usize,
    clip: Option<Rect>,
    has_halo: bool,
}

/// Faults of an SVG that [`chromascope_figure::svg`] wrote with these colors of ground and grid lines.
pub(crate) fn faults(svg: &str, ground: &str, grid: &str) -> Vec<String> {
    let (page, texts, marks) = read(svg, ground, grid);
    let mut found = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        let words = &text.words;
        if !text.clip.unwrap_or(page).enlarged(0.5).holds(&text.area) {
            found.push(format!("“{words}” is cut"));
        }
        for other in &texts[..index] {
            let halo = if text.has_halo { 1.0 } else { 0.0 };
            if text.area.enlarged(halo).overlaps(&other.area) {
                found.push(format!("“{words}” on “{}”", other.words));
            }
        }
        let meets = |mark: &&Drawn| {
            let seen = mark.clip.map_or(Some(text.area), |clip| common(clip, text.area));
            (!mark.is_ground || mark.order > text.order) && seen.is_some_and(|area| mark.shape.meets(area))
        };
        found.extend(marks.iter().find(meets).map(|mark| format!("“{words}” on the mark “{}”", mark.name)));
    }
    found
}

impl Shape {
    fn meets(&self, area: Rect) -> bool {
        match self {
            Self::Area(other) => area.overlaps(other),
            Self::Disk { center, radius } => {
                let beyond = [0, 1].map(|i| (area.min[i] - center[i]).max(center[i] - area.max[i]).max(0.0));
                beyond[0].hypot(beyond[1]) < *radius
            }
            Self::Line { points, half, filled } => {
                let area = area.enlarged(*half);
                let close = points.last().copied().filter(|_| *filled).into_iter();
                let path: Vec<[f64; 2]> = close.chain(points.iter().copied()).collect();
                path.windows(2).any(|ends| passes([ends[0], ends[1]], area)) || *filled && holds(&path, area)
            }
        }
    }
}

/// True if a straight line has a part within an area, by halving it.
fn passes([a, b]: [[f64; 2]; 2], area: Rect) -> bool {
    let around = Rect::around([a, b]);
    if !(0..2).all(|i| around.min[i] < area.max[i] && area.min[i] < around.max[i]) {
        return false;
    }
    let middle = [0, 1].map(|i| 0.5 * (a[i] + b[i]));
    let is_short = (a[0] - b[0]).hypot(a[1] - b[1]) < 0.1;
    [a, b, middle].into_iter().any(|at| area.contains(at))
        || !is_short && (passes([a, middle], area) || passes([middle, b], area))
}

/// True if the middle of an area lies within an outline.
fn holds(path: &[[f64; 2]], area: Rect) -> bool {
    let [x, y] = [0, 1].map(|i| 0.5 * (area.min[i] + area.max[i]));
    let crosses =
        |[a, b]: [[f64; 2]; 2]| (a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0];
    path.windows(2).filter(|ends| crosses([ends[0], ends[1]])).count() % 2 == 1
}

fn common(a: Rect, b: Rect) -> Option<Rect> {
    let both = Rect { min: [0, 1].map(|i| a.min[i].max(b.min[i])), max: [0, 1].map(|i| a.max[i].min(b.max[i])) };
    (both.width() > 0.0 && both.height() > 0.0).then_some(both)
}

/// Value of an attribute.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
    line[start..].split('"').next()
}

fn number(line: &str, name: &str) -> f64 {
    attribute(line, name).and_then(|text| text.parse().ok()).unwrap_or(f64::NAN)
}

/// The page, its texts, and its marks.
fn read(svg: &str, ground: &str, grid: &str) -> (Rect, Vec<Text>, Vec<Drawn>) {
    let (mut texts, mut marks) = (Vec::new(), Vec::new());
    let mut groups: Vec<(Option<Rect>, String)> = Vec::new();
    let mut page = None;
    let box_of = |line: &str| {
        Rect::from_min_size([number(line, "x"), number(line, "y")], [number(line, "width"), number(line, "height")])
    };
    let mut clip_path = None;
    for (order, line) in svg.lines().enumerate() {
        if line.starts_with("<clipPath") {
            clip_path = line.find("<rect").map(|start| box_of(&line[start..]));
            continue;
        }
        if line.starts_with("<g") {
            let name = line.split("<title>").nth(1).and_then(|rest| rest.split("</title>").next()).unwrap_or_default();
            groups.push((clip_path.take().or(groups.last().and_then(|group| group.0)), name.to_owned()));
            continue;
        }
        if line == "</g>" {
            groups.pop();
            continue;
        }
        let clip = groups.last().and_then(|group| group.0);
        let name = groups.last().map_or_else(|| "key of the legend".to_owned(), |group| group.1.clone());
        if line.starts_with("<text") {
            texts.push(text(line, order, clip));
            continue;
        }
        let [stroke, fill] = ["stroke", "fill"].map(|of| attribute(line, of).filter(|color| *color != "none"));
        let is_pale = number(line, "fill-opacity") < 0.2;
        let fill = fill.filter(|_| !is_pale);
        let half = if stroke.is_some() { 0.5 * number(line, "stroke-width") } else { 0.0 };
        let shape = if line.starts_with("<rect") {
            if page.is_none() {
                page = Some(box_of(line));
                continue;
            }
            // A rectangle outside of a mark's group is a ground or a frame.
            if groups.len() < 2 {
                continue;
            }
            let area = box_of(line);
            match (fill, stroke) {
                (Some(_), _) => Shape::Area(area.enlarged(half)),
                (None, Some(_)) => {
                    let (min, max) = (area.min, area.max);
                    let points = vec![min, [max[0], min[1]], max, [min[0], max[1]], min];
                    Shape::Line { points, half, filled: false }
                }
                (None, None) => continue,
            }
        } else if line.starts_with("<circle") {
            Shape::Disk { center: [number(line, "cx"), number(line, "cy")], radius: number(line, "r") + half }
        } else if line.starts_with("<path") {
            let mut points = points(attribute(line, "d").unwrap_or_default());
            let closed = attribute(line, "d").is_some_and(|path| path.ends_with('Z'));
            points.extend(points.first().copied().filter(|_| closed));
            Shape::Line { points, half, filled: fill.is_some() }
        } else {
            continue;
        };
        let colors: Vec<&str> = [stroke, fill].into_iter().flatten().collect();
        // Lines of a panel itself are its grid.
        if colors.is_empty() || colors.iter().all(|color| *color == grid) || groups.len() == 1 {
            continue;
        }
        let is_ground = colors.iter().all(|color| *color == ground);
        marks.push(Drawn { shape, order, clip, name, is_ground });
    }
    (page.unwrap_or(Rect { min: [0.0; 2], max: [0.0; 2] }), texts, marks)
}

fn points(path: &str) -> Vec<[f64; 2]> {
    let pairs = path.split(['M', 'L', 'Z']).filter(|pair| !pair.is_empty());
    pairs
        .filter_map(|pair| pair.split_once(' '))
        .filter_map(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?]))
        .collect()
}

fn text(line: &str, order: usize, clip: Option<Rect>) -> Text {
    let inner = line.split_once('>').map_or("", |(_, rest)| rest).trim_end_matches("</text>");
    let words = inner.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&");
    let points = number(line, "font-size");
    let sizes = [TextSize::Small, TextSize::Body, TextSize::Heading, TextSize::Mono];
    let size = sizes.into_iter().find(|size| (f64::from(size.points()) - points).abs() < 0.01).unwrap_or_default();
    let width = text_width(&words, size);
    let along = match attribute(line, "text-anchor") {
        Some("end") => 1.0,
        Some("middle") => 0.5,
        _ => 0.0,
    };
    // Capital letters and digits, and what hangs below the line.
    let hangs = words.chars().any(|c| "gjpqyQµ,;()_/|[]".contains(c));
    let (up, down) = (0.73 * points, if hangs { 0.2 * points } else { 0.0 });
    let [x, y] = [number(line, "x"), number(line, "y")];
    let area = if line.contains("rotate(-90") {
        Rect { min: [x - up, y + along * width - width], max: [x + down, y + along * width] }
    } else {
        Rect { min: [x - along * width, y - up], max: [x + width - along * width, y + down] }
    };
    Text { words, area: area.enlarged(-0.25), order, clip, has_halo: line.contains("paint-order") }
}
