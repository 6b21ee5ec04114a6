//! The words a machine takes and makes. Files, packages and waveforms derive from these.

use super::register::Registers;
use crate::format::{Column, Role, Word};
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
            let word = Word::signed(read.width()).fraction(read.fraction());
            setup.extend(
                [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY].map(|role| role.column(word)),
            );
        }
        Self::valued(vertex, setup, depth)
    }

    /// The ports of a triangle machine whose set-up has these columns, those of its depth among
    /// them.
    pub fn valued(vertex: &VertexConfig, setup: Vec<Column>, depth: Option<Depth>) -> Self {
        let (low, high) = vertex.range();
        let signed = low < 0;
        let width = i128::BITS - high.leading_zeros() + u32::from(signed);
        let coordinate = if signed { Word::signed(width) } else { Word::unsigned(width) };
        let coordinate = coordinate.fraction(vertex.sub_pixel);
        let mut input = Vec::new();
        for n in 0..3 {
            input.extend([Role::VERTEX_X, Role::VERTEX_Y].map(|role| role.of(n, coordinate)));
            input.extend(
                depth.map(|depth| Role::VERTEX_Z.of(n, Word::unsigned(depth.read_out().integer()))),
            );
        }
        let depth = depth.map(|depth| {
            let column = Role::DEPTH.column(Word::unsigned(depth.code_bits()));
            if depth.config().format.is_none() {
                return column;
            }
            let meaning = "Depth as stored, in the profile's depth format.".to_owned();
            Column { meaning, ..column }
        });
        Self { input, setup, depth, mask: None, by_sample: false, registers: None }
    }
}
