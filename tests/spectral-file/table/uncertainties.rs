//! Columns and rows that are uncertainties of curves, and covariances beside files.

use super::{names, ok};
use spectral_file::{Certainty, ReadOptions, Source, SpectralFile, Warning, read};

#[track_caller]
fn uncertain(text: &str, curves: &[&str], k: f64, standard: &[f64]) -> SpectralFile {
    let table = ok(text);
    assert_eq!(names(&table), curves, "{text}");
    let stated = table.curves[0].uncertainty.as_ref().expect(text);
    assert_eq!((stated.coverage, &*stated.standard), (k, standard), "{text}");
    table
}

fn certainty(table: &SpectralFile) -> Certainty {
    table.decisions().into_iter().find(|decision| decision.what == "Uncertainty").unwrap().certainty
}

#[test]
fn a_column_behind_its_curve_follows_it_and_its_scale() {
    let agilent = "Wavelength (nm);Transmittance(%);Std.Dev.\n400;79;0.38\n410;80;0.5\n420;81;0.7\n";
    let table = uncertain(agilent, &["Transmittance"], 1.0, &[0.0038, 0.005, 0.007]);
    assert_eq!(certainty(&table), Certainty::Certain);
    assert_eq!(table.reading.parts[0].curves, 1);
    for word in ["StdDev", "sd", "SD", "std_err", "SE", "s.e.", "SEM", "sigma", "u(R)", "R_sd", "R_std", "± R", "sd_R"]
    {
        uncertain(&format!("nm,R,{word}\n400,0.5,0.02\n410,0.6,0.01\n"), &["R"], 1.0, &[0.02, 0.01]);
    }
    for word in [
        "SD",
        "std_err",
        "u(k=1)",
        "stdev_R",
        "Standardabw.",
        "Ecart type",
        "desv. est.",
        "R (±)",
        "R +/-",
        "Std. error",
    ] {
        uncertain(&format!("nm,R,{word}\n400,0.5,0.02\n410,0.6,0.01\n"), &["R"], 1.0, &[0.02, 0.01]);
    }
    for word in ["u_rel", "RSD", "CV", "Relative standard uncertainty"] {
        uncertain(&format!("nm,R,{word}\n400,0.5,0.02\n410,0.6,0.01\n"), &["R"], 1.0, &[0.01, 0.006]);
    }
    // Rows that descend, and one without an uncertainty.
    let table = uncertain("nm,R,SD\n420,0.5,0.02\n410,0.6,\n400,0.7,0.01\n", &["R"], 1.0, &[0.01, 0.02, 0.02]);
    assert!(table.warnings.iter().any(|warning| matches!(warning, Warning::UncertaintyGaps { count: 1, .. })));
}

#[test]
fn the_coverage_factor_comes_from_the_header_a_line_above_or_is_a_guess() {
    let rows = "400,0.5,0.02\n410,0.6,0.01\n";
    let certain = uncertain(&format!("nm,R,U (k=2)\n{rows}"), &["R"], 2.0, &[0.01, 0.005]);
    assert_eq!(certainty(&certain), Certainty::Certain);
    uncertain(&format!("# k = 2.5\nnm,R,Expanded uncertainty\n{rows}"), &["R"], 2.5, &[0.008, 0.004]);
    uncertain(&format!("# coverage factor: 2\nnm,R,Uncertainty\n{rows}"), &["R"], 2.0, &[0.01, 0.005]);
    for word in
        ["U95", "U (k = 2)", "U(R), k=2", "Expanded uncertainty k=2", "Expanded uncertainty (95 % confidence level)"]
    {
        uncertain(&format!("nm,R,{word}\n{rows}"), &["R"], 2.0, &[0.01, 0.005]);
    }
    let guess = uncertain(&format!("nm,R,Expanded uncertainty (95 %)\n{rows}"), &["R"], 2.0, &[0.01, 0.005]);
    assert_eq!(certainty(&guess), Certainty::Guess);
}

