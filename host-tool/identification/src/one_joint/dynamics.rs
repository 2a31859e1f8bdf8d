//! Motion and friction of one joint over a step of time, with its Jacobians.
//!
//! The pendulum with friction, eq. (11) of the paper, in volts: inertia times qdd is the
//! command less LuGre friction, eq. (9), less the linear terms (gravity, the neighbours'
//! reaction). The midpoint rule evaluates both at the middle of the step, where friction
//! takes its exact step at that velocity; the whole is of second order.

use model::Friction;

use super::friction_step::{FrictionJacobian, FrictionStep, NUDGE};
use super::parameters::{FRICTION, from_logarithms};

/// Most parameters that a joint may have: friction, inertia, gravity and neighbours.
pub const MAX_PARAMETERS: usize = 12;
/// Parameter index of the inertia, in volts per acceleration [V s^2/rad].
pub const INERTIA: usize = FRICTION;

/// What a linear term of the command multiplies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Regressor {
    /// Cosine of the joint's angle plus its parent's.
    Cosine,
    /// Sine of that angle.
    Sine,
    /// An external signal, by its index.
    Signal(usize),
}

/// What acts on the joint during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<'a> {
    /// Command [V].
    pub command_v: f64,
    /// Length of the step [s].
    pub step_s: f64,
    /// Angle of the parent joint [rad].
    pub parent_rad: f64,
    /// External signals.
    pub signals: &'a [f64],
}

/// Angle, velocity and bristle deflection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Angle [rad].
    pub q_rad: f64,
    /// Velocity [rad/s].
    pub qd_rad_per_s: f64,
    /// Deflection z of eq. (9), LuGre friction [rad].
    pub deflection_rad: f64,
}

impl State {
    /// Adds gain times innovation to (q, qd, z).
    pub fn correct(&mut self, gain: [f64; 3], innovation: f64) {
        self.q_rad += gain[0] * innovation;
        self.qd_rad_per_s += gain[1] * innovation;
        self.deflection_rad += gain[2] * innovation;
    }
}

/// A joint with its parameters: friction's logarithms, inertia, factors of the linear terms.
#[derive(Clone, Debug)]
pub struct Joint<'a> {
    friction: Friction<f64>,
    /// The friction with alpha_0, and with sigma_0, times (1 + [`NUDGE`]).
    nudged_alpha0: Friction<f64>,
    nudged_sigma0: Friction<f64>,
    inertia: f64,
    factors: &'a [f64],
    regressors: &'a [Regressor],
}

/// The state at the end of a step and its Jacobians.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// State at the end.
    pub state: State,
    /// Derivatives of (q, qd, z) at the end by (q, qd, z) at the beginning.
    pub by_state: [[f64; 3]; 3],
    /// Derivatives of (q, qd, z) at the end by the parameters.
    pub by_parameter: [[f64; MAX_PARAMETERS]; 3],
    /// Derivatives of (q, qd, z) at the end by the command.
    pub by_command: [f64; 3],
}

/// The forces at the middle of a step.
struct Midpoint {
    step_s: f64,
    velocity_rad_per_s: f64,
    sin_cos: (f64, f64),
    /// Derivative of the linear terms by q [V/rad].
    gravity_v_per_rad: f64,
    friction: FrictionJacobian,
    acceleration_rad_per_s2: f64,
}

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

    /// The state a step later, with its Jacobians.
    pub fn step(&self, state: &State, inputs: &Inputs) -> Step {
        let middle = self.midpoint(state, inputs);
        Step {
            state: middle.end(state),
            by_state: self.by_state(&middle),
            by_parameter: self.by_parameter(&middle, inputs.signals),
            by_command: self.by_command(&middle),
        }
    }

    fn midpoint(&self, state: &State, inputs: &Inputs) -> Midpoint {
        let (step_s, z) = (inputs.step_s, state.deflection_rad);
        let half_s = 0.5 * step_s;
        let angle = state.q_rad + inputs.parent_rad + half_s * state.qd_rad_per_s;
        let sin_cos = angle.sin_cos();
        let (linear_v, gravity_v_per_rad) = self.linear_v(sin_cos, inputs.signals);
        let acceleration =
            |friction_v: f64| (inputs.command_v - friction_v - linear_v) / self.inertia;
        let first = FrictionStep::over(&self.friction, z, state.qd_rad_per_s, step_s);
        let velocity = state.qd_rad_per_s + half_s * acceleration(first.voltage_v);
        let nudged = [&self.nudged_alpha0, &self.nudged_sigma0];
        let friction = FrictionJacobian::at(&self.friction, nudged, z, velocity, step_s);
        Midpoint {
            step_s,
            velocity_rad_per_s: velocity,
            sin_cos,
            gravity_v_per_rad,
            acceleration_rad_per_s2: acceleration(friction.nominal.voltage_v),
            friction,
        }
    }

    /// Linear terms of the command besides inertia [V], and their derivative by q [V/rad].
    fn linear_v(&self, sin_cos: (f64, f64), signals: &[f64]) -> (f64, f64) {
        let (mut sum, mut slope) = (0.0, 0.0);
        for (&regressor, factor) in self.regressors.iter().zip(self.factors) {
            sum += factor * regressor.value(sin_cos, signals);
            slope += match regressor {
                Regressor::Cosine => -factor * sin_cos.0,
                Regressor::Sine => factor * sin_cos.1,
                Regressor::Signal(_) => 0.0,
            };
        }
        (sum, slope)
    }

    fn by_state(&self, middle: &Midpoint) -> [[f64; 3]; 3] {
        let (h, gravity) = (middle.step_s, middle.gravity_v_per_rad);
        let (by_v, by_z) = (middle.friction.by_velocity, middle.friction.by_deflection);
        let half = 0.5 * h / self.inertia;
        // By (q, qd, z): the velocity at the middle, and forces and deflection besides.
        let velocity_by = [-half * gravity, 1.0 - half * by_v.voltage_v, -half * by_z.voltage_v];
        let force_by = [gravity, 0.5 * h * gravity, by_z.voltage_v];
        let deflection_by = [0.0, 0.0, by_z.deflection_rad];
        let mut jacobian = [[0.0; 3]; 3];
        for i in 0..3 {
            let identity = |row: usize| if row == i { 1.0 } else { 0.0 };
            let acceleration = -(by_v.voltage_v * velocity_by[i] + force_by[i]) / self.inertia;
            let velocity = identity(1) + h * acceleration;
            jacobian[0][i] = identity(0) + 0.5 * h * (velocity + identity(1));
            jacobian[1][i] = velocity;
            jacobian[2][i] = by_v.deflection_rad * velocity_by[i] + deflection_by[i];
        }
        jacobian
    }

    fn by_parameter(&self, middle: &Midpoint, signals: &[f64]) -> [[f64; MAX_PARAMETERS]; 3] {
        let (h, by_v) = (middle.step_s, middle.friction.by_velocity);
        let half = 0.5 * h / self.inertia;
        let friction_by = middle.friction.by_parameter(middle.velocity_rad_per_s, h);
        let mut jacobian = [[0.0; MAX_PARAMETERS]; 3];
        for k in 0..INERTIA + 1 + self.regressors.len() {
            let (force, deflection) = match k {
                _ if k < FRICTION => (friction_by[k].voltage_v, friction_by[k].deflection_rad),
                INERTIA => (middle.acceleration_rad_per_s2, 0.0),
                _ => (self.regressors[k - INERTIA - 1].value(middle.sin_cos, signals), 0.0),
            };
            let velocity = -half * force;
            let acceleration = -(force + by_v.voltage_v * velocity) / self.inertia;
            jacobian[0][k] = 0.5 * h * h * acceleration;
            jacobian[1][k] = h * acceleration;
            jacobian[2][k] = deflection + by_v.deflection_rad * velocity;
        }
        jacobian
    }

    fn by_command(&self, middle: &Midpoint) -> [f64; 3] {
        let (h, by_v) = (middle.step_s, middle.friction.by_velocity);
        let half = 0.5 * h / self.inertia;
        let acceleration = (1.0 - by_v.voltage_v * half) / self.inertia;
        [0.5 * h * h * acceleration, h * acceleration, by_v.deflection_rad * half]
    }
}

