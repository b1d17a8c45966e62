//! How much memory a piece of work has at its peak.
#![allow(unsafe_code, reason = "an allocator can only be wrapped in unsafe code")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, AtomicIsize, Ordering::Relaxed};

/// The system's allocator, with a look at what is in use while somebody asks.
struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

static ASKED: AtomicBool = AtomicBool::new(false);
static IN_USE: AtomicIsize = AtomicIsize::new(0);
static PEAK: AtomicIsize = AtomicIsize::new(0);

fn grow(bytes: isize) {
    if ASKED.load(Relaxed) {
        let now = IN_USE.fetch_add(bytes, Relaxed) + bytes;
        PEAK.fetch_max(now, Relaxed);
    }
}

// SAFETY: every call goes to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        grow(layout.size().cast_signed());
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        grow(layout.size().cast_signed());
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        grow(-layout.size().cast_signed());
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        grow(size.cast_signed() - layout.size().cast_signed());
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// The most bytes in use at one time during a piece of work, beyond those in use before it.
///
/// A block that grows counts with its new size; where it must move, the old one is there for a moment too.
pub(crate) fn peak<T>(work: impl FnOnce() -> T) -> usize {
    IN_USE.store(0, Relaxed);
    PEAK.store(0, Relaxed);
    ASKED.store(true, Relaxed);
    drop(std::hint::black_box(work()));
    ASKED.store(false, Relaxed);
    PEAK.load(Relaxed).unsigned_abs()
}
