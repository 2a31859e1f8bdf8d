//! The command handler: numbers, uploads, states, the key, and what goes wrong on the line.
#![allow(missing_docs)]

#[allow(dead_code)]
mod bench;
#[allow(dead_code)]
mod common;

use bench::memory_store::MemoryStore;
use bench::operator::{Bench, Owned, encoded, frame, read_answer};
use firmware::block::MAX_BYTES;
use firmware::link::{
    BlockRefusal, Command, Handler, HandlerConfig, Origin, Refusal, Request, Source, StoreRefusal,
};
use firmware::reference::Reference;
use firmware::supervisor::{Fault, Health, Implausible, State, Supervisor};
use firmware::{Controller, Mode, ParameterBlock};

const RUN: Command<'_> = Command::Run { host_timeout_ms: None };
const KEY: [u8; 32] = [0x5A; 32];

fn block(mode: Mode) -> ParameterBlock {
    ParameterBlock { reference: Reference::hold([0.01; 3]), ..common::block(mode) }
}

/// A board with parameters in use, at rest long enough to be armed.
fn ready(key: Option<[u8; 32]>) -> Bench {
    let mut bench = Bench::new(key);
    bench.upload(&encoded(&block(Mode::Pd)), Command::Use).unwrap();
    bench.stand(200);
    bench
}

#[test]
fn a_day_at_the_rig() {
    let mut bench = Bench::new(None);
    let report = bench.report();
    assert_eq!((report.state, report.parameters, report.has_key), (State::Disarmed, None, false));
    assert_eq!(bench.ask(Command::Arm), Err(Refusal::NoParameters));
    assert_eq!(bench.download(Source::InUse), Err(Refusal::NoParameters));
    assert_eq!(bench.download(Source::Stored), Err(Refusal::Store(StoreRefusal::Empty)));

    let bytes = encoded(&block(Mode::PdModel));
    assert_eq!(bench.upload(&bytes, Command::Commit), Ok(Owned::InUse));
    assert_eq!(bench.download(Source::Stored).unwrap(), bytes);
    assert_eq!(bench.download(Source::InUse).unwrap(), bytes);
    assert_eq!(bench.report().parameters.unwrap().origin, Origin::Newest);

    let other = encoded(&block(Mode::Pd));
    assert_eq!(bench.upload(&other, Command::Use), Ok(Owned::InUse));
    assert_eq!(bench.download(Source::InUse).unwrap(), other);
    assert_eq!(bench.download(Source::Stored).unwrap(), bytes, "only in use");
    assert_eq!(bench.report().parameters.unwrap().origin, Origin::Uploaded);

    let refused = bench.ask(Command::Arm);
    let why = Implausible::NotSettled;
    assert_eq!(refused, Err(Refusal::Implausible { joint: 1, why }));
    bench.stand(200);
    for (command, state) in [
        (Command::Arm, State::Armed),
        (RUN, State::Running),
        (Command::Stop, State::Armed),
        (RUN, State::Running),
        (Command::Disarm, State::Disarmed),
    ] {
        assert_eq!(bench.ask(command), Ok(Owned::Done), "{command:?}");
        assert_eq!(bench.report().state, state);
        // The feedback begins at 0 V and is faded in.
        bench.supervisor.tick(&[0; 3], Health::default());
        let codes = bench.supervisor.tick(&[0; 3], Health::default()).codes;
        assert_eq!(codes[0].0 != 0, state == State::Running);
    }
}

