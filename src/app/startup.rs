//! Opening the window, or saying why it cannot open.

use std::path::{Path, PathBuf};
use std::time::Instant;

use eframe::{NativeOptions, egui::ViewportBuilder};

use super::{ChromascopeApp, LAYOUT_KEY};
use crate::action::history::History;
use crate::files::{self, Files};
use crate::view::SavedView;

/// The program's name in the system: folders, window class.
const APP_ID: &str = "chromascope";

/// What there is without a window.
const WITHOUT: &str = "Without a window, `chromascope locus`, `patches`, `compare`, `light`, `matrix`, `figure`, `report`, `render`, \
                       `identify`, `inspect`, `bench` and `list` do the same.";

/// Reason that the window did not open.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// There is no screen to open it on.
    #[error(
        "no display: neither DISPLAY nor WAYLAND_DISPLAY is set.\n{}\n\
         For a window without a screen, install the Debian package xvfb and run `xvfb-run chromascope`.",
        WITHOUT
    )]
    NoDisplay,
    /// The system refused.
    #[error(
        "the window could not be opened: {0}.\n\
         It needs X11 (Debian packages libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0 libgl1) or Wayland \
         (libwayland-client0 libwayland-egl1 libxkbcommon0 libegl1), and libgl1-mesa-dri.\n{without}",
        without = WITHOUT
    )]
    Refused(#[from] eframe::Error),
}

/// Opens the window with these files. Returns when it is closed.
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
            let known: Option<SavedView> = cc.storage.and_then(|s| eframe::get_value(s, LAYOUT_KEY));
            let mut saved = known.unwrap_or_else(|| SavedView::first(files::reduces_motion()));
            saved.mend();
            let history = History::new(kept.saved_document());
            let mut app = ChromascopeApp::new(&cc.egui_ctx, history, saved, kept);
            app.restore_place(cc.storage);
            app.report_first_frame(start);
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
