//! Queries for pictures side by side and their answers: of a mesh or of a spectral image.

use std::sync::Arc;

use chromascope_core::camera::RenderingError;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::render::difference::Difference;
use chromascope_core::query::render::picture::{Pictures, PicturesQuery};
use chromascope_core::query::{Query, RenderingQuery};
use chromascope_core::render::{LitSamples, Picture};

use crate::document::Exaggeration;
use crate::scene::spectral_image::{ImagePictures, ImagePicturesError, ImagePicturesQuery};

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum PicturesOf {
    Mesh(PicturesQuery),
    Image(ImagePicturesQuery),
}

impl PicturesOf {
    pub fn mesh(&self) -> Option<&PicturesQuery> {
        if let Self::Mesh(query) = self { Some(query) } else { None }
    }

    pub fn image(&self) -> Option<&ImagePicturesQuery> {
        if let Self::Image(query) = self { Some(query) } else { None }
    }

    pub fn metric(&self) -> Metric {
        let (Self::Mesh(PicturesQuery { metric, .. }) | Self::Image(ImagePicturesQuery { metric, .. })) = self;
        *metric
    }

    /// Factor on the differences that the pictures show.
    pub fn exaggeration(&self) -> Exaggeration {
        let (Self::Mesh(PicturesQuery { exaggeration, .. }) | Self::Image(ImagePicturesQuery { exaggeration, .. })) =
            self;
        let is_it = |to: &Exaggeration| to.factor().to_bits() == *exaggeration;
        Exaggeration::ALL.into_iter().find(is_it).unwrap_or_default()
    }

    pub fn reference(&self) -> &RenderingQuery {
        let (Self::Mesh(PicturesQuery { reference, .. }) | Self::Image(ImagePicturesQuery { reference, .. })) = self;
        reference
    }

    /// Color transform of one of the sensors.
    pub fn rendering(&self, index: usize) -> Option<&RenderingQuery> {
        match self {
            Self::Mesh(query) => query.sources.get(index),
            Self::Image(query) => query.sources.get(index).map(|(rendering, _)| rendering),
        }
    }

    pub fn reference_index(&self) -> Option<usize> {
        (0..).map_while(|index| self.rendering(index)).position(|rendering| rendering == self.reference())
    }

    pub fn ev(&self) -> f64 {
        let (Self::Mesh(PicturesQuery { ev, .. }) | Self::Image(ImagePicturesQuery { ev, .. })) = self;
        f64::from_bits(*ev)
    }

    /// True if another query is of the same mesh, material, sensors and light, however they are viewed and made; images count as
    /// such by their kind alone.
    pub fn has_subject_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Mesh(own), Self::Mesh(other)) => {
                own.shading.geometry.visibility.mesh == other.shading.geometry.visibility.mesh
                    && own.reflectance == other.reflectance
                    && own.sources == other.sources
                    && own.reference == other.reference
            }
            (Self::Image(_), Self::Image(_)) => true,
            _ => false,
        }
    }

    /// True if another query is of the same shaded mesh, or of the same signals of an image.
    pub fn has_signals_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Mesh(own), Self::Mesh(other)) => own.shading == other.shading,
            (Self::Image(own), Self::Image(other)) => own.signals == other.signals,
            _ => false,
        }
    }
}

#[derive(Clone, Debug, thiserror::Error)]
pub enum NoPictures {
    #[error("rendering was stopped")]
    Stopped,
    #[error(transparent)]
    Rendering(#[from] RenderingError),
    #[error(transparent)]
    Image(Arc<ImagePicturesError>),
}

#[derive(Clone, Debug)]
pub enum PicturesAnswer {
    Mesh(Arc<<PicturesQuery as Query>::Answer>),
    /// Of a spectral image.
    Image(Arc<<ImagePicturesQuery as Query>::Answer>),
}

impl PicturesAnswer {
    pub fn pictures(&self) -> Result<MadePictures<'_>, NoPictures> {
        match self {
            Self::Mesh(answer) => match &**answer {
                Ok(Some(made)) => {
                    Ok(MadePictures { pictures: &made.pictures, differences: &made.differences, of: Made::Mesh(made) })
                }
                Ok(None) => Err(NoPictures::Stopped),
                Err(error) => Err(NoPictures::Rendering(*error)),
            },
            Self::Image(answer) => match &**answer {
                Ok(made) => {
                    Ok(MadePictures { pictures: &made.pictures, differences: &made.differences, of: Made::Image(made) })
                }
                Err(error) => Err(NoPictures::Image(Arc::clone(error))),
            },
        }
    }
}

/// Pictures side by side with the signals that pixels are read from.
#[derive(Clone, Copy, Debug)]
pub struct MadePictures<'a> {
    /// Of each sensor its picture, or why there is none.
    pub pictures: &'a [Result<Arc<Picture>, RenderingError>],
    /// Of each sensor its difference from the reference.
    pub differences: &'a [Option<Arc<Difference>>],
    of: Made<'a>,
}

#[derive(Clone, Copy, Debug)]
enum Made<'a> {
    Mesh(&'a Pictures),
    Image(&'a ImagePictures),
}

impl<'a> MadePictures<'a> {
    pub fn mesh(self) -> Option<&'a Pictures> {
        if let Made::Mesh(made) = self.of { Some(made) } else { None }
    }

    pub fn image(self) -> Option<&'a ImagePictures> {
        if let Made::Image(made) = self.of { Some(made) } else { None }
    }

    /// Positions of a sensor's signals, and these; none for a sensor without a picture.
    pub fn signals(self, index: usize) -> Option<(&'a LitSamples, &'a [[f32; 3]])> {
        match self.of {
            Made::Mesh(made) => {
                let image = made.images.get(index)?.as_ref()?;
                Some((image.placed(), image.signals()))
            }
            Made::Image(made) => Some((made.placed(), made.signals(index)?)),
        }
    }

    /// Y of the white of color measurements.
    pub fn white(self) -> f64 {
        match self.of {
            Made::Mesh(made) => made.facing.white,
            Made::Image(made) => made.white,
        }
    }

    pub fn factor(self, ev: f64) -> f64 {
        match self.of {
            Made::Mesh(made) => made.facing.factor(ev),
            Made::Image(made) => made.factor(ev),
        }
    }
}
