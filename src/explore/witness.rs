//! A counterexample to a budget: a triangle and a sample that it draws wrong. Spec clause `Q-8`.

use super::field::{Level, Value};
use super::metric::{Cause, Interpolated, Metric, Scale, Subject};
use super::sweep::{self, Sweep};
use super::tolerance::{Tolerance, exceeded};
use crate::bits::Event;
use crate::measure::accuracy::{
    ChannelTally, Drawn, Inspected, Moments, Place, Stage, Tally, Truth, What, WorstCode, measure,
    measure_channels,
};
use crate::measure::error::exact_rule;
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use std::cmp::Ordering;

/// A tolerance that a budget exceeds, and the place where.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// The value of the field in question.
    pub value: Value,
    /// The tolerance that is exceeded.
    pub tolerance: Tolerance,
    /// What its figure comes to.
    pub figure: f64,
    /// The scene, by its place in the list.
    pub scene: usize,
    /// The triangle and the sample; absent for what has no place, such as a triangle refused.
    pub place: Option<Place>,
    /// The triangle on the grid, vertices as `eval` takes them.
    pub vertices: Option<[[i128; 2]; 3]>,
    /// Depth of its vertices.
    pub depths: Option<[i128; 3]>,
    /// What happened there, in words.
    pub finding: String,
}

/// The first tolerance that a profile exceeds, measured as a whole, and where; on the stages of the
/// profile's grid.
pub(super) fn witness(
    sweep: &Sweep,
    stages: &[Stage],
    tolerances: &[Tolerance],
    profile: &Profile,
    value: Value,
) -> Result<Option<Witness>, InvalidProfile> {
    let (mut snap, mut arithmetic) = (Tally::default(), Tally::default());
    let wanted = vec![true; profile.channel.len()];
    let (model, mut channels) = (Model::new(profile)?, ChannelTally::of(wanted.len()));
    let (mut each, mut tallies) = (Vec::new(), Vec::new());
    for stage in stages {
        let drawn = Drawn::new(stage, profile)?;
        let own = measure(stage, &drawn, profile).tally;
        snap.merge(&stage.snap);
        arithmetic.merge(&own);
        let tally = measure_channels(stage, &drawn, &model, &wanted);
        let mut accuracy = sweep::accuracy(std::slice::from_ref(stage), &stage.snap, &own);
        if let Some(tally) = &tally {
            channels.merge(tally);
            accuracy.channels = tally.report(profile);
        }
        each.push(accuracy);
        tallies.push(tally);
    }
    let mut whole = sweep::accuracy(stages, &snap, &arithmetic);
    whole.channels = channels.report(profile);
    let levels = [Level::Stage, Level::Coverage, Level::Value];
    let over = levels.iter().find_map(|level| exceeded(tolerances, &whole, *level));
    let Some(tolerance) = over else { return Ok(None) };
    let figure = |accuracy| tolerance.metric.of_accuracy(accuracy).unwrap_or(0.0);
    // The scene that has most of it.
    let scene = (0..each.len())
        .max_by(|a, b| figure(&each[*a]).total_cmp(&figure(&each[*b])).then(b.cmp(a)))
        .unwrap_or(0);
    let (place, finding) = if let Subject::Channel(channel) = tolerance.metric.subject {
        let tally = tallies[scene].as_ref();
        tally.and_then(|tally| worst_code((&stages[scene], tally), profile, channel)).unzip()
    } else {
        let place = locate(sweep, scene, &stages[scene], profile, tolerance.metric)?;
        let finding = match place {
            Some(place) => words(place, tolerance.metric.name),
            None => first_refusal(sweep, scene, profile)?,
        };
        (place, Some(finding))
    };
    let face = place.and_then(|p| stages[scene].faces.iter().find(|f| f.source == p.triangle));
    Ok(Some(Witness {
        value,
        tolerance,
        figure: figure(&whole),
        scene,
        place,
        vertices: face.map(|face| profile.vertex.to_input(face.triangle.xy)),
        depths: face.and_then(|face| face.triangle.z),
        finding: finding.unwrap_or_else(|| NOWHERE.to_owned()),
    }))
}

/// What has no place in the picture.
const NOWHERE: &str = "no single sample shows the error";

