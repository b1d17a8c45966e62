//! Families of files with a grammar of their own.

use spectral_file::{Reader, What};

use super::whole;

const CGATS: &str = "SPECT\n\nDESCRIPTOR \"Lamp 400\"\nSPECTRAL_BANDS \"4\"\nSPECTRAL_START_NM \"400.0\"\n\
SPECTRAL_END_NM \"430.0\"\nSPECTRAL_NORM \"100.0\"\n\nNUMBER_OF_FIELDS 5\nBEGIN_DATA_FORMAT\n\
SAMPLE_ID SPEC_400 SPEC_410 SPEC_420 SPEC_430\nEND_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n\
1 10 20 30 40\n2 11 12 13 10\nEND_DATA\n";

const PAIRS: &str = "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_NM SPECTRAL_DEC SPECTRAL_NM SPECTRAL_DEC \
SPECTRAL_NM SPECTRAL_DEC\nEND_DATA_FORMAT\nBEGIN_DATA\n\"A1\" 400 0.1 410 0.2 420 0.3\n\"A2\" 400 0.4 410 0.5 420 0.6\nEND_DATA\n";

const LABELS: &str = "Date,2024/04/00\nPPFD 400-700nm,12\nSpectral Data 5 400[nm],0.1\nSpectral Data 5 405[nm],0.2\n\
Spectral Data 5 410[nm],0.3\nSpectral Data 5 415[nm],0.4\nSpectral Data 5 420[nm],0.5\nSpectral Data 1 400[nm],0.1\n\
Spectral Data 1 401[nm],0.2\nSpectral Data 1 402[nm],0.15\nSpectral Data 1 403[nm],0.25\nSpectral Data 1 404[nm],0.35\n\
Spectral Data 1 405[nm],0.2\nCRI,400\n";

const ALTERNATE: &str = "@12/05/2024\n@400\n#Lamp\n400\n0.5\n405\n0.6\n410\n0.7\n415\n0.8\n";

const JCAMP_POINTS: &str = "##TITLE= 400 lamp\n##JCAMP-DX= 4.24\n##DATA TYPE= UV/VIS SPECTRUM\n##XUNITS= NANOMETERS\n\
##YUNITS= TRANSMITTANCE\n##XFACTOR= 1\n##YFACTOR= 0.5\n##NPOINTS= 4\n##XYPOINTS= (XY..XY)\n400, 0.1; 410, 0.2\n\
420, 0.3; 430, 0.4 $$ 400, 0.1\n##END=\n";

const JCAMP_BLOCKS: &str = "##TITLE= both\n##JCAMP-DX= 4.24\n##DATA TYPE= LINK\n##BLOCKS= 3\n\
##TITLE= x:dark\n##XUNITS= NANOMETERS\n##YUNITS= ARBITRARY\n##XYPOINTS= (XY..XY)\n400, 0\n410, 0\n420, 5\n##END=\n\
##TITLE= x:processed\n##XUNITS= NANOMETERS\n##YUNITS= ARBITRARY\n##XYPOINTS= (XY..XY)\n400, 0\n410, 0\n420, 7\n##END=\n\
##TITLE= x:reference\n##XUNITS= NANOMETERS\n##YUNITS= ARBITRARY\n##XYPOINTS= (XY..XY)\n400, 0\n410, 0\n420, 7\n##END=\n##END=\n";

const JCAMP_ORDINATES: &str = "##TITLE= lamp\n##JCAMP-DX= 4.24\n##XUNITS= NANOMETERS\n##YUNITS= TRANSMITTANCE\n\
##FIRSTX= 400\n##LASTX= 450\n##XFACTOR= 1\n##YFACTOR= 0.01\n##NPOINTS= 6\n##XYDATA= (X++(Y..Y))\n400 10 20 30\n430 40 50 60\n##END=\n";

const JCAMP_SQUEEZED: &str = "##TITLE= lamp\n##JCAMP-DX= 4.24\n##XUNITS= NANOMETERS\n##YUNITS= TRANSMITTANCE\n\
##FIRSTX= 400\n##LASTX= 450\n##XFACTOR= 1\n##YFACTOR= 0.01\n##NPOINTS= 6\n##XYDATA= (X++(Y..Y))\n400A0J0J0\n430D0J0J0\n##END=\n";

const TM27: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<IESTM2714 version=\"1.0\">\n<Header><Description>400 lamp</Description></Header>\n\
<SpectralDistribution><SpectralQuantity>radiance</SpectralQuantity>\n<BandwidthFWHM>5</BandwidthFWHM>\n\
<SpectralData wavelength=\"400\">0.1</SpectralData>\n<SpectralData wavelength=\"405.5\">\n2e-3</SpectralData><SpectralData wavelength='410'>0.3</SpectralData>\n\
</SpectralDistribution>\n</IESTM2714>\n";

