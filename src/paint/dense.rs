//! Lines with more points than the screen has columns, reduced to the points that can be seen.
//!
//! Drawn in full, a line of noise covers each pixel many times, and many such lines block the window for a minute. The
//! figure retains all its points; only the drawing is reduced.

use egui::{Color32, Mesh, Pos2, Rect, epaint::Vertex};

/// Points for each column of pixels from which a line is drawn by columns: its first and last, least and largest point there.
const PER_COLUMN: usize = 2;
/// Mean way up and down within a column, in columns' widths, from which a line fills what lies between its extremes.
const RESTLESS: f32 = 20.0;

/// A line as it goes to the screen.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Drawn {
    Line(Vec<Pos2>),
    /// A line so restless that it fills its columns.
    Filled(Vec<Column>),
}

/// The part of a line within a column of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column {
    index: usize,
    first: Pos2,
    last: Pos2,
    least: Pos2,
    largest: Pos2,
}

impl Column {
    fn new(index: usize, at: Pos2) -> Self {
        Self { index, first: at, last: at, least: at, largest: at }
    }

    fn take(&mut self, at: Pos2) {
        self.last = at;
        self.least = if at.y < self.least.y { at } else { self.least };
        self.largest = if at.y > self.largest.y { at } else { self.largest };
    }
}

/// Shortens a line for a plot in `rect` whose pixels have sides of `pixel` points. A line with few points, or one that turns
/// back, stays as it is.
pub(super) fn shortened(points: Vec<Pos2>, rect: Rect, pixel: f32) -> Drawn {
    let columns = (rect.width() / pixel).ceil().max(1.0) as usize;
    let falls = points.first().zip(points.last()).is_some_and(|(first, last)| first.x > last.x);
    let is_ordered = |pair: &[Pos2]| if falls { pair[0].x >= pair[1].x } else { pair[0].x <= pair[1].x };
    if points.len() <= PER_COLUMN * columns || !points.windows(2).all(is_ordered) {
        return Drawn::Line(points);
    }
    let mut points = points;
    if falls {
        points.reverse();
    }
    // One more on each side, for the way there.
    let from = points.partition_point(|at| at.x < rect.left()).saturating_sub(1);
    let to = (points.partition_point(|at| at.x <= rect.right()) + 1).min(points.len());
    let seen = &points[from.min(to)..to];
    if seen.len() <= PER_COLUMN * columns {
        return Drawn::Line(seen.to_vec());
    }
    // Beyond the plot nothing is seen, however far.
    let near = rect.expand(4.0);
    let held = |at: &Pos2| Pos2::new(at.x, at.y.clamp(near.top(), near.bottom()));
    let left = (rect.left() / pixel).floor() * pixel - pixel;
    let place = |at: Pos2| ((at.x - left) / pixel).clamp(0.0, (columns + 2) as f32) as usize;
    let mut parts: Vec<Column> = Vec::with_capacity(columns + 2);
    let mut transform = 0.0;
    for at in seen.iter().map(held) {
        match parts.last_mut().filter(|column| column.index == place(at)) {
            Some(column) => {
                transform += (at.y - column.last.y).abs();
                column.take(at);
            }
            None => parts.push(Column::new(place(at), at)),
        }
    }
    if transform > RESTLESS * pixel * parts.len() as f32 { Drawn::Filled(parts) } else { Drawn::Line(joined(&parts)) }
}

/// At most four points of each column, in their order.
fn joined(columns: &[Column]) -> Vec<Pos2> {
    let mut line = Vec::with_capacity(4 * columns.len());
    for column in columns {
        let mut between = [column.least, column.largest];
        between.sort_by(|a, b| a.x.total_cmp(&b.x));
        for at in [column.first, between[0], between[1], column.last] {
            if line.last() != Some(&at) {
                line.push(at);
            }
        }
    }
    line
}

