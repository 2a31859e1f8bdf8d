//! Good inputs, from which damage begins.

use std::path::Path;

use files::excitation_file::JointTable;
use files::{ExcitationFile, JointLog, Log, Position, RobotFile};
use firmware::block::MAX_BYTES;
use firmware::checksum::CRC_32C;
use firmware::frame::FrameReader;
use firmware::link::checked::{Kind, open};
use firmware::link::{
    Command, MAX_FRAME_BYTES, PIECE_BYTES, PROTOCOL_VERSION, Request, Source, ToBoard,
};
use firmware::reference::Reference;
use firmware::store::slot_record;
use firmware::{Angle, Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use rig::{Rig, plan};

/// Blocks with every kind of reference.
fn parameter_blocks() -> Vec<ParameterBlock> {
    let rig = Rig::new(reference_robot());
    let plans = [
        plan::task(10.0).with_mode(Mode::PdModel),
        plan::excitation(1, 10.0).with_mode(Mode::PdFriction),
        plan::driven_noise(10.0, 1),
        plan::constant_velocity(2),
        plan::friction_excitation(&rig),
    ];
    plans.iter().map(|plan| plan.block(&rig)).collect()
}

fn encoded(block: &ParameterBlock) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    block.encode(&mut buffer).unwrap_or_default().to_vec()
}

/// Bodies of blocks, without header and checksum.
pub fn blocks() -> Vec<Vec<u8>> {
    let body = |block: &ParameterBlock| {
        let bytes = encoded(block);
        bytes.get(4..bytes.len().saturating_sub(4)).unwrap_or_default().to_vec()
    };
    parameter_blocks().iter().map(body).collect()
}

/// All that is needed from an empty board to motion, and what comes after it.
fn commands(block: &[u8]) -> Vec<Command<'_>> {
    let checksum = CRC_32C.checksum(block);
    let mut commands = vec![
        Command::Query,
        Command::Challenge,
        Command::UploadBegin { length: block.len() as u16, checksum },
    ];
    let offsets = (0..).step_by(PIECE_BYTES);
    let pieces = offsets.zip(block.chunks(PIECE_BYTES));
    commands.extend(pieces.map(|(offset, bytes)| Command::UploadPiece { offset, bytes }));
    commands.extend([
        Command::Commit,
        Command::Download { source: Source::Stored, offset: 0 },
        Command::Download { source: Source::InUse, offset: 192 },
        Command::Home { position: [Angle(0); 3] },
        Command::Query,
        Command::Query,
        Command::Query,
        Command::Query,
        Command::Query,
        Command::Query,
        Command::Arm,
        Command::Run { host_timeout_ms: Some(100) },
        Command::Stop,
        Command::Disarm,
        Command::ClearFault,
        Command::SetKey { key: Some([0x5A; 32]) },
        Command::Stream { on: true },
    ]);
    commands
}

