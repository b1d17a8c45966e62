//! The head as a function of space: about the distance from the skin, negative inside.

use super::strokes::{EARS, EYES, FACE, MOUTH, NECK, NOSE, SKULL};
use crate::implicit::{Field, Sample};
use glam::{Mat3A, Vec3, Vec3A, vec3a};

/// The middle of the head's bounds, in the figures' millimeters.
pub(super) const MIDDLE_MM: [f32; 3] = [0.0, -17.0, 0.0];

/// The plane that cuts the neck, and how round its edge is.
const CUT_MM: f32 = -162.0;
const CUT_ROUND_MM: f32 = 12.0;

/// The plane below which the neck keeps its section, `y = SECTION_MM + SECTION_SLOPE z`, and how far below it the section
/// is that it keeps in the end.
const SECTION_MM: f32 = -93.0;
const SECTION_SLOPE: f32 = -0.28;
const SECTION_DEPTH_MM: f32 = 9.0;

/// From what height on and by what share the neck widens to the cut, and around what line.
const FLARE_FROM_MM: f32 = -85.0;
const FLARE: f32 = 0.14;
const FLARE_AXIS_MM: f32 = -20.0;

/// Center and radius of the left eyeball.
const EYEBALL: (Vec3A, f32) = (vec3a(29.33, 20.69, 64.72), 15.95);

/// Where the lids leave it open: how far aside and above its center is the middle, half the width and height.
const OPENING: [(f32, f32); 2] = [(2.0, 11.5), (-2.4, 5.0)];

/// No value changes faster than this with distance, around the surface.
const STEEPEST: f32 = 2.0;

/// What the parameters do to the figures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Meters for each millimeter of the figures.
    pub scale: f32,
    /// The lower face's width.
    pub jaw: f32,
    /// How wide the crease between lids and eyeballs is rounded, in millimeters of the figures.
    pub crease: f32,
}

/// A value in millimeters with its gradient.
#[derive(Clone, Copy)]
struct Jet {
    value: f32,
    gradient: Vec3A,
}

/// A place, seen from the figures.
struct Place {
    /// The height in millimeters, before the neck is drawn out.
    height: f32,
    /// The place in the figures' millimeters, x ≥ 0.
    figure: Vec3A,
    /// The change of the figures' place with the place in millimeters.
    jacobian: Mat3A,
}

/// A smooth hill or hollow within an ellipsoid.
#[derive(Clone, Copy)]
struct Stroke {
    center: Vec3A,
    matrix: Mat3A,
    amount: f32,
    /// Half the edges of the box around the ellipsoid.
    reach: Vec3A,
}

/// The head, or what of it matters near a place.
pub(super) struct Clay {
    shape: Shape,
    strokes: Vec<Stroke>,
}

impl Clay {
    /// The whole head.
    pub(super) fn new(shape: Shape) -> Self {
        let rows = SKULL.iter().chain(&FACE).chain(&EYES).chain(&NOSE).chain(&MOUTH).chain(&EARS).chain(&NECK);
        let strokes = rows.map(Stroke::from_row).flat_map(|s| [s, s.mirrored()]);
        // Only the half with x ≥ 0 is ever asked for.
        Self { shape, strokes: strokes.filter(|s| s.center.x + s.reach.x > 0.0).collect() }
    }

    /// The distance from the skin and the eyeball at a place in the figures' millimeters, x ≥ 0.
    fn jet(&self, p: Vec3A) -> Jet {
        let mut skin = body(p);
        for stroke in &self.strokes {
            stroke.add(p, &mut skin);
        }
        join(skin, eyeball(p), self.shape.crease)
    }

