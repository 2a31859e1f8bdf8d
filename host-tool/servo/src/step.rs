//! One step of a servo joint: the implicit midpoint rule with friction as a set-valued law.
//!
//! The mean velocity w over the step solves 2 I (w - v) / h = torque(q + h w / 2, w) - f sign(w), in
//! which drive, gravity and viscous friction are linear in w: one soft threshold. The rule is of
//! second order while the joint slides and sticks exactly.

use crate::joint::ServoJoint;

/// What moves with the joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Position [rad; m].
    pub q: f64,
    /// Velocity [rad/s; m/s].
    pub v: f64,
    /// Voltage behind the lag [V].
    pub u: f64,
}

/// What the rigid body asks of the joint: inertia * qdd + torque + slope (q - q now).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// The links' inertia about the joint [kg m^2; kg].
    pub inertia: f64,
    /// Gravity, Coriolis and what the other joints' accelerations ask [Nm; N].
    pub torque: f64,
    /// Gravity's slope over the joint's own position [Nm/rad].
    pub slope: f64,
}

/// The drive's voltage over a step as a0 - a1 w.
#[derive(Clone, Copy)]
struct Line(f64, f64);

impl ServoJoint {
    /// The state `h` seconds on, `t_s` seconds into the log.
    #[inline]
    pub fn step(&self, state: &State, goal: f64, load: &Load, h: f64, t_s: f64) -> State {
        let inertia = self.rotor + load.inertia;
        let k_t = self.torque_constant;
        let goal = goal.clamp(self.goal_range[0], self.goal_range[1]);
        let drive = self.drive(state, goal, h);
        let other = self.other_volts(state.q) * k_t - load.torque;
        let mass = 2.0 * inertia / h;
        let stiff = 0.5 * h * (load.slope + k_t * self.spring);
        let solve = |line: Line| {
            let push = mass * state.v + k_t * line.0 + other;
            let (level, viscous) = self.friction(state, load, push, t_s);
            let level = k_t * level;
            if push.abs() <= level {
                return 0.0;
            }
            (push - level.copysign(push)) / (mass + k_t * (line.1 + viscous) + stiff)
        };
        let (mut w, mut line) = (solve(drive), drive);
        if let Some(held) = self.beyond_the_line(state, goal, w, h) {
            line = held;
            w = solve(held);
        }
        let next = 2.0 * w - state.v;
        // A joint that friction stops within the step stays.
        let v = if w == 0.0 || next * w < 0.0 { 0.0 } else { next };
        State { q: state.q + h * w, v, u: line.0 - line.1 * w }
    }

    /// The voltage where neither limit nor dead zone is reached, behind the lag.
    #[inline]
    fn drive(&self, state: &State, goal: f64, h: f64) -> Line {
        let line = Line(self.stiffness * (goal - state.q), 0.5 * h * self.stiffness + self.damping);
        self.lagged(line, state, h)
    }

    #[inline]
    fn lagged(&self, line: Line, state: &State, h: f64) -> Line {
        if self.lag_s == 0.0 {
            return line;
        }
        let new = 1.0 - (-h / self.lag_s).exp();
        Line(new * line.0 + (1.0 - new) * state.u, new * line.1)
    }

    /// The voltage where the drive, at the mean velocity found, is at its limit or in its dead zone.
    #[inline]
    fn beyond_the_line(&self, state: &State, goal: f64, w: f64, h: f64) -> Option<Line> {
        let u = self.stiffness * (goal - state.q - 0.5 * h * w) - self.damping * w;
        let zone = self.dead_zone;
        if u.abs() >= self.limit + zone {
            return Some(self.lagged(Line(self.limit.copysign(u), 0.0), state, h));
        }
        if zone == 0.0 {
            return None;
        }
        if u.abs() <= zone {
            return Some(self.lagged(Line(0.0, 0.0), state, h));
        }
        let slope = 0.5 * h * self.stiffness + self.damping;
        let start = self.stiffness * (goal - state.q) - zone.copysign(u);
        Some(self.lagged(Line(start, slope), state, h))
    }

    /// Voltages that are neither the drive's nor friction's.
    #[inline]
    fn other_volts(&self, q: f64) -> f64 {
        let mut volts = self.offset - self.spring * (q - self.spring_rest);
        let [amplitude, order, phase] = self.cogging;
        if amplitude != 0.0 {
            volts += amplitude * (order * q + phase).sin();
        }
        volts
    }

    /// Level of dry friction [V] and viscous coefficient [V s/rad] against a push.
    #[inline]
    fn friction(&self, state: &State, load: &Load, push: f64, t_s: f64) -> (f64, f64) {
        let sign = 1.0_f64.copysign(push);
        let side = 1.0 + sign * self.asymmetry;
        let mut level = self.coulomb * side;
        let mut viscous = self.viscous * side * (1.0 + sign * self.viscous_asymmetry);
        if self.stribeck != 0.0 {
            let part = state.v / self.stribeck_velocity;
            level += self.stribeck * (-part * part).exp();
        }
        if self.motor_load_friction != 0.0 {
            level += self.motor_load_friction * (self.torque_constant * state.u).abs();
        }
        if self.joint_load_friction != 0.0 {
            level += self.joint_load_friction * load.torque.abs();
        }
        if self.drag != 0.0 {
            viscous = (viscous + self.drag * state.v.abs()).max(0.0);
        }
        if self.drift != 0.0 {
            let warm = 1.0 + self.drift * (1.0 - (-t_s / self.drift_time_s).exp());
            (level, viscous) = (level * warm, viscous * warm);
        }
        (level.max(0.0), viscous)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint() -> ServoJoint {
        ServoJoint {
            torque_constant: 0.5,
            stiffness: 29.0,
            rotor: 0.028,
            coulomb: 0.1,
            viscous: 1.2,
            ..ServoJoint::ideal()
        }
    }

    fn after(joint: &ServoJoint, h: f64, seconds: f64) -> State {
        let mut state = State::default();
        let load = Load { inertia: 0.01, torque: 0.3, slope: 0.0 };
        for k in 0..(seconds / h).round() as usize {
            state = joint.step(&state, 0.5, &load, h, k as f64 * h);
        }
        state
    }

    #[test]
    fn steps_of_five_milliseconds_are_as_good_as_short_ones() {
        for seconds in [0.1, 0.2, 0.4] {
            let (long, short) = (after(&joint(), 5e-3, seconds), after(&joint(), 5e-5, seconds));
            assert!((long.q - short.q).abs() < 1.5e-3, "{seconds}: {} {}", long.q, short.q);
        }
    }

    #[test]
    fn it_sticks_within_its_friction_and_at_its_limit() {
        let rest = after(&joint(), 5e-3, 5.0);
        assert_eq!(rest.v, 0.0);
        // 0.3 Nm are 0.6 V; friction holds 0.1 V of it either way.
        assert!((29.0 * (0.5 - rest.q) - 0.6).abs() <= 0.1 + 1e-9);
        let weak = ServoJoint { limit: 0.4, ..joint() };
        assert!(after(&weak, 5e-3, 1.0).q < 0.0, "a drive that is too weak gives way");
    }
}
