//! Help pages and the palette that finds anything.

use egui::{Align2, Grid, Key, RichText, ScrollArea, TextEdit, Ui, Vec2, Window};

use super::context::PaneContext;
use crate::action::history::History;
use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::catalog::{Entry, licenses, names};
use crate::command::{Command, key_bindings};
use crate::document::{Light, SetKind};
use crate::panes::widgets::{WHAT_YOU_SEE, facts};
use crate::theme::{ROW, UNIT};
use crate::view::HelpPage;
use crate::view::import::ImportItem;
use crate::workspaces::{PaneKind, Workspace};

/// Shows what is open.
pub fn show(ui: &mut Ui, history: &History, context: &mut PaneContext<'_>) {
    if let Some(page) = context.view.help {
        show_page(ui, page, context);
    }
    if context.view.palette.is_some() {
        palette(ui, history, context);
    }
}

fn title(page: HelpPage) -> &'static str {
    match page {
        HelpPage::WhatYouSee => "What you see",
        HelpPage::Keyboard => "Keyboard",
        HelpPage::Data => "Data and sources",
        HelpPage::Equations => "Equations",
        HelpPage::About => "About Chromascope",
    }
}

fn show_page(ui: &Ui, page: HelpPage, context: &mut PaneContext<'_>) {
    let mut open = true;
    let screen = ui.ctx().content_rect();
    let size = Vec2::new(620.0_f32.min(screen.width() - 40.0), 520.0_f32.min(screen.height() - 80.0));
    Window::new(title(page))
        .id(egui::Id::unique("help"))
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, Vec2::ZERO)
        .fixed_size(size)
        .show(ui.ctx(), |ui| {
            ui.horizontal_wrapped(|ui| {
                use HelpPage::{About, Data, Equations, Keyboard, WhatYouSee};
                for other in [WhatYouSee, Keyboard, Data, Equations, About] {
                    if ui.selectable_label(other == page, title(other)).clicked() {
                        context.view.help = Some(other);
                    }
                }
            });
            ui.separator();
            ScrollArea::vertical().id_salt(title(page)).auto_shrink(false).show(ui, |ui| match page {
                HelpPage::WhatYouSee => what_you_see(ui),
                HelpPage::Keyboard => keyboard(ui, context),
                HelpPage::Data => data(ui, context),
                HelpPage::Equations => equations(ui),
                HelpPage::About => about(ui),
            });
        });
    if !open {
        context.view.help = None;
    }
}

fn what_you_see(ui: &mut Ui) {
    for paragraph in [
        WHAT_YOU_SEE,
        "Chromaticity. The thick line is the Planckian locus of the reference observer, from 20000 K (blue) to 1000 K (red); \
         thinner lines are those of the cameras. Points are the patches of a chart; a tail leads from a \
         camera's point to the reference's. The strip below shows each camera's distance from the reference over temperature; a \
         ring marks its minimum, which lies where signals are balanced (equal energy by the paper's matrix, the light by a fitted \
         transform) and says little about the camera. Loci and distances are dotted where they are extrapolated: below 2500 K for \
         tables that end before 720 nm. Drag in the strip to set the temperature.",
        "Swatches. The same patches as colors: the left half as the reference sees them, the right half as the camera records \
         them. The bar below a swatch is the difference. A notched corner marks a color that the screen cannot show.",
        "Spectra. The light, the reflectances and the sensitivities that all of this is computed from. Dotted parts were not \
         measured: the last value is held.",
        "Render. A head, a fern or a mesh of yours with measured skin or leaf under the light, through each camera beside the \
         reference. Drag to orbit, all pictures together; the wheel moves nearer; a click keeps a pixel, a double click shows its \
         picture alone. Figure 8 and Figure 9 are the paper's, with light and white balance; Normalization says what its Eq 1 stands for. \
         Difference maps how far each camera is from the reference.",
        "Accuracy. What the scene on show costs by each method, with its error, measured when you press Run: no figure without \
         its error; Bench does the same on inputs of its own. Left out lists what was not computed, and the time that computing \
         it took. Under Tolerance you choose the largest error; each camera then says which method keeps it, with an estimated \
         error bound.",
        "Color transform: paper matrix. Camera and RGB observer signals, balanced so that a flat spectrum is 1 : 1 : 1, go through the \
         matrix of Eq 13; equal energy falls on D65 (0.3127, 0.3290). CIE observers are drawn directly, with equal energy at \
         (1/3, 1/3), so they differ from the others by construction and cannot be compared with them. Eq 13 takes an observer's RGB \
         as sRGB, so the ΔE*00 formula on its colors is not ΔE*00: it is called Δ of Eq 13 colors, and distances in the diagram \
         come first.",
        "Color transform: fitted. CIE observers directly; all others through a 3×3 matrix, fitted to the named observer over 190 \
         training reflectances under the chosen light so that white stays white. Then everything can be compared. The fit follows when another XYZ \
         observer becomes the reference.",
        "Hover to read, click to select, Esc to deselect. Drop files anywhere, or paste numbers: spectra and camera sensitivities \
         as text, with any delimiter. What was decided on reading is shown and can be changed. One file is put to use as what it \
         is; of several at once cameras are put on show, and light and patches stay.",
        "Import. Before each file stands a mark: a dot, read; a ring, read with guesses; a diamond, read with guesses that nobody \
         has looked at; a dash, not used; a triangle, not read. In the text wavelengths are underlined, names lie on a ground, \
         units are slanted; what is not used, and curves that are left out, are pale, and rows left out are struck through. \
         What is tried on a file stays with it until it can be read so, or until Forget choices. F6 leads to the files, the \
         switches and the curves; arrows move there, Enter takes.",
    ] {
        ui.label(paragraph);
        ui.add_space(2.0 * UNIT);
    }
}

