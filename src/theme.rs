//! Every color, size and stroke. Only data has color, the frame is pure gray; numbers sit on a grid of 4 points.

use std::sync::Arc;

use chromascope_figure::{Ink, InkRole, Palette as _, TextSize};
use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, Style, TextStyle,
    Vec2, Visuals, style::WidgetVisuals,
};

use crate::palette::{Colors, FONT, FONT_FAMILY, MONO_FAMILY, MONO_FONT};
pub use crate::palette::{LINE_TAIL, SourceInks, Surround};

/// Seconds that the pointer rests before a tooltip.
pub const TOOLTIP_DELAY: f32 = 0.3;
pub const UNIT: f32 = 4.0;
/// Height of a row, smallest side of what can be clicked.
pub const ROW: f32 = 24.0;
pub const TEXT: f32 = TextSize::Body.points();
pub const HEADING: f32 = TextSize::Heading.points();
pub const SMALL: f32 = TextSize::Small.points();
pub const MONO: f32 = TextSize::Mono.points();

pub const LINE_GRID: f64 = 1.0;
/// Opacity of unselected items while something is selected.
pub const FADED: f32 = 0.35;

pub const FOCUS: f32 = 2.0;

const CORNER: u8 = 3;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// Those of figures.
    pub colors: Colors,
    pub dark: bool,
    pub panel: Color32,
    pub plot: Color32,
    pub control: Color32,
    pub hover: Color32,
    pub chosen: Color32,
    pub line: Color32,
    pub grid: Color32,
    pub text: Color32,
    pub weak: Color32,
    pub focus: Color32,
    pub warning: Color32,
    pub error: Color32,
    /// The gray around swatches and renders, and labels on it.
    pub surround: Color32,
    pub on_surround: Color32,
}

