//! Depth formats, the depth buffer and the depth bias against their definitions and the known figures.
#![cfg(feature = "cli")]
#![allow(
    clippy::unwrap_used,
    clippy::cast_precision_loss,
    reason = "a test may panic, and its numbers are small"
)]

use guardbit::bits::Rounding;
use guardbit::cover::Rect;
use guardbit::exact::{Rational, dyadic, integer, ratio, round};
use guardbit::format::Unreduced;
use guardbit::machine::Sink;
use guardbit::measure::resolution::Scale;
use guardbit::model::{Drawing, Model};
use guardbit::profile::{WindowConfig, load, parse};
use guardbit::scene::{self, Lens};
use guardbit::setup::{Plane, Snapped, Triangle};
use guardbit::value::{Compare, DepthBias, DepthBuffer, DepthFormat};

fn toys() -> Vec<DepthFormat> {
    let mut list = Vec::new();
    for bits in 3..=6 {
        list.push(DepthFormat::ZOverW { bits });
        list.push(DepthFormat::InverseZ { bits });
        list.push(DepthFormat::OneOverW { bits, ratio: 10 });
        list.push(DepthFormat::ObjectZ { bits, ratio: 10 });
    }
    for (exponent, mantissa) in [(1, 2), (2, 3), (3, 2), (2, 1)] {
        list.push(DepthFormat::FloatFarZero { exponent, mantissa });
        list.push(DepthFormat::FloatNearZero { exponent, mantissa, ratio: 7 });
    }
    list
}

/// The quantity by its definition from a distance: w in [n, f] with n = 1, f = ratio.
fn defined(format: &DepthFormat, w: &Rational, f: i128) -> Rational {
    let (n, f) = (integer(1), integer(f));
    match format {
        DepthFormat::ZOverW { .. } => &f * (w - &n) / (w * (&f - &n)),
        DepthFormat::OneOverW { .. } => n / w,
        DepthFormat::ObjectZ { .. } | DepthFormat::FloatNearZero { .. } => (w - &n) / (&f - &n),
        DepthFormat::InverseZ { .. } | DepthFormat::FloatFarZero { .. } => {
            (integer(1) / w - integer(1) / &f) / (integer(1) / n - integer(1) / f)
        }
    }
}

/// Every value of a toy format by its definition, by code.
fn values(format: &DepthFormat) -> Vec<Rational> {
    (0..=format.maximum())
        .map(|code| {
            let code = i128::from(code);
            match format {
                DepthFormat::FloatFarZero { exponent, mantissa }
                | DepthFormat::FloatNearZero { exponent, mantissa, .. } => {
                    let (e, m) = (code >> mantissa, code & ((1 << mantissa) - 1));
                    let range = 1u32 << exponent;
                    if e == 0 {
                        dyadic(m, mantissa + range - 1)
                    } else {
                        dyadic(m + (1 << mantissa), mantissa + range - u32::try_from(e).unwrap())
                    }
                }
                _ => ratio(code, i128::from(format.maximum())).unwrap(),
            }
        })
        .collect()
}

/// Clauses Z-1, Z-2 and Z-3: on toy formats, every stored quantity, every decoded code, and every
/// encoded one is as defined: the nearest value, ties to the even code.
#[test]
fn toy_formats_are_their_definitions() {
    for format in toys() {
        let values = values(&format);
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{format:?} is ordered");
        for (code, value) in values.iter().enumerate() {
            let (n, d) = format.decode(code as u64);
            assert_eq!(&ratio(n, d).unwrap(), value, "{format:?} {code}");
            assert_eq!(format.encode((n, d), Rounding::NearestEven), code as u64, "round trip");
        }
        let r = format.ratio().map_or(5, i128::from);
        for step in 0..=240 {
            // A distance, its Z/w, and from that the quantity.
            let w = integer(1) + integer((r - 1) * step) / integer(240);
            let v = integer(r) * (&w - integer(1)) / (&w * integer(r - 1));
            let number = |n: &num_bigint::BigInt| i128::try_from(n.clone()).unwrap();
            let part = format.part((number(v.numer()), number(v.denom())));
            let quantity = ratio(part.0, part.1).unwrap();
            assert_eq!(quantity, defined(&format, &w, r), "{format:?} {w}");
            let got = format.encode(part, Rounding::NearestEven);
            let above = values.partition_point(|value| value <= &quantity);
            let wanted = if above == values.len() {
                format.maximum()
            } else {
                let (below, above) = (above - 1, above);
                let twice = integer(2) * &quantity - &values[below] - &values[above];
                match twice.cmp(&integer(0)) {
                    std::cmp::Ordering::Less => below as u64,
                    std::cmp::Ordering::Greater => above as u64,
                    std::cmp::Ordering::Equal => (below + below % 2) as u64,
                }
            };
            assert_eq!(got, wanted, "{format:?} {quantity}");
            let floor = format.encode(part, Rounding::Floor);
            assert!(values[usize::try_from(floor).unwrap()] <= quantity);
        }
    }
}

