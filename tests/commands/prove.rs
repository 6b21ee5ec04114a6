//! Claims on bits: their numbers, their witnesses judged anew, toys exhaustively, and the command.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run;

use guardbit::bits::Rounding;
use guardbit::cover::{EdgeStorage, EdgeWordConfig, FillRule, SampleConfig};
use guardbit::exact::{self, Rational, Rule, dyadic, integer};
use guardbit::explore::prove::{self, Overrides, Proof, Question, Witness, prove, table};
use guardbit::profile::{Form, Profile, load};
use num_traits::Signed;
use run::{Ran, guardbit, run_in};

const PLAIN: Overrides =
    Overrides { window: None, guard_band: None, sub_pixel: None, depth_bits: None, w_ratio: None };

fn find(proofs: &[Proof], claim: &str) -> Proof {
    proofs.iter().find(|proof| proof.claim == claim).unwrap().clone()
}

fn ask(profile: &str, overrides: Overrides) -> Vec<Proof> {
    prove(&Question::new(&load(profile).unwrap(), overrides).unwrap())
}

/// E by a cross product of differences: no coefficients, as the model and the prover have.
fn e([from, to]: [[i128; 2]; 2], at: [i128; 2]) -> i128 {
    (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
}

fn bias([from, to]: [[i128; 2]; 2]) -> i128 {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    if dy < 0 || (dy == 0 && dx > 0) { 0 } else { -1 }
}

/// Whether a value has an `n`-bit two's complement word.
fn fits(value: i128, n: u32) -> bool {
    (-(1_i128 << (n - 1))..1 << (n - 1)).contains(&value)
}

fn sides(witness: &Witness) -> [[[i128; 2]; 2]; 3] {
    let v = &witness.triangle;
    [[v[0], v[1]], [v[1], v[2]], [v[2], v[0]]]
}

/// Judges a witness of an edge width by arithmetic of its own: in the claimed width all three words
/// fit and say what the exact triangle says, in one bit less their signs say the opposite.
#[track_caller]
fn judge_width(proof: &Proof, shift: u32) {
    let (bits, witness) = (proof.bits.unwrap(), proof.witness.as_ref().unwrap());
    assert_eq!((witness.bits, witness.by), (bits - 1, "model"));
    let sample = witness.sample.unwrap();
    let words = sides(witness).map(|side| (e(side, sample) + bias(side)) >> shift);
    assert!(words.iter().all(|word| fits(*word, bits)), "{words:?}");
    let covered = |n: u32| words.iter().all(|word| word >> (n - 1) & 1 == 0);
    let triangle = [witness.triangle[0], witness.triangle[1], witness.triangle[2]];
    let truth = exact::covers(triangle, sample, Rule::TopLeft);
    assert_eq!(covered(bits), truth, "{witness:?}");
    assert_ne!(covered(bits - 1), truth, "{witness:?}");
    let culprit = (e(witness.edge.unwrap(), sample) + bias(witness.edge.unwrap())) >> shift;
    assert!(!fits(culprit, bits - 1), "{culprit} needs all {bits} bits");
}

// Clauses B-2, B-3 and B-10.
#[test]
fn the_table_has_the_known_widths_and_each_row_a_misread_sample() {
    let rows = table().unwrap();
    let expected = [
        ("4096-s10", 45, 35, 10),
        ("4096-s10-g2048", 47, 37, 10),
        ("4096-s10-g4096", 48, 38, 10),
        ("4096-s8", 41, 33, 8),
        ("d3d", 49, 41, 8),
        ("16k", 47, 39, 8),
        ("2048-s8", 39, 31, 8),
        ("8192-s4", 35, 31, 4),
        ("2048-s9", 41, 32, 9),
        ("8192-s5", 37, 32, 5),
    ];
    assert_eq!(rows.len(), expected.len());
    for (row, (name, full, stored, s)) in rows.iter().zip(expected) {
        let found = (&*row.name, row.full.bits, row.stored.bits);
        assert_eq!(found, (name, Some(full), Some(stored)));
        assert!(row.full.sufficient && row.stored.sufficient);
        judge_width(&row.full, 0);
        judge_width(&row.stored, s);
    }
    // Coordinates are the window's own, negative ones included.
    let d3d = rows[4].stored.witness.as_ref().unwrap();
    assert!(d3d.triangle.iter().flatten().any(|at| *at == -32768 << 8));
    assert!(d3d.pixel.unwrap().iter().all(|at| (-32768..32768).contains(at)));
}

#[test]
fn the_35_bits_are_an_exact_edge_function_without_a_guard_band() {
    let stored = find(&ask("sgi-4k", PLAIN), "edge.stored");
    assert_eq!((stored.bits, stored.given, stored.sufficient), (Some(35), Some(35), true));
    assert!(stored.statement.contains("the 35 bits of the profile are exactly enough"));
    assert!(stored.statement.contains("1 guard + 12 integer + 10 sub-pixel + 12 interpolation"));
    judge_width(&stored, 10);
    // The sentence on the budget is computed: another window has another one or none.
    let of = |window| Overrides { window: Some((window, window)), guard_band: Some(0), ..PLAIN };
    let other = find(&ask("sgi-4k", of(2048)), "edge.stored");
    assert!(other.statement.contains("33 = 1 guard + 11 integer + 10 sub-pixel + 11 inter"));
    assert!(!find(&ask("sgi-4k", of(3000)), "edge.stored").statement.contains("1 guard +"));
    let wide = |profile: &str, band| {
        find(&ask(profile, Overrides { guard_band: Some(band), ..PLAIN }), "edge.stored")
    };
    // One pixel of a guard band is one bit, and the profile has too few.
    let broken = wide("sgi-4k", 1);
    assert_eq!((broken.bits, broken.given, broken.sufficient), (Some(36), Some(35), false));
    assert_eq!(broken.verdict(), "TOO FEW");
    judge_width(&broken, 10);
    // 171/1024 of a pixel is the first widening that takes it: (W - 1/2 + g)(W + 2g) > W^2 - 1.
    let most = |g: i128| {
        let side = 4096_i128 << 10;
        (side - 512 + g) * (side + 2 * g) - 1
    };
    assert!(stored.statement.contains("171/1024 pixels further out"));
    assert!(fits(most(170) >> 10, 35) && !fits(most(171) >> 10, 35));
}

/// A start and slopes rounded apart from the model, from exact rationals.
fn drawn(
    witness: &Witness,
    rounding: Rounding,
    fraction: u32,
    offset: [i128; 2],
    s: u32,
) -> Rational {
    let triangle = [witness.triangle[0], witness.triangle[1], witness.triangle[2]];
    let z = witness.depths.unwrap();
    let unit = |value: Rational| exact::round(&(value * dyadic(1 << fraction, 0)), rounding);
    let start = unit(exact::plane_at(triangle, z, offset).unwrap());
    let slopes = exact::plane_slopes(triangle, z).unwrap().map(|v| unit(v * dyadic(1 << s, 0)));
    let [x, y] = witness.pixel.unwrap();
    Rational::from(start + &slopes[0] * x + &slopes[1] * y) * dyadic(1, fraction)
}

/// How far a depth witness is off with so many bits.
fn off(witness: &Witness, rounding: Rounding, fraction: u32, s: u32) -> Rational {
    let triangle = [witness.triangle[0], witness.triangle[1], witness.triangle[2]];
    let sample = witness.sample.unwrap();
    assert!(exact::covers(triangle, sample, Rule::TopLeft), "{witness:?}");
    let truth = exact::plane_at(triangle, witness.depths.unwrap(), sample).unwrap();
    (drawn(witness, rounding, fraction, [1 << (s - 1); 2], s) - truth).abs()
}

// Clause B-5.
#[test]
fn the_39_bits_are_half_an_ulp_to_nearest() {
    let proofs = ask("sgi-4k", PLAIN);
    let depth = find(&proofs, "depth.interpolation");
    assert_eq!((depth.bits, depth.sufficient), (Some(13), true));
    assert!(depth.statement.contains("2 guard + 24 integer + 13 interpolation = 39 bits"));
    assert!(depth.statement.contains("a start and 8190 steps"));
    assert!(depth.statement.contains("1 of its 2 guard bits is needed"));
    assert!(depth.bound.starts_with("8191 x 2^-14 = 8191/16384 < 1/2; with 12: "));
    for (profile, bits, s) in [("sgi-4k", 13, 10), ("d3d11", 15, 8), ("tiny", 3, 1)] {
        let depth = find(&ask(profile, PLAIN), "depth.interpolation");
        let witness = depth.witness.unwrap();
        assert_eq!((depth.bits, witness.bits), (Some(bits), bits - 1), "{profile}");
        assert!(off(&witness, Rounding::NearestEven, bits - 1, s) >= dyadic(1, 1), "{profile}");
        assert!(off(&witness, Rounding::NearestEven, bits, s) < dyadic(1, 1), "{profile}");
    }
}

#[test]
fn every_rounding_has_its_budget_and_its_witness() {
    for rounding in Rounding::ALL {
        let mut profile = load("sgi-4k").unwrap();
        profile.depth.as_mut().unwrap().rounding = rounding;
        let proofs = prove(&Question::new(&profile, PLAIN).unwrap());
        let nearest = rounding.to_string().starts_with("nearest");
        let goals: &[_] = if nearest {
            &[("depth.interpolation", 13, dyadic(1, 1))]
        } else {
            &[
                ("depth.interpolation", 14, dyadic(1, 1)),
                ("depth.interpolation-one", 13, integer(1)),
            ]
        };
        for (claim, bits, goal) in goals {
            let proof = find(&proofs, claim);
            assert_eq!(proof.bits, Some(*bits), "{rounding} {claim}");
            let witness = proof.witness.unwrap();
            assert!(off(&witness, rounding, bits - 1, 10) >= *goal, "{rounding} {claim}");
            assert!(off(&witness, rounding, *bits, 10) < *goal, "{rounding} {claim}");
        }
        assert_eq!(proofs.iter().any(|p| p.claim == "depth.interpolation-one"), !nearest);
    }
}

/// A closed window of 2^k pixels, no guard band.
fn toy(k: u32, s: u32) -> Question {
    Question::square((0, 1 << k), 0, s, 8).unwrap()
}

fn lattice(k: u32, s: u32) -> Vec<[i128; 2]> {
    let side = (1 << (k + s)) + 1;
    (0..side * side).map(|n| [n % side, n / side]).collect()
}

fn centres(k: u32, s: u32) -> Vec<[i128; 2]> {
    let at = move |n: i128| (n << s) + (1 << (s - 1));
    (0..1_i128 << (2 * k)).map(|n| [at(n & ((1 << k) - 1)), at(n >> k)]).collect()
}

#[test]
fn toy_windows_exhaustively() {
    for (k, s) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
        let proofs = prove(&toy(k, s));
        let (points, samples) = (lattice(k, s), centres(k, s));
        let (mut full, mut stored, mut slope, mut constant) = (1, 1, 1, 1);
        for from in &points {
            for to in &points {
                let edge = [*from, *to];
                let grow = |bits: &mut u32, value| {
                    while !fits(value, *bits) {
                        *bits += 1;
                    }
                };
                for sample in &samples {
                    let biased = e(edge, *sample) + bias(edge);
                    grow(&mut full, biased);
                    grow(&mut stored, biased >> s);
                }
                grow(&mut slope, from[1] - to[1]);
                grow(&mut constant, e(edge, [0, 0]));
            }
        }
        let bits = |claim| find(&proofs, claim).bits;
        let found = ["edge.full", "edge.stored", "edge.coefficient", "edge.constant"].map(bits);
        assert_eq!(found, [full, stored, slope, constant].map(Some), "({k},{s})");
        judge_width(&find(&proofs, "edge.full"), 0);
        judge_width(&find(&proofs, "edge.stored"), s);
    }
}