pub const fn rgb([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}

impl Theme {
    pub const DARK: Self = Self::new(Colors::DARK, [0x38, 0x48, 0x58, 0xFF], [0xFF, 0x7B, 0x72]);
    pub const LIGHT: Self = Self::new(Colors::LIGHT, [0xDA, 0xCC, 0xBC, 0x00], [0xB3, 0x26, 0x1E]);

    const fn new(colors: Colors, [control, hover, chosen, focus]: [u8; 4], error: [u8; 3]) -> Self {
        Self {
            colors,
            dark: colors.dark,
            panel: rgb(colors.panel),
            plot: rgb(colors.plot),
            control: Color32::from_gray(control),
            hover: Color32::from_gray(hover),
            chosen: Color32::from_gray(chosen),
            line: rgb(colors.line),
            grid: rgb(colors.grid),
            text: rgb(colors.text),
            weak: rgb(colors.weak),
            focus: Color32::from_gray(focus),
            warning: rgb(colors.warning),
            error: rgb(error),
            surround: rgb(colors.surround.color()),
            on_surround: rgb(colors.surround.ink()),
        }
    }

    pub const fn of(visuals: &Visuals) -> Self {
        if visuals.dark_mode { Self::DARK } else { Self::LIGHT }
    }

    #[must_use]
    pub const fn with_surround(self, surround: Surround) -> Self {
        let colors = Colors { surround, ..self.colors };
        Self { colors, surround: rgb(surround.color()), on_surround: rgb(surround.ink()), ..self }
    }

    pub fn role(&self, role: InkRole) -> Color32 {
        rgb(self.colors.rgb(role))
    }

    /// The gray behind a number: a share from 0 (the ground of a pane) to 1 (the darkest, or in a dark theme the lightest).
    pub fn shade(&self, share: f32) -> Color32 {
        self.panel.lerp_to_gamma(self.chosen, share.clamp(0.0, 1.0))
    }

    pub fn ink(&self, ink: Ink) -> Color32 {
        self.role(ink.role).gamma_multiply(ink.alpha.clamp(0.0, 1.0))
    }

    pub fn style(&self) -> Style {
        let mut style = Style { visuals: self.visuals(), animation_time: 0.0, ..Style::default() };
        style.text_styles = text_styles();
        let spacing = &mut style.spacing;
        spacing.item_spacing = Vec2::splat(UNIT);
        spacing.button_padding = Vec2::new(2.0 * UNIT, UNIT);
        spacing.interact_size = Vec2::new(ROW, ROW);
        spacing.menu_margin = Margin::same(4);
        spacing.window_margin = Margin::same(8);
        spacing.indent = 4.0 * UNIT;
        spacing.icon_width = 14.0;
        spacing.icon_width_inner = 8.0;
        spacing.icon_spacing = 1.5 * UNIT;
        spacing.combo_height = 12.0 * ROW;
        spacing.tooltip_width = 360.0;
        style.interaction.selectable_labels = false;
        style.interaction.tooltip_delay = TOOLTIP_DELAY;
        style.url_in_tooltip = true;
        style
    }

    fn visuals(&self) -> Visuals {
        let mut visuals = if self.dark { Visuals::dark() } else { Visuals::light() };
        let widget = |fill: Color32, rim: Stroke| WidgetVisuals {
            bg_fill: fill,
            weak_bg_fill: fill,
            bg_stroke: rim,
            corner_radius: CornerRadius::same(CORNER),
            fg_stroke: Stroke::new(1.0, self.text),
            expansion: 0.0,
        };
        let widgets = &mut visuals.widgets;
        widgets.noninteractive = widget(self.panel, Stroke::new(1.0, self.line));
        widgets.inactive = widget(self.control, Stroke::NONE);
        widgets.hovered = widget(self.hover, Stroke::NONE);
        // Pressed or focused; what has the keyboard also has a ring.
        widgets.active = widget(self.hover, Stroke::new(1.5, self.text));
        widgets.open = widget(self.hover, Stroke::NONE);
        visuals.selection.bg_fill = self.chosen;
        visuals.selection.stroke = Stroke::new(1.0, self.text);
        visuals.weak_text_color = Some(self.weak);
        // No link is blue: it is underlined.
        visuals.hyperlink_color = self.text;
        visuals.warn_fg_color = self.warning;
        visuals.error_fg_color = self.error;
        visuals.panel_fill = self.panel;
        visuals.window_fill = self.panel;
        visuals.window_stroke = Stroke::new(1.0, self.line);
        visuals.faint_bg_color = self.panel;
        visuals.extreme_bg_color = self.plot;
        visuals.text_edit_bg_color = Some(self.plot);
        visuals.code_bg_color = self.plot;
        visuals.text_cursor.stroke = Stroke::new(1.5, self.text);
        visuals.window_corner_radius = CornerRadius::same(CORNER);
        visuals.menu_corner_radius = CornerRadius::same(CORNER);
        visuals.window_shadow = Shadow::NONE;
        visuals.popup_shadow = Shadow::NONE;
        visuals.slider_trailing_fill = true;
        visuals
    }
}

pub fn font(size: TextSize) -> FontId {
    match size {
        TextSize::Mono => FontId::monospace(size.points()),
        _ => FontId::proportional(size.points()),
    }
}

fn text_styles() -> std::collections::BTreeMap<TextStyle, FontId> {
    [
        (TextStyle::Small, font(TextSize::Small)),
        (TextStyle::Body, font(TextSize::Body)),
        (TextStyle::Button, font(TextSize::Body)),
        (TextStyle::Heading, font(TextSize::Heading)),
        (TextStyle::Monospace, font(TextSize::Mono)),
    ]
    .into()
}

const BOLD_FONT: &[u8] = include_bytes!("../assets/fonts/DejaVuSans-Bold.ttf");

/// Family of the bold face, which is for headings and emphasis on screen alone.
pub fn bold() -> FontFamily {
    FontFamily::Name("DejaVu Sans Bold".into())
}

/// The bundled fonts: text and numbers the same on screen and in figures.
pub fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, bytes, family) in [
        (FONT_FAMILY, FONT, FontFamily::Proportional),
        (MONO_FAMILY, MONO_FONT, FontFamily::Monospace),
        ("DejaVu Sans Bold", BOLD_FONT, bold()),
    ] {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
        // The text font has characters the other lacks.
        let order = [name, FONT_FAMILY].map(str::to_owned);
        let order = if name == FONT_FAMILY { order[..1].to_vec() } else { order.to_vec() };
        fonts.families.insert(family, order);
    }
    fonts
}

pub fn apply(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    ctx.set_style_of(egui::Theme::Dark, Theme::DARK.style());
    ctx.set_style_of(egui::Theme::Light, Theme::LIGHT.style());
}
