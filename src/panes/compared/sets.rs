//! Cameras and observers in folding groups, to be ticked.

use std::borrow::Cow;

use chromascope_core::query::Shared;
use egui::{Key, Modifiers, Popup, Rect, Response, ScrollArea, Sense, TextStyle, Ui, Vec2};

use crate::catalog::{Entry, names};
use crate::document::SetKind;
use crate::document::imported::ImportedSet;
use crate::format::capitalized;
use crate::panes::context::PaneContext;
use crate::panes::widgets::sets::{choose, menu};
use crate::panes::widgets::{focus_rim, labeled, lines};
use crate::plot_item::PlotItem;
use crate::theme::{ROW, UNIT};

const SENSORS: [SetKind; 2] = [SetKind::Camera, SetKind::Observer];

pub(super) const SCROLL_BAR: f32 = 10.0;

/// Width that the tag of a digitized table takes.
const DIGITIZED: f32 = 64.0;

pub(super) enum Row<'a> {
    Group {
        kind: SetKind,
        /// Number of sets; while searching, of matches.
        count: usize,
        open: bool,
    },
    BuiltIn(&'a Entry),
    Own(&'a Shared<ImportedSet>),
}

impl<'a> Row<'a> {
    /// The entry of a set, made for visible rows only.
    pub(super) fn entry(&self) -> Option<Cow<'a, Entry>> {
        match self {
            Self::Group { .. } => None,
            Self::BuiltIn(entry) => Some(Cow::Borrowed(entry)),
            Self::Own(set) => Some(Cow::Owned(Entry::from_own(set))),
        }
    }
}

/// All rows as if the pane were endless; while searching all groups are open and hold what matches, the best match first.
pub(super) fn rows<'a>(context: &PaneContext<'a>) -> Vec<Row<'a>> {
    let search = context.view.search.trim();
    let searching = !search.is_empty();
    let (document, catalog) = (context.scene.document, context.scene.catalog);
    let of_kind = |kind| {
        let own = document.own.iter().filter(move |set| SetKind::of_own(set) == kind).map(Row::Own);
        own.chain(catalog.of_kind(kind).map(Row::BuiltIn))
    };
    let groups: Vec<(SetKind, Vec<Row<'a>>)> = if searching {
        let all = SENSORS.into_iter().flat_map(|kind| of_kind(kind).filter_map(|row| Some((row.entry()?, row))));
        let found = names::ranked(search, all, |(entry, _)| (entry.kind, entry.glossed_name(), entry.gloss()));
        found.into_iter().map(|(kind, found)| (kind, found.into_iter().map(|(_, row)| row).collect())).collect()
    } else {
        SENSORS.into_iter().map(|kind| (kind, of_kind(kind).collect())).collect()
    };
    let mut rows = Vec::new();
    for (kind, found) in groups {
        let open = searching || !context.view.saved.folded.contains(kind.key());
        rows.push(Row::Group { kind, count: found.len(), open });
        if open {
            rows.extend(found);
        }
    }
    rows
}

/// The list; only visible rows are laid out.
pub(super) fn list(ui: &mut Ui, rows: &[Row<'_>], context: &mut PaneContext<'_>) {
    if rows.is_empty() {
        ui.label(names::no_match(&context.view.search));
        if ui.button("Clear search").clicked() {
            context.view.search.clear();
        }
        return;
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    // Each search begins at its best match, and without one the list is where it was.
    let area = ScrollArea::vertical().id_salt(("sets", &context.view.search)).auto_shrink(false);
    area.show_rows(ui, ROW, rows.len(), |ui, range| {
        for row in &rows[range] {
            if let Row::Group { kind, count, open } = row {
                group(ui, *kind, *count, *open, context);
            } else if let Some(entry) = row.entry() {
                set(ui, &entry, context);
            }
        }
    });
}

/// The head of a group; a click folds it.
fn group(ui: &mut Ui, kind: SetKind, count: usize, open: bool, context: &mut PaneContext<'_>) {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW), Sense::click());
    let title = capitalized(kind.key());
    let name = format!("{title} {count}");
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::DisclosureTriangle, true, open, &name));
    rim(ui, rect, &response, context);
    let center = egui::pos2(rect.left() + 7.0, rect.center().y);
    let points = if open { [(-4.0, -2.0), (4.0, -2.0), (0.0, 3.0)] } else { [(-2.0, -4.0), (3.0, 0.0), (-2.0, 4.0)] };
    let points = points.map(|(x, y)| center + Vec2::new(x, y)).to_vec();
    ui.painter().add(egui::Shape::convex_polygon(points, context.theme.text, egui::Stroke::NONE));
    let words = rect.with_min_x(rect.left() + 4.0 * UNIT);
    lines::elided(ui, words, &format!("{title}  {count}"), TextStyle::Body, context.theme.text);
    if response.clicked() && context.view.search.trim().is_empty() {
        let folded = &mut context.view.saved.folded;
        if !folded.remove(kind.key()) {
            folded.insert(kind.key().to_owned());
        }
    }
}

fn rim(ui: &Ui, rect: Rect, response: &Response, context: &PaneContext<'_>) {
    if response.hovered() || response.has_focus() {
        let fill = if response.hovered() { context.theme.control } else { context.theme.panel };
        ui.painter().rect(rect, 3.0, fill, focus_rim(response, &context.theme), egui::StrokeKind::Inside);
    }
}

