//! Names by which raw developers know cameras.

use crate::catalog::names::model_of;

/// Names of the library and `UniqueCameraModel` of raw files, as rows of a data file.
const MODELS: &str = "models/unique_camera_model.csv";

/// Camera model as its raw files state it (DNG's `UniqueCameraModel`), by which raw developers offer a profile: that of the table of
/// names, else the camera's name without the parenthesis that distinguishes tables of one model.
pub fn unique_camera_model(camera: &str) -> String {
    let model = model_of(camera);
    let rows = chromascope_data::text(MODELS).unwrap_or_default().lines();
    let known = rows.filter_map(|row| row.split_once(',')).find(|(name, _)| *name == model);
    known.map_or(model, |(_, known)| known).to_owned()
}
