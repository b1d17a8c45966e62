//! Lossless JPEG: ITU-T T.81 (09/92), process 14, Huffman coding, one interleaved scan of 1 to 4 components.

use crate::error::LosslessJpegError as Error;

/// Bits of a code that are looked up at once; longer codes are rare.
const FAST_BITS: u32 = 12;

/// Samples of a frame, row by row, components of a pixel side by side.
#[derive(Debug)]
pub(crate) struct Frame {
    /// Samples of a row: width times components.
    pub(crate) row: usize,
    pub(crate) samples: Vec<u16>,
}

/// Start of frame (T.81 B.2.2): sample precision, size, components.
#[derive(Clone, Copy)]
struct Header {
    precision: u32,
    height: usize,
    width: usize,
    components: usize,
}

/// Scan (T.81 B.2.3): predictor, point transform, pixels between restarts.
struct Scan<'a, const C: usize> {
    header: Header,
    tables: [&'a Table; C],
    predictor: u8,
    shift: u32,
    restart: usize,
}

/// Decodes a frame of at most `most` samples.
pub(crate) fn decode(bytes: &[u8], most: usize) -> Result<Frame, Error> {
    if bytes.get(..2) != Some(&[0xFF, 0xD8]) {
        return Err(Error::NotJpeg);
    }
    let (mut at, mut header, mut tables, mut restart) = (2, None, [const { None }; 4], 0);
    loop {
        if *bytes.get(at).ok_or(Error::Truncated)? != 0xFF {
            return Err(Error::Segment("marker"));
        }
        let marker = *bytes.get(at + 1).ok_or(Error::Truncated)?;
        if marker == 0xFF {
            at += 1;
            continue;
        }
        let length = bytes.get(at + 2..at + 4).map(|n| usize::from(n[0]) << 8 | usize::from(n[1]));
        let end = at + 2 + length.ok_or(Error::Truncated)?.max(2);
        let segment = bytes.get(at + 4..end).ok_or(Error::Truncated)?;
        match marker {
            0xC3 => header = Some(frame_header(segment, bytes.len(), most)?),
            0xC4 => huffman_tables(segment, &mut tables)?,
            0xC0..=0xCF => return Err(Error::Lossy(marker)),
            0xDD if segment.len() == 2 => restart = usize::from(segment[0]) << 8 | usize::from(segment[1]),
            0xDA => {
                let header = header.ok_or(Error::Segment("SOF"))?;
                return match header.components {
                    1 => scan::<1>(segment, &bytes[end..], header, &tables, restart),
                    2 => scan::<2>(segment, &bytes[end..], header, &tables, restart),
                    3 => scan::<3>(segment, &bytes[end..], header, &tables, restart),
                    _ => scan::<4>(segment, &bytes[end..], header, &tables, restart),
                };
            }
            0xD0..=0xD9 | 0xDC | 0 => return Err(Error::Segment("marker")),
            _ => {}
        }
        at = end;
    }
}

fn frame_header(segment: &[u8], bytes: usize, most: usize) -> Result<Header, Error> {
    let &[precision, y1, y0, x1, x0, components, ref rest @ ..] = segment else {
        return Err(Error::Segment("SOF"));
    };
    let [height, width] = [[y1, y0], [x1, x0]].map(|n| usize::from(u16::from_be_bytes(n)));
    let components = usize::from(components);
    let sampled = components > 1 && rest.chunks(3).any(|component| component.get(1) != Some(&0x11));
    if !(2..=16).contains(&precision) || !(1..=4).contains(&components) || rest.len() != 3 * components || sampled {
        return Err(Error::Segment("SOF"));
    }
    // Each sample takes at least one bit.
    let found = height * width * components;
    if found == 0 || found > most || found / 8 > bytes {
        return Err(Error::Size { found, expected: most });
    }
    Ok(Header { precision: precision.into(), height, width, components })
}

fn huffman_tables(mut segment: &[u8], tables: &mut [Option<Table>; 4]) -> Result<(), Error> {
    while let Some((&class, rest)) = segment.split_first() {
        let (counts, rest) = rest.split_at_checked(16).ok_or(Error::Segment("DHT"))?;
        let symbols = counts.iter().map(|&count| usize::from(count)).sum();
        let (symbols, rest) = rest.split_at_checked(symbols).ok_or(Error::Segment("DHT"))?;
        let table = tables.get_mut(usize::from(class)).ok_or(Error::Segment("DHT"))?;
        *table = Some(Table::new(counts, symbols).ok_or(Error::Segment("DHT"))?);
        segment = rest;
    }
    Ok(())
}