#[test]
fn percent_of_the_value_and_percent_as_the_values_are() {
    let nist = "Wavelength (nm),Spectral irradiance (W/cm^3),Expanded uncertainty (%)\n400,50,4\n410,80,2\n";
    assert_eq!(ok(nist).curves.len(), 1);
    let stated = ok(nist).curves[0].uncertainty.clone().unwrap();
    let relative = |at: usize| stated.standard[at] / ok(nist).curves[0].values[at];
    assert!((relative(0) - 0.02).abs() < 1e-12 && (relative(1) - 0.01).abs() < 1e-12);
    for head in [
        "Wellenlänge in nm;spektrale Bestrahlungsstärke in W/(m² nm);erweiterte Messunsicherheit in %",
        "Wavelength /nm;Spectral irradiance /W m-2 nm-1;Expanded uncertainty (k=2) /%",
        "Wavelength;Irradiance;U\nnm;W/m2/nm;%",
    ] {
        let table = ok(&format!("{head}\n400;50;4\n410;80;2\n"));
        assert_eq!(
            (table.curves.len(), &*table.curves[0].uncertainty.as_ref().expect(head).standard),
            (1, &[1.0, 0.8][..])
        );
    }
    let both = "nm,Reflectance (%),Uncertainty (%)\n400,50,4\n410,80,2\n";
    let table = uncertain(both, &["Reflectance"], 1.0, &[0.04, 0.02]);
    assert!(table.warnings.iter().any(|warning| matches!(warning, Warning::UncertaintyScale { .. })));
}

