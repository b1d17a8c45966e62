//! Figure 1: the angles of light, surface and camera.

use chromascope_figure::{
    Anchor, Cell, Dash, Figure, FigureRoom, Ink, InkRole, Mark, Panel, Rect, Shape, Table, TextSize,
};

use crate::plot_item::PickIndex;

const SIZE: [f64; 2] = [640.0, 300.0];
/// Zenith angle of the light in degrees.
const INCIDENT: f64 = 40.0;
/// Zenith angle of the camera in degrees.
const SCATTERED: f64 = 25.0;

pub(super) fn figure(room: FigureRoom) -> Figure {
    let size = room.size(SIZE, 0.0);
    let mut figure = Figure::new("Geometry of the reflectance model", size);
    let mut drawing = Drawing { marks: Vec::new(), scale: size[0] / SIZE[0] };
    surface(&mut drawing);
    camera(&mut drawing);
    let area = Rect::from_min_size([0.0; 2], size);
    figure.panels.push(Panel { marks: drawing.marks, ..Panel::board("Geometry", area, Ink::new(InkRole::Plot)) });
    "Left: light falls on a rough surface of RMS roughness σ and correlation length τ at θi from the normal \
                      and is scattered at θs; v is the difference of the wave vectors, 2X the width that is illuminated \
                      coherently (Eq 1 to 4). Right: a pixel at the angle α off the axis of a lens of diameter d at the \
                      distance z from the sensor (Eq 9)."
        .clone_into(&mut figure.caption);
    figure.table = Table::new(["symbol", "meaning", "drawn_at_deg"]);
    for (symbol, meaning, at) in [
        ("θi", "zenith angle of the light", Some(INCIDENT)),
        ("θs", "zenith angle of the camera", Some(SCATTERED)),
        ("v", "difference of the wave vectors", None),
        ("σ", "RMS roughness", None),
        ("τ", "correlation length", None),
        ("X", "half-width of the coherently illuminated area", None),
        ("α", "angle of the pixel off the optical axis", None),
        ("d", "diameter of the lens", None),
        ("z", "distance from lens to sensor", None),
    ] {
        figure.table.push([Cell::from(symbol), Cell::from(meaning), Cell::from(at)]);
    }
    figure
}

/// Marks in points of [`SIZE`].
struct Drawing {
    marks: Vec<Mark>,
    scale: f64,
}

impl Drawing {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x * self.scale, y * self.scale]
    }

    fn line(&mut self, name: &str, points: &[[f64; 2]], ink: InkRole, width: f64, dash: Dash) {
        let points = points.iter().map(|point| self.at(*point)).collect();
        let mark = Mark::new(PickIndex::NONE, name, Shape::Line { points, closed: false });
        self.marks.push(mark.with_stroke(ink, width).with_dash(dash));
    }

    fn text(&mut self, text: &str, at: [f64; 2], anchor: Anchor) {
        let at = self.at(at);
        let (text, size, ink) = (text.to_owned(), TextSize::Body, InkRole::Text.into());
        let shape = Shape::Text { at, text: text.clone(), anchor, offset: [0.0; 2], size, ink };
        self.marks.push(Mark::new(PickIndex::NONE, text, shape));
    }

    /// A line with a head at its end.
    fn arrow(&mut self, name: &str, from: [f64; 2], to: [f64; 2], ink: InkRole) {
        self.line(name, &[from, to], ink, 2.0, Dash::Solid);
        let back = (from[1] - to[1]).atan2(from[0] - to[0]);
        let barb = |turn: f64| polar(to, (back + turn).to_degrees(), 9.0);
        let points = [to, barb(0.38), barb(-0.38)].map(|point| self.at(point)).to_vec();
        self.marks.push(Mark::new(PickIndex::NONE, name, Shape::Polygon { points }).with_fill(ink));
    }

    /// A part of a circle between angles in degrees, with a name at its middle.
    fn arc(&mut self, name: &str, center: [f64; 2], radius: f64, [from, to]: [f64; 2]) {
        const STEPS: i32 = 24;
        let points: Vec<[f64; 2]> = (0..=STEPS)
            .map(|step| polar(center, from + (to - from) * f64::from(step) / f64::from(STEPS), radius))
            .collect();
        self.line(name, &points, InkRole::Weak, 1.0, Dash::Solid);
        self.text(name, polar(center, f64::midpoint(from, to), radius + 12.0), Anchor::CENTER);
    }
}

