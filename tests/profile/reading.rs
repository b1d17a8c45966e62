//! Readers of TIFF directories, ICC tags and CLF numbers, and MD5, written from the specifications.

/// A field of a TIFF directory.
pub(crate) struct TiffField {
    pub(crate) tag: u16,
    kind: u16,
    pub(crate) bytes: Vec<u8>,
}

fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap())
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

/// Fields of the only directory of a DCP file.
pub(crate) fn tiff_fields(file: &[u8]) -> Vec<TiffField> {
    assert_eq!(&file[..4], b"IIRC");
    let directory = u32_at(file, 4) as usize;
    let count = usize::from(u16_at(file, directory));
    let fields: Vec<TiffField> = (0..count)
        .map(|index| {
            let at = directory + 2 + 12 * index;
            let (tag, kind, count) = (u16_at(file, at), u16_at(file, at + 2), u32_at(file, at + 4) as usize);
            let size = count * [0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8][usize::from(kind)];
            let start = if size <= 4 { at + 8 } else { u32_at(file, at + 8) as usize };
            assert!(size <= 4 || start.is_multiple_of(2));
            TiffField { tag, kind, bytes: file[start..start + size].to_vec() }
        })
        .collect();
    assert_eq!(u32_at(file, directory + 2 + 12 * count), 0, "there is no second directory");
    fields
}

impl TiffField {
    pub(crate) fn text(&self) -> String {
        assert!(self.kind == 1 || self.kind == 2);
        String::from_utf8(self.bytes.strip_suffix(&[0]).unwrap().to_vec()).unwrap()
    }

    pub(crate) fn unsigned(&self) -> u32 {
        match self.kind {
            3 => u32::from(u16_at(&self.bytes, 0)),
            4 => u32_at(&self.bytes, 0),
            other => panic!("type {other}"),
        }
    }

    pub(crate) fn rationals(&self) -> Vec<f64> {
        assert_eq!(self.kind, 10);
        let number = |at: usize| f64::from(u32_at(&self.bytes, at).cast_signed());
        (0..self.bytes.len() / 8).map(|i| number(8 * i) / number(8 * i + 4)).collect()
    }
}

/// A tag of an ICC profile.
pub(crate) struct IccTag {
    pub(crate) name: String,
    pub(crate) offset: usize,
    pub(crate) bytes: Vec<u8>,
}

/// Tags of an ICC profile in the order of its table.
pub(crate) fn icc_tags(file: &[u8]) -> Vec<IccTag> {
    let number = |at: usize| u32::from_be_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    let tag = |index: usize| {
        let at = 132 + 12 * index;
        let (offset, size) = (number(at + 4), number(at + 8));
        let name = String::from_utf8(file[at..at + 4].to_vec()).unwrap();
        IccTag { name, offset, bytes: file[offset..offset + size].to_vec() }
    };
    (0..number(128)).map(tag).collect()
}

impl IccTag {
    /// s15Fixed16 numbers after the type.
    pub(crate) fn fixed(&self) -> Vec<f64> {
        let (words, _) = self.bytes[8..].as_chunks::<4>();
        words.iter().map(|word| f64::from(i32::from_be_bytes(*word)) / 65_536.0).collect()
    }

    /// The only text of a `multiLocalizedUnicodeType`.
    pub(crate) fn text(&self) -> String {
        assert_eq!(&self.bytes[..4], b"mluc");
        let number = |at: usize| u32::from_be_bytes(self.bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((number(8), number(12)), (1, 12));
        let (units, _) = self.bytes[number(24)..number(24) + number(20)].as_chunks::<2>();
        String::from_utf16(&units.iter().map(|unit| u16::from_be_bytes(*unit)).collect::<Vec<_>>()).unwrap()
    }
}

/// Numbers between the tags of the only array of a CLF file.
pub(crate) fn clf_numbers(xml: &str) -> Vec<f64> {
    let (_, rest) = xml.split_once("<Array dim=\"3 3\">").unwrap();
    let (numbers, _) = rest.split_once("</Array>").unwrap();
    numbers.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

/// MD5 of a message (RFC 1321).
pub(crate) fn md5(message: &[u8]) -> [u8; 16] {
    const TURNS: [[u32; 4]; 4] = [[7, 12, 17, 22], [5, 9, 14, 20], [4, 11, 16, 23], [6, 10, 15, 21]];
    let mut padded = [message, &[0x80]].concat();
    padded.resize((padded.len() + 8).next_multiple_of(64) - 8, 0);
    padded.extend((8 * message.len() as u64).to_le_bytes());
    let mut state: [u32; 4] = [0x6745_2301, 0xefcd_ab89, 0x98ba_dcfe, 0x1032_5476];
    for block in padded.chunks_exact(64) {
        let word = |i: usize| u32::from_le_bytes(block[4 * i..4 * i + 4].try_into().unwrap());
        let [mut a, mut b, mut c, mut d] = state;
        for i in 0..64 {
            let (mixed, place) = match i / 16 {
                0 => ((b & c) | (!b & d), i),
                1 => ((d & b) | (!d & c), (5 * i + 1) % 16),
                2 => (b ^ c ^ d, (3 * i + 5) % 16),
                _ => (c ^ (b | !d), 7 * i % 16),
            };
            let sine = (((i + 1) as f64).sin().abs() * 4_294_967_296.0) as u32;
            let sum = a.wrapping_add(mixed).wrapping_add(sine).wrapping_add(word(place));
            (a, d, c, b) = (d, c, b, b.wrapping_add(sum.rotate_left(TURNS[i / 16][i % 4])));
        }
        for (total, part) in state.iter_mut().zip([a, b, c, d]) {
            *total = total.wrapping_add(part);
        }
    }
    state.map(u32::to_le_bytes).concat().try_into().unwrap()
}
