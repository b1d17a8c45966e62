//! Run time against error, both in powers of ten: methods as points, those that no other beats joined by a line.

use chromascope_figure::{
    Anchor, Axis, Dash, InkRole, Label, Labels, Mark, Marker, Panel, Rect, Shape, Tag, TextSize, Ticks, text_width,
};

/// Errors below this are drawn at it: in doubles they are not distinguishable from zero.
pub const LEAST_ERROR: f64 = 1e-18;

/// Maximum number of columns of a list of names.
const COLUMNS: usize = 3;

/// A method's place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Measurement that it stands for.
    pub tag: Tag,
    /// Its error.
    pub error: f64,
    /// Its time in seconds.
    pub seconds: f64,
    /// Ink.
    pub marker: Marker,
    /// In which color.
    pub role: InkRole,
}

impl Place {
    /// True if another beats it in one and is not worse in the other.
    fn is_beaten(&self, others: &[Self]) -> bool {
        others.iter().any(|other| {
            other.seconds <= self.seconds
                && other.error <= self.error
                && (other.seconds < self.seconds || other.error < self.error)
        })
    }

    fn logarithms(&self) -> [f64; 2] {
        [error_of(self.error).log10(), self.seconds.max(LEAST_SECONDS).log10()]
    }
}

/// A dot less is no time.
const LEAST_SECONDS: f64 = 1e-15;

/// The panel in an area. Its axes are the decimal logarithms of error and seconds.
pub fn panel(name: &str, [error_label, time_label]: [&str; 2], note: String, places: &[Place], area: Rect) -> Panel {
    let errors = decades(places.iter().map(|place| place.logarithms()[0]), [-16.0, 0.0]);
    let times = decades(places.iter().map(|place| place.logarithms()[1]), [-9.0, -3.0]);
    let x = Axis::new(error_label, errors).with_ticks(Ticks::At(error_ticks(errors)));
    let y = Axis::new(time_label, times).with_ticks(Ticks::At(time_ticks(times)));
    let mut panel = Panel::new(name, area, x, y);
    panel.note = note;
    let (mut front, rest): (Vec<&Place>, Vec<&Place>) = places.iter().partition(|place| !place.is_beaten(places));
    front.sort_by(|a, b| a.error.total_cmp(&b.error));
    if front.len() > 1 {
        let points = front.iter().map(|place| place.logarithms()).collect();
        let line = Mark::new(Tag::default(), "best methods", Shape::Line { points, closed: false });
        panel.marks.push(line.with_stroke(InkRole::Weak, 1.2).with_dash(Dash::Dashed));
    }
    for (place, on_front) in rest.iter().map(|place| (place, false)).chain(front.iter().map(|place| (place, true))) {
        let points = Shape::Points { points: vec![place.logarithms()], marker: place.marker, radius: 5.0 };
        let mark = Mark::new(place.tag, place.name.clone(), points).with_stroke(place.role, 1.5);
        let filled = on_front && place.marker.has_inside();
        panel.marks.push(if filled { mark.with_fill(place.role) } else { mark });
    }
    let mut panel = panel.with_headroom(4.0);
    // What is on the front is named first: it is what one looks for.
    let order: Vec<&Place> = front.into_iter().chain(rest).collect();
    panel.marks.extend(names(&panel, &order));
    panel
}

/// Names of points, in this order, each written once. Where there is no room beside a point a number stands for the name, which is then in a list;
/// one without room for either is omitted, and shown under the pointer.
fn names(panel: &Panel, places: &[&Place]) -> Vec<Mark> {
    let mut labels = Labels::new(panel);
    let (mut named, mut crowded): (Vec<&str>, Vec<&Place>) = (Vec::new(), Vec::new());
    for place in places {
        if !named.contains(&place.name.as_str()) {
            named.push(&place.name);
            // A leader out of a crowd does not tell well which of its points is named.
            if !labels.place(&Label { starts: Vec::new(), ..label(place, &place.name) }) {
                crowded.push(place);
            }
        }
    }
    // As many in a list as it has room for; what is left takes a leader.
    let listed = (1..=crowded.len()).rev().find_map(|count| Some((with_list(&labels, &crowded[..count])?, count)));
    let (mut labels, count) = listed.unwrap_or((labels, 0));
    for place in &crowded[count..] {
        labels.place(&label(place, &place.name));
    }
    labels.into_marks()
}

