//! Rigid-body dynamics in closed form, eq. (1): D(q) qdd + c(q, qd) + h(q) = tau.
//!
//! Rotor inertias are inside D, so tau is what the motors deliver, k_t u.

use crate::vector::{self, Matrix3, Vector3};
use crate::{BaseParameters, Geometry, Real};

/// The sines and cosines of a posture, from which all terms of eq. (1) follow.
///
/// Joint 1 turns about the vertical, so no term depends on q1.
#[derive(Clone, Copy, Debug)]
pub struct Posture<T> {
    /// sin q2
    pub s2: T,
    /// cos q2
    pub c2: T,
    /// sin q3
    pub s3: T,
    /// cos q3
    pub c3: T,
    /// sin (q2 + q3)
    pub s23: T,
    /// cos (q2 + q3)
    pub c23: T,
}

impl<T: Real> Posture<T> {
    /// The posture at joint angles in radians.
    #[inline]
    pub fn new(q2_rad: T, q3_rad: T) -> Self {
        Self::from_sines(q2_rad.sin_cos(), q3_rad.sin_cos())
    }

    /// The posture from (sin, cos) of q2 and of q3.
    #[inline]
    pub fn from_sines((s2, c2): (T, T), (s3, c3): (T, T)) -> Self {
        Self { s2, c2, s3, c3, s23: s2 * c3 + c2 * s3, c23: c2 * c3 - s2 * s3 }
    }

    /// Mass matrix D [kg m^2], rotors included.
    #[inline]
    pub fn mass_matrix(&self, p: &BaseParameters<T>, geometry: &Geometry<T>) -> Matrix3<T> {
        let two = T::constant(2.0);
        let Self { s2, c2, s23, c23, .. } = *self;
        let elbow = geometry.a2_m * self.moment_along_link_2(p);
        let d11 = p.zz1r
            + s2 * (p.xx2r * s2 + two * p.xy2r * c2)
            + s23 * (p.xx3r * s23 + two * p.xy3r * c23)
            + two * geometry.a2_m * c2 * self.level_moment_3(p);
        let d13 = p.xz3r * s23 + p.yz3r * c23;
        let d12 = p.xz2r * s2 + p.yz2r * c2 + d13;
        let d22 = p.zz2r + p.zz3r + two * elbow;
        let d23 = p.zz3r + elbow;
        [[d11, d12, d13], [d12, d22, d23], [d13, d23, p.zz3r + p.ia3]]
    }

    /// Coriolis and centrifugal torques c [Nm], from D by the Christoffel symbols.
    #[inline]
    pub fn coriolis(
        &self,
        p: &BaseParameters<T>,
        geometry: &Geometry<T>,
        qd_rad_per_s: &Vector3<T>,
    ) -> Vector3<T> {
        let slopes = self.slopes(p, geometry);
        let [qd1, qd2, qd3] = *qd_rad_per_s;
        let half_square = qd1 * qd1 / T::constant(2.0);
        let qd23 = qd2 + qd3;
        [
            qd1 * (slopes.d11_by_q2 * qd2 + slopes.d11_by_q3 * qd3)
                + slopes.shoulder * qd2 * qd2
                + slopes.forearm * qd23 * qd23,
            slopes.elbow * qd3 * (qd2 + qd23) - slopes.d11_by_q2 * half_square,
            -slopes.elbow * qd2 * qd2 - slopes.d11_by_q3 * half_square,
        ]
    }

    /// Matrix C with c = C qd for which dD/dt - 2C is skew [Nm s].
    pub fn coriolis_matrix(
        &self,
        p: &BaseParameters<T>,
        geometry: &Geometry<T>,
        qd_rad_per_s: &Vector3<T>,
    ) -> Matrix3<T> {
        let by = self.slopes(p, geometry).by_joint();
        let half = T::constant(0.5);
        let christoffel = |i: usize, j: usize, k: usize| {
            half * (by[k][i][j] + by[j][i][k] - by[i][j][k]) * qd_rad_per_s[k]
        };
        let entry = |i, j| christoffel(i, j, 0) + christoffel(i, j, 1) + christoffel(i, j, 2);
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
    }

    /// Gravity torques h = dV/dq [Nm].
    #[inline]
    pub fn gravity(&self, p: &BaseParameters<T>, geometry: &Geometry<T>) -> Vector3<T> {
        let forearm = self.level_moment_3(p);
        let shoulder = p.mx2r * self.c2 - p.my2r * self.s2 + forearm;
        [T::zero(), geometry.gravity_m_s2 * shoulder, geometry.gravity_m_s2 * forearm]
    }

    /// Potential energy V [J].
    pub fn potential_energy(&self, p: &BaseParameters<T>, geometry: &Geometry<T>) -> T {
        let Self { s2, c2, s23, c23, .. } = *self;
        geometry.gravity_m_s2 * (p.mx2r * s2 + p.my2r * c2 + p.mx3r * s23 + p.my3r * c23)
    }

