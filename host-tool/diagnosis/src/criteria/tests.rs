//! The defaults survive being written and read, and mistakes are named.

use super::Criteria;

fn read(text: &str) -> Result<Criteria, String> {
    let name = format!("criteria-{}-{:?}.toml", std::process::id(), std::thread::current().id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, text).unwrap();
    let read = Criteria::read(&path);
    std::fs::remove_file(&path).unwrap();
    read.map_err(|error| format!("{error}; {}", error.hint()))
}

#[test]
fn the_defaults_are_read_back_as_they_are_written() {
    let defaults = Criteria::default();
    assert_eq!(read(&defaults.to_toml()).unwrap(), defaults);
    assert_eq!(read("# nothing is replaced\n").unwrap(), defaults);
}

#[test]
fn one_key_overrides_one_value() {
    let changed = read("[verdict]\nexplained = 0.8\n").unwrap();
    let mut expected = Criteria::default();
    expected.verdict.explained = 0.8;
    assert_eq!(changed, expected);
}

#[test]
fn mistakes_are_named_with_their_line() {
    let cases = [
        ("[rows]\n\nmargin = 1.0\n", ["line 3", "margin", "--print-criteria"]),
        ("[row]\n", ["line 1", "row", "--print-criteria"]),
        ("[search]\nstarts = 2.5\n", ["line 2", "2.5", "correct"]),
        ("[search]\nstarts = 0\n", ["line 2", "starts", "positive"]),
        ("[rows]\nmargin_s = -1.0\n", ["line 2", "margin_s", "positive"]),
        ("[rows]\nmargin_s = nan\n", ["line 2", "margin_s", "finite"]),
        ("[logs]\nheld_out_part = 1.0\n", ["line 2", "held_out_part", "below 1"]),
    ];
    for (text, words) in cases {
        let message = read(text).unwrap_err();
        for word in words {
            assert!(message.contains(word), "no `{word}` in: {message}");
        }
    }
}
