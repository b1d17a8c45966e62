//! An eframe window with nothing in it: the baseline that the program's launch is measured against (`.ci/launch`).

use std::time::Instant;

/// Reports when its first frame was complete.
struct Empty {
    start: Option<Instant>,
}

impl eframe::App for Empty {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        egui::CentralPanel::default().show(ui, |_| {});
        if let Some(start) = self.start.take() {
            log::info!("first frame after {} ms", start.elapsed().as_millis());
        }
    }
}

fn main() -> Result<(), eframe::Error> {
    let start = Instant::now();
    env_logger::init();
    let viewport = eframe::egui::ViewportBuilder::default().with_inner_size([1280.0, 800.0]);
    let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
    eframe::run_native(
        "empty",
        options,
        Box::new(move |cc| {
            // Without a font egui cannot lay out a frame; the program's own are loaded in both.
            cc.egui_ctx.set_fonts(chromascope::theme::fonts());
            Ok(Box::new(Empty { start: Some(start) }))
        }),
    )
}
