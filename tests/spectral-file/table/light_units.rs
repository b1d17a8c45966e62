//! Lights in photons and per frequency, digits that are kept, thousands far down, and marks that stay right.

use spectral_file::write::{Content, Format, Grid, Sheet, Trace, write};
use spectral_file::{Certainty, Preview, ReadOptions, Role, Values, Watch, read, read_marked};

use super::{ok, samples};

/// h c in J nm and the same for a mole in J nm/mol, multiplied in exact fractions.
const PHOTON_J_NM: f64 = 1.986_445_857_148_928_6e-16;
const MOLE_J_NM: f64 = 1.196_265_656_386_970_1e8;

/// A value as written, of a wavelength and an energy.
type Written = fn(f64, f64) -> f64;

#[test]
fn one_light_in_every_unit_is_one_light() {
    let energies = [(400.0, 0.03), (450.0, 0.05), (500.0, 0.07), (600.0, 0.09), (700.0, 0.11)];
    let forms: [(&str, Written); 9] = [
        ("W/m2/nm", |_, e| e),
        ("µmol m-2 s-1 nm-1", |nm, e| e * nm / MOLE_J_NM * 1e6),
        ("umol/(m² s nm)", |nm, e| e * nm / MOLE_J_NM * 1e6),
        ("photons/s/m²/nm", |nm, e| e * nm / PHOTON_J_NM),
        ("W/m²/THz", |nm, e| e * nm * nm / 299_792.458),
        ("W m-2 Hz-1", |nm, e| e * nm * nm / 299_792.458e12),
        ("W/m²/cm-1", |nm, e| e * nm * nm / 1e7),
        ("W/m2/µm", |_, e| e * 1000.0),
        ("µmol m-2 s-1 THz-1", |nm, e| e * nm / MOLE_J_NM * 1e6 * nm * nm / 299_792.458),
    ];
    for (unit, written) in forms {
        let mut text = format!("Wavelength (nm),Lamp ({unit})\n");
        for (nm, energy) in energies {
            text.push_str(&format!("{nm},{:e}\n", written(nm, energy)));
        }
        let table = ok(&text);
        assert_eq!(table.role.value, Role::Illuminant, "{unit}");
        for ((nm, energy), (found_nm, value)) in energies.into_iter().zip(samples(&table.curves[0])) {
            assert!(nm == found_nm && (value - energy).abs() < 1e-12 * energy, "{unit} at {nm}: {value}, not {energy}");
        }
        let said = table.decisions().into_iter().find(|decision| decision.what == "Spectral unit");
        assert_eq!(said.is_some(), unit != "W/m2/nm", "{unit}");
        assert!(said.is_none_or(|said| said.certainty == Certainty::Certain && said.why.contains(unit)));
    }
}

#[test]
fn photons_chosen_to_be_plain_stay_as_they_are() {
    let text = "nm,Lamp (umol/m2/s/nm)\n400,1\n500,2\n";
    let plain = ReadOptions { values: Some(Values::Plain), ..ReadOptions::default() };
    let table = read(text.as_bytes(), &plain).unwrap();
    assert_eq!(table.curves[0].values, [1.0, 2.0]);
    assert_eq!(table.curves[0].unit.as_deref(), Some("umol/m2/s/nm"));
    let unknown = ReadOptions { role: Some(Role::Unknown), ..ReadOptions::default() };
    assert_eq!(read(text.as_bytes(), &unknown).unwrap().curves[0].values, [1.0, 2.0]);
}

