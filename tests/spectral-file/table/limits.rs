//! Every cut, every flipped bit and random splices of a small file of every layout, under every reader and every switch:
//! nothing panics, and what is read is sound. Files of families with a grammar of their own are cut and flipped with the
//! readers that the content requests beside the tests of those families.

use proptest::prelude::*;
use spectral_file::Reader;

use super::damage::{SOUND, check};
use super::*;

/// A file for each reader, as short as its traps allow.
const FAMILIES: [&str; 17] = [
    "{\"wavelengths\": [400, 410, 420], \"reflectance\": [0.1, 0.2, 0.3]}",
    "CGATS.17\nSPECTRAL_NORM \"100\"\nBEGIN_DATA_FORMAT\nSAMPLE_NAME nm400 nm410\nEND_DATA_FORMAT\nBEGIN_DATA\n\
     \"a \"\"b\" 5 -9999 # c\nd 5,5 6,5\nEND_DATA\nCAL\n",
    "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_NM SPECTRAL_PCT SPECTRAL_NM SPECTRAL_PCT\nEND_DATA_FORMAT\nBEGIN_DATA\n\
     1 400 5 410 6\nEND_DATA\n",
    "##TITLE= a\n##DATA TYPE= LINK\n##TITLE= PROCESSED\n##JCAMP-DX= 5 $$b\n##XUNITS= NANOMETERS\n##YUNITS= Transmission (%)\n\
     ##NPOINTS= 2\n##XYPOINTS= (XY..XY)\n400.5, 25.0; 401,30\n##END=\n##END=\n",
    "##TITLE= a\n##XUNITS= NANOMETERS\n##YFACTOR= 0.001\n##FIRSTX= 400\n##LASTX= 440\n##NPOINTS= 5\n##XYDATA= (X++(Y..Y))\n\
     400A00J0T%\n430A20p0\n##END=\n",
    "<?xml version=\"1.0\" encoding=\"utf-16\"?><IESTM2714 xmlns=\"a\"><Header><Description>b &amp; c</Description></Header>\
     <SpectralDistribution><SpectralData wavelength=\"400\">1</SpectralData><SpectralData wavelength='4&#49;0'>2</SpectralData>\
     </SpectralDistribution></IESTM2714>",
    "<!DOCTYPE a [<!ENTITY b \"c\">]><d:CxF><Object Name=\"e\"><XSpectrum StartWL=\"400\" Increment=\"1\">1 <!-- f --><![CDATA[2]]>\
     </XSpectrum><XSpectrum><SpectralPoint WL=\"400\">1</SpectralPoint></XSpectrum></Object></d:CxF>",
    "{\"header\":{\"model\":\"a\"},\"spectral_data\":{\"units\":\"relative\",\"index\":{\"main\":[\"R\",\"G\"]},\
     \"data\":{\"main\":{\"400\":[0.1,0.2],\"390\":[0.3,0.4]}}}}",
    "// a\n{\"ssf_bands\":[400,420,10], // b\n\"red_ssf\":[0.1,0.5,1],\"green_ssf\":[1,2,3],\"blue_ssf\":[3,2,1]}",
    "{\"bands\":[400,410,420],\"scale\":0.5,/* a */\"spectrum\":[1,2,3]}",
    "{\"metadata\":{\"Label\":\"a\",\"Technique\":\"Reflectance\"},\"spectrometerSettings\":{\"wavelengths\":[400,410,420]},\
     \"spectrum\":{\"dark\":null,\"processed\":[1,null,3],\"raw\":[1,2,3]}}",
    "Title,a\nSpectral Data 380[nm],0.1\nSpectral Data 381[nm],0.2\nSpectral Data 382[nm],---\nSpectral Data 383[nm],1\n\
     Spectral Data 384[nm],2\nSpectral Data 385[nm],3\n",
    "@1/5/97\n#No Title\n 2.5E+02\n 0.0E+00\n 2.51E+02\n 1,5E-04\n",
    "A 1D\r\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1\r\n\
     0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1 0\r\n\
     1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\r\n",
    "/*** Spectra Vista SIG Data ***/\nname= a.sig\nunits= Radiance, Radiance\ndata= \n400.0  1.0  2.0  5.0\n420.0  1.0  2.0  6.0\n\
     410.0  1.0  2,0  NaN\n430.0  1.0  2.0  8.0\n",
    "PE UV       SUBTECH     SPECTRUM    ASCII       PEDS        4.00        \n  -1\na.asc\n#HDR\n-1\n#GR\nnm\n%R\n1.0\n0.0\n410.0\n-10.0\n2\n\
     #DATA\n410.0\t5.0\n400,0\t6.0\n",
    "CC glasses\nNM G1 2 1 1.5 60 0\nED 1 0 1\nIT 0.4 0.9 25\nIT 0.41 0.91 25\nNM G2 2 1 1.5 60 0\nED 1 0 1\nIT 0.4 0.8 10\n\
     IT 0.42 0.7 10\n",
];

