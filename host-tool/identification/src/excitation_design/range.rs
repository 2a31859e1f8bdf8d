//! The joints' ranges, in which the motion stays as the board sees it.

use firmware::reference::braking_distance_rad;

use super::series::State;

/// Share of the way to an end that a design may use: joints overshoot their references.
const SHARE: f64 = 0.98;

/// The range of each joint, and how fast it can be brought to rest at the ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// Lower and upper end [rad]; `None`: the joint may turn without end.
    pub limits_rad: [Option<[f64; 2]>; 3],
    /// What each joint can be decelerated with [rad/s^2].
    pub braking_rad_per_s2: [f64; 3],
}

impl Range {
    /// Whether any joint has one.
    pub fn is_there(&self) -> bool {
        self.limits_rad.iter().any(Option::is_some)
    }

    /// The first joint (1 to 3) that cannot begin there [rad].
    pub fn outside(&self, position_rad: &[f64; 3]) -> Option<u8> {
        let is_outside = |i: &usize| {
            let within = |[low, high]: [f64; 2]| low < position_rad[*i] && position_rad[*i] < high;
            !self.limits_rad[*i].is_none_or(within)
        };
        (0..3).find(is_outside).map(|i| i as u8 + 1)
    }

    /// How much of the usable way from the centre to its ends each joint needs at most, until it is
    /// at rest if it were braked; with the distance in which the board brakes it.
    pub fn share(&self, centre_rad: &[f64; 3], states: impl Iterator<Item = State>) -> [f64; 3] {
        states.fold([0.0; 3], |most, state| {
            [0, 1, 2].map(|i| most[i].max(self.share_of(i, centre_rad[i], &state)))
        })
    }

    fn share_of(&self, i: usize, centre_rad: f64, state: &State) -> f64 {
        let Some([lower_rad, upper_rad]) = self.limits_rad[i] else { return 0.0 };
        let velocity = state.qd_rad_per_s[i];
        let braking = self.braking_rad_per_s2[i] as f32;
        let distance_rad = f64::from(braking_distance_rad(velocity as f32, braking));
        let offset_rad = state.q_rad[i] - centre_rad;
        let ahead = offset_rad + distance_rad * if velocity > 0.0 { 1.0 } else { 0.0 };
        let behind = offset_rad - distance_rad * if velocity < 0.0 { 1.0 } else { 0.0 };
        let share = |reach: f64, way: f64| (reach / (SHARE * way)).max(0.0);
        share(ahead, upper_rad - centre_rad).max(share(-behind, centre_rad - lower_rad))
    }
}
