//! JCAMP-DX: labeled records, blocks of blocks, points or compressed ordinates.

mod block;
mod ordinates;

use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Family, Part, Reader};
use crate::error::{MAX_PARTS, MAX_SAMPLES, ReadError, check_curves};
use crate::formats::Format;
use crate::formats::jcamp::block::{Block, label};
use crate::formats::spectra::{self, Found};
use crate::options::ReadOptions;
use crate::text::{Lines, excerpt};
use crate::unit_text;
use crate::warning::Warning;
use crate::watch::Log;

impl Reader {
    /// JCAMP-DX.
    pub const JCAMP: Self = Self::new("jcamp", "JCAMP-DX", "JCAMP-DX");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::JCAMP, fits: |head| head.is(Family::Jcamp) || head.is_chosen_for("##"), read };

/// Returns whether a text begins with the label `##TITLE=`, with blanks in it or not, or with another one before `##DATA TYPE=`.
pub(super) fn recognize(start: &str) -> bool {
    let Some((key, _)) = start.strip_prefix("##").and_then(|record| record.split_once('=')) else { return false };
    let begins = !key.contains('\n') && label(key) == "TITLE" || start.contains("DATA TYPE=");
    begins && !is_plain(start)
}

/// Returns whether rows of numbers stand below labels of which none begins data.
fn is_plain(start: &str) -> bool {
    const DATA: &str =
        "JCAMPDX|XYDATA|XYPOINTS|PEAK TABLE|PEAKTABLE|PEAK ASSIGNMENTS|DATA TABLE|DATATABLE|NTUPLES|RADATA|END";
    let key = |line: &str| line.strip_prefix("##").and_then(|rest| Some(label(rest.split_once('=')?.0)));
    let has_data = || start.lines().filter_map(key).any(|key| DATA.split('|').any(|data| label(data) == key));
    let is_row = |line: &str| {
        let mut cells = line.split_whitespace().map(|cell| cell.parse::<f64>().is_ok());
        cells.next() == Some(true) && cells.next() == Some(true)
    };
    start.lines().any(is_row) && !has_data()
}

/// Reads the processed spectrum, or all spectra if none is a raw one beside it.
fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut blocks = blocks(text, log)?;
    let foreign = blocks.iter().find_map(|block| block.foreign.clone());
    blocks.retain(|block| !block.samples.is_empty());
    if let Some((line, kind)) = foreign.filter(|_| blocks.is_empty()) {
        return Err(ReadError::NotLight { line, kind: excerpt(&kind) });
    }
    let parts: Vec<Part> = blocks.iter().take(MAX_PARTS).map(Block::part).collect();
    let mut notes = Vec::new();
    let ratio = block::settle(&mut blocks, options, log);
    let part = choose(&mut blocks, options, &mut notes)?;
    let part = leave_other_units(&mut blocks, part, &parts, log);
    let first_line = blocks.first().map(|block| block.data_line + 1).ok_or(ReadError::NoNumbers)?;
    for block in &blocks {
        block.warn(log);
    }
    let comma = blocks.iter().any(|block| block.comma);
    let form =
        (blocks[0].written, format!("Line {} gives the form {}", blocks[0].data_line, excerpt(&blocks[0].form_label)));
    let header = blocks[0].header();
    let units: Vec<Option<String>> = blocks.iter().map(|block| unit_text::unit(&block.y_units.1)).collect();
    let spectra = blocks.into_iter().map(Block::spectrum).collect();
    let mut grid = spectra::grid(spectra, header, log)?;
    grid.curves.iter_mut().zip(units).for_each(|(curve, unit)| curve.unit = unit);
    (grid.parts, grid.part) = (parts, Some(part));
    if let Some(ratio) = ratio {
        (grid.role, grid.quantity) = (Some(ratio.role), Some(ratio.quantity));
        notes.retain(|note: &Decision| note.what != ratio.note.what);
        notes.push(ratio.note);
    }
    let dialect =
        if comma { (Delimiter::CommaSpace, DecimalMark::Comma) } else { (Delimiter::Comma, DecimalMark::Point) };
    notes.insert(0, Decision::certain("Form", form.0.description(), &*form.1));
    let reader = Decided::certain(Reader::JCAMP, "The file begins with ## labels");
    Ok(Found::fixed(grid, reader, (dialect, first_line, &form.1), notes))
}

