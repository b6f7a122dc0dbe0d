//! No text, however broken, makes the reader panic or hang.

mod samples;

use std::time::{Duration, Instant};

use case::{Case, Expression, Names, Overrides};
use proptest::prelude::*;
use samples::{COLUMN, PLATE, RINGS, parse};

/// Reads a text and renders what is wrong with it. A sample takes about a millisecond; ten seconds are a hang.
fn read(text: &str, overrides: &Overrides) {
    let start = Instant::now();
    if let Err(error) = Case::parse("case.toml", text, overrides) {
        assert!(!error.diagnostics.is_empty());
        assert!(!error.render(false).is_empty() && !error.render(true).is_empty());
    }
    assert!(start.elapsed() < Duration::from_secs(10), "{text}");
}

/// A change of a text: what stands at a place is replaced by a piece that means something somewhere.
#[derive(Debug, Clone)]
struct Change {
    place: prop::sample::Index,
    length: usize,
    piece: String,
}

const PIECES: &[&str] = &[
    "",
    "\"",
    "'",
    "\"\"\"",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "=",
    ",",
    ".",
    "\n",
    "#",
    "-",
    "1e999",
    "nan",
    "-0",
    "t",
    "x",
    "\u{0}",
    "\u{feff}",
    "\u{1f600}",
    "\\u0041",
    "true",
    "2026-01-01",
    "[[body]]\n",
    "[time]\n",
    "free",
    "union",
    "9223372036854775808",
    "0x",
    "^^",
    "\r\n",
    "\t",
    "%",
    "1 mm",
    "*/",
    "\u{301}",
    "\u{200d}",
];

fn change() -> impl Strategy<Value = Change> {
    (any::<prop::sample::Index>(), 0..12usize, prop::sample::select(PIECES))
        .prop_map(|(place, length, piece)| Change { place, length, piece: piece.to_string() })
}

/// The text after the changes, cut at characters.
fn changed(text: &str, changes: &[Change]) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    for change in changes {
        let start = change.place.index(letters.len().max(1)).min(letters.len());
        let end = (start + change.length).min(letters.len());
        letters.splice(start..end, change.piece.chars());
    }
    letters.into_iter().collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_are_refused_quietly(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        read(&String::from_utf8_lossy(&bytes), &Overrides::default());
    }

    #[test]
    fn broken_cases_are_refused_quietly(
        text in prop::sample::select(vec![RINGS, PLATE, COLUMN]),
        changes in prop::collection::vec(change(), 1..6),
    ) {
        read(&changed(text, &changes), &Overrides::default());
    }

    #[test]
    fn broken_overrides_are_refused_quietly(
        text in prop::sample::select(vec![RINGS, PLATE, COLUMN]),
        set in prop::sample::select(vec![
            "time.end=0.1", "body.0.velocity=[1, 0]", "parameters.v0=\"2*c0\"", "probe.S.at=[0, 0, 1]",
            "body.0.shape.ring.inner=1 mm", "material.rubber.density=2", "formulation=\"tl-nested\"",
        ]),
        changes in prop::collection::vec(change(), 0..4),
    ) {
        read(text, &Overrides::set([changed(set, &changes)]));
    }

    #[test]
    fn random_expressions_are_read_or_refused(text in "[-+*/^()<>=!,. a-z0-9]{0,60}") {
        let known = [("a".to_string(), 2.0)];
        let names = Names { variables: &["x", "t"], constants: &known };
        match Expression::parse(&text, &names) {
            Ok(expression) => drop(expression.eval(&[0.5, 1.0])),
            Err(error) => {
                prop_assert!(error.span.start <= error.span.end && error.span.end <= text.len());
                prop_assert!(text.get(error.span).is_some());
            }
        }
    }
}

#[test]
fn extreme_texts_are_refused_quietly() {
    let texts = [
        "a = ".to_string() + &"[".repeat(100_000),
        "a = ".to_string() + &"{ b = ".repeat(100_000),
        "a".to_string() + &".a".repeat(100_000) + " = 1",
        "[a".to_string() + &".a".repeat(100_000) + "]",
        "[[body]]\n".repeat(3_000),
        "x = 1\n".repeat(10_000),
        "\u{feff}".to_string() + RINGS,
        RINGS.replace('\n', "\r\n"),
        RINGS.replace("v0\"", &("(".repeat(100_000) + "\"")),
        RINGS.replace("v0\"", &("v0".to_string() + &"+v0".repeat(100_000) + "\"")),
        RINGS.replace("0.06*c0", &"\u{1f600}".repeat(10_000)),
    ];
    for text in &texts {
        read(text, &Overrides::default());
    }
}

#[test]
fn a_byte_order_mark_and_dos_lines_do_no_harm() {
    assert!(parse(&("\u{feff}".to_string() + RINGS)).is_ok());
    assert!(parse(&RINGS.replace('\n', "\r\n")).is_ok());
    let wrong = "\u{feff}".to_string() + &RINGS.replace('\n', "\r\n").replace("densit", "denst");
    let error = parse(&wrong).expect_err("wrong");
    assert_eq!(error.line(&error.diagnostics[1]), Some(24), "{error}");
}

#[test]
fn long_chains_of_parameters_are_followed() {
    let mut chain = String::from("p0 = 1\n");
    for i in 1..3_000 {
        chain.push_str(&format!("p{i} = \"p{} + 1\"\n", i - 1));
    }
    let backwards: String = chain.lines().rev().map(|line| format!("{line}\n")).collect();
    for parameters in [chain, backwards] {
        let case = parse(&PLATE.replace("H = 0.02\n", &format!("H = 0.02\n{parameters}"))).expect("right");
        let last = case.parameters.iter().find(|(name, _)| name == "p2999");
        assert_eq!(last.map(|(_, value)| *value), Some(3_000.0));
    }
}