/// A profile of a toy window with depth.
fn toy_depth(rounding: Rounding) -> Profile {
    let mut profile = load("tiny").unwrap();
    profile.window.width = 2;
    profile.window.height = 2;
    profile.vertex.integer = 1;
    let depth = profile.depth.as_mut().unwrap();
    depth.integer = 2;
    depth.rounding = rounding;
    profile
}

/// Worst error over every triangle, depth and centre of (k, s, d) = (1, 1, 2) with F bits, at all
/// centres and at covered ones, as numerator and denominator in ULP.
fn toy_worst(rounding: Rounding, fraction: u32) -> [(i128, i128); 2] {
    let points = lattice(1, 1);
    let mut worst = [(0, 1); 2];
    for a in &points {
        for b in &points {
            for c in &points {
                let area = e([*a, *b], *c);
                if area <= 0 {
                    continue;
                }
                for n in 0..64 {
                    let z = [n % 4, n / 4 % 4, n / 16];
                    // Barycentric: the exact plane times the area.
                    let plane = |at| {
                        z[0] * e([*b, *c], at) + z[1] * e([*c, *a], at) + z[2] * e([*a, *b], at)
                    };
                    let round = |value: i128| rounding.divide(value << fraction, area).unwrap().0;
                    let start = round(plane([1, 1]));
                    let dx = round(plane([3, 1]) - plane([1, 1]));
                    let dy = round(plane([1, 3]) - plane([1, 1]));
                    for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                        let at = [2 * x + 1, 2 * y + 1];
                        let held = (start + dx * x + dy * y) * area;
                        let error = ((held - (plane(at) << fraction)).abs(), area << fraction);
                        let sides = [[*a, *b], [*b, *c], [*c, *a]];
                        let covered = sides.iter().all(|side| e(*side, at) + bias(*side) >= 0);
                        for (worst, counts) in worst.iter_mut().zip([true, covered]) {
                            if counts && error.0 * worst.1 > worst.0 * error.1 {
                                *worst = error;
                            }
                        }
                    }
                }
            }
        }
    }
    worst
}

