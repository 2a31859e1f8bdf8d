//! One tick of a joint: motion and bristles from command and parameters, with slopes.

use model::{Friction, FrictionState};

use super::grey_box::{FRICTION, from_logarithms};

/// Most parameters that a joint may have: friction, inertia, gravity and neighbours.
pub const MOST: usize = 12;
/// Parameter index of the inertia, in volts per acceleration [V s^2/rad].
pub const INERTIA: usize = FRICTION;

/// What a linear term of the command multiplies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Regressor {
    /// Cosine of the joint's angle plus an angle that carries it.
    Cosine,
    /// Sine of that angle.
    Sine,
    /// A signal from outside, by its number.
    Signal(usize),
    /// One: a constant torque.
    One,
}

/// What acts on the joint during a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<'a> {
    /// Command [V].
    pub command_v: f64,
    /// Length of the tick [s].
    pub step_s: f64,
    /// Angle of what carries the joint [rad].
    pub carried_rad: f64,
    /// Signals from outside.
    pub signals: &'a [f64],
}

/// Angle, velocity and bristle deflection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Angle [rad].
    pub q_rad: f64,
    /// Velocity [rad/s].
    pub qd_rad_per_s: f64,
    /// Deflection z of eq. (9) [rad].
    pub deflection_rad: f64,
}

/// A joint with its parameters: friction's logarithms, inertia, factors of the linear terms.
#[derive(Clone, Debug)]
pub struct Joint<'a> {
    friction: Friction<f64>,
    /// (1 + nudge) in alpha_0, and in sigma_0, for slopes.
    nudged_alpha0: Friction<f64>,
    nudged_sigma0: Friction<f64>,
    inertia: f64,
    factors: &'a [f64],
    regressors: &'a [Regressor],
}

/// Where a tick leads, and how that moves with state and parameters.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// State at the tick's end.
    pub state: State,
    /// Slopes of the state by (q, qd, z).
    pub by_state: [[f64; 3]; 3],
    /// Slopes of the state by the parameters.
    pub by_parameter: [[f64; MOST]; 3],
    /// Slopes of the state by the command.
    pub by_command: [f64; 3],
}

const NUDGE: f64 = 1e-5;

impl<'a> Joint<'a> {
    /// A joint of parameters: friction's logarithms, inertia, factors of `regressors`.
    pub fn new(parameters: &'a [f64], regressors: &'a [Regressor]) -> Self {
        let friction = from_logarithms(parameters);
        let scale = 1.0 + NUDGE;
        Self {
            friction,
            nudged_alpha0: Friction { alpha0_v: friction.alpha0_v * scale, ..friction },
            nudged_sigma0: Friction {
                sigma0_v_per_rad: friction.sigma0_v_per_rad * scale,
                ..friction
            },
            inertia: parameters[INERTIA],
            factors: &parameters[INERTIA + 1..],
            regressors,
        }
    }

    /// The friction that the parameters mean.
    pub fn friction(&self) -> &Friction<f64> {
        &self.friction
    }

    fn regressor(&self, which: Regressor, (sine, cosine): (f64, f64), signals: &[f64]) -> f64 {
        match which {
            Regressor::Cosine => cosine,
            Regressor::Sine => sine,
            Regressor::Signal(number) => signals[number],
            Regressor::One => 1.0,
        }
    }

    /// Linear terms of the command besides inertia [V], and their slope by q [V/rad].
    fn linear_v(&self, sines: (f64, f64), signals: &[f64]) -> (f64, f64) {
        let (mut sum, mut slope) = (0.0, 0.0);
        for (&which, factor) in self.regressors.iter().zip(self.factors) {
            sum += factor * self.regressor(which, sines, signals);
            slope += match which {
                Regressor::Cosine => -factor * sines.0,
                Regressor::Sine => factor * sines.1,
                _ => 0.0,
            };
        }
        (sum, slope)
    }

    /// Friction over a step from a deflection: mean voltage and deflection at its end.
    fn friction_over(
        friction: &Friction<f64>,
        deflection_rad: f64,
        velocity: f64,
        step_s: f64,
    ) -> (f64, f64) {
        let mut state = FrictionState { deflection_rad };
        let voltage = state.step(friction, velocity, step_s);
        (voltage, state.deflection_rad)
    }

