//! Shapes of tables: tidy ones, names above and beside, bands across, rows that end early, samples out of range, encodings.

use spectral_file::{
    Certainty, Delimiter, Encoding, ReadError, ReadOptions, Reader, Role, SpectralFile, Warning, WavelengthUnit, read,
};

use super::{error, names, ok, samples};

/// Rows of samples and wavelengths, sample by sample or wavelength by wavelength.
fn rows(by_sample: bool, row: impl Fn(&str, u32, f64) -> String) -> String {
    let all = [("leaf", 0.1), ("bark", 0.4), ("soil", 0.2)];
    let wavelengths = [400, 410, 420, 430, 440, 450, 460, 470, 480];
    let cell = |(name, base): (&str, f64), nm: u32| row(name, nm, base + f64::from(nm - 400) / 1000.0);
    let each = |sample| wavelengths.map(|nm| cell(sample, nm)).concat();
    if by_sample {
        all.map(each).concat()
    } else {
        wavelengths.map(|nm| all.map(|sample| cell(sample, nm)).concat()).concat()
    }
}

fn is_whole(file: &SpectralFile, expected: [&str; 3]) {
    assert_eq!((file.reading.reader.value, names(file)), (Reader::TIDY, expected.to_vec()));
    for (curve, base) in file.curves.iter().zip([0.1, 0.4, 0.2]) {
        assert_eq!(curve.wavelengths_nm.len(), 9);
        assert_eq!((curve.values[0], curve.values[8]), (base, base + 0.08), "{}", curve.name);
    }
}

#[test]
fn tidy_tables_in_both_orders() {
    for by_sample in [true, false] {
        let plain = rows(by_sample, |name, nm, value| format!("{name},{nm},{value}\n"));
        is_whole(&ok(&format!("species,wl,refl\n{plain}")), ["leaf", "bark", "soil"]);
        is_whole(&ok(&format!("# melted\nspecies;wl;refl\n{}", plain.replace(',', ";"))), ["leaf", "bark", "soil"]);
        let comma = plain.replace(',', "\t").replace('.', ",");
        is_whole(&ok(&format!("species\twavelength\tvalue\n{comma}")), ["leaf", "bark", "soil"]);
        let quoted = rows(by_sample, |name, nm, value| format!("\"{nm}\",{value},\"{name}\",\"field\"\n"));
        is_whole(&ok(&format!("\"wl\",\"value\",\"variable\",\"site\"\n{quoted}")), ["leaf", "bark", "soil"]);
        let keyed = rows(by_sample, |name, nm, value| format!("{name},2,{nm},{value},45\n"));
        let table = ok(&format!("Individual,Replicate,Wavelength (nm),Reflectance,Angle\n{keyed}"));
        is_whole(&table, ["leaf", "bark", "soil"]);
        assert!(matches!(&table.warnings[..], [Warning::NotSpectra { count: 1, .. }]), "{:?}", table.warnings);
        assert_eq!((table.role.value, table.role.certainty), (Role::Reflectance, Certainty::Certain));
    }
}

#[test]
fn tidy_tables_with_rows_counted_and_with_uncertainties() {
    let count = |table: String| {
        table.lines().zip(1..).map(|(row, at)| format!("\"{at}\",{row}\n")).collect::<Vec<_>>().concat()
    };
    let plain = rows(true, |name, nm, value| format!("{nm},\"{name}\",{value}\n"));
    is_whole(&ok(&format!("\"\",\"wl\",\"variable\",\"value\"\n{}", count(plain.clone()))), ["leaf", "bark", "soil"]);
    let blanks = count(plain).replace(',', " ");
    is_whole(&ok(&format!("\"wl\" \"variable\" \"value\"\n{blanks}")), ["leaf", "bark", "soil"]);
    for spread in ["sd", "std_err", "R_sd"] {
        let uncertain = rows(false, |name, nm, value| format!("{name},{nm},{value},0.01,5\n"));
        let table = ok(&format!("sample,wavelength,R,{spread},n\n{uncertain}"));
        is_whole(&table, ["leaf", "bark", "soil"]);
        assert!(table.curves.iter().all(|curve| curve.uncertainty.as_ref().unwrap().standard == [0.01; 9]), "{spread}");
    }
    let two = rows(true, |name, nm, value| format!("{name},{nm},{value},0.01,{},0.02\n", value / 2.0));
    let table = ok(&format!("sample,wavelength,R,R_sd,T,T_sd\n{two}"));
    assert_eq!(names(&table)[..3], ["leaf R", "leaf T", "bark R"]);
    assert_eq!(table.curves[1].uncertainty.as_ref().unwrap().standard[0], 0.02);
}

