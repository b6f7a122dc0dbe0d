//! Who may import whom (ARCHITECTURE.md).

use crate::imports::{ModulePath, module_of, named};
use crate::{from_root, read, root, sources};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Every crate, and which of ours it may import.
const CRATES: &[(&str, &[&str])] = &[
    ("taut", &[]),
    ("geometry", &["taut"]),
    ("output", &["taut"]),
    ("case", &["taut", "geometry", "output"]),
    ("report", &["output"]),
    ("cli", &["taut", "geometry", "output", "case", "report"]),
];

/// The modules of `taut`, from the cellar to the roof: a line may name its own floor and those before it.
const FLOORS: &[&str] = &[
    "math",
    "field",
    "kernel",
    "particles",
    "neighbours",
    "pass",
    "run",
    "correction",
    "material",
    "formulation",
    "machine",
    "integrator",
    "diagnostics",
    "contact",
    "simulation",
];

#[test]
fn crates_import_in_one_direction() {
    for (name, manifest) in manifests() {
        let allowed = CRATES.iter().find(|(crate_name, _)| *crate_name == name).map(|(_, allowed)| *allowed);
        let allowed = allowed.unwrap_or_else(|| panic!("say in this test whom crates/{name} may import"));
        for table in ["dependencies", "dev-dependencies", "build-dependencies"] {
            let Some(table) = manifest.get(table).and_then(toml::Value::as_table) else { continue };
            for ours in table.keys().filter(|key| CRATES.iter().any(|(crate_name, _)| crate_name == key)) {
                assert!(allowed.contains(&ours.as_str()), "crates/{name} must not import {ours}");
            }
        }
    }
}

/// Name of the folder and manifest of every crate.
fn manifests() -> Vec<(String, toml::Table)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(root().join("crates")).expect("the folder of crates").flatten() {
        let manifest = entry.path().join("Cargo.toml");
        if manifest.is_file() {
            let table = read(&manifest).parse().expect("a manifest is TOML");
            found.push((entry.file_name().to_string_lossy().into_owned(), table));
        }
    }
    assert!(found.len() >= CRATES.len(), "{} crates", found.len());
    found
}

/// The files of `taut`: path, module, and what they name.
fn numerics() -> Vec<(PathBuf, ModulePath, Vec<ModulePath>)> {
    let own = |path: &PathBuf| from_root(path).starts_with("crates/taut/src/");
    let files = sources().into_iter().filter(own).map(|path| {
        let module = module_of(from_root(&path).trim_start_matches("crates/taut/src/"));
        let names = named(&read(&path), &module);
        (path, module, names)
    });
    let files: Vec<_> = files.collect();
    assert!(files.len() > 50, "the sources are found");
    files
}

#[test]
fn inside_taut_a_line_travels_from_math_to_simulation_and_never_back() {
    let floor = |name: &str| FLOORS.iter().position(|floor| *floor == name);
    for (path, module, names) in numerics() {
        let Some(top) = module.first() else { continue };
        let own = floor(top).unwrap_or_else(|| panic!("say in this test on which floor {top} stands"));
        for other in names.iter().filter_map(|name| name.first()) {
            if let Some(above) = floor(other).filter(|other| *other > own) {
                panic!("{}: {top} must not name {}, which stands above it", from_root(&path), FLOORS[above]);
            }
        }
    }
}

/// A formulation: its module and the types it offers.
fn formulations() -> Vec<(ModulePath, BTreeSet<String>)> {
    let mut found = Vec::new();
    for (path, module, _) in numerics() {
        let source = read(&path);
        if !source.lines().any(|line| line.starts_with("impl<") && line.contains("Formulation<D> for")) {
            continue;
        }
        let types = source.lines().filter_map(|line| line.strip_prefix("pub struct "));
        let name = |line: &str| line.chars().take_while(|c| c.is_alphanumeric()).collect();
        found.push((module, types.map(name).collect()));
    }
    assert!(found.len() >= 4, "the formulations are found");
    found
}

#[test]
fn formulations_never_import_each_other() {
    let formulations = formulations();
    for (path, module, names) in numerics() {
        let Some((own, _)) = formulations.iter().find(|(formulation, _)| *formulation == module) else {
            continue;
        };
        for (other, types) in formulations.iter().filter(|(other, _)| other != own) {
            let family = &other[..other.len() - 1];
            for name in &names {
                let directly = name.starts_with(other);
                let by_family =
                    name.starts_with(family) && name.get(family.len()).is_some_and(|n| types.contains(n));
                assert!(!directly && !by_family, "{} names {}", from_root(&path), name.join("::"));
            }
        }
    }
    for (path, module, names) in numerics() {
        for (here, there) in [("total", "updated"), ("updated", "total")] {
            let mine = module.len() > 1 && module[0] == "formulation" && module[1] == here;
            let theirs = |name: &&ModulePath| name.len() > 1 && name[0] == "formulation" && name[1] == there;
            let found = names.iter().find(theirs).filter(|_| mine);
            assert!(found.is_none(), "{}: what two families share goes down a floor", from_root(&path));
        }
    }
}

#[test]
fn the_numerics_know_no_files_no_clock_and_no_terminal() {
    for (path, _, _) in numerics() {
        let source = read(&path);
        let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
        for line in code {
            for word in ["std::fs", "std::io", "std::time", "std::env", "println!", "print!", "serde"] {
                assert!(!line.contains(word), "{}: {line}", from_root(&path));
            }
        }
    }
}
