//! A column's name in words.

/// Lower-case words and numbers of a name: `jointPos_1[deg]` has joint, pos, 1, deg.
pub(super) fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        let begins = !letter.is_alphanumeric()
            || letter.is_ascii_digit() != before.is_ascii_digit()
            || (letter.is_uppercase() && before.is_lowercase());
        if begins {
            words.push(String::new());
        }
        if letter.is_alphanumeric()
            && let Some(word) = words.last_mut()
        {
            word.extend(letter.to_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Whether one of the words is in a list.
pub(super) fn has(words: &[String], list: &[&str]) -> bool {
    words.iter().any(|word| list.contains(&word.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fall_into_words() {
        assert_eq!(words("jointPos_1[deg]"), ["joint", "pos", "1", "deg"]);
        assert_eq!(words("observation.state[0]"), ["observation", "state", "0"]);
        assert_eq!(words("position[joint_1]"), ["position", "joint", "1"]);
        assert_eq!(words("t"), ["t"]);
    }
}
