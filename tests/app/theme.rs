//! Tests of the palette: visible against its background, and distinguishable, in any kind of color vision.

use chromascope::palette::Colors;
use chromascope::theme::{self, SourceInks, Surround, Theme};
use chromascope_core::colorimetry::{
    Lab, Xyz, delta_e_2000,
    lab::lab_from_xyz,
    rgb::{XYZ_FROM_SRGB, srgb_inverse_transfer, srgb_white},
};
use chromascope_figure::{Ink, InkRole, Palette as _};
use egui::Color32;

/// Machado, Oliveira and Fernandes 2009, severity 1.0: normal, protan, deutan and tritan sight, in linear RGB.
const SIGHTS: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.152_286, 1.052_583, -0.204_868], [0.114_503, 0.786_281, 0.099_216], [-0.003_882, -0.048_116, 1.051_998]],
    [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_820, 0.042_940, 0.968_881]],
    [[1.255_528, -0.076_749, -0.178_779], [-0.078_411, 0.930_809, 0.147_602], [0.004_733, 0.691_367, 0.303_900]],
];

fn linear(color: Color32) -> [f64; 3] {
    let [r, g, b, _] = color.to_array();
    [r, g, b].map(|v| srgb_inverse_transfer(f64::from(v) / 255.0))
}

/// WCAG 2.1 contrast ratio.
fn contrast(a: Color32, b: Color32) -> f64 {
    let luminance = |color| {
        let [r, g, b] = linear(color);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (a, b): (f64, f64) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

fn seen(color: Color32, sight: &[[f64; 3]; 3]) -> Lab {
    let rgb = linear(color);
    let [r, g, b] = sight.map(|row| (0..3).map(|i| row[i] * rgb[i]).sum::<f64>().clamp(0.0, 1.0));
    let xyz = Xyz::from_vector(XYZ_FROM_SRGB * glam::DVec3::new(r, g, b));
    lab_from_xyz(xyz, srgb_white()).expect("the white of sRGB is positive")
}

/// The smallest color difference of two colors, over all kinds of sight.
fn closest(colors: &[Color32]) -> f64 {
    let mut least = f64::INFINITY;
    for sight in &SIGHTS {
        let labs: Vec<Lab> = colors.iter().map(|color| seen(*color, sight)).collect();
        for (i, a) in labs.iter().enumerate() {
            for b in &labs[..i] {
                least = least.min(delta_e_2000(*a, *b));
            }
        }
    }
    least
}

fn keys(theme: &Theme, sources: usize) -> Vec<Color32> {
    let colors = theme.colors;
    [colors.reference, colors.observer]
        .into_iter()
        .chain(colors.sources.into_iter().take(sources))
        .map(theme::rgb)
        .collect()
}

#[test]
fn sources_stand_out_from_the_plot() {
    for (theme, least) in [(Theme::DARK, 4.0), (Theme::LIGHT, 3.0)] {
        for color in keys(&theme, 8) {
            let ratio = contrast(color, theme.plot);
            assert!(ratio >= least, "{color:?} on {:?}: {ratio:.2}", theme.plot);
        }
    }
}

#[test]
fn sources_are_told_apart_by_everyone() {
    for theme in [Theme::DARK, Theme::LIGHT] {
        let (few, all) = (closest(&keys(&theme, 4)), closest(&keys(&theme, 8)));
        assert!(few >= 16.0, "dark {}: truth, observer, 1-4: {few:.2}", theme.dark);
        assert!(all >= 11.7, "dark {}: all: {all:.2}", theme.dark);
    }
}

#[test]
fn gray_inks_differ_in_lightness() {
    for colors in [Colors::PRINT, Colors::LIGHT, Colors::DARK].map(|colors| colors.with_inks(SourceInks::Gray)) {
        let mut lightness: Vec<f64> =
            colors.sources.iter().map(|color| seen(theme::rgb(*color), &SIGHTS[0]).l).collect();
        lightness.push(seen(theme::rgb(colors.plot), &SIGHTS[0]).l);
        lightness.sort_by(f64::total_cmp);
        assert!(lightness.windows(2).all(|pair| pair[1] - pair[0] > 7.0), "{lightness:?}");
    }
}

#[test]
fn text_is_legible_everywhere() {
    for theme in [Theme::DARK, Theme::LIGHT] {
        for ground in [theme.panel, theme.plot, theme.control, theme.hover, theme.chosen] {
            assert!(contrast(theme.text, ground) >= 4.5, "text on {ground:?}");
        }
        for ground in [theme.panel, theme.plot] {
            for color in [theme.weak, theme.warning, theme.error] {
                assert!(contrast(color, ground) >= 4.5, "{color:?} on {ground:?}");
            }
        }
    }
    for surround in [Surround::Middle, Surround::Dark, Surround::Light] {
        assert!(contrast(theme::rgb(surround.color()), theme::rgb(surround.ink())) >= 4.5);
    }
}

#[test]
fn the_frame_is_gray() {
    for theme in [Theme::DARK, Theme::LIGHT] {
        let visuals = theme.style().visuals;
        let widgets = &visuals.widgets;
        let states = [&widgets.noninteractive, &widgets.inactive, &widgets.hovered, &widgets.active, &widgets.open];
        let mut colors = vec![
            visuals.selection.bg_fill,
            visuals.selection.stroke.color,
            visuals.hyperlink_color,
            visuals.panel_fill,
            visuals.window_fill,
            visuals.extreme_bg_color,
            visuals.faint_bg_color,
            visuals.code_bg_color,
            visuals.text_cursor.stroke.color,
            theme.plot,
            theme.grid,
            theme.line,
            theme.weak,
        ];
        colors.extend(states.iter().flat_map(|s| [s.bg_fill, s.weak_bg_fill, s.bg_stroke.color, s.fg_stroke.color]));
        for color in colors {
            assert!(color.r() == color.g() && color.g() == color.b(), "{color:?} has a tint");
        }
        assert!(widgets.active.bg_stroke.width > 1.0, "the keyboard's focus shows");
    }
}

#[test]
fn roles_have_colors_and_data_keep_theirs() {
    let theme = Theme::LIGHT;
    assert_eq!(theme.colors.rgb(InkRole::Rgb([1, 2, 3])), [1, 2, 3]);
    assert_eq!(theme.colors.rgb(InkRole::Sensor(8)), theme.colors.rgb(InkRole::Sensor(0)));
    assert_eq!(theme.ink(Ink::new(InkRole::Reference).faded(0.0)), Color32::TRANSPARENT);
    let dark = theme.with_surround(Surround::Dark);
    assert_eq!(dark.colors.rgb(InkRole::OnSurround), [255; 3]);
}

#[test]
fn all_fonts_are_there() {
    let fonts = theme::fonts();
    for family in [egui::FontFamily::Proportional, egui::FontFamily::Monospace, theme::bold()] {
        let names = &fonts.families[&family];
        assert!(!names.is_empty() && names.iter().all(|name| fonts.font_data.contains_key(name)));
    }
}
