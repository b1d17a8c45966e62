//! Tristimulus values, diagrams, L*a*b*, differences, adaptation, screens.

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::adaptation::bradford;
use chromascope_core::colorimetry::diagram::area_color;
use chromascope_core::colorimetry::lab::lab_from_xyz;
use chromascope_core::colorimetry::rgb::{
    XYZ_FROM_SRGB, encode_srgb, srgb_from_xyz, srgb_inverse_transfer, srgb_transfer, srgb_white,
};
use chromascope_core::colorimetry::{Lab, UvPrime, Xy, Xyz, delta_e_1976, delta_e_2000};
use chromascope_math::double::Double;
use glam::{DMat3, DVec3};

use super::draw::{Case, Draw, case};
use super::walk::{Verdict, Walk};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "Xyz::chromaticity", promise: 1e-15, share: 60.0, draw: draw_xyz, check: chromaticity },
    Walk { name: "Xy, UvPrime", promise: 2e-14, share: 40.0, draw: draw_xy, check: diagrams },
    Walk { name: "lab_from_xyz", promise: 0.0, share: 40.0, draw: draw_six, check: lab },
    Walk { name: "delta_e_2000", promise: 1e-12, share: 60.0, draw: draw_pair, check: difference },
    Walk { name: "delta_e_2000 on the gray axis", promise: 1e-14, share: 20.0, draw: draw_gray, check: gray },
    Walk { name: "delta_e_2000 at 180°", promise: 1e-12, share: 20.0, draw: draw_opposite, check: opposite },
    Walk { name: "delta_e ends", promise: 0.0, share: 20.0, draw: draw_six, check: difference_ends },
    Walk { name: "bradford", promise: 1e-14, share: 20.0, draw: draw_six, check: adaptation },
    Walk {
        name: "srgb_transfer",
        promise: 1e-13,
        share: 20.0,
        draw: |d| case([d.log(1e-300, 1e100)]),
        check: transfer,
    },
    Walk { name: "encode_srgb", promise: 0.0, share: 20.0, draw: draw_xyz, check: screen },
];

fn draw_xyz(d: &mut Draw) -> Case {
    case(if d.pick(2) == 0.0 {
        [d.anything(), d.anything(), d.anything()]
    } else {
        [d.signed(1e-300, 1e300), d.signed(1e-3, 1e3), d.signed(1e-300, 1e300)]
    })
}

fn draw_six(d: &mut Draw) -> Case {
    if d.pick(2) == 0.0 {
        return case([d.number(), d.number(), d.number(), d.number(), d.number(), d.number()]);
    }
    case([d.signed(1e-9, 1e9), d.log(1e-9, 1e9), d.log(1e-9, 1e9), d.log(0.1, 2.0), d.log(0.1, 2.0), d.log(0.1, 2.0)])
}

fn chromaticity(&[x, y, z, ..]: &Case, v: &mut Verdict) {
    let color = Xyz::new(x, y, z);
    let largest = x.abs().max(y.abs()).max(z.abs());
    let white = WhiteBalanceTarget::from_xyz(color);
    let usable = largest < 1e300 && !(x + y + z).is_nan();
    v.holds("a white that is no number", !usable || white.0.iter().all(|s| s.is_finite()));
    let Some(xy) = color.chromaticity() else { return v.refuse() };
    v.all_finite([xy.x, xy.y]);
    // Scaled as a double can be without loss, so that two doubles do not overflow either.
    let scale = (-largest.log2().floor()).exp2();
    let scaled = |n: f64| Double::from(if scale.is_finite() && scale > 0.0 { n * scale } else { n / largest });
    let sum = scaled(x) + scaled(y) + scaled(z);
    let spread = 1.0 / sum.value().abs();
    let exact = [(scaled(x) / sum).value(), (scaled(y) / sum).value()];
    // Where the three nearly cancel, rounding is shown as large as their sum is small.
    for (value, exact) in [xy.x, xy.y].into_iter().zip(exact) {
        v.error((value - exact).abs() / (1.0 + exact.abs()) / spread.max(1.0));
    }
    if let Some(uv) = color.uv_prime() {
        v.all_finite([uv.u, uv.v, uv.uv60().v]);
    }
}

fn draw_xy(d: &mut Draw) -> Case {
    case(match d.pick(3) as u32 {
        0 => [d.anything(), d.anything()],
        1 => [d.signed(1e-12, 1e12), d.signed(1e-12, 1e12)],
        _ => [d.unit(), d.unit()],
    })
}