fn label(place: &Place, text: &str) -> Label {
    let at = place.logarithms();
    // Above to the right first: the line falls to the right, and passes below.
    let places = chromascope_figure::Place::around(at, [1.0, -0.9], 9.0);
    Label { tag: place.tag, starts: vec![at], ..Label::new(text, InkRole::Text, places) }
}

/// Labels with a number beside each point, and a list of what they stand for; none where there is no room.
fn with_list(labels: &Labels, crowded: &[&Place]) -> Option<Labels> {
    (1..=COLUMNS).find_map(|columns| {
        let (mut labels, mut list) = (labels.clone(), Vec::new());
        // Numbers first: each line of the list is of a point that has one.
        for place in crowded {
            let number = (list.len() + 1).to_string();
            if labels.place(&label(place, &number)) {
                list.push((place.tag, format!("{number}: {}", place.name)));
            }
        }
        (!list.is_empty() && write_list(&mut labels, &list, columns)).then_some(labels)
    })
}

/// Writes lines of text in columns where nothing else is, the lower left corner first. Whether there was room.
fn write_list(labels: &mut Labels, lines: &[(Tag, String)], columns: usize) -> bool {
    const LINE: f64 = 14.0;
    const GAP: f64 = 8.0;
    let widest = lines.iter().map(|(_, line)| text_width(line, TextSize::Small)).fold(0.0, f64::max);
    let (down, across) = (lines.len().div_ceil(columns), widest + GAP);
    let Some([x, y]) = labels.corner([across * columns as f64, LINE * down as f64]) else { return false };
    for (index, (tag, line)) in lines.iter().enumerate() {
        let at = [x + 0.5 * GAP + across * (index / down) as f64, y + LINE * (index % down) as f64];
        let place =
            chromascope_figure::Place { at: labels.projection().value(at), anchor: Anchor::LEFT_TOP, offset: [0.0; 2] };
        labels.place(&Label { tag: *tag, always: true, ..Label::new(line, InkRole::Text, vec![place]) });
    }
    true
}

fn error_of(error: f64) -> f64 {
    if error > LEAST_ERROR { error } else { LEAST_ERROR }
}

/// Whole powers of ten around logarithms, with room beside the outermost.
fn decades(values: impl Iterator<Item = f64>, usual: [f64; 2]) -> [f64; 2] {
    let around = |range: Option<[f64; 2]>, value: f64| {
        Some(range.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]))
    };
    let [low, high] = values.filter(|value| value.is_finite()).fold(None, around).unwrap_or(usual);
    [(low - 0.4).floor(), (high + 0.4).ceil()]
}

fn error_ticks([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let least = LEAST_ERROR.log10() as i32;
    let label =
        |exponent: i32| if exponent == least { "0".to_owned() } else { format!("1e{exponent}").replace('-', "−") };
    (least.max(low as i32)..=high as i32).map(|exponent| (f64::from(exponent), label(exponent))).collect()
}

fn time_ticks([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    (low as i32..=high as i32).map(|exponent| (f64::from(exponent), duration(10_f64.powi(exponent)))).collect()
}

/// A time with three digits in the unit that suits it.
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 0.9995e-6 => (s * 1e9, "ns"),
        s if s < 0.9995e-3 => (s * 1e6, "µs"),
        s if s < 0.9995 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    // A whole number of units is a tick of an axis.
    let decimals = match value {
        v if (v - v.round()).abs() < 1e-9 * v || v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        _ => 2,
    };
    format!("{value:.decimals$} {unit}")
}
