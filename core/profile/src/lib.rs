//! Camera color profiles as bytes: DCP, ICC, CLF.
//!
//! Matrices are rows of numbers; where they come from is not this crate's concern. Everything is checked before a byte is made: what
//! cannot be written in a format is a [`ProfileError`] that names the field.

pub mod clf;
pub mod dcp;
pub mod icc;

/// 3×3 matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// Reason that a profile cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ProfileError {
    #[error("{field} is empty; give it a name")]
    Empty { field: &'static str },
    #[error("{field} has a control character, which the format cannot hold; remove it")]
    Control { field: &'static str },
    #[error("{field} has {bytes} bytes; shorten it to {} or less", MOST_TEXT)]
    Long { field: &'static str, bytes: usize },
    #[error("{field} has a number that is not finite or beyond ±{limit}")]
    Number { field: &'static str, limit: u32 },
    #[error("a DCP file holds the matrices of one light or two, not of {0}")]
    Lights(usize),
}

/// The longest text in bytes.
pub const MOST_TEXT: usize = 1000;

fn text(field: &'static str, value: &str, may_be_empty: bool) -> Result<(), ProfileError> {
    if value.is_empty() && !may_be_empty {
        return Err(ProfileError::Empty { field });
    }
    if value.chars().any(char::is_control) {
        return Err(ProfileError::Control { field });
    }
    if value.len() > MOST_TEXT {
        return Err(ProfileError::Long { field, bytes: value.len() });
    }
    Ok(())
}

/// Checks numbers against the largest magnitude that a format holds.
fn numbers<'a>(field: &'static str, values: impl IntoIterator<Item = &'a f64>, limit: u32) -> Result<(), ProfileError> {
    let within = |value: &f64| value.abs() <= f64::from(limit);
    if values.into_iter().all(within) { Ok(()) } else { Err(ProfileError::Number { field, limit }) }
}
