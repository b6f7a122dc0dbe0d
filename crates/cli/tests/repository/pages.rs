//! What the pages say, compared with the code.

use crate::{files, from_root, read, root, text};
use taut::field::{Quantity, Rank};

/// What stands between two marks of a page.
fn between<'a>(page: &'a str, begin: &str, end: &str) -> &'a str {
    let (_, rest) = page.split_once(begin).unwrap_or_else(|| panic!("{begin} is missing"));
    rest.split_once(end).unwrap_or_else(|| panic!("{end} is missing")).0
}

/// The table of fields in CONVENTIONS.md is the glossary. If this fails, put the printed table there.
#[test]
fn the_table_of_fields_is_the_glossary() {
    let mut table = "| name | symbol | rank | unit |\n|---|---|---|---|\n".to_string();
    for quantity in Quantity::ALL {
        let rank = match quantity.rank() {
            Rank::Scalar => "scalar",
            Rank::Vector => "vector",
            Rank::Tensor => "tensor",
        };
        let (name, symbol, unit) = (quantity.name(), quantity.symbol(), quantity.unit());
        table += &format!("| `{name}` | {symbol} | {rank} | {unit} |\n");
    }
    let page = text("CONVENTIONS.md");
    let written = between(&page, "<!-- fields: begin -->\n", "<!-- fields: end -->");
    assert_eq!(written, table, "the glossary has changed; the table should read\n{table}");
}

/// The commands of the README's second code block are what the continuous integration runs.
#[test]
fn the_two_commands_of_the_readme_are_run_by_ci() {
    let readme = text("README.md");
    let commands = between(&readme, "```sh\n", "```");
    let commands: Vec<&str> =
        commands.lines().map(|line| line.split('#').next().unwrap_or_default().trim()).collect();
    assert_eq!(commands.len(), 2, "two commands: {commands:?}");
    let ci = text(".ci/run");
    for command in commands {
        assert!(
            ci.lines().any(|line| line.trim() == command || line.trim().starts_with(&format!("{command} "))),
            "{command} is not in .ci/run"
        );
    }
}

#[test]
fn the_readme_names_every_built_in_case() {
    let readme = text("README.md");
    for path in files("cases", &["toml"]) {
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        assert!(readme.contains(&format!("`{name}`")), "{name} is not in README.md");
    }
}

#[test]
fn architecture_names_every_crate_and_every_module_of_the_numerics() {
    let page = text("ARCHITECTURE.md");
    for folder in ["crates", "crates/taut/src"] {
        for entry in std::fs::read_dir(root().join(folder)).expect("a folder").flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            assert!(
                !entry.path().is_dir() || page.contains(&name),
                "{folder}/{name} is not in ARCHITECTURE.md"
            );
        }
    }
}

#[test]
fn links_between_pages_lead_somewhere() {
    for name in ["README.md", "ARCHITECTURE.md", "CONVENTIONS.md", "CHANGELOG.md", "docs/performance.md"] {
        let page = text(name);
        let folder = root().join(name).parent().expect("a folder").to_path_buf();
        for target in page.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = target.split('#').next().unwrap_or_default();
            if file.is_empty() || file.starts_with("http") {
                continue;
            }
            assert!(folder.join(file).exists(), "{name}: {target} leads nowhere");
        }
        for target in page.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            assert!(root().join(target).exists(), "{name}: {target} leads nowhere");
        }
    }
}

#[test]
fn pictures_are_small() {
    for path in files("docs", &["png", "svg", "gif"]) {
        let size = std::fs::metadata(&path).expect("a file").len();
        assert!(size < 120_000, "{} has {size} bytes", from_root(&path));
    }
}

#[test]
fn one_version_everywhere() {
    let version = env!("CARGO_PKG_VERSION");
    assert!(text("CITATION.cff").contains(&format!("version: {version}")), "CITATION.cff");
    let changes = text("CHANGELOG.md");
    assert!(
        changes.contains("## [Unreleased]") || changes.contains(&format!("## [{version}]")),
        "CHANGELOG.md"
    );
    for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
        assert!(read(&root().join(licence)).len() > 1000, "{licence} is the full text");
    }
}
