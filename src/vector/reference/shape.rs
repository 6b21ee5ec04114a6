//! What a reference is written of: how a profile covers samples, its depth, its samples in a pixel.

use crate::cover::{DepthAt, EdgeStorage, EdgeWordConfig, FillRule, SampleGrid};
use crate::format::{Clamp, ReadOut};
use crate::machine::EdgeWalkConfig;
use crate::profile::Profile;
use crate::setup::Division;
use crate::value::DepthConfig;

/// What decides coverage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coverage {
    /// Three edge words over a box; of a machine that chooses tiles first, the side of a tile.
    Edges(EdgeWordConfig, Option<u32>),
    /// An x walked down the edges.
    Walk(EdgeWalkConfig),
}

/// What a reference is written of.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    pub(super) coverage: Coverage,
    pub(super) depth: Option<DepthConfig>,
    /// The places of the samples in a pixel, in sub-pixels.
    pub(super) samples: Vec<[i128; 2]>,
    /// Where several samples share a depth.
    pub(super) centre: Option<[i128; 2]>,
    /// Whether the profile has `[multisample]`.
    pub(super) several: bool,
    /// Low bits of an edge value that are not kept.
    pub(super) shift: u32,
}

impl Shape {
    /// What a profile is, or why no reference can be written of it.
    pub(super) fn of(profile: &Profile) -> Result<Self, String> {
        let form = &profile.form;
        let walk = form.walk().filter(|_| form.walks_a_plane());
        let coverage = match (form.edge(), walk) {
            (Some(edge), _) if form.visits_the_box() || form.tile().is_some() => {
                Coverage::Edges(*edge, form.tile())
            }
            (_, Some(walk)) if walk.clamp != Clamp::Guard => {
                let clamp = walk.clamp.name();
                return Err(format!(
                    "clamp of the walk is {clamp}: the texts read a walked x as under guard"
                ));
            }
            (_, Some(walk)) => Coverage::Walk(*walk),
            _ => return Err(format!("the machine is {}", form.engine())),
        };
        if profile.conservative().is_some() {
            return Err(
                "coverage is conservative: the texts cover samples, and no squares".to_owned()
            );
        }
        if let Some(depth) = &profile.depth {
            check(depth)?;
        }
        if profile.cull.is_some() {
            return Err("[cull] is given, and the texts draw every triangle with area".to_owned());
        }
        let grid = profile.grid().map_err(|error| error.to_string())?;
        let several = profile.multisample.map_or_else(Vec::new, |all| all.grids(grid.sub_pixel));
        if !several.iter().chain([&grid]).all(SampleGrid::is_on_the_grid) {
            return Err("samples lie between the sub-pixels, and the texts take them on the grid"
                .to_owned());
        }
        if profile.multisample.is_some_and(|all| all.mask.is_some()) {
            return Err("the profile has a sample mask, and the texts draw every sample".to_owned());
        }
        let (mut samples, mut centre) = (vec![grid.offset], None);
        if let Some(config) = &profile.multisample {
            if walk.is_some() {
                let reason = "it walks edges for several samples in a pixel";
                return Err(reason.to_owned());
            }
            samples = config.grids(grid.sub_pixel).iter().map(|grid| grid.offset).collect();
            let shared = config.depth == DepthAt::Centre && profile.depth.is_some();
            centre = shared.then_some(grid.offset);
        }
        let shift = match coverage {
            Coverage::Edges(edge, _) if edge.storage == EdgeStorage::Shifted => grid.sub_pixel,
            _ => 0,
        };
        let (depth, several) = (profile.depth, profile.multisample.is_some());
        Ok(Self { coverage, depth, samples, centre, several, shift })
    }

    /// Whether edge words of one sample a pixel and depth are all there is.
    pub(super) const fn is_plain(&self) -> bool {
        let edges = matches!(self.coverage, Coverage::Edges(_, None));
        edges && self.depth.is_some() && !self.several
    }

    /// What the templates are told.
    pub(super) fn flags(&self) -> Vec<&'static str> {
        let (edges, tiles) = match self.coverage {
            Coverage::Edges(_, tile) => (true, tile.is_some()),
            Coverage::Walk(_) => (false, false),
        };
        let depth = self.depth.is_some();
        [
            ("depth", depth),
            ("edges", edges),
            ("tiles", tiles),
            ("plain_edges", edges && !tiles),
            ("walk", !edges),
            ("words", edges || depth),
            ("quotients", !edges || depth),
            ("several", self.several),
            ("centre", self.centre.is_some()),
            ("at_samples", self.several && depth && self.centre.is_none()),
            ("rich", !self.is_plain()),
            ("stepped", self.is_plain()),
        ]
        .into_iter()
        .filter_map(|(flag, set)| set.then_some(flag))
        .collect()
    }

    /// The units of the self test.
    pub(super) fn units(&self) -> Vec<&'static str> {
        let step = match self.coverage {
            Coverage::Edges(..) => "the edge stepper",
            Coverage::Walk(_) => "the walked x",
        };
        let dda = self.depth.map(|_| "the DDA");
        dda.into_iter().chain([step, "the set-up", "the samples"]).collect()
    }

    /// The register of depth.
    pub(super) fn depth_read(&self) -> Option<ReadOut> {
        let DepthConfig { guard, integer, interpolation, clamp, .. } = self.depth?;
        ReadOut::new(guard, integer, interpolation, clamp).ok()
    }

    /// The register of an edge word, or of a walked x.
    pub(super) fn step_read(&self) -> ReadOut {
        let read = match self.coverage {
            Coverage::Edges(edge, _) => edge.read_out(),
            Coverage::Walk(EdgeWalkConfig { guard, integer, fraction, .. }) => {
                ReadOut::new(guard, integer, fraction, Clamp::Guard).ok()
            }
        };
        read.unwrap_or_else(|| unreachable!("a valid profile"))
    }

    /// When an edge owns its samples, in C and SystemVerilog. Clauses `C-2` and `C-3`.
    pub(super) const fn owns(&self) -> &'static str {
        match self.coverage {
            Coverage::Edges(EdgeWordConfig { rule: FillRule::Shadow, .. }, _) => {
                "ey > 0 || (ey == 0 && ex > 0)"
            }
            _ => "ey < 0 || (ey == 0 && ex > 0)",
        }
    }
}

/// Whether the texts know what a depth asks for.
fn check(depth: &DepthConfig) -> Result<(), String> {
    let reason = match (depth.division, depth.clamp) {
        _ if depth.format.is_some() => "depth is stored in another format, as [depth.format] asks",
        _ if depth.bias.is_some() => "[depth.bias] is given: the set-up adds no depth bias",
        (Division::Quotient, Clamp::Saturate) => {
            "clamp is saturate: what a sticky accumulator holds depends on the order of the samples"
        }
        (Division::Quotient, Clamp::Error) => {
            "clamp is error: a refused triangle has no rows, and no text can refuse one"
        }
        (Division::Quotient, _) => return Ok(()),
        _ => "division is not quotient: the set-up divides exactly, not by a reciprocal",
    };
    Err(reason.to_owned())
}
