//! View state: selection, panes and layout. Not part of the document, and not undoable.

pub mod correction;
mod help;
pub mod import;
mod places;
pub mod recorded;
pub mod template;
pub mod tour;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::mem::take;
use std::path::PathBuf;

use chromascope_core::metamers::Confusion;
use chromascope_core::query::Shared;
use chromascope_figure::Tag;
use chromascope_text::{Look, Pick, Setting, Settings, choices, place, settings, words_of};
use correction::CorrectionView;
use import::{ImportItem, ImportMemory, ImportView};
use recorded::RecordedView;
use serde::{Deserialize, Serialize};

use crate::document::imported::ImportedSet;
use crate::document::{Compared, SetKind};
use crate::export::Paper;
use crate::figures::chromaticity::shown::DiagramView;
use crate::figures::look::FigureLook;
use crate::figures::metrics::TABLE;
use crate::figures::report_card;
use crate::paint::Emphasis;
use crate::plot_item::{PickIndex, PlotItem, Relation, SensorId};
use crate::scene::Scene;
use crate::theme::Surround;
use crate::workspaces::{Layout, PaneKind, Workspace};

pub use help::{HelpView, PickState};

pub use crate::figures::chromaticity::shown::{DiagramFit, Ranges};
pub use crate::figures::look::{DifferencePlane, Sorting};
pub use crate::figures::look::{PixelPlace, RenderMode};
pub use crate::figures::look::{Shows, SpectraLayout, SwatchLayout, SwatchStyle};
pub use crate::scene::metrics::RankedCameras;
pub use crate::scene::orbit::Orbit;

