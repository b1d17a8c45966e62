//! Workspaces: tables of slots that place the panes, no docking. A slot holds one of its panes, which are its tabs.

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
    /// Sensors compared: the only legend.
    pub const COMPARED: Self = Self::new("Compared");
    /// All data sets as a table.
    pub const LIBRARY: Self = Self::new("Library");
    pub const CHROMATICITY: Self = Self::new("Chromaticity");
    /// Each camera's differences from the reference.
    pub const DIFFERENCES: Self = Self::new("Differences");
    pub const SWATCHES: Self = Self::new("Swatches");
    pub const SPECTRA: Self = Self::new("Spectra");
    pub const INSPECTOR: Self = Self::new("Inspector");
    pub const RENDER: Self = Self::new("Render");
    /// Settings of the view that has the focus.
    pub const SETTINGS: Self = Self::new("RenderSetup");
    /// The user's files, and the text of one with the marks of how it was read.
    pub const IMPORT: Self = Self::new("Import");
    /// The user's camera from pictures of a chart: all of Data while it is shown.
    pub const MEASURE: Self = Self::new("Measure");
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
    /// All tables of a camera's model.
    pub const TABLES: Self = Self::new("Tables");
    pub const METAMERS: Self = Self::new("Metamers");
    pub const TOLERANCE: Self = Self::new("Tolerance");

    /// Where it stands. A pane that is not listed here is a view of Compare.
    pub fn slot(self) -> Slot {
        match self {
            Self::COMPARED => Slot::Left,
            Self::INSPECTOR => Slot::Selection,
            Self::SETTINGS => Slot::Settings,
            Self::METRICS => Slot::List,
            Self::REPORT_CARD
            | Self::HEAD_TO_HEAD
            | Self::CORRECTION
            | Self::METAMERS
            | Self::RECORDED
            | Self::TABLES => Slot::Page,
            Self::LIBRARY | Self::MEASURE => Slot::Sets,
            Self::IMPORT => Slot::Text,
            Self::INTERPRETATION => Slot::Reading,
            Self::CURVES => Slot::Curve,
            Self::METHODS | Self::TOLERANCE | Self::STATISTICS => Slot::Numerics,
            Self::LIGHT => Slot::Card,
            _ => Slot::View,
        }
    }

    /// True for a pane of controls, which gains nothing from the whole window.
    pub fn is_controls(self) -> bool {
        matches!(self, Self::COMPARED | Self::SETTINGS | Self::TOLERANCE | Self::INTERPRETATION)
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
    /// The workspaces, in the order of their tabs and keys. Those of earlier versions open in the one that took them in.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
    pub enum Workspace {
        #[default]
        #[serde(alias = "Spectra", alias = "Render", alias = "Numerics", alias = "Accuracy")]
        Compare = "compare", "Compare", "How far off the compared cameras are, and where";
        #[serde(alias = "Metrics")]
        Rank = "rank", "Rank", "Every camera by its figures of merit, and one camera's page";
        #[serde(alias = "Import")]
        Data = "data", "Data", "All data sets, your files, and how they are read";
    }
}

/// A part of a workspace that holds one pane at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    Left,
    /// Either of the two views of Compare.
    View,
    Selection,
    Settings,
    List,
    Page,
    Sets,
    Text,
    Reading,
    Curve,
    /// The page that Help opens.
    Numerics,
    /// Over the right column until it is closed.
    Card,
}

impl Slot {
    /// True for a pane that can be shown in it.
    pub fn takes(self, pane: PaneKind) -> bool {
        // In Data, what is selected may be a set that was not read from a file.
        pane.slot() == self || (self, pane) == (Self::Reading, PaneKind::INSPECTOR)
    }
}

/// Panes of a workspace: upper and lower in its center, upper and lower in its right column.
pub type Places = [Option<PaneKind>; 4];

