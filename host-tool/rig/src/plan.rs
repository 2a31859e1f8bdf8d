//! The experiments of the paper, as references and modes for the board.

use std::f32::consts::{FRAC_PI_2, PI};

use firmware::reference::{
    ConstantVelocity, FadeIn, FourierSeries, FrictionExcitation, Injection, Motion, Noise,
    Reference, Sine,
};
use firmware::{Mode, ParameterBlock};

use model::HANGING_RAD as HANGING;

use super::Rig;
use super::designed_excitation::DESIGNED_EXCITATION;
use files::{Entry, Experiment, Role};

/// [`model::HANGING_RAD`] in the precision of the board.
pub const HANGING_RAD: [f32; 3] = [HANGING[0] as f32, HANGING[1] as f32, HANGING[2] as f32];

/// An experiment before it is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// File name of its log, without extension.
    pub name: String,
    /// What it is called in a data set.
    pub experiment: Experiment,
    /// What its log is for.
    pub role: Role,
    /// The joint, 1 to 3, of an experiment on one joint.
    pub joint: Option<u8>,
    /// What each joint's command is made of.
    pub mode: [Mode; 3],
    /// What the board plays.
    pub reference: Reference,
}

impl Plan {
    /// How long it takes [ticks].
    pub fn ticks(&self, rig: &Rig) -> u32 {
        (f64::from(self.reference.duration_s) / rig.sample_period_s).round() as u32
    }

    /// The block that makes the board play it.
    pub fn block(&self, rig: &Rig) -> ParameterBlock {
        rig.block(self.mode, self.reference.clone())
    }

    /// The line of `dataset.toml` for its log.
    pub fn entry(&self, extension: &str) -> Entry {
        Entry {
            file: format!("{}.{extension}", self.name),
            experiment: self.experiment,
            role: self.role,
            joint: self.joint,
        }
    }

    /// The same with another mode on every joint.
    pub fn with_mode(self, mode: Mode) -> Self {
        Self { mode: [mode; 3], ..self }
    }

    /// The same for another role.
    pub fn with_role(self, role: Role) -> Self {
        Self { role, ..self }
    }

    /// The same with another motion.
    pub fn with_motion(mut self, motion: [Motion; 3]) -> Self {
        self.reference.motion = motion;
        self
    }

    fn closed_loop(
        name: &str,
        experiment: Experiment,
        motion: [Motion; 3],
        duration_s: f32,
    ) -> Self {
        Self {
            name: name.into(),
            experiment,
            role: Role::Train,
            joint: None,
            mode: [Mode::Pd; 3],
            reference: Reference { motion, injection: [Injection::None; 3], duration_s },
        }
    }

    /// An experiment on one joint while the others are held hanging down.
    fn on_one_joint(kind: &str, experiment: Experiment, joint: u8, duration_s: f32) -> Self {
        let motion = HANGING_RAD.map(|angle_rad| Motion::Hold { angle_rad });
        let name = format!("{kind}-{joint}");
        Self { joint: Some(joint), ..Self::closed_loop(&name, experiment, motion, duration_s) }
    }

    fn open_loop(mut self, injection: Injection) -> Self {
        for index in self.joint.map(usize::from).into_iter().map(|joint| joint - 1) {
            self.mode[index] = Mode::OpenLoop;
            self.reference.injection[index] = injection;
        }
        self
    }
}

/// The validation motion, eq. (20)-(21): a half turn to and fro in 5 s on every joint.
pub fn task(duration_s: f32) -> Plan {
    let motion = [FRAC_PI_2, -FRAC_PI_2, 0.0].map(|centre_rad| {
        Motion::Sine(Sine {
            centre_rad,
            amplitude_rad: FRAC_PI_2,
            period_s: 5.0,
            fade_in: FadeIn { duration_s: 1.0 },
        })
    });
    let plan = Plan::closed_loop("task", Experiment::Task, motion, duration_s);
    plan.with_role(Role::Holdout)
}

/// Hanging down, where gravity asks for nothing.
pub fn hold(duration_s: f32) -> Plan {
    let motion = HANGING_RAD.map(|angle_rad| Motion::Hold { angle_rad });
    Plan::closed_loop("hold", Experiment::Task, motion, duration_s).with_role(Role::Holdout)
}

/// A Fourier series on all joints: variant 1 is the designed one, others are different.
pub fn excitation(variant: u32, duration_s: f32) -> Plan {
    if variant == 1 {
        let motion = DESIGNED_EXCITATION.map(Motion::Fourier);
        return Plan::closed_loop("excitation", Experiment::Excitation, motion, duration_s);
    }
    let name = format!("excitation-{variant}");
    let motion = [0, 1, 2].map(|i| fourier(i, variant, 10.0, PEAK_VELOCITY_RAD_PER_S[i]));
    Plan::closed_loop(&name, Experiment::Excitation, motion, duration_s)
}

/// Velocity limits of section 4.2, with a margin.
const PEAK_VELOCITY_RAD_PER_S: [f32; 3] = [1.8 * PI, 2.6 * PI, 2.6 * PI];

/// Slow reversals: the same kind of series at a twentieth of the speed.
pub fn slow(duration_s: f32) -> Plan {
    let motion = [0, 1, 2].map(|i| fourier(i, 11, 20.0, [0.5, 0.6, 1.2][i]));
    Plan::closed_loop("slow", Experiment::Slow, motion, duration_s)
}