fn keyboard(ui: &mut Ui, context: &PaneContext<'_>) {
    let focused = context.view.focused.unwrap_or(PaneKind::CHROMATICITY);
    let mut rows: Vec<(String, String)> = Vec::new();
    for binding in key_bindings(focused) {
        let words = match binding.command {
            Command::Show(workspace) => format!("Workspace {}", workspace.title()),
            Command::ToggleSource(0) => "Show or hide the first source (2 to 9: the others)".to_owned(),
            Command::ToggleSource(_) => continue,
            _ => binding.words.to_owned(),
        };
        rows.push((ui.ctx().format_shortcut(&binding.shortcut), words));
    }
    for (key, words) in [
        ("Ctrl+C", "Copy the pane's numbers"),
        ("Ctrl+V", "Read the clipboard as data"),
        ("B, held", "The reference in place of every camera"),
        ("Ctrl +, Ctrl −, Ctrl 0", "Larger, smaller, normal size"),
        ("Tab, Shift+Tab", "Next, previous control"),
        ("Arrows in the strip", "Temperature"),
        ("Drag, arrows in Render", "Orbit all pictures"),
        ("Wheel, + and − in Render", "Nearer, farther"),
        ("Click, double click in Render", "Keep a pixel; one picture, all pictures"),
        ("Esc in Render", "Stop rendering, let go of the pixel, all pictures"),
        ("Ctrl+Q", "Quit"),
    ] {
        rows.push((key.to_owned(), words.to_owned()));
    }
    ui.label("Letters rest while you type.");
    Grid::new("keys").num_columns(2).spacing([6.0 * UNIT, UNIT]).show(ui, |ui| {
        for (key, words) in rows {
            ui.monospace(key);
            ui.label(words);
            ui.end_row();
        }
    });
}

/// What holds for every table.
const DATA: [&str; 5] = [
    "Every built-in table with its source and terms. Hover a name in the Library for its notes.",
    "Resampling. Integrals run over 380–780 nm at 1 nm by the trapezoid rule. Tables with uniform steps of 5 nm or more are \
     brought to 1 nm by Sprague's interpolation (CIE 167:2005); all others, and every light, linearly. Reflectances and camera \
     sensitivities that interpolation makes negative become zero; color matching functions keep their negative lobes.",
    "Beyond a table's ends. Sensitivities count as zero there, so each channel is integrated over its own table only; \
     reflectances and lights hold their end values, which are drawn dotted. A camera whose table ends before 720 nm has its locus \
     dotted below 2500 K: there the missing red tail matters. Cutting the measured Nikon D70 at 700 nm moves its 1000 K point by \
     two thirds of its distance to the reference (Eq 13).",
    "Per energy or per photon. Stated: the source says it, or it follows from the definition. Inferred: concluded from how the \
     source or its programs use the table; the note gives the grounds. Unknown: taken as per energy.",
    "Digitized tables were read off a published figure; of one model's tables they stand last. A table of the Kodak DCS420, the \
     third camera of the 2007 paper, is in Zhao et al. 2009 (Zenodo 4297288), which could not be obtained: its sister, the DCS200, \
     stands in. Open reads a copy that you have.",
];

fn data(ui: &mut Ui, context: &PaneContext<'_>) {
    for paragraph in DATA {
        ui.label(paragraph);
        ui.add_space(UNIT);
    }
    let mut shown = std::collections::BTreeSet::new();
    for kind in SetKind::ALL {
        ui.add_space(2.0 * UNIT);
        ui.heading(kind.plural());
        for header in context.scene.catalog.of_kind(kind).filter_map(|entry| entry.header.as_ref()) {
            if shown.insert((kind, header.title.clone())) {
                ui.label(RichText::new(&header.title).strong());
                if matches!(kind, SetKind::Camera | SetKind::Observer) {
                    ui.label(RichText::new(format!("Response: {}", facts::response_of(header))).small());
                }
                if header.is_digitized() {
                    ui.label(RichText::new("Origin: digitized from a figure").small());
                }
                ui.label(RichText::new(&header.source).small());
                ui.label(RichText::new(&header.license).small().color(context.theme.weak));
            }
        }
    }
}

