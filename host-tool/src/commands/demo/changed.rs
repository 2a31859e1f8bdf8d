//! The second half of the demonstration: the robot changes, and the diagnosis finds how.

use firmware::Mode;

use super::super::{diagnose, simulate};
use super::{Arguments, print_table};
use crate::failure::Failure;
use crate::output_files::write_text;
use crate::say;
use diagnosis::sentence;
use files::EffectTable;
use report::diagnosis_page::figure;
use report::tracking_page::Diagnosed;
use rig::Rig;

/// What the robot does that the identified model does not know.
const HIDDEN: [&str; 2] = [
    "asymmetric_friction:1:relative_asymmetry=0.3",
    "cogging:3:amplitude_V=0.15,harmonic=8,phase_rad=0.9",
];

/// Directory of the diagnosis.
const DIAGNOSIS: &str = "diagnosis";

impl Arguments {
    /// Records a robot with hidden effects, diagnoses its logs against the model of the rig,
    /// and drives it with that model and with the amended one.
    pub(super) fn diagnosed(&self, rig: &Rig) -> Result<Diagnosed, Failure> {
        say!("\n4. The robot changes, unknown to its model. Its logs are diagnosed.");
        simulate::run(&self.gap())?;
        let diagnosis = diagnose::diagnose(&self.diagnosis())?;
        say!("Hidden were {}", HIDDEN.join(" and "));
        write_text(&figure(&diagnosis), &self.out.join("diagnosis.svg"))?;
        say!("\n5. The amended model goes into the firmware, which plays the motion again.");
        let amended = self.out.join(DIAGNOSIS).join(diagnose::MODEL);
        let mut knowing = simulate::Arguments::new(&amended, "task", &self.out);
        knowing.compensate = true;
        let hidden = hidden()?;
        let before = self.drive(rig, Mode::PdModel, "model as it was", &hidden)?;
        let after = self.drive(&knowing.rig()?, Mode::PdModel, "amended model", &hidden)?;
        print_table(&before, &after);
        let report = format!("{DIAGNOSIS}/{}", diagnose::PAGE);
        let sentence = format!("Hidden: {}. Found: {}", HIDDEN.join(" and "), sentence(&diagnosis));
        Ok(Diagnosed { sentence, report, before, after })
    }

    fn gap(&self) -> simulate::Arguments {
        simulate::Arguments {
            qemu: Some(self.firmware.clone()),
            effect: HIDDEN.map(String::from).to_vec(),
            ..simulate::Arguments::new(
                &self.out.join("true-robot.toml"),
                "gap",
                &self.out.join("gap"),
            )
        }
    }

    fn diagnosis(&self) -> diagnose::Arguments {
        diagnose::Arguments {
            dataset: self.out.join("gap"),
            model: self.out.join("model.toml"),
            out: self.out.join(DIAGNOSIS),
            criteria: None,
            model_doubt: None,
        }
    }
}

fn hidden() -> Result<Vec<EffectTable>, Failure> {
    let tables = HIDDEN.iter().map(|text| rig::effects::table_from_text(text));
    let tables: Result<Vec<_>, _> = tables.collect();
    tables.map_err(|error| Failure::new(error.to_string(), ""))
}
