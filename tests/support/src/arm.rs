//! A small arm.

/// An arm of format 2 with one joint, which takes a torque.
pub const PIVOT: &str = r#"format = 2
[robot]
gravity_m_s2 = [0.0, 0.0, -9.81]
sample_period_s = 0.002
[[joint]]
name = "pivot"
kind = "revolute"
axis = [0, 1, 0]
mass_kg = 0.6
com_m = [0.2, 0, 0]
inertia_kg_m2 = [1e-3, 0, 0, 4e-3, 0, 4e-3]
armature_kg_m2 = 0.002
limits_rad = [-3, 3]
[joint.drive]
kind = "torque"
limit_Nm = 4
[joint.friction]
alpha0_V = 0.05
alpha2_V_s_per_rad = 0.02
"#;
