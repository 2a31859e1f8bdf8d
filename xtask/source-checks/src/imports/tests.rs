//! Small trees of files, some with circles.

use std::fs;

use super::*;

/// The edges among the files of a library and, where it is among them, of a test.
fn edges_of(files: &[(&str, &str)]) -> BTreeSet<Edge> {
    let directory = tempfile::tempdir().unwrap();
    let root = directory.path();
    for (file, text) in files {
        fs::create_dir_all(root.join(file).parent().unwrap()).unwrap();
        fs::write(root.join(file), text).unwrap();
    }
    let of = |file: &str, library: Option<&str>| Crate {
        package: root.to_owned(),
        root: root.join(file),
        library: library.map(str::to_owned),
        is_test: library.is_none(),
    };
    let all = [of("src/lib.rs", Some("arm")), of("tests/all.rs", None)];
    let there: Vec<Crate> = all.into_iter().filter(|each| each.root.is_file()).collect();
    edges(&there, root).unwrap()
}

/// `from -> to: path` of every import.
fn imports(files: &[(&str, &str)]) -> Vec<String> {
    let edges = edges_of(files);
    edges.iter().map(|edge| edge.to_string().replace("src/", "")).collect()
}

/// The first line of every circle.
fn circles(files: &[(&str, &str)]) -> Vec<String> {
    let edges = edges_of(files);
    let circles = circles::find(&edges);
    circles.iter().map(|circle| circle.to_string().lines().next().unwrap().to_owned()).collect()
}

const LIB: (&str, &str) = ("src/lib.rs", "mod a; mod b;");

#[test]
fn two_files_that_use_each_other_are_a_circle_and_its_lines_are_named() {
    let files = [
        LIB,
        ("src/a.rs", "use crate::b::B;\npub struct A(B);"),
        ("src/b.rs", "pub struct B;\nfn f() {\n    super::a::A;\n}"),
    ];
    let edges = edges_of(&files);
    let found = circles::find(&edges);
    assert_eq!(found.len(), 1);
    let expected = "a circle in src: a.rs, b.rs\n  \
        a.rs -> b.rs, lines: 1\n    src/a.rs:1: crate::b::B (defined in src/b.rs)\n  \
        b.rs -> a.rs, lines: 1\n    src/b.rs:3: super::a::A (defined in src/a.rs)\n";
    assert_eq!(found[0].to_string(), expected);
}

#[test]
fn one_way_is_no_circle() {
    let files = [LIB, ("src/a.rs", "use crate::b::B;"), ("src/b.rs", "pub struct B;")];
    assert_eq!(imports(&files), ["a.rs:1: crate::b::B (defined in b.rs)"]);
    assert!(circles(&files).is_empty());
}

#[test]
fn a_circle_of_three_is_found() {
    let files = [
        ("src/lib.rs", "mod a; mod b; mod c; mod d;"),
        ("src/a.rs", "use crate::b::f; pub fn g() {}"),
        ("src/b.rs", "use crate::c::f as other; pub fn f() {}"),
        ("src/c.rs", "pub fn f() { crate::a::g() }"),
        ("src/d.rs", "use crate::a::g;"),
    ];
    assert_eq!(circles(&files), ["a circle in src: a.rs, b.rs, c.rs"]);
}

#[test]
fn what_is_re_exported_counts_where_it_is_defined() {
    let files = [
        ("src/lib.rs", "mod joint; pub use joint::{Angle, Speed};"),
        ("src/joint/mod.rs", "mod angle; mod speed; pub use angle::*; pub use speed::Speed;"),
        ("src/joint/angle.rs", "pub struct Angle;"),
        ("src/joint/speed.rs", "use super::Angle; pub struct Speed; fn f(_: crate::Speed) {}"),
    ];
    let expected = ["joint/speed.rs:1: super::Angle (defined in joint/angle.rs)"];
    assert_eq!(imports(&files), expected);
    assert!(circles(&files).is_empty());
}

#[test]
fn a_mod_that_defines_what_its_files_use_must_not_use_them() {
    let angle = ("src/joint/angle.rs", "use super::Unit; pub struct Angle(Unit);");
    let defining = "mod angle; pub use angle::Angle; pub struct Unit;";
    let lib = ("src/lib.rs", "mod joint;");
    assert!(circles(&[lib, ("src/joint/mod.rs", defining), angle]).is_empty());
    let using = format!("{defining} fn f(_: Angle) {{}}");
    let expected = ["a circle in src/joint: angle.rs, mod.rs"];
    assert_eq!(circles(&[lib, ("src/joint/mod.rs", &using), angle]), expected);
}

#[test]
fn folders_that_use_each_other_are_a_circle_though_no_files_are() {
    let one = ("src/one/mod.rs", "pub mod x; pub mod y;");
    let files = [
        ("src/lib.rs", "mod one; mod two;"),
        one,
        ("src/one/x.rs", "use crate::two::X;"),
        ("src/one/y.rs", "pub struct Y;"),
        ("src/two.rs", "mod z; pub struct X;"),
        ("src/two/z.rs", "use crate::one::y;\nfn f(_: y::Y) {}"),
    ];
    assert_eq!(circles(&files), ["a circle in src: one/, two/"]);
    let with_z_apart = [
        ("src/lib.rs", "mod one; mod two; mod z;"),
        one,
        files[2],
        files[3],
        ("src/two.rs", "pub struct X;"),
        ("src/z.rs", files[5].1),
    ];
    assert!(circles(&with_z_apart).is_empty());
}

#[test]
fn unit_tests_are_left_out_and_macros_are_read() {
    let files = [
        LIB,
        (
            "src/a.rs",
            "pub fn f() {}
            #[cfg(test)]
            mod tests { use crate::b::g; }
            #[cfg(test)]
            use crate::b::g;
            #[cfg(test)]
            mod more;",
        ),
        ("src/b.rs", "pub fn g() {\n println!(\"{}\", vec![x.a::<u8>(), crate::a::f()][0]);\n}"),
    ];
    assert_eq!(imports(&files), ["b.rs:2: crate::a::f (defined in a.rs)"]);
}

#[test]
fn files_of_tests_count_too() {
    let files = [
        ("src/lib.rs", "pub fn f() {}"),
        ("tests/all.rs", "mod common; mod other; fn t() { common::g(); arm::f() }"),
        ("tests/common/mod.rs", "pub fn g() { crate::other::h() }"),
        ("tests/other.rs", "use crate::common; pub fn h() { common::g() }"),
    ];
    assert_eq!(circles(&files), ["a circle in tests: common/, other.rs"]);
    assert!(imports(&files).contains(&"tests/all.rs:1: arm::f (defined in lib.rs)".to_owned()));
}

#[test]
fn imports_that_lead_to_themselves_and_names_from_outside_end_nowhere() {
    let files = [
        LIB,
        ("src/a.rs", "pub use crate::b::*; use std::fmt; fn f(_: fmt::Result, _: Missing) {}"),
        ("src/b.rs", "pub use crate::a::*; pub use self::nothing::here as here;"),
    ];
    let globs = ["a.rs:1: crate::b (defined in b.rs)", "b.rs:1: crate::a (defined in a.rs)"];
    assert_eq!(imports(&files), globs);
}