/// Leaves the block that was chosen, else those that are not raw; 0 stands for several.
fn choose(
    blocks: &mut Vec<Block>,
    options: &ReadOptions,
    notes: &mut Vec<Decision>,
) -> Result<Decided<usize>, ReadError> {
    let count = blocks.len();
    if let Some(part) = options.part {
        if !(1..=count.min(MAX_PARTS)).contains(&part) && count > 0 {
            return Err(ReadError::NoSuchPart { part, parts: count.min(MAX_PARTS) });
        }
        *blocks = blocks.drain(..).skip(part.saturating_sub(1)).take(1).collect();
        return Ok(Decided::chosen(part));
    }
    let raw = blocks.iter().filter(|block| block.is_raw()).count();
    let all = usize::from(count == 1);
    if raw == 0 || raw == count || options.raw == Some(true) {
        return Ok(Decided::certain(all, format!("{count} blocks hold spectra")));
    }
    let first = blocks.iter().position(|block| !block.is_raw()).map_or(0, |index| index + 1);
    let why = format!("{count} blocks, of which {raw} are dark or reference spectra");
    blocks.retain(|block| !block.is_raw());
    let taken = format!("“{}” alone", blocks[0].title);
    notes.push(Decision::new(
        "Blocks",
        &Decided::or_chosen(options.raw, || Decided::certain(false, why.clone())).described(&taken),
    ));
    Ok(Decided::certain(if count - raw == 1 { first } else { 0 }, why))
}

/// Leaves the blocks that are in the units of the first: those of others are parts that must be chosen.
fn leave_other_units(
    blocks: &mut Vec<Block>,
    part: Decided<usize>,
    parts: &[Part],
    log: &mut Log<'_>,
) -> Decided<usize> {
    let Some(units) = blocks.first().map(Block::units) else { return part };
    let Some(other) = blocks.iter().find(|block| block.units() != units) else { return part };
    log.push(Warning::MoreTables(other.data_line + 1));
    blocks.retain(|block| block.units() == units);
    let why = format!("{}, not all in the same units", part.why);
    let alone = parts.iter().position(|listed| listed.line == blocks[0].data_line + 1).map_or(0, |at| at + 1);
    Decided { value: if blocks.len() == 1 { alone } else { 0 }, why, ..part }
}

/// All blocks that have a title of their own, in the order of the file.
fn blocks(text: &str, log: &mut Log<'_>) -> Result<Vec<Block>, ReadError> {
    let mut all: Vec<Block> = Vec::new();
    let mut total = 0;
    // Repetitions make more of a file than it is long, but no sound file makes this much of little.
    let most = MAX_SAMPLES.min(1_000_000 + 10 * text.len());
    for (number, line) in Lines::new(text) {
        log.at(line.as_ptr() as usize - text.as_ptr() as usize)?;
        let line = line.split_once("$$").map_or(line, |(before, _)| before);
        let record = line.trim_start().strip_prefix("##");
        // Some end without the sign.
        let end = || record.filter(|record| label(record) == "END").map(|record| (record, ""));
        if let Some((key, value)) = record.and_then(|record| record.split_once('=').or_else(end)) {
            let key = label(key);
            if key == "TITLE" || all.is_empty() {
                all.last_mut().map_or(Ok(()), Block::close)?;
                check_curves(all.len() + 1, number)?;
                all.push(Block::default());
            }
            if let Some(block) = all.last_mut() {
                block.record(number, &key, value.trim());
            }
            continue;
        }
        if let Some(block) = all.last_mut().filter(|block| block.form.is_some() && block.foreign.is_none()) {
            let before = block.samples.len() + block.ordinates.len();
            block.data(number, line, log)?;
            total += block.samples.len() + block.ordinates.len() - before;
            if total > most {
                return Err(ReadError::TooManySamples(number));
            }
        }
    }
    all.last_mut().map_or(Ok(()), Block::close)?;
    Ok(all)
}