fn equations(ui: &mut Ui) {
    for (number, formula, words) in [
        (
            "Eq 1",
            "P = ρ₀² exp(−g) + D,  ρ₀ = sinc(v_x X) sinc(v_y Y),  g = σ² v_z²",
            "Light scattered by a rough surface: a coherent (specular) component and a diffuse one. σ: RMS roughness; τ: \
             correlation length; X, Y: half-widths of the illuminated area. sinc x = sin x / x; the light comes from azimuth \
             π. Fresnel, untinted: ρ₀² times F at the half vector, without S(λ).",
        ),
        (
            "Eq 2",
            "D = (π τ² / A) G² exp(−g) Σ gⁿ / (n! n) exp(−τ² v_xy² / (4 n))",
            "n from 1 on. A = 4XY; the paper prints XY, which can be chosen, but its patch is 2X by 2Y. Summed by one method for all g: around its saddle, directly where few terms count.",
        ),
        (
            "Eq 3",
            "G² = (1 − F(θi, n)) (1 − F(asin(sin θs / n), 1 / n)) cos θi",
            "Fresnel's transmittances into the surface and out of it.",
        ),
        (
            "Eq 4",
            "D = π τ² G² / (A σ² v_z²) exp(−τ² v_xy² / (4 σ² v_z²))",
            "Eq 2 for very rough surfaces, g ≫ 1. It stands behind the paper's third case of g.",
        ),
        (
            "Eq 11",
            "s_c = κ_c m dω ∫ C_c L dλ",
            "White-balance target s: the RGB that a perfect diffuser under the light is mapped to. It is also the adopted white of \
             L*a*b*.",
        ),
        (
            "Eq 12",
            "I_c = s_c cos θi cos⁴α ∫ C_c P S L dλ / ∫ C_c L dλ",
            "A pixel through a camera. Reading: P itself (Paper), or π f with f = A / (λ² cos θs) (cos θi ρ₀² exp(−g) + D) \
             (Radiometric), or the same with Beckmann's geometric factor (Microfacet).",
        ),
        (
            "Eq 13",
            "X = 0.4124 R + 0.3576 G + 0.1805 B\nY = 0.2126 R + 0.7152 G + 0.0722 B\nZ = 0.0193 R + 0.1192 G + 0.9505 B",
            "From RGB to XYZ; then x = X / (X + Y + Z), y = Y / (X + Y + Z).",
        ),
        (
            "Eq 14",
            "E(λ, T) = c₁ / (λ⁵ (exp(c₂ / (λ T)) − 1))",
            "Planck's law, with the paper's constants c₁ = 3.74183e−16 W m², c₂ = 1.4388e−2 m K.",
        ),
        ("Eq 15", "I_c(T) = s_c ∫ C_c E dλ / ∫ C_c dλ", "A blackbody through a camera, balanced to equal energy."),
        ("Eq 16", "I_c = s_c ∫ C_c S L dλ / ∫ C_c L dλ", "A patch through a camera, balanced to the light."),
        (
            "Observer",
            "XYZ = M (I / s),  M minimizes Σ |M I − XYZ|² with M white = white",
            "Over the 190 training reflectances under the light; the same matrix along a locus.",
        ),
        (
            "Integrals",
            "∫ f dλ = Σ f(λ_i),  380 … 780 nm at 1 nm, half weight at the ends",
            "Tables with even steps of 5 nm or more by Sprague's interpolation, lights linearly. Sensitivities are zero outside \
             their table; reflectances and lights hold their end value, dotted.",
        ),
    ] {
        ui.label(RichText::new(number).strong());
        ui.monospace(formula);
        ui.label(words);
        ui.add_space(2.0 * UNIT);
    }
    ui.label(
        "Equation numbers are those of C. P. Huynh and A. Robles-Kelly, “Comparative Colorimetric Simulation and Evaluation of \
         Digital Cameras Using Spectroscopy Data”, 2007.",
    );
}

fn about(ui: &mut Ui) {
    ui.heading(concat!("Chromascope ", env!("CARGO_PKG_VERSION")));
    ui.label(env!("CARGO_PKG_DESCRIPTION"));
    ui.label(
        "Free software under the MIT or the Apache-2.0 license, as you choose. Data and fonts have terms of their own:",
    );
    ui.add_space(UNIT);
    for (name, text) in licenses() {
        ui.collapsing(name, |ui| {
            ui.label(RichText::new(text).small());
        });
    }
}