    /// The state a tick later: friction takes its exact step at the velocity of the
    /// tick's middle, which makes the whole of second order.
    pub fn advance(&self, state: &State, inputs: &Inputs) -> State {
        let (middle, _, sines) = self.middle(state, inputs);
        let (friction_v, deflection_rad) =
            Self::friction_over(&self.friction, state.deflection_rad, middle, inputs.step_s);
        let (linear_v, _) = self.linear_v(sines, inputs.signals);
        let acceleration = (inputs.command_v - friction_v - linear_v) / self.inertia;
        self.moved(state, inputs.step_s, acceleration, deflection_rad)
    }

    fn moved(&self, state: &State, step_s: f64, acceleration: f64, deflection_rad: f64) -> State {
        let qd_rad_per_s = state.qd_rad_per_s + step_s * acceleration;
        let q_rad = state.q_rad + 0.5 * step_s * (state.qd_rad_per_s + qd_rad_per_s);
        State { q_rad, qd_rad_per_s, deflection_rad }
    }

    /// Velocity in the tick's middle, slope of friction by the velocity, sines there.
    fn middle(&self, state: &State, inputs: &Inputs) -> (f64, f64, (f64, f64)) {
        let half_s = 0.5 * inputs.step_s;
        let angle = state.q_rad + inputs.carried_rad + half_s * state.qd_rad_per_s;
        let sines = angle.sin_cos();
        let (friction_v, _) = Self::friction_over(
            &self.friction,
            state.deflection_rad,
            state.qd_rad_per_s,
            inputs.step_s,
        );
        let (linear_v, _) = self.linear_v(sines, inputs.signals);
        let acceleration = (inputs.command_v - friction_v - linear_v) / self.inertia;
        (state.qd_rad_per_s + half_s * acceleration, acceleration, sines)
    }

