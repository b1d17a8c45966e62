//! Colors of figures as bytes, and the bundled fonts: the same on screen and in files.

#![allow(clippy::unreadable_literal, reason = "colors have six hexadecimal digits, as everywhere")]

use chromascope_figure::{InkRole, Palette};
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

/// Width of the tail from a point to the reference.
pub const LINE_TAIL: f64 = 1.2;
/// Opacity of the colors in a chromaticity diagram.
pub const DIAGRAM_FILL: f32 = 0.1;

/// Family of text in figures.
pub const FONT_FAMILY: &str = "DejaVu Sans";
/// Families with the widths of Arial and of Times, of which journals take figures, with those that stand in for them.
pub const SANS_FAMILY: &str = "Arimo, Arial, Helvetica, DejaVu Sans, sans-serif";
pub const SERIF_FAMILY: &str = "Tinos, Times New Roman, Times, DejaVu Sans, serif";
pub const SANS_FONT: &[u8] = include_bytes!("../../../assets/fonts/Arimo.ttf");
pub const SERIF_FONT: &[u8] = include_bytes!("../../../assets/fonts/Tinos.ttf");
/// Family of numbers in figures.
pub const MONO_FAMILY: &str = "DejaVu Sans Mono";
pub const FONT: &[u8] = include_bytes!("../../../assets/fonts/DejaVuSans.ttf");
pub const MONO_FONT: &[u8] = include_bytes!("../../../assets/fonts/DejaVuSansMono.ttf");

choices! {
    /// The gray around swatches and renders: 777777 (L* 50), 3A3A3A, BABABA.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
    pub enum Surround {
        #[default]
        Middle = "middle", "Middle gray, L* 50", "";
        Dark = "dark", "Dark gray", "";
        Light = "light", "Light gray", "";
    }
}

impl Surround {
    pub const fn color(self) -> [u8; 3] {
        match self {
            Self::Middle => [0x77; 3],
            Self::Dark => [0x3A; 3],
            Self::Light => [0xBA; 3],
        }
    }

    /// Color of labels on it.
    pub const fn ink(self) -> [u8; 3] {
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

/// Bytes of colors that are written as on the web.
const fn rgb<const N: usize>(colors: [u32; N]) -> [[u8; 3]; N] {
    let mut bytes = [[0; 3]; N];
    let mut place = 0;
    while place < N {
        let [_, red, green, blue] = colors[place].to_be_bytes();
        bytes[place] = [red, green, blue];
        place += 1;
    }
    bytes
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
        sources: rgb([0xD48924, 0x7FA9FF, 0xB8ECA6, 0xA068A8, 0xE7CC45, 0x6670F4, 0xD74954, 0x6BE6FE]),
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
        sources: rgb([0x9B5402, 0x293C87, 0x5AA269, 0xCF6ECA, 0x9C8A08, 0x5F50D3, 0x7E1F2D, 0x1F7B91]),
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
            InkRole::OnSurround => self.surround.ink(),
            InkRole::Warning => self.warning,
            InkRole::Rgb(rgb) => rgb,
        }
    }
}

/// Steps of the color scale of differences: uniform in L*, from blue through gray to yellow, distinguishable in all kinds
/// of color vision.
const DIFFERENCE_RAMP: [[u8; 3]; 9] =
    rgb([0x003378, 0x2E4880, 0x515D88, 0x6F748F, 0x908D82, 0xB1A47B, 0xD0BD73, 0xEFD768, 0xFFF159]);

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
