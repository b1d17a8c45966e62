//! Each setting of the picture and of the paper is one entry: all that is made from it is there.

use std::process::Command as Process;

use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::Document;
use chromascope::document::render::{MeshChoice, NEAR, RenderSettings};
use chromascope::export::Paper;
use chromascope::workspaces::PaneKind;
use chromascope_core::render::QualityLevel;
use chromascope_text::{Setting, Settings, Value};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::finding::find;
use crate::screenshots::open_with;

type Window = Harness<'static, ChromascopeApp>;

/// Another value of a setting; false for one with a control of its own.
fn change<D>(setting: &Setting<D>, settings: &mut D) -> bool {
    match &setting.value {
        Value::Switch(get, set) => {
            let on = get(settings);
            set(settings, !on);
        }
        Value::Choice(pick) => {
            let next = ((pick.get)(settings) + 1) % (pick.all)().len();
            (pick.set)(settings, next);
        }
        value => {
            for number in value.numbers() {
                let [low, high] = number.slider;
                (number.set)(settings, low + 0.25 * (high - low));
            }
        }
    }
    !matches!(setting.value, Value::Own)
}

/// Settings under which one has an effect.
fn with_effect(setting: &Setting<RenderSettings>) -> RenderSettings {
    let usual = RenderSettings::default();
    let others = [
        RenderSettings { light_distance: Some(NEAR), ..usual.clone() },
        RenderSettings { quality: QualityLevel::Tolerance, ..usual.clone() },
        RenderSettings { mesh: MeshChoice::Image("cube.hdr".into()), ..usual.clone() },
    ];
    [usual].into_iter().chain(others).find(|settings| (setting.idle)(settings).is_none()).expect(setting.key)
}

/// A changed setting differs in the field of its key alone, and is read back.
fn survives<D: Settings + Clone + PartialEq + Serialize + DeserializeOwned>(base: impl Fn(&Setting<D>) -> D) {
    for setting in D::ALL {
        let before = base(setting);
        let mut after = before.clone();
        if change(setting, &mut after) {
            let [a, b] = [&before, &after].map(|settings| serde_json::to_value(settings).unwrap());
            let fields = a.as_object().unwrap().iter();
            let differ: Vec<&str> =
                fields.filter(|(key, value)| b[key.as_str()] != **value).map(|(key, _)| key.as_str()).collect();
            assert_eq!(differ, [setting.key], "{}", setting.name);
            assert!(serde_json::from_value::<D>(b).unwrap() == after, "{}", setting.name);
        }
    }
}

#[test]
fn each_survives_a_session_under_its_key() {
    survives(with_effect);
    survives(|_| Paper::default());
}

fn is_range_checked<D: Settings>(base: impl Fn(&Setting<D>) -> D) {
    for setting in D::ALL {
        for (index, number) in setting.value.numbers().into_iter().enumerate() {
            let [low, high] = number.valid.or(number.typed).unwrap_or(number.slider);
            for spoiled in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, high + high.abs(), low - low.abs() - 1.0] {
                let mut settings = base(setting);
                (number.set)(&mut settings, spoiled);
                settings.mend();
                let mended = (setting.value.numbers()[index].get)(&settings);
                assert!((low..=high).contains(&mended), "{}: {spoiled} became {mended}", setting.name);
            }
        }
    }
}

#[test]
fn each_number_is_brought_into_its_range() {
    is_range_checked(with_effect);
    is_range_checked::<Paper>(|_| Paper::default());
}

fn has_flags<D: Settings>(command: &str, without: &[&str]) {
    let output = Process::new(env!("CARGO_BIN_EXE_chromascope")).args([command, "--help"]).output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    let words: Vec<&str> = help.split_whitespace().collect();
    let help = words.join(" ");
    for setting in D::ALL {
        let flag = &setting.flag;
        assert_eq!(flag.long.is_empty(), without.contains(&setting.name), "{}", setting.name);
        assert!(flag.long.is_empty() || words.contains(&format!("--{}", flag.long).as_str()), "{}", setting.name);
        assert!(flag.elsewhere || flag.long.is_empty() || help.contains(setting.help), "{}", setting.name);
    }
}

#[test]
fn each_has_a_flag() {
    // Pictures of the command line are under the Sun, which `--light` turns.
    has_flags::<RenderSettings>("render", &["Sun's disk", "Point light", "Light distance"]);
    has_flags::<Paper>("figure", &[]);
}

fn has_control(window: &Window, setting: &Setting<RenderSettings>) -> bool {
    let named = |role: Role, name: &str| window.query_all_by_role_and_label(role, name).count() > 0;
    match &setting.value {
        Value::Switch(..) => named(Role::CheckBox, setting.name),
        Value::Pair(pair) => pair.iter().all(|(name, ..)| named(Role::Slider, name)),
        Value::Number(_) => {
            let is_named = |label: Option<String>| label.is_some_and(|label| label.contains(setting.name));
            window.query_all_by_role(Role::Slider).any(|node| is_named(node.accesskit_node().label()))
        }
        Value::Choice(_) | Value::Own => {
            let list = format!("{}: ", setting.name);
            let is_list = window
                .query_all_by_role(Role::ComboBox)
                .any(|node| node.accesskit_node().label().is_some_and(|label| label.starts_with(&list)));
            let all = if let Value::Choice(pick) = &setting.value { (pick.all)() } else { Vec::new() };
            let in_row = |role| !all.is_empty() && all.iter().all(|words| named(role, words.label));
            is_list || in_row(Role::RadioButton) || in_row(Role::Button)
        }
    }
}

#[test]
fn each_has_a_control_a_line_in_the_palette_and_an_undo_step() {
    let mut window = open_with(Document::colorimetry(), [1280.0, 1700.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::RENDER);
    window.run_steps(3);
    let settings = |window: &Window| window.state().history.document().render.clone();
    let begun = settings(&window);
    for setting in RenderSettings::ALL {
        let name = setting.name;
        // Settings of a spectral image are beside its name, with an image.
        assert!(setting.key.starts_with("image_") || has_control(&window, setting), "{name}");
        if (setting.idle)(&begun).is_some() {
            continue;
        }
        let text = match &setting.value {
            Value::Switch(get, _) => format!("{name}: {}", if get(&begun) { "off" } else { "on" }),
            Value::Choice(pick) => {
                let (all, now) = ((pick.all)(), (pick.get)(&begun));
                format!("{name}: {}", all[(now + 1) % all.len()].label)
            }
            Value::Number(_) | Value::Pair(_) => name.to_owned(),
            Value::Own => continue,
        };
        find(&mut window, &text, 0);
        if let Value::Number(_) = setting.value {
            window.run_steps(2);
            window.key_press(Key::ArrowRight);
            window.run_steps(2);
        }
        if let Value::Pair(_) = setting.value {
            continue;
        }
        assert_eq!(window.state().history.undo_name(), Some(name), "{text}");
        window.state_mut().push(Command::Undo);
        window.run_steps(2);
        assert_eq!(settings(&window), begun, "{name}");
    }
}
