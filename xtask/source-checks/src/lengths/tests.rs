//! A small package, measured.

use std::fs;

use super::walk::measured;

const LIB: &str = "\
//! A library.

mod inner;

/// Says one.
pub fn one() -> u32 {
    // It is one.
    1
}

#[cfg(test)]
mod tests {
    #[test]
    fn it_is_one() {}
}
#[cfg(test)]
mod more;
";

#[test]
fn files_and_functions_are_measured_without_their_tests() {
    let directory = tempfile::tempdir().unwrap();
    let write = |file: &str, text: &str| {
        let path = directory.path().join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    write("arm/Cargo.toml", "");
    write("arm/src/lib.rs", LIB);
    write("arm/src/inner.rs", "trait T {\n    fn a();\n    fn b(\n    ) {}\n}");
    for tests in ["arm/src/more.rs", "arm/src/more/deep.rs", "arm/tests/all.rs"] {
        write(tests, "fn t() {}");
    }
    let [inner, lib] = measured(directory.path()).unwrap().try_into().unwrap();
    assert_eq!(inner.path.to_str().unwrap(), "arm/src/inner.rs");
    assert_eq!(lib.package.to_str().unwrap(), "arm");
    assert_eq!((inner.lines, inner.code, inner.functions.len()), (5, 5, 1));
    assert_eq!((inner.functions[0].line, inner.functions[0].lines), (3, 2));
    assert_eq!((lib.lines, lib.code), (10, 4));
    assert_eq!((lib.functions[0].name.as_str(), lib.functions[0].lines), ("one", 4));
}
