//! Pictures of the head: a frame beside its aim, and how cost grows.

use crate::asker::Remembering;
use crate::library::{defaults, shared, sixty};
use crate::pictures::RenderService;
use crate::stopwatch::median;
use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Xy;
use chromascope_core::query::Ask;
use chromascope_core::query::render::MeshQuery;
use chromascope_core::render::{Quality, RasterSize, Shadows};
use std::time::Instant;

/// The truth and the cameras of the paper's third experiment.
fn studio() -> RenderService {
    RenderService::new(&defaults()[..4])
}

fn milliseconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    1e3 * start.elapsed().as_secs_f64()
}

/// The median time of a frame after a change; what the first frame needed is known already.
fn frame(rounds: usize, mut studio: RenderService, change: impl Fn(&mut RenderService, usize)) -> f64 {
    let ask = Remembering::default();
    studio.take(&ask);
    let known = ask.len();
    let times = (1..=rounds).map(|round| {
        ask.keep(known);
        change(&mut studio, round);
        milliseconds(|| {
            studio.take(&ask);
        })
    });
    median(&mut times.collect::<Vec<_>>())
}

/// The largest error of any source's signals, relative to its largest, at each eighth sample across and down.
fn error(mut studio: RenderService, quality: Quality) -> f64 {
    studio.size = RasterSize::new(64, 64);
    let ask = Remembering::default();
    studio.quality = quality;
    let found = studio.images(&ask);
    studio.quality = Quality::Reference;
    let exact = studio.images(&ask);
    let mut worst = 0.0_f32;
    for (found, exact) in found.iter().zip(&exact) {
        let peak = exact.signals().iter().flatten().fold(0.0_f32, |m, v| m.max(v.abs()));
        for (f, e) in found.signals().iter().flatten().zip(exact.signals().iter().flatten()) {
            worst = worst.max((f - e).abs() / peak);
        }
    }
    f64::from(worst)
}

/// Times of whole frames beside what is aimed at.
pub(crate) fn render(rounds: usize) {
    let first = studio();
    let ask = Remembering::default();
    let triangles = ask.ask(&first.mesh).triangles().len();
    let lit = (*ask.ask(&first.geometry())).as_ref().unwrap().counts().lit;
    println!("\na frame: head of {triangles} triangles, 512 × 512, 4 sources, {lit} samples lit");
    println!("  {:<44} {:>10} {:>8}  max error, of peak", "", "median", "aim");
    let line = |name: &str, aim: f64, time: f64, error: f64| {
        println!("  {name:<44} {time:>7.2} ms {aim:>5.0} ms  {error:.1e}");
    };
    let preview = || RenderService { quality: Quality::Preview, ..studio() };
    let full = || RenderService { shadows: Shadows::Full, ..studio() };
    let orbit = |studio: &mut RenderService, round: usize| studio.yaw = 0.3 + 0.01 * round as f64;
    line("orbit, preview", 16.0, frame(rounds, preview(), orbit), error(preview(), Quality::Preview));
    line("orbit, full", 16.0, frame(rounds, full(), orbit), error(full(), Quality::Full));
    let light = |studio: &mut RenderService, round: usize| studio.light_right += round as f64;
    line("light moved, preview", 16.0, frame(rounds, preview(), light), error(preview(), Quality::Preview));
    for sigma in [5e-6, 0.3e-6, 0.05e-6] {
        let start = || RenderService { sigma_m: sigma, ..full() };
        let slide = |studio: &mut RenderService, round: usize| studio.sigma_m = sigma * (1.0 + 1e-3 * round as f64);
        let name = format!("σ moved at {:.2} µm", sigma * 1e6);
        line(&name, 5.0, frame(rounds, start(), slide), error(start(), Quality::Full));
    }
    let expose = |studio: &mut RenderService, round: usize| studio.ev = 0.01 * round as f64;
    line("exposure moved", 1.0, frame(rounds, full(), expose), error(full(), Quality::Full));
    let balance = |studio: &mut RenderService, round: usize| {
        let white = WhiteBalanceTarget::from_chromaticity(Xy { x: 0.33 + 1e-4 * round as f64, y: 0.34 }).unwrap();
        studio.sources.iter_mut().for_each(|source| source.white = white);
    };
    line("white moved", 1.0, frame(rounds, full(), balance), error(full(), Quality::Full));
}

/// Median times of the stages of a frame, in milliseconds, with everything that a frame does not change known.
fn stages(rounds: usize, studio: &mut RenderService) -> [f64; 5] {
    let ask = Remembering::default();
    studio.take(&ask);
    let known = ask.len();
    let mut times: [Vec<f64>; 5] = Default::default();
    for round in 1..=rounds {
        ask.keep(known);
        studio.yaw += 0.01 * round as f64;
        times[0].push(milliseconds(|| drop(ask.ask(&studio.visibility()))));
        times[1].push(milliseconds(|| drop(ask.ask(&studio.geometry()))));
        times[2].push(milliseconds(|| drop(ask.ask(&studio.shading()))));
        times[3].push(milliseconds(|| drop(studio.images(&ask))));
        times[4].push(milliseconds(|| {
            studio.take(&ask);
        }));
    }
    times.each_mut().map(|times| median(times))
}

/// How the stages' times grow with pixels, triangles, sources and threads.
pub(crate) fn growth(rounds: usize) {
    let rounds = rounds.min(9);
    println!("\nhow a frame grows, milliseconds a stage (full quality, preview shadows; otherwise as above)");
    let heads = ["visibility", "geometry", "shading", "signals", "pixels", "sum"];
    println!("  {:<24} {}", "", heads.map(|head| format!("{head:>10}")).concat());
    let line = |name: &str, times: [f64; 5]| {
        let sum: f64 = times.iter().sum();
        let cells: Vec<String> = times.iter().chain([&sum]).map(|time| format!("{time:>10.2}")).collect();
        println!("  {name:<24} {}", cells.concat());
    };
    for side in [128, 256, 512, 1024, 2048] {
        let mut studio = RenderService { size: RasterSize::new(side, side), ..studio() };
        line(&format!("{side} × {side} pixels"), stages(rounds, &mut studio));
    }
    for triangles in [2_000, 20_000, 100_000, 500_000, 2_000_000] {
        let mut studio = RenderService { mesh: MeshQuery::Head(triangles), ..studio() };
        line(&format!("{triangles} triangles"), stages(rounds, &mut studio));
    }
    let mut sensors = vec![shared(crate::library::DEFAULT[0])];
    sensors.extend(sixty());
    for count in [1, 4, 10, 50] {
        let mut studio = RenderService::new(&sensors[..count]);
        line(&format!("{count} sources"), stages(rounds, &mut studio));
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    for threads in (0..).map(|n| 1 << n).take_while(|&threads| threads <= cores) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        line(&format!("{threads} threads"), pool.install(|| stages(rounds, &mut studio())));
    }
}
