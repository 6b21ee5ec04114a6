//! The engine `quads` as a text. Spec clauses `RG-5` to `RG-7`.

use super::engine::{EngineText, Port, pixel};
use crate::format::Layout;
use crate::machine::{QuadDevice, WiredDevice};
use crate::vector::package::device_name;
use crate::vector::reference::stimulus::register::{self, Registers};

const ENDS: [&str; 4] = ["left", "top", "right", "bottom"];

pub(super) struct Quads {
    device: &'static str,
    edge: i128,
    /// Pixels on a side of a tile and of a block; 0 without a descent.
    tile: i128,
    block: i128,
    truncated: bool,
    masks: bool,
    /// Of vertices: whether they have a sign, the sample in its pixel, and the largest end of a range.
    vertices: Option<(bool, [i128; 2], i128)>,
}

impl Quads {
    /// Edges that are given.
    pub(super) fn given(device: QuadDevice) -> Self {
        let QuadDevice { edge, tile, block, .. } = device;
        Self {
            device: "quad_engine",
            edge: edge.into(),
            tile: tile.into(),
            block: block.into(),
            truncated: false,
            masks: true,
            vertices: None,
        }
    }

    /// Edges of vertices.
    pub(super) fn of_vertices(
        device: &WiredDevice,
        input: &Layout,
        (signed, sample): (bool, [i128; 2]),
    ) -> Self {
        let bits = ENDS.iter().filter_map(|name| input.find(name)).map(|end| end.bits()).min();
        Self {
            device: device_name(device.engine),
            edge: device.fact("EDGE"),
            tile: device.fact("TILE"),
            block: device.fact("BLOCK"),
            truncated: device.fact("TRUNCATED") != 0,
            masks: device.fact("MASKS") != 0,
            vertices: Some((signed, sample, (1 << bits.unwrap_or(0)) - 1)),
        }
    }
}

impl EngineText for Quads {
    fn device(&self) -> &'static str {
        self.device
    }

    fn templates(&self) -> [&'static str; 2] {
        [include_str!("../quads.c.in"), include_str!("../quads.py.in")]
    }

    fn flags(&self) -> Vec<&'static str> {
        let flags = [
            ("given", self.vertices.is_none()),
            ("truncated", self.truncated),
            ("descent", self.tile > 0),
            ("masks", self.masks),
        ];
        let applies = flags.into_iter().filter(|(_, applies)| *applies);
        ["quads"].into_iter().chain(applies.map(|(flag, _)| flag)).collect()
    }

    fn keys(&self, _: bool) -> Vec<(&'static str, String)> {
        let (_, sample, largest) = self.vertices.unwrap_or_default();
        let numbers = [
            ("EDGE", self.edge),
            ("TILE", self.tile),
            ("BLOCK", self.block),
            ("OFFSET_X", sample[0]),
            ("OFFSET_Y", sample[1]),
            ("LARGEST", largest),
        ];
        numbers.map(|(key, value)| (key, value.to_string())).into()
    }

    fn ports(&self) -> Vec<Port> {
        if let Some((signed, ..)) = self.vertices {
            let ends = ENDS.map(Port::plain);
            return Port::vertices(signed).into_iter().chain(ends).collect();
        }
        let pixels = ["tile_x", "tile_y", "x_min", "x_max", "y_min", "y_max"].map(Port::plain);
        let word = |name: &'static str| {
            (0..3).map(move |k| Port::entry(format!("{name}{k}"), name, k, true))
        };
        pixels.into_iter().chain(["a", "b", "c"].into_iter().flat_map(word)).collect()
    }

    fn values(&self, _: usize) -> Vec<(String, String)> {
        let mut values: Vec<_> = pixel().into();
        let mut add = |value: String| values.push((format!("(uint64_t){value}"), value));
        if self.masks {
            add("mask".to_owned());
        }
        for k in 0..3 {
            if self.masks {
                (0..4).for_each(|place| add(format!("e[{k}][{place}]")));
            } else {
                add(format!("e[{k}]"));
            }
        }
        values
    }

    fn registers(&self) -> Box<dyn Registers + '_> {
        match self.vertices {
            None => Box::new(register::GivenQuads { tile: self.tile, edge: self.edge }),
            Some((_, sample, largest)) => Box::new(register::VertexQuads { largest, sample }),
        }
    }
}