impl Workspace {
    /// Slots in the order of [`Places`].
    pub const fn slots(self) -> [Option<Slot>; 4] {
        match self {
            Self::Compare => [Some(Slot::View), Some(Slot::View), Some(Slot::Selection), Some(Slot::Settings)],
            Self::Rank => [Some(Slot::List), None, Some(Slot::Page), None],
            Self::Data => [Some(Slot::Sets), Some(Slot::Text), Some(Slot::Reading), Some(Slot::Curve)],
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Splitter {
    Left,
    Right,
    /// Between the list and the page of Rank.
    Page,
    Center,
    RightRows,
    /// Between the table of sets and the text of a file.
    Text,
    Curve,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    /// Width of the left column in points; none for the window's own choice. Files have the names of the first layouts.
    #[serde(rename = "library_width")]
    pub left_width: Option<f32>,
    /// Width of the right column in points; none for the window's own choice.
    pub right_width: Option<f32>,
    /// Width of the page of Rank in points; none for a third.
    pub page_width: Option<f32>,
    /// Height of the center's lower pane as a share.
    pub lower_share: f32,
    /// Height of the right column's lower pane as a share.
    pub right_lower_share: f32,
    pub text_share: f32,
    pub curve_share: f32,
    #[serde(rename = "library")]
    pub left: bool,
    pub right: bool,
    pub compare: Places,
    #[serde(rename = "metrics")]
    pub rank: Places,
    #[serde(rename = "import")]
    pub data: Places,
}

impl Default for Layout {
    fn default() -> Self {
        Self {
            left_width: None,
            right_width: None,
            page_width: None,
            lower_share: 0.335,
            right_lower_share: 0.484_375,
            text_share: 0.5,
            curve_share: 0.3,
            left: true,
            right: true,
            compare: [
                Some(PaneKind::CHROMATICITY),
                Some(PaneKind::SWATCHES),
                Some(PaneKind::INSPECTOR),
                Some(PaneKind::SETTINGS),
            ],
            rank: [Some(PaneKind::METRICS), None, Some(PaneKind::REPORT_CARD), None],
            data: [
                Some(PaneKind::LIBRARY),
                Some(PaneKind::IMPORT),
                Some(PaneKind::INTERPRETATION),
                Some(PaneKind::CURVES),
            ],
        }
    }
}

impl Layout {
    pub fn places(&self, workspace: Workspace) -> &Places {
        [&self.compare, &self.rank, &self.data][workspace as usize]
    }

    pub fn places_mut(&mut self, workspace: Workspace) -> &mut Places {
        match workspace {
            Workspace::Compare => &mut self.compare,
            Workspace::Rank => &mut self.rank,
            Workspace::Data => &mut self.data,
        }
    }

    /// Puts a pane of its own into each slot that holds another: a layout may be of another version.
    pub fn mend(&mut self, exists: impl Fn(PaneKind) -> bool) {
        let start = Self::default();
        for workspace in Workspace::ALL {
            let places = self.places_mut(workspace);
            for (at, slot) in workspace.slots().into_iter().enumerate() {
                let fits = |pane: &PaneKind| exists(*pane) && slot.is_some_and(|slot| slot.takes(*pane));
                // The lower view may be folded away.
                if places[at].is_some() || (at, slot) != (1, Some(Slot::View)) {
                    places[at] = places[at].filter(fits).or(start.places(workspace)[at]);
                }
            }
        }
        if self.compare[0] == self.compare[1] {
            self.compare[1] = start.compare.into_iter().find(|pane| *pane != self.compare[0]).flatten();
        }
    }

    /// Where a pane is or can be shown: in this workspace if it has a slot for it, else in its own, and in which place there.
    pub fn place_of(&self, pane: PaneKind, now: Workspace) -> Option<(Workspace, usize)> {
        std::iter::once(now).chain(Workspace::ALL).find_map(|workspace| {
            let shown = self.places(workspace).iter().position(|place| *place == Some(pane));
            let takes = |slot: &Option<Slot>| slot.is_some_and(|slot| slot.takes(pane));
            let place = shown.or_else(|| workspace.slots().iter().position(takes))?;
            Some((workspace, place))
        })
    }

    pub fn shows(&self, workspace: Workspace, pane: PaneKind) -> bool {
        self.places(workspace).contains(&Some(pane))
    }

    /// Puts a pane into a place; one that was shown elsewhere in the workspace changes places.
    pub fn put(&mut self, workspace: Workspace, at: usize, pane: PaneKind) {
        let places = self.places_mut(workspace);
        if let Some(other) = places.iter().position(|place| *place == Some(pane)) {
            places.swap(other, at);
        }
        places[at] = Some(pane);
    }

    /// Shows the lower view, or folds it away.
    pub fn toggle_lower(&mut self) {
        let views = [PaneKind::SWATCHES, PaneKind::CHROMATICITY];
        let other = views.into_iter().find(|view| Some(*view) != self.compare[0]);
        self.compare[1] = if self.compare[1].is_some() { None } else { other };
    }
}

/// A border of the center, behind which something is hidden.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    Left,
    Right,
    Lower,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    pub panes: Vec<(PaneKind, Rect)>,
    pub splitters: Vec<(Splitter, Rect)>,
    /// Handles of what is hidden.
    pub handles: Vec<(Side, Rect)>,
    /// The right column where it overlaps the others.
    pub over: Vec<(PaneKind, Rect)>,
    pub narrow: bool,
}

impl Arrangement {
    pub fn shows(&self, pane: PaneKind) -> bool {
        self.panes.iter().chain(&self.over).any(|(shown, _)| *shown == pane)
    }
}

/// What is arranged.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    pub workspace: Workspace,
    pub layout: &'a Layout,
    pub maximized: Option<PaneKind>,
    /// A pane in place of the right column.
    pub card: Option<PaneKind>,
    pub numerics: bool,
    /// The lower pane of the right column has something to show: settings of a view, curves of a file.
    pub has_lower: bool,
    /// The column that a narrow window omits lies over the center.
    pub column_over: bool,
}

/// Below this width Compare omits its right column.
const NARROW: f32 = 1100.0;
/// Once omitted, it returns only this much above.
const HYSTERESIS: f32 = 40.0;
/// Above this width the columns grow.
const LARGE: f32 = 1800.0;
const GAP: f32 = 4.0;
const HANDLE: f32 = 12.0;
/// Width that the page of Rank needs.
const PAGE: f32 = 316.0;
const COLUMN: f32 = 316.0;

/// Arranges a workspace in an area. `was_narrow` prevents a window at the limit from flickering.
pub fn arrange(shown: &Shown<'_>, area: Rect, was_narrow: bool) -> Arrangement {
    let &Shown { workspace, layout, maximized, card, numerics, has_lower, .. } = shown;
    if let Some(pane) = maximized {
        return Arrangement { panes: vec![(pane, area)], narrow: was_narrow, ..Arrangement::default() };
    }
    let narrow = area.width() < if was_narrow { NARROW + HYSTERESIS } else { NARROW };
    let mut made = Arrangement { narrow, ..Arrangement::default() };
    let column = layout.right_width.unwrap_or(if area.width() > LARGE { 560.0 } else { COLUMN }).clamp(200.0, 720.0);
    if numerics {
        let center = cut_right(&mut made, area, column, Splitter::Right, |made, right| {
            let rows = [Some(PaneKind::TOLERANCE), Some(PaneKind::STATISTICS)];
            stack(made, right, rows, layout.right_lower_share, Splitter::RightRows);
        });
        made.panes.push((PaneKind::METHODS, center));
        return made;
    }
    let [upper, lower, right_upper, right_lower] = *layout.places(workspace);
    let right_lower = right_lower.filter(|_| has_lower);
    let rows = if card.is_some() { [card, None] } else { [right_upper, right_lower] };
    let rest = match workspace {
        Workspace::Compare => compare(&mut made, shown, area, rows, column),
        Workspace::Rank => {
            // As wide as two cameras side by side need, where the list keeps more.
            let usual = (area.width() / 3.0).max((0.44 * area.width()).min(500.0));
            let page = layout.page_width.unwrap_or(usual).clamp(PAGE, (0.6 * area.width()).max(PAGE));
            cut_right(&mut made, area, page, Splitter::Page, |made, right| {
                stack(made, right, rows, 0.5, Splitter::Curve);
            })
        }
        Workspace::Data if upper == Some(PaneKind::MEASURE) => {
            made.panes.push((PaneKind::MEASURE, area));
            return made;
        }
        Workspace::Data => cut_right(&mut made, area, column, Splitter::Right, |made, right| {
            stack(made, right, rows, layout.curve_share, Splitter::Curve);
        }),
    };
    let (share, splitter) = match workspace {
        Workspace::Data => (layout.text_share, Splitter::Text),
        _ => (layout.lower_share, Splitter::Center),
    };
    stack(&mut made, rest, [upper, lower], share, splitter);
    made
}

/// Arranges the columns of Compare, and returns what is left for its views.
fn compare(made: &mut Arrangement, shown: &Shown<'_>, area: Rect, rows: [Option<PaneKind>; 2], column: f32) -> Rect {
    let layout = shown.layout;
    let mut rest = area;
    if layout.left {
        let width = layout.left_width.unwrap_or(if area.width() > LARGE { 280.0 } else { 216.0 }).clamp(160.0, 360.0);
        let (left, border, right) = cut_x(rest, width);
        made.panes.push((PaneKind::COMPARED, left));
        made.splitters.push((Splitter::Left, border));
        rest = right;
    } else {
        let (handle, _, right) = cut_x(rest, HANDLE);
        made.handles.push((Side::Left, handle));
        rest = right;
    }
    let overlaps = made.narrow && (shown.column_over || shown.card.is_some());
    if overlaps {
        let min = Pos2::new(rest.right() - COLUMN.min(rest.width()), rest.top());
        let mut over = Arrangement::default();
        stack(&mut over, Rect::from_min_max(min, rest.max), rows, layout.right_lower_share, Splitter::RightRows);
        made.over = over.panes;
    }
    if made.narrow || (!layout.right && shown.card.is_none()) {
        let (center, _, handle) = cut_x(rest, rest.width() - HANDLE - GAP);
        made.handles.push((Side::Right, handle));
        rest = center;
    } else {
        rest = cut_right(made, rest, column, Splitter::Right, |made, right| {
            stack(made, right, rows, layout.right_lower_share, Splitter::RightRows);
        });
    }
    if layout.compare[1].is_none() {
        let cut = rest.bottom() - HANDLE;
        made.handles.push((Side::Lower, rest.with_min_y(cut)));
        rest.max.y = cut - GAP;
    }
    rest
}

/// Cuts a column of a width off at the right, fills it, and returns what is left.
fn cut_right(
    made: &mut Arrangement,
    area: Rect,
    width: f32,
    splitter: Splitter,
    fill: impl FnOnce(&mut Arrangement, Rect),
) -> Rect {
    let (center, border, right) = cut_x(area, (area.width() - width - GAP).max(200.0));
    made.splitters.push((splitter, border));
    fill(made, right);
    center
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
    /// Puts a border back.
    pub fn release(&mut self, splitter: Splitter) {
        let start = Self::default();
        match splitter {
            Splitter::Left => self.left_width = None,
            Splitter::Right => self.right_width = None,
            Splitter::Page => self.page_width = None,
            Splitter::Center => self.lower_share = start.lower_share,
            Splitter::RightRows => self.right_lower_share = start.right_lower_share,
            Splitter::Text => self.text_share = start.text_share,
            Splitter::Curve => self.curve_share = start.curve_share,
        }
    }

    pub fn drag(&mut self, splitter: Splitter, pointer: Pos2, area: Rect) {
        match splitter {
            Splitter::Left => self.left_width = Some((pointer.x - area.left()).clamp(160.0, 360.0)),
            Splitter::Right => self.right_width = Some((area.right() - pointer.x).clamp(200.0, 720.0)),
            Splitter::Page => self.page_width = Some((area.right() - pointer.x).max(PAGE)),
            Splitter::Center => self.lower_share = share(pointer, area),
            Splitter::RightRows => self.right_lower_share = share(pointer, area),
            Splitter::Text => self.text_share = share(pointer, area),
            Splitter::Curve => self.curve_share = share(pointer, area),
        }
    }
}

fn share(pointer: Pos2, area: Rect) -> f32 {
    ((area.bottom() - pointer.y) / area.height().max(1.0)).clamp(0.15, 0.85)
}