#[test]
fn what_was_converted_is_not_converted_again() {
    for head in [
        "Photon irradiance (µmol m-2 s-1 nm-1)",
        "PPFD",
        "Photon flux density",
        "Sky W/m2/THz",
        "s.q.irrad",
        "Lamp photons/s/m2/nm",
        "Quantum irradiance of lamp 5",
    ] {
        let first = ok(&format!("nm,{head}\n400,1.5\n500,2.5\n600,3.5\n"));
        assert_eq!(first.role.value, Role::Illuminant, "{head}");
        assert_ne!(first.curves[0].values[0], 1.5, "{head}");
        let curves: Vec<Trace<'_>> = first.curves.iter().map(Trace::from).collect();
        for title in ["", head] {
            let unit = first.curves[0].unit.as_deref();
            let sheet = Sheet { title, content: Content::Illuminant, curves: &curves, unit, ..Sheet::default() };
            let text = write(&sheet, Format::Csv, Grid::Native).unwrap().text;
            assert_eq!(ok(&text).curves[0].values, first.curves[0].values, "{head}: {text}");
        }
    }
    // A light is not converted merely because of its name.
    let named = [Trace { name: "PPFD lamp", wavelengths_nm: &[400.0, 500.0], values: &[1.0, 2.0], uncertainty: None }];
    let sheet = Sheet { content: Content::Illuminant, curves: &named, ..Sheet::default() };
    let text = write(&sheet, Format::Csv, Grid::Native).unwrap().text;
    assert_eq!(ok(&text).curves[0].values, [1.0, 2.0], "{text}");
}

#[test]
fn shifted_decimals_keep_their_digits() {
    for (percent, fraction) in [
        ("23.333", 0.23333),
        ("7.1", 0.071),
        ("0.7", 0.007),
        ("99.99", 0.9999),
        ("33.3", 0.333),
        ("1.23456789012345", 0.012_345_678_901_234_5),
        ("17.000000000000004", 0.170_000_000_000_000_04),
        ("2.9e-300", 2.9e-302),
    ] {
        let table = ok(&format!("nm,Reflectance (%)\n400,{percent}\n410,50\n"));
        assert_eq!(table.curves[0].values, [fraction, 0.5], "{percent}");
    }
    let um = ok("µm,Reflectance\n0.4001,0.1\n0.45037,0.2\n0.512345678,0.3\n");
    assert_eq!(um.curves[0].wavelengths_nm, [400.1, 450.37, 512.345_678]);
    let angstrom = ok("Wavelength (Å),Reflectance\n4001.1,0.1\n4503.7,0.2\n");
    assert_eq!(angstrom.curves[0].wavelengths_nm, [400.11, 450.37]);
}

#[test]
fn thousands_that_begin_far_down_end_no_table() {
    for (sep, mark) in [(';', ','), ('\t', ','), (';', '.')] {
        let mut text = format!("nm{sep}Reflectance\n");
        for nm in 350..2500 {
            let nm = if nm < 1000 { nm.to_string() } else { format!("{}{mark}{:03}", nm / 1000, nm % 1000) };
            let fraction = if mark == '.' { "0,25" } else { "0.25" };
            text.push_str(&format!("{nm}{sep}{fraction}\n"));
        }
        let table = ok(&text);
        assert_eq!(table.curves[0].wavelengths_nm.len(), 2150, "{sep:?} {mark}");
        assert_eq!(table.curves[0].wavelengths_nm.last(), Some(&2499.0));
        assert!(table.warnings.is_empty(), "{:?}", table.warnings);
    }
}

#[test]
fn converted_and_missing_values_are_marked() {
    let photons = "nm,Lamp (umol/m2/s/nm)\n400,1\n500,2\n";
    let gap = "nm,Reflectance\n400,0.1\n450,-999\n500,0.2\n";
    let percent = "nm,Reflectance (%)\n400,23.333\n450,33.3\n";
    let tell = |text: &str| {
        let (table, marker) = read_marked(text.as_bytes(), &ReadOptions::default(), Watch::none()).unwrap();
        let preview = Preview::new(text.as_bytes()).unwrap();
        (1..=preview.line_count())
            .flat_map(|line| preview.marks(line, &table, &marker))
            .map(|mark| format!("{:?}", mark.what))
            .collect::<Vec<_>>()
    };
    let written = tell(photons).into_iter().filter(|mark| mark.contains("Value"));
    let written: Vec<bool> =
        written.zip(["written: 1.0", "written: 2.0"]).map(|(mark, said)| mark.contains(said)).collect();
    assert_eq!(written, [true, true]);
    let gap = tell(gap);
    assert!(gap.iter().any(|mark| mark.contains("Gap")), "{gap:?}");
    let values = tell(percent).into_iter().filter(|mark| mark.contains("Value")).count();
    assert_eq!(values, 2);
}