#[test]
fn the_depth_bound_holds_on_a_toy_for_every_rounding() {
    for rounding in Rounding::ALL {
        let proofs = prove(&Question::new(&toy_depth(rounding), PLAIN).unwrap());
        let proof = find(&proofs, "depth.interpolation");
        let bits = proof.bits.unwrap();
        assert_eq!(bits, if rounding.to_string().starts_with("nearest") { 2 } else { 3 });
        let [everywhere, _] = toy_worst(rounding, bits);
        assert!(2 * everywhere.0 < everywhere.1, "{rounding}: {everywhere:?}");
        // A witness is given exactly where one exists, even in a window this small.
        let [_, covered] = toy_worst(rounding, bits - 1);
        assert_eq!(2 * covered.0 >= covered.1, proof.witness.is_some(), "{rounding}: {covered:?}");
    }
}

// Clause B-7.
#[test]
fn a_sample_wraps_without_its_guard_bit() {
    for (profile, bits, s) in [("sgi-4k", 1, 10), ("tiny", 1, 1)] {
        let proof = find(&ask(profile, PLAIN), "depth.guard");
        assert_eq!((proof.bits, proof.sufficient), (Some(bits), true));
        let witness = proof.witness.unwrap();
        let fraction = load(profile).unwrap().depth.unwrap().interpolation;
        let held = drawn(&witness, Rounding::NearestEven, fraction, [1 << (s - 1); 2], s);
        assert!(held.is_negative() && held > integer(-1), "{held}");
        let triangle = [witness.triangle[0], witness.triangle[1], witness.triangle[2]];
        let sample = witness.sample.unwrap();
        assert!(exact::covers(triangle, sample, Rule::TopLeft));
        let truth = exact::plane_at(triangle, witness.depths.unwrap(), sample).unwrap();
        assert_eq!(truth, integer(0));
        assert!(witness.got.contains(&format!("depth {}", load(profile).unwrap().depth_max())));
    }
    // Floor has the smallest case there is: 4/8192 below zero.
    let mut profile = load("sgi-4k").unwrap();
    profile.depth.as_mut().unwrap().rounding = Rounding::Floor;
    let proof = find(&prove(&Question::new(&profile, PLAIN).unwrap()), "depth.guard");
    let witness = proof.witness.unwrap();
    assert_eq!(witness.triangle, [[5632, 512], [8704, 512], [5632, 3584]]);
    assert_eq!((witness.depths, witness.bits), (Some([0, 1, 0]), 0));
    assert!(witness.got.contains("-4/2^13"), "{}", witness.got);
    // Modes without a range to stay in have no answer.
    for clamp in [guardbit::format::Clamp::Wrap, guardbit::format::Clamp::Saturate] {
        profile.depth.as_mut().unwrap().clamp = clamp;
        let proof = find(&prove(&Question::new(&profile, PLAIN).unwrap()), "depth.guard");
        assert_eq!((proof.bits, proof.sufficient), (None, false));
    }
}

