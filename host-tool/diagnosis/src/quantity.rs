//! Numbers with units for readers: three digits, and thousandths where they are small.

/// Unit suffixes of names, as they are written and as they are said; longest first.
const UNITS: [(&str, &str); 23] = [
    ("_V_s2_per_rad2", "V s^2/rad^2"),
    ("_Nm_s_per_rad", "Nm s/rad"),
    ("_Nm_per_rad", "Nm/rad"),
    ("_V_s_per_rad", "V s/rad"),
    ("_V_per_rad", "V/rad"),
    ("_V_per_Nm", "V/Nm"),
    ("_rad_per_s", "rad/s"),
    ("_V_s_per_m", "V s/m"),
    ("_V_per_m", "V/m"),
    ("_m_per_s", "m/s"),
    ("_kg_m2", "kg m^2"),
    ("_kg_m", "kg m"),
    ("_rad", "rad"),
    ("_kg", "kg"),
    ("_Nm", "Nm"),
    ("_Hz", "Hz"),
    ("_V", "V"),
    ("_A", "A"),
    ("_N_s_per_m", "N s/m"),
    ("_N_per_m", "N/m"),
    ("_s", "s"),
    ("_N", "N"),
    ("_m", "m"),
];

/// A name without its unit, and the unit; "" where it has none.
pub fn split_unit(name: &str) -> (&str, &'static str) {
    let with = |(suffix, unit): &(&str, &'static str)| Some((name.strip_suffix(suffix)?, *unit));
    UNITS.iter().find_map(with).unwrap_or((name, ""))
}

/// A value with its unit; small volts, seconds, radians and metres in thousandths.
pub fn quantity(value: f64, unit: &str) -> String {
    let scaled = number(scale(value, unit) * value);
    match unit {
        "" => scaled,
        unit if scale(value, unit) > 1.0 => format!("{scaled} m{unit}"),
        unit => format!("{scaled} {unit}"),
    }
}

/// By what a value is multiplied before it is said: 1000 where that is in thousandths, else 1.
pub fn scale(value: f64, unit: &str) -> f64 {
    const SMALL: f64 = 0.1;
    let in_thousandths = matches!(unit, "V" | "s" | "rad" | "m") && value.abs() < SMALL;
    if in_thousandths && value != 0.0 { 1e3 } else { 1.0 }
}

/// Volts, always of two or three digits.
pub fn volts(value_v: f64) -> String {
    quantity(value_v, "V")
}

/// Three significant digits without needless zeros.
pub fn number(value: f64) -> String {
    const DIGITS: i32 = 3;
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { format!("{value}") };
    }
    let magnitude = value.abs().log10().floor() as i32;
    if magnitude < -4 {
        return format!("{value:.1e}");
    }
    let decimals = DIGITS - 1 - magnitude;
    let scale = 10f64.powi(decimals);
    let rounded = (value * scale).round() / scale;
    let text = format!("{rounded:.*}", decimals.max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [(0.1101, "0.11"), (1234.5, "1230"), (8.0, "8"), (-0.00123, "-0.00123")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
        assert_eq!(volts(0.0042), "4.2 mV");
        assert_eq!(quantity(0.3, "kg"), "0.3 kg");
        assert_eq!(split_unit("coefficient_V_per_Nm"), ("coefficient", "V/Nm"));
    }
}
