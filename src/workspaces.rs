//! Which panes stand where: tables of splits, no docking.

use egui::{Pos2, Rect, Vec2};
use serde::{Deserialize, Serialize};

/// A pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum PaneKind {
    /// What is compared, and all data sets.
    Library,
    /// The diagram.
    Chromaticity,
    /// The patches as colors.
    Swatches,
    /// Light, patches, sensitivities.
    Spectra,
    /// The key, or the selection.
    Inspector,
    /// A mesh through each camera.
    Render,
    /// What is rendered: mesh, surface, light's place.
    RenderSetup,
    /// The user's files, and the text of one with what was understood of it.
    Import,
    /// The curves that a file gives.
    Curves,
    /// What a file was understood as, with switches.
    Understood,
    /// Run time against error of the scene.
    Accuracy,
    /// What the scene did not compute.
    SkippedWork,
    /// How large errors may be.
    Tolerance,
}

impl PaneKind {
    /// All panes.
    pub const ALL: [Self; 13] = [
        Self::Library,
        Self::Chromaticity,
        Self::Swatches,
        Self::Spectra,
        Self::Inspector,
        Self::Render,
        Self::RenderSetup,
        Self::Import,
        Self::Curves,
        Self::Understood,
        Self::Accuracy,
        Self::SkippedWork,
        Self::Tolerance,
    ];
    /// The panes that stand in the workspaces' changeable places: all but the library, which comes first.
    pub const CHANGEABLE: &[Self] = Self::ALL.split_at(1).1;

    /// Its title.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Library => "Library",
            Self::Chromaticity => "Chromaticity",
            Self::Swatches => "Swatches",
            Self::Spectra => "Spectra",
            Self::Inspector => "Inspector",
            Self::Render => "Render",
            Self::RenderSetup => "Scene",
            Self::Import => "Import",
            Self::Curves => "Result",
            Self::Understood => "Interpretation",
            Self::Accuracy => "Methods",
            Self::SkippedWork => "Work saved",
            Self::Tolerance => "Tolerance",
        }
    }
}

/// A fixed arrangement of panes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Workspace {
    /// The diagram over swatches, inspector over spectra.
    #[default]
    Compare,
    /// Large spectra.
    Spectra,
    /// A mesh through each camera, beside what it is made of.
    Render,
    /// The user's files, and what was understood of them.
    Import,
    /// What the scene costs by each method, and what was left out.
    Accuracy,
}

impl Workspace {
    /// All workspaces, in the order of their tabs and keys.
    pub const ALL: [Self; 5] = [Self::Compare, Self::Spectra, Self::Render, Self::Import, Self::Accuracy];

    /// The tab's title.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Compare => "Compare",
            Self::Spectra => "Spectra",
            Self::Render => "Render",
            Self::Import => "Import",
            Self::Accuracy => "Accuracy",
        }
    }

    /// Whether a narrow window hides the library, so that the right column stays.
    pub const fn keeps_right_column(self) -> bool {
        matches!(self, Self::Render | Self::Import | Self::Accuracy)
    }
}

/// A border that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Splitter {
    /// Right of the library.
    Library,
    /// Left of the right column.
    Right,
    /// Between the panes of the center.
    Center,
    /// Between the panes of the right column.
    RightRows,
}

/// Sizes and places, kept between runs.
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
    /// Whether the library is shown.
    pub library: bool,
    /// Compare: center upper, center lower, right upper, right lower.
    pub compare: [Option<PaneKind>; 4],
    /// Spectra: center upper, center lower, right upper, right lower.
    pub spectra: [Option<PaneKind>; 4],
    /// Render: center upper, center lower, right upper, right lower.
    pub render: [Option<PaneKind>; 4],
    /// Import: center upper, center lower, right upper, right lower.
    pub import: [Option<PaneKind>; 4],
    /// Accuracy: center upper, center lower, right upper, right lower.
    pub accuracy: [Option<PaneKind>; 4],
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
                Some(PaneKind::Chromaticity),
                Some(PaneKind::Swatches),
                Some(PaneKind::Inspector),
                Some(PaneKind::Spectra),
            ],
            spectra: [Some(PaneKind::Spectra), None, Some(PaneKind::Inspector), None],
            render: [Some(PaneKind::Render), None, Some(PaneKind::RenderSetup), None],
            import: [Some(PaneKind::Import), Some(PaneKind::Curves), Some(PaneKind::Understood), None],
            accuracy: [Some(PaneKind::Accuracy), Some(PaneKind::SkippedWork), Some(PaneKind::Tolerance), None],
        }
    }
}

impl Layout {
    /// The panes of a workspace's four places.
    pub fn places(&self, workspace: Workspace) -> &[Option<PaneKind>; 4] {
        match workspace {
            Workspace::Compare => &self.compare,
            Workspace::Spectra => &self.spectra,
            Workspace::Render => &self.render,
            Workspace::Import => &self.import,
            Workspace::Accuracy => &self.accuracy,
        }
    }

    /// The same, to change.
    pub fn places_mut(&mut self, workspace: Workspace) -> &mut [Option<PaneKind>; 4] {
        match workspace {
            Workspace::Compare => &mut self.compare,
            Workspace::Spectra => &mut self.spectra,
            Workspace::Render => &mut self.render,
            Workspace::Import => &mut self.import,
            Workspace::Accuracy => &mut self.accuracy,
        }
    }

    /// Whether a workspace shows a pane.
    pub fn shows(&self, workspace: Workspace, pane: PaneKind) -> bool {
        if pane == PaneKind::Library { self.library } else { self.places(workspace).contains(&Some(pane)) }
    }

    /// Shows or hides a pane; shown, it takes its own place, else the first free one, else the last.
    pub fn toggle(&mut self, workspace: Workspace, pane: PaneKind) {
        if pane == PaneKind::Library {
            self.library = !self.library;
            return;
        }
        let home = Self::default().places(workspace).iter().position(|p| *p == Some(pane));
        // Where a workspace has no place of its own for it, the inspector stands at the right like everywhere.
        let home = home.or((pane == PaneKind::Inspector).then_some(3));
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

/// Where everything stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    /// Panes with their rectangles.
    pub panes: Vec<(PaneKind, Rect)>,
    /// Borders with theirs.
    pub splitters: Vec<(Splitter, Rect)>,
    /// A pane that lies over the others.
    pub over: Option<(PaneKind, Rect)>,
    /// Whether a column was left out for want of width.
    pub narrow: bool,
}

/// Below this width a column is left out: the right one, in Render and Import the library.
const NARROW: f32 = 1100.0;
/// Once left out, it returns only this much above.
const HYSTERESIS: f32 = 40.0;
/// Above this width the columns grow.
const LARGE: f32 = 1800.0;
/// Width of a border.
const GAP: f32 = 4.0;

/// Arranges a workspace in an area. `was_narrow` keeps a window at the limit from flickering; `column_over` lays the column that
/// a narrow window leaves out over the center.
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
        made.panes.push((PaneKind::Library, left));
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
        made.over = Some((PaneKind::Library, Rect::from_min_max(rest.min, max)));
    }
    if right_left_out && column_over {
        let width = 316.0_f32.min(rest.width());
        let min = Pos2::new(rest.right() - width, rest.top());
        made.over = Some((PaneKind::Inspector, Rect::from_min_max(min, rest.max)));
    }
    made
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
    /// Moves a border to the pointer.
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
