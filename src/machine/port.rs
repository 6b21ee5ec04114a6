//! The words a machine takes and makes. Files, packages and waveforms derive from these.

use super::channels::ChannelPort;
use super::register::Registers;
use crate::bits::{self, WidthError};
use crate::format::{Column, FractionMismatch, QFormat, Role, Unreduced, WordFormat};
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
    /// The channels of the profile.
    pub channels: Vec<ChannelPort>,
    /// The words of a machine that begins at registers.
    pub registers: Option<Registers>,
}

/// Set-up values that do not go with the columns of their machine.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SetupError {
    /// Another number of values.
    #[error("{got} set-up values for {need} columns")]
    Count {
        /// Columns.
        need: usize,
        /// Values.
        got: usize,
    },
    /// A column no word can have.
    #[error("column {name}: {source}")]
    Width {
        /// The column.
        name: String,
        /// Why.
        source: WidthError,
    },
    /// A value in other units than its column.
    #[error("column {name}: {source}")]
    Units {
        /// The column.
        name: String,
        /// Why.
        source: FractionMismatch,
    },
}

impl Ports {
    /// The set-up words of these values: each mod 2^N of its column, whose units it must count.
    ///
    /// # Errors
    /// [`SetupError`] if there are more or fewer values than columns, or one counts other units.
    pub fn words(&self, values: &[Unreduced]) -> Result<Vec<bits::Word<QFormat>>, SetupError> {
        let (need, got) = (self.setup.len(), values.len());
        if need != got {
            return Err(SetupError::Count { need, got });
        }
        let word = |(column, value): (&Column, &Unreduced)| {
            let name = || column.name.clone();
            let format =
                column.format().map_err(|source| SetupError::Width { name: name(), source })?;
            value.reduce(format).map_err(|source| SetupError::Units { name: name(), source })
        };
        self.setup.iter().zip(values).map(word).collect()
    }

    /// The ports of a triangle machine whose coverage set-up has these columns, and whose depth
    /// is a plane.
    pub fn triangle(vertex: &VertexConfig, mut setup: Vec<Column>, depth: Option<Depth>) -> Self {
        if let Some(read) = depth.map(|depth| depth.read_out()) {
            let word = WordFormat::signed(read.width()).fraction(read.fraction());
            setup.extend(
                [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY].map(|role| role.column(word)),
            );
        }
        Self::valued(vertex, setup, depth)
    }

    /// The ports of a triangle machine whose set-up has these columns, those of its depth among
    /// them.
    pub fn valued(vertex: &VertexConfig, setup: Vec<Column>, depth: Option<Depth>) -> Self {
        let word = if vertex.signed { WordFormat::signed } else { WordFormat::unsigned };
        let coordinate = word(vertex.bits()).fraction(vertex.sub_pixel);
        let mut input = Vec::new();
        for n in 0..3 {
            input.extend([Role::VERTEX_X, Role::VERTEX_Y].map(|role| role.of(n, coordinate)));
            input.extend(depth.map(|depth| {
                Role::VERTEX_Z.of(n, WordFormat::unsigned(depth.read_out().integer()))
            }));
        }
        let depth = depth.map(|depth| {
            let column = Role::DEPTH.column(WordFormat::unsigned(depth.code_bits()));
            if depth.config().format.is_none() {
                return column;
            }
            let meaning = "Depth as stored, in the profile's depth format.".to_owned();
            Column { meaning, ..column }
        });
        Self {
            input,
            setup,
            depth,
            mask: None,
            by_sample: false,
            channels: Vec::new(),
            registers: None,
        }
    }
}