/// Clause Z-4: no conversion exchanges two depths.
#[test]
fn conversion_keeps_the_order() {
    for format in toys() {
        let codes: Vec<u64> = (0..=2000)
            .map(|v| format.encode(format.part((v, 2000)), Rounding::NearestEven))
            .collect();
        let ordered = if format.is_reversed() {
            codes.windows(2).all(|pair| pair[0] >= pair[1])
        } else {
            codes.windows(2).all(|pair| pair[0] <= pair[1])
        };
        assert!(ordered, "{format:?}");
        assert!(codes.iter().max() > codes.iter().min());
    }
}

/// Clause Z-8: the known figures of 24-bit buffers, from the formats' own codes.
#[test]
fn resolutions_are_the_known_ones() {
    let mean = |format, far| Scale::new(format, Lens { near: 1.0, far }).mean_step();
    let plain = DepthFormat::ZOverW { bits: 24 };
    for (far, wanted) in [(10.0, 3.70), (100.0, 33.67), (1000.0, 333.67)] {
        let r: f64 = far;
        assert!((wanted - (r * r + r + 1.0) / (3.0 * r)).abs() < 0.005);
        let got = mean(plain, far);
        assert!((got / wanted - 1.0).abs() < 0.01, "{far}: {got}");
    }
    let float = DepthFormat::FloatFarZero { exponent: 4, mantissa: 20 };
    for (far, wanted) in [(100.0, 1.962), (500.0, 1.934), (1000.0, 1.937)] {
        let got = mean(float, far);
        assert!((got / wanted - 1.0).abs() < 0.005, "{far}: {got}");
    }
    let scale = Scale::new(plain, Lens { near: 0.1, far: 10_000.0 });
    assert!((scale.step(1.0).codes_nearer - 90.0009).abs() < 0.0001);
    let reached = scale.reaches(1.0).unwrap();
    // A step is a finite one, so the place is known to about a step.
    assert!((reached - 1295.28).abs() < 1.0, "{reached}");
    let even =
        Scale::new(DepthFormat::ObjectZ { bits: 24, ratio: 1000 }, Lens { near: 1.0, far: 1000.0 });
    assert!((even.mean_step() - 1.0).abs() < 0.001);
}

/// Clause Z-5: a profile with a format draws the codes of that format, by the exact plane of each sample.
#[test]
fn a_profile_stores_its_format() {
    let mut base = load("sgi-4k").unwrap();
    base.window = WindowConfig { width: 16, height: 16 };
    let triangle = Triangle {
        xy: [[0, 0], [16_000, 1000], [900, 16_000]],
        z: Some([11, 9_000_001, 16_000_000]),
    };
    let plain = Model::new(&base).unwrap();
    let mut held = Held(Vec::new());
    plain.draw(&plain.place(triangle).unwrap(), &mut held).unwrap();
    for name in DepthFormat::NAMES {
        let mut profile = base.clone();
        let format = DepthFormat::named(name, 20, 50).unwrap();
        profile.depth.as_mut().unwrap().format = Some(format);
        assert_eq!(parse(&profile.to_toml(), "format.toml").unwrap(), profile);
        let model = Model::new(&profile).unwrap();
        assert_eq!(model.ports().depth.as_ref().unwrap().width, 20);
        let mut drawing = Drawing::default();
        model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
        assert_eq!(drawing.depth.len(), held.0.len());
        for (code, held) in drawing.depth.iter().zip(&held.0) {
            let v = ratio(*held, ((1 << 24) - 1) << 13).unwrap();
            let w = integer(50) / (integer(50) - &v * integer(49));
            let quantity = defined(&format, &w, 50);
            if matches!(
                format,
                DepthFormat::FloatFarZero { .. } | DepthFormat::FloatNearZero { .. }
            ) {
                let (n, d) = format.decode(*code);
                let off = ratio(n, d).unwrap() - quantity;
                assert!(off.clone() * &off < dyadic(1, 32), "{name}");
            } else {
                let wanted = round(&(quantity * integer((1 << 20) - 1)), Rounding::NearestEven);
                assert_eq!(num_bigint::BigInt::from(*code), wanted, "{name}");
            }
        }
    }
    let refused = |change: &dyn Fn(&mut guardbit::value::DepthConfig)| {
        let mut profile = base.clone();
        change(profile.depth.as_mut().unwrap());
        profile.validate().unwrap_err().to_string()
    };
    let text = refused(&|d| d.format = Some(DepthFormat::ZOverW { bits: 33 }));
    assert!(text.contains("33"), "{text}");
    let text = refused(&|d| d.format = DepthFormat::named("float-far-zero", 40, 2));
    assert!(text.contains("mantissa = 36"), "{text}");
    let text = refused(&|d| d.format = DepthFormat::named("object-z", 24, 1));
    assert!(text.contains("ratio = 1"), "{text}");
}

