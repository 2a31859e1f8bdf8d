//! Data sets that can be recorded by name.

use super::Rig;
use super::plan::{
    Plan, constant_velocity, driven_noise, excitation, friction_excitation, presliding_noise, slow,
    task,
};
use files::Role;

/// What `rrr simulate --dataset` records.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// The name on the command line.
    pub name: &'static str,
    /// What it is for.
    pub purpose: &'static str,
    plans: fn(&Rig, u32) -> Vec<Plan>,
}

impl Recipe {
    /// All recipes.
    pub const ALL: [Self; 5] = [
        Self {
            name: "campaign",
            purpose: "all experiments that `rrr identify` needs, about 8 minutes",
            plans: campaign,
        },
        Self { name: "gap", purpose: "the logs that `rrr diagnose` works on, 72 s", plans: gap },
        Self {
            name: "task",
            purpose: "the validation motion (20)-(21), 20 s",
            plans: |_, _| vec![task(20.0)],
        },
        Self {
            name: "excitation",
            purpose: "one Fourier series, 30 s",
            plans: |_, _| vec![excitation(1, 30.0)],
        },
        Self { name: "friction", purpose: "the experiments on single joints", plans: friction },
    ];

    /// The recipe of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|recipe| recipe.name == name)
    }

    /// Its experiments on a rig, with noises from a seed.
    pub fn plans(&self, rig: &Rig, seed: u32) -> Vec<Plan> {
        (self.plans)(rig, seed)
    }
}

fn friction(rig: &Rig, seed: u32) -> Vec<Plan> {
    let mut plans: Vec<Plan> = (1..=3).map(constant_velocity).collect();
    plans.push(friction_excitation(rig));
    plans.extend((1..=3).map(|joint| presliding_noise(rig, joint, 3 * seed + u32::from(joint))));
    plans
}

fn campaign(rig: &Rig, seed: u32) -> Vec<Plan> {
    let mut plans = friction(rig, seed);
    plans.push(excitation(1, 30.0));
    plans.push(task(10.0));
    plans.push(excitation(2, 10.0).with_role(Role::Holdout));
    plans
}

fn gap(_: &Rig, seed: u32) -> Vec<Plan> {
    vec![
        excitation(1, 20.0),
        slow(20.0),
        driven_noise(12.0, seed),
        task(10.0),
        excitation(2, 10.0).with_role(Role::Holdout),
    ]
}
