//! Wrong cases in bulk, through the whole program: status 2, the file and the line, no panic, nothing left behind.

use crate::{BLOCK, taut, with_case};

/// What is replaced in the block (the first time it occurs), by what, and a word of the message. The message has to
/// point at the line of the replacement; where it points elsewhere, the replacement marks the line with `@`.
const ROWS: &[(&str, &str, &str)] = &[
    // As text.
    ("dimension = 2", "dimension = ", "not valid TOML"),
    ("dimension = 2", "dimension 2", "not valid TOML"),
    ("[time]", "[time", "not valid TOML"),
    ("title = \"A block", "title = \"A \u{7} block", "not valid TOML"),
    ("spacing = \"dp\"", "spacing = \"dp\"\n@spacing = 1", "duplicate key"),
    ("spacing", "spcing", "did you mean `spacing`?"),
    ("[region.foot]", "[regoin.foot]", "did you mean `region`?"),
    ("poisson_ratio", "poison_ratio", "did you mean `poisson_ratio`?"),
    ("poisson_ratio = 0.45", "[material.rubber.poisson_ratio]\nvalue = 0.45", "has to be a number"),
    ("fixed = true", "fixed = \"yes\"", "fixed"),
    // Numbers, units, expressions.
    ("dimension = 2", "dimension = 5", "2 or 3"),
    ("dp = \"1 mm\"", "dp = 1e-300\n@dp = 3", "duplicate key"),
    ("spacing = \"dp\"", "spacing = 0", "positive"),
    ("spacing = \"dp\"", "spacing = inf", "finite"),
    ("spacing = \"dp\"", "spacing = \"dp*1e999\"", "1e999"),
    ("17 MPa", "17 MP", "unknown unit"),
    ("17 MPa", "17 kg", "expected a pressure"),
    ("1.1 g/cm^3", "-1.1 g/cm^3", "positive"),
    ("0.45", "0.5", "0.5"),
    ("v0*sin(80*x)", "v0*sin(80*x", "parenthesis"),
    ("v0*sin(80*x)", "v0*sin(80*y, 3)", "sin"),
    ("v0*sin(80*x)", "v1*sin(80*x)", "unknown name `v1`"),
    ("v0*sin(80*x)", "import os", "import"),
    ("v0*sin(80*x)", "v0*sin(80*t)", "cannot use `t`"),
    ("v0 = 10", "v0 = \"v0 + 1\"", "circle"),
    ("\"0.1 ms\"", "\"0.1 mm\"", "expected a time"),
    ("\"0.1 ms\"", "-1", "positive"),
    // Names.
    ("tl-hourglass-free", "tl-hourglas-free", "did you mean `tl-hourglass-free`?"),
    ("tl-hourglass-free", "tl-nested\"\n@plane = \"stress", "plane stress"),
    ("\"neo-hookean\"", "\"steel\"", "unknown model `steel`"),
    ("\"neo-hookean\"", "\"saint-venant-kirchhoff\"", "tl-nested"),
    ("region = \"foot\"", "region = \"feet\"", "unknown region `feet`"),
    ("probe = \"tip\"", "probe = \"tp\"", "did you mean `tip`?"),
    ("component = \"x\"", "component = \"w\"", "unknown component"),
    ("name = \"block\"", "name = \"../../etc\"", "cannot be the name"),
    ("name = \"tip\"", "name = \"../tip\"", "cannot be a name"),
    // Geometry: found when the case is built.
    ("[0, 0], max", "[0, 0, 0], max", "a list of 2"),
    ("[\"2 cm\", \"1 cm\"]", "[\"-2 cm\", \"1 cm\"]", "empty"),
    ("at = [0.02, 0.005]", "at = [2, 0.005]", "not in its body"),
    ("at = [0.02, 0.005]", "region = \"feet\"", "unknown region `feet`"),
    (
        "at = [0.02, 0.005]",
        "region = { ball = { center = [9, 9], radius = 1 } }",
        "no particle is in its region",
    ),
    ("at = [0.02, 0.005]", "at = [0.02, 0.005]\n@region = \"foot\"", "found `at` and `region`"),
    (
        "[[probe]]",
        "@[[initial]]\nregion = { ball = { center = [9, 9], radius = 1 } }\nvelocity = [1, 0]\n[[probe]]",
        "no particle is in this region",
    ),
    ("[[probe]]", "[[initial]]\nregion = \"foot\"\n@velocity = [\"t\", 0]\n[[probe]]", "cannot use `t`"),
    (
        "[[probe]]",
        "@[[initial]]\nregion = \"foot\"\nvelocity = [\"1/(x-x)\", 0]\n[[probe]]",
        "is not a number",
    ),
    ("{ box = { min = [0, 0]", "{ cube = { min = [0, 0]", "unknown shape `cube`"),
    ("[[body]]", "@[[body]]\nfill = \"concentric\"", "only a ring or a ball"),
];

