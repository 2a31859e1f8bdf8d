//! Numbers as text: reading one field, writing one field.

use super::error::Problem;

/// Reads a finite number, with blanks or double quotes around it or not.
pub(super) fn float(field: &[u8]) -> Result<f64, Problem> {
    let bare = trim(field);
    match fast_float2::parse::<f64, _>(bare) {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(Problem::NotFinite(excerpt(bare))),
        Err(_) => Err(Problem::NotANumber(excerpt(bare))),
    }
}

/// Reads a whole number; `12.0` and `1e3` are whole, too.
pub(super) fn count(field: &[u8]) -> Result<i64, Problem> {
    const LARGEST_EXACT: f64 = (1_u64 << 53) as f64;
    if let Some((value, length)) = count_prefix(field)
        && length == field.len()
    {
        return Ok(value);
    }
    let value = float(field)?;
    if value.fract() == 0.0 && value.abs() <= LARGEST_EXACT {
        Ok(value as i64)
    } else {
        Err(Problem::NotACount(excerpt(trim(field))))
    }
}

/// A number at the beginning of `text` and its length in bytes.
#[inline]
pub(super) fn float_prefix(text: &[u8]) -> Option<(f64, usize)> {
    fast_float2::parse_partial::<f64, _>(text).ok().filter(|(value, _)| value.is_finite())
}

/// A whole number of up to 18 digits at the beginning of `text`, and its length in bytes.
#[inline]
pub(super) fn count_prefix(text: &[u8]) -> Option<(i64, usize)> {
    let sign = usize::from(text.first() == Some(&b'-'));
    let digits = text[sign..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    if !(1..=18).contains(&digits) {
        return None;
    }
    let digit = |value: i64, byte: &u8| 10 * value + i64::from(byte - b'0');
    let magnitude = text[sign..sign + digits].iter().fold(0, digit);
    Some((if sign == 1 { -magnitude } else { magnitude }, sign + digits))
}

/// A field without the blanks and double quotes around it.
pub(super) fn trim(field: &[u8]) -> &[u8] {
    let bare = field.trim_ascii();
    match bare {
        [b'"', inner @ .., b'"'] => inner.trim_ascii(),
        _ => bare,
    }
}

/// A field for a message: not longer than a line of a terminal holds.
fn excerpt(field: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(field);
    if text.chars().count() <= LONGEST {
        return text.into_owned();
    }
    text.chars().take(LONGEST).chain("...".chars()).collect()
}

/// Appends a number in decimals: `most` of them, less the zeros at the end beyond `least`.
///
/// A log has millions of numbers: whole ones format several times as fast as floats.
pub(super) fn push_decimal(line: &mut String, value: f64, least: usize, most: usize) {
    let scaled = (value * 10_f64.powi(most as i32)).round();
    if scaled.abs() < 9e15 {
        push_scaled(line, scaled as i64, most);
    } else {
        line.push_str(&format!("{value:.most$}"));
    }
    let spare = line.bytes().rev().take(most - least).take_while(|&byte| byte == b'0').count();
    line.truncate(line.len() - spare);
}

/// Appends `scaled` / 10^`decimals`.
fn push_scaled(line: &mut String, scaled: i64, decimals: usize) {
    use std::fmt::Write;
    let one = 10_u64.pow(decimals as u32);
    let magnitude = scaled.unsigned_abs();
    let sign = if scaled < 0 { "-" } else { "" };
    // Writing to a string cannot fail.
    let _ = write!(line, "{sign}{}.{:0decimals$}", magnitude / one, magnitude % one);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(value: f64, least: usize, most: usize) -> String {
        let mut line = String::new();
        push_decimal(&mut line, value, least, most);
        line
    }

    #[test]
    fn decimals_are_trimmed_down_to_the_least() {
        assert_eq!(decimal(0.001, 3, 9), "0.001");
        assert_eq!(decimal(0.1 + 0.2, 3, 9), "0.300");
        assert_eq!(decimal(0.003334, 3, 9), "0.003334");
        assert_eq!(decimal(-1.5, 6, 6), "-1.500000");
        assert_eq!(decimal(-1e-9, 6, 6), "0.000000");
        assert_eq!(decimal(1e20, 6, 6), "100000000000000000000.000000");
        assert_eq!(decimal(-0.25, 0, 3), "-0.25");
    }

    #[test]
    fn counts_are_whole() {
        assert_eq!(count(b"-163840").unwrap(), -163_840);
        assert_eq!(count(b" \"12.0\"").unwrap(), 12);
        assert!(matches!(count(b"12.5"), Err(Problem::NotACount(text)) if text == "12.5"));
        assert!(matches!(count(b"1e300"), Err(Problem::NotACount(_))));
        assert!(matches!(count(b"99999999999999999999"), Err(Problem::NotACount(_))));
        assert!(matches!(count(b""), Err(Problem::NotANumber(text)) if text.is_empty()));
        assert!(matches!(count(b"-"), Err(Problem::NotANumber(_))));
    }

    #[test]
    fn numbers_are_finite() {
        assert_eq!(float(b" 1.5\r").unwrap(), 1.5);
        assert!(matches!(float(b"nan"), Err(Problem::NotFinite(_))));
        assert!(matches!(float(b"-inf"), Err(Problem::NotFinite(_))));
        assert!(matches!(float(b"1,5"), Err(Problem::NotANumber(_))));
        assert!(float_prefix(b"inf,2").is_none());
        assert_eq!(float_prefix(b"-0.25,3"), Some((-0.25, 5)));
    }

    #[test]
    fn long_fields_are_cut_in_messages() {
        assert_eq!(excerpt(&[b'x'; 100]).len(), 43);
    }
}
