//! Figures laid out for paper: size, text, lines, inks, legend.

use chromascope_figure::{
    AxisRanges, AxisTitles, Figure, FigureRoom, LegendPlace, Numbers, Page, PageStyle, Shape, TextSize,
};
use chromascope_text::{Flag, Setting, Settings, Words, choices, settings};
use serde::{Deserialize, Serialize};

use crate::palette::{Colors, FONT, FONT_FAMILY, SANS_FAMILY, SANS_FONT, SERIF_FAMILY, SERIF_FONT, SourceInks};

choices! {
    /// Colors of a figure apart from those of its sources.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum PaperStyle {
        #[default]
        Light = "light", "Light", "As on a light screen";
        Print = "print", "Print", "Black on white";
        Dark = "dark", "Dark", "Light on dark, for slides";
    }
}

choices! {
    /// Typeface of a figure.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Typeface {
        #[default]
        Screen = "screen", "Screen", "DejaVu Sans, as on screen";
        Sans = "sans", "Sans", "Arimo, with the widths of Arial and Helvetica";
        Serif = "serif", "Serif", "Tinos, with the widths of Times";
    }
}

impl Typeface {
    /// Families of text, the first one bundled.
    pub const fn families(self) -> &'static str {
        match self {
            Self::Screen => FONT_FAMILY,
            Self::Sans => SANS_FAMILY,
            Self::Serif => SERIF_FAMILY,
        }
    }

    pub const fn font(self) -> &'static [u8] {
        match self {
            Self::Screen => FONT,
            Self::Sans => SANS_FONT,
            Self::Serif => SERIF_FONT,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches of one form")]
pub struct Paper {
    /// Width in millimeters; `None` takes the figure's own points, and then text has its size on screen.
    pub width_mm: Option<f64>,
    /// Height in millimeters; `None` takes the figure's own proportions.
    pub height_mm: Option<f64>,
    /// Size of all text in points; only the name on a report card is larger.
    pub font_pt: f64,
    pub typeface: Typeface,
    pub line_scale: f64,
    pub style: PaperStyle,
    pub inks: SourceInks,
    /// Position of the legend; `None` places it beside a wide figure and below a narrow one. Beside, it stands below
    /// where it would take half of the width.
    pub legend: Option<LegendPlace>,
    pub axis_titles: AxisTitles,
    /// True if the conditions stand below the figure.
    pub caption: bool,
    /// True if the chromaticity diagram has its strip below, its patches, its loci.
    pub strip: bool,
    pub patches: bool,
    pub loci: bool,
    pub ranges: AxisRanges,
    /// Ends of the axes; equal ones for those of the figure.
    pub x_range: [f64; 2],
    pub y_range: [f64; 2],
    pub numbers: Numbers,
    pub dpi: f64,
}

impl Default for Paper {
    fn default() -> Self {
        Self {
            width_mm: None,
            height_mm: None,
            font_pt: 8.0,
            typeface: Typeface::default(),
            line_scale: 1.0,
            style: PaperStyle::default(),
            inks: SourceInks::default(),
            legend: None,
            axis_titles: AxisTitles::default(),
            caption: true,
            strip: true,
            patches: true,
            loci: true,
            ranges: AxisRanges::default(),
            x_range: [0.0; 2],
            y_range: [0.0; 2],
            numbers: Numbers::default(),
            dpi: 300.0,
        }
    }
}

pub const SIZE: &str = "Size";
pub const LOOK: &str = "Look";

const IN_SIZE: Setting<Paper> = Setting { group: SIZE, ..Setting::DEFAULT };
const IN_LOOK: Setting<Paper> = Setting { group: LOOK, ..Setting::DEFAULT };
const PAPER: Flag = Flag { heading: "Paper", ..Flag::NONE };
const LENGTH: Flag = Flag {
    value: "LENGTH",
    range: Paper::SIDE_MM,
    unit: "mm",
    lengths: &[("mm", 1.0), ("cm", 10.0), ("in", 25.4), ("pt", 25.4 / 72.0)],
    ..PAPER
};
const AUTOMATIC: Words =
    Words::new("", "Automatic", "Below on a page narrower than 120 mm, else where the figure has it");

impl Settings for Paper {
    const ALL: &'static [Setting<Self>] = settings! {
        "width_mm" "Width" in IN_SIZE, by "", "Width of the page",
            number(|p| p.width_mm.unwrap_or(Self::ONE_COLUMN_MM), |p, to| p.width_mm = Some(to), " mm", Self::SIDE_MM;),
            flag(LENGTH, "width", "LENGTH", ", in mm, cm, in or pt [default: 85mm, one column]"; usual: "85mm");
        "height_mm" "Height" in IN_SIZE, by "", "Height of the page",
            number(|p| p.height_mm.unwrap_or(Self::ONE_COLUMN_MM), |p, to| p.height_mm = Some(to), " mm", Self::SIDE_MM;),
            flag(LENGTH, "height", "LENGTH", " [default: the figure's own proportions]";);
        "font_pt" "Text" in IN_SIZE, by "", "Size of all text in points",
            field(font_pt, " pt", Self::FONT_PT; step: Some(0.05)),
            flag(PAPER, "font-size", "POINTS", ""; usual: "8", range: Self::FONT_PT, unit: "points");
        "line_scale" "Lines" in IN_SIZE, by "", "Factor on the widths of lines and on markers",
            field(line_scale, "×", Self::LINE_SCALE; step: Some(0.01)),
            flag(PAPER, "line-width", "FACTOR", ""; usual: "1", range: Self::LINE_SCALE);
        "dpi" "PNG" in IN_SIZE, by "", "Resolution of PNG, TIFF and the copied picture, in pixels per inch",
            field(dpi, " dpi", Self::DPI; step: Some(1.0)),
            flag(PAPER, "dpi", "DPI", ""; usual: "300", range: Self::DPI, unit: "pixels per inch");
        "style" "Style" in IN_LOOK, by "", "Colors of ground, text and frames",
            pick(style: PaperStyle, Row), flag(PAPER, "style", "STYLE", ""; usual: "light");
        "typeface" "Typeface" in IN_LOOK, by "font", "Typeface of text",
            pick(typeface: Typeface, Row), flag(PAPER, "typeface", "TYPEFACE", ""; usual: "screen");
        "inks" "Colors" in IN_LOOK, by "", "Colors of sources",
            pick(inks: SourceInks, Row), flag(PAPER, "inks", "INKS", ""; usual: "safe");
        "legend" "Legend" in IN_LOOK, by "", "Place of the legend", pick(legend: LegendPlace, List, or AUTOMATIC),
            flag(PAPER, "legend", "LEGEND", " [default: below where the page is narrower than 120 mm, else beside]";);
        "axis_titles" "Axis titles" in IN_LOOK, by "", "Place of the titles of the axes",
            pick(axis_titles: AxisTitles, Row), flag(PAPER, "axis-titles", "AXIS_TITLES", ""; usual: "inside");
        "ranges" "Axis ranges" in IN_LOOK, by "", "Ranges of the axes of plots that can be zoomed",
            pick(ranges: AxisRanges, Row), elsewhere("range");
        "x_range" "x" in IN_LOOK, by "axis limits", "Ends of the horizontal axis, temperatures in K or 1000 K; equal ones for the figure's own",
            pair("from", "Left end", "to", "Right end"; x_range, "", Self::AXIS),
            flag(PAPER, "x-range", "FROM,TO", " [default: the figure's own]"; range: Self::AXIS);
        "y_range" "y" in IN_LOOK, by "axis limits", "Ends of the vertical axis of the first plot; equal ones for the figure's own",
            pair("from", "Lower end", "to", "Upper end"; y_range, "", Self::AXIS),
            flag(PAPER, "y-range", "FROM,TO", " [default: the figure's own]"; range: Self::AXIS);
        "numbers" "Numbers" in IN_LOOK, by "", "Numbers of a CSV",
            pick(numbers: Numbers, Row), flag(PAPER, "numbers", "NUMBERS", ""; usual: "all");
        "strip" "Strip of distances below the diagram" in IN_LOOK, by "", "Strip of distances below the chromaticity diagram",
            switch(|p| p.strip, |p, on| p.strip = on), flag(PAPER, "no-strip", "", ", omitted";);
        "patches" "Patches in the diagram" in IN_LOOK, by "", "Patches in the chromaticity diagram",
            switch(|p| p.patches, |p, on| p.patches = on), flag(PAPER, "no-patches", "", ", omitted";);
        "loci" "Loci in the diagram" in IN_LOOK, by "", "Planckian loci in the chromaticity diagram",
            switch(|p| p.loci, |p, on| p.loci = on), flag(PAPER, "no-loci", "", ", omitted";);
        "caption" "Caption with the conditions" in IN_LOOK, by "", "Caption with the conditions",
            switch(|p| p.caption, |p, on| p.caption = on), flag(PAPER, "no-caption", "", ", omitted";);
    };
}

