//! Wrong cases: each is refused with the right line, what was found, and what was expected.

mod samples;

use case::{Case, Overrides};
use samples::{COLUMN, PLATE, PUNCH, RINGS, parse, parse_set};

/// A case, what is replaced in it (the first time it occurs) by what, and words of the message and its hint.
/// The line is that of the mark `@` in the replacement (which is taken out), or of its beginning.
type Row = (&'static str, &'static str, &'static str, &'static [&'static str]);

const ROWS: &[Row] = &[
    // Text and structure.
    (RINGS, "dimension = 2", "dimension = ", &["not valid TOML"]),
    (RINGS, "title = \"Two rings\"", "title = Two rings", &["not valid TOML", "quotes"]),
    (RINGS, "dimension = 2", "dimension = 2\n@dimension = 2", &["duplicate key"]),
    (RINGS, "[time]", "[time", &["not valid TOML"]),
    (RINGS, "smoothing", "smothing", &["unknown key `smothing` in the case", "did you mean `smoothing`?"]),
    (RINGS, "end = ", "ende = ", &["unknown key `ende` in [time]", "did you mean `end`?"]),
    (RINGS, "density", "densty", &["unknown key `densty` in [material.rubber]", "`density`"]),
    (PLATE, "except", "exept", &["unknown key `exept` in [[boundary]]", "did you mean `except`?"]),
    (
        PLATE,
        "kind = \"second",
        "prominence = 1\nkind = \"second",
        &["unknown key `prominence`", "second-crossing"],
    ),
    (RINGS, "end = \"12 ms\"", "", &["missing key `end` in [time]"]),
    (PLATE, "spacing = \"H/10\"\n", "", &["missing key `spacing`"]),
    (PLATE, "name = \"plate\"\ndim", "dim", &["missing key `name`"]),
    (PLATE, "dimension = 2\n", "", &["missing key `dimension`"]),
    (RINGS, "model = \"linear-elastic\"\n", "", &["missing key `model` in [material.rubber]"]),
    (RINGS, "material = \"rubber\"\n", "", &["missing key `material` in [[body]] `left`"]),
    (PLATE, "[[boundary]]\nregion = \"block\"\n", "[[boundary]]\n", &["missing key `region`"]),
    (PLATE, "[[boundary]]", "[boundary]", &["`boundary` has to be a list of tables", "[[boundary]]"]),
    (PLATE, "[time]", "[timee]", &["unknown key `timee`", "did you mean `time`?"]),
    (
        PLATE,
        "[parameters]\nH = 0.02\nL = 0.2",
        "parameters = 3",
        &["[parameters] has to be a table, found the number 3"],
    ),
    // Head.
    (PLATE, "name = \"plate\"", "name = \"My Plate\"", &["`My Plate` cannot be the name", "small letters"]),
    (PLATE, "name = \"plate\"", "name = 3", &["name has to be a text, found the number 3"]),
    (PLATE, "dimension = 2", "dimension = 4", &["has to be 2 or 3, found the number 4"]),
    (PLATE, "dimension = 2", "dimension = \"2\"", &["has to be 2 or 3, found the text \"2\""]),
    (
        PLATE,
        "dimension = 2",
        "dimension = 2\n@plane = \"stress\"",
        &["`plane = \"stress\"` does not go with `tl-hourglass-free`", "only small-strain"],
    ),
    (
        PLATE,
        "dimension = 2",
        "dimension = 2\n@plane = \"plain\"",
        &["unknown plane `plain`", "`strain`, `stress`, `papers`"],
    ),
    (
        COLUMN,
        "dimension = 3",
        "dimension = 3\n@plane = \"strain\"",
        &["`plane` says what 2D means", "remove"],
    ),
    (RINGS, "wendland-c2", "wendland", &["unknown kernel `wendland`", "did you mean `wendland-c2`?"]),
    (RINGS, "spacing = \"dp\"", "spacing = -0.1", &["`spacing` has to be positive, found -0.1"]),
    (RINGS, "spacing = \"dp\"", "spacing = [1]", &["`spacing` has to be a number, found a list of 1"]),
    (RINGS, "spacing = \"dp\"", "spacing = nan", &["`spacing` is NaN, expected a finite number"]),
    (RINGS, "smoothing = 1.3", "smoothing = 0", &["`smoothing` has to be positive"]),
    // Formulations and what depends on them.
    (
        RINGS,
        "ul-non-hourglass",
        "ul-non-hourglas",
        &["unknown formulation", "did you mean `ul-non-hourglass`?"],
    ),
    (RINGS, "ul-non-hourglass", "ul-generalized", &["unknown formulation", "did you mean `ul-generalised`?"]),
    (RINGS, "\"dual\"", "\"duel\"", &["unknown stepping `duel`", "did you mean `dual`?"]),
    (
        PLATE,
        "dimension = 2",
        "dimension = 2\n@stepping = \"dual\"",
        &["`stepping` belongs to updated Lagrangian"],
    ),
    (
        PLATE,
        "dimension = 2",
        "dimension = 2\n@reference_speed = 1",
        &["`reference_speed` belongs to updated"],
    ),
    (PLATE, "dimension = 2", "dimension = 2\n@alpha = 5", &["`alpha` belongs to tl-ganzenmueller"]),
    (PLATE, "dimension = 2", "dimension = 2\n@artificial_stress = 1", &["belongs to ul-art"]),
    (
        RINGS,
        "dimension = 2",
        "dimension = 2\n@calibration = \"lattice\"",
        &["`calibration` belongs to tl-hourglass-free"],
    ),
    (RINGS, "end = \"12 ms\"", "end = 1\n@step = \"paper\"", &["`step` belongs to total Lagrangian"]),
    (
        RINGS,
        "linear-elastic",
        "neo-hookean",
        &["`neo-hookean` does not go with `ul-non-hourglass`", "linear-elastic"],
    ),
    (
        PLATE,
        "\"neo-hookean\"",
        "\"saint-venant-kirchhoff\"",
        &["does not go with `tl-hourglass-free`", "`tl-nested`"],
    ),
    (
        PLATE,
        "\"neo-hookean\"",
        "\"neohookean\"",
        &["unknown model `neohookean`", "did you mean `neo-hookean`?"],
    ),
    // Parameters, units, expressions.
    (RINGS, "wall = \"10 mm\"", "wall = \"dp*10\"", &["circle", "`wall` -> `dp` -> `wall`"]),
    (RINGS, "nu = 0.4", "sin = 0.4", &["`sin` cannot be the name of a parameter"]),
    (
        RINGS,
        "nu = 0.4",
        "nu = 0.4\n@a-b = 1",
        &["`a-b` cannot be the name of a parameter", "letters, digits"],
    ),
    (RINGS, "nu = 0.4", "nu = true", &["parameter `nu` has to be a number, found `true`"]),
    (RINGS, "nu = 0.4", "nu = \"1/0\"", &["parameter `nu` is inf"]),
    (RINGS, "v0 = \"0.06*c0\"", "v0 = \"0.06*co\"", &["unknown name `co`", "did you mean `c0`?"]),
    (RINGS, "10 MPa", "10 MPaa", &["unknown unit `MPaa`", "did you mean `MPa`?"]),
    (RINGS, "outer = \"4 cm\"", "outer = \"4 MPa\"", &["expected a length (m), found a pressure (MPa)"]),
    (
        RINGS,
        "youngs_modulus = \"E\"",
        "youngs_modulus = \"wall\"",
        &["expected a pressure (Pa), found a length (mm)"],
    ),
    (PLATE, "-9.81 m/s^2", "-9.81 m/s", &["expected an acceleration (m/s^2), found a speed (m/s)"]),
    (PLATE, "-H/2\"]", "-H/2)\"]", &["this parenthesis closes nothing"]),
    (PLATE, "2*sin(pi*x/(2*L))", "2*sine(pi*x/(2*L))", &["unknown function `sine`", "did you mean `sin`?"]),
    (PLATE, "2*sin(pi*x/(2*L))", "2 sin(pi*x/(2*L))", &["an operator is missing", "`*`"]),
    (PLATE, "2*sin(pi*x/(2*L))", "z", &["uses `z`, which a 2D case does not have"]),
    (PLATE, "spacing = \"H/10\"", "spacing = \"x/10\"", &["unknown name `x`"]),
    // Materials.
    (
        RINGS,
        "poisson_ratio = \"nu\"",
        "poisson_ratio = 0.5",
        &["between -1 and 0.5, found 0.5", "incompressible"],
    ),
    (RINGS, "poisson_ratio = \"nu\"", "poisson_ratio = -1", &["between -1 and 0.5, found -1"]),
    (PLATE, "shear_modulus = 7e5", "youngs_modulus = 3e7", &["between -1 and 0.5, found -1.1"]),
    (RINGS, "density = \"rho\"", "density = 0", &["`density` has to be positive, found 0"]),
    (RINGS, "density = \"rho\"", "density = \"3 kg\"", &["expected a density (kg/m^3), found a mass (kg)"]),
    (RINGS, "poisson_ratio = \"nu\"\n", "", &["exactly two elastic constants, found youngs_modulus"]),
    (
        RINGS,
        "poisson_ratio = \"nu\"",
        "poisson_ratio = \"nu\"\n@bulk_modulus = 1",
        &["exactly two", "bulk_modulus"],
    ),
    // Bodies and shapes.
    (
        RINGS,
        "material = \"rubber\"",
        "material = \"ruber\"",
        &["unknown material `ruber`", "did you mean `rubber`?"],
    ),
    (RINGS, "name = \"right\"", "name = \"left\"", &["the name `left` is given twice"]),
    (RINGS, "name = \"left\"", "name = \"my left\"", &["`my left` cannot be a name"]),
    (RINGS, "fill = \"concentric\"", "fill = \"hexagonal\"", &["unknown fill", "\"concentric\""]),
    (RINGS, "velocity = [\"v0\", 0]", "velocity = [\"v0*t\", 0]", &["cannot use `t`", "[[boundary]]"]),
    (
        RINGS,
        "velocity = [\"v0\", 0]",
        "velocity = [\"v0\", 0, 0]",
        &["a list of 2 (dimension = 2), found a list of 3"],
    ),
    (COLUMN, "at = [0.5, 0.5, 6]", "at = [0.5, 0.5]", &["a list of 3 (dimension = 3), found a list of 2"]),
    (RINGS, "{ ring =", "{ rings =", &["unknown shape `rings`", "did you mean `ring`?"]),
    (
        RINGS,
        "inner = 0.03",
        "inner = 0.05",
        &["inner radius 0.05 has to be smaller than the outer radius 0.04"],
    ),
    (RINGS, "{ ring =", "{ hollow-ball =", &["`hollow-ball` exists in 3D only", "`ring`"]),
    (PLATE, "max = [\"L\", \"H/2\"]", "max = [-1, 1]", &["the box is empty along x: min -0.06 >= max -1"]),
    (
        PLATE,
        "[\"strip\", \"block\"]",
        "[\"strip\", \"blok\"]",
        &["unknown region `blok`", "did you mean `block`?"],
    ),
    (PLATE, "{ union = [\"strip\", \"block\"] }", "3", &["a shape is expected, found the number 3"]),
    (
        PLATE,
        "{ union = [\"strip\", \"block\"] }",
        "{ union = [], box = {} }",
        &["a table with one key, found 2"],
    ),
    (PLATE, "{ union = [\"strip\", \"block\"] }", "{ union = [] }", &["a list of shapes, found a list of 0"]),
    // Boundaries, time, probes, measures.
    (PLATE, "fixed = true", "fixed = true\n@fix = [\"x\"]", &["exactly one thing, found fixed, fix"]),
    (PLATE, "fixed = true", "fixed = false", &["`fixed = false` prescribes nothing"]),
    (PLATE, "fixed = true\n", "", &["exactly one thing, found none"]),
    (PLATE, "fixed = true", "fix = [\"z\"]", &["unknown axis `z`", "`x`, `y`"]),
    (PLATE, "fixed = true", "velocity = [\"free\", \"free\"]", &["leaves every axis free"]),
    (
        PLATE,
        "fixed = true",
        "body = \"plat\"\nfixed = true",
        &["unknown body `plat`", "did you mean `plate`?"],
    ),
    (PLATE, "end = 0.3", "end = \"3 m\"", &["`end`: expected a time (s), found a length (m)"]),
    (PLATE, "end = 0.3", "end = 0", &["`end` has to be positive, found 0"]),
    (COLUMN, "cfl = 0.5", "cfl = 1.5", &["`cfl` has to lie in (0, 1], found 1.5"]),
    (COLUMN, "zigzag = \"1 %\"", "zigzag = -1", &["`zigzag` has to be positive"]),
    (RINGS, "body = \"left\"\nat", "at", &["which `body` it belongs to", "left, right"]),
    (RINGS, "quantity = \"velocity\"", "quantity = \"speed\"", &["unknown quantity `speed`", "`velocity`"]),
    (PLATE, "probe = \"tip\"", "probe = \"top\"", &["unknown probe `top`", "did you mean `tip`?"]),
    (PLATE, "component = \"y\"", "component = \"z\"", &["unknown component `z`"]),
    (COLUMN, "index = 1", "index = 0", &["a whole number from 1 on, found the number 0"]),
    (COLUMN, "prominence = 0.3", "prominence = \"1 m/s\"", &["expected a length (m), found a speed (m/s)"]),
    (COLUMN, "\"value-at\"", "\"value-on\"", &["unknown kind `value-on`", "did you mean `value-at`?"]),
    (
        PUNCH,
        "contact-force\"\nbody = \"upper\"\nby = \"strip\"",
        "gap\"\nbody = \"strip\"\n@by = \"strip\"",
        &["between two bodies"],
    ),
    (
        PUNCH,
        "contact-moment\"\nbody = \"roller\"\n\n[[measure]]\nname = \"most\"\nkind = \"maximum\"\nprobe = \"moment\"\n",
        "gap\"\nbody = \"roller\"\n\n[[measure]]\nname = \"most\"\nkind = \"maximum\"\nprobe = \"moment\"\n@",
        &["a probe of gap records one number", "remove this line"],
    ),
    (COLUMN, "time = 1", "time = 2026-01-01", &["`time` has to be a number, found the date 2026-01-01"]),
];

/// The wrong text of a row and the line where it is wrong.
fn spoiled((text, old, new, _): &Row) -> (String, usize) {
    let at = text.find(old).unwrap_or_else(|| panic!("{old} is in the case"));
    let line = |end: usize, text: &str| text[..end].matches('\n').count() + 1;
    let whole = text.replacen(old, new, 1);
    match new.find('@') {
        Some(mark) => (whole.replacen('@', "", 1), line(at + mark, &whole)),
        None => (whole.clone(), line(at, &whole)),
    }
}

/// Rows whose diagnostic points at a header or the first line, because what is missing has no place of its own,
/// or at the other part of a contradiction: the text of that line.
const ELSEWHERE: &[(&str, &str)] = &[
    ("missing key `end`", "[time]"),
    ("missing key `spacing`", "name = \"plate\""),
    ("missing key `name`", "dimension = 2"),
    ("missing key `dimension`", "name = \"plate\""),
    ("missing key `model`", "[material.rubber]"),
    ("missing key `material`", "[[body]]"),
    ("missing key `region`", "[[boundary]]"),
    ("exactly two elastic constants, found youngs_modulus", "[material.rubber]"),
    ("exactly one thing, found none", "[[boundary]]"),
    ("between -1 and 0.5, found -1.1", "bulk_modulus = 3e6"),
    ("which `body` it belongs to", "[[probe]]"),
];

#[test]
fn each_wrong_input_is_explained_where_it_stands() {
    for row in ROWS {
        let (text, line) = spoiled(row);
        let Err(error) = parse(&text) else { panic!("accepted: {} -> {}", row.1, row.2) };
        let rendered = error.to_string();
        let place = error.diagnostics.iter().find(|d| {
            let said = format!("{} {} {}", d.message, d.label, d.help.as_deref().unwrap_or(""));
            row.3.iter().all(|words| said.contains(words))
        });
        let Some(diagnostic) = place else {
            panic!("{} -> {}: none of {:?} in\n{rendered}", row.1, row.2, row.3)
        };
        let found = error.line(diagnostic).expect("a line");
        let elsewhere = ELSEWHERE.iter().find(|(message, _)| row.3[0].starts_with(message));
        match elsewhere {
            Some((_, content)) => assert_eq!(text.lines().nth(found - 1), Some(*content), "{rendered}"),
            None => assert_eq!(found, line, "{} -> {}\n{rendered}", row.1, row.2),
        }
        assert!(rendered.contains(&format!("case.toml:{found}:")), "{rendered}");
    }
    assert!(ROWS.len() >= 90);
}

#[test]
fn the_rendered_text_shows_line_caret_and_hint() {
    let error = parse(&PLATE.replace("2*sin(pi*x", "2*sine(pi*x")).expect_err("wrong");
    let expected = "\
error: unknown function `sine`
  --> case.toml:25:29
   |
25 | velocity = [0, \"if(x > 0, 2*sine(pi*x/(2*L)), 0)\"]
   |                             ^^^^
   |
   = help: did you mean `sin`?";
    assert_eq!(error.to_string(), expected);
    assert!(error.render(true).contains('\u{1b}'));
}

#[test]
fn several_mistakes_are_told_at_once_and_once_each() {
    let text = RINGS
        .replace("density", "densty")
        .replace("inner = 0.03", "inner = \"3 s\"")
        .replace("end = \"12 ms\"", "end = \"12 mm\"")
        .replace("kind = \"rebound-speed\"", "kind = \"rebound\"");
    let error = parse(&text).expect_err("wrong");
    let messages: Vec<&str> = error.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages.len(), 6, "{messages:#?}");
    // In the order of the file.
    let lines: Vec<_> = error.diagnostics.iter().map(|d| error.line(d)).collect();
    assert!(lines.is_sorted(), "{lines:?}");
    // A wrong region is told where it stands, not again where it is used.
    let region = parse(&PLATE.replace("max = [\"L\", \"H/2\"]", "max = [-1, 1]")).expect_err("wrong");
    assert_eq!(region.diagnostics.len(), 1, "{region}");
}

#[test]
fn regions_that_contain_themselves_or_explode_are_refused() {
    let circle = PLATE.replacen(
        "{ box = { min = [-0.06, \"-H/2\"], max = [\"L\", \"H/2\"] } }",
        "{ union = [\"block\", \"strip\"] }",
        1,
    );
    assert!(parse(&circle).expect_err("wrong").to_string().contains("region `strip` is made of itself"));
    let mut doubling = PLATE.to_string();
    doubling.push_str("[region.r0]\nshape = \"block\"\n");
    for i in 1..25 {
        doubling.push_str(&format!("[region.r{i}]\nshape = {{ union = [\"r{0}\", \"r{0}\"] }}\n", i - 1));
    }
    assert!(parse(&doubling).expect_err("wrong").to_string().contains("made of too many parts"));
    let deep = "{ union = [".repeat(35) + "\"strip\"" + &"] }".repeat(35);
    let error = parse(&PLATE.replace("{ union = [\"strip\", \"block\"] }", &deep)).expect_err("wrong");
    assert!(error.to_string().contains("nested too deeply"), "{error}");
}

#[test]
fn wrong_overrides_are_shown_as_typed() {
    let rows: &[(&str, &[&str])] = &[
        ("time.end", &["`--set` needs a path, `=` and a value"]),
        ("time.end=-1", &["`end` has to be positive, found -1"]),
        ("time.ende=1", &["unknown key `ende` in [time]", "did you mean `end`?"]),
        (
            "parameters.resolutoin=20",
            &["the case has no parameter `resolutoin`", "did you mean `resolution`?"],
        ),
        ("material.ruber.density=2", &["the case has no material `ruber`", "did you mean `rubber`?"]),
        ("body.2.velocity=[1, 0]", &["`body` has 2 entries, counted from 0: there is no 2"]),
        ("body.lift.velocity=[1, 0]", &["no `body` is called `lift`", "did you mean `left`?"]),
        ("name.x=1", &["`name` is the text \"rings\": there is no `x` in it"]),
        ("spacing=1 kPa", &["expected a length (m), found a pressure (kPa)"]),
        ("spacing=dpp", &["unknown name `dpp`", "did you mean `dp`?"]),
        ("tiem.end=1", &["unknown key `tiem`", "did you mean `time`?"]),
        ("time..end=1", &["empty name in the path"]),
        ("=1", &["empty name in the path"]),
        ("body.0.velocity=[1, 0, 0]", &["a list of 2 (dimension = 2), found a list of 3"]),
        ("material.rubber.poisson_ratio=0.5", &["between -1 and 0.5"]),
    ];
    for (set, words) in rows {
        let error = parse_set(RINGS, &[set]).expect_err(set);
        let rendered = error.to_string();
        for word in words.iter().copied().chain([format!("--set {set}").as_str()]) {
            assert!(rendered.contains(word), "{set}: no `{word}` in\n{rendered}");
        }
        assert!(error.diagnostics.iter().all(|d| error.line(d).is_none()), "{rendered}");
    }
    let force = |name: &str| Overrides { formulation: Some(name.to_string()), ..Overrides::default() };
    let error = Case::parse("case.toml", RINGS, &force("ul-nestd")).expect_err("wrong").to_string();
    assert!(
        error.contains("--formulation ul-nestd") && error.contains("did you mean `ul-nested`?"),
        "{error}"
    );
    let error = Case::parse("case.toml", RINGS, &force("tl-nested")).expect_err("wrong").to_string();
    assert!(error.contains("--set material.rubber.model=neo-hookean"), "{error}");
}

#[test]
fn turns_are_counted_of_positions_about_an_axis_that_is_there() {
    let with = |axis: &str| {
        format!(
            "{RINGS}\n[[measure]]\nname = \"turns\"\nkind = \"most-turns\"\nprobe = \"front\"\naxis = \"{axis}\"\n"
        )
    };
    let message = |text: &str| parse(text).expect_err("wrong").to_string();
    assert!(message(&with("z")).contains("turns are counted of a probe that records positions"));
    let position = |text: String| text.replace("quantity = \"velocity\"", "quantity = \"position\"");
    assert!(parse(&position(with("z"))).is_ok());
    // In the plane there is one axis to go around.
    assert!(message(&position(with("x"))).contains("unknown axis `x`, expected one of `z`"));
}