const CXF: &str = "<?xml version=\"1.0\"?>\n<cc:CxF xmlns:cc=\"http://colorexchangeformat.com/CxF3-core\">\n<cc:Resources><cc:ObjectCollection>\n\
<cc:Object Name=\"one\" Id=\"1\"><cc:ColorValues><cc:ReflectanceSpectrum StartWL=\"400\" Increment=\"10\">0.1 0.2 0.3\n0.4</cc:ReflectanceSpectrum>\n\
</cc:ColorValues></cc:Object>\n<cc:Object Name=\"two\" Id=\"2\"><cc:ColorValues><cc:ReflectanceSpectrum StartWL=\"400\" Increment=\"10\">0.5 0.2 0.3 0.4\
</cc:ReflectanceSpectrum></cc:ColorValues></cc:Object>\n</cc:ObjectCollection></cc:Resources>\n</cc:CxF>\n";

const ACES: &str = "{\n\"header\": {\"manufacturer\": \"M\", \"model\": \"400\"},\n\"spectral_data\": {\"units\": \"relative\", \
\"index\": {\"main\": [\"R\", \"G\", \"B\"]},\n\"data\": {\"main\": {\n\"400\": [0.1, 0.2, 0.3],\n\"410\": [0.4,\n0.5, 0.6], \"420\": [0.7, 0.8, 0.9]\n}}}}\n";

const DCAMPROF: &str = "// made 2024\n{\n\"camera_name\": \"C 400\",\n\"ssf_bands\": [400, 440, 10],\n\"red_ssf\": [0.1, 0.2, 0.3, 0.4, 0.5],\n\
\"green_ssf\": [\n0.2,\n0.3,\n0.4, 0.5, 0.1],\n\"blue_ssf\": [0.1, 0.2, 0.3, 0.4, 0.6]\n}\n";

const SPECTRUM: &str = "{\n\"bands\": [400, 410, 420, 430],\n\"scale\": 2,\n\"spectrum\": [0.1, 0.2, 0.3, 0.5]\n}\n";

const SVC: &str = "/*** Spectra Vista SIG Data ***/\nname= leaf 400.sig\ndata= \n400.0  9.0  8.0  5.0\n420.0  9.0  8.0  6.0\n\
410.0  9.0  8.0  7.0\n430.0  9.0  8.0  8.0\n";

const PERKIN_ELMER: &str = "PE UV       SUBTECH     SPECTRUM    ASCII       PEDS        4.00        \n400\n#GR\nnm\n%T\n1.0\n0.0\n\
420.0\n-10.0\n3\n#DATA\n420.0\t5.0\n410.0\t6.0\n400.0\t7.0\n";

const LISTS: &str = "{\n\"wavelengths\": [400, 410, 420, 430],\n\"reflectance\": [0.1, 0.2, 0.3, 0.5],\n\"leaf\": {\"reflectance\": [0.3, 0.2, 0.3, 0.4]}\n}\n";
const RECORDS: &str =
    "[{\"wavelength\": 400, \"R\": 0.1},\n{\"wavelength\": 410, \"R\": 0.2},\n{\"wavelength\": 420, \"R\": 0.4}]\n";

pub(super) const ALL: [&str; 17] = [
    LISTS,
    RECORDS,
    SVC,
    PERKIN_ELMER,
    CGATS,
    PAIRS,
    LABELS,
    ALTERNATE,
    JCAMP_POINTS,
    JCAMP_BLOCKS,
    JCAMP_ORDINATES,
    JCAMP_SQUEEZED,
    TM27,
    CXF,
    ACES,
    DCAMPROF,
    SPECTRUM,
];

#[test]
fn cgats_fields_and_sets() {
    let seen = whole(CGATS.as_bytes());
    assert_eq!(seen.table.reading.reader.value, Reader::CGATS);
    assert_eq!(seen.pieces(3), [("DESCRIPTOR \"Lamp 400\"", What::Setting)]);
    let format: Vec<&str> = seen.pieces(11).into_iter().map(|(piece, _)| piece).collect();
    assert_eq!(format, ["400", "410", "420", "430"]);
    assert_eq!(seen.pieces(15)[0].0, "10");
    assert_eq!(seen.pieces(15).len(), 4);
}

#[test]
fn cgats_pairs() {
    let seen = whole(PAIRS.as_bytes());
    assert_eq!(seen.pieces(6).len(), 6);
    assert_eq!(seen.pieces(6)[0].1, What::Wavelength(400.0));
}

