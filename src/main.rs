//! Chromascope: arguments, logging, window.

use std::process::ExitCode;
use std::time::Instant;

use chromascope::{app, cli, files, terminal};

fn main() -> ExitCode {
    let start = Instant::now();
    std::panic::set_hook(Box::new(terminal::report_panic));
    let opened = match cli::run(std::env::args_os()) {
        cli::Outcome::Done(code) => return ExitCode::from(code),
        cli::Outcome::Window(files) => files,
    };
    let wanted = env_logger::Env::default().default_filter_or("warn");
    let logger = env_logger::Builder::from_env(wanted)
        .format_timestamp_millis()
        .target(env_logger::Target::Pipe(Box::new(terminal::StandardError)))
        .build();
    // Errors are logged regardless of the environment: they distinguish unavailable dialogs from Cancel.
    log::set_max_level(logger.filter().max(log::LevelFilter::Error));
    if let Err(error) = log::set_boxed_logger(Box::new(files::DialogLog::new(logger))) {
        terminal::say(&format!("chromascope: no log: {error}\n"));
    }
    files::install_panic_hook();
    match app::run(opened, start) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            terminal::say(&format!("chromascope: {error}\n"));
            ExitCode::FAILURE
        }
    }
}
