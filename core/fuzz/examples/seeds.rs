//! Writes the sound files and the miniature files of the tests into the corpus of each target, where libFuzzer begins.

use std::path::Path;

use chromascope_core_fuzz::{files, options};

fn main() -> std::io::Result<()> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for target in ["table", "table_preview", "table_readers", "table_write", "raw"] {
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
    std::fs::write(corpus.join("raw").join("mosaic"), mosaic())
}

/// A DNG of 2 × 2 pixels, whose samples are its own first four bytes.
fn mosaic() -> Vec<u8> {
    let entries: [[u16; 5]; 9] = [
        [256, 3, 1, 2, 0],
        [257, 3, 1, 2, 0],
        [258, 3, 1, 8, 0],
        [262, 3, 1, 32803, 0],
        [273, 4, 1, 0, 0],
        [279, 4, 1, 4, 0],
        [33421, 3, 2, 2, 2],
        [33422, 1, 4, 0x100, 0x201],
        [50706, 1, 4, 0x401, 0],
    ];
    let words = [0x4949, 42, 8, 0, entries.len() as u16].into_iter();
    let entries = entries.into_iter().flat_map(|[tag, kind, count, low, high]| [tag, kind, count, 0, low, high]);
    words.chain(entries).chain([0; 2]).flat_map(u16::to_le_bytes).collect()
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
