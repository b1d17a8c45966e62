//! The table of metrics, and their ranks, which respect the uncertainty.

use super::differences::{DifferenceConditions, Statistic};
use super::evidence::Evidence;
use super::value::{MetricSet, MetricUncertainty, MetricValue, WhyNot};
use chromascope_color::camera::RenderingError;
use chromascope_color::colorimetry::Metric;
use chromascope_color::units::eq_by;
use rayon::prelude::*;

/// Part of the table that a metric belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MetricGroup {
    /// Differences of the chart's patches from the reference.
    Differences,
    /// Error of the Planckian locus.
    Locus,
    /// Agreement of the sensitivities with the reference's.
    Sensitivities,
    /// Noise that balance and color transform amplify.
    Noise,
}

impl MetricGroup {
    /// All groups, in the order of the table.
    pub const ALL: [Self; 4] = [Self::Differences, Self::Locus, Self::Sensitivities, Self::Noise];

    /// Name in words.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Differences => "Differences of patches",
            Self::Locus => "Planckian locus",
            Self::Sensitivities => "Sensitivities",
            Self::Noise => "Noise",
        }
    }
}

/// Direction in which a metric's values improve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Better {
    /// Smaller magnitudes are better.
    Lower,
    /// Larger values are better.
    Higher,
    /// A property, no figure of merit: not ranked.
    Neither,
}

impl Better {
    /// Number that is smaller for a better value: the order of rankings. None for a metric that ranks nothing.
    pub fn merit(self, value: f64) -> Option<f64> {
        match self {
            Self::Lower => Some(value.abs()),
            Self::Higher => Some(-value),
            Self::Neither => None,
        }
    }
}

