//! Every color, size and stroke. Only data has color, the frame is pure gray; numbers sit on a grid of 4 points.

use chromascope_text::choices;
use std::sync::Arc;

use chromascope_figure::{Ink, InkRole, Palette, TextSize};
use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, Style, TextStyle,
    Vec2, Visuals, style::WidgetVisuals,
};

/// Unit of all distances.
pub const UNIT: f32 = 4.0;
/// Height of a row, smallest side of what can be clicked.
pub const ROW: f32 = 24.0;
/// Font sizes.
pub const TEXT: f32 = TextSize::Body.points();
/// Font size of headings.
pub const HEADING: f32 = TextSize::Heading.points();
/// Font size of captions and notes.
pub const SMALL: f32 = TextSize::Small.points();
/// Font size of numbers.
pub const MONO: f32 = TextSize::Mono.points();

/// Width of the tail from a point to the reference.
pub const LINE_TAIL: f64 = 1.2;
/// Width of grid lines.
pub const LINE_GRID: f64 = 1.0;
/// Opacity of the colors in a chromaticity diagram.
pub const DIAGRAM_FILL: f32 = 0.1;
/// Opacity of unselected items while something is selected.
pub const FADED: f32 = 0.35;

/// Width of the ring around the control that has the keyboard.
pub const FOCUS: f32 = 2.0;

/// Corner radius of controls.
const CORNER: u8 = 3;

/// Family of text in figures.
pub const FONT_FAMILY: &str = "DejaVu Sans";
/// Family of numbers in figures.
pub const MONO_FAMILY: &str = "DejaVu Sans Mono";
/// The text font.
pub const FONT: &[u8] = include_bytes!("../assets/fonts/DejaVuSans.ttf");
/// The font of numbers.
pub const MONO_FONT: &[u8] = include_bytes!("../assets/fonts/DejaVuSansMono.ttf");

/// The gray around swatches and renders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize, serde::Deserialize)]
pub enum Surround {
    /// 777777, L* 50.
    #[default]
    Middle,
    /// 3A3A3A.
    Dark,
    /// BABABA.
    Light,
}

impl Surround {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Middle, Self::Dark, Self::Light];

    /// The name on screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Middle => "Middle gray, L* 50",
            Self::Dark => "Dark gray",
            Self::Light => "Light gray",
        }
    }

    /// The gray.
    pub const fn color(self) -> Color32 {
        match self {
            Self::Middle => Color32::from_gray(0x77),
            Self::Dark => Color32::from_gray(0x3A),
            Self::Light => Color32::from_gray(0xBA),
        }
    }

    /// Labels on it.
    pub const fn label(self) -> Color32 {
        match self {
            Self::Dark => Color32::WHITE,
            Self::Middle | Self::Light => Color32::BLACK,
        }
    }
}

choices! {
    /// Colors of compared sources in a figure.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
    pub enum SourceInks {
        /// Those on screen, told apart in all kinds of color vision.
        #[default]
        Screen = "safe", "Color", "Colors told apart in all kinds of color vision";
        /// Grays, told apart in print without color.
        Gray = "gray", "Gray", "Grays told apart in print without color";
    }
}

/// The colors of one theme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// True if text is light on dark.
    pub dark: bool,
    /// Ground of panes and bars.
    pub panel: Color32,
    /// Ground of plots, fields and lists.
    pub plot: Color32,
    /// Controls at rest.
    pub control: Color32,
    /// Controls under the pointer.
    pub hover: Color32,
    /// Chosen controls, selected text.
    pub chosen: Color32,
    /// Frames and separators.
    pub line: Color32,
    /// Grid lines.
    pub grid: Color32,
    /// Text.
    pub text: Color32,
    /// Text of less weight.
    pub weak: Color32,
    /// The ring around the control that has the keyboard.
    pub focus: Color32,
    /// Something to look after.
    pub warning: Color32,
    /// Something failed.
    pub error: Color32,
    /// The gray around swatches and renders.
    pub surround: Surround,
    /// The reference.
    pub reference: Color32,
    /// Observers other than the reference.
    pub observer: Color32,
    /// Compared sources by slot.
    pub sources: [Color32; 8],
}

