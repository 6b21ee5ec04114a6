//! What `prove` says of the depth of a machine, against the depth that the model draws.

use crate::toy::TOY;
use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::exact::{Rational, integer, ratio};
use guardbit::explore::prove::{Overrides, Proof, Question, prove};
use guardbit::machine::{EveryLinear, Input, Sink};
use guardbit::model::Model;
use guardbit::profile::{Form, Profile, parse, triangle_machines};
use guardbit::setup::Triangle;

/// 8 x 8 pixels with four sub-pixel bits, depth of 4 bits. With a sign the vertices reach 32 pixels beyond the window's
/// left and top, and 24 beyond its right and bottom.
fn toy(machine: &str, signed: bool) -> Profile {
    let text = TOY.to_owned()
        + r#"[depth]
guard = 4
integer = 4
interpolation = 6
rounding = "nearest-even"
division = "quotient"
clamp = "guard"
"#;
    let mut profile = parse(&text, "toy.toml").unwrap();
    if signed {
        (profile.vertex.integer, profile.vertex.signed) = (6, true);
    }
    let mut profile = profile.with_machine(machine).unwrap();
    if let Form::Gouraud(walk) = &mut profile.form {
        // Room for an x that is walked from the lowest one and rounded down.
        walk.0.guard = 2;
    }
    profile
}

/// The same with so many fraction bits of what a machine makes depth of beside the accumulator.
fn with_own_fraction(profile: &Profile, fraction: u32) -> Profile {
    let mut profile = profile.clone();
    match &mut profile.form {
        Form::Gouraud(walk) => walk.0.fraction = fraction,
        Form::Barycentric(machine) => machine.coordinate = fraction,
        _ => {}
    }
    profile
}

/// The accumulators that were read, in units of their last place.
#[derive(Default)]
struct Held(Vec<([u32; 2], i128)>);

impl Sink for Held {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn wants_held(&self) -> bool {
        true
    }

    fn held(&mut self, y: u32, x0: u32, values: &[i128]) {
        self.0.extend((x0..).zip(values).map(|(x, value)| ([x, y], *value)));
    }
}

/// Triangles of any size, and slivers, which are steep.
fn triangle(index: u64, profile: &Profile) -> Triangle {
    let (low, high) = profile.vertex.range();
    let [low, high] = [low, high].map(|end| i64::try_from(end).unwrap());
    let mut words = Words::new(19, 1, index);
    let mut point = || [0, 1].map(|_| words.between(low, high));
    let mut xy = [point(), point(), point()];
    if index.is_multiple_of(2) {
        let near = |at: i128, by: i128| (at + by).clamp(low.into(), high.into());
        xy[2] = [near(xy[1][0], words.between(-3, 3)), near(xy[1][1], words.between(-3, 3))];
    }
    Triangle { xy, z: Some([0; 3].map(|_: i128| words.between(0, 15))) }.normalised()
}

/// Tall triangles that begin 32 rows above the window, with two edges down through it.
fn tall(index: u64, _: &Profile) -> Triangle {
    let mut words = Words::new(19, 2, index);
    let [x, low, high] = [words.between(0, 128), words.between(-384, 0), words.between(128, 512)];
    let z = [0; 3].map(|_: i128| words.between(0, 15));
    Triangle { xy: [[x, -512], [low, 512], [high, 512]], z: Some(z) }.normalised()
}

/// A fraction.
type Fraction = [i128; 2];

fn less(a: Fraction, b: Fraction) -> bool {
    a[0] * b[1] < b[0] * a[1]
}

