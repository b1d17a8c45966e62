//! Finding and steering: the palette, lists that filter, the way from pane to pane by keyboard.

use chromascope::app::ChromascopeApp;
use chromascope::catalog::names::{Fit, fit, typed_words};
use chromascope::command::Command;
use chromascope::document::{Diagram, Document, Light, Overlays, SetKind};
use chromascope::panes::widgets::pick_list::{Line, found};
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::view::DiagramFit;
use chromascope::view::import::ImportItem;
use chromascope::workspaces::{PaneKind, Workspace};
use egui::Key;
use egui::accesskit::{Role, Toggled};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use crate::import_switches::says;
use crate::keyboard::press_like_keyboard;
use crate::screenshots::open_with;

type Window = Harness<'static, ChromascopeApp>;

fn window() -> Window {
    open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark)
}

/// Types into the palette, presses a key some times, then Enter.
pub(crate) fn find(window: &mut Window, text: &str, down: usize) {
    window.state_mut().push(Command::FindAnything);
    window.run_steps(3);
    window.get_by_role_and_label(Role::TextInput, "Find anything").type_text(text);
    window.run_steps(2);
    for _ in 0..down {
        window.key_press(Key::ArrowDown);
        window.run_steps(1);
    }
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert!(window.state().view.palette.is_none(), "{text}: closed");
}

/// Words of the highlighted line.
fn picked(window: &Window) -> String {
    let on = window.query_all_by(|node| node.role() == Role::Button && node.toggled() == Some(Toggled::True));
    let on = on.filter(|node| node.rect().width() > 480.0);
    let words: Vec<String> = on.filter_map(|node| node.accesskit_node().label()).collect();
    assert_eq!(words.len(), 1, "one line is highlighted: {words:?}");
    words[0].clone()
}

#[test]
fn settings_and_numbers_are_found() {
    let mut window = window();
    find(&mut window, "uv", 0);
    assert_eq!(window.state().history.document().diagram, Diagram::UvPrime);
    find(&mut window, "full diagram", 0);
    assert_eq!(window.state().view.saved.diagram_fit, DiagramFit::Whole);
    find(&mut window, "fit to data", 0);
    assert_eq!(window.state().view.saved.diagram_fit, DiagramFit::Data);
    find(&mut window, "theme light", 0);
    assert_eq!(window.ctx.options(|options| options.theme_preference), egui::ThemePreference::Light);
    find(&mut window, "daylight locus", 0);
    assert_eq!(
        window.state().history.document().overlays,
        Overlays { daylight: true, ..Document::colorimetry().overlays }
    );
    for text in ["3200", "3300 K", "3400k"] {
        find(&mut window, text, 0);
        let kelvin: String = text.chars().filter(char::is_ascii_digit).collect();
        assert_eq!(window.state().history.document().temperature_k.to_string(), kelvin);
    }
    find(&mut window, "planckian locus red", 0);
    assert!(window.state().view.help.page.is_some(), "what only the help says opens there");
}

#[test]
fn each_slider_that_is_found_takes_the_keyboard() {
    for name in [
        "Roughness σ",
        "Correlation τ",
        "Index n",
        "Light elevation",
        "Light azimuth",
        "Sky",
        "Exposure",
        "Field of view",
        "Triangles",
    ] {
        let mut window = window();
        find(&mut window, name, 0);
        assert!(window.state().view.is_shown(PaneKind::RENDER), "{name}");
        window.run_steps(2);
        let focused = window.get_by(|node| node.is_focused() && !node.is_hidden());
        assert_eq!(focused.accesskit_node().role(), Role::Slider, "{name}");
    }
}

#[test]
fn arrows_move_the_highlight_and_compared_cameras_are_ticked() {
    let mut window = window();
    window.state_mut().push(Command::FindAnything);
    window.run_steps(3);
    window.get_by_role_and_label(Role::TextInput, "Find anything").type_text("nikon d7");
    window.run_steps(2);
    let first = picked(&window);
    window.key_press(Key::ArrowDown);
    window.run_steps(1);
    assert_ne!(picked(&window), first);
    window.key_press(Key::ArrowUp);
    window.key_press(Key::ArrowUp);
    window.run_steps(1);
    assert_eq!(picked(&window), first);
    assert!(window.query_by_label("Cameras").is_some(), "a heading");
    window.key_press(Key::Escape);
    window.run_steps(2);
    let compared = window.state().history.document().compared.clone();
    let camera = compared.iter().find(|sensor| sensor.kind == SetKind::Camera).expect("one is compared");
    find(&mut window, &camera.name, 0);
    let id = SensorId { kind: SetKind::Camera, name: camera.name.clone() };
    assert_eq!(window.state().view.selected, Some(PlotItem::Sensor(id)), "a compared camera is selected");
    assert_eq!(window.state().history.document().compared, compared, "and stays");
}

