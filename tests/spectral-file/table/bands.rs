//! Wavelengths in the names of columns, and rows that name the channels of a camera.

use spectral_file::{
    Certainty, Preview, ReadError, ReadOptions, Role, Values, Warning, Watch, WavelengthUnit, What, read, read_marked,
};

use super::{error, names, ok};

const NM: [f64; 5] = [360.0, 370.0, 380.0, 390.0, 400.0];

/// A table of two samples with a column for each band of each group.
fn wide(groups: &[&str], delimiter: &str) -> String {
    let header = groups.iter().flat_map(|group| NM.map(|nm| group.replace('#', &nm.to_string())));
    let row = |name: &str, from: usize| {
        let values = (0..5 * groups.len()).map(|i| format!("0.{:02}", from + i));
        [name.to_owned()].into_iter().chain(values).collect::<Vec<_>>().join(delimiter)
    };
    let header: Vec<String> = ["Name".to_owned()].into_iter().chain(header).collect();
    format!("{}\n{}\n{}\n", header.join(delimiter), row("a", 10), row("b", 20))
}

#[test]
fn names_of_columns_hold_wavelengths() {
    for name in ["SCI #nm", "SCE #[nm]", "SPEC_#", "R#", "R_#", "nm#", "SPECTRAL_NM#", "# nm [a.u.]", "M1 # nm", "λ#"]
    {
        for delimiter in [",", ";", "\t"] {
            let text = wide(&[name], delimiter);
            let table = ok(&text);
            assert_eq!((names(&table), table.curves[0].wavelengths_nm.as_slice()), (vec!["a", "b"], &NM[..]), "{name}");
            assert_eq!(table.curves[1].values, [0.2, 0.21, 0.22, 0.23, 0.24], "{text}");
            assert_eq!((table.reading.rows, table.warnings.len()), (2, 0), "{text}: {:?}", table.warnings);
        }
    }
    let percent = ok(&wide(&["# nm [%]"], ";"));
    assert_eq!((percent.reading.values.value, percent.curves[0].unit.as_deref()), (Values::Percent, Some("%")));
    assert_eq!(percent.reading.wavelength_unit.certainty, Certainty::Certain);
    assert_eq!(ok(&wide(&["SCI #nm"], ",")).role.value, Role::Reflectance);
}

#[test]
fn other_columns_stand_on_both_sides() {
    let text = "No;L*;a*;SCI 360nm;SCI 370nm;SCI 380nm;SCI 390nm;SCI 400nm;Note\n\
                1;50,1;2,2;1,5;2;3;4;5;x\n2;51,1;3,2;2,5;3;4;5;6;\n";
    let table = ok(text);
    assert_eq!(table.curves[0].wavelengths_nm, NM);
    assert_eq!(table.curves[1].values, [0.025, 0.03, 0.04, 0.05, 0.06]);
}

#[test]
fn groups_with_different_names_are_parts() {
    let text = wide(&["SCI #nm", "SCE #nm"], ",");
    let choice = |part| ReadOptions { part: Some(part), ..ReadOptions::default() };
    let first = ok(&text);
    let parts: Vec<&str> = first.reading.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!((parts, first.reading.part.value), (vec!["SCI", "SCE"], 1));
    assert_eq!(first.warnings, [Warning::MoreGroups { count: 2, second: "SCE".to_owned() }]);
    let part = |part| read(text.as_bytes(), &choice(part));
    let second = part(2).unwrap();
    assert_eq!((second.curves[0].values[0], second.curves[0].wavelengths_nm[0]), (0.15, 360.0));
    assert_eq!((second.warnings.len(), second.reading.part.certainty), (0, Certainty::Chosen));
    assert_eq!(part(3), Err(ReadError::NoSuchPart { part: 3, parts: 2 }));
    for (part, table) in [(1, &first), (2, &second)] {
        let preview = Preview::new(text.as_bytes()).unwrap();
        let (_, marker) = read_marked(text.as_bytes(), &choice(part), Watch::none()).unwrap();
        let values = preview.marks(3, table, &marker).into_iter().filter_map(|mark| match mark.what {
            What::Value { value, curve: 1, .. } => Some(value),
            _ => None,
        });
        assert_eq!(values.collect::<Vec<_>>(), table.curves[1].values);
        let header = preview.marks(1, table, &marker);
        assert_eq!(header.iter().filter(|mark| matches!(mark.what, What::Wavelength(..))).count(), 5);
    }
}

#[test]
fn names_with_numbers_are_no_bands() {
    let samples = ok("nm,leaf 100,leaf 200,leaf 300,leaf 400,leaf 500\n400,.1,.2,.3,.4,.5\n410,.1,.2,.3,.4,.5\n");
    assert_eq!((samples.curves.len(), samples.curves[0].wavelengths_nm.as_slice()), (5, &[400.0, 410.0][..]));
    let down = ok("Wavelength,R100,R200,R300,R400,R500\n400,.1,.2,.3,.4,.5\n410,.1,.2,.3,.4,.5\n");
    assert_eq!(down.curves.len(), 5);
    assert!(matches!(
        error("a,R100,R200,R300,R400,R500\nx,a,b,c,d,e\n"),
        ReadError::NearlyRow { .. } | ReadError::NoNumbers
    ));
}

#[test]
fn rows_named_after_channels_make_a_camera() {
    let text = "Name,400,410,420,430,440\nR,.1,.2,.3,.4,.5\nG,.2,.3,.4,.5,.6\nB,.2,.3,.4,.5,.6\n";
    let camera = ok(text);
    assert_eq!((camera.role.value, camera.role.certainty), (Role::Camera, Certainty::Guess));
    assert_eq!(camera.reading.camera_columns, Some([0, 1, 2]));
    let leaves = ok("nm,leaf r,leaf g,leaf b\n400,.1,.2,.3\n410,.2,.3,.4\n420,.3,.4,.5\n");
    assert_eq!(leaves.role.certainty, Certainty::Guess);
    let units = ok("nm,R (a.u.),G (a.u.),B (a.u.)\n400,.1,.2,.3\n410,.2,.3,.4\n420,.3,.4,.5\n");
    assert_eq!((units.role.value, units.role.certainty), (Role::Camera, Certainty::Guess));
}

#[test]
fn wave_numbers_of_the_infrared_are_guessed_and_said() {
    let file = |first: u32, last: u32, step: usize| -> String {
        (first..=last).rev().step_by(step).map(|x| format!("{x}.5,0.5\n")).collect::<Vec<_>>().concat()
    };
    let infrared = ok(&file(498, 3998, 2));
    assert_eq!(infrared.reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
    assert_eq!(infrared.reading.wavelength_unit.certainty, Certainty::Guess);
    assert!(infrared.warnings.contains(&Warning::MaybeWavelengths));
    assert!(infrared.curves[0].values.len() == 1751 && infrared.reading.range_nm[1] > 20_000.0);
    for (first, last) in [(200, 2500), (350, 2500), (175, 3300)] {
        let light = ok(&file(first, last, 1));
        assert_eq!((light.reading.wavelength_unit.value, light.warnings.len()), (WavelengthUnit::Nanometer, 0));
    }
    let named = ok(&format!("nm,A\n{}", file(498, 3998, 2)));
    assert_eq!(named.reading.wavelength_unit.value, WavelengthUnit::Nanometer);
}