/// The largest distance of the accumulator from the exact plane at a sample inside the exact triangle, in ULP, over
/// `count` triangles, and the triangle that has it. The plane is that of the vertices weighed by edge functions.
fn worst(
    profile: &Profile,
    count: u64,
    triangle: fn(u64, &Profile) -> Triangle,
) -> (Fraction, Option<Triangle>) {
    let model = Model::new(profile).unwrap();
    let (grid, fraction) = (profile.grid().unwrap(), profile.depth.unwrap().interpolation);
    let mut worst = ([0, 1], None);
    for index in 0..count {
        let triangle = triangle(index, profile);
        if triangle.area2() == 0 {
            continue;
        }
        let mut held = Held::default();
        let placed = model.place(triangle).unwrap();
        model.draw(Input::Triangle(&placed), &mut held).unwrap();
        for ([x, y], value) in held.0 {
            let at = grid.position(x.into(), y.into());
            let e = |from: [i128; 2], to: [i128; 2]| {
                (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
            };
            let ([a, b, c], z) = (triangle.xy, triangle.z.unwrap());
            let weights = [e(b, c), e(c, a), e(a, b)];
            if weights.iter().any(|e| *e < 0) {
                continue;
            }
            let sum = weights.iter().sum::<i128>();
            let exact = (0..3).map(|k| weights[k] * z[k]).sum::<i128>() << fraction;
            let off = [(value * sum - exact).abs(), sum << fraction];
            if less(worst.0, off) {
                worst = (off, Some(triangle));
            }
        }
    }
    worst
}

fn claim(profile: &Profile, name: &str) -> Proof {
    let proofs = prove(&Question::new(profile, Overrides::default()).unwrap());
    proofs.into_iter().find(|proof| proof.claim == name).unwrap()
}

/// Clauses A-3, A-6, B-5 and B-7: on every machine, with the bits that are said to be enough, no depth inside the exact
/// triangle is off by half an ULP.
#[test]
fn no_depth_is_beyond_what_is_claimed() {
    let mut proved = Vec::new();
    for kind in triangle_machines() {
        let planes = !["gouraud", "barycentric"].contains(&kind.name);
        for (signed, own, rounding) in [
            (true, 24, Rounding::NearestEven),
            (false, 4, Rounding::NearestEven),
            (false, 24, Rounding::Floor),
        ] {
            let mut profile = with_own_fraction(&toy(kind.name, signed), own);
            profile.depth.as_mut().unwrap().rounding = rounding;
            let Some(bits) = claim(&profile, "depth.interpolation").bits else {
                // 4 bits of x or of a coordinate alone are off by more.
                assert!(!planes && own == 4, "{}", kind.name);
                continue;
            };
            profile.depth.as_mut().unwrap().interpolation = bits;
            profile.depth.as_mut().unwrap().guard = claim(&profile, "depth.guard").bits.unwrap();
            let (off, triangle) = worst(&profile, 200, triangle);
            assert!(less(off, [1, 2]), "{} {bits} {own}: {off:?} in {triangle:?}", kind.name);
            proved.push(kind.name);
            if planes {
                // The search for a counterexample takes its time, and is that of one plane.
                break;
            }
        }
    }
    proved.dedup();
    assert_eq!(proved.len(), triangle_machines().count(), "{proved:?}");
}

/// The bound that a machine states for every triangle of the toy.
fn stated(profile: &Profile) -> Option<Rational> {
    let (low, high) = profile.vertex.range();
    let depth = profile.depth.unwrap();
    profile.form.window_bound(&EveryLinear {
        window: [8, 8],
        vertices: [[low; 2], [high; 2]],
        sub_pixel: 4,
        rise: integer(15),
        // Twice the area is one sub-pixel squared at least.
        steepest: integer(15 * (high - low) * 16),
        rounding: depth.rounding,
        fraction: depth.interpolation,
    })
}

/// Clauses A-3, A-6 and B-5: on every machine no depth inside the exact triangle is off by more than the stated bound, also
/// where a triangle begins outside the window, and where a machine's own words are coarse.
#[test]
fn no_depth_is_beyond_the_bound_over_a_window() {
    for kind in triangle_machines() {
        for (signed, own) in [(false, 1), (false, 40), (true, 6), (true, 40)] {
            let profile = with_own_fraction(&toy(kind.name, signed), own);
            let Some(bound) = stated(&profile) else {
                // 15 roundings of half a unit of 2^-1 fill the word of a coordinate, of 2^-6 they do not.
                assert_eq!((kind.name, own), ("barycentric", 1));
                continue;
            };
            let (off, triangle) = worst(&profile, 200, triangle);
            assert!(within(off, &bound), "{} {own}: {off:?} > {bound} in {triangle:?}", kind.name);
        }
    }
}

fn within(off: Fraction, bound: &Rational) -> bool {
    ratio(off[0], off[1]).unwrap() <= *bound
}

/// Clause A-3: a walk that begins above the window gathers the roundings of the rows there: more than 8 + 2 rows and 8 + 2
/// columns of the window have, half a unit of 2^-6 each.
#[test]
fn rows_above_the_window_count() {
    let profile = with_own_fraction(&toy("gouraud", true), 40);
    let (off, triangle) = worst(&profile, 1000, tall);
    assert!(less([20, 128], off), "{off:?}");
    assert!(within(off, &stated(&profile).unwrap()), "{off:?} in {triangle:?}");
}

/// Clauses A-3 and A-6: there is no bound where a walked x or a coordinate can leave its word.
#[test]
fn words_that_can_wrap_have_no_bound() {
    let mut profile = toy("gouraud", true);
    assert!(stated(&profile).is_some());
    let Form::Gouraud(walk) = &mut profile.form else { unreachable!("a gouraud machine") };
    // Vertices reach from -32 to 32 pixels; the word holds -4 to 12.
    (walk.0.guard, walk.0.integer) = (1, 3);
    assert_eq!(stated(&profile), None);
    // 15 roundings of half a unit: 15/16 of a coordinate, and 15/8.
    let bound = |bits| stated(&with_own_fraction(&toy("barycentric", false), bits));
    // 2 x 15 x 15/16, and the floor to 6 bits.
    assert_eq!(bound(3), ratio(2 * 15 * 15 * 4 + 1, 64));
    assert_eq!(bound(2), None);
}
