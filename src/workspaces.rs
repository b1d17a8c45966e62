//! Workspaces: tables of splits that place the panes, no docking.

use std::collections::BTreeSet;
use std::fmt::{self, Formatter};
use std::sync::{Mutex, PoisonError};

use chromascope_text::choices;
use egui::{Pos2, Rect, Vec2};
use serde::de::{DeserializeSeed, EnumAccess, VariantAccess as _, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A pane, by the id that saved layouts name it by.
///
/// The panes themselves are in `panes::ALL`; those that a layout starts with have a name here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PaneKind(&'static str);

impl PaneKind {
    /// Sensors compared, and all data sets.
    pub const LIBRARY: Self = Self::new("Library");
    pub const CHROMATICITY: Self = Self::new("Chromaticity");
    pub const SWATCHES: Self = Self::new("Swatches");
    pub const SPECTRA: Self = Self::new("Spectra");
    pub const INSPECTOR: Self = Self::new("Inspector");
    pub const RENDER: Self = Self::new("Render");
    /// Mesh, surface, light and view of the render.
    pub const RENDER_SETTINGS: Self = Self::new("RenderSetup");
    /// The user's files, and the text of one with the marks of how it was read.
    pub const IMPORT: Self = Self::new("Import");
    pub const CURVES: Self = Self::new("Curves");
    /// Decisions made in reading a file, with switches.
    pub const INTERPRETATION: Self = Self::new("Understood");
    pub const METHODS: Self = Self::new("Accuracy");
    pub const STATISTICS: Self = Self::new("Statistics");
    pub const METRICS: Self = Self::new("Metrics");
    /// Two cameras side by side.
    pub const HEAD_TO_HEAD: Self = Self::new("HeadToHead");
    pub const REPORT_CARD: Self = Self::new("ReportCard");
    /// The light judged.
    pub const LIGHT: Self = Self::new("Light");
    pub const CORRECTION: Self = Self::new("Correction");
    pub const RECORDED: Self = Self::new("Recorded");
    pub const TOLERANCE: Self = Self::new("Tolerance");

    /// The workspace that it is listed under: the one it starts in, else Metrics.
    pub fn group(self) -> Workspace {
        Layout::home(self).unwrap_or(Workspace::Metrics)
    }

    /// True for a pane of controls, which gains nothing from the whole window.
    pub fn is_controls(self) -> bool {
        matches!(self, Self::LIBRARY | Self::RENDER_SETTINGS | Self::TOLERANCE | Self::INTERPRETATION)
    }

    /// A pane of this id. Ids stay: layouts of earlier runs name them.
    pub const fn new(id: &'static str) -> Self {
        Self(id)
    }
}

impl From<PaneKind> for &'static str {
    fn from(kind: PaneKind) -> Self {
        kind.0
    }
}

impl Serialize for PaneKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_unit_variant("PaneKind", 0, self.0)
    }
}

impl<'de> Deserialize<'de> for PaneKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_enum("PaneKind", &[], AnyVariant).map(interned)
    }
}

/// Reads the name of a unit variant.
struct AnyVariant;

impl<'de> Visitor<'de> for AnyVariant {
    type Value = String;

