//! A rough dielectric surface, and what the paper leaves open: its area, its specular reflection, the meaning of its P.

use chromascope_color::units::{bits, eq_by};
use chromascope_text::choices;
use std::fmt;
use std::ops::RangeInclusive;

/// The largest height deviation, in meters.
const SIGMA_M: RangeInclusive<f64> = 0.0..=1.0;
/// Correlation lengths and half-widths, in meters.
const LENGTH_M: RangeInclusive<f64> = 1e-9..=1.0;
/// The largest refractive index.
const LARGEST_INDEX: f64 = 1000.0;

/// Reason that numbers are not a surface of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum SurfaceError {
    #[error("the height deviation must lie between 0 and 1 m")]
    Sigma,
    #[error("the correlation length must lie between 1 nm and 1 m")]
    Tau,
    #[error("the patch's half sides must lie between 1 nm and 1 m")]
    Patch,
    #[error("the refractive index must be positive and at most 1000")]
    Index,
}

choices! {
    /// The area A of the coherently illuminated patch with half-widths X and Y.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    pub enum IlluminatedArea {
        /// A = 4XY: with the arguments `v_x X` and `v_y Y` of the paper's sinc the patch is 2X by 2Y, and only with this area does
        /// the coherent lobe of a smooth surface hold all that its boundary reflects.
        #[default]
        #[cfg_attr(feature = "serde", serde(rename = "4xy"))]
        FourXy = "4xy", "A = 4XY",
            "With the paper's sinc(v_x X) sinc(v_y Y) the illuminated area is 2X by 2Y: only A = 4XY normalizes the coherent lobe, \
             so that a smooth surface returns what its boundary reflects.";
        /// A = XY, as the paper prints it. Radiometrically three quarters of the coherent component are lost; in the paper's own
        /// normalization the diffuse component is four times stronger relative to the coherent one.
        Xy = "xy", "A = XY",
            "As printed in the paper. Three quarters of the coherent component are lost; with the normalization Paper, Eq 1–12, \
             the diffuse component is four times stronger instead.";
    }
}

impl IlluminatedArea {
    /// A / XY.
    const fn factor(self) -> f64 {
        match self {
            Self::FourXy => 4.0,
            Self::Xy => 1.0,
        }
    }
}

choices! {
    /// The reflectance factor of the coherent (specular) component.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    pub enum Specular {
        /// The paper's: no Fresnel factor, and S(λ) multiplies it, as if the boundary were a perfect mirror of the material's
        /// color. At n = 1.4 and normal incidence 36 times brighter than a dielectric.
        #[default]
        Paper = "paper", "As in the paper",
            "Eq 1 has no Fresnel factor, and S(λ) multiplies the coherent component too: a specular reflection in the material's \
             color, at n = 1.4 and normal incidence 36 times as bright as a dielectric's.";
        /// Fresnel's reflectance at the half vector, independent of S(λ): a dielectric boundary reflects all wavelengths alike.
        Fresnel = "fresnel", "Fresnel, untinted",
            "The coherent component times Fresnel's reflectance at the half vector, without S(λ): the specular reflection of a \
             dielectric has the color of the light.";
    }
}

/// The roughness, illuminated area and refractive index of a surface. Lengths in meters.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    sigma_m: f64,
    tau_m: f64,
    half_x_m: f64,
    half_y_m: f64,
    index: f64,
    area: IlluminatedArea,
    specular: Specular,
}

impl Surface {
    /// Surface with another RMS roughness in meters, clamped to 0 to 1 m; NaN counts as 0.
    #[must_use]
    pub fn with_sigma(self, sigma_m: f64) -> Self {
        Self { sigma_m: if sigma_m > 0.0 { sigma_m.min(*SIGMA_M.end()) } else { 0.0 }, ..self }
    }

    /// This surface with another correlation length in meters; values outside 1 nm to 1 m count as the nearest end, NaN as 1 nm.
    #[must_use]
    pub fn with_tau(self, tau_m: f64) -> Self {
        let (low, high) = (*LENGTH_M.start(), *LENGTH_M.end());
        Self { tau_m: if tau_m > low { tau_m.min(high) } else { low }, ..self }
    }

    /// This surface with another area of the illuminated patch.
    #[must_use]
    pub const fn with_area(self, area: IlluminatedArea) -> Self {
        Self { area, ..self }
    }

    /// This surface with another reflectance factor of the coherent component.
    #[must_use]
    pub const fn with_specular(self, specular: Specular) -> Self {
        Self { specular, ..self }
    }

