//! What an adder of N bits measures in a standard-cell process, between and beyond measured points.
//!
//! The points: an adder alone, synthesised for the open 45 nm library Nangate45 at its typical
//! corner, in picoseconds and square micrometres. Another process has other figures, and a placed
//! and routed adder is slower: these compare budgets, they do not promise a chip.

/// One measured adder.
#[derive(Clone, Copy, Debug)]
struct Point {
    bits: u32,
    delay_ps: f64,
    area_um2: f64,
}

const fn point(bits: u32, delay_ps: f64, area_um2: f64) -> Point {
    Point { bits, delay_ps, area_um2 }
}

/// Ripple carry.
const RIPPLE: [Point; 4] =
    [point(24, 744., 162.), point(32, 989., 213.), point(48, 1473., 319.), point(64, 1956., 427.)];

/// Sklansky's prefix tree.
const SKLANSKY: [Point; 4] =
    [point(24, 279., 235.), point(32, 299., 383.), point(48, 335., 543.), point(64, 348., 874.)];

/// Brent and Kung's prefix tree, not used by the estimate.
#[cfg(test)]
const BRENT_KUNG: [Point; 4] =
    [point(24, 326., 201.), point(32, 355., 269.), point(48, 389., 404.), point(64, 421., 528.)];

/// Kogge and Stone's prefix tree, not used by the estimate.
#[cfg(test)]
const KOGGE_STONE: [Point; 4] =
    [point(24, 238., 434.), point(32, 265., 559.), point(48, 286., 965.), point(64, 302., 1390.)];

/// Growth of a Sklansky adder's area a bit for twice the bits, in square micrometres: the slope
/// of the least-squares line through area / N over log2 N of its four points. It extends the area
/// beyond them; the end slopes alone would be negative at 8 bits.
const SKLANSKY_GROWTH: f64 = 2.17;

/// Delay and area of one adder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Adder {
    pub(super) delay_ps: f64,
    pub(super) area_um2: f64,
}

/// A ripple-carry adder: straight lines through the points, the outer ones going on.
pub(super) fn ripple(bits: u32) -> Adder {
    let at = |value: fn(&Point) -> f64| line(&RIPPLE, f64::from(bits), |n| n, value);
    Adder { delay_ps: at(|p| p.delay_ps), area_um2: at(|p| p.area_um2) }
}

/// A Sklansky adder: delay and area a bit are straight lines over log2 N through the points. It is
/// a ripple adder and more, so it is never smaller, and where the tree would not pay, at a few
/// bits, it is one.
pub(super) fn prefix(bits: u32) -> Adder {
    let ripple = ripple(bits);
    let tree = tree(&SKLANSKY, SKLANSKY_GROWTH, bits);
    Adder {
        delay_ps: tree.delay_ps.min(ripple.delay_ps),
        area_um2: tree.area_um2.max(ripple.area_um2),
    }
}

fn tree(points: &[Point; 4], growth: f64, bits: u32) -> Adder {
    let n = f64::from(bits);
    let per_bit = |p: &Point| p.area_um2 / f64::from(p.bits);
    let [first, .., last] = points;
    let beyond = |end: &Point| per_bit(end) + growth * (n / f64::from(end.bits)).log2();
    let per_bit = if bits < first.bits {
        beyond(first)
    } else if bits > last.bits {
        beyond(last)
    } else {
        line(points, n, f64::log2, per_bit)
    };
    Adder { delay_ps: line(points, n, f64::log2, |p| p.delay_ps), area_um2: per_bit * n }
}

/// The value at `bits` on straight lines through the points, over an axis of the caller's choice;
/// the first and last lines go on.
fn line(
    points: &[Point; 4],
    bits: f64,
    axis: impl Fn(f64) -> f64,
    value: impl Fn(&Point) -> f64,
) -> f64 {
    // The last piece whose left end is not right of us, or the first one.
    let piece = (1..3).rev().find(|n| bits >= f64::from(points[*n].bits)).unwrap_or(0);
    let [left, right] = [&points[piece], &points[piece + 1]];
    let [from, to] = [left, right].map(|p| axis(f64::from(p.bits)));
    let share = (axis(bits) - from) / (to - from);
    value(left) + share * (value(right) - value(left))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_points_are_met() {
        for p in &RIPPLE {
            let adder = ripple(p.bits);
            assert!((adder.delay_ps - p.delay_ps).abs() < 1e-9);
            assert!((adder.area_um2 - p.area_um2).abs() < 1e-9);
        }
        for p in &SKLANSKY {
            let adder = prefix(p.bits);
            assert!((adder.delay_ps - p.delay_ps).abs() < 1e-9);
            assert!((adder.area_um2 - p.area_um2).abs() < 1e-9);
        }
    }

    #[test]
    fn the_growth_is_the_least_squares_slope() {
        let points = SKLANSKY.map(|p| (f64::from(p.bits).log2(), p.area_um2 / f64::from(p.bits)));
        let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / 4.0;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let product: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let square: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
        assert!((product / square - SKLANSKY_GROWTH).abs() < 0.01, "{}", product / square);
    }

    #[test]
    fn wider_is_never_smaller_or_quicker() {
        for bits in 1..130 {
            for adder in [ripple as fn(u32) -> Adder, prefix] {
                let (narrow, wide) = (adder(bits), adder(bits + 1));
                assert!(narrow.delay_ps > 0.0 && narrow.area_um2 > 0.0, "{bits}: {narrow:?}");
                assert!(wide.delay_ps > narrow.delay_ps, "{bits}: {narrow:?} {wide:?}");
                assert!(wide.area_um2 > narrow.area_um2, "{bits}: {narrow:?} {wide:?}");
            }
        }
    }

    /// Why Sklansky: of the three trees only it leaves the two measured whole DDAs of clause `H-2`
    /// the same remainder of delay, what registers and multiplexers take.
    #[test]
    fn the_prefix_tree_is_the_one_that_explains_whole_dda_figures() {
        let spread = |points: &[Point; 4]| {
            let [narrow, wide] = [26, 44].map(|bits| tree(points, 0.0, bits));
            ((394.0 - narrow.delay_ps) - (434.0 - wide.delay_ps)).abs()
        };
        let sklansky = spread(&SKLANSKY);
        assert!(sklansky < 3.0, "{sklansky} ps");
        for other in [BRENT_KUNG, KOGGE_STONE].map(|points| spread(&points)) {
            assert!(sklansky < other, "{sklansky} {other} ps");
        }
    }
}
