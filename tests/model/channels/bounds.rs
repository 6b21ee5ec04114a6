//! Every code is within the stated bound of the exact value.

use super::{Case, NEAREST, case, corrections, draw, normalised, plane, with};
use guardbit::exact::{PlaneNumerator, Rational, integer, ratio};
use guardbit::format::Clamp;
use guardbit::machine::Face;
use guardbit::model::Model;
use guardbit::profile::{Profile, WindowConfig, triangle_machines};
use guardbit::setup::{Division, Triangle};
use guardbit::value::{Correction, DepthConfig, StartBias};

/// The bound that a machine states for depth of these words.
fn stated(profile: &Profile, triangle: &Triangle, values: [i128; 3], bits: [u32; 2]) -> Rational {
    let mut profile = profile.clone();
    let [integer, interpolation] = bits;
    profile.depth = Some(DepthConfig {
        guard: 1,
        integer,
        interpolation,
        rounding: NEAREST,
        division: Division::Quotient,
        clamp: Clamp::Guard,
        start_bias: StartBias::None,
        format: None,
        bias: None,
    });
    let model = Model::new(&Profile { channel: Vec::new(), w: None, ..profile.clone() }).unwrap();
    let exact = PlaneNumerator::new(triangle.xy, values).unwrap();
    let target =
        guardbit::machine::Target { grid: profile.grid().unwrap(), clip: model.clip(), reach: 0 };
    // A machine may look at the values of the vertices.
    let triangle = &Triangle { z: Some(values), ..*triangle };
    let face = Face { triangle, grid: &target.grid, bounds: target.bounds(triangle) };
    profile.form.depth_bound(&profile.state(), &face, &exact).unwrap()
}

fn apart(a: &Rational, b: &Rational) -> Rational {
    if a > b { a - b } else { b - a }
}

/// Corrections that are compared with the exact value.
fn bounded() -> impl Iterator<Item = Correction> {
    corrections().into_iter().filter(|correction| {
        let walks = correction.walks_w() && !matches!(correction, Correction::ConstantW { .. });
        walks || matches!(correction, Correction::Affine | Correction::Barycentric { .. })
    })
}

/// Compares each code of a case with the exact value; counts those with a bound and those without.
fn check(model: &Model, case: &Case, name: &str, [checked, skipped]: &mut [u32; 2]) {
    let (profile, (triangle, codes, q)) = (model.profile(), normalised(case));
    if triangle.area2() == 0 {
        return;
    }
    let correction = &profile.channel[0].correction;
    let drawing = draw(model, case);
    let mut values = drawing.channels.first().into_iter().flatten();
    let grid = profile.grid().unwrap();
    let rises = codes.map(|u| stated(profile, &triangle, u, [4, 9]));
    let over = |u: [i128; 3]| [0, 1, 2].map(|n| u[n] * q[n]);
    // u q counts 2^-5 of u q / 2^5: 9 bits below the point are 4 below that.
    let rises_over = codes.map(|u| stated(profile, &triangle, over(u), [9, 4]));
    let rises_w = stated(profile, &triangle, q, [5, 9]);
    for span in &drawing.spans {
        for x in span.x0..span.x1 {
            let at = grid.position(x.into(), span.y.into());
            for (n, u) in codes.into_iter().enumerate() {
                let got = integer((*values.next().unwrap()).into());
                let one = integer(1);
                let exact = |v: [i128; 3]| plane(triangle.xy, v.map(integer), at);
                let (p, w) = (exact(over(u)), exact(q));
                let want = if correction.needs_w() { &p / &w } else { exact(u) };
                let bound = match correction {
                    Correction::Affine => Some(&rises[n] + &one),
                    Correction::Barycentric { .. } => {
                        let rise = (u[1] - u[0]).abs() + (u[2] - u[0]).abs();
                        Some(ratio(rise, 2 << 10).unwrap() + &one)
                    }
                    _ => perspective((&rises_over[n], &p), (&rises_w, &w), correction),
                };
                match bound {
                    Some(bound) => {
                        let error = apart(&got, &want);
                        assert!(
                            error <= bound,
                            "{} {correction:?} {name} at {at:?}: {got} for {want}, {error} > {bound}",
                            profile.form.name()
                        );
                        *checked += 1;
                    }
                    None => *skipped += 1,
                }
            }
        }
    }
}

/// Clauses CH-13 and CH-14: on every machine every code is within the stated bound of the exact value.
#[test]
fn errors_stay_within_the_stated_bounds() {
    for correction in bounded() {
        let base = with(correction.clone(), true);
        for kind in triangle_machines() {
            let model = Model::new(&base.with_machine(kind.name).unwrap()).unwrap();
            let mut count = [0, 0];
            for index in 0..24 {
                check(&model, &case(1000 + index, true), &format!("case {index}"), &mut count);
            }
            let [checked, skipped] = count;
            assert!(checked > 200 && skipped < checked, "{} {checked} {skipped}", kind.name);
        }
    }
}

/// Clauses CH-13 and CH-14 on whole scenes: the built-in ones, or those of `GUARDBIT_SCENES`, with any codes at
/// their vertices.
#[test]
#[ignore = "minutes: a rational at each sample of each machine"]
fn long_every_machine_stays_within_its_bounds_on_every_scene() {
    let given = std::env::var("GUARDBIT_SCENES").ok();
    let names = given.as_ref().map_or_else(
        || guardbit::scene::builtin_names().iter().map(|(name, _)| *name).collect(),
        |given| given.split(',').collect::<Vec<_>>(),
    );
    for name in names {
        let mut count = [0, 0];
        for correction in bounded() {
            let mut base = with(correction.clone(), true);
            base.window = WindowConfig { width: 32, height: 32 };
            base.vertex.integer = 5;
            for kind in triangle_machines() {
                let model = Model::new(&base.with_machine(kind.name).unwrap()).unwrap();
                let scene = guardbit::scene::load(name, &model.viewport()).unwrap();
                for (n, triangle) in scene.triangles.iter().enumerate() {
                    let Ok(placed) = model.snap(triangle) else { continue };
                    let index = u64::try_from(n).unwrap();
                    let triangle = Triangle { z: Some([1, 2, 3]), ..*placed };
                    let case = Case { triangle, ..case(50_000 + index, true) };
                    check(&model, &case, &format!("{name} {n}"), &mut count);
                }
            }
        }
        let [checked, skipped] = count;
        println!("{name}: {checked} codes within their bound, {skipped} without one");
        assert!(checked > 0);
    }
}

/// The bound of CH-14, all in units of 2^-5 of 1/w; nothing where 1/w is lost in its error, or a clamp can act.
fn perspective(
    (e_p, p): (&Rational, &Rational),
    (e_q, q): (&Rational, &Rational),
    correction: &Correction,
) -> Option<Rational> {
    let u = p / q;
    let magnitude = if u < integer(0) { -&u } else { u.clone() };
    let room = q - e_q;
    if room <= integer(0) || q + e_q >= integer(31) {
        return None;
    }
    let spread = (e_p + &magnitude * e_q) / room;
    Some(match correction {
        Correction::Reciprocal { unit, .. } => {
            let worst = unit.unit().unwrap().worst();
            let error = ratio(worst.error.abs(), 1 << worst.scale).unwrap()
                + ratio(1, 1 << (unit.operand - 1)).unwrap();
            // Rounding is a floor.
            (magnitude + integer(1) + &spread) * error + &spread + integer(1)
        }
        _ => spread + ratio(1, 2).unwrap(),
    })
}
