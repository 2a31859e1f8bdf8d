//! `--foxglove`: a client of the WebSocket sees the samples that the logs hold.
#![cfg(unix)]
#![allow(missing_docs)]

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use assert_cmd::cargo::cargo_bin;
use files::{JointLog, Log, Position};
use host_tool::live::Server;
use serde_json::{Value, json};
use simulation::simulated_board::SimulatedBoard;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

mod common;
use common::simulated_board::{board, refused, rrr, said};
use common::with_model;

/// The protocol of Foxglove's own clients.
const PROTOCOL: &str = "foxglove.sdk.v1";
/// A message with data: its kind, the subscription, the time.
const HEAD_BYTES: usize = 1 + 4 + 8;
const DATA: u8 = 1;

/// A client that subscribes to every channel.
struct Listener {
    socket: WebSocket<TcpStream>,
    /// Topics by subscription.
    topics: BTreeMap<u32, String>,
    /// Schemas by topic.
    schemas: BTreeMap<String, String>,
}

impl Listener {
    fn connect(port: u16) -> Self {
        let mut request = format!("ws://127.0.0.1:{port}").into_client_request().unwrap();
        request.headers_mut().insert("Sec-WebSocket-Protocol", PROTOCOL.parse().unwrap());
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        let (socket, _) = tungstenite::client(request, stream).unwrap();
        Self { socket, topics: BTreeMap::new(), schemas: BTreeMap::new() }
    }

    /// The next sample: its topic and what it holds; none once the server has gone.
    fn next(&mut self) -> Option<(String, Value)> {
        loop {
            match self.socket.read().ok()? {
                Message::Text(text) => self.subscribe(&serde_json::from_str(&text).unwrap()),
                Message::Binary(bytes) if bytes.first() == Some(&DATA) => {
                    let (head, json) = bytes.split_at(HEAD_BYTES);
                    let id = u32::from_le_bytes(head[1..5].try_into().unwrap());
                    let value = serde_json::from_slice(json).unwrap();
                    return Some((self.topics[&id].clone(), value));
                }
                Message::Close(_) => return None,
                _ => {}
            }
        }
    }

    /// Subscribes to what is advertised, each channel by its own number.
    fn subscribe(&mut self, said: &Value) {
        if said["op"] != "advertise" {
            return;
        }
        for channel in said["channels"].as_array().unwrap() {
            let id = channel["id"].as_u64().unwrap();
            let topic = channel["topic"].as_str().unwrap().to_owned();
            self.schemas.insert(topic.clone(), channel["schemaName"].as_str().unwrap().into());
            self.topics.insert(id as u32, topic);
            let wish =
                json!({ "op": "subscribe", "subscriptions": [{ "id": id, "channelId": id }] });
            self.socket.send(Message::text(wish.to_string())).unwrap();
        }
    }
}

/// A log of one joint with so many rows.
fn log(rows: usize) -> Log {
    let joint = JointLog {
        joint: 2,
        position: Position::Radian((0..rows).map(|row| 0.01 * row as f64).collect()),
        command_v: (0..rows).map(|row| row as f64).collect(),
        reference_rad: None,
    };
    Log { time_s: (0..rows).map(|row| 1e-3 * row as f64).collect(), joints: vec![joint] }
}

#[test]
fn a_client_gets_every_sample_once() {
    const ROWS: usize = 3000;
    let mut server = Server::start("127.0.0.1:0", 4096.0).unwrap();
    let mut listener = Listener::connect(server.port());
    let log = log(ROWS);
    let sender = std::thread::spawn(move || {
        // Until the client hears, it is told the first row.
        while !server.is_heard() {
            server.send(&log, &[], 0..1);
            std::thread::sleep(Duration::from_millis(20));
        }
        for row in (1..ROWS).step_by(7) {
            server.send(&log, &[], row..ROWS.min(row + 7));
        }
        server
    });
    let (mut row, mut seen) = (0, 0);
    while row + 1 < ROWS {
        let (topic, sample) = listener.next().unwrap();
        assert_eq!(topic, "/joint2");
        let at = sample["command_V"].as_f64().unwrap() as usize;
        assert!(at == 0 || at == row + 1, "row {at} after {row}");
        if at > 0 {
            assert!((sample["velocity_rad_per_s"].as_f64().unwrap() - 10.0).abs() < 1e-6);
            (row, seen) = (at, seen + 1);
        }
    }
    assert_eq!(seen, ROWS - 1);
    assert_eq!(listener.schemas["/board"], "BoardSample");
    drop(sender.join().unwrap());
    assert!(listener.next().is_none());
}

