//! Slips of a device that no profile describes.

/// A defect of a device that no profile describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quirk {
    /// None: as specified.
    None,
    /// Each row shows the state before its clock edge.
    Late,
    /// The read-out lags the accumulator by one row.
    LateOut,
    /// dx and dy change places.
    Swapped,
    /// A hold steps by dx.
    HoldSteps,
    /// Steps subtract.
    Negated,
    /// dy is ignored in favour of dx.
    OnlyX,
    /// The read-out rounds to nearest instead of truncating (depth); the zero of an edge word
    /// counts as outside (edge).
    OtherTie,
    /// The read-out is inverted: clamps to the wrong ends (depth), inside for outside (edge).
    Inverted,
}

/// The quirks tried in diagnosis, and what each is called.
pub(super) const QUIRKS: [(Quirk, &str, &str); 8] = [
    (Quirk::Late, "an off-by-one step: each row shows the state before its clock edge", ""),
    (
        Quirk::LateOut,
        "the read-out lags the accumulator by one clock",
        "the sign test lags the edge word by one clock",
    ),
    (Quirk::Swapped, "dx and dy are swapped", ""),
    (Quirk::HoldSteps, "a hold steps by dx", ""),
    (Quirk::Negated, "steps subtract instead of adding", ""),
    (Quirk::OnlyX, "a step down adds dx instead of dy", ""),
    (
        Quirk::OtherTie,
        "the read-out rounds to nearest instead of truncating",
        "an edge word of zero counts as outside",
    ),
    (Quirk::Inverted, "the clamp goes to the wrong end", "inside and outside are exchanged"),
];
