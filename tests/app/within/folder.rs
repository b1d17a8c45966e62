//! The folder in which windows save their documents.

use super::*;

#[test]
fn curves_that_no_document_names_are_removed_once_no_other_window_is_open() {
    let folder = tempfile::tempdir().expect("a folder");
    let curves = folder.path().join(CURVES);
    fs::create_dir(&curves).expect("made");
    for name in ["a.json", "b.json", "c.json"] {
        fs::write(curves.join(name), "[]").expect("written");
    }
    for (document, names) in [("document.json", "a.json"), ("of-a-backup.json", "{ b.json")] {
        fs::write(folder.path().join(document), names).expect("written");
    }
    let left = || entries(&curves).map(|path| name_of(&path).to_owned()).collect::<std::collections::BTreeSet<_>>();
    let claim = || Folder::claim(Some(folder.path().to_owned()));
    let (first, second) = (claim(), claim());
    let written = SystemTime::UNIX_EPOCH + Duration::from_hours(1_000_000);
    for name in ["a.json", "b.json", "c.json"] {
        let file = OpenOptions::new().write(true).open(curves.join(name)).expect("opened");
        file.set_modified(written).expect("set");
    }
    let late = written + UNNAMED + Duration::from_secs(1);
    first.tidy(late);
    second.tidy(late);
    assert_eq!(left().len(), 3, "the second window may be about to name one");
    drop(second);
    first.tidy(written + UNNAMED);
    assert_eq!(left().len(), 3, "a document that is put back may name one");
    first.tidy(late);
    assert_eq!(left().into_iter().collect::<Vec<_>>(), ["a.json", "b.json"]);
}
