//! The choice that the paper leaves: what its P stands for.

use chromascope_text::choices;

choices! {
    /// Quantity that the scattered power P of Eq 12 stands for.
    ///
    /// P is Beckmann's power relative to that of a smooth mirror of the same patch: dimensionless, and no reflectance
    /// distribution. Put into Eq 12 as it stands, it tints: on a rough surface P goes with λ², so that a white under D55 comes out
    /// mustard.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    pub enum Normalization {
        /// π f with the bidirectional reflectance `f = A/(λ² cos θs) (cos θi ρ0² e^-g + D)`, in 1/sr.
        ///
        /// The default: a smooth surface returns what its boundary reflects, no surface returns more than falls on it (to 0.4 % for indices from
        /// 1.2 on), and rough surfaces scatter all wavelengths alike, as geometrical optics demands. Energy is not conserved: without multiple
        /// scattering steep surfaces and grazing light lose most of it ([`super::directional_hemispherical`]).
        #[default]
        Radiometric = "radiometric", "Radiometric",
            "A rough white surface remains white. Scattered radiance per incident irradiance: Eq 1 times A / (λ² cos θs).";
        /// P itself, Eq 1–3 as printed but for A, which is 4XY or XY ([`super::IlluminatedArea`]): for reproducing the paper.
        Paper = "paper", "Paper, Eq 1–12",
            "Eq 4 is proportional to λ² without a compensating λ⁻², so rough surfaces turn yellow. Eq 1 to 12 as printed, except \
             for A, which is set with X and Y: a white surface under D55 moves from xy (0.332, 0.347) to (0.373, 0.379).";
        /// π f with the form factor cos θi in G² replaced by Beckmann's own, `4 (l·ĥ)⁴/(cos θi (cos θi + cos θs)²)`.
        ///
        /// The diffuse component is reciprocal (Helmholtz). The coherent one is not: X lies in the plane of incidence, which turns
        /// when light and viewer are exchanged. On rough surfaces f equals a microfacet reflectance without shadowing, with
        /// Beckmann's slope distribution of roughness 2σ/τ.
        Microfacet = "microfacet", "Microfacet",
            "Only the diffuse component is reciprocal (Helmholtz). Beckmann's own geometric factor in place of the cos θi of Eq 3.";
        /// 1: a surface that scatters evenly, whatever its roughness.
        Lambertian = "lambertian", "Lambertian", "The fastest, as a baseline. No model: equal in all directions.";
    }
}
