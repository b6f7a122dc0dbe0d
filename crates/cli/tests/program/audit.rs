//! The books of energy and momentum, and the reactions of boundaries, in the result directory.

use crate::{BLOCK, json, taut, with_case};
use output::Table;
use std::path::Path;

/// The block, with a name for what holds it and probes of that.
fn observed() -> String {
    let named = BLOCK.replace("[[boundary]]", "[[boundary]]\nname = \"wall\"");
    named
        + "\n[[probe]]\nname = \"force\"\nof = \"wall\"\n[[probe]]\nname = \"moment\"\nof = \"wall\"\nquantity = \"moment\"\n"
        + "[[probe]]\nname = \"slow\"\nof = \"wall\"\ninterval = \"0.01 ms\"\n"
}

fn names(table: &Table) -> Vec<String> {
    table.columns.iter().map(|c| format!("{} [{}]", c.name, c.unit)).collect()
}

fn read(results: &Path, file: &str) -> Table {
    Table::read(&results.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// Sum of value times the interval that it is the mean of, from the start.
fn integral(table: &Table, column: usize) -> f64 {
    let mut before = 0.0;
    let values = table.times.iter().zip(&table.columns[column].values);
    values.map(|(&t, v)| v * (t - std::mem::replace(&mut before, t))).sum()
}

/// Only the wall acts from outside: its reaction, in every step or as a mean between samples, adds up to what the momentum gained.
#[test]
fn reactions_add_up_to_the_momentum() {
    let folder = with_case(&observed());
    taut(folder.path(), &["run", "case.toml"]).with(0);
    let results = folder.path().join("out/block");
    let summary = json(&results.join("summary.json"));
    let [linear, angular] = ["linear", "angular"].map(|key| summary["momentum"][key].clone());
    let gained = |m: &serde_json::Value, i: usize| {
        m["final"][i].as_f64().expect("a number") - m["initial"][i].as_f64().expect("a number")
    };
    let [force, moment, slow] =
        ["force", "moment", "slow"].map(|name| read(&results, &format!("probes/{name}.csv")));
    assert_eq!(
        (names(&force), names(&moment)),
        (vec!["x [N]".into(), "y [N]".into()], vec!["z [N m]".to_string()])
    );
    // About 40 steps with sums of 200 particles' momenta, each rounded; the momentum changes by about its own size.
    let scale = linear["scale"].as_f64().expect("a number");
    let near =
        |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12 * scale, "{found} {expected}");
    near(integral(&force, 0), gained(&linear, 0));
    near(integral(&force, 1), gained(&linear, 1));
    assert!(gained(&linear, 0).abs() > 0.01 * scale, "the wall does something: {summary}");
    // The slow probe ends with its last sample; by then it has the same sum.
    let until = |table: &Table, end: f64| {
        let keep = table.times.iter().take_while(|t| **t <= end).count();
        let mut cut = table.clone();
        cut.times.truncate(keep);
        integral(&cut, 0)
    };
    let end = slow.times.last().copied().expect("samples");
    near(integral(&slow, 0), until(&force, end));
    assert!(slow.times.len() < force.times.len() / 3 && slow.times[0] > 0.0, "{:?}", slow.times);
    // Of the moment no more than this form keeps of angular momentum is missing.
    let missing = (integral(&moment, 0) - gained(&angular, 2)).abs();
    assert!(
        (missing / angular["residual"].as_f64().expect("a number") - 1.0).abs() < 1e-6,
        "{missing} {angular}"
    );
}

#[test]
fn the_books_are_tables_and_a_picture() {
    let folder = with_case(&observed());
    taut(folder.path(), &["run", "case.toml"]).with(0);
    let results = folder.path().join("out/block");
    let audit = read(&results, "audit.csv");
    let expected = [
        "kinetic [J]",
        "strain [J]",
        "contact [J]",
        "dissipated [J]",
        "external work [J]",
        "residual [J]",
        "momentum x [kg m/s]",
        "momentum y [kg m/s]",
        "impulse x [kg m/s]",
        "impulse y [kg m/s]",
        "angular momentum z [kg m^2/s]",
        "angular impulse z [kg m^2/s]",
    ];
    assert_eq!(names(&audit), expected);
    let reactions = read(&results, "reactions.csv");
    assert_eq!(names(&reactions), ["wall force x [N]", "wall force y [N]", "wall moment z [N m]"]);
    assert_eq!(reactions.times, audit.times[1..], "means between the samples of the books");
    let summary = json(&results.join("summary.json"));
    let column = |name: &str| &audit.columns.iter().find(|c| c.name == name).expect(name).values;
    let worst = column("residual").iter().map(|r| r.abs()).fold(0.0, f64::max);
    let supplied = column("external work")
        .iter()
        .fold(f64::MIN, |most, w| most.max(w + summary["energy"]["initial"].as_f64().unwrap_or(0.0)));
    let told = summary["energy"]["worst_residual"].as_f64().expect("a number");
    assert!((told / (worst / supplied) - 1.0).abs() < 1e-12, "{told} {worst} {supplied}");
    // The block is damped but little: the books close within the share that is not adjoint.
    assert!(told < 0.1, "{told}");
    let linear = &summary["momentum"]["linear"];
    // 40 steps of 64 terms of eps/2 of the momentum that there is.
    assert!(linear["worst_residual"].as_f64().expect("a number") < 40.0 * 64.0 * 1.1e-16, "{linear}");
    let svg = std::fs::read_to_string(results.join("audit.svg")).expect("the picture");
    assert!(svg.contains("A block is squeezed: energies") && svg.contains("angular impulse"));
}
