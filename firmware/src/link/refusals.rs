//! Conversion of the board's errors to the refusals sent to the host.

use super::answer::{BlockRefusal, Refusal, StoreRefusal};
use crate::block::BlockError;
use crate::store::StoreError;
use crate::supervisor::OrderError;

impl From<OrderError> for Refusal {
    fn from(error: OrderError) -> Self {
        match error {
            OrderError::NotNow { state } => Self::NotNow { state },
            OrderError::NoParameters => Self::NoParameters,
            OrderError::Implausible { joint, why } => Self::Implausible { joint, why },
            OrderError::FarFromStart { joint, distance_rad } => {
                Self::FarFromStart { joint, distance_rad }
            }
            OrderError::FaultPersists => Self::FaultPersists,
            OrderError::EmergencyStop => Self::EmergencyStop,
            OrderError::NoDrivePower => Self::NoDrivePower,
            OrderError::OutsideRange { joint, position_rad } => {
                Self::OutsideRange { joint, position_rad }
            }
        }
    }
}

impl From<StoreRefusal> for Refusal {
    fn from(why: StoreRefusal) -> Self {
        Self::Store(why)
    }
}

impl From<BlockError> for BlockRefusal {
    fn from(error: BlockError) -> Self {
        match error {
            BlockError::Length { .. } => Self::Length,
            BlockError::Version { found } => Self::Version { found },
            BlockError::Checksum => Self::Checksum,
            BlockError::Layout => Self::Layout,
            BlockError::Parameter(error) => Self::Value {
                name: shortened(error.name),
                joint: error.joint,
                value: error.value as f32,
                must: shortened(error.must),
            },
        }
    }
}

/// As much of a text as there is room for.
fn shortened<const N: usize>(text: &str) -> heapless::String<N> {
    let mut shortened = heapless::String::new();
    // The names are ASCII and shorter; one that is not ends early.
    let _ = text.chars().try_for_each(|letter| shortened.push(letter));
    shortened
}

impl From<BlockRefusal> for Refusal {
    fn from(why: BlockRefusal) -> Self {
        Self::Block(why)
    }
}

impl From<StoreError> for StoreRefusal {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::ReadBack { .. } => Self::ReadBack,
            StoreError::TooLong { .. } => Self::TooLong,
            StoreError::Flash { .. } | StoreError::Refused(_) | StoreError::WornOut => Self::Write,
        }
    }
}
