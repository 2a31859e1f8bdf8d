//! Models, data sets and excitations.

use files::{ArmFile, Dataset, ExcitationFile, RobotFile};
use rig::compensation::Compensations;
use rig::effects::Catalogue;
use rig::{Rig, plan};

/// Reads the bytes as each; a model goes on to the parameter block.
pub fn run(bytes: &[u8]) {
    let _ = Dataset::parse(".", bytes.to_vec());
    if let Ok(file) = ExcitationFile::parse("excitation.toml", bytes.to_vec()) {
        let _ = file.motion();
    }
    if let Ok(arm) = ArmFile::parse("model.toml", bytes.to_vec()) {
        let _ = (arm.chain(), arm.chain_of_what_is_known(), arm.remarks());
    }
    let Ok(file) = RobotFile::parse("model.toml", bytes.to_vec()) else { return };
    let _ = (file.robot(), file.pendulum());
    let compensations = Compensations::of(&file.effects, &Catalogue::standard());
    if let (Ok(rig), Ok((compensations, _))) = (Rig::of_file(&file), compensations) {
        let _ = plan::task(1.0).block(&rig.with_compensations(compensations)).check();
    }
}
