//! Which joints a rig has: the others get no voltage, and nobody looks at their encoders.

use firmware::reference::{Injection, Motion};
use firmware::{Mode, ParameterBlock};

use crate::plan::HANGING_RAD;

/// The joints, 1 to 3, that are there.
pub fn present(block: &ParameterBlock) -> Vec<u8> {
    (1..=3).filter(|joint| block.in_use[usize::from(*joint) - 1]).collect()
}

/// The block for a rig that has these joints alone: the others hang, without a voltage.
pub fn with_joints(mut block: ParameterBlock, joints: &[u8]) -> ParameterBlock {
    for (joint, index) in (1..).zip(0..3) {
        block.in_use[index] = joints.contains(&joint);
        if !block.in_use[index] {
            block.mode[index] = Mode::OpenLoop;
            block.reference.injection[index] = Injection::None;
            block.safety.position[index] = None;
            block.reference.motion[index] = Motion::Hold { angle_rad: HANGING_RAD[index] };
        }
    }
    block
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rig, plan};
    use model::reference_robot::reference_robot;

    #[test]
    fn joints_that_are_taken_away_are_not_there() {
        let rig = Rig::new(reference_robot());
        for plan in
            [plan::task(1.0), plan::driven_noise(1.0, 1), plan::presliding_noise(&rig, 3, 1)]
        {
            assert_eq!(present(&plan.block(&rig)), [1, 2, 3], "{}", plan.name);
            let alone = with_joints(plan.block(&rig), &[3]);
            assert_eq!((present(&alone), alone.check()), (vec![3], Ok(())), "{}", plan.name);
        }
        let none = plan::hold(1.0).with_mode(Mode::OpenLoop).block(&rig);
        assert_eq!(present(&none), [1, 2, 3]);
    }
}