/// `rrr` beside the test, and the port at which it says that it serves.
fn served(at: &std::path::Path, board: &SimulatedBoard, line: &str) -> (Child, u16) {
    let mut command = Command::new(cargo_bin("rrr"));
    command.current_dir(at).args(line.split(' ')).args(["--port", &board.port()]);
    command.env_remove("RRR_KEY_FILE").stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut program = command.spawn().unwrap();
    let mut lines = BufReader::new(program.stdout.take().unwrap()).lines();
    let address = lines.by_ref().map(Result::unwrap).find(|line| line.contains("ws://"));
    let address = address.expect("it says where it serves");
    // Whatever else it says is read, or it would wait.
    std::thread::spawn(move || lines.for_each(drop));
    (program, address.rsplit_once(':').unwrap().1.parse().unwrap())
}

#[test]
fn a_run_is_seen_as_its_log_holds_it() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    said(at, &board, "upload model.toml");
    let line = "run hold --duration 4 --out logs --foxglove=127.0.0.1:0";
    let (mut run, port) = served(at, &board, line);
    let mut listener = Listener::connect(port);
    let mut seen = BTreeMap::<String, Vec<Value>>::new();
    while let Some((topic, sample)) = listener.next() {
        seen.entry(topic).or_default().push(sample);
    }
    assert!(run.wait().unwrap().success());
    let log = Log::read(at.join("logs/hold.csv.gz")).unwrap();
    for topic in ["/joint1", "/joint2", "/joint3", "/joint1/count", "/board"] {
        let count = seen.get(topic).map_or(0, Vec::len);
        // What came before the client had subscribed is not seen.
        assert!(2 * count > log.len(), "{topic}: {count} of {} samples", log.len());
    }
    for sample in &seen["/joint3"] {
        let t_s = sample["t_s"].as_f64().unwrap();
        let row = log.time_s.iter().position(|time_s| (time_s - t_s).abs() < 1e-6).unwrap();
        assert!(
            (sample["command_V"].as_f64().unwrap() - log.joints[2].command_v[row]).abs() < 1e-5
        );
    }
}

#[test]
fn monitor_serves_every_record_of_a_board_at_rest() {
    let (directory, board) = (with_model(), board());
    let (mut monitor, port) = served(directory.path(), &board, "monitor --foxglove=127.0.0.1:0");
    let mut listener = Listener::connect(port);
    let mut times_s = Vec::new();
    while times_s.len() < 1000 {
        let (topic, sample) = listener.next().unwrap();
        if topic == "/board" {
            times_s.push(sample["t_s"].as_f64().unwrap());
        }
    }
    let tick = |pair: &[f64]| (pair[1] - pair[0] - 1e-3).abs() < 1e-6;
    let gaps = times_s.windows(2).filter(|pair| !tick(pair)).count();
    assert!(gaps < 50, "{gaps} gaps in 1000 records");
    Command::new("kill").args(["-INT", &monitor.id().to_string()]).status().unwrap();
    monitor.wait().unwrap();
}

#[test]
fn an_address_that_is_none_has_words() {
    let (directory, board) = (with_model(), board());
    let line = "monitor --once --foxglove=here";
    let text = refused(rrr(directory.path(), &board.port(), line).assert());
    assert!(text.contains("--foxglove=here: not HOST:PORT"), "{text}");
}
