//! What a handler takes at most, by every path through it and through all that it calls:
//! instructions, cycles and stack.
//!
//! The longest path over the control-flow graph of the linked image, loops gone round as often as
//! [`loops`] says. Paths that exclude each other are not told apart, so the bound lies above
//! anything that can happen.

mod cost;
mod function;
mod graph;
mod loops;
mod step;

use std::collections::BTreeMap;

use anyhow::{Context, Result, bail};

pub use cost::Cost;

use crate::code::Code;
use function::Body;

/// Bytes of stack that `memcpy` and its like take at most.
const COPY_STACK: u64 = 64;

/// What a function takes at most, callees included.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bound {
    /// Instructions and cycles.
    pub cost: Cost,
    /// Bytes of stack.
    pub stack: u64,
}

/// Bounds of functions, each found once.
pub struct Bounds<'a, 'data> {
    code: &'a Code<'data>,
    /// Functions that are left out, and told apart.
    apart: &'a [&'a str],
    known: BTreeMap<u32, Bound>,
    open: Vec<u32>,
}

impl<'a, 'data> Bounds<'a, 'data> {
    /// Over an image; functions whose names contain one of `apart` cost nothing where they are called.
    pub fn new(code: &'a Code<'data>, apart: &'a [&'a str]) -> Self {
        Self { code, apart, known: BTreeMap::new(), open: Vec::new() }
    }

    /// The bound of the function that begins at an address.
    ///
    /// # Errors
    /// It calls itself, jumps where nobody knows, or has a loop without a bound.
    pub fn of(&mut self, start: u32) -> Result<Bound> {
        if let Some(bound) = self.known.get(&start) {
            return Ok(*bound);
        }
        let name = self.code.function(start).map_or("?", |f| f.name()).to_owned();
        if self.open.contains(&start) {
            bail!("{name} calls itself");
        }
        self.open.push(start);
        let bound = self.of_body(start, &name).with_context(|| format!("in {name}"))?;
        self.open.pop();
        self.known.insert(start, bound);
        Ok(bound)
    }

    fn of_body(&mut self, start: u32, name: &str) -> Result<Bound> {
        let mut body = Body::read(self.code, start)?;
        let mut deepest = body.deepest;
        for (site, callee, below) in body.calls.clone() {
            let entry = self.code.function_at(callee).context("a call leads to no function")?;
            if self.is_apart(entry) {
                continue;
            }
            let bound = match self.code.function(entry).is_some_and(|f| f.is_called(loops::is_copy))
            {
                true => Bound { cost: loops::copy(name), stack: COPY_STACK },
                false => self.of(entry)?,
            };
            deepest = deepest.max(below + bound.stack);
            if let Some(cost) = body.graph.cost.get_mut(&site) {
                *cost = cost.then(bound.cost);
            }
        }
        let mut heads = Vec::new();
        body.graph.longest(start, &mut |head, depth| {
            heads.push((head, depth));
            Ok(1)
        })?;
        let mut rounds = |head, _| loops::rounds(self.code, name, start, &heads, head);
        let cost = body.graph.longest(start, &mut rounds)?;
        Ok(Bound { cost, stack: deepest })
    }

    fn is_apart(&self, entry: u32) -> bool {
        let name = self.code.function(entry).map_or("", |f| f.name());
        self.apart.iter().any(|part| name.contains(part))
    }
}

/// Parts of the tick that come now and then, or end it: what they take is told apart.
const APART: [(&str, &str); 9] = [
    ("answer_to", "an order, a question, a new controller"),
    ("check_parameters_now", "a part of the parameters against its checksum"),
    ("Converter::watch", "a register of the converter read back, every 16 ms"),
    ("latch_anew", "a fault kept for the next boot"),
    ("first_fault", "a closer look at the joints"),
    ("first_board_fault", "a closer look at the board"),
    ("enter_joint_fault", "the figures of a joint's fault"),
    ("enter_fault", "a fault"),
    ("prepare_late", "a tick that was not prepared; none in this image"),
];

/// Prints what a handler takes at most, by its parts.
///
/// # Errors
/// There is no such handler, or no bound.
pub fn report(code: &Code<'_>, handler: &'static str) -> Result<()> {
    let apart = APART.map(|(name, _)| name);
    let starts = |part: &str| {
        let is_it = |name: &str| name.contains(part) && !name.starts_with("__Thumb");
        let found = code.functions().find(|(_, f)| f.names.iter().any(|name| is_it(name)));
        found.map(|(start, _)| start)
    };
    let start = starts(handler).context("the handler is not in the image")?;
    println!(
        "{:56} {:>12} {:>8} {:>6}",
        "at most, by every path", "instructions", "cycles", "stack"
    );
    print(&format!("{handler}, each tick"), Bounds::new(code, &apart).of(start)?);
    for (name, what) in &APART {
        let Some(start) = starts(name) else { continue };
        // What is left out in it has its own line.
        let others: Vec<&str> = apart.iter().copied().filter(|part| part != name).collect();
        print(&format!("and {what}"), Bounds::new(code, &others).of(start)?);
    }
    Ok(())
}

fn print(what: &str, bound: Bound) {
    let Bound { cost, stack } = bound;
    println!("{what:56} {:12} {:8} {stack:6}", cost.instructions, cost.cycles);
}
