//! Directions of light and view about a surface's normal, as the reflectance model wants them.

use glam::DVec3;

/// Directions of light and view, without wavelength, roughness or index.
///
/// ```text
/// v_x/k = sin θi − sin θs cos φs      along the plane of incidence
/// v_y/k = −sin θs sin φs              across it
/// v_z/k = −(cos θi + cos θs)          the sign is omitted here
/// ```
/// In vectors, with l to the light, v to the viewer, n the normal and h = l + v: `|v_xy|/k = |h × n|`, `|v_z|/k = h·n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// cos θi, the light's zenith cosine; not positive where the light is behind the surface.
    pub cos_i: f64,
    /// cos θs, the viewer's zenith cosine; not positive where the viewer is behind the surface.
    pub cos_s: f64,
    /// `v_x/k`.
    pub vx_by_k: f64,
    /// `v_y/k`.
    pub vy_by_k: f64,
    /// `(v_x² + v_y²)/k²`.
    pub vxy2_by_k2: f64,
    /// `|v_z|/k = cos θi + cos θs`; positive where the surface is lit and seen.
    pub vz_by_k: f64,
    /// (l·ĥ)²: the squared cosine between the light and the unit half vector.
    pub cos_half2: f64,
}

impl Geometry {
    /// No light and no view: what directions that are no numbers come to.
    pub const DARK: Self =
        Self { cos_i: 0.0, cos_s: 0.0, vx_by_k: 0.0, vy_by_k: 0.0, vxy2_by_k2: 0.0, vz_by_k: 0.0, cos_half2: 0.0 };

    /// From zenith angles and azimuth in radians, with φi = π: the specular direction is θs = θi, φs = 0.
    ///
    /// Differences of sines are written as products, so that all digits survive next to the specular direction:
    /// ```text
    /// a = sin θi − sin θs = (cos θi + cos θs) tan((θi − θs)/2)
    /// v_x/k = a + 2 sin θs sin²(φs/2)
    /// v_xy²/k² = a² + 4 sin θi sin θs sin²(φs/2)
    /// ```
    pub fn from_angles(theta_i: f64, theta_s: f64, phi_s: f64) -> Self {
        if !(theta_i.is_finite() && theta_s.is_finite() && phi_s.is_finite()) {
            return Self::DARK;
        }
        let (sin_i, cos_i) = theta_i.sin_cos();
        let (sin_s, cos_s) = theta_s.sin_cos();
        let half_phi2 = (phi_s / 2.0).sin().powi(2);
        // The halves are taken apart because the difference of the largest angles overflows.
        let apart = (cos_i + cos_s) * (theta_i / 2.0 - theta_s / 2.0).tan();
        // Where one of the angles is past the zenith the second term is negative; rounding must not carry the sum below zero.
        let vxy2 = (apart * apart + 4.0 * sin_i * sin_s * half_phi2).max(0.0);
        Self::new([cos_i, cos_s], [apart + 2.0 * sin_s * half_phi2, -sin_s * phi_s.sin()], vxy2)
    }

    /// From unit vectors: to the light, to the viewer, and the normal.
    ///
    /// No angle is computed, and near the specular direction `h × n` loses no more than the vectors' own rounding. At normal
    /// incidence the plane of incidence is any.
    pub fn from_directions(to_light: DVec3, to_viewer: DVec3, normal: DVec3) -> Self {
        if !(to_light.is_finite() && to_viewer.is_finite() && normal.is_finite()) {
            return Self::DARK;
        }
        // The part of h along the surface, turned by a right angle: taken from h × n alone, free of h's large normal part.
        let turned = normal.cross(to_light + to_viewer);
        let across = across_incidence(to_light, normal);
        let along = across.cross(normal);
        let v = [-turned.dot(across), turned.dot(along)];
        Self::new([normal.dot(to_light), normal.dot(to_viewer)], v, turned.length_squared())
    }

    /// [`Self::from_directions`] without a branch, and true if the result holds: not where a vector is NaN, nor so near to normal
    /// incidence that the plane of incidence is undefined.
    #[inline(always)]
    pub fn from_directions_branchless(to_light: DVec3, to_viewer: DVec3, normal: DVec3) -> (Self, bool) {
        let turned = normal.cross(to_light + to_viewer);
        let cross = to_light.cross(normal);
        let within = cross - normal * normal.dot(cross);
        let stretch = within.length_recip();
        let across = within * stretch;
        let [cos_i, cos_s] = [normal.dot(to_light), normal.dot(to_viewer)];
        let [vx_by_k, vy_by_k] = [-turned.dot(across), turned.dot(across.cross(normal))];
        let (vxy2_by_k2, vz_by_k) = (turned.length_squared(), cos_i + cos_s);
        let cos_half2 = (vxy2_by_k2 + vz_by_k * vz_by_k) / 4.0;
        let all = Self { cos_i, cos_s, vx_by_k, vy_by_k, vxy2_by_k2, vz_by_k, cos_half2: cos_half2.min(1.0) };
        // Whatever is no number or infinite is so in one of these as well.
        let finite = cos_half2.is_finite() && vx_by_k.is_finite() && vy_by_k.is_finite();
        (all, finite && stretch > 0.0 && stretch.is_finite() && cross.length_squared() >= 1e-24)
    }

    fn new([cos_i, cos_s]: [f64; 2], [vx_by_k, vy_by_k]: [f64; 2], vxy2_by_k2: f64) -> Self {
        let vz_by_k = cos_i + cos_s;
        // |l + v|² = 2 + 2 l·v, and l·ĥ is half of |l + v|.
        let cos_half2 = (vxy2_by_k2 + vz_by_k * vz_by_k) / 4.0;
        let all = Self { cos_i, cos_s, vx_by_k, vy_by_k, vxy2_by_k2, vz_by_k, cos_half2: cos_half2.min(1.0) };
        if vxy2_by_k2.is_finite() && cos_half2.is_finite() && vx_by_k.is_finite() && vy_by_k.is_finite() {
            all
        } else {
            Self::DARK
        }
    }

    /// True if both light and viewer are in front of the surface.
    #[inline]
    pub fn is_lit(&self) -> bool {
        self.cos_i > 0.0 && self.cos_s > 0.0
    }
}

/// A unit vector in the surface, across the plane of incidence; any where there is no such plane.
fn across_incidence(to_light: DVec3, normal: DVec3) -> DVec3 {
    let cross = to_light.cross(normal);
    // Near normal incidence the cross product is rounding, with a part along the normal.
    let within = cross - normal * normal.dot(cross);
    let any = || normal.try_normalize().unwrap_or(DVec3::Z).any_orthonormal_vector();
    if cross.length_squared() < 1e-24 { any() } else { within.try_normalize().unwrap_or_else(any) }
}
