//! `CxF3`: spectra of named objects in XML, as lists of values or as single points; and `CxF` 1, whose samples have single values.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::decimal::clean;
use crate::decision::{Decided, Reader};
use crate::error::{ReadError, check_curves, check_samples};
use crate::formats::Format;
use crate::formats::spectra::{Found, Sample, Spectrum};
use crate::formats::xml::{self, Element, Step, Walk};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::watch::Log;

impl Reader {
    /// XML of `CxF3`.
    pub const CXF: Self = Self::new("cxf", "CxF", "CxF");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::CXF, fits: |head| xml::fits(head, |root| matches!(root, "CxF" | "CXF")), read };

fn read(text: &str, _: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut walk = Walk::new(text);
    let mut content = Content::default();
    while let Some(step) = walk.next(log)? {
        match (step, walk.innermost()) {
            (Step::Open, Some(element)) => content.open(element)?,
            (Step::Open, None) => {}
            (Step::Close(element), inside) => content.close(&element, inside.map_or("", Element::name), log)?,
        }
    }
    content.place_lists(log)?;
    content.name_types();
    let Content { header, spectra: all, .. } = content;
    let reader = Decided::certain(Reader::CXF, "The root element is “CxF”");
    xml::found(all, header, (reader, "CxF prescribes it"), log)
}

fn is_spectrum(name: &str) -> bool {
    name.ends_with("Spectrum")
}

/// First wavelength and step of a list of values, as far as they are given.
#[derive(Debug, Clone, Default)]
struct Range {
    start: Option<f64>,
    step: Option<f64>,
}

impl Range {
    fn of(element: &Element<'_>) -> Result<Self, ReadError> {
        Ok(Self { start: element.number_attribute("StartWL")?, step: element.number_attribute("Increment")? })
    }
}

/// A spectrum whose samples have the numbers of their places in a list for wavelengths.
struct List {
    spectrum: usize,
    range: Range,
    /// The specification with the information that `range` lacks.
    specification: Option<String>,
    line: usize,
}

#[derive(Default)]
struct Content {
    header: Header,
    spectra: Vec<Spectrum>,
    total: usize,
    objects: Vec<Option<String>>,
    points: Vec<Sample>,
    /// Lists wait for the end: the specifications may stand below them.
    lists: Vec<List>,
    specification: Option<String>,
    ranges: Vec<(String, Range)>,
    /// Of the first version: the conditions that a spectrum names, those whose element is open, and what spectra measured
    /// in some are.
    conditions: Vec<(usize, String)>,
    number: Option<String>,
    types: BTreeMap<String, String>,
}

impl Content {
    fn open(&mut self, element: &Element<'_>) -> Result<(), ReadError> {
        match element.name() {
            "Object" => {
                let name = element.attribute("Name")?.or(element.attribute("Id")?);
                self.objects.push(name.map(Cow::into_owned));
            }
            "Sample" => self.objects.push(None),
            "ColorSpecification" => self.specification = element.attribute("Id")?.map(Cow::into_owned),
            name if is_spectrum(name) => self.points = Vec::new(),
            _ => {}
        }
        Ok(())
    }

    fn close(&mut self, element: &Element<'_>, inside: &str, log: &mut Log<'_>) -> Result<(), ReadError> {
        if inside == "FileInformation" {
            self.header.note(element.line, element.name(), element.content());
        }
        match element.name() {
            "Object" | "Sample" => {
                self.objects.pop();
            }
            "Name" if inside == "Sample" => {
                self.objects.pop();
                self.objects.push(Some(element.content().to_owned()));
            }
            "Attribute" if element.attribute("Name")?.as_deref() == Some("Physical.SpectrumType") => {
                let kind = element.content();
                let kind = if matches!(kind, "AmbientLight" | "Emission") { "Emission" } else { kind };
                self.types.extend(self.number.clone().map(|number| (number, kind.to_owned())));
            }
            "ID" if inside == "Conditions" => self.number = Some(element.content().to_owned()),
            "Conditions" => self.number = None,
            "ColorSpecification" => self.specification = None,
            "WavelengthRange" => {
                // The first one of a specification counts.
                if let Some(id) = self.specification.take() {
                    self.ranges.push((id, Range::of(element)?));
                }
            }
            point @ ("SpectralPoint" | "Value") if point != "Value" || inside == "Spectrum" => {
                let attribute = if point == "Value" { "Name" } else { "WL" };
                let wavelength = element.number_attribute(attribute)?.unwrap_or(f64::NAN);
                let place = element.pair(attribute, log);
                let sample = Sample { wavelength, value: element.number()?, line: element.line, place };
                push(&mut self.points, &mut self.total, sample)?;
            }
            name if is_spectrum(name) => self.spectrum(element, log)?,
            _ => {}
        }
        Ok(())
    }

    fn spectrum(&mut self, element: &Element<'_>, log: &mut Log<'_>) -> Result<(), ReadError> {
        let Some(name) = self.objects.last().cloned() else { return Ok(()) };
        check_curves(self.spectra.len() + 1, element.line)?;
        let kind = element.name().trim_end_matches("Spectrum");
        let label = if kind == "Emissive" { "Emission" } else { kind.trim_start_matches("Custom") }.to_owned();
        let mut samples = std::mem::take(&mut self.points);
        if samples.is_empty() && !element.content().is_empty() {
            let specification = element.attribute("ColorSpecification")?.map(Cow::into_owned);
            let (range, line) = (Range::of(element)?, element.line);
            self.lists.push(List { spectrum: self.spectra.len(), range, specification, line });
            let mut places = 0..;
            element.numbers(log, |value, place| {
                let wavelength = places.next().map_or(f64::NAN, |place: u32| f64::from(place));
                push(&mut samples, &mut self.total, Sample { wavelength, value, line, place })
            })?;
        }
        samples.shrink_to_fit();
        if let Some(conditions) = element.attribute("Conditions")? {
            self.conditions.push((self.spectra.len(), conditions.into_owned()));
        }
        self.spectra.push(Spectrum { name, label, samples });
        Ok(())
    }

    /// Conditions stand below the spectra that were measured in them.
    fn name_types(&mut self) {
        for (spectrum, number) in &self.conditions {
            if let Some(kind) = self.types.get(number) {
                self.spectra[*spectrum].label.clone_from(kind);
            }
        }
    }

    fn place_lists(&mut self, log: &Log<'_>) -> Result<(), ReadError> {
        self.ranges.sort_by(|a, b| a.0.cmp(&b.0));
        for list in &self.lists {
            log.look(usize::MAX)?;
            let declared = list.specification.as_ref().and_then(|id| {
                let first = self.ranges.partition_point(|(other, _)| other < id);
                self.ranges.get(first).filter(|(other, _)| other == id)
            });
            let start = list.range.start.or(declared.and_then(|(_, range)| range.start));
            let step = list.range.step.or(declared.and_then(|(_, range)| range.step));
            let (Some(start), Some(step)) = (start, step) else {
                return Err(ReadError::NoWavelengths(list.line));
            };
            let samples = &mut self.spectra[list.spectrum].samples;
            for sample in &mut *samples {
                sample.wavelength = clean(start + step * sample.wavelength);
            }
            samples.retain(|sample| sample.wavelength.is_finite());
        }
        Ok(())
    }
}

fn push(samples: &mut Vec<Sample>, total: &mut usize, sample: Sample) -> Result<(), ReadError> {
    if !sample.wavelength.is_finite() || !sample.value.is_finite() {
        return Ok(());
    }
    *total += 1;
    check_samples(*total, sample.line)?;
    samples.push(sample);
    Ok(())
}