#[test]
fn parameters_change_only_when_disarmed() {
    let mut bench = ready(None);
    let (before, other) = (bench.download(Source::InUse), encoded(&block(Mode::PdModel)));
    bench.send_block(&other).unwrap();
    bench.ask(Command::Arm).unwrap();
    for state in [State::Armed, State::Running] {
        for end in [Command::Use, Command::Commit, Command::UploadBegin { length: 9, checksum: 0 }]
        {
            assert_eq!(bench.ask(end), Err(Refusal::NotNow { state }));
        }
        assert_eq!(bench.ask(Command::SetKey { key: None }), Err(Refusal::NotNow { state }));
        assert_eq!(bench.download(Source::InUse), before);
        let _ = bench.ask(RUN);
    }
    bench.ask(Command::Disarm).unwrap();
    assert_eq!(bench.ask(Command::Use), Ok(Owned::InUse));
    assert_eq!(bench.download(Source::InUse).unwrap(), other);
    assert_eq!(bench.handler.store().commits, 0);
}

#[test]
fn a_request_is_carried_out_once_however_often_it_comes() {
    let mut bench = ready(None);
    let request = bench.request(Command::Arm);
    let first = bench.send(&frame(request));
    assert_eq!(read_answer(&first[0]).1, Ok(Owned::Done));
    // The answer was lost; asked anew it would be refused, as the board is armed now.
    for _ in 0..3 {
        assert_eq!(bench.send(&frame(request)), first);
    }
    // Something else under the same number, and an old number.
    for (number, command) in [(request.number, RUN), (1, Command::Query)] {
        let answers = bench.send(&frame(Request { number, proof: None, command }));
        let newest = request.number;
        assert_eq!(read_answer(&answers[0]), (number, Err(Refusal::OldNumber { newest })));
    }
    assert_eq!(bench.send(&frame(request)), first, "still kept");
    assert_eq!(bench.report().state, State::Armed);
    // A Hello begins the numbers anew.
    bench.greet();
    assert_eq!(bench.report().state, State::Armed);
}

#[test]
fn after_a_reset_the_host_must_say_hello() {
    let mut bench = ready(None);
    let config = HandlerConfig {
        board: "test",
        limits: Default::default(),
        nonce_seed: [1; 16],
        key: None,
        fault: None,
        in_use: None,
    };
    bench.handler = Handler::new(MemoryStore::default(), &config);
    assert_eq!(bench.ask(Command::Arm), Err(Refusal::HelloFirst));
    bench.greet();
    assert_eq!(bench.ask(Command::Arm), Ok(Owned::Done));
}

#[test]
fn broken_frames_and_noise_change_nothing_and_are_counted() {
    let mut bench = ready(None);
    let mut asked = 0;
    let request = bench.request(Command::Arm);
    let whole = frame(request);
    for bit in 0..8 * whole.len() {
        let mut line = whole.clone();
        line[bit / 8] ^= 1 << (bit % 8);
        line.push(0);
        assert!(bench.send(&line).is_empty(), "bit {bit}");
        asked += 1;
    }
    for end in 1..whole.len() - 1 {
        assert!(bench.send(&[&whole[..end], &[0]].concat()).is_empty());
        asked += 1;
    }
    assert_eq!(bench.supervisor.state(), State::Disarmed);
    let report = bench.report();
    assert!(report.counters.frames_broken >= asked, "{asked}: {report:?}");
    assert_eq!(bench.send(&whole).len(), 1, "late, and old by now");
    assert_eq!(bench.ask(Command::Arm), Ok(Owned::Done));
}

#[test]
fn bytes_at_random_never_do_anything() {
    let mut bench = ready(None);
    let mut word = 1_u32;
    for _ in 0..2_000_000 {
        word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        assert!(bench.send(&[(word >> 24) as u8]).is_empty());
    }
    assert_eq!(bench.supervisor.state(), State::Disarmed);
}