// Clause B-8.
#[test]
fn the_steepest_slope_is_met() {
    for (profile, value) in [("sgi-4k", ((1_i128 << 24) - 1) << (22 + 10 + 13)), ("tiny", 7 << 7)] {
        let proof = find(&ask(profile, PLAIN), "depth.slope");
        let (bits, witness) = (proof.bits.unwrap(), proof.witness.unwrap());
        assert!(fits(value, bits) && !fits(value, bits - 1), "{profile}");
        let triangle = [witness.triangle[0], witness.triangle[1], witness.triangle[2]];
        let [x, _] = exact::plane_slopes(triangle, witness.depths.unwrap()).unwrap();
        let profile = load(profile).unwrap();
        let up = profile.vertex.sub_pixel + profile.depth.unwrap().interpolation;
        assert_eq!(x * integer(1 << up), integer(value));
    }
}

// Clause B-9.
#[test]
fn walked_edges_stray_and_miss_ties() {
    let proofs = ask("sgi-4k-walk", PLAIN);
    let fraction = find(&proofs, "walk.fraction");
    assert_eq!((fraction.bits, fraction.sufficient), (Some(22), true));
    let witness = fraction.witness.unwrap();
    let [from, to] = witness.edge.unwrap();
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    assert!(dy > 0 && from[1] == 0, "the first row is row 0");
    // Worst over the rows of the edge, in sub-pixels times dy 2^F.
    let stray = |f: u32| {
        let start =
            Rounding::NearestEven.divide((from[0] * dy + 512 * dx) << f, dy << 10).unwrap().0;
        let slope = Rounding::NearestEven.divide(dx << f, dy).unwrap().0;
        let exact = |n: i128| (from[0] * dy + (512 + 1024 * n) * dx) << f;
        (0..4096).map(|n| ((((start + slope * n) * dy) << 10) - exact(n)).abs()).max().unwrap()
    };
    assert!(2 * stray(21) >= dy << 21 && 2 * stray(22) < dy << 22);
    let coverage = find(&proofs, "walk.coverage");
    assert_eq!((coverage.bits, coverage.sufficient), (None, false));
    let tie = coverage.witness.unwrap();
    assert_eq!(e(tie.edge.unwrap(), tie.sample.unwrap()), 0, "the edge meets the sample");
    // Floor is exact with 44 bits and not with 43.
    let mut profile = load("sgi-4k-walk").unwrap();
    for (bits, good) in [(43, false), (44, true)] {
        if let Form::EdgeWalk(walk) = &mut profile.form {
            (walk.rounding, walk.fraction) = (Rounding::Floor, bits);
        }
        let coverage = find(&prove(&Question::new(&profile, PLAIN).unwrap()), "walk.coverage");
        assert_eq!((coverage.bits, coverage.sufficient), (Some(44), good));
        assert_eq!(coverage.witness.unwrap().bits, 43);
    }
}

