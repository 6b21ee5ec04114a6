//! Bit patterns and pictures, as a person would check them. Each was checked by hand, or by a few
//! lines of rational arithmetic elsewhere, before it was accepted.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::{RunTime, Width as _, Word, hex};
use guardbit::dda::{Op, Walker};
use guardbit::format::{Clamp, ReadOut};
use guardbit::model::{Drawing, Model, View};
use guardbit::profile::load;
use guardbit::setup::Triangle;
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
    let model = Model::with_view(
        &load(profile).unwrap(),
        View { window: Some((128, 128)), ..View::default() },
    )
    .unwrap();
    let mut drawing = Drawing::default();
    model.draw(&triangle, &mut drawing).unwrap();
    let mut text = String::new();
    for (column, word) in model.ports().setup.iter().zip(&drawing.setup) {
        let word = Word::wrapping(RunTime::new(column.width).unwrap(), *word);
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
        model.draw(&Triangle { xy: *xy, z: None }, &mut drawing).unwrap();
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
    let lattice = triangles.map(|(xy, _)| {
        xy.map(|v| v.map(|c| profile.vertex.snap((0, 0), c, 8, profile.vertex.range()).unwrap()))
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