/// Wrong cases whose message has no better place than the head of a table: old, new, word, the line pointed at.
const HEADS: &[(&str, &str, &str, &str)] = &[
    ("end = \"0.1 ms\"\n", "", "missing key `end`", "[time]"),
    ("model = \"neo-hookean\"\n", "", "missing key `model`", "[material.rubber]"),
    ("dimension = 2\n", "", "missing key `dimension`", "name = \"block\""),
    ("spacing = \"dp\"", "spacing = 1", "no particle fits inside", "[[body]]"),
    ("fixed = true", "velocity = [\"sqrt(-1 - t)\", 0]", "is not a number", "[[boundary]]"),
    (
        "[[probe]]",
        "[[gravity]]\nacceleration = [\"1/(x-x)\", 0]\n\n[[probe]]",
        "`1/(x-x)` is not a number",
        "[[gravity]]",
    ),
    (
        "[[probe]]",
        "[[gravity]]\nacceleration = [0, \"sqrt(-1 - t)\"]\n\n[[probe]]",
        "`sqrt(-1 - t)` is not a number",
        "[[gravity]]",
    ),
    ("at = [0.02, 0.005]\n", "", "missing key `at`", "[[probe]]"),
    ("spacing = \"dp\"", "spacing = 1e-12", "choose a larger spacing", "[[body]]"),
    ("spacing = \"dp\"", "spacing = 4e-7", "GB of memory", "[[body]]"),
    ("v0*sin(80*x)", "1/(x-x)", "the velocity of body `block` is inf", "[[body]]"),
    ("[-1, -1], max = [\"dp\", 1]", "[-2, -2], max = [-1, -1]", "holds no particle", "[[boundary]]"),
    (
        "{ min = [0, 0], max = [\"2 cm\", \"1 cm\"] }",
        "{ min = [1e9, 0], max = [2e9, 1] }",
        "choose a larger spacing",
        "[[body]]",
    ),
];

/// Runs a wrong case; the message of the program.
#[track_caller]
fn refused(text: &str) -> String {
    let folder = with_case(text);
    let ended = taut(folder.path(), &["run", "case.toml"]).with(2);
    assert!(ended.stderr.starts_with("error"), "{}", ended.stderr);
    assert_eq!(ended.stdout, "");
    let left = std::fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(left, 1, "only the case itself is left: {}", ended.stderr);
    ended.stderr
}

fn line_of(text: &str, place: usize) -> usize {
    text[..place].matches('\n').count() + 1
}

#[test]
fn wrong_cases_are_refused_with_file_and_line() {
    for &(old, new, word) in ROWS {
        let at = BLOCK.find(old).unwrap_or_else(|| panic!("{old} is in the block"));
        let at = at + new.find('@').unwrap_or(0);
        let text = BLOCK.replacen(old, new, 1).replacen('@', "", 1);
        let message = refused(&text);
        assert!(message.contains(word), "{new}: {word} is not in\n{message}");
        let place = format!("case.toml:{}:", line_of(&text, at));
        assert!(message.contains(&place), "{new}: {place} is not in\n{message}");
    }
}

#[test]
fn what_is_missing_or_does_not_fit_points_at_its_table() {
    for &(old, new, word, head) in HEADS {
        let text = BLOCK.replacen(old, new, 1);
        assert_ne!(text, BLOCK, "{old} is in the block");
        let message = refused(&text);
        assert!(message.contains(word), "{new}: {word} is not in\n{message}");
        let place = format!("case.toml:{}:", line_of(&text, text.find(head).expect("the head is there")));
        assert!(message.contains(&place), "{new}: {place} is not in\n{message}");
    }
}

#[test]
fn files_that_are_no_cases_are_refused() {
    let deep = format!("name = {}", "[".repeat(20_000));
    let nested = BLOCK.replace("v0*sin(80*x)", &format!("{}x", "(".repeat(100_000)));
    let many = BLOCK.replace("v0*sin(80*x)", &vec!["x"; 100_000].join("+"));
    for text in
        ["", "\u{feff}", "hello, world", "name = \"block\"", deep.as_str(), nested.as_str(), many.as_str()]
    {
        let folder = with_case(text);
        let ended = taut(folder.path(), &["run", "case.toml", "--set", "time.end=1e-9"]);
        let short: String = ended.stderr.chars().take(300).collect();
        assert!(!ended.stderr.contains("panicked"), "{short}");
        assert!(matches!(ended.status, Some(0 | 2)), "{:?}: {short}", ended.status);
        assert_eq!(ended.status == Some(2), !folder.path().join("out").exists(), "{short}");
    }
    let folder = with_case("");
    std::fs::write(folder.path().join("case.toml"), [0xff, 0xfe, 0x00]).expect("the file is written");
    assert!(taut(folder.path(), &["run", "case.toml"]).with(2).stderr.contains("case.toml"));
    assert!(taut(folder.path(), &["run", "."]).with(2).stderr.contains("cannot read the case file"));
}

#[test]
fn wrong_overrides_show_the_argument() {
    let folder = with_case(BLOCK);
    for (set, word) in [
        ("time.end", "needs a path, `=` and a value"),
        ("time.end=", "empty"),
        ("time.ende=1", "did you mean `end`?"),
        ("tme.end=1", "did you mean `time`?"),
        ("material.ruber.density=1", "did you mean `rubber`?"),
        ("parameters.v0=1/0", "inf"),
        ("spacing=1 MPa", "expected a length"),
        ("=1", "path"),
        ("dimension=7", "2 or 3"),
    ] {
        let message = taut(folder.path(), &["run", "case.toml", "--set", set]).with(2).stderr;
        assert!(message.contains(word), "{set}: {word} is not in\n{message}");
        assert!(message.contains(&format!("--set {set}")), "{set}: {message}");
    }
    assert!(!folder.path().join("out").exists());
}
