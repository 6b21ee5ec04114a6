//! What random edges show when they are walked by slopes of lecture A's 22 fraction bits.

use super::edge_walk::Walk;
use super::statement::{Statement, real};
use crate::bits::Rounding;
use crate::case::Words;
use std::sync::OnceLock;

const SEED: u64 = 1;
const CLASS: u64 = 1;
const EDGES: u64 = 20_000;

/// What [`EDGES`] random edges over 4096 pixels show at F = 22, s = 10.
struct Population {
    worst_sub_pixel: f64,
    mean_sub_pixel: f64,
    wrong_rows: f64,
    touched_edges: f64,
}

fn population(rounding: Rounding) -> Population {
    let (mut rows, mut wrong, mut touched, mut crossed) = (0, 0, 0, 0);
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for index in 0..EDGES {
        let mut words = Words::new(SEED, CLASS, index);
        let mut point = || [words.between(0, 4096 << 10), words.between(0, 4096 << 10)];
        let Some(walk) = Walk::new([point(), point()], 10, 22, rounding) else {
            continue;
        };
        let missed = (0..walk.rows()).filter(|n| !walk.right(*n)).count();
        let unit = real(walk.denominator << walk.config.fraction) / 1024.0;
        let ends = [0, walk.rows() - 1].map(|n| real(walk.error(n)) / unit);
        worst = worst.max(ends[0].abs()).max(ends[1].abs());
        // The mean of a line over its rows is the mean of its ends.
        sum += f64::midpoint(ends[0], ends[1]) * real(walk.rows());
        rows += walk.rows();
        wrong += missed;
        touched += u32::from(missed > 0);
        crossed += 1;
    }
    Population {
        worst_sub_pixel: worst,
        mean_sub_pixel: sum / real(rows),
        wrong_rows: real(wrong) / real(rows),
        touched_edges: f64::from(touched) / f64::from(crossed),
    }
}

fn nearest() -> &'static Population {
    static NEAREST: OnceLock<Population> = OnceLock::new();
    NEAREST.get_or_init(|| population(Rounding::NearestEven))
}

fn floor() -> &'static Population {
    static FLOOR: OnceLock<Population> = OnceLock::new();
    FLOOR.get_or_init(|| population(Rounding::Floor))
}

pub(super) fn statements() -> Vec<Statement> {
    let what = |figure: &str| {
        format!(
            "edge walk, W = 4096, s = 10, F = 22: {figure}; {EDGES} edges with both ends uniform \
             in the window, mix64 seed {SEED} class {CLASS}"
        )
    };
    [
        Statement::between(
            "walk.worst-nearest",
            what("worst error in sub-pixels, nearest (bound 1/2)"),
            0.463,
            [0.44, 0.5],
            || nearest().worst_sub_pixel,
        ),
        Statement::between(
            "walk.worst-floor",
            what("worst error in sub-pixels, floor (bound 1)"),
            0.931,
            [0.88, 1.0],
            || floor().worst_sub_pixel,
        ),
        Statement::within(
            "walk.mean-floor",
            what(
                "mean error in sub-pixels over rows, floor: -1/8 for uniform ends, since the \
                mean row is W/4 below the top of its edge and loses half a unit per row (-0.114 is quoted for \
                another population of edges)",
            ),
            -0.125,
            0.005,
            || floor().mean_sub_pixel,
        ),
        Statement::within(
            "walk.wrong-nearest",
            what(
                "share of rows with the wrong pixel, nearest: the mean error in pixels, 2^-14 \
                for uniform ends (5.4e-5 is quoted for another population)",
            ),
            6.1e-5,
            7e-6,
            || nearest().wrong_rows,
        ),
        Statement::within(
            "walk.wrong-floor",
            what(
                "share of rows with the wrong pixel, floor: the mean error in pixels, 2^-13 for \
                uniform ends",
            ),
            1.2e-4,
            1.2e-5,
            || floor().wrong_rows,
        ),
        Statement::within(
            "walk.touched-nearest",
            what(
                "share of edges with a wrong row, nearest: 1 - exp(-wrong rows) averaged over \
                uniform ends is 0.0735 (5 % is quoted for another population)",
            ),
            0.0735,
            0.01,
            || nearest().touched_edges,
        ),
        Statement::within(
            "walk.touched-floor",
            what(
                "share of edges with a wrong row, floor: 1 - exp(-wrong rows) averaged over \
                uniform ends is 0.132 (10 % is quoted for another population)",
            ),
            0.132,
            0.01,
            || floor().touched_edges,
        ),
    ]
    .map(Statement::slow)
    .into()
}
