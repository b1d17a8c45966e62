//! Equations: white balance, falloff of the lens, normalization of the reflectance model.

use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::{GeometryQuery, MeshQuery, VisibilityQuery};
use chromascope_core::reflectance::{Geometry, Normalization, factor};
use chromascope_core::render::{RasterSize, Reach, Shadows};
use chromascope_core::scene::Viewpoint;
use chromascope_core::scene::lighting::Lighting;
use chromascope_core::spectral::SpectralDistribution;
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};

use super::claim::{Finding, Subject, Value};
use crate::document::render::{BALANCE, RenderSettings, SKIN};
use crate::document::{Document, Light, SetKind};
use crate::scene::SceneError;

pub(super) fn balance(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    const PRINTED: [f64; 3] = [1.1040, 0.9870, 0.8233];
    let document = subject.in_sun(SKIN);
    let target = subject.scene(&document).white()?.0;
    let channels = ["R", "G", "B"].into_iter().zip(target);
    let values = channels.map(|(channel, number)| Value::new(format!("{channel} of {BALANCE}"), "", number, "", 4));
    let same = target.iter().zip(PRINTED).all(|(own, printed)| (own - printed).abs() <= 0.5e-4);
    Ok(Finding::on(Some(same), values))
}

pub(super) fn falloff(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    const SIDE: u32 = 64;
    const FIELD_DEG: f64 = 30.0;
    let field = FIELD_DEG.to_radians();
    // So near that the square fills the picture.
    let Ok(viewpoint) = Viewpoint::new(0.0, 0.0, 1.05, field) else {
        return Ok(Finding::on(None, []));
    };
    let size = RasterSize { width: SIDE, height: SIDE, samples: 1 };
    let visibility = VisibilityQuery { mesh: MeshQuery::Plane, viewpoint, size };
    let lighting = Lighting::from_angles(0.0, 0.0, 0.0)?;
    let image =
        subject.results.ask(&GeometryQuery { visibility, lighting, shadows: Shadows::Off, reach: Reach::default() });
    let falloffs = (*image).iter().flat_map(|image| image.angles()).map(|angles| f64::from(angles.falloff));
    let corner = falloffs.reduce(f64::min).unwrap_or(f64::NAN);
    // The middle of the corner's pixel.
    let tangent = (field / 2.0).tan() * (1.0 - 1.0 / f64::from(SIDE)) * std::f64::consts::SQRT_2;
    let expected = tangent.atan().cos().powi(4);
    let name = format!("cos⁴ α in the corner of a picture of {FIELD_DEG:.0}°");
    let values = [Value::new(name, "", corner, "", 3)];
    Ok(Finding::on(Some((corner - expected).abs() < 1e-4), values))
}

pub(super) fn tint(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let document = Document { light: Light::Set(BALANCE.to_owned()), ..subject.in_sun(SKIN) };
    let scene = subject.scene(&document);
    let surface = RenderSettings::default().as_in_the_paper().surface()?;
    let facing = Geometry::from_angles(0.0, 0.0, 0.0);
    let white = |normalization| {
        let nm: Vec<f64> = (0..COUNT).map(wavelength_nm).collect();
        let at = |nm: f64| factor(&surface, &facing, nm, normalization, 0.0);
        let middle = at(550.0);
        let values = nm.iter().map(|nm| at(*nm) / middle).collect();
        let curve = SpectralDistribution::new(nm, values).ok()?;
        Some(PatchSet::new([("rough white".to_owned(), curve)]))
    };
    let mut values = Vec::new();
    let mut places = Vec::new();
    for (name, normalization) in [("as printed", Normalization::Paper), ("radiometric", Normalization::Radiometric)] {
        let Some(patches) = white(normalization) else { continue };
        let rendering = scene.rendering_of(SetKind::Observer, &document.reference)?;
        let Some(xy) = subject.colors(rendering, patches)?.first().and_then(|color| color.xy) else { continue };
        for (coordinate, number) in [("x", xy.x), ("y", xy.y)] {
            let quantity = format!("{coordinate} of a rough white under {BALANCE}, {name}");
            values.push(Value::new(quantity, "", number, "", 3));
        }
        places.push(xy);
    }
    let white = subject.white(&document)?;
    let stays = places.first().zip(white).map(|(printed, white)| printed.distance(white) < 1e-3);
    Ok(Finding::on(stays, values))
}