#[test]
fn a_profile_and_a_question_count_the_same_edge_bits() {
    let mut checked = 0;
    for name in ["sgi-4k", "d3d11", "tiny"] {
        let profile = load(name).unwrap();
        let half = 1 << profile.vertex.sub_pixel >> 1;
        for (x, y) in [(0, 0), (half, half), (2 * half - 1, 0)] {
            for rule in FillRule::ALL {
                for band in [0, 3, 1000] {
                    let mut changed =
                        Profile { sample: Some(SampleConfig::sub_pixels(x, y)), ..profile.clone() };
                    let width = changed.form.edge().unwrap().width;
                    let storage = EdgeStorage::Shifted;
                    changed.form = Form::EdgeFunction(
                        EdgeWordConfig { rule, storage, width, conservative: None }.into(),
                    );
                    let overrides = Overrides { guard_band: Some(band), ..PLAIN };
                    let question = Question::new(&changed, overrides).unwrap();
                    let window = (changed.window.width, changed.window.height);
                    // Field and box agree only where the box is a power of two.
                    let (low, high) = question.profile.vertex.range();
                    if question.vertices != [[low; 2], [high; 2]] {
                        continue;
                    }
                    let edges = EdgeWordConfig { rule, storage, width, conservative: None };
                    let grid = question.profile.grid().unwrap();
                    let bits = edges.exact_width(&question.profile.vertex, &grid, window);
                    let stored = find(&prove(&question), "edge.stored");
                    assert_eq!(stored.bits, Some(bits), "{name} {x} {y} {rule:?} {band}");
                    checked += 1;
                }
            }
        }
    }
    assert!(checked >= 18, "{checked}");
    // 35 bits hold for every sample position, as long as the bias comes first.
    let corner = Some(SampleConfig::sub_pixels(0, 0));
    let profile = Profile { sample: corner, ..load("sgi-4k").unwrap() };
    let proofs = prove(&Question::new(&profile, PLAIN).unwrap());
    assert_eq!(find(&proofs, "edge.stored").bits, Some(35));
}

/// Parentheses or braces open before they close, and end closed; comments and strings left out.
#[track_caller]
fn balanced(text: &str, comment: char, [open, close]: [char; 2]) {
    let mut depth = 0;
    for line in text.lines() {
        let mut quoted = false;
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                _ if quoted => {}
                c if c == comment => break,
                c if c == open => depth += 1,
                c if c == close => depth -= 1,
                _ => {}
            }
            assert!(depth >= 0, "{line}");
        }
        assert!(!quoted, "{line}");
    }
    assert_eq!(depth, 0);
}

// Clause B-11.
#[test]
fn prover_files_are_well_formed() {
    for profile in ["sgi-4k", "sgi-4k-walk", "d3d11", "tiny"] {
        let proofs = ask(profile, PLAIN);
        let smt = prove::smt(&proofs);
        balanced(&smt, ';', ['(', ')']);
        let lines: Vec<&str> = smt.lines().collect();
        let mut asked = 0;
        for (n, line) in lines.iter().enumerate().filter(|(_, line)| **line == "(check-sat)") {
            let expected = lines[n - 2].strip_prefix("; expect: ").expect(line);
            assert!(lines[n - 1].starts_with("(echo \"") && lines[n - 1].contains(expected));
            asked += 1;
        }
        let witnesses = proofs.iter().filter(|p| p.bits.is_some() && p.witness.is_some()).count();
        let sat = lines.iter().filter(|line| **line == "; expect: sat").count();
        assert!(sat >= witnesses.min(5) && asked > sat, "{profile}: {asked} {sat} {witnesses}");
        for proof in &proofs {
            assert!(smt.contains(&format!("\n; {}: ", proof.claim)), "{}", proof.claim);
        }
        let gappa = prove::gappa(&proofs).unwrap();
        balanced(&gappa, '#', ['(', ')']);
        balanced(&gappa, '#', ['{', '}']);
        assert!(!gappa.contains('$') && gappa.contains("fixed<-"));
        assert_eq!(gappa.lines().filter(|line| line.starts_with("{ ")).count(), 1);
    }
    assert!(prove::gappa(&[find(&ask("tiny", PLAIN), "depth.guard")]).is_none());
}

