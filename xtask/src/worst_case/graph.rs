//! The longest path through a function, its loops gone round as often as they can be.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, Result, bail};

use super::cost::Cost;

/// Places of a function: what each costs, and which may follow.
pub struct Graph {
    /// The cost of each place.
    pub cost: BTreeMap<u32, Cost>,
    /// Places that may follow it.
    pub next: BTreeMap<u32, Vec<u32>>,
}

impl Graph {
    /// The longest path from `start`; `rounds` tells how often the loop
    /// at a place is gone round, by the loops that it is in.
    ///
    /// # Errors
    /// A loop without a bound.
    pub fn longest(
        &self,
        start: u32,
        rounds: &mut dyn FnMut(u32, usize) -> Result<u64>,
    ) -> Result<Cost> {
        let all: BTreeSet<u32> = self.cost.keys().copied().collect();
        self.longest_within(&all, &BTreeSet::from([start]), &BTreeSet::new(), rounds)
    }

    /// The longest path that begins at one of `starts`, stays among `places` and never enters one of
    /// `heads` again.
    fn longest_within(
        &self,
        places: &BTreeSet<u32>,
        starts: &BTreeSet<u32>,
        heads: &BTreeSet<u32>,
        rounds: &mut dyn FnMut(u32, usize) -> Result<u64>,
    ) -> Result<Cost> {
        let follow = |place: u32| self.following(place, places, heads);
        let components = components(places, &follow);
        // Of each component the longest path from it on; later ones come first.
        let mut from: BTreeMap<u32, Cost> = BTreeMap::new();
        for component in &components {
            let onward = component.iter().flat_map(|place| follow(*place));
            let outside = onward.filter(|place| !component.contains(place));
            let best = outside.map(|place| from[&place]).fold(Cost::default(), Cost::or);
            let own = self.of_component(component, places, starts, heads, rounds)?;
            component.iter().for_each(|place| {
                from.insert(*place, own.then(best));
            });
        }
        Ok(starts.iter().filter_map(|s| from.get(s)).copied().fold(Cost::default(), Cost::or))
    }

    fn following(&self, place: u32, among: &BTreeSet<u32>, heads: &BTreeSet<u32>) -> Vec<u32> {
        let next = self.next.get(&place).into_iter().flatten().copied();
        next.filter(|place| among.contains(place) && !heads.contains(place)).collect()
    }

    /// A place, or a loop with all its rounds.
    fn of_component(
        &self,
        component: &BTreeSet<u32>,
        places: &BTreeSet<u32>,
        starts: &BTreeSet<u32>,
        heads: &BTreeSet<u32>,
        rounds: &mut dyn FnMut(u32, usize) -> Result<u64>,
    ) -> Result<Cost> {
        let first = *component.first().context("a component has a place")?;
        let is_loop = component.len() > 1 || self.following(first, places, heads).contains(&first);
        if !is_loop {
            return Ok(self.cost[&first]);
        }
        // Where it is entered: from outside, or at the beginning.
        let entered = |place: &&u32| {
            let from_outside = |before: &u32| {
                !component.contains(before)
                    && self.next.get(before).is_some_and(|n| n.contains(place))
            };
            starts.contains(place) || places.iter().any(from_outside)
        };
        let entries: BTreeSet<u32> = component.iter().filter(entered).copied().collect();
        if entries.is_empty() {
            bail!("the loop at {first:#x} is entered nowhere");
        }
        // Each loop around this one has closed its head.
        let times = rounds(*entries.first().unwrap_or(&first), heads.len())?;
        let closed: BTreeSet<u32> = heads.union(&entries).copied().collect();
        Ok(self.longest_within(component, &entries, &closed, rounds)?.times(times))
    }
}

/// Strongly connected components, those that others lead to first (Tarjan).
fn components(places: &BTreeSet<u32>, next: &dyn Fn(u32) -> Vec<u32>) -> Vec<BTreeSet<u32>> {
    let mut search = Search::new(next);
    for place in places {
        if !search.index.contains_key(place) {
            search.visit(*place);
        }
    }
    search.found
}

struct Search<'a> {
    next: &'a dyn Fn(u32) -> Vec<u32>,
    index: BTreeMap<u32, usize>,
    low: BTreeMap<u32, usize>,
    open: Vec<u32>,
    found: Vec<BTreeSet<u32>>,
}

impl<'a> Search<'a> {
    fn new(next: &'a dyn Fn(u32) -> Vec<u32>) -> Self {
        let (index, low) = (BTreeMap::new(), BTreeMap::new());
        Self { next, index, low, open: Vec::new(), found: Vec::new() }
    }

    /// Depth first, with a stack of its own: functions have thousands of places.
    fn visit(&mut self, root: u32) {
        let mut path = vec![(root, self.begin(root), 0)];
        while let Some((place, next, done)) = path.pop() {
            if let Some(&other) = next.get(done) {
                path.push((place, next, done + 1));
                if !self.index.contains_key(&other) {
                    let following = self.begin(other);
                    path.push((other, following, 0));
                } else if self.open.contains(&other) {
                    self.lower(place, self.index[&other]);
                }
                continue;
            }
            if self.low[&place] == self.index[&place] {
                self.close(place);
            }
            if let Some((before, ..)) = path.last() {
                let (before, low) = (*before, self.low[&place]);
                self.lower(before, low);
            }
        }
    }

    fn begin(&mut self, place: u32) -> Vec<u32> {
        let number = self.index.len();
        self.index.insert(place, number);
        self.low.insert(place, number);
        self.open.push(place);
        (self.next)(place)
    }

    fn lower(&mut self, place: u32, to: usize) {
        let low = self.low.entry(place).or_insert(to);
        *low = (*low).min(to);
    }

    fn close(&mut self, root: u32) {
        let mut component = BTreeSet::new();
        while let Some(place) = self.open.pop() {
            component.insert(place);
            if place == root {
                break;
            }
        }
        self.found.push(component);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places 1 to n of one instruction each.
    fn graph(edges: &[(u32, u32)], places: u32) -> Graph {
        let one = Cost { instructions: 1, cycles: 2 };
        let cost = (1..=places).map(|place| (place, one)).collect();
        let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        edges.iter().for_each(|(from, to)| next.entry(*from).or_default().push(*to));
        Graph { cost, next }
    }

    fn longest(graph: &Graph, rounds: u64) -> u64 {
        graph.longest(1, &mut |_, _| Ok(rounds)).unwrap().instructions
    }

    #[test]
    fn of_two_ways_the_longer_counts() {
        assert_eq!(longest(&graph(&[(1, 2), (1, 3), (2, 4), (3, 5), (5, 4)], 5), 0), 4);
    }

    #[test]
    fn loops_in_loops_multiply() {
        // 1, then (2 (3)* 4)*, then 5.
        let nested = graph(&[(1, 2), (2, 3), (3, 3), (3, 4), (4, 2), (4, 5)], 5);
        assert_eq!(longest(&nested, 10), 1 + 10 * (1 + 10 + 1) + 1);
    }

    #[test]
    fn a_loop_without_a_bound_is_told() {
        let endless = graph(&[(1, 1)], 1);
        assert!(endless.longest(1, &mut |_, _| bail!("no bound")).is_err());
    }
}
