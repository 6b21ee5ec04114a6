//! Lines, points and circles against their definitions.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::{
    LineConfig, LineRule, PointConfig, PointRule, Rect, SampleGrid, Start, Stipple, Tie, bresenham,
    circle, incremental, integer_incremental, march, midpoint, naive,
};
use guardbit::exact::{Diamond, Rational, divide, dyadic, exits, integer};
use std::collections::BTreeSet;
use std::io::Write as _;
use std::process::{Command, Stdio};

type Ends = [[i128; 2]; 2];

fn collect(draw: impl FnOnce(&mut dyn FnMut([i128; 2]))) -> Vec<[i128; 2]> {
    let mut pixels = Vec::new();
    draw(&mut |pixel| pixels.push(pixel));
    pixels
}

fn all_ends() -> impl Iterator<Item = Ends> {
    (-9..=9).flat_map(|x| (-9..=9).map(move |y| [[2, -1], [2 + x, y - 1]]))
}

/// The line by its definition: for step i of the major axis, the minor offset m i / n rounded.
fn defined(ends: Ends, round: impl Fn(i128, i128) -> i128) -> Vec<[i128; 2]> {
    let d = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
    let major = usize::from(d[1].abs() > d[0].abs());
    let n = d[major].abs();
    (0..=n)
        .map(|i| {
            let up = if n == 0 { 0 } else { round(d[1 - major].abs() * i, n) };
            let mut at = ends[0];
            at[major] += i * d[major].signum();
            at[1 - major] += up * d[1 - major].signum();
            at
        })
        .collect()
}

/// Clauses L-1 and L-2: every algorithm in every octant is its definition.
#[test]
fn integer_lines_are_their_definitions_in_every_octant() {
    let nearest = |rounding| move |a, b| divide(a, b, rounding).unwrap();
    let (up, down) = (nearest(Rounding::NearestUp), nearest(Rounding::NearestDown));
    let mut ties = 0;
    for ends in all_ends() {
        assert_eq!(collect(|p| naive(ends, Rounding::NearestEven, p)), {
            defined(ends, nearest(Rounding::NearestEven))
        });
        assert_eq!(collect(|p| bresenham(ends, p)), defined(ends, down), "{ends:?}");
        let middle = |tie| collect(|p| midpoint(ends, tie, &mut |_| (), p));
        assert_eq!(middle(Tie::East), defined(ends, down), "{ends:?}");
        assert_eq!(middle(Tie::NorthEast), defined(ends, up), "{ends:?}");
        ties += u32::from(middle(Tie::East) != middle(Tie::NorthEast));
        let start = |start| collect(|p| integer_incremental(ends, start, p));
        assert_eq!(start(Start::Zero), defined(ends, nearest(Rounding::Floor)), "{ends:?}");
        // Half of an odd length is floored: a tie cannot arise, of an even one it goes up.
        assert_eq!(start(Start::Half), defined(ends, up), "{ends:?}");
        // Enough fraction bits for so short a line.
        let walked = collect(|p| incremental(ends, 20, Rounding::Ceiling, p));
        assert_eq!(walked, defined(ends, up), "{ends:?}");
        // From its other end a line is the same but where it passes through midpoints.
        let mut back = collect(|p| midpoint([ends[1], ends[0]], Tie::East, &mut |_| (), p));
        back.reverse();
        assert_eq!(back, middle(Tie::NorthEast), "{ends:?}");
    }
    assert!(ties > 40);
}

/// Clause L-3: a slope of too few bits takes another pixel, and more bits take the right one.
#[test]
fn incremental_lines_drift() {
    let ends = [[0, 0], [1000, 333]];
    let exact = collect(|p| naive(ends, Rounding::NearestUp, p));
    let wrong = |fraction| {
        let got = collect(|p| incremental(ends, fraction, Rounding::NearestEven, p));
        got.iter().zip(&exact).filter(|(a, b)| a != b).count()
    };
    assert!(wrong(6) > 100 && wrong(10) > 0, "{} {}", wrong(6), wrong(10));
    assert_eq!(wrong(24), 0);
}

/// What a rule plots in walking order.
fn plotted(rule: LineRule, line: Ends, grid: &SampleGrid, clip: Rect) -> Vec<(u32, u32)> {
    let mut pixels = Vec::new();
    let config = LineConfig { rule, stipple: None };
    config.pixels(line, grid, clip, &mut |x, y| pixels.push((x, y)));
    pixels
}

