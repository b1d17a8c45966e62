//! Tables of numbers as instruments write them: what stands around the numbers, and which columns are taken.

use spectral_file::{Certainty, Orientation, Quantity, ReadOptions, Role, Values, Warning, read};

use super::{names, note, ok, samples};

/// Rows `wavelength separator value` of a made-up curve.
fn rows(separator: &str, count: u32) -> String {
    let row = |i| format!("{}.50{separator}{}.25\r\n", 400 + i, 10 + i);
    (0..count).map(row).collect::<Vec<_>>().concat()
}

#[test]
fn stellarnet_says_what_it_measured() {
    let file = |mode: &str| {
        format!(
            "\" File: Some\\Path\\To\n\" {mode}->  Wave:734.22nm  Pix:1050  Val: 57.710  Time:186ms  Xt:1  Ch:1\n \
             339.00  1.0000E-003\n 339.50  -7.7101E+001\n 340.00  5.0000E+001\n"
        )
    };
    let table = ok(&file("TRANS"));
    assert_eq!(samples(&table, 0), [(339.0, 1e-5), (339.5, -0.77101), (340.0, 0.5)]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Transmittance, Certainty::Certain));
    assert_eq!(table.reading.values.certainty, Certainty::Certain);
    assert_eq!(note(&table, "Program"), Some("a file of StellarNet SpectraWiz"));
    let scope = ok(&file("SCOPE"));
    assert_eq!((scope.role.value, scope.curves[0].values[2]), (Role::Unknown, 50.0));
    assert_eq!(scope.reading.quantity.value, Quantity::Counts);
    assert_eq!(ok(&file("REFL")).role.value, Role::Reflectance);
    assert_eq!(ok(&file("IRRAD")).reading.quantity.value, Quantity::Irradiance);
    let absorbed = ok(&file("ABSORB").replace("-7.7101E+001", "1.0"));
    assert_eq!((absorbed.role.value, absorbed.role.certainty), (Role::Transmittance, Certainty::Guess));
    assert_eq!((absorbed.reading.values.value, absorbed.curves[0].values[1]), (Values::Absorbance, 0.1));
}

#[test]
fn ocean_programs_in_any_language() {
    let english = format!(
        "SpectraSuite Data File\r\n+++++++\r\nReference Spectrum Present: Yes\r\nSpectra Averaged: 50 (USB4A1)\r\n\
         >>>>>Begin Processed Spectral Data<<<<<\r\n{}>>>>>End Processed Spectral Data<<<<<\r\n",
        rows("\t", 9)
    );
    let table = ok(&english);
    assert_eq!((table.curves[0].values.len(), table.curves[0].values[0]), (9, 0.1025));
    assert_eq!(note(&table, "Program"), Some("a file of Ocean SpectraSuite"));
    assert_eq!(table.warnings, [Warning::TextBelow(15)]);
    let spanish = format!(
        "Archivo De Datos\r\n+++++++\r\nFecha: x\r\nIntegraci\u{f3}n (usec): 50 (USB4A1)\r\n\
         >>>>> Comienza Data<<<<< Espectral Procesado\r\n{}>>>>> Termine Data<<<<<\r\n",
        rows("\t", 9).replace('.', ",").replace(",25", ",25E00")
    );
    let latin: Vec<u8> = spanish.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    let other = read(&latin, &ReadOptions::default()).unwrap();
    // Words in another language do not say whether there was a reference.
    assert_eq!((other.role.certainty, other.curves[0].values[0]), (Certainty::Open, 10.25));
    assert_eq!(note(&other, "Program"), Some("a file of an Ocean program"));
    let mixed = "Data from a.txt Node\n\rDate: x\nUser: y\n>>>>>Begin Spectral Data<<<<<\n1.8792E2\t18.995E0\r\n1.8839E2\t33.852E0\r\n";
    let view = ok(mixed);
    assert_eq!((view.reading.range_nm, view.curves[0].values[0]), ([187.92, 188.39], 18.995));
    assert_eq!(note(&view, "Program"), Some("a file of Ocean OceanView"));
}

#[test]
fn the_processed_column_is_taken() {
    let jaz = "Jaz Data File\n++++\nReference Spectrum Present: Yes\n>>>>>Begin Processed Spectral Data<<<<<\n\
               W\tD\tR\tS\tP\n400.853500\t10.5\t20.5\t15.5\t50.0\n401.231918\t10.5\t20.5\t14.5\t40.0\n";
    let table = ok(jaz);
    assert_eq!((names(&table), samples(&table, 0)), (vec!["P"], vec![(400.8535, 0.5), (401.231_918, 0.4)]));
    assert_eq!(note(&table, "Columns"), Some("“P”"));
    let all = read(jaz.as_bytes(), &ReadOptions { raw: Some(true), ..ReadOptions::default() }).unwrap();
    assert_eq!(names(&all), ["D", "R", "S", "P"]);
    let avantes = "1305084U1-\r\nIntegration time: 150.00 ms\r\nAverage: 10 scans\r\n\
        Data measured with spectrometer name: 1305084U1\0\0\0\0\0\0\r\nWave   ;Dark     ;Ref      ;Sample   ;Transmittance\r\n\
        [nm]   ;[counts] ;[counts] ;[counts] ;[% transmittance] \r\n275.27;768.60;885.60;795.90;23.333\r\n\
        275.87;790.30;885.92;808.92;19.477\r\n";
    let table = ok(avantes);
    assert_eq!((names(&table), table.curves[0].values[0]), (vec!["Transmittance"], 0.233_33));
    assert_eq!(table.warnings, [Warning::Invisible]);
    let french = avantes.replace('.', ",");
    assert_eq!(ok(&french).curves, table.curves);
    let wasatch = "ENLIGHTEN Version,2.2.7\nTechnique,Transmission\nCCD C0,247.9385986328125\nPixel Count,1024\n\n\
        Pixel,Wavelength,Processed,Raw,Dark,Reference\n0,447.94,24.0,835.0,823.0,50.0\n1,448.45,nan,850.0,823.0,50.0\n\
        2,448.96,26.0,858.0,823.0,46.0\n";
    let table = ok(wasatch);
    assert_eq!((names(&table), samples(&table, 0)), (vec!["Processed"], vec![(447.94, 0.24), (448.96, 0.26)]));
    let plain = ok("nm,sample,control\n400,0.1,0.2\n500,0.2,0.3\n");
    assert_eq!(names(&plain), ["sample", "control"]);
    let camera = ok("nm,R,G,B\n400,0.1,0.2,0.3\n500,0.2,0.3,0.4\n");
    assert_eq!(names(&camera), ["R", "G", "B"]);
}

