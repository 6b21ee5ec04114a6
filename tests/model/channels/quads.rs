//! Quads, their differences and the level of detail.
#![allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small integers as real numbers and back"
)]

use super::{case, clause, corrections, draw, toy, with};
use guardbit::model::{Model, QuadError};
use guardbit::value::{AxisLength, Correction, Derivatives, DetailConfig, Quad};
use std::collections::BTreeSet;

/// Clause CH-20: the pixels of a quad have the codes of the words, inside and outside of the triangle.
#[test]
fn quads_have_the_codes_of_the_clauses() {
    let planes = ["edge-function", "edge-walk", "engine-per-pixel", "tiles", "homogeneous"];
    let planar = |c: &Correction| !matches!(c, Correction::ConstantW { .. });
    let (mut helpers, mut covered) = (0, 0);
    for correction in corrections().into_iter().filter(planar) {
        let base = with(correction, true);
        let models = planes.map(|name| Model::new(&base.with_machine(name).unwrap()).unwrap());
        for (index, model) in (0..25).zip(models.iter().cycle()) {
            let case = case(3000 + index, true);
            let drawing = draw(model, &case);
            let spans = drawing.spans.iter();
            let pixels: BTreeSet<[u32; 2]> =
                spans.flat_map(|span| (span.x0..span.x1).map(|x| [span.y, x])).collect();
            let mut want: Vec<[u32; 2]> = pixels.iter().map(|p| p.map(|v| v / 2 * 2)).collect();
            want.sort_unstable();
            want.dedup();
            let values = [("c".to_owned(), case.codes.to_vec())];
            let values = model.values(&values, Some(case.q)).unwrap();
            let quads = model.quads(&model.place(case.triangle).unwrap(), &values, "c").unwrap();
            assert_eq!(quads.iter().map(|quad| [quad.y, quad.x]).collect::<Vec<_>>(), want);
            for quad in &quads {
                assert_eq!(quad.codes.len(), 2);
                for n in 0..4 {
                    let [y, x] = [quad.y + n / 2, quad.x + n % 2];
                    let inside = quad.covered[n as usize];
                    assert_eq!(inside, pixels.contains(&[y, x]));
                    (helpers, covered) =
                        (helpers + u32::from(!inside), covered + u32::from(inside));
                    for component in 0..2 {
                        let pixel = [x, y].map(i128::from);
                        let want = clause(&base, &case, component, pixel, [0; 2]);
                        let got = quad.codes[component][n as usize];
                        assert_eq!(i128::from(got), want, "case {index} at {pixel:?}");
                    }
                }
            }
        }
    }
    assert!(helpers > 500 && covered > 500, "{helpers} {covered}");
}

/// Clause CH-20: every quad of codes of two bits, signed: fine differences are those of the pixel's own row and
/// column, coarse ones those of the first, and both fit three bits.
#[test]
fn differences_are_those_of_rows_and_columns() {
    for n in 0..256i64 {
        let codes = [0, 2, 4, 6].map(|at| (n >> at & 3) - 2);
        let quad = Quad { x: 0, y: 0, covered: [true; 4], codes: vec![codes] };
        let [fine, coarse] =
            [Derivatives::Fine, Derivatives::Coarse].map(|which| quad.derivatives(0, which));
        let at = |x: usize, y: usize| codes[2 * y + x];
        for pixel in 0..4 {
            let [x, y] = [pixel % 2, pixel / 2];
            assert_eq!(fine[pixel], [at(1, y) - at(0, y), at(x, 1) - at(x, 0)]);
            assert_eq!(coarse[pixel], [at(1, 0) - at(0, 0), at(0, 1) - at(0, 0)]);
            assert!(fine[pixel].iter().all(|d| (-4..4).contains(d)));
        }
    }
}