/// A point at an angle in degrees from the x axis, clockwise as y runs downward.
fn polar([x, y]: [f64; 2], degrees: f64, radius: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [x + radius * cos, y + radius * sin]
}

fn surface(drawing: &mut Drawing) {
    const FOOT: [f64; 2] = [170.0, 200.0];
    // Angles are from the normal, which points up: −90°.
    let (light, view) = (-90.0 - INCIDENT, -90.0 + SCATTERED);
    let heights = |x: f64| 4.5 * (x / 6.1).sin() + 3.5 * (x / 3.7 + 1.0).sin() + 2.5 * (x / 9.7 + 2.0).cos();
    let profile: Vec<[f64; 2]> =
        (0..=280).map(|step| 30.0 + f64::from(step)).map(|x| [x, FOOT[1] + 8.0 + heights(x)]).collect();
    let ground = profile.iter().copied().chain([[310.0, 238.0], [30.0, 238.0]]);
    let points = ground.map(|point| drawing.at(point)).collect();
    drawing.marks.push(Mark::new(PickIndex::NONE, "material", Shape::Polygon { points }).with_fill(InkRole::Grid));
    drawing.line("rough surface", &profile, InkRole::Text, 2.0, Dash::Solid);
    drawing.line("normal", &[FOOT, [FOOT[0], 26.0]], InkRole::Weak, 1.0, Dash::Dashed);
    drawing.text("n", [FOOT[0], 14.0], Anchor::CENTER);
    drawing.arrow("light", polar(FOOT, light, 165.0), polar(FOOT, light, 6.0), InkRole::Reference);
    drawing.text("light", polar(FOOT, light, 180.0), Anchor::CENTER);
    drawing.arrow("to the camera", FOOT, polar(FOOT, view, 150.0), InkRole::Sensor(0));
    drawing.text("camera", polar(FOOT, view, 165.0), Anchor::CENTER);
    let middle = f64::midpoint(light, view);
    drawing.arrow("v", FOOT, polar(FOOT, middle, 105.0), InkRole::Weak);
    drawing.text("v", polar(FOOT, middle, 116.0), Anchor::CENTER);
    drawing.arc("θi", FOOT, 66.0, [light, -90.0]);
    drawing.arc("θs", FOOT, 80.0, [-90.0, view]);
    drawing.line("illuminated area", &[[110.0, 252.0], [230.0, 252.0]], InkRole::Text, 1.0, Dash::Solid);
    for x in [110.0, 230.0] {
        drawing.line("end of the area", &[[x, 247.0], [x, 257.0]], InkRole::Text, 1.0, Dash::Solid);
    }
    drawing.text("2X", [170.0, 266.0], Anchor::CENTER);
    drawing.text("σ, τ", [318.0, 212.0], Anchor::LEFT);
}

fn camera(drawing: &mut Drawing) {
    const LENS: [f64; 2] = [480.0, 120.0];
    const SENSOR: f64 = 600.0;
    let pixel = [SENSOR, 172.0];
    drawing.line("axis", &[[370.0, LENS[1]], [SENSOR, LENS[1]]], InkRole::Weak, 1.0, Dash::Dashed);
    let lens: Vec<[f64; 2]> = (0..=40)
        .map(|step| f64::from(step) * 9.0)
        .map(|degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [LENS[0] + 9.0 * cos, LENS[1] + 56.0 * sin]
        })
        .collect();
    drawing.line("lens", &lens, InkRole::Text, 2.0, Dash::Solid);
    drawing.line("sensor", &[[SENSOR, 50.0], [SENSOR, 190.0]], InkRole::Text, 3.0, Dash::Solid);
    let slope = (pixel[1] - LENS[1]) / (pixel[0] - LENS[0]);
    let far = [370.0, LENS[1] - slope * (LENS[0] - 370.0)];
    drawing.arrow("light", far, pixel, InkRole::Sensor(0));
    drawing.arc("α", LENS, 52.0, [0.0, slope.atan().to_degrees()]);
    drawing.line("diameter", &[[456.0, 64.0], [456.0, 176.0]], InkRole::Text, 1.0, Dash::Solid);
    drawing.text("d", [446.0, 150.0], Anchor::CENTER);
    drawing.line("distance", &[[LENS[0], 206.0], [SENSOR, 206.0]], InkRole::Text, 1.0, Dash::Solid);
    drawing.text("z", [540.0, 218.0], Anchor::CENTER);
    drawing.text("sensor", [SENSOR, 36.0], Anchor::CENTER);
    drawing.text("lens", [LENS[0], 50.0], Anchor::CENTER);
}