/// Clause L-4: segments of toy grids exit the diamonds that the definition says, in both rules: from
/// every point, to every 11th or 97th (with steps of 1 and 5, all is well, too, and takes minutes).
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn diamond_exit_is_its_definition_on_toy_grids() {
    let clip = Rect { x0: 0, y0: 0, x1: 3, y1: 3 };
    let mut drawn = 0;
    for (sub_pixel, step) in [(1, 11), (2, 97)] {
        let grid = SampleGrid::at([1 << (sub_pixel - 1); 2], sub_pixel);
        let side = 3 << sub_pixel;
        let points: Vec<[i128; 2]> =
            (-1..=side + 1).flat_map(|y| (-1..=side + 1).map(move |x| [x, y])).collect();
        for (n, from) in points.iter().enumerate() {
            for to in points.iter().skip(n % step).step_by(step) {
                let ends = [*from, *to].map(|p| p.map(|value| dyadic(value, sub_pixel)));
                for (rule, diamond) in [
                    (LineRule::DiamondD3d, Diamond::LowerEdges),
                    (LineRule::DiamondVulkan, Diamond::Perturbed),
                ] {
                    let got: BTreeSet<(u32, u32)> =
                        plotted(rule, [*from, *to], &grid, clip).into_iter().collect();
                    for (x, y) in (0..3).flat_map(|x| (0..3).map(move |y| (x, y))) {
                        let [a, b] = ends.clone();
                        let wanted = exits(diamond, a, b, [x.into(), y.into()]);
                        assert_eq!(
                            got.contains(&(x, y)),
                            wanted,
                            "{rule:?} {from:?} {to:?} {x} {y}"
                        );
                        drawn += u32::from(wanted);
                    }
                }
            }
        }
    }
    assert!(drawn > 2_000, "{drawn}");
}

/// The lectures' example under both diamond rules: one pixel apart at the tie.
#[test]
fn the_example_line_takes_15_13_or_15_14() {
    let grid = SampleGrid::at([1, 1], 1);
    let clip = Rect { x0: 0, y0: 0, x1: 64, y1: 64 };
    let line = [[21, 21], [41, 35]];
    let d3d = plotted(LineRule::DiamondD3d, line, &grid, clip);
    let vulkan = plotted(LineRule::DiamondVulkan, line, &grid, clip);
    assert!(d3d.contains(&(15, 13)) && !d3d.contains(&(15, 14)), "{d3d:?}");
    assert!(vulkan.contains(&(15, 14)) && !vulkan.contains(&(15, 13)), "{vulkan:?}");
    // The last pixel is not left.
    assert!(d3d.len() == 10 && vulkan.len() == 10);
}

/// Clause L-5: sixteen pixels, the first in the lowest bit, each bit for `factor` pixels.
#[test]
fn patterns_repeat() {
    let grid = SampleGrid::at([1, 1], 1);
    let clip = Rect { x0: 5, y0: 0, x1: 60, y1: 8 };
    let stipple = Some(Stipple { pattern: 0x00ff, factor: 2 });
    let config = LineConfig { rule: LineRule::Bresenham, stipple };
    let mut columns = Vec::new();
    config.pixels([[0, 2], [120, 2]], &grid, clip, &mut |x, _| columns.push(x));
    // The counter began outside the window: 16 on, 16 off.
    let wanted: Vec<u32> = (5..16).chain(32..48).collect();
    assert_eq!(columns, wanted);
}

/// Clause L-6: the cells of a segment are those of its points, in order: at its ends, where it meets a
/// border, and between.
#[test]
fn marching_touches_every_cell_of_every_toy_segment() {
    let mut corners = 0;
    for ends in (0..=12i128).flat_map(|x| (0..=12).map(move |y| [[5, 6], [x, y]])) {
        for ends in [ends, [ends[1], ends[0]]] {
            let cells = {
                let mut cells = Vec::new();
                march(ends, 4, &mut |cell| cells.push(cell));
                cells
            };
            let d = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
            let mut parts = vec![integer(0), integer(1)];
            for k in 0..2 {
                if d[k] != 0 {
                    let meets =
                        (0..=16).step_by(4).map(|b| integer(b - ends[0][k]) / integer(d[k]));
                    parts.extend(meets.filter(|t| *t >= integer(0) && *t <= integer(1)));
                }
            }
            parts.sort();
            let between: Vec<Rational> =
                parts.windows(2).map(|w| (&w[0] + &w[1]) / integer(2)).collect();
            parts.extend(between);
            parts.sort();
            let mut wanted: Vec<[i128; 2]> = parts
                .iter()
                .map(|t| {
                    [0, 1].map(|k| {
                        let at = integer(ends[0][k]) + integer(d[k]) * t;
                        i128::try_from((at / integer(4)).floor().to_integer()).unwrap()
                    })
                })
                .collect();
            wanted.dedup();
            assert_eq!(cells, wanted, "{ends:?}");
            let diagonal = |w: &[[i128; 2]]| w[0][0] != w[1][0] && w[0][1] != w[1][1];
            corners += u32::from(cells.windows(2).any(diagonal));
        }
    }
    assert!(corners > 3, "some pass through a corner: {corners}");
}

