//! A function's places, what follows each, what it calls and how far its stack goes down.

use std::collections::BTreeMap;

use anyhow::{Result, bail};

use super::cost::Cost;
use super::graph::Graph;
use super::step::{Next, Step, step};
use crate::code::Code;

/// A function as the bound sees it.
pub struct Body {
    /// Its places.
    pub graph: Graph,
    /// Calls and jumps out: the place, where to, bytes of stack in use there.
    pub calls: Vec<(u32, u32, u64)>,
    /// Most bytes of stack of its own.
    pub deepest: u64,
}

impl Body {
    /// Follows every way from the first instruction on.
    ///
    /// # Errors
    /// It jumps where nobody knows.
    pub fn read(code: &Code<'_>, start: u32) -> Result<Self> {
        let mut body = Self {
            graph: Graph { cost: BTreeMap::new(), next: BTreeMap::new() },
            calls: Vec::new(),
            deepest: 0,
        };
        if let Some(target) = code.bridge(start) {
            body.graph.cost.insert(start, Cost { instructions: 3, cycles: 5 });
            body.calls.push((start, target, 0));
            return Ok(body);
        }
        // Instructions left in an IT block, bytes on the stack.
        let mut pending = vec![(start, 0_u32, 0_i64)];
        while let Some((at, in_block, depth)) = pending.pop() {
            if body.graph.cost.contains_key(&at) {
                continue;
            }
            let step = step(code, at, in_block > 0)?;
            let depth = depth + step.pushes;
            body.deepest = body.deepest.max(depth.max(0) as u64);
            let left = if_then(code, at).unwrap_or(in_block.saturating_sub(1));
            for next in body.follow(code, start, &step, in_block > 0, depth)? {
                pending.push((next, if next == at + step.length { left } else { 0 }, depth));
            }
        }
        Ok(body)
    }

    /// Notes a place; the places within the function that may follow it.
    fn follow(
        &mut self,
        code: &Code<'_>,
        start: u32,
        step: &Step,
        conditional: bool,
        depth: i64,
    ) -> Result<Vec<u32>> {
        self.graph.cost.insert(step.at, Cost { instructions: 1, cycles: step.cycles });
        let on = step.at + step.length;
        let mut next = match &step.next {
            Next::On => vec![on],
            Next::Call { .. } => vec![on],
            Next::Jump { to, conditional: true } => vec![*to, on],
            Next::Jump { to, .. } => vec![*to],
            Next::Table { to } => to.clone(),
            Next::Return | Next::Trap if conditional => vec![on],
            Next::Return | Next::Trap => Vec::new(),
            Next::Unknown => bail!("a jump to a computed address at {:#x}", step.at),
        };
        if let Next::Call { to } = step.next {
            self.calls.push((step.at, to, depth.max(0) as u64));
        }
        next.retain(|&to| {
            let is_own = code.function_at(to) == Some(start);
            if !is_own {
                self.calls.push((step.at, to, depth.max(0) as u64));
            }
            is_own
        });
        self.graph.next.insert(step.at, next.clone());
        Ok(next)
    }
}

/// Instructions in the block that an IT begins.
fn if_then(code: &Code<'_>, at: u32) -> Option<u32> {
    let first = code.halfword(at)?;
    (first & 0xff00 == 0xbf00 && first & 0xf != 0).then(|| 4 - (first & 0xf).trailing_zeros())
}