fn scan<const C: usize>(
    segment: &[u8],
    data: &[u8],
    header: Header,
    tables: &[Option<Table>; 4],
    restart: usize,
) -> Result<Frame, Error> {
    let broken = Error::Segment("SOS");
    let &[count, ref rest @ ..] = segment else { return Err(broken) };
    let (selectors, &[predictor, 0, shift]) = rest.split_at_checked(2 * C).ok_or(broken)? else { return Err(broken) };
    if usize::from(count) != C || !(1..=7).contains(&predictor) || u32::from(shift) >= header.precision {
        return Err(broken);
    }
    let mut chosen = [None; C];
    for (chosen, selector) in chosen.iter_mut().zip(selectors.chunks(2)) {
        *chosen = tables.get(usize::from(selector[1] >> 4)).and_then(Option::as_ref);
    }
    // A restart is at the start of a row (T.81 H.1.1).
    if chosen.contains(&None) || !restart.is_multiple_of(header.width) {
        return Err(broken);
    }
    let tables = chosen.map(|table| table.expect("checked above"));
    Scan { header, tables, predictor, shift: shift.into(), restart: restart / header.width }.decode(data)
}

impl<const C: usize> Scan<'_, C> {
    fn decode(&self, data: &[u8]) -> Result<Frame, Error> {
        let row = self.header.width * C;
        let mut samples = vec![0; row * self.header.height];
        let mut bits = Bits::new(data);
        let start = 1 << (self.header.precision - self.shift - 1);
        for y in 0..self.header.height {
            let restarts = self.restart > 0 && y > 0 && y % self.restart == 0;
            if restarts {
                bits.restart((y / self.restart - 1) as u8 % 8)?;
            }
            let (above, line) = samples.split_at_mut(y * row);
            let line = &mut line[..row];
            let decoded = match above.len().checked_sub(row).filter(|_| !restarts) {
                None => self.row(&mut bits, line, [start; C], |left, _| left),
                Some(from) => self.lower_row(&mut bits, line, &above[from..]),
            };
            decoded.ok_or(Error::Code { row: y })?;
            if bits.ran_out() {
                return Err(Error::Truncated);
            }
        }
        if self.shift > 0 {
            for sample in &mut samples {
                *sample <<= self.shift;
            }
        }
        Ok(Frame { row, samples })
    }

    /// A row by the scan's predictor (T.81 table H.1); its first pixel by that above.
    fn lower_row(&self, bits: &mut Bits<'_>, line: &mut [u16], above: &[u16]) -> Option<()> {
        let first = std::array::from_fn(|component| above[component]);
        let b = |at: usize| i32::from(above[at]);
        let c = |at: usize| b(at - C);
        match self.predictor {
            1 => self.row(bits, line, first, |a, _| a),
            2 => self.row(bits, line, first, |_, at| b(at)),
            3 => self.row(bits, line, first, |_, at| c(at)),
            4 => self.row(bits, line, first, |a, at| a + b(at) - c(at)),
            5 => self.row(bits, line, first, |a, at| a + ((b(at) - c(at)) >> 1)),
            6 => self.row(bits, line, first, |a, at| b(at) + ((a - c(at)) >> 1)),
            _ => self.row(bits, line, first, |a, at| (a + b(at)) >> 1),
        }
    }

    #[inline]
    fn row(
        &self,
        bits: &mut Bits<'_>,
        line: &mut [u16],
        first: [u16; C],
        predict: impl Fn(i32, usize) -> i32,
    ) -> Option<()> {
        let mut left = first.map(i32::from);
        for (x, pixel) in line.chunks_exact_mut(C).enumerate() {
            for component in 0..C {
                let predicted = if x == 0 { left[component] } else { predict(left[component], x * C + component) };
                // Modulo 2¹⁶ (T.81 H.1.2.1).
                pixel[component] = (predicted + bits.difference(self.tables[component])?) as u16;
                left[component] = pixel[component].into();
            }
        }
        Some(())
    }
}

/// Canonical Huffman codes (T.81 annex C), for each the length of a difference in bits.
#[derive(PartialEq)]
struct Table {
    /// For the next `FAST_BITS` bits: length of the code << 8 | its symbol; 0 for a longer one.
    fast: Vec<u16>,
    /// For each length: the first code, the first code of no symbol, the index of the first symbol.
    lengths: [[u32; 3]; 17],
    symbols: Vec<u8>,
}

