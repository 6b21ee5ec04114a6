//! What a profile's datapath costs in hardware, estimated from its bits alone.
//! Spec clauses `H-1` to `H-4`.
//!
//! Every figure is an estimate for comparing budgets: registers and adders are counted, area and
//! delay are interpolated from measured adders of one process, the open 45 nm library Nangate45 at
//! its typical corner, before placement. [`synthesise`] asks a synthesis tool instead.

mod adder;
mod channel;
mod synthesis;

pub use crate::machine::{Count, Operations, Unit};
pub use channel::{ChannelCost, SetUpCost};
pub use synthesis::{
    Source, Synthesis, SynthesisError, UnitSynthesis, YOSYS, sources, synthesise, synthesise_unit,
};

use crate::cover::SampleGrid;
use crate::format::Clamp;
use crate::machine::{Datapath, corners, signed_bits};
use crate::profile::{InvalidProfile, Profile};
use crate::setup::{Gradient, Triangle, VertexConfig};
use crate::value::DepthConfig;
use adder::Adder;
use serde::Serialize;

/// Clock to output, operand multiplexers and set-up time of a DDA, in picoseconds: what the two
/// measured whole DDAs of clause `H-2` take beyond their adder, 109 and 107.
const REGISTER_PS: f64 = 108.0;
/// A register bit with its share of the multiplexers, in square micrometres: fitted to the same
/// two, and near the flip-flop of the library.
const REGISTER_UM2: f64 = 4.2;
/// The guard clamp a result bit, in square micrometres: measured clamps are 23 to 111 in all.
const CLAMP_UM2: f64 = 3.0;
/// The guard clamp where it is in the loop of a sticky accumulator, in picoseconds: the middle of
/// the measured 81 to 141.
const CLAMP_PS: f64 = 111.0;

/// What a profile's datapath costs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// The walked units: edges, then depth if the profile has it.
    pub units: Vec<Unit>,
    /// Register bits of all units.
    pub register_bits: u32,
    /// Adder bits of all units.
    pub adder_bits: u32,
    /// Bits of the widest intermediate of set-up, sign included: what the dividers and multipliers
    /// before the units are built for. In no other figure here.
    pub setup_bits: u32,
    /// Area and clock with ripple-carry adders.
    pub ripple: Estimate,
    /// Area and clock with Sklansky prefix adders.
    pub prefix: Estimate,
    /// Arithmetic operations of the model.
    pub operations: Operations,
    /// Channels, 1/w first, with ripple-carry adders; absent without channels. Part of the area.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<ChannelCost>,
    /// What sets the planes of a triangle up, with ripple-carry adders. In no other figure here.
    pub set_up: SetUpCost,
}

/// Area and clock of a profile's units with one kind of adder.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Cell area of all units, in square micrometres.
    pub area_um2: f64,
    /// One step of the slowest unit, register to register, in picoseconds.
    pub delay_ps: f64,
    /// The clock that allows, one step a clock.
    pub clock_mhz: f64,
}

/// Estimates what a profile costs.
///
/// ```
/// use guardbit::{measure::cost::estimate, profile::load};
/// let cost = estimate(&load("sgi-4k")?)?;
/// // Three edges of 35 bits and a depth plane of 39, one adder each, four registers each.
/// assert_eq!((cost.adder_bits, cost.register_bits), (3 * 35 + 39, 4 * (3 * 35 + 39)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`InvalidProfile`] if the profile fails validation, or if its machine has no cost model.
pub fn estimate(profile: &Profile) -> Result<Cost, InvalidProfile> {
    profile.validate()?;
    let grid = profile.whole_grid()?;
    let Datapath { units, setup_bits, operations } = datapath(profile)?;
    let sum = |bits: fn(&Unit) -> u32| units.iter().map(bits).sum();
    let depth_bits = profile.depth.map_or(0, |d| depth_setup_bits(&d, &profile.vertex, &grid));
    let channels = channel::channels(profile, adder::ripple);
    Ok(Cost {
        register_bits: sum(|unit| unit.register_bits),
        adder_bits: sum(|unit| unit.adder_bits),
        setup_bits: setup_bits.max(depth_bits),
        ripple: area_and_clock(profile, &units, &channels, adder::ripple),
        prefix: area_and_clock(
            profile,
            &units,
            &channel::channels(profile, adder::prefix),
            adder::prefix,
        ),
        channels,
        set_up: channel::set_up(profile, adder::ripple),
        operations,
        units,
    })
}

/// The datapath of a valid profile. Spec clause `H-1`.
fn datapath(profile: &Profile) -> Result<Datapath, InvalidProfile> {
    let stated = profile.form.datapath(&profile.state());
    stated.ok_or(InvalidProfile::NoCost(profile.form.name()))
}

/// Spec clause `H-2`.
fn area_and_clock(
    profile: &Profile,
    units: &[Unit],
    channels: &[ChannelCost],
    adder: fn(u32) -> Adder,
) -> Estimate {
    let (mut area_um2, mut delay_ps) = (0.0, 0.0f64);
    for unit in units {
        let Adder { delay_ps: adder_ps, area_um2: adder_um2 } = adder(unit.width);
        area_um2 += f64::from(unit.copies) * adder_um2;
        area_um2 += f64::from(unit.register_bits) * REGISTER_UM2;
        let mut step = adder_ps + REGISTER_PS;
        if let (true, Some(depth)) = (unit.clamp, profile.depth) {
            area_um2 += f64::from(depth.integer) * CLAMP_UM2;
            if depth.clamp == Clamp::Saturate {
                step += CLAMP_PS;
            }
        }
        delay_ps = delay_ps.max(step);
    }
    area_um2 += channels.iter().map(|own| own.walked_um2 + own.correction_um2).sum::<f64>();
    for width in channel::widths(profile) {
        delay_ps = delay_ps.max(adder(width).delay_ps + REGISTER_PS);
    }
    Estimate { area_um2, delay_ps, clock_mhz: 1e6 / delay_ps }
}

/// The dividends of the depth plane: those of clause `P-5`, with the slack of its bound taken out
/// by trying the corners of the vertex field and of the depth range.
fn depth_setup_bits(depth: &DepthConfig, vertex: &VertexConfig, grid: &SampleGrid) -> u32 {
    let top = i128::from(u64::MAX >> (64 - depth.integer));
    let (mut start, mut slope) = (0, 0);
    for [x0, y0, x1, y1, x2, y2] in corners::<6>(vertex) {
        let triangle = Triangle { xy: [[x0, y0], [x1, y1], [x2, y2]], z: None };
        for n in 0..8usize {
            let z = std::array::from_fn(|bit| if n >> bit & 1 == 0 { 0 } else { top });
            let gradient = Gradient::new(&triangle, z);
            let [ox, oy] = grid.offset;
            let offset = gradient.x * (ox - x0) + gradient.y * (oy - y0);
            // A quotient divides the whole plane, a reciprocal only what the anchor lacks.
            let whole = match depth.division {
                crate::setup::Division::Quotient => z[0] * gradient.area2 + offset,
                crate::setup::Division::Reciprocal { .. } => offset,
            };
            start = whole.abs().max(start);
            slope = gradient.x.abs().max(gradient.y.abs()).max(slope);
        }
    }
    match depth.division {
        crate::setup::Division::Quotient => {
            let fraction = depth.interpolation;
            (signed_bits(start) + fraction).max(signed_bits(slope) + grid.sub_pixel + fraction)
        }
        // Here the product is wide, and the scale is a choice of its bits.
        crate::setup::Division::Reciprocal { bits } => signed_bits(start.max(slope)) + bits,
    }
}

#[cfg(test)]
mod tests;