#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent one-frame requests and switches")]
pub struct View {
    pub saved: SavedView,
    /// Under the pointer now, in any pane.
    pub hovered: Option<PlotItem>,
    /// Under the pointer in the frame that is being made; becomes `hovered` at its end.
    pub next_hovered: Option<PlotItem>,
    /// Text of the coordinates under the pointer, where it is over no item.
    pub point: Option<String>,
    pub selected: Option<PlotItem>,
    /// True if the selection belongs to a sensor that is not compared: nothing drawn is dimmed for it.
    pub selected_elsewhere: bool,
    pub pinned: Vec<PlotItem>,
    pub search: String,
    pub maximized: Option<PaneKind>,
    /// The pane that keys and exports mean.
    pub focused: Option<PaneKind>,
    /// True if the column that a narrow window omits lies over the center.
    pub column_over: bool,
    /// A pane in place of the right column, until it is closed.
    pub card: Option<PaneKind>,
    /// True while the page on the program's own methods takes the place of the workspace.
    pub numerics: bool,
    /// The view of Compare that had the focus last: the settings beside are its.
    pub settings_of: Option<PaneKind>,
    /// True while cameras are added to the comparison.
    pub adding: bool,
    pub diagram: DiagramView,
    /// Other plots that are zoomed, by pane: the title of the figure, and its ranges.
    pub zoomed: HashMap<PaneKind, (String, Ranges)>,
    pub import: ImportView,
    pub render: RenderView,
    pub correction: CorrectionView,
    pub shows: Shows,
    pub recorded: RecordedView,
    /// The pane that is shown as a page; `None` while panes are shown.
    pub page: Option<PaneKind>,
    /// Plots show their own ranges again in this frame.
    pub reset_plots: bool,
    /// True while B is held: the reference replaces every camera.
    pub blink: bool,
    pub focus_search: bool,
    /// True if a field has the keyboard in which Esc discards the typed text.
    pub keeps_escape: bool,
    /// True if the focused pane shows a table, which copies its own rows.
    pub table_copies: bool,
    pub focus_temperature: bool,
    pub help: HelpView,
    pub tour: Option<(tour::Tour, usize)>,
    pub about: bool,
    /// Share of the loci that is drawn, while they draw in.
    pub locus_share: Option<f64>,
    /// Time of egui in seconds at which the loci began to draw in.
    pub draws_since: Option<f64>,
    pub palette: Option<PickState>,
    /// The keyboard walks through panes: the pane that has it is framed.
    pub by_keyboard: bool,
    /// Under the keyboard in the pane that has it.
    pub cursor: Option<PlotItem>,
    /// Tab leads into the pane that has the keyboard.
    pub tab_enters: bool,
    /// An arrow key does so in the next frame.
    pub arrow_enters: bool,
    /// Times are neither shown nor renewed: for pictures that are compared.
    pub fixed_clock: bool,
    /// Documents that other windows saved, with their ages.
    pub other_documents: Vec<(PathBuf, String)>,
    pub templates: Vec<(String, PathBuf)>,
    pub status: Status,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportOn {
    /// What is compared, under its conditions.
    Comparison,
    Paper,
    /// The paper with the cameras and patches that are compared.
    Document,
    /// The built-in data sets as files.
    Library,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SavedView {
    pub workspace: Workspace,
    pub layout: Layout,
    /// Panes that show their numbers instead of their picture.
    pub tables: BTreeSet<PaneKind>,
    /// Order and columns of tables, by table.
    pub looks: BTreeMap<String, TableLook>,
    pub metrics: MetricsLook,
    pub surround: Surround,
    /// True if the diagram fits the data or shows all.
    pub diagram_fit: DiagramFit,
    pub swatch_layout: SwatchLayout,
    pub swatch_style: SwatchStyle,
    pub spectra_layout: SpectraLayout,
    pub difference_bars: bool,
    pub difference_plane: DifferencePlane,
    /// Nothing moves by itself.
    pub reduced_motion: bool,
    /// The loci are to draw in, as on the first start.
    pub draws_in: bool,
    pub folded: BTreeSet<String>,
    #[serde(with = "crate::document::paths::list")]
    pub recent: Vec<PathBuf>,
    pub render: RenderLook,
    pub import: ImportMemory,
    pub page: PageLook,
}

impl Default for SavedView {
    fn default() -> Self {
        Self {
            workspace: Workspace::default(),
            layout: Layout::default(),
            tables: BTreeSet::new(),
            looks: BTreeMap::new(),
            metrics: MetricsLook::default(),
            surround: Surround::default(),
            diagram_fit: DiagramFit::default(),
            swatch_layout: SwatchLayout::default(),
            swatch_style: SwatchStyle::default(),
            spectra_layout: SpectraLayout::default(),
            difference_bars: true,
            difference_plane: DifferencePlane::default(),
            reduced_motion: false,
            draws_in: false,
            folded: ["observers", "charts", "illuminants", "materials"].map(str::to_owned).into(),
            recent: Vec::new(),
            render: RenderLook::default(),
            import: ImportMemory::default(),
            page: PageLook::default(),
        }
    }
}

impl Settings for SavedView {
    const ALL: &'static [Setting<Self>] = settings! {
        "diagram_fit" "Diagram" in Setting::DEFAULT, by "zoom range whole", "Ranges of the diagram",
            pick(diagram_fit: DiagramFit, Row), none();
        "swatch_layout" "Swatches" in Setting::DEFAULT, by "layout", "Arrangement of the swatches",
            pick(swatch_layout: SwatchLayout, Row), none();
        "swatch_style" "Swatches" in Setting::DEFAULT, by "style half", "Sensor and reference within a swatch",
            pick(swatch_style: SwatchStyle, Row), none();
        "difference_bars" "Bars under swatches" in Setting::DEFAULT, by "difference", "Differences as bars",
            switch(|look| look.difference_bars, |look, on| look.difference_bars = on), none();
        "difference_plane" "Differences" in Setting::DEFAULT, by "delta arrows displacement loci offset", "Plane of the differences",
            pick(difference_plane: DifferencePlane, Row), none();
        "spectra_layout" "Spectra" in Setting::DEFAULT, by "layout", "Plots of the spectra",
            pick(spectra_layout: SpectraLayout, Row), none();
        "mode" "Pictures" in Setting::DEFAULT, by "render mode maps", "Pictures that are shown", choice(Pick {
            get: |look| place(look.render.mode),
            set: |look, to| look.render.mode = RenderMode::ALL[to],
            all: words_of::<RenderMode>,
            look: Look::Row,
        }), none();
        "surround" "Surround of swatches" in Setting::DEFAULT, by "background grey", "The gray around colors",
            pick(surround: Surround, List), none();
        "reduced_motion" "Reduce motion" in Setting::DEFAULT, by "animation", "Nothing moves by itself",
            switch(|look| look.reduced_motion, |look, on| look.reduced_motion = on), none();
    };
}

/// Workspace of a saved view, of any version: those of earlier ones had the ids of their panes.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct EarlierView {
    workspace: PaneKind,
}