    /// [`Self::advance`] with slopes.
    pub fn step(&self, state: &State, inputs: &Inputs) -> Step {
        let (h, j) = (inputs.step_s, self.inertia);
        let (velocity, _, sines) = self.middle(state, inputs);
        let z = state.deflection_rad;
        let over =
            |friction: &Friction<f64>, z: f64, v: f64| Self::friction_over(friction, z, v, h);
        let (friction_v, z_end) = over(&self.friction, z, velocity);
        let (linear_v, gravity_slope) = self.linear_v(sines, inputs.signals);
        let acceleration = (inputs.command_v - friction_v - linear_v) / j;

        // Slopes of friction and of the end deflection by z, v and the parameters.
        let slope =
            |(f, d): (f64, f64), nudge: f64| ((f - friction_v) / nudge, (d - z_end) / nudge);
        let z_nudge = 1e-3 * self.friction.alpha0_v / self.friction.sigma0_v_per_rad;
        let by_z = slope(over(&self.friction, z + z_nudge, velocity), z_nudge);
        let v_nudge = 1e-4 * self.friction.stribeck_velocity_rad_per_s;
        let by_v = slope(over(&self.friction, z, velocity + v_nudge), v_nudge);
        let by_level =
            slope(over(&self.nudged_alpha0, z, velocity), NUDGE * self.friction.alpha0_v);
        let by_sigma0 = slope(over(&self.nudged_sigma0, z, velocity), NUDGE);

        let mut friction_by = [(0.0, 0.0); MOST];
        let scaled = |(f, d): (f64, f64), factor: f64| (f * factor, d * factor);
        let ratio = velocity / self.friction.stribeck_velocity_rad_per_s;
        let bell = (-ratio * ratio).exp();
        let breakaway_v = self.friction.alpha0_v + self.friction.alpha1_v;
        friction_by[0] = scaled(by_level, self.friction.alpha0_v * (1.0 - bell));
        friction_by[1] = scaled(by_level, breakaway_v * bell);
        friction_by[2] = scaled(by_level, self.friction.alpha1_v * bell * 2.0 * ratio * ratio);
        friction_by[3] = (self.friction.alpha2_v_s_per_rad * velocity, 0.0);
        friction_by[4] = by_sigma0;
        friction_by[5] = (self.friction.sigma1_v_s_per_rad * (z_end - z) / h, 0.0);

        // The middle velocity's own slopes, by (q, qd, z), the parameters and the command.
        let half = 0.5 * h / j;
        let middle_by_state = [-half * gravity_slope, 1.0 - half * by_v.0, -half * by_z.0];
        let force_by = |k: usize| match k {
            _ if k < FRICTION => friction_by[k].0,
            INERTIA => acceleration,
            _ => self.regressor(self.regressors[k - INERTIA - 1], sines, inputs.signals),
        };
        let mut by_state = [[0.0; 3]; 3];
        for (i, &middle) in middle_by_state.iter().enumerate() {
            let own_v = if i == 2 { by_z.0 } else { 0.0 };
            let gravity = [gravity_slope, 0.5 * h * gravity_slope, 0.0][i];
            let a = -(by_v.0 * middle + own_v + gravity) / j;
            let qd = if i == 1 { 1.0 } else { 0.0 } + h * a;
            by_state[1][i] = qd;
            by_state[0][i] =
                if i == 0 { 1.0 } else { 0.0 } + 0.5 * h * (qd + if i == 1 { 1.0 } else { 0.0 });
            by_state[2][i] = by_v.1 * middle + if i == 2 { by_z.1 } else { 0.0 };
        }
        let mut by_parameter = [[0.0; MOST]; 3];
        for k in 0..INERTIA + 1 + self.regressors.len() {
            let force = force_by(k);
            let middle = -half * force;
            let own_z = if k < FRICTION { friction_by[k].1 } else { 0.0 };
            let a = -(force + by_v.0 * middle) / j;
            by_parameter[1][k] = h * a;
            by_parameter[0][k] = 0.5 * h * h * a;
            by_parameter[2][k] = own_z + by_v.1 * middle;
        }
        let a = (1.0 - by_v.0 * half) / j;
        Step {
            state: self.moved(state, h, acceleration, z_end),
            by_state,
            by_parameter,
            by_command: [0.5 * h * h * a, h * a, by_v.1 * half],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMETERS: [f64; 9] = [-1.03, -1.7, -5.8, -2.08, 5.4, 0.39, 0.0238, 0.65, -0.02];
    const REGRESSORS: [Regressor; 2] = [Regressor::Cosine, Regressor::Sine];

    fn inputs() -> Inputs<'static> {
        Inputs { command_v: 0.3, step_s: 1e-3, carried_rad: -1.57, signals: &[] }
    }

    fn values(state: &State) -> [f64; 3] {
        [state.q_rad, state.qd_rad_per_s, state.deflection_rad]
    }

    #[test]
    fn slopes_agree_with_differences() {
        for velocity in [0.0005, -0.004, 0.3] {
            let state = State { q_rad: 0.4, qd_rad_per_s: velocity, deflection_rad: 3e-4 };
            let step = Joint::new(&PARAMETERS, &REGRESSORS).step(&state, &inputs());
            for i in 0..3 {
                let nudge = [1e-5, 1e-6, 1e-8][i];
                let mut moved = values(&state);
                moved[i] += nudge;
                let moved =
                    State { q_rad: moved[0], qd_rad_per_s: moved[1], deflection_rad: moved[2] };
                let end = Joint::new(&PARAMETERS, &REGRESSORS).advance(&moved, &inputs());
                agree(&end, &step, nudge, |row| step.by_state[row][i]);
            }
            for k in 0..PARAMETERS.len() {
                let mut nudged = PARAMETERS;
                nudged[k] += 1e-6;
                let end = Joint::new(&nudged, &REGRESSORS).advance(&state, &inputs());
                agree(&end, &step, 1e-6, |row| step.by_parameter[row][k]);
            }
            let more = Inputs { command_v: 0.3 + 1e-5, ..inputs() };
            let end = Joint::new(&PARAMETERS, &REGRESSORS).advance(&state, &more);
            agree(&end, &step, 1e-5, |row| step.by_command[row]);
        }
    }

    /// A slope within 5 %, or within a share of what matters: the middle velocity's
    /// slopes are taken at the middle, not at the beginning.
    fn agree(end: &State, step: &Step, nudge: f64, slope: impl Fn(usize) -> f64) {
        let (end, begin) = (values(end), values(&step.state));
        for row in 0..3 {
            let difference = (end[row] - begin[row]) / nudge;
            let floor = [1e-6, 1e-4, 1e-6][row];
            let error = (difference - slope(row)).abs();
            assert!(error < 0.05 * difference.abs() + floor, "{row}: {difference} {}", slope(row));
        }
    }
}
