//! Housekeeping: sizes, and words that do not belong into a repository.

use crate::{files, from_root, read, sources};
use std::path::PathBuf;

/// Longest file, lines.
const FILE: usize = 400;
/// Longest function, lines.
const FUNCTION: usize = 60;

#[test]
fn no_source_file_is_longer_than_400_lines() {
    let mut lengths: Vec<usize> = Vec::new();
    for path in sources() {
        let lines = read(&path).lines().count();
        assert!(lines <= FILE, "{} has {lines} lines", from_root(&path));
        lengths.push(lines);
    }
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    assert!(median <= 150, "half of the files have more than {median} lines");
}

#[test]
fn no_function_is_longer_than_60_lines() {
    for path in sources() {
        let source = read(&path);
        for (line, length) in functions(&source) {
            assert!(length <= FUNCTION, "{}:{line}: a function of {length} lines", from_root(&path));
        }
    }
}

/// First line and length of every function with a body, by its indentation: it ends at the first brace that closes as
/// deep as it began.
fn functions(source: &str) -> Vec<(usize, usize)> {
    const WORDS: [&str; 7] = ["pub", "pub(crate)", "pub(super)", "const", "unsafe", "async", "extern"];
    let lines: Vec<&str> = source.lines().collect();
    let mut found = Vec::new();
    for (first, line) in lines.iter().enumerate() {
        let indent = line.len() - line.trim_start().len();
        let mut words = line.split_whitespace().skip_while(|word| WORDS.contains(word));
        if words.next() != Some("fn") {
            continue;
        }
        let as_deep = |l: &&str| {
            l.len() > indent && !l[..indent].contains(|c| c != ' ') && !l[indent..].starts_with(' ')
        };
        // What ends a declaration without a body, or a body: the first line as deep as the beginning that ends so.
        let end = lines[first..].iter().position(|l| as_deep(l) && (l.ends_with('}') || l.ends_with(';')));
        match end {
            Some(end) if lines[first + end].ends_with('}') => found.push((first + 1, end + 1)),
            _ => {}
        }
    }
    found
}

#[test]
fn functions_are_measured() {
    let source = "fn a() {\n    b();\n}\n\nimpl X {\n    pub fn b(\n        c: C,\n    ) -> D {\n        e\n    }\n}\n";
    assert_eq!(functions(source), [(1, 3), (6, 5)]);
    let declared = "trait T {\n    fn a(\n        b: B,\n    ) -> C;\n    fn c() {\n    }\n}\n";
    assert_eq!(functions(declared), [(5, 2)]);
}

/// Everything that people wrote.
fn everything() -> Vec<PathBuf> {
    let mut all = files("crates", &["rs", "toml", "py", "txt"]);
    for folder in ["cases", "benches", "validation", "docs", "book", "reliability", ".ci"] {
        all.extend(files(folder, &["rs", "toml", "py", "sh", "md", "csv", ""]));
    }
    for page in [
        "README.md",
        "ARCHITECTURE.md",
        "CONVENTIONS.md",
        "CHANGELOG.md",
        "RELIABILITY.md",
        "CITATION.cff",
        "Cargo.toml",
    ] {
        all.push(crate::root().join(page));
    }
    all
}

#[test]
fn nothing_names_a_place_of_one_machine_or_a_thing_to_be_done() {
    // In two halves, so that this file does not find itself.
    let words = [
        ["/ho", "me/"],
        ["/wo", "rk/"],
        ["/ro", "ot/"],
        ["/t", "mp/"],
        ["TO", "DO"],
        ["FIX", "ME"],
        ["XX", "X"],
        ["to", "do!("],
        ["unimpl", "emented!("],
    ];
    let words = words.map(|halves| halves.concat());
    for path in everything() {
        for (number, line) in read(&path).lines().enumerate() {
            for word in &words {
                assert!(!line.contains(word), "{}:{}: {word}", from_root(&path), number + 1);
            }
        }
    }
}

/// Pages are filled in: no mark of a template, such as a name in capitals between two at signs, is left.
#[test]
fn no_page_has_an_unfilled_place() {
    for path in everything().into_iter().filter(|path| path.extension().is_some_and(|e| e == "md")) {
        let page = read(&path);
        for piece in page.split('@').skip(1) {
            let name = !piece.is_empty() && piece.chars().all(|c| c.is_ascii_uppercase() || c == '_');
            assert!(!name, "{}: @{piece}@", from_root(&path));
        }
    }
}

/// A library must not panic on what a user gave it: outside tests there is no unwrap, expect or panic in the crates
/// that read input and write results.
#[test]
fn nothing_that_a_user_reaches_may_panic() {
    for path in sources() {
        let place = from_root(&path);
        if place.starts_with("crates/taut/") || place.ends_with("tests.rs") {
            continue;
        }
        let source = read(&path);
        let code = source.split("#[cfg(test)]").next().unwrap_or_default();
        for (number, line) in code.lines().enumerate() {
            let line = line.split("//").next().unwrap_or_default();
            for word in [".unwrap()", ".expect(", "panic!(", "unreachable!("] {
                assert!(!line.contains(word), "{place}:{}: {word}", number + 1);
            }
        }
    }
}
