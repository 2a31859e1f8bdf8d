//! What is fitted: fields of a joint, their ranges and what is thought of them before.

use crate::joint::ServoJoint;

/// A number of a [`ServoJoint`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // they are the joint's
pub enum Field {
    Rotor,
    Viscous,
    Coulomb,
    Stiffness,
    Gravity,
    ReadAfter,
    Limit,
    Stribeck,
    StribeckVelocity,
    MotorLoadFriction,
    JointLoadFriction,
    Asymmetry,
    ViscousAsymmetry,
    Drag,
    OverSpeed(u8),
    OverSpeedTop,
    Lag,
    DeadZone,
    Offset,
    CoggingSine,
    CoggingCosine,
    CoggingOrder,
    CoggingAmplitude,
    CoggingPhase,
    Delay,
    Spring,
    SpringRest,
    Drift,
    DriftTime,
    Gap,
    EncoderOffset,
    GoalLow,
    GoalHigh,
}

impl Field {
    /// Its value in a joint.
    pub fn of(self, servo: &ServoJoint) -> f64 {
        match self {
            Self::CoggingSine => servo.cogging[0] * servo.cogging[2].cos(),
            Self::CoggingCosine => servo.cogging[0] * servo.cogging[2].sin(),
            Self::Delay => -servo.read_after_s,
            field => *field.place(&mut servo.clone()),
        }
    }

    /// Puts a value into a joint.
    pub fn set(self, servo: &mut ServoJoint, value: f64) {
        let [amplitude, _, phase] = servo.cogging;
        let (sine, cosine) = (amplitude * phase.cos(), amplitude * phase.sin());
        let (sine, cosine) = match self {
            Self::CoggingSine => (value, cosine),
            Self::CoggingCosine => (sine, value),
            Self::Delay => return servo.read_after_s = -value,
            field => return *field.place(servo) = value,
        };
        servo.cogging[0] = sine.hypot(cosine);
        servo.cogging[2] = cosine.atan2(sine);
    }

    /// Whether two are the same number of a joint.
    pub fn overlaps(self, other: Self) -> bool {
        let timing = |field| matches!(field, Self::ReadAfter | Self::Delay);
        self == other || (timing(self) && timing(other))
    }

    fn place(self, servo: &mut ServoJoint) -> &mut f64 {
        match self {
            Self::Rotor => &mut servo.rotor,
            Self::Viscous => &mut servo.viscous,
            Self::Coulomb => &mut servo.coulomb,
            Self::Stiffness => &mut servo.stiffness,
            Self::Gravity => &mut servo.gravity,
            Self::ReadAfter | Self::Delay => &mut servo.read_after_s,
            Self::Limit => &mut servo.limit,
            Self::Stribeck => &mut servo.stribeck,
            Self::StribeckVelocity => &mut servo.stribeck_velocity,
            Self::MotorLoadFriction => &mut servo.motor_load_friction,
            Self::JointLoadFriction => &mut servo.joint_load_friction,
            Self::Asymmetry => &mut servo.asymmetry,
            Self::EncoderOffset => &mut servo.encoder_offset,
            Self::ViscousAsymmetry => &mut servo.viscous_asymmetry,
            Self::Drag => &mut servo.drag,
            Self::OverSpeed(knot) => &mut servo.over_speed.more[usize::from(knot)],
            Self::OverSpeedTop => &mut servo.over_speed.top,
            Self::Lag => &mut servo.lag_s,
            Self::DeadZone => &mut servo.dead_zone,
            Self::Offset => &mut servo.offset,
            Self::CoggingSine | Self::CoggingCosine => &mut servo.cogging[0],
            Self::CoggingAmplitude => &mut servo.cogging[0],
            Self::CoggingPhase => &mut servo.cogging[2],
            Self::CoggingOrder => &mut servo.cogging[1],
            Self::Spring => &mut servo.spring,
            Self::SpringRest => &mut servo.spring_rest,
            Self::Drift => &mut servo.drift,
            Self::DriftTime => &mut servo.drift_time_s,
            Self::Gap => &mut servo.gap,
            Self::GoalLow => &mut servo.goal_range[0],
            Self::GoalHigh => &mut servo.goal_range[1],
        }
    }
}

/// A field that is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unknown {
    /// Which.
    pub field: Field,
    /// Whether its logarithm is searched for.
    pub is_log: bool,
    /// Lowest value.
    pub low: f64,
    /// Highest value.
    pub high: f64,
    /// Value thought likely, and its standard deviation (of the logarithm where that is searched).
    pub prior: (f64, f64),
    /// Step of its slopes (of the logarithm where that is searched).
    pub step: f64,
}

impl Unknown {
    /// A positive field, searched for by its logarithm, likely where it is given.
    pub fn positive(field: Field, likely: f64, deviation: f64) -> Self {
        let (low, high) = (likely / 100.0, likely * 100.0);
        Self { field, is_log: true, low, high, prior: (likely, deviation), step: 0.02 }
    }

    /// A field between bounds; `step` is what makes a difference.
    pub fn between(field: Field, [low, high]: [f64; 2], prior: (f64, f64), step: f64) -> Self {
        Self { field, is_log: false, low, high, prior, step }
    }

    /// The coordinate of the search.
    pub fn coordinate(&self, servo: &ServoJoint) -> f64 {
        let value = self.field.of(servo).clamp(self.low, self.high);
        if self.is_log { value.ln() } else { value }
    }

    /// Whether it is at a bound and this change of its coordinate would push it beyond.
    pub fn leaves_range(&self, servo: &ServoJoint, change: f64) -> bool {
        let value = self.field.of(servo);
        // What was put there by its logarithm comes back rounded.
        let near = 1e-9 * (self.high - self.low).min(self.low.abs().max(1.0));
        (value <= self.low + near && change < 0.0) || (value >= self.high - near && change > 0.0)
    }

    /// The highest coordinate.
    pub fn top(&self) -> f64 {
        if self.is_log { self.high.ln() } else { self.high }
    }

    /// The joint with the field where the coordinate says.
    pub fn put(&self, servo: &mut ServoJoint, coordinate: f64) {
        let value = if self.is_log { coordinate.exp() } else { coordinate };
        self.field.set(servo, value.clamp(self.low, self.high));
    }

    /// How far a coordinate is from what was likely, in standard deviations.
    pub fn surprise(&self, coordinate: f64) -> f64 {
        let likely = if self.is_log { self.prior.0.ln() } else { self.prior.0 };
        (coordinate - likely) / self.prior.1
    }
}
