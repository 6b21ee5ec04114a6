//! Bit patterns and pictures, as a person would check them. Each was checked by hand, or by a few
//! lines of rational arithmetic elsewhere, before it was accepted.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::{Rounding, RunTime, Width as _, Word, hex};
use guardbit::cover::{LineConfig, LineRule, Rect, SampleGrid, Start, Stipple, Tie};
use guardbit::dda::{Op, Walker};
use guardbit::format::{Clamp, ReadOut};
use guardbit::model::{Drawing, Model, View};
use guardbit::profile::{Profile, load};
use guardbit::setup::{Coordinate, Polygon, Triangle};
use std::fmt::Write as _;

/// Value, pattern and read-out of every pattern, lowest value of the guard range first.
fn guard_table(guard: u32, integer: u32) -> String {
    let read = ReadOut::new(guard, integer, 0, Clamp::Guard).unwrap();
    let width = RunTime::new(read.width()).unwrap();
    let (low, end) = read.range();
    let mut text = "value pattern clamped\n".to_owned();
    for value in low..end {
        let pattern = Word::wrapping(width, value);
        writeln!(text, "{value:5} {pattern:>7b} {:7}", read.read(value)).unwrap();
    }
    assert_eq!(text.lines().count(), 1 + (1 << width.bits()));
    text
}

// Clauses G-3, G-4
#[test]
fn guard_bits() {
    insta::assert_snapshot!("guard_1_over_2", guard_table(1, 2));
    insta::assert_snapshot!("guard_2_over_2", guard_table(2, 2));
}

// Clauses D-2, D-4, G-1
#[test]
fn a_walk_out_and_back() {
    // 1 guard, 2 integer, 2 fraction bits; start 2 1/4, dx 1 1/2, dy -3/4.
    let read = ReadOut::new(1, 2, 2, Clamp::Guard).unwrap();
    let mut walk = Walker::new(read, 9, 6, -3);
    let mut text = "op     accumulator out\n".to_owned();
    let ops = [
        Op::Load,
        Op::StepX,
        Op::StepX,
        Op::StepX,
        Op::Hold,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
        Op::StepY,
    ];
    for op in ops {
        walk.clock(op);
        writeln!(text, "{:<6} {:05b}       {}", format!("{op:?}"), walk.pattern(), walk.out())
            .unwrap();
    }
    insta::assert_snapshot!("walk", text);
}

/// Set-up words as a vector file has them: name, width, hexadecimal.
fn setup_words(profile: &str, triangle: Triangle) -> String {
    setup_words_of(&load(profile).unwrap(), triangle)
}

fn setup_words_of(profile: &Profile, triangle: Triangle) -> String {
    let view = View { window: Some((128, 128)), ..View::default() };
    let model = Model::with_view(profile, view).unwrap();
    let mut drawing = Drawing::default();
    model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
    let mut text = String::new();
    let words = model.ports().words(&drawing.setup).unwrap();
    for (column, word) in model.ports().setup.iter().zip(words) {
        writeln!(
            text,
            "{:<4} {:2} {}",
            column.name,
            column.width,
            hex(word.to_bits(), column.width)
        )
        .unwrap();
    }
    assert_eq!(model.ports().setup.len(), drawing.setup.len());
    text
}

/// (10.5, 20.25), (100.75, 30.5), (40, 90.125), in sub-pixels, with three depths.
fn named(sub_pixel: u32) -> Triangle {
    let at = |eighths: i128| (eighths << sub_pixel) / 8;
    let xy = [[84, 162], [806, 244], [320, 721]].map(|v| v.map(at));
    Triangle { xy, z: Some([0x1000, 0x80_0000, 0xff_ffff]) }
}

// Clauses W-4, C-4, C-5, P-2, K-3
#[test]
fn set_up_words() {
    insta::assert_snapshot!("setup_sgi_4k", setup_words("sgi-4k", named(10)));
    insta::assert_snapshot!("setup_sgi_4k_walk", setup_words("sgi-4k-walk", named(10)));
    insta::assert_snapshot!("setup_d3d11", setup_words("d3d11", named(8)));
}

