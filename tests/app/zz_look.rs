use crate::screenshots::open_with;
use chromascope::document::{Document, Light, Overlays};
use chromascope::workspaces::PaneKind;

#[test]
fn look() {
    for (size, name) in [([1280.0, 800.0], "1280"), ([900.0, 600.0], "900")] {
        for (theme, tone) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
            let mut document = Document::colorimetry();
            document.light = Light::Set("FL2".to_owned());
            document.filters = vec!["Warming 18 mired".to_owned()];
            document.overlays = Overlays { whites: true, isotherms: true, ..document.overlays };
            let mut window = open_with(document, size, theme);
            let workspace = window.state().view().saved.workspace;
            let layout = &mut window.state_mut().view_mut().saved.layout;
            layout.replace(workspace, PaneKind::INSPECTOR, PaneKind::new("Light"));
            window.run();
            window.render().unwrap().save(format!("/tmp/h/lights-{name}-{tone}.png")).unwrap();
            let layout = &mut window.state_mut().view_mut().saved.layout;
            layout.replace(workspace, PaneKind::SWATCHES, PaneKind::INSPECTOR);
            window.state_mut().view_mut().selected = Some(chromascope::plot_item::PlotItem::Light);
            window.state_mut().view_mut().search = "filter".to_owned();
            window.run();
            window.render().unwrap().save(format!("/tmp/h/lights2-{name}-{tone}.png")).unwrap();
        }
    }
}