#[test]
fn a_long_list_filters_as_one_types() {
    let mut window = window();
    window.get_by_label_contains("Light: ").click();
    window.run_steps(3);
    let field = window.get_by_role_and_label(Role::TextInput, "Filter Light");
    field.type_text("d55");
    window.run_steps(2);
    assert!(window.query_by_label_contains("D50").is_none(), "filtered");
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(window.state().history.document().light, Light::Set("D55".to_owned()));
    assert!(window.query_by_label("Filter Light").is_none(), "closed");
    window.get_by_label_contains("Patches: ").click();
    window.run_steps(3);
    window.get_by_role_and_label(Role::TextInput, "Filter Patches").type_text("maple leaf");
    window.run_steps(2);
    window.key_press(Key::ArrowDown);
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert!(window.state().history.document().chart.contains("leaf"), "{}", window.state().history.document().chart);
}

#[test]
fn a_short_list_has_no_field_and_letters_go_to_its_lines() {
    let mut window = window();
    window.get_by_label_contains("Reference: ").click();
    window.run_steps(3);
    assert!(window.query_by_label("Filter Reference").is_none());
    for letter in ["s", "s"] {
        window.event(egui::Event::Text(letter.to_owned()));
        window.run_steps(2);
    }
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(
        window.state().history.document().reference,
        "Stiles & Burch 1959 10°",
        "the second one with the letter"
    );
}

#[test]
fn lights_in_common_use_come_first() {
    let catalog = chromascope::catalog::Catalog::built_in();
    let names: Vec<&str> = catalog.of_kind(SetKind::Illuminant).map(|entry| entry.name.as_str()).take(8).collect();
    assert_eq!(names, ["D65", "D50", "A", "E", "D55", "FL2", "FL11", "LED-B3"]);
}

#[test]
fn what_lies_below_the_palette_does_not_feel_the_pointer_and_a_press_there_closes_it() {
    let mut window = window();
    let board = window.get_by_role_and_label(Role::Canvas, "Swatches").rect();
    let mut on_swatch = |step: u8| {
        let at = board.lerp_inside(egui::Vec2::new(0.3 + 0.01 * f32::from(step), 0.1 + 0.02 * f32::from(step)));
        window.hover_at(at);
        window.run_steps(2);
        window.state().view.hovered.is_some().then_some(at)
    };
    let swatches = (0..40).find_map(&mut on_swatch).expect("a swatch under the pointer");
    window.state_mut().push(Command::FindAnything);
    window.run_steps(3);
    window.hover_at(swatches + egui::Vec2::splat(1.0));
    window.run_steps(3);
    assert_eq!(window.state().view.hovered, None);
    window.drag_at(swatches);
    window.drop_at(swatches);
    window.run_steps(3);
    assert!(window.state().view.palette.is_none() && window.state().view.selected.is_none());
}

/// Words of the lines in sight that a palette or list shows, from above.
fn lines(window: &Window) -> Vec<String> {
    let shown =
        window.query_all_by(|node| node.role() == Role::Button && node.toggled().is_some() && !node.is_hidden());
    let wide = shown.filter(|node| node.rect().width() > 250.0);
    wide.filter_map(|node| node.accesskit_node().label()).collect()
}

#[test]
fn exact_names_win_in_lists_and_in_the_palette() {
    const A: &str = "A, incandescent 2856 K";
    for (typed, first) in [
        ("a", A),
        ("A", A),
        ("illuminant a", A),
        ("light A", A),
        ("a, inc", A),
        ("fl2", "FL2, CIE fluorescent lamps"),
        ("fl", "FL2, CIE fluorescent lamps"),
        ("d6", "D65, daylight 6504 K"),
    ] {
        let mut window = window();
        window.get_by_label_contains("Light: ").click();
        window.run_steps(3);
        press_like_keyboard(&mut window, typed);
        assert_eq!(lines(&window)[0], first, "{typed} in the list");
        window.key_press(Key::Enter);
        window.run_steps(3);
        let name = first.split(", ").next().unwrap().to_owned();
        assert_eq!(window.state().history.document().light, Light::Set(name), "{typed}");
        let mut window = self::window();
        window.state_mut().push(Command::FindAnything);
        window.run_steps(3);
        press_like_keyboard(&mut window, typed);
        assert_eq!(picked(&window), first, "{typed} in the palette");
    }
    for typed in ["D200", "camera d200"] {
        let mut window = window();
        window.state_mut().push(Command::FindAnything);
        window.run_steps(3);
        press_like_keyboard(&mut window, typed);
        assert_eq!(picked(&window), "Nikon D200", "{typed}");
        assert!(!lines(&window).iter().any(|line| line.contains("10D")), "{typed}: {:?}", lines(&window));
    }
}

