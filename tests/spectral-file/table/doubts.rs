//! Readings with a warning: encodings, commas, values below zero, quantities that were chosen.

use spectral_file::{
    Certainty, DecimalMark, Encoding, Quantity, ReadError, ReadOptions, Role, SpectralFile, Warning, read,
};

use super::{names, ok, ok_bytes, samples};

/// 波長,反射率(%) in Shift-JIS.
const JAPANESE: &[u8] = b"\x94g\x92\xb7,\x94\xbd\x8e\xcb\x97\xa6(%)\r\n400,10.5\r\n410,20\r\n420,30\r\n";

#[test]
fn japanese_of_windows_is_read_and_said_to_be_guessed() {
    let table = ok_bytes(JAPANESE);
    assert_eq!((table.reading.encoding, table.role.value), (Encoding::ShiftJis, Role::Reflectance));
    assert_eq!(samples(&table.curves[0]), [(400.0, 0.105), (410.0, 0.2), (420.0, 0.3)]);
    let said = table.decisions().into_iter().find(|decision| decision.what == "Encoding").unwrap();
    assert_eq!((said.value.as_str(), said.certainty), ("Shift-JIS", Certainty::Guess));
    let column = b"\x83T\x83\x93\x83v\x83\x8b,\x94g\x92\xb7nm,A\n1,400,10\n2,410,20\n3,420,30\n";
    let table = ok_bytes(column);
    assert_eq!(
        (table.curves[0].wavelengths_nm.as_slice(), table.reading.wavelength_column),
        (&[400.0, 410.0, 420.0][..], Some(2))
    );
}

#[test]
fn accented_letters_are_not_japanese() {
    for header in [
        &b"Ger\xe4t: Flu\xdf \xa35 \xb0\nnm;R\xe9flectance \xe9"[..],
        b"nm;Durchl\xe4ssigkeit \xfcber \xb5W\xb2 \x93quoted\x94 \x96 \x80",
        b"nm;\xe4r\xe4r\xf6r\xfcr\xdfr",
    ] {
        let table = ok_bytes(&[header, b"\n400;10\n410;20\n420;30\n"].concat());
        assert_eq!(table.reading.encoding, Encoding::Windows1252, "{header:?}");
    }
}

#[test]
fn two_bytes_a_character_need_no_mark() {
    let text = "nm;Durchlässigkeit A;B\n400;10;1\n410;20;2\n420;30;3\n";
    let low: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let high: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for (bytes, encoding) in [(low, Encoding::Utf16Le), (high, Encoding::Utf16Be)] {
        let table = ok_bytes(&bytes);
        assert_eq!((table.reading.encoding, names(&table)), (encoding, vec!["Durchlässigkeit A", "B"]));
    }
    let padded = [&b"name: spectrometer"[..], &[0; 40], b"\n400;10.5\n410;20\n420;30\n"].concat();
    assert_eq!(ok_bytes(&padded).reading.encoding, Encoding::Utf8);
}

fn with_commas(text: &str) -> Result<SpectralFile, ReadError> {
    read(text.as_bytes(), &ReadOptions { decimal_mark: Some(DecimalMark::Comma), ..ReadOptions::default() })
}

#[test]
fn commas_that_separate_and_mark_are_read_where_chosen() {
    let text = "400,0,060\n410,0,070\n420,0,085\n";
    let refused = read(text.as_bytes(), &ReadOptions::default()).unwrap_err();
    assert_eq!(refused, ReadError::AmbiguousCommas(1));
    assert!(refused.to_string().ends_with("choose decimal commas, or points if not"), "{refused}");
    assert_eq!(samples(&with_commas(text).unwrap().curves[0]), [(400.0, 0.06), (410.0, 0.07), (420.0, 0.085)]);
    let both = with_commas("nm,B\n400,5,0,060\n401,0,0,070\n401,5,0,085\n").unwrap();
    assert_eq!(samples(&both.curves[0]), [(400.5, 0.06), (401.0, 0.07), (401.5, 0.085)]);
    let points = ReadOptions { decimal_mark: Some(DecimalMark::Point), ..ReadOptions::default() };
    assert_eq!(read(text.as_bytes(), &points).unwrap().curves.len(), 2);
    let plain = ok("400,0,600\n410,0,700\n420,0,850\n");
    assert_eq!(plain.warnings, [Warning::CommasOnly]);
    assert!(plain.warnings[0].to_string().ends_with("choose decimal commas"));
}

#[test]
fn values_far_below_zero_are_told_with_their_line() {
    let file = |header: &str, low: &str| {
        let rows = (0..20).map(|i| format!("{},{},0.3\n", 400 + 10 * i, if i == 7 { low } else { "0.5" }));
        format!("{header}\n{}", rows.collect::<String>())
    };
    let leaf = ok(&file("nm,Reflectance leaf,Reflectance bark", "-0.4"));
    let [warning] = leaf.warnings.as_slice() else { panic!("{:?}", leaf.warnings) };
    assert!(matches!(warning, Warning::BelowZero { count: 1, line: Some(9), min: -0.4, .. }), "{warning:?}");
    assert_eq!(
        warning.to_string(),
        "line 9: “Reflectance leaf” (column 2) falls to -0.4, further below zero than noise"
    );
    assert_eq!(ok(&file("nm,Reflectance leaf,Reflectance bark", "-0.02")).warnings, []);
    assert_eq!(ok(&file("nm,Signal a,Signal b", "-40")).warnings, []);
}

#[test]
fn a_chosen_role_has_its_own_quantity() {
    let rows = (0..20).map(|i| format!("{},{}\n", 400 + 10 * i, 5000 + i)).collect::<Vec<_>>().concat();
    let options = ReadOptions { role: Some(Role::Reflectance), ..ReadOptions::default() };
    let table = read(format!("nm,counts\n{rows}").as_bytes(), &options).unwrap();
    assert_eq!(table.reading.quantity.value, Quantity::Reflectance);
    let doubt = Warning::OtherQuantity { quantity: Quantity::Counts, role: Role::Reflectance };
    assert!(table.warnings.contains(&doubt), "{:?}", table.warnings);
    assert_eq!(doubt.to_string(), "The numbers look like counts of a detector, not like reflectances");
}

#[test]
fn a_second_table_has_its_own_quantity() {
    let table = |header: &str, from: u32| {
        let rows = (0..5).map(|i| format!("{};{}.5\n", 400 + 10 * i, from + i));
        format!("{header}\n{}", rows.collect::<String>())
    };
    let text = table("nm;Transmittance", 0) + "\n" + &table("nm;Irradiance [W/m2/nm]", 1);
    let second = read(text.as_bytes(), &ReadOptions { part: Some(2), ..ReadOptions::default() }).unwrap();
    assert_eq!((second.role.value, second.reading.quantity.value), (Role::Illuminant, Quantity::Irradiance));
    assert_eq!(second.curves[0].unit.as_deref(), Some("W/m2/nm"));
}