/// Clause L-7: samples in the rectangle by their distance and projection as rationals.
#[test]
fn wide_lines_cover_by_distance() {
    let grid = SampleGrid::at([2, 2], 2);
    let clip = Rect { x0: 0, y0: 0, x1: 8, y1: 8 };
    let (mut inside, mut on_side) = (0, 0);
    for index in 0..600 {
        let mut words = Words::new(4, 5, index);
        let mut at = || [words.between(0, 32), words.between(0, 32)];
        let (from, to) = (at(), at());
        let width = u32::try_from(words.between(1, 12)).unwrap();
        let got: BTreeSet<(u32, u32)> =
            plotted(LineRule::Rectangle { width }, [from, to], &grid, clip).into_iter().collect();
        let d = [to[0] - from[0], to[1] - from[1]];
        let length = integer(d[0] * d[0] + d[1] * d[1]);
        for (x, y) in (0..8).flat_map(|x| (0..8).map(move |y| (x, y))) {
            let at = grid.position(x.into(), y.into());
            let q = [at[0] - from[0], at[1] - from[1]];
            let wanted = length != integer(0) && {
                let along = integer(q[0] * d[0] + q[1] * d[1]) / &length;
                let cross = integer(d[0] * q[1] - d[1] * q[0]);
                let distance2 = &cross * &cross / &length;
                let limit2 = dyadic(i128::from(width) * i128::from(width), 2);
                on_side += u32::from(distance2 == limit2);
                let within =
                    if cross < integer(0) { distance2 <= limit2 } else { distance2 < limit2 };
                along >= integer(0) && along < integer(1) && within
            };
            assert_eq!(got.contains(&(x, y)), wanted, "{from:?} {to:?} {width} {x} {y}");
            inside += u32::from(wanted);
        }
    }
    assert!(inside > 1000 && on_side > 20, "{inside} {on_side}");
}

/// Clause L-8: pixels, squares and disks, sample by sample.
#[test]
fn points_cover_what_they_are_defined_to() {
    let grid = SampleGrid::at([2, 2], 2);
    let clip = Rect { x0: 0, y0: 0, x1: 6, y1: 6 };
    let mut rims = 0;
    for point in (0..=24).flat_map(|x| (0..=24).map(move |y| [x, y])) {
        for size in 1..=11 {
            for rule in [
                PointRule::Pixel,
                PointRule::PixelD3d,
                PointRule::Square { size },
                PointRule::Disk { size },
            ] {
                let mut got = BTreeSet::new();
                PointConfig { rule }.rows(point, &grid, clip, &mut |y, x0, x1| {
                    assert!(x0 < x1);
                    got.extend((x0..x1).map(|x| (x, y)));
                });
                let size = i128::from(size);
                for (x, y) in (0..6).flat_map(|x| (0..6).map(move |y| (x, y))) {
                    let at = grid.position(x.into(), y.into());
                    let q = [at[0] - point[0], at[1] - point[1]];
                    let up = |value: i128| (value - 4 + 3).div_euclid(4);
                    let wanted = match rule {
                        PointRule::Pixel => {
                            [x, y].map(i128::from) == point.map(|v: i128| v.div_euclid(4))
                        }
                        PointRule::PixelD3d => [x, y].map(i128::from) == point.map(up),
                        PointRule::Square { .. } => {
                            q.iter().all(|d| -size <= 2 * d && 2 * d < size)
                        }
                        PointRule::Disk { .. } => {
                            let far = 4 * (q[0] * q[0] + q[1] * q[1]);
                            let rim = far == size * size;
                            rims += u32::from(rim);
                            far < size * size || (rim && (q[1] < 0 || (q[1] == 0 && q[0] < 0)))
                        }
                    };
                    assert_eq!(got.contains(&(x, y)), wanted, "{rule:?} {point:?} {x} {y}");
                }
            }
        }
    }
    assert!(rims > 100);
}