/// The sample where a channel is farthest off, and what happened there.
fn worst_code(
    (stage, tally): (&Stage, &ChannelTally),
    profile: &Profile,
    channel: &str,
) -> Option<(Place, String)> {
    let number = profile.channel.iter().position(|own| own.name == channel)?;
    let Moments { count, worst: error, .. } = tally.moments[number];
    if count == 0 || error.is_infinite() {
        return None;
    }
    let WorstCode { component, face, x, y, code, exact } = tally.worst[number];
    let component = &profile.channel[number].components[component];
    #[allow(clippy::cast_precision_loss, reason = "a code has at most 32 bits")]
    let what = What::Ulp(code as f64 - exact);
    let place = Place { triangle: stage.faces[face].source, x, y, what };
    Some((place, format!("{component} of {channel} is {code} but should be {exact:.3}")))
}

/// The value to look at for a metric.
const fn inspected(value: Interpolated) -> Inspected {
    match value {
        Interpolated::Depth => Inspected::Depth,
        Interpolated::Attribute => Inspected::Attribute,
    }
}

/// The place behind a metric.
fn locate(
    sweep: &Sweep,
    scene: usize,
    stage: &Stage,
    profile: &Profile,
    metric: Metric,
) -> Result<Option<Place>, InvalidProfile> {
    if metric.cause == Cause::Snap {
        let (grid, clip) = (profile.whole_grid()?, profile.window()?);
        let truth = Truth::new(&sweep.scenes[scene], &grid, clip, exact_rule(&profile.form));
        return Ok(match metric.subject {
            Subject::Misclassified | Subject::Hits => stage.displaced(&truth),
            Subject::Order(order) => stage.exchanged(order),
            Subject::Value(value, scale) => {
                stage.moved(&truth, inspected(value), scale == Scale::World)
            }
            // A triangle that is not drawn has no sample.
            Subject::Triangles => None,
            Subject::Wraps
            | Subject::Clamps
            | Subject::Cost
            | Subject::Software
            | Subject::Channel(_) => {
                unreachable!("{}: snapping has none", metric.name)
            }
        });
    }
    Ok(match metric.subject {
        Subject::Misclassified | Subject::Hits => stage.misclassified(profile),
        Subject::Order(order) => stage.broken(profile, order),
        Subject::Wraps => stage.raised(profile, Event::Wrap),
        Subject::Clamps => stage
            .raised(profile, Event::ClampAbove)
            .or_else(|| stage.raised(profile, Event::ClampBelow)),
        Subject::Value(value, scale) => {
            stage.worst(profile, inspected(value), scale == Scale::World)
        }
        // What has no place in the picture, or was looked for before.
        Subject::Triangles | Subject::Cost | Subject::Software | Subject::Channel(_) => None,
    })
}

fn words(place: Place, metric: &str) -> String {
    let value = if metric.contains("attribute-") { "the attribute" } else { "depth" };
    let moved = if metric.starts_with("snap-") { "moved" } else { "is off" };
    match place.what {
        What::Missing => "the sample is not covered but should be".to_owned(),
        What::Extra => "the sample is covered but should not be".to_owned(),
        What::Ulp(ulp) => format!("{value} {moved} by {ulp:+.4} ULP"),
        What::Event(Event::Wrap) => "depth leaves the guard range".to_owned(),
        What::Event(_) => "depth is clamped to an end of its range".to_owned(),
        What::Order(Ordering::Equal, other) => {
            format!("its depth becomes equal to that of triangle {other}")
        }
        What::Order(_, other) => format!("its depth order with triangle {other} is reversed"),
    }
}

/// Which triangle a profile refuses, and why.
fn first_refusal(sweep: &Sweep, scene: usize, profile: &Profile) -> Result<String, InvalidProfile> {
    let (model, reference) = (Model::new(profile)?, &sweep.scenes[scene]);
    let refusal = (0..reference.triangles.len()).find_map(|index| {
        let error = model.snap(&reference.triangle(index, profile)).err()?;
        Some(format!("triangle {index}: {error}"))
    });
    Ok(refusal.unwrap_or_else(|| NOWHERE.to_owned()))
}
