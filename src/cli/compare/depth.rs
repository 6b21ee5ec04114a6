//! Depth formats over distance, and what a vertex grid leaves of their bits.

use super::{Request, compared, interruptible, number};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::output::Output;
use guardbit::measure::accuracy::{Reference, Stage, Truth};
use guardbit::measure::error::exact_rule;
use guardbit::measure::resolution::{FormatRow, SnapRow, resolutions};
use guardbit::profile::Profile;
use guardbit::scene::Lens;

/// The report.
#[derive(serde::Serialize)]
struct Report<'a> {
    scene: &'a str,
    near: f64,
    far: f64,
    depth: &'a [FormatRow],
    snapping: &'a [SnapRow],
}

/// Sub-pixel bits whose effect on depth is measured.
const GRIDS: [u32; 5] = [2, 4, 6, 8, 10];

pub(super) fn show(request: Request<'_>) -> Result<Outcome, Failure> {
    let Request { profile, scene, arguments } = request;
    let name = scene.name.clone();
    let has_lens = scene.lens.is_some();
    // A scene without a camera shows the formats between the planes of a common one.
    let lens = scene.lens.unwrap_or(Lens { near: 0.1, far: 10_000.0 });
    let bits = profile.depth.map_or(24, |depth| depth.integer.min(32));
    let mut made = compared(scene.clone(), &profile)?;
    let (rows, snapping) = interruptible(|go_on| {
        let (_, stage) = made.stage("edge-function").map_err(Failure::input)?;
        let rows = resolutions(bits, lens, has_lens.then_some(stage));
        let mut snapping = Vec::new();
        for sub_pixel in GRIDS {
            if !go_on() {
                break;
            }
            snapping.extend(snapped(&scene, &profile, sub_pixel)?);
        }
        Ok((rows, snapping))
    })?;
    let mut output = Output::new();
    if arguments.json {
        let Lens { near, far } = lens;
        output.json(&Report { scene: &name, near, far, depth: &rows, snapping: &snapping })?;
        return Ok(Outcome::Good);
    }
    print(&mut output, &name, lens, &rows)?;
    output.line("")?;
    output.line("snapping of vertices: RMS change of depth on this scene, in codes")?;
    output.line("sub-pixel bits     16 bits     24 bits     32 bits")?;
    for row in &snapping {
        let [a, b, c] = row.codes.map(number);
        output.line(format!("{:<14} {a:>11} {b:>11} {c:>11}", row.sub_pixel))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}

/// The RMS depth change that snapping makes; `None` on a grid that the profile cannot have, or where
/// nothing has depth.
fn snapped(
    scene: &guardbit::scene::Scene,
    profile: &Profile,
    sub_pixel: u32,
) -> Result<Option<SnapRow>, Failure> {
    let mut profile = profile.clone();
    profile.vertex.sub_pixel = sub_pixel;
    profile.sample = None;
    profile.multisample = None;
    let lattice =
        |t: &guardbit::scene::Triangle| matches!(t, guardbit::scene::Triangle::Lattice { .. });
    // A scene of integers lies on its profile's own grid, and moves off no other.
    if profile.validate().is_err() || profile.depth.is_none() || scene.triangles.iter().any(lattice)
    {
        return Ok(None);
    }
    let reference = Reference::new(scene.clone(), &profile);
    let (grid, clip) =
        (profile.whole_grid().map_err(Failure::input)?, profile.window().map_err(Failure::input)?);
    let truth = Truth::new(&reference, &grid, clip, exact_rule(&profile.form));
    let stage = Stage::new(&reference, &truth, &profile).map_err(Failure::input)?;
    let depth = stage.snap.report().depth;
    Ok(depth.map(|depth| SnapRow::new(sub_pixel, depth.ulp.rms, stage.world.top)))
}

fn print(output: &mut Output, scene: &str, lens: Lens, rows: &[FormatRow]) -> Result<(), Failure> {
    let Some(first) = rows.first() else { return Ok(()) };
    output.line(format!(
        "{scene}: near {}, far {}, {} bits; the distance from one code to the next",
        number(lens.near),
        number(lens.far),
        first.bits
    ))?;
    output.line("")?;
    let across = |values: &mut dyn Iterator<Item = f64>| {
        values.map(|value| format!("{:>12}", number(value))).collect::<Vec<_>>().concat()
    };
    let places = across(&mut first.steps.iter().map(|step| step.distance));
    output.line(format!("format           nearer is  mean step{places}        ties"))?;
    for row in rows {
        let steps = across(&mut row.steps.iter().map(|step| step.step));
        output.line(format!(
            "{:<16} {:<9} {:>10}{steps} {:>11}",
            row.format,
            if row.reversed { "larger" } else { "smaller" },
            number(row.mean_step),
            row.ties.map_or("-".to_owned(), |ties| ties.to_string())
        ))?;
    }
    output.line("")?;
    output.line("mean step: mean over all distances, as a ratio to even steps; ties: neighbouring surfaces with the same code")
}
