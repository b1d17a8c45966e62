//! Named starts: the comparison and its conditions on the first screen and after a reset.

use super::SetKind;
use super::render::{GARMENT, model::SpecularChoice};
use super::{CHART, CIE_1931, Document, Light, PAPER_REFERENCE, Subset, TransformChoice};
use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// CIE 1931 2° as the reference, D65, cameras fitted to it, ColorChecker 24
    #[default]
    Colorimetry,
    /// The paper's experiments 1 and 2: Stiles & Burch 1955, equal energy, Eq 13, five patches
    Paper,
}

impl Start {
    pub const ALL: [Self; 2] = [Self::Colorimetry, Self::Paper];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Colorimetry => "Colorimetry",
            Self::Paper => "The 2007 paper",
        }
    }

    /// The name on the command line and in tables.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Colorimetry => "colorimetry",
            Self::Paper => "paper",
        }
    }

    pub const fn summary(self) -> &'static str {
        match self {
            Self::Colorimetry => "CIE 1931 2° under D65; cameras through 3×3 matrices fitted to it; ColorChecker 24.",
            Self::Paper => "Stiles & Burch 1955 under equal energy; Eq 13; the paper's cameras and five patches.",
        }
    }

    pub const fn sensors(self) -> &'static [(&'static str, SetKind)] {
        match self {
            Self::Colorimetry => &[
                (CIE_1931, SetKind::Observer),
                ("Canon EOS 5D Mark II", SetKind::Camera),
                ("Nikon D70 (A.M.P.A.S.)", SetKind::Camera),
                ("Kodak DCS200", SetKind::Camera),
            ],
            Self::Paper => &[
                (PAPER_REFERENCE, SetKind::Observer),
                ("Canon EOS 10D (2007 figure)", SetKind::Camera),
                ("Nikon D70 (2007 figure)", SetKind::Camera),
                ("Kodak DCS200", SetKind::Camera),
                (CIE_1931, SetKind::Observer),
            ],
        }
    }

    pub const fn specular(self) -> SpecularChoice {
        match self {
            Self::Colorimetry => SpecularChoice::Fresnel,
            Self::Paper => SpecularChoice::Paper,
        }
    }

    pub fn document(self) -> Document {
        let mut document = Document::blank(self);
        if self == Self::Colorimetry {
            CIE_1931.clone_into(&mut document.reference);
            document.light = Light::Set("D65".to_owned());
            CHART.clone_into(&mut document.chart);
            document.subset = Subset::All;
            document.render.garment = Some(GARMENT.to_owned());
            document.set_transform(TransformChoice::Observer(CIE_1931.to_owned()));
        }
        if self == Self::Paper {
            // The paper's light is a point.
            document.render.sky = 0.0;
        }
        document.render.specular = self.specular();
        for (name, kind) in self.sensors() {
            document.compare(name, *kind);
        }
        document
    }
}
