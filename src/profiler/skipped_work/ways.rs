//! How the integrals of a source are made in the picture as it is.

use std::hint::black_box;
use std::sync::Arc;

use chromascope_core::camera::RenderingError;
use chromascope_core::query::Ask;
use chromascope_core::query::render::{DiffuseTableQuery, PicturesQuery, PlanQuery, SourceOf};
use chromascope_core::reflectance::Precision;
use chromascope_core::render::diffuse::{by_moments, by_nodes, by_regimes, rough_basis};
use chromascope_core::render::measure::Node;
use chromascope_core::render::plan::Method;
use chromascope_core::render::shading::{Shade, Way};
use chromascope_core::render::{Against, DiffuseTable, Plan, Quality, ShadingImage, SpectralWeights};
use chromascope_measure::harness::shortest;

/// How a source's integrals are made.
pub(super) struct Ways {
    /// One that there is.
    measure: Arc<Result<SpectralWeights, RenderingError>>,
    table: Option<Arc<Result<DiffuseTable, RenderingError>>>,
    plan: Option<Arc<Result<Plan, RenderingError>>>,
    quality: Quality,
}

impl Ways {
    /// With table and plan as the picture takes them; none for a source that gives no signals under this light.
    pub(super) fn new(
        pictures: &PicturesQuery,
        source: &SourceOf,
        shading: &ShadingImage,
        ask: &impl Ask,
    ) -> Option<Self> {
        let of = pictures.image(&source.rendering).measure;
        let measure = of.in_picture(shading, ask);
        (*measure).as_ref().ok()?;
        let table = shading.needs_table().then(|| ask.ask(&DiffuseTableQuery(of.clone())));
        let wanted = shading.demand().zip(shading.plan_accuracy());
        let plan = wanted
            .map(|(demand, accuracy)| ask.ask(&PlanQuery { measure: of, accuracy, against: Against::Peak, demand }));
        Some(Self { measure, table, plan, quality: shading.quality() })
    }

    /// Its weights.
    pub(super) fn measure(&self) -> &SpectralWeights {
        (*self.measure).as_ref().expect("made of nothing else")
    }

    /// Its table, where the picture takes one.
    pub(super) fn table(&self) -> Option<&DiffuseTable> {
        self.table.as_deref().and_then(|table| table.as_ref().ok())
    }

    /// Its plan, where a tolerance is kept.
    pub(super) fn plan(&self) -> Option<&Plan> {
        self.plan.as_deref().and_then(|plan| plan.as_ref().ok())
    }

    /// Whether a plan makes this κ by moments.
    fn is_rough(plan: &Plan, kappa: f64) -> bool {
        match plan.explanation().rough.as_ref().map(|rough| rough.method) {
            Some(Method::Moments { from_kappa, .. }) => kappa >= from_kappa,
            _ => false,
        }
    }

    /// At how many wavelengths S is made for a sample; those that filled a table beforehand are not of the sample.
    pub(super) fn looked_at(&self, shade: &Shade) -> usize {
        match (shade.way, self.plan()) {
            (Way::Dark | Way::Flat | Way::Moments | Way::Table, _) => 0,
            (Way::Sum, _) => self.nodes().len(),
            (Way::Planned, Some(plan)) if Self::is_rough(plan, shade.kappa) => 0,
            (Way::Planned, Some(plan)) => match plan.explanation().chosen.method {
                Method::Table { .. } => 0,
                Method::Shared { nodes, .. } | Method::Own { nodes, .. } => nodes,
                Method::Nothing | Method::Moments { .. } | Method::Every { .. } => self.measure().dense().len(),
            },
            (Way::Planned, None) => self.measure().dense().len(),
        }
    }

    /// Whether sums of S are made for a sample.
    pub(super) fn sums(&self, shade: &Shade) -> bool {
        self.looked_at(shade) > 0
    }

    /// The wavelengths that integrals rest on, in the sample or in what was made beforehand; in a plan with a rule for each
    /// channel, as many for all.
    pub(super) fn nodes(&self) -> Vec<Node> {
        let measure = self.measure();
        match (self.quality, self.plan().map(|plan| plan.explanation().chosen.method)) {
            (Quality::Exact | Quality::Regimes, _) | (Quality::Within(_), None | Some(Method::Every { .. })) => {
                measure.dense().to_vec()
            }
            (Quality::Fine, _) => measure.fine().to_vec(),
            (_, Some(Method::Table { nodes, .. } | Method::Shared { nodes, .. } | Method::Own { nodes, .. })) => {
                measure.shared(nodes)
            }
            (Quality::Preview | Quality::Full | Quality::Within(_), _) => measure.coarse().to_vec(),
        }
    }

    /// Seconds that the integrals of these take as the picture makes them, on this thread.
    pub(super) fn seconds(&self, shades: &[&Shade]) -> f64 {
        let places: Vec<[f64; 2]> = shades.iter().map(|shade| [shade.kappa, shade.beta]).collect();
        let mut sums = vec![[0.0; 3]; places.len()];
        shortest(|| {
            if let Some(plan) = self.plan() {
                plan.fill(&places, &mut sums);
            } else {
                sums.iter_mut().zip(shades).for_each(|(sum, shade)| *sum = self.integral(shade));
            }
            black_box(&sums);
        })
    }

    fn integral(&self, shade: &Shade) -> [f64; 3] {
        let (measure, kappa, beta) = (self.measure(), shade.kappa, shade.beta);
        match (shade.way, self.table()) {
            (Way::Dark, _) => [0.0; 3],
            (Way::Flat, _) => measure.totals(),
            (Way::Moments, _) => by_moments(measure.moments(), &rough_basis(kappa, beta)),
            (Way::Table, Some(table)) => table.at(kappa, beta),
            (Way::Table | Way::Sum | Way::Planned, _) => match self.quality {
                Quality::Preview | Quality::Full => by_nodes(measure.coarse(), kappa, beta, Precision::Fine),
                Quality::Fine => by_nodes(measure.fine(), kappa, beta, Precision::Full),
                Quality::Exact | Quality::Within(_) => by_nodes(measure.dense(), kappa, beta, Precision::Full),
                Quality::Regimes => by_regimes(measure.dense(), kappa, beta),
            },
        }
    }
}
