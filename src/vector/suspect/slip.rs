//! Slips of an accumulator and of its read-out that no profile describes, and devices with them.

use crate::dda::Op;
use crate::format::{Clamp, ReadOut};

/// A defect of an accumulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slip {
    TopBitLost,
    LowBitLost,
    /// The sum is made in two parts that meet at this bit.
    CarryLost(u32),
    NoCarry,
    SignXLost,
    SignsLost,
    OnlyY,
    LoadAdds,
    LoadSteps,
    LoadIgnored,
    LoadLess,
    LoadMore,
    HoldClears,
    HoldSteps,
    Held,
    OpLate,
}

impl Slip {
    /// Those that an accumulator of this width can have.
    pub(super) fn all(width: u32) -> impl Iterator<Item = Self> {
        let single = [
            Self::TopBitLost,
            Self::LowBitLost,
            Self::NoCarry,
            Self::SignXLost,
            Self::SignsLost,
            Self::OnlyY,
            Self::LoadAdds,
            Self::LoadSteps,
            Self::LoadIgnored,
            Self::LoadLess,
            Self::LoadMore,
            Self::HoldClears,
            Self::HoldSteps,
            Self::Held,
            Self::OpLate,
        ];
        single.into_iter().chain((1..width).map(Self::CarryLost))
    }

    /// Whether a row depends on nothing but its own walk.
    pub(super) fn forgets(self) -> bool {
        !matches!(self, Self::LoadAdds | Self::LoadIgnored | Self::OpLate)
    }

    /// In words.
    pub(super) fn text(self) -> String {
        match self {
            Self::TopBitLost => "the highest bit of the accumulator is lost",
            Self::LowBitLost => "the lowest bit of the accumulator is lost",
            Self::CarryLost(bit) => return format!("the carry into bit {bit} is lost"),
            Self::NoCarry => "no carries: exclusive or instead of addition",
            Self::SignXLost => "the sign bit of dx is lost",
            Self::SignsLost => "the sign bits of dx and dy are lost",
            Self::OnlyY => "a step right adds dy instead of dx",
            Self::LoadAdds => "a load adds to the accumulator instead of replacing it",
            Self::LoadSteps => "a load also adds dx",
            Self::LoadIgnored => "a load is ignored",
            Self::LoadLess => "a load is one too small: the bias is subtracted twice",
            Self::LoadMore => "a load is one too large: the bias is cancelled",
            Self::HoldClears => "a hold clears the accumulator",
            Self::HoldSteps => "a hold steps by dx",
            Self::Held => "the accumulator is held in reset",
            Self::OpLate => "an operation takes effect one clock late",
        }
        .to_owned()
    }
}

/// An accumulator that wraps, with a slip.
#[derive(Clone, Debug)]
pub(super) struct Register {
    slip: Option<Slip>,
    width: u32,
    /// The word it holds.
    pub(super) pattern: u128,
    late: Op,
}

impl Register {
    /// After reset.
    pub(super) fn new(slip: Option<Slip>, width: u32) -> Self {
        Self { slip, width, pattern: 0, late: Op::Hold }
    }

    /// One clock edge.
    pub(super) fn clock(&mut self, op: Op, words: [i128; 3]) {
        let mask = u128::MAX >> (128 - self.width);
        let [init, mut dx, mut dy] = words.map(|word| word.cast_unsigned() & mask);
        let low = mask >> 1;
        match self.slip {
            Some(Slip::SignXLost) => dx &= low,
            Some(Slip::SignsLost) => (dx, dy) = (dx & low, dy & low),
            Some(Slip::OnlyY) => dx = dy,
            _ => {}
        }
        let now = self.pattern;
        let done = if self.slip == Some(Slip::OpLate) {
            std::mem::replace(&mut self.late, op)
        } else {
            op
        };
        let (base, addend) = match (done, self.slip) {
            (Op::Load, Some(Slip::LoadAdds)) => (now, init),
            (Op::Load, Some(Slip::LoadSteps)) => (dx, init),
            (Op::Load, Some(Slip::LoadIgnored)) => (now, 0),
            (Op::Load, Some(Slip::LoadLess)) => (init.wrapping_sub(1), 0),
            (Op::Load, Some(Slip::LoadMore)) => (init.wrapping_add(1), 0),
            (Op::Load, _) => (0, init),
            (Op::StepX, _) | (Op::Hold, Some(Slip::HoldSteps)) => (now, dx),
            (Op::StepY, _) => (now, dy),
            (Op::Hold, Some(Slip::HoldClears)) => (0, 0),
            (Op::Hold, _) => (now, 0),
        };
        let sum = match self.slip {
            Some(Slip::CarryLost(bit)) => {
                let below = (1 << bit) - 1;
                let high = (base & !below).wrapping_add(addend & !below);
                high | (base & below).wrapping_add(addend & below) & below
            }
            Some(Slip::NoCarry) => base ^ addend,
            _ => base.wrapping_add(addend),
        };
        self.pattern = mask
            & match self.slip {
                Some(Slip::TopBitLost) => sum & low,
                Some(Slip::LowBitLost) => sum & !1,
                Some(Slip::Held) => 0,
                _ => sum,
            };
    }
}

