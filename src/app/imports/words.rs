//! Words about sets that were just opened.

use chromascope_core::query::Shared;

use crate::document::imported::{ImportedSet, Role};
use crate::document::{Document, SetKind};

/// Names the sets that were renamed because another set already had the name in their files.
pub(super) fn renamed(new: &[(&ImportedSet, &Shared<ImportedSet>)]) -> String {
    let mut renamed = new.iter().filter(|(wanted, set)| wanted.name != set.name);
    let Some((first, set)) = renamed.next() else { return String::new() };
    let more = match renamed.count() {
        0 => String::new(),
        count => format!(" ({count} others renamed)"),
    };
    format!("A data set named {} already exists; imported as {}{more}.", first.name, set.name)
}

/// Names the files, of `count`, whose sets were already there.
pub(super) fn opened_again(again: &[(&ImportedSet, &Shared<ImportedSet>)], count: usize) -> String {
    match again {
        [] => String::new(),
        [(_, set)] if count == 1 => format!("This data set is already open as {}.", set.name),
        [(wanted, set)] => format!("{} is already open as {}.", wanted.file, set.name),
        many => format!("{} of them were already open.", many.len()),
    }
}

/// What becomes of sets that were opened: cameras are compared, all others wait in the library.
pub(super) fn put_to_use(before: &Document, after: &Document, brought: &[Shared<ImportedSet>]) -> String {
    if let [one] = brought {
        let waits = SetKind::of_own(one).used_as().is_some() && !after.uses(SetKind::of_own(one), &one.name);
        return if waits { "In the Library; the conditions are unchanged.".to_owned() } else { String::new() };
    }
    let cameras = brought.iter().filter(|set| set.role == Role::Camera).count();
    let shown = after.compared.len() - before.compared.len();
    let shown = match (shown, cameras) {
        (_, 0) => "None is a camera".to_owned(),
        (shown, cameras) if shown == cameras => format!("{shown} added to the comparison"),
        (shown, cameras) => format!("{shown} of {cameras} cameras added to the comparison"),
    };
    format!("{shown}; illuminant and patches are unchanged. Choose others in the Library.")
}