/// Triangles as letters, in order; a point where nothing is, `!` where two met.
fn picture(profile: &str, size: (u32, u32), triangles: &[[[i128; 2]; 3]]) -> (String, Vec<u64>) {
    let view = View { window: Some(size), ..View::default() };
    let model = Model::with_view(&load(profile).unwrap(), view).unwrap();
    let mut cells = vec![vec!['.'; size.0 as usize]; size.1 as usize];
    let mut counts = Vec::new();
    for (letter, xy) in ('a'..).zip(triangles) {
        let mut drawing = Drawing::default();
        model.draw(&model.place(Triangle { xy: *xy, z: None }).unwrap(), &mut drawing).unwrap();
        counts.push(drawing.samples());
        for span in &drawing.spans {
            for cell in &mut cells[span.y as usize][span.x0 as usize..span.x1 as usize] {
                *cell = if *cell == '.' { letter } else { '!' };
            }
        }
    }
    (cells.iter().map(|row| row.iter().collect::<String>() + "\n").collect(), counts)
}

// Clauses C-2, C-7
#[test]
fn the_top_left_rule_of_direct3d() {
    // Fourteen triangles in pixels, each meeting the rule in its own way, and their pixel counts.
    let triangles: [([[f64; 2]; 3], u64); 14] = [
        ([[1.0, 1.0], [6.0, 2.0], [2.0, 4.0]], 7),
        ([[5.25, 1.25], [6.25, 0.25], [6.25, 1.25]], 0),
        ([[6.5, 1.5], [7.5, 0.5], [7.5, 1.5]], 0),
        ([[9.75, 0.75], [7.75, 2.5], [11.75, 2.5]], 2),
        ([[7.75, 2.5], [11.75, 2.5], [9.5, 5.25]], 8),
        ([[1.0, 6.0], [7.0, 4.0], [5.0, 6.0]], 4),
        ([[7.0, 4.0], [5.0, 6.0], [8.0, 7.0]], 5),
        ([[7.0, 4.0], [9.5, 5.5], [8.0, 7.0]], 3),
        ([[11.5, 4.5], [12.5, 5.5], [11.5, 6.5]], 1),
        ([[15.0, 0.0], [13.5, 1.5], [14.5, 2.5]], 3),
        ([[13.5, 1.5], [14.5, 2.5], [14.5, 4.5]], 0),
        ([[13.5, 5.5], [15.5, 5.5], [13.5, 7.5]], 3),
        ([[15.5, 5.5], [15.5, 7.5], [13.5, 7.5]], 1),
        ([[9.5, 7.5], [10.5, 7.5], [9.5, 9.5]], 2),
    ];
    let profile = load("d3d11").unwrap();
    let origin = Coordinate { key: "f", vertex: Some(0), axis: 0 };
    let lattice = triangles.map(|(xy, _)| {
        xy.map(|v| v.map(|c| profile.vertex.snap(origin, c, 8, profile.vertex.range()).unwrap()))
    });
    let (text, counts) = picture("d3d11", (16, 10), &lattice);
    assert_eq!(counts, triangles.map(|(_, count)| count));
    insta::assert_snapshot!("top_left", text);
}

// Clauses C-2, T-2
#[test]
fn small_pictures() {
    let square = [[[1, 1], [7, 1], [1, 7]], [[7, 7], [1, 7], [7, 1]]];
    insta::assert_snapshot!("square", picture("tiny", (4, 4), &square).0);
    // A fan around (6, 5) in pixels: eight triangles share a vertex, all edges cross samples.
    let rim = [[0, 0], [6, 0], [12, 0], [12, 5], [12, 10], [6, 10], [0, 10], [0, 5]];
    let sub = |[x, y]: [i128; 2]| [256 * x + 128, 256 * y + 128];
    let fan: Vec<_> = (0..8).map(|n| [[6, 5], rim[n], rim[(n + 1) % 8]].map(sub)).collect();
    let (text, counts) = picture("d3d11", (14, 12), &fan);
    // The rectangle of samples [0, 12) by [0, 10) under half-open edges.
    assert_eq!(counts.iter().sum::<u64>(), 120);
    insta::assert_snapshot!("fan", text);
    let walked: Vec<_> = fan.iter().map(|t| t.map(|v| v.map(|c| c * 4))).collect();
    insta::assert_snapshot!("fan", picture("sgi-4k-walk", (14, 12), &walked).0);
}

