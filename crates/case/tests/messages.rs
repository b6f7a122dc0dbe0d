//! Snapshots of what is said about wrong cases, word for word, with file, line and caret.
//!
//! After a change of a message, run this test with `TAUT_ACCEPT=1` in the environment, and read the difference of
//! `messages.txt`: is every caret below what is wrong?

mod samples;

use samples::{COLUMN, PLATE, PUNCH, RINGS, parse, parse_set};
use std::fmt::Write as _;
use std::path::Path;

/// A case, what is replaced in it (the first time it occurs), by what.
type Wrong = (&'static str, &'static str, &'static str);

const WRONG: &[Wrong] = &[
    // Text.
    (RINGS, "dimension = 2", "dimension = "),
    (RINGS, "title = \"Two rings\"", "title = Two rings"),
    (RINGS, "dimension = 2", "dimension = 2\ndimension = 3"),
    (RINGS, "[time]", "[time"),
    // Keys.
    (RINGS, "density", "densty"),
    (PLATE, "except", "exept"),
    (RINGS, "inner = 0.03", "iner = 0.03"),
    (PLATE, "kind = \"second", "prominence = 1\nkind = \"second"),
    (RINGS, "end = \"12 ms\"", ""),
    (PLATE, "[[boundary]]", "[boundary]"),
    // Types.
    (PLATE, "name = \"plate\"", "name = 3"),
    (RINGS, "spacing = \"dp\"", "spacing = [1]"),
    (RINGS, "velocity = [\"v0\", 0]", "velocity = [\"v0\", 0, 0]"),
    (PLATE, "{ union = [\"strip\", \"block\"] }", "{ union = [], box = {} }"),
    // Units.
    (RINGS, "10 MPa", "10 MPaa"),
    (RINGS, "outer = \"4 cm\"", "outer = \"4 MPa\""),
    (RINGS, "youngs_modulus = \"E\"", "youngs_modulus = \"wall\""),
    (PLATE, "-9.81 m/s^2", "-9.81 m/s"),
    // Expressions.
    (RINGS, "v0 = \"0.06*c0\"", "v0 = \"0.06*co\""),
    (RINGS, "wall = \"10 mm\"", "wall = \"dp*10\""),
    (PLATE, "2*sin(pi*x/(2*L))", "2*sine(pi*x/(2*L))"),
    (PLATE, "2*sin(pi*x/(2*L))", "2 sin(pi*x/(2*L))"),
    (PLATE, "2*sin(pi*x/(2*L))", "2*sin(pi*x/(2*L)"),
    (PLATE, "2*sin(pi*x/(2*L))", "z"),
    // Ranges.
    (RINGS, "spacing = \"dp\"", "spacing = -0.1"),
    (COLUMN, "cfl = 0.5", "cfl = 1.5"),
    (RINGS, "smoothing = 1.3", "smoothing = 0.3"),
    (RINGS, "smoothing = 1.3", "smoothing = 50"),
    (RINGS, "poisson_ratio = \"nu\"", "poisson_ratio = 0.5"),
    (RINGS, "inner = 0.03", "inner = 0.05"),
    (PLATE, "max = [\"L\", \"H/2\"]", "max = [-1, 1]"),
    (COLUMN, "index = 1", "index = 0"),
    // Names and what goes together.
    (PLATE, "at = [\"L\", 0]", "of = \"block\""),
    (PLATE, "at = [\"L\", 0]", "at = [\"L\", 0]\nof = \"block\""),
    (PLATE, "fixed = true", "name = \"wall\"\nfixed = true\n[[probe]]\nname = \"f\"\nof = \"wal\""),
    (COLUMN, "quantity = \"position\"", "quantity = \"reaction\""),
    (
        PLATE,
        "fixed = true",
        "name = \"wall\"\nfixed = true\n[[probe]]\nname = \"f\"\nof = \"wall\"\nquantity = \"velocity\"",
    ),
    (COLUMN, "zigzag = \"1 %\"", "stop = \"yes\""),
    (RINGS, "ul-non-hourglass", "ul-non-hourglas"),
    (RINGS, "ul-non-hourglass", "small-strain"),
    (RINGS, "linear-elastic", "neo-hookean"),
    (PLATE, "dimension = 2", "dimension = 2\nstepping = \"dual\""),
    (PLATE, "dimension = 2", "dimension = 2\nalpha = 5"),
    (
        PLATE,
        "[[gravity]]\nacceleration = [0, \"-9.81 m/s^2\"]",
        "[[load]]\nregion = \"strip\"\ntraction = [0, \"1 kPa\"]\npressure = 3",
    ),
    (
        PLATE,
        "[[gravity]]\nacceleration = [0, \"-9.81 m/s^2\"]",
        "[[load]]\nat = [\"L\", 0]\ntraction = [0, \"1 kPa\"]",
    ),
    (
        PLATE,
        "[[gravity]]\nacceleration = [0, \"-9.81 m/s^2\"]",
        "[[load]]\nat = [\"L\", 0]\nforce = [0, \"1 kPa\"]\nhistory = [[0, 0], [\"1 ms\", 1], [0, 1]]",
    ),
    (
        PLATE,
        "[[gravity]]\nacceleration = [0, \"-9.81 m/s^2\"]",
        "[[load]]\nat = [\"L\", 0]\nforce = [0, \"1 N\"]\nhistory = \"gone.csv\"",
    ),
    (
        PLATE,
        "[time]\n",
        "[quasi_static]\nincrements = 0\ntolerance = 2\n[damping]\nviscosity = \"1 Pa\"\n\n[time]\n",
    ),
    (
        RINGS,
        "[time]\n",
        "[quasi_static]\n\n[[contact]]\nbodies = [\"left\", \"right\"]\nfriction = 0.2\n\n[time]\n",
    ),
    (PLATE, "dimension = 2", "dimension = 2\nformulation = \"tl-ganzenmueller\"\nalpha = -1"),
    (RINGS, "material = \"rubber\"", "material = \"ruber\""),
    (PLATE, "[\"strip\", \"block\"]", "[\"strip\", \"blok\"]"),
    (PLATE, "fixed = true", "fixed = true\nfix = [\"x\"]"),
    (RINGS, "name = \"right\"", "name = \"left\""),
    (RINGS, "velocity = [\"v0\", 0]", "velocity = [\"v0*t\", 0]"),
    // Tools and contact.
    (PUNCH, "displacement = [0, \"-0.1*t\"]", "displacement = [0, \"-0.1*x\"]"),
    (PUNCH, "displacement = [0, \"-0.1*t\"]", "displacement = [0, 0]\nvelocity = [0, 0]"),
    (PUNCH, "displacement = [0, \"-0.1*t\"]", "velocity = [0, \"1/t\"]"),
    (PUNCH, "angle = \"2*pi*t\"\n", ""),
    (PUNCH, "name = \"upper\"", "name = \"strip\""),
    (PUNCH, "[\"strip\", \"upper\"]", "[\"strip\", \"uper\"]"),
    (PUNCH, "[\"strip\", \"upper\"]", "\"strip\""),
    (PUNCH, "[\"strip\", \"upper\"]", "[\"roller\", \"upper\"]"),
    (PUNCH, "[\"strip\", \"upper\"]", "[\"upper\"]"),
    (PUNCH, "[\"strip\", \"roller\"]\nignore = true", "[\"upper\", \"strip\"]"),
    (PUNCH, "friction = 0.3", "friction = -0.3"),
    (PUNCH, "ignore = true", "ignore = true\nfriction = 1"),
    (PUNCH, "by = \"strip\"", "at = [0, 0]"),
    (PUNCH, "quantity = \"contact-force\"\nbody = \"upper\"", "body = \"strip\"\nat = [0, 0]"),
    (PUNCH, "component = \"z\"\nover = \"2 N m\"", "component = \"z\"\nover = \"2 N\""),
    (RINGS, "[time]", "[[contact]]\nbodies = [\"left\", \"right\"]\n\n[time]"),
];

/// Wrong overrides of the rings.
const OVERRIDES: &[&str] =
    &["time.end", "time.ende=1", "material.ruber.density=2", "spacing=1 kPa", "body.2.velocity=[1, 0]"];

/// Doubtful, but legal.
const DOUBTFUL: &[Wrong] = &[
    (RINGS, "nu = 0.4", "nu = 0.3"),
    (RINGS, "ul-non-hourglass", "ul-artificial-stress"),
    (PLATE, "density = \"1 g/cm^3\"", "density = 1.1"),
    (PLATE, "bulk_modulus = 3e6", "bulk_modulus = 3"),
    (PLATE, "bulk_modulus = 3e6", "bulk_modulus = 3e9"),
    (COLUMN, "\"90 deg\"", "90"),
];

#[test]
fn messages_are_as_agreed() {
    let mut text = String::new();
    for &(case, old, new) in WRONG {
        assert!(case.contains(old), "{old} is in the case");
        let error = parse(&case.replacen(old, new, 1)).expect_err(new);
        let _ = write!(text, "### {old} -> {new}\n\n{error}\n\n\n");
    }
    for set in OVERRIDES {
        let error = parse_set(RINGS, &[set]).expect_err(set);
        let _ = write!(text, "### --set {set}\n\n{error}\n\n\n");
    }
    for &(case, old, new) in DOUBTFUL {
        assert!(case.contains(old), "{old} is in the case");
        let plane = |text: &str| text.replace("plane = \"papers\"\n", "");
        let warned = parse(&plane(&case.replacen(old, new, 1))).expect("legal");
        assert!(parse(case).expect("right").warnings.is_empty(), "{case}");
        let warnings = warned.render_warnings(false);
        assert!(!warnings.is_empty(), "{old} -> {new}");
        let _ = write!(text, "### {old} -> {new}\n\n{warnings}\n\n\n");
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/messages.txt");
    if std::env::var_os("TAUT_ACCEPT").is_some() {
        std::fs::write(&file, &text).expect("messages.txt is written");
    }
    let agreed = std::fs::read_to_string(&file).expect("messages.txt");
    assert!(text == agreed, "a message changed: see the comment of this test");
}