#[test]
fn tidy_names_are_joined_of_the_columns_that_vary() {
    let two = rows(true, |name, nm, value| format!("{name},1,{nm},{value}\n{name},2,{nm},{}\n", value / 2.0));
    let table = ok(&format!("species,replicate,wl,refl\n{two}"));
    assert_eq!(names(&table), ["leaf 1", "leaf 2", "bark 1", "bark 2", "soil 1", "soil 2"]);
    assert_eq!((table.curves[0].values[0], table.curves[1].values[0]), (0.1, 0.05));
    // A text that follows the wavelength names no sample.
    let bands =
        rows(false, |name, nm, value| format!("{name},{},{nm},{value}\n", if nm < 440 { "violet" } else { "blue" }));
    is_whole(&ok(&format!("species,band,wl,refl\n{bands}")), ["leaf", "bark", "soil"]);
    let several = rows(true, |name, nm, value| format!("{name},{nm},{value},{}\n", value / 2.0));
    let table = ok(&format!("species,wl,Reflectance,Transmittance\n{several}"));
    assert_eq!(names(&table)[..3], ["leaf Reflectance", "leaf Transmittance", "bark Reflectance"]);
}

#[test]
fn tidy_tables_without_names_and_with_doubts() {
    let number = |name: &str| match name {
        "leaf" => 157,
        "bark" => 158,
        _ => 9,
    };
    let table = ok(&rows(true, |name, nm, value| format!("{}, {nm}, {value} \n", number(name))));
    is_whole(&table, ["157", "158", "9"]);
    assert_eq!(table.reading.reader.certainty, Certainty::Guess);
    for by_sample in [true, false] {
        is_whole(&ok(&rows(by_sample, |name, nm, value| format!("{name}\t{nm}\t{value}\n"))), ["leaf", "bark", "soil"]);
    }
    is_whole(&ok(&rows(false, |name, nm, value| format!("{},{nm},{value}\n", number(name)))), ["157", "158", "9"]);
    // Two values of one sample at one wavelength, or a torn row, are left to the general reader.
    let torn = rows(true, |name, nm, value| format!("{name},{nm},{value}\n")).replace("bark,450,0.45\n", "bark,45\n");
    let table = read(format!("species,wl,refl\n{torn}").as_bytes(), &ReadOptions::default());
    assert!(table.is_err() || table.is_ok_and(|table| !table.warnings.is_empty()));
    // A table whose second column happens to hold text is none.
    let wide = ok("nm,grade,R\n400,good,0.1\n410,good,0.2\n420,bad,0.3\n430,good,0.4\n");
    assert_eq!((wide.reading.reader.value, wide.curves.len()), (Reader::TABLE, 1));
}