const fn hex(rgb: u32) -> Color32 {
    Color32::from_rgb((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8)
}

impl Theme {
    /// Light on dark.
    pub const DARK: Self = Self {
        dark: true,
        panel: hex(0x0026_2626),
        plot: hex(0x001C_1C1C),
        control: hex(0x0038_3838),
        hover: hex(0x0048_4848),
        chosen: hex(0x0058_5858),
        line: hex(0x003C_3C3C),
        grid: hex(0x002C_2C2C),
        text: hex(0x00DE_DEDE),
        weak: hex(0x00A2_A2A2),
        focus: hex(0x00FF_FFFF),
        warning: hex(0x00F2_B84B),
        error: hex(0x00FF_7B72),
        surround: Surround::Middle,
        reference: hex(0x00F2_F2F2),
        observer: hex(0x009A_9A9A),
        sources: [
            hex(0x00D4_8924),
            hex(0x007F_A9FF),
            hex(0x00B8_ECA6),
            hex(0x00A0_68A8),
            hex(0x00E7_CC45),
            hex(0x0066_70F4),
            hex(0x00D7_4954),
            hex(0x006B_E6FE),
        ],
    };

    /// Dark on light. Figures are exported in it.
    pub const LIGHT: Self = Self {
        dark: false,
        panel: hex(0x00EB_EBEB),
        plot: hex(0x00FF_FFFF),
        control: hex(0x00DA_DADA),
        hover: hex(0x00CC_CCCC),
        chosen: hex(0x00BC_BCBC),
        line: hex(0x00C8_C8C8),
        grid: hex(0x00E8_E8E8),
        text: hex(0x001C_1C1C),
        weak: hex(0x0056_5656),
        focus: hex(0x0000_0000),
        warning: hex(0x008A_5A00),
        error: hex(0x00B3_261E),
        surround: Surround::Middle,
        reference: hex(0x0014_1414),
        observer: hex(0x0070_7070),
        sources: [
            hex(0x009B_5402),
            hex(0x0029_3C87),
            hex(0x005A_A269),
            hex(0x00CF_6ECA),
            hex(0x009C_8A08),
            hex(0x005F_50D3),
            hex(0x007E_1F2D),
            hex(0x001F_7B91),
        ],
    };

    /// Black on white, for print.
    pub const PRINT: Self = Self {
        panel: hex(0x00FF_FFFF),
        line: hex(0x0080_8080),
        grid: hex(0x00E2_E2E2),
        text: hex(0x0000_0000),
        weak: hex(0x0030_3030),
        reference: hex(0x0000_0000),
        observer: hex(0x0060_6060),
        ..Self::LIGHT
    };

    /// Theme with other colors of compared sources.
    #[must_use]
    pub fn with_inks(self, inks: SourceInks) -> Self {
        // Equal steps of L*, 18 to 77.5 on white and 42 to 96 on dark, neighbors in the list far apart.
        const LIGHT: [u8; 8] = [0x67, 0xA8, 0x2C, 0x92, 0x3F, 0xBF, 0x52, 0x7C];
        const DARK: [u8; 8] = [0x9E, 0xDE, 0x76, 0xF4, 0x8A, 0xC8, 0x63, 0xB3];
        match inks {
            SourceInks::Screen => self,
            SourceInks::Gray => {
                let grays = if self.dark { DARK } else { LIGHT };
                Self { sources: grays.map(Color32::from_gray), ..self }
            }
        }
    }

    /// The theme a [`egui::Ui`] or [`egui::Style`] with these visuals is drawn in.
    pub const fn of(visuals: &Visuals) -> Self {
        if visuals.dark_mode { Self::DARK } else { Self::LIGHT }
    }

    /// Theme with another gray around swatches and renders.
    #[must_use]
    pub const fn with_surround(self, surround: Surround) -> Self {
        Self { surround, ..self }
    }

    /// The color of a role.
    pub fn role(&self, role: InkRole) -> Color32 {
        match role {
            InkRole::Reference => self.reference,
            InkRole::Observer => self.observer,
            InkRole::Sensor(slot) => self.sources[usize::from(slot) % self.sources.len()],
            InkRole::Text => self.text,
            InkRole::Weak => self.weak,
            InkRole::Grid => self.grid,
            InkRole::Line => self.line,
            InkRole::Plot => self.plot,
            InkRole::Panel => self.panel,
            InkRole::Surround => self.surround.color(),
            InkRole::OnSurround => self.surround.label(),
            InkRole::Warning => self.warning,
            InkRole::Rgb([r, g, b]) => Color32::from_rgb(r, g, b),
        }
    }

    /// The gray behind a number: a share from 0 (the ground of a pane) to 1 (the darkest, or in a dark theme the lightest).
    pub fn shade(&self, share: f32) -> Color32 {
        self.panel.lerp_to_gamma(self.chosen, share.clamp(0.0, 1.0))
    }

    /// The color of an ink.
    pub fn ink(&self, ink: Ink) -> Color32 {
        self.role(ink.role).gamma_multiply(ink.alpha.clamp(0.0, 1.0))
    }

    /// The style of the window in this theme.
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
        style.interaction.tooltip_delay = 0.3;
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

impl Palette for Theme {
    fn rgb(&self, role: InkRole) -> [u8; 3] {
        let [r, g, b, _] = self.role(role).to_array();
        [r, g, b]
    }
}

/// Steps of the color scale of differences: uniform in L*, from blue through gray to yellow, distinguishable in all kinds
/// of color vision.
const DIFFERENCE_RAMP: [[u8; 3]; 9] = [
    [0x00, 0x33, 0x78],
    [0x2E, 0x48, 0x80],
    [0x51, 0x5D, 0x88],
    [0x6F, 0x74, 0x8F],
    [0x90, 0x8D, 0x82],
    [0xB1, 0xA4, 0x7B],
    [0xD0, 0xBD, 0x73],
    [0xEF, 0xD7, 0x68],
    [0xFF, 0xF1, 0x59],
];

/// The color of a share from 0 (no difference) to 1 (the scale's end).
pub fn difference_ramp(share: f32) -> [u8; 3] {
    let last = DIFFERENCE_RAMP.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f32;
    let index = (place as usize).min(last - 1);
    let part = place - index as f32;
    let mix = |channel: usize| {
        let [from, to] = [index, index + 1].map(|i| f32::from(DIFFERENCE_RAMP[i][channel]));
        (from + part * (to - from)).round() as u8
    };
    [mix(0), mix(1), mix(2)]
}

/// The font of a text size.
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

/// The bundled fonts: the same on screen and in figures.
pub fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, bytes, family) in
        [(FONT_FAMILY, FONT, FontFamily::Proportional), (MONO_FAMILY, MONO_FONT, FontFamily::Monospace)]
    {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
        // The text font has characters the other lacks.
        let order = [name, FONT_FAMILY].map(str::to_owned);
        let order = if name == FONT_FAMILY { order[..1].to_vec() } else { order.to_vec() };
        fonts.families.insert(family, order);
    }
    fonts
}

/// Gives the context the fonts and the style of both themes.
pub fn apply(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    ctx.set_style_of(egui::Theme::Dark, Theme::DARK.style());
    ctx.set_style_of(egui::Theme::Light, Theme::LIGHT.style());
}
