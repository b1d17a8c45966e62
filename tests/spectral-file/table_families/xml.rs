//! Forms that XML allows in files of spectra: the same curves however they are written, and a place for everything that is broken.

use std::cell::Cell;

use spectral_file::{
    Encoding, Family, MAX_CURVES, Quantity, ReadError, ReadOptions, Reader, Role, SpectralFile, Warning, Watch, read,
    read_watched,
};

use super::{Certainty, error, layouts, names, ok, samples};

/// A light of three samples, with something in place of the middle one.
fn light(middle: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\">\n<SpectralDistribution>\n\
         <SpectralData wavelength=\"400\">1</SpectralData>\n{middle}\n<SpectralData wavelength=\"420\">3</SpectralData>\n\
         </SpectralDistribution>\n</IESTM2714>\n"
    )
}

/// The document as a light of points in `CxF`.
fn points(middle: &str) -> String {
    format!(
        "<CxF><Object Name=\"a\"><EmissiveSpectrum>\n<SpectralPoint WL=\"400\">1</SpectralPoint>\n{middle}\n\
         <SpectralPoint WL=\"420\">3</SpectralPoint>\n</EmissiveSpectrum></Object></CxF>\n"
    )
}

const THREE: [(f64, f64); 3] = [(400.0, 1.0), (410.0, 2.5), (420.0, 3.0)];

fn malformed(line: usize, column: usize) -> ReadError {
    ReadError::Malformed { family: Family::Xml, line, column }
}

#[test]
fn samples_are_found_however_they_are_written() {
    for middle in [
        "<SpectralData wavelength=\"410\">2.5</SpectralData>",
        "<SpectralData\n\twavelength = '410' \n>\r\n 2.5\t</SpectralData\n>",
        "<SpectralData unit=\"a>b\" wavelength=\"410\">2<!-- . --><![CDATA[.5]]></SpectralData>",
        "<SpectralData wavelength=\"4&#49;0\">2&#46;&#x35;</SpectralData>",
        "<x:SpectralData y:wavelength=\"1\" wavelength=\"410\" xmlns:y=\"z\">2.5</x:SpectralData>",
        "<?note <SpectralData> ?><SpectralData wavelength=\"410\">2.5<Note>7</Note></SpectralData>",
        "<!-- <SpectralData wavelength=\"411\">9</SpectralData> --><a><SpectralData wavelength=\"410\">2.5</SpectralData></a>",
        "<SpectralData wavelength=\"411\"/><SpectralData wavelength=\"410\">2.5</SpectralData><Note/>",
        "<![CDATA[<SpectralData wavelength=\"411\">9</SpectralData>]]><SpectralData wavelength=\"410\">2.5</SpectralData>",
    ] {
        let table = ok(&light(middle));
        assert_eq!(samples(&table, 0), THREE, "{middle}");
        let middle = middle.replace("SpectralData", "SpectralPoint").replace("wavelength", "WL");
        assert_eq!(samples(&ok(&points(&middle)), 0), THREE, "{middle}");
    }
}

#[test]
fn a_list_may_be_broken_by_anything_that_is_no_element() {
    for list in [
        "0.1 0.2 0.3",
        "\r\n0.1\r\n\t0.2\n0.3\n",
        "0.1<!-- a --> <![CDATA[0.2 ]]>0.3",
        "0.1&#32;0.2&#10;0.3",
        "0.1 NaN 0.3",
    ] {
        let text = format!(
            "<CxF><Object Id=\"7\"><ReflectanceSpectrum StartWL=\"400\" Increment=\"10\">{list}</ReflectanceSpectrum></Object></CxF>"
        );
        let table = ok(&text);
        let mut wanted = vec![(400.0, 0.1), (410.0, 0.2), (420.0, 0.3)];
        wanted.retain(|(w, _)| *w != 410.0 || !list.contains("NaN"));
        assert_eq!((samples(&table, 0), names(&table)), (wanted, vec!["7"]), "{list}");
    }
    let wrong =
        "<CxF><Object><XSpectrum\nStartWL=\"400\" Increment=\"10\">\r\n0.1\r\n0.2 O.3 0.4</XSpectrum></Object></CxF>";
    assert_eq!(error(wrong), ReadError::NotANumber { line: 4, column: 1, text: "O.3".to_owned() });
}