#[test]
fn prefixes_of_wavelengths_and_counters() {
    for prefix in ["Wave_", "Wvl_", "wv", "nm_", "band", "spc.", "b", "A", "L", "X", "nm"] {
        let table = ok(&format!(
            "id,{prefix}400,{prefix}410,{prefix}420,{prefix}430,{prefix}440\nleaf,1,2,3,4,5\nbark,2,3,4,5,6\n"
        ));
        assert_eq!(names(&table), ["leaf", "bark"], "{prefix}");
        assert_eq!(samples(&table.curves[0])[0], (400.0, 1.0), "{prefix}");
    }
    // A word that says nothing of wavelengths is a guess; small numbers below it are no wavelengths.
    for prefix in ["nir", "Reflect_", "V"] {
        let text = format!(
            "id,{prefix}400,{prefix}410,{prefix}420,{prefix}430,{prefix}440\nleaf,.1,.2,.3,.4,.5\nbark,.2,.3,.4,.5,.6\n"
        );
        let table = ok(&text);
        assert_eq!((names(&table), samples(&table.curves[0])[0]), (vec!["leaf", "bark"], (400.0, 0.1)), "{prefix}");
        assert_eq!(table.reading.orientation.certainty, Certainty::Guess, "{prefix}");
    }
    let counted = "id,V1,V2,V3,V4,V5,V6\nleaf,.31,.32,.33,.34,.35,.36\nbark,.2,.3,.4,.5,.6,.7\n";
    assert!(matches!(error(counted), ReadError::NearlyRow { .. }));
    let hash = ok("#,Name,400,410,420,430,440\n1,leaf,.1,.2,.3,.4,.5\n2,bark,.2,.3,.4,.5,.6\n");
    assert_eq!((names(&hash), hash.reading.range_nm), (vec!["leaf", "bark"], [400.0, 440.0]));
    for prefix in ["b", "A", "L"] {
        let heads: Vec<String> = (301..307).map(|count| format!("{prefix}{count}")).collect();
        let text = format!("nm,{}\n400,1,2,3,4,5,6\n410,1,2,3,4,5,6\n420,1,2,3,4,5,7\n", heads.join(","));
        assert_eq!((ok(&text).curves.len(), names(&ok(&text))[0]), (6, heads[0].as_str()));
    }
}

#[test]
fn names_above_what_was_measured() {
    let cary = "Leaf,,Bark,,\nWavelength (nm),%T,Wavelength (nm),%T,\n400,10,400,30,\n410,20,410,40,\n420,30,420,50,\n";
    let table = ok(cary);
    assert_eq!((names(&table), table.curves[1].values[0]), (vec!["Leaf", "Bark"], 0.3));
    assert_eq!((table.role.value, table.reading.header_line), (Role::Transmittance, Some(1)));
    let above = ok(",Leaf,Bark\nWavelength (nm),%R,%R\n400,10,30\n410,20,40\n420,30,50\n");
    assert_eq!((names(&above), above.curves[0].values[0]), (vec!["Leaf", "Bark"], 0.1));
    let shimadzu = ok("\"Leaf A - RawData\"\n\"Wavelength nm.\",\"R%\"\n400,10\n410,20\n420,30\n");
    assert_eq!((names(&shimadzu), shimadzu.curves[0].values[0]), (vec!["Leaf A"], 0.1));
    let shimadzu =
        ok("\"\",\"Leaf - RawData\",\"Bark - RawData\"\n\"Wavelength nm.\",\"R%\",\"R%\"\n400,10,30\n410,20,40\n");
    assert_eq!(names(&shimadzu), ["Leaf", "Bark"]);
    // Names above means and uncertainties, each above both or above the first.
    let rows = "400,.5,.01,.3,.02\n410,.6,.01,.4,.02\n420,.7,.01,.5,.02\n";
    for head in [
        ",Leaf,,Bark,\nWavelength,mean,sd,mean,sd\n",
        ",Leaf,Leaf,Bark,Bark\nWavelength (nm),R,U (k=1),R,U (k=1)\n",
        "Wavelength,Leaf,,Bark,\n,mean,sd,mean,sd\n",
        ",Leaf,Leaf,Bark,Bark\n,mean,std,mean,std\nwavelength,,,,\n",
    ] {
        let table = ok(&format!("{head}{rows}"));
        assert_eq!(names(&table), ["Leaf", "Bark"], "{head}");
        assert_eq!(table.curves[1].uncertainty.as_ref().expect(head).standard, [0.02; 3], "{head}");
    }
    // A setting above them is no name.
    let setting = ok("Operator,Smith\nWavelength (nm),%R\n400,10\n410,20\n420,30\n");
    assert!(!names(&setting).contains(&"Smith"), "{:?}", names(&setting));
}