impl Paper {
    /// Width of one column of a journal in millimeters.
    pub const ONE_COLUMN_MM: f64 = 85.0;
    /// Width of two columns of a journal in millimeters.
    pub const TWO_COLUMNS_MM: f64 = 174.0;
    /// Range of width and height in millimeters.
    pub const SIDE_MM: [f64; 2] = [20.0, 2000.0];
    /// Range of the ends of an axis.
    pub const AXIS: [f64; 2] = [-1e6, 1e6];
    pub const FONT_PT: [f64; 2] = [3.0, 48.0];
    pub const LINE_SCALE: [f64; 2] = [0.1, 10.0];
    pub const DPI: [f64; 2] = [36.0, 2400.0];
    /// Below this width in millimeters the legend stands below.
    const NARROW_MM: f64 = 120.0;

    pub fn page_style(&self) -> PageStyle {
        PageStyle { width_mm: self.width_mm, line_scale: self.line_scale, axis_titles: self.axis_titles }
    }

    pub fn pixels_per_point(&self) -> f32 {
        (self.dpi / 72.0) as f32
    }

    pub fn colors(&self) -> Colors {
        let colors = match self.style {
            PaperStyle::Light => Colors::LIGHT,
            PaperStyle::Print => Colors::PRINT,
            PaperStyle::Dark => Colors::DARK,
        };
        colors.with_inks(self.inks)
    }

