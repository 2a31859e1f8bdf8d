//! The serial line under load.
#![allow(missing_docs)]

mod common;

use common::{board_alone, done, image};
use firmware::link::Command;

#[test]
fn a_request_at_any_instant_is_answered_while_telemetry_flows() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    board.run_ms(50).unwrap();
    assert!(board.hello().unwrap());
    done(&mut board, Command::Stream { on: true });
    let mut state = 1_u64;
    for request in 0..2000 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let pause = (state >> 33) % 600_000;
        let end = board.machine.board().now + pause;
        board.machine.run_until(end).unwrap();
        let answer = board.ask(Command::Query).unwrap();
        if answer != Some(Ok(())) {
            let b = board.machine.board();
            println!("{request} {answer:?} now {} {:?}\n{:?}\n{:?}\n{:?}", b.now, b.lpuart, b.dma, b.nvic, b.tim5);
        }
        assert_eq!(answer, Some(Ok(())), "request {request}");
    }
}
