use crate::screenshots::open;
use chromascope::action::{Action, CompareAction, OwnAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::{Kind, import};
use chromascope::thing::{SourceId, Thing};
use egui_kittest::Harness;

fn save(h: &mut Harness<'static, ChromascopeApp>, name: &str) {
    h.run();
    h.render().unwrap().save(format!("/tmp/look3/{name}.png")).unwrap();
}
fn cam(n: &str) -> SourceId {
    SourceId { kind: Kind::Camera, name: n.into() }
}

#[test]
fn look() {
    std::fs::create_dir_all("/tmp/look3").unwrap();
    let only = std::env::var("LOOK").unwrap_or_default();
    for (tname, theme) in [("dark", egui::Theme::Dark), ("light", egui::Theme::Light)] {
        if !only.is_empty() && only != tname {
            continue;
        }
        let mut h = open([1280.0, 800.0], theme);
        save(&mut h, &format!("a_welcome_{tname}"));
        h.state_mut().view_mut().selected =
            Some(Thing::Patch { source: Some(cam("Kodak DCS200")), patch: "blue".into() });
        save(&mut h, &format!("b_patch_{tname}"));
        h.state_mut().view_mut().selected = Some(Thing::Patch { source: None, patch: "orange yellow".into() });
        save(&mut h, &format!("c_across_{tname}"));
        h.state_mut().view_mut().selected = Some(Thing::Source(cam("Canon EOS 10D")));
        save(&mut h, &format!("d_source_{tname}"));
        h.state_mut().view_mut().selected = Some(Thing::Radiator { source: cam("Nikon D70"), kelvin: 5500.0 });
        h.state_mut().view_mut().pinned = vec![
            Thing::Patch { source: Some(cam("Kodak DCS200")), patch: "blue".into() },
            Thing::Patch { source: Some(cam("Nikon D70")), patch: "blue".into() },
            Thing::Radiator { source: cam("Canon EOS 10D"), kelvin: 5500.0 },
        ];
        save(&mut h, &format!("e_radiator_pinned_{tname}"));
        h.state_mut().view_mut().pinned.clear();
        h.state_mut().view_mut().selected = Some(Thing::Light);
        save(&mut h, &format!("f_light_{tname}"));
        h.state_mut().view_mut().selected = None;
        let text = "nm,leaf a,leaf b,leaf c\n400,4,5,6\n450,8,5,7\n500,9,10,9\n550,30,40,22\n600,22,30,40\n650,10,10,60\n700,45,50,70\n";
        let mut set = import::import("my leaves with a long name.csv", text.as_bytes(), None).unwrap();
        set.set.name = "My leaves with a really long name".into();
        let mut camera = set.set.clone();
        camera.role = chromascope::document::own::OwnRole::Camera;
        camera.name = "My own camera".into();
        h.state_mut().push(Action::Own(OwnAction::Import(vec![set.set, camera])));
        h.state_mut().push(Action::Compare(CompareAction::SetVisible(Kind::Camera, "Nikon D70".into(), false)));
        h.state_mut().view_mut().reading = Some("My own camera".into());
        h.state_mut().view_mut().say(set.message);
        h.state_mut().view_mut().status.change = Some("My own camera".into());
        save(&mut h, &format!("g_reading_{tname}"));
        h.state_mut().view_mut().reading = None;
        h.state_mut().view_mut().search = "my".into();
        h.state_mut().view_mut().fail("leaf.csv, line 14: no number in column 2. Nothing was changed. And a very long rest of the sentence that does not fit into this bar at all, at all, at all.");
        save(&mut h, &format!("h_search_{tname}"));
        let mut h = open([900.0, 600.0], theme);
        h.state_mut().view_mut().search = "zzz".into();
        save(&mut h, &format!("i_small_{tname}"));
        h.state_mut().view_mut().search.clear();
        h.state_mut().view_mut().saved.folded = ["cameras", "illuminants", "materials"].map(str::to_owned).into();
        let kodak = egui::pos2(90.0, 190.0);
        h.hover_at(kodak);
        h.run_steps(60);
        save(&mut h, &format!("j_small_hover_{tname}"));
        h.state_mut().view_mut().inspector_over = true;
        for name in [
            "Canon EOS 5D",
            "Canon EOS 600D",
            "Nikon D850",
            "Sony ILCE-7M3",
            "ARRI D21",
            "Canon EOS M",
            "Canon EOS 5DS",
            "Canon EOS 100D",
        ] {
            h.state_mut().push(Action::Compare(CompareAction::Add(Kind::Camera, name.into())));
        }
        h.state_mut().view_mut().selected =
            Some(Thing::Patch { source: Some(cam("Kodak DCS200")), patch: "blue".into() });
        save(&mut h, &format!("k_small_over_{tname}"));
    }
}
