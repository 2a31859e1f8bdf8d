//! Circles among the files and folders of every directory.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;

use super::edges::Edge;

/// How many lines of an import are shown.
const SHOWN: usize = 10;

/// Files and folders of one directory that import each other in a circle.
#[derive(Debug)]
pub struct Circle<'e> {
    directory: PathBuf,
    members: Vec<&'e Path>,
    links: Links<'e>,
}

/// From one file or folder of a directory into another, by which imports.
type Links<'e> = BTreeMap<(&'e Path, &'e Path), Vec<&'e Edge>>;

/// For every directory, the circles among the files and folders that are directly in it.
///
/// The file `name.rs` of a folder `name` belongs to that folder, as a `mod.rs` would.
pub fn find(edges: &BTreeSet<Edge>) -> Vec<Circle<'_>> {
    let files = edges.iter().flat_map(|edge| [&edge.from, &edge.to]);
    let folders: BTreeSet<&Path> = files.flat_map(|file| file.ancestors().skip(1)).collect();
    let mut directories: BTreeMap<&Path, Links<'_>> = BTreeMap::new();
    for edge in edges {
        let [from, to] = [&edge.from, &edge.to].map(|file| way_to(file, &folders));
        let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
        let links = directories.entry(from[shared - 1]).or_default();
        links.entry((from[shared], to[shared])).or_default().push(edge);
    }
    directories.iter().flat_map(|(directory, links)| circles(directory, links)).collect()
}

/// The folders from the workspace's down to a file, and the file.
fn way_to<'e>(file: &'e Path, folders: &BTreeSet<&'e Path>) -> Vec<&'e Path> {
    let mut way: Vec<&Path> = file.ancestors().collect();
    way.reverse();
    if let Some(folder) = folders.get(file.with_extension("").as_path()) {
        way.insert(way.len() - 1, folder);
    }
    way
}

fn circles<'e>(directory: &Path, links: &Links<'e>) -> Vec<Circle<'e>> {
    let graph: DiGraphMap<&Path, ()> = DiGraphMap::from_edges(links.keys());
    let groups = tarjan_scc(&graph).into_iter().filter(|group| group.len() > 1);
    groups.map(|group| Circle::new(directory, group, links)).collect()
}

impl<'e> Circle<'e> {
    fn new(directory: &Path, mut members: Vec<&'e Path>, links: &Links<'e>) -> Self {
        members.sort_unstable();
        let mut links = links.clone();
        links.retain(|(from, to), _| members.contains(from) && members.contains(to));
        Self { directory: directory.to_owned(), members, links }
    }
}

impl fmt::Display for Circle<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let members: Vec<String> = self.members.iter().map(|member| name(member)).collect();
        writeln!(f, "a circle in {}: {}", self.directory.display(), members.join(", "))?;
        let mut links: Vec<_> = self.links.iter().collect();
        links.sort_by_key(|(_, edges)| edges.len());
        for ((from, to), edges) in links {
            writeln!(f, "  {} -> {}, lines: {}", name(from), name(to), edges.len())?;
            edges.iter().take(SHOWN).try_for_each(|edge| writeln!(f, "    {edge}"))?;
            if edges.len() > SHOWN {
                writeln!(f, "    and {} more", edges.len() - SHOWN)?;
            }
        }
        Ok(())
    }
}

/// The name of a file or folder, this with a `/`.
fn name(member: &Path) -> String {
    let is_file = member.extension().is_some_and(|extension| extension == "rs");
    let name = member.file_name().unwrap_or_default().display();
    format!("{name}{}", if is_file { "" } else { "/" })
}
