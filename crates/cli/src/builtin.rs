//! The cases that come with the program.

use crate::Failure;
use crate::arguments::CaseOptions;
use case::{Case, Overrides};
use std::path::Path;

/// Name and text of every built-in case.
pub const CASES: &[(&str, &str)] = &[
    ("tl-plate", include_str!("../../../cases/tl-plate.toml")),
    ("tl-bending-column", include_str!("../../../cases/tl-bending-column.toml")),
    ("tl-twisting-column", include_str!("../../../cases/tl-twisting-column.toml")),
    ("tl-punch", include_str!("../../../cases/tl-punch.toml")),
    ("tl-stent", include_str!("../../../cases/tl-stent.toml")),
    ("contact-hertz", include_str!("../../../cases/contact-hertz.toml")),
    ("contact-sphere", include_str!("../../../cases/contact-sphere.toml")),
    ("contact-bars", include_str!("../../../cases/contact-bars.toml")),
    ("contact-incline", include_str!("../../../cases/contact-incline.toml")),
    ("contact-fold", include_str!("../../../cases/contact-fold.toml")),
    ("tl-pull-2d", include_str!("../../../cases/tl-pull-2d.toml")),
    ("tl-pull-3d", include_str!("../../../cases/tl-pull-3d.toml")),
    ("tl-flag", include_str!("../../../cases/tl-flag.toml")),
    ("tl-loaded-beam", include_str!("../../../cases/tl-loaded-beam.toml")),
    ("ul-plate-2d", include_str!("../../../cases/ul-plate-2d.toml")),
    ("ul-plate-3d", include_str!("../../../cases/ul-plate-3d.toml")),
    ("lk-rectangle", include_str!("../../../cases/lk-rectangle.toml")),
    ("lk-formulations", include_str!("../../../cases/lk-formulations.toml")),
    ("lk-annulus", include_str!("../../../cases/lk-annulus.toml")),
    ("lk-stability", include_str!("../../../cases/lk-stability.toml")),
    ("lk-collision", include_str!("../../../cases/lk-collision.toml")),
    ("ul-rings", include_str!("../../../cases/ul-rings.toml")),
    ("ul-hollow-balls", include_str!("../../../cases/ul-hollow-balls.toml")),
    ("ul-ball-plate-2d", include_str!("../../../cases/ul-ball-plate-2d.toml")),
    ("ul-ball-plate-3d", include_str!("../../../cases/ul-ball-plate-3d.toml")),
];

/// Reference curves of the built-in cases, by their paths.
const CURVES: &[(&str, &str)] = &[
    (
        "../validation/tl-plate/reference/tip-res20.csv",
        include_str!("../../../validation/tl-plate/reference/tip-res20.csv"),
    ),
    (
        "../validation/tl-bending-column/reference/corner-res12-4layers.csv",
        include_str!("../../../validation/tl-bending-column/reference/corner-res12-4layers.csv"),
    ),
    (
        "../validation/ul-plate-2d/reference/tip-res20.csv",
        include_str!("../../../validation/ul-plate-2d/reference/tip-res20.csv"),
    ),
];

/// Reads and checks the case that the options name.
pub fn read(options: &CaseOptions) -> Result<Case, Failure> {
    let overrides = Overrides { set: options.set.clone(), formulation: options.formulation.clone() };
    let read = match CASES.iter().find(|(name, _)| *name == options.case) {
        Some((name, text)) => Case::parse(&format!("{name}.toml (built in)"), text, &overrides)
            .and_then(|case| case.with_references(curves)),
        None if !Path::new(&options.case).exists() => return Err(unknown(&options.case)),
        None => Case::read(Path::new(&options.case), &overrides),
    };
    read.map_err(|error| Failure::Input(error.render(colour())))
}

fn curves(file: &str) -> Result<String, String> {
    let found = CURVES.iter().find(|(path, _)| *path == file);
    found.map(|(_, text)| text.to_string()).ok_or_else(|| "it does not come with the program".to_string())
}

/// Whether messages may be coloured.
pub fn colour() -> bool {
    use std::io::IsTerminal;
    std::env::var_os("NO_COLOR").is_none() && std::io::stderr().is_terminal()
}

fn unknown(name: &str) -> Failure {
    let names: Vec<&str> = CASES.iter().map(|(name, _)| *name).collect();
    Failure::Input(format!(
        "there is no case file `{name}`, and no built-in case of that name\nbuilt-in cases: {}",
        names.join(", ")
    ))
}
