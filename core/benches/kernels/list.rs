//! The kernels: what every frame, every chart and every file is made of.

use std::fmt::Write as _;
use std::hint::black_box;
use std::sync::Arc;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::batch::Sample;
use chromascope_core::camera::rendering::{raw, under_light};
use chromascope_core::camera::{
    Batch, ColorTransform, LocusEvaluator, LocusTable, LocusTableError, Rendering, WhiteBalanceTarget,
};
use chromascope_core::colorimetry::{Lab, Uv60, delta_e_2000, delta_e_2000_into};
use chromascope_core::light::PlanckianLocus;
use chromascope_core::reflectance::{Normalization, Precision, Surface, diffuse_sum, wavelength_power};
use chromascope_core::render::diffuse::{by_moments, by_nodes, rough_basis};
use chromascope_core::render::{
    CameraImage, Demand, Development, GeometryImage, Plan, Quality, RasterSize, ShadingImage, Shadows, SpectralWeights,
    Stop, Visibility, develop,
};
use chromascope_core::scene::{Lighting, SUN_RADIUS, Viewpoint};
use chromascope_core::spectral::{GridSpectrum, Quantity, Sensor, SpectralDistribution};
use chromascope_core::units::Kelvin;
use chromascope_math::dot::dot;
use chromascope_mesh::{ShadowTree, shapes};
use glam::DVec3;
use spectral_file::{ReadOptions, read};

use crate::Work;
use crate::library::{CHART, CONSTANTS, equal_energy, patches, sensor, text};

/// One kernel by its name.
pub(crate) struct Kernel {
    pub(crate) name: &'static str,
    /// Number of runs per timing or count.
    pub(crate) count: u64,
    /// Makes what it needs.
    pub(crate) ready: fn() -> Work,
}

/// The kernel that times are shown beside.
pub(crate) const BASELINE: &str = "dot_401";

pub(crate) const KERNELS: &[Kernel] = &[
    Kernel { name: "dot_401", count: 10_000, ready: dot_401 },
    Kernel { name: "sum_direct", count: 10_000, ready: || sum(5.0, 7.0) },
    Kernel { name: "sum_saddle", count: 10_000, ready: || sum(1e3, 2e3) },
    Kernel { name: "integral_by_nodes", count: 2000, ready: nodes },
    Kernel { name: "integral_by_moments", count: 10_000, ready: moments },
    Kernel { name: "plan_searched", count: 1, ready: searched },
    Kernel { name: "plan_1000_samples", count: 20, ready: planned },
    Kernel { name: "locus_evaluator", count: 10_000, ready: || locus(false) },
    Kernel { name: "locus_sum", count: 500, ready: || locus(true) },
    Kernel { name: "locus_rules", count: 2, ready: rules },
    Kernel { name: "locus_table_1000", count: 50, ready: tabulated },
    Kernel { name: "chart_24_patches", count: 500, ready: chart },
    Kernel { name: "batch_96_by_12", count: 20, ready: || batch(|x| x) },
    Kernel { name: "batch_96_by_12_f32", count: 20, ready: || batch(|x| x as f32) },
    Kernel { name: "delta_e_2000", count: 5000, ready: difference },
    Kernel { name: "delta_e_2000_1000", count: 10, ready: differences },
    Kernel { name: "nearest_black_body", count: 5000, ready: nearest },
    Kernel { name: "sprague_81_to_401", count: 200, ready: sprague },
    Kernel { name: "csv_4000_samples", count: 2, ready: csv },
    Kernel { name: "sphere_96", count: 2, ready: || sphere(1e-6) },
    Kernel { name: "sphere_96_0.3_um", count: 2, ready: || sphere(0.3e-6) },
    Kernel { name: "sphere_96_0.1_um", count: 2, ready: || sphere(0.1e-6) },
    Kernel { name: "sphere_96_0.05_um", count: 2, ready: || sphere(0.05e-6) },
    Kernel { name: "light_changed_96", count: 4, ready: light_changed },
    Kernel { name: "roughness_changed_96", count: 4, ready: roughness_changed },
];

const CAMERA: &str = "cameras/canon_eos_10d_2007_figure.csv";
const OBSERVER: &str = "observers/cie_1931_2deg.csv";

fn camera() -> Sensor {
    sensor(&text(CAMERA))
}

fn dot_401() -> Work {
    let a: Vec<f64> = (0..401).map(|i| f64::from(i) * 0.01).collect();
    let b = a.clone();
    Box::new(move || dot(black_box(&a), black_box(&b)))
}

fn sum(g: f64, b: f64) -> Work {
    Box::new(move || diffuse_sum(black_box(g), black_box(b), Precision::Full))
}