/// All files in UTF-8, the short ones in UTF-16 and with NUL bytes and letters of Windows-1252 among them too.
fn sound() -> Vec<Vec<u8>> {
    let mut all: Vec<Vec<u8>> = SOUND.iter().chain(&FAMILIES).map(|text| text.as_bytes().to_vec()).collect();
    for text in ["nm;R (µm)\n0,4;1\n0,5;3\n", "@1\n400\n1\n410\n2\n"] {
        let wide = |bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(bytes).collect()
        };
        all.push(wide(u16::to_le_bytes));
        all.push(wide(u16::to_be_bytes));
        let latin = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap());
        all.push(latin.chain([0, 0, 0]).collect());
    }
    all
}

#[test]
fn every_format_is_recognized_and_has_words() {
    let table = "400,1\n410,2\n420,3\n";
    let tidy = "sample,nm,R\nleaf,400,1\nleaf,410,2\nleaf,420,3\nbark,400,4\nbark,410,5\nbark,420,6\n";
    let readers: Vec<Reader> =
        FAMILIES.iter().chain(&[table, tidy]).map(|text| ok(text).reading.reader.value).collect();
    for reader in Reader::ALL {
        let (key, label) = (reader.key, reader.label);
        assert!(readers.contains(&reader), "no file is {reader}");
        assert!(!label.is_empty() && !reader.to_string().is_empty() && key.bytes().all(|c| c.is_ascii_alphanumeric()));
        let word = serde_json::to_value(reader).unwrap();
        assert_eq!(word, key);
        assert_eq!(serde_json::from_value::<Reader>(word).unwrap(), reader);
        let alike = |other: &&Reader| other.key == key || other.label == label;
        assert_eq!(Reader::ALL.iter().filter(alike).count(), 1, "{key}");
    }
    assert!(serde_json::from_str::<Reader>("\"word\"").is_err());
}

#[test]
fn every_cut_under_every_reader() {
    for bytes in sound() {
        for end in 0..bytes.len() {
            check(&bytes[..end], &ReadOptions::default());
            let reader = Some(Reader::ALL[end % Reader::ALL.len()]);
            let _ = read(&bytes[..end], &ReadOptions { reader, ..ReadOptions::default() });
            let _ = read(&bytes[end..], &ReadOptions { reader, ..ReadOptions::default() });
        }
    }
}

#[test]
fn every_flipped_bit() {
    for mut bytes in sound() {
        for at in 0..bytes.len() {
            for bit in 0..8 {
                bytes[at] ^= 1 << bit;
                check(&bytes, &ReadOptions::default());
                bytes[at] ^= 1 << bit;
            }
        }
    }
}

/// Pieces of files one after the other, whatever family they are of.
fn spliced() -> impl Strategy<Value = Vec<u8>> {
    let piece = (prop::sample::select(sound()), any::<prop::sample::Index>(), 0..200_usize);
    prop::collection::vec(piece, 1..5).prop_map(|pieces| {
        let cut = pieces.into_iter().enumerate().flat_map(|(index, (bytes, at, length))| {
            // The first piece is a beginning, by which a family is known.
            let from = if index == 0 { 0 } else { at.index(bytes.len()) };
            let to = if index == 0 { 1 + at.index(bytes.len()) } else { (from + length).min(bytes.len()) };
            bytes[from..to].to_vec()
        });
        cut.collect()
    })
}

fn switches() -> impl Strategy<Value = ReadOptions> {
    (
        prop::option::weighted(0.3, prop::sample::select(Reader::ALL.to_vec())),
        prop::option::weighted(0.3, 0..40_usize),
        prop::option::weighted(0.3, 0..4_usize),
        prop::option::weighted(0.2, Just(Role::Transmittance)),
        any::<Option<bool>>(),
    )
        .prop_map(|(reader, wavelength_column, part, role, raw)| ReadOptions {
            reader,
            wavelength_column,
            part,
            role,
            raw,
            ..ReadOptions::default()
        })
}

proptest! {
    #[test]
    fn splices_are_survived(bytes in spliced(), options in switches()) {
        check(&bytes, &options);
    }

    #[test]
    fn switches_are_survived(bytes in prop::sample::select(sound()), options in switches()) {
        check(&bytes, &options);
    }
}
