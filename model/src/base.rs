//! The 16 base parameters, in the names of Khalil and Dombre.

use serde::{Deserialize, Serialize};

use crate::Real;

/// How many base parameters there are, eq. (4).
pub const COUNT: usize = 16;

/// The base parameters' names, in the order of [`BaseParameters::to_array`].
pub const NAMES: [&str; COUNT] = [
    "zz1r", "xx2r", "xy2r", "xz2r", "yz2r", "zz2r", "mx2r", "my2r", //
    "xx3r", "xy3r", "xz3r", "yz3r", "zz3r", "mx3r", "my3r", "ia3",
];

/// The base parameters of eq. (4): first moments in kg m, inertias in kg m^2.
///
/// Jm,1 is inside `zz1r`, Jm,2 inside `zz2r`; `ia3` is Jm,3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
#[serde(deny_unknown_fields)]
pub struct BaseParameters<T> {
    pub zz1r: T,
    pub xx2r: T,
    pub xy2r: T,
    pub xz2r: T,
    pub yz2r: T,
    pub zz2r: T,
    pub mx2r: T,
    pub my2r: T,
    pub xx3r: T,
    pub xy3r: T,
    pub xz3r: T,
    pub yz3r: T,
    pub zz3r: T,
    pub mx3r: T,
    pub my3r: T,
    pub ia3: T,
}

impl<T: Real> BaseParameters<T> {
    /// The parameters as the vector p of eq. (4), in the order of [`NAMES`].
    pub fn to_array(&self) -> [T; COUNT] {
        [
            self.zz1r, self.xx2r, self.xy2r, self.xz2r, self.yz2r, self.zz2r, self.mx2r, self.my2r,
            self.xx3r, self.xy3r, self.xz3r, self.yz3r, self.zz3r, self.mx3r, self.my3r, self.ia3,
        ]
    }

    /// The parameters from the vector p of eq. (4), in the order of [`NAMES`].
    pub fn from_array(p: [T; COUNT]) -> Self {
        let [zz1r, xx2r, xy2r, xz2r, yz2r, zz2r, mx2r, my2r, ..] = p;
        let [.., xx3r, xy3r, xz3r, yz3r, zz3r, mx3r, my3r, ia3] = p;
        Self {
            zz1r,
            xx2r,
            xy2r,
            xz2r,
            yz2r,
            zz2r,
            mx2r,
            my2r, //
            xx3r,
            xy3r,
            xz3r,
            yz3r,
            zz3r,
            mx3r,
            my3r,
            ia3,
        }
    }

    /// The same parameters in another number type.
    pub fn cast<U: Real>(&self) -> BaseParameters<U> {
        BaseParameters::from_array(self.to_array().map(|p| U::constant(p.as_f64())))
    }
}