/// Clause CH-21, as it is written.
fn level(config: &DetailConfig, d: [[i64; 2]; 2]) -> u64 {
    let scale = f64::from(1 << config.fraction);
    let cut = |v: f64| (v * scale).floor();
    let log = |v: f64| {
        let place = v.log2().floor();
        cut(place + v / place.exp2() - 1.0)
    };
    let axis = |n: usize| {
        let [u, v] = [0, 1].map(|k| (d[k][n] * i64::from(config.texels[k])).abs() as f64);
        match config.length {
            AxisLength::LargerAndHalf => 2.0 * u.max(v) + u.min(v),
            AxisLength::Exact => u * u + v * v,
        }
    };
    let longer = axis(0).max(axis(1));
    if longer == 0.0 {
        return 0;
    }
    let found = match config.length {
        AxisLength::LargerAndHalf => log(longer) - scale,
        AxisLength::Exact => (log(longer) / 2.0).floor(),
    };
    let most = f64::from(config.levels) * scale;
    (found - log(f64::from(config.unit))).clamp(0.0, most) as u64
}

/// Clause CH-21: every difference of codes of three bits, against the clause and against the exact level.
#[test]
fn levels_are_near_the_logarithm() {
    for length in [AxisLength::LargerAndHalf, AxisLength::Exact] {
        for unit in [5, 7, 8] {
            let derivatives = Derivatives::Fine;
            let config = DetailConfig {
                texels: [64, 16],
                unit,
                derivatives,
                length,
                fraction: 5,
                levels: 5,
            };
            let built = config.unit().unwrap();
            // What the linear mantissa loses, and what the length gains.
            let (step, mantissa) = (1.0 / 32.0, 0.0861);
            let gain = if length == AxisLength::Exact { 0.0 } else { 0.1610 };
            for n in 0..15i64.pow(4) {
                let d = [1, 15, 225, 3375].map(|at| n / at % 15 - 7);
                let d = [[d[0], d[1]], [d[2], d[3]]];
                let got = built.level(d);
                assert_eq!(got, level(&config, d), "{config:?} {d:?}");
                let axis = |n: usize| f64::hypot((d[0][n] * 64) as f64, (d[1][n] * 16) as f64);
                let longer = axis(0).max(axis(1));
                let exact = (longer / f64::from(unit)).log2().clamp(0.0, 5.0);
                let over = got as f64 / 32.0 - exact;
                assert!(over >= -mantissa - 2.0 * step && over <= gain + mantissa + step, "{d:?}");
            }
        }
    }
}

/// Clauses CH-20 and CH-21: what has no codes beyond the edge has no quads, and a unit has its ranges.
#[test]
fn what_cannot_be_is_refused_by_name() {
    let case = case(1, false);
    let quads = |profile: &guardbit::profile::Profile, channel: &str| {
        let model = Model::new(profile).unwrap();
        let values = [("c".to_owned(), case.codes.to_vec())];
        let values = model.values(&values, Some(case.q)).unwrap();
        model.quads(&model.place(case.triangle).unwrap(), &values, channel)
    };
    assert!(quads(&toy(), "c").is_ok());
    assert_eq!(quads(&toy(), "d"), Err(QuadError::Channel("d".to_owned())));
    for machine in ["gouraud", "scanline", "barycentric"] {
        let profile = toy().with_machine(machine).unwrap();
        assert_eq!(quads(&profile, "c"), Err(QuadError::Machine(machine)));
    }
    let [.., constant] = corrections();
    assert_eq!(quads(&with(constant, false), "c"), Err(QuadError::Place("c".to_owned())));
    let length = AxisLength::Exact;
    let derivatives = Derivatives::Coarse;
    let good =
        DetailConfig { texels: [1; 2], unit: 1, derivatives, length, fraction: 16, levels: 31 };
    assert!(good.unit().is_ok());
    for bad in [
        DetailConfig { texels: [1, 65_537], ..good },
        DetailConfig { unit: 0, ..good },
        DetailConfig { fraction: 17, ..good },
        DetailConfig { levels: 32, ..good },
    ] {
        assert!(bad.unit().unwrap_err().to_string().contains("is needed"));
    }
    let most = i64::from(u32::MAX);
    assert_eq!(good.unit().unwrap().level([[most, -most]; 2]), 31 << 16);
}

