//! What channels and set-up cost. Spec clauses `H-5` and `H-6`.

use super::adder::Adder;
use super::{CLAMP_UM2, REGISTER_UM2};
use crate::bits::Rounding;
use crate::format::Clamp;
use crate::machine::{RasterState, Unit};
use crate::profile::Profile;
use crate::setup::Division;
use crate::value::{
    AttributeConfig, Correction, DepthConfig, InverseWConfig, ReciprocalConfig, Refine, StartBias,
};
use serde::Serialize;

/// A full adder and an AND gate, a cell of an array multiplier, in square micrometres: the slope of the
/// ripple adders of clause `H-2`, and one AND2 of the library.
const MULTIPLIER_UM2: f64 = 6.63 + 1.06;
/// A full adder and a multiplexer, a cell of an array divider.
const DIVIDER_UM2: f64 = 6.63 + 1.86;
/// A bit of a table of constants, as logic.
const TABLE_UM2: f64 = 0.35;

/// What a channel costs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelCost {
    /// The channel; `w` is the plane of 1/w.
    pub name: String,
    /// DDAs of all its components.
    pub walked_um2: f64,
    /// Arrays that correct it for perspective, one result a clock.
    pub correction_um2: f64,
}

/// What sets a triangle's planes up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SetUpCost {
    /// A divider of one bit a clock, and an array multiplier where a reciprocal is multiplied.
    pub area_um2: f64,
    /// Clocks a triangle: quotients and products one after another.
    pub cycles: u32,
}

/// The words that a linear value is carried in.
struct Words {
    width: u32,
    integer: u32,
    clamp: Clamp,
    interpolation: u32,
    guard: u32,
}

impl From<&AttributeConfig> for Words {
    fn from(of: &AttributeConfig) -> Self {
        let AttributeConfig { guard, integer, interpolation, clamp, .. } = *of;
        Self { width: guard + integer + interpolation, integer, clamp, interpolation, guard }
    }
}

impl From<&InverseWConfig> for Words {
    fn from(of: &InverseWConfig) -> Self {
        let InverseWConfig { guard, integer, interpolation, clamp, .. } = *of;
        Self { width: guard + integer + interpolation, integer, clamp, interpolation, guard }
    }
}

/// The area of what carries one linear value: what depth of the same words takes on this machine.
fn walked(profile: &Profile, words: &Words, adder: fn(u32) -> Adder) -> f64 {
    let Words { integer, interpolation, guard, clamp, .. } = *words;
    let depth = DepthConfig {
        guard,
        integer,
        interpolation,
        rounding: Rounding::NearestEven,
        division: Division::Quotient,
        clamp,
        start_bias: StartBias::None,
        format: None,
        bias: None,
    };
    let area = |depth: Option<DepthConfig>| {
        let state = RasterState { depth, ..profile.state() };
        let units = profile.form.datapath(&state).map_or_else(Vec::new, |path| path.units);
        let unit = |unit: &Unit| {
            if unit.is_shared() {
                // All values are weighed by the same coordinates: one product each.
                let products = array(MULTIPLIER_UM2, unit.width, integer + 1);
                return f64::from(unit.copies) * products;
            }
            let clamp = if unit.clamp { f64::from(integer) * CLAMP_UM2 } else { 0.0 };
            let adders = f64::from(unit.copies) * adder(unit.width).area_um2;
            adders + f64::from(unit.register_bits) * REGISTER_UM2 + clamp
        };
        units.iter().map(unit).sum::<f64>()
    };
    area(Some(depth)) - area(None)
}

fn array(cell: f64, rows: u32, columns: u32) -> f64 {
    cell * f64::from(rows) * f64::from(columns)
}

/// The bits of a reciprocal unit's result.
fn mantissa(unit: &ReciprocalConfig) -> u32 {
    match &unit.refine {
        Refine::Newton { bits } => bits.last().copied().unwrap_or(unit.entry),
        Refine::None | Refine::Linear => unit.entry,
    }
}

/// A reciprocal unit: its table and its multipliers.
fn reciprocal(unit: &ReciprocalConfig) -> f64 {
    let entries = f64::from(1u32 << unit.index.min(31));
    let table = entries * f64::from(unit.entry) * TABLE_UM2;
    match &unit.refine {
        Refine::None => table,
        Refine::Linear => {
            let below = unit.operand.saturating_sub(1 + unit.index);
            2.0 * table + array(MULTIPLIER_UM2, unit.entry, below)
        }
        Refine::Newton { bits } => {
            let mut from = unit.entry;
            bits.iter().fold(table, |area, to| {
                let step =
                    array(MULTIPLIER_UM2, unit.operand, from) + array(MULTIPLIER_UM2, from, to + 2);
                from = *to;
                area + step
            })
        }
    }
}

