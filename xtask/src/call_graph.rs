//! Which functions of an image can run once one of them is called.

use std::collections::BTreeMap;

use anyhow::{Context, Result, bail};

use crate::code::{Code, Function};
use crate::thumb::Flow;

/// The functions reached from some roots.
#[derive(Debug)]
pub struct Reached {
    /// Each with the call found first; a root with none.
    calls: BTreeMap<u32, Option<Call>>,
}

/// A call or a jump from one function to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call {
    /// Where the calling function begins.
    pub caller: u32,
    /// The address of the instruction.
    pub site: u32,
}

impl Reached {
    /// Follows every call and branch, taken or not, but none out of an `end`. What
    /// cannot be followed is an error, so that nothing is missed.
    pub fn from(roots: &[u32], code: &Code<'_>, end: impl Fn(&Function) -> bool) -> Result<Self> {
        let mut calls: BTreeMap<u32, Option<Call>> =
            roots.iter().map(|&root| (root, None)).collect();
        let mut pending = roots.to_vec();
        while let Some(caller) = pending.pop() {
            if code.function(caller).is_some_and(&end) {
                continue;
            }
            for (site, callee) in callees(code, caller)? {
                calls.entry(callee).or_insert_with(|| {
                    pending.push(callee);
                    Some(Call { caller, site })
                });
            }
        }
        Ok(Self { calls })
    }

    /// The addresses of the functions, roots included.
    pub fn functions(&self) -> impl Iterator<Item = u32> {
        self.calls.keys().copied()
    }

    /// A call that leads to a function; none to a root.
    pub fn call_of(&self, function: u32) -> Option<Call> {
        self.calls.get(&function).copied().flatten()
    }

    /// The functions from a root to this one.
    pub fn path(&self, function: u32) -> Vec<u32> {
        let callers = |&callee: &u32| self.call_of(callee).map(|call| call.caller);
        let mut path: Vec<u32> = std::iter::successors(Some(function), callers).collect();
        path.reverse();
        path
    }
}

/// The other functions that one calls or jumps to, and from where.
fn callees(code: &Code<'_>, caller: u32) -> Result<Vec<(u32, u32)>> {
    let name = code.function(caller).map_or("?", Function::name);
    if let Some(target) = code.bridge(caller) {
        return Ok(vec![(caller, function_at(code, name, caller, target)?)]);
    }
    let mut callees = Vec::new();
    for (site, instruction) in code.instructions(caller)? {
        match instruction.flow {
            Flow::Local => {}
            Flow::Computed => bail!(
                "{name} jumps to a computed address at {site:#x}: where to cannot be told. \
                 Call by name there, not through a pointer"
            ),
            Flow::To(target) => callees.push((site, function_at(code, name, site, target)?)),
        }
    }
    callees.retain(|&(_, callee)| callee != caller);
    Ok(callees)
}

fn function_at(code: &Code<'_>, name: &str, site: u32, target: u32) -> Result<u32> {
    code.function_at(target)
        .with_context(|| format!("{name} jumps at {site:#x} to {target:#x}, where no function is"))
}

#[cfg(test)]
mod tests;
