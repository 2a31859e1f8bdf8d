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

/// How much of the way to a voltage that lasts a step the torque behind a first-order lag goes: at its end, and on
/// average over it.
#[derive(Clone, Copy)]
struct Lag {
    end: f64,
    mean: f64,
}

impl Lag {
    #[inline]
    fn over(lag_s: f64, h: f64) -> Self {
        if lag_s == 0.0 {
            return Self { end: 1.0, mean: 1.0 };
        }
        let end = -(-h / lag_s).exp_m1();
        Self { end, mean: 1.0 - end * lag_s / h }
    }

    #[inline]
    fn mean(self, line: Line, before: f64) -> Line {
        Line(before + self.mean * (line.0 - before), self.mean * line.1)
    }

    #[inline]
    fn end(self, volts: f64, before: f64) -> f64 {
        before + self.end * (volts - before)
    }
}

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
        let lag = Lag::over(self.lag_s, h);
        let solve = |line: Line| {
            let line = lag.mean(line, state.u);
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
        State { q: state.q + h * w, v, u: lag.end(line.0 - line.1 * w, state.u) }
    }

    /// The voltage where neither limit nor dead zone is reached.
    #[inline]
    fn drive(&self, state: &State, goal: f64, h: f64) -> Line {
        Line(self.stiffness * (goal - state.q), 0.5 * h * self.stiffness + self.damping)
    }

    /// The voltage where the drive, at the mean velocity found, is at its limit or in its dead zone.
    #[inline]
    fn beyond_the_line(&self, state: &State, goal: f64, w: f64, h: f64) -> Option<Line> {
        let u = self.stiffness * (goal - state.q - 0.5 * h * w) - self.damping * w;
        let zone = self.dead_zone;
        if u.abs() >= self.limit + zone {
            return Some(Line(self.limit.copysign(u), 0.0));
        }
        if zone == 0.0 {
            return None;
        }
        if u.abs() <= zone {
            return Some(Line(0.0, 0.0));
        }
        let slope = 0.5 * h * self.stiffness + self.damping;
        let start = self.stiffness * (goal - state.q) - zone.copysign(u);
        Some(Line(start, slope))
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
        if self.over_speed.top != 0.0 {
            level += self.over_speed.at(state.v.abs());
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
    fn a_lag_is_as_long_in_long_steps_as_in_short_ones() {
        let late = |lag_s: f64, h: f64| after(&ServoJoint { lag_s, ..joint() }, h, 0.1).q;
        for lag_s in [4e-3, 8e-3, 20e-3] {
            // What a tenth more of the lag does is more than the step errs by.
            let (long, short) = (late(lag_s, 5e-3), late(lag_s, 5e-5));
            let tenth = (late(1.1 * lag_s, 5e-5) - short).abs();
            let own = late(0.0, 5e-3) - late(0.0, 5e-5);
            assert!((long - short - own).abs() < tenth, "{lag_s}: {long} {short} {tenth}");
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
