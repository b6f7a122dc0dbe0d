//! Where the numbers of a record stand in memory, so that chunks can be read and written from several threads.

use crate::field::{Quantity, Record, Sink, Source};
use crate::math::{Element, Lanes, MOST_LANES, prefetch};
use crate::run::MAX_WORDS;

/// A pointer that threads share. Sound because every thread writes its own chunk only, and what a pair sum reads of others is not
/// written meanwhile.
#[derive(Debug)]
pub struct Shared<E>(*mut E);

impl<E> Clone for Shared<E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E> Copy for Shared<E> {}

// SAFETY: see above; each use states which elements it touches.
unsafe impl<E> Send for Shared<E> {}
// SAFETY: as above.
unsafe impl<E> Sync for Shared<E> {}

impl<E> Shared<E> {
    /// Shares a slice.
    pub fn new(slice: &mut [E]) -> Self {
        Self(slice.as_mut_ptr())
    }

    /// # Safety
    /// `i` is inside the slice, which outlives the reference, and nobody else touches element `i` meanwhile.
    #[inline(always)]
    pub unsafe fn get_mut<'a>(self, i: usize) -> &'a mut E {
        // SAFETY: the caller's promise.
        unsafe { &mut *self.0.add(i) }
    }

    /// # Safety
    /// `i` is inside the slice, or one past its end.
    #[inline(always)]
    pub unsafe fn from(self, i: usize) -> *mut E {
        // SAFETY: the caller's promise.
        unsafe { self.0.add(i) }
    }

    /// # Safety
    /// `i` is inside the slice, and no other thread touches element `i` meanwhile.
    #[inline(always)]
    pub unsafe fn set(self, i: usize, x: E) {
        // SAFETY: the caller's promise.
        unsafe { self.0.add(i).write(x) }
    }
}

/// What a pair sum reads: columns of one precision.
#[derive(Clone, Copy, Debug)]
pub struct PairPlaces<E> {
    columns: [Shared<E>; MAX_WORDS],
    len: usize,
}

impl<E: Element> PairPlaces<E> {
    /// The columns of record `R`; `column(field, word)` says where each starts.
    pub fn of<R: Record<D>, const D: usize>(mut column: impl FnMut(Quantity, usize) -> *mut E) -> Self {
        let mut new = Self { columns: [Shared(std::ptr::null_mut()); MAX_WORDS], len: 0 };
        for &field in R::FIELDS {
            for word in 0..field.rank().words(D) {
                new.push(column(field, word));
            }
        }
        new
    }

    /// Adds a column.
    pub fn push(&mut self, column: *mut E) {
        assert!(self.len < MAX_WORDS, "a record of {} numbers is too wide", self.len + 1);
        self.columns[self.len] = Shared(column);
        self.len += 1;
    }

    /// Asks for the numbers of particle `a`, and of those in the same cache lines.
    #[inline(always)]
    pub fn fetch(&self, a: usize) {
        for column in &self.columns[..self.len] {
            prefetch(column.0.wrapping_add(a));
        }
    }

    /// How many numbers.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Number `k` of particle `a`.
    ///
    /// # Safety
    /// `a` is a particle, and `k` is below the width of the record.
    #[inline(always)]
    pub unsafe fn from(&self, k: usize, a: usize) -> *const E {
        // SAFETY: the caller's promise.
        unsafe { self.columns.get_unchecked(k).from(a) }
    }

    /// The same record elsewhere: column `k` starts at `first + k * stride` of a buffer.
    ///
    /// # Safety
    /// The buffer holds that many columns, with room for lanes before and after each.
    pub unsafe fn elsewhere(&self, first: *mut E, stride: usize) -> Self {
        let mut moved = *self;
        for k in 0..self.len {
            // SAFETY: the caller's promise.
            moved.columns[k] = Shared(unsafe { first.add(k * stride) });
        }
        moved
    }

    /// Column `k` of `len` particles.
    ///
    /// # Safety
    /// The column is that long, and nobody writes it meanwhile.
    pub unsafe fn column(&self, k: usize, len: usize) -> &[E] {
        // SAFETY: the caller's promise.
        unsafe { std::slice::from_raw_parts(self.columns[k].0, len) }
    }
}

/// Consecutive particles from this one on, in the lanes of a pair sum.
pub struct Row<'a, E>(pub &'a PairPlaces<E>, pub isize);

impl<V: Lanes> Source<V> for Row<'_, V::E> {
    #[inline(always)]
    fn get(&self, k: usize) -> V {
        // SAFETY: particles and guard are readable around every particle, and `k` is below the width of the record.
        unsafe { V::load(self.0.columns.get_unchecked(k).0.offset(self.1)) }
    }
}

/// Where one number of a particle lives.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// In double precision, or null.
    pub double: *mut f64,
    /// In single precision, or null.
    pub single: *mut f32,
    /// Whether it is read at the home of the particles.
    pub shared: bool,
}

/// What an update reads or writes. In a double run all columns are double; in a single run state is double (and single beside it, where
/// pair sums read it), everything else single.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    columns: [Column; MAX_WORDS],
    len: usize,
}

