//! Role and scale of the curves of a grid.

use crate::report::{Certainty, Decided};
use crate::role::{Role, Values};

/// The role, and the scale of each curve.
#[derive(Debug)]
pub(crate) struct Scale {
    pub(crate) role: Decided<Role>,
    /// The role by content and surroundings, where another was chosen.
    pub(crate) content: Decided<Role>,
    /// Scale of most curves.
    pub(crate) values: Decided<Values>,
    pub(super) columns: Vec<Values>,
}

impl Scale {
    /// Returns whether values above a thousand are out of question: percent, and fractions of light.
    pub(crate) fn denies_thousands(&self) -> bool {
        let sure = |certainty| matches!(certainty, Certainty::Certain | Certainty::Chosen);
        (self.values.value == Values::Percent && sure(self.values.certainty))
            || (self.role.value.is_fraction() && sure(self.role.certainty))
    }
}
