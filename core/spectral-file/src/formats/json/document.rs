//! Members used by the layouts; all others are skipped without being stored.

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

use crate::formats::json::rows::Rows;

/// Maximum number of stored header entries.
const MAX_ENTRIES: usize = 1000;

#[derive(Deserialize)]
pub(super) struct File {
    pub(super) header: Option<Texts>,
    pub(super) spectral_data: Option<Aces>,
    pub(super) camera_name: Option<String>,
    #[serde(default)]
    pub(super) comments: TextsOf<true>,
    #[serde(default)]
    pub(super) name: TextsOf<true>,
    pub(super) ssf_bands: Option<Vec<f64>>,
    pub(super) red_ssf: Option<Vec<f64>>,
    pub(super) green_ssf: Option<Vec<f64>>,
    pub(super) blue_ssf: Option<Vec<f64>>,
    pub(super) bands: Option<Vec<f64>>,
    pub(super) scale: Option<f64>,
    pub(super) spectrum: Option<Shape>,
    pub(super) metadata: Option<Texts>,
    #[serde(rename = "spectrometerSettings")]
    pub(super) settings: Option<Settings>,
}

/// A spectrum: the values of dcamprof, or the curves of ENLIGHTEN by their names.
pub(super) enum Shape {
    Values(Vec<f64>),
    Curves(InOrder<Option<Vec<Option<f64>>>>),
}

impl<'de> Deserialize<'de> for Shape {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Shape;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a list of numbers, or an object of lists")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Shape, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(list)).map(Shape::Values)
            }
            fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Shape, M::Error> {
                InOrder::deserialize(MapAccessDeserializer::new(map)).map(Shape::Curves)
            }
        }
        deserializer.deserialize_any(Any)
    }
}

/// Settings of a spectrometer, as ENLIGHTEN writes them.
#[derive(Deserialize)]
pub(super) struct Settings {
    #[serde(default)]
    pub(super) wavelengths: Option<Vec<f64>>,
}

/// The data of rawtoaces.
#[derive(Deserialize)]
pub(super) struct Aces {
    pub(super) units: Option<String>,
    #[serde(default)]
    pub(super) index: InOrder<Vec<String>>,
    pub(super) data: InOrder<Rows>,
}

/// An object whose members are stored in the order of the file.
pub(super) struct InOrder<T>(pub(super) Vec<(String, T)>);

impl<T> Default for InOrder<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for InOrder<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
            type Value = InOrder<T>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }
            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<InOrder<T>, M::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(InOrder(entries))
            }
        }
        deserializer.deserialize_map(Entries(PhantomData))
    }
}

/// An object of texts; other values are omitted.
#[derive(Default)]
pub(super) struct Texts(pub(super) Vec<(String, String)>);

impl<'de> Deserialize<'de> for Texts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Texts;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object of texts")
            }
            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Texts, M::Error> {
                let mut kept = Vec::new();
                while let Some((key, entry)) = map.next_entry::<String, TextsOf<false>>()? {
                    if let Some(text) = entry.0.into_iter().next().filter(|_| kept.len() < MAX_ENTRIES) {
                        kept.push((key, text));
                    }
                }
                Ok(Texts(kept))
            }
        }
        deserializer.deserialize_map(Entries)
    }
}

/// Texts of a value: the value itself, or the members of a list where `LIST` is set. All others are passed over.
#[derive(Default)]
pub(super) struct TextsOf<const LIST: bool>(pub(super) Vec<String>);

impl<'de, const LIST: bool> Deserialize<'de> for TextsOf<LIST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyValue::<LIST>).map(Self)
    }
}

struct AnyValue<const LIST: bool>;

impl<'de, const LIST: bool> Visitor<'de> for AnyValue<LIST> {
    type Value = Vec<String>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("any value")
    }
    fn visit_str<E: Error>(self, text: &str) -> Result<Vec<String>, E> {
        Ok(vec![text.to_owned()])
    }
    fn visit_bool<E: Error>(self, _: bool) -> Result<Vec<String>, E> {
        Ok(Vec::new())
    }
    fn visit_i64<E: Error>(self, _: i64) -> Result<Vec<String>, E> {
        Ok(Vec::new())
    }
    fn visit_u64<E: Error>(self, _: u64) -> Result<Vec<String>, E> {
        Ok(Vec::new())
    }
    fn visit_f64<E: Error>(self, _: f64) -> Result<Vec<String>, E> {
        Ok(Vec::new())
    }
    fn visit_unit<E: Error>(self) -> Result<Vec<String>, E> {
        Ok(Vec::new())
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<String>, A::Error> {
        let mut kept = Vec::new();
        while LIST && let Some(entry) = list.next_element::<TextsOf<false>>()? {
            if kept.len() < MAX_ENTRIES {
                kept.extend(entry.0);
            }
        }
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(kept)
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Vec<String>, A::Error> {
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Vec::new())
    }
}
