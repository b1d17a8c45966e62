//! Fresnel's formulas, the specular lobe, angles, and the scattered power.

use chromascope_core::reflectance::coherent::{
    mean_sinc_squared, rho0_squared, rho0_squared_bound, sinc, sine_integral,
};
use chromascope_core::reflectance::fresnel::{reflectance, transmittance, transmittance_by_cosine};
use chromascope_core::reflectance::{
    Geometry, IlluminatedArea, Normalization, Specular, Surface, beta, coherent_prefactor, diffuse_prefactor,
    directional_hemispherical, factor, factors, kappa, wavelength_power,
};
use chromascope_math::double::Double;
use glam::DVec3;

use super::draw::{Case, Draw, case};
use super::walk::{Verdict, Walk};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "fresnel", promise: 1e-13, share: 60.0, draw: draw_interface, check: interface },
    Walk { name: "fresnel ends", promise: 0.0, share: 20.0, draw: |d| case([d.anything(), d.anything()]), check: ends },
    Walk {
        name: "sine_integral",
        promise: 2e-15,
        share: 20.0,
        draw: |d| case([d.signed(1e-300, 1e20)]),
        check: integral,
    },
    Walk { name: "mean_sinc_squared", promise: 1e-14, share: 20.0, draw: draw_lobe, check: lobe },
    Walk {
        name: "sinc, lobe ends",
        promise: 0.0,
        share: 20.0,
        draw: |d| case([d.anything(), d.anything()]),
        check: lobe_ends,
    },
    Walk { name: "Geometry::from_angles", promise: 4e-15, share: 40.0, draw: draw_angles, check: angles },
    Walk { name: "Geometry::from_directions", promise: 0.0, share: 20.0, draw: draw_directions, check: directions },
    Walk { name: "Surface::new", promise: 0.0, share: 20.0, draw: draw_anything, check: surface },
    Walk { name: "factor", promise: 1e-12, share: 60.0, draw: draw_power, check: power },
];

/// Cosines to 1e-12 of grazing and of normal; indices next to 1 and far from it.
fn draw_interface(d: &mut Draw) -> Case {
    let cos = match d.pick(4) as u32 {
        0 => d.log(1e-300, 1.0),
        1 => d.log(1e-12, 1.0),
        2 => 1.0 - d.log(1e-16, 1.0),
        _ => d.unit(),
    };
    let index = if d.pick(3) == 0.0 { 1.0 + d.signed(1e-16, 0.5) } else { d.log(0.01, 1e4) };
    case([cos, index])
}

/// F and T in two doubles, from the textbook's amplitudes, and q².
fn exact(cos: f64, index: f64) -> Option<[Double; 3]> {
    let (c, n, one) = (Double::from(cos), Double::from(index), Double::from(1.0));
    if index == 1.0 {
        return Some([Double::from(0.0), one, c * c]);
    }
    let squared = n * n - one + c * c;
    if squared.value() <= 0.0 {
        return None;
    }
    let q = squared.sqrt();
    let across = (c - q) / (c + q);
    let along = (n * n * c - q) / (n * n * c + q);
    let half = Double::from(0.5);
    let f = half * (across * across + along * along);
    let t = |a: Double, b: Double| a * b / ((a + b) * (a + b));
    // 1 − r² of each, without the difference.
    let passed = Double::from(2.0) * (t(c, q) + t(n * n * c, q));
    Some([f, passed, squared])
}

fn interface(&[cos, index, ..]: &Case, v: &mut Verdict) {
    let (f, t, by) = (reflectance(cos, index), transmittance(cos, index), transmittance_by_cosine(cos, index));
    v.all_finite([f, t, by]);
    v.holds("not from 0 to 1", (0.0..=1.0).contains(&f) && (0.0..=1.0).contains(&t));
    let Some([exact_f, exact_t, squared]) = exact(cos, index) else {
        v.holds("total reflection", f > 1.0 - 1e-6 && t < 1e-6);
        return v.refuse();
    };
    // Next to an index's critical angle a last digit of the cosine is many of T.
    let steep = if index < 1.0 { 2.0 * f64::EPSILON / squared.value() } else { 0.0 };
    v.relative(f, exact_f.value(), steep);
    if t > 1e-290 {
        v.relative(t, exact_t.value(), steep);
    }
    let truth = (exact_t / cos.into()).value();
    if truth < 1e15 {
        v.relative(by, truth, steep);
    }
}

