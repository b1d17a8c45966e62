//! Wavelengths as keys, each with a list of values: stored as plain numbers, not as the texts and lists they are written
//! as.

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt;

use crate::text::excerpt;

/// Wavelengths with a value for each curve; `null` is a gap.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) wavelengths: Vec<f64>,
    /// The values of one wavelength after those of the other, NaN for a gap.
    pub(super) values: Vec<f64>,
    /// Number of values at the first wavelength.
    pub(super) width: usize,
    /// The first row that does not go with the others.
    pub(super) fault: Option<Fault>,
}

/// Reason that a row is none.
#[derive(Debug)]
pub(super) enum Fault {
    /// Its key is not a number.
    Key(String),
    /// It has another number of values than the first.
    Count { key: String, found: usize },
}

impl<'de> Deserialize<'de> for Rows {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Rows;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object of lists")
            }
            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Rows, M::Error> {
                let mut rows = Rows::default();
                while let Some(key) = map.next_key::<Key>()? {
                    let before = rows.values.len();
                    map.next_value_seed(Append(&mut rows.values))?;
                    rows.take(key, before);
                }
                rows.wavelengths.shrink_to_fit();
                rows.values.shrink_to_fit();
                Ok(rows)
            }
        }
        deserializer.deserialize_map(Entries)
    }
}

impl Rows {
    fn take(&mut self, key: Key, before: usize) {
        let found = self.values.len() - before;
        self.width = if self.wavelengths.is_empty() { found } else { self.width };
        let fault = match key {
            Key::Wavelength(wavelength) => {
                self.wavelengths.push(wavelength);
                (found != self.width).then(|| Fault::Count { key: wavelength.to_string(), found })
            }
            Key::Other(text) => Some(Fault::Key(text)),
        };
        // A row that matches no other is discarded, so that all have the same width.
        if fault.is_some() {
            self.values.truncate(before);
            self.wavelengths.truncate(before / self.width.max(1));
        }
        self.fault = self.fault.take().or(fault);
    }
}

/// A key: a wavelength, or the beginning of a text that is none.
enum Key {
    Wavelength(f64),
    Other(String),
}

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Text;
        impl Visitor<'_> for Text {
            type Value = Key;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a text")
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Key, E> {
                let number = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
                Ok(number.map_or_else(|| Key::Other(excerpt(text)), Key::Wavelength))
            }
        }
        deserializer.deserialize_str(Text)
    }
}

/// Puts a list of values behind others.
struct Append<'a>(&'a mut Vec<f64>);

impl<'de> DeserializeSeed<'de> for Append<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        struct List<'a>(&'a mut Vec<f64>);
        impl<'de> Visitor<'de> for List<'_> {
            type Value = ();
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a list of numbers")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
                while let Some(value) = list.next_element::<Option<f64>>()? {
                    self.0.push(value.unwrap_or(f64::NAN));
                }
                Ok(())
            }
        }
        deserializer.deserialize_seq(List(self.0))
    }
}
