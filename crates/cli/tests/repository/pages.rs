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
    for name in [
        "README.md",
        "ARCHITECTURE.md",
        "CONVENTIONS.md",
        "CHANGELOG.md",
        "RELIABILITY.md",
        "docs/performance.md",
    ] {
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

/// The schema and the reference page are what the program prints. After a change of the keys, run this test with
/// `TAUT_ACCEPT=1` in the environment.
#[test]
fn schema_and_reference_page_are_those_of_the_program() {
    for (file, now) in
        [("docs/taut-case.schema.json", case::keys::schema()), ("docs/case-reference.md", case::keys::page())]
    {
        if std::env::var_os("TAUT_ACCEPT").is_some() {
            std::fs::write(root().join(file), &now).expect("the page is written");
        }
        assert!(text(file) == now, "{file} is not what the program prints: see the comment of this test");
    }
}

/// The built-in cases use only what the schema has: every key, at every level.
#[test]
fn built_in_cases_follow_the_schema() {
    let schema: serde_json::Value = serde_json::from_str(&case::keys::schema()).expect("JSON");
    let mut starter = vec![root().join("crates/cli/src/starter.toml")];
    starter.extend(files("cases", &["toml"]));
    for path in starter {
        let case: toml::Table = read(&path).parse().expect("TOML");
        let case = serde_json::to_value(case).expect("TOML is JSON");
        follows(&case, &schema, &schema, &path.display().to_string());
    }
}

/// Checks what schemas of this program use: references, alternatives, types, keys, words, lengths and bounds.
fn follows(value: &serde_json::Value, schema: &serde_json::Value, root: &serde_json::Value, at: &str) {
    if let Err(error) = fits(value, schema, root) {
        panic!("{at}: {error}");
    }
}

fn fits(
    value: &serde_json::Value,
    schema: &serde_json::Value,
    root: &serde_json::Value,
) -> Result<(), String> {
    use serde_json::Value;
    if let Some(reference) = schema["$ref"].as_str() {
        let name = reference.strip_prefix("#/definitions/").expect("a definition");
        return fits(value, &root["definitions"][name], root);
    }
    if let Some(any) = schema["anyOf"].as_array() {
        let errors: Vec<String> = any.iter().filter_map(|s| fits(value, s, root).err()).collect();
        return if errors.len() < any.len() { Ok(()) } else { Err(errors.join("; ")) };
    }
    if let Some(words) = schema["enum"].as_array() {
        return if words.contains(value) { Ok(()) } else { Err(format!("{value} is none of {words:?}")) };
    }
    if let Some(types) = schema.get("type") {
        let is = match value {
            Value::Object(_) => "object",
            Value::Array(_) => "array",
            Value::String(_) => "string",
            Value::Bool(_) => "boolean",
            Value::Number(n) if n.is_f64() => "number",
            _ => "integer",
        };
        let types: Vec<&str> = types
            .as_array()
            .map_or(vec![types.as_str().unwrap_or("")], |t| t.iter().filter_map(Value::as_str).collect());
        let wide = if is == "integer" { "number" } else { is };
        if !types.contains(&is) && !types.contains(&wide) {
            return Err(format!("{value} is no {types:?}"));
        }
    }
    if let Some(array) = value.as_array() {
        let length = array.len() as u64;
        if length < schema["minItems"].as_u64().unwrap_or(0)
            || length > schema["maxItems"].as_u64().unwrap_or(length)
        {
            return Err(format!("{value} has a wrong length"));
        }
        array.iter().try_for_each(|item| fits(item, &schema["items"], root))?;
    }
    let Some(table) = value.as_object() else { return Ok(()) };
    for required in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        table.get(required).ok_or(format!("`{required}` is missing in {value}"))?;
    }
    for (key, inner) in table {
        let known = schema["properties"].get(key).unwrap_or(&schema["additionalProperties"]);
        if !known.is_object() {
            return Err(format!("`{key}` is not in the schema"));
        }
        fits(inner, known, root).map_err(|error| format!("{key}: {error}"))?;
    }
    Ok(())
}
