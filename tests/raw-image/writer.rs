//! A writer of small DNG files and of lossless JPEG, for the tests.

/// Value of a tag: TIFF type and numbers, for rationals numerator and denominator in turn.
#[derive(Clone)]
pub(crate) struct Tag(pub(crate) u16, pub(crate) u16, pub(crate) Vec<i64>);

pub(crate) fn short(tag: u16, numbers: &[i64]) -> Tag {
    Tag(tag, 3, numbers.to_vec())
}

pub(crate) fn long(tag: u16, numbers: &[i64]) -> Tag {
    Tag(tag, 4, numbers.to_vec())
}

pub(crate) fn rational(tag: u16, numbers: &[i64]) -> Tag {
    Tag(tag, 10, numbers.iter().flat_map(|&n| [n, 1000]).collect())
}

pub(crate) fn text(tag: u16, text: &str) -> Tag {
    Tag(tag, 2, text.bytes().chain([0]).map(i64::from).collect())
}

/// A DNG of a full-resolution image.
#[derive(Clone)]
pub(crate) struct Dng {
    pub(crate) big_endian: bool,
    pub(crate) tags: Vec<Tag>,
    pub(crate) tiles: Vec<Vec<u8>>,
}

impl Dng {
    /// A mosaic, red at the top left, in one strip.
    pub(crate) fn mosaic(width: usize, height: usize, bits: i64, strip: Vec<u8>) -> Self {
        let tags = [short(33421, &[2, 2]), Tag(33422, 1, vec![0, 1, 1, 2]), short(262, &[32803]), short(277, &[1])];
        Self::new(width, height, bits, strip, &tags)
    }

    /// A linear raw image of three channels in one strip.
    pub(crate) fn linear(width: usize, height: usize, bits: i64, strip: Vec<u8>) -> Self {
        Self::new(width, height, bits, strip, &[short(262, &[34892]), short(277, &[3])])
    }

    fn new(width: usize, height: usize, bits: i64, strip: Vec<u8>, tags: &[Tag]) -> Self {
        let form = [long(256, &[width as i64]), long(257, &[height as i64]), short(258, &[bits])];
        let version = Tag(50706, 1, vec![1, 7, 1, 0]);
        let tags = tags.iter().cloned().chain(form).chain([version]).collect();
        Self { big_endian: false, tags, tiles: vec![strip] }
    }

    /// The file with other or further tags.
    pub(crate) fn with(mut self, tags: &[Tag]) -> Self {
        self.tags.retain(|own| tags.iter().all(|tag| tag.0 != own.0));
        self.tags.extend_from_slice(tags);
        self
    }

    pub(crate) fn tiled(self, width: i64, height: i64, tiles: Vec<Vec<u8>>) -> Self {
        Self { tiles, ..self.with(&[long(322, &[width]), long(323, &[height])]) }
    }

    /// Bytes of the file, the image in the main directory.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let (mut file, directory) = self.parts(&[]);
        self.point(&mut file, directory);
        file
    }

    /// Bytes of the file, the image in a `SubIFD` below a preview with `above` as its tags.
    pub(crate) fn below(&self, above: &[Tag]) -> Vec<u8> {
        let (file, directory) = self.parts(&[]);
        let preview = [long(256, &[1]), long(257, &[1]), short(262, &[2]), long(254, &[1])];
        let tags = above.iter().cloned().chain(preview).chain([long(330, &[directory as i64])]).collect();
        let top = Self { big_endian: self.big_endian, tags, tiles: vec![vec![0; 3]] };
        let (mut file, directory) = top.parts(&file);
        self.point(&mut file, directory);
        file
    }

    fn number(&self, length: usize, n: i64) -> Vec<u8> {
        let mut digits = n.to_le_bytes()[..length].to_vec();
        if self.big_endian {
            digits.reverse();
        }
        digits
    }

    fn point(&self, file: &mut [u8], directory: usize) {
        file[4..8].copy_from_slice(&self.number(4, directory as i64));
    }

    /// The file up to here with tiles and directory after it, and where the directory is.
    fn parts(&self, before: &[u8]) -> (Vec<u8>, usize) {
        let mut file = before.to_vec();
        if file.is_empty() {
            file.extend(if self.big_endian { b"MM" } else { b"II" });
            file.extend([self.number(2, 42), self.number(4, 0)].concat());
        }
        let mut offsets = Vec::new();
        for tile in &self.tiles {
            offsets.push(file.len() as i64);
            file.extend_from_slice(tile);
        }
        let lengths: Vec<i64> = self.tiles.iter().map(|tile| tile.len() as i64).collect();
        let tiled = self.tags.iter().any(|tag| tag.0 == 322);
        let mut tags = self.tags.clone();
        tags.extend([long(if tiled { 324 } else { 273 }, &offsets), long(if tiled { 325 } else { 279 }, &lengths)]);
        tags.sort_by_key(|tag| tag.0);
        let mut entries = self.number(2, tags.len() as i64);
        for Tag(tag, kind, numbers) in &tags {
            let length = [1, 1, 2, 4, 4, 1, 1, 2, 4, 4][usize::from(*kind) - 1];
            let mut value: Vec<u8> = numbers.iter().flat_map(|&n| self.number(length, n)).collect();
            let count = if *kind == 10 { numbers.len() / 2 } else { numbers.len() };
            if value.len() > 4 {
                let at = file.len() as i64;
                file.extend(std::mem::replace(&mut value, self.number(4, at)));
            }
            value.resize(4, 0);
            entries.extend([self.number(2, (*tag).into()), self.number(2, (*kind).into())].concat());
            entries.extend([self.number(4, count as i64), value].concat());
        }
        let at = file.len();
        file.extend(entries);
        file.extend([0; 4]);
        (file, at)
    }
}

