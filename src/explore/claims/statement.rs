//! A statement that can be checked, and the claim that a check makes.

use num_traits::ToPrimitive;
use serde::Serialize;

/// One fact, recomputed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Claim {
    /// Stable name, `topic.fact`.
    pub id: String,
    /// What is claimed, and how it is checked.
    pub what: String,
    /// What must come out.
    pub expected: String,
    /// What came out.
    pub got: String,
    /// Whether the two agree.
    pub good: bool,
}

/// What a check computes: the text to print and whether it is as expected.
struct Finding {
    got: String,
    good: bool,
}

/// A fact that has not been checked yet.
pub struct Statement {
    /// Stable name, `topic.fact`.
    pub id: String,
    /// What is claimed, and how it is checked.
    pub what: String,
    /// What must come out.
    pub expected: String,
    /// Whether the check takes milliseconds rather than a sizeable part of a second.
    pub quick: bool,
    compute: Box<dyn Fn() -> Finding + Send + Sync>,
}

impl std::fmt::Debug for Statement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Statement").field("id", &self.id).finish_non_exhaustive()
    }
}

impl Statement {
    /// Computes the fact.
    pub fn check(&self) -> Claim {
        let Finding { got, good } = (self.compute)();
        Claim {
            id: self.id.clone(),
            what: self.what.clone(),
            expected: self.expected.clone(),
            got,
            good,
        }
    }

    /// A fact whose text must come out exactly.
    pub(super) fn exact<T: ToString>(
        id: impl Into<String>,
        what: impl Into<String>,
        expected: impl Into<String>,
        compute: impl Fn() -> T + Send + Sync + 'static,
    ) -> Self {
        let expected: String = expected.into();
        let wanted = expected.clone();
        let finding = move || {
            let got = compute().to_string();
            Finding { good: got == wanted, got }
        };
        Self { id: id.into(), what: what.into(), expected, quick: true, compute: Box::new(finding) }
    }

    /// A measured figure that must come within `tolerance` of `expected`.
    pub(super) fn within(
        id: impl Into<String>,
        what: impl Into<String>,
        expected: f64,
        tolerance: f64,
        compute: impl Fn() -> f64 + Send + Sync + 'static,
    ) -> Self {
        let finding = move || {
            let got = compute();
            Finding { good: (got - expected).abs() <= tolerance, got: figure(got) }
        };
        Self {
            id: id.into(),
            what: what.into(),
            expected: format!("{} +- {}", figure(expected), figure(tolerance)),
            quick: true,
            compute: Box::new(finding),
        }
    }

    /// A worst case over samples, which must come near `expected` and stay within a range, the
    /// upper end of which is a bound.
    pub(super) fn between(
        id: impl Into<String>,
        what: impl Into<String>,
        expected: f64,
        [low, bound]: [f64; 2],
        compute: impl Fn() -> f64 + Send + Sync + 'static,
    ) -> Self {
        let finding = move || {
            let got = compute();
            Finding { good: low <= got && got < bound, got: figure(got) }
        };
        Self {
            id: id.into(),
            what: what.into(),
            expected: format!("{}, in [{}, {})", figure(expected), figure(low), figure(bound)),
            quick: true,
            compute: Box::new(finding),
        }
    }

    /// The same statement, marked as one that takes a while.
    #[must_use]
    pub(super) fn slow(mut self) -> Self {
        self.quick = false;
        self
    }
}

/// Four significant digits; small figures in scientific notation.
fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        small if small < 1e-3 => format!("{value:.2e}"),
        small if small < 10.0 => format!("{value:.4}"),
        _ => format!("{value:.1}"),
    }
}

/// An integer as a real number, for reports.
pub(super) fn real(value: impl ToPrimitive + Copy) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_expectation_is_reported_as_wrong() {
        assert!(!Statement::exact("a", "b", "2", || 1 + 2).check().good);
        assert!(Statement::exact("a", "b", "3", || 1 + 2).check().good);
        assert!(!Statement::within("a", "b", 1.0, 0.1, || 1.2).check().good);
        assert!(!Statement::within("a", "b", 1.0, 0.1, || f64::NAN).check().good);
        assert!(Statement::within("a", "b", 1.0, 0.1, || 0.95).check().good);
        assert!(Statement::between("a", "b", 0.4, [0.3, 0.5], || 0.45).check().good);
        assert!(!Statement::between("a", "b", 0.4, [0.3, 0.5], || 0.5).check().good);
    }

    #[test]
    fn claims_serialise_with_the_agreed_keys() {
        let claim = Statement::exact("a.b", "c", "1", || 1).check();
        let text = serde_json::to_string(&claim).unwrap();
        assert_eq!(text, r#"{"id":"a.b","what":"c","expected":"1","got":"1","good":true}"#);
    }
}
