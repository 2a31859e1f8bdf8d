//! A hypothesis linearised, fitted, and judged against the noise.

mod bounded_step;
pub mod bristles;
pub mod command_instants;
pub mod command_left;
pub mod cross_validation;
pub mod doubt;
pub mod earlier;
pub mod excess;
pub mod fitted_model;
pub mod gauss_newton;
pub mod gears;
mod gram;
mod inertia;
pub mod joint_slopes;
mod kicks;
pub mod linearisation;
mod marginal_likelihood;
mod normal_equations;
pub mod pairs;
pub mod preparation;
mod refitted_change;
pub mod residual_stats;
pub mod row_changes;
pub mod slopes;
mod stretch_changes;
pub mod unknowns;
pub mod warmth;
