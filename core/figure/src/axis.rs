//! Axes, and where their ticks stand.

use super::mark::TextSize;
use super::text::text_width;

/// The smallest distance between tick labels, in points.
pub const MIN_LABEL_SPACING: f64 = 60.0;

/// A linear axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit, or a symbol of at most two characters. Symbols of x stand in the plot's corner, all else below
    /// its tick labels.
    pub label: String,
    /// Value at the left or bottom end, value at the right or top end. The first may be the larger one.
    pub range: [f64; 2],
    /// Its ticks.
    pub ticks: Ticks,
    /// True if a grid line is drawn at each tick.
    pub grid: bool,
}

/// Ticks of an axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Ticks {
    /// None, and no room for labels.
    None,
    /// Round numbers, as many as there is room for.
    #[default]
    Auto,
    /// At the given values with the given labels. Those whose labels are too close to others are omitted.
    At(Vec<(f64, String)>),
}

/// A tick of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Value at the tick.
    pub value: f64,
    /// Label; empty where there is no room.
    pub label: String,
}

impl Axis {
    /// An axis with automatic ticks and a grid.
    pub fn new(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self { label: label.into(), range, ticks: Ticks::Auto, grid: true }
    }

    /// An invisible axis.
    pub fn hidden(range: [f64; 2]) -> Self {
        Self { label: String::new(), range, ticks: Ticks::None, grid: false }
    }

    /// Axis with the given ticks.
    #[must_use]
    pub fn with_ticks(self, ticks: Ticks) -> Self {
        Self { ticks, ..self }
    }

    /// Axis with or without grid lines.
    #[must_use]
    pub fn with_grid(self, grid: bool) -> Self {
        Self { grid, ..self }
    }

    /// True if the label of a horizontal axis is a line of its own below the tick labels.
    pub fn has_title_line(&self) -> bool {
        self.ticks != Ticks::None && self.label.chars().count() > 2
    }

    /// The range, or one of length 1 around its value (around 0.5 if it has none) where it has no length.
    pub fn proper_range(&self) -> [f64; 2] {
        proper(self.range)
    }

    /// Ticks inside `range`, in ascending order, for an axis drawn `length` points long. Labels stand
    /// [`MIN_LABEL_SPACING`] apart; given ones as close as their widths allow.
    pub fn ticks_over(&self, range: [f64; 2], length: f64) -> Vec<Tick> {
        self.spaced(range, length, if matches!(self.ticks, Ticks::At(_)) { 0.0 } else { MIN_LABEL_SPACING })
    }

    fn spaced(&self, range: [f64; 2], length: f64, spacing: f64) -> Vec<Tick> {
        let range = proper(range);
        let mut ticks = match &self.ticks {
            Ticks::None => Vec::new(),
            Ticks::Auto => auto_ticks(range, length),
            Ticks::At(at) => inside(at, range),
        };
        thin_out(&mut ticks, range, length, spacing);
        // A grid line without a number tells nothing.
        ticks.retain(|tick| self.ticks == Ticks::Auto || !tick.label.is_empty());
        ticks
    }

    /// Ticks of a vertical axis drawn `length` points long. Labels given for it may stand closer, and others where fewer than
    /// three would be left: lines of text are low.
    pub fn vertical_ticks_over(&self, range: [f64; 2], length: f64) -> Vec<Tick> {
        let stretch = if matches!(self.ticks, Ticks::At(_)) { 3.5 } else { 1.0 };
        let ticks = self.spaced(range, stretch * length, MIN_LABEL_SPACING);
        if self.ticks != Ticks::Auto || ticks.len() > 2 {
            return ticks;
        }
        self.spaced(range, 2.0 * length, MIN_LABEL_SPACING)
    }
}

pub(super) fn proper(range: [f64; 2]) -> [f64; 2] {
    let [start, end] = range;
    match (start.is_finite() && end.is_finite() && (end - start).is_finite(), start == end) {
        (true, false) => range,
        (true, true) => [start - 0.5, start + 0.5],
        (false, _) => [0.0, 1.0],
    }
}

/// A step of 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy)]
struct Step {
    mantissa: f64,
    exponent: i32,
}

impl Step {
    /// The smallest step that is not below `least`.
    fn at_least(least: f64) -> Self {
        let exponent = least.log10().floor() as i32;
        [(1.0, 0), (2.0, 0), (5.0, 0), (1.0, 1), (2.0, 1)]
            .into_iter()
            .map(|(mantissa, up)| Self { mantissa, exponent: exponent + up })
            .find(|step| step.value() >= least)
            .unwrap_or(Self { mantissa: 5.0, exponent: exponent + 1 })
    }

    fn finer(self) -> Self {
        let Self { mantissa, exponent } = self;
        match mantissa {
            5.0 => Self { mantissa: 2.0, exponent },
            2.0 => Self { mantissa: 1.0, exponent },
            _ => Self { mantissa: 5.0, exponent: exponent - 1 },
        }
    }

    fn value(self) -> f64 {
        self.times(1.0)
    }