/// The channel `c` of the toy with a level of detail.
fn detailed(derivatives: Derivatives) -> guardbit::profile::Profile {
    let mut profile = toy();
    let length = AxisLength::Exact;
    let detail =
        DetailConfig { texels: [64, 16], unit: 15, derivatives, length, fraction: 3, levels: 6 };
    profile.channel[0].detail = Some(detail);
    profile
}

/// Clauses CH-20 and CH-21: the levels of a drawing are those of the codes of the words around each covered pixel.
#[test]
fn each_covered_pixel_has_its_level() {
    let mut seen = BTreeSet::new();
    for derivatives in [Derivatives::Fine, Derivatives::Coarse] {
        let profile = detailed(derivatives);
        let (model, config) = (Model::new(&profile).unwrap(), profile.channel[0].detail.unwrap());
        for index in 0..20 {
            let case = case(4000 + index, false);
            let drawing = draw(&model, &case);
            let values = model.values_in_order(&case.codes, Some(case.q)).unwrap();
            let placed = model.place(case.triangle).unwrap();
            let [details] = &model.details(&placed, &values, &drawing).unwrap()[..] else {
                panic!("one channel has a level of detail")
            };
            let pixels = drawing.spans.iter().flat_map(|run| (run.x0..run.x1).map(|x| (x, run.y)));
            assert!(pixels.eq(details.iter().map(|detail| (detail.x, detail.y))));
            for detail in details {
                let code = |component: usize, x: u32, y: u32| {
                    let pixel = [x, y].map(i128::from);
                    i64::try_from(clause(&profile, &case, component, pixel, [0; 2])).unwrap()
                };
                let (x, y) = (detail.x & !1, detail.y & !1);
                let [row, column] = match derivatives {
                    Derivatives::Fine => [detail.y, detail.x],
                    Derivatives::Coarse => [y, x],
                };
                let want = [0, 1].map(|c| {
                    [
                        code(c, x + 1, row) - code(c, x, row),
                        code(c, column, y + 1) - code(c, column, y),
                    ]
                });
                assert_eq!(detail.differences, want, "case {index} at {x} {y}");
                assert_eq!(detail.level, level(&config, want));
                seen.insert(detail.level);
            }
        }
    }
    assert!(seen.len() > 8, "{seen:?}");
}

type Change<'a> = &'a dyn Fn(&mut guardbit::profile::Profile);

/// Clause CH-21: what a profile asks of a level of detail and cannot have is named.
#[test]
fn details_that_cannot_be_are_refused() {
    let with = |change: Change<'_>| {
        let mut profile = detailed(Derivatives::Coarse);
        change(&mut profile);
        Model::new(&profile).unwrap_err().to_string()
    };
    let [_, flat, .., constant] = corrections();
    let places = "one place in a pixel";
    let four = guardbit::cover::MultisampleConfig::standard(4, guardbit::cover::DepthAt::Centre);
    let cases: [(Change<'_>, &str); 6] = [
        (&|p| p.channel[0].components.truncate(1), "components = 1, but a texture has 2"),
        (&|p| (p.w, p.channel[0].correction) = (None, flat.clone()), places),
        (&|p| p.channel[0].correction = constant.clone(), places),
        (&|p| p.multisample = Some(four), places),
        (&|p| *p = p.with_machine("gouraud").unwrap(), "has values only where it covers"),
        (&|p| p.channel[0].detail.as_mut().unwrap().unit = 0, "unit = 0: 1 <= unit"),
    ];
    for (change, says) in cases {
        let text = with(change);
        assert!(text.contains("channel \"c\": detail: ") && text.contains(says), "{text}");
    }
}
