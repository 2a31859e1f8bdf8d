//! A block in parts, each with a checksum of its own: the tick checks one at a time.

use postcard::ser_flavors::Flavor;
use serde::Serialize;

use super::parameters::ParameterBlock;
use crate::checksum::CRC_32C;

/// How many parts a block has.
pub const PARTS: usize = 12;

/// The checksum of every part.
pub type Fingerprints = [u32; PARTS];

impl ParameterBlock {
    /// The checksums of all parts.
    pub fn fingerprints(&self) -> Fingerprints {
        let mut part = 0;
        [(); PARTS].map(|()| {
            part += 1;
            self.part_fingerprint(part - 1)
        })
    }

    /// [`CRC_32C`] of part `part`, from 0; each value of the block is in one of them.
    pub fn part_fingerprint(&self, part: usize) -> u32 {
        let Self { robot, reference, compensations, safety, external_load, .. } = self;
        match part {
            0 => of(robot),
            1 => of(&self.scalars()),
            2 => of(safety),
            3..=5 => match (reference.motion.get(part - 3), reference.injection.get(part - 3)) {
                (Some(motion), Some(injection)) => of(&(motion, injection)),
                _ => 0,
            },
            6..=8 => compensations
                .get(part - 6)
                .map_or(0, |joint| of(&(&joint.feedforward, &joint.input_inverses, external_load))),
            _ => compensations.get(part - 9).map_or(0, |joint| of(&joint.tables)),
        }
    }

    /// What is one value, or one a joint.
    fn scalars(&self) -> impl Serialize + '_ {
        (
            (self.encoder_counts_per_turn, self.sample_period_s, self.command_limit_v),
            (&self.gains, &self.velocity_bandwidth_rad_per_s),
            (self.mode, self.in_use, self.reference.duration_s),
        )
    }
}

/// The checksum of a value's bytes, which are kept nowhere.
#[inline(never)]
fn of(value: &impl Serialize) -> u32 {
    let digest = Digest(CRC_32C.digest());
    postcard::serialize_with_flavor(value, digest).unwrap_or(0)
}

struct Digest(crc::Digest<'static, u32, crc::Table<1>>);

impl Flavor for Digest {
    type Output = u32;

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.0.update(&[byte]);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<u32> {
        Ok(self.0.finalize())
    }
}
