//! Numbers in aligned columns.

use chromascope_core::colorimetry::Xyz;
use chromascope_core::light::Cct;
use chromascope_core::query::PatchColor;
use egui::{FontId, Rect, Sense, Ui, Vec2};

use crate::format::fixed;
use crate::scene::Scene;
use crate::theme::{MONO, SMALL, Theme};

/// Height of a row of numbers.
const LINE: f32 = 15.0;
/// Width of the rows' names.
const NAMES: f32 = 40.0;

/// A row: its name, how many decimals, and a number for each column.
pub(super) struct Row {
    /// Name of the quantity.
    pub(super) name: &'static str,
    /// Number of decimals shown.
    pub(super) decimals: usize,
    /// The numbers; none where there is none.
    pub(super) cells: Vec<Option<f64>>,
}

/// The rows that patches have: RGB, both diagrams, L*a*b*.
pub(super) fn of_patches(scene: &Scene<'_>, colors: &[Option<PatchColor>]) -> Vec<Row> {
    let row = |name, decimals, take: &dyn Fn(&PatchColor) -> Option<f64>| Row {
        name,
        decimals,
        cells: colors.iter().map(|color| color.as_ref().and_then(take)).collect(),
    };
    let mut rows = vec![
        row("R", 4, &|c| c.rgb.map(|rgb| rgb[0])),
        row("G", 4, &|c| c.rgb.map(|rgb| rgb[1])),
        row("B", 4, &|c| c.rgb.map(|rgb| rgb[2])),
        row("x", 4, &|c| c.xy.map(|xy| xy.x)),
        row("y", 4, &|c| c.xy.map(|xy| xy.y)),
        row("u′", 4, &|c| c.uv.map(|uv| uv.u)),
        row("v′", 4, &|c| c.uv.map(|uv| uv.v)),
        row("L*", 2, &|c| c.lab.map(|lab| lab.l)),
        row("a*", 2, &|c| c.lab.map(|lab| lab.a)),
        row("b*", 2, &|c| c.lab.map(|lab| lab.b)),
    ];
    rows.extend(temperatures(scene, colors.iter().map(|color| color.map(|color| color.xyz))));
    rows
}

/// Correlated color temperature in kelvins and Duv, for the CIE 1931 observer; none where it is undefined.
pub(super) fn temperatures(scene: &Scene<'_>, colors: impl Iterator<Item = Option<Xyz>>) -> [Row; 2] {
    let found: Vec<Option<Cct>> = colors.map(|color| scene.temperature_of(color).ok()?.ok()).collect();
    let row = |name, decimals, take: fn(Cct) -> f64| Row {
        name,
        decimals,
        cells: found.iter().map(|cct| cct.map(take)).collect(),
    };
    [row("CCT", 0, |cct| cct.temperature.get()), row("Duv", 4, |cct| cct.duv)]
}

/// Writes rows below the columns' heads, each column flush right in its width.
pub(super) fn show(ui: &mut Ui, theme: &Theme, heads: &[String], rows: &[Row], column: f32) {
    let width = NAMES + column * heads.len() as f32;
    let place = |rect: Rect, index: usize| rect.left() + NAMES + column * (index + 1) as f32;
    let spacing = std::mem::take(&mut ui.spacing_mut().item_spacing.y);
    if heads.iter().any(|head| !head.is_empty()) {
        let (rect, _) = ui.allocate_exact_size(Vec2::new(width, LINE), Sense::hover());
        for (index, head) in heads.iter().enumerate() {
            let at = egui::pos2(place(rect, index), rect.center().y);
            ui.painter().text(at, egui::Align2::RIGHT_CENTER, head, FontId::proportional(SMALL), theme.weak);
        }
    }
    for row in rows {
        let (rect, response) = ui.allocate_exact_size(Vec2::new(width, LINE), Sense::hover());
        let mono = FontId::monospace(MONO);
        ui.painter().text(rect.left_center(), egui::Align2::LEFT_CENTER, row.name, mono.clone(), theme.weak);
        let words: Vec<String> = row.cells.iter().map(|cell| cell_words(*cell, row.decimals)).collect();
        for (index, words) in words.iter().enumerate() {
            let at = egui::pos2(place(rect, index), rect.center().y);
            ui.painter().text(at, egui::Align2::RIGHT_CENTER, words, mono.clone(), theme.text);
        }
        let spoken: Vec<String> = heads.iter().zip(&words).map(|(head, words)| format!("{head} {words}")).collect();
        let spoken = format!("{}: {}", row.name, spoken.join(", "));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &spoken));
    }
    ui.spacing_mut().item_spacing.y = spacing;
}

fn cell_words(cell: Option<f64>, decimals: usize) -> String {
    cell.map_or_else(|| "–".to_owned(), |value| fixed(value, decimals))
}

/// Rows for a spreadsheet, in full precision.
pub(super) fn to_tsv(heads: &[String], rows: &[Row]) -> String {
    let mut text = format!("quantity\t{}\n", heads.join("\t"));
    for row in rows {
        text.push_str(row.name);
        for cell in &row.cells {
            text.push('\t');
            text.extend(cell.map(|value| value.to_string()));
        }
        text.push('\n');
    }
    text
}