/// `tiny` with a channel of each correction that has a bound.
fn with_channels() -> String {
    let channel = |name: &str, correction: &str| {
        format!(
            "[[channel]]\nname = \"{name}\"\ncomponents = [\"s\"]\nguard = 1\ninteger = 3\ninterpolation = 10\n\
             rounding = \"nearest-even\"\nclamp = \"guard\"\ncorrection = {correction}\n"
        )
    };
    load("tiny").unwrap().to_toml()
        + "\n[w]\nguard = 1\ninteger = 6\ninterpolation = 6\nrounding = \"nearest-even\"\nclamp = \"guard\"\n"
        + &channel("color", "\"affine\"")
        + &channel("map", "{ quotient = { rounding = \"nearest-even\" } }")
        + &channel(
            "cube",
            "{ reciprocal = { rounding = \"floor\", unit = { operand = 8, index = 3, entry = 9, \
             refine = \"linear\" } } }",
        )
        + &channel("glow", "{ barycentric = { bits = 8, rounding = \"floor\" } }")
        + &channel("face", "{ flat = { provoking = \"last\" } }")
}

// Clauses CH-22 and CH-23.
#[test]
fn channels_are_bounded_by_the_command_and_written_for_provers() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("c.toml"), with_channels()).unwrap();
    let ran = run_in(home.path(), "prove c.toml --claim channel.map --w-ratio 4").ends(0);
    // 4 x 4 pixels: 7 roundings. 7 x 2^-6 of u/w with 5 bits, 7 x 2^-7 of 1/w, from floor(63 / 4) = 15.
    for text in [
        "w ratio at most 4",
        "channel.map.interpolation: 5 bits, the profile has 10 -> enough  (CH-22)",
        "(7/64 x 2^6 + 7 x 7/128) / (15 - 7/128) =",
    ] {
        assert!(ran.out.contains(text), "{}", ran.out);
    }
    assert!(ran.out.lines().all(|line| line.len() <= 100), "{}", ran.out);
    let arguments = "prove c.toml --json --smt c.smt2 --gappa c.g";
    let report = json(&run_in(home.path(), arguments).ends(0));
    let rows = report["rows"].as_array().unwrap();
    let error = |claim: &str| {
        let row = rows.iter().find(|row| row["claim"] == claim).unwrap();
        row["error"].as_str().map(str::to_owned)
    };
    // The affine code: 7 x 2^-11 and the floor. Coordinates: 2 x 7 x 2^-8 and the floor.
    assert_eq!(error("channel.color.interpolation").as_deref(), Some("2055/2048"));
    assert_eq!(error("channel.glow.coordinate").as_deref(), Some("135/128"));
    assert_eq!(error("channel.face.interpolation").as_deref(), Some("0"));
    assert_eq!(error("depth.interpolation"), None);
    let read = |name| std::fs::read_to_string(home.path().join(name)).unwrap();
    let (smt, gappa) = (read("c.smt2"), read("c.g"));
    balanced(&smt, ';', ['(', ')']);
    balanced(&gappa, '#', ['(', ')']);
    balanced(&gappa, '#', ['{', '}']);
    for claim in ["color.interpolation", "map.interpolation", "map.guard", "cube.interpolation"] {
        assert!(smt.contains(&format!("(echo \"channel.{claim} with ")), "{claim}");
    }
    // Both planes are rounded, the quotient once more; only the unit has an error of its own.
    assert!(gappa.contains("fixed<-10, ne>") && gappa.contains("fixed<-6, ne>"));
    assert!(gappa.contains("fixed<0, ne>(w_") && gappa.contains("* (1 + r_"), "{gappa}");
}

fn json(ran: &Ran) -> serde_json::Value {
    serde_json::from_str(&ran.out).unwrap()
}

