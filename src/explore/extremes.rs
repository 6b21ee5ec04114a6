//! Numerical stability at the extremes: each quantity pushed as far as a profile's window goes, and
//! the first budget at which it breaks. Spec clause `Q-10`.

mod push;

use super::field::{Field, FieldError, Level, Value};
use super::metric::Metric;
use super::space::Space;
use super::sweep::{self, Sweep};
use super::tolerance::Tolerance;
use super::witness::{Witness, witness};
use crate::measure::accuracy::{Drawn, Reference, Stage, Tally, measure};
use crate::profile::{InvalidProfile, Profile};
use crate::scene::{Lens, Scene, Triangle};

/// A quantity, pushed; what shows that it broke, and the field that is taken down until it does.
#[derive(Clone, Debug)]
pub(super) struct Push {
    name: &'static str,
    pushed: String,
    field: Field,
    /// From the one that should hold to the one that should not.
    values: Vec<Value>,
    tolerance: Tolerance,
    /// Each list a scene of its own: surfaces that are not to meet are kept apart.
    scenes: Vec<Vec<Triangle>>,
    lens: Option<Lens>,
}

/// What became of a pushed quantity.
#[derive(Clone, Debug)]
pub struct Extreme {
    /// The quantity.
    pub name: &'static str,
    /// How far it was pushed, in words.
    pub pushed: String,
    /// The field that was varied.
    pub field: &'static str,
    /// What the profile has there.
    pub own: Option<Value>,
    /// What must not happen.
    pub tolerance: Tolerance,
    /// The last value that held, before the first that did not.
    pub holds: Option<(Value, f64)>,
    /// The first value that broke; `None` if none did.
    pub breaks: Option<Box<Witness>>,
    /// The last value that was tried.
    pub last: Option<Value>,
}

/// Pushes every quantity that the profile has. `go_on` is asked between budgets; what is known when
/// it says no is returned.
///
/// # Errors
/// [`InvalidProfile`] names the violated inequality.
pub fn extremes(
    profile: &Profile,
    go_on: &dyn Fn() -> bool,
) -> Result<Vec<Extreme>, InvalidProfile> {
    profile.validate()?;
    let mut found = Vec::new();
    for push in push::all(profile) {
        if !go_on() {
            break;
        }
        found.push(run(profile, push, go_on)?);
    }
    Ok(found)
}

fn run(profile: &Profile, push: Push, go_on: &dyn Fn() -> bool) -> Result<Extreme, InvalidProfile> {
    let Push { name, pushed, field, values, tolerance, scenes, lens } = push;
    let scene = |triangles| {
        let scene = Scene { lens, ..Scene::new(name, triangles) };
        Reference::new(scene, profile)
    };
    let scenes = scenes.into_iter().map(scene).collect();
    // A space of no axes: the sweep only brings the scene to grids.
    let Ok(space) = Space::new(profile.clone(), Vec::new()) else {
        unreachable!("the profile is valid")
    };
    let sweep = Sweep { space, scenes };
    let (mut holds, mut breaks, mut last) = (None, None, None);
    let mut stages: Option<Vec<Stage>> = None;
    for value in values {
        if !go_on() {
            break;
        }
        let mut changed = profile.clone();
        let set: Result<(), FieldError> = field.write(&mut changed, &value);
        if set.is_err() || changed.validate().is_err() {
            continue;
        }
        last = Some(value.clone());
        // A field of an inner level leaves the scene on its grid as it is.
        if field.level() == Level::Stage || stages.is_none() {
            stages = Some(sweep.stages(&changed)?);
        }
        let figure = figure(stages.as_deref().unwrap_or(&[]), &changed, tolerance.metric)?;
        if figure > tolerance.limit {
            let stages = stages.as_deref().unwrap_or(&[]);
            breaks = witness(&sweep, stages, &[tolerance], &changed, value)?.map(Box::new);
            break;
        }
        holds = Some((value, figure));
    }
    let (own, field) = (field.read(profile), field.name());
    Ok(Extreme { name, pushed, field, own, tolerance, holds, breaks, last })
}

fn figure(stages: &[Stage], profile: &Profile, metric: Metric) -> Result<f64, InvalidProfile> {
    let (mut snap, mut arithmetic) = (Tally::default(), Tally::default());
    for stage in stages {
        snap.merge(&stage.snap);
        arithmetic.merge(&measure(stage, &Drawn::new(stage, profile)?, profile).tally);
    }
    let accuracy = sweep::accuracy(stages, &snap, &arithmetic);
    Ok(metric.of_accuracy(&accuracy).unwrap_or(0.0))
}