    fn expecting(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str("the id of a pane")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<String, A::Error> {
        let (id, rest) = data.variant_seed(self)?;
        rest.unit_variant().map(|()| id)
    }

    fn visit_str<E: serde::de::Error>(self, id: &str) -> Result<String, E> {
        Ok(id.to_owned())
    }
}

impl<'de> DeserializeSeed<'de> for AnyVariant {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

/// Pane of an id read from a file. Each id is leaked only once, however often layouts are read.
fn interned(id: String) -> PaneKind {
    static IDS: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut ids = IDS.lock().unwrap_or_else(PoisonError::into_inner);
    let known = ids.get(id.as_str()).copied();
    PaneKind(known.unwrap_or_else(|| {
        let id = id.leak();
        ids.insert(id);
        id
    }))
}

choices! {
    /// The workspaces, in the order of their tabs and keys.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
    pub enum Workspace {
        #[default]
        Compare = "compare", "Compare", "Diagram, swatches and spectra of the compared sensors";
        Spectra = "spectra", "Spectra", "Light, patches and sensitivities";
        Render = "render", "Render", "Pictures through each camera";
        Metrics = "metrics", "Metrics", "Cameras ranked, their corrections, the light judged";
        Import = "import", "Import", "Files, and how they are read";
        /// Run time and error of each method on the scene, the skipped work, the statistics of the pictures.
        #[serde(alias = "Accuracy")]
        Numerics = "numerics", "Numerics", "Run time and error of each method";
    }
}

impl Workspace {
    /// True where a narrow window hides the library instead of the right column.
    pub const fn keeps_right_column(self) -> bool {
        matches!(self, Self::Render | Self::Metrics | Self::Import | Self::Numerics)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Splitter {
    Library,
    Right,
    Center,
    RightRows,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    /// Width of the library in points; none for the window's own choice.
    pub library_width: Option<f32>,
    /// Width of the right column in points; none for the window's own choice.
    pub right_width: Option<f32>,
    /// Height of the center's lower pane as a share.
    pub lower_share: f32,
    /// Height of the right column's lower pane as a share.
    pub right_lower_share: f32,
    pub library: bool,
    /// Compare: center upper, center lower, right upper, right lower.
    pub compare: [Option<PaneKind>; 4],
    pub spectra: [Option<PaneKind>; 4],
    pub render: [Option<PaneKind>; 4],
    pub metrics: [Option<PaneKind>; 4],
    pub import: [Option<PaneKind>; 4],
    #[serde(alias = "accuracy")]
    pub numerics: [Option<PaneKind>; 4],
}

impl Default for Layout {
    fn default() -> Self {
        Self {
            library_width: None,
            right_width: None,
            lower_share: 0.31,
            right_lower_share: 0.5,
            library: true,
            compare: [
                Some(PaneKind::CHROMATICITY),
                Some(PaneKind::SWATCHES),
                Some(PaneKind::INSPECTOR),
                Some(PaneKind::SPECTRA),
            ],
            spectra: [Some(PaneKind::SPECTRA), None, Some(PaneKind::INSPECTOR), None],
            render: [Some(PaneKind::RENDER), None, Some(PaneKind::RENDER_SETTINGS), None],
            metrics: [
                Some(PaneKind::METRICS),
                Some(PaneKind::CORRECTION),
                Some(PaneKind::HEAD_TO_HEAD),
                Some(PaneKind::LIGHT),
            ],
            import: [Some(PaneKind::IMPORT), Some(PaneKind::CURVES), Some(PaneKind::INTERPRETATION), None],
            numerics: [Some(PaneKind::METHODS), None, Some(PaneKind::TOLERANCE), Some(PaneKind::STATISTICS)],
        }
    }
}

impl Layout {
    pub fn places(&self, workspace: Workspace) -> &[Option<PaneKind>; 4] {
        let Self { compare, spectra, render, metrics, import, numerics, .. } = self;
        [compare, spectra, render, metrics, import, numerics][workspace as usize]
    }

    pub fn places_mut(&mut self, workspace: Workspace) -> &mut [Option<PaneKind>; 4] {
        match workspace {
            Workspace::Compare => &mut self.compare,
            Workspace::Spectra => &mut self.spectra,
            Workspace::Render => &mut self.render,
            Workspace::Metrics => &mut self.metrics,
            Workspace::Import => &mut self.import,
            Workspace::Numerics => &mut self.numerics,
        }
    }

    /// Empties the places of panes that do not exist: a layout may be of another version.
    pub fn retain(&mut self, exists: impl Fn(PaneKind) -> bool) {
        for workspace in Workspace::ALL {
            for place in self.places_mut(workspace) {
                *place = place.filter(|pane| exists(*pane));
            }
        }
    }

    pub fn home(pane: PaneKind) -> Option<Workspace> {
        let start = Self::default();
        Workspace::ALL.into_iter().find(|workspace| start.places(*workspace).contains(&Some(pane)))
    }

    pub fn shows(&self, workspace: Workspace, pane: PaneKind) -> bool {
        if pane == PaneKind::LIBRARY { self.library } else { self.places(workspace).contains(&Some(pane)) }
    }

    /// Shows or hides a pane. A pane is shown in its own place, else in the first free one, else in the last.
    pub fn toggle(&mut self, workspace: Workspace, pane: PaneKind) {
        if pane == PaneKind::LIBRARY {
            self.library = !self.library;
            return;
        }
        let home = Self::default().places(workspace).iter().position(|p| *p == Some(pane));
        // In a workspace without a place for the inspector, it is on the right, as elsewhere.
        let home = home.or((pane == PaneKind::INSPECTOR).then_some(3));
        let places = self.places_mut(workspace);
        if let Some(shown) = places.iter_mut().find(|p| **p == Some(pane)) {
            *shown = None;
            return;
        }
        let free = home.filter(|&h| places[h].is_none()).or_else(|| places.iter().position(Option::is_none));
        places[free.unwrap_or(3)] = Some(pane);
    }

    /// Puts a pane into the place of another; one that was shown elsewhere changes places.
    pub fn replace(&mut self, workspace: Workspace, old: PaneKind, new: PaneKind) {
        let places = self.places_mut(workspace);
        for place in places.iter_mut() {
            if *place == Some(old) {
                *place = Some(new);
            } else if *place == Some(new) {
                *place = Some(old);
            }
        }
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    pub panes: Vec<(PaneKind, Rect)>,
    pub splitters: Vec<(Splitter, Rect)>,
    /// A pane that overlaps the others.
    pub over: Option<(PaneKind, Rect)>,
    pub narrow: bool,
}

/// Below this width a column is omitted: the right one, in Render and Import the library.
const NARROW: f32 = 1100.0;
/// Once omitted, it returns only this much above.
const HYSTERESIS: f32 = 40.0;
/// Above this width the columns grow.
const LARGE: f32 = 1800.0;
const GAP: f32 = 4.0;

/// Arranges a workspace in an area. `was_narrow` prevents a window at the limit from flickering; `column_over` lays the omitted
/// column of a narrow window over the center.
pub fn arrange(
    workspace: Workspace,
    layout: &Layout,
    area: Rect,
    was_narrow: bool,
    maximized: Option<PaneKind>,
    column_over: bool,
) -> Arrangement {
    if let Some(pane) = maximized {
        return Arrangement { panes: vec![(pane, area)], narrow: was_narrow, ..Arrangement::default() };
    }
    let narrow = area.width() < if was_narrow { NARROW + HYSTERESIS } else { NARROW };
    let large = area.width() > LARGE;
    let mut made = Arrangement { narrow, ..Arrangement::default() };
    let mut rest = area;
    let library_left_out = narrow && workspace.keeps_right_column();
    if layout.library && !library_left_out {
        let width = layout.library_width.unwrap_or(if large { 280.0 } else { 216.0 }).clamp(160.0, 360.0);
        let (left, border, right) = cut_x(rest, width);
        made.panes.push((PaneKind::LIBRARY, left));
        made.splitters.push((Splitter::Library, border));
        rest = right;
    }
    let [upper, lower, right_upper, right_lower] = *layout.places(workspace);
    let right_left_out = narrow && !workspace.keeps_right_column();
    if !right_left_out && (right_upper.is_some() || right_lower.is_some()) {
        let width = layout.right_width.unwrap_or(if large { 560.0 } else { 316.0 }).clamp(200.0, 720.0);
        let (center, border, right) = cut_x(rest, (rest.width() - width - GAP).max(200.0));
        made.splitters.push((Splitter::Right, border));
        stack(&mut made, right, [right_upper, right_lower], layout.right_lower_share, Splitter::RightRows);
        rest = center;
    }
    stack(&mut made, rest, [upper, lower], layout.lower_share, Splitter::Center);
    if library_left_out && column_over {
        let width = 216.0_f32.min(rest.width());
        let max = Pos2::new(rest.left() + width, rest.bottom());
        made.over = Some((PaneKind::LIBRARY, Rect::from_min_max(rest.min, max)));
    }
    if right_left_out && column_over {
        let width = 316.0_f32.min(rest.width());
        let min = Pos2::new(rest.right() - width, rest.top());
        made.over = Some((PaneKind::INSPECTOR, Rect::from_min_max(min, rest.max)));
    }
    made
}

/// Arranges the Figure page of a pane in an area, beside the library where there is room for both.
pub fn arrange_page(pane: PaneKind, layout: &Layout, area: Rect, was_narrow: bool) -> Arrangement {
    let mut layout = layout.clone();
    *layout.places_mut(Workspace::Import) = [Some(pane), None, None, None];
    // A narrow window has no room for the library there.
    arrange(Workspace::Import, &layout, area, was_narrow, None, false)
}

/// One pane above the other, or the one there is.
fn stack(made: &mut Arrangement, area: Rect, panes: [Option<PaneKind>; 2], lower_share: f32, splitter: Splitter) {
    match panes {
        [Some(upper), Some(lower)] => {
            let height = (area.height() * lower_share.clamp(0.15, 0.85)).round();
            let cut = area.bottom() - height;
            made.panes.push((upper, Rect::from_min_max(area.min, Pos2::new(area.right(), cut - GAP))));
            made.splitters
                .push((splitter, Rect::from_min_max(Pos2::new(area.left(), cut - GAP), Pos2::new(area.right(), cut))));
            made.panes.push((lower, Rect::from_min_max(Pos2::new(area.left(), cut), area.max)));
        }
        [Some(one), None] | [None, Some(one)] => made.panes.push((one, area)),
        [None, None] => {}
    }
}

fn cut_x(area: Rect, width: f32) -> (Rect, Rect, Rect) {
    let x = (area.left() + width).round();
    (
        Rect::from_min_max(area.min, Pos2::new(x, area.bottom())),
        Rect::from_min_size(Pos2::new(x, area.top()), Vec2::new(GAP, area.height())),
        Rect::from_min_max(Pos2::new(x + GAP, area.top()), area.max),
    )
}

impl Layout {
    pub fn drag(&mut self, splitter: Splitter, pointer: Pos2, area: Rect) {
        match splitter {
            Splitter::Library => self.library_width = Some((pointer.x - area.left()).clamp(160.0, 360.0)),
            Splitter::Right => self.right_width = Some((area.right() - pointer.x).clamp(200.0, 720.0)),
            Splitter::Center => self.lower_share = share(pointer, area),
            Splitter::RightRows => self.right_lower_share = share(pointer, area),
        }
    }
}

fn share(pointer: Pos2, area: Rect) -> f32 {
    ((area.bottom() - pointer.y) / area.height().max(1.0)).clamp(0.15, 0.85)
}