/// The contents of a whole conversation's frames, with a Hello first.
fn contents(commands: &[Command<'_>]) -> Vec<Vec<u8>> {
    let hello = ToBoard::Hello { protocol_version: PROTOCOL_VERSION };
    let requests = (1..)
        .zip(commands)
        .map(|(number, &command)| ToBoard::Request(Request { number, proof: None, command }));
    let messages = core::iter::once(hello).chain(requests);
    messages
        .map(|message| message.write(&mut [0; MAX_FRAME_BYTES]).unwrap_or_default().to_vec())
        .collect()
}

/// Frames of a Hello and of every command.
pub fn frames() -> Vec<Vec<u8>> {
    parameter_blocks().first().map(|block| contents(&commands(&encoded(block)))).unwrap_or_default()
}

/// Ticks of joints at rest, all well, as the target reads them.
fn rest(ticks: u8) -> [u8; 8] {
    [3, 6, 0, 0, 0, 0, 0, ticks]
}

/// A frame's payload, as the target reads it.
fn piece(frame: &[u8]) -> Vec<u8> {
    let mut reader = FrameReader::new();
    let mut piece = Vec::new();
    for &byte in frame {
        if let Some((kind, payload)) = reader.push(byte).and_then(open) {
            let what = if kind == Kind::Hello { 2 } else { 1 };
            let payload = &payload[..payload.len().min(255)];
            piece = [&[what, payload.len() as u8], payload].concat();
        }
    }
    piece
}

/// Conversations, as the target reads them: from upload to motion, with rest before arming.
///
/// The blocks hold where the joints are, so that they run: with feedback, with the model, and in
/// open loop with noise; with a key and without.
pub fn conversations() -> Vec<Vec<u8>> {
    let holding = |block: &ParameterBlock| {
        let hold = Reference::hold([0.0; 3]);
        let reference = Reference { injection: block.reference.injection, ..hold };
        ParameterBlock { reference, ..block.clone() }
    };
    let blocks = parameter_blocks();
    let long = blocks
        .iter()
        .take(4)
        .map(|block| conversation(0, contents(&commands(&encoded(&holding(block))))));
    // Boards that have parameters and have settled: every short way to a run and back.
    let to_run = [Command::Arm, Command::Run { host_timeout_ms: Some(100) }];
    let ends = [Command::Query, Command::Stop, Command::Disarm, Command::ClearFault];
    let short = ends.iter().map(|end| {
        conversation(4, contents(&[&to_run[..], &[*end, Command::Arm, to_run[1]]].concat()))
    });
    long.chain(short).collect()
}

/// A conversation, as the target reads it.
fn conversation(first: u8, contents: Vec<Vec<u8>>) -> Vec<u8> {
    let mut bytes = vec![first];
    for frame in contents {
        // Before arming the estimates settle, and a run lasts some ticks.
        bytes.extend([piece(&frame), rest(20).to_vec()].concat());
    }
    bytes
}

/// Records in the slots of the store.
pub fn banks() -> Vec<Vec<u8>> {
    let blocks = parameter_blocks();
    let records = (1..).zip(&blocks).map(|(sequence, block)| {
        let mut page = [0xFF; 2048];
        slot_record(sequence, &encoded(block), &mut page);
        page.to_vec()
    });
    let records: Vec<Vec<u8>> = records.collect();
    let pairs = records.windows(2).map(|pair| pair.concat());
    pairs.map(|slots| [slots, vec![0xFF; 4 * 2048]].concat()).collect()
}

fn log() -> Log {
    let joint = |joint: u8| JointLog {
        joint,
        position: Position::Count((0..6).map(|i| 1000 * i64::from(joint) - i).collect()),
        command_v: (0..6).map(|i| f64::from(i % 7) * 0.125 - 0.25).collect(),
        reference_rad: Some((0..6).map(|i| f64::from(i) / 8.0 - 1.5).collect()),
    };
    Log {
        time_s: (0..6).map(|i| f64::from(i) / 1000.0).collect(),
        joints: (1..=3).map(joint).collect(),
    }
}

/// The bytes of a file that `write` makes.
fn written(name: &str, write: impl Fn(&Path)) -> Vec<u8> {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join(name);
    write(&path);
    std::fs::read(path).unwrap_or_default()
}

fn log_as(name: &str) -> Vec<u8> {
    written(name, |path| log().write(path).expect("the log is good"))
}

/// Logs as text, plain and compressed.
pub fn logs_csv() -> Vec<Vec<u8>> {
    vec![
        log_as("log.csv"),
        log_as("log.csv.gz"),
        b"t_s,q3_rad,u3_V,note\n0,0.5,-1e-3,a\n0.001,0.25,2,b\n".to_vec(),
    ]
}

/// Logs as MCAP.
pub fn logs_mcap() -> Vec<Vec<u8>> {
    vec![log_as("log.mcap")]
}

const EFFECTS: &str = "[[effect]]\neffect = \"payload\"\njoint = 0\nmass_kg = 0.3\n[[effect]]\n\
    effect = \"cogging\"\njoint = 3\namplitude_V = 0.1\nharmonic = 8\nphase_rad = 0.2\n";
const PENDULUM: &str = "format = 1\n[robot]\ntorque_constant_Nm_per_V = [3]\n\
    gravity_m_s2 = 9.81\n[pendulum]\njoint = 3\ninertia_kg_m2 = 0.07\ngravity_torque_Nm = 1.9\n\
    [[friction]]\njoint = 3\nalpha0_V = 0.3\nalpha1_V = 0.1\nstribeck_velocity_rad_per_s = 0.003\n\
    alpha2_V_s_per_rad = 0.1\n";
const DATASET: &str = "format = 1\nencoder_counts_per_rev = 655360\n[[log]]\nfile = \"a.csv\"\n\
    experiment = \"slow\"\nrole = \"train\"\n";
const MAPPED: &str = "format = 1\n[streams.log]\ntopic = \"/a\"\n[streams.b]\nfile = \"b.npz\"\n\
    time = { column = \"t\", unit = \"ms\" }\nclock = \"own\"\nshift_s = 0.5\n[columns]\nt_s = \"t\"\n\
    q1_rad = { column = \"state[0]\", unit = \"deg\", scale = -1, offset = 0.1, wraps_at = 6.3 }\n\
    u1_V = { stream = \"b\", column = \"u\", copy = \"c\" }\n[[log]]\nfile = \"a.csv\"\n\
    experiment = \"slow\"\nrole = \"train\"\nrows = { episode = 3 }\nfiles = { b = \"c.npz\" }\n";
const ARM: &str = "format = 2\n[robot]\ngravity_m_s2 = [0, 0, -9.81]\n[[joint]]\nname = \"a\"\n\
    kind = \"revolute\"\norigin_xyz_m = [0, 0, 0.1]\naxis = [0, 0, 1]\nmass_kg = 1\n\
    com_m = [0, 0, 0]\ninertia_kg_m2 = [1, 0, 0, 1, 0, 1]\nlimits_rad = [-1, 1]\n\
    [joint.drive]\nkind = \"current\"\ntorque_constant_Nm_per_A = 2\n[joint.encoder]\n\
    counts_per_rev = 4096\n[joint.friction]\nalpha0_V = 0.1\n[joint.standard_error]\nmass_kg = 0.1\n";
/// Models, data sets and excitations.
pub fn toml_files() -> Vec<Vec<u8>> {
    let model = written("model.toml", |path| {
        RobotFile::from_robot(&reference_robot()).write(path).expect("the model is good");
    });
    let excitation = written("excitation.toml", |path| {
        let joint = |joint| JointTable {
            joint,
            centre_rad: 0.5,
            period_s: 10.0,
            sine_rad: [1.0, 0.5, 0.0, 0.0, 0.0],
            cosine_rad: [0.0; 5],
            peak_velocity_rad_per_s: Some(1.0),
            peak_command_v: Some(2.0),
        };
        let file = ExcitationFile::new(1.0, [1, 2, 3].map(joint));
        file.write(path).expect("the excitation is good");
    });
    let with_effects = [&model, EFFECTS.as_bytes()].concat();
    vec![
        model,
        with_effects,
        PENDULUM.into(),
        DATASET.into(),
        MAPPED.into(),
        ARM.into(),
        excitation,
    ]
}