#[test]
fn the_command_answers_and_says_so_by_its_status() {
    let home = tempfile::tempdir().unwrap();
    let ran = run_in(home.path(), "prove").ends(0);
    assert!(ran.out.contains("edge.stored: 35 bits, the profile has 35 -> enough"), "{}", ran.out);
    assert!(ran.out.lines().all(|line| line.len() <= 100), "{}", ran.out);
    let ran = run_in(home.path(), "prove --guard-band 1 --claim edge.stored").ends(1);
    assert!(ran.out.contains("36 bits, the profile has 35 -> TOO FEW"), "{}", ran.out);
    run_in(home.path(), "prove sgi-4k-walk --claim walk.coverage").ends(1);
    let ran = run_in(home.path(), "prove --json").ends(0);
    let report = json(&ran);
    assert_eq!(report["claim"], "edge.stored");
    assert_eq!((&report["bits"], &report["sufficient"]), (&35.into(), &true.into()));
    assert_eq!(report["witness"]["bits"], 34);
    let rows = report["rows"].as_array().unwrap();
    assert!(rows.len() >= 7);
    for row in rows {
        for key in ["claim", "bits", "sufficient", "witness", "given", "bound", "clause"] {
            assert!(row.get(key).is_some(), "{key}: {row}");
        }
    }
    let ran = run_in(home.path(), "prove --json --claim depth.guard").ends(0);
    assert_eq!((&json(&ran)["claim"], &json(&ran)["bits"]), (&"depth.guard".into(), &1.into()));
    let ran = run_in(home.path(), "prove --table --json").ends(0);
    let rows = json(&ran)["rows"].as_array().unwrap().clone();
    assert_eq!(
        (rows.len(), &rows[0]["row"], &rows[0]["bits"]),
        (20, &"4096-s10".into(), &35.into())
    );
    let arguments = "prove --window 2048x2048 --guard-band 0 --sub-pixel 8 --claim edge --json";
    assert_eq!(json(&run_in(home.path(), arguments).ends(0))["bits"], 31);
    let arguments = "prove --depth-bits 16 --claim depth --json";
    assert_eq!(json(&run_in(home.path(), arguments).ends(0))["rows"][0]["bits"], 13);
}

#[test]
fn questions_that_cannot_be_are_refused_with_the_nearest_that_can() {
    let home = tempfile::tempdir().unwrap();
    for (arguments, about) in [
        ("--window 0x4", &["0 x 4: a window has 1 to 65536"][..]),
        ("--window 70000x4", &["1 to 65536"]),
        (
            "--guard-band 4000000000",
            &["guard-band = 4000000000", "> 32 bits", "largest possible value is 2093056"],
        ),
        ("--guard-band 2093057", &["guard-band = 2093057", "2093056"]),
        (
            "--sub-pixel 40",
            &["sub-pixel = 40", "12 + 40 = 52 > 32", "largest possible value is 20"],
        ),
        (
            "--sub-pixel 0",
            &["sub-pixel = 0: a vertex grid without sub-pixels has no pixel centres"],
        ),
        ("--depth-bits 65", &["depth-bits = 65", "nearest possible value is 61"]),
        ("--depth-bits 0", &["depth-bits = 0", "nearest possible value is 1"]),
        ("--claim nothing", &["--claim \"nothing\"", "edge.stored"]),
        ("--table --claim depth", &["--claim \"depth\""]),
        ("--table --window 4x4", &["cannot be used with"]),
        ("--w-ratio 0", &["0"]),
        ("--table --w-ratio 2", &["cannot be used with"]),
        ("--limit 0", &["0"]),
        ("no-such-profile", &["no-such-profile"]),
        ("--smt a --gappa a", &["name the same file"]),
        ("--claim depth.guard --gappa a", &["Gappa cannot check any of the selected claims"]),
    ] {
        run_in(home.path(), &format!("prove {arguments}")).complains(2, about);
    }
    // The widest that can be asked can be answered.
    run_in(home.path(), "prove --guard-band 2093056 --claim edge").ends(1);
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0, "nothing was written");
    run_in(home.path(), "prove --smt none/a.smt2").complains(3, &["none/a.smt2"]);
    run_in(home.path(), "prove --gappa .").complains(3, &["."]);
}

#[test]
fn files_are_the_library_s_text() {
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), "prove tiny --smt a.smt2 --gappa b.g").ends(0);
    let proofs = ask("tiny", PLAIN);
    let read = |name| std::fs::read_to_string(home.path().join(name)).unwrap();
    assert_eq!(read("a.smt2"), prove::smt(&proofs));
    assert_eq!(Some(read("b.g")), prove::gappa(&proofs));
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 2);
}

