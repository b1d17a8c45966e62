//! The command line without the window.

use std::process::ExitCode;

use chromascope_workbench::{cli, terminal};

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(terminal::report_panic));
    match cli::run(std::env::args_os()) {
        cli::Outcome::Done(code) => ExitCode::from(code),
        cli::Outcome::Window(_) => {
            terminal::say("chromascope-cli: there is no window; name a command, see --help\n");
            ExitCode::FAILURE
        }
    }
}
