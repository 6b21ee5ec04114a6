//! How the bits of a word are spent. Spec clause `F-3`.

/// A bit budget in the lectures' four parts.
///
/// ```
/// use guardbit::format::Budget;
/// assert_eq!(Budget::EDGE_35.width(), 35);
/// assert_eq!(Budget::DEPTH_39.width(), 39);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Budget {
    /// Extra most significant bits that keep a wrap apart from a value.
    pub guard: u32,
    /// Integer bits of the result.
    pub integer: u32,
    /// Sub-pixel position bits.
    pub sub_pixel: u32,
    /// Interpolation bits: the growth of the error over the longest walk.
    pub interpolation: u32,
}

impl Budget {
    /// Lecture A's edge equation in a 4096 x 4096 space.
    pub const EDGE_35: Self = Self { guard: 1, integer: 12, sub_pixel: 10, interpolation: 12 };

    /// Lecture A's depth value in a 4096 x 4096 space.
    pub const DEPTH_39: Self = Self { guard: 2, integer: 24, sub_pixel: 0, interpolation: 13 };

    /// Bits in all.
    pub const fn width(self) -> u32 {
        self.guard + self.integer + self.sub_pixel + self.interpolation
    }

    /// Bits below the binary point of the result.
    pub const fn fraction(self) -> u32 {
        self.sub_pixel + self.interpolation
    }
}