/// A bar in each column from the least to the largest of a line of some width; neighbors touch where the line goes from one to
/// the other.
pub(super) fn bars(columns: &[Column], rect: Rect, pixel: f32, width: f32, color: Color32) -> Mesh {
    let left = (rect.left() / pixel).floor() * pixel - pixel;
    let mut mesh = Mesh::default();
    let mut bar = |index: usize, top: f32, bottom: f32| {
        let x = left + index as f32 * pixel;
        let base = mesh.vertices.len() as u32;
        for (x, y) in [(x, top), (x + pixel, top), (x, bottom), (x + pixel, bottom)] {
            mesh.vertices.push(Vertex { pos: Pos2::new(x, y), uv: egui::epaint::WHITE_UV, color });
        }
        mesh.add_triangle(base, base + 1, base + 2);
        mesh.add_triangle(base + 2, base + 1, base + 3);
    };
    for (i, column) in columns.iter().enumerate() {
        let [before, after] = [i.checked_sub(1).and_then(|i| columns.get(i)), columns.get(i + 1)];
        let halfway = |a: Pos2, b: Pos2| 0.5 * (a.y + b.y);
        let ends = [
            before.map(|before| halfway(before.last, column.first)),
            after.map(|after| halfway(column.last, after.first)),
        ];
        let ends = ends.into_iter().flatten();
        let (top, bottom) =
            ends.fold((column.least.y, column.largest.y), |(top, bottom), y| (top.min(y), bottom.max(y)));
        bar(column.index, top - 0.5 * width, bottom + 0.5 * width);
        // Columns between samples that stand farther apart.
        for index in column.index + 1..after.map_or(0, |after| after.index) {
            let y = after.map_or(column.last.y, |after| halfway(column.last, after.first));
            bar(index, y - 0.5 * width, y + 0.5 * width);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLOT: Rect = Rect { min: Pos2::new(10.0, 20.0), max: Pos2::new(510.0, 220.0) };

    fn line(count: usize, y: impl Fn(usize) -> f32) -> Vec<Pos2> {
        (0..count).map(|i| Pos2::new(10.0 + 500.0 * i as f32 / (count - 1) as f32, y(i))).collect()
    }

    fn noise(i: usize) -> f32 {
        20.0 + ((i as u32).wrapping_mul(2_654_435_761).rotate_left(11).wrapping_mul(2_246_822_519) >> 8) as f32
            / 16_777_216.0
            * 200.0
    }

    #[test]
    fn a_line_of_few_points_or_one_that_turns_back_stays_as_it_is() {
        let few = line(1000, noise);
        assert_eq!(shortened(few.clone(), PLOT, 1.0), Drawn::Line(few));
        let mut turning = line(20_000, noise);
        turning.swap(5, 6);
        turning[7].x = 400.0;
        assert_eq!(shortened(turning.clone(), PLOT, 1.0), Drawn::Line(turning));
    }

    #[test]
    fn a_smooth_line_keeps_its_extremes_in_four_points_a_column() {
        let points = line(100_000, |i| 120.0 + 90.0 * (i as f32 / 3000.0).sin());
        let Drawn::Line(drawn) = shortened(points.clone(), PLOT, 1.0) else { panic!("it is smooth") };
        assert!((500..=2010).contains(&drawn.len()), "{} points", drawn.len());
        let extremes = |points: &[Pos2]| {
            points.iter().fold((f32::MAX, f32::MIN), |(low, high), at| (low.min(at.y), high.max(at.y)))
        };
        assert_eq!(extremes(&drawn), extremes(&points));
        assert_eq!((drawn.first(), drawn.last()), (points.first(), points.last()));
        let reversed = points.into_iter().rev().collect();
        assert_eq!(shortened(reversed, PLOT, 1.0), Drawn::Line(drawn));
    }

    #[test]
    fn noise_covers_each_pixel_once() {
        let points = line(4000, noise);
        let Drawn::Filled(columns) = shortened(points.clone(), PLOT, 1.0) else { panic!("it is restless") };
        let mesh = bars(&columns, PLOT, 1.0, 2.0, Color32::RED);
        assert!(mesh.vertices.len() <= 4 * 502, "{} vertices", mesh.vertices.len());
        // Every sample lies within its bar, and no two bars lie over each other.
        let bars: Vec<(f32, f32, f32)> =
            mesh.vertices.chunks(4).map(|bar| (bar[0].pos.x, bar[0].pos.y, bar[3].pos.y)).collect();
        assert!(bars.windows(2).all(|pair| pair[0].0 + 0.999 < pair[1].0));
        for at in points {
            assert!(
                bars.iter().any(|(x, top, bottom)| (*x..x + 1.001).contains(&at.x) && (*top..=*bottom).contains(&at.y)),
                "{at:?}"
            );
        }
    }

    #[test]
    fn what_is_zoomed_out_of_sight_is_not_drawn() {
        let points: Vec<Pos2> = (0..100_000).map(|i| Pos2::new(i as f32, noise(i))).collect();
        let Drawn::Line(drawn) = shortened(points, PLOT, 1.0) else { panic!("there are few in sight") };
        assert_eq!(drawn.len(), 503);
    }
}
