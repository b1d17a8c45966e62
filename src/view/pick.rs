//! State of a list that is filtered as one types.

/// The text that is typed, and the highlighted line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PickState {
    pub text: String,
    /// The highlighted line, counted among those that can be chosen; none for the one that is set.
    pub picked: Option<usize>,
}
