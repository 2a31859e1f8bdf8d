//! Without friction and drive, the energy stays.

mod common;

use common::rigid_robot::rigid_robot;
use model::reference_robot::reference_robot;
use model::vector::{Vector3, dot, multiply};
use model::{BaseParameters, Geometry, Posture};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;

const STEP_S: f64 = 1e-4;
const DURATION_S: f64 = 10.0;

struct Arm {
    base: BaseParameters<f64>,
    geometry: Geometry<f64>,
}

/// Angles and velocities.
type State = [Vector3<f64>; 2];

impl Arm {
    fn slope(&self, [q, qd]: &State) -> State {
        let posture = Posture::new(q[1], q[2]);
        [*qd, posture.forward_dynamics(&self.base, &self.geometry, qd, &[0.0; 3])]
    }

    fn energy_j(&self, [q, qd]: &State) -> f64 {
        let posture = Posture::new(q[1], q[2]);
        let momentum = multiply(&posture.mass_matrix(&self.base, &self.geometry), qd);
        0.5 * dot(&momentum, qd) + posture.potential_energy(&self.base, &self.geometry)
    }

    /// Largest potential energy above that of the arm's level position.
    fn largest_potential_j(&self) -> f64 {
        let p = &self.base;
        let moment = p.mx2r.hypot(p.my2r) + p.mx3r.hypot(p.my3r);
        self.geometry.gravity_m_s2 * moment
    }

    fn runge_kutta(&self, state: &State) -> State {
        let k1 = self.slope(state);
        let k2 = self.slope(&moved(state, &k1, 0.5 * STEP_S));
        let k3 = self.slope(&moved(state, &k2, 0.5 * STEP_S));
        let k4 = self.slope(&moved(state, &k3, STEP_S));
        let outer = moved(&moved(state, &k1, STEP_S / 6.0), &k4, STEP_S / 6.0);
        moved(&moved(&outer, &k2, STEP_S / 3.0), &k3, STEP_S / 3.0)
    }

    /// Largest change of energy in a free swing, relative to the energy scale: the kinetic
    /// energy at the start plus the largest potential energy.
    fn energy_drift(&self, start: State) -> f64 {
        let at_start = self.energy_j(&start);
        let scale = self.largest_potential_j() + self.energy_j(&start).abs();
        let mut state = start;
        let mut drift = 0.0_f64;
        for _ in 0..(DURATION_S / STEP_S) as usize {
            state = self.runge_kutta(&state);
            drift = drift.max((self.energy_j(&state) - at_start).abs());
        }
        assert!(state.iter().flatten().all(|x| x.is_finite()));
        drift / scale
    }
}

fn moved(state: &State, slope: &State, by_s: f64) -> State {
    [0, 1].map(|part| [0, 1, 2].map(|i| state[part][i] + by_s * slope[part][i]))
}

const START: State = [[0.0, 0.3, 0.7], [2.0, -1.0, 3.0]];

#[test]
fn reference_robot_keeps_its_energy() {
    let robot = reference_robot();
    let drift = Arm { base: robot.base, geometry: robot.geometry }.energy_drift(START);
    assert!(drift < 1e-6, "{drift:e}");
}

#[test]
fn random_robots_keep_their_energy() {
    let mut runner = TestRunner::new(common::cases(1));
    for _ in 0..10 {
        let robot = rigid_robot().new_tree(&mut runner).unwrap().current();
        let drift = Arm { base: robot.base(), geometry: robot.geometry }.energy_drift(START);
        assert!(drift < 1e-6, "{drift:e} for {robot:?}");
    }
}
