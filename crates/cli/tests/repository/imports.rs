//! Which modules a source file names.

/// A path of module names, from the root of its crate.
pub type ModulePath = Vec<String>;

/// Every path of the crate that a file names, from the root of the crate. `module` is the file's own path; comments do
/// not count.
pub fn named(source: &str, module: &[String]) -> Vec<ModulePath> {
    let code: String = source
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default())
        .fold(String::new(), |code, line| code + line + "\n");
    let mut found = Vec::new();
    for (start, base) in starts(&code, module) {
        tree(&code[start..], base, &mut found);
    }
    found
}

/// Where paths begin (behind `crate::`, or the last `super::` of a row), and what they begin with.
fn starts<'a>(code: &'a str, module: &'a [String]) -> impl Iterator<Item = (usize, ModulePath)> + 'a {
    let word = |at: usize, word: &str| {
        let before = code[..at].chars().next_back();
        code[at..].starts_with(word) && !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':')
    };
    code.char_indices().filter_map(move |(at, _)| {
        if word(at, "crate::") {
            return Some((at + "crate::".len(), Vec::new()));
        }
        if !word(at, "super::") {
            return None;
        }
        let mut end = at;
        let mut base = module.to_vec();
        while code[end..].starts_with("super::") {
            end += "super::".len();
            base.pop();
        }
        Some((end, base))
    })
}

/// Reads `a::b::{c, d::e}`; returns how many bytes it took.
fn tree(code: &str, mut base: ModulePath, found: &mut Vec<ModulePath>) -> usize {
    let mut at = 0;
    loop {
        let rest = &code[at..];
        if let Some(group) = rest.strip_prefix('{') {
            at += 1 + items(group, &base, found);
            return at;
        }
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        if name.is_empty() {
            break;
        }
        at += name.len();
        base.push(name);
        match code[at..].strip_prefix("::") {
            Some(_) => at += 2,
            None => break,
        }
    }
    found.push(base);
    at
}

/// Reads the items of a group up to its closing brace; returns how many bytes they took.
fn items(code: &str, base: &[String], found: &mut Vec<ModulePath>) -> usize {
    let mut at = 0;
    while let Some(next) = code[at..].chars().next() {
        match next {
            '}' => return at + 1,
            c if c.is_alphabetic() || c == '_' => at += tree(&code[at..], base.to_vec(), found),
            c => at += c.len_utf8(),
        }
    }
    at
}

/// The module of a file: `formulation/total/mod.rs` is formulation::total.
pub fn module_of(path: &str) -> ModulePath {
    let path = path.trim_end_matches(".rs").trim_end_matches("/mod");
    if path == "lib" || path == "main" {
        return Vec::new();
    }
    path.split('/').map(str::to_string).collect()
}

#[test]
fn paths_are_read_from_groups_and_from_super() {
    let source = "use super::{kick::Kick, super::pass::{Now, Pair}};\nuse super::super::math; // crate::lost\n\
                  let x = crate::run::Run::<f64>::new();";
    let found = named(source, &module_of("formulation/total/motion.rs"));
    let found: Vec<String> = found.iter().map(|path| path.join("::")).collect();
    let wanted = [
        "formulation::total::kick::Kick",
        "formulation::total::super::pass::Now",
        "formulation::total::super::pass::Pair",
        "formulation::math",
        "run::Run",
    ];
    assert!(wanted.iter().all(|path| found.iter().any(|f| f.starts_with(path))), "{found:?}");
    assert!(!found.iter().any(|path| path.contains("lost")), "{found:?}");
}
