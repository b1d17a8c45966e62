//! Measured radiances as `patches` takes them: integrated as they are, balanced to the radiance of a white among them.

use std::path::Path;

use chromascope_core::query::{PatchColor, RadianceColorsQuery, RenderingQuery, Shared};
use chromascope_core::spectral::{GridSpectrum, Quantity};

use super::error::CliError;
use super::request::{Request, display_path};
use crate::catalog::names::{NameError, folded};
use crate::document::SetKind;
use crate::document::imported::Role;
use crate::scene::{Scene, SceneError};

/// Radiances with their names, and which of them is that of a perfect diffuser.
pub(super) struct Radiances {
    /// The names of the curves.
    pub(super) names: Vec<String>,
    spectra: Vec<Shared<GridSpectrum>>,
    white: Option<usize>,
}

impl Radiances {
    /// Reads a file of radiances.
    pub(super) fn open(request: &mut Request, file: &Path, white: Option<&str>) -> Result<Self, CliError> {
        let set = request.read(file, Role::Illuminant)?;
        let curves = set.curves_in_nm().map_err(|error| CliError::File(format!("{}: {error}", display_path(file))))?;
        let names: Vec<String> = curves.iter().map(|(name, _)| name.clone()).collect();
        let white = white.map(|white| index_of(&names, white)).transpose()?;
        let on_grid = |(_, curve)| Shared::new(GridSpectrum::resample(&curve, Quantity::Light));
        Ok(Self { spectra: curves.into_iter().map(on_grid).collect(), names, white })
    }

    /// The conditions' name for what the radiances are balanced to.
    pub(super) fn illuminant(&self) -> String {
        match self.white.and_then(|index| self.names.get(index)) {
            Some(name) => format!("radiance of {name}"),
            None => "radiance; white at equal energy".to_owned(),
        }
    }

    /// The colors through a sensor. Without a white among the radiances there is no L*a*b*.
    pub(super) fn colors(&self, scene: &Scene<'_>, kind: SetKind, name: &str) -> Result<Vec<PatchColor>, SceneError> {
        let adopted = self.white.and_then(|index| self.spectra.get(index)).cloned();
        let light = adopted.clone().unwrap_or_else(|| Shared::new(GridSpectrum::constant(1.0)));
        let sensor = scene.sensor(kind, name)?;
        let rendering = RenderingQuery { sensor, light, white: scene.white()?, transform: scene.transform()? };
        let mut colors = scene.rendered(&RadianceColorsQuery { rendering, radiances: self.spectra.clone() }, name)?;
        if adopted.is_none() {
            for color in &mut colors {
                color.lab = None;
            }
        }
        Ok(colors)
    }
}

/// The index of the radiance of this name, case and punctuation aside.
fn index_of(names: &[String], typed: &str) -> Result<usize, NameError> {
    let wanted = folded(typed);
    let exact = names.iter().position(|name| name == typed);
    let unknown = || {
        let nearest = names.iter().take(5).cloned().collect();
        NameError::Unknown { kind: "radiance", name: typed.to_owned(), nearest }
    };
    exact.or_else(|| names.iter().position(|name| folded(name) == wanted)).ok_or_else(unknown)
}
