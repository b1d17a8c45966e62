//! CPU time of the window's frames while something moves: their time on a machine with nothing else to do.
//!
//! `cargo test --release --test app -- --ignored --nocapture frames_while`

#![allow(clippy::disallowed_methods, clippy::disallowed_types, clippy::print_stdout, reason = "measures and says it")]

use std::collections::BTreeSet;
use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use chromascope::action::{Action, CompareAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::document::{Document, Light, SetKind};
use chromascope::scene::orbit::Orbit;
use chromascope::workspaces::PaneKind;
use egui_kittest::Harness;

use crate::screenshots::open_with;

type Window = Harness<'static, ChromascopeApp>;

/// Measured frames, and their interval on a screen with 60 Hz.
const FRAMES: usize = 120;
const REFRESH: Duration = Duration::from_micros(16_667);

/// CPU time of a thread in milliseconds, by Linux.
fn cpu_ms(schedstat: &str) -> f64 {
    let text = fs::read_to_string(schedstat).unwrap_or_default();
    text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or_default() / 1e6
}

/// CPU time of all threads of the process.
fn all_cpu_ms() -> f64 {
    let tasks = fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    tasks.map(|task| cpu_ms(&task.path().join("schedstat").to_string_lossy())).sum()
}

/// Prints the CPU time of the window's thread in each frame, and of the others for each picture.
fn measure(name: &str, mut window: Window, mut change: impl FnMut(&mut Window, f64)) {
    window.run_steps(3);
    window.state().render_service.wait();
    window.run_steps(3);
    let (mut frames, mut serials) = (Vec::new(), BTreeSet::new());
    let (start, before) = (Instant::now(), all_cpu_ms());
    for index in 0..FRAMES {
        let (begun, cpu) = (Instant::now(), cpu_ms("/proc/thread-self/schedstat"));
        change(&mut window, index as f64);
        window.step();
        let shapes = window.output().shapes.clone();
        window.ctx.tessellate(shapes, 1.0);
        frames.push(cpu_ms("/proc/thread-self/schedstat") - cpu);
        serials.extend(window.state().render_service.frame().map(|frame| frame.serial));
        thread::sleep(REFRESH.saturating_sub(begun.elapsed()));
    }
    let (own, pictures) = (frames.iter().sum::<f64>(), serials.len());
    frames.sort_by(f64::total_cmp);
    let [median, p95, most] = [0.5, 0.95, 1.0].map(|share| frames[(share * (FRAMES - 1) as f64) as usize]);
    println!(
        "{name}: frame {median:.1} ms of the window's thread, 95 % {p95:.1}, most {most:.1}; {pictures} pictures in \
         {:.1} s, {:.1} ms of all other threads each",
        start.elapsed().as_secs_f64(),
        (all_cpu_ms() - before - own) / pictures.saturating_sub(1).max(1) as f64
    );
}

fn opened(document: Document, pane: PaneKind) -> Window {
    let mut window = open_with(document, [1280.0, 800.0], egui::Theme::Light);
    window.state_mut().view.show(pane);
    window
}

#[test]
#[ignore = "measures"]
fn frames_while_the_head_turns() {
    for (sensors, sigma_um, sky) in [(4, 5.0, 0.15), (2, 5.0, 0.15), (4, 5.0, 0.0), (4, 0.3, 0.15), (4, 0.3, 0.0)] {
        let mut document = Document::paper();
        (document.render.sigma_um, document.render.sky) = (sigma_um, sky);
        let mut cameras = 0;
        document.compared.retain(|source| {
            cameras += usize::from(source.kind == SetKind::Camera);
            source.kind != SetKind::Camera || cameras < sensors
        });
        let name = format!("orbit, 100 000 triangles, {sensors} pictures, \u{3c3} {sigma_um} µm, sky {sky}");
        measure(&name, opened(document, PaneKind::RENDER), |window, degrees| {
            let orbit = Orbit { yaw_deg: degrees - 25.0, ..Orbit::default() };
            window.state_mut().view.saved.render.orbit = Some(orbit);
        });
    }
}

#[test]
#[ignore = "measures"]
fn frames_while_the_temperature_moves() {
    let mut colorimetry = Document::colorimetry();
    Action::Compare(CompareAction::Add(SetKind::Camera, "Canon EOS 5D".to_owned())).apply(&mut colorimetry);
    let mut black_body = Document::paper();
    Action::Scene(SceneAction::SetLight(Light::BlackBody)).apply(&mut black_body);
    // The paper's pictures are in sunlight otherwise, whatever the temperature.
    black_body.render.sunlight = false;
    for (name, document, pane) in [
        ("Compare, the light a blackbody", black_body.clone(), PaneKind::CHROMATICITY),
        ("Render, the light a blackbody", black_body, PaneKind::RENDER),
        ("Compare, Colorimetry's start and one more camera", colorimetry, PaneKind::CHROMATICITY),
    ] {
        measure(&format!("temperature, {name}"), opened(document, pane), |window, index| {
            window.state_mut().push(Action::Scene(SceneAction::SetTemperature(2500.0 + 30.0 * index)));
        });
    }
}
