//! What machines of three edge words share: their word in a budget, their set-up, their decisions.

use super::{FormError, Kind, RasterState, Steps, Word};
use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule};
use crate::format::{Decision, Level, Refused, Takes, Value};
use crate::setup::EdgeCoefficients;
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

/// The edge words of another machine, or such as exact coverage asks for.
pub(super) fn adopted(from: &super::Form, state: &RasterState) -> EdgeWordConfig {
    from.edge().copied().unwrap_or_else(|| {
        let edge = EdgeWordConfig { rule: from.rule(), storage: EdgeStorage::Shifted, width: 2 };
        EdgeWordConfig { width: state.exact_edge_width(&edge, 1).unwrap_or(2), ..edge }
    })
}

/// Whether words hold every value.
pub(super) fn hold_all(edges: EdgeWordConfig, exact: Option<u32>) -> bool {
    exact.is_some_and(|exact| edges.width >= exact)
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

/// Changes of the words; `place` leads to them from the machine's table.
pub(super) fn steps<C: Clone>(
    steps: &mut Steps<'_, C>,
    place: &str,
    of: fn(&mut C) -> &mut EdgeWordConfig,
) {
    use EdgeStorage::{Full, Shifted};
    let width = of(&mut steps.config()).width;
    rules(steps, place, |config, rule| of(config).rule = rule);
    for (storage, name, other) in [(Full, "full", "shifted"), (Shifted, "shifted", "full")] {
        steps.add(&format!("{place}storage"), &name, &other, |config| of(config).storage = storage);
    }
    for got in super::step::near(width) {
        steps.add(&format!("{place}width"), &got, &width, |config| of(config).width = got);
    }
}
