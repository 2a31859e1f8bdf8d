//! Messages to frames and back; what is broken on the way is seen.
#![allow(missing_docs)]

use firmware::frame::FrameReader;
use firmware::link::{
    Answer, BAUD, Command, Hello, MAX_FRAME_BYTES, PIECE_BYTES, Refusal, Reply, Request, Source,
    Telemetry, ToBoard, ToHost, key,
};
use firmware::supervisor::{Fault, State};
use firmware::{Angle, DacCode, Mode};

fn to_board(message: &ToBoard<'_>) -> Vec<u8> {
    message.write(&mut [0; MAX_FRAME_BYTES]).unwrap().to_vec()
}

fn to_host(message: &ToHost<'_>) -> Vec<u8> {
    message.write(&mut [0; MAX_FRAME_BYTES]).unwrap().to_vec()
}

/// The contents of the frames in these bytes.
fn contents(line: &[u8]) -> Vec<Vec<u8>> {
    let mut reader = FrameReader::new();
    line.iter().filter_map(|&byte| reader.push(byte).map(<[u8]>::to_vec)).collect()
}

fn request(command: Command<'_>) -> ToBoard<'_> {
    ToBoard::Request(Request { number: u32::MAX, proof: Some([0xA5; 32]), command })
}

/// The longest record there can be.
fn longest_record() -> Telemetry {
    Telemetry {
        sequence: u32::MAX,
        counts: [i32::MIN; 3],
        codes: [DacCode(i16::MIN); 3],
        reference: [Angle(i32::MIN); 3],
        mode: [Mode::OpenLoop; 3],
        state: State::Faulted,
        saturated: 7,
        fault: Some((Fault::Converter, 3)),
        tick_time_tenth_us: u16::MAX,
        dropped: u32::MAX,
    }
}

/// Byte for byte, checksum included: a host and a firmware of any age can say Hello.
#[test]
fn a_hello_on_the_line_never_changes() {
    let ask = to_board(&ToBoard::Hello { protocol_version: 1 });
    assert_eq!(ask, b"\x06HRRR\x01\x05)\x11\xd6\xe7\x00");
    let hello = Hello {
        protocol_version: 1,
        schema_hash: 0x0403_0201,
        ..Hello::of_this_build("nucleo-g474re")
    };
    let hello = Hello { build_id: firmware::link::hello::Text::new("0.1.0"), ..hello };
    let frame = b"\x06HRRR\x01\x0a\x01\x02\x03\x040.1.0\x01\x01\
        \x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\
        \x0enucleo-g474re\x01\x01\x01\x01\x01\x01\x01\x01\x01\x01\x05\xa1*N\x9a\x00";
    assert_eq!(to_host(&ToHost::Hello(hello)), frame);
}

#[test]
fn messages_survive_the_line() {
    let bytes = [0; PIECE_BYTES];
    for command in [
        Command::Query,
        Command::UploadPiece { offset: 960, bytes: &bytes },
        Command::Download { source: Source::Stored, offset: 0 },
        Command::Run { host_timeout_ms: Some(500) },
        Command::SetKey { key: Some([7; 32]) },
    ] {
        let frames = contents(&to_board(&request(command)));
        assert_eq!(frames.len(), 1);
        assert_eq!(ToBoard::read(&frames[0]), Ok(request(command)));
    }
    for message in [
        ToHost::Hello(Hello::of_this_build("test")),
        ToHost::Answer(Answer { number: 3, result: Ok(Reply::Done) }),
        ToHost::Answer(Answer { number: 4, result: Err(Refusal::Proof) }),
        ToHost::Telemetry(longest_record()),
    ] {
        assert_eq!(ToHost::read(&contents(&to_host(&message))[0]), Ok(message));
    }
}

#[test]
fn a_record_every_tick_leaves_a_quarter_of_the_line() {
    let longest = to_host(&ToHost::Telemetry(longest_record())).len();
    let bytes_a_tick = BAUD as usize / 10 / 1000;
    println!("longest record {longest} of {bytes_a_tick} bytes a tick");
    assert_eq!(longest, 67);
    assert!(4 * longest <= 3 * bytes_a_tick);
}

#[test]
fn every_flip_of_a_bit_in_a_frame_is_detected() {
    let piece: Vec<u8> = (0..PIECE_BYTES).map(|k| (k * k % 7) as u8).collect();
    let upload = request(Command::UploadPiece { offset: 192, bytes: &piece });
    let report = Answer { number: 9, result: Err(Refusal::OldNumber { newest: 77 }) };
    let mut flips = 0;
    for frame in [
        to_board(&request(Command::Arm)),
        to_board(&upload),
        to_board(&ToBoard::Hello { protocol_version: 1 }),
        to_host(&ToHost::Answer(report)),
        to_host(&ToHost::Telemetry(longest_record())),
    ] {
        // The frame that follows must come through whole, or, where its beginning was
        // broken too, be seen as broken.
        for bit in 0..8 * frame.len() {
            let mut line = frame.clone();
            line[bit / 8] ^= 1 << (bit % 8);
            line.push(0);
            for content in contents(&line) {
                assert!(ToBoard::read(&content).is_err(), "bit {bit}");
                assert!(ToHost::read(&content).is_err(), "bit {bit}");
            }
            flips += 1;
        }
    }
    println!("{flips} flips detected");
}

#[test]
fn frames_of_the_wrong_direction_or_of_another_build_are_foreign() {
    let frame = to_host(&ToHost::Telemetry(longest_record()));
    assert!(ToBoard::read(&contents(&frame)[0]).is_err());
    let frame = to_board(&request(Command::Arm));
    assert!(ToHost::read(&contents(&frame)[0]).is_err());
}

#[test]
fn a_proof_holds_for_one_command_under_one_number_and_challenge() {
    let (key, nonce) = ([1; 32], [2; 16]);
    let proof = key::proof(&key, &nonce, 5, &Command::Arm);
    let request = Request { number: 5, proof, command: Command::Arm };
    assert!(key::is_proven(&key, &nonce, &request));
    assert!(!key::is_proven(&key, &nonce, &Request { number: 6, ..request }));
    assert!(!key::is_proven(&key, &nonce, &Request { command: Command::Commit, ..request }));
    assert!(!key::is_proven(&key, &nonce, &Request { proof: None, ..request }));
    assert!(!key::is_proven(&key, &[3; 16], &request));
    assert!(!key::is_proven(&[0; 32], &nonce, &request));
}

/// A block ends with a checksum of its own; the line's must still tell one from another.
#[test]
fn a_checksum_tells_one_block_from_another() {
    let of = |limit_v: f32| {
        let mut block = firmware::store::safe_defaults();
        block.command_limit_v = limit_v;
        let mut buffer = [0; firmware::block::MAX_BYTES];
        firmware::checksum::CRC_32C.checksum(block.encode(&mut buffer).unwrap())
    };
    assert_ne!(of(1.0), of(2.0));
}
