//! Polygons, clipping and quadrilaterals against their definitions.
#![allow(
    clippy::unwrap_used,
    clippy::cast_precision_loss,
    reason = "a test may panic, and its numbers are small"
)]

use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::{ClipRect, FillRule, GuardBand, Rect, SampleGrid, polygon};
use guardbit::exact::{Rational, Rule, covers, integer};
use guardbit::model::{Drawing, Model};
use guardbit::profile::{WindowConfig, load};
use guardbit::setup::{Diagonal, Polygon};

const GRID: SampleGrid = SampleGrid::at([1, 1], 1);
const CLIP: Rect = Rect { x0: 0, y0: 0, x1: 6, y1: 6 };

/// Hits of each pixel; runs come in order and do not overlap.
fn hits(shape: &[[i128; 2]], rule: FillRule) -> [u32; 36] {
    let mut hits = [0; 36];
    let mut last = (0, 0);
    polygon(shape, &GRID, CLIP, rule, &mut |y, x0, x1| {
        assert!(x0 < x1 && (y, x0) >= last, "{shape:?}");
        last = (y, x1);
        (x0..x1).for_each(|x| hits[(y * 6 + x) as usize] += 1);
    });
    hits
}

/// Clauses Y-1 and Y-2: parity, by the triangles that a fan around any point makes of a polygon: a
/// sample is inside when an odd number of them cover it, whatever their shape.
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn parity_is_that_of_the_triangles_of_a_fan() {
    let mut inside = 0;
    for index in 0..3000 {
        let mut words = Words::new(2, 8, index);
        let corners = 3 + usize::try_from(index % 5).unwrap();
        // Even and odd coordinates meet samples, repeat points and line up.
        let shape: Vec<[i128; 2]> =
            (0..corners).map(|_| [words.between(-2, 14), words.between(-2, 14)]).collect();
        for (rule, exact) in [(FillRule::TopLeft, Rule::TopLeft), (FillRule::Shadow, Rule::Shadow)]
        {
            let got = hits(&shape, rule);
            for (place, hit) in (0i128..).zip(got) {
                let at = [place % 6 * 2 + 1, place / 6 * 2 + 1];
                let fan = (1..corners - 1)
                    .filter(|k| covers([shape[0], shape[*k], shape[k + 1]], at, exact))
                    .count();
                assert_eq!(hit, u32::from(fan % 2 == 1), "{shape:?} {rule:?} {at:?}");
                inside += hit;
            }
        }
    }
    assert!(inside > 10_000);
}

/// Clause Y-1: a concave polygon and the pieces that fill its bounding box share no sample.
#[test]
fn neighbours_of_a_concave_polygon_leave_no_gap() {
    // A notch cut into a square, and the piece that fills it.
    let square = [[0, 0], [12, 0], [7, 5], [12, 11], [0, 11]];
    let piece = [[12, 0], [12, 11], [7, 5]];
    let (a, b) = (hits(&square, FillRule::TopLeft), hits(&piece, FillRule::TopLeft));
    for (place, (a, b)) in a.iter().zip(b).enumerate() {
        assert_eq!(a + b, u32::from(place < 30), "{place}");
    }
}

/// A bow tie has two lobes and nothing at its crossing; drawn through the machine of scanlines.
#[test]
fn bow_ties_are_drawn_by_the_scanline_machine() {
    let mut profile = load("sgi-4k").unwrap().with_machine("scanline").unwrap();
    profile.window = WindowConfig { width: 8, height: 8 };
    let model = Model::new(&profile).unwrap();
    let p = 1024;
    let xy = vec![[0, 0], [8 * p, 8 * p], [8 * p, 0], [0, 8 * p]];
    let mut drawing = Drawing::default();
    model.draw(&model.place(Polygon { xy, z: None }).unwrap(), &mut drawing).unwrap();
    // Row 1: x from 1.5 and from the other side: [0, 1.5) and (6.5, 8).
    let row: Vec<[u32; 2]> =
        drawing.spans.iter().filter(|span| span.y == 1).map(|span| [span.x0, span.x1]).collect();
    assert_eq!(row, [[0, 1], [6, 8]]);
    let tilted = vec![[0, 0], [p, 0], [0, p]];
    let tilted = model.place(Polygon { xy: tilted, z: Some(vec![1, 2, 3]) }).unwrap();
    let refused = model.draw(&tilted, &mut drawing);
    assert!(refused.unwrap_err().to_string().contains("plane"));
}