    /// Dividing by a power of ten is exact where multiplying by its inverse is not.
    fn times(self, count: f64) -> f64 {
        let scale = 10_f64.powi(self.exponent.abs());
        if self.exponent < 0 { count * self.mantissa / scale } else { count * self.mantissa * scale }
    }

    fn multiples(self, low: f64, high: f64) -> Vec<f64> {
        let step = self.value();
        // A tolerance, or 0.3 is lost at the end of a range from 0 to 0.3.
        let slack = 1e-9;
        let first = (low / step - slack).ceil();
        let last = (high / step + slack).floor();
        let count = if (last - first).is_finite() { (last - first + 1.0).clamp(0.0, 10_000.0) } else { 0.0 };
        let mut values: Vec<f64> = (0..count as usize).map(|i| self.times(first + i as f64).clamp(low, high)).collect();
        values.dedup();
        values
    }

    /// Value with the decimals of the step, the same for every multiple of it, 0 too.
    fn label(self, value: f64) -> String {
        let magnitude = if value == 0.0 { self.exponent } else { value.abs().log10().floor() as i32 };
        let text = if self.exponent >= -5 && magnitude <= 6 {
            let decimals = usize::try_from(-self.exponent).unwrap_or(0);
            format!("{:.decimals$}", value.abs())
        } else if value == 0.0 {
            "0".to_owned()
        } else {
            let digits = (magnitude - self.exponent).clamp(0, 15) as usize;
            format!("{:.digits$e}", value.abs())
        };
        if value < 0.0 { format!("−{text}") } else { text }
    }
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten, in ascending order, at least [`MIN_LABEL_SPACING`] points
/// apart on an axis `length` points long, labelled with as many decimals as the step needs. There is always one.
pub fn auto_ticks(range: [f64; 2], length: f64) -> Vec<Tick> {
    let [start, end] = proper(range);
    let (low, high) = (start.min(end), start.max(end));
    let length = if length.is_finite() { length.max(1.0) } else { 1.0 };
    // Below this labels have more digits than anyone reads, and doubles soon too few.
    let finest = (low.abs().max(high.abs()) * 1e-10).max(f64::MIN_POSITIVE * 1e16);
    let mut step = Step::at_least(((high - low) * MIN_LABEL_SPACING / length).max(finest));
    let mut values = step.multiples(low, high);
    for _ in 0..60 {
        if !values.is_empty() || step.value() <= finest {
            break;
        }
        step = step.finer();
        values = step.multiples(low, high);
        values.truncate(1);
    }
    if values.is_empty() {
        values.push(low);
    }
    values.into_iter().map(|value| Tick { value, label: step.label(value) }).collect()
}

/// The given ticks inside the range, in ascending order.
fn inside(at: &[(f64, String)], range: [f64; 2]) -> Vec<Tick> {
    let (low, high) = (range[0].min(range[1]), range[0].max(range[1]));
    let here = at.iter().filter(|(value, _)| (low..=high).contains(value));
    let mut ticks: Vec<Tick> = here.map(|(value, label)| Tick { value: *value, label: label.clone() }).collect();
    ticks.sort_by(|a, b| a.value.total_cmp(&b.value));
    ticks
}

/// Takes away labels that are too close: that of 0 and those at the ends stay if they can, the others where there is room.
fn thin_out(ticks: &mut [Tick], range: [f64; 2], length: f64, spacing: f64) {
    let spans: Vec<Option<Span>> = ticks.iter().map(|tick| Span::of(tick, range, length)).collect();
    let first = spans.iter().position(Option::is_some);
    let last = spans.iter().rposition(Option::is_some);
    let zero = ticks.iter().position(|tick| tick.value == 0.0);
    let mut kept: Vec<Span> = Vec::new();
    for index in zero.into_iter().chain(first).chain(last).chain(0..ticks.len()) {
        let Some(span) = spans[index].filter(|span| !kept.contains(span)) else { continue };
        if kept.iter().all(|other| span.is_clear_of(*other, spacing)) {
            kept.push(span);
        }
    }
    for (tick, span) in ticks.iter_mut().zip(spans) {
        if span.is_some_and(|span| !kept.contains(&span)) {
            tick.label.clear();
        }
    }
}

/// Position of a label along its axis, in points.
#[derive(Clone, Copy, PartialEq)]
struct Span {
    tick: f64,
    middle: f64,
    half: f64,
}

impl Span {
    /// Labels at the ends are moved inward rather than cut.
    fn of(tick: &Tick, range: [f64; 2], length: f64) -> Option<Self> {
        let at = (tick.value - range[0]) / (range[1] - range[0]) * length;
        let half = 0.5 * text_width(&tick.label, TextSize::Body);
        let middle = at.min(length - half).max(half);
        (!tick.label.is_empty()).then_some(Self { tick: at, middle, half })
    }

    fn is_clear_of(self, other: Self, spacing: f64) -> bool {
        // Steps may fall short of the spacing by rounding.
        let apart = (self.tick - other.tick).abs() >= spacing * (1.0 - 1e-3);
        apart && (self.middle - other.middle).abs() >= self.half + other.half + if spacing > 0.0 { 6.0 } else { 2.0 }
    }
}