/// The camera under equal energy before a gray.
fn measure() -> (Rendering, SpectralWeights) {
    let (camera, light) = (camera(), equal_energy());
    let rendering = Rendering::new(&camera, &light, WhiteBalanceTarget::UNITY, ColorTransform::Paper).unwrap();
    let power = wavelength_power(Normalization::Radiometric);
    let measure = SpectralWeights::new(&camera, &light, &GridSpectrum::constant(0.5), rendering.white_integrals, power);
    (rendering, measure)
}

fn nodes() -> Work {
    let (_, measure) = measure();
    Box::new(move || by_nodes(measure.fine(), black_box(10.0), black_box(3.0), Precision::Fine)[1])
}

fn moments() -> Work {
    let (_, measure) = measure();
    Box::new(move || by_moments(measure.moments(), &rough_basis(black_box(400.0), black_box(3.0)))[1])
}

/// A plan for a picture, found and its table filled.
fn searched() -> Work {
    let (_, measure) = measure();
    let (tolerance, demand) = (RelTolerance::new(1e-5).unwrap(), Demand::of_picture([0.1, 100.0], 100_000));
    Box::new(move || Plan::new(black_box(&measure), tolerance, demand).unwrap().at(1.0, 1.0)[1])
}

/// Samples from smooth to rough and from the peak into the dark, by a plan that took a table and moments.
fn planned() -> Work {
    let demand = Demand::new([1e-2, 1e4], 10_000_000);
    let plan = Plan::new(&measure().1, RelTolerance::new(1e-5).unwrap(), demand).unwrap();
    let point = |i: u32| [1e-2 * 1e6_f64.powf(f64::from(i) / 999.0), 0.03 * f64::from(i * 389 % 1000)];
    let points: Vec<[f64; 2]> = (0..1000).map(point).collect();
    let mut sums = vec![[0.0; 3]; points.len()];
    Box::new(move || {
        plan.fill(black_box(&points), &mut sums);
        sums[500][1]
    })
}

fn locus(by_sum: bool) -> Work {
    let camera = Arc::new(camera());
    let evaluator = if by_sum { LocusEvaluator::by_sum } else { LocusEvaluator::new }(camera, CONSTANTS);
    let t = Kelvin::new(5500.0).unwrap();
    Box::new(move || evaluator.raw(black_box(t))[1])
}

fn rules() -> Work {
    let camera = Arc::new(camera());
    let t = Kelvin::new(5500.0).unwrap();
    Box::new(move || LocusEvaluator::new(Arc::clone(&camera), CONSTANTS).raw(t)[1])
}

/// Blackbodies of 1000 K to 20 000 K in no order.
fn tabulated() -> Work {
    let table = LocusTable::new(&camera(), &measure().0, CONSTANTS);
    let kelvin = |i: u32| Kelvin::new(1e6 / (50.0 + 0.95 * f64::from(i * 389 % 1000))).unwrap();
    let temperatures: Vec<Kelvin> = (0..1000).map(kelvin).collect();
    let mut answers = vec![Err(LocusTableError::Outside); temperatures.len()];
    Box::new(move || {
        table.xys_into(black_box(&temperatures), &mut answers);
        answers[500].map_or(0.0, |xy| xy.x)
    })
}

/// From reflectances to L*a*b*, the camera's product with the light made once.
fn chart() -> Work {
    let (patches, rendering) = (patches(CHART), measure().0);
    let product = under_light(&camera(), &equal_energy());
    Box::new(move || {
        let lightness = black_box(&patches).patches().iter().map(|patch| {
            let signals = rendering.patch_signals(raw(&product, patch.grid.values()).to_array());
            rendering.lab(rendering.xyz(signals)).map_or(0.0, |lab| lab.l)
        });
        lightness.sum()
    })
}

fn difference() -> Work {
    let (a, b) = (Lab { l: 50.0, a: 2.5, b: -80.0 }, Lab { l: 58.0, a: 24.0, b: 15.0 });
    Box::new(move || delta_e_2000(black_box(a), black_box(b)))
}

/// 96 spectra of 401 samples to 12 channels.
fn batch<T: Sample + Into<f64> + 'static>(number: fn(f64) -> T) -> Work {
    let numbers = |count: u32| (0..count).map(|i| number(f64::from(i * 389 % 1000) / 1000.0)).collect::<Vec<T>>();
    let (curves, spectra) = (Batch::new(&numbers(12 * 401), 401).unwrap(), numbers(96 * 401));
    let mut answers = curves.responses(&spectra).unwrap();
    Box::new(move || {
        curves.responses_into(black_box(&spectra), &mut answers).unwrap();
        answers[500].into()
    })
}

/// Pairs far apart, near and equal.
fn differences() -> Work {
    let color = |i: u32| Lab {
        l: f64::from(i * 389 % 1000) / 10.0,
        a: f64::from(i * 71 % 1000) / 5.0 - 100.0,
        b: f64::from(i * 953 % 1000) / 5.0 - 100.0,
    };
    let firsts: Vec<Lab> = (0..1000).map(color).collect();
    let seconds: Vec<Lab> = (0..1000).map(|i| color(i + i % 3)).collect();
    let mut answers = vec![0.0; firsts.len()];
    Box::new(move || {
        delta_e_2000_into(black_box(&firsts), black_box(&seconds), &mut answers);
        answers[500]
    })
}