#[test]
fn names_and_titles_are_unescaped() {
    let table = ok(&points("").replace("\"a\"", "'&quot;&#xB0;&quot; &lt;&amp;amp; b'"));
    assert_eq!(names(&table), ["\"°\" <&amp; b"]);
    let header = "<Header><Description>5 &gt; 4 &amp; <![CDATA[<b>]]></Description></Header>\n";
    let text = light("").replace("<SpectralDistribution>", &format!("{header}<SpectralDistribution>"));
    assert_eq!(names(&ok(&text)), ["5 > 4 & <b>"]);
}

#[test]
fn what_a_declaration_says_of_the_encoding_does_not_matter() {
    let text = |encoding: &str| {
        points("").replace("\"a\"", "\"µ\"").replacen(
            '<',
            &format!("<?xml version=\"1.0\" encoding=\"{encoding}\"?>\n<"),
            1,
        )
    };
    for encoding in ["utf-8", "UTF-16", "iso-8859-1", "no such", ""] {
        let text = text(encoding);
        let plain = ok(&text);
        assert_eq!((names(&plain), plain.reading.encoding), (vec!["µ"], Encoding::Utf8));
        let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
        let wide: Vec<u8> = std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
        for (bytes, encoding) in [(latin, Encoding::Windows1252), (wide, Encoding::Utf16Le)] {
            let other = read(&bytes, &ReadOptions::default()).unwrap();
            assert_eq!((other.reading.encoding, &other.curves), (encoding, &plain.curves));
        }
    }
}

#[test]
fn entities_of_the_file_are_refused_and_never_grow() {
    let mut bomb = String::from("<!DOCTYPE a [<!ENTITY e0 \"0123456789\">\n");
    for i in 1..30 {
        bomb += &format!("<!ENTITY e{i} \"{}\">\n", format!("&e{};", i - 1).repeat(10));
    }
    bomb += "]>\n";
    let line = bomb.lines().count() + 3;
    assert_eq!(error(&format!("{bomb}{}", points("&e29;"))), malformed(line, 1));
    let attribute = format!("{bomb}{}", points("").replace("\"a\"", "\"&e29;\""));
    assert!(matches!(error(&attribute), ReadError::Malformed { .. }));
    let unused =
        format!("<!DOCTYPE CxF SYSTEM \"http://nowhere/a>b.dtd\" [<!-- > --><!ELEMENT CxF ANY>]>\n{}", points(""));
    assert_eq!(ok(&unused).curves[0].values, [1.0, 3.0]);
    let outside = format!("<!DOCTYPE CxF [<!ENTITY f SYSTEM \"file:///etc/passwd\">]>{}", points("&f;"));
    assert!(matches!(error(&outside), ReadError::Malformed { .. }));
    for bad in ["&", "&#0;", "&#xD800;", "&#x110000;", "&amp", "&nbsp;"] {
        assert!(matches!(error(&points(bad)), ReadError::Malformed { line: 3, .. }), "{bad}");
    }
}

#[test]
fn broken_markup_is_placed() {
    let sound = light("");
    for (text, line, column) in [
        (sound.replace("</IESTM2714>\n", ""), 8, 1),
        (sound.replace("</SpectralDistribution>\n", ""), 7, 1),
        (sound.replace(">3</SpectralData>", ">µ3</spectraldata>"), 6, 34),
        (sound.replace("\"420\">3</SpectralData>", "\"420"), 6, 1),
        (sound.replace(">3</SpectralData>", ">3<!-- "), 6, 33),
        (sound.replace(">3</SpectralData>", "><![CDATA[3</SpectralData>"), 6, 32),
        (sound.replace('\n', "\r").replace("</IESTM2714>\r", ""), 8, 1),
        (sound.replace('\n', "\r\n").replace("</IESTM2714>\r\n", ""), 8, 1),
        (format!("{sound}\n<a/>"), 10, 1),
        (format!("{sound}</a>"), 9, 1),
        (format!("{sound} 380,1\n<!-- -->"), 8, 13),
        (format!("{}<", sound.trim_end()), 8, 13),
    ] {
        let found = read(text.as_bytes(), &ReadOptions { reader: Some(Reader::TM27), ..ReadOptions::default() });
        assert_eq!(found, Err(malformed(line, column)), "{text}");
    }
    let attribute = light("<SpectralData wavelength=410>2</SpectralData>");
    assert!(matches!(error(&attribute), ReadError::Malformed { line: 5, .. }));
    let missing = light("<SpectralData>2</SpectralData>");
    assert_eq!(error(&missing), ReadError::NotANumber { line: 5, column: 1, text: String::new() });
}