/// The arrays that correct a channel.
fn correction(channel: &AttributeConfig, w: Option<&InverseWConfig>) -> f64 {
    let components = f64::from(u32::try_from(channel.components.len()).unwrap_or(0));
    let own = channel.integer + channel.interpolation;
    let inverse = w.map_or(0, |w| w.integer + w.interpolation);
    match &channel.correction {
        Correction::Affine | Correction::Flat { .. } => 0.0,
        Correction::Quotient { .. } | Correction::ConstantW { .. } => {
            components * array(DIVIDER_UM2, channel.integer + 1, inverse + 1)
        }
        Correction::Reciprocal { unit, .. } => {
            reciprocal(unit) + components * array(MULTIPLIER_UM2, own, mantissa(unit))
        }
        Correction::Barycentric { bits, .. } => {
            // Two coordinates, and two products of each component.
            2.0 * array(DIVIDER_UM2, *bits, inverse + 1)
                + components * 2.0 * array(MULTIPLIER_UM2, *bits, channel.integer + 1)
        }
    }
}

/// The channels of a profile, 1/w first. Spec clause `H-5`.
pub(super) fn channels(profile: &Profile, adder: fn(u32) -> Adder) -> Vec<ChannelCost> {
    let walks_w = profile.channel.iter().any(|channel| channel.correction.walks_w());
    let w = profile.w.as_ref().filter(|_| walks_w).map(|w| ChannelCost {
        name: "w".to_owned(),
        walked_um2: walked(profile, &Words::from(w), adder),
        correction_um2: 0.0,
    });
    let channel = |channel: &AttributeConfig| {
        let carried = match channel.correction {
            Correction::Flat { .. } | Correction::Barycentric { .. } => {
                // Registers of the vertices' codes alone.
                let codes =
                    if matches!(channel.correction, Correction::Flat { .. }) { 1 } else { 3 };
                f64::from(codes * channel.integer) * REGISTER_UM2
            }
            _ => walked(profile, &Words::from(channel), adder),
        };
        let components = f64::from(u32::try_from(channel.components.len()).unwrap_or(0));
        ChannelCost {
            name: channel.name.clone(),
            walked_um2: components * carried,
            correction_um2: correction(channel, profile.w.as_ref()),
        }
    };
    w.into_iter().chain(profile.channel.iter().map(channel)).collect()
}

/// Bits of the accumulators of 1/w and of the channels.
pub(super) fn widths(profile: &Profile) -> impl Iterator<Item = u32> {
    let channels = profile.channel.iter().map(|channel| Words::from(channel).width);
    profile.w.iter().map(|w| Words::from(w).width).chain(channels)
}

/// The set-up of all planes of a triangle. Spec clause `H-6`.
pub(super) fn set_up(profile: &Profile, adder: fn(u32) -> Adder) -> SetUpCost {
    let walks_w = profile.channel.iter().any(|channel| channel.correction.walks_w());
    let depth = profile
        .depth
        .iter()
        .map(|depth| (depth.guard + depth.integer + depth.interpolation, depth.division, 1usize));
    let w = profile
        .w
        .iter()
        .filter(|_| walks_w)
        .map(|w| (w.guard + w.integer + w.interpolation, Division::Quotient, 1));
    let carried = profile.channel.iter().filter(|channel| {
        !matches!(channel.correction, Correction::Flat { .. } | Correction::Barycentric { .. })
    });
    let channels = carried
        .map(|channel| (Words::from(channel).width, channel.division, channel.components.len()));
    let planes: Vec<_> = depth.chain(w).chain(channels).collect();
    // Twice the area: a product of two vertex differences, and a bit for their difference.
    let divisor = 2 * profile.vertex.difference_bits() + 1;
    let (mut quotient, mut cycles, mut product) = (0, 0, 0);
    let mut mantissas: Vec<u32> = Vec::new();
    for (width, division, values) in planes {
        let values = u32::try_from(values).unwrap_or(0);
        match division {
            // Start and two slopes, a bit a clock.
            Division::Quotient => {
                quotient = quotient.max(width);
                cycles += 3 * width * values;
            }
            // One division for all planes with as many bits, and three products each.
            Division::Reciprocal { bits } => {
                quotient = quotient.max(bits);
                product = product.max(bits * width);
                if !mantissas.contains(&bits) {
                    mantissas.push(bits);
                    cycles += bits;
                }
                cycles += 3 * values;
            }
        }
    }
    if quotient == 0 {
        return SetUpCost::default();
    }
    // Remainder, divisor and quotient are registers; one adder subtracts.
    let registers = f64::from(2 * divisor + quotient) * REGISTER_UM2;
    let area_um2 = adder(divisor + 1).area_um2 + registers + f64::from(product) * MULTIPLIER_UM2;
    SetUpCost { area_um2, cycles }
}