#[test]
fn names_of_rows_and_names_between_blanks() {
    for text in [
        "\"wl\" \"leaf\" \"bark\"\n\"1\" 400 0.1 0.2\n\"2\" 410 0.2 0.3\n\"3\" 420 0.3 0.4\n",
        "\"wl\",\"leaf\",\"bark\"\n\"1\",400,0.1,0.2\n\"2\",410,0.2,0.3\n\"3\",420,0.3,0.4\n",
    ] {
        let table = ok(text);
        assert_eq!((names(&table), samples(&table.curves[1])[0]), (vec!["leaf", "bark"], (400.0, 0.2)), "{text}");
    }
    let wide = ok("\"X400\" \"X410\" \"X420\" \"X430\" \"X440\"\n\"leaf\" .1 .2 .3 .4 .5\n\"bark\" .2 .3 .4 .5 .6\n");
    assert_eq!((names(&wide), samples(&wide.curves[1])[4]), (vec!["leaf", "bark"], (440.0, 0.6)));
    let axis = ok("\"leaf\" \"bark\"\n\"400\" 0.1 0.2\n\"410\" 0.2 0.3\n\"420\" 0.3 0.4\n");
    assert_eq!((names(&axis), samples(&axis.curves[1])[0]), (vec!["leaf", "bark"], (400.0, 0.2)));
    for (head, sign) in
        [("nm leaf bark", ","), ("nm,leaf,bark", " "), ("nm\tleaf\tbark", " "), ("nm leaf bark", "\t\t\t")]
    {
        let rows = "400,0.1,0.2\n410,0.2,0.3\n420,0.3,0.4\n".replace(',', sign);
        let table = ok(&format!("{head}\n{rows}"));
        assert_eq!((names(&table), table.curves[1].values[0]), (vec!["leaf", "bark"], 0.2), "{head:?} {sign:?}");
    }
    let named = ok("nm,leaf one,bark two\n400 0.1 0.2\n410 0.2 0.3\n420 0.3 0.4\n");
    assert_eq!(names(&named), ["leaf one", "bark two"]);
    let absent = ok("\"Wavelength, µm\",\"n\",\"k\"\n0.43,1.61\n0.44,1.62\n0.45,1.63\n");
    assert_eq!((names(&absent), absent.curves[0].values[0]), (vec!["n"], 1.61));
    let blanks = ok("w.length.1 leaf\tw.length.2 bark\n400\t0.1\t400\t0.2\n410\t0.2\t410\t0.3\n420\t0.3\t420\t0.4\n");
    assert_eq!((names(&blanks), blanks.curves[1].values[0]), (vec!["leaf", "bark"], 0.2));
    let specular = ok("Name,Mode,400nm,410nm,420nm,430nm,440nm\nWhite,SCI,90,91,92,93,94\nWhite,SCE,80,81,82,83,84\n");
    assert_eq!(names(&specular), ["White (SCI)", "White (SCE)"]);
    let rows = "1,White,SCI,90,91,92,93,94\n2,White,SCE,80,81,82,83,84\n";
    assert_eq!(names(&ok(&format!("No.,Name,Specular,400,410,420,430,440\n{rows}"))), ["White (SCI)", "White (SCE)"]);
    let rows = rows.replace("SCI", "x").replace("SCE", "x");
    assert_eq!(names(&ok(&format!("No.,Name,Mode,400,410,420,430,440\n{rows}"))), ["White (1)", "White (2)"]);
    let instrument = ok("Irradiance [µW/cm2/nm],\nTime,10:00,10:01\nIndex,1,2\n[nm],\n400,1,2\n410,2,3\n420,3,4\n");
    assert_eq!(names(&instrument), ["1", "2"]);
    let counted = ok("No.,Wavelength,Reflectance\n1,400,0.1\n2,410,0.2\n3,420,0.3\n");
    assert_eq!((counted.curves.len(), samples(&counted.curves[0])[0]), (1, (400.0, 0.1)));
    for head in ["Point", "S.No", "Unnamed: 0", "Nº"] {
        let rows = (0..9).map(|at| format!("{at},{},0.1,0.2\n", 400 + 10 * at)).collect::<Vec<_>>().concat();
        let table = ok(&format!("{head},Wavelength,leaf,bark\n{rows}"));
        assert_eq!((names(&table), table.curves[0].values.len()), (vec!["leaf", "bark"], 9), "{head}");
    }
    let last = ok("Wavelength,Reflectance,No.\n400,0.1,1\n410,0.2,2\n420,0.3,3\n");
    assert_eq!((last.curves.len(), samples(&last.curves[0])[0]), (1, (400.0, 0.1)));
}