    /// Where the figures describe a place in meters.
    fn place(&self, p: Vec3) -> Place {
        let raw = Vec3A::from(p) / self.shape.scale + Vec3A::from(MIDDLE_MM);
        let raw = vec3a(raw.x.abs(), raw.y, raw.z);
        // Widest at the mouth, fading towards the eyes and down the neck.
        let (above, slope_above) = step((10.0 - raw.y) / 70.0);
        let (below, slope_below) = step((raw.y + 140.0) / 60.0);
        let factor = 1.0 + (self.shape.jaw - 1.0) * above * below;
        let slope = (self.shape.jaw - 1.0) * (above * slope_below / 60.0 - below * slope_above / 70.0);
        let x = raw.x / factor;
        let (figure, neck) = stretched(vec3a(x, raw.y, raw.z));
        let jaw = Mat3A::from_cols(vec3a(1.0 / factor, 0.0, 0.0), vec3a(-x * slope / factor, 1.0, 0.0), Vec3A::Z);
        Place { height: raw.y, figure, jacobian: neck * jaw }
    }
}

impl Field for Clay {
    fn at(&self, p: Vec3) -> Sample {
        let place = self.place(p);
        let figure = self.jet(place.figure);
        let inside = Jet { value: -figure.value, gradient: -(place.jacobian.transpose() * figure.gradient) };
        let jet = join(inside, Jet { value: place.height - CUT_MM, gradient: Vec3A::Y }, CUT_ROUND_MM);
        let side = if p.x < 0.0 { -1.0 } else { 1.0 };
        let gradient = Vec3::new(-side * jet.gradient.x, -jet.gradient.y, -jet.gradient.z);
        Sample { value: -jet.value * self.shape.scale, gradient }
    }

    fn near(&self, center: Vec3, radius: f32) -> Option<Self> {
        // How much longer distances can be in the figures' space.
        let longer = if self.shape.jaw == 1.0 { 1.15 } else { 1.5 };
        let (q, reach) = (self.place(center).figure, radius / self.shape.scale * longer);
        (self.at(center).value.abs() <= STEEPEST * radius * longer).then(|| {
            let touches = |s: &&Stroke| ((q - s.center).abs() - s.reach).max(Vec3A::ZERO).length() <= reach;
            Self { shape: self.shape, strokes: self.strokes.iter().filter(touches).copied().collect() }
        })
    }
}

impl Jet {
    fn negated(self) -> Self {
        Self { value: -self.value, gradient: -self.gradient }
    }
}

impl Stroke {
    fn from_row(row: &[f32; 10]) -> Self {
        let [x, y, z, a, b, c, d, e, f, amount] = *row;
        let matrix = Mat3A::from_cols(vec3a(a, b, d), vec3a(0.0, c, e), vec3a(0.0, 0.0, f));
        let inverse = matrix.inverse().transpose();
        let reach = vec3a(inverse.x_axis.length(), inverse.y_axis.length(), inverse.z_axis.length());
        Self { center: vec3a(x, y, z), matrix, amount, reach }
    }

    fn mirrored(self) -> Self {
        let mirror = vec3a(-1.0, 1.0, 1.0);
        Self { center: self.center * mirror, matrix: self.matrix * Mat3A::from_diagonal(mirror.into()), ..self }
    }

    /// Adds the stroke at a place.
    fn add(&self, p: Vec3A, to: &mut Jet) {
        let y = self.matrix * (p - self.center);
        let inner = 1.0 - y.length_squared();
        if inner > 0.0 {
            let steep = self.amount * inner * inner;
            to.value += steep * inner;
            to.gradient -= self.matrix.transpose() * y * (6.0 * steep);
        }
    }
}

/// The place in the figures from which the skin at a place in millimeters is taken, and its change with that place.
///
/// The figures end with the throat. Below a plane that falls from the nape to the throat, the neck goes on with the
/// section it has there, and widens a little towards the cut.
fn stretched(p: Vec3A) -> (Vec3A, Mat3A) {
    let (wider, slope) = step((FLARE_FROM_MM - p.y) / (FLARE_FROM_MM - CUT_MM));
    let (size, size_slope) = (1.0 + FLARE * wider, -FLARE * slope / (FLARE_FROM_MM - CUT_MM));
    let from_axis = (p.z - FLARE_AXIS_MM) / size;
    let end = SECTION_MM + SECTION_SLOPE * p.z;
    let low = ((end - p.y) / SECTION_DEPTH_MM).max(0.0).tanh();
    let follow = 1.0 - low * low;
    let y = p.y.max(end) - SECTION_DEPTH_MM * low;
    let x = p.x / size;
    let jacobian = Mat3A::from_cols(
        vec3a(1.0 / size, 0.0, 0.0),
        vec3a(-x * size_slope / size, follow, -from_axis * size_slope / size),
        vec3a(0.0, SECTION_SLOPE * (1.0 - follow), 1.0 / size),
    );
    (vec3a(x, y, FLARE_AXIS_MM + from_axis), jacobian)
}

