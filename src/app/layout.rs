//! The window's place and the layout between runs. eframe reads them at the start; they are written here, for eframe writes its
//! file in place, and a kill would leave half of it.

use std::collections::BTreeMap;

use egui_winit::{WindowGeometry, WindowSettings};

use super::{ChromascopeApp, LAYOUT_KEY};

/// eframe's key of the window's place and size.
pub(super) const WINDOW_KEY: &str = "window";
const MEMORY_KEY: &str = "egui";

#[derive(Default)]
struct Values(BTreeMap<String, String>);

impl eframe::Storage for Values {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}

/// Window geometry as egui reports it, compared to detect a change.
#[derive(Clone, Copy, Default, PartialEq)]
struct Seen {
    rects: [Option<egui::Rect>; 2],
    fills: [Option<bool>; 2],
}

#[derive(Default)]
pub(super) struct WindowPlace {
    settings: Option<WindowSettings>,
    /// Its place and size when it is neither maximized nor fills the screen.
    normal: Option<WindowGeometry>,
    seen: Seen,
}

impl WindowPlace {
    /// Begins with the place that the window was restored to.
    pub(super) fn restored(storage: Option<&dyn eframe::Storage>) -> Self {
        let settings: Option<WindowSettings> = storage.and_then(|storage| eframe::get_value(storage, WINDOW_KEY));
        let normal = settings.as_ref().map(WindowSettings::normal_geometry);
        Self { settings, normal, seen: Seen::default() }
    }

    /// Records the window's position, if it changed.
    pub(super) fn follow(&mut self, ctx: &egui::Context, frame: &eframe::Frame) {
        let now = ctx.input(|input| {
            let viewport = input.viewport();
            Seen { rects: [viewport.outer_rect, viewport.inner_rect], fills: [viewport.maximized, viewport.fullscreen] }
        });
        if self.settings.is_some() && self.seen == now {
            return;
        }
        if let Some(window) = frame.winit_window() {
            let settings = WindowSettings::from_window(ctx.zoom_factor(), window, self.normal);
            (self.normal, self.settings) = (Some(settings.normal_geometry()), Some(settings));
            self.seen = now;
        }
    }
}

impl ChromascopeApp {
    /// Saves the layout, in the background or, with `now`, before returning.
    pub(super) fn save_layout(&mut self, now: bool) {
        let mut values = Values::default();
        if let Some(settings) = &self.place.settings {
            eframe::set_value(&mut values, WINDOW_KEY, settings);
        }
        self.ctx.memory(|memory| eframe::set_value(&mut values, MEMORY_KEY, memory));
        eframe::set_value(&mut values, LAYOUT_KEY, &self.saved_view());
        self.files.save_layout(&values.0, now);
    }
}
