//! Queries: each a value that holds everything its answer depends on.
//!
//! Equality of queries is the only rule of invalidation: no flags, no revisions. A caching evaluator (`Results` in the
//! app) and one without a cache ([`Direct`], for the command line and tests) have the same interface.

pub mod ask;
pub mod compare;
pub mod correction;
pub mod displacement;
pub mod lights;
pub mod loci;
pub mod metamers;
pub mod metrics;
pub mod patches;
pub mod recovery;
pub mod render;

pub use ask::{Ask, Direct, Query, Shared};
pub use compare::DifferenceError;
pub use correction::{
    CorrectionReport, CorrectionReportQuery, ErrorSummary, StimulusCheck, TwoLightPoint, TwoLightQuery,
};
pub use displacement::{Displacements, LocusDeviationsQuery};
pub use lights::{Consistency, ConsistencyError, ConsistencyQuery, Rendition, RenditionQuery};
pub use loci::{
    CctQuery, Locus, LocusPoint, LocusQuery, LocusRulesQuery, MonochromaticQuery, NearestBlackBodyQuery,
    RadiatorSignalsQuery, SpectralLocusQuery, Temperatures,
};
pub use metamers::{Metamers, MetamersQuery};
pub use metrics::{
    CameraMetric, CameraMetrics, CameraMetricsQuery, IndexConditions, MetricUncertaintiesQuery, MetricUncertainty,
    MetricValue, WhyNot,
};
pub use patches::{
    ColorTransformSpec, FitTargetsQuery, PatchColor, PatchColorsQuery, RadianceColorsQuery, RecordedFitQuery,
    RecordedSet, RenderingQuery,
};
pub use recovery::{ChartMeasurement, ChartRecoveryQuery, ChartShot};
