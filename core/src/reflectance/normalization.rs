//! The choice that the paper leaves: what its P stands for.

/// Quantity that the scattered power P of Eq 12 stands for.
///
/// P is Beckmann's power relative to that of a smooth mirror of the same patch: dimensionless, and no reflectance
/// distribution. Put into Eq 12 as it stands, it tints: on a rough surface P goes with λ², so that a white under D55 comes out
/// mustard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Normalization {
    /// π f with the bidirectional reflectance `f = A/(λ² cos θs) (cos θi ρ0² e^-g + D)`, in 1/sr.
    ///
    /// The default: a smooth surface returns what its boundary reflects, no surface returns more than falls on it (to 0.4 % for indices from
    /// 1.2 on), and rough surfaces scatter all wavelengths alike, as geometrical optics demands. Energy is not conserved: without multiple
    /// scattering steep surfaces and grazing light lose most of it ([`super::directional_hemispherical`]).
    #[default]
    Radiometric,
    /// P itself, Eq 1–3 as printed but for A, which is 4XY or XY ([`super::IlluminatedArea`]): for reproducing the paper.
    Paper,
    /// π f with the form factor cos θi in G² replaced by Beckmann's own, `4 (l·ĥ)⁴/(cos θi (cos θi + cos θs)²)`.
    ///
    /// The diffuse component is reciprocal (Helmholtz). The coherent one is not: X lies in the plane of incidence, which turns
    /// when light and viewer are exchanged. On rough surfaces f equals a microfacet reflectance without shadowing, with
    /// Beckmann's slope distribution of roughness 2σ/τ.
    Microfacet,
    /// 1: a surface that scatters evenly, whatever its roughness.
    Lambertian,
}
