//! Run time against error, both in powers of ten: methods as points, those that no other beats joined by a line.

use chromascope_core::figure::{
    Anchor, Axis, Dash, Ink, InkRole, Mark, Marker, Panel, Rect, Shape, Tag, TextSize, Ticks, text_width,
};

/// Errors below this are drawn there: a double tells them from nothing only by chance.
pub const LEAST_ERROR: f64 = 1e-17;

/// A method's place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// What it stands for.
    pub tag: Tag,
    /// Its error.
    pub error: f64,
    /// Its time in seconds.
    pub seconds: f64,
    /// How it is drawn.
    pub marker: Marker,
    /// In which color.
    pub role: InkRole,
    /// Whether no other method beats it in both.
    pub on_front: bool,
}

/// The panel for an area of the given size. The places on the front come in the order of their errors.
pub fn panel(name: &str, error_label: &str, time_label: &str, places: &[Place], size: [f64; 2]) -> Panel {
    let errors = decades(places.iter().map(|place| error_of(place.error)), [-16.0, 0.0]);
    let times = decades(places.iter().map(|place| place.seconds.max(1e-12)), [-9.0, -3.0]);
    let x = Axis::new(error_label, errors).with_ticks(Ticks::At(error_ticks(errors)));
    let y = Axis::new(time_label, times).with_ticks(Ticks::At(time_ticks(times)));
    let mut panel = Panel::new(name, Rect::from_min_size([0.0, 0.0], size), x, y);
    let at = |place: &Place| [error_of(place.error).log10(), place.seconds.max(1e-12).log10()];
    let front: Vec<[f64; 2]> = places.iter().filter(|place| place.on_front).map(at).collect();
    if front.len() > 1 {
        let line = Shape::Line { points: front, closed: false };
        let mark = Mark::new(Tag::default(), "cheapest for its error", line).with_stroke(InkRole::Weak, 1.2);
        panel.marks.push(mark.with_dash(Dash::Dashed));
    }
    for place in places {
        let points = Shape::Points { points: vec![at(place)], marker: place.marker, radius: 5.0 };
        let mark = Mark::new(place.tag, place.name.clone(), points).with_stroke(place.role, 1.5);
        let filled = place.on_front && place.marker.has_inside();
        panel.marks.push(if filled { mark.with_fill(place.role) } else { mark });
    }
    panel.marks.extend(labels(places, &at, size, errors, times));
    panel
}

fn error_of(error: f64) -> f64 {
    if error > LEAST_ERROR { error } else { LEAST_ERROR }
}

/// Whole powers of ten around values, as exponents, with room beside the outermost.
fn decades(values: impl Iterator<Item = f64>, usual: [f64; 2]) -> [f64; 2] {
    let range =
        values.filter(|value| value.is_finite()).map(f64::log10).fold(None, |range: Option<[f64; 2]>, value| {
            Some(range.map_or([value, value], |[low, high]| [low.min(value), high.max(value)]))
        });
    let [low, high] = range.unwrap_or(usual);
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

/// A time in the unit that suits it, two digits or three.
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 0.9995e-6 => (s * 1e9, "ns"),
        s if s < 0.9995e-3 => (s * 1e6, "µs"),
        s if s < 0.9995 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let decimals =
        if value >= 99.5 || (value - value.round()).abs() < 0.005 * value { 0 } else { usize::from(value < 9.95) };
    format!("{value:.decimals$} {unit}")
}

/// Names beside points, those on the front first; one without room is left out, and read under the pointer.
fn labels(
    places: &[Place],
    at: &dyn Fn(&Place) -> [f64; 2],
    size: [f64; 2],
    errors: [f64; 2],
    times: [f64; 2],
) -> Vec<Mark> {
    // About what axes with labels leave.
    let inner = [(size[0] - 76.0).max(1.0), (size[1] - 44.0).max(1.0)];
    let on_paper = |p: [f64; 2]| {
        [(p[0] - errors[0]) / (errors[1] - errors[0]) * inner[0], (times[1] - p[1]) / (times[1] - times[0]) * inner[1]]
    };
    let around = |p: [f64; 2], r: f64| [p[0] - r, p[1] - r, p[0] + r, p[1] + r];
    let mut taken: Vec<[f64; 4]> = places.iter().map(|place| around(on_paper(at(place)), 6.0)).collect();
    let mut marks = Vec::new();
    let mut order: Vec<&Place> = places.iter().collect();
    order.sort_by_key(|place| !place.on_front);
    for place in order {
        let p = on_paper(at(place));
        let width = text_width(&place.name, TextSize::Small);
        // Above to the right first: the line falls to the right, and passes below.
        let choices = [
            (Anchor::LEFT, [7.0, -9.0], [p[0] + 7.0, p[1] - 16.0]),
            (Anchor::RIGHT, [-9.0, 0.0], [p[0] - 9.0 - width, p[1] - 7.0]),
            (Anchor::RIGHT, [-7.0, 10.0], [p[0] - 7.0 - width, p[1] + 3.0]),
            (Anchor::LEFT, [9.0, 0.0], [p[0] + 9.0, p[1] - 7.0]),
            (Anchor::LEFT, [7.0, 11.0], [p[0] + 7.0, p[1] + 4.0]),
        ];
        let free = choices.into_iter().find(|(_, _, min)| {
            let b = [min[0], min[1], min[0] + width, min[1] + 14.0];
            let inside = b[0] >= 2.0 && b[1] >= 2.0 && b[2] <= inner[0] - 2.0 && b[3] <= inner[1] - 2.0;
            inside && taken.iter().all(|t| b[2] < t[0] || t[2] < b[0] || b[3] < t[1] || t[3] < b[1])
        });
        let Some((anchor, offset, min)) = free else { continue };
        taken.push([min[0], min[1], min[0] + width, min[1] + 14.0]);
        let text = Shape::Text {
            at: at(place),
            text: place.name.clone(),
            anchor,
            offset,
            size: TextSize::Small,
            ink: Ink::new(InkRole::Text),
        };
        marks.push(Mark::new(place.tag, place.name.clone(), text));
    }
    marks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units_that_suit() {
        let all = [1e-9, 1.5e-8, 9.99e-7, 1e-6, 2.5e-6, 1.5e-3, 0.9999, 12.0].map(duration);
        assert_eq!(all, ["1 ns", "15 ns", "999 ns", "1 µs", "2.5 µs", "1.5 ms", "1 s", "12 s"]);
    }

    #[test]
    fn what_has_no_error_has_a_place() {
        let place = |error, seconds| Place {
            name: "a method".to_owned(),
            tag: Tag(1),
            error,
            seconds,
            marker: Marker::Circle,
            role: InkRole::Text,
            on_front: true,
        };
        let panel = panel("p", "error", "time", &[place(0.0, 1e-6), place(1e-3, 0.0)], [400.0, 300.0]);
        let finite = |v: &[f64; 2]| v.iter().all(|v| v.is_finite());
        for mark in &panel.marks {
            if let Shape::Points { points, .. } | Shape::Line { points, .. } = &mark.shape {
                assert!(points.iter().all(finite));
            }
        }
        assert!(finite(&panel.x.range) && finite(&panel.y.range));
    }
}