/// Fields that stay with the window when a session is opened or saved.
const OF_WINDOW: [&str; 5] = ["recent", "import", "reduced_motion", "draws_in", "folded"];

impl SavedView {
    pub fn for_session(&self) -> serde_json::Value {
        let mut value = serde_json::to_value(self).unwrap_or_default();
        if let Some(fields) = value.as_object_mut() {
            fields.retain(|key, _| !OF_WINDOW.contains(&key.as_str()));
        }
        value
    }

    pub fn take_session(&mut self, view: Self) {
        let (recent, import, folded) = (take(&mut self.recent), take(&mut self.import), take(&mut self.folded));
        *self = Self { recent, import, folded, draws_in: false, reduced_motion: self.reduced_motion, ..view };
    }

    /// Corrects values of a damaged file that are out of range, and panes that are not where they are now.
    pub fn mend(&mut self, exists: impl Fn(PaneKind) -> bool) {
        self.render.mend();
        self.page.paper.mend();
        self.layout.mend(exists);
    }

    /// Shows what the workspace of an earlier version showed, by its id.
    pub fn open_earlier(&mut self, EarlierView { workspace }: &EarlierView) {
        if [PaneKind::RENDER, PaneKind::SPECTRA].contains(workspace) {
            self.layout.put(Workspace::Compare, 0, *workspace);
        }
    }

    /// View of the first start, under the system's wish for motion.
    pub fn first(reduced_motion: bool) -> Self {
        Self { reduced_motion, draws_in: !reduced_motion, ..Self::default() }
    }
}

/// A message at the foot of the window.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    pub text: String,
    pub weight: Weight,
    /// Import item and line that `[Change]` or `[Show line]` opens.
    pub change: Option<(ImportItem, Option<usize>)>,
    /// Time of egui in seconds when it was first shown.
    pub since: Option<f64>,
    /// What waits for the user's word; the message stays until then.
    pub offers: Vec<Offer>,
    /// The button of the offers takes the keyboard in this frame.
    pub takes_keyboard: bool,
}

/// Something that is done only at the user's word, by a button of a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Offer {
    Use(SetKind, String),
    Open(PathBuf),
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    #[default]
    Note,
    Warning,
    /// Something failed; nothing was changed.
    Error,
}

impl View {
    /// The camera of Rank's page: the selected one, else the first that is compared.
    pub fn camera(&self, scene: &Scene<'_>) -> Option<SensorId> {
        report_card::camera(scene, self.selected.as_ref())
    }

    /// Shows a file, and selects the set that is made of it, so that this can be used.
    pub fn select_file(&mut self, item: ImportItem, own: &[Shared<ImportedSet>]) {
        if let ImportItem::Set(name) = &item
            && let Some(set) = own.iter().find(|set| set.name == *name)
        {
            self.selected = Some(PlotItem::of_set(SetKind::of_own(set), name));
        }
        self.import.select(item);
    }

    /// Adds offers to the message. `takes_keyboard` has one Enter take the first.
    pub fn offer(&mut self, offers: Vec<Offer>, takes_keyboard: bool) {
        self.status.takes_keyboard = takes_keyboard && !offers.is_empty();
        self.status.offers = offers;
    }

    pub fn look(&self, pane: PaneKind) -> FigureLook {
        let saved = &self.saved;
        FigureLook {
            hovered: self.hovered.clone(),
            selected: self.selected.clone(),
            blink: self.blink,
            fit: saved.diagram_fit,
            diagram: self.diagram.clone(),
            zoom: self.zoomed.get(&pane).cloned(),
            locus_share: self.locus_share,
            pinned_pixel: self.render.pinned.clone(),
            swatch_layout: saved.swatch_layout,
            swatch_style: saved.swatch_style,
            without_bars: !saved.difference_bars,
            difference_plane: saved.difference_plane,
            spectra_layout: saved.spectra_layout,
            mode: saved.render.mode,
            surround: saved.surround,
            cameras: saved.metrics.cameras,
            sorting: saved.looks.get(TABLE).and_then(|look| look.sorting.clone()),
            pair: saved.metrics.pair.clone(),
            residuals_of: self.recorded.camera.clone(),
            shows: self.shows,
            correction: self.correction.shown.clone(),
            recorded: self.recorded.ranked.clone(),
            ..FigureLook::default()
        }
    }