/// Samples packed from the highest bit on, each row padded to a byte.
pub(crate) fn packed(samples: &[u16], row: usize, bits: usize) -> Vec<u8> {
    let rows = samples.chunks(row).map(|row| {
        let mut digits: Vec<u8> =
            row.iter().flat_map(|&sample| (0..bits).rev().map(move |bit| (sample >> bit & 1) as u8)).collect();
        digits.resize(digits.len().next_multiple_of(8), 0);
        digits.chunks(8).map(|byte| byte.iter().fold(0, |sum, bit| sum << 1 | bit)).collect::<Vec<u8>>()
    });
    rows.flatten().collect()
}

/// A lossless JPEG (T.81, process 14): form of the frame, and how it is predicted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) width: usize,
    pub(crate) components: usize,
    pub(crate) precision: u32,
    pub(crate) predictor: u8,
    /// Rows between restarts; 0 for none.
    pub(crate) restart: usize,
}

impl Frame {
    /// Encodes samples, row by row, components side by side. The code of size s has s + 1 bits, all ones but the last; that
    /// of 16 has 16 ones.
    pub(crate) fn encode(&self, samples: &[u16]) -> Vec<u8> {
        let row = self.width * self.components;
        let height = samples.len() / row;
        let be = |n: usize| (n as u16).to_be_bytes();
        let components = self.components as u8;
        let mut file = vec![0xFF, 0xD8, 0xFF, 0xC4, 0, 36, 0];
        file.extend([1; 15].iter().chain(&[2]).copied().chain(0..=16));
        file.extend([0xFF, 0xC3, 0, 8 + 3 * components, self.precision as u8]);
        file.extend([be(height), be(self.width)].concat());
        file.push(components);
        file.extend((0..components).flat_map(|id| [id, 0x11, 0]));
        file.extend([0xFF, 0xDD, 0, 4]);
        file.extend(be(self.restart * self.width));
        file.extend([0xFF, 0xDA, 0, 6 + 2 * components, components]);
        file.extend((0..components).flat_map(|id| [id, 0]).chain([self.predictor, 0, 0]));
        let mut bits: Vec<bool> = Vec::new();
        for (y, line) in samples.chunks(row).enumerate() {
            let restarts = self.restart > 0 && y % self.restart == 0;
            if restarts && y > 0 {
                file.extend(stuffed(&std::mem::take(&mut bits)));
                file.extend([0xFF, 0xD0 + ((y / self.restart - 1) % 8) as u8]);
            }
            for (at, &sample) in line.iter().enumerate() {
                let above = (y > 0 && !restarts).then(|| &samples[(y - 1) * row..y * row]);
                let difference = i64::from(sample) - self.predicted(line, above, at);
                // Modulo 2¹⁶, from -32767 to 32768.
                let difference = (difference + 32767).rem_euclid(1 << 16) - 32767;
                let size = if difference == 1 << 15 { 16 } else { 64 - difference.unsigned_abs().leading_zeros() };
                bits.extend((0..size).map(|_| true).chain((size < 16).then_some(false)));
                let low = if difference < 0 { difference - 1 } else { difference };
                bits.extend((0..size).rev().filter(|_| size < 16).map(|bit| low >> bit & 1 == 1));
            }
        }
        file.extend(stuffed(&bits));
        file.extend([0xFF, 0xD9]);
        file
    }

    fn predicted(&self, line: &[u16], above: Option<&[u16]>, at: usize) -> i64 {
        let left = at.checked_sub(self.components);
        match (above, left.map(|left| i64::from(line[left]))) {
            (None, None) => 1 << (self.precision - 1),
            (None, Some(a)) => a,
            (Some(above), None) => above[at].into(),
            (Some(above), Some(a)) => {
                let [b, c] = [at, at - self.components].map(|at| i64::from(above[at]));
                [a, b, c, a + b - c, a + ((b - c) >> 1), b + ((a - c) >> 1), (a + b) >> 1]
                    [usize::from(self.predictor) - 1]
            }
        }
    }
}

/// Bits as bytes, filled with ones, a zero after each byte of ones.
fn stuffed(bits: &[bool]) -> Vec<u8> {
    let byte = |bits: &[bool]| (0..8).fold(0_u8, |sum, at| sum << 1 | u8::from(*bits.get(at).unwrap_or(&true)));
    bits.chunks(8).map(byte).flat_map(|byte| [Some(byte), (byte == 0xFF).then_some(0)]).flatten().collect()
}
