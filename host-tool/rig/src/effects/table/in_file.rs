//! A table as an `[[effect]]` of a model file.

use files::EffectTable;
use toml::Value;

use super::axis::TableAxis;
use super::curve::Table;
use super::names::{AXIS, KNOTS, NAME, VALUES_V};
use crate::effects::error::EffectError;

impl Table {
    /// Whether an `[[effect]]` is a table.
    pub fn is_in(table: &EffectTable) -> bool {
        table.effect == NAME
    }

    /// The table that an `[[effect]]` of a model file describes.
    ///
    /// # Errors
    /// Another effect, parameters that are not `axis`, `knots` and `values_V`, or a curve that is
    /// none: see [`Table::checked`].
    pub fn of(table: &EffectTable) -> Result<Self, EffectError> {
        Self::read(table)?.checked()
    }

    /// The same on an arm of so many joints.
    ///
    /// # Errors
    /// Those of [`Self::of`].
    pub fn on_one_of(joints: u8, table: &EffectTable) -> Result<Self, EffectError> {
        Self::read(table)?.checked_on_one_of(joints)
    }

    fn read(table: &EffectTable) -> Result<Self, EffectError> {
        if !Self::is_in(table) {
            let (name, known) = (table.effect.clone(), NAME.to_owned());
            return Err(EffectError::Unknown { name, known });
        }
        let given = &table.parameters;
        let parameters = || -> Option<(&str, Vec<f64>, Vec<f64>)> {
            let known = given.len() == 3;
            let axis = given.get(AXIS)?.as_str()?;
            known.then_some((axis, numbers(given.get(KNOTS)?)?, numbers(given.get(VALUES_V)?)?))
        };
        let (axis, knots, values_v) = parameters().ok_or_else(|| wrong_parameters(given))?;
        Ok(Self { joint: table.joint, axis: axis_named(axis)?, knots, values_v })
    }

    /// The same as an `[[effect]]` of a model file.
    pub fn to_effect_table(&self) -> EffectTable {
        let array = |values: &[f64]| {
            Value::Array(values.iter().map(|value| Value::Float(*value)).collect())
        };
        let parameters = [
            (AXIS.to_owned(), Value::String(self.axis.name().to_owned())),
            (KNOTS.to_owned(), array(&self.knots)),
            (VALUES_V.to_owned(), array(&self.values_v)),
        ];
        EffectTable {
            effect: NAME.to_owned(),
            joint: self.joint,
            parameters: parameters.into_iter().collect(),
            ..EffectTable::default()
        }
    }
}

fn axis_named(name: &str) -> Result<TableAxis, EffectError> {
    TableAxis::by_name(name).ok_or_else(|| EffectError::TableAxis {
        found: name.to_owned(),
        known: TableAxis::ALL.map(TableAxis::name).join(", "),
    })
}

/// An array of numbers.
fn numbers(value: &Value) -> Option<Vec<f64>> {
    let number =
        |value: &Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    value.as_array()?.iter().map(number).collect()
}

fn wrong_parameters(given: &toml::Table) -> EffectError {
    let kind = |value: &Value| match value {
        Value::Array(entries) if numbers(value).is_some() => format!("{} numbers", entries.len()),
        other => format!("a value of type {}", other.type_str()),
    };
    let found: Vec<String> =
        given.iter().map(|(name, value)| format!("{name} = {}", kind(value))).collect();
    EffectError::Parameters {
        effect: NAME,
        expected: format!("{AXIS} (a name), {KNOTS} and {VALUES_V} (arrays of numbers)"),
        found: if found.is_empty() { "nothing".into() } else { found.join(", ") },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Catalogue, table_from_text};

    const TEXT: &str = "table:2:axis=velocity,knots=-1 0 1,values_V=-0.1 0 0.1";

    fn refusal(text: &str) -> String {
        let table = table_from_text(text).unwrap();
        Catalogue::standard().effect_of(&table).unwrap_err().to_string()
    }

    #[test]
    fn a_table_survives_file_and_command_line() {
        let table = Table::of(&table_from_text(TEXT).unwrap()).unwrap();
        let expected = Table {
            joint: 2,
            axis: TableAxis::Velocity,
            knots: vec![-1.0, 0.0, 1.0],
            values_v: vec![-0.1, 0.0, 0.1],
        };
        assert_eq!(table, expected);
        assert_eq!(Table::of(&table.to_effect_table()).unwrap(), table);
        let text = toml::to_string(&table.to_effect_table()).unwrap();
        assert_eq!(toml::from_str::<EffectTable>(&text).unwrap(), table.to_effect_table());
        Catalogue::standard().effect_of(&table.to_effect_table()).unwrap();
    }

    #[test]
    fn whole_numbers_of_a_file_are_numbers() {
        let text = "effect = \"table\"\njoint = 1\n[parameters]\naxis = \"time\"\n\
                    knots = [0, 10]\nvalues_V = [0, 0.5]\n";
        let table = Table::of(&toml::from_str(text).unwrap()).unwrap();
        assert_eq!((table.axis, table.value_v(5.0)), (TableAxis::Time, 0.25));
    }

    #[test]
    fn what_is_wrong_with_a_table_is_named() {
        let curve = |axis, knots, values| {
            refusal(&format!("table:1:axis={axis},knots={knots},values_V={values}"))
        };
        assert!(curve("speed", "0 1", "0 1").contains("`speed`, but must be one of position"));
        assert!(curve("load", "0 1 2", "0 1").contains("3 knots and 2 values_V; give as many"));
        assert!(curve("load", "0 0", "0 1").contains("must increase, but 0 comes after 0; sort"));
        assert!(curve("load", "0 nan", "0 1").contains("knots of table is NaN"));
        assert!(curve("load", "0 1", "0 inf").contains("values_V of table is inf"));
        assert!(curve("load", "0 1", "0 6").contains("6, but must be from -5 to 5"));
        assert!(curve("load", "0", "1").contains("knots = a value of type float"));
        let many = (0..65).map(|k| k.to_string()).collect::<Vec<_>>().join(" ");
        assert!(curve("load", &many, &many).contains("2 to 64"));
        assert!(refusal(&TEXT.replace(":2:", ":0:")).contains("joint 1, 2 or 3"));
        assert!(refusal(&TEXT.replace("knots", "nots")).contains("takes axis (a name), knots"));
        assert!(refusal(&format!("{TEXT},extra=1")).contains("extra"));
        assert!(refusal("table:1").contains("nothing is given"));
        assert!(refusal("tabel:1").contains("quadratic_drag, table"));
    }

    #[test]
    fn values_go_to_the_joint_at_its_place_on_the_axis() {
        use crate::effects::{Effect, JointState};
        let state = JointState {
            time_s: 0.1,
            q_rad: &[0.0, 0.2, 0.0],
            qd_rad_per_s: &[0.0, 0.3, 0.0],
            load_nm: &[0.0, 0.4, 0.0],
            motor_nm: &[0.0; 3],
        };
        let found = TableAxis::ALL.map(|axis| {
            let (knots, values_v) = (vec![-1.0, 1.0], vec![-1.0, 1.0]);
            let mut table = Table { joint: 2, axis, knots, values_v };
            let mut voltage_v = [0.0, 0.5, 0.0];
            table.change_command(&state, &mut voltage_v);
            table.add_voltage(&state, &mut voltage_v);
            assert_eq!(table.feels_load(), axis == TableAxis::Load);
            (voltage_v[1] * 10.0).round() / 10.0
        });
        assert_eq!(found, [0.7, 0.8, 0.9, 1.0, 0.6]);
    }
}