impl Regressor {
    fn value(self, (sine, cosine): (f64, f64), signals: &[f64]) -> f64 {
        match self {
            Self::Cosine => cosine,
            Self::Sine => sine,
            Self::Signal(index) => signals[index],
        }
    }
}

impl Midpoint {
    /// The state at the end of the step.
    fn end(&self, begin: &State) -> State {
        let qd_rad_per_s = begin.qd_rad_per_s + self.step_s * self.acceleration_rad_per_s2;
        let q_rad = begin.q_rad + 0.5 * self.step_s * (begin.qd_rad_per_s + qd_rad_per_s);
        State { q_rad, qd_rad_per_s, deflection_rad: self.friction.nominal.deflection_rad }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMETERS: [f64; 9] = [-1.03, -1.7, -5.8, -2.08, 5.4, 0.39, 0.0238, 0.65, -0.02];
    const REGRESSORS: [Regressor; 2] = [Regressor::Cosine, Regressor::Sine];

    fn inputs() -> Inputs<'static> {
        Inputs { command_v: 0.3, step_s: 1e-3, parent_rad: -1.57, signals: &[] }
    }

    fn values(state: &State) -> [f64; 3] {
        [state.q_rad, state.qd_rad_per_s, state.deflection_rad]
    }

    #[test]
    fn jacobians_agree_with_differences() {
        let joint = Joint::new(&PARAMETERS, &REGRESSORS);
        for velocity in [0.0005, -0.004, 0.3] {
            let state = State { q_rad: 0.4, qd_rad_per_s: velocity, deflection_rad: 3e-4 };
            let step = joint.step(&state, &inputs());
            for i in 0..3 {
                let nudge = [1e-5, 1e-6, 1e-8][i];
                let mut moved = state;
                moved.correct([0, 1, 2].map(|k| if k == i { nudge } else { 0.0 }), 1.0);
                let end = joint.step(&moved, &inputs()).state;
                agree(&end, &step, nudge, |row| step.by_state[row][i]);
            }
            for k in 0..PARAMETERS.len() {
                let mut nudged = PARAMETERS;
                nudged[k] += 1e-6;
                let end = Joint::new(&nudged, &REGRESSORS).step(&state, &inputs()).state;
                agree(&end, &step, 1e-6, |row| step.by_parameter[row][k]);
            }
            let more = Inputs { command_v: 0.3 + 1e-5, ..inputs() };
            let end = joint.step(&state, &more).state;
            agree(&end, &step, 1e-5, |row| step.by_command[row]);
        }
    }

    /// A derivative within 5 %, or within a small absolute error: those by the velocity at
    /// the middle are taken at the middle, not at the beginning.
    fn agree(end: &State, step: &Step, nudge: f64, derivative: impl Fn(usize) -> f64) {
        let (end, begin) = (values(end), values(&step.state));
        for row in 0..3 {
            let difference = (end[row] - begin[row]) / nudge;
            let floor = [1e-6, 1e-4, 1e-6][row];
            let error = (difference - derivative(row)).abs();
            let found = derivative(row);
            assert!(error < 0.05 * difference.abs() + floor, "{row}: {difference} {found}");
        }
    }
}