    /// Takes an alternative of a setting of the layout, by its place.
    pub fn choose(&mut self, key: &str, place: usize) {
        self.reset_plots |= key == "diagram_fit";
        if let Some(setting) = SavedView::ALL.iter().find(|setting| setting.key == key) {
            setting.value.choose(&mut self.saved, place);
        }
    }

    /// Notes what a pane's plot, whose figure has this title, is zoomed to, if it is.
    pub fn note_zoom(&mut self, pane: PaneKind, title: String, zoomed: Option<Ranges>) {
        match zoomed {
            Some(ranges) => drop(self.zoomed.insert(pane, (title, ranges))),
            None => drop(self.zoomed.remove(&pane)),
        }
    }

    pub fn say(&mut self, text: impl Into<String>) {
        self.status = Status { text: text.into(), ..Status::default() };
    }

    pub fn fail(&mut self, text: impl Into<String>) {
        self.status = Status { text: text.into(), weight: Weight::Error, ..Status::default() };
    }

    /// Lets the loci draw in, once; `now` is egui's time in seconds.
    pub fn draw_in(&mut self, now: f64) {
        const DURATION: f64 = 1.2;
        if std::mem::take(&mut self.saved.draws_in) && !self.saved.reduced_motion {
            self.draws_since = Some(now);
        }
        let part = self.draws_since.map(|since| (now - since) / DURATION);
        let moving = part.filter(|part| *part < 1.0 && !self.saved.reduced_motion);
        if moving.is_none() {
            self.draws_since = None;
        }
        // Fast at first, slow at the end.
        self.locus_share = moving.map(|part| 1.0 - (1.0 - part.clamp(0.0, 1.0)).powi(3));
    }

    /// Puts a file at the head of those opened lately.
    pub fn remember_file(&mut self, path: PathBuf) {
        let recent = &mut self.saved.recent;
        recent.retain(|known| *known != path);
        recent.insert(0, path);
        recent.truncate(10);
    }

    pub fn hover(&mut self, thing: Option<&PlotItem>) {
        if let Some(thing) = thing {
            self.next_hovered = Some(thing.clone());
        }
    }

    /// Selects a clicked item, or clears the selection if it was selected.
    pub fn click(&mut self, thing: Option<&PlotItem>) {
        self.selected = if self.selected.as_ref() == thing { None } else { thing.cloned() };
    }

    /// Removes references to sensors that a step removed from the comparison: they are no longer selected, pinned or
    /// hovered.
    pub fn let_go_of_removed(&mut self, before: &[Compared], after: &[Compared]) {
        let has = |list: &[Compared], id: &SensorId| list.iter().any(|c| c.kind == id.kind && c.name == id.name);
        let gone = |id: &SensorId| has(before, id) && !has(after, id);
        let is_gone = |thing: &mut PlotItem| thing.source().is_some_and(gone);
        for thing in [&mut self.selected, &mut self.hovered, &mut self.next_hovered] {
            thing.take_if(is_gone);
        }
        self.pinned.retain(|thing| !thing.source().is_some_and(gone));
        for place in [&mut self.render.pinned, &mut self.render.hovered] {
            place.take_if(|place| gone(&place.source));
        }
        self.render.chosen.take_if(|id| gone(id));
    }

    pub fn emphasis(&self, drawn: &PlotItem, reference: &str) -> Emphasis {
        let standing = |of: &Option<PlotItem>| of.as_ref().map(|thing| thing.relation_to(drawn, reference));
        let pinned = self.pinned.iter().any(|thing| thing == drawn);
        match (standing(&self.hovered), standing(&self.selected)) {
            (_, Some(Relation::Same)) if self.selected.as_ref().is_some_and(|thing| thing.is_alike(drawn)) => {
                Emphasis::Selected
            }
            (_, Some(Relation::Same)) => Emphasis::Related,
            // Of a camera's points, only the one under the pointer has a ring.
            (Some(Relation::Same), _) if self.hovered.as_ref().is_some_and(|thing| thing.is_alike(drawn)) => {
                Emphasis::Hovered
            }
            (Some(Relation::Same), _) => Emphasis::Pointed,
            _ if pinned => Emphasis::Selected,
            (_, Some(Relation::Other)) if !self.selected_elsewhere => Emphasis::Faded,
            _ => Emphasis::Normal,
        }
    }