fn ends(&[cos, index, ..]: &Case, v: &mut Verdict) {
    let (f, t, by) = (reflectance(cos, index), transmittance(cos, index), transmittance_by_cosine(cos, index));
    v.all_finite([f, t, by]);
    v.holds("not from 0 to 1", (0.0..=1.0).contains(&f) && (0.0..=1.0).contains(&t) && (0.0..=1e15).contains(&by));
    v.holds("light is lost", (f + t - 1.0).abs() < 1e-12);
}

/// Si(x): the power series where it loses no digit that shows, beyond it the expansion for large x.
fn exact_integral(x: f64) -> f64 {
    if x <= 40.0 {
        let x = Double::from(x);
        let (mut power, mut sum) = (x, x);
        for k in (3..=201).step_by(2).map(f64::from) {
            power = -(power * x * x / (k * (k - 1.0)).into());
            sum = sum + power / k.into();
        }
        return sum.value();
    }
    let inverse = Double::from(1.0) / x.into();
    let (mut term, mut sums) = (inverse, [Double::from(0.0); 2]);
    for k in 0..38_u32 {
        let signed = if k % 4 < 2 { term } else { -term };
        sums[k as usize % 2] = sums[k as usize % 2] + signed;
        term = term * f64::from(k + 1).into() * inverse;
    }
    let (sin, cos) = x.sin_cos();
    let quarter = Double::from(std::f64::consts::FRAC_PI_2) + 6.123_233_995_736_766e-17.into();
    (quarter - sums[0] * cos.into() - sums[1] * sin.into()).value()
}

fn integral(&[x, ..]: &Case, v: &mut Verdict) {
    let value = sine_integral(x);
    v.finite(value);
    v.holds("not odd", sine_integral(-x) == -value);
    v.error((value.abs() - exact_integral(x.abs())).abs());
}

fn draw_lobe(d: &mut Draw) -> Case {
    case([d.signed(1e-6, 1e4), if d.pick(4) == 0.0 { 0.0 } else { d.log(1e-9, 1e4) }])
}

/// `∫ sinc²` from 0 to u, by its power series or from Si.
fn area(u: f64) -> f64 {
    if u.abs() > 18.0 {
        return (exact_integral(2.0 * u.abs()) - u.abs().sin().powi(2) / u.abs()).copysign(u);
    }
    let x = Double::from(u);
    let (mut term, mut sum) = (x, x);
    for k in (1..=120).map(f64::from) {
        // (2u)^2k over (2k + 2)!, twice.
        term = -(term * x * x * 4.0.into() / ((2.0 * k + 1.0) * (2.0 * k + 2.0)).into());
        sum = sum + term / (2.0 * k + 1.0).into();
    }
    sum.value()
}