/// Moderate motion with noise up to 200 Hz added to every command.
pub fn driven_noise(duration_s: f32, seed: u32) -> Plan {
    let motion = [0, 1, 2].map(|i| fourier(i, 7, 10.0, [1.0, 1.4, 2.5][i]));
    let mut plan = Plan::closed_loop("driven-noise", Experiment::DrivenNoise, motion, duration_s);
    for (i, rms_v) in [0.6, 1.0, 0.6].into_iter().enumerate() {
        let noise = Noise { rms_v, bandwidth_hz: 200.0, seed: seed * 3 + i as u32 };
        plan.reference.injection[i] = Injection::Noise(noise);
    }
    plan
}

/// Constant velocities of one joint, slow ones first, section 3.1.
pub fn constant_velocity(joint: u8) -> Plan {
    const SPEEDS: [f32; 9] = [0.0025, 0.005, 0.01, 0.02, 0.05, 0.1, 0.3, 1.0, 2.0];
    const LEG_S: f32 = 3.0;
    let duration_s = 2.0 * LEG_S * SPEEDS.len() as f32;
    let mut plan =
        Plan::on_one_joint("constant-velocity", Experiment::ConstantVelocity, joint, duration_s);
    let index = usize::from(joint) - 1;
    plan.reference.motion[index] = Motion::ConstantVelocity(ConstantVelocity {
        start_rad: HANGING_RAD[index],
        speeds_rad_per_s: SPEEDS.into_iter().collect(),
        leg_s: LEG_S,
        ramp_s: 0.25,
    });
    plan
}

/// The open-loop sequence of Fig. 2 on joint 3, which swings as eq. (11) says.
pub fn friction_excitation(rig: &Rig) -> Plan {
    let model = &rig.model;
    let gravity_v = model.geometry.gravity_m_s2 * model.base.mx3r.hypot(model.base.my3r)
        / model.torque_constant_nm_per_v[2];
    let friction_v = model.friction[2].alpha0_v.max(model.friction[2].stribeck_level(0.0));
    let excitation = FrictionExcitation {
        first_amplitude_v: (0.3 * gravity_v + 1.2 * friction_v) as f32,
        last_amplitude_v: (1.8 * gravity_v + 2.0 * friction_v) as f32,
        growth_s: 40.0,
        slow_period_s: 8.0,
        fast_period_s: 1.7,
    };
    Plan::on_one_joint("friction-excitation", Experiment::FrictionExcitation, 3, 40.0)
        .open_loop(Injection::FrictionExcitation(excitation))
}

/// Open-loop noise below static friction on one joint, for the FRF (12): 50 half-
/// overlapping records of 4096 samples.
pub fn presliding_noise(rig: &Rig, joint: u8, seed: u32) -> Plan {
    const SAMPLES: f32 = 4096.0 * 25.5;
    let duration_s = SAMPLES * rig.sample_period_s as f32;
    let breakaway_v = rig.model.friction[usize::from(joint) - 1].stribeck_level(0.0);
    let noise = Noise { rms_v: (0.06 * breakaway_v) as f32, bandwidth_hz: 200.0, seed };
    Plan::on_one_joint("presliding-noise", Experiment::PreslidingNoise, joint, duration_s)
        .open_loop(Injection::Noise(noise))
}

/// A Fourier series of a joint whose velocity peaks at `peak_rad_per_s`.
///
/// Amplitudes follow from the golden ratio, so that joints and variants differ and
/// no two terms fall together; scaling to the peak does the rest.
fn fourier(index: usize, variant: u32, period_s: f32, peak_rad_per_s: f32) -> Motion {
    const GOLDEN: f32 = 0.618_034;
    let angle = |term: usize| {
        let number = (term + 5 * index) as f32 + 15.0 * variant as f32;
        2.0 * PI * (GOLDEN * number * number).fract()
    };
    let mut series = FourierSeries {
        centre_rad: HANGING_RAD[index],
        period_s,
        sine_rad: [0, 1, 2, 3, 4].map(|term| angle(term).cos() / (term + 1) as f32),
        cosine_rad: [0, 1, 2, 3, 4].map(|term| angle(term).sin() / (term + 1) as f32),
        fade_in: FadeIn { duration_s: 1.0 },
    };
    let scale = peak_rad_per_s / peak_velocity(&series);
    series.sine_rad = series.sine_rad.map(|a| a * scale);
    series.cosine_rad = series.cosine_rad.map(|b| b * scale);
    Motion::Fourier(series)
}

/// The largest velocity of a series over its period [rad/s].
pub fn peak_velocity(series: &FourierSeries) -> f32 {
    let frequency = 2.0 * PI / series.period_s;
    let velocity = |phase: f32| -> f32 {
        let terms = series.sine_rad.iter().zip(&series.cosine_rad).zip(1..);
        terms
            .map(|((a, b), k)| {
                let k = k as f32;
                k * frequency * (a * (k * phase).cos() - b * (k * phase).sin())
            })
            .sum()
    };
    (0..1000).map(|k| velocity(2.0 * PI * k as f32 / 1000.0).abs()).fold(0.0, f32::max)
}
