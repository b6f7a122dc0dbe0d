//! How much memory the program holds: the allocator of the system, counted. `main.rs` installs it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Bytes held now.
static NOW: AtomicUsize = AtomicUsize::new(0);
/// Most bytes held since the last [`restart`].
static PEAK: AtomicUsize = AtomicUsize::new(0);

/// The allocator of the system, which also counts.
#[derive(Clone, Copy, Debug)]
pub struct Counting;

fn grown(bytes: usize) {
    let now = NOW.fetch_add(bytes, Relaxed) + bytes;
    PEAK.fetch_max(now, Relaxed);
}

fn shrunk(bytes: usize) {
    NOW.fetch_sub(bytes, Relaxed);
}

// SAFETY: every call is handed on to the system as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        grown(layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        grown(layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if size > layout.size() {
            grown(size - layout.size());
        } else {
            shrunk(layout.size() - size);
        }
        // SAFETY: the caller's promise.
        unsafe { System.realloc(at, layout, size) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        shrunk(layout.size());
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(at, layout) }
    }
}

/// Bytes held now; the peak begins anew.
pub(crate) fn restart() -> usize {
    let now = NOW.load(Relaxed);
    PEAK.store(now, Relaxed);
    now
}

/// Most bytes held since [`restart`]; `None` in a program with another allocator.
pub(crate) fn peak() -> Option<usize> {
    Some(PEAK.load(Relaxed)).filter(|&peak| peak > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    // The allocator of the tests is another, so only this test counts.
    #[test]
    fn the_peak_is_what_was_held_at_once() {
        let layout = |size| Layout::from_size_align(size, 8).unwrap();
        let before = restart();
        // SAFETY: sizes are not zero, and every block is given back with the layout it has.
        unsafe {
            let a = Counting.alloc(layout(1000));
            let a = Counting.realloc(a, layout(1000), 3000);
            let b = Counting.alloc_zeroed(layout(500));
            Counting.dealloc(b, layout(500));
            let a = Counting.realloc(a, layout(3000), 10);
            assert_eq!(NOW.load(Relaxed) - before, 10);
            Counting.dealloc(a, layout(10));
        }
        assert_eq!((peak(), NOW.load(Relaxed)), (Some(before + 3500), before));
    }
}
