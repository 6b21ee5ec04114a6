//! What can be wrong with a channel.

use super::COMPONENTS;
use crate::format::ReadOutError;
use crate::setup::DivisionError;
use crate::value::lod::DetailError;
use crate::value::reciprocal::ReciprocalError;

/// A channel, or a plane of 1/w, that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AttributeError {
    /// A name that no file can have.
    #[error(
        "{0:?} is no name of a channel or component: a name contains only a-z, 0-9 and _, and begins with a letter"
    )]
    Name(String),
    /// A name given twice.
    #[error("{0:?} is given twice; rename one")]
    Twice(String),
    /// A name that is in use.
    #[error(
        "channel {0:?}: the name stands for the set-up words of a set, or for 1/w; choose another"
    )]
    Reserved(String),
    /// Two columns of one name.
    #[error(
        "two set-up words would be called {0:?}: a word is called by its channel, its component and what it holds; \
         rename a channel or a component"
    )]
    Column(String),
    /// A place that is off the lattice.
    #[error(
        "channel {0:?}: sub-pixel = 0: a vertex grid without sub-pixels has no pixel centres; write at = \"sample\" \
         or at = \"corner\""
    )]
    NoCentre(String),
    /// No components, or too many.
    #[error("channel {name:?}: {got} components: 1 <= components <= 4 is needed")]
    Components {
        /// The channel.
        name: String,
        /// How many.
        got: usize,
    },
    /// A level of detail of other than two coordinates.
    #[error(
        "channel {name:?}: detail: components = {got}, but a texture has 2 coordinates; give 2 components, or leave detail out"
    )]
    DetailComponents {
        /// The channel.
        name: String,
        /// How many.
        got: usize,
    },
    /// A unit for the level of detail that cannot be built.
    #[error("channel {0:?}: detail: {1}")]
    Detail(String, DetailError),
    /// A level of detail where there are no helpers.
    #[error(
        "channel {0:?}: detail: quads need one place in a pixel (`at`) and a correction that is neither flat nor \
         constant-w"
    )]
    DetailPlace(String),
    /// A level of detail on a machine without helpers.
    #[error(
        "channel {0:?}: detail: this machine has values only where it covers; quads need a machine that walks \
         planes, such as edge-function"
    )]
    DetailMachine(String),
    /// Too many in all channels.
    #[error("{0} components in all channels: at most {COMPONENTS} are allowed")]
    Total(usize),
    /// A value wider than the arithmetic of a sample.
    #[error("{0}: integer = {1}: 1 <= integer <= 32 is needed")]
    Integer(String, u32),
    /// A code of 1 that a word does not have.
    #[error("channel {name:?}: unit = {unit}: 1 <= unit <= {most} is needed, the largest code")]
    Unit {
        /// The channel.
        name: String,
        /// The unit.
        unit: u32,
        /// The largest code.
        most: u64,
    },
    /// The read-out.
    #[error("{0}: {1}")]
    ReadOut(String, ReadOutError),
    /// A clamp that depends on the path, or refuses the primitive.
    #[error(
        "{0}: clamp = {1:?}: a channel cannot saturate its accumulator or reject a primitive; use wrap, guard or sign"
    )]
    Clamp(String, &'static str),
    /// The division of set-up.
    #[error("channel {0:?}: division: {1}")]
    Division(String, DivisionError),
    /// A reciprocal in set-up where the numerators have a fraction.
    #[error(
        "channel {0:?}: division = {{ reciprocal = ... }} goes with correction = \"affine\" only; write division = \"quotient\""
    )]
    DividedTwice(String),
    /// A half that would be divided.
    #[error(
        "channel {0:?}: start-bias = \"half\" goes with correction = \"affine\" only; its correction has a rounding of its own"
    )]
    Bias(String),
    /// A correction without 1/w.
    #[error(
        "channel {0:?}: its correction needs 1/w: give the profile a table [w] with guard, integer, interpolation, rounding and clamp"
    )]
    NoW(String),
    /// 1/w that nobody asks for.
    #[error("[w] is given, but no channel is corrected by it; leave it out")]
    UnusedW,
    /// The reciprocal unit.
    #[error("channel {0:?}: reciprocal unit: {1}")]
    Reciprocal(String, ReciprocalError),
    /// A coordinate of too many bits.
    #[error("channel {name:?}: bits = {bits}: 1 <= bits <= 40 is needed for a coordinate")]
    Coordinate {
        /// The channel.
        name: String,
        /// Its bits.
        bits: u32,
    },
    /// Numbers that outgrow exact arithmetic.
    #[error(
        "{what}: {sum} bits in {clause} > {most}: {formula}; use fewer bits in one of these fields"
    )]
    Growth {
        /// Whose.
        what: String,
        /// Bits of the largest intermediate.
        sum: u32,
        /// The largest allowed.
        most: u32,
        /// The clause that states the sum.
        clause: &'static str,
        /// The sum, with its numbers.
        formula: String,
    },
}
