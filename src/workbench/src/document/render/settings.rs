//! Settings of the picture: one entry each, from which control, flag, palette line, undo step and range check are made.

use std::path::PathBuf;

use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{IlluminatedArea, Normalization, Specular};
use chromascope_core::render::QualityLevel;
use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_mesh::head::FEWEST;
use chromascope_text::{Flag, Look, Pick, Setting, Settings, Words, settings};
use spectral_image::ImageQuantity;

use super::{MeshChoice, NEAR, RenderSettings, TOLERANCES};

/// Heads of the groups of settings.
pub const LIGHT: &str = "Mesh and light";
pub const IMAGE: &str = "Spectral image";
pub const SURFACE: &str = "Surface";
pub const VIEW: &str = "View";

const NO_SURFACE: &str = "A spectral image has no surface.";
const NOT_OF_IMAGES: &str = "These do nothing to a spectral image.";

type Entry = Setting<RenderSettings>;

const OF_SURFACE: Entry =
    Setting { group: SURFACE, idle: |s| s.mesh.is_image().then_some(NO_SURFACE), ..Setting::DEFAULT };
const OF_MESH: Entry =
    Setting { group: LIGHT, idle: |s| s.mesh.is_image().then_some(NOT_OF_IMAGES), ..Setting::DEFAULT };
const BESIDE: Entry = Setting { beside: true, ..OF_MESH };
const OF_VIEW: Entry = Setting { group: VIEW, ..OF_MESH };
const OF_IMAGE: Entry = Setting {
    group: IMAGE,
    idle: |s| (!s.mesh.is_image()).then_some("Only a spectral image has samples."),
    ..Setting::DEFAULT
};

/// A setting that has no effect where `is_off`, which its control shows.
const fn unless(of: Entry, idle: fn(&RenderSettings) -> Option<&'static str>) -> Entry {
    Setting { idle, ..of }
}

