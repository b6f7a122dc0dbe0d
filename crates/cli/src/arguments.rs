//! The command line.

use crate::rebuild::{Frames, range, view};
use case::{Dimension, UnitQuantity};
use clap::{Args, Parser, Subcommand, ValueEnum};
use report::View;
use std::path::PathBuf;
use std::time::Duration;
use taut::simulation::Numbers;

/// Meshless solver for solids that stretch, twist, hit and bounce.
#[derive(Debug, Parser)]
#[command(name = "taut", version, about, subcommand_required = true, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a case: a file, or a built-in case by name (see `taut list`)
    Run(RunOptions),
    /// List the built-in cases and benchmarks
    List,
    /// Tell everything that can be known without running: particles, memory, time step, run time, warnings
    Check(TrialOptions),
    /// Say in plain words what a case does
    Explain(TrialOptions),
    /// Write a commented starter case, NAME.toml; nothing is overwritten
    New {
        /// Name of the case: small letters, digits and `-`
        #[arg(default_value = "my-case")]
        name: String,
    },
    /// Make the particles of a case or of a shape, and save them with a picture and how good they are
    Particles(ParticleOptions),
    /// Write the surface of bodies as STL, FILE.stl; nothing is overwritten
    Surface(SurfaceOptions),
    /// Tell what is in a file of triangles (STL, OBJ), and whether it is a body: in the file's own unit of length
    Mesh {
        /// The file
        file: PathBuf,
    },
    /// Print the JSON schema of case files, for editors that complete and explain
    Schema {
        /// The manual's page of all keys instead
        #[arg(long)]
        page: bool,
    },
    /// Run published benchmarks and hold what comes out against the papers
    Validate(ValidateOptions),
    /// Measure how fast this machine runs every formulation: see docs/performance.md
    Bench(BenchOptions),
    /// Find the longest stable step of a case: by formulas, by its highest frequency, and by running it; for small strain draw what it depends on
    Stability(StudyOptions),
    /// Compute the lowest modes of vibration of small-strain bodies, and show them
    Modes(ModesOptions),
    /// Solve for the equilibrium of small-strain bodies under their loads, without marching there
    Static(StudyOptions),
    /// Tell at which frequencies a probe of a run moves
    Spectrum(SpectrumOptions),
    /// Rebuild pictures and plots of a run, finished or not, from its files; or animate it
    Report(ReportOptions),
}

/// What to run.
#[derive(Debug, Args)]
pub struct CaseOptions {
    /// Path of a case file, or name of a built-in case; the default is ul-rings
    #[arg(default_value = "ul-rings")]
    pub case: String,
    /// Override a value of the case file, for instance --set parameters.resolution=20
    #[arg(long = "set", value_name = "a.b=value")]
    pub set: Vec<String>,
    /// Override the formulation of every deformable body
    #[arg(long, value_name = "NAME")]
    pub formulation: Option<String>,
}

/// Which surface to write.
#[derive(Debug, Args)]
pub struct SurfaceOptions {
    /// A case file, a built-in case, or a shape as in a case file
    #[arg(value_name = "CASE|SHAPE")]
    pub what: String,
    /// Where it goes: FILE.stl; nothing is overwritten
    #[arg(long, short = 'o', value_name = "FILE")]
    pub out: PathBuf,
    /// Override a value of the case file, for instance --set parameters.strut=0.2
    #[arg(long = "set", value_name = "a.b=value")]
    pub set: Vec<String>,
}

/// Which particles to make.
#[derive(Debug, Args)]
pub struct ParticleOptions {
    /// A case file, a built-in case, or a shape as in a case file: '{ ball = { center = [0, 0, 0], radius = "1 cm" } }'
    #[arg(value_name = "CASE|SHAPE")]
    pub what: String,
    /// Where they go: FILE.vtp, with the picture FILE.png beside it; nothing is overwritten
    #[arg(long, short = 'o', value_name = "FILE")]
    pub out: PathBuf,
    /// Distance between particles of a shape, for instance "1 mm"
    #[arg(long, value_name = "LENGTH")]
    pub spacing: Option<String>,
    /// Override a value of the case file, for instance --set parameters.resolution=20
    #[arg(long = "set", value_name = "a.b=value")]
    pub set: Vec<String>,
}

