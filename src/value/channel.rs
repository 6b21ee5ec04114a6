//! Interpolated values whose starts and slopes come from registers. Spec clause `RG-20`.

use crate::format::{Clamp, ReadOut, ReadOutError};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What lies above a register's own bits once it is in an accumulator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Extension {
    /// Copies of its sign.
    #[default]
    Sign,
    /// Zeros.
    Zero,
}

/// Channels that share one shape.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ChannelConfig {
    /// Their names, as registers and records know them.
    pub names: Vec<String>,
    /// Guard bits of the read-out.
    pub guard: u32,
    /// Integer bits of the read-out.
    pub integer: u32,
    /// Bits below them.
    pub interpolation: u32,
    /// What the read-out does outside its range.
    pub clamp: Clamp,
    /// Bits of the accumulator, where it has more than its read-out looks at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// What lies above the start's register; slopes are always signed.
    #[serde(default, skip_serializing_if = "is_sign")]
    pub start: Extension,
    /// Places that registers are moved up on their way into the accumulator.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub shift: u32,
    /// The same for the slope along a row, where it differs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shift_along: Option<u32>,
    /// Low bits that the slope along a row lacks.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub drop: u32,
    /// Bits below the integer that the correction to the first covered sub-sample sees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub correction: u32,
    /// Bits of the slopes, where an accumulator has more: their upper bits are lost.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_width: Option<u32>,
    /// What the accumulator is multiplied with before it is read.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub scale: u32,
    /// Bits of what is read, where that is the code repeated from its highest bit on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub replicate: Option<u32>,
}

const fn one() -> u32 {
    1
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_one(value: &u32) -> bool {
    *value == 1
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_zero(value: &u32) -> bool {
    *value == 0
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_sign(value: &Extension) -> bool {
    matches!(value, Extension::Sign)
}

/// A channel that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ChannelError {
    /// The read-out.
    #[error("channel {name:?}: {source}")]
    ReadOut {
        /// The channel.
        name: String,
        /// Why.
        source: ReadOutError,
    },
    /// A word that no accumulator holds.
    #[error(
        "channel {name:?}: guard + integer + interpolation = {read} <= width = {width} <= 64 is needed"
    )]
    Width {
        /// The channel.
        name: String,
        /// Bits of the read-out.
        read: u32,
        /// Bits of the accumulator.
        width: u32,
    },
    /// A shift beyond the word.
    #[error("channel {name:?}: {what} = {value} < width = {width} is needed")]
    Shift {
        /// The channel.
        name: String,
        /// Which number.
        what: &'static str,
        /// The number.
        value: u32,
        /// Bits of the accumulator.
        width: u32,
    },
    /// A sticky clamp on an accumulator that is re-evaluated.
    #[error(
        "channel {name:?}: clamp = {clamp:?}: a channel cannot saturate its accumulator or reject a primitive; \
         use wrap, guard or sign"
    )]
    Sticky {
        /// The channel.
        name: String,
        /// The clamp.
        clamp: &'static str,
    },
    /// A correction with more bits than there are.
    #[error(
        "channel {name:?}: correction = {correction} <= interpolation = {interpolation} is needed"
    )]
    Correction {
        /// The channel.
        name: String,
        /// Bits of the correction.
        correction: u32,
        /// Bits below the integer.
        interpolation: u32,
    },
    /// Slopes wider than what they are added to.
    #[error("channel {name:?}: 1 <= slope-width = {slope} <= width = {width} is needed")]
    SlopeWidth {
        /// The channel.
        name: String,
        /// Bits of a slope.
        slope: u32,
        /// Bits of the accumulator.
        width: u32,
    },
    /// A factor that leaves nothing, or a product beyond every word.
    #[error("channel {name:?}: 1 <= scale = {scale} <= 2^16 is needed")]
    Scale {
        /// The channel.
        name: String,
        /// The factor.
        scale: u32,
    },
    /// A code that is cut when it is repeated.
    #[error("channel {name:?}: integer = {integer} <= replicate = {replicate} <= 32 is needed")]
    Replicate {
        /// The channel.
        name: String,
        /// Bits of the code.
        integer: u32,
        /// Bits of what is read.
        replicate: u32,
    },
    /// A name given twice.
    #[error("channel {0:?} is defined twice; remove one definition")]
    Twice(String),
    /// A name that no register can have.
    #[error(
        "channel {0:?}: the name of a channel contains only a-z, 0-9 and _, and begins with a letter"
    )]
    Name(String),
}

/// Whether a channel or a component can be called so.
pub(super) fn is_name(name: &str) -> bool {
    let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(legal)
}

/// One channel, ready: registers in, accumulators of `width` bits, read-outs out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Its name.
    pub name: String,
    /// How the accumulator is read.
    pub read: ReadOut,
    /// Bits of the accumulator.
    pub width: u32,
    /// What lies above the start's register.
    pub start: Extension,
    /// Places registers are moved up.
    pub shift: u32,
    /// The same along a row.
    pub shift_along: u32,
    /// Low bits that the slope along a row lacks.
    pub drop: u32,
    /// Bits below the integer that a correction sees.
    pub correction: u32,
    /// Bits of the slopes.
    pub slope_width: u32,
    /// What the accumulator is multiplied with before it is read.
    pub scale: u32,
    /// Bits of what is read, where that is the code repeated.
    pub replicate: Option<u32>,
}