fn rational_part(segment: [[i128; 2]; 2], rect: &ClipRect) -> Option<[Rational; 2]> {
    // Liang and Barsky: the part of the way inside all four sides.
    let [a, b] = segment;
    let (mut from, mut to) = (integer(0), integer(1));
    for k in 0..2 {
        let d = b[k] - a[k];
        if d == 0 {
            if a[k] < rect.low[k] || a[k] > rect.high[k] {
                return None;
            }
            continue;
        }
        let [low, high] = [rect.low[k], rect.high[k]].map(|s| integer(s - a[k]) / integer(d));
        let (enter, leave) = if d > 0 { (low, high) } else { (high, low) };
        from = from.max(enter);
        to = to.min(leave);
    }
    (from <= to).then_some([from, to])
}

/// Clause Y-4: the part inside is that of Liang and Barsky, each new end within half a sub-pixel of
/// the line.
#[test]
fn clipped_lines_are_the_part_inside() {
    let rect = ClipRect { low: [-3, 2], high: [20, 17] };
    let (mut cut, mut lost) = (0, 0);
    for index in 0..20_000 {
        let mut words = Words::new(7, 1, index);
        let mut at = || [words.between(-30, 40), words.between(-25, 45)];
        let segment = [at(), at()];
        let got = rect.line(segment, Rounding::NearestEven);
        let part = rational_part(segment, &rect);
        match (got, part) {
            (Some(ends), Some(part)) => {
                for end in &ends {
                    assert!(rect.outcode(*end) == 0);
                    // On the line on one axis, within half a sub-pixel of it on the other.
                    let near = |k: usize| {
                        let [d, e] =
                            [0, 1].map(|n| segment[1][(k + n) % 2] - segment[0][(k + n) % 2]);
                        let along = end[k] - segment[0][k];
                        let across = end[1 - k] - segment[0][1 - k];
                        2 * (along * e - across * d).abs() <= d.abs()
                    };
                    assert!(segment.contains(end) || near(0) || near(1), "{segment:?} {ends:?}");
                }
                assert!(part[0] <= part[1]);
                cut += u32::from(ends != segment);
            }
            (None, None) => lost += 1,
            // A segment that only grazes a corner: the rounded end lies beyond the other side.
            (None, Some([from, to])) => assert!(to - from < integer(1) / integer(3), "{segment:?}"),
            (Some(_), None) => {
                // The rounded end fell onto the rectangle though the segment passes it closely.
                let grown = ClipRect { low: [-4, 1], high: [21, 18] };
                assert!(rational_part(segment, &grown).is_some(), "{segment:?}");
            }
        }
    }
    assert!(cut > 3000 && lost > 3000, "{cut} {lost}");
}

/// Clause Y-5: a polygon cut to the window covers the window's samples as the whole one does, where its
/// new vertices fall onto the grid.
#[test]
fn clipped_polygons_cover_the_same_samples() {
    let rect = ClipRect { low: [0, 0], high: [12, 12] };
    let mut compared = 0;
    for index in 0..4000 {
        let mut words = Words::new(7, 2, index);
        // Slopes of 0, 1 and infinity meet every side on the grid: vertices on a coarse lattice.
        let (x, y) = (words.between(-8, 20), words.between(-8, 20));
        let (a, b) = (words.between(1, 16), words.between(1, 16));
        let shapes: [Vec<[i128; 2]>; 3] = [
            vec![[x, y], [x + a, y], [x + a, y + b], [x, y + b]],
            vec![[x, y - a], [x + a, y], [x, y + a], [x - a, y]],
            // Concave: an arrow.
            vec![[x, y - a], [x + a, y], [x, y + a], [x, y]],
        ];
        for shape in shapes {
            let cut = rect.polygon(&shape, Rounding::NearestEven);
            assert!(cut.iter().all(|point| rect.outcode(*point) == 0));
            let (whole, part) = (hits(&shape, FillRule::TopLeft), hits(&cut, FillRule::TopLeft));
            assert_eq!(whole, part, "{shape:?} {cut:?}");
            compared += whole.iter().sum::<u32>();
        }
    }
    assert!(compared > 10_000);
    assert!(rect.polygon(&[[-5, -5], [-2, -5], [-2, -1]], Rounding::Floor).is_empty());
}