    /// Inverse dynamics, eq. (1): the torques [Nm] that give the accelerations.
    ///
    /// ```
    /// use model::{Posture, reference_robot::reference_robot};
    ///
    /// let model::Robot { base, geometry, .. } = reference_robot::<f64>();
    /// let posture = Posture::new(0.3, -0.5); // q2, q3 [rad]
    /// let (qd, qdd) = ([0.0, 1.0, 0.5], [0.0, 0.0, 2.0]); // [rad/s], [rad/s^2]
    ///
    /// let torque_nm = posture.inverse_dynamics(&base, &geometry, &qd, &qdd);
    /// let accelerations = posture.forward_dynamics(&base, &geometry, &qd, &torque_nm);
    /// assert!((accelerations[2] - 2.0).abs() < 1e-9);
    /// ```
    #[inline]
    pub fn inverse_dynamics(
        &self,
        p: &BaseParameters<T>,
        geometry: &Geometry<T>,
        qd_rad_per_s: &Vector3<T>,
        qdd_rad_per_s2: &Vector3<T>,
    ) -> Vector3<T> {
        let inertial = vector::multiply(&self.mass_matrix(p, geometry), qdd_rad_per_s2);
        let coriolis = self.coriolis(p, geometry, qd_rad_per_s);
        let gravity = self.gravity(p, geometry);
        [0, 1, 2].map(|i| inertial[i] + coriolis[i] + gravity[i])
    }

    /// Forward dynamics, eq. (1) solved for the accelerations [rad/s^2].
    #[inline]
    pub fn forward_dynamics(
        &self,
        p: &BaseParameters<T>,
        geometry: &Geometry<T>,
        qd_rad_per_s: &Vector3<T>,
        torque_nm: &Vector3<T>,
    ) -> Vector3<T> {
        let coriolis = self.coriolis(p, geometry, qd_rad_per_s);
        let gravity = self.gravity(p, geometry);
        let net = [0, 1, 2].map(|i| torque_nm[i] - coriolis[i] - gravity[i]);
        vector::solve_symmetric(&self.mass_matrix(p, geometry), &net)
    }

    /// First moment of link 3 along link 2 [kg m].
    #[inline]
    fn moment_along_link_2(&self, p: &BaseParameters<T>) -> T {
        p.mx3r * self.c3 - p.my3r * self.s3
    }

    /// Horizontal first moment of link 3 about its joint [kg m].
    #[inline]
    fn level_moment_3(&self, p: &BaseParameters<T>) -> T {
        p.mx3r * self.c23 - p.my3r * self.s23
    }

    /// The independent derivatives of D by q2 and q3.
    #[inline]
    fn slopes(&self, p: &BaseParameters<T>, geometry: &Geometry<T>) -> Slopes<T> {
        let two = T::constant(2.0);
        let Self { s2, c2, s3, c3, s23, c23 } = *self;
        let upright_moment_3 = p.mx3r * s23 + p.my3r * c23;
        let forearm_inertia = two * (p.xx3r * s23 * c23 + p.xy3r * (c23 * c23 - s23 * s23));
        let d11_by_q3 = forearm_inertia - two * geometry.a2_m * c2 * upright_moment_3;
        let upper_arm_inertia = two * (p.xx2r * s2 * c2 + p.xy2r * (c2 * c2 - s2 * s2));
        Slopes {
            d11_by_q2: upper_arm_inertia + d11_by_q3
                - two * geometry.a2_m * s2 * self.level_moment_3(p),
            d11_by_q3,
            shoulder: p.xz2r * c2 - p.yz2r * s2,
            forearm: p.xz3r * c23 - p.yz3r * s23,
            elbow: -geometry.a2_m * (p.mx3r * s3 + p.my3r * c3),
        }
    }
}

/// Derivatives of the mass matrix: D12 falls apart into a part that moves with q2
/// (`shoulder`) and one that moves with q2 + q3 (`forearm`), which is D13.
struct Slopes<T> {
    d11_by_q2: T,
    d11_by_q3: T,
    shoulder: T,
    forearm: T,
    /// dD23/dq3, half of dD22/dq3.
    elbow: T,
}

impl<T: Real> Slopes<T> {
    /// dD/dq1 (zero), dD/dq2 and dD/dq3.
    fn by_joint(&self) -> [Matrix3<T>; 3] {
        let zero = T::zero();
        let (f, e) = (self.forearm, self.elbow);
        let sum = self.shoulder + f;
        [
            [[zero; 3]; 3],
            [[self.d11_by_q2, sum, f], [sum, zero, zero], [f, zero, zero]],
            [[self.d11_by_q3, f, f], [f, e + e, e], [f, e, zero]],
        ]
    }
}
