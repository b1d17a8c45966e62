//! Queries that convert a set's values to the form used by the core.

use chromascope_core::camera::{CurveSpread, CurveSpreadError};
use chromascope_core::light::filter::{filtered, transmittance};
use chromascope_core::light::{DaylightBasis, DaylightError, RadiationConstants, planckian::black_body};
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::metrics::LightUncertainty;
use chromascope_core::query::{Ask, Query, Shared};
use chromascope_core::rendition::Standards;
use chromascope_core::spectral::{
    Dataset, DatasetError, DistributionError, Evidence, GridSpectrum, Primaries, Quantity, Sensor, SensorError,
    SpectralDistribution, StatedUncertainty, StatedUncertaintyError,
};
use chromascope_core::units::Kelvin;

use super::{BuiltInFile, Place};
use crate::document::imported::Role;

pub const DAYLIGHT_BASIS: &str = "illuminants/cie_daylight_basis.csv";

pub const CURVE_SPREAD: &str = "uncertainty/curve_spread.csv";

/// Reason that a set's figures cannot be computed with.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    #[error("{0} is missing from this build")]
    Missing(&'static str),
    #[error("{path}: {error}")]
    Damaged { path: &'static str, error: DatasetError },
    #[error("no curve found")]
    NoCurve,
    #[error(transparent)]
    Sensor(#[from] SensorError),
    #[error(transparent)]
    Spread(#[from] CurveSpreadError),
    #[error(transparent)]
    Spectrum(#[from] DistributionError),
    #[error(transparent)]
    Daylight(#[from] DaylightError),
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FileQuery(pub BuiltInFile);

impl Query for FileQuery {
    type Answer = Result<Dataset, LoadError>;
    const NAME: &'static str = "data file";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        Dataset::read(self.0.text).map_err(|error| LoadError::Damaged { path: self.0.path, error })
    }
}

fn asset(path: &'static str, ask: &impl Ask) -> Result<Dataset, LoadError> {
    let text = chromascope_data::text(path).ok_or(LoadError::Missing(path))?;
    (*ask.ask(&FileQuery(BuiltInFile { path, text }))).clone()
}

/// A set's curves with their names, as measured.
pub fn curves(place: &Place, ask: &impl Ask) -> Result<Vec<(String, SpectralDistribution)>, LoadError> {
    match place {
        Place::BuiltIn { file, column } => {
            let file = ask.ask(&FileQuery(*file));
            let file = (*file).as_ref().map_err(Clone::clone)?;
            let named = file.header.columns.iter().cloned().zip(file.curves.iter().cloned());
            Ok(named
                .enumerate()
                .filter(|(index, _)| column.is_none_or(|c| c == *index))
                .map(|(_, curve)| curve)
                .collect())
        }
        Place::Own(set) => Ok(set.curves_in_nm()?),
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SensorQuery(pub Place);

impl Query for SensorQuery {
    type Answer = Result<Shared<Sensor>, LoadError>;
    const NAME: &'static str = "sensor";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let named = curves(&self.0, ask)?;
        let (primaries, response) = match &self.0 {
            Place::BuiltIn { file, .. } => {
                let file = ask.ask(&FileQuery(*file));
                let header = &(*file).as_ref().map_err(Clone::clone)?.header;
                (Primaries::from_columns(&header.columns), header.response())
            }
            Place::Own(set) => (Primaries::Camera, set.response()),
        };
        let found = named.len();
        let three: [SpectralDistribution; 3] = named
            .into_iter()
            .map(|(_, curve)| curve)
            .collect::<Vec<_>>()
            .try_into()
            .map_err(|_| SensorError::NotThree { found })?;
        Ok(Shared::new(Sensor::new(primaries, three, response)?))
    }
}

/// Evidence for what a camera's sensitivities are a response to; what a file of the user's was read as is a guess that is shown.
pub fn response_evidence(place: &Place, ask: &impl Ask) -> Evidence {
    match place {
        Place::BuiltIn { file, .. } => {
            let file = ask.ask(&FileQuery(*file));
            (*file).as_ref().map_or(Evidence::Unknown, |file| file.header.response_evidence())
        }
        Place::Own(_) => Evidence::Inferred,
    }
}

/// Uncertainty that the file of a set of the user's states for its curves, or for those of some names, in their order.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct StatedQuery {
    pub place: Place,
    pub names: Option<&'static [&'static str]>,
}

#[derive(Clone, Debug, Default)]
pub struct Stated {
    /// None where the file states none; for a camera, none unless it states one for each channel.
    pub uncertainty: Option<Shared<StatedUncertainty>>,
    /// Reason that what the file states is not used, or not its covariance.
    pub refused: Option<StatedUncertaintyError>,
}

impl Query for StatedQuery {
    type Answer = Stated;
    const NAME: &'static str = "stated uncertainty";

    fn answer(&self, _: &impl Ask) -> Stated {
        let Place::Own(set) = &self.place else { return Stated::default() };
        let (mut stated, covariance) = (set.uncertainties_in_nm(), set.covariance_in_nm());
        let known = stated.iter().filter(|of| of.is_some()).count();
        let is_used = if set.role == Role::Camera { known == stated.len() } else { known > 0 };
        let Ok(curves) = set.curves_in_nm() else { return Stated::default() };
        if !is_used && covariance.is_none() || stated.len() != curves.len() {
            return Stated::default();
        }
        let index = |name: &&str| curves.iter().position(|(of, _)| of == name);
        let indices = self
            .names
            .map_or_else(|| (0..curves.len()).collect(), |names| names.iter().filter_map(index).collect::<Vec<_>>());
        let length = |at: usize| curves[at].1.values().len();
        let samples = |at: &usize| {
            let first: usize = (0..*at).map(length).sum();
            first..first + length(*at)
        };
        let covariance = covariance.and_then(|of| of.among(&indices.iter().flat_map(samples).collect::<Vec<_>>()));
        let standard = indices.iter().map(|&at| stated[at].take().unwrap_or_else(|| vec![0.0; length(at)])).collect();
        let coverage = set.curves.iter().filter_map(|curve| curve.uncertainty.as_ref()).map(|of| of.coverage);
        let (uncertainty, refused) = match StatedUncertainty::new(standard, coverage.fold(1.0, f64::max)) {
            Err(refused) => (None, Some(refused)),
            Ok(own) => match covariance.map(|of| own.clone().with_covariance(&of.values)) {
                None => (Some(own), None),
                Some(Ok(decided)) => (Some(decided), None),
                Some(Err(refused)) => (is_used.then_some(own), Some(refused)),
            },
        };
        Stated { uncertainty: uncertainty.map(Shared::new), refused }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CurveSpreadQuery;

impl Query for CurveSpreadQuery {
    type Answer = Result<Shared<CurveSpread>, LoadError>;
    const NAME: &'static str = "curve spread";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        Ok(Shared::new(CurveSpread::from_dataset(&asset(CURVE_SPREAD, ask)?)?))
    }
}

#[derive(Clone, Debug)]
pub struct LoadedLight {
    /// As measured, or as the formula gives it.
    pub measured: SpectralDistribution,
    pub grid: Shared<GridSpectrum>,
    /// Uncertainty that its file states.
    pub stated: Option<Shared<LightUncertainty>>,
}

impl LoadedLight {
    fn new(measured: SpectralDistribution) -> Self {
        let grid = Shared::new(GridSpectrum::resample(&measured, Quantity::Light));
        Self { measured, grid, stated: None }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum LightQuery {
    Set(Place),
    BlackBody(Kelvin),
    Daylight(Kelvin),
}

impl Query for LightQuery {
    type Answer = Result<LoadedLight, LoadError>;
    const NAME: &'static str = "light";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        match self {
            Self::Set(place) => {
                let (_, measured) = curves(place, ask)?.into_iter().next().ok_or(LoadError::NoCurve)?;
                let stated = ask.ask(&StatedQuery { place: place.clone(), names: None }).uncertainty.clone();
                let stated = stated.map(|stated| {
                    let (measured, stated) = (measured.clone(), (*stated).clone());
                    Shared::new(LightUncertainty { measured, stated, transmittance: None })
                });
                Ok(LoadedLight { stated, ..LoadedLight::new(measured) })
            }
            Self::BlackBody(temperature) => {
                let grid = black_body(*temperature, RadiationConstants::Paper);
                let nm = (0..grid.values().len()).map(chromascope_core::spectral::grid::wavelength_nm).collect();
                Ok(LoadedLight::new(SpectralDistribution::new(nm, grid.values().to_vec())?))
            }
            Self::Daylight(temperature) => {
                let basis = DaylightBasis::new(&asset(DAYLIGHT_BASIS, ask)?)?;
                Ok(LoadedLight::new(basis.light(*temperature)?))
            }
        }
    }
}

/// Transmittance of a filter on the grid; the first curve of a set of several.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FilterQuery(pub Place);

impl Query for FilterQuery {
    type Answer = Result<Shared<GridSpectrum>, LoadError>;
    const NAME: &'static str = "filter";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let (_, measured) = curves(&self.0, ask)?.into_iter().next().ok_or(LoadError::NoCurve)?;
        Ok(Shared::new(GridSpectrum::resample(&measured, Quantity::Reflectance)))
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FilteredLightQuery {
    pub light: LightQuery,
    /// Transmittances of the filters, in any order.
    pub filters: Vec<Shared<GridSpectrum>>,
}

impl Query for FilteredLightQuery {
    type Answer = Result<LoadedLight, LoadError>;
    const NAME: &'static str = "filtered light";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let light = ask.ask(&self.light);
        let light = (*light).as_ref().map_err(Clone::clone)?;
        let all = transmittance(self.filters.iter().map(|filter| &**filter));
        let behind = |of: &Shared<LightUncertainty>| {
            Shared::new(LightUncertainty { transmittance: Some(all.clone()), ..(**of).clone() })
        };
        Ok(LoadedLight {
            measured: filtered(&light.measured, &all)?,
            grid: Shared::new(light.grid.times(&all)),
            stated: light.stated.as_ref().map(behind),
        })
    }
}

/// Observers, samples and basis of rendition indices.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct StandardsQuery;

impl Query for StandardsQuery {
    type Answer = Result<Shared<Standards>, LoadError>;
    const NAME: &'static str = "rendition standards";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let file = |path| asset(path, ask);
        let patches = |path| file(path).map(|file| PatchSet::from_dataset(&file));
        let observer = |path| Ok::<_, LoadError>(Sensor::from_dataset(&file(path)?)?);
        Ok(Shared::new(Standards {
            cie_1931: observer("observers/cie_1931_2deg.csv")?,
            cie_1964: observer("observers/cie_1964_10deg.csv")?,
            daylight: DaylightBasis::new(&file(DAYLIGHT_BASIS)?)?,
            test_colors: patches("test-samples/cri_14.csv")?,
            evaluation_colors: patches("test-samples/ces_99.csv")?,
        }))
    }
}

/// A chart, or single reflectances; with names, only those patches in that order.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PatchesQuery {
    pub place: Place,
    pub names: Option<&'static [&'static str]>,
}

impl Query for PatchesQuery {
    type Answer = Result<Shared<PatchSet>, LoadError>;
    const NAME: &'static str = "patches";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let mut named = curves(&self.place, ask)?;
        if let Some(names) = self.names {
            // Only visible curves are resampled.
            named = names.iter().filter_map(|name| named.iter().find(|(n, _)| n == name).cloned()).collect();
        }
        Ok(Shared::new(PatchSet::new(named)))
    }
}
