//! A number that counts what is done with it.

use crate::math::Real;
use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

thread_local! {
    static DONE: Cell<u64> = const { Cell::new(0) };
}

/// A double that counts operations of its thread: one for +, -, *, /, the root, the exponential and the logarithm, two for a
/// multiply-add, none for signs, comparisons and choices.
#[derive(Clone, Copy, Debug)]
pub struct Counted(f64);

impl Counted {
    /// Operations on this thread while `work` runs.
    pub fn during(work: impl FnOnce()) -> u64 {
        let before = DONE.get();
        work();
        DONE.get() - before
    }

    fn after(x: f64, operations: u64) -> Self {
        DONE.set(DONE.get() + operations);
        Self(x)
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $op:tt),*) => {$(
        impl $trait for Counted {
            type Output = Self;
            fn $name(self, o: Self) -> Self {
                Self::after(self.0 $op o.0, 1)
            }
        }
    )*};
}
operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Counted {
    type Mask = bool;
    fn of(x: f64) -> Self {
        Self(x)
    }
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self::after(self.0 * a.0 + b.0, 2)
    }
    fn sqrt(self) -> Self {
        Self::after(self.0.sqrt(), 1)
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn exp(self) -> Self {
        Self::after(self.0.exp(), 1)
    }
    fn ln(self) -> Self {
        Self::after(self.0.ln(), 1)
    }
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}