    /// A = 4XY and the paper's coherent component; takes σ from 0 to 1 m, τ and the half-widths X and Y from 1 nm to 1 m, and an index above 0 and up to 1000.
    ///
    /// # Errors
    /// [`SurfaceError`] where a number is outside the model's range.
    ///
    /// ```
    /// use chromascope_core::reflectance::Surface;
    /// let surface = Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4)?;
    /// assert!((surface.area_m2() - 1e-8).abs() < 1e-22);
    /// # Ok::<(), chromascope_core::reflectance::SurfaceError>(())
    /// ```
    pub fn new(sigma_m: f64, tau_m: f64, half_x_m: f64, half_y_m: f64, index: f64) -> Result<Self, SurfaceError> {
        if !SIGMA_M.contains(&sigma_m) {
            return Err(SurfaceError::Sigma);
        }
        if !LENGTH_M.contains(&tau_m) {
            return Err(SurfaceError::Tau);
        }
        if !LENGTH_M.contains(&half_x_m) || !LENGTH_M.contains(&half_y_m) {
            return Err(SurfaceError::Patch);
        }
        if !(index > 0.0 && index <= LARGEST_INDEX) {
            return Err(SurfaceError::Index);
        }
        // Negative zero equals zero, so it must hash as zero.
        let (area, specular) = (IlluminatedArea::default(), Specular::default());
        Ok(Self { sigma_m: sigma_m + 0.0, tau_m, half_x_m, half_y_m, index, area, specular })
    }

    /// σ: the RMS roughness, in meters.
    pub const fn sigma_m(&self) -> f64 {
        self.sigma_m
    }

    /// τ: the correlation length, the lag at which the height autocorrelation has fallen to 1/e, in meters.
    pub const fn tau_m(&self) -> f64 {
        self.tau_m
    }

    /// X: half-width of the coherently illuminated area in the plane of incidence, in meters.
    pub const fn half_x_m(&self) -> f64 {
        self.half_x_m
    }

    /// Y: half-width across the plane of incidence, in meters.
    pub const fn half_y_m(&self) -> f64 {
        self.half_y_m
    }

    /// n: the refractive index, the same at all wavelengths.
    pub const fn index(&self) -> f64 {
        self.index
    }

    /// A: the illuminated area in square meters, 4XY or XY ([`IlluminatedArea`]).
    pub const fn area_m2(&self) -> f64 {
        self.area.factor() * self.half_x_m * self.half_y_m
    }

    /// Area that A of Eq 1 stands for.
    pub const fn area(&self) -> IlluminatedArea {
        self.area
    }

    /// The reflectance factor of the coherent component.
    pub const fn specular(&self) -> Specular {
        self.specular
    }

    /// The heights' root mean square slope, √2 σ/τ.
    pub const fn slope(&self) -> f64 {
        std::f64::consts::SQRT_2 * self.sigma_m / self.tau_m
    }

    /// Limits of validity that this surface exceeds.
    pub fn cautions(&self) -> Vec<Caution> {
        let mut cautions = Vec::new();
        if self.half_x_m.min(self.half_y_m) < 5.0 * self.tau_m {
            cautions.push(Caution::SmallPatch);
        }
        if self.tau_m < LONGEST_VISIBLE_M {
            cautions.push(Caution::ShortCorrelation);
        }
        if self.slope() > 0.4 {
            cautions.push(Caution::Steep);
        }
        cautions
    }
}

/// The end of the grid's range.
const LONGEST_VISIBLE_M: f64 = 780e-9;

/// Limit of the model's validity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Caution {
    /// min(X, Y) < 5 τ.
    SmallPatch,
    /// τ < 780 nm.
    ShortCorrelation,
    /// √2 σ/τ > 0.4.
    Steep,
}

impl Caution {
    /// The limit that is exceeded.
    pub const fn brief(self) -> &'static str {
        match self {
            Self::SmallPatch => "The illuminated area is narrower than ten correlation lengths",
            Self::ShortCorrelation => "The correlation length is shorter than a wavelength",
            Self::Steep => "The RMS slope is above 0.4",
        }
    }

    /// The rest of the sentence: what follows from it.
    const fn rest(self) -> &'static str {
        match self {
            Self::SmallPatch => ": too small to stand for the surface, and the scattered power can exceed 1",
            Self::ShortCorrelation => ": tangent planes no longer stand for the surface",
            Self::Steep => {
                ", the limit of the model: steeper facets shadow each other, which it leaves out, so brightness by \
                 angle is approximate"
            }
        }
    }
}

impl fmt::Display for Caution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.brief(), self.rest())
    }
}

eq_by!(Surface, |of| {
    let numbers = [of.sigma_m, of.tau_m, of.half_x_m, of.half_y_m, of.index];
    (numbers.map(bits), of.area, of.specular)
});

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
