//! Spline Lab: `spline-lab [FILE]` opens the window, `spline-lab --help` lists the jobs that need none.

use std::process::ExitCode;

fn main() -> ExitCode {
    spline_lab::command_line::run()
}
