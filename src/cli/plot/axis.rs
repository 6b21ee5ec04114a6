//! One axis of a chart: its range, and ticks at round numbers.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// An axis in its own units: values, or their decimal logarithms.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    log: bool,
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) ticks: Vec<f64>,
}

impl Axis {
    /// An axis that holds these finite values, above zero if logarithmic, with room at the ends.
    pub(super) fn new(values: impl Iterator<Item = f64>, log: bool) -> Self {
        let values = values.map(|value| if log { value.log10() } else { value });
        let (low, high) = values
            .fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low > high { (0.0, 1.0) } else { (low, high) };
        // One value, or values too near to tell apart, stand in the middle.
        let span = high - low;
        let least = 1e-9 * low.abs().max(high.abs()).max(1e-300);
        let room = match (span > least, log) {
            (true, _) => span / 16.0,
            (false, true) => 0.5,
            (false, false) if high == 0.0 => 1.0,
            (false, false) => high.abs() / 2.0,
        };
        // A linear axis that comes near zero begins there.
        let from_zero = !log && (0.0..high / 2.0).contains(&low);
        let low = if from_zero { 0.0 } else { low - room };
        let high = high + room;
        let ticks = if log { decades(low, high) } else { linear(low, high) };
        Self { log, low, high, ticks }
    }

    /// A value in the axis' own units.
    pub(super) fn place(&self, value: f64) -> f64 {
        if self.log { value.log10() } else { value }
    }

    /// What is written at a tick.
    pub(super) fn text(&self, tick: f64) -> String {
        if self.log {
            return number(10f64.powf(tick), 3);
        }
        // As many digits as tell neighbours apart.
        let step = self.ticks.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::MAX, f64::min);
        let largest = self.ticks.iter().fold(0.0f64, |most, tick| most.max(tick.abs()));
        let apart = (1..12).find(|n| 10f64.powi(*n) > largest / step).unwrap_or(12);
        number(tick, apart.max(2) + 1)
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let share = (value - self.low) / (self.high - self.low);
        let place = f64::from(from) + share * f64::from(to - from);
        #[allow(clippy::cast_possible_truncation, reason = "a pixel between two pixels")]
        let pixel = place.round() as i32;
        pixel
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(tick: &f64) -> String {
        number(*tick, 3)
    }
}

/// About six multiples of 1, 2 or 5 times a power of ten.
fn linear(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low) / 6.0;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().find(|digit| digit * power >= rough).unwrap_or(10.0);
    multiples(low, high, step * power)
}

/// Powers of ten; with few of them, twice and five times each as well; within one decade, the
/// logarithms of round numbers.
fn decades(low: f64, high: f64) -> Vec<f64> {
    let span = high - low;
    if span > 3.0 {
        return multiples(low, high, (span / 9.0).ceil());
    }
    if span < 0.7 {
        let ticks = linear(10f64.powf(low), 10f64.powf(high));
        return ticks.into_iter().filter(|tick| *tick > 0.0).map(f64::log10).collect();
    }
    let whole = multiples(low.floor(), high, 1.0);
    let parts =
        whole.iter().flat_map(|decade| [1f64, 2.0, 5.0].map(|digit| decade + digit.log10()));
    parts.filter(|tick| (low..=high).contains(tick)).collect()
}

fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step).ceil();
    // Twenty are more than any rule above asks for; a degenerate range must not ask for more.
    let ticks = (0..20u32).map(|n| (first + f64::from(n)) * step);
    ticks.take_while(|tick| *tick <= high).collect()
}

/// A number in few characters: so many significant digits, without zeros that say nothing.
fn number(value: f64, digits: i32) -> String {
    let size = value.abs();
    if size < 1e-300 {
        return "0".to_owned();
    }
    if size < 0.000_999 || size >= 10f64.powi(digits.max(5)) {
        return format!("{value:.0e}");
    }
    let decimals =
        (-3..digits).take_while(|n| size < 10f64.powi(digits - 1 - n)).filter(|n| *n >= 0);
    let decimals = decimals.count();
    let text = format!("{value:.decimals$}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if text.contains('.') { short.to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(values: &[f64], log: bool) -> Vec<String> {
        let axis = Axis::new(values.iter().copied(), log);
        axis.ticks.iter().map(|tick| axis.text(*tick)).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(texts(&[0.3, 9.7], false), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(texts(&[101.0, 103.0], false), ["101", "101.5", "102", "102.5", "103"]);
        assert_eq!(texts(&[1e-4, 1e2], true), ["1e-4", "0.001", "0.01", "0.1", "1", "10", "100"]);
        assert_eq!(texts(&[0.3, 5.0], true), ["0.5", "1", "2", "5"]);
        assert_eq!(texts(&[-3.0, 3.0], false), ["-2", "0", "2"]);
    }

    #[test]
    fn values_lie_inside_and_ticks_are_few() {
        for values in
            [&[5.0][..], &[0.0], &[1e300, -1e300], &[1e-12, 1e12], &[2.0, 2.0 + 1e-15], &[]]
        {
            for log in [false, true] {
                let values: Vec<f64> =
                    values.iter().copied().filter(|v| *v > 0.0 || !log).collect();
                let axis = Axis::new(values.iter().copied(), log);
                assert!(axis.low < axis.high, "{values:?} {axis:?}");
                assert!((1..=20).contains(&axis.ticks.len()), "{values:?} {axis:?}");
                for value in values {
                    let place = axis.place(value);
                    assert!((axis.low..=axis.high).contains(&place), "{value} {axis:?}");
                }
            }
        }
    }

    #[test]
    fn numbers_are_short() {
        let short = [0.0, 1.0, 0.25, 0.001, 12_500.0, 1e-7, 3e9, 99.5, -0.5].map(|n| number(n, 3));
        assert_eq!(short, ["0", "1", "0.25", "0.001", "12500", "1e-7", "3e9", "99.5", "-0.5"]);
    }
}
