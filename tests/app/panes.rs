//! The registry of panes: a pane is a file and its line there.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use chromascope::catalog::Catalog;
use chromascope::catalog::file_store::FileStore;
use chromascope::catalog::opened::Opened;
use chromascope::document::Document;
use chromascope::jobs::{Executor, Later};
use chromascope::panes;
use chromascope::panes::context::{PaneContext, PaneStates};
use chromascope::profiler::{Measured, Profiler};
use chromascope::render_service::RenderService;
use chromascope::scene::Scene;
use chromascope::theme::{self, Theme};
use chromascope::view::{SavedView, View};
use chromascope::workspaces::{Layout, PaneKind, Workspace};
use egui::Ui;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

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
    let mut mended = Layout::default();
    mended.mend(|kind| kinds.contains(&kind));
    assert_eq!(mended, layout, "each stands in a slot that takes it");
}

/// As eframe writes it: the ids are those of every version so far.
const SAVED: &str = "(library_width: Some(240.0), compare: (Some(Chromaticity), Some(Understood), None, Some(Spectra)), \
                     metrics: (Some(Metrics), Some(Correction), Some(HeadToHead), Some(Gamut)), \
                     accuracy: (Some(Accuracy), Some(SkippedWork), Some(Tolerance), Some(RenderSetup)))";

#[test]
fn layouts_of_earlier_versions_open() {
    let mut layout: Layout = ron::from_str(SAVED).unwrap();
    assert_eq!(layout.left_width, Some(240.0));
    layout.mend(|kind| panes::by_kind(kind).is_some());
    // Interpretation is no view of Compare, and what is beside the views is fixed; the page of a camera stays chosen.
    assert_eq!(layout.compare, Layout::default().compare);
    assert_eq!(layout.rank[2], Some(PaneKind::HEAD_TO_HEAD));
    let again = ron::to_string(&layout).unwrap();
    assert!(again.contains("Some(Understood)"), "{again}");
    assert_eq!(ron::from_str::<Layout>(&again).unwrap(), layout);
    assert_eq!(serde_json::from_str::<Layout>(&serde_json::to_string(&layout).unwrap()).unwrap(), layout);
}

#[test]
fn workspaces_of_earlier_versions_open_in_the_place_that_took_them_in() {
    for (earlier, workspace, upper) in [
        ("Compare", Workspace::Compare, PaneKind::CHROMATICITY),
        ("Spectra", Workspace::Compare, PaneKind::SPECTRA),
        ("Render", Workspace::Compare, PaneKind::RENDER),
        ("Metrics", Workspace::Rank, PaneKind::CHROMATICITY),
        ("Import", Workspace::Data, PaneKind::CHROMATICITY),
        ("Accuracy", Workspace::Compare, PaneKind::CHROMATICITY),
    ] {
        let layout = format!("(workspace: {earlier}, layout: {SAVED})");
        let mut saved: SavedView = ron::from_str(&layout).unwrap();
        saved.mend(|kind| panes::by_kind(kind).is_some());
        saved.open_earlier(&ron::from_str(&layout).unwrap());
        assert_eq!((saved.workspace, saved.layout.compare[0]), (workspace, Some(upper)), "{earlier}");
    }
}

/// All of a pane with a slow answer and a state of its own.
mod doubling {
    use chromascope::panes::context::{Pane, PaneContext};
    use chromascope::panes::widgets;
    use chromascope::workspaces::PaneKind;
    use chromascope_core::query::{Ask, Query};
    use egui::{Rect, Ui};

    pub(super) const PANE: Pane = Pane {
        kind: PaneKind::new("Doubling"),
        title: "Doubling",
        show,
        figure: None,
        under_conditions: false,
        table: false,
        tab: "Doubling",
        settings: None,
    };

    #[derive(Clone, PartialEq, Eq, Hash)]
    struct Doubled(u32);

    impl Query for Doubled {
        type Answer = u32;
        const NAME: &'static str = "doubled";

        fn answer(&self, _: &impl Ask) -> u32 {
            2 * self.0
        }
    }

    #[derive(Default)]
    struct Number(u32);

    fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
        let body = widgets::body(ui, &PANE, rect, context, |_, _| {});
        let mut body = widgets::clipped(ui, "doubling", body);
        let number = &mut context.states.of::<Number>().0;
        if body.button("Next").clicked() {
            *number += 1;
        }
        match context.later.ask(PANE.kind, vec![Doubled(*number)]).current() {
            Ok(Some(twice)) => body.label(format!("Twice {number} is {twice}.")),
            Ok(None) => body.weak("computing…"),
            Err(why) => body.label(why),
        };
    }
}

/// A window that shows one thing, in a context of its own.
pub(crate) fn window_of(
    executor: &Executor,
    mut view: View,
    mut show: impl FnMut(&mut Ui, &mut PaneContext<'_>) + 'static,
) -> Harness<'static> {
    let (document, catalog, results) = (Document::colorimetry(), Catalog::built_in(), executor.results());
    let (meshes, images, recorded) =
        (FileStore::on(executor, || {}), FileStore::on(executor, || {}), FileStore::on(executor, || {}));
    let (opened, later) = (Opened::on(executor, || {}), Later::on(executor, || {}));
    let (mut states, mut commands) = (PaneStates::default(), Vec::new());
    let mut render_service = RenderService::on(executor, || {});
    let mut profiler = Profiler { measured: Measured::default() };
    let mut has_fonts = false;
    let mut window = Harness::new_ui(move |ui| {
        if !std::mem::replace(&mut has_fonts, true) {
            return theme::apply(ui.ctx());
        }
        let mut context = PaneContext {
            panes: panes::ALL,
            scene: Scene { document: &document, catalog: &catalog, results: &results },
            theme: Theme::of(ui.visuals()),
            view: &mut view,
            meshes: &meshes,
            images: &images,
            opened: &opened,
            recorded: &recorded,
            later: &later,
            states: &mut states,
            render_service: &mut render_service,
            profiler: &mut profiler,
            commands: &mut commands,
        };
        show(ui, &mut context);
        later.end_frame();
    });
    window.run_steps(2);
    window
}

#[test]
fn a_pane_with_a_slow_answer_is_one_file() {
    let executor = Executor::driven();
    let mut window = window_of(&executor, View::default(), |ui, context| {
        (doubling::PANE.show)(ui, ui.max_rect(), context);
    });
    window.get_by_label("computing…");
    assert!(executor.run_one("doubled"));
    window.run_steps(2);
    window.get_by_label("Twice 0 is 0.");
    window.get_by_label("Next").click();
    window.run_steps(2);
    assert!(window.query_by_label("computing…").is_some() && executor.run_one("doubled"));
    window.run_steps(2);
    window.get_by_label("Twice 1 is 2.");
    assert!(executor.queued().is_empty(), "what is answered is not asked again");
}
