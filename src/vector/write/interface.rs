//! What the generated files of a set depend on: read-out, set-up and engine, as the profile has them.

mod units;

use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule};
use crate::format::{Clamp, ReadOut};
use crate::machine::RegisterDevice;
use crate::model::MODEL_VERSION;
use crate::profile::{BUILTIN, Profile, builtin};
use crate::setup::Division;
use crate::value::{DepthConfig, StartBias};
use crate::vector::manifest::FileEntry;
use crate::vector::package::{
    ClampParameters, EngineParameters, FileLayout, Interface, SetupParameters,
};
use units::units;

/// What the generated files of a set depend on.
pub(super) fn interface(set: &str, profile: &Profile, files: &[FileEntry]) -> Interface {
    let clamp = match profile.depth {
        Some(depth) => ClampParameters {
            guard: depth.guard,
            integer: depth.integer,
            fraction: depth.interpolation,
            mode: depth.clamp,
        },
        None => ClampParameters { guard: 0, integer: 1, fraction: 0, mode: Clamp::Wrap },
    };
    let files = files
        .iter()
        .map(|file| FileLayout {
            name: file.name.clone(),
            rows: file.rows,
            columns: file.columns.clone(),
        })
        .collect();
    let (setup, engine, registers) = (setup(profile), engine(profile), registers(profile));
    let (set, units) = (set.to_owned(), units(profile));
    Interface { set, model_version: MODEL_VERSION, clamp, setup, engine, registers, units, files }
}

/// What the devices that draw a profile are told.
pub(in crate::vector) struct Devices {
    pub(in crate::vector) edge: EdgeWordConfig,
    pub(in crate::vector) depth: DepthConfig,
    pub(in crate::vector) setup: SetupParameters,
}

/// Set-up and engine of a profile, or why no device does what it asks.
pub(in crate::vector) fn devices(profile: &Profile) -> Result<Devices, String> {
    let (edge, depth) = drawn(profile)?;
    let setup = setup(profile)?;
    engine(profile)?;
    Ok(Devices { edge, depth, setup })
}

impl Devices {
    /// The registers of depth and of an edge.
    pub(in crate::vector) fn registers(&self) -> [ReadOut; 2] {
        let DepthConfig { guard, integer, interpolation, clamp, .. } = self.depth;
        [ReadOut::new(guard, integer, interpolation, clamp).ok(), self.edge.read_out()]
            .map(|read| read.unwrap_or_else(|| unreachable!("a valid profile")))
    }
}

/// The edge words and the depth of the profiles that the devices draw, or what keeps them from it.
fn drawn(profile: &Profile) -> Result<(EdgeWordConfig, DepthConfig), String> {
    let machine = profile.form.engine();
    let Some(edge) = profile.form.edge().filter(|_| profile.form.visits_the_box()) else {
        return Err(format!(
            "the devices draw edge functions over a box, and the machine is {machine}"
        ));
    };
    if profile.multisample.is_some() {
        return Err("no device takes several samples in a pixel, as [multisample] asks".to_owned());
    }
    let depth = profile.depth.ok_or("the devices draw depth, and the profile has none")?;
    if depth.format.is_some() {
        return Err("no device stores depth in another format, as [depth.format] asks".to_owned());
    }
    Ok((*edge, depth))
}

/// What the set-up of a set's devices is told, or why they cannot do the profile's.
fn setup(profile: &Profile) -> Result<SetupParameters, String> {
    let (edge, depth) = drawn(profile)?;
    if depth.division != Division::Quotient {
        let reason =
            "division is not quotient: triangle_setup divides exactly, not by a reciprocal";
        return Err(reason.to_owned());
    }
    if depth.bias.is_some() {
        let reason =
            "[depth.bias] is given: triangle_setup adds no depth bias to the start of its plane";
        return Err(reason.to_owned());
    }
    if edge.conservative.is_some() {
        let reason = "coverage is conservative: triangle_setup sets up samples, and adds no offset for squares";
        return Err(reason.to_owned());
    }
    if profile.cull.is_some() {
        return Err("[cull] is given: triangle_setup leaves out no triangle with area".to_owned());
    }
    let grid = profile.grid().map_err(|error| error.to_string())?;
    if !grid.is_on_the_grid() {
        return Err(
            "samples lie between the sub-pixels, and triangle_setup takes them on the grid"
                .to_owned(),
        );
    }
    let vertex = &profile.vertex;
    Ok(SetupParameters {
        signed: vertex.signed,
        sub_pixel: vertex.sub_pixel,
        sample: grid.offset,
        shadow: edge.rule == FillRule::Shadow,
        shift: if edge.storage == EdgeStorage::Shifted { vertex.sub_pixel } else { 0 },
        rounding: depth.rounding,
        half: depth.start_bias == StartBias::Half,
    })
}

/// What the engine of a set's devices is told, or why it cannot draw the profile's set-up words. The order
/// of visits moves no bit (clause `O-1`), but an engine with such an order answers in it.
fn engine(profile: &Profile) -> Result<EngineParameters, String> {
    let (_, depth) = drawn(profile)?;
    match depth.clamp {
        Clamp::Saturate => {
            return Err("clamp is saturate: what a sticky accumulator holds depends on the order \
                        of the samples, and triangle_engine has no such read-out"
                .to_owned());
        }
        Clamp::Error => {
            let reason =
                "clamp is error: a refused triangle has no rows, and no device can refuse one";
            return Err(reason.to_owned());
        }
        Clamp::Wrap | Clamp::Guard | Clamp::Sign => {}
    }
    Ok(EngineParameters { any_order: profile.traversal.is_some() })
}

/// What draws the profile's registers.
fn registers(profile: &Profile) -> Result<RegisterDevice, String> {
    let missing = || format!("there is no device for {}", profile.form.engine());
    let device = profile.form.register_device().ok_or_else(missing)?;
    let field = |profile: &Profile| {
        let vertex = &profile.vertex;
        (vertex.integer, vertex.sub_pixel, vertex.signed, profile.sample)
    };
    // Devices are wired for the registers of built-in profiles.
    let wired_alike = |known: &Profile| match (&device, known.form.register_device()) {
        (RegisterDevice::Wired(own), Some(RegisterDevice::Wired(known_device))) => {
            own.wiring == known_device.wiring && field(profile) == field(known)
        }
        _ => false,
    };
    let known = BUILTIN.iter().filter_map(|(name, _)| builtin(name)?.ok());
    if matches!(device, RegisterDevice::Quads(_))
        || known.into_iter().any(|known| wired_alike(&known))
    {
        return Ok(device);
    }
    Err(missing() + " with these registers: each device is wired for those of a built-in profile")
}
