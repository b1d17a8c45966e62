//! `recover narrowband`.

use std::fmt::Write as _;
use std::path::PathBuf;

use chromascope_core::recovery::{Cell as State, NarrowBandRecovery, NarrowBands};
use chromascope_figure::{Cell, Column, Table};
use clap::Args;

use super::{UNNAMED, Written, put};
use crate::catalog::narrow_bands::read_pass;
use crate::cli::error::{Result, refused};
use crate::cli::outputs::{check, show};
use crate::cli::request::{Request, in_file};
use crate::document::start::Start;
use crate::format::{display_path, fixed};
use crate::results::Results;
use crate::scene::recorded::CHANNELS;
use crate::scene::recovery::{built_in_cameras, library};

#[derive(Debug, Args)]
pub(super) struct NarrowBandArguments {
    /// Tables with the columns `wavelength_nm`, `power`, `exposure_s`, `red`, `green`, `blue`, `dark_red`, `dark_green`, `dark_blue` and,
    /// where it is known, `width_nm`: one for each pass over the same bands
    #[arg(value_name = "PASS", required = true)]
    files: Vec<PathBuf>,
    /// Raw value from which on a lit mean is saturated
    #[arg(long, value_name = "LEVEL")]
    clip: f64,
    #[command(flatten)]
    written: Written,
}

pub(super) fn run(arguments: &NarrowBandArguments) -> Result<()> {
    if arguments.clip.is_nan() || arguments.clip <= 0.0 {
        return refused("--clip", "the end of the scale is a positive number");
    }
    let mut request = Request::of_cameras(Start::Colorimetry, "--camera", &[], None)?;
    let mut passes = Vec::new();
    for file in &arguments.files {
        let bytes = request.bytes(file)?;
        passes.push(read_pass(&bytes).map_err(|error| in_file(file, error))?);
    }
    check(arguments.written.out.as_deref(), &request.inputs(), arguments.written.force)?;
    let bands = NarrowBands { passes, clip: arguments.clip };
    let first = &arguments.files[0];
    let nm = bands.wavelengths_nm().map_err(|error| in_file(first, error))?;
    let library = library(&built_in_cameras(&request.catalog), &nm, &Results::default())?;
    arguments.written.format()?;
    let found = bands.recover(&library).map_err(|error| in_file(first, error))?;
    show(&text(&found))?;
    let files: Vec<String> = arguments.files.iter().map(|file| display_path(file)).collect();
    let reduction = "mean quotient of the passes, smoothed by the discrepancy principle (chromascope recover narrowband); cells that were saturated or dark are filled from the library's tables";
    let method = format!("raw means of {} narrow bands, {} passes", nm.len(), files.len());
    let (written, files) = (&arguments.written, files.join(", "));
    let title = written.title.as_deref().unwrap_or(UNNAMED);
    put(title, &found.curves, written, &written.provenance(&files, &method, reduction))
}

fn text(found: &NarrowBandRecovery) -> String {
    let column = |name: &str, decimals| Column { width: 6, decimals: Some(decimals), ..Column::from(name) };
    let heads =
        ["nm", "red", "±", "green", "±", "blue", "±"].map(|name| column(name, if name == "nm" { 0 } else { 4 }));
    let mut table = Table::new(heads.into_iter().chain(["quotient R, G, B".into()]));
    let (own, standard) = (&found.curves, found.curves.standard());
    let peak = found.quotient.iter().flatten().copied().fold(f64::MIN_POSITIVE, f64::max);
    for (k, nm) in own.wavelengths_nm.iter().enumerate() {
        let pair = |c: usize| [own.values[c][k], 2.0 * standard[c][k]];
        let quotient = |c: usize| match found.cells[c][k] {
            State::Saturated => "saturated".to_owned(),
            State::Dark => "dark".to_owned(),
            State::Good => {
                format!("{} ± {}", fixed(found.quotient[c][k] / peak, 4), fixed(2.0 * found.deviation[c][k] / peak, 4))
            }
        };
        let cells = [*nm].into_iter().chain([0, 1, 2].into_iter().flat_map(pair)).map(Cell::from);
        table.push(cells.chain([Cell::from([0, 1, 2].map(quotient).join("  "))]));
    }
    let mut text = table.to_text();
    text += "± is expanded (k = 2). Saturated and dark cells are skipped and filled from the library's tables, given the others.\n";
    if let Some(scatter) = found.scatter {
        let scatter = scatter.map(|s| fixed(100.0 * s, 1)).join(", ");
        let _ = writeln!(text, "Passes scatter by {scatter} % (one pass, standard deviation of red, green, blue)");
    } else {
        text += "One pass: its scatter is not known, 2 % is assumed\n";
    }
    let doubt =
        |[value, deviation]: [f64; 2]| if value.abs() > 3.0 * deviation { ": check it" } else { ", not significant" };
    let [slope, deviation] = found.nonlinearity;
    let _ = writeln!(
        text,
        "Exponent of the response {} ± {}{}",
        fixed(1.0 + slope, 3),
        fixed(2.0 * deviation, 3),
        doubt([slope, deviation])
    );
    if let Some((shift, table)) = &found.shift_nm {
        let _ = writeln!(
            text,
            "Wavelengths are shifted by {} ± {} nm from {table}{}",
            fixed(shift[0], 1),
            fixed(2.0 * shift[1], 1),
            doubt(*shift)
        );
    }
    for (leak, channel) in found.leak.iter().zip(CHANNELS) {
        if let Some(leak) = leak {
            let check = if *leak > 0.01 { ": light outside the band, or an infrared leak" } else { "" };
            let _ = writeln!(
                text,
                "{channel}: {} % of the peak where no table of the library exceeds 1 %{check}",
                fixed(100.0 * leak, 2)
            );
        }
    }
    text
}
