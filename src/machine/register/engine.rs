//! The list of engines: one line each. What an engine does is asked through [`EngineForm`].

use super::input::{Inputs, RegisterError};
use super::{RegisterConfig, RegisterDevice};
use crate::machine::{Step, Target, Word};
use crate::setup::{Triangle, VertexConfig};
use crate::value::Channel;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What turns words into records.
pub(super) trait Engine: Send + Sync + std::fmt::Debug {
    /// Draws what the words say; `emit` takes the kind of a record and its values.
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64]));

    /// The most steps that these words take, found without drawing; more may be said of words that take no more
    /// than `most`. Spec clause `RG-23`.
    fn work(&self, words: &[u32], most: u64) -> u128;

    /// The words that a host would write for a triangle, one list or more, each of `count` words.
    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>>;
}

/// An engine, and the names of the values of each kind of record that it writes.
pub(super) type Built = (Box<dyn Engine>, Vec<Vec<String>>);

/// The registers of a clip rectangle, by name.
pub(super) struct ClipNames {
    /// Left, top, right and bottom.
    pub(super) ends: [&'static str; 4],
    /// Whether they are in sub-pixels.
    pub(super) sub_pixels: bool,
    /// What says whether there is one.
    pub(super) on: Option<&'static str>,
}

/// An engine as a profile configures it.
pub(super) trait EngineForm {
    /// The name profiles use.
    fn name(&self) -> &'static str;

    /// The registers of its clip rectangle, if it has one.
    fn clip(&self) -> Option<ClipNames>;

    /// Whether slopes can have fewer bits than what they are added to.
    fn cuts_slopes(&self) -> bool {
        false
    }

    /// The word that decides coverage; `None` where sides are exact.
    fn edge_word(&self) -> Option<Word>;

    /// The device that the machine's engine, this one, asks for.
    fn device(&self, machine: &RegisterConfig) -> Option<RegisterDevice>;

    /// Every configuration one decision away.
    fn neighbours(&self) -> Vec<Step<EngineConfig>>;
}

macro_rules! engines {
    ($($(#[$doc:meta])* $variant:ident($config:ty);)*) => {
        /// How registers become fragments.
        #[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[cfg_attr(feature = "verification", derive(JsonSchema))]
        #[serde(rename_all = "kebab-case", deny_unknown_fields)]
        pub enum EngineConfig {
            $($(#[$doc])* $variant($config),)*
        }

        impl EngineConfig {
            /// The engine's configuration.
            pub(super) fn form(&self) -> &dyn EngineForm {
                match self {
                    $(Self::$variant(config) => config,)*
                }
            }

            /// The engine, if it goes with registers, channels and vertices.
            pub(super) fn engine(
                &self,
                inputs: &Inputs<'_>,
                channels: &[Channel],
                vertex: &VertexConfig,
                target: Target,
            ) -> Result<Built, RegisterError> {
                match self {
                    $(Self::$variant(config) => config.engine(inputs, channels, vertex, target),)*
                }
            }

            /// The name profiles use.
            pub fn name(&self) -> &'static str {
                self.form().name()
            }
        }

        $(impl From<$config> for EngineConfig {
            fn from(config: $config) -> Self {
                Self::$variant(config)
            }
        })*
    };
}

engines! {
    /// Wrapping edge functions over quads of 2 x 2 pixels.
    Quads(super::QuadConfig);
    /// Vertices, exact spans, and planes anchored at one vertex.
    Anchored(super::AnchoredConfig);
    /// Edges walked by their slopes, one row at a time.
    Slopes(super::SlopeConfig);
    /// Edges walked by their slopes, four sub-scanlines a row.
    SubScanlines(super::SubScanlineConfig);
    /// Edge functions with linear channels, made of parts.
    EdgeFunctions(super::EdgeEngineConfig);
    /// Lines by a stepper of parts, fills between them, and fans of them.
    Lines(super::LinesConfig);
}
