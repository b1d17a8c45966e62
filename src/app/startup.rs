//! Opening the window, or saying why it cannot open; its place and the layout between runs. eframe reads them at the start; they
//! are written here, for eframe writes its file in place, and a kill would leave half of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use eframe::NativeOptions;
use eframe::egui::ViewportBuilder;
use egui_winit::{WindowGeometry, WindowSettings};

use super::{ChromascopeApp, LAYOUT_KEY};
use crate::action::history::History;
use crate::files::{self, Files};
use crate::view::SavedView;

const APP_ID: &str = "chromascope";

const WITHOUT: &str = "Without a window, `chromascope locus`, `patches`, `compare`, `light`, `matrix`, `figure`, `report`, `render`, \
                       `identify`, `recover`, `inspect`, `bench` and `list` do the same.";

#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    #[error(
        "no display: neither DISPLAY nor WAYLAND_DISPLAY is set.\n{}\n\
         For a window without a screen, install the Debian package xvfb and run `xvfb-run chromascope`.",
        WITHOUT
    )]
    NoDisplay,
    #[error(
        "the window could not be opened: {0}.\n\
         It needs X11 (Debian packages libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0 libgl1) or Wayland \
         (libwayland-client0 libwayland-egl1 libxkbcommon0 libegl1), and libgl1-mesa-dri.\n{without}",
        without = WITHOUT
    )]
    Refused(#[from] eframe::Error),
}

pub fn run(paths: Vec<PathBuf>, start: Instant) -> Result<(), WindowError> {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(target_os = "linux") && !set("DISPLAY") && !set("WAYLAND_DISPLAY") {
        return Err(WindowError::NoDisplay);
    }
    let viewport = ViewportBuilder::default()
        .with_title("Chromascope")
        .with_app_id(APP_ID)
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([900.0, 600.0])
        .with_drag_and_drop(true)
        .with_icon(icon());
    // The window's position is saved by the program itself and read by eframe.
    let mut options = NativeOptions { viewport, persist_window: false, ..NativeOptions::default() };
    prefer_x11(&mut options);
    let folder = eframe::storage_dir(APP_ID);
    if let Some(folder) = folder.as_ref().filter(|_| cfg!(unix)) {
        say_homeless(folder);
    }
    let mut kept = Files::new(folder);
    let copy = kept.copy().map(|(_, file)| file);
    files::save_on_exit();
    if let Err(error) = files::save_on_signals() {
        log::warn!("signals end the program without saving: {error}");
    }
    eframe::run_native(
        APP_ID,
        options,
        Box::new(move |cc| {
            let known = cc.storage.and_then(|storage| serde_json::from_str(&storage.get_string(LAYOUT_KEY)?).ok());
            let saved = known.unwrap_or_else(|| SavedView::first(files::reduces_motion()));
            let history = History::new(kept.saved_document());
            let mut app = ChromascopeApp::new(&cc.egui_ctx, history, saved, kept);
            (app.place, app.first_frame) = (WindowPlace::restored(cc.storage), Some(start));
            app.open_at_start(paths);
            Ok(Box::new(app))
        }),
    )?;
    if let Some(copy) = copy.filter(|copy| copy.exists()) {
        crate::terminal::say(&format!("chromascope: this window's document is saved in {}\n", copy.display()));
    }
    Ok(())
}

/// Says where work is kept if the environment names no home: the system then gives that of the user's entry, or, where the name
/// is relative, a folder below the current one.
fn say_homeless(folder: &Path) {
    let named = |name: &str| std::env::var_os(name).map(PathBuf::from);
    let is_home = |home: &PathBuf| home.is_absolute();
    if !named("HOME").as_ref().is_some_and(is_home) && !named("XDG_DATA_HOME").as_ref().is_some_and(is_home) {
        let folder = folder.display();
        crate::terminal::say(&format!("chromascope: HOME names no folder; work is saved in {folder}\n"));
    }
}

/// The window's icon; a plain one if the file in the program were damaged.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default()
}

/// Under Wayland the window library delivers no dropped files; where X11 is there too, it is taken.
#[cfg(target_os = "linux")]
fn prefer_x11(options: &mut NativeOptions) {
    use winit::platform::x11::EventLoopBuilderExtX11 as _;
    if std::env::var_os("DISPLAY").is_some_and(|value| !value.is_empty()) {
        options.event_loop_builder = Some(Box::new(|builder| {
            builder.with_x11();
        }));
    }
}

#[cfg(not(target_os = "linux"))]
fn prefer_x11(_: &mut NativeOptions) {}

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
    pub(super) fn restored(storage: Option<&dyn eframe::Storage>) -> Self {
        let settings: Option<WindowSettings> = storage.and_then(|storage| eframe::get_value(storage, WINDOW_KEY));
        let normal = settings.as_ref().map(WindowSettings::normal_geometry);
        Self { settings, normal, seen: Seen::default() }
    }

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
        // In the form of a session: a second one would be code for each of its types.
        match serde_json::to_string(&self.saved_view()) {
            Ok(view) => eframe::Storage::set_string(&mut values, LAYOUT_KEY, view),
            Err(error) => log::warn!("the layout could not be saved: {error}"),
        }
        self.files.save_layout(&values.0, now);
    }
}
