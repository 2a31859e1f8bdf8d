//! Mass properties of links, and the base parameters that follow from them.

use crate::{BaseParameters, Geometry, Real};

/// A rigid link in its standard (distal) Denavit-Hartenberg frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<T> {
    /// Mass [kg].
    pub mass_kg: T,
    /// Centre of mass x, y, z [m].
    pub centre_m: [T; 3],
    /// Entries xx, yy, zz of the inertia tensor about the centre of mass [kg m^2].
    pub inertia_diagonal_kg_m2: [T; 3],
    /// Entries xy, xz, yz of that tensor; xy is minus the integral of x y dm [kg m^2].
    pub inertia_products_kg_m2: [T; 3],
}

impl<T: Real> Link<T> {
    /// Inertia tensor entry (row, column) about the frame's axes moved by `-shift_m`,
    /// by the parallel axis theorem.
    fn entry_about(&self, shift_m: [T; 3], row: usize, column: usize) -> T {
        let [xx, yy, zz] = self.inertia_diagonal_kg_m2;
        let [xy, xz, yz] = self.inertia_products_kg_m2;
        let central = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]][row][column];
        let r = [0, 1, 2].map(|i| self.centre_m[i] + shift_m[i]);
        let steiner = if row == column {
            r[0] * r[0] + r[1] * r[1] + r[2] * r[2] - r[row] * r[row]
        } else {
            -r[row] * r[column]
        };
        central + self.mass_kg * steiner
    }
}

/// Base parameters of three links and their rotors (Jm,1 to Jm,3, about the joint axes).
///
/// The formulas of MODEL.md, term by term: link 2 is taken about the axis of joint 2
/// and link 3 about that of joint 3, with link 3's mass lumped at the elbow.
pub fn base_parameters<T: Real>(
    links: &[Link<T>; 3],
    rotor_inertia_kg_m2: &[T; 3],
    geometry: &Geometry<T>,
) -> BaseParameters<T> {
    let zero = T::zero();
    let [link1, link2, link3] = links;
    let (a2, a3, d2) = (geometry.a2_m, geometry.a3_m, geometry.d2_m);
    let m3 = link3.mass_kg;
    let offset = d2 + geometry.d3_m;
    let shift2 = [a2, zero, d2];
    let shift3 = [a3, zero, offset];
    let mx3r = m3 * (a3 + link3.centre_m[0]);
    // Inertia of link i, less its y entry, about its joint axis; both without the z offset.
    let flat = |link: &Link<T>, length: T, row, column| {
        link.entry_about([length, zero, -link.centre_m[2]], row, column)
    };
    let xx2r = flat(link2, a2, 0, 0) - flat(link2, a2, 1, 1) - a2 * a2 * m3;
    let xx3r = flat(link3, a3, 0, 0) - flat(link3, a3, 1, 1);
    let zz1r = link1.entry_about([zero; 3], 1, 1)
        + rotor_inertia_kg_m2[0]
        + link2.entry_about(shift2, 0, 0)
        + link3.entry_about(shift3, 0, 0)
        - xx2r
        - xx3r;
    BaseParameters {
        zz1r,
        xx2r,
        xy2r: link2.entry_about(shift2, 0, 1),
        xz2r: link2.entry_about(shift2, 0, 2) - m3 * a2 * (offset + link3.centre_m[2]),
        yz2r: link2.entry_about(shift2, 1, 2),
        zz2r: link2.entry_about(shift2, 2, 2) + rotor_inertia_kg_m2[1] + a2 * a2 * m3,
        mx2r: link2.mass_kg * (a2 + link2.centre_m[0]) + a2 * m3,
        my2r: link2.mass_kg * link2.centre_m[1],
        xx3r,
        xy3r: link3.entry_about(shift3, 0, 1),
        xz3r: link3.entry_about(shift3, 0, 2),
        yz3r: link3.entry_about(shift3, 1, 2),
        zz3r: link3.entry_about(shift3, 2, 2),
        mx3r,
        my3r: m3 * link3.centre_m[1],
        ia3: rotor_inertia_kg_m2[2],
    }
}
