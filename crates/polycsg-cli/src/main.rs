//! The program `polycsg`.
use std::process::ExitCode;

fn main() -> ExitCode {
    polycsg_cli::run()
}
