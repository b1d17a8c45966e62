//! Writes the sound files into the corpus of each target, where libFuzzer begins.

use std::path::Path;

use chromascope_core_fuzz::{files, options};

fn main() -> std::io::Result<()> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for target in ["table", "table_preview", "table_readers", "table_write"] {
        std::fs::create_dir_all(corpus.join(target))?;
    }
    for (name, text) in files::ALL {
        let plain = text.as_bytes();
        std::fs::write(corpus.join("table").join(name), plain)?;
        for reader in 0..=options::readers() {
            let chosen = [options::only_reader(reader).as_slice(), plain].concat();
            for target in ["table_preview", "table_readers"] {
                std::fs::write(corpus.join(target).join(format!("{name}-{reader}")), &chosen)?;
            }
        }
        std::fs::write(corpus.join("table_write").join(name), [&[0], plain].concat())?;
    }
    Ok(())
}