    /// Points on paper for each point of a figure laid out.
    pub fn scale(&self) -> f64 {
        self.font_pt.max(0.1) / f64::from(TextSize::Small.points())
    }

    /// A figure laid out for this paper, so that its text has the size wanted there. `make` makes it for a room.
    pub fn laid_out(&self, mut make: impl FnMut(FigureRoom) -> Option<Figure>) -> Option<Figure> {
        // Text is laid out in its size on screen, and the page scaled.
        let points = |mm: f64| mm / 25.4 * 72.0 / self.scale();
        let mut make = |room| make(room).map(|figure| self.dressed(figure));
        let mut room = FigureRoom {
            strip: self.strip,
            patches: self.patches,
            loci: self.loci,
            names: self.legend == Some(LegendPlace::None),
            ranges: self.ranges,
            limits: [self.x_range, self.y_range],
            numbers: self.numbers,
            ..FigureRoom::default()
        };
        let Some(width) = self.width_mm.map(points) else { return make(room) };
        room.width = Some(width);
        let mut figure = make(room)?;
        let beside = figure.legend_place == LegendPlace::Outside;
        let is_cramped = beside && Page::new(&figure, &self.page_style()).surplus(&figure)[0] > 0.5 * width;
        let mut make = |room| {
            make(room).map(|figure| match figure.legend_place {
                LegendPlace::Outside if is_cramped => Figure { legend_place: LegendPlace::Below, ..figure },
                _ => figure,
            })
        };
        if is_cramped {
            figure = make(room)?;
        }
        // What stands around the panels depends on their width, and that on it.
        for _ in 0..2 {
            let surplus = Page::new(&figure, &self.page_style()).surplus(&figure);
            room.width = Some(width - surplus[0]);
            room.height = self.height_mm.map(|mm| points(mm) - surplus[1]);
            figure = make(room)?;
        }
        Some(figure)
    }

    fn dressed(&self, mut figure: Figure) -> Figure {
        let narrow = self.width_mm.is_some_and(|mm| mm < Self::NARROW_MM);
        match self.legend {
            Some(place) => figure.legend_place = place,
            None if narrow => figure.legend_place = LegendPlace::Below,
            None => {}
        }
        if !self.caption {
            figure.caption.clear();
        }
        // One size of text for all of a page.
        for mark in figure.panels.iter_mut().flat_map(|panel| &mut panel.marks) {
            if let Shape::Text { size: size @ TextSize::Body, .. } = &mut mark.shape {
                *size = TextSize::Small;
            }
        }
        figure
    }
}
