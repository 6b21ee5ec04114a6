//! Which instruction set the kernels use: chosen once, at run time, in safe code.

use fearless_simd::Level;

/// A processor level that this machine has. Every level computes the same bits.
#[derive(Clone, Copy, Debug)]
pub struct Processor(Level);

impl Processor {
    /// The best level of this machine.
    pub fn best() -> Self {
        Self(Level::new())
    }

    /// The level that every machine of this architecture has.
    pub fn baseline() -> Self {
        Self(Level::baseline())
    }

    /// Every level of this machine, lowest first, so that each can be forced.
    pub fn available() -> Vec<Self> {
        let best = Level::new();
        let mut levels = vec![Level::baseline()];
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            levels.extend(best.as_sse4_2().map(Level::Sse4_2));
            levels.extend(best.as_avx2().map(Level::Avx2));
            levels.extend(best.as_avx512().map(Level::Avx512));
        }
        levels.push(best);
        let mut names: Vec<Self> = levels.into_iter().map(Self).collect();
        names.dedup_by_key(|level| level.name());
        names
    }

    /// A short name: `sse2`, `sse4.2`, `avx2`, `avx512`, `neon`, `baseline`.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => "sse2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse4_2(_) => "sse4.2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => "avx2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx512(_) => "avx512",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "neon",
            #[allow(unreachable_patterns, reason = "which levels exist depends on the target")]
            _ => "baseline",
        }
    }

    pub(crate) fn level(self) -> Level {
        self.0
    }
}

impl Default for Processor {
    fn default() -> Self {
        Self::best()
    }
}
