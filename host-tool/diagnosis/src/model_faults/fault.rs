//! What may be wrong with a model's description of its robot.

use crate::logs::derived::Derived;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::EffectInstance;
use model::mechanism::Rrr;
use rig::effects::Definition;
use rig::plant::Body;

/// A fault of the model as given, or of what the data set says of its columns.
#[derive(Clone, Debug, PartialEq)]
pub enum ModelFault {
    /// Counts and commands of a joint (0 to 2) have the other sign.
    Direction(usize),
    /// Commands alone of a joint have the other sign.
    CommandSign(usize),
    /// The columns of two joints are exchanged.
    Exchanged(usize, usize),
    /// Zero of each joint lies elsewhere by so much [rad].
    Home(Vec<f64>),
    /// d2, a2, d3, a3 are longer by so much [m].
    Lengths([f64; LENGTHS]),
    /// Commands act later on all joints by so much, as a bus makes them [s].
    Late([f64; 1]),
}

/// Lengths that matter to the dynamics.
pub const LENGTHS: usize = 4;
const LENGTH_NAMES: [&str; LENGTHS] = ["d2_m", "a2_m", "d3_m", "a3_m"];

impl ModelFault {
    /// All faults without a size that a rig may have.
    pub fn without_size(subject: &Subject) -> Vec<Self> {
        let joints = &subject.joints;
        let mut all: Vec<Self> = joints.iter().copied().map(Self::Direction).collect();
        all.extend(joints.iter().copied().map(Self::CommandSign));
        for (place, &first) in joints.iter().enumerate() {
            all.extend(joints[place + 1..].iter().map(|&second| Self::Exchanged(first, second)));
        }
        all
    }

    /// Those whose size is to be found, with none yet.
    pub fn with_size(subject: &Subject) -> Vec<Self> {
        let home = Self::Home(vec![0.0; subject.plant.joints()]);
        match (subject.one_joint, subject.plant.body.as_rrr()) {
            (true, _) => vec![home],
            (false, Some(_)) => vec![home, Self::Lengths([0.0; LENGTHS]), Self::Late([0.0])],
            (false, None) => vec![home, Self::Late([0.0])],
        }
    }

    /// Its size; empty where it has none.
    pub fn size(&self) -> &[f64] {
        match self {
            Self::Home(size) => size,
            Self::Lengths(size) => size,
            Self::Late(size) => size,
            _ => &[],
        }
    }

    /// Effects that say the same, where the catalogue has them: on an arm of any kind another home
    /// position is one.
    pub fn as_effects(&self, subject: &Subject) -> Vec<EffectInstance> {
        let Self::Home(size) = self else { return Vec::new() };
        let of_name = |effect: &&'static Definition| effect.name == "encoder_offset";
        let definition = subject.catalogue.iter().find(of_name);
        let of_joint = |joint: usize| {
            let (joint, values) = (joint as u8 + 1, vec![size[joint]]);
            definition.map(|definition| EffectInstance { definition, joint, values })
        };
        said_joints(size, subject).filter_map(of_joint).collect()
    }

    /// The same with another size.
    pub fn sized(&self, to: &[f64]) -> Self {
        let mut sized = self.clone();
        let size: &mut [f64] = match &mut sized {
            Self::Home(size) => size,
            Self::Lengths(size) => size,
            Self::Late(size) => size,
            _ => &mut [],
        };
        size.copy_from_slice(to);
        sized
    }

    /// Sizes at whole sample periods about this one, where those are likely: a bus takes whole
    /// cycles, and a part of one also smooths the commands.
    pub fn whole_periods(&self, period_s: f64) -> Vec<Vec<f64>> {
        let Self::Late([late_s]) = self else { return Vec::new() };
        let below = (late_s / period_s).floor();
        vec![vec![below * period_s], vec![(below + 1.0) * period_s]]
    }

    /// Puts right what a subject says of its robot.
    pub fn corrected(&self, subject: &Subject) -> Subject {
        let mut corrected = subject.clone();
        if let Self::Lengths(more) = self {
            let given_m = lengths_m(subject);
            if let Body::Rrr(Rrr { geometry, .. }) = &mut corrected.plant.body {
                [geometry.d2_m, geometry.a2_m, geometry.d3_m, geometry.a3_m] =
                    std::array::from_fn(|k| given_m[k] + more[k]);
            }
        }
        corrected
    }

