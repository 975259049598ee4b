//! The program `spline-lab`: the window, and jobs that need none. See `spline-lab --help`.

mod command_line;

use std::process::ExitCode;

fn main() -> ExitCode {
    command_line::run()
}