#[test]
fn the_root_element_decides_and_nothing_before_it() {
    let long = format!("<!-- <html> {} -->\n{}", "license ".repeat(2000), points(""));
    assert_eq!(ok(&long).reading.reader.value, Reader::CXF);
    for other in [
        "<!-- <CxF> -->\n<html><CxF/></html>",
        "<?xml version=\"1.0\"?><?CxF <CxF> ?>\n<svg/>",
        "<?xml version=\"1.0\"?>\n",
    ] {
        assert_eq!(error(other), ReadError::Unsupported(Family::Xml), "{other}");
    }
    let cut = "<?xml version=\"1.0\"?>\n<cc:CxF xmlns:cc=\"u";
    assert_eq!(error(cut), malformed(2, 1));
    let empty = "<CxF/>";
    assert_eq!(error(empty), ReadError::NoNumbers);
}

#[test]
fn several_lights_in_one_file() {
    let one = light("<SpectralData wavelength=\"410\">2.5</SpectralData>");
    let start = one.find("<SpectralDistribution>").unwrap();
    let end = one.find("</IESTM2714>").unwrap();
    let body = &one[start..end];
    let table = ok(&format!(
        "{}{body}{}</IESTM2714>",
        &one[..start],
        body.replace("wavelength=\"410", "wavelength=\"41&#x35;")
    ));
    assert_eq!((table.curves.len(), samples(&table, 0)), (2, THREE.to_vec()));
}

#[test]
fn lights_of_another_quantity_are_another_part() {
    let one =
        light("<SpectralQuantity>Transmittance</SpectralQuantity><SpectralData wavelength=\"410\">2.5</SpectralData>");
    let (start, end) = (one.find("<SpectralDistribution>").unwrap(), one.find("</IESTM2714>").unwrap());
    let other = one[start..end].replace("Transmittance", "Irradiance");
    let text = format!("{}{other}</IESTM2714>", &one[..end]);
    let first = ok(&text);
    assert_eq!((first.curves.len(), first.reading.parts.len()), (1, 2));
    assert!(matches!(first.warnings.as_slice(), [Warning::MoreTables(..)]), "{:?}", first.warnings);
    let part = |part| read(text.as_bytes(), &ReadOptions { part: Some(part), ..ReadOptions::default() });
    let second = part(2).unwrap();
    assert_eq!((second.curves.len(), second.role.value), (1, Role::Illuminant));
    assert_eq!((second.reading.quantity.value, second.warnings.len()), (Quantity::Irradiance, 0));
    assert_eq!(part(3), Err(ReadError::NoSuchPart { part: 3, parts: 2 }));
}

#[test]
fn specifications_count_wherever_they_stand() {
    let spectrum =
        "<Object Name=\"a\"><TransmittanceSpectrum ColorSpecification=\"s\">1 2 3</TransmittanceSpectrum></Object>";
    let range = "<ColorSpecification Id=\"s\"><WavelengthRange StartWL=\"400\" Increment=\"10\"/><WavelengthRange StartWL=\"1\"/></ColorSpecification>";
    for text in [format!("<CxF>{spectrum}{range}</CxF>"), format!("<CxF>{range}{spectrum}</CxF>")] {
        assert_eq!(ok(&text).curves[0].wavelengths_nm, [400.0, 410.0, 420.0]);
    }
    let other = format!("<CxF>\n{spectrum}{}</CxF>", range.replace("\"s\"", "\"t\""));
    assert_eq!(error(&other), ReadError::NoWavelengths(2));
}

#[test]
fn spectra_are_counted_as_they_come() {
    let body = "<Object><XSpectrum/></Object>\n".repeat(MAX_CURVES + 1) + "<broken";
    assert_eq!(error(&format!("<?xml version=\"1.0\"?><CxF>\n{body}")), ReadError::TooManyCurves(MAX_CURVES + 2));
    let one = "<SpectralDistribution><SpectralData wavelength=\"400\">1</SpectralData></SpectralDistribution>\n";
    let body = one.repeat(MAX_CURVES + 1) + "<broken";
    let text = format!("<?xml version=\"1.0\"?><IESTM27>\n{body}");
    assert_eq!(error(&text), ReadError::TooManyCurves(MAX_CURVES + 2));
}

