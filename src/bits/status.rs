//! Numeric events as data beside a value. Spec clause `V-1`.

use std::ops::{BitOr, BitOrAssign};

/// One kind of numeric event, by the key that reports use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Event {
    /// The unwrapped value left the range that the word (or its guard clamp) can tell apart.
    Wrap,
    /// The read-out was held at the largest value.
    ClampAbove,
    /// The read-out was held at zero.
    ClampBelow,
    /// Bits other than zero were dropped.
    Inexact,
}

impl Event {
    /// Every event, in report order.
    pub const ALL: [Self; 4] = [Self::Wrap, Self::ClampAbove, Self::ClampBelow, Self::Inexact];

    /// The key in `events` objects.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Wrap => "wrap",
            Self::ClampAbove => "clamp_above",
            Self::ClampBelow => "clamp_below",
            Self::Inexact => "inexact",
        }
    }
}

/// The set of events one operation raised: data, never an error.
///
/// ```
/// use guardbit::bits::{Event, Status};
/// let status = Status::when(Event::Wrap, true) | Status::when(Event::Inexact, false);
/// assert!(status.has(Event::Wrap) && !status.has(Event::Inexact));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct Status(u8);

impl Status {
    /// Nothing happened.
    pub const NONE: Self = Self(0);

    /// `event` if `happened`, else nothing.
    #[inline]
    pub const fn when(event: Event, happened: bool) -> Self {
        Self((happened as u8) << event as u8)
    }

    /// Whether `event` is in the set.
    #[inline]
    pub const fn has(self, event: Event) -> bool {
        self.0 >> event as u8 & 1 != 0
    }

    /// Both sets together; `|` in constant code.
    #[inline]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether the set is empty.
    #[inline]
    pub const fn is_none(self) -> bool {
        self.0 == 0
    }
}

impl BitOr for Status {
    type Output = Self;
    #[inline]
    fn bitor(self, other: Self) -> Self {
        self.union(other)
    }
}

impl BitOrAssign for Status {
    #[inline]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}