// SAFETY: as `Shared`.
unsafe impl Send for Places {}
// SAFETY: as `Shared`.
unsafe impl Sync for Places {}

impl Places {
    /// The columns of record `R`.
    pub fn of<R: Record<D>, const D: usize>(mut column: impl FnMut(Quantity, usize) -> Column) -> Self {
        assert!(R::WORDS <= MAX_WORDS, "a record of {} numbers is too wide", R::WORDS);
        let nowhere = Column { double: std::ptr::null_mut(), single: std::ptr::null_mut(), shared: false };
        let mut columns = [nowhere; MAX_WORDS];
        let mut k = 0;
        for &field in R::FIELDS {
            for word in 0..field.rank().words(D) {
                columns[k] = column(field, word);
                k += 1;
            }
        }
        Self { columns, len: k }
    }
}

/// Columns that are asked for ahead of time.
#[derive(Debug)]
pub struct Fetching {
    /// Where each starts, and how long a number is.
    columns: [(*const u8, usize); 4 * MAX_WORDS],
    len: usize,
}

// SAFETY: addresses of what is only asked for, never read.
unsafe impl Sync for Fetching {}

impl Fetching {
    /// The columns of these records, single ones and double ones, but those that are read at the home of a block: they are near already.
    pub fn of(records: [&Places; 2]) -> Self {
        let mut new = Self { columns: [(std::ptr::null(), 0); 4 * MAX_WORDS], len: 0 };
        let columns = records.iter().flat_map(|record| &record.columns[..record.len]);
        for column in columns.filter(|column| !column.shared) {
            let double = (column.double.cast_const().cast::<u8>(), size_of::<f64>());
            let single = (column.single.cast_const().cast::<u8>(), size_of::<f32>());
            for one in [double, single] {
                if !one.0.is_null() {
                    new.columns[new.len] = one;
                    new.len += 1;
                }
            }
        }
        new
    }

    /// Asks for the numbers of particle `a`, and of those in the same cache lines, in part `part` of `parts` of the columns.
    #[inline(always)]
    pub fn fetch(&self, a: usize, (part, parts): (usize, usize)) {
        let mut k = part;
        while k < self.len {
            let (start, size) = self.columns[k];
            prefetch(start.wrapping_add(a * size));
            k += parts;
        }
    }
}

/// Consecutive particles: `count` of them from `first` on. What they share with those from `home` on, bit by bit, is read there, where it
/// is still in the first cache (see [`super::homes`]).
#[derive(Clone, Copy, Debug)]
pub struct Span {
    pub first: usize,
    pub home: usize,
    pub count: usize,
}

impl Span {
    /// Particles that share nothing with others.
    #[inline(always)]
    pub const fn new(first: usize, count: usize) -> Self {
        Self { first, home: first, count }
    }
}

/// The numbers of some consecutive particles, as many as an update has lanes or fewer. `MIXED` says whether columns may be single.
pub struct Some<'a, const MIXED: bool> {
    pub places: &'a Places,
    pub span: Span,
}

// SAFETY of the blocks below: whoever makes a `Some` has checked that the particles exist and belong to the chunk of this
// thread; `k` is below the width of the record the places were made for; of a column that is not double the single one exists.
impl<U: Lanes<E = f64>, const MIXED: bool> Source<U> for Some<'_, MIXED> {
    #[inline(always)]
    fn get(&self, k: usize) -> U {
        unsafe {
            let column = self.places.columns.get_unchecked(k);
            let single = MIXED && column.double.is_null();
            let first = if column.shared { self.span.home } else { self.span.first };
            if self.span.count == U::N {
                return if single {
                    U::load_single(column.single.add(first))
                } else {
                    U::load(column.double.add(first))
                };
            }
            let mut lanes = [0.0; MOST_LANES];
            for (l, lane) in lanes.iter_mut().enumerate().take(U::N) {
                let a = first + if l < self.span.count { l } else { 0 };
                *lane =
                    if single { f64::from(column.single.add(a).read()) } else { column.double.add(a).read() };
            }
            U::load(lanes.as_ptr())
        }
    }
}

impl<U: Lanes<E = f64>, const MIXED: bool> Sink<U> for Some<'_, MIXED> {
    #[inline(always)]
    fn put(&mut self, k: usize, x: U) {
        unsafe {
            let column = self.places.columns.get_unchecked(k);
            let Span { first, count, .. } = self.span;
            if count == U::N {
                if !MIXED || !column.double.is_null() {
                    x.store(column.double.add(first));
                }
                if MIXED && !column.single.is_null() {
                    x.store_single(column.single.add(first));
                }
                return;
            }
            let mut lanes = [0.0; MOST_LANES];
            x.store(lanes.as_mut_ptr());
            for (l, &value) in lanes.iter().enumerate().take(count) {
                if !column.double.is_null() {
                    column.double.add(first + l).write(value);
                }
                if MIXED && !column.single.is_null() {
                    column.single.add(first + l).write(value as f32);
                }
            }
        }
    }
}
