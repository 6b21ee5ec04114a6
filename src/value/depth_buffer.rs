//! A depth buffer and its test. Spec clause `Z-6`.

use crate::cover::Rect;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// When a fragment passes: its depth compared with the stored one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each name says it")]
pub enum Compare {
    Never,
    Less,
    Equal,
    LessEqual,
    Greater,
    NotEqual,
    GreaterEqual,
    Always,
}

impl Compare {
    /// Every comparison.
    pub const ALL: [Self; 8] = [
        Self::Never,
        Self::Less,
        Self::Equal,
        Self::LessEqual,
        Self::Greater,
        Self::NotEqual,
        Self::GreaterEqual,
        Self::Always,
    ];

    /// Whether a fragment of this code passes a stored one.
    pub const fn passes(self, code: u64, stored: u64) -> bool {
        match self {
            Self::Never => false,
            Self::Less => code < stored,
            Self::Equal => code == stored,
            Self::LessEqual => code <= stored,
            Self::Greater => code > stored,
            Self::NotEqual => code != stored,
            Self::GreaterEqual => code >= stored,
            Self::Always => true,
        }
    }
}

/// Codes of a window, and the test that guards them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DepthBuffer {
    codes: Vec<u64>,
    width: usize,
    compare: Compare,
    /// Fragments that passed and were written.
    pub passed: u64,
    /// Fragments that did not.
    pub failed: u64,
}

impl DepthBuffer {
    /// A buffer of the pixels `[0, x1)` by `[0, y1)`, every code `clear`.
    ///
    /// ```
    /// use guardbit::{cover::Rect, value::{Compare, DepthBuffer}};
    /// let mut buffer = DepthBuffer::new(Rect { x0: 0, y0: 0, x1: 4, y1: 1 }, Compare::Less, 9);
    /// buffer.test(0, 1, &[3, 9]);
    /// buffer.test(0, 0, &[5, 4, 8]);
    /// assert_eq!(buffer.row(0), [5, 3, 8, 9]);
    /// assert_eq!((buffer.passed, buffer.failed), (3, 2));
    /// ```
    pub fn new(window: Rect, compare: Compare, clear: u64) -> Self {
        let width = window.x1 as usize;
        let codes = vec![clear; width * window.y1 as usize];
        Self { codes, width, compare, passed: 0, failed: 0 }
    }

    /// Tests a run of fragments from pixel (x, y) rightward, and writes those that pass.
    pub fn test(&mut self, y: u32, x: u32, depth: &[u64]) {
        let begin = y as usize * self.width + x as usize;
        for (stored, code) in self.codes[begin..begin + depth.len()].iter_mut().zip(depth) {
            if self.compare.passes(*code, *stored) {
                *stored = *code;
                self.passed += 1;
            } else {
                self.failed += 1;
            }
        }
    }

    /// The codes of row y.
    pub fn row(&self, y: u32) -> &[u64] {
        &self.codes[y as usize * self.width..][..self.width]
    }
}
