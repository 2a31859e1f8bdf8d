//! Which functions of an image can run once one of them is called.

use std::collections::BTreeMap;

use anyhow::{Context, Result, bail};

use crate::code::Code;
use crate::thumb::Flow;

/// The functions reached from some roots.
#[derive(Debug)]
pub struct Reached {
    /// Each with the function that led to it; a root with itself.
    callers: BTreeMap<u32, u32>,
}

impl Reached {
    /// Follows every call and branch, taken or not. What cannot be followed is an
    /// error, so that nothing is missed.
    pub fn from(roots: &[u32], code: &Code<'_>) -> Result<Self> {
        let mut callers: BTreeMap<u32, u32> = roots.iter().map(|&root| (root, root)).collect();
        let mut pending = roots.to_vec();
        while let Some(caller) = pending.pop() {
            for callee in callees(code, caller)? {
                callers.entry(callee).or_insert_with(|| {
                    pending.push(callee);
                    caller
                });
            }
        }
        Ok(Self { callers })
    }

    /// The addresses of the functions, roots included.
    pub fn functions(&self) -> impl Iterator<Item = u32> {
        self.callers.keys().copied()
    }

    /// The way from a root to a function.
    pub fn path(&self, to: u32) -> Vec<u32> {
        let mut path = vec![to];
        while let Some(&caller) = path.last().and_then(|last| self.callers.get(last)) {
            if path.contains(&caller) {
                break;
            }
            path.push(caller);
        }
        path.reverse();
        path
    }
}

/// The other functions that one calls or jumps to.
fn callees(code: &Code<'_>, caller: u32) -> Result<Vec<u32>> {
    let name = code.function(caller).map_or("?", |function| function.name());
    let mut callees = Vec::new();
    for (address, instruction) in code.instructions(caller)? {
        match instruction.flow {
            Flow::Local => {}
            Flow::Computed => bail!(
                "{name} jumps to a computed address at {address:#x}: where to cannot be told. \
                 Call by name there, not through a pointer"
            ),
            Flow::To(target) => callees.push(code.function_at(target).with_context(|| {
                format!("{name} jumps at {address:#x} to {target:#x}, where no function is")
            })?),
        }
    }
    callees.retain(|&callee| callee != caller);
    Ok(callees)
}

#[cfg(test)]
mod tests;
