//! Arguments of fitted color transforms.

use std::ffi::OsString;

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser as _};

/// Conditions of a fit.
#[derive(Debug, Args)]
pub(super) struct FitArguments {
    /// The training reflectances: a chart, a material, or a file with reflectances [default: the built-in 190]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) training: Option<OsString>,
    /// Weights of classes of reflectances in the fit, 0 to 100: `neutrals=4,skin=2,foliage=1,sky=1`
    #[arg(long, value_name = "CLASS=WEIGHT,…", value_delimiter = ',', value_parser = weight)]
    pub(super) weights: Vec<(ColorClass, f64)>,
    /// Fits without keeping the color of a perfect diffuser
    #[arg(long)]
    pub(super) free_white: bool,
}

/// Names of the correction methods.
pub(super) fn method() -> impl clap::builder::TypedValueParser<Value = CorrectionMethod> {
    let ids = CorrectionMethod::ALL.map(|method| clap::builder::PossibleValue::new(method.id()).help(method.label()));
    PossibleValuesParser::new(ids).map(|id| CorrectionMethod::by_id(&id).unwrap_or_default())
}

/// One weight, as `skin=2`.
fn weight(text: &str) -> Result<(ColorClass, f64), String> {
    let classes = || ColorClass::ALL.map(ColorClass::key).join(", ");
    let malformed = || format!("write a class and its weight, as skin=2; classes: {}", classes());
    let (class, number) = text.split_once('=').ok_or_else(malformed)?;
    let class = ColorClass::ALL.into_iter().find(|known| known.key() == class.trim());
    let class = class.ok_or_else(|| format!("no class is named so; classes: {}", classes()))?;
    let number = number.trim().parse::<f64>().ok().filter(|number| (0.0..=ClassWeights::MOST).contains(number));
    let number = number.ok_or_else(|| format!("a weight is a number from 0 to {}", ClassWeights::MOST))?;
    Ok((class, number))
}
