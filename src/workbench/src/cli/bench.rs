//! `bench`: run time against error, as figures, a table and JSON.

use std::path::{Path, PathBuf};

use chromascope_core::render::Stop;
use chromascope_figure::Figure;
use chromascope_measure::pareto::duration;
use chromascope_measure::{Effort, Measurement, Progress, Report, Workload};
use chromascope_text::Choice as _;
use clap::{ArgMatches, Args};

use super::error::{CliError, Result};
use super::outputs::{show, write_to};
use super::render::make_folder;
use crate::export::{Paper, png, png_file, svg};
use crate::palette::Colors;
use crate::profiler::bench;
use crate::terminal::say;

const EXAMPLES: &str = "Examples:
  chromascope bench --quick --out measured
  chromascope bench --only locus,temperature --out measured
  chromascope bench --list

Writes bench.json, bench.csv and, for each workload, a figure as SVG and PNG. Files are written at the end,
and an earlier run is overwritten only with --replace.
A line gives: threads, median time per item, ratio to the case's first method, largest error, what it is an error of.";

const JSON: &str = "bench.json";

const CSV: &str = "bench.csv";

/// Run time against error of every method, measured on this machine: figures, table and JSON
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[expect(clippy::struct_excessive_bools, reason = "switches of a command line")]
pub(super) struct BenchArguments {
    /// Takes a minute instead of a quarter of an hour
    #[arg(long)]
    quick: bool,
    /// Folder for the files, created if necessary
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    out: Option<PathBuf>,
    /// Overwrites an earlier run in that folder
    #[arg(long, visible_alias = "force")]
    replace: bool,
    /// Measures only these workloads
    #[arg(long, value_name = "NAME", value_delimiter = ',', num_args = 1.., value_parser = workload)]
    only: Vec<Workload>,
    /// Lists the workloads
    #[arg(long)]
    list: bool,
    /// As little as can be: to try the command, not to measure
    #[arg(long, hide = true, conflicts_with = "quick")]
    trial: bool,
}

fn workload(name: &str) -> Result<Workload, String> {
    let names = || Workload::ALL.map(Workload::key).join(", ");
    Workload::parse(name).ok_or_else(|| format!("there are: {}", names()))
}

pub(super) fn run(arguments: &BenchArguments, _: &ArgMatches) -> Result<()> {
    let (false, Some(folder)) = (arguments.list, &arguments.out) else {
        let lines = Workload::ALL.map(|workload| format!("{:<12} {}\n", workload.key(), workload.label()));
        return show(&lines.concat());
    };
    let measure = bench().ok_or(CliError::NoBench)?;
    make_folder(folder)?;
    // Better now than after a quarter of an hour.
    tempfile::tempfile_in(folder).map_err(|error| CliError::Output { path: folder.clone(), error })?;
    let plan: Vec<Workload> = Workload::ALL
        .into_iter()
        .filter(|workload| arguments.only.is_empty() || arguments.only.contains(workload))
        .collect();
    let known = names(&plan).into_iter().find(|name| folder.join(name).exists());
    if let Some(name) = known.filter(|_| !arguments.replace) {
        let folder = folder.display();
        return Err(CliError::File(format!(
            "{folder}: {name} of an earlier run exists; name another folder, or add --replace"
        )));
    }
    let effort = if arguments.trial {
        Effort::Trial
    } else if arguments.quick {
        Effort::Quick
    } else {
        Effort::Full
    };
    let mut case = String::new();
    let report = measure(&plan, effort, &Stop::NEVER, &mut |progress| tell(progress, &mut case))?;
    let files = files(&report, folder)?;
    for (path, bytes) in &files {
        write_to(path, bytes)?;
    }
    let count = report.measurements.len();
    show(&format!("{count} measurements in {} files in {}\n", files.len(), folder.display()))
}

fn names(plan: &[Workload]) -> Vec<String> {
    let figures = plan.iter().flat_map(|workload| ["svg", "png"].map(|ending| format!("{}.{ending}", workload.key())));
    [JSON, CSV].map(str::to_owned).into_iter().chain(figures).collect()
}

/// A line for each measurement, under its case.
fn tell(progress: Progress<'_>, case: &mut String) {
    match progress {
        Progress::Machine(machine) => say(&format!("{machine}\n")),
        Progress::Begins(workload) => {
            case.clear();
            say(&format!("\n{}\n", workload.label()));
        }
        Progress::Measured(measurement) => {
            if *case != measurement.case {
                case.clone_from(&measurement.case);
                say(&format!("  {case}\n"));
            }
            say(&line(measurement));
        }
    }
}

fn line(m: &Measurement) -> String {
    let roof = m.roof.map_or_else(String::new, |roof| {
        format!("  {:.0} % of memory, {:.0} % of arithmetic", 100.0 * roof.memory, 100.0 * roof.arithmetic)
    });
    let refused = if m.error.refused > 0 { format!(", {} refused", m.error.refused) } else { String::new() };
    format!(
        "    {:<32} {:>2} {:>10} a {} {:>9.4}  {:.1e} {}{refused}{roof}\n",
        m.method,
        m.threads,
        duration(m.seconds_per_item),
        m.item,
        m.ratio,
        m.error.max(),
        m.error.what
    )
}

fn files(report: &Report, folder: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>> {
    let mut files = vec![
        (folder.join(JSON), report.to_json()?.into_bytes()),
        (folder.join(CSV), report.table().to_csv().into_bytes()),
    ];
    let figures = report.workloads().into_iter().filter_map(|workload| Some((workload, report.figure(workload)?)));
    for (workload, figure) in figures {
        files.extend(pictures(&folder.join(workload.key()), &figure)?);
    }
    Ok(files)
}

fn pictures(stem: &Path, figure: &Figure) -> Result<[(PathBuf, Vec<u8>); 2]> {
    let text = svg(figure, &Colors::LIGHT, Paper::default());
    let picture = png_file(&png(&text, 2.0)?)?;
    Ok([(stem.with_extension("svg"), text.into_bytes()), (stem.with_extension("png"), picture)])
}