/// A defect of a read-out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ReadSlip {
    Rounds,
    Inverted,
    NeverLow,
    NeverHigh,
    SplitLate,
    SplitEarly,
    WholeLate,
    MaximumLess,
    TooHigh,
}

impl ReadSlip {
    const CLAMPS: [Self; 7] = [
        Self::Inverted,
        Self::NeverLow,
        Self::NeverHigh,
        Self::SplitLate,
        Self::SplitEarly,
        Self::WholeLate,
        Self::MaximumLess,
    ];

    /// Those that this read-out can have.
    pub(super) fn all(read: ReadOut) -> Vec<Self> {
        let mut list = vec![Self::TooHigh];
        if read.fraction() > 0 {
            list.push(Self::Rounds);
        }
        match read.clamp() {
            Clamp::Guard => list.extend(Self::CLAMPS),
            // The split is the sign bit itself.
            Clamp::Sign => list.extend(
                Self::CLAMPS
                    .iter()
                    .filter(|slip| !matches!(slip, Self::SplitLate | Self::SplitEarly)),
            ),
            _ => {}
        }
        list
    }

    /// In words.
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Rounds => "the read-out rounds to nearest instead of truncating",
            Self::Inverted => "the clamp goes to the wrong end",
            Self::NeverLow => "values below zero are clamped to the maximum instead of zero",
            Self::NeverHigh => "values above the range are clamped to zero instead of the maximum",
            Self::SplitLate => "the guard range is split one pattern too late",
            Self::SplitEarly => "the guard range is split one pattern too early",
            Self::WholeLate => "the clamp begins one pattern too late",
            Self::MaximumLess => "the clamp's maximum is one too small",
            Self::TooHigh => "the read-out takes its bits one place too high",
        }
    }

    /// What the device shows for an accumulator.
    pub(super) fn read(self, read: ReadOut, pattern: u128) -> u64 {
        let (integer, fraction) = (read.integer(), read.fraction());
        let whole = 1u128 << integer;
        let value = |pattern: u128| read.read(pattern.cast_signed());
        let u = pattern >> fraction;
        let bits = || {
            let low = u & (whole - 1);
            u64::try_from(low).unwrap_or_else(|_| unreachable!("a read-out has 64 bits at most"))
        };
        let zone = read.zone(pattern.cast_signed());
        match self {
            Self::Rounds => {
                // The carry may leave the accumulator: the pattern grows a bit.
                let up =
                    pattern.wrapping_add(1 << (fraction - 1)) & (u128::MAX >> (128 - read.width()));
                value(up)
            }
            Self::TooHigh => {
                let shifted = u >> 1 << fraction;
                value(shifted)
            }
            Self::Inverted => match zone {
                1 => 0,
                2 => read.maximum(),
                _ => value(pattern),
            },
            Self::NeverLow if zone == 2 => read.maximum(),
            Self::NeverHigh if zone == 1 => 0,
            Self::MaximumLess if zone == 1 => read.maximum() - 1,
            Self::WholeLate if u == whole => bits(),
            // The first pattern of the upper half and the last of the lower half change sides.
            Self::SplitLate if zone == 2 && u == middle(read) => read.maximum(),
            Self::SplitEarly if zone == 1 && u + 1 == middle(read) => 0,
            _ => value(pattern),
        }
    }
}

/// The first pattern of guard and integer bits that counts as below zero.
fn middle(read: ReadOut) -> u128 {
    let bits = read.guard() + read.integer();
    if bits == 0 { 0 } else { (1u128 << (bits - 1)) + (1u128 << read.integer() >> 1) }
}

/// A defect of an edge word's sign test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SignSlip {
    ZeroOutside,
    MinusOneInside,
    BitBelow,
    Exchanged,
}

impl SignSlip {
    pub(super) const ALL: [(Self, &'static str); 4] = [
        (Self::ZeroOutside, "an edge word of zero counts as outside"),
        (Self::MinusOneInside, "an edge word of minus one counts as inside"),
        (Self::BitBelow, "the sign test reads one bit too low"),
        (Self::Exchanged, "inside and outside are exchanged"),
    ];

    /// Whether the device takes a word for inside.
    pub(super) fn inside(slip: Option<Self>, width: u32, pattern: u128) -> bool {
        let clear = pattern >> (width - 1) & 1 == 0;
        match slip {
            None => clear,
            Some(Self::ZeroOutside) => clear && pattern != 0,
            Some(Self::MinusOneInside) => clear || pattern == u128::MAX >> (128 - width),
            Some(Self::BitBelow) => pattern >> (width - 2) & 1 == 0,
            Some(Self::Exchanged) => !clear,
        }
    }
}
