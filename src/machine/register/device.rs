//! What devices in hardware are told of an engine, and what they take for granted.

use super::RegisterConfig;
use crate::bits::Rounding;

/// What a device of given edge functions is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuadDevice {
    /// Bits of an edge word.
    pub edge: u32,
    /// Pixels on a side of a tile.
    pub tile: u32,
    /// Pixels on a side of a block.
    pub block: u32,
    /// Bits of a register of a pixel coordinate.
    pub coordinate: u32,
}

/// An engine whose device is wired for one list of registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WiredEngine {
    /// Planes anchored at a vertex.
    Anchored,
    /// Quads of edge functions that it makes of vertices.
    VertexQuads,
    /// Edges that are given.
    GivenSlopes,
    /// Edges that it divides from vertices.
    DividedSlopes,
    /// Four sub-scanlines a row.
    SubScanlines,
}

/// A device that is wired for one list of registers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WiredDevice {
    /// What it draws with.
    pub engine: WiredEngine,
    /// Its parameters.
    pub values: Vec<(&'static str, i128)>,
    /// What it takes for granted, and a text of the engine is told.
    pub facts: Vec<(&'static str, i128)>,
    /// How it rounds its slopes, where the profile says so.
    pub rounding: Option<Rounding>,
    /// The machine, with one and the same value in each field that a parameter sets: two machines with equal
    /// ones have the same device.
    pub wiring: Box<RegisterConfig>,
}

/// The device that an engine asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RegisterDevice {
    /// One that takes edge functions in registers of any width.
    Quads(QuadDevice),
    /// One that is wired for a list of registers.
    Wired(WiredDevice),
}

impl RegisterDevice {
    pub(super) fn wired(
        engine: WiredEngine,
        [values, facts]: [Vec<(&'static str, i128)>; 2],
        wiring: RegisterConfig,
    ) -> Self {
        let wiring = Box::new(wiring);
        Self::Wired(WiredDevice { engine, values, facts, rounding: None, wiring })
    }
}

impl WiredDevice {
    /// A parameter; 0 without one of this name.
    pub fn value(&self, name: &str) -> i128 {
        Self::named(&self.values, name)
    }

    /// What it takes for granted; 0 without one of this name.
    pub fn fact(&self, name: &str) -> i128 {
        Self::named(&self.facts, name)
    }

    fn named(list: &[(&'static str, i128)], name: &str) -> i128 {
        list.iter().find(|(known, _)| *known == name).map_or(0, |(_, value)| *value)
    }
}
