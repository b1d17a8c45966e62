//! Chromascope: arguments, logging, window.

use std::process::ExitCode;

fn main() -> ExitCode {
    let start = std::time::Instant::now();
    env_logger::init();
    match chromascope::app::run(Vec::new(), start) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            log::error!("{error}");
            ExitCode::FAILURE
        }
    }
}