impl Table {
    fn new(counts: &[u8], symbols: &[u8]) -> Option<Self> {
        let (mut lengths, mut fast) = ([[0; 3]; 17], vec![0; 1 << FAST_BITS]);
        let (mut code, mut index) = (0, 0);
        for (length, &count) in (1..).zip(counts) {
            let first = code;
            for &symbol in &symbols[index as usize..][..count.into()] {
                if code >= 1 << length || symbol > 16 {
                    return None;
                }
                if length <= FAST_BITS {
                    let spare = FAST_BITS - length;
                    fast[(code << spare) as usize..((code + 1) << spare) as usize]
                        .fill((length << 8) as u16 | u16::from(symbol));
                }
                code += 1;
            }
            lengths[length as usize] = [first, code, index];
            index += u32::from(count);
            code <<= 1;
        }
        Some(Self { fast, lengths, symbols: symbols.to_vec() })
    }

    /// Length of the code at the head of 64 bits, and its symbol.
    #[inline]
    fn code(&self, bits: u64) -> Option<(u32, u32)> {
        let fast = u32::from(self.fast[(bits >> (64 - FAST_BITS)) as usize]);
        if fast > 0 {
            return Some((fast >> 8, fast & 0xFF));
        }
        (FAST_BITS + 1..=16).find_map(|length| {
            let code = (bits >> (64 - length)) as u32;
            let [first, end, index] = self.lengths[length as usize];
            (first..end).contains(&code).then(|| (length, self.symbols[(index + code - first) as usize].into()))
        })
    }
}

/// Bits of entropy-coded data up to the next marker; zeros beyond.
struct Bits<'a> {
    data: &'a [u8],
    at: usize,
    /// The next bits, the first at the top; those below `count` may hold what follows.
    next: u64,
    count: u32,
    /// Bits of `count` that no data stand behind.
    padding: u32,
}

impl<'a> Bits<'a> {
    fn new(data: &'a [u8]) -> Self {
        Self { data, at: 0, next: 0, count: 0, padding: 0 }
    }

    /// Fills up to more than 56 bits.
    #[inline]
    fn refill(&mut self) {
        if let Some(word) = self.data.get(self.at..self.at + 8) {
            let word = u64::from_be_bytes(word.try_into().expect("eight bytes"));
            // No byte is 0xFF, which would be stuffing or a marker.
            if (!word).wrapping_sub(0x0101_0101_0101_0101) & word & 0x8080_8080_8080_8080 == 0 {
                self.next |= word >> self.count;
                let bytes = (64 - self.count) / 8;
                self.at += bytes as usize;
                self.count += 8 * bytes;
                return;
            }
        }
        self.refill_by_bytes();
    }

    fn refill_by_bytes(&mut self) {
        while self.count <= 56 {
            let byte = match self.data.get(self.at..) {
                Some(&[0xFF, 0, ..]) => {
                    self.at += 2;
                    0xFF
                }
                Some(&[byte, ..]) if byte != 0xFF => {
                    self.at += 1;
                    byte
                }
                _ => {
                    self.padding += 8;
                    0
                }
            };
            self.next |= u64::from(byte) << (56 - self.count);
            self.count += 8;
        }
    }

    fn ran_out(&self) -> bool {
        self.padding > self.count
    }

    /// The next difference (T.81 H.1.2.2).
    #[inline]
    fn difference(&mut self, table: &Table) -> Option<i32> {
        if self.count < 32 {
            self.refill();
        }
        let (length, size) = table.code(self.next)?;
        self.skip(length);
        if size == 0 || size == 16 {
            return Some(if size == 0 { 0 } else { 1 << 15 });
        }
        let value = (self.next >> (64 - size)) as i32;
        self.skip(size);
        Some(if value < 1 << (size - 1) { value + 1 - (1 << size) } else { value })
    }

    #[inline]
    fn skip(&mut self, bits: u32) {
        self.next <<= bits;
        self.count -= bits;
    }

    /// Goes past restart marker `number`, from 0 to 7.
    fn restart(&mut self, number: u8) -> Result<(), Error> {
        let fill = self.data[self.at.min(self.data.len())..].iter().take_while(|&&byte| byte == 0xFF).count();
        if fill == 0 || self.data.get(self.at + fill) != Some(&(0xD0 | number)) {
            return Err(Error::Segment("RST"));
        }
        *self = Self { at: self.at + fill + 1, ..Self::new(self.data) };
        Ok(())
    }
}
