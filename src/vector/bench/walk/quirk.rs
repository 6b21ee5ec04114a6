//! Slips of a walking device that no profile describes.

use super::WalkKind;
use crate::format::{Clamp, ReadOut};
use crate::vector::bench::slip::{ReadSlip, SignSlip, Slip};

/// A defect of a device that no profile describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quirk {
    /// None: as specified.
    None,
    /// Each row shows the state before its clock edge.
    Late,
    /// The read-out lags the accumulator by one row.
    LateOut,
    /// dx and dy change places.
    Swapped,
    /// Steps subtract.
    Negated,
    /// dy is ignored in favour of dx.
    OnlyX,
    /// In the accumulator.
    Word(Slip),
    /// In the read-out.
    Read(ReadSlip),
    /// In the sign test.
    Sign(SignSlip),
}

/// The quirks tried in diagnosis, and what each is called.
pub(super) fn quirks(kind: WalkKind, read: ReadOut) -> Vec<(Quirk, String)> {
    let lag = match kind {
        WalkKind::Depth => "the read-out lags the accumulator by one clock",
        WalkKind::Edge => "the sign test lags the edge word by one clock",
    };
    let mut list: Vec<(Quirk, String)> = [
        (Quirk::Late, "an off-by-one step: each row shows the state before its clock edge"),
        (Quirk::LateOut, lag),
        (Quirk::Swapped, "dx and dy are swapped"),
        (Quirk::Negated, "steps subtract instead of adding"),
        (Quirk::OnlyX, "a step down adds dx instead of dy"),
    ]
    .map(|(quirk, name)| (quirk, name.to_owned()))
    .to_vec();
    // A register that slips does not hold its accumulator.
    let sticky = read.clamp() == Clamp::Saturate;
    let slips = Slip::all(read.width()).filter(|slip| !sticky || *slip == Slip::HoldSteps);
    list.extend(slips.map(|slip| (Quirk::Word(slip), slip.text())));
    match kind {
        WalkKind::Depth => list.extend(
            ReadSlip::all(read).into_iter().map(|slip| (Quirk::Read(slip), slip.text().to_owned())),
        ),
        WalkKind::Edge => {
            list.extend(SignSlip::ALL.map(|(slip, name)| (Quirk::Sign(slip), name.to_owned())));
        }
    }
    list
}