/// Gauss and Legendre's five nodes, in pieces.
fn by_pieces(u: f64, w: f64) -> f64 {
    let inner = (5.0 - 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let outer = (5.0 + 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let [near, far] = [(322.0 + 13.0 * 70.0_f64.sqrt()) / 900.0, (322.0 - 13.0 * 70.0_f64.sqrt()) / 900.0];
    let rule = [(0.0, 128.0 / 225.0), (inner, near), (-inner, near), (outer, far), (-outer, far)];
    let square = |x: f64| if x == 0.0 { 1.0 } else { (x.sin() / x).powi(2) };
    let piece = |i: i32| {
        let center = u + w * (f64::from(2 * i + 1) / 8.0 - 1.0);
        rule.iter().map(|(node, weight)| weight / 2.0 * square(center + node * w / 8.0)).sum::<f64>()
    };
    (0..8).map(piece).sum::<f64>() / 8.0
}

fn exact_lobe(u: f64, w: f64) -> f64 {
    if w <= 1.0 { by_pieces(u, w) } else { (area(u + w) - area(u - w)) / (2.0 * w) }
}

fn lobe(&[u, w, ..]: &Case, v: &mut Verdict) {
    let value = mean_sinc_squared(u, w);
    v.finite(value);
    v.holds("not from 0 to 1", (0.0..=1.0 + 1e-15).contains(&value));
    v.holds("not even", value == mean_sinc_squared(-u, w));
    v.error((value - exact_lobe(u, w)).abs());
}

fn lobe_ends(&[u, w, ..]: &Case, v: &mut Verdict) {
    v.all_finite([sinc(u), sine_integral(u), mean_sinc_squared(u, w)]);
    v.holds("more than 1", sinc(u).abs() <= 1.0 && mean_sinc_squared(u, w) <= 1.0 + 1e-15);
}

fn draw_angles(d: &mut Draw) -> Case {
    case([d.angle(), d.angle(), d.angle()])
}

fn whole(g: &Geometry, v: &mut Verdict) {
    v.all_finite([g.cos_i, g.cos_s, g.vx_by_k, g.vy_by_k, g.vxy2_by_k2, g.vz_by_k, g.cos_half2]);
    v.holds("a square below 0", g.vxy2_by_k2 >= 0.0 && (0.0..=1.0).contains(&g.cos_half2));
}

fn angles(&[i, s, phi, ..]: &Case, v: &mut Verdict) {
    let g = Geometry::from_angles(i, s, phi);
    whole(&g, v);
    // Behind the surface, where nothing is made of them, differences of sines cancel.
    let zenith = 0.0..=std::f64::consts::FRAC_PI_2;
    if !(zenith.contains(&i) && zenith.contains(&s) && phi.abs() < 10.0) {
        return;
    }
    let back = Geometry::from_angles(s, i, phi);
    v.error((g.vxy2_by_k2 - back.vxy2_by_k2).abs().max((g.vz_by_k - back.vz_by_k).abs()));
    let light = DVec3::new(-i.sin(), 0.0, i.cos());
    let viewer = DVec3::new(s.sin() * phi.cos(), s.sin() * phi.sin(), s.cos());
    let d = Geometry::from_directions(light, viewer, DVec3::Z);
    v.error((g.vxy2_by_k2 - d.vxy2_by_k2).abs().max((g.cos_half2 - d.cos_half2).abs()));
    v.error((g.vx_by_k.hypot(g.vy_by_k).powi(2) - g.vxy2_by_k2).abs());
}

fn draw_directions(d: &mut Draw) -> Case {
    let size = if d.pick(2) == 0.0 { 1.0 } else { d.log(1e-300, 1e300) };
    case([d.angle(), d.angle(), d.angle(), size, d.anything(), d.pick(8)])
}

fn directions(&[i, s, phi, size, odd, place, ..]: &Case, v: &mut Verdict) {
    let light = DVec3::new(-i.sin(), 0.0, i.cos());
    let mut viewer = DVec3::new(s.sin() * phi.cos(), s.sin() * phi.sin(), s.cos()) * size;
    if place < 3.0 {
        viewer[place.max(0.0) as usize] = odd;
    }
    for (l, w) in [(light, viewer), (viewer, light)] {
        let normal = DVec3::new(0.6, 0.0, 0.8);
        let careful = Geometry::from_directions(l, w, normal);
        whole(&careful, v);
        let (quick, sure) = Geometry::from_directions_branchless(l, w, normal);
        v.holds("quick is otherwise", !sure || quick == careful);
        v.holds("lit in the dark", !careful.is_lit() || careful.cos_i > 0.0 && careful.cos_s > 0.0);
    }
}

fn draw_anything(d: &mut Draw) -> Case {
    case([d.anything(), d.anything(), d.anything(), d.anything(), d.anything()])
}

fn surface(&[sigma, tau, x, y, index, ..]: &Case, v: &mut Verdict) {
    let usual = Surface::new(1e-6, 1e-5, 1e-4, 1e-4, 1.5).expect("a usual surface");
    let rough = usual.with_sigma(sigma);
    v.holds("σ beyond 0 to 1 m", (0.0..=1.0).contains(&rough.sigma_m()));
    v.holds("τ beyond 1 nm to 1 m", (1e-9..=1.0).contains(&usual.with_tau(tau).tau_m()));
    let Ok(surface) = Surface::new(sigma, tau, x, y, index) else { return v.refuse() };
    v.all_finite([surface.area_m2(), surface.slope(), surface.index(), surface.half_x_m(), surface.half_y_m()]);
    v.holds("no length", surface.tau_m() > 0.0 && surface.area_m2() > 0.0 && surface.slope() >= 0.0);
    v.holds("more than three cautions", surface.cautions().len() <= 3);
}

fn draw_power(d: &mut Draw) -> Case {
    let sigma = if d.pick(8) == 0.0 { 0.0 } else { d.log(1e-12, 1e3) };
    let length = |d: &mut Draw| if d.pick(2) == 0.0 { d.log(1e-9, 1.0) } else { d.log(1e-6, 1e3) };
    case([sigma, length(d), length(d), d.log(0.01, 1e4), d.angle(), d.angle(), d.angle(), d.log(1e-3, 1e9)])
}

fn power(&[sigma, tau, half, index, i, s, phi, nm]: &Case, v: &mut Verdict) {
    let Ok(surface) = Surface::new(sigma, tau, half, half, index) else { return v.refuse() };
    let returned = directional_hemispherical(&surface, Normalization::Microfacet, i);
    v.all_finite([returned.diffuse, returned.coherent, returned.total()]);
    for surface in [surface, surface.with_area(IlluminatedArea::Xy).with_specular(Specular::Fresnel)] {
        power_of(&surface, [i, s, phi, nm], v);
    }
}

fn power_of(surface: &Surface, [i, s, phi, nm]: [f64; 4], v: &mut Verdict) {
    let surface = *surface;
    let g = Geometry::from_angles(i, s, phi);
    let back = Geometry { cos_i: g.cos_s, cos_s: g.cos_i, ..g };
    let (k, b) = (kappa(&surface, &g), beta(&surface, &g));
    v.holds("κ or β below 0 or infinite", k >= 0.0 && b >= 0.0 && k.is_finite() && b <= 1e150);
    for radius in [0.0, 4.65e-3] {
        let wave_number = std::f64::consts::TAU / (nm * 1e-9);
        let pattern = rho0_squared(&g, &surface, wave_number, radius);
        v.holds("ρ0² not from 0 to 1", (0.0..=1.0 + 1e-14).contains(&pattern));
        v.holds(
            "ρ0² above its bound",
            pattern <= rho0_squared_bound(&g, &surface, wave_number, radius) * (1.0 + 1e-9) + 1e-14,
        );
        for reading in
            [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet, Normalization::Lambertian]
        {
            let value = factor(&surface, &g, nm, reading, radius);
            v.finite(value);
            v.holds("below 0", value >= 0.0);
            v.holds("light in the dark", g.is_lit() || value == 0.0);
            let parts = factors(&surface, &g, nm, reading, radius);
            v.holds("not the sum of its parts", parts[0] >= 0.0 && parts[1] >= 0.0 && parts[0] + parts[1] >= value);
            let (diffuse, coherent) =
                (diffuse_prefactor(&surface, &g, reading), coherent_prefactor(&surface, &g, reading));
            v.holds("a prefactor below 0 or infinite", diffuse >= 0.0 && coherent >= 0.0 && diffuse + coherent < 1e151);
            if reading == Normalization::Microfacet && radius == 0.0 {
                // Light and viewer can be exchanged.
                v.relative(factor(&surface, &back, nm, reading, radius), value, 0.0);
            }
        }
    }
    v.holds("another power", wavelength_power(Normalization::Paper) == 0);
}
