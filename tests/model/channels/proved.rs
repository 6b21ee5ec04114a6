//! What `prove` says of channels, against what the model draws.

use super::{NEAREST, case, corrections, draw, normalised, toy, unit, with};
use guardbit::bits::Rounding;
use guardbit::cover::{ConservativeConfig, ConservativeDepth, ConservativeMode, Degenerate};
use guardbit::exact::{Rational, ratio};
use guardbit::explore::prove::{Overrides, Proof, Question, prove};
use guardbit::format::Clamp;
use guardbit::machine::Input;
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Profile, triangle_machines};
use guardbit::setup::{Division, Triangle};
use guardbit::value::{Correction, EvaluatedAt, Provoking, ReciprocalConfig, Refine, StartBias};

fn ask(profile: &Profile, w_ratio: u32) -> Vec<Proof> {
    let overrides = Overrides { w_ratio: Some(w_ratio), ..Overrides::default() };
    prove(&Question::new(profile, overrides).unwrap())
}

#[track_caller]
fn claim<'a>(proofs: &'a [Proof], name: &str) -> &'a Proof {
    proofs.iter().find(|proof| proof.claim == name).unwrap()
}

/// The proved bound of the first channel's codes.
fn bound(proofs: &[Proof]) -> Option<[i128; 2]> {
    let first = proofs.iter().find(|proof| proof.claim.starts_with("channel.")).unwrap();
    let bound: Rational = first.error.as_ref()?.parse().unwrap();
    Some([bound.numer(), bound.denom()].map(|part| part.try_into().unwrap()))
}

