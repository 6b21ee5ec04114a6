//! What machines of three edge words share: their word in a budget, their set-up, their decisions.

use super::painter;
use super::{FormError, Kind, RasterState, Sink, Steps, Word};
use crate::cover::{
    ConservativeConfig, ConservativeDepth, ConservativeError, ConservativeMode, Degenerate,
    EdgeStorage, EdgeWordConfig, FillRule,
};
use crate::format::{Decision, Level, Refused, Takes, Value};
use crate::setup::{EdgeCoefficients, Triangle};
use std::cmp::Ordering;

/// The word that makes an edge width follow the grid and the window.
const EXACT: &str = "exact";

impl EdgeWordConfig {
    /// Bits of an edge word.
    pub const WIDTH: Decision = Decision {
        name: "edge-width",
        level: Level::Coverage,
        clause: "C-5",
        takes: Takes::Bits { least: 2, most: 120, word: Some(EXACT) },
    };
    /// Its decisions that a search may vary.
    pub const DECISIONS: &[Decision] = &[Self::WIDTH];
}

/// What the decision of this name is set to.
pub(super) fn decision(edges: EdgeWordConfig, name: &str) -> Option<Value> {
    (name == EdgeWordConfig::WIDTH.name).then_some(Value::Bits(edges.width))
}

/// The width that a value stands for.
pub(super) fn decided(name: &str, value: &Value, exact: Option<u32>) -> Result<u32, Refused> {
    if name != EdgeWordConfig::WIDTH.name {
        return Err(Refused::Absent);
    }
    match value {
        Value::Bits(bits) => Ok(*bits),
        Value::Name(EXACT) => exact.ok_or(Refused::Absent),
        Value::Number(_) | Value::Name(_) => Err(Refused::Unfit),
    }
}