/// A figure of merit of a camera under conditions.
#[derive(Clone, Copy, Debug)]
pub struct CameraMetric {
    /// Name in documents and on the command line.
    pub id: &'static str,
    /// Head of its column in tables.
    pub column: &'static str,
    /// Name in words.
    pub label: &'static str,
    /// Symbol.
    pub symbol: &'static str,
    /// Unit; `1` for ratios and indices.
    pub unit: &'static str,
    /// Part of the table.
    pub group: MetricGroup,
    /// Meaningful decimals.
    pub decimals: usize,
    /// Direction in which values improve.
    pub better: Better,
    pub(super) place: usize,
    evaluate: fn(&Evidence<'_>) -> Result<f64, WhyNot>,
}

eq_by!(CameraMetric, |metric| metric.id);

/// The four statistics of one difference metric over the chart's patches.
macro_rules! statistics {
    ($at:literal, $id:literal, $column:literal, $symbol:literal, $decimals:literal) => {
        [
            statistics!(@ $at, Statistic::Mean, $id, "mean", "mean", $column, $symbol, $decimals),
            statistics!(@ $at, Statistic::Median, $id, "median", "median", $column, $symbol, $decimals),
            statistics!(@ $at, Statistic::Percentile95, $id, "p95", "95 %", $column, $symbol, $decimals),
            statistics!(@ $at, Statistic::Maximum, $id, "max", "max", $column, $symbol, $decimals),
        ]
    };
    (@ $at:literal, $of:expr, $id:literal, $suffix:literal, $word:literal, $column:literal, $symbol:literal, $decimals:literal) => {
        CameraMetric {
            id: concat!($id, "-", $suffix),
            column: concat!($column, "_", $suffix),
            label: concat!($symbol, " of the patches, ", $word),
            symbol: concat!($symbol, " ", $word),
            unit: "1",
            group: MetricGroup::Differences,
            decimals: $decimals,
            better: Better::Lower,
            place: 0,
            evaluate: |evidence| evidence.statistic($at, $of),
        }
    };
}

const DELTA_E_2000: [CameraMetric; 4] = statistics!(0, "delta-e2000", "delta_e_2000", "ΔE*00", 2);
const DELTA_E_1976: [CameraMetric; 4] = statistics!(1, "delta-e1976", "delta_e_1976", "ΔE*ab", 2);
const DELTA_E_1994: [CameraMetric; 4] = statistics!(2, "delta-e1994", "delta_e_1994", "ΔE*94", 2);
const UV_PRIME: [CameraMetric; 4] = statistics!(3, "uv-prime", "delta_uv_prime", "Δu′v′", 4);
const XY: [CameraMetric; 4] = statistics!(4, "xy", "delta_xy", "Δxy", 4);

const STATISTICS: [[CameraMetric; 4]; 5] = [DELTA_E_2000, DELTA_E_1976, DELTA_E_1994, UV_PRIME, XY];
// A metric that is added to the table of differences has its statistics here.
const _: () = assert!(STATISTICS.len() == Metric::ALL.len());

const SINGLE: [CameraMetric; 17] = [
    CameraMetric {
        id: "lightness",
        column: "delta_l_rms",
        label: "Lightness differences of the patches, root mean square",
        symbol: "ΔL* RMS",
        evaluate: |evidence| evidence.rms(0),
        ..DIFFERENCE
    },
    CameraMetric {
        id: "chroma",
        column: "delta_c_rms",
        label: "Chroma differences of the patches, root mean square",
        symbol: "ΔC*ab RMS",
        evaluate: |evidence| evidence.rms(1),
        ..DIFFERENCE
    },
    CameraMetric {
        id: "hue",
        column: "delta_h_rms",
        label: "Hue differences of the patches, root mean square",
        symbol: "ΔH*ab RMS",
        evaluate: |evidence| evidence.rms(2),
        ..DIFFERENCE
    },
    CameraMetric {
        id: "angular-error",
        column: "angular_error_deg",
        label: "Angle between the patches' linear sRGB vectors, mean",
        symbol: "RGB angle",
        unit: "°",
        evaluate: |evidence| evidence.mean(DifferenceConditions::angle_deg),
        ..DIFFERENCE
    },
    CameraMetric {
        id: "cct-error",
        column: "cct_error_k",
        label: "CCT error of a blackbody, by CIE 15 (nearest in CIE 1960 u, v) on the reference's own locus",
        symbol: "CCT error",
        unit: "K",
        decimals: 0,
        evaluate: |evidence| (*evidence.locus)?.cct_error_k.ok_or(WhyNot::NoCct),
        ..LOCUS
    },
    CameraMetric {
        id: "locus-along",
        column: "locus_error_along",
        label: "Locus error along the reference's locus, positive towards higher temperatures",
        symbol: "Δu′v′ along",
        evaluate: |evidence| Ok((*evidence.locus)?.along),
        ..LOCUS
    },
    CameraMetric {
        id: "locus-off",
        column: "locus_error_off",
        label: "Locus error across the reference's locus, positive towards green",
        symbol: "Δu′v′ off",
        evaluate: |evidence| Ok((*evidence.locus)?.off),
        ..LOCUS
    },
    CameraMetric { evaluate: |evidence| Ok((*evidence.space)?.vora), ..VORA },
    CameraMetric {
        id: "luther",
        column: "luther_residual",
        label: "Luther residual, relative RMS of the least-squares fit to the reference's curves",
        symbol: "Luther",
        decimals: 3,
        better: Better::Lower,
        evaluate: |evidence| Ok((*evidence.space)?.luther),
        ..VORA
    },
    CameraMetric {
        id: "metamerism-index",
        column: "metamerism_index",
        label: "Sensitivity metamerism index as in ISO 17321, least-squares fit",
        symbol: "SMI",
        decimals: 1,
        evaluate: |evidence| *evidence.index[0],
        ..VORA
    },
    CameraMetric {
        id: "metamerism-index-min",
        column: "metamerism_index_min_delta_e",
        label: "Sensitivity metamerism index as in ISO 17321, minimum-ΔE*ab fit",
        symbol: "SMI min ΔE",
        decimals: 1,
        evaluate: |evidence| *evidence.index[1],
        ..VORA
    },
    CameraMetric {
        id: "quality-factor",
        column: "quality_factor_min",
        label: "Quality factor (Neugebauer) of the worst channel",
        symbol: "q-factor",
        decimals: 3,
        evaluate: |evidence| Ok((*evidence.space)?.factors.into_iter().fold(f64::INFINITY, f64::min)),
        ..VORA
    },
    CameraMetric {
        id: "noise-red",
        column: "noise_gain_red",
        label: "Noise gain from raw RGB to linear sRGB, red row of matrix ∘ balance",
        symbol: "noise R",
        evaluate: |evidence| evidence.noise_row(0),
        ..NOISE
    },
    CameraMetric {
        id: "noise-green",
        column: "noise_gain_green",
        label: "Noise gain from raw RGB to linear sRGB, green row of matrix ∘ balance",
        symbol: "noise G",
        evaluate: |evidence| evidence.noise_row(1),
        ..NOISE
    },
    CameraMetric {
        id: "noise-blue",
        column: "noise_gain_blue",
        label: "Noise gain from raw RGB to linear sRGB, blue row of matrix ∘ balance",
        symbol: "noise B",
        evaluate: |evidence| evidence.noise_row(2),
        ..NOISE
    },
    CameraMetric { evaluate: |evidence| Ok((*evidence.noise)?.psi), ..NOISE },
    CameraMetric {
        id: "condition",
        column: "condition_number",
        label: "Condition number of matrix ∘ balance",
        symbol: "cond",
        evaluate: |evidence| {
            evidence.scale?;
            (*evidence.noise)?.condition().ok_or(WhyNot::Rendering(RenderingError::NoWhite))
        },
        ..NOISE
    },
];

const SNR: CameraMetric = CameraMetric {
    id: "gray-snr",
    column: "gray_snr_db",
    label: "Signal-to-noise ratio of an 18 % gray's luminance, shot and read noise",
    symbol: "SNR",
    unit: "dB",
    decimals: 1,
    better: Better::Higher,
    evaluate: |evidence| *evidence.snr_db,
    ..NOISE
};

/// Common values of the metrics of a group.
const DIFFERENCE: CameraMetric = CameraMetric {
    id: "",
    column: "",
    label: "",
    symbol: "",
    unit: "1",
    group: MetricGroup::Differences,
    decimals: 2,
    better: Better::Lower,
    place: 0,
    evaluate: |_| Err(WhyNot::NoPatches),
};
const LOCUS: CameraMetric = CameraMetric { group: MetricGroup::Locus, decimals: 4, ..DIFFERENCE };
const VORA: CameraMetric = CameraMetric {
    id: "vora",
    column: "vora_value",
    label: "Vora value",
    symbol: "Vora",
    group: MetricGroup::Sensitivities,
    decimals: 4,
    better: Better::Higher,
    ..DIFFERENCE
};
const NOISE: CameraMetric = CameraMetric {
    id: "noise-gain",
    column: "noise_gain_psi",
    label: "Noise-gain factor Ψ of US 5609978: sum of the row lengths of the matrix from balanced RGB",
    symbol: "Ψ",
    group: MetricGroup::Noise,
    ..DIFFERENCE
};

const COUNT: usize = STATISTICS.as_flattened().len() + SINGLE.len() + 1;

static TABLE: [CameraMetric; COUNT] = table();

const fn table() -> [CameraMetric; COUNT] {
    let (first, then) = (STATISTICS.as_flattened(), &SINGLE);
    let mut all = [SNR; COUNT];
    let mut at = 0;
    while at < COUNT {
        if at + 1 < COUNT {
            all[at] = if at < first.len() { first[at] } else { then[at - first.len()] };
        }
        all[at].place = at;
        at += 1;
    }
    all
}

impl CameraMetric {
    /// All metrics, in the order they are listed.
    pub const ALL: &[Self] = &TABLE;

