//! Named starts: the comparison and its conditions on the first screen and after a reset.

use super::render::GARMENT;
use super::{CHART, CIE_1931, Document, Light, PAPER_REFERENCE, SetKind, Subset, TransformChoice};
use chromascope_core::reflectance::Specular;
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Start {
        #[default]
        Colorimetry = "colorimetry", "Colorimetry",
            "CIE 1931 2° under D65; cameras through 3×3 matrices fitted to it; ColorChecker 24.";
        Paper = "paper", "The 2007 paper",
            "Stiles & Burch 1955 under equal energy; Eq 13; the paper's cameras and five patches.";
    }
}

impl Start {
    /// The sensors that are compared, the reference first.
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

    /// The specular component that it renders with.
    pub const fn specular(self) -> Specular {
        match self {
            Self::Colorimetry => Specular::Fresnel,
            Self::Paper => Specular::Paper,
        }
    }

    pub fn document(self) -> Document {
        let mut document = Document::blank(self);
        if self == Self::Colorimetry {
            CIE_1931.clone_into(&mut document.reference);
            document.light = Light::Set("D65".to_owned());
            CHART.clone_into(&mut document.chart);
            document.subset = Subset::All;
            document.overlays.multiples = true;
            document.render.garment = Some(GARMENT.to_owned());
            document.render = document.render.as_photographed();
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
