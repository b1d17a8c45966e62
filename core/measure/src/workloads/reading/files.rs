//! Files of every family, of a given size, with numbers that follow from their places.

use std::fmt::Write;

use spectral_file::MAX_CURVES;

/// A file and what is in it.
pub(crate) struct File {
    pub(crate) name: &'static str,
    pub(crate) text: String,
    pub(crate) curves: usize,
    pub(crate) samples: usize,
    /// The value of a curve at a sample.
    pub(crate) value: fn(usize, usize) -> f64,
    /// Settings of the `csv` crate.
    pub(crate) separator: u8,
    pub(crate) comma: bool,
}

/// Wavelengths of the files with many curves: 380 to 780 nm by 1 nm.
const WAVELENGTHS: usize = 401;

/// All files, each made for a number of bytes.
pub(crate) fn files() -> [fn(usize) -> File; 15] {
    [
        long_numbers,
        down,
        across,
        decimal_comma,
        cgats,
        jcamp_pairs,
        jcamp_squeezed,
        tm27,
        cxf_lists,
        cxf_points,
        rawtoaces,
        dcamprof,
        labels,
        alternate,
        camspec,
    ]
}

/// A whole number below a million for a place.
fn integer(curve: usize, sample: usize) -> u32 {
    let mut x =
        (curve as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (sample as u64).wrapping_mul(0xD1B5_4A32_D192_ED03);
    x = (x ^ (x >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((x >> 33) % 1_000_000) as u32
}

/// It as six digits, to stand behind the decimal mark.
pub(crate) fn digits(curve: usize, sample: usize) -> String {
    format!("{:06}", integer(curve, sample))
}

fn millionths(curve: usize, sample: usize) -> f64 {
    f64::from(integer(curve, sample)) / 1e6
}

/// A fraction with all the digits a double has.
fn fraction(curve: usize, sample: usize) -> f64 {
    f64::from(integer(curve, sample)) / 1_000_003.0
}

fn file(name: &'static str, text: String, curves: usize, samples: usize) -> File {
    File { name, text, curves, samples, value: millionths, separator: b',', comma: false }
}

/// Rows of wavelengths, a column for each curve.
fn columns(curves: usize, samples: usize, separator: char, cell: impl Fn(usize, usize) -> String) -> String {
    let mut text = String::from("nm");
    for curve in 0..curves {
        write!(text, "{separator}c{curve}").expect("a string takes any text");
    }
    for sample in 0..samples {
        write!(text, "\n{}", 380 + sample).expect("a string takes any text");
        for curve in 0..curves {
            text.push(separator);
            text += &cell(curve, sample);
        }
    }
    text + "\n"
}

fn long_numbers(bytes: usize) -> File {
    let (cell, samples) = (22, 545);
    let curves = bytes / (cell * samples);
    let text = columns(curves, samples, ',', |curve, sample| format!("{:.16e}", fraction(curve, sample)));
    File { value: fraction, ..file("CSV, 5000 curves, 17 digits", text, curves, samples) }
}

fn down(bytes: usize) -> File {
    let curves = bytes / (9 * WAVELENGTHS);
    let text = columns(curves, WAVELENGTHS, ',', |curve, sample| format!("0.{}", digits(curve, sample)));
    file("CSV, 6 digits", text, curves, WAVELENGTHS)
}

fn decimal_comma(bytes: usize) -> File {
    let curves = bytes / (9 * WAVELENGTHS);
    let text = columns(curves, WAVELENGTHS, ';', |curve, sample| format!("0,{}", digits(curve, sample)));
    File { separator: b';', comma: true, ..file("semicolons, decimal commas", text, curves, WAVELENGTHS) }
}

/// The values of a curve in a row.
fn row(text: &mut String, curve: usize, separator: &str) {
    for sample in 0..WAVELENGTHS {
        write!(text, "{separator}0.{:06}", integer(curve, sample)).expect("a string takes any text");
    }
    text.push('\n');
}

/// Values of a row for each wavelength.
fn heads(each: impl Fn(usize) -> String) -> String {
    (0..WAVELENGTHS).map(|sample| each(380 + sample)).collect()
}

fn across(bytes: usize) -> File {
    let curves = bytes / (9 * WAVELENGTHS);
    let mut text = format!("name{}\n", heads(|nm| format!(",{nm}")));
    for curve in 0..curves {
        write!(text, "c{curve}").expect("a string takes any text");
        row(&mut text, curve, ",");
    }
    file("CSV, wavelengths across", text, curves, WAVELENGTHS)
}

fn cgats(bytes: usize) -> File {
    let curves = bytes / (9 * WAVELENGTHS);
    let fields = heads(|nm| format!(" SPEC_{nm}"));
    let mut text = format!(
        "CGATS.17\nSPECTRAL_NORM \"1.0\"\nNUMBER_OF_FIELDS {}\nBEGIN_DATA_FORMAT\nSAMPLE_ID{fields}\nEND_DATA_FORMAT\n\
         NUMBER_OF_SETS {curves}\nBEGIN_DATA\n",
        WAVELENGTHS + 1
    );
    for curve in 0..curves {
        write!(text, "c{curve}").expect("a string takes any text");
        row(&mut text, curve, " ");
    }
    File { separator: b' ', ..file("CGATS", text + "END_DATA\n", curves, WAVELENGTHS) }
}

/// The wavelength of a sample in a file with one curve, in ten thousandths of a nanometer.
fn fine(sample: usize) -> String {
    let tenths = 3_000_000 + 2 * sample;
    format!("{}.{:04}", tenths / 10_000, tenths % 10_000)
}

/// A file of one curve: what stands above, a line for each sample of about some bytes, what stands below.
fn lines(name: &'static str, bytes: usize, line: usize, around: [&str; 2], each: impl Fn(usize, &mut String)) -> File {
    let samples = bytes / line;
    let mut text = around[0].to_owned();
    for sample in 0..samples {
        each(sample, &mut text);
    }
    file(name, text + around[1], 1, samples)
}

fn jcamp_pairs(bytes: usize) -> File {
    let head = "##TITLE= a\n##JCAMP-DX= 5\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##XYPOINTS= (XY..XY)\n";
    lines("JCAMP, pairs", bytes, 19, [head, "##END=\n"], |sample, text| {
        writeln!(text, "{}, 0.{}", fine(sample), digits(0, sample)).expect("a string takes any text");
    })
}

/// Differences and repeated checks, 30 values in a line.
fn jcamp_squeezed(bytes: usize) -> File {
    const IN_LINE: usize = 30;
    let samples = bytes / 7;
    let mut text = format!(
        "##TITLE= a\n##JCAMP-DX= 4.24\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##XFACTOR= 1\n##YFACTOR= 0.000001\n\
         ##FIRSTX= 300\n##LASTX= {}\n##NPOINTS= {samples}\n##XYDATA= (X++(Y..Y))\n",
        300.0 + 0.000_05 * (samples - 1) as f64
    );
    let squeezed = |number: i64, [zero, above, below]: [u8; 3]| {
        let digits = number.unsigned_abs().to_string();
        let first = digits.as_bytes()[0] - b'0';
        let lead = if number == 0 { zero } else { first - 1 + if number > 0 { above } else { below } };
        format!("{}{}", char::from(lead), &digits[1..])
    };
    for start in (0..samples).step_by(IN_LINE) {
        // Every line but the first repeats the last value of the line before.
        let from = start.saturating_sub(1);
        write!(text, "{}", fine(from)).expect("a string takes any text");
        text += &squeezed(integer(0, from).into(), *b"@Aa");
        for sample in from + 1..(start + IN_LINE).min(samples) {
            text += &squeezed(i64::from(integer(0, sample)) - i64::from(integer(0, sample - 1)), *b"%Jj");
        }
        text.push('\n');
    }
    File {
        value: |curve, sample| f64::from(integer(curve, sample)) * 0.000_001,
        ..file("JCAMP, squeezed", text + "##END=\n", 1, samples)
    }
}

fn tm27(bytes: usize) -> File {
    let head = "<?xml version=\"1.0\"?>\r\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\r\n\t<Header>\r\n\
                \t\t<Description>a</Description>\r\n\t</Header>\r\n\t<SpectralDistribution>\r\n";
    let around = [head, "\t</SpectralDistribution>\r\n</IESTM2714>\r\n"];
    lines("TM-27", bytes, 63, around, |sample, text| {
        let (wavelength, digits) = (fine(sample), digits(0, sample));
        writeln!(text, "\t\t<SpectralData wavelength=\"{wavelength}\">0.{digits}</SpectralData>\r")
            .expect("a string takes any text");
    })
}

const CXF: &str =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<cc:CxF xmlns:cc=\"urn:any\">\n<cc:Resources><cc:ObjectCollection>\n";

fn cxf_lists(bytes: usize) -> File {
    let samples = 101;
    let curves = bytes / (180 + 9 * samples);
    let mut text = CXF.to_owned();
    for curve in 0..curves {
        let values: Vec<String> = (0..samples).map(|sample| format!("0.{}", digits(curve, sample))).collect();
        write!(
            text,
            "<cc:Object ObjectType=\"Standard\" Name=\"c{curve}\" Id=\"{curve}\"><cc:ColorValues>\n<cc:ReflectanceSpectrum \
             ColorSpecification=\"s\" StartWL=\"380\">{}</cc:ReflectanceSpectrum></cc:ColorValues></cc:Object>\n",
            values.join(" ")
        )
        .expect("a string takes any text");
    }
    text += "</cc:ObjectCollection><cc:ColorSpecificationCollection><cc:ColorSpecification Id=\"s\"><cc:WavelengthRange \
             StartWL=\"380\" Increment=\"4\"/></cc:ColorSpecification></cc:ColorSpecificationCollection></cc:Resources></cc:CxF>\n";
    File { separator: b' ', ..file("CxF, lists of 101", text, curves, samples) }
}

fn cxf_points(bytes: usize) -> File {
    let curves = bytes / (100 + 55 * WAVELENGTHS);
    let mut text = CXF.to_owned();
    for curve in 0..curves {
        writeln!(text, "<cc:Object ObjectType=\"Standard\" Name=\"c{curve}\" Id=\"{curve}\"><cc:CustomSpectrum>")
            .expect("a string takes any text");
        for sample in 0..WAVELENGTHS {
            let (nm, digits) = (380 + sample, digits(curve, sample));
            writeln!(text, "<cc:SpectralPoint WL=\"{nm}\">0.{digits}</cc:SpectralPoint>")
                .expect("a string takes any text");
        }
        text += "</cc:CustomSpectrum></cc:Object>\n";
    }
    file("CxF, points", text + "</cc:ObjectCollection></cc:Resources></cc:CxF>\n", curves, WAVELENGTHS)
}

fn rawtoaces(bytes: usize) -> File {
    let curves = bytes / (10 * WAVELENGTHS);
    let list = |each: &dyn Fn(usize) -> String| (0..curves).map(each).collect::<Vec<_>>().join(", ");
    let names = list(&|curve| format!("\"c{curve}\""));
    let mut text = format!(
        "{{\n\"header\": {{ \"schema_version\": \"1.0.0\" }},\n\"spectral_data\": {{ \"units\": \"relative\",\n\
         \"index\": {{ \"main\": [{names}] }},\n\"data\": {{ \"main\": {{\n"
    );
    for sample in 0..WAVELENGTHS {
        let end = if sample + 1 < WAVELENGTHS { "," } else { "" };
        let values = list(&|curve| format!("0.{}", digits(curve, sample)));
        writeln!(text, "\"{}\": [{values}]{end}", 380 + sample).expect("a string takes any text");
    }
    file("rawtoaces JSON", text + "} } } }\n", curves, WAVELENGTHS)
}

fn dcamprof(bytes: usize) -> File {
    let samples = bytes / 30;
    let last = 300.0 + 0.000_25 * (samples - 1) as f64;
    let mut text = format!("{{\n\"camera_name\": \"a\", // made up\n\"ssf_bands\": [ 300, {last}, 0.00025 ],\n");
    for (curve, (name, end)) in [("red", ","), ("green", ","), ("blue", "\n}")].into_iter().enumerate() {
        let values: Vec<String> = (0..samples).map(|sample| format!("0.{}", digits(curve, sample))).collect();
        writeln!(text, "\"{name}_ssf\": [ {} ]{end}", values.join(", ")).expect("a string takes any text");
    }
    file("dcamprof JSON", text, 3, samples)
}

fn labels(bytes: usize) -> File {
    let head = "Date Saved,15/03/2021\nTitle,lamp\nTcp [K],3262\n\n";
    lines("labels", bytes, 37, [head, "TM-30 Bin 1,---\n"], |sample, text| {
        writeln!(text, "Spectral Data {}[nm],0.{}", fine(sample), digits(0, sample)).expect("a string takes any text");
    })
}

fn alternate(bytes: usize) -> File {
    lines("alternate lines", bytes, 20, ["@19/5/1997\n@12:00\n#lamp\n", ""], |sample, text| {
        write!(text, " {}\n 0.{}\n", fine(sample), digits(0, sample)).expect("a string takes any text");
    })
}

fn camspec(bytes: usize) -> File {
    let (channels, bands) = (3, 33);
    let cameras = (bytes / (channels * bands * 9)).min(MAX_CURVES / channels);
    let mut text = String::new();
    for camera in 0..cameras {
        writeln!(text, "Made up {camera}").expect("a string takes any text");
        for channel in 0..channels {
            let values: Vec<String> =
                (0..bands).map(|sample| format!("0.{}", digits(camera * channels + channel, sample))).collect();
            writeln!(text, "{}", values.join("\t")).expect("a string takes any text");
        }
    }
    File { separator: b'\t', ..file("cameras by name", text, cameras * channels, bands) }
}
