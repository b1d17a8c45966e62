//! The registry of panes: a pane is a file and its line there.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use chromascope::panes;
use chromascope::workspaces::{Layout, PaneKind, Workspace};

/// Files beside the panes: what panes are made of, and the bars and pages around them.
const BESIDE_PANES: [&str; 7] = ["context", "widgets", "help", "menu", "scene_bar", "status_bar", "figure_page"];

#[test]
fn each_file_of_a_pane_is_registered_under_its_title() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/panes");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "rs"));
    let mut stems: Vec<String> = files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    stems.retain(|stem| !BESIDE_PANES.contains(&stem.as_str()));
    let mut titles: Vec<String> = panes::ALL.iter().map(|pane| pane.title.to_lowercase().replace(' ', "_")).collect();
    stems.sort();
    titles.sort();
    assert_eq!(stems, titles);
    let kinds: BTreeSet<PaneKind> = panes::ALL.iter().map(|pane| pane.kind).collect();
    assert_eq!(kinds.len(), panes::ALL.len(), "each has an id of its own");
    let layout = Layout::default();
    let mut placed = Workspace::ALL.iter().flat_map(|&workspace| *layout.places(workspace)).flatten();
    assert!(placed.all(|kind| kinds.contains(&kind)), "a layout starts with panes that exist");
}

/// As eframe writes it: the ids are those of every version so far.
const SAVED: &str = "(library_width: Some(240.0), compare: (Some(Chromaticity), Some(Understood), None, Some(Spectra)), \
                     accuracy: (Some(Accuracy), Some(SkippedWork), Some(Tolerance), Some(RenderSetup)))";

#[test]
fn layouts_of_earlier_versions_open() {
    let layout: Layout = ron::from_str(SAVED).unwrap();
    assert_eq!(
        layout.compare,
        [Some(PaneKind::CHROMATICITY), Some(PaneKind::INTERPRETATION), None, Some(PaneKind::SPECTRA)]
    );
    let accuracy = [PaneKind::METHODS, PaneKind::new("SkippedWork"), PaneKind::TOLERANCE, PaneKind::RENDER_SETTINGS];
    assert_eq!(layout.numerics, accuracy.map(Some));
    let again = ron::to_string(&layout).unwrap();
    assert!(again.contains("Some(Understood)"), "{again}");
    assert_eq!(ron::from_str::<Layout>(&again).unwrap(), layout);
    assert_eq!(serde_json::from_str::<Layout>(&serde_json::to_string(&layout).unwrap()).unwrap(), layout);
}

#[test]
fn a_pane_that_is_not_there_leaves_its_place_empty() {
    let mut layout: Layout = ron::from_str(&SAVED.replace("Spectra", "Gamut")).unwrap();
    assert_eq!(layout.compare[3], Some(PaneKind::new("Gamut")));
    layout.retain(|kind| panes::by_kind(kind).is_some());
    assert_eq!(layout.compare[3], None);
    assert_eq!(layout.library_width, Some(240.0));
    assert_eq!(layout.compare[0], Some(PaneKind::CHROMATICITY));
}
