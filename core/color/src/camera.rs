//! From spectra to a camera's signals, and from signals to the diagram.

pub mod batch;
pub mod channel_ratio;
pub mod chart_grid;
pub mod chart_search;
pub mod curve_spread;
pub mod locus;
pub mod locus_deviation;
pub mod locus_table;
pub mod quality;
pub mod recorded;
pub mod rendering;
pub mod white_balance;

pub use batch::{Batch, BatchError};
pub use channel_ratio::{ChannelRatio, RatioTable};
pub use curve_spread::{CurveSpread, CurveSpreadError};
pub use locus::{LocusEvaluator, LocusMethod};
pub use locus_deviation::{LocusDeviation, ReferenceLocus};
pub use locus_table::{LocusTable, LocusTableError};
pub use rendering::{ColorTransform, FitSamples, FitTargets, Rendering, RenderingError};
pub use white_balance::WhiteBalanceTarget;
