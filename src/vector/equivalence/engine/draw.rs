//! Numbers from a linear congruence.

#[derive(Clone)]
pub(super) struct Draw(pub(super) u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 32
    }

    /// A number below a limit that is not 0.
    pub(super) fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit
    }

    /// A word of so many bits, or of 126 if that is less.
    pub(super) fn word(&mut self, bits: u32) -> i128 {
        let word = (0..4).fold(0u128, |word, _| word << 32 | u128::from(self.next()));
        (word & ((1 << bits.min(126)) - 1)).cast_signed()
    }
}