impl ChannelConfig {
    /// Bits of what is read.
    pub fn top_bits(&self) -> u32 {
        self.replicate.unwrap_or(self.integer)
    }

    /// The first part of these channels that is in no reference and in no device.
    pub fn beyond_plain(&self) -> Option<&'static str> {
        let parts = [
            ("slope-width", self.slope_width.is_some()),
            ("scale", self.scale != 1),
            ("replicate", self.replicate.is_some()),
        ];
        parts.into_iter().find(|(_, there)| *there).map(|(name, _)| name)
    }

    /// The channels of a group.
    ///
    /// # Errors
    /// [`ChannelError`] names the channel and the inequality.
    pub fn channels(&self) -> Result<Vec<Channel>, ChannelError> {
        self.names.iter().map(|name| self.channel(name.clone())).collect()
    }

    fn channel(&self, name: String) -> Result<Channel, ChannelError> {
        if !is_name(&name) {
            return Err(ChannelError::Name(name));
        }
        let read = match ReadOut::new(self.guard, self.integer, self.interpolation, self.clamp) {
            Ok(read) => read,
            Err(source) => return Err(ChannelError::ReadOut { name, source }),
        };
        let width = self.width.unwrap_or(read.width());
        if read.width() > width || width > 64 {
            return Err(ChannelError::Width { name, read: read.width(), width });
        }
        if matches!(self.clamp, Clamp::Saturate | Clamp::Error) {
            return Err(ChannelError::Sticky { name, clamp: self.clamp.name() });
        }
        let shift_along = self.shift_along.unwrap_or(self.shift);
        let shifts = [("shift", self.shift), ("shift-along", shift_along), ("drop", self.drop)];
        if let Some((what, value)) = shifts.into_iter().find(|(_, value)| *value >= width) {
            return Err(ChannelError::Shift { name, what, value, width });
        }
        let (correction, interpolation) = (self.correction, self.interpolation);
        if correction > interpolation {
            return Err(ChannelError::Correction { name, correction, interpolation });
        }
        let slope_width = self.slope_width.unwrap_or(width);
        if !(1..=width).contains(&slope_width) {
            return Err(ChannelError::SlopeWidth { name, slope: slope_width, width });
        }
        let (scale, replicate, integer) = (self.scale, self.replicate, self.integer);
        if !(1..=1 << 16).contains(&scale) {
            return Err(ChannelError::Scale { name, scale });
        }
        if let Some(replicate) = replicate.filter(|bits| !(integer..=32).contains(bits)) {
            return Err(ChannelError::Replicate { name, integer, replicate });
        }
        Ok(Channel {
            name,
            read,
            width,
            start: self.start,
            shift: self.shift,
            shift_along,
            drop: self.drop,
            correction,
            slope_width,
            scale,
            replicate,
        })
    }
}

impl Channel {
    /// A value mod 2^width, as a signed number.
    #[inline]
    pub const fn wrap(&self, value: i64) -> i64 {
        let above = 64 - self.width;
        value << above >> above
    }

    /// The accumulator moved on by `count` slopes.
    #[inline]
    pub const fn walk(&self, accumulator: i64, slope: i64, count: i64) -> i64 {
        self.wrap(accumulator.wrapping_add(slope.wrapping_mul(count)))
    }

    /// A slope along a row without the bits it lacks.
    pub const fn along(&self, slope: i64) -> i64 {
        slope & !((1 << self.drop) - 1)
    }

    /// A slope in its own bits, as a signed number.
    #[inline]
    pub const fn slope(&self, value: i64) -> i64 {
        let above = 64 - self.slope_width;
        value << above >> above
    }

    /// The read-out: scale, floor, clamp, and the code repeated. Spec clauses `RE-9` and `RG-20`.
    #[inline]
    pub fn value(&self, accumulator: i64) -> i64 {
        let code = self.read.read(i128::from(accumulator) * i128::from(self.scale));
        self.replicate.map_or(code, |bits| self.repeated(code, bits)).cast_signed()
    }

    /// A code from the highest bit of so many on, again and again.
    fn repeated(&self, code: u64, bits: u32) -> u64 {
        let integer = self.read.integer();
        let (mut value, mut filled) = (0, 0);
        while filled < bits {
            let room = bits - filled;
            let part =
                if integer <= room { code << (room - integer) } else { code >> (integer - room) };
            value |= part;
            filled += integer;
        }
        value
    }

    /// The slope that a host gives for a real one of `numerator / denominator` codes, nearest.
    pub fn register(&self, numerator: i128, denominator: i128, shift: u32) -> i64 {
        let places = self.read.fraction();
        let denominator = denominator * i128::from(self.scale);
        let exact = crate::bits::Rounding::NearestEven
            .divide(numerator << places >> shift, denominator)
            .map_or(0, |(value, _)| value);
        i64::try_from(exact).unwrap_or(0)
    }
}
