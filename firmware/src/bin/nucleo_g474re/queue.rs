//! A queue between the tick and a task, without a lock, a wait or a way to panic.
//!
//! One end puts in, the other takes out. Its length is a power of two, so that a place is found by
//! masking: the library's queue divides by a length that the compiler cannot tell from zero.

use core::cell::UnsafeCell;
use core::mem::MaybeUninit;
use core::sync::atomic::AtomicU32;
use core::sync::atomic::Ordering::{Acquire, Relaxed, Release};

/// Room for N things, a power of two.
pub struct Queue<T, const N: usize> {
    slots: [UnsafeCell<MaybeUninit<T>>; N],
    /// Things put in and taken out so far, wrapping.
    put: AtomicU32,
    taken: AtomicU32,
}

// SAFETY: a slot belongs to the end that the two counters give it to.
unsafe impl<T: Send, const N: usize> Sync for Queue<T, N> {}

/// The end that puts in.
pub struct Producer<T: 'static, const N: usize>(&'static Queue<T, N>);
/// The end that takes out.
pub struct Consumer<T: 'static, const N: usize>(&'static Queue<T, N>);

impl<T, const N: usize> Queue<T, N> {
    const MASK: usize = {
        assert!(N.is_power_of_two());
        N - 1
    };

    /// An empty queue.
    pub const fn new() -> Self {
        Self {
            slots: [const { UnsafeCell::new(MaybeUninit::uninit()) }; N],
            put: AtomicU32::new(0),
            taken: AtomicU32::new(0),
        }
    }

    /// Its two ends.
    pub fn split(&'static mut self) -> (Producer<T, N>, Consumer<T, N>) {
        (Producer(self), Consumer(self))
    }
}

impl<T, const N: usize> Producer<T, N> {
    /// Puts a thing in; false where there is no room.
    #[inline]
    pub fn enqueue(&mut self, thing: T) -> bool {
        let put = self.0.put.load(Relaxed);
        if put.wrapping_sub(self.0.taken.load(Acquire)) as usize >= N {
            return false;
        }
        let slot = self.0.slots[put as usize & Queue::<T, N>::MASK].get();
        // SAFETY: the slot is free until `put` says otherwise, and no other producer is there.
        unsafe { (*slot).write(thing) };
        self.0.put.store(put.wrapping_add(1), Release);
        true
    }
}

impl<T, const N: usize> Consumer<T, N> {
    /// Takes the oldest thing out.
    #[inline]
    pub fn dequeue(&mut self) -> Option<T> {
        let taken = self.0.taken.load(Relaxed);
        if taken == self.0.put.load(Acquire) {
            return None;
        }
        let slot = self.0.slots[taken as usize & Queue::<T, N>::MASK].get();
        // SAFETY: the slot was filled, and is not filled again until `taken` says so.
        let thing = unsafe { (*slot).assume_init_read() };
        self.0.taken.store(taken.wrapping_add(1), Release);
        Some(thing)
    }
}