/// Clause Y-6: outside, inside the band, or to be clipped.
#[test]
fn the_guard_band_decides() {
    let window = ClipRect { low: [0, 0], high: [100, 100] };
    let band = ClipRect { low: [-50, -50], high: [150, 150] };
    let of = |triangle| window.guard_band(&band, &triangle);
    assert_eq!(of([[-40, 5], [-1, 90], [-20, 200]]), GuardBand::Outside);
    assert_eq!(of([[-40, 5], [10, 90], [140, 120]]), GuardBand::Inside);
    assert_eq!(of([[-60, 5], [10, 90], [140, 120]]), GuardBand::Clip);
    // Beyond two sides but not one: it may cross the window.
    assert_eq!(of([[-40, 50], [50, -40], [-49, -49]]), GuardBand::Inside);
}

/// Clause Y-3: the greater dot product is connected, ties between A and C; both triangles wind as the
/// quadrilateral does.
#[test]
fn quadrilaterals_are_split_along_the_better_diagonal() {
    let agree = [0, 0, 10];
    assert_eq!(Diagonal::of([agree; 4]), Diagonal::Ac);
    assert_eq!(Diagonal::of([agree, [10, 0, 0], agree, [-10, 0, 0]]), Diagonal::Ac);
    assert_eq!(Diagonal::of([[10, 0, 0], agree, [-10, 0, 0], agree]), Diagonal::Bd);
    let corners = [[0, 0], [4, 0], [4, 4], [0, 4]];
    let area =
        |[a, b, c]: [[i128; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    for diagonal in [Diagonal::Ac, Diagonal::Bd] {
        assert_eq!(diagonal.split(corners).map(area), [16, 16]);
    }
}

/// Clause Y-7: what each experiment is to show.
#[test]
fn experiments_show_what_they_are_about() {
    let made = guardbit::measure::experiment::experiments();
    // T-vertices crack at every grid, less on finer ones, and never vanish.
    let cracks: Vec<u64> = made.t_vertices.iter().map(|row| row.holes + row.double_hits).collect();
    assert!(cracks[0] > 1000 && cracks.windows(2).all(|pair| pair[1] < pair[0]), "{cracks:?}");
    assert!(made.t_vertices[1].holes > 0 && made.t_vertices[1].double_hits > 0);
    // Thin slivers: few samples, a larger part of them misplaced, steeper depth.
    let part = |n: usize| made.acute[n].misplaced as f64 / made.acute[n].samples.max(1) as f64;
    assert!(made.acute.windows(2).all(|pair| pair[1].samples < pair[0].samples));
    assert!(made.acute.windows(2).all(|pair| pair[1].slope > pair[0].slope));
    assert!(part(5) > 10.0 * part(0), "{:?}", made.acute);
    // A moved sample grid meets no vertex, and edges all the same.
    assert!(made.offset_grid[0].on_vertices > 0);
    assert_eq!(made.offset_grid[1].on_vertices, 0);
    assert!(made.offset_grid[1].on_edges > 100);
    // Lines with a depth of their own disappear; an offset or the plane keeps them.
    let [own, moved, plane] = &made.outlines[..] else { panic!("three ways") };
    assert!(own.pixels > 1000 && own.hidden * 4 > own.pixels, "{own:?}");
    assert_eq!((moved.hidden, plane.hidden), (0, 0));
}