#[test]
fn an_upload_with_a_gap_an_overlap_or_another_block_is_refused() {
    let mut bench = Bench::new(None);
    let bytes = encoded(&block(Mode::Pd));
    let (length, checksum) = (bytes.len() as u16, 7);
    let piece = |offset: u16, end: usize| Command::UploadPiece {
        offset,
        bytes: &bytes[usize::from(offset)..end],
    };
    assert_eq!(bench.ask(piece(0, 9)), Err(Refusal::Upload { taken: 0 }), "not announced");
    assert_eq!(bench.ask(Command::Use), Err(Refusal::Block(BlockRefusal::Length)));
    bench.ask(Command::UploadBegin { length, checksum }).unwrap();
    bench.ask(piece(0, 100)).unwrap();
    for wrong in [piece(0, 100), piece(99, 120), piece(101, 120)] {
        assert_eq!(bench.ask(wrong), Err(Refusal::Upload { taken: 100 }));
    }
    assert_eq!(bench.ask(Command::Use), Err(Refusal::Block(BlockRefusal::Length)));
    for from in (100..length).step_by(150) {
        bench.ask(piece(from, bytes.len().min(usize::from(from) + 150))).unwrap();
    }
    let beyond = Command::UploadPiece { offset: length, bytes: &[0] };
    assert_eq!(bench.ask(beyond), Err(Refusal::Upload { taken: length }));
    assert_eq!(bench.ask(Command::Use), Err(Refusal::Block(BlockRefusal::Checksum)));
    let long = Command::UploadBegin { length: MAX_BYTES as u16 + 1, checksum };
    assert_eq!(bench.ask(long), Err(Refusal::Block(BlockRefusal::Length)));
    assert_eq!(bench.report().parameters, None);
}