#[test]
fn a_search_for_a_phone_says_that_there_is_none() {
    for typed in ["phone", "iPhone 15", "nokia", "Samsung", "pixel"] {
        let mut window = window();
        window.state_mut().push(Command::FindAnything);
        window.run_steps(3);
        press_like_keyboard(&mut window, typed);
        assert!(says(&window, "No phone is among the built-in cameras"), "{typed}");
        window.key_press(Key::Escape);
        window.run_steps(2);
        window.state_mut().view.adding = true;
        window.state_mut().view.search = typed.to_owned();
        window.run_steps(2);
        assert!(says(&window, "Open a table of your own (Ctrl+O)"), "{typed}");
    }
}

#[test]
fn the_library_ranks_as_all_searches_do() {
    let mut window = window();
    window.state_mut().view.adding = true;
    for (search, first) in [("d200", "Nikon D200"), ("camera d200", "Nikon D200"), ("nikkon d90", "")] {
        window.state_mut().view.search = search.to_owned();
        window.run_steps(3);
        let sets = window.query_all_by(|node| {
            matches!(node.role(), Role::CheckBox | Role::RadioButton) && node.toggled().is_some() && !node.is_hidden()
        });
        let sets: Vec<String> = sets
            .filter(|node| node.rect().left() < 100.0 && node.rect().top() > 300.0)
            .filter_map(|node| node.accesskit_node().label())
            .collect();
        assert_eq!(sets.first().map_or("", String::as_str), first, "{search}: {sets:?}");
        assert!(!sets.iter().any(|set| search.contains("200") && set.contains("10D")), "{sets:?}");
    }
}

#[test]
fn names_are_ranked_by_how_much_of_them_was_typed() {
    let fit = |text: &str, name: &str, gloss: &str| fit(&typed_words(text), name, gloss);
    let ordered = ["Day", "Daylight 5000 K", "Clear day", "Clear daylight", "Midday"];
    let fits: Vec<_> = ordered.iter().map(|name| fit("day", name, "").unwrap()).collect();
    assert_eq!(fits, [Fit::Exact, Fit::Start, Fit::Words, Fit::WordStarts, Fit::Inside]);
    assert_eq!(fit("day", "Noon", "daylight"), Some(Fit::Gloss));
    assert_eq!(fit("nikkon d70", "Nikon D70", ""), Some(Fit::Similar));
    assert_eq!(fit("d71", "Nikon D70", ""), None, "numbers must be right");
    assert_eq!(fit("D200", "Canon EOS 10D (2007 figure)", "Canon 10D (2007) camera"), None);
    assert_eq!(fit("eos5dmark", "Canon EOS 5D Mark II", ""), Some(Fit::WordStarts));
    assert_eq!(fit("illuminant A", "A, incandescent 2856 K", "CIE light illuminant"), Some(Fit::Exact));
    assert_eq!(fit("a", "White balance: A, incandescent 2856 K", ""), Some(Fit::Exact));
    assert_eq!(fit("camera", "Nikon D70", "camera"), Some(Fit::Gloss));
}