/// A search path with these programs only.
#[cfg(unix)]
fn with_provers(programs: &[(&str, &str)]) -> tempfile::TempDir {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    for (name, script) in programs {
        let path = folder.path().join(name);
        std::fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    folder
}

#[cfg(unix)]
fn check_with(programs: &[(&str, &str)], arguments: &str) -> Ran {
    let path = with_provers(programs);
    let mut command = guardbit();
    let words = arguments.split_whitespace();
    command.env("PATH", path.path()).args(["prove", "tiny", "--check"]).args(words);
    command.output().unwrap().into()
}

#[cfg(unix)]
#[test]
fn provers_agree_disagree_are_missing_or_are_stopped() {
    let one = "--claim edge.stored";
    // The solver is asked three questions: two ways out of the word, and the witness.
    let honest = ("z3", "read a; echo unsat; echo unsat; echo sat");
    let ran = check_with(&[honest, ("gappa", "read a; exit 0")], one).ends(0);
    assert_eq!(
        ran.out.lines().filter(|line| line.ends_with("s  agrees")).count(),
        2,
        "{}",
        ran.out
    );
    assert_eq!(ran.err, "");
    let ran = check_with(&[("z3", "read a; echo unsat; echo sat; echo sat")], one).ends(1);
    assert!(ran.out.contains("DISAGREES: unsat sat sat"), "{}", ran.out);
    assert!(ran.err.contains("note: gappa is not on the search path"), "{}", ran.err);
    let ran = check_with(&[honest, ("gappa", "read a; echo cannot >&2; exit 1")], one).ends(1);
    assert!(ran.out.contains("DISAGREES: cannot"), "{}", ran.out);
    let ran = check_with(&[], one).ends(0);
    assert_eq!(ran.err.lines().filter(|line| line.starts_with("note: ")).count(), 2, "{}", ran.err);
    let begun = std::time::Instant::now();
    let slow = ("z3", "exec 0<&- ; while :; do :; done");
    let ran = check_with(&[slow], &format!("{one} --limit 1")).ends(1);
    assert!(ran.out.contains("STOPPED at the time limit"), "{}", ran.out);
    assert!(begun.elapsed() < std::time::Duration::from_secs(20));
    let ran = check_with(&[honest], &format!("{one} --json")).ends(0);
    let checks = json(&ran)["checks"].clone();
    assert_eq!((&checks[0]["solver"], &checks[0]["answer"]), (&"z3".into(), &"agrees".into()));
}

/// Clauses B-5, B-7 and B-8: depth that is no plane has the bound of its machine, and no slope. The numbers are those of
/// 2 x 255 x 7 x 2^-(C+1) + 2^-F for 4 x 4 pixels and 8 bits of depth.
#[test]
fn depth_without_a_plane_has_the_bound_of_its_machine() {
    let home = tempfile::tempdir().unwrap();
    let mut profile = load("tiny").unwrap().with_machine("barycentric").unwrap();
    let Form::Barycentric(machine) = &mut profile.form else { unreachable!("as asked") };
    machine.coordinate = 12;
    profile.depth.as_mut().unwrap().integer = 8;
    std::fs::write(home.path().join("b.toml"), profile.to_toml()).unwrap();
    let report = json(&run_in(home.path(), "prove b.toml --claim depth --json"));
    let rows = report["rows"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|row| row["claim"].as_str().unwrap()).collect();
    assert_eq!(names, ["depth.interpolation", "depth.guard"]);
    // 3570 / 8192 = 1785 / 4096 leaves 263 / 4096 below one half: 2^-4 is 256 / 4096.
    assert_eq!((&rows[0]["bits"], &rows[0]["clause"]), (&4.into(), &"B-5".into()));
    assert_eq!(rows[0]["bound"], "2041/4096 < 1/2");
    assert!(rows[0]["witness"].is_null() && rows[1]["witness"].is_null());
    // With 11 bits of a coordinate the half is gone.
    let Form::Barycentric(machine) = &mut profile.form else { unreachable!("as asked") };
    machine.coordinate = 11;
    std::fs::write(home.path().join("b.toml"), profile.to_toml()).unwrap();
    let ran = run_in(home.path(), "prove b.toml --claim depth.interpolation").ends(1);
    let words = |ran: &Ran| ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
    for text in ["NOT PROVED", "other words (clause A-6): give these more bits."] {
        assert!(words(&ran).contains(text), "{}", ran.out);
    }
    // Slopes of slivers make more of the error of a walked x than any depth has.
    let walked = load("tiny").unwrap().with_machine("gouraud").unwrap();
    std::fs::write(home.path().join("g.toml"), walked.to_toml()).unwrap();
    let ran = run_in(home.path(), "prove g.toml --claim depth.interpolation").ends(1);
    for text in ["as the machine gouraud carries it", "which this machine does not promise"] {
        assert!(words(&ran).contains(text), "{}", ran.out);
    }
    run_in(home.path(), "prove g.toml --claim depth.slope").complains(2, &["depth.slope"]);
}