    pub fn emphasis_of(&self, things: &PickIndex, tag: Tag, reference: &str) -> Emphasis {
        things.get(tag).map_or(Emphasis::Normal, |thing| self.emphasis(thing, reference))
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct TableLook {
    /// Column that rows are sorted by; none for the order as given.
    pub sorting: Option<Sorting>,
    /// Columns that the user shows or hides, by name; others keep the table's default.
    pub columns: BTreeMap<String, bool>,
    /// Words that a row must contain. Not saved between runs.
    #[serde(skip)]
    pub filter: String,
    /// Row with the keyboard cursor where rows have no items, in the given order.
    #[serde(skip)]
    pub cursor: Option<usize>,
    /// Selection that the table was scrolled to.
    #[serde(skip)]
    pub seen: Option<PlotItem>,
}

impl TableLook {
    /// Sorts by a column that was clicked: in its preferred direction, then in the other, then as given.
    pub fn sort_by(&mut self, column: &str, largest_first: bool) {
        self.sorting = match self.sorting.take() {
            Some(now) if now.column == column && now.descending == largest_first => {
                Some(Sorting { descending: !largest_first, ..now })
            }
            Some(now) if now.column == column => None,
            _ => Some(Sorting { column: column.to_owned(), descending: largest_first }),
        };
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MetricsLook {
    pub cameras: RankedCameras,
    pub confusion: Confuses,
    /// The two cameras of Head to head; `None` for the selected one and the first compared one.
    #[serde(skip)]
    pub pair: [Option<SensorId>; 2],
}

choices! {
    /// The one that takes two reflectances for one.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Confuses {
        #[default]
        Camera = "camera", "By the camera", "Equal to the camera, different to the reference";
        Reference = "reference", "By the reference", "Equal to the reference, different to the camera";
    }
}

impl Confuses {
    pub const fn confusion(self) -> Confusion {
        match self {
            Self::Camera => Confusion::Camera,
            Self::Reference => Confusion::Observer,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RenderLook {
    pub mode: RenderMode,
    /// Viewpoint; `None` for the mesh's own.
    pub orbit: Option<Orbit>,
    /// Position of the divider of the split picture, from 0 (left) to 1.
    pub split: f32,
}

/// Where the divider begins: through the face of the head as it is first seen.
const SPLIT: f32 = 0.62;

impl Default for RenderLook {
    fn default() -> Self {
        Self { mode: RenderMode::Grid, orbit: None, split: SPLIT }
    }
}

impl RenderLook {
    /// Corrects values of a damaged file that are out of range.
    pub fn mend(&mut self) {
        if !(0.0..=1.0).contains(&self.split) {
            self.split = Self::default().split;
        }
        self.orbit = self.orbit.filter(|orbit| orbit.viewpoint(1.0).is_some());
    }
}

#[derive(Debug, Default)]
pub struct RenderView {
    pub pinned: Option<PixelPlace>,
    pub hovered: Option<PixelPlace>,
    /// The sensor shown alone or with the reference; `None` for the first camera.
    pub chosen: Option<SensorId>,
    /// True if finer pictures than the current ones are not wanted.
    pub cancelled: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PageLook {
    pub paper: Paper,
    pub zoom: PageZoom,
    pub unit: LengthUnit,
}

impl Default for PageLook {
    fn default() -> Self {
        let paper = Paper { width_mm: Some(Paper::ONE_COLUMN_MM), ..Paper::default() };
        Self { paper, zoom: PageZoom::default(), unit: LengthUnit::default() }
    }
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum PageZoom {
        #[default]
        Fit = "fit", "Fit", "The whole page";
        TrueSize = "true", "True size", "As large as on paper, where a screen has 96 points per inch";
        Double = "double", "200 %", "Twice as large as on paper";
    }
}

impl PageZoom {
    /// Points on screen for each point on paper at true size: screens have 96 points per inch.
    pub const TRUE: f64 = 96.0 / 72.0;

    /// Points on screen for each point on paper, for a page that fits at `fit`.
    pub fn scale(self, fit: f64) -> f64 {
        match self {
            Self::Fit => fit,
            Self::TrueSize => Self::TRUE,
            Self::Double => 2.0 * Self::TRUE,
        }
    }
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum LengthUnit {
        #[default]
        Millimeter = "mm", "mm", "Millimeters";
        Inch = "in", "in", "Inches, 25.4 mm each";
    }
}

impl LengthUnit {
    pub const fn mm(self) -> f64 {
        match self {
            Self::Millimeter => 1.0,
            Self::Inch => 25.4,
        }
    }
}
