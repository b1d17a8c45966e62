//! Text of a file line by line, with the meaning of its parts.
//!
//! [`Preview`] holds the decoded text and the starts of its lines, for files up to the limit of the readers. Lines are numbered
//! as in every message of the readers. A [`Marker`] holds what [`read_marked`](crate::read_marked) recorded while it read: with
//! it, [`Preview::marks`] returns the positions of wavelengths, values, names and gaps in a single line. A number that no curve
//! has, such as a date or an integration time, is not marked.
//!
//! ```
//! use spectral_file::{Preview, ReadOptions, Watch, What, read_marked};
//!
//! let bytes = "nm;Leaf reflectance (%)\n400;5,5\n410;6,0\n".as_bytes();
//! let (table, marker) = read_marked(bytes, &ReadOptions::default(), Watch::none())?;
//! let preview = Preview::new(bytes)?;
//! let marks = preview.marks(2, &table, &marker);
//! assert_eq!(&preview.line(2).unwrap()[marks[1].range.clone()], "5,5");
//! assert_eq!(marks[0].what.describe(&table), "400 nm");
//! assert_eq!(marks[1].what.describe(&table), "Leaf reflectance: 0.055 at 400 nm (written 5.5, percent)");
//! # Ok::<(), spectral_file::ReadError>(())
//! ```

mod mark;
mod marker;
mod tables;

pub use mark::{LeftOut, Mark, Shown, What};
pub use marker::Marker;

use std::ops::Range;

use crate::decision::Encoding;
use crate::error::ReadError;
use crate::report::SpectralFile;
use crate::text::{self, Lines};

/// The most characters that [`Preview::longest`] counts of a line.
pub const LONGEST_LINE: usize = 1_000_000;

/// The text of a file and where its lines begin.
///
/// Needs the memory of the text and 4 bytes for each line.
#[derive(Debug, Clone)]
pub struct Preview {
    text: String,
    starts: Vec<u32>,
    longest: usize,
    encoding: Encoding,
}

impl Preview {
    /// Decodes the bytes of a file as the readers do, in a time proportional to their number.
    ///
    /// # Errors
    /// Those of the readers for binary, empty and too large files, and no others.
    pub fn new(bytes: &[u8]) -> Result<Self, ReadError> {
        let (text, encoding) = text::decode(bytes)?;
        let mut starts = Vec::new();
        let mut longest = 0;
        for (_, line) in Lines::new(&text) {
            starts.push(tables::offset(&text, line) as u32);
            // A line has at most as many characters as bytes, so that most lines need no count.
            if line.len() > longest {
                longest = longest.max(line.chars().take(LONGEST_LINE).count());
            }
        }
        starts.shrink_to_fit();
        Ok(Self { text: text.into_owned(), starts, longest, encoding })
    }

    /// The encoding the bytes were in.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// Number of lines; at least one.
    pub fn line_count(&self) -> usize {
        self.starts.len()
    }

    /// The characters of the longest line, at most [`LONGEST_LINE`].
    pub fn longest(&self) -> usize {
        self.longest
    }

    /// A line without its end, by its number from 1.
    pub fn line(&self, number: usize) -> Option<&str> {
        let index = number.checked_sub(1)?;
        let start = *self.starts.get(index)? as usize;
        let end = self.starts.get(number).map_or(self.text.len(), |next| *next as usize);
        Some(self.text.get(start..end)?.trim_end_matches(['\r', '\n']))
    }

    /// At most `count` characters of a line, from character `from` (from 0) on, ready for one row of fixed-width letters.
    pub fn shown(&self, number: usize, from: usize, count: usize) -> Option<Shown> {
        self.line(number).map(|line| Shown::new(line, from, count))
    }

    /// Marks of a line: in the order of the line, without overlaps, in bytes of [`line`](Self::line).
    ///
    /// Empty for a line that does not exist. A marker of a file with another number of curves
    /// gives none.
    pub fn marks(&self, number: usize, table: &SpectralFile, marker: &Marker) -> Vec<Mark> {
        self.marks_within(number, 0..usize::MAX, table, marker)
    }

    /// [`marks`](Self::marks), but only those that touch a range of bytes: quick also in lines of many megabytes.
    pub fn marks_within(
        &self,
        number: usize,
        window: Range<usize>,
        table: &SpectralFile,
        marker: &Marker,
    ) -> Vec<Mark> {
        let start = number.checked_sub(1).and_then(|index| self.starts.get(index));
        let marks = self.line(number).zip(start).map(|(line, start)| (line, *start as usize));
        marks.map_or_else(Vec::new, |(line, start)| marker.marks((number, start), line, &window, table))
    }

    /// Place where reading failed: the line, and the bytes in it, which are the whole line where nothing closer is known.
    ///
    /// `None` where the error is about the file as a whole.
    pub fn error_range(&self, error: &ReadError) -> Option<(usize, Range<usize>)> {
        let number = error.line()?;
        Some((number, tables::of_error(self.line(number)?, error)))
    }
}
