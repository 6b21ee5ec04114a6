//! The words a machine takes and makes. Files, packages and waveforms derive from these.

use super::register::Registers;
use crate::format::Column;
use crate::setup::VertexConfig;
use crate::value::Depth;

/// Columns of a machine's inputs and outputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ports {
    /// Vertices.
    pub input: Vec<Column>,
    /// Set-up results.
    pub setup: Vec<Column>,
    /// The depth value of a sample, if the profile has depth.
    pub depth: Option<Column>,
    /// The coverage mask of a pixel, where there are several samples.
    pub mask: Option<Column>,
    /// Whether depth is that of every covered sample of a pixel, and not one a pixel.
    pub by_sample: bool,
    /// The words of a machine that begins at registers.
    pub registers: Option<Registers>,
}

impl Ports {
    /// The ports of a triangle machine whose coverage set-up has these columns, and whose depth
    /// is a plane.
    pub fn triangle(vertex: &VertexConfig, mut setup: Vec<Column>, depth: Option<Depth>) -> Self {
        if let Some(read) = depth.map(|depth| depth.read_out()) {
            let (width, fraction) = (read.width(), read.fraction());
            let column = |name, meaning| Column::new(name, width, true, fraction, meaning);
            setup.push(column("z", "Depth accumulator at pixel (0, 0)."));
            setup.push(column("dzdx", "Depth slope per pixel to the right."));
            setup.push(column("dzdy", "Depth slope per row downward."));
        }
        Self::valued(vertex, setup, depth)
    }

    /// The ports of a triangle machine whose set-up has these columns, those of its depth among
    /// them.
    pub fn valued(vertex: &VertexConfig, setup: Vec<Column>, depth: Option<Depth>) -> Self {
        let (low, high) = vertex.range();
        let signed = low < 0;
        let width = i128::BITS - high.leading_zeros() + u32::from(signed);
        let mut input = Vec::new();
        for n in 0..3 {
            for axis in ["x", "y"] {
                let meaning = format!("Vertex {n}, {axis} in sub-pixels.");
                input.push(Column::new(
                    &format!("{axis}{n}"),
                    width,
                    signed,
                    vertex.sub_pixel,
                    &meaning,
                ));
            }
            if let Some(depth) = depth {
                let (bits, meaning) =
                    (depth.read_out().integer(), format!("Vertex {n}, depth code."));
                input.push(Column::new(&format!("z{n}"), bits, false, 0, &meaning));
            }
        }
        let depth = depth.map(|depth| {
            let meaning = match depth.config().format {
                None => "Depth read-out after the clamp.",
                Some(_) => "Depth as stored, in the profile's depth format.",
            };
            Column::new("z", depth.code_bits(), false, 0, meaning)
        });
        Self { input, setup, depth, mask: None, by_sample: false, registers: None }
    }
}
