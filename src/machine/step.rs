//! Lists of configurations that are one decision away.

use super::{Form, Step};
use std::fmt::Display;

/// The steps of a configuration.
#[derive(Debug)]
pub struct Steps<'a, C, T = Form> {
    config: &'a C,
    form: fn(C) -> T,
    found: Vec<Step<T>>,
}

impl<'a, C: Clone, T> Steps<'a, C, T> {
    /// None yet; `form` makes a machine, or the engine of one, of a configuration.
    pub const fn of(config: &'a C, form: fn(C) -> T) -> Self {
        Self { config, form, found: Vec::new() }
    }

    /// A copy of the configuration.
    pub fn config(&self) -> C {
        self.config.clone()
    }

    /// Adds a step: the decision, what it becomes and what it was.
    pub fn add(
        &mut self,
        field: &str,
        got: &dyn Display,
        was: &dyn Display,
        change: impl FnOnce(&mut C),
    ) {
        let mut config = self.config.clone();
        change(&mut config);
        self.found.push(Step {
            field: field.to_owned(),
            got: got.to_string(),
            was: was.to_string(),
            form: (self.form)(config),
        });
    }

    /// All of them, in the order added.
    pub fn found(self) -> Vec<Step<T>> {
        self.found
    }
}

/// One less (if any) and one more.
pub fn near(bits: u32) -> impl Iterator<Item = u32> {
    bits.checked_sub(1).into_iter().chain([bits + 1])
}

/// The same, and none at all.
pub fn near_or_none(bits: u32) -> impl Iterator<Item = u32> {
    near(bits).chain((bits > 1).then_some(0))
}
