//! Roles instead of colors.

/// Role of a mark. A palette turns it into a color.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum InkRole {
    /// The source the others are compared to.
    Reference,
    /// An observer other than the reference.
    Observer,
    /// A compared source by its slot, 0 to 7 (taken modulo 8).
    Sensor(u8),
    /// Text, and marks that are about the reader (rings, cursors).
    Text,
    /// Text of less weight.
    Weak,
    /// Grid lines.
    Grid,
    /// Frames and separators.
    Line,
    /// The ground of a plot.
    Plot,
    /// The ground of a pane.
    Panel,
    /// The neutral surround of swatches and renders.
    Surround,
    /// Labels on the surround.
    OnSurround,
    /// Something to look after.
    Warning,
    /// The color of the data itself in sRGB, such as a patch's. The same in every palette.
    Rgb([u8; 3]),
}

/// A role with an opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    /// Role.
    pub role: InkRole,
    /// Opacity, 0 (nothing) to 1 (opaque).
    pub alpha: f32,
}

impl Ink {
    /// The opaque ink of a role.
    pub const fn new(role: InkRole) -> Self {
        Self { role, alpha: 1.0 }
    }

    /// Opaque ink in the data's own sRGB color.
    pub const fn rgb(rgb: [u8; 3]) -> Self {
        Self::new(InkRole::Rgb(rgb))
    }

    /// Ink with its opacity multiplied.
    #[must_use]
    pub fn faded(self, factor: f32) -> Self {
        Self { alpha: (self.alpha * factor).clamp(0.0, 1.0), ..self }
    }
}

impl From<InkRole> for Ink {
    fn from(role: InkRole) -> Self {
        Self::new(role)
    }
}

/// Colors for roles.
pub trait Palette {
    /// The sRGB color (8 bits per channel) of a role. [`InkRole::Rgb`] returns its own.
    fn rgb(&self, role: InkRole) -> [u8; 3];
}