#[test]
fn nesting_is_bounded() {
    let nested = |depth: usize| format!("<CxF>{}{}{}</CxF>", "<a>".repeat(depth), "<b/>", "</a>".repeat(depth));
    assert_eq!(error(&nested(150)), ReadError::NoNumbers);
    assert_eq!(error(&nested(100_000)), ReadError::Unsupported(Family::Xml));
}

/// Number of looks at the watch during a reading, and the last share reported.
fn looks(text: &str) -> (usize, f32, Result<SpectralFile, ReadError>) {
    let (count, last) = (Cell::new(0), Cell::new(0.0_f32));
    let look = |share: f32| {
        assert!(share >= last.get() && share <= 1.0, "{share} after {}", last.get());
        last.set(share);
        count.set(count.get() + 1);
        count.get() < 1_000
    };
    let table = read_watched(text.as_bytes(), &ReadOptions::default(), Watch::new(&look));
    (count.get(), last.get(), table)
}

#[test]
fn reading_can_be_watched_and_stopped() {
    let many = "<SpectralData wavelength=\"410\">2.5</SpectralData>\n".repeat(60_000);
    let list = format!(
        "<CxF><Object><XSpectrum StartWL=\"300\" Increment=\"0.001\">{}</XSpectrum></Object></CxF>",
        "0.25 ".repeat(600_000)
    );
    let comments = light(&"<!---->".repeat(400_000));
    let meter =
        format!("@a\n#b\n{}", (0..150_000).map(|i| format!("{}\n1\n", 30_000 + i)).collect::<Vec<_>>().concat());
    for text in [light(&many), list, comments, meter] {
        let (count, _, _) = looks(&text);
        assert!(count > text.len() / 300_000, "{count} looks at {} bytes", text.len());
        for after in [1, 2, count / 2] {
            let left = Cell::new(after);
            let look = |_| {
                left.set(left.get() - 1);
                left.get() > 0
            };
            assert_eq!(
                read_watched(text.as_bytes(), &ReadOptions::default(), Watch::new(&look)),
                Err(ReadError::Stopped)
            );
        }
    }
}

#[test]
fn the_layouts_of_other_tests_survive_other_line_ends() {
    for text in [layouts::TM27, layouts::CXF] {
        let plain = ok(&text.replace("\r\n", "\n"));
        for end in ["\r", "\r\n"] {
            let other = ok(&text.replace("\r\n", "\n").replace('\n', end));
            assert_eq!((&other.curves, other.reading.first_data_line), (&plain.curves, plain.reading.first_data_line));
            assert_eq!(other.warnings, plain.warnings);
        }
    }
}

#[test]
fn samples_of_the_first_version_of_cxf_have_single_values() {
    let of = |at: usize| {
        format!(
            "<Sample><Name>patch {at}</Name><SampleAttribute><Spectrum Conditions=\"{at}\">\n<Value Name=\"400\">0.{at}</Value>\n\
             <Value Name=\"410\">0.5</Value>\n</Spectrum></SampleAttribute></Sample>\n"
        )
    };
    let kind = |of: usize, kind: &str| {
        format!("<Conditions><ID>{of}</ID><Attribute Name=\"Physical.SpectrumType\">{kind}</Attribute></Conditions>\n")
    };
    let set = format!("<CXF Version=\"1.0\"><SampleSet><Name>set</Name>{}{}</SampleSet>", of(1), of(2));
    let table = ok(&format!("{set}{}{}</CXF>", kind(1, "AmbientLight"), kind(2, "Emission")));
    assert_eq!((names(&table), table.role.value), (vec!["patch 1", "patch 2"], Role::Illuminant));
    assert_eq!(samples(&table, 1), [(400.0, 0.2), (410.0, 0.5)]);
    // What is said of one of them is not said of the other.
    for others in [kind(2, "Reflectance"), kind(3, "AmbientLight"), String::new()] {
        let table = ok(&format!("{set}{}{others}</CXF>", kind(1, "AmbientLight")));
        assert_ne!(table.role.certainty, Certainty::Certain, "{others}");
    }
}