fn diagrams(&[x, y, ..]: &Case, v: &mut Verdict) {
    let xy = Xy { x, y };
    if let Some(xyz) = xy.with_unit_luminance() {
        v.all_finite([xyz.x, xyz.z]);
        v.holds("Y is not 1", xyz.y == 1.0);
        v.holds("no white", WhiteBalanceTarget::from_chromaticity(xy).is_some());
    }
    if let Some(far) = (UvPrime { u: x, v: y }).xy() {
        v.all_finite([far.x, far.y]);
    }
    let Some(uv) = xy.uv_prime() else { return v.refuse() };
    v.all_finite([uv.u, uv.v]);
    if let Some(back) = uv.xy() {
        v.all_finite([back.x, back.y]);
        // What a last digit of u′ and v′ is in x and y, where the maps stretch.
        let d = -2.0 * x + 12.0 * y + 3.0;
        let size = 1.0 + x.abs() + y.abs();
        let stretch = size / d.abs() + size * d.abs() + size * size;
        v.error(xy.distance(back) / size / stretch);
        v.holds("not symmetric", uv.distance(UvPrime { u: 0.2, v: 0.5 }) == (UvPrime { u: 0.2, v: 0.5 }).distance(uv));
    }
}

fn lab(&[x, y, z, a, b, c, ..]: &Case, v: &mut Verdict) {
    let (color, white) = (Xyz::new(x, y, z), Xyz::new(a, b, c));
    let Some(lab) = lab_from_xyz(color, white) else { return v.refuse() };
    v.all_finite([lab.l, lab.a, lab.b]);
    v.holds("a white that is not positive", a > 0.0 && b > 0.0 && c > 0.0);
    let brighter = Xyz::new(x, y + y.abs() * 1e-9 + f64::MIN_POSITIVE, z);
    if let Some(more) = lab_from_xyz(brighter, white) {
        v.holds("L* falls with Y", more.l >= lab.l);
    }
    let itself = lab_from_xyz(white, white);
    v.holds("white is not 100, 0, 0", itself == Some(Lab { l: 100.0, a: 0.0, b: 0.0 }));
}

fn draw_pair(d: &mut Draw) -> Case {
    let size = d.log(1e-6, 1e6);
    let near = d.log(1e-9, 10.0);
    let (l, a, b) = (d.within(0.0, 100.0), size * d.within(-1.0, 1.0), size * d.within(-1.0, 1.0));
    if d.pick(2) == 0.0 {
        case([l, a, b, l + near * d.within(-1.0, 1.0), a + near * d.within(-1.0, 1.0), b + near * d.within(-1.0, 1.0)])
    } else {
        case([l, a, b, d.within(0.0, 100.0), size * d.within(-1.0, 1.0), size * d.within(-1.0, 1.0)])
    }
}

fn pair(case: &Case) -> [Lab; 2] {
    [Lab { l: case[0], a: case[1], b: case[2] }, Lab { l: case[3], a: case[4], b: case[5] }]
}

/// Hues of [`Lab`] pairs by vectors: the hue difference from the two colors' products, the mean hue from their
/// bisector. Also the bisector's length, 0 for opposite hues: the shorter it is, the less certain the mean hue.
fn by_vectors([one, two]: [Lab; 2]) -> Option<[f64; 2]> {
    let share = |c: f64| (c.powi(7) / (c.powi(7) + 25.0_f64.powi(7))).sqrt();
    let chroma = f64::midpoint(one.a.hypot(one.b), two.a.hypot(two.b));
    let stretch = 1.0 + 0.5 * (1.0 - share(chroma));
    let [p, q] = [one, two].map(|lab| [stretch * lab.a, lab.b]);
    let [c1, c2] = [p, q].map(|p: [f64; 2]| p[0].hypot(p[1]));
    let (inner, outer) = (p[0] * q[0] + p[1] * q[1], p[0] * q[1] - p[1] * q[0]);
    // Next to 180° rounding decides which way round the mean hue is.
    if c1 * c2 == 0.0 || inner < 0.0 && outer.abs() < 1e-6 * c1 * c2 {
        return None;
    }
    // |p/|p| − q/|q|| √(c1 c2) is twice the sine of half the angle times it.
    let dh = 2.0 * (c1 * c2).sqrt() * (outer.atan2(inner) / 2.0).sin();
    let bisector = [p[0] / c1 + q[0] / c2, p[1] / c1 + q[1] / c2];
    let h = bisector[1].atan2(bisector[0]).rem_euclid(std::f64::consts::TAU);
    let c = f64::midpoint(c1, c2);
    let degrees = f64::to_radians;
    let t = 1.0 - 0.17 * (h - degrees(30.0)).cos() + 0.24 * (2.0 * h).cos() + 0.32 * (3.0 * h + degrees(6.0)).cos()
        - 0.20 * (4.0 * h - degrees(63.0)).cos();
    let lift = (f64::midpoint(one.l, two.l) - 50.0).powi(2);
    let l = (two.l - one.l) / (1.0 + 0.015 * lift / (20.0 + lift).sqrt());
    let (dc, dh) = ((c2 - c1) / (1.0 + 0.045 * c), dh / (1.0 + 0.015 * c * t));
    let turn = degrees(30.0) * (-((h.to_degrees() - 275.0) / 25.0).powi(2)).exp();
    let rotation = -2.0 * share(c) * (2.0 * turn).sin();
    Some([(l * l + dc * dc + dh * dh + rotation * dc * dh).max(0.0).sqrt(), bisector[0].hypot(bisector[1])])
}

