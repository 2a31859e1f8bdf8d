//! The names of rigid-body parameters.

/// A parameter in which the inverse dynamics is linear: a quantity, and the link that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParameterName {
    /// The quantity with its unit, as `mx_kg_m`.
    pub quantity: &'static str,
    /// The link that has it: the number of the joint that moves it, from 1; 0 where the quantity
    /// itself says it.
    pub link: u8,
}

impl core::fmt::Display for ParameterName {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.link {
            0 => f.write_str(self.quantity),
            link => write!(f, "joint[{link}].{}", self.quantity),
        }
    }
}