#[test]
fn absorbances_carry_theirs_by_the_derivative() {
    let table = ok("nm,Absorbance,SD\n400,1,0.01\n410,0.5,0.02\n");
    let stated = table.curves[0].uncertainty.clone().unwrap().standard;
    let wanted = [0.01 * 10_f64.ln() * 0.1, 0.02 * 10_f64.ln() * 10_f64.powf(-0.5)];
    assert!(stated.iter().zip(wanted).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{stated:?}");
}

/// Three curves, with the uncertainties 0.02, 0.03 and 0.01.
#[track_caller]
fn all_three(text: &str) {
    let table = ok(text);
    let first = |name: &str| name.chars().next().unwrap();
    assert_eq!(names(&table).into_iter().map(first).collect::<String>(), "RGB", "{text}");
    for (curve, standard) in table.curves.iter().zip([0.02, 0.03, 0.01]) {
        assert_eq!(curve.uncertainty.as_ref().expect(text).standard, [standard; 2], "{text}");
    }
}

#[test]
fn several_curves_by_turns_by_name_or_as_many_behind() {
    let by_turns = "400,0.5,0.02,0.4,0.03,0.3,0.01\n410,0.6,0.02,0.5,0.03,0.4,0.01\n";
    for header in ["R,sd,G,sd,B,sd", "R_mean,R_std,G_mean,G_std,B_mean,B_std", "R,R (SD),G,G (SD),B,B (SD)"] {
        all_three(&format!("nm,{header}\n{by_turns}"));
    }
    let before = "400,0.02,0.5,0.03,0.4,0.01,0.3\n410,0.02,0.6,0.03,0.5,0.01,0.4\n";
    all_three(&format!("nm,sd_R,R,sd_G,G,sd_B,B\n{before}"));
    let behind = "400,0.5,0.4,0.3,0.02,0.03,0.01\n410,0.6,0.5,0.4,0.02,0.03,0.01\n";
    for header in ["R,G,B,R_sd,G_sd,B_sd", "R,G,B,sd,sd,sd", "R,G,B,SD1,SD2,SD3", "R 1,G 2,B 3,SD 1,SD 2,SD 3"] {
        all_three(&format!("nm,{header}\n{behind}"));
    }
    let bands = "400,410,420,430,440,450,460,470,480,490";
    let row = |value: &str| [value; 10].join(",");
    let named = format!("sample,{bands}\nleaf,{}\nleaf sd,{}\n", row("0.5"), row("0.01"));
    let kinds = format!("sample,kind,{bands}\nleaf,mean,{}\nleaf,sd,{}\n", row("0.5"), row("0.01"));
    for text in [named, kinds] {
        uncertain(&text, &["leaf"], 1.0, &[0.01; 10]);
    }
}

#[test]
fn curves_stay_curves() {
    for header in ["SD1,SD2,SD3", "N,SE,S", "E,SE,S", "Ref,SE Asia,Error bay", "SE,NE,E", "u,g,r", "Sample,Ref,Std"] {
        let table = ok(&format!("nm,{header}\n400,0.5,0.45,0.4\n410,0.6,0.5,0.5\n"));
        assert_eq!(table.curves.len(), 3, "{header}");
        assert!(table.curves.iter().all(|curve| curve.uncertainty.is_none()), "{header}");
    }
    for header in [
        "SD15,SD14,DP2",
        "SD15 R,SD15 G,SD15 B",
        "SD1 Merrill,SD1 Quattro,DP1",
        "SD card,paper,SE-300",
        "usd,euro,Std A",
        "error,leaf,bark",
        "leaf,error 1,error 2",
        "Std A,Std B,Std C",
        "white std,gray std,black std",
        "Canon,Sigma,Nikon",
        "iPhone SE,iPhone 12,iPhone 13",
        "U,B,V",
        "standard 1,standard 2,unknown",
        "UC,UCLA,UC2",
        "SD,HD,UHD",
    ] {
        let table = ok(&format!("nm,{header}\n400,0.5,0.4,0.3\n410,0.6,0.5,0.4\n"));
        assert_eq!(names(&table), header.split(',').collect::<Vec<_>>());
        assert!(table.curves.iter().all(|curve| curve.uncertainty.is_none()), "{header}");
    }
    // Not even as small as uncertainties are.
    for header in [
        "D300,SD15",
        "paint,SE-300",
        "paint,SD card",
        "paint,usd",
        "paint,Std A",
        "white,black std",
        "leaf,error sample",
    ] {
        assert_eq!(
            names(&ok(&format!("nm,{header}\n400,0.5,0.03\n410,0.6,0.02\n"))),
            header.split(',').collect::<Vec<_>>()
        );
    }
    let negative = ok("nm,R,error\n400,0.5,-0.02\n410,0.6,0.01\n");
    assert_eq!((names(&negative), negative.warnings.len()), (vec!["R"], 1));
    let all = ReadOptions { raw: Some(true), ..ReadOptions::default() };
    assert_eq!(read("nm,R,Std.Dev.\n400,0.5,0.02\n410,0.6,0.01\n", &all).unwrap().curves.len(), 2);
}

fn with_covariance(text: &str, covariance: &str) -> SpectralFile {
    let source = Source { bytes: text.as_bytes(), covariance: covariance.as_bytes(), ..Source::default() };
    read(source, &ReadOptions::default()).unwrap()
}

#[test]
fn a_covariance_beside_a_file_follows_order_and_scale_or_is_left_out_with_its_fault() {
    let percent = "nm,Reflectance (%)\n410,50\n400,60\n";
    for text in ["4,1\n1,9\n", ",a,b\na,4,1\nb,1,9\n", "a;b\n4;1\n1;9\n"] {
        let table = with_covariance(percent, text);
        let covariance = table.covariance.as_ref().expect(text);
        let wanted = [9e-4, 1e-4, 1e-4, 4e-4];
        assert!(covariance.values.iter().zip(wanted).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{covariance:?}");
        assert!((table.curves[0].uncertainty.as_ref().unwrap().standard[0] - 0.03).abs() < 1e-15);
    }
    let faults = [("4,1\n2,9\n", "symmetric"), ("-4,1\n1,9\n", "below zero"), ("4\n", "1 rows"), ("4,1\n1,x\n", "“x”")];
    for (text, fault) in faults {
        let table = with_covariance(percent, text);
        let said = table.warnings.iter().map(ToString::to_string).collect::<String>();
        assert!(table.covariance.is_none() && said.contains(fault), "{said}");
    }
}
