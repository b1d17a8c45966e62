//! Room for a figure on paper.

use chromascope_text::choices;

choices! {
    /// Ranges of the axes of a saved figure.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub enum AxisRanges {
        /// Those on screen, zoomed or not.
        #[default]
        Screen = "screen", "As on screen", "Zoomed or not";
        /// The whole diagram.
        Full = "full", "Full", "All of the plot; of the diagram, the data enlarged where there is room";
    }
}

choices! {
    /// Extent of the numbers written with a figure.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub enum Numbers {
        /// Everything that the figure is made from.
        #[default]
        All = "all", "All", "Everything that the figure is made from";
        /// Only what its axes and panels show.
        Visible = "visible", "Visible", "Only points within the axes, and curves that are drawn";
    }
}

/// Size that a saved figure is laid out for, in points, and what it leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches of a page")]
pub struct FigureRoom {
    /// Width; `None` takes the figure's own.
    pub width: Option<f64>,
    /// Height of the panels; `None` keeps the figure's own proportions.
    pub height: Option<f64>,
    /// True if the chromaticity diagram has its strip below.
    pub strip: bool,
    /// True if the chromaticity diagram has its patches.
    pub patches: bool,
    /// True if the chromaticity diagram has its Planckian loci.
    pub loci: bool,
    /// True if sensors are named at their loci: no legend names them.
    pub names: bool,
    /// Ranges of the axes.
    pub ranges: AxisRanges,
    /// Ends of x and of y of the first plot; equal ones for its own.
    pub limits: [[f64; 2]; 2],
    /// Extent of the numbers.
    pub numbers: Numbers,
}

impl Default for FigureRoom {
    fn default() -> Self {
        Self {
            width: None,
            height: None,
            strip: true,
            patches: true,
            loci: true,
            names: true,
            ranges: AxisRanges::Screen,
            limits: [[0.0; 2]; 2],
            numbers: Numbers::All,
        }
    }
}

impl FigureRoom {
    /// The least side of a figure.
    const LEAST: f64 = 80.0;

    /// The height below which a figure that is free to be higher keeps its own.
    const LEAST_HEIGHT: f64 = 240.0;

    /// Size of a figure that has this size by itself, with a part of fixed height below.
    pub fn size(&self, own: [f64; 2], below: f64) -> [f64; 2] {
        let width = self.width.unwrap_or(own[0]).max(Self::LEAST);
        let proper = (own[1] / own[0] * width).max(own[1].min(Self::LEAST_HEIGHT));
        let height = self.height.map_or(proper, |height| height - below);
        [width, height.max(Self::LEAST)]
    }
}