#[test]
fn f6_frames_a_pane_and_arrows_walk_its_items() {
    let mut window = window();
    window.state_mut().view.focused = Some(PaneKind::COMPARED);
    window.state_mut().view.fixed_clock = true;
    window.run_steps(2);
    let before = window.render().expect("drawn");
    window.key_press(Key::F6);
    window.run_steps(3);
    assert_eq!(window.state().view.focused, Some(PaneKind::CHROMATICITY));
    let after = window.render().expect("drawn");
    // The left edge of the pane, far from its header.
    let white = egui::Color32::WHITE.to_array();
    let framed = |image: &image::RgbaImage| (200..300).filter(|x| image.get_pixel(*x, 400).0 == white).count();
    assert!(framed(&after) >= framed(&before) + 2, "{} {}", framed(&before), framed(&after));
    window.key_press(Key::ArrowRight);
    window.run_steps(2);
    let first = window.state().view.cursor.clone().expect("the first point");
    window.key_press(Key::ArrowRight);
    window.run_steps(2);
    let second = window.state().view.cursor.clone().expect("the next point");
    assert_ne!(first, second);
    assert_eq!(window.state().view.hovered, Some(second.clone()), "marked and read as under the pointer");
    assert_eq!(first.source(), second.source());
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    let below = window.state().view.cursor.clone().expect("the same patch of the next sensor");
    assert_eq!(below.patch(), second.patch());
    assert_ne!(below.source(), second.source());
    window.key_press(Key::Enter);
    window.run_steps(2);
    assert_eq!(window.state().view.selected, Some(below));
    window.key_press(Key::Tab);
    window.run_steps(3);
    let focused = window.get_by(|node| node.is_focused() && !node.is_hidden());
    assert_eq!(focused.accesskit_node().label().as_deref(), Some("Diagram"), "Tab enters the pane");
}

#[test]
fn the_compared_sensors_are_walked_by_arrows() {
    let mut window = window();
    window.state_mut().push(Command::GoTo(PaneKind::COMPARED));
    window.run_steps(3);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    let label = |window: &Window| {
        window.get_by(|node| node.is_focused() && !node.is_hidden()).accesskit_node().label().expect("named")
    };
    let first = label(&window);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    assert_ne!(label(&window), first);
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert!(window.state().view.selected.is_some());
}

#[test]
fn a_file_that_fails_is_told_of_in_the_list_and_at_the_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("notes.txt");
    std::fs::write(&path, "hello world\nthis is not a spectrum\n1 2 3\n").unwrap();
    let mut window = window();
    window.state_mut().push(Command::OpenPath(path));
    for _ in 0..3 {
        window.run_steps(3);
        window.state().opened.wait();
    }
    assert!(window.state().view.status.text.contains("line 3"), "elsewhere the status line says it");
    let (item, line) = window.state().view.status.change.clone().expect("a way there");
    assert!(matches!(item, ImportItem::File(_)));
    window.state_mut().push(Command::ShowImport(item, line));
    for _ in 0..3 {
        window.run_steps(3);
        window.state().opened.wait();
    }
    assert!(window.state().view.status.text.is_empty(), "{}", window.state().view.status.text);
    let told = window.query_all_by(|node| {
        let label = node.label().unwrap_or_default();
        label.contains("a curve needs values") && !node.is_hidden()
    });
    let told: Vec<String> = told.filter_map(|node| node.accesskit_node().label()).collect();
    assert_eq!(told.len(), 2, "the list and the text: {told:?}");
}

#[test]
fn controls_that_do_nothing_in_a_workspace_are_dim() {
    let brightest = |window: &mut Window, left: u32| {
        let image = window.render().expect("drawn");
        let pixels = (left..left + 90).flat_map(|x| (34..44).map(move |y| (x, y)));
        pixels.map(|(x, y)| image.get_pixel(x, y).0[0]).max().expect("pixels")
    };
    let mut window = window();
    window.run_steps(3);
    let lit = brightest(&mut window, 8);
    window.state_mut().view.show(PaneKind::IMPORT);
    window.run_steps(3);
    assert!(brightest(&mut window, 8) < lit, "Reference does nothing in Data");
    window.state_mut().push(Command::Show(Workspace::Compare));
    window.run_steps(3);
    assert_eq!(brightest(&mut window, 8), lit);
}

#[test]
fn layouts_of_the_workspace_once_named_accuracy_open() {
    let old = "\"Accuracy\"";
    assert_eq!(serde_json::from_str::<Workspace>(old).unwrap(), Workspace::Compare);
}

#[test]
fn groups_without_a_match_are_left_out() {
    let all = [
        Line::heading("Blackbodies"),
        Line::new("A", true),
        Line::heading("Daylight"),
        Line::new("D50", false),
        Line { also: "noon daylight".to_owned(), ..Line::new("D65", false) },
    ];
    assert_eq!(found(&all, "noon d6"), [2, 4]);
    assert_eq!(found(&all, " "), [0, 1, 2, 3, 4]);
    assert!(found(&all, "zeiss").is_empty());
    assert_eq!(found(&all, "a"), [0, 1, 2, 4], "the name before what only contains it");
}
