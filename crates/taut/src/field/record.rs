//! Records: the few fields that a pass reads or writes, as one struct generic in the number.

use super::{Quantity, Sink, Source};
use crate::math::Real;

/// A list of fields, as the type that a pass names. `Of<S>` is the struct a pass sees.
pub trait Record<const D: usize> {
    /// The struct, in numbers `S`.
    type Of<S: Real>: Copy;
    /// The fields, in the order of their numbers.
    const FIELDS: &'static [Quantity];
    /// How many numbers.
    const WORDS: usize;
    /// Reads the record.
    fn read<S: Real>(from: &impl Source<S>) -> Self::Of<S>;
    /// Writes the record.
    fn write<S: Real>(record: Self::Of<S>, to: &mut impl Sink<S>);
    /// All numbers zero.
    fn nought<S: Real>() -> Self::Of<S>;
}

/// What record `R` looks like in numbers `S`.
pub type Of<R, S, const D: usize> = <R as Record<D>>::Of<S>;

/// The empty record.
impl<const D: usize> Record<D> for () {
    type Of<S: Real> = ();
    const FIELDS: &'static [Quantity] = &[];
    const WORDS: usize = 0;
    #[inline(always)]
    fn read<S: Real>(_: &impl Source<S>) {}
    #[inline(always)]
    fn write<S: Real>((): (), _: &mut impl Sink<S>) {}
    #[inline(always)]
    fn nought<S: Real>() {}
}

/// Declares a record: `record! { /// doc  Motion { v: Velocity, p: Pressure } }` gives the struct `Motion<S, D>`
/// and makes `Motion<f64, D>` its [`Record`].
#[macro_export]
macro_rules! record {
    ($($(#[$doc:meta])* $name:ident { $($field:ident: $quantity:ident),+ $(,)? })+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[allow(missing_docs, reason = "each field is an entry of the glossary")]
        pub struct $name<S: $crate::math::Real, const D: usize> {
            $(pub $field: $crate::field::In<$crate::field::$quantity, S, D>,)+
        }

        impl<const D: usize> $crate::field::Record<D> for $name<f64, D> {
            type Of<S: $crate::math::Real> = $name<S, D>;
            const FIELDS: &'static [$crate::field::Quantity] =
                &[$(<$crate::field::$quantity as $crate::field::Field>::ID),+];
            const WORDS: usize = 0 $(+ <$crate::field::$quantity as $crate::field::Field>::ID.rank().words(D))+;

            #[inline(always)]
            #[allow(unused_assignments, reason = "the place after the last field is not read")]
            fn read<S: $crate::math::Real>(from: &impl $crate::field::Source<S>) -> $name<S, D> {
                let mut at = 0;
                $(
                    let $field = $crate::field::Value::read(from, at);
                    at += <$crate::field::$quantity as $crate::field::Field>::ID.rank().words(D);
                )+
                $name { $($field),+ }
            }

            #[inline(always)]
            #[allow(unused_assignments, reason = "the place after the last field is not read")]
            fn write<S: $crate::math::Real>(record: $name<S, D>, to: &mut impl $crate::field::Sink<S>) {
                let mut at = 0;
                $(
                    $crate::field::Value::write(record.$field, to, at);
                    at += <$crate::field::$quantity as $crate::field::Field>::ID.rank().words(D);
                )+
            }

            #[inline(always)]
            fn nought<S: $crate::math::Real>() -> $name<S, D> {
                $name { $($field: $crate::field::Value::nought()),+ }
            }
        }
    )+};
}
