//! Why one bit less will not do: a triangle and a sample. Spec clause `Q-8`.

use super::Tolerance;
use super::judge::{Judge, Verdict, exceeded};
use crate::bits::Event;
use crate::explore::field::{Field, Level, Value};
use crate::explore::sweep::{self, Sweep};
use crate::measure::accuracy::{Drawn, Inspected, Place, Stage, Tally, Truth, What, measure};
use crate::measure::error::exact_rule;
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use std::cmp::Ordering;

/// What comes of one bit less in one field.
#[derive(Clone, Debug)]
pub enum Lesser {
    /// It fails: here is why.
    Fails(Field, Box<Witness>),
    /// There is no bit to take away, or no such profile.
    Impossible(Field, String),
    /// It meets the tolerances, too: the cost does not count the field, or its value is not
    /// in the space.
    Meets(Field),
}

/// A tolerance that one bit less exceeds, and the place where.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// The value with one bit less.
    pub value: Value,
    /// The tolerance that is exceeded.
    pub tolerance: Tolerance,
    /// What its figure comes to.
    pub figure: f64,
    /// The scene, by its place in the list.
    pub scene: usize,
    /// The triangle and the sample; absent for what has no place, such as a triangle refused.
    pub place: Option<Place>,
    /// The triangle on the grid, vertices in sub-pixels.
    pub vertices: Option<[[i128; 2]; 3]>,
    /// Depth of its vertices.
    pub depths: Option<[i128; 3]>,
    /// What happened there, in words.
    pub finding: String,
}

/// Takes a bit away from each field of the space that counts bits.
pub(super) fn lesser(
    judge: &mut Judge<'_>,
    sweep: &Sweep,
    profile: &Profile,
) -> Result<Vec<Lesser>, InvalidProfile> {
    let mut found = Vec::new();
    for axis in sweep.space.axes().iter().filter(|axis| axis.field.is_bits()) {
        let field = axis.field;
        let Some(Value::Bits(bits)) = field.read(profile) else { continue };
        let Some(less) = bits.checked_sub(1) else {
            found.push(Lesser::Impossible(field, "there is no bit to take away".to_owned()));
            continue;
        };
        let changed = match sweep.space.with(profile, field, &Value::Bits(less)) {
            Ok(changed) => changed,
            Err(error) => {
                found.push(Lesser::Impossible(field, error.to_string()));
                continue;
            }
        };
        if let Err(error) = changed.validate() {
            found.push(Lesser::Impossible(field, error.to_string()));
            continue;
        }
        found.push(match judge.judge(&changed)? {
            Verdict::Fails => match witness(sweep, &judge.tolerances, &changed, less)? {
                Some(witness) => Lesser::Fails(field, Box::new(witness)),
                None => Lesser::Meets(field),
            },
            _ => Lesser::Meets(field),
        });
    }
    Ok(found)
}

/// The first tolerance that a profile exceeds, measured as a whole, and where.
fn witness(
    sweep: &Sweep,
    tolerances: &[Tolerance],
    profile: &Profile,
    less: u32,
) -> Result<Option<Witness>, InvalidProfile> {
    let stages = sweep.stages(profile)?;
    let (mut snap, mut arithmetic) = (Tally::default(), Tally::default());
    let mut each = Vec::new();
    for stage in &stages {
        let drawn = Drawn::new(stage, profile)?;
        let own = measure(stage, &drawn, profile);
        snap.merge(&stage.snap);
        arithmetic.merge(&own);
        each.push(sweep::accuracy(std::slice::from_ref(stage), &stage.snap, &own));
    }
    let whole = sweep::accuracy(&stages, &snap, &arithmetic);
    let levels = [Level::Stage, Level::Coverage, Level::Value];
    let over = levels.iter().find_map(|level| exceeded(tolerances, &whole, *level));
    let Some(tolerance) = over else { return Ok(None) };
    let figure = |accuracy| tolerance.metric.of_accuracy(accuracy).unwrap_or(0.0);
    // The scene that has most of it.
    let scene = (0..each.len())
        .max_by(|a, b| figure(&each[*a]).total_cmp(&figure(&each[*b])).then(b.cmp(a)))
        .unwrap_or(0);
    let place = locate(sweep, scene, &stages[scene], profile, tolerance.metric.name)?;
    let face = place.and_then(|p| stages[scene].faces.iter().find(|f| f.source == p.triangle));
    let finding = match place {
        Some(place) => words(place, tolerance.metric.name),
        None => first_refusal(sweep, scene, profile)?,
    };
    Ok(Some(Witness {
        value: Value::Bits(less),
        tolerance,
        figure: figure(&whole),
        scene,
        place,
        vertices: face.map(|face| face.triangle.xy),
        depths: face.and_then(|face| face.triangle.z),
        finding,
    }))
}

/// The place behind a metric.
fn locate(
    sweep: &Sweep,
    scene: usize,
    stage: &Stage,
    profile: &Profile,
    metric: &str,
) -> Result<Option<Place>, InvalidProfile> {
    let world = metric.ends_with("-world");
    let snapped = metric.strip_prefix("snap-");
    let value = if metric.contains("attribute-") { Inspected::Attribute } else { Inspected::Depth };
    if let Some(metric) = snapped {
        let (grid, clip) = (profile.grid()?, profile.window()?);
        let truth = Truth::new(&sweep.scenes[scene], &grid, clip, exact_rule(&profile.form));
        return Ok(match metric {
            "misclassified" | "holes" | "double-hits" => stage.displaced(&truth),
            "inversions" => stage.exchanged(Ordering::Greater),
            "ties" => stage.exchanged(Ordering::Equal),
            "refused" | "vanished" => None,
            _ => stage.moved(&truth, value, world),
        });
    }
    Ok(match metric {
        "misclassified" | "holes" | "double-hits" => stage.misclassified(profile),
        "inversions" => stage.broken(profile, Ordering::Greater),
        "ties" => stage.broken(profile, Ordering::Equal),
        "wraps" => stage.raised(profile, Event::Wrap),
        "clamps" => stage
            .raised(profile, Event::ClampAbove)
            .or_else(|| stage.raised(profile, Event::ClampBelow)),
        _ => stage.worst(profile, value, world),
    })
}

fn words(place: Place, metric: &str) -> String {
    let value = if metric.contains("attribute-") { "the attribute" } else { "depth" };
    let moved = if metric.starts_with("snap-") { "moved" } else { "is off" };
    match place.what {
        What::Missing => "the sample is not covered and should be".to_owned(),
        What::Extra => "the sample is covered and should not be".to_owned(),
        What::Ulp(ulp) => format!("{value} {moved} by {ulp:+.4} ULP"),
        What::Event(Event::Wrap) => "depth leaves the guard range".to_owned(),
        What::Event(_) => "depth is held at an end of its range".to_owned(),
        What::Order(Ordering::Equal, other) => format!("it becomes level with triangle {other}"),
        What::Order(_, other) => format!("it changes places with triangle {other}"),
    }
}

/// Which triangle a profile refuses, and why.
fn first_refusal(sweep: &Sweep, scene: usize, profile: &Profile) -> Result<String, InvalidProfile> {
    let (model, reference) = (Model::new(profile)?, &sweep.scenes[scene]);
    let refusal = (0..reference.triangles.len()).find_map(|index| {
        let error = model.snap(&reference.triangle(index, profile)).err()?;
        Some(format!("triangle {index}: {error}"))
    });
    Ok(refusal.unwrap_or_else(|| "no single sample is to blame".to_owned()))
}