#[test]
fn a_last_column_may_end_early_but_no_row_is_torn() {
    let early = ok("nm,A,B\n400,1.5,2\n410,2,3\n420,3,4\n430,4\n440,5\n");
    assert_eq!((early.curves[0].values.len(), early.curves[1].values.len()), (5, 3));
    assert!(matches!(early.warnings[..], [Warning::Gaps { cells: 2, .. }]), "{:?}", early.warnings);
    assert_eq!(
        error("nm,A,B\n400,1.5,2\n410,2,\n420,3\n430,4,1\n440,5,1\n"),
        ReadError::UnevenRow { line: 4, found: 2, expected: 3 }
    );
    let merged = ok("nm,n,k\n400,1.5,2\n410,,3\n420,3\n430,3\n440,,4\n450,5\n460,6\n");
    assert_eq!((merged.curves[0].values.len(), merged.curves[1].values.len()), (5, 3));
    let uneven = |line| ReadError::UnevenRow { line, found: 2, expected: 3 };
    assert_eq!(error("nm,A,B\n400,1,2\n410,2\n420,3,4\n430,4\n440,5\n"), uneven(3));
    // The last row alone may be cut, unless its line is whole.
    assert_eq!(error("nm,A,B\n400,1,2\n410,2,3\n420,3,4\n430,4"), uneven(5));
    let last = ok("nm,A,B\n400,1,2\n410,2,3\n420,3,4\n430,4\n");
    assert_eq!((last.curves[0].values.len(), last.curves[1].values.len()), (4, 3));
    assert!(matches!(last.warnings[..], [Warning::CommasOnly, Warning::Gaps { cells: 1, .. }]), "{:?}", last.warnings);
    assert_eq!(error("nm A B\n400 1 2\n410 2 3\n420 3 4\n430 4\n440 5\n"), uneven(5));
}

#[test]
fn samples_out_of_range_are_left_out_at_the_ends_only() {
    let far = ok("Wavelength (um),R\n24.8,0.1\n24.9,0.2\n25.0,0.3\n25.05,0.4\n");
    assert_eq!(far.curves[0].wavelengths_nm, [24_800.0, 24_900.0, 25_000.0]);
    assert!(far.warnings.iter().any(|warning| matches!(warning, Warning::OutOfRange { count: 1, .. })));
    assert_eq!(far.reading.dropped_rows[0].line, 5);
    let infrared = ok("1/cm,R\n4000,0.1\n2000,0.2\n1000,0.3\n399,0.4\n");
    assert_eq!(infrared.curves[0].values, [0.1, 0.2, 0.3]);
    let heads: Vec<String> = (0..50).map(|at| (33_000 - 500 * at).to_string()).collect();
    let across = ok(&format!("Wavenumber (cm-1),{}\nleaf,{}\n", heads.join(","), vec!["0.5"; 50].join(",")));
    assert_eq!((across.curves[0].values.len(), across.reading.range_nm[1].round()), (50, 1176.0));
    let outside = |text: &str| matches!(error(text), ReadError::WavelengthOutOfRange { .. });
    assert!(outside("nm,R\n400,0.1\n41,0.2\n420,0.3\n430,0.4\n"));
    assert!(outside("nm,R\n400,0.1\n410,0.2\n420,0.3\n43,0.4\n"));
    assert!(matches!(error("400,0.1\n10000,0.2\n20000,0.3\n30000,0.4\n"), ReadError::AmbiguousUnit { .. }));
    assert!(outside("nm,R\n0,0.1\n100,0.2\n200,0.3\n300,0.4\n"));
}