/// Clause L-10: in its octant the height of a circle is the nearest to the exact one; each pixel once.
#[test]
fn circles_are_nearest_and_complete() {
    for r in 0..=60 {
        let mut pixels = Vec::new();
        circle(r, &mut |p| pixels.push(p));
        let set: BTreeSet<[i64; 2]> = pixels.iter().copied().collect();
        assert_eq!(set.len(), pixels.len(), "radius {r}");
        let r2 = i64::from(r) * i64::from(r);
        for [x, y] in &pixels {
            let (a, b) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
            let rest = 4 * (r2 - a * a);
            assert!((2 * b - 1).pow(2) <= rest.max(1) && rest < (2 * b + 1).pow(2), "{r} {x} {y}");
            for image in [[*y, *x], [-x, *y], [*x, -y]] {
                assert!(set.contains(&image), "radius {r}");
            }
        }
        // One pixel a column of the octant.
        let octant = set.iter().filter(|[x, y]| 0 <= *x && x <= y).count();
        let columns: BTreeSet<i64> =
            set.iter().filter(|[x, y]| 0 <= *x && x <= y).map(|p| p[0]).collect();
        assert_eq!(octant, columns.len());
    }
}

/// Clause L-9: a line across the whole vertex field costs what a small window holds of it.
#[test]
fn long_lines_cost_their_window() {
    let grid = SampleGrid::at([128, 128], 8);
    let clip = Rect { x0: 0, y0: 0, x1: 16, y1: 16 };
    let far = 1i128 << 31;
    let begin = std::time::Instant::now();
    for rule in [
        LineRule::DiamondD3d,
        LineRule::DiamondVulkan,
        LineRule::Bresenham,
        LineRule::Midpoint { tie: Tie::East },
        LineRule::IntegerIncremental { start: Start::Half },
        LineRule::Incremental { fraction: 60, rounding: Rounding::Floor },
        LineRule::Naive { rounding: Rounding::Floor },
    ] {
        for line in [[[-far, -far], [far, far]], [[far, far], [-far, -far]]] {
            let pixels = plotted(rule, line, &grid, clip);
            assert_eq!(pixels.len(), 16, "{rule:?}");
        }
        assert!(plotted(rule, [[-far, far], [far, far]], &grid, clip).is_empty());
    }
    // A walk over 2^24 pixels would take seconds in a test build.
    assert!(begin.elapsed() < std::time::Duration::from_secs(1));
}

fn eval(profile: &str, line: &str) -> (String, i32) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_guardbit"))
        .args(["eval", profile])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(format!("{line}\n").as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
}

/// What eval answers for lines, points, polygons and homogeneous triangles, and what it refuses.
#[test]
fn eval_draws_every_primitive_or_says_why_not() {
    for (profile, line, rows) in [
        ("sgi-4k", r#"{"id": 7, "point": [1024, 2048]}"#, "[[2, 1, 2]]"),
        ("d3d11", r#"{"id": 7, "point": [256, 512]}"#, "[[1, 0, 1]]"),
        ("sgi-4k", r#"{"id": 7, "line": [[512, 512], [3584, 512]]}"#, "[[0, 0, 3]]"),
        ("sgi-4k", r#"{"id": 7, "line": [[512, 512], [512, 512]]}"#, "[]"),
    ] {
        let (answer, status) = eval(profile, line);
        assert_eq!(answer, format!("{{\"id\": 7, \"rows\": {rows}}}\n"));
        assert_eq!(status, 0);
    }
    for (profile, line, says) in [
        ("sgi-4k", r#"{"id": 7, "line": [[0, 0], [0, 4194305]]}"#, "line[1][1] = 4194305"),
        ("sgi-4k", r#"{"id": 7, "point": [-1, 0]}"#, "point[0] = -1"),
        ("sgi-4k", r#"{"id": 7, "polygon": [[0,0],[1,1]]}"#, "3 vertices or more"),
        ("sgi-4k", r#"{"id": 7, "polygon": [[0,0],[1,1],[2,0]]}"#, "field `polygon`"),
        ("sgi-4k", r#"{"id": 7, "polygon": [[0,0],[1,1,3],[2,0]]}"#, "polygon[1]"),
        ("sgi-4k", r#"{"id": 7, "clip": [[0,0,1],[1,1,1],[2,0,1]]}"#, "field `clip`"),
        ("sgi-4k", r#"{"id": 7, "clip": [[0,0,1],[1,1,0,1],[2,0,1]]}"#, "clip[1]"),
        ("sgi-4k", r#"{"id": 7, "line": [[0, 0], [1e3, 0]]}"#, "line[1][0]"),
    ] {
        let (answer, status) = eval(profile, line);
        assert!(answer.contains(says) && answer.contains("\"error\""), "{line}: {answer}");
        assert_eq!(status, 2);
    }
}
