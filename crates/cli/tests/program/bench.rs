//! `taut bench`: the shape of what it says and writes. Times are never looked at.

use crate::{json, taut};
use std::fs;

/// One small body on one thread.
const ONE: &[&str] = &["bench", "--quick", "--threads", "1", "tl-hourglass-free/2d/lattice/double"];

#[test]
fn a_measurement_is_told_written_and_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let told = taut(folder.path(), &[ONE, &["--json", "a.json"]].concat()).with(0);
    assert!(told.stdout.contains("triad, GB/s") && told.stdout.contains("Mps/s"), "{}", told.stdout);
    assert!(told.stderr.contains("1 of 1"), "progress: {}", told.stderr);
    let report = json(&folder.path().join("a.json"));
    assert_eq!((&report["format"], &report["quick"]), (&"taut bench 1".into(), &true.into()));
    assert_eq!(report["taut"], env!("CARGO_PKG_VERSION"));
    assert!(report["started"].as_str().is_some_and(|time| time.ends_with('Z')));
    assert!(["arch", "os", "instruction_set", "cores"].iter().all(|key| !report["machine"][key].is_null()));
    for key in ["double_flops", "single_flops", "triad_bytes"] {
        assert!(report["limits"][0][key].as_f64().is_some_and(|x| x > 0.0), "{key}: {report}");
    }
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!((rows.len(), &rows[0]["threads"]), (1, &1.into()));
    for key in [
        "particles",
        "neighbours",
        "particle_steps_per_second",
        "median_particle_steps_per_second",
        "pairs_per_second",
        "bytes_per_particle",
        "flops_per_particle_step",
        "of_flops",
        "of_triad",
    ] {
        assert!(rows[0][key].as_f64().is_some_and(|x| x > 0.0), "{key}: {report}");
    }
    assert!(rows[0]["relist_share"].is_null(), "lists that last for ever");
    let compared =
        taut(folder.path(), &[ONE, &["--compare", "a.json", "--markdown"]].concat()).with(0).stdout;
    let row = compared.lines().find(|line| line.starts_with("| tl-hourglass-free/2d")).expect("the row");
    let ratio = row.trim_end_matches([' ', '|']).rsplit(' ').next().expect("the last cell");
    assert!(ratio.parse::<f64>().is_ok_and(|ratio| ratio > 0.0), "{row}");
}

#[test]
fn wrong_files_and_words_are_wrong_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    write("table.txt", "Mps/s 3.2");
    write("summary.json", "{\"case\": \"plate\"}");
    write("newer.json", "{\"format\": \"taut bench 9\"}");
    write("torn.json", "{\"format\": \"taut bench 1\", \"rows\": []}");
    for (more, words) in [
        (&["--compare", "nothing.json"][..], &["nothing.json", "No such file"][..]),
        (&["--compare", "table.txt"], &["table.txt: this is no JSON", "taut bench --json FILE"]),
        (&["--compare", "summary.json"], &["it has no `format`", "taut bench --json FILE"]),
        (&["--compare", "newer.json"], &["`taut bench 9`, not `taut bench 1`"]),
        (&["--compare", "torn.json"], &["missing field `taut`"]),
        (&["--json", "table.txt"], &["table.txt already exists and is not overwritten"]),
        (&["--json", "nowhere/a.json"], &["there is no folder nowhere"]),
        (&["4d"], &["`4d`", "tl-nested/3d/irregular/single"]),
        (&["--threads", "0"], &["--threads"]),
    ] {
        let ended = taut(folder.path(), &[ONE, more].concat()).with(2);
        assert!(ended.stderr.starts_with("error: "), "{}", ended.stderr);
        assert!(words.iter().all(|word| ended.stderr.contains(word)), "{more:?}: {}", ended.stderr);
        assert_eq!(ended.stdout, "", "nothing was measured");
    }
    assert_eq!(fs::read_to_string(folder.path().join("table.txt")).expect("the file"), "Mps/s 3.2");
}
