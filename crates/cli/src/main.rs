//! The `taut` program.

use std::process::ExitCode;

#[global_allocator]
static ALLOCATOR: cli::memory::Counting = cli::memory::Counting;

fn main() -> ExitCode {
    cli::run(std::env::args_os())
}
