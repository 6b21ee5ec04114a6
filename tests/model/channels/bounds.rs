//! Every code is within the stated bound of the exact value.

use super::{NEAREST, case, corrections, draw, normalised, plane, with};
use guardbit::exact::{PlaneNumerator, Rational, integer, ratio};
use guardbit::format::Clamp;
use guardbit::machine::Face;
use guardbit::model::Model;
use guardbit::profile::{Profile, triangle_machines};
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
    let face = Face { triangle, grid: &target.grid, bounds: target.bounds(triangle) };
    profile.form.depth_bound(&profile.state(), &face, &exact).unwrap()
}

fn apart(a: &Rational, b: &Rational) -> Rational {
    if a > b { a - b } else { b - a }
}

/// Clauses CH-13 and CH-14: on every machine every code is within the stated bound of the exact value.
#[test]
fn errors_stay_within_the_stated_bounds() {
    for correction in corrections() {
        let walks = correction.walks_w() && !matches!(correction, Correction::ConstantW { .. });
        if !walks && !matches!(correction, Correction::Affine | Correction::Barycentric { .. }) {
            continue;
        }
        let base = with(correction.clone(), true);
        for kind in triangle_machines() {
            let profile = base.with_machine(kind.name).unwrap();
            let model = Model::new(&profile).unwrap();
            let (mut checked, mut skipped) = (0, 0);
            for index in 0..24 {
                let case = case(1000 + index, true);
                let (triangle, codes, q) = normalised(&case);
                if triangle.area2() == 0 {
                    continue;
                }
                let drawing = draw(&model, &case);
                let mut values = drawing.channels.first().into_iter().flatten();
                let grid = profile.grid().unwrap();
                for span in &drawing.spans {
                    for x in span.x0..span.x1 {
                        let at = grid.position(x.into(), span.y.into());
                        for u in codes {
                            let got = integer((*values.next().unwrap()).into());
                            let one = integer(1);
                            let exact = |v: [i128; 3]| plane(triangle.xy, v.map(integer), at);
                            let over = [0, 1, 2].map(|n| u[n] * q[n]);
                            let (p, w) = (exact(over), exact(q));
                            let want = if correction.needs_w() { &p / &w } else { exact(u) };
                            let bound = match &correction {
                                Correction::Affine => {
                                    Some(stated(&profile, &triangle, u, [4, 9]) + &one)
                                }
                                Correction::Barycentric { .. } => {
                                    let rise = (u[1] - u[0]).abs() + (u[2] - u[0]).abs();
                                    Some(ratio(rise, 2 << 10).unwrap() + &one)
                                }
                                // u q counts 2^-5 of u q / 2^5: 9 bits below the point are 4 below that.
                                _ => perspective(
                                    (&stated(&profile, &triangle, over, [9, 4]), &p),
                                    (&stated(&profile, &triangle, q, [5, 9]), &w),
                                    &correction,
                                ),
                            };
                            match bound {
                                Some(bound) => {
                                    let error = apart(&got, &want);
                                    assert!(
                                        error <= bound,
                                        "{} {correction:?} case {index} at {at:?}: {got} for {want}, {error} > {bound}",
                                        kind.name
                                    );
                                    checked += 1;
                                }
                                None => skipped += 1,
                            }
                        }
                    }
                }
            }
            assert!(checked > 200 && skipped < checked, "{} {checked} {skipped}", kind.name);
        }
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
