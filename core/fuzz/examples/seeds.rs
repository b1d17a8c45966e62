//! Writes the sound files and the miniature files of the tests into the corpus of each target, where libFuzzer begins.

use std::path::Path;

use chromascope_core_fuzz::{files, options};

fn main() -> std::io::Result<()> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for target in ["table", "table_preview", "table_readers", "table_write"] {
        std::fs::create_dir_all(corpus.join(target))?;
    }
    let sound = files::ALL.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec()));
    for (name, plain) in sound.chain(miniatures()?) {
        let plain = plain.as_slice();
        std::fs::write(corpus.join("table").join(&name), plain)?;
        for reader in 0..=options::readers() {
            let chosen = [options::only_reader(reader).as_slice(), plain].concat();
            for target in ["table_preview", "table_readers"] {
                std::fs::write(corpus.join(target).join(format!("{name}-{reader}")), &chosen)?;
            }
        }
        std::fs::write(corpus.join("table_write").join(&name), [&[0], plain].concat())?;
    }
    Ok(())
}

/// The files that the tests read, each with its name.
fn miniatures() -> std::io::Result<Vec<(String, Vec<u8>)>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/spectral-file/corpus");
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending != "truth") {
            all.push((path.file_name().unwrap_or_default().to_string_lossy().into_owned(), std::fs::read(path)?));
        }
    }
    Ok(all)
}
