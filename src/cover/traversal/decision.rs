//! The decisions of a traversal that a search may vary. Spec clause `Q-1`.

use super::{Order, Stamp, TraversalConfig};
use crate::format::{Decision, Level, Refused, Value};

/// The word for visiting the bounding box row by row, as a profile without a `[traversal]` does.
const ROWS: &str = "rows";

impl TraversalConfig {
    /// The order in which samples are visited.
    pub const ORDER: Decision = Decision::words("traversal", Level::Coverage, "O-2", || {
        std::iter::once(ROWS).chain(Order::ALL.map(Order::name)).collect()
    });
    /// Pixels evaluated in one step.
    pub const STAMP: Decision =
        Decision::words("stamp", Level::Coverage, "O-1", || Stamp::ALL.map(Stamp::name).to_vec());
    /// All of them.
    pub const DECISIONS: &[Decision] = &[Self::ORDER, Self::STAMP];

    /// What a decision of this name is set to in a profile with or without a `[traversal]`; `None` for
    /// another owner's.
    pub fn decision(of: Option<&Self>, name: &str) -> Option<Value> {
        Some(Value::Name(match name {
            "traversal" => of.map_or(ROWS, |traversal| traversal.order.name()),
            "stamp" => of.map_or(Stamp::One, |traversal| traversal.stamp).name(),
            _ => return None,
        }))
    }

    /// Sets a decision.
    ///
    /// # Errors
    /// [`Refused`] for another owner's, or a value that it does not take.
    pub fn decide(of: &mut Option<Self>, name: &str, value: &Value) -> Result<(), Refused> {
        match name {
            "traversal" => {
                let stamp = of.map_or(Stamp::One, |traversal| traversal.stamp);
                *of = if *value == Value::Name(ROWS) {
                    None
                } else {
                    let order = Refused::unless(value.choose(&Order::ALL, Order::name))?;
                    Some(Self { order, stamp })
                };
            }
            "stamp" => {
                let stamp = Refused::unless(value.choose(&Stamp::ALL, Stamp::name))?;
                if of.is_some() || stamp != Stamp::One {
                    of.get_or_insert(Self { order: Order::BoundingBox, stamp }).stamp = stamp;
                }
            }
            _ => return Err(Refused::Absent),
        }
        Ok(())
    }
}
