//! Numbers in narrower types, where a bound is known.

use std::fmt::Display;

/// The number in another type. Stops, with the number, if it does not fit: then a bound that the caller
/// states is wrong, and any answer would be a wrong one.
#[inline]
#[track_caller]
pub(crate) fn bounded<T: TryInto<U> + Copy + Display, U>(value: T) -> U {
    value.try_into().unwrap_or_else(|_| unreachable!("{value} is beyond its bound"))
}
