//! What was done to logs, said once where it is the same of several.

/// The notes of each log by its file, as lines of a report.
pub fn told<'a>(logs: impl IntoIterator<Item = (&'a str, &'a [String])>) -> Vec<String> {
    let mut told: Vec<(&str, Vec<&str>)> = Vec::new();
    for (file, notes) in logs {
        for note in notes {
            match told.iter_mut().find(|(other, _)| other == note) {
                Some((_, files)) => files.push(file),
                None => told.push((note, vec![file])),
            }
        }
    }
    told.into_iter().map(|(note, files)| format!("{}: {note}.", files.join(", "))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_the_same_is_said_once() {
        let (both, one) = ("lag".to_owned(), "rows".to_owned());
        let logs = [("a.csv", [both.clone(), one].to_vec()), ("b.csv", [both].to_vec())];
        let told = told(logs.iter().map(|(file, notes)| (*file, notes.as_slice())));
        assert_eq!(told, ["a.csv, b.csv: lag.", "a.csv: rows."]);
    }
}
