//! The board at the end of a debug probe.
//!
//! The chip is held in reset while the probe attaches, so that the watchdog, which runs on
//! while a probe holds the core, has not been started.

use probe_rs::flashing::DownloadOptions;
use probe_rs::probe::list::Lister;
use probe_rs::probe::{DebugProbeSelector, Probe};
use probe_rs::{MemoryInterface, Permissions, Session};

use firmware::store::{Layout, Slot};

use super::check::unchanged;
use super::{FlashError, FlashImage};

const CHIP: &str = "STM32G474RETx";
const LAYOUT: Layout = Layout::G474;

/// The board, halted.
pub struct ProbedBoard {
    session: Session,
}

fn failed(action: &'static str, error: &dyn std::error::Error) -> FlashError {
    let mut why = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        why = format!("{why}: {cause}");
        source = cause.source();
    }
    FlashError::Probe { action, why }
}

/// The names of the probes that are connected.
pub fn connected() -> Vec<String> {
    Lister::new().list_all().iter().map(|probe| probe.to_string()).collect()
}

/// The only probe, or the one of that name, VID:PID:SERIAL.
fn open(name: Option<&str>) -> Result<Probe, FlashError> {
    let lister = Lister::new();
    if let Some(name) = name {
        let selector: DebugProbeSelector = name.parse().map_err(|error| {
            let why = format!("{error}");
            FlashError::ProbeName { name: name.into(), why }
        })?;
        return lister.open(selector).map_err(|error| failed("be opened", &error));
    }
    match lister.list_all().as_slice() {
        [] => Err(FlashError::NoProbe),
        [one] => one.open().map_err(|error| failed("be opened", &error)),
        many => Err(FlashError::ManyProbes { names: many.iter().map(|p| p.to_string()).collect() }),
    }
}

impl ProbedBoard {
    /// Attaches to the board.
    ///
    /// # Errors
    /// There is no probe or more than one, or the chip does not answer.
    pub fn attach(name: Option<&str>) -> Result<Self, FlashError> {
        let session = open(name)?
            .attach_under_reset(CHIP, Permissions::default())
            .map_err(|error| failed("attach to the chip", &error))?;
        Ok(Self { session })
    }

    /// Reads flash.
    ///
    /// # Errors
    /// The probe does not read it.
    pub fn read(&mut self, address: u32, bytes: usize) -> Result<Vec<u8>, FlashError> {
        let mut found = vec![0; bytes];
        let mut core = self.session.core(0).map_err(|error| failed("halt the core", &error))?;
        core.read(u64::from(address), &mut found).map_err(|error| failed("read flash", &error))?;
        Ok(found)
    }

    /// What the store has.
    ///
    /// # Errors
    /// The probe does not read it.
    pub fn read_store(&mut self) -> Result<Vec<u8>, FlashError> {
        self.read(LAYOUT.bank_start, LAYOUT.used_bytes() as usize)
    }

    /// Writes an image and reads it back; all else in bank 2 must be afterwards what it was
    /// before.
    ///
    /// # Errors
    /// The image touches what it may not, the probe does not write it, it is not there
    /// afterwards, or something else has changed.
    pub fn write(&mut self, image: &FlashImage, chosen: Option<Slot>) -> Result<(), FlashError> {
        image.check(chosen)?;
        let before = self.read_store()?;
        self.program(image)?;
        for piece in &image.pieces {
            let found = self.read(piece.address, piece.bytes.len())?;
            let differs = found.iter().zip(&piece.bytes).position(|(a, b)| a != b);
            if let Some(at) = differs {
                return Err(FlashError::Verify { address: piece.address + at as u32 });
            }
        }
        unchanged(&before, &self.read_store()?, image)
    }

    fn program(&mut self, image: &FlashImage) -> Result<(), FlashError> {
        let mut loader = self.session.target().flash_loader();
        for piece in &image.pieces {
            loader
                .add_data(u64::from(piece.address), &piece.bytes)
                .map_err(|error| failed("take the image", &error))?;
        }
        let mut options = DownloadOptions::new();
        options.verify = true;
        loader.commit(&mut self.session, options).map_err(|error| failed("write flash", &error))
    }

    /// Lets the board run.
    ///
    /// # Errors
    /// The probe does not reset it.
    pub fn restart(&mut self) -> Result<(), FlashError> {
        let mut core = self.session.core(0).map_err(|error| failed("reach the core", &error))?;
        core.reset().map_err(|error| failed("reset the board", &error))
    }
}
