//! Slips of a triangle engine that no profile describes.

use super::engine::EngineSlip;
use super::setup::SetupSlip;

/// A defect that no profile describes, applied to what was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quirk {
    None,
    RightEndIncluded,
    LeftEndExcluded,
    RowsLate,
    NoSwap,
    /// Words narrower than the set's come with zeros above them, not with their sign.
    ZeroExtended,
    /// In an engine that takes set-up words.
    Engine(EngineSlip),
    /// In the set-up.
    Setup(SetupSlip),
}

pub(super) const QUIRKS: [(Quirk, &str); 4] = [
    (Quirk::RightEndIncluded, "spans include the pixel at their right end (off by one)"),
    (Quirk::LeftEndExcluded, "spans leave out the pixel at their left end (off by one)"),
    (Quirk::RowsLate, "rows are numbered one too high (off by one)"),
    (Quirk::NoSwap, "triangles of negative area are not turned round: v1 and v2 keep their places"),
];