/// One thing that the palette finds.
struct Found {
    words: String,
    note: String,
    command: Command,
}

/// A field and what matches it. Enter takes the first, arrows and Tab go on.
fn palette(ui: &Ui, history: &History, context: &mut PaneContext<'_>) {
    let Some(mut typed) = context.view.palette.take() else { return };
    let mut chosen = None;
    let screen = ui.ctx().content_rect();
    let window = Window::new("Find anything")
        .id(egui::Id::unique("palette"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 84.0))
        .fixed_size(Vec2::new(520.0_f32.min(screen.width() - 40.0), 360.0));
    window.show(ui.ctx(), |ui| {
        let hint = "A command, a camera, a light, a chart…";
        let field = TextEdit::singleline(&mut typed).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Find anything"));
        if !field.has_focus() && !field.lost_focus() && ui.memory(|memory| memory.focused().is_none()) {
            field.request_focus();
        }
        let found = find(&typed, history, context);
        if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            chosen = found.first().map(|found| found.command.clone());
        }
        if found.is_empty() {
            ui.label("No match.");
        }
        ScrollArea::vertical().auto_shrink([false, true]).show_rows(ui, ROW, found.len(), |ui, rows| {
            for found in &found[rows] {
                let button = egui::Button::new(&found.words).shortcut_text(&found.note).frame_when_inactive(false);
                if ui.add_sized([ui.available_width(), ROW], button).clicked() {
                    chosen = Some(found.command.clone());
                }
            }
        });
    });
    match chosen {
        Some(command) => context.push(command),
        None => context.view.palette = Some(typed),
    }
}

fn find(typed: &str, history: &History, context: &PaneContext<'_>) -> Vec<Found> {
    let wanted: Vec<String> = typed.split_whitespace().map(names::folded).collect();
    let matches = |words: &str| {
        let words = names::folded(words);
        wanted.iter().all(|word| words.contains(word))
    };
    let focused = context.view.focused.unwrap_or(PaneKind::CHROMATICITY);
    let mut found: Vec<Found> = key_bindings(focused)
        .into_iter()
        .filter(|binding| {
            !matches!(binding.command, Command::ToggleSource(_) | Command::FindAnything | Command::Escape)
        })
        .filter(|binding| binding.command != Command::Undo || history.undo_name().is_some())
        .map(|binding| Found {
            words: match binding.command {
                Command::Show(workspace) => format!("Workspace {}", Workspace::title(workspace)),
                _ => binding.words.to_owned(),
            },
            note: key_name(binding.shortcut),
            command: binding.command,
        })
        .filter(|found| matches(&found.words))
        .collect();
    for (action, words) in [
        (RenderAction::Figure8, "Figure 8: a head under direct sunlight"),
        (RenderAction::Figure9, "Figure 9: a fern under direct sunlight"),
        (RenderAction::PaperFigure8, "Figure 8, as in the paper: point light, Eq 12 as printed"),
        (RenderAction::PaperFigure9, "Figure 9, as in the paper: point light, Eq 12 as printed"),
    ] {
        if matches(words) {
            let command = Command::Do(Action::Render(action));
            found.push(Found { words: words.to_owned(), note: "render".to_owned(), command });
        }
    }
    for kind in SetKind::ALL {
        let entries = context.scene.entries(kind).filter(|entry| names::matches_search(entry, typed));
        found.extend(entries.map(|entry| entry_found(kind, &entry)));
    }
    found
}

fn key_name(shortcut: egui::KeyboardShortcut) -> String {
    shortcut.format(&egui::ModifierNames::NAMES, cfg!(target_os = "macos"))
}

/// What choosing a data set does.
fn entry_found(kind: SetKind, entry: &Entry) -> Found {
    let name = entry.name.clone();
    let action = match kind {
        SetKind::Camera | SetKind::Observer => Action::Compare(CompareAction::Add(kind, name)),
        SetKind::Chart | SetKind::Material => Action::Scene(SceneAction::SetChart(name)),
        SetKind::Illuminant => Action::Scene(SceneAction::SetLight(Light::Set(name))),
        SetKind::Unsorted => {
            let command = Command::ShowImport(ImportItem::Set(name), None);
            return Found { words: entry.name.clone(), note: "not sorted yet: say what it is".to_owned(), command };
        }
    };
    let verb = match kind {
        SetKind::Camera | SetKind::Observer => "compare",
        SetKind::Chart | SetKind::Material => "as patches",
        SetKind::Illuminant | SetKind::Unsorted => "as light",
    };
    Found { words: entry.name.clone(), note: format!("{}, {verb}", kind.singular()), command: Command::Do(action) }
}
