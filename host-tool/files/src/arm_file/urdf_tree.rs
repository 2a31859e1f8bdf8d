//! The tree of links and joints in a URDF.

use std::collections::HashMap;

use model::chain::{Body, Transform, rotation_of_rpy};
use urdf_rs::{Joint, JointType, Pose, Robot};

/// Which joint leads to a link, and which lead away from it.
pub(super) struct Tree<'a> {
    robot: &'a Robot,
    to: HashMap<&'a str, usize>,
    from: HashMap<&'a str, Vec<usize>>,
}

/// A frame in its parent.
fn place_of(pose: &Pose) -> Transform<f64> {
    Transform { rotation: rotation_of_rpy(pose.rpy.0), position: pose.xyz.0 }
}

fn moves(joint: &Joint) -> bool {
    joint.joint_type != JointType::Fixed && joint.mimic.is_none()
}

impl<'a> Tree<'a> {
    /// The tree of a robot.
    pub(super) fn of(robot: &'a Robot) -> Result<Self, String> {
        let mut tree = Self { robot, to: HashMap::new(), from: HashMap::new() };
        for (index, joint) in robot.joints.iter().enumerate() {
            let child = joint.child.link.as_str();
            if tree.to.insert(child, index).is_some() {
                return Err(format!("link \"{child}\" is the child of two joints"));
            }
            tree.from.entry(&joint.parent.link).or_default().push(index);
        }
        match (0..robot.joints.len()).find(|joint| tree.up(*joint).count() > robot.joints.len()) {
            Some(joint) => Err(format!("joint \"{}\" is in a circle", robot.joints[joint].name)),
            None => Ok(tree),
        }
    }

    pub(super) fn joints(&self) -> &'a [Joint] {
        &self.robot.joints
    }

    /// The joints before a joint, towards the base; without end where they are a circle, so cut off.
    fn up(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        let before = |joint: &usize| self.to.get(self.joints()[*joint].parent.link.as_str());
        let all = std::iter::successors(Some(joint), move |joint| before(joint).copied());
        all.skip(1).take(self.joints().len() + 1)
    }

    /// All joints that move, base to tip.
    pub(super) fn moving(&self) -> Result<Vec<usize>, String> {
        let mut moving: Vec<usize> =
            (0..self.joints().len()).filter(|joint| moves(&self.joints()[*joint])).collect();
        moving.sort_by_key(|joint| self.up(*joint).count());
        for pair in moving.windows(2) {
            if !self.up(pair[1]).any(|before| before == pair[0]) {
                let names = [0, 1].map(|index| &self.joints()[pair[index]].name);
                return Err(format!(
                    "joints \"{}\" and \"{}\" are on two branches: name the joints of one \
                     with [[joint]] tables",
                    names[0], names[1]
                ));
            }
        }
        self.checked(moving)
    }

    /// The joints of these names.
    pub(super) fn named(&self, names: &[Option<String>]) -> Result<Vec<usize>, String> {
        let find = |name: &Option<String>| {
            let Some(name) = name else {
                return Err("a [[joint]] beside `urdf` has no name".to_owned());
            };
            let found = self.joints().iter().position(|joint| joint.name == *name);
            found.ok_or_else(|| {
                let all: Vec<&str> =
                    self.joints().iter().map(|joint| joint.name.as_str()).collect();
                format!("there is no joint \"{name}\"; there are {}", all.join(", "))
            })
        };
        self.checked(names.iter().map(find).collect::<Result<_, _>>()?)
    }

    fn checked(&self, chain: Vec<usize>) -> Result<Vec<usize>, String> {
        const KINDS: [JointType; 3] =
            [JointType::Revolute, JointType::Continuous, JointType::Prismatic];
        match chain.iter().map(|joint| &self.joints()[*joint]).find(|joint| {
            !KINDS.contains(&joint.joint_type) || joint.axis.xyz.0.iter().all(|x| *x == 0.0)
        }) {
            Some(joint) => Err(format!(
                "joint \"{}\" must be revolute, continuous or prismatic, with an axis",
                joint.name
            )),
            None => Ok(chain),
        }
    }

    /// A joint's frame in that of the joint before in the chain, and whether they follow each other
    /// with nothing fixed between.
    pub(super) fn origin(
        &self,
        joint: usize,
        before: Option<usize>,
    ) -> Result<(Transform<f64>, bool), String> {
        let mut origin = place_of(&self.joints()[joint].origin);
        let mut is_direct = true;
        for between in self.up(joint) {
            if Some(between) == before {
                return Ok((origin, is_direct));
            }
            let fixed = &self.joints()[between];
            if moves(fixed) {
                return Err(format!(
                    "joint \"{}\" moves before \"{}\", but is not that before it in the file",
                    fixed.name,
                    self.joints()[joint].name
                ));
            }
            (origin, is_direct) = (place_of(&fixed.origin).then(&origin), false);
        }
        match before {
            None => Ok((origin, is_direct)),
            Some(before) => Err(format!(
                "joint \"{}\" does not come before \"{}\"",
                self.joints()[before].name,
                self.joints()[joint].name
            )),
        }
    }

    /// All that a joint moves up to the next joints of the chain, in its frame.
    pub(super) fn body(&self, joint: usize, chain: &[usize]) -> Result<Body<f64>, String> {
        let mut sum = Body::zero();
        let mut rest = vec![(joint, Transform::identity())];
        while let Some((joint, frame)) = rest.pop() {
            let name = self.joints()[joint].child.link.as_str();
            let link = self.robot.links.iter().find(|link| link.name == name);
            let link = link.ok_or_else(|| format!("there is no link \"{name}\""))?;
            sum = sum.plus(&own_body(&link.inertial).out_of(&frame));
            let next = self.from.get(name).into_iter().flatten();
            let next = next.filter(|joint| !chain.contains(joint));
            rest.extend(next.map(|j| (*j, frame.then(&place_of(&self.joints()[*j].origin)))));
        }
        Ok(sum)
    }
}

/// A link's own body in its frame.
fn own_body(inertial: &urdf_rs::Inertial) -> Body<f64> {
    let i = &inertial.inertia;
    let inertia = [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz];
    let body = Body::about_centre(inertial.mass.value, [0.0; 3], inertia);
    body.out_of(&place_of(&inertial.origin))
}