/// Keeps depth accumulators.
struct Held(Vec<i128>);

impl Sink for Held {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn wants_held(&self) -> bool {
        true
    }

    fn held(&mut self, _: u32, _: u32, accumulators: &[i128]) {
        self.0.extend_from_slice(accumulators);
    }
}

/// Clause Z-6: a scene leaves the same codes in whatever order it is drawn, and the test is reversed where
/// larger is nearer.
#[test]
fn the_depth_buffer_does_not_depend_on_the_order() {
    let mut profile = load("sgi-4k").unwrap();
    profile.window = WindowConfig { width: 120, height: 90 };
    let window = Rect { x0: 0, y0: 0, x1: 120, y1: 90 };
    let mut nearest = Vec::new();
    for name in ["z-over-w", "inverse-z", "float-near-zero"] {
        let format = DepthFormat::named(name, 24, 1000).unwrap();
        profile.depth.as_mut().unwrap().format = Some(format);
        let model = Model::new(&profile).unwrap();
        let scene = scene::load("knot", &model.viewport()).unwrap();
        let triangles: Vec<Snapped<Triangle>> =
            scene.triangles.iter().map(|triangle| model.snap(triangle).unwrap()).collect();
        let (compare, clear) = if format.is_reversed() {
            (Compare::Greater, 0)
        } else {
            (Compare::Less, format.maximum())
        };
        let draw = |order: &mut dyn Iterator<Item = &Snapped<Triangle>>| {
            let mut buffer = DepthBuffer::new(window, compare, clear);
            order.for_each(|triangle| model.draw(triangle, &mut buffer).unwrap());
            buffer
        };
        let (forth, back) = (draw(&mut triangles.iter()), draw(&mut triangles.iter().rev()));
        assert!((0..90).all(|y| forth.row(y) == back.row(y)), "{name}");
        assert_eq!(forth.passed + forth.failed, back.passed + back.failed);
        assert!(forth.passed > 1000 && forth.failed > 100);
        nearest.push((0..90).flat_map(|y| forth.row(y).to_vec()).collect::<Vec<u64>>());
    }
    // 1 - v is v seen from the other end.
    let both = nearest[0].iter().zip(&nearest[1]);
    let seen =
        both.filter(|(plain, inverse)| **plain + **inverse != (1 << 24) - 1 && **inverse != 0);
    assert_eq!(seen.count(), 0);
}

/// The eight comparisons.
#[test]
fn comparisons_are_their_names() {
    let passes: Vec<[bool; 3]> = Compare::ALL
        .iter()
        .map(|c| [(1, 2), (2, 2), (3, 2)].map(|(a, b)| c.passes(a, b)))
        .collect();
    let wanted = [
        [false, false, false],
        [true, false, false],
        [false, true, false],
        [true, true, false],
        [false, false, true],
        [true, false, true],
        [false, true, true],
        [true, true, true],
    ];
    assert_eq!(passes, wanted);
}

/// Clause Z-7: constant and slope, worked by hand.
#[test]
fn the_bias_is_constant_and_slope() {
    // Slopes of 3 and -5 ULP a pixel in units of 1/8.
    let [start, dx, dy] = [0, 24, -40].map(|raw| Unreduced::new(raw, 3));
    let plane = Plane::new(start, dx, dy).unwrap();
    let of = |constant, slope, clamp| {
        let bias = DepthBias { constant, unit: 2, slope, clamp };
        // r is one ULP: 8 of these units.
        bias.of(&plane, (8, 1), Rounding::NearestEven).raw()
    };
    assert_eq!(of(4, 0, 0), 8 * 8);
    // One and a half times 5 ULP.
    assert_eq!(of(0, 384, 0), 60);
    assert_eq!(of(-4, 384, 0), 60 - 64);
    assert_eq!(of(4, 384, 10), 80);
    assert_eq!(of(-40, 0, -10), -80);
}

/// Clause Z-9: snapping at 2 sub-pixel bits moves depth by more than a 16-bit code.
#[test]
fn few_sub_pixel_bits_leave_few_depth_bits() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_guardbit"))
        .args(["compare", "--show", "depth", "--window", "256x256", "--json"])
        .output()
        .unwrap();
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = report["snapping"].as_array().unwrap();
    let codes = |n: usize, bits: usize| rows[n]["codes"][bits].as_f64().unwrap();
    assert_eq!((rows.len(), rows[0]["sub_pixel"].as_u64()), (5, Some(2)));
    assert!(codes(0, 0) > 1.0 && codes(0, 2) > 65_536.0);
    // Two bits more, a quarter of the change.
    for n in 1..5 {
        let part = codes(n - 1, 1) / codes(n, 1);
        assert!((2.5..6.0).contains(&part), "{part}");
    }
}
