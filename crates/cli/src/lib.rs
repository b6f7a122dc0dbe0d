//! The taut program, callable as a function.
//!
//! Exit status: 0 done, 1 the run failed, 2 the input is wrong, 130 or 143 stopped by Ctrl-C or a request to end.

#[macro_use]
mod say;

mod arguments;
mod bench;
mod builtin;
mod check;
mod explain;
mod list;
pub mod memory;
mod mesh;
mod new;
mod particles;
mod pictures;
mod progress;
mod rebuild;
mod run;
mod schema;
mod signals;
mod study;
mod surface;
mod validate;

use arguments::{Arguments, Command};
use clap::Parser;
use std::ffi::OsString;
use std::process::ExitCode;

/// Why the program stops with a status other than 0.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The input is wrong: status 2.
    Input(String),
    /// The run failed: status 1.
    Run(String),
    /// The run was stopped, with this status.
    Stopped(String, u8),
}

/// Runs the program with these arguments (the first is its name).
pub fn run<I, A>(arguments: I) -> ExitCode
where
    I: IntoIterator<Item = A>,
    A: Into<OsString> + Clone,
{
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version come as errors too, with status 0. A closed pipe is nobody's fault.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    let done = match arguments.command {
        Command::Run(options) => run::run(&options),
        Command::List => list::list(),
        Command::Check(options) => check::check(&options),
        Command::Explain(options) => explain::explain(&options),
        Command::New { name } => new::new(&name),
        Command::Surface(options) => surface::surface(&options),
        Command::Particles(options) => particles::particles(&options),
        Command::Mesh { file } => mesh::mesh(&file),
        Command::Schema { page } => schema::schema(page),
        Command::Validate(options) => validate::validate(&options),
        Command::Bench(options) => bench::bench(&options),
        Command::Stability(options) => study::stability::stability(&options),
        Command::Modes(options) => study::vibration::modes(&options),
        Command::Static(options) => study::vibration::equilibrate(&options),
        Command::Spectrum(options) => study::spectrum::of_probe(&options),
        Command::Report(options) => rebuild::report(&options),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Run(message)) => stop(&message, 1),
        Err(Failure::Stopped(message, status)) => {
            complain!("{message}");
            ExitCode::from(status)
        }
        Err(Failure::Input(message)) => stop(&message, 2),
    }
}

fn stop(message: &str, status: u8) -> ExitCode {
    // Diagnostics of the case file bring their own heading.
    if message.starts_with("error") {
        complain!("{message}");
    } else {
        complain!("error: {message}");
    }
    ExitCode::from(status)
}
