//! Tests of the app: reducer, results, panes, rules, pictures, the command line.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

mod accuracy;
mod added_camera;
mod architecture;
mod assets;
mod bench;
mod cli;
mod cli_render;
mod cli_render_image;
mod correction;
mod cpu_renderer;
mod diagram;
mod differences;
mod doubt;
mod exports;
mod figure;
mod figure_page;
mod figure_words;
mod finding;
mod focus;
#[cfg(target_os = "linux")]
mod frames;
mod golden;
mod help;
mod import;
mod import_files;
mod import_keys;
mod import_looks;
mod import_switches;
mod import_text;
mod inspector;
#[cfg(unix)]
mod keeping;
mod keyboard;
mod library;
mod lights;
mod measure;
mod measure_shots;
mod measured_doubts;
mod meshes;
mod metrics;
mod opened;
mod opening;
mod own_data;
mod own_uncertainty;
mod panes;
mod path_box;
mod plots;
mod profiler;
mod recompute;
mod recorded;
mod recorded_tables;
mod reducer;
mod render;
mod render_scene;
mod report;
mod results;
mod same_file;
mod save_prompt;
mod save_set;
mod screenshots;
mod sessions;
mod settings;
mod shell;
mod spectral_images;
mod starts;
mod steering;
mod table;
mod temperature;
mod theme;
mod waiting;
mod words;

/// Names of the built-in sets.
fn built_in_names() -> chromascope::document::names::BuiltInNames {
    chromascope::catalog::Catalog::built_in().names().clone()
}

fn import_sets(sets: Vec<chromascope::document::imported::ImportedSet>) -> chromascope::action::Action {
    chromascope::action::Action::Imported(chromascope::action::ImportedAction::Import {
        sets,
        built_in: built_in_names(),
    })
}
