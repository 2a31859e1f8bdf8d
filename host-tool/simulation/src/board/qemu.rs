//! The firmware's image in QEMU, tied to this process by two FIFOs.

use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use firmware::ParameterBlock;
use firmware::lockstep::{REPLY_BYTES, Reply, Request};
use nix::fcntl::{FcntlArg, OFlag, fcntl};
use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::sys::stat::Mode;
use nix::unistd::{Pid, mkfifo};

use super::in_process::{accepted, encoded};
use super::{Board, BoardError};

/// How QEMU is run.
#[derive(Clone, Debug)]
pub struct QemuSettings {
    /// The firmware's ELF for `mps2-an386`.
    pub image: PathBuf,
    /// QEMU itself.
    pub program: PathBuf,
    /// Its working directory, where `flash.bin` is kept; a temporary one without.
    pub directory: Option<PathBuf>,
    /// Where its serial line ends, as QEMU's `-serial` has it: `none`, `pty`, `unix:...`.
    pub serial: String,
}

impl QemuSettings {
    /// `qemu-system-arm` from the path.
    pub fn new(image: impl Into<PathBuf>) -> Self {
        Self {
            image: image.into(),
            program: "qemu-system-arm".into(),
            directory: None,
            serial: "none".into(),
        }
    }
}

/// A QEMU with the firmware in it; ends with this value.
#[derive(Debug)]
pub struct Qemu {
    child: Child,
    requests: File,
    replies: File,
    _temporary: Option<tempfile::TempDir>,
}

impl Qemu {
    /// Starts QEMU and waits until the firmware has opened the link.
    ///
    /// This thread and QEMU are put on one processor: in lockstep only one of them
    /// runs at a time, and waking the other there is several times faster.
    pub fn start(settings: &QemuSettings) -> Result<Self, BoardError> {
        let image = settings
            .image
            .canonicalize()
            .map_err(|source| BoardError::Start { program: settings.image.clone(), source })?;
        let temporary = settings.directory.is_none().then(tempfile::tempdir).transpose()?;
        let directory = settings
            .directory
            .as_deref()
            .or(temporary.as_ref().map(|own| own.path()))
            .unwrap_or(Path::new("."));
        let [requests, replies] = ["to-board", "from-board"].map(|name| directory.join(name));
        make_fifo(&requests)?;
        make_fifo(&replies)?;
        stay_on_one_processor();
        let mut child = spawn(settings, &image, directory)?;
        let requests = open_requests(&requests, &mut child)?;
        let replies = File::open(replies)?;
        Ok(Self { child, requests, replies, _temporary: temporary })
    }

    /// Puts a block into the board's store; its sequence number.
    ///
    /// # Errors
    /// The board refuses it, or has ended.
    pub fn commit(&mut self, block: &ParameterBlock) -> Result<u32, BoardError> {
        let bytes = encoded(block)?;
        let reply = self.ask(Request::Commit { length: bytes.len() as u32 }, &bytes)?;
        Ok(accepted(reply, "commit")?.sequence)
    }

    /// Has the board begin with what its store has; the sequence number, or `None` for the
    /// safe defaults.
    ///
    /// # Errors
    /// The board has ended.
    pub fn boot(&mut self) -> Result<Option<u32>, BoardError> {
        let reply = self.ask(Request::Boot, &[])?;
        Ok(reply.accepted.then_some(reply.sequence))
    }

    /// The number of the process, for who wants to kill it.
    pub fn process(&self) -> u32 {
        self.child.id()
    }

    fn ask(&mut self, request: Request, payload: &[u8]) -> Result<Reply, BoardError> {
        self.requests.write_all(&request.encode())?;
        if !payload.is_empty() {
            self.requests.write_all(payload)?;
        }
        let mut bytes = [0; REPLY_BYTES];
        match self.replies.read_exact(&mut bytes) {
            Ok(()) => Ok(Reply::decode(&bytes)),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Err(self.ended()),
            Err(error) => Err(error.into()),
        }
    }

    fn ended(&mut self) -> BoardError {
        BoardError::Ended(match self.child.wait() {
            Ok(status) => status.to_string(),
            Err(error) => error.to_string(),
        })
    }
}

impl Board for Qemu {
    fn load(&mut self, block: &ParameterBlock) -> Result<(), BoardError> {
        let bytes = encoded(block)?;
        accepted(self.ask(Request::Load { length: bytes.len() as u32 }, &bytes)?, "load")?;
        Ok(())
    }

    fn start(&mut self) -> Result<(), BoardError> {
        accepted(self.ask(Request::Start, &[])?, "start")?;
        Ok(())
    }

    fn tick(&mut self, counts: &[i32; 3]) -> Result<Reply, BoardError> {
        accepted(self.ask(Request::Tick(*counts), &[])?, "tick")
    }
}

impl Drop for Qemu {
    fn drop(&mut self) {
        // It ends by itself when it can; when not, it must not outlive us.
        let _ = self.requests.write_all(&Request::Quit.encode());
        std::thread::sleep(Duration::from_millis(20));
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Makes a FIFO; one that an earlier run has left is as good.
fn make_fifo(path: &Path) -> std::io::Result<()> {
    match mkfifo(path, Mode::S_IRUSR | Mode::S_IWUSR) {
        Ok(()) | Err(nix::errno::Errno::EEXIST) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

fn spawn(settings: &QemuSettings, image: &Path, directory: &Path) -> Result<Child, BoardError> {
    let program = &settings.program;
    Command::new(program)
        .args(["-M", "mps2-an386", "-nographic", "-monitor", "none"])
        .args(["-serial", &settings.serial])
        .args(["-semihosting-config", "enable=on,target=native"])
        // An instruction takes 2^10 ns of the guest's clock: runs repeat exactly.
        .args(["-icount", "shift=10,sleep=off"])
        .arg("-kernel")
        .arg(image)
        .current_dir(directory)
        .stdin(Stdio::null())
        .spawn()
        .map_err(|source| BoardError::Start { program: program.to_owned(), source })
}

/// Opens the firmware's input once the firmware has it open, or says that QEMU has ended.
fn open_requests(path: &Path, child: &mut Child) -> Result<File, BoardError> {
    loop {
        let opened =
            OpenOptions::new().write(true).custom_flags(OFlag::O_NONBLOCK.bits()).open(path);
        match opened {
            Ok(file) => {
                fcntl(&file, FcntlArg::F_SETFL(OFlag::empty())).map_err(std::io::Error::from)?;
                return Ok(file);
            }
            // Nobody reads yet.
            Err(error) if error.raw_os_error() == Some(nix::libc::ENXIO) => {}
            Err(error) => return Err(error.into()),
        }
        if let Some(status) = child.try_wait()? {
            return Err(BoardError::Ended(status.to_string()));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Keeps this thread, and what it starts, on the first processor that it may use.
/// Where the system does not allow it, the link is slower and no less right.
fn stay_on_one_processor() {
    let Ok(allowed) = sched_getaffinity(Pid::from_raw(0)) else { return };
    let first = (0..CpuSet::count()).find(|&cpu| allowed.is_set(cpu).unwrap_or(false));
    let mut one = CpuSet::new();
    if first.is_some_and(|cpu| one.set(cpu).is_ok()) {
        let _ = sched_setaffinity(Pid::from_raw(0), &one);
    }
}
