//! Inertia of a rigid body (RBDA 2.13): ten numbers, in which its forces are linear.

use super::spatial::{Force, Motion, Transform};
use crate::Real;
use crate::vector::{
    Matrix3, Vector3, add, add_scaled, cross, dot, multiply, product, scale, subtract, transposed,
};

/// How many numbers make a rigid body.
pub const BODY_PARAMETERS: usize = 10;

/// A rigid body in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body<T> {
    /// Mass m [kg].
    pub mass_kg: T,
    /// First moment m c [kg m].
    pub moment_kg_m: Vector3<T>,
    /// Inertia about the frame's origin, xx xy xz yy yz zz [kg m^2].
    pub inertia_kg_m2: [T; 6],
}

impl<T: Real> Body<T> {
    /// Nothing.
    #[inline]
    pub fn zero() -> Self {
        let zero = T::zero();
        Self { mass_kg: zero, moment_kg_m: [zero; 3], inertia_kg_m2: [zero; 6] }
    }

    /// From mass [kg], centre of mass [m] and inertia about it, xx xy xz yy yz zz [kg m^2],
    /// by the parallel axis theorem, eq. (2.63).
    #[inline]
    pub fn about_centre(mass_kg: T, centre_m: Vector3<T>, inertia_kg_m2: [T; 6]) -> Self {
        let [x, y, z] = centre_m;
        let steiner = [y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y];
        Self {
            mass_kg,
            moment_kg_m: scale(&centre_m, mass_kg),
            inertia_kg_m2: core::array::from_fn(|k| inertia_kg_m2[k] + mass_kg * steiner[k]),
        }
    }

    /// A point mass [kg] at a point [m].
    #[inline]
    pub fn point(mass_kg: T, at_m: Vector3<T>) -> Self {
        Self::about_centre(mass_kg, at_m, [T::zero(); 6])
    }

    /// The ten numbers: m, m c (3), inertia about the origin (xx xy xz yy yz zz).
    #[inline]
    pub fn to_array(&self) -> [T; BODY_PARAMETERS] {
        let ([x, y, z], [xx, xy, xz, yy, yz, zz]) = (self.moment_kg_m, self.inertia_kg_m2);
        [self.mass_kg, x, y, z, xx, xy, xz, yy, yz, zz]
    }

    /// The body of ten numbers in the order of [`Body::to_array`].
    #[inline]
    pub fn from_array([mass_kg, x, y, z, inertia @ ..]: [T; BODY_PARAMETERS]) -> Self {
        Self { mass_kg, moment_kg_m: [x, y, z], inertia_kg_m2: inertia }
    }

    /// Two bodies as one.
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        let [mine, others] = [self.to_array(), other.to_array()];
        Self::from_array(core::array::from_fn(|k| mine[k] + others[k]))
    }

    /// The inertia about the origin as a matrix [kg m^2].
    #[inline]
    pub fn inertia_matrix(&self) -> Matrix3<T> {
        let [xx, xy, xz, yy, yz, zz] = self.inertia_kg_m2;
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    /// I v, eq. (2.63): momentum at a velocity, or the force of an acceleration from rest.
    #[inline]
    pub fn times(&self, motion: &Motion<T>) -> Force<T> {
        let h = &self.moment_kg_m;
        let turning = multiply(&self.inertia_matrix(), &motion.angular);
        Force {
            moment: add(&turning, &cross(h, &motion.linear)),
            force: subtract(&scale(&motion.linear, self.mass_kg), &cross(h, &motion.angular)),
        }
    }

    /// The force of an acceleration at a velocity, I a + v x* I v, eq. (5.9).
    #[inline]
    pub fn force(&self, velocity: &Motion<T>, acceleration: &Motion<T>) -> Force<T> {
        self.times(acceleration).plus(&velocity.cross_force(&self.times(velocity)))
    }

    /// The body from a frame's coordinates into its parent's: X^T I X, eq. (2.66).
    #[inline]
    pub fn out_of(&self, frame: &Transform<T>) -> Self {
        let (turn, r) = (&frame.rotation, &frame.position);
        let near = multiply(turn, &self.moment_kg_m);
        let far = add(&near, &scale(r, self.mass_kg));
        let turned = product(&product(turn, &self.inertia_matrix()), &transposed(turn));
        let both = dot(r, &near) + dot(r, &far);
        let shift = |i: usize, k: usize| {
            let diagonal = if i == k { both } else { T::zero() };
            turned[i][k] + diagonal - near[i] * r[k] - r[i] * far[k]
        };
        Self {
            mass_kg: self.mass_kg,
            moment_kg_m: far,
            inertia_kg_m2: [
                shift(0, 0),
                shift(0, 1),
                shift(0, 2),
                shift(1, 1),
                shift(1, 2),
                shift(2, 2),
            ],
        }
    }

    /// The same body in another number type.
    #[inline]
    pub fn cast<U: Real>(&self) -> Body<U> {
        Body::from_array(self.to_array().map(|x| U::constant(x.as_f64())))
    }

    /// Whether mass and pseudo-inertia could be those of matter: the matrix
    /// [[tr(I)/2 1 - I, m c], [(m c)^T, m]] is positive definite (Wensing, Kim and Slotine 2018).
    #[inline]
    pub fn is_physical(&self) -> bool {
        let zero = T::zero();
        let i = self.inertia_matrix();
        let half_trace = (i[0][0] + i[1][1] + i[2][2]) / T::constant(2.0);
        let unit = Transform::identity().rotation;
        let second_moments = add_scaled(&unit.map(|row| scale(&row, half_trace)), &i, -T::one());
        let h = &self.moment_kg_m;
        // The Schur complement of the mass: second moments about the centre of mass.
        let central: Matrix3<T> =
            [0, 1, 2].map(|r| subtract(&second_moments[r], &scale(h, h[r] / self.mass_kg)));
        let minors = crate::vector::leading_minors(&central);
        self.mass_kg > zero && minors.iter().all(|minor| *minor > zero)
    }
}