/// The name, joint and demand in the refusal of a block.
fn refused_value(change: impl FnOnce(&mut ParameterBlock)) -> (String, u8, String) {
    let mut block = block(Mode::Pd);
    change(&mut block);
    let mut bench = Bench::new(None);
    match bench.upload(&encoded(&block), Command::Commit) {
        Err(Refusal::Block(BlockRefusal::Value { name, joint, must, .. })) => {
            assert_eq!(bench.handler.store().commits, 0);
            (name.as_str().into(), joint, must.as_str().into())
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_block_is_checked_as_a_whole_before_anything_is_stored() {
    let (name, joint, must) = refused_value(|b| b.robot.base.zz3r = -1.0);
    assert_eq!((name.as_str(), joint), ("zz3r + ia3", 0));
    assert_eq!(must, "make the mass matrix positive definite in every posture");
    assert_eq!(refused_value(|b| b.sample_period_s = 2e-3).0, "sample_period_s");
    let hard = "not exceed the board's hard limit".to_owned();
    let kp = refused_value(|b| b.gains[1].proportional_v_per_rad = 2e4);
    assert_eq!(kp, ("proportional_gain_V_per_rad".into(), 2, hard.clone()));
    let speed = refused_value(|b| b.safety.speed_rad_per_s[2] = 31.0);
    assert_eq!(speed, ("speed_limit_rad_per_s".into(), 3, hard));
    let mut bench = Bench::new(None);
    let mut bytes = encoded(&block(Mode::Pd));
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    let refused = bench.upload(&bytes, Command::Commit);
    assert_eq!(refused, Err(Refusal::Block(BlockRefusal::Checksum)));
}

#[test]
fn a_store_that_fails_or_lies_leaves_the_old_block_in_use() {
    for (fails, lies, why) in
        [(true, false, StoreRefusal::Write), (false, true, StoreRefusal::ReadBack)]
    {
        let mut bench = ready(None);
        let before = bench.download(Source::InUse);
        (bench.handler.store().fails, bench.handler.store().lies) = (fails, lies);
        let refused = bench.upload(&encoded(&block(Mode::PdModel)), Command::Commit);
        assert_eq!(refused, Err(Refusal::Store(why)));
        assert_eq!(bench.download(Source::InUse), before);
    }
}

#[test]
fn a_fault_is_kept_over_a_reset_and_left_by_a_clear() {
    let mut bench = ready(None);
    bench.ask(Command::Arm).unwrap();
    bench.ask(Command::Run { host_timeout_ms: Some(100) }).unwrap();
    for _ in 0..20 {
        bench.stand(90);
        assert_eq!(bench.report().state, State::Running, "the host is there");
    }
    bench.stand(102);
    let record = bench.supervisor.fault().unwrap();
    assert_eq!(record.fault, Fault::LinkLost);
    // A reset: what is left is the store.
    let store = std::mem::take(bench.handler.store());
    assert_eq!(store.fault, Some(record));
    let mut supervisor = Supervisor::default();
    supervisor.replace(Controller::new(block(Mode::Pd))).unwrap();
    let mut bench = Bench::with_store(store, supervisor, [8; 16]);
    let report = bench.report();
    assert_eq!((report.state, report.fault), (State::Faulted, Some(record)));
    assert_eq!(bench.ask(Command::Arm), Err(Refusal::NotNow { state: State::Faulted }));
    assert_eq!(bench.ask(Command::ClearFault), Ok(Owned::Done));
    assert_eq!(bench.handler.store().fault, None);
    assert_eq!(bench.report().state, State::Disarmed);
}

#[test]
fn without_the_key_nothing_that_matters_is_done() {
    let mut bench = ready(Some(KEY));
    assert!(bench.report().has_key);
    let bytes = encoded(&block(Mode::Pd));
    bench.key = None;
    for command in [
        Command::Arm,
        Command::UploadBegin { length: 9, checksum: 0 },
        Command::UploadPiece { offset: 0, bytes: &bytes[..9] },
        Command::Use,
        Command::Commit,
        RUN,
        Command::ClearFault,
        Command::SetKey { key: None },
    ] {
        assert_eq!(bench.ask(command), Err(Refusal::Proof), "{command:?}");
    }
    assert!(bench.ask(Command::Stop).is_ok(), "whoever sees a danger may stop");
    bench.key = Some([0; 32]);
    assert_eq!(bench.ask(Command::Arm), Err(Refusal::Proof), "another key");
    bench.key = Some(KEY);
    bench.ask(Command::Arm).unwrap();
    bench.ask(RUN).unwrap();
    bench.key = None;
    assert_eq!(bench.ask(Command::Disarm), Ok(Owned::Done));
}

#[test]
fn what_was_heard_on_the_line_cannot_be_said_again() {
    let mut bench = ready(Some(KEY));
    let heard = bench.request(Command::Arm);
    assert_eq!(read_answer(&bench.send(&frame(heard))[0]).1, Ok(Owned::Done));
    bench.ask(Command::Disarm).unwrap();
    // In the same conversation its number is old.
    let replayed = read_answer(&bench.send(&frame(heard))[0]).1;
    assert!(matches!(replayed, Err(Refusal::OldNumber { .. })), "{replayed:?}");
    // In the next one, and after a new challenge, the challenge is another.
    bench.greet();
    assert_eq!(read_answer(&bench.send(&frame(heard))[0]).1, Err(Refusal::Proof));
    bench.number = heard.number;
    // After a Hello without a challenge there is none that fits.
    bench.greet();
    bench.key = None;
    bench.greet();
    assert_eq!(read_answer(&bench.send(&frame(heard))[0]).1, Err(Refusal::Proof));
    assert_eq!(bench.supervisor.state(), State::Disarmed);
}

#[test]
fn a_key_is_set_changed_and_removed_by_who_has_it() {
    let mut bench = ready(None);
    bench.ask(Command::SetKey { key: Some(KEY) }).unwrap();
    assert_eq!(bench.handler.store().key, Some(KEY));
    assert_eq!(bench.ask(Command::Arm), Err(Refusal::Proof));
    bench.key = Some(KEY);
    bench.greet();
    let other = [9; 32];
    bench.ask(Command::SetKey { key: Some(other) }).unwrap();
    bench.greet();
    assert_eq!(bench.ask(Command::Arm), Err(Refusal::Proof), "the old key");
    bench.key = Some(other);
    bench.greet();
    assert_eq!(bench.ask(Command::SetKey { key: None }), Ok(Owned::Done));
    bench.key = None;
    assert_eq!(bench.ask(Command::Arm), Ok(Owned::Done), "the link is open again");
}