fn idle(settings: &RenderSettings, why: &'static str, is_off: bool) -> Option<&'static str> {
    if settings.mesh.is_image() { Some(why) } else { is_off.then_some("") }
}

fn least_triangles(settings: &RenderSettings) -> f64 {
    // The head's cages have so many that a smaller number would change nothing. The slider has one range for all meshes: equal
    // numbers have equal places.
    let is_head = settings.mesh == MeshChoice::Head;
    if is_head { FEWEST[usize::from(settings.garment.is_some())] as f64 } else { 2e3 }
}

/// A share from its percentage, without the last digit that multiplying by 100 gives a share such as 0.007.
fn share(percent: f64) -> f64 {
    (percent * 1e10).round() / 1e12
}

const SCENE: Flag = Flag { heading: "Scene", ..Flag::NONE };
const PICTURE: Flag = Flag { heading: "Picture", ..Flag::NONE };
const MODEL: Flag = Flag { heading: SURFACE, ..Flag::NONE };
/// Controls have micrometers.
const METERS: f64 = 1e6;
const ERRORS: [f64; 2] = [*TOLERANCES.start(), *TOLERANCES.end()];

const AS_IN_FILE: Words = Words::new("", "As in the file", "The quantity that the file states");
const OWN_LIGHT: [Words; 2] = [
    Words::new("sun", "Sun, D55", "Direct sun (ASTM G173), balanced to D55, in this workspace alone"),
    Words::new(
        "scene",
        "As above",
        "The light and white balance of all workspaces; choosing one above while pictures are visible chooses this too",
    ),
];
const LIGHTS: Pick<RenderSettings> = Pick {
    get: |s| usize::from(!s.sunlight),
    set: |s, to| s.sunlight = to == 0,
    all: || OWN_LIGHT.iter().collect(),
    look: Look::Row,
};

impl Settings for RenderSettings {
    const ALL: &'static [Entry] = settings! {
        "mesh" "Mesh" in Setting { group: LIGHT, ..Setting::DEFAULT }, by "", "What is rendered", own(), elsewhere("mesh");
        "image_quantity" "Quantity of the image" in OF_IMAGE, by "samples", "Quantity of the image's samples",
            pick(image_quantity: ImageQuantity, List, or AS_IN_FILE),
            flag(SCENE, "image-quantity", "QUANTITY", ", overriding the file"; needs: "image");
        "image_scale" "Scale of the image" in OF_IMAGE, by "samples",
            "Sample that stands for 1, such as 10000, where the file does not state it",
            field(image_scale, "", [1e-12, 1e12]; field: true),
            flag(SCENE, "image-scale", "VALUE", ""; usual: "1", range: [f64::MIN_POSITIVE, f64::MAX], needs: "image");
        "triangles" "Triangles" in unless(OF_MESH, |s| {
            idle(s, NOT_OF_IMAGES, matches!(s.mesh, MeshChoice::Plane | MeshChoice::File(_)))
        }), by "mesh resolution",
            "Approximate number of triangles of head, fern and sphere. Generating a mesh takes longer than drawing it",
            number(|s| s.triangles as f64, |s, to| s.triangles = to as usize, "", [2e3, 2e6];
                   log_from: Some(1.0), clamps: true, floor: least_triangles),
            flag(SCENE, "triangles", "N", ""; usual: "100000", range: [8.0, 5e6], whole: true);
        "material" "Material" in OF_MESH, by "", "Reflectance of the surface", own(), elsewhere("material");
        "garment" "Garment" in unless(OF_MESH, |s| idle(s, NOT_OF_IMAGES, s.mesh != MeshChoice::Head)), by "clothes",
            "Reflectance of the head's garment, which scatters evenly. Figures 8 and 9 have none",
            own(), elsewhere("garment");
        "sunlight" "Light and white balance" in OF_MESH, by "sun scene",
            "Light and white balance of the pictures: their own, or those of the scene bar",
            choice(LIGHTS), elsewhere("illuminant");
        "light_up_deg" "Light elevation" in OF_MESH, by "direction height sun",
            "Elevation of the light above the view axis; it moves with the viewpoint",
            field(light_up_deg, "°", [-90.0, 90.0]; step: Some(1.0)), elsewhere("light");
        "light_right_deg" "Light azimuth" in OF_MESH, by "direction side sun",
            "Azimuth of the light to the right of the view axis; negative is left, beyond 90° is behind",
            field(light_right_deg, "°", [-180.0, 180.0]; step: Some(1.0)), elsewhere("light");
        "sky" "Sky" in OF_MESH, by "skylight ambient hemisphere",
            "Uniform sky above the horizon, of the light's spectrum: irradiance of a level surface over that of a surface \
             that faces the light. About 15 % on a clear day. Figures 8 and 9 have none",
            number(|s| 100.0 * s.sky, |s, to| s.sky = share(to), " %", [0.0, 100.0]; step: Some(1.0), clamps: true),
            flag(SCENE, "sky", "SHARE", "; from 0 to 1 [default: 0.15; none in the paper's start, whose light is a point]";
                 range: [0.0, 1.0], scale: 100.0);
        "shadows" "Shadows" in OF_MESH, by "", "Self-shadowing of the mesh",
            switch(|s| s.shadows, |s, on| s.shadows = on), flag(SCENE, "no-shadows", "", ", turned off";);
        "light_radius" "Sun's disk" in BESIDE, by "light radius",
            "A light as wide as the Sun softens the edges of shadows and blurs the specular lobe; a point does not",
            switch(|s| s.light_radius > 0.0, |s, on| s.light_radius = if on { SUN_RADIUS } else { 0.0 }), none();
        "light_distance" "Point light" in BESIDE, by "near",
            "Point light at a finite distance instead of parallel rays; no inverse-square falloff",
            switch(|s| s.light_distance.is_some(), |s, on| s.light_distance = on.then_some(NEAR)), none();
        "chart" "Chart beside the mesh" in OF_MESH, by "patches card ColorChecker swatches",
            "The compared patches as a card beside the mesh, lit as it is. They scatter evenly (Lambert), as does cloth; a white one \
             that faces the light is as bright as a white of the mesh's surface. A click on a patch there selects it",
            switch(|s| s.chart, |s, on| s.chart = on),
            flag(SCENE, "chart", "BOOL", " [default: true; false in the paper's start]";);
        "ground" "Gray ground" in BESIDE, by "floor plane shadow contact",
            "A level gray plane beneath the mesh (neutral 5 of the ColorChecker, 20 %), with the shadow on it and the light that \
             it sends up: one diffuse reflection, spectral",
            switch(|s| s.ground, |s, on| s.ground = on),
            flag(SCENE, "ground", "BOOL", " [default: true; false in the paper's start]";);
        "hair" "Hair and brows" in unless(OF_MESH, |s| idle(s, NOT_OF_IMAGES, s.mesh != MeshChoice::Head)), by "region head",
            "Short hair and brows of the head, of a measured reflectance (brown hair 097, Vrhel). Lips and eyes are of the material: no \
             measured reflectance of theirs with terms of use was found",
            switch(|s| s.hair, |s, on| s.hair = on), flag(SCENE, "hair", "BOOL", " [default: true; false in the paper's start]";);
        "composed" "Composed view" in unless(BESIDE, |s| {
            idle(s, NOT_OF_IMAGES, !matches!(s.mesh, MeshChoice::Head | MeshChoice::Fern))
        }), by "crop portrait framing",
            "As a photographer frames it: the head down to the chest, the fern turned so that no frond points at the eye",
            switch(|s| s.composed, |s, on| s.composed = on),
            flag(SCENE, "composed", "BOOL", " [default: true; false in the paper's start]";);
        "thin" "Light through leaves" in OF_MESH, by "transmittance",
            "Light also passes through, as through a leaf: its transmittance from the material's reflectance by the plate \
             model (PROSPECT: 1.5 plates of index 1.45), alike in all directions",
            switch(|s| s.thin, |s, on| s.thin = on), flag(SCENE, "leaf", "BOOL", " [default: for the fern]";);
        "diffusion" "Diffusion in skin" in unless(BESIDE, |s| idle(s, NOT_OF_IMAGES, s.mesh != MeshChoice::Head)),
            by "subsurface scattering translucent radius",
            "Light of the sun spreads within the head's skin before it leaves: 0.9 mm at 650 nm and 0.2 mm at 450 nm (RMS), by the \
             scattering of skin (Jacques 2013) and the absorption that gives the material's reflectance; the head is 230 mm high",
            switch(|s| s.diffusion, |s, on| s.diffusion = on),
            flag(SCENE, "diffusion", "BOOL", " [default: true; false in the paper's start]";);
        "light_distance" "Light distance" in unless(OF_MESH, |s| idle(s, NOT_OF_IMAGES, s.light_distance.is_none())),
            by "near point light", "Of a point light from the center, in radii of the mesh",
            number(|s| s.light_distance.unwrap_or(NEAR), |s, to| s.light_distance = s.light_distance.map(|_| to),
                   "", [1.1, 100.0]; log_from: Some(1.0)), none();
        "sigma_um" "Roughness σ" in OF_SURFACE, by "RMS sigma surface", "RMS roughness",
            field(sigma_um, " µm", [0.0, 1e3]; log_from: Some(0.01), typed: Some([0.0, 1e6])),
            flag(MODEL, "sigma", "METERS", " in meters [default: 5e-6]"; scale: METERS);
        "roughness" "σ and τ from the mesh, as in the paper" in OF_SURFACE, by "sigma tau roughness", Roughness::Mesh.why(),
            switch(|s| s.roughness == Roughness::Mesh,
                   |s, on| s.roughness = if on { Roughness::Mesh } else { Roughness::Surface }),
            flag(MODEL, "sigma-from-mesh", "", "";);
        "tau_um" "Correlation τ" in OF_SURFACE, by "length tau surface",
            "Correlation length: lag at which the height autocorrelation falls to 1/e",
            field(tau_um, " µm", [0.001, 1e3]; log_from: Some(0.001), typed: Some([0.001, 1e6])),
            flag(MODEL, "tau", "METERS", ", in meters [default: 10e-6]"; scale: METERS);
        "half_sides_um" "Half-widths of the coherently illuminated area" in OF_SURFACE, by "X Y patch surface",
            "Half-widths of the coherently illuminated area",
            pair("Half-width X", "In the plane of incidence", "Half-width Y", "Across the plane of incidence";
                 half_sides_um, " µm", [0.001, 1e6]),
            flag(MODEL, "half-widths", "X,Y", " in meters [default: 50e-6,50e-6]"; alias: "patch", scale: METERS);
        "index" "Index n" in OF_SURFACE, by "refractive Fresnel surface", "The refractive index, the same at all wavelengths",
            field(index, "", [1.0, 3.0]; typed: Some([0.01, 1e3])),
            flag(MODEL, "ior", "N", " [default: 1.4; 1.45 for the fern]";);
        "area" "Illuminated area" in OF_SURFACE, by "surface", "Area A of the patch with those half-widths",
            pick(area: IlluminatedArea, Radio), flag(MODEL, "area", "AREA", ""; usual: "4xy");
        "reading" "Normalization" in OF_SURFACE, by "reflectance model surface", "Normalization of P",
            pick(normalization: Normalization, List),
            flag(MODEL, "normalization", "READING", ". Returned at normal incidence, and at 85°, by the default surface: 0.49 and \
                 0.03 of the light (radiometric), 0.49 and 1.38 (microfacet: more than 1 from about 70°)";
                 alias: "reading", usual: "radiometric");
        "specular" "Coherent component" in unless(OF_SURFACE, |s| {
            idle(s, NO_SURFACE, s.normalization == Normalization::Lambertian)
        }), by "specular lobe surface", "Reflectance factor of the coherent (specular) component",
            pick(specular: Specular, List),
            flag(MODEL, "specular", "SPECULAR", " [default: fresnel; paper in the paper's start]";);
        "exposure_ev" "Exposure" in unless(OF_VIEW, |_| None), by "EV brightness",
            "Exposure, the same for all cameras. At 0 EV the material facing the light has 40 % of the screen's white, or, with a \
             chart beside the mesh, a white has it all; of a spectral image, a reflectance of 1 is that white, or the luminance that 99.5 % of the radiances stay below",
            field(exposure_ev, " EV", [-6.0, 6.0]; step: Some(0.1), valid: Some([-20.0, 20.0]), clamps: true),
            flag(PICTURE, "exposure", "EV", ""; usual: "0", range: [-64.0, 64.0], unit: "EV");
        // A tolerance has a number of its own.
        "quality" "Quality" in OF_VIEW, by "accuracy", "Accuracy of the integrals over wavelength at rest",
            pick(quality: QualityLevel, List), flag(PICTURE, "quality", "QUALITY", ""; usual: "full", except: "tolerance");
        "tolerance" "Tolerance" in unless(OF_VIEW, |s| idle(s, NOT_OF_IMAGES, s.quality != QualityLevel::Tolerance)),
            by "error accuracy", "Largest error of a picture, relative to its brightest sample",
            field(tolerance, "", ERRORS;),
            flag(PICTURE, "tolerance", "ERROR", ", from 1e-13 to 0.1: for each camera the fastest method within it is used, and \
                 stated with its estimated error bound"; range: ERRORS, excludes: "quality");
    };

    fn idle_with() -> Option<(&'static str, Self)> {
        Some(("image", Self { mesh: MeshChoice::Image(PathBuf::new()), ..Self::default() }))
    }
}