/// True if a set is in use, and whether that can be changed here.
fn state(entry: &Entry, context: &PaneContext<'_>) -> (bool, bool) {
    let document = context.scene.document;
    let is_reference = entry.kind == SetKind::Observer && entry.name == document.reference;
    (document.uses(entry.kind, &entry.name), !is_reference)
}

fn set(ui: &mut Ui, entry: &Entry, context: &mut PaneContext<'_>) {
    let (on, enabled) = state(entry, context);
    let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW), Sense::hover());
    let id = ui.scope_id().with(("set", entry.kind, &entry.name, entry.is_own()));
    let mut row = rect.with_min_x(rect.left() + 2.0 * UNIT);
    if entry.is_own() {
        row.max.x -= lines::DOTS + UNIT + SCROLL_BAR;
    }
    let response = ui.interact(row, id, Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, enabled, on, &entry.name));
    rim(ui, row, &response, context);
    let mark = egui::pos2(row.left() + 11.0, row.center().y);
    draw_mark(ui, mark, on, enabled, context);
    let mut words = row.with_min_x(row.left() + 6.0 * UNIT);
    let place = egui::pos2(rect.right() - SCROLL_BAR - lines::DOTS, row.top());
    let shown = menu_of(ui, Rect::from_min_size(place, Vec2::new(lines::DOTS, ROW)), &response, entry, context);
    if entry.is_own() {
        words.max.x -= lines::right_aligned(ui, words, "yours", TextStyle::Small, context.theme.weak) + UNIT;
    } else if shown {
        words.max.x = place.x - UNIT;
    }
    // A tag that cuts the name off says less than the name does.
    if entry.is_digitized() && lines::width(ui, &entry.name, TextStyle::Body) + DIGITIZED < words.width() {
        words.max.x -= lines::right_aligned(ui, words, "digitized", TextStyle::Small, context.theme.weak) + UNIT;
    }
    let color = if enabled { context.theme.text } else { context.theme.weak };
    let cut = lines::name(ui, words, &entry.name, TextStyle::Body, color);
    if enabled && response.clicked() {
        choose(entry, !on, context);
    }
    // Source, terms and curve stand in the inspector, a sensor's locus in the diagram, where they cover nothing.
    if response.hovered() || response.has_focus() {
        context.view.hover(Some(&PlotItem::of_set(entry.kind, &entry.name)));
    }
    let also = entry.also.clone().filter(|also| *also != entry.name);
    if !enabled || cut || also.is_some() {
        response.on_hover_ui(|ui| {
            ui.set_max_width(row.width());
            ui.strong(&entry.name);
            also.map(|also| ui.label(also));
            if !enabled {
                ui.small("The reference cannot be removed; choose another reference first.");
            }
        });
    }
}

/// A box with a tick.
fn draw_mark(ui: &Ui, at: egui::Pos2, on: bool, enabled: bool, context: &PaneContext<'_>) {
    let theme = context.theme;
    let square = Rect::from_center_size(at, Vec2::splat(14.0));
    let rim = egui::Stroke::new(1.0, theme.hover);
    ui.painter().rect(square, 3.0, theme.control, rim, egui::StrokeKind::Inside);
    if on {
        let corner = |x: f32, y: f32| at + Vec2::new(x, y);
        let tick = vec![corner(-3.5, 0.0), corner(-1.0, 3.0), corner(3.5, -3.5)];
        let color = if enabled { theme.text } else { theme.weak };
        ui.painter().add(egui::Shape::line(tick, egui::Stroke::new(1.8, color)));
    }
}

/// The dots at the end of a row and their menu, which a right click on the row and the menu key open, too. The row of a
/// built-in set shows its dots while it is hovered or focused. Returns whether they are visible.
fn menu_of(ui: &Ui, rect: Rect, row: &Response, entry: &Entry, context: &mut PaneContext<'_>) -> bool {
    let id = row.id.with("dots");
    let whose = if entry.is_own() { "Menu of your" } else { "Menu in the library of" };
    let name = format!("{whose} {}", entry.name);
    let popup = Popup::default_response_id(row).with("menu");
    let shown = entry.is_own()
        || row.contains_pointer()
        || row.has_focus()
        || ui.memory(|memory| memory.has_focus(id))
        || Popup::is_id_open(ui.ctx(), popup)
        || ui.rect_contains_pointer(rect);
    let button = if shown {
        lines::dots(ui, rect, id, &name)
    } else {
        // Invisible, but accessible to keyboards and screen readers.
        let button = ui.interact(rect, id, Sense::click());
        labeled(&button, egui::Role::Button, &name);
        button
    };
    let focused = row.has_focus() || button.has_focus();
    let key = focused
        && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Menu) || i.consume_key(Modifiers::SHIFT, Key::F10));
    let toggled = button.clicked() || key;
    Popup::menu(&button)
        .id(popup)
        .open_memory(toggled.then_some(egui::SetOpenCommand::Toggle))
        .show(|ui| menu(ui, entry, context));
    row.context_menu(|ui| menu(ui, entry, context));
    shown
}
