//! Where the registers of the engine lie.

use super::part::{BoxEnds, BoxLimit, EdgeBox, EdgeSource};
use super::value::ValueSource;
use super::{EdgeEngineConfig, NAME};
use crate::format::Gather;
use crate::machine::register::input::{Inputs, RegisterError};
use crate::value::Channel;

/// Where edge words come from.
#[derive(Clone, Debug)]
pub(super) enum EdgeWires {
    /// Value, change to the right, change down; of each edge.
    Given([[Gather; 3]; 3]),
    /// x and y of each vertex.
    Vertices([[Gather; 2]; 3]),
}

/// Where what a box is cut to comes from.
#[derive(Clone, Debug)]
pub(super) enum LimitWires {
    None,
    Size([u32; 2]),
    /// Width and height, as powers of two or as they are.
    Size2 {
        size: [Gather; 2],
        exponents: bool,
    },
    /// Left, top, right and bottom.
    Rectangle([Gather; 4], BoxEnds),
}

/// Where everything comes from.
#[derive(Clone, Debug)]
pub(super) struct Wires {
    pub(super) edges: EdgeWires,
    pub(super) limit: LimitWires,
    /// Of each channel: start and slopes, or a value at each vertex.
    pub(super) values: Vec<[Gather; 3]>,
}

/// The names of a rectangle.
pub(super) const ENDS: [&str; 4] = ["left", "top", "right", "bottom"];

impl EdgeEngineConfig {
    /// The rectangle of registers that it has.
    pub(super) fn rectangle(&self) -> Option<BoxEnds> {
        match self.r#box {
            EdgeBox::Given(ends) | EdgeBox::Vertices { limit: BoxLimit::Rectangle(ends), .. } => {
                Some(ends)
            }
            EdgeBox::Vertices { .. } => None,
        }
    }

    /// The registers, by name.
    pub(super) fn wires(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
    ) -> Result<Wires, RegisterError> {
        let edges = match self.edges {
            EdgeSource::Given { .. } => EdgeWires::Given([
                inputs.all(NAME, ["e0", "e0_dx", "e0_dy"])?,
                inputs.all(NAME, ["e1", "e1_dx", "e1_dy"])?,
                inputs.all(NAME, ["e2", "e2_dx", "e2_dy"])?,
            ]),
            EdgeSource::Vertices { .. } => EdgeWires::Vertices([
                inputs.all(NAME, ["x0", "y0"])?,
                inputs.all(NAME, ["x1", "y1"])?,
                inputs.all(NAME, ["x2", "y2"])?,
            ]),
        };
        let limit = match (self.rectangle(), self.r#box) {
            (Some(ends), _) => LimitWires::Rectangle(inputs.all(NAME, ENDS)?, ends),
            (None, EdgeBox::Vertices { limit: BoxLimit::Size(size), .. }) => LimitWires::Size(size),
            (None, EdgeBox::Vertices { limit: BoxLimit::SizeRegisters, .. }) => {
                let size = inputs.all(NAME, ["width", "height"])?;
                LimitWires::Size2 { size, exponents: false }
            }
            (None, EdgeBox::Vertices { limit: BoxLimit::ExponentRegisters, .. }) => {
                let size = inputs.all(NAME, ["width_log2", "height_log2"])?;
                LimitWires::Size2 { size, exponents: true }
            }
            (None, _) => LimitWires::None,
        };
        let names = match self.values {
            Some(ValueSource::Given { .. }) => ["", "_dx", "_dy"],
            _ => ["0", "1", "2"],
        };
        let values = channels.iter().map(|channel| {
            let [a, b, c] = names.map(|end| format!("{}{end}", channel.name));
            inputs.all(NAME, [a.as_str(), &b, &c])
        });
        Ok(Wires { edges, limit, values: values.collect::<Result<_, _>>()? })
    }
}