/// Checks the word; `place` is its table within that of the machine.
pub(super) fn validate(
    edges: EdgeWordConfig,
    kind: &Kind,
    place: &[&'static str],
) -> Result<(), FormError> {
    let field = [place, &["width"]].concat();
    edges.validate().map_err(|error| FormError::own(kind, &field, error))
}

/// Checks conservative coverage, on a machine that has a bounding box to decide by; `place` is the table of the
/// words within that of the machine.
pub(super) fn validate_conservative(
    edges: EdgeWordConfig,
    state: &RasterState,
    kind: &Kind,
    place: &[&'static str],
) -> Result<(), FormError> {
    let Some(config) = edges.conservative else { return Ok(()) };
    let fault = |key: Option<&'static str>, error: &dyn std::fmt::Display| {
        let keys = ["conservative"].into_iter().chain(key);
        FormError::own(kind, &place.iter().copied().chain(keys).collect::<Vec<_>>(), error)
    };
    let grid = state.grid().map_err(|error| fault(None, &error))?;
    config.validate(&grid).map_err(|error| fault(error.key(), &error))?;
    if state.multisample.is_some() {
        return Err(fault(None, &ConservativeError::Multisample));
    }
    Ok(())
}

/// Refuses conservative coverage on a machine that cannot decide it, for a reason.
pub(super) fn refuse_conservative(
    edges: EdgeWordConfig,
    kind: &Kind,
    place: &[&'static str],
    reason: &str,
) -> Result<(), FormError> {
    if edges.conservative.is_none() {
        return Ok(());
    }
    let message = format!(
        "conservative coverage is not for the machine {}: {reason}; choose edge-function or tiles, or leave \
         the table out",
        kind.name
    );
    Err(FormError::own(kind, &[place, &["conservative"]].concat(), message))
}

/// The normalised triangle, or `None` after reporting that it has no area and is culled. Spec clauses `T-3` and
/// `CR-4`.
pub(super) fn drawable(
    edges: EdgeWordConfig,
    triangle: &Triangle,
    out: &mut dyn Sink,
) -> Option<Triangle> {
    if draws_degenerate(edges) {
        Some(triangle.normalised())
    } else {
        painter::drawable(triangle, out)
    }
}

/// Whether triangles without area are drawn.
pub(super) fn draws_degenerate(edges: EdgeWordConfig) -> bool {
    edges.conservative.is_some_and(|config| config.degenerate == Degenerate::Draw)
}

/// The edge words of another machine, or such as exact coverage asks for.
pub(super) fn adopted(from: &super::Form, state: &RasterState) -> EdgeWordConfig {
    from.edge().copied().unwrap_or_else(|| {
        let (rule, storage) = (from.rule(), EdgeStorage::Shifted);
        let edge = EdgeWordConfig { rule, storage, width: 2, conservative: None };
        EdgeWordConfig { width: state.exact_edge_width(&edge, 1).unwrap_or(2), ..edge }
    })
}

/// Whether words hold every value, so that the samples of `C-2` are covered: those of squares are others.
pub(super) fn hold_all(edges: EdgeWordConfig, exact: Option<u32>) -> bool {
    edges.conservative.is_none() && exact.is_some_and(|exact| edges.width >= exact)
}

/// The edge constants: E at the window's origin and at the first sample, before any shift.
pub(super) fn setup_bits(edges: EdgeWordConfig, state: &RasterState) -> u32 {
    let origin = super::cost::corners::<4>(&state.vertex)
        .map(|[ax, ay, bx, by]| EdgeCoefficients::between([ax, ay], [bx, by]).c.abs())
        .max()
        .map_or(1, super::cost::signed_bits);
    let full = EdgeWordConfig { storage: EdgeStorage::Full, ..edges };
    let first = RasterState { window: (1, 1), ..*state }.exact_edge_width(&full, 1);
    origin.max(first.unwrap_or(0))
}

/// The word of a budget.
pub(super) fn word(edges: EdgeWordConfig, state: &RasterState) -> Word {
    let mut facts = vec![("range", format!("-2^{0} to 2^{0} - 1", edges.width - 1))];
    if let Some(exact) = state.exact_edge_width(&edges, 1) {
        let verdict = match edges.width.cmp(&exact) {
            Ordering::Less => "too narrow: edge words can wrap",
            Ordering::Equal => "exactly enough",
            Ordering::Greater => "more than enough",
        };
        facts.push(("exact in this window", format!("{exact} bits: {verdict}")));
    }
    Word::new("edge", [("edge", edges.width)], facts)
}

/// Changes of the rule; `place` leads to it from the machine's table.
pub(super) fn rules<C: Clone>(
    steps: &mut Steps<'_, C>,
    place: &str,
    set: impl Fn(&mut C, FillRule),
) {
    use FillRule::{Shadow, TopLeft};
    for (rule, name, other) in [(TopLeft, "top-left", "shadow"), (Shadow, "shadow", "top-left")] {
        steps.add(&format!("{place}rule"), &name, &other, |config| set(config, rule));
    }
}

/// Changes of conservative coverage.
fn squares<C: Clone>(
    steps: &mut Steps<'_, C>,
    place: &str,
    own: ConservativeConfig,
    of: fn(&mut C) -> &mut EdgeWordConfig,
) {
    use ConservativeMode::{Inner, Outer};
    let place = format!("{place}conservative");
    let set = |changed| move |config: &mut C| of(config).conservative = Some(changed);
    for (mode, name, other) in [(Outer, "outer", "inner"), (Inner, "inner", "outer")] {
        let degenerate = if mode == Inner { Degenerate::Cull } else { own.degenerate };
        let changed = ConservativeConfig { mode, degenerate, ..own };
        steps.add(&format!("{place}.mode"), &name, &other, set(changed));
    }
    for grow in super::step::near(own.grow).chain((own.grow > 1).then_some(0)) {
        let changed = ConservativeConfig { grow, ..own };
        steps.add(&format!("{place}.grow"), &grow, &own.grow, set(changed));
    }
    for (degenerate, name, other) in
        [(Degenerate::Cull, "cull", "draw"), (Degenerate::Draw, "draw", "cull")]
    {
        let changed = ConservativeConfig { degenerate, ..own };
        steps.add(&format!("{place}.degenerate"), &name, &other, set(changed));
    }
    for (depth, name, other) in [
        (ConservativeDepth::Nearest, "nearest", "centre"),
        (ConservativeDepth::Centre, "centre", "nearest"),
    ] {
        let changed = ConservativeConfig { depth, ..own };
        steps.add(&format!("{place}.depth"), &name, &other, set(changed));
    }
    steps.add(&place, &"left out, so that samples decide", &"in force", |config| {
        of(config).conservative = None;
    });
}

/// Changes of the words; `place` leads to them from the machine's table.
pub(super) fn steps<C: Clone>(
    steps: &mut Steps<'_, C>,
    place: &str,
    of: fn(&mut C) -> &mut EdgeWordConfig,
) {
    use EdgeStorage::{Full, Shifted};
    let width = of(&mut steps.config()).width;
    match of(&mut steps.config()).conservative {
        // No rule decides about a touch.
        Some(conservative) => squares(steps, place, conservative, of),
        None => rules(steps, place, |config, rule| of(config).rule = rule),
    }
    for (storage, name, other) in [(Full, "full", "shifted"), (Shifted, "shifted", "full")] {
        steps.add(&format!("{place}storage"), &name, &other, |config| of(config).storage = storage);
    }
    for got in super::step::near(width) {
        steps.add(&format!("{place}width"), &got, &width, |config| of(config).width = got);
    }
}