fn difference(numbers: &Case, v: &mut Verdict) {
    let [one, two] = pair(numbers);
    let value = delta_e_2000(one, two);
    v.finite(value);
    v.holds("below 0", value >= 0.0);
    v.holds("not 0 to itself", delta_e_2000(one, one) == 0.0 && delta_e_1976(one, one) == 0.0);
    v.error((value - delta_e_2000(two, one)).abs() / value.max(1.0));
    v.holds("ΔE*ab not symmetric", delta_e_1976(one, two) == delta_e_1976(two, one));
    let plain = (one.l - two.l).powi(2) + (one.a - two.a).powi(2) + (one.b - two.b).powi(2);
    v.relative(delta_e_1976(one, two), plain.sqrt(), 0.0);
    if let Some([other, sure]) = by_vectors([one, two]) {
        // A last digit of a large chroma is much of a small difference; a hue's last digit (360° ε) is as much of dH.
        let chroma = one.a.hypot(one.b).max(two.a.hypot(two.b));
        v.error((value - other).abs() * sure.min(1.0) / value.max(1.0).max(chroma / 100.0));
    }
}

fn draw_gray(d: &mut Draw) -> Case {
    case([d.within(-20.0, 200.0), d.within(-20.0, 200.0), d.log(1e-300, 1e3)])
}

fn gray(&[a, b, chroma, ..]: &Case, v: &mut Verdict) {
    let at = |l: f64| Lab { l, a: 0.0, b: 0.0 };
    let lift = (f64::midpoint(a, b) - 50.0).powi(2);
    let truth = (a - b).abs() / (1.0 + 0.015 * lift / (20.0 + lift).sqrt());
    v.relative(delta_e_2000(at(a), at(b)), truth, 0.0);
    // Against gray no hue counts, whatever the other's.
    let colored = |turn: f64| delta_e_2000(at(a), Lab { l: a, a: 0.0, b: chroma.copysign(turn) });
    v.all_finite([colored(1.0), colored(-1.0)]);
    v.error((colored(1.0) - colored(-1.0)).abs() / colored(1.0).max(1.0));
}

fn draw_opposite(d: &mut Draw) -> Case {
    case([d.within(0.0, 100.0), d.signed(1e-3, 1e3), d.signed(1e-3, 1e3), d.log(0.5, 2.0).log2().round().exp2()])
}

fn opposite(&[l, a, b, factor, ..]: &Case, v: &mut Verdict) {
    let (one, two) = (Lab { l, a, b }, Lab { l, a: -a * factor, b: -b * factor });
    let (value, back) = (delta_e_2000(one, two), delta_e_2000(two, one));
    v.all_finite([value, back]);
    v.error((value - back).abs() / value.max(1.0));
}

fn difference_ends(numbers: &Case, v: &mut Verdict) {
    let [one, two] = pair(numbers);
    v.all_finite([delta_e_1976(one, two), delta_e_2000(one, two)]);
    v.holds("below 0", delta_e_1976(one, two) >= 0.0 && delta_e_2000(one, two) >= 0.0);
}

fn adaptation(&[x, y, z, a, b, c, ..]: &Case, v: &mut Verdict) {
    let (from, to) = (Xyz::new(x, y, z), Xyz::new(a, b, c));
    let Some(matrix) = bradford(from, to) else { return v.refuse() };
    v.holds("not finite", matrix.is_finite());
    let carried = matrix * from.to_vector();
    // What rounding is of the matrix's own entries.
    let size = matrix.to_cols_array().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scale = size * from.to_vector().abs().max_element() + to.to_vector().abs().max_element();
    // Below it the whites or the gains are subnormal, with fewer digits.
    let least = from.to_vector().abs().max_element().min(to.to_vector().abs().max_element());
    if scale.is_finite() && size > 1e-290 && least > 1e-290 {
        v.error((carried - to.to_vector()).abs().max_element() / scale);
    }
}

fn transfer(&[x, ..]: &Case, v: &mut Verdict) {
    let encoded = srgb_transfer(x);
    v.finite(encoded);
    v.holds("falls", srgb_transfer(x * (1.0 + 1e-9)) >= encoded);
    v.holds("not odd below 0", srgb_transfer(-x) == -12.92 * x);
    // The two branches meet but for 3e-8 of what lies between.
    if !(0.003_1..0.003_2).contains(&x) {
        v.relative(srgb_inverse_transfer(encoded), x, 0.0);
    }
}

fn screen(&[x, y, z, ..]: &Case, v: &mut Verdict) {
    let encoded = encode_srgb([x, y, z]);
    let odd = [x, y, z].iter().any(|n| !n.is_finite());
    v.holds("clipped and not said", !odd || encoded.clipped);
    let _ = area_color(Xy { x, y });
    let white = srgb_white();
    v.holds("another white", (XYZ_FROM_SRGB * DVec3::ONE - white.to_vector()).length() < 1e-15);
    let unity = srgb_from_xyz() * XYZ_FROM_SRGB - DMat3::IDENTITY;
    v.holds("no inverse", unity.to_cols_array().iter().all(|e| e.abs() < 1e-14));
}