// Clauses
#[test]
fn set_up_words_of_machines() {
    let base = load("sgi-4k").unwrap();
    for machine in ["gouraud", "barycentric", "homogeneous", "scanline"] {
        let profile = base.with_machine(machine).unwrap();
        insta::assert_snapshot!(format!("setup_{machine}"), setup_words_of(&profile, named(10)));
    }
}

/// Sixteen lines out of the middle of a window, some through ties, by one rule.
fn star(config: LineConfig) -> String {
    let grid = SampleGrid::at([2, 2], 2);
    let clip = Rect { x0: 0, y0: 0, x1: 33, y1: 33 };
    let mut cells = vec![vec!['.'; 33]; 33];
    let ends: [[i128; 2]; 8] =
        [[15, 0], [14, 7], [15, 10], [13, 13], [7, 14], [0, 15], [-10, 15], [-14, 7]];
    for (letter, [x, y]) in ('a'..).zip(ends.into_iter().chain(ends.map(|[x, y]| [-x, -y]))) {
        // From pixel centre to pixel centre.
        let at = |dx: i128, dy: i128| [(16 + dx) * 4 + 2, (16 + dy) * 4 + 2];
        let near = [x.signum() * 3, y.signum() * 3];
        config.pixels([at(near[0], near[1]), at(x, y)], &grid, clip, &mut |x, y| {
            let cell = &mut cells[y as usize][x as usize];
            *cell = if *cell == '.' { letter } else { '!' };
        });
    }
    cells.iter().map(|row| row.iter().collect::<String>() + "\n").collect()
}

// Clauses L-1, L-2, L-4, L-5, L-7
#[test]
fn lines_by_rule() {
    for (name, rule) in [
        ("d3d", LineRule::DiamondD3d),
        ("vulkan", LineRule::DiamondVulkan),
        ("bresenham", LineRule::Bresenham),
        ("north_east", LineRule::Midpoint { tie: Tie::NorthEast }),
        ("floored", LineRule::IntegerIncremental { start: Start::Zero }),
        ("two_bits", LineRule::Incremental { fraction: 2, rounding: Rounding::NearestEven }),
        ("wide", LineRule::Rectangle { width: 8 }),
    ] {
        insta::assert_snapshot!(format!("star_{name}"), star(LineConfig { rule, stipple: None }));
    }
    let stipple = Some(Stipple { pattern: 0b11, factor: 2 });
    insta::assert_snapshot!(
        "star_stipple",
        star(LineConfig { rule: LineRule::Bresenham, stipple })
    );
}

// Clauses Y-1, Y-2
#[test]
fn polygons_by_parity() {
    let profile = load("sgi-4k").unwrap().with_machine("scanline").unwrap();
    let view = View { window: Some((24, 12)), ..View::default() };
    let model = Model::with_view(&profile, view).unwrap();
    let mut cells = vec![vec!['.'; 24]; 12];
    let shapes: [&[[i128; 2]]; 3] = [
        &[[0, 0], [7, 11], [7, 0], [0, 11]],
        &[[8, 0], [12, 4], [16, 0], [16, 11], [8, 11]],
        &[[20, 0], [23, 11], [16, 4], [24, 4], [17, 11]],
    ];
    for (letter, shape) in ('a'..).zip(shapes) {
        let xy = shape.iter().map(|p| p.map(|c| c * 1024)).collect();
        let mut drawing = Drawing::default();
        model.draw(&model.place(Polygon { xy, z: None }).unwrap(), &mut drawing).unwrap();
        for span in &drawing.spans {
            cells[span.y as usize][span.x0 as usize..span.x1 as usize].fill(letter);
        }
    }
    let text: String = cells.iter().map(|row| row.iter().collect::<String>() + "\n").collect();
    insta::assert_snapshot!("polygons", text);
}
