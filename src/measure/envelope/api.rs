//! The APIs that are known here, and what each leaves open. Spec clauses `EN-2` to `EN-5`.

use super::error::EnvelopeError;
use super::rule::Rule;
use super::snap::Snap;
use crate::bits::Rounding;
use std::str::FromStr;

/// An API in the version whose text the clauses cite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Api {
    /// Vulkan 1.3.
    Vulkan,
    /// Direct3D 11.3.
    D3d11,
    /// WebGPU, the draft of the W3C.
    WebGpu,
    /// OpenGL 4.6, core profile.
    OpenGl,
}

impl Api {
    /// Every API that is known here.
    pub const ALL: [Self; 4] = [Self::Vulkan, Self::D3d11, Self::WebGpu, Self::OpenGl];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Vulkan => "vulkan",
            Self::D3d11 => "d3d11",
            Self::WebGpu => "webgpu",
            Self::OpenGl => "opengl",
        }
    }

    /// The text that its clauses cite.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Vulkan => "Vulkan 1.3",
            Self::D3d11 => "Direct3D 11.3",
            Self::WebGpu => "WebGPU (W3C draft)",
            Self::OpenGl => "OpenGL 4.6",
        }
    }

    /// The fewest and the most sub-pixel bits that its text allows; no text but Direct3D's has a most. Spec
    /// clause `EN-2`.
    pub const fn bits(self) -> (u32, Option<u32>) {
        match self {
            Self::D3d11 => (8, Some(8)),
            Self::Vulkan | Self::WebGpu | Self::OpenGl => (4, None),
        }
    }

    /// How it lets a coordinate be rounded to the sub-pixel grid. Spec clause `EN-3`.
    pub fn snaps(self) -> Vec<Snap> {
        match self {
            Self::D3d11 => {
                vec![Snap::Round(Rounding::NearestEven), Snap::TolerantUp, Snap::TolerantDown]
            }
            Self::Vulkan | Self::WebGpu | Self::OpenGl => {
                Rounding::ALL.into_iter().map(Snap::Round).collect()
            }
        }
    }

    /// The one rule for samples on edges, if the text has one. Spec clause `EN-5`.
    pub const fn rule(self) -> Option<Rule> {
        match self {
            Self::D3d11 => Some(Rule::TOP_LEFT),
            Self::Vulkan | Self::WebGpu | Self::OpenGl => None,
        }
    }
}

impl FromStr for Api {
    type Err = EnvelopeError;

    /// Reads `vulkan`, or the name with the version of that text: `vulkan-1.3`.
    fn from_str(name: &str) -> Result<Self, EnvelopeError> {
        match name {
            "vulkan" | "vulkan-1.3" => Ok(Self::Vulkan),
            "d3d11" | "d3d11.3" => Ok(Self::D3d11),
            "webgpu" => Ok(Self::WebGpu),
            "opengl" | "opengl-4.6" => Ok(Self::OpenGl),
            _ => Err(EnvelopeError::Api { name: name.to_owned() }),
        }
    }
}