fn nearest() -> Work {
    let locus = PlanckianLocus::new(&sensor(&text(OBSERVER)), CONSTANTS).unwrap();
    let color = Uv60 { u: 0.21, v: 0.33 };
    Box::new(move || locus.cct(black_box(color)).map_or(0.0, |cct| cct.temperature.get()))
}

fn sprague() -> Work {
    let nm: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
    let values = nm.iter().map(|nm| 0.5 + 0.4 * (nm / 40.0).sin()).collect();
    let spectrum = SpectralDistribution::new(nm, values).unwrap();
    Box::new(move || GridSpectrum::resample(black_box(&spectrum), Quantity::Reflectance).values()[200])
}

fn csv() -> Work {
    let mut file = String::from("wavelength (nm),reflectance\n");
    for i in 0..4000 {
        let nm = 380.0 + 0.1 * f64::from(i);
        writeln!(file, "{nm:.1},{:.6}", 0.5 + 0.4 * (nm / 40.0).sin()).unwrap();
    }
    Box::new(move || {
        let table = read(black_box(file.as_bytes()), &ReadOptions::default()).unwrap();
        table.curves.len() as f64
    })
}

/// Angles of a small frame of a sphere, its mesh's tree made once.
fn angles() -> impl Fn() -> GeometryImage {
    let mesh = shapes::sphere(2000);
    let tree = ShadowTree::new(&mesh);
    let lighting = Lighting::far(DVec3::new(0.5, 0.6, 0.8), SUN_RADIUS).unwrap();
    let viewpoint = Viewpoint::new(0.3, 0.2, 3.0, 0.7).unwrap();
    move || {
        let eye = viewpoint.eye(mesh.bounds());
        let seen = Visibility::new(&mesh, eye, RasterSize::new(96, 96), &Stop::NEVER).unwrap();
        GeometryImage::new(&mesh, &seen, &lighting, Some((&tree, Shadows::Full)), &Stop::NEVER).unwrap()
    }
}

fn shading(geometry: Arc<GeometryImage>, sigma_m: f64) -> ShadingImage {
    let surface = Surface::new(sigma_m, 10e-6, 50e-6, 50e-6, 1.5).unwrap();
    ShadingImage::new(geometry, surface, Normalization::Radiometric, Quality::Full, &Stop::NEVER).unwrap()
}

/// Sum of a frame's signals.
fn signals(shading: &ShadingImage, measure: &SpectralWeights, plan: &Arc<Plan>) -> f64 {
    let image = CameraImage::new(shading, measure, Arc::clone(plan), &Stop::NEVER).unwrap();
    image.signals().as_flattened().iter().map(|&v| f64::from(v)).sum()
}

/// Roughnesses of the frames after a change.
const CHANGED: [f64; 3] = [5e-6, 2e-6, 0.7e-6];

/// From a light to signals, the shading made once: weights, and whatever method of integration has to be made for them.
fn light_changed() -> Work {
    let geometry = Arc::new(angles()());
    let shadings = CHANGED.map(|sigma_m| shading(Arc::clone(&geometry), sigma_m));
    Box::new(move || {
        let (_, measure) = measure();
        let plan = |shading: &ShadingImage| Arc::new(shading.plan(&measure).unwrap());
        shadings.iter().map(|shading| signals(shading, &measure, &plan(shading))).sum()
    })
}

/// From a roughness to signals, the plans made once, as a slider has them.
fn roughness_changed() -> Work {
    let (geometry, (_, measure)) = (Arc::new(angles()()), measure());
    let plan = |sigma_m| Arc::new(shading(Arc::clone(&geometry), sigma_m).plan(&measure).unwrap());
    let plans = CHANGED.map(plan);
    Box::new(move || {
        let frame = |(&sigma_m, plan)| signals(&shading(Arc::clone(&geometry), sigma_m), &measure, plan);
        CHANGED.iter().zip(&plans).map(frame).sum()
    })
}

/// Every stage from the mesh to pixels at a roughness, the mesh's tree made once.
fn sphere(sigma_m: f64) -> Work {
    let (rendering, measure) = measure();
    let angles = angles();
    Box::new(move || {
        let shading = shading(Arc::new(angles()), sigma_m);
        let plan = Arc::new(shading.plan(&measure).unwrap());
        let image = CameraImage::new(&shading, &measure, plan, &Stop::NEVER).unwrap();
        let development = Development::new(&rendering, 1.0, None);
        develop(&image, &development, &Stop::NEVER).unwrap().rgba.iter().map(|&v| f64::from(v)).sum()
    })
}
