//! Decisions, each with its certainty, reason and effect.

use std::fmt;

/// Certainty of a decision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Certainty {
    /// Stated in the file, or the only possible interpretation.
    Certain,
    /// Suggested by the content; the user should check it.
    Guess,
    /// Decided by neither the file nor its numbers: the numbers stay as written until the user chooses.
    Open,
    /// Requested by the caller.
    Chosen,
}

impl Certainty {
    /// Returns whether the user should check it: a guess, or an open decision.
    pub fn is_doubtful(self) -> bool {
        matches!(self, Self::Guess | Self::Open)
    }
}

impl fmt::Display for Certainty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Certain => "certain",
            Self::Guess => "a guess",
            Self::Open => "open",
            Self::Chosen => "chosen",
        })
    }
}

/// A value with how sure it is and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Decided<T> {
    /// The decided value.
    pub value: T,
    /// Its certainty.
    pub certainty: Certainty,
    /// The evidence, as the first half of a sentence: "Values reach 98".
    pub why: String,
}

impl<T> Decided<T> {
    pub(super) fn certain(value: T, why: impl Into<String>) -> Self {
        Self { value, certainty: Certainty::Certain, why: why.into() }
    }

    pub(super) fn guess(value: T, why: impl Into<String>) -> Self {
        Self { value, certainty: Certainty::Guess, why: why.into() }
    }

    pub(super) fn open(value: T, why: impl Into<String>) -> Self {
        Self { value, certainty: Certainty::Open, why: why.into() }
    }

    pub(super) fn chosen(value: T) -> Self {
        Self { value, certainty: Certainty::Chosen, why: "Chosen by hand".to_owned() }
    }

    /// This decision with its value in words.
    pub(super) fn described(&self, value: &str) -> Decided<String> {
        Decided { value: value.to_owned(), certainty: self.certainty, why: self.why.clone() }
    }

    /// The caller's choice if there is one, else what `decide` finds.
    pub(super) fn or_chosen(choice: Option<T>, decide: impl FnOnce() -> Self) -> Self {
        choice.map_or_else(decide, Self::chosen)
    }
}

/// One decision as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decision {
    /// Subject: "Decimal mark".
    pub what: &'static str,
    /// Value: "decimal commas".
    pub value: String,
    /// Its certainty.
    pub certainty: Certainty,
    /// The evidence: "Cells such as 0,05".
    pub why: String,
    /// Effect of a wrong decision.
    pub effect: Effect,
}

/// Quantity that a wrong decision makes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// The report alone.
    Report,
    /// Numbers, or their use.
    Data,
    /// The scale of all values.
    Scale,
}

impl Decision {
    pub(super) fn new<T: fmt::Display>(what: &'static str, decided: &Decided<T>) -> Self {
        Self {
            what,
            value: decided.value.to_string(),
            certainty: decided.certainty,
            why: decided.why.clone(),
            effect: Effect::Report,
        }
    }

    /// The decision with an effect on the data.
    pub(super) fn affecting(self, effect: Effect) -> Self {
        Self { effect, ..self }
    }
}

impl fmt::Display for Decision {
    /// One sentence: "Values reach 98: read as percent."
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.certainty == Certainty::Open {
            return write!(f, "{}: not decided.", self.why);
        }
        write!(f, "{}: read as {}.", self.why, self.value)
    }
}