#[test]
fn bars_separate_columns() {
    for text in [
        "nm|leaf|bark\n400|0.1|0.2\n410|0.2|0.3\n420|0.3|0.4\n",
        "| nm | leaf | bark |\n|---|---|---|\n| 400 | 0.1 | 0.2 |\n| 410 | 0.2 | 0.3 |\n| 420 | 0.3 | 0.4 |\n",
    ] {
        let table = ok(text);
        assert_eq!((names(&table), table.reading.delimiter.value), (vec!["leaf", "bark"], Delimiter::Bar), "{text}");
        assert_eq!(samples(&table.curves[1])[0], (400.0, 0.2));
    }
}

#[test]
fn chinese_and_western_bytes() {
    let read = |bytes: &[u8]| read(bytes, &ReadOptions::default()).unwrap();
    // “波长,红,绿” in GB 2312.
    let chinese = read(b"\xB2\xA8\xB3\xA4,\xBA\xEC,\xC2\xCC\n400,0.1,0.2\n410,0.2,0.3\n420,0.3,0.4\n");
    assert_eq!((chinese.reading.encoding, names(&chinese)), (Encoding::Gbk, vec!["红", "绿"]));
    let encoding = chinese.decisions().into_iter().find(|decision| decision.what == "Encoding").unwrap();
    assert_eq!((encoding.value.as_str(), encoding.certainty), ("GBK", Certainty::Guess));
    // Big5, EUC-KR and Windows-1251 are none of these.
    for unknown in [&b"nm,\xA4\xCF\xAEg\xB2v\n400,1\n410,2\n420,3\n"[..], b"nm,\xB9\xDD\xBB\xE7\n400,1\n410,2\n420,3\n"]
    {
        let table = read(unknown);
        let encoding = table.decisions().into_iter().find(|decision| decision.what == "Encoding").unwrap();
        assert_eq!((table.reading.encoding, encoding.certainty), (Encoding::Unknown, Certainty::Guess));
        assert!(encoding.why.contains("UTF-8"), "{encoding}");
    }
    for western in [&b"nm,W\xB7m\xB2\xB7nm\n400,1\n410,2\n420,3\n"[..], b"nm,S\xE4ure 20 \xB0C\n400,1\n410,2\n420,3\n"]
    {
        assert_eq!(read(western).reading.encoding, Encoding::Windows1252);
    }
}

#[test]
fn words_of_other_languages() {
    for (text, role) in [
        ("Golflengte (nm);Reflectie", Role::Reflectance),
        ("Długość fali [nm];Odbicie", Role::Reflectance),
        ("Vlnová délka (nm);Propustnost", Role::Transmittance),
        ("Длина волны, нм;Коэффициент отражения", Role::Reflectance),
        ("Longueur d'onde (nm);Facteur de réflexion", Role::Reflectance),
        ("Lunghezza d'onda;Trasmissione", Role::Transmittance),
        ("波长;透过率", Role::Transmittance),
        ("파장;반사율", Role::Reflectance),
    ] {
        let table = ok(&format!("{text}\n400;0.1\n410;0.2\n420;0.3\n"));
        assert_eq!((table.role.value, table.role.certainty), (role, Certainty::Certain), "{text}");
    }
}

#[test]
fn one_warning_for_all_gaps_of_one_kind() {
    let mut text = "nm,A\n".to_owned();
    (400..460).for_each(|nm| text += &format!("{nm},0.5\n"));
    let islands = (0..10).map(|at| 500 + at * (30 + at));
    islands.for_each(|nm| text += &format!("{nm},0.5\n{},0.5\n", nm + 1));
    let holes: Vec<Warning> = ok(&text).warnings;
    assert!(matches!(holes[..], [Warning::Hole { count: 10, .. }]), "{holes:?}");
    assert!(holes[0].to_string().ends_with("as in 9 other places"), "{}", holes[0]);
}

#[test]
fn wavelengths_in_thousands_are_no_wave_numbers() {
    let rows: String = (290..=800).step_by(10).map(|nm| format!("{nm}0,0.5\n")).collect::<Vec<_>>().concat();
    let table = ok(&format!("wavelength,irradiance\n{rows}"));
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Angstrom);
    assert!(table.warnings.contains(&Warning::MaybeNanometers) && table.reading.range_nm == [290.0, 800.0]);
    assert!(matches!(error(&rows), ReadError::AmbiguousUnit { .. }));
}