    /// Puts right what a stretch says of motion and commands.
    pub fn correct(&self, stretch: &mut Stretch) {
        let motion = &mut stretch.motion;
        match self {
            &Self::Direction(joint) => {
                motion.all_mut().for_each(|signal| negate(&mut signal[joint]));
                negate(&mut stretch.command_v[joint]);
            }
            &Self::CommandSign(joint) => negate(&mut stretch.command_v[joint]),
            &Self::Exchanged(a, b) => {
                motion.all_mut().for_each(|signal| signal.swap(a, b));
                stretch.command_v.swap(a, b);
                stretch.settled.swap(a, b);
                stretch.known_part.swap(a, b);
                stretch.at_rest_rad.swap(a, b);
            }
            Self::Home(size) => {
                for (joint, more) in size.iter().enumerate() {
                    motion.q_rad[joint].iter_mut().for_each(|q| *q += more);
                    motion.raw_rad[joint].iter_mut().for_each(|q| *q += more);
                }
            }
            Self::Late([late_s]) => stretch.act_later(*late_s),
            Self::Lengths(_) => {}
        }
        stretch.derived = Derived::default();
        if !stretch.postures.is_empty() {
            stretch.postures = stretch.motion.postures();
        }
    }

    /// What is wrong, for a person who can put it right.
    pub fn words(&self, subject: &Subject) -> String {
        let number = |joint: usize| subject.outer_joint(joint as u8 + 1);
        match self {
            Self::Direction(joint) => format!(
                "joint {} counts and is driven the other way round than in the model; turn both \
                 signs",
                number(*joint)
            ),
            Self::CommandSign(joint) => format!(
                "the command of joint {} has the other sign than in the model; turn it",
                number(*joint)
            ),
            Self::Exchanged(a, b) => {
                format!("joints {} and {} are exchanged in the logs", number(*a), number(*b))
            }
            Self::Home(size) => home_words(size, subject),
            Self::Lengths(size) => length_words(size, subject),
            Self::Late([late_s]) => format!(
                "commands act {:.2} ms later on all joints than the logs say; shorten the way to \
                 the drives, or log what reaches them",
                1e3 * late_s
            ),
        }
    }
}

/// The model's lengths, in the order of a fault's [m].
pub fn lengths_m(subject: &Subject) -> [f64; LENGTHS] {
    let Some(Rrr { geometry, .. }) = subject.plant.body.as_rrr() else { return [0.0; LENGTHS] };
    [geometry.d2_m, geometry.a2_m, geometry.d3_m, geometry.a3_m]
}

fn negate(signal: &mut [f64]) {
    signal.iter_mut().for_each(|value| *value = -*value);
}

/// Joints (from 0) whose zeros lie elsewhere by a good part of the largest.
fn said_joints(size: &[f64], subject: &Subject) -> impl Iterator<Item = usize> {
    let largest = size.iter().fold(0.0, |largest, q: &f64| f64::max(largest, q.abs()));
    let is_said = move |joint: &usize| size[*joint].abs() > SAID_PART * largest;
    subject.joints.iter().copied().filter(is_said)
}

fn home_words(size: &[f64], subject: &Subject) -> String {
    let words = |joint: usize| {
        let number = subject.outer_joint(joint as u8 + 1);
        match subject.units[joint].slides {
            true => format!("joint {number} by {:.4} m", -size[joint]),
            false => format!("joint {number} by {:.1} degrees", -size[joint].to_degrees()),
        }
    };
    let said: Vec<String> = said_joints(size, subject).map(words).collect();
    format!("the home position is not the model's: {}; home the arm anew", said.join(", "))
}

/// Lengths that are off by a good part of what the worst is.
fn length_words(size: &[f64; LENGTHS], subject: &Subject) -> String {
    let given_m = lengths_m(subject);
    let part = |k: usize| size[k] / given_m[k];
    let largest = (0..LENGTHS).fold(0.0, |largest, k| f64::max(largest, part(k).abs()));
    let is_said = |k: &usize| part(*k).abs() > SAID_PART * largest;
    let words = |k: usize| {
        format!("{} = {:.3} rather than {:.3}", LENGTH_NAMES[k], given_m[k] + size[k], given_m[k])
    };
    let said: Vec<String> = (0..LENGTHS).filter(is_said).map(words).collect();
    format!("the lengths are not the robot's: {}; measure them", said.join(", "))
}

/// What is smaller than this part of the largest is not said.
const SAID_PART: f64 = 0.2;