    /// The metric of this id.
    pub fn by_id(id: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|metric| metric.id == id)
    }

    pub(super) fn evaluate(self, evidence: &Evidence<'_>) -> Result<f64, WhyNot> {
        (self.evaluate)(evidence)
    }
}

const _: () = assert!(COUNT <= 64, "one bit each");

impl MetricSet {
    /// All metrics.
    pub const ALL: Self = Self(u64::MAX);

    /// True for a metric that is asked for.
    pub const fn contains(self, metric: CameraMetric) -> bool {
        self.0 >> metric.place & 1 == 1
    }
}

impl FromIterator<CameraMetric> for MetricSet {
    fn from_iter<I: IntoIterator<Item = CameraMetric>>(metrics: I) -> Self {
        Self(metrics.into_iter().fold(0, |bits, metric| bits | 1 << metric.place))
    }
}

/// Difference of two values of one metric under the same conditions, with its uncertainty.
///
/// ```text
/// u = √(u₁² + u₂²),   significant where |x₁ − x₂| > k u
/// ```
/// Errors of the two cameras are taken as independent, which is conservative for tables of one laboratory: they share some. k is the larger
/// of the two coverage factors; an uncertainty that is not known counts as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// First less second.
    pub value: f64,
    /// Standard uncertainty, if either has one.
    pub standard: Option<f64>,
    /// Coverage factor for 95 %.
    pub coverage: f64,
}

impl Difference {
    /// Difference of two values; none where one is missing.
    pub fn new(a: MetricValue, b: MetricValue) -> Option<Self> {
        Some(Self::of((a.value.ok()?, a.uncertainty), (b.value.ok()?, b.uncertainty)))
    }

    fn of(a: (f64, Option<MetricUncertainty>), b: (f64, Option<MetricUncertainty>)) -> Self {
        let known = || [a.1, b.1].into_iter().flatten();
        let standard = known().map(|u| u.standard * u.standard).reduce(|a, b| a + b).map(f64::sqrt);
        Self { value: a.0 - b.0, standard, coverage: known().map(|u| u.coverage).fold(0.0, f64::max) }
    }

    /// True if the difference exceeds its expanded uncertainty: a claim at 95 %.
    pub fn is_significant(self) -> bool {
        self.value.abs() > self.coverage * self.standard.unwrap_or(0.0)
    }
}

/// Rank of each value as a range from 1, best first: as many as are significantly better stand before it, and as many as are significantly
/// worse after it. None for missing values and for metrics that rank nothing.
///
/// ```text
/// [1 + #better, n − #worse],   n values
/// ```
pub fn rank_ranges(better: Better, values: &[MetricValue]) -> Vec<Option<[usize; 2]>> {
    let merit = |value: &MetricValue| Some((better.merit(value.value.ok()?)?, value.uncertainty));
    let merits: Vec<Option<(f64, Option<MetricUncertainty>)>> = values.iter().map(merit).collect();
    let others = || merits.iter().flatten().copied();
    let count = others().count();
    let range = |own: (f64, Option<MetricUncertainty>)| {
        let apart = others().filter(move |&other| Difference::of(own, other).is_significant());
        apart.fold([1, count], |[first, last], other| {
            [first + usize::from(other.0 < own.0), last - usize::from(other.0 > own.0)]
        })
    };
    merits.par_iter().map(|own| own.map(range)).collect()
}
