//! Sets of the library as files: what is written reads back, what does not fit says why, the menu is there.

use chromascope::catalog::import::{Imported, Origin, import, import_as};
use chromascope::catalog::{Catalog, Entry};
use chromascope::document::SetKind;
use chromascope::document::imported::{ImportOverrides, ImportedSet, Role};
use chromascope::export::spectra::{Form, SpectraFile, file, fits, notes_in_words};
use chromascope::results::Results;
use chromascope_core::query::Shared;
use egui::accesskit;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use spectral_file::write::{Format, Grid};
use spectral_file::{ReadError, Watch};

use crate::screenshots::open;

fn built_in(kind: SetKind, name: &str) -> Entry {
    Catalog::built_in().get(kind, name).unwrap_or_else(|| panic!("no {name}")).clone()
}

fn own(file: &str, text: &str, role: Role) -> ImportedSet {
    import(file, text.as_bytes(), Some(role)).unwrap().set
}

/// A written file as it is opened again, with what is beside it.
fn reopened(written: &SpectraFile) -> Result<Imported, ReadError> {
    let bytes = written.text.as_bytes();
    let metadata = written.beside.metadata.as_ref().map(|metadata| metadata.text(&written.name)).unwrap_or_default();
    let origin = Origin { metadata: metadata.into_bytes().into(), ..Origin::named(&written.name, bytes) };
    import_as(&origin, bytes, &ImportOverrides::default(), Watch::none())
}

fn form(format: Format, step_nm: Option<f64>) -> Form {
    Form { format, grid: step_nm.map_or(Grid::Native, Grid::Step) }
}

/// The values at the wavelengths that both have, which must be some. Not every format has names.
fn agree(read: &ImportedSet, name: &str, index: usize, values: &[(f64, f64)]) {
    let curve = read.curves.iter().find(|curve| curve.name == name).unwrap_or(&read.curves[index]);
    let mut shared = 0;
    for (nm, value) in curve.wavelengths.iter().zip(&curve.values) {
        if let Some((_, expected)) = values.iter().find(|(known, _)| (known - nm).abs() < 1e-6) {
            assert!((value - expected).abs() <= 1e-12 * expected.abs(), "{name} at {nm}: {value}, not {expected}");
            shared += 1;
        }
    }
    assert!(shared > 1, "{name}: nothing in common");
}

#[test]
fn every_format_reads_back_as_the_same_set() {
    let results = Results::default();
    let sets = [
        (built_in(SetKind::Camera, "Nikon D70 (2007 figure)"), Role::Camera, "red"),
        (built_in(SetKind::Observer, "CIE 1931 2°"), Role::Camera, "x_bar"),
        (built_in(SetKind::Illuminant, "D65"), Role::Illuminant, "power"),
        (built_in(SetKind::Chart, "ColorChecker 24 (Ohta 1997)"), Role::Reflectance, "white"),
    ];
    let mut count = 0;
    for (entry, role, curve) in sets {
        let measured = file(&entry, form(Format::Csv, None), &results, None).unwrap();
        assert!(measured.notes.is_empty(), "{:?}", measured.notes);
        let measured = reopened(&measured).unwrap().set;
        let index = measured.curves.iter().position(|known| known.name == curve).unwrap_or(0);
        let known = &measured.curves[index];
        let known: Vec<(f64, f64)> = known.wavelengths.iter().copied().zip(known.values.iter().copied()).collect();
        for form in Form::all().filter(|form| fits(&entry, *form).is_ok()) {
            let written = file(&entry, form, &results, None).unwrap_or_else(|e| panic!("{} {form:?}: {e}", entry.name));
            let read =
                reopened(&written).unwrap_or_else(|error| panic!("{} {form:?}: {error}\n{}", entry.name, written.text));
            let beside = written.beside.metadata.as_ref().map(|metadata| metadata.text(&written.name));
            if matches!(form.format, Format::Csv | Format::CommentedCsv) {
                assert_eq!(read.set.role, role, "{} {form:?}", entry.name);
                assert_eq!(read.set.name, entry.name);
                let [source, license] = match &beside {
                    Some(_) => ["\"source\": ", "\"dc:license\": "],
                    None => ["# source: ", "# license: "],
                };
                let known = beside.as_ref().unwrap_or(&written.text);
                assert!(known.contains(source) && known.contains(license), "{known}");
                assert_eq!(written.text.starts_with("wavelength_nm,"), form.format == Format::Csv);
            }
            if let Grid::Average(step) = form.grid {
                let told =
                    format!("\"resampling\": \"band averages every {step} nm: means of the linear interpolant over ±");
                assert!(beside.as_ref().unwrap().contains(&told), "{beside:?}");
                assert!(notes_in_words(&written.notes).contains(&format!("averaged over bands of {step} nm")));
            } else {
                agree(&read.set, curve, index, &known);
            }
            count += 1;
        }
    }
    assert!(count >= 4 * 5, "{count}");
}

#[test]
fn what_happened_on_the_way_is_said() {
    let results = Results::default();
    let camera = built_in(SetKind::Camera, "Nikon D70 (2007 figure)");
    let written = file(&camera, form(Format::Csv, Some(5.0)), &results, None).unwrap();
    assert!(notes_in_words(&written.notes).contains("resampled to 5 nm"), "{:?}", written.notes);
    assert_eq!(written.name, "Nikon D70 (2007 figure).csv");
    let json = file(&camera, form(Format::RawtoacesJson, None), &results, None).unwrap().text;
    assert!(json.contains("\"manufacturer\": \"Nikon\"") && json.contains("\"model\": \"D70\""), "{json}");
}

