//! Checks of parameters, with errors that name them.

use crate::Real;

/// A parameter out of its bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterError {
    /// The parameter's name, as in the model file, with its unit.
    pub name: &'static str,
    /// The joint, 1 to 3, or 0 where the parameter belongs to no joint.
    pub joint: u8,
    /// The value found.
    pub value: f64,
    /// What it must be.
    pub must: &'static str,
}

impl core::fmt::Display for ParameterError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.joint {
            0 => write!(f, "{} is {}, but must {}", self.name, self.value, self.must),
            joint => {
                write!(
                    f,
                    "{} of joint {joint} is {}, but must {}",
                    self.name, self.value, self.must
                )
            }
        }
    }
}

impl core::error::Error for ParameterError {}

/// A named value, to be checked.
#[derive(Clone, Copy, Debug)]
pub struct Named<T> {
    name: &'static str,
    joint: u8,
    value: T,
}

/// Names a value of the whole robot for checking.
pub fn named<T: Real>(name: &'static str, value: T) -> Named<T> {
    Named { name, joint: 0, value }
}

impl<T: Real> Named<T> {
    /// Says which joint (1 to 3) the value belongs to.
    pub fn of_joint(self, joint: u8) -> Self {
        Self { joint, ..self }
    }

    /// Requires a finite value.
    pub fn finite(self) -> Result<T, ParameterError> {
        self.require(self.value.is_finite(), "be a finite number")
    }

    /// Requires a finite value above zero.
    pub fn positive(self) -> Result<T, ParameterError> {
        self.finite()?;
        self.require(self.value > T::zero(), "be above 0")
    }

    /// Requires a finite value of zero or more.
    pub fn not_negative(self) -> Result<T, ParameterError> {
        self.finite()?;
        self.require(self.value >= T::zero(), "be 0 or more")
    }

    /// Requires what the caller tested, in words that follow "must".
    pub fn require(self, holds: bool, must: &'static str) -> Result<T, ParameterError> {
        if holds { Ok(self.value) } else { Err(self.error(must)) }
    }

    /// The error that says what the value must be.
    pub fn error(self, must: &'static str) -> ParameterError {
        ParameterError { name: self.name, joint: self.joint, value: self.value.as_f64(), must }
    }
}
