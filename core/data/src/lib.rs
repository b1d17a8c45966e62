//! Spectra that come with Chromascope, as text: one data file for each set, with its source and license in its header.
//!
//! Folders: `cameras`, `observers`, `charts`, `illuminants`, `materials`; `licenses` holds the license texts, `help` the pages of the guide.

use include_dir::{Dir, include_dir};

static ASSETS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../assets");

/// Path below `assets` and text of each file of a folder, in the order of the paths.
///
/// ```
/// assert!(chromascope_data::files("observers").any(|(path, _)| path == "observers/cie_1931_2deg.csv"));
/// ```
pub fn files(folder: &str) -> impl Iterator<Item = (&'static str, &'static str)> + use<> {
    let files = ASSETS.get_dir(folder).into_iter().flat_map(Dir::files);
    files.filter_map(|file| file.path().to_str().zip(file.contents_utf8()))
}

/// Folders below `assets`.
pub fn folders() -> impl Iterator<Item = &'static str> {
    ASSETS.dirs().filter_map(|folder| folder.path().to_str())
}

/// Text of the file at a path below `assets`.
pub fn text(path: &str) -> Option<&'static str> {
    ASSETS.get_file(path).and_then(|file| file.contents_utf8())
}
