//! What a profile's datapath costs in hardware, estimated from its bits alone.
//! Spec clauses `H-1` to `H-4`.
//!
//! Every figure is an estimate for comparing budgets: registers and adders are counted, area and
//! delay are interpolated from measured adders of one process, the open 45 nm library Nangate45 at
//! its typical corner, before placement. [`synthesise`] asks a synthesis tool instead.

mod adder;
mod operations;
mod synthesis;

pub use operations::{Count, Operations};
pub use synthesis::{
    Source, Synthesis, SynthesisError, UnitSynthesis, YOSYS, sources, synthesise, synthesise_unit,
};

use crate::cover::{EdgeStorage, EdgeWordConfig, SampleGrid};
use crate::format::Clamp;
use crate::machine::{EdgeWalkConfig, ScanlineConfig};
use crate::profile::{Form, InvalidProfile, Profile};
use crate::setup::{EdgeCoefficients, Gradient, Triangle, VertexConfig};
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
}

/// Equal DDAs that step together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Unit {
    /// `edge` or `depth`.
    pub name: &'static str,
    /// How many of them.
    pub copies: u32,
    /// Bits of the accumulator of each.
    pub width: u32,
    /// Register bits of all copies. A planar DDA holds accumulator, row start and two slopes; the
    /// linear DDA of an edge walk holds accumulator and slope.
    pub register_bits: u32,
    /// Adder bits of all copies: one adder of the accumulator's width each, which the operands of
    /// a step right and of a step down share.
    pub adder_bits: u32,
    /// Whether its read-out clamps.
    pub clamp: bool,
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
/// [`InvalidProfile`] if its parts do not go together.
pub fn estimate(profile: &Profile) -> Result<Cost, InvalidProfile> {
    profile.validate()?;
    let grid = profile.grid()?;
    let units = units(profile);
    let sum = |bits: fn(&Unit) -> u32| units.iter().map(bits).sum();
    let vertex = &profile.vertex;
    let edge_bits = match (&profile.form, profile.form.edge(), profile.form.walk()) {
        (_, Some(edges), _) => edge_setup_bits(*edges, vertex, &grid),
        (.., Some(walk)) => walk_setup_bits(walk, vertex, &grid),
        (Form::Homogeneous(machine), ..) => machine.edge_width(vertex) + 1,
        _ => ScanlineConfig::width(vertex),
    };
    let depth_bits = profile.depth.map_or(0, |d| depth_setup_bits(&d, &profile.vertex, &grid));
    Ok(Cost {
        register_bits: sum(|unit| unit.register_bits),
        adder_bits: sum(|unit| unit.adder_bits),
        setup_bits: edge_bits.max(depth_bits),
        ripple: area_and_clock(profile, &units, adder::ripple),
        prefix: area_and_clock(profile, &units, adder::prefix),
        operations: operations::count(profile),
        units,
    })
}

/// The units of a valid profile. Spec clause `H-1`.
fn units(profile: &Profile) -> Vec<Unit> {
    let unit = |name, copies, width, registers, clamp| Unit {
        name,
        copies,
        width,
        register_bits: copies * width * registers,
        adder_bits: copies * width,
        clamp,
    };
    let edge = match (&profile.form, profile.form.edge(), profile.form.walk()) {
        (_, Some(edges), _) => unit("edge", 3, edges.width, 4, false),
        // Two of three edges are walked at a time; the third waits in set-up.
        (.., Some(EdgeWalkConfig { guard, integer, fraction, .. })) => {
            unit("edge", 2, guard + integer + fraction, 2, false)
        }
        (Form::Homogeneous(machine), ..) => {
            unit("edge", 3, machine.edge_width(&profile.vertex), 4, false)
        }
        // A quotient and a remainder, each with its step.
        _ => unit("edge", 2, ScanlineConfig::width(&profile.vertex), 2, false),
    };
    let mut units = vec![edge];
    if let Some(depth) = profile.depth {
        let width = depth.guard + depth.integer + depth.interpolation;
        let clamps = depth.clamp != Clamp::Wrap;
        match profile.form {
            Form::Gouraud(_) => {
                units.push(unit("edge-depth", 2, width, 2, false));
                units.push(unit("depth", 1, width, 2, clamps));
            }
            // Its multipliers are combinational: they are in the operations, not here.
            Form::Barycentric(machine) => {
                units.push(unit("share", 2, machine.coordinate_width(), 4, clamps));
            }
            _ => units.push(unit("depth", 1, width, 4, clamps)),
        }
    }
    units
}

/// Spec clause `H-2`.
fn area_and_clock(profile: &Profile, units: &[Unit], adder: fn(u32) -> Adder) -> Estimate {
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
    Estimate { area_um2, delay_ps, clock_mhz: 1e6 / delay_ps }
}

/// Bits of a two's complement word for values of up to this magnitude, of either sign.
fn signed_bits(magnitude: i128) -> u32 {
    1 + i128::BITS - magnitude.leading_zeros()
}

/// The ends of the vertex field chosen by the bits of `n`: what is linear in each coordinate has
/// its extremes there.
fn corners<const C: usize>(vertex: &VertexConfig) -> impl Iterator<Item = [i128; C]> {
    let (low, high) = vertex.range();
    (0..1usize << C)
        .map(move |n| std::array::from_fn(|bit| if n >> bit & 1 == 0 { low } else { high }))
}

/// The edge constants: E at the window's origin and at the first sample, before any shift.
fn edge_setup_bits(edges: EdgeWordConfig, vertex: &VertexConfig, grid: &SampleGrid) -> u32 {
    let origin = corners::<4>(vertex)
        .map(|[ax, ay, bx, by]| EdgeCoefficients::between([ax, ay], [bx, by]).c.abs())
        .max()
        .map_or(1, signed_bits);
    let full = EdgeWordConfig { storage: EdgeStorage::Full, ..edges };
    origin.max(full.exact_width(vertex, grid, (1, 1)))
}

/// The dividend of an edge walk's start: x times the height plus the part of the first row times
/// the width, over a sub-pixel more, scaled by the fraction.
fn walk_setup_bits(walk: &EdgeWalkConfig, vertex: &VertexConfig, grid: &SampleGrid) -> u32 {
    let first_row = [0, (1 << grid.sub_pixel) - 1];
    let dividend = corners::<4>(vertex)
        .flat_map(|[ax, ay, bx, by]| {
            first_row.map(|below| (ax * (by - ay) + below * (bx - ax)).abs())
        })
        .max();
    dividend.map_or(1, signed_bits) + walk.fraction
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
