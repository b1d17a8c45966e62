//! The keyboard's place: every control that Tab reaches shows that it has the focus.

use std::collections::BTreeSet;

use chromascope::app::ChromascopeApp;
use chromascope::workspaces::PaneKind;
use egui_kittest::Harness;
use image::RgbaImage;

use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

fn focused(window: &Window) -> Option<egui::Response> {
    let id = window.ctx.memory(egui::Memory::focused)?;
    window.ctx.read_response(id)
}

fn name_of(window: &Window, id: egui::Id) -> String {
    use egui_kittest::kittest::{NodeT as _, Queryable as _};
    let node = window.query_by(|node| node.is_focused() && !node.is_hidden());
    node.and_then(|node| node.accesskit_node().label()).unwrap_or_else(|| format!("{id:?}"))
}

/// Share of the pixels along the rim of a rectangle that differ between two pictures.
fn changed_along(rect: egui::Rect, a: &RgbaImage, b: &RgbaImage) -> f64 {
    let (left, top) = (rect.left().round().max(0.0) as u32, rect.top().round().max(0.0) as u32);
    let right = (rect.right().round() as u32).min(a.width()).max(left + 1) - 1;
    let bottom = (rect.bottom().round() as u32).min(a.height()).max(top + 1) - 1;
    let (mut all, mut changed) = (0, 0);
    let mut look = |x: u32, y: u32| {
        all += 1;
        changed += usize::from(a.get_pixel(x, y) != b.get_pixel(x, y));
    };
    for x in left..=right {
        for inset in 0..2 {
            look(x, (top + inset).min(bottom));
            look(x, bottom.saturating_sub(inset).max(top));
        }
    }
    for y in top..=bottom {
        for inset in 0..2 {
            look((left + inset).min(right), y);
            look(right.saturating_sub(inset).max(left), y);
        }
    }
    changed as f64 / f64::from(all)
}

/// Traverses the window with Tab, and compares each control with and without the focus.
fn tab_through(pane: PaneKind, theme: egui::Theme, size: [f32; 2], least: usize) {
    let mut window = open(size, theme);
    window.state_mut().view.show(pane);
    window.state_mut().view.fixed_clock = true;
    // Charts stand for the rows of all groups: 58 cameras more would be as many pictures of the same widget.
    let folded = ["cameras", "observers", "illuminants", "materials"].map(str::to_owned);
    window.state_mut().view.saved.folded = folded.into();
    for _ in 0..4 {
        window.run_steps(2);
        window.state().render_service.wait();
        window.state().later.wait();
    }
    let (mut seen, mut hidden) = (BTreeSet::new(), Vec::new());
    loop {
        window.key_press(egui::Key::Tab);
        window.run_steps(5);
        let Some(response) = focused(&window) else { continue };
        if !seen.insert(response.id.value()) {
            break;
        }
        assert!(seen.len() < 400, "Tab does not come round");
        let with = window.render().expect("drawn");
        window.ctx.memory_mut(|memory| memory.surrender_focus(response.id));
        window.run_steps(1);
        let without = window.render().expect("drawn");
        window.ctx.memory_mut(|memory| memory.request_focus(response.id));
        window.run_steps(1);
        let rect = response.interact_rect;
        let name = name_of(&window, response.id);
        if !rect.is_positive() || changed_along(rect, &with, &without) < 0.6 {
            hidden.push(format!("{name} at {rect}: {:.2}", changed_along(rect, &with, &without)));
        }
    }
    assert!(seen.len() >= least, "only {} controls", seen.len());
    assert!(hidden.is_empty(), "{pane:?}: {} of {} show no focus:\n{}", hidden.len(), seen.len(), hidden.join("\n"));
}

#[test]
fn compare_shows_the_focus() {
    tab_through(PaneKind::CHROMATICITY, egui::Theme::Dark, [900.0, 600.0], 40);
}

#[test]
fn spectra_shows_the_focus() {
    tab_through(PaneKind::SPECTRA, egui::Theme::Light, [900.0, 600.0], 30);
}

#[test]
fn render_shows_the_focus() {
    tab_through(PaneKind::RENDER, egui::Theme::Light, [900.0, 600.0], 40);
}