#[test]
fn only_the_finer_block_of_labels_is_marked() {
    let seen = whole(LABELS.as_bytes());
    assert_eq!(seen.table.curves[0].values.len(), 6);
    assert_eq!(seen.pieces(3), []);
    assert_eq!(seen.pieces(8)[0], ("400", What::Wavelength(400.0)));
    assert!(!seen.pieces(14).iter().any(|(_, what)| *what != What::Setting));
}

#[test]
fn alternate_lines() {
    let seen = whole(ALTERNATE.as_bytes());
    assert_eq!(seen.pieces(4), [("400", What::Wavelength(400.0))]);
    assert_eq!(seen.pieces(2), [("@400", What::Setting)]);
}

#[test]
fn the_ratio_of_a_field_spectrometer() {
    let seen = whole(SVC.as_bytes());
    let value = What::Value { curve: 0, nm: 400.0, value: 0.05, written: 5.0 };
    assert_eq!(seen.pieces(4), [("400.0", What::Wavelength(400.0)), ("5.0", value)]);
    assert_eq!(seen.pieces(6), [], "its detector's range is left to the other");
    assert_eq!(seen.table.curves[0].wavelengths_nm, [400.0, 430.0]);
}

#[test]
fn pairs_below_a_header_without_labels() {
    let seen = whole(PERKIN_ELMER.as_bytes());
    assert_eq!((seen.pieces(2), seen.pieces(8)), (vec![("400", What::Setting)], vec![]));
    assert_eq!(seen.pieces(12)[1].1, What::Value { curve: 0, nm: 420.0, value: 0.05, written: 5.0 });
}

#[test]
fn jcamp_points_with_a_factor() {
    let seen = whole(JCAMP_POINTS.as_bytes());
    assert_eq!(seen.pieces(10)[1].1, What::Value { curve: 0, nm: 400.0, value: 0.05, written: 0.1 });
    assert_eq!(seen.pieces(11).len(), 4, "the remark is no data");
    assert_eq!(seen.pieces(1), [("##TITLE= 400 lamp", What::Setting)]);
}

#[test]
fn jcamp_blocks_that_begin_alike() {
    let seen = whole(JCAMP_BLOCKS.as_bytes());
    assert_eq!(seen.table.curves.len(), 1);
    assert_eq!(seen.pieces(9), []);
    assert_eq!(seen.pieces(17).len(), 2);
    assert_eq!(seen.pieces(25), []);
}

#[test]
fn jcamp_ordinates() {
    let seen = whole(JCAMP_ORDINATES.as_bytes());
    assert_eq!(seen.pieces(12)[0], ("430", What::Wavelength(430.0)));
    assert_eq!(seen.pieces(12).len(), 4);
}

#[test]
fn squeezed_jcamp_is_marked_by_lines() {
    let seen = super::Seen::new(JCAMP_SQUEEZED.as_bytes());
    assert_eq!(seen.pieces(11), [("400A0J0J0", What::Block(0))]);
    assert_eq!(seen.said(12), ["430D0J0J0 = lamp: compressed values"]);
}

#[test]
fn xml_attributes_and_lists() {
    let seen = whole(TM27.as_bytes());
    assert_eq!(seen.pieces(6)[0], ("400", What::Wavelength(400.0)));
    let seen = whole(CXF.as_bytes());
    assert_eq!(seen.pieces(4).len(), 3);
}

#[test]
fn json_keys_and_lists() {
    let seen = whole(ACES.as_bytes());
    assert_eq!(seen.pieces(5).len(), 4);
    whole(DCAMPROF.as_bytes());
    let seen = whole(SPECTRUM.as_bytes());
    assert_eq!(seen.pieces(2).len(), 4);
    assert_eq!(seen.pieces(3), []);
    let seen = whole(LISTS.as_bytes());
    assert_eq!([2, 3, 4].map(|line| seen.pieces(line).len()), [4, 4, 4]);
    let seen = whole(RECORDS.as_bytes());
    assert_eq!([1, 2, 3].map(|line| seen.pieces(line).len()), [2, 2, 2]);
}

#[test]
fn a_database_of_cameras() {
    let line = |scale: f64| (0..33).map(|i| (f64::from(i) * scale).to_string()).collect::<Vec<_>>().join(" ");
    let camera = |name: &str, scale: f64| format!("{name}\n{}\n{}\n{}\n", line(scale), line(2.0 * scale), line(scale));
    let seen = whole(format!("{}{}", camera("One 400", 0.01), camera("Two", 0.03)).as_bytes());
    assert_eq!(seen.pieces(4).len(), 33);
    assert_eq!(seen.pieces(5), []);
}
