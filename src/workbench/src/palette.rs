//! Colors of figures as bytes, and the bundled fonts: the same on screen and in files.

use chromascope_figure::{InkRole, Palette};
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

/// Width of the tail from a point to the reference.
pub const LINE_TAIL: f64 = 1.2;
/// Opacity of the colors in a chromaticity diagram.
pub const DIAGRAM_FILL: f32 = 0.1;

/// Family of text in figures.
pub const FONT_FAMILY: &str = "DejaVu Sans";
/// Family of numbers in figures.
pub const MONO_FAMILY: &str = "DejaVu Sans Mono";
pub const FONT: &[u8] = include_bytes!("../../../assets/fonts/DejaVuSans.ttf");
pub const MONO_FONT: &[u8] = include_bytes!("../../../assets/fonts/DejaVuSansMono.ttf");

/// The gray around swatches and renders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
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
    pub const ALL: [Self; 3] = [Self::Middle, Self::Dark, Self::Light];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Middle => "Middle gray, L* 50",
            Self::Dark => "Dark gray",
            Self::Light => "Light gray",
        }
    }

    pub const fn color(self) -> [u8; 3] {
        match self {
            Self::Middle => [0x77; 3],
            Self::Dark => [0x3A; 3],
            Self::Light => [0xBA; 3],
        }
    }

    /// Labels on it.
    pub const fn label(self) -> [u8; 3] {
        match self {
            Self::Dark => [0xFF; 3],
            Self::Middle | Self::Light => [0; 3],
        }
    }
}

choices! {
    /// Colors of compared sources in a figure.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
    pub enum SourceInks {
        #[default]
        Screen = "safe", "Color", "Colors told apart in all kinds of color vision";
        Gray = "gray", "Gray", "Grays told apart in print without color";
    }
}

/// The colors of figures in one theme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colors {
    /// True if text is light on dark.
    pub dark: bool,
    /// Ground of panes and pages.
    pub panel: [u8; 3],
    /// Ground of plots.
    pub plot: [u8; 3],
    /// Frames.
    pub line: [u8; 3],
    pub grid: [u8; 3],
    pub text: [u8; 3],
    /// Text of less weight.
    pub weak: [u8; 3],
    /// Something to look after.
    pub warning: [u8; 3],
    /// The gray around swatches and renders.
    pub surround: Surround,
    pub reference: [u8; 3],
    /// Observers other than the reference.
    pub observer: [u8; 3],
    /// Compared sources by slot.
    pub sources: [[u8; 3]; 8],
}

impl Colors {
    pub const DARK: Self = Self {
        dark: true,
        panel: [0x26; 3],
        plot: [0x1C; 3],
        line: [0x3C; 3],
        grid: [0x2C; 3],
        text: [0xDE; 3],
        weak: [0xA2; 3],
        warning: [0xF2, 0xB8, 0x4B],
        surround: Surround::Middle,
        reference: [0xF2; 3],
        observer: [0x9A; 3],
        sources: [
            [0xD4, 0x89, 0x24],
            [0x7F, 0xA9, 0xFF],
            [0xB8, 0xEC, 0xA6],
            [0xA0, 0x68, 0xA8],
            [0xE7, 0xCC, 0x45],
            [0x66, 0x70, 0xF4],
            [0xD7, 0x49, 0x54],
            [0x6B, 0xE6, 0xFE],
        ],
    };

    /// Dark on light. Figures are exported in it.
    pub const LIGHT: Self = Self {
        dark: false,
        panel: [0xEB; 3],
        plot: [0xFF; 3],
        line: [0xC8; 3],
        grid: [0xE8; 3],
        text: [0x1C; 3],
        weak: [0x56; 3],
        warning: [0x8A, 0x5A, 0x00],
        surround: Surround::Middle,
        reference: [0x14; 3],
        observer: [0x70; 3],
        sources: [
            [0x9B, 0x54, 0x02],
            [0x29, 0x3C, 0x87],
            [0x5A, 0xA2, 0x69],
            [0xCF, 0x6E, 0xCA],
            [0x9C, 0x8A, 0x08],
            [0x5F, 0x50, 0xD3],
            [0x7E, 0x1F, 0x2D],
            [0x1F, 0x7B, 0x91],
        ],
    };

    /// Black on white, for print.
    pub const PRINT: Self = Self {
        panel: [0xFF; 3],
        line: [0x80; 3],
        grid: [0xE2; 3],
        text: [0; 3],
        weak: [0x30; 3],
        reference: [0; 3],
        observer: [0x60; 3],
        ..Self::LIGHT
    };

    /// The same with other colors of compared sources.
    #[must_use]
    pub fn with_inks(self, inks: SourceInks) -> Self {
        // Equal steps of L*, 18 to 77.5 on white and 42 to 96 on dark, neighbors in the list far apart.
        const LIGHT: [u8; 8] = [0x67, 0xA8, 0x2C, 0x92, 0x3F, 0xBF, 0x52, 0x7C];
        const DARK: [u8; 8] = [0x9E, 0xDE, 0x76, 0xF4, 0x8A, 0xC8, 0x63, 0xB3];
        match inks {
            SourceInks::Screen => self,
            SourceInks::Gray => {
                let grays = if self.dark { DARK } else { LIGHT };
                Self { sources: grays.map(|gray| [gray; 3]), ..self }
            }
        }
    }
}

impl Palette for Colors {
    fn rgb(&self, role: InkRole) -> [u8; 3] {
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
            InkRole::Rgb(rgb) => rgb,
        }
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