/// The eyeball, a little smaller outside the opening: there the lids are thinner than the figures are exact.
fn eyeball(p: Vec3A) -> Jet {
    const SHRINKING_MM: f32 = 1.4;
    let from = p - EYEBALL.0;
    let [(aside, wide), (above, high)] = OPENING;
    let (u, v) = ((from.x - aside) / wide, (from.y - above) / high);
    let (hidden, slope) = step(2.0 * (u * u + v * v - 1.0));
    let gradient = from.normalize_or_zero() + 4.0 * SHRINKING_MM * slope * vec3a(u / wide, v / high, 0.0);
    Jet { value: from.length() - EYEBALL.1 + SHRINKING_MM * hidden, gradient }
}

/// Skull, face and neck without features.
fn body(p: Vec3A) -> Jet {
    let skull = ellipsoid(p - vec3a(0.0, 42.44, -9.4), vec3a(74.6, 90.12, 102.44));
    let face = ellipsoid(p - vec3a(0.0, -34.55, 23.7), vec3a(56.2, 71.45, 71.65));
    join(join(skull, face, 40.0), neck(p), 32.0)
}

/// About the distance from an ellipsoid: exact in value and slope on it.
fn ellipsoid(p: Vec3A, radii: Vec3A) -> Jet {
    let (a, b) = (p / radii, p / (radii * radii));
    let (k, l) = (a.length() + 1e-6, b.length() + 1e-6);
    let (slope_k, slope_l) = (b / k, b / (radii * radii) / l);
    let value = k * (k - 1.0) / l;
    Jet { value, gradient: (slope_k * (2.0 * k - 1.0) - slope_l * value) / l }
}

/// An elliptic cylinder that leans back and widens downward.
fn neck(p: Vec3A) -> Jet {
    const WIDTH: f32 = 52.7;
    const DEPTH: f32 = 45.15;
    let y = p.y + 60.0;
    let (widening, slope) = step(-y / 60.0);
    let (size, size_slope) = (1.0 + 0.25 * widening, -0.25 * slope / 60.0);
    let (u, v) = (p.x / (WIDTH * size), (p.z + 36.7 - 0.059 * y) / (DEPTH * size));
    let k = u.hypot(v) + 1e-6;
    let unit = 0.95 * (WIDTH * DEPTH).sqrt();
    let along = -k * size_slope / size - 0.059 * v / (k * DEPTH * size);
    let side =
        Jet { value: unit * (k - 1.0), gradient: unit * vec3a(u / (k * WIDTH * size), along, v / (k * DEPTH * size)) };
    let top = Jet { value: p.y - 14.8, gradient: Vec3A::Y };
    join(side.negated(), top.negated(), 20.0).negated()
}

/// The smooth union of two bodies, rounded where their distances differ by less than `width`, without a jump in curvature.
fn join(a: Jet, b: Jet, width: f32) -> Jet {
    let (near, far) = if a.value < b.value { (a, b) } else { (b, a) };
    let h = (1.0 - (far.value - near.value) / width).max(0.0);
    Jet { value: near.value - h * h * h * width / 6.0, gradient: near.gradient.lerp(far.gradient, h * h / 2.0) }
}

/// From 0 to 1 with level ends, and its slope.
fn step(t: f32) -> (f32, f32) {
    let t = t.clamp(0.0, 1.0);
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t))
}