/// Numbers that sums over neighbours are made of; what is integrated in time is double always.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Precision {
    Double,
    Single,
}

impl From<Precision> for Numbers {
    fn from(precision: Precision) -> Self {
        match precision {
            Precision::Double => Self::Double,
            Precision::Single => Self::Single,
        }
    }
}

/// A case that is tried, and how it would be run.
#[derive(Debug, Args)]
pub struct TrialOptions {
    #[command(flatten)]
    pub case: CaseOptions,
    /// Numbers in the sums over neighbours; what is integrated in time is double always
    #[arg(long, default_value = "double")]
    pub precision: Precision,
}

/// A case that is studied.
#[derive(Debug, Args)]
pub struct StudyOptions {
    #[command(flatten)]
    pub case: CaseOptions,
    /// Result directory [default: out/<case>-<study>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Which modes.
#[derive(Debug, Args)]
pub struct ModesOptions {
    #[command(flatten)]
    pub case: CaseOptions,
    /// Modes of each body that are no rigid motion
    #[arg(long, value_name = "N", default_value = "12", value_parser = clap::value_parser!(u16).range(1..=500))]
    pub count: u16,
    /// Result directory [default: out/<case>-modes]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// How samples are weighed before they are transformed.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SampleWindow {
    /// Hann's: one line does not cover another far away
    Hann,
    /// None: the finest resolution
    None,
}

impl From<SampleWindow> for case::study::spectrum::Window {
    fn from(window: SampleWindow) -> Self {
        match window {
            SampleWindow::Hann => Self::Hann,
            SampleWindow::None => Self::None,
        }
    }
}

/// Which spectrum.
#[derive(Debug, Args)]
pub struct SpectrumOptions {
    /// Result directory of a run
    pub dir: PathBuf,
    /// Name of a probe
    pub probe: String,
    /// Samples from this time on, s
    #[arg(long, value_name = "TIME")]
    pub from: Option<f64>,
    /// Samples up to this time, s
    #[arg(long, value_name = "TIME")]
    pub to: Option<f64>,
    /// Weight of the samples
    #[arg(long, value_name = "KIND", default_value = "hann")]
    pub window: SampleWindow,
    /// Highest frequency that is written and drawn, Hz [default: half more than the highest peak that is told]
    #[arg(long, value_name = "HZ")]
    pub highest: Option<f64>,
}

/// What to run, and how.
#[derive(Debug, Args)]
pub struct RunOptions {
    #[command(flatten)]
    pub case: CaseOptions,
    /// Result directory [default: out/<case>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads [default: as many as the particles can use]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// No progress, no messages
    #[arg(long, short)]
    pub quiet: bool,
    /// Numbers in the sums over neighbours; what is integrated in time is double always
    #[arg(long, default_value = "double")]
    pub precision: Precision,
    /// Go on with the run that was interrupted in DIR, from its last checkpoint (or from the checkpoint that is named)
    #[arg(long, value_name = "DIR", conflicts_with_all = ["case", "set", "formulation", "out", "precision"])]
    pub resume: Option<PathBuf>,
    /// Wall time between two checkpoints, such as "30 s" or "1 h" [default: 5 min]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = wall_time)]
    pub checkpoint_every: Option<Duration>,
}

/// A duration with its unit; a plain number counts seconds.
fn wall_time(text: &str) -> Result<Duration, String> {
    let wanted = "a time is wanted, such as \"30 s\", \"5 min\" or \"1 h\"";
    let seconds = match (text.trim().parse::<f64>(), UnitQuantity::parse(text.trim())) {
        (Ok(seconds), _) => seconds,
        (_, Some(Ok(quantity))) if quantity.dimension == Dimension::TIME => quantity.value,
        (_, Some(Err(error))) => return Err(format!("{error}; {wanted}")),
        _ => return Err(wanted.to_string()),
    };
    Duration::try_from_secs_f64(seconds).map_err(|_| wanted.to_string())
}

/// What to validate, and how.
#[derive(Debug, Args)]
pub struct ValidateOptions {
    /// Benchmarks [default: all]
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// Also the long runs: an hour and more for some benchmarks
    #[arg(long)]
    pub full: bool,
    /// One JSON array of rows instead of tables
    #[arg(long)]
    pub json: bool,
    /// Keep the runs, each in DIR/BENCHMARK/RUN [default: they are deleted]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads [default: as many as the particles can use]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Numbers in the sums over neighbours; what is integrated in time is double always
    #[arg(long, default_value = "double")]
    pub precision: Precision,
}

/// What to measure, and what to do with it.
#[derive(Debug, Args)]
pub struct BenchOptions {
    /// Only bodies whose name contains all of these words, for instance `tl- 3d double` [default: all, four minutes]
    #[arg(value_name = "WORD")]
    pub filter: Vec<String>,
    /// Smaller bodies, and a sixth of the time for each
    #[arg(long)]
    pub quick: bool,
    /// Numbers of threads [default: 1 and all]
    #[arg(long, value_name = "N,...", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Vec<u16>,
    /// Write everything as JSON; the file must not exist
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Print the ratio of every row to the same row of an earlier JSON file
    #[arg(long, value_name = "FILE")]
    pub compare: Option<PathBuf>,
    /// Tables in Markdown
    #[arg(long)]
    pub markdown: bool,
}

/// How a run is animated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Animation {
    /// One file, animation.gif
    Gif,
    /// A folder of pictures, animation/000000.png, ...
    Frames,
}