#[test]
fn spectral_library_in_micrometers() {
    let table = ok(
        "Name: Made-up grass\nType:  Vegetation\nWavelength Range:  All\n\nDescription:  Grass. Measured at an \n\
        angle of 60 degrees. \nX Units:  Wavelength (micrometers)\nY Units:  Reflectance (percent)\nFirst X Value: 0.38049\n\
        Number of X Values: 3\n \n0.40049\t14.249\t \n0.39049\t14.251\t\t\n0.38049\t14.546\t\t\n",
    );
    assert_eq!((names(&table), table.reading.descending), (vec!["Made-up grass"], true));
    assert_eq!(table.curves[0].wavelengths_nm, [380.49, 390.49, 400.49]);
    assert_eq!(table.curves[0].values, [14.546 / 100.0, 14.251 / 100.0, 14.249 / 100.0]);
    assert_eq!((table.role.certainty, table.reading.values.certainty), (Certainty::Certain, Certainty::Certain));
}

#[test]
fn optical_spectrum_analyzer() {
    let file = |unit: &str| {
        format!(
            "#Thorlabs FTS 1\n#[SpectrumHeader]\n#Date;20260522\n#XAxisUnit;nm_air\n#YAxisUnit;{unit}\n#[Data]\n\
             9.997433472e+02;6.0e+01\n1.000743347e+03;5.0e+01\n#[EndOfFile]\n"
        )
    };
    let table = ok(&file("intensity"));
    assert_eq!(samples(&table, 0), [(999.743_347_2, 60.0), (1_000.743_347, 50.0)]);
    assert_eq!(table.reading.wavelength_unit.certainty, Certainty::Certain);
    assert!(note(&table, "Program").is_some_and(|program| program.contains("Thorlabs")));
    assert_eq!(table.role.value, Role::Illuminant);
    assert_eq!(note(&table, "Medium"), Some("wavelengths in air, taken as they are"));
    let bare = ok(&file("intensity").replace('#', ""));
    assert_eq!((bare.role.value, bare.reading.values.value), (Role::Illuminant, Values::Plain));
    let power = ok(&file("dBm"));
    assert_eq!((power.reading.values.value, power.role.value), (Values::Decibels, Role::Illuminant));
    assert_eq!((power.curves[0].values[1], power.reading.values.certainty), (1e5, Certainty::Certain));
}

#[test]
fn headers_of_numbers_and_labels() {
    let asd = "\r\nText conversion of header file \\a.asd\r\n ------\r\n\0\0\0\0\0\0\r\nxmin = 350 xmax= 2500\r\n\
        VNIR gain was 16 offset was 2051\r\n\r\nWavelength;a.asd\r\n350; 0.2197 \r\n351; 0.2164 \r\n352; 0.2164 \r\n";
    let table = ok(asd);
    assert_eq!((names(&table), table.reading.rows), (vec!["a.asd"], 3));
    assert_eq!(note(&table, "Program"), Some("a file of ASD ViewSpec Pro"));
    let uprtek = "Model Name\tCV600\nLUX\t695.15\nCCT\t5198.0\nLambdaPValue\t18.4\nIRR\t2.6\n380nm\t0.030267\n381nm\t0.030268\n382nm\t0.03\n";
    let table = ok(&format!("{uprtek}PPFD\t4.5\nR/B\t1.1\n"));
    assert_eq!((table.curves[0].values.len(), table.role.value), (3, Role::Illuminant));
    assert_eq!(note(&table, "Program"), Some("a file of a UPRtek meter"));
    let vue = "Date,Mode,IntegrationTime(ms),Tag,Coordinates,Wavelengths(nm),400.62,401.23,401.83,402.44,403.05\n\
        3/8/2022 3:02:47 PM,Reflectance,0.914,,,,28.4,28.5,28.6,28.7,28.8\n";
    let table = ok(vue);
    assert_eq!((table.reading.orientation.value, table.role.value), (Orientation::Across, Role::Reflectance));
    assert_eq!(table.curves[0].values[0], 28.4 / 100.0);
}

#[test]
fn raw_radiances_of_a_field_spectrometer() {
    let text = include_str!("../corpus/svc_overlap.sig");
    let raw = ReadOptions { raw: Some(true), ..ReadOptions::default() };
    let table = read(text.as_bytes(), &raw).unwrap();
    assert_eq!(names(&table), ["Reference", "Target", "Reflectance (%)"]);
    let wanted = [(400.0, 50.0), (600.0, 200.0), (990.0, 1000.0), (1000.0, 2240.0), (1020.0, 2400.0), (1910.0, 330.0)];
    assert_eq!(samples(&table, 1), wanted);
    assert_eq!(table.role.value, Role::Illuminant, "{:?}", table.role);
}