#[test]
fn own_sets_keep_all_curves_and_say_how_they_were_read() {
    let results = Results::default();
    let text = "nm,red,green,blue,infrared\n400,1,2,80,1\n500,3,70,4,2\n600,90,5,3,8\n700,6,2,1,70\n";
    let mut camera = own("mine.csv", text, Role::Camera);
    camera.per_photon = true;
    let entry = Entry::from_own(&Shared::new(camera.clone()));
    let written = file(&entry, form(Format::Csv, None), &results, None).unwrap();
    let read = reopened(&written).unwrap().set;
    assert_eq!((read.role, read.per_photon, read.channels), (Role::Camera, true, camera.channels));
    assert_eq!(read.curves, camera.curves);
    let beside = written.beside.metadata.unwrap().text("again.csv");
    assert!(beside.contains("{ \"source\": \"mine.csv\" }") && beside.contains("{ \"reading\": \""), "{beside}");
    let written = file(&entry, form(Format::DcamprofJson, None), &results, None).unwrap();
    assert!(notes_in_words(&written.notes).contains("one curve beside red, green and blue"), "{:?}", written.notes);

    // Percent on the way in, fractions ever after, whatever the comments say of percent.
    for role in [Role::Reflectance, Role::Transmittance] {
        let leaf = own("leaf.txt", "nm\tleaf (%)\n400\t5.5\n500\t10\n600\t99\n700\t80\n", role);
        assert!(leaf.percent);
        let entry = Entry::from_own(&Shared::new(leaf.clone()));
        for form in Form::all().filter(|form| fits(&entry, *form).is_ok() && form.grid == Grid::Native) {
            let written = file(&entry, form, &results, None).unwrap();
            let again = import(&written.name, written.text.as_bytes(), Some(role)).unwrap().set;
            let values: Vec<f64> =
                again.curves[0].values.iter().step_by(again.curves[0].values.len() / 3).copied().collect();
            assert_eq!(values[..2], leaf.curves[0].values[..2], "{form:?}\n{}", written.text);
        }
    }
}

#[test]
fn what_does_not_fit_says_why() {
    let results = Results::default();
    let light = built_in(SetKind::Illuminant, "D65");
    let cmf = form(Format::ArgyllCmf, None);
    let why = fits(&light, cmf).unwrap_err().to_string();
    assert!(why.contains("not for curves of this kind"), "{why}");
    assert!(file(&light, cmf, &results, None).is_err());
    let chart = built_in(SetKind::Chart, "ColorChecker 24 (Ohta 1997)");
    assert!(fits(&chart, form(Format::DcamprofJson, None)).unwrap_err().to_string().contains("24"));
    assert!(fits(&chart, form(Format::Cgats, None)).is_ok());
    for kind in SetKind::ALL {
        for entry in Catalog::built_in().of_kind(kind) {
            assert!(fits(entry, form(Format::Csv, None)).is_ok(), "{}", entry.name);
        }
    }
}

#[test]
fn every_row_has_a_menu_with_all_forms() {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    let set = own("zoo.csv", "nm,red,green,blue\n400,0,1,5\n500,1,8,4\n600,9,5,1\n700,5,1,0\n", Role::Camera);
    window.state_mut().push(crate::import_sets(vec![ImportedSet { name: "Zoo".to_owned(), ..set }]));
    window.state_mut().view.adding = true;
    window.run();
    for (menu, own) in [("Menu of your Zoo", true), ("Menu in the library of ARRI D21", false)] {
        window.state_mut().view.adding = true;
        window.run();
        window.get_by_role_and_label(accesskit::Role::Button, menu).click();
        window.run();
        assert_eq!(window.query_by_role_and_label(accesskit::Role::Button, "Remove").is_some(), own);
        window.get_by(|node| node.label().is_some_and(|label| label.starts_with("Save as"))).click();
        window.run();
        for form in Form::all() {
            let name = form.name();
            let item = window.get_by_role_and_label(accesskit::Role::Button, &name);
            assert!(!item.accesskit_node().is_disabled(), "{}", form.name());
        }
        window.key_press(egui::Key::Escape);
        window.run();
        window.key_press(egui::Key::Escape);
        window.run();
        assert!(window.query_by_role_and_label(accesskit::Role::Button, "CSV, as measured").is_none());
    }
    // The menu key opens it too; a light does not fit everywhere.
    window.state_mut().view.adding = true;
    window.run();
    window.get_by_role_and_label(accesskit::Role::CheckBox, "ARRI D21").focus();
    window.run();
    window.key_press(egui::Key::Menu);
    window.run();
    assert!(window.query_by_label_contains("Save as").is_some());
    window.key_press(egui::Key::Escape);
    window.state_mut().view.show(chromascope::workspaces::PaneKind::LIBRARY);
    window.state_mut().view.selected = Some(chromascope::plot_item::PlotItem::of_set(SetKind::Illuminant, "D65"));
    window.run();
    window.get_by_role_and_label(accesskit::Role::Button, "More").click();
    window.run();
    window.get_by(|node| node.label().is_some_and(|label| label.starts_with("Save as"))).click();
    window.run();
    let item = window.get_by_role_and_label(accesskit::Role::Button, "Argyll color matching functions (.cmf)");
    assert!(item.accesskit_node().is_disabled());
}