/// The edge functions opposite the vertices at a point, by differences.
fn weights(xy: [[i128; 2]; 3], at: [i128; 2]) -> [i128; 3] {
    let e = |from: [i128; 2], to: [i128; 2]| {
        (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
    };
    [e(xy[1], xy[2]), e(xy[2], xy[0]), e(xy[0], xy[1])]
}

/// The largest error so far, as a fraction.
struct Worst([i128; 2]);

impl Worst {
    /// Takes |code - above / below|.
    fn note(&mut self, code: i128, [above, below]: [i128; 2]) {
        let off = (code * below - above).abs();
        if off * self.0[1] > self.0[0] * below.abs() {
            self.0 = [off, below.abs()];
        }
    }

    /// Whether it is at most this fraction.
    fn within(&self, [above, below]: [i128; 2]) -> bool {
        self.0[0] * below <= above * self.0[1]
    }
}

/// Clauses CH-13 and CH-22: on every machine, no code inside the exact triangle is off by more than the proved bound.
#[test]
fn no_code_is_beyond_the_proved_bound() {
    for correction in corrections() {
        let base = with(correction.clone(), true);
        for kind in triangle_machines() {
            let profile = base.with_machine(kind.name).unwrap();
            // The claims on depth take longer, and are not looked at.
            let asked = Profile { depth: None, ..profile.clone() };
            let Some(bound) = bound(&ask(&asked, 31)) else {
                assert!(matches!(correction, Correction::ConstantW { .. }), "{}", kind.name);
                continue;
            };
            let model = Model::new(&profile).unwrap();
            let grid = profile.grid().unwrap();
            let mut worst = Worst([0, 1]);
            for index in 0..24 {
                let case = case(2000 + index, true);
                let (triangle, codes, q) = normalised(&case);
                if triangle.area2() == 0 {
                    continue;
                }
                let drawing = draw(&model, &case);
                let mut values = drawing.channels.first().into_iter().flatten();
                for span in &drawing.spans {
                    for x in span.x0..span.x1 {
                        let e = weights(triangle.xy, grid.position(x.into(), span.y.into()));
                        for (n, u) in codes.iter().enumerate() {
                            let code = i128::from(*values.next().unwrap());
                            let want = match &correction {
                                Correction::Flat { provoking: Provoking::First } => {
                                    [case.codes[n][0], 1]
                                }
                                Correction::Flat { provoking: Provoking::Last } => {
                                    [case.codes[n][2], 1]
                                }
                                Correction::Affine => [weighed(e, *u), e.iter().sum()],
                                _ => [weighed(e, [0, 1, 2].map(|k| u[k] * q[k])), weighed(e, q)],
                            };
                            // A walked edge can let in a sample from beyond it.
                            if e.iter().all(|e| *e >= 0) {
                                worst.note(code, want);
                            }
                        }
                    }
                }
            }
            let what = format!("{} {correction:?}: {:?} of {bound:?}", kind.name, worst.0);
            assert!(worst.within(bound), "{what}");
            assert!(worst.0[0] > 0 || bound[0] == 0, "{what}");
        }
    }
}

fn weighed(e: [i128; 3], values: [i128; 3]) -> i128 {
    e[0] * values[0] + e[1] * values[1] + e[2] * values[2]
}

/// 2 x 2 pixels with one sub-pixel bit, codes and codes of 1/w of two bits, 32 components.
fn tiny(correction: &Correction) -> Profile {
    let mut profile = toy();
    (profile.window.width, profile.window.height) = (2, 2);
    (profile.vertex.integer, profile.vertex.sub_pixel) = (1, 1);
    profile.depth = None;
    let w = profile.w.as_mut().unwrap();
    (w.integer, w.interpolation) = (2, 4);
    let channel = &mut profile.channel[0];
    (channel.integer, channel.interpolation) = (2, 4);
    channel.components = ["a", "b", "c", "d"].map(str::to_owned).to_vec();
    channel.correction = correction.clone();
    let channel = channel.clone();
    profile.channel = (0..8)
        .map(|n| guardbit::value::AttributeConfig { name: format!("c{n}"), ..channel.clone() })
        .collect();
    profile.validate().unwrap();
    profile
}

/// The largest error over every triangle, code and code of 1/w of the tiny profile.
fn exhaustively(profile: &Profile) -> Worst {
    let model = Model::new(profile).unwrap();
    let points: Vec<[i128; 2]> = (0..25).map(|n| [n % 5, n / 5]).collect();
    let samples = [[1, 1], [3, 1], [1, 3], [3, 3]];
    let mut worst = Worst([0, 1]);
    let mut drawing = Drawing::default();
    for (n, a) in points.iter().enumerate() {
        for (m, b) in points.iter().enumerate().skip(n + 1) {
            for c in &points[m + 1..] {
                let triangle = Triangle { xy: [*a, *b, *c], z: None }.normalised();
                let inside = |at: &[i128; 2]| weights(triangle.xy, *at).iter().all(|e| *e > 0);
                // What lies on an edge alone is left out.
                if triangle.area2() == 0 || !samples.iter().any(inside) {
                    continue;
                }
                let placed = model.place(triangle).unwrap();
                for q in (0..27).map(|n| [n % 3 + 1, n / 3 % 3 + 1, n / 9 + 1]) {
                    for half in 0..2 {
                        let codes = |n: i128| [n % 4, n / 4 % 4, n / 16];
                        let list: Vec<_> = (0..8)
                            .map(|n| {
                                (
                                    format!("c{n}"),
                                    (0..4).map(|k| codes(32 * half + 4 * n + k)).collect(),
                                )
                            })
                            .collect();
                        let values = model.values(&list, Some(q)).unwrap();
                        drawing.clear();
                        model.draw(Input::Shaded(&placed, &values), &mut drawing).unwrap();
                        let pixels =
                            drawing.spans.iter().flat_map(|s| (s.x0..s.x1).map(|x| [x, s.y]));
                        for (place, pixel) in pixels.enumerate() {
                            let e = weights(triangle.xy, pixel.map(|at| 2 * i128::from(at) + 1));
                            let below = weighed(e, q);
                            for (n, of_channel) in (0..).zip(&drawing.channels) {
                                for (k, code) in (0..).zip(&of_channel[4 * place..][..4]) {
                                    let u = codes(32 * half + 4 * n + k);
                                    let above = weighed(e, [0, 1, 2].map(|k| u[k] * q[k]));
                                    worst.note((*code).into(), [above, below]);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    worst
}

/// Clause CH-22: on a tiny profile no triangle, no code and no code of 1/w is off by more than the bound, and some is
/// off by more than half of it.
#[test]
fn the_bound_holds_exhaustively_on_a_tiny_profile() {
    let refine = Refine::Newton { bits: vec![8] };
    let unit = ReciprocalConfig { operand: 5, index: 2, entry: 5, refine, table: None };
    for correction in [
        Correction::Quotient { rounding: NEAREST },
        Correction::Reciprocal { unit, rounding: Rounding::Floor },
    ] {
        let profile = tiny(&correction);
        let bound = bound(&ask(&profile, 3)).unwrap();
        let worst = exhaustively(&profile);
        eprintln!("{:?} of {bound:?}", worst.0);
        assert!(worst.within(bound), "{correction:?}: {:?} > {bound:?}", worst.0);
        assert!(
            !worst.within([bound[0], 2 * bound[1]]),
            "{correction:?}: {:?} of {bound:?}",
            worst.0
        );
    }
}

/// Clause CH-22: the numbers of a quotient, by hand. The longest walk is 14 steps, so each plane is off by 15 2^-10 at
/// most; codes are at most 15, codes of 1/w from floor(31 / 16) = 1 to 31.
#[test]
fn a_quotient_has_the_bits_that_its_inequality_asks_for() {
    let profile = toy();
    let proofs = ask(&profile, 16);
    let map = claim(&proofs, "channel.c.interpolation");
    // (15/1024 x 32 + 15 x 15/1024) / (1 - 15/1024) = 705/1009, and half an ULP of the last rounding.
    assert_eq!(map.error.as_deref(), Some("2419/2018"));
    // 15 2^(4-F) 1024 + 225 < 1009/2 needs 2^(F-4) > 54.9.
    assert_eq!((map.bits, map.given, map.sufficient), (Some(10), Some(9), false));
    assert!(map.statement.contains("at most 2419/2018 = 1.198712 ULP"), "{}", map.statement);
    assert!(map.statement.contains("at most 16 times its smallest"), "{}", map.statement);
    // With F = 9: 240/512 + 15 e < (1 - e) / 2 needs e < 1/496: 2^(Fw+1) > 15 x 496.
    let w = claim(&proofs, "w.interpolation");
    assert_eq!((w.bits, w.given, w.sufficient), (Some(12), Some(9), false));
    // Values to 15 31/32, and 7 units at most: below 0, so one guard bit; 1/w is from 1 to 31, so none.
    let guard = |name| claim(&proofs, name).bits;
    assert_eq!([guard("channel.c.guard"), guard("w.guard")], [Some(1), Some(0)]);
    // Half the ratio: the smallest code of 1/w is 3.
    let nearer = ask(&profile, 8);
    assert_eq!(bound(&nearer), Some(reduced([705 * 2 + 3057, 2 * 3057])));
}

fn reduced([above, below]: [i128; 2]) -> [i128; 2] {
    let reduced = ratio(above, below).unwrap();
    [reduced.numer(), reduced.denom()].map(|part| part.try_into().unwrap())
}

/// Clause CH-22: where 1/w can come within its error of 0 there is no bound, and the claim says how many bits help.
#[test]
fn a_quotient_without_a_bound_says_what_to_do() {
    let mut profile = toy();
    profile.w.as_mut().unwrap().interpolation = 2;
    let proofs = ask(&profile, 16);
    let map = claim(&proofs, "channel.c.interpolation");
    assert_eq!((map.bits, map.sufficient, map.error.as_ref()), (None, false, None));
    // 15 2^-3 is above 1. 15 e / (1 - e) < 1/2 needs e < 1/31: 8 bits; then 15 2^(4-F) 512 < 23.5: 13 bits.
    for text in [
        "its smallest code is 1 <= 15/8 = 1.875000 = its error",
        "give [w] interpolation = 8 bits and the channel 13",
    ] {
        assert!(map.statement.contains(text), "{}", map.statement);
    }
    // What it says is so.
    profile.w.as_mut().unwrap().interpolation = 8;
    assert_eq!(claim(&ask(&profile, 16), "channel.c.interpolation").bits, Some(13));
    // A unit that is off by 1/9 of itself moves a code of 15 by more than one.
    let coarse =
        ReciprocalConfig { operand: 10, index: 2, entry: 7, refine: Refine::None, table: None };
    let profile = with(Correction::Reciprocal { unit: coarse, rounding: NEAREST }, false);
    let map = claim(&ask(&profile, 1), "channel.c.interpolation").clone();
    assert_eq!(map.bits, None);
    assert!(map.statement.contains("its relative error must be below 1/30"), "{}", map.statement);
    // More operands than can be tried.
    let wide = ReciprocalConfig { operand: 25, ..unit() };
    let profile = with(Correction::Reciprocal { unit: wide, rounding: NEAREST }, false);
    let map = claim(&ask(&profile, 1), "channel.c.interpolation").clone();
    assert!(map.statement.contains("operand = 25 > 24"), "{}", map.statement);
    // Places outside the triangle, and the 1/w of another sample.
    for change in [
        |profile: &mut Profile| profile.channel[0].at = EvaluatedAt::Corner,
        |profile: &mut Profile| {
            profile.channel[0].correction = Correction::ConstantW { rounding: NEAREST }
        },
    ] {
        let mut profile = toy();
        change(&mut profile);
        let map = claim(&ask(&profile, 1), "channel.c.interpolation").clone();
        assert_eq!((map.bits, map.sufficient, map.error), (None, false, None));
    }
}

/// Clauses B-5, B-6, B-7 and CH-22: an affine channel has the claims of depth of the same words; its code has the
/// floor of the read-out besides.
#[test]
fn an_affine_channel_is_bounded_as_depth() {
    let affine = |change: &dyn Fn(&mut Profile)| {
        let mut profile = with(Correction::Affine, false);
        let depth = profile.depth.as_mut().unwrap();
        (depth.integer, depth.interpolation) = (4, 9);
        change(&mut profile);
        profile.validate().unwrap();
        let proofs = ask(&profile, 16);
        for fact in ["interpolation", "guard"] {
            let [depth, channel] =
                ["depth", "channel.c"].map(|of| claim(&proofs, &format!("{of}.{fact}")).clone());
            assert_eq!((depth.bits, &depth.bound), (channel.bits, &channel.bound));
            let [depth, channel] = [depth, channel].map(|proof| proof.witness);
            assert_eq!(depth.and_then(|w| w.depths), channel.and_then(|w| w.codes));
        }
        bound(&proofs)
    };
    // 15 2^-10 and the floor.
    assert_eq!(affine(&|_| {}), Some([1039, 1024]));
    assert_eq!(
        affine(&|profile| {
            profile.channel[0].start_bias = StartBias::Half;
            profile.depth.as_mut().unwrap().start_bias = StartBias::Half;
        }),
        Some([527, 1024])
    );
    assert_eq!(
        affine(&|profile| {
            profile.channel[0].rounding = Rounding::Floor;
            profile.depth.as_mut().unwrap().rounding = Rounding::Floor;
        }),
        Some([527, 512])
    );
    // 15 2^-10 + 15 2^-8 of the shared reciprocal.
    let shared = Division::Reciprocal { bits: 8 };
    assert_eq!(
        affine(&|profile| {
            profile.channel[0].division = shared;
            profile.depth.as_mut().unwrap().division = shared;
        }),
        Some([1024 + 15 + 60, 1024])
    );
    // An accumulator that wraps below 0 has no bound.
    assert_eq!(
        affine(&|profile| {
            profile.channel[0].clamp = Clamp::Wrap;
            profile.depth.as_mut().unwrap().clamp = Clamp::Wrap;
        }),
        None
    );
}

/// Clauses CR-8 and CH-22: pixels that a triangle only touches have channels outside of it, so nothing is claimed; a
/// square that lies in the triangle is inside.
#[test]
fn nothing_is_claimed_of_channels_outside_their_triangle() {
    let asked = |mode: ConservativeMode, correction: &Correction| {
        let mut profile = with(correction.clone(), false);
        let (degenerate, depth) = (Degenerate::Cull, ConservativeDepth::Centre);
        let config = ConservativeConfig { mode, grow: 0, degenerate, depth };
        profile.form.edge_mut().unwrap().conservative = Some(config);
        profile.depth = None;
        let proofs = ask(&profile, 2);
        proofs.into_iter().filter(|proof| proof.claim.starts_with("channel.c.")).collect::<Vec<_>>()
    };
    for correction in corrections() {
        let flat = matches!(correction, Correction::Flat { .. });
        let outer = asked(ConservativeMode::Outer, &correction);
        assert!(!outer.is_empty());
        for proof in outer {
            assert_eq!(proof.sufficient, flat, "{correction:?}: {}", proof.statement);
            assert!(flat || proof.bits.is_none(), "{}", proof.statement);
        }
        let inner = asked(ConservativeMode::Inner, &correction);
        if !matches!(correction, Correction::ConstantW { .. }) {
            assert!(inner.iter().any(|proof| proof.bits.is_some()), "{correction:?}");
        }
    }
}
