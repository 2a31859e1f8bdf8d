//! What the documentation says of the tree is true of the tree.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::CommandFactory;
use diagnosis::verdict::judged::Reason;
use firmware::supervisor::Fault;
use host_tool::commands::CommandLine;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn text(path: &str) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// README.md, CONTRIBUTING.md and all pages of docs/, relative to the root.
fn pages() -> Vec<String> {
    let docs = std::fs::read_dir(root().join("docs")).unwrap();
    let names = docs.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let pages = names.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}"));
    ["README.md", "CONTRIBUTING.md"].map(String::from).into_iter().chain(pages).collect()
}

/// What a text has in code marks.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// The cells of a table's rows that begin with a code mark.
fn rows(text: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = text.lines().filter(|line| line.starts_with("| `"));
    lines.map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
}

/// Whether a page has the heading that a link names, in lower case with dashes for spaces.
fn has_heading(page: &Path, link: &str) -> bool {
    let text = std::fs::read_to_string(page).unwrap();
    let mut headings = text.lines().filter(|line| line.starts_with('#'));
    headings.any(|heading| {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = words.chars().filter(|c| c.is_alphanumeric() || " -".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>() == link
    })
}

#[test]
fn links_lead_somewhere() {
    for page in pages() {
        let folder = root().join(&page).parent().unwrap().to_owned();
        let text = text(&page);
        let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
        for (link, _) in links.filter(|(link, _)| !link.contains("://")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { root().join(&page) } else { folder.join(file) };
            assert!(target.exists(), "{page}: {link} leads nowhere");
            assert!(heading.is_empty() || has_heading(&target, heading), "{page}: {link}");
        }
    }
}

#[test]
fn paths_in_code_marks_exist() {
    const FOLDERS: [&str; 9] = [
        "docs/",
        "emulator/",
        "firmware/",
        "fuzz/",
        "host-tool/",
        "model/",
        "tests/",
        "xtask/",
        ".ci/",
    ];
    for page in pages() {
        for line in text(&page).lines() {
            for path in code(line) {
                let is_path = FOLDERS.iter().any(|folder| path.starts_with(folder));
                let path = path.split([' ', '*', ':', '<']).next().unwrap();
                assert!(!is_path || root().join(path).exists(), "{page}: {path} is not there");
            }
        }
    }
}

#[test]
fn the_architecture_page_names_the_dependencies_of_every_crate() {
    let page = text("docs/architecture.md");
    let workspace: toml::Table = text("Cargo.toml").parse().unwrap();
    let own = |name: &str| {
        let dependency = workspace["workspace"]["dependencies"].get(name);
        dependency.is_some_and(|dependency| dependency.get("path").is_some())
    };
    for row in rows(&page).filter(|row| row.len() == 3 && row[2] != "all of them") {
        let folder = row[0].trim_matches(['`', '/']);
        let manifest: toml::Table = text(&format!("{folder}/Cargo.toml")).parse().unwrap();
        let found = manifest.get("dependencies").and_then(toml::Value::as_table);
        let found = found.into_iter().flat_map(toml::Table::keys).map(String::as_str);
        let found: BTreeSet<&str> = found.filter(|name| own(name)).collect();
        let listed: BTreeSet<&str> = code(row[2]).collect();
        assert_eq!(found, listed, "{folder}");
    }
}

#[test]
fn every_crate_has_its_row_in_the_architecture_page() {
    let page = text("docs/architecture.md");
    let workspace: toml::Table = text("Cargo.toml").parse().unwrap();
    for (name, dependency) in workspace["workspace"]["dependencies"].as_table().unwrap() {
        let Some(path) = dependency.get("path").and_then(toml::Value::as_str) else { continue };
        let is_listed = rows(&page).any(|row| row[0].trim_matches(['`', '/']) == path);
        assert!(
            is_listed || path.starts_with("tests"),
            "{name} has no row in docs/architecture.md"
        );
    }
}

#[test]
fn every_fault_has_its_row() {
    let page = text("docs/safety.md");
    for fault in Fault::ALL {
        let row = format!("| {} | {} |", fault.number(), fault.name());
        assert!(page.contains(&row), "docs/safety.md has no row of {}", fault.name());
    }
}

#[test]
fn every_reason_not_to_name_an_effect_has_its_cure() {
    let page = text("docs/diagnosis.md");
    for reason in Reason::ALL {
        assert!(page.contains(reason.words()), "docs/diagnosis.md lacks \"{}\"", reason.words());
    }
}

#[test]
fn every_command_is_documented() {
    let readme = text("README.md");
    for command in CommandLine::command().get_subcommands() {
        let name = command.get_name();
        assert!(readme.contains(name), "README.md does not name `rrr {name}`");
        assert!(command.get_about().is_some(), "`rrr {name}` has no help");
    }
}