/// What to draw, and how.
#[derive(Debug, Args)]
pub struct ReportOptions {
    /// Result directory of a run
    pub dir: PathBuf,
    /// Quantity that colours the particles: Pressure, Velocity (its magnitude), Velocity.x, CauchyStress.xy, ...; may be given
    /// several times
    #[arg(long = "field", value_name = "NAME", default_value = "VonMisesStress")]
    pub fields: Vec<String>,
    /// Frames: start, middle, end, all, numbers and ranges of them, for instance 0,5,10-20 [default: start,middle,end; all in
    /// an animation]
    #[arg(long, value_name = "WHICH", value_delimiter = ',')]
    pub frames: Vec<Frames>,
    /// Where to look from: front, back, left, right, top, bottom, oblique, or AZIMUTH,ELEVATION in degrees [default: oblique in
    /// space]
    #[arg(long, value_name = "FROM", value_parser = view, allow_hyphen_values = true)]
    pub view: Option<View>,
    /// Show in light grey where the particles were at the start (in the plane)
    #[arg(long)]
    pub undeformed: bool,
    /// Longer side of a picture, pixels, 400 to 4000 [default: 1200; 800 in an animation]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(400..=4000))]
    pub size: Option<u16>,
    /// Values at the ends of the colours, in SI units [default: the middle 99 % of each frame; of all frames in an animation]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true)]
    pub range: Option<[f64; 2]>,
    /// One animated GIF, or a sequence of pictures
    #[arg(long, value_name = "KIND")]
    pub animation: Option<Animation>,
    /// Where the pictures go [default: the result directory, where pictures of the same name are replaced]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// No messages
    #[arg(long, short)]
    pub quiet: bool,
}

impl ReportOptions {
    /// The pictures that a run makes.
    pub fn usual(dir: PathBuf, quiet: bool) -> Self {
        Self {
            dir,
            fields: vec!["VonMisesStress".to_string()],
            frames: Vec::new(),
            view: None,
            undeformed: false,
            size: None,
            range: None,
            animation: None,
            out: None,
            quiet,
        }
    }
}
