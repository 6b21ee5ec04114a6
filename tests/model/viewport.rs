//! From clip space to the window, and what is culled there, against exact arithmetic rounded once a step.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "numbers of few bits, and a guess that is put right"
)]

use super::toy::{TOY, parse};
use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::exact::{Rational, integer, ratio, round};
use guardbit::model::{Drawing, Model};
use guardbit::profile::Profile;
use guardbit::scene::{Positioned, Primitive, lines::parse_line};
use guardbit::setup::{
    ClipDepth, DepthClamp, DivisionByW, Transform, Triangle, VerticalAxis, ViewportConfig,
};

const DEPTH: &str = "[depth]\nguard = 2\ninteger = 20\ninterpolation = 6\nrounding = \"nearest-even\"\n\
                     division = \"quotient\"\nclamp = \"wrap\"\nstart-bias = \"none\"\n";

/// The exact value of a number of moderate size.
fn exact(value: f32) -> Rational {
    let scaled = f64::from(value) * 2f64.powi(60);
    assert!(value.is_finite() && scaled.fract() == 0.0 && scaled.abs() < 2f64.powi(120), "{value}");
    ratio(scaled as i128, 1 << 60).unwrap()
}

/// The binary32 number nearest to an exact value, to even on a tie: a guess, and its neighbours.
fn nearest(value: &Rational) -> f32 {
    let scaled = i128::try_from(round(&(value * integer(1 << 62)), Rounding::NearestEven)).unwrap();
    let guess = (scaled as f64 / 2f64.powi(62)) as f32;
    let distance = |n: &f32| {
        let apart = exact(*n) - value;
        if apart < integer(0) { integer(0) - apart } else { apart }
    };
    let all = [guess.next_down(), guess, guess.next_up()];
    let least = all.iter().map(distance).min().unwrap();
    let mut found: Vec<f32> = all.into_iter().filter(|n| distance(n) == least).collect();
    if found.len() > 1 {
        found.retain(|n| n.to_bits() & 1 == 0);
    }
    found[0]
}

/// What the clauses say, one exact operation at a time: x, y in sub-pixels of 2^-16 pixels, and depth.
fn twin(config: &ViewportConfig, [x, y, z, w]: [f32; 4]) -> [i128; 3] {
    let divide = |a: f32, b: f32| nearest(&(exact(a) / exact(b)));
    let divided = [x, y, z].map(|value| match config.division {
        DivisionByW::Quotient => divide(value, w),
        DivisionByW::Reciprocal => nearest(&(exact(value) * exact(divide(1.0, w)))),
    });
    let [width, height] = [config.width.unwrap(), config.height.unwrap()].map(i128::from);
    let turned = if config.y_axis == VerticalAxis::Up { -height } else { height };
    let half = |twice: i128| ratio(twice, 2).unwrap();
    let sides = [
        (half(width), half(2 * i128::from(config.x) + width)),
        (half(turned), half(2 * i128::from(config.y) + height)),
    ];
    let maximum = integer((1 << 20) - 1);
    let whole = |value: &Rational, by: Rounding| i128::try_from(round(value, by)).unwrap();
    let (near, far) = (f32::from(config.near), f32::from(config.far));
    let ends = [near, far].map(|end| whole(&(exact(end) * &maximum), Rounding::NearestEven));
    if let Transform::Fixed { fraction, rounding } = config.transform {
        let unit = integer(1 << fraction);
        let fixed = divided.map(|n| integer(whole(&(exact(n) * &unit), rounding)) / &unit);
        let at = |axis: usize| {
            let window = &fixed[axis] * &sides[axis].0 + &sides[axis].1;
            whole(&(window * integer(1 << 16)), Rounding::NearestEven)
        };
        let share = match config.depth {
            ClipDepth::ZeroToOne => fixed[2].clone(),
            ClipDepth::MinusOneToOne => (&fixed[2] + integer(1)) / integer(2),
        };
        let code = integer(ends[0]) + share * integer(ends[1] - ends[0]);
        let code = whole(&code, Rounding::NearestEven);
        let code = match config.clamp {
            DepthClamp::None => code,
            DepthClamp::Vertex => code.clamp(ends[0].min(ends[1]), ends[0].max(ends[1])),
        };
        return [at(0), at(1), code];
    }
    let sum = |value: f32, scale: &Rational, offset: &Rational| match config.transform {
        Transform::Fused => nearest(&(exact(value) * scale + offset)),
        _ => nearest(&(exact(nearest(&(exact(value) * scale))) + offset)),
    };
    let at = |axis: usize| {
        let window = sum(divided[axis], &sides[axis].0, &sides[axis].1);
        whole(&(exact(window) * integer(1 << 16)), Rounding::NearestEven)
    };
    let apart = exact(nearest(&(exact(far) - exact(near))));
    let (scale, offset) = match config.depth {
        ClipDepth::ZeroToOne => (apart, exact(near)),
        ClipDepth::MinusOneToOne => {
            let both = exact(nearest(&(exact(far) + exact(near))));
            (apart / integer(2), both / integer(2))
        }
    };
    let depth = sum(divided[2], &scale, &offset);
    let depth = match config.clamp {
        DepthClamp::None => depth,
        DepthClamp::Vertex => depth.clamp(near.min(far), near.max(far)),
    };
    [at(0), at(1), whole(&(exact(depth) * maximum), Rounding::NearestEven)]
}

/// A profile with a field that holds every vertex of the test.
fn profile(viewport: &str) -> Profile {
    let base =
        TOY.replace("integer = 3", "integer = 14").replace("signed = false", "signed = true");
    let base = base.replace("sub-pixel = 4", "sub-pixel = 16");
    let base = base.replace("width = 24", "width = 60").replace("closed = true", "closed = false");
    parse(&format!("{base}{DEPTH}[viewport]\nwidth = 333\nheight = 240\nx = -7\ny = 5\n{viewport}"))
        .unwrap()
}

/// Clauses FP-6, FP-7, FP-8 and FP-9: every choice of the viewport, on positions that round in each step.
#[test]
fn positions_reach_the_window_as_exact_steps_do() {
    let (mut differ, mut tried) = ([0u32; 3], 0);
    let mut index = 0;
    for transform in
        ["\"separate\"", "\"fused\"", "{ fixed = { fraction = 9, rounding = \"nearest-even\" } }"]
    {
        for (division, depth) in [
            ("quotient", "zero-to-one"),
            ("reciprocal", "minus-one-to-one"),
            ("reciprocal", "zero-to-one"),
        ] {
            for (up, clamp) in [("up", "none"), ("down", "vertex")] {
                let profile = profile(&format!(
                    "transform = {transform}\ndivision = \"{division}\"\ndepth = \"{depth}\"\ny-axis = \"{up}\"\n\
                     clamp = \"{clamp}\"\nnear = 0.9\nfar = 0.1\n"
                ));
                assert_eq!(parse(&profile.to_toml()).unwrap(), profile);
                let (config, model) = (profile.viewport.unwrap(), Model::new(&profile).unwrap());
                for _ in 0..10 {
                    index += 1;
                    let mut words = Words::new(41, 12, index);
                    let mut vertex = || {
                        let w = words.between(1 << 10, 1 << 14) as f32 / 4096.0;
                        // Depth is kept between the planes, but for the clamp.
                        let reach = if clamp == "none" { 1.0 } else { 1.2 };
                        let low = if depth == "zero-to-one" { 0.0 } else { -1.0 };
                        let mut part = || words.between(0, 1 << 20) as f32 / (1 << 20) as f32;
                        let (x, y) = ((part() * 3.0 - 1.5) * w, (part() * 3.0 - 1.5) * w);
                        [x, y, (low + part() * (reach - low)) * w, w]
                    };
                    let positions = [vertex(), vertex(), vertex()];
                    let got = model.position(&Positioned(positions)).unwrap();
                    for ((xy, z), position) in got.xy.iter().zip(got.z.unwrap()).zip(positions) {
                        assert_eq!([xy[0], xy[1], z], twin(&config, position), "{config:?}");
                        tried += 1;
                    }
                    // That each step matters: another choice moves some vertex.
                    let other = ViewportConfig { transform: Transform::Fused, ..config };
                    differ[0] +=
                        u32::from(twin(&other, positions[0]) != twin(&config, positions[0]));
                    let other = ViewportConfig { division: DivisionByW::Quotient, ..config };
                    differ[1] +=
                        u32::from(twin(&other, positions[0]) != twin(&config, positions[0]));
                    let other = ViewportConfig { clamp: DepthClamp::None, ..config };
                    differ[2] +=
                        u32::from(twin(&other, positions[0]) != twin(&config, positions[0]));
                }
            }
        }
    }
    assert!(tried == 540 && differ.iter().all(|count| *count > 8), "{tried} {differ:?}");
}

/// Clauses FP-6 and FP-9: what has no place is refused by its field; w at zero, behind the eye, without end.
#[test]
fn positions_without_a_place_are_refused_by_field() {
    let model = Model::new(&profile("")).unwrap();
    let asked = |text: &str| {
        let line = parse_line(text).map_err(|error| error.to_string())?;
        model.prepare(&line.primitive).map(|_| ()).map_err(|error| error.to_string())
    };
    let with = |vertex: &str| format!("{{\"position\":[[0,0,0,1],{vertex},[0,1,0.5,1]]}}");
    assert_eq!(asked(&with("[1,1,1,1]")), Ok(()));
    for (vertex, wanted) in [
        ("[1,1,1,0]", "position[1][3] = 0: only a vertex with w > 0"),
        ("[1,1,1,-2]", "position[1][3] = -2"),
        ("[1,1,1,{\"bits\":\"7f800000\"}]", "position[1][3] = inf"),
        ("[1,1,1,{\"bits\":\"7fc00000\"}]", "position[1][3] = NaN"),
        ("[1e30,1,1,1]", "position[1][0]"),
        ("[1,{\"bits\":\"7fc00000\"},1,1]", "position[1][1] is NaN"),
        ("[1,1,1.5,1]", "position[1][2] = 1572862 is outside the depth range"),
        ("[1,1,{\"bits\":\"ff800000\"},1]", "position[1][2] is infinite"),
        ("[1,1,1]", "field `position[1]`: 4 coordinates x, y, z, w are needed"),
    ] {
        let error = asked(&with(vertex)).unwrap_err();
        assert!(error.contains(wanted), "{error}");
    }
    let none = Model::new(&parse(TOY).unwrap()).unwrap();
    let line = parse_line(&with("[1,1,1,1]")).unwrap();
    assert!(none.prepare(&line.primitive).unwrap_err().to_string().contains("no [viewport]"));
    for (text, wanted) in [
        ("width = 0", "width = 0: 1 <= width <= 65536"),
        ("x = -65537", "x = -65537: -65536 <= x"),
        ("near = 1.5", "near = 1.5: the depth range lies in that of depth"),
        ("transform = { fixed = { fraction = 41, rounding = \"floor\" } }", "fraction = 41"),
    ] {
        let error = parse(&format!("{TOY}[viewport]\n{text}\n")).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
}

/// Clauses FP-10 and FP-11: a winding, and edges beyond a size, are left out after the snap; the rest is drawn
/// as without the table.
#[test]
fn triangles_are_culled_by_winding_and_by_size() {
    let plain = Model::new(&parse(TOY).unwrap()).unwrap();
    let mut counts = [0u32; 2];
    for (table, winding, largest) in [
        ("winding = \"counter-clockwise\"\n", -1, None),
        ("winding = \"clockwise\"\n", 1, None),
        ("largest = { x = 3, y = 5 }\n", 0, Some([3, 5])),
        ("winding = \"clockwise\"\nlargest = { x = 6, y = 6 }\n", 1, Some([6, 6])),
    ] {
        let model = Model::new(&parse(&format!("{TOY}[cull]\n{table}")).unwrap()).unwrap();
        for index in 0..200 {
            let mut words = Words::new(17, 5, index);
            let mut at = || [words.between(0, 128), words.between(0, 128)];
            let triangle = Triangle { xy: [at(), at(), at()], z: None };
            let (mut got, mut all) = (Drawing::default(), Drawing::default());
            model.draw(&model.place(triangle).unwrap(), &mut got).unwrap();
            plain.draw(&plain.place(triangle).unwrap(), &mut all).unwrap();
            let [a, b, c] = triangle.xy;
            let cross = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            let beyond = largest.is_some_and(|largest: [i128; 2]| {
                [(a, b), (b, c), (c, a)]
                    .iter()
                    .any(|(p, q)| (0..2).any(|axis| (p[axis] - q[axis]).abs() > largest[axis] * 16))
            });
            let culled = cross.signum() * winding > 0 || beyond;
            assert_eq!(got.culled, culled, "{triangle:?} {table}");
            assert_eq!(got.spans, if culled { Vec::new() } else { all.spans }, "{triangle:?}");
            counts[usize::from(culled)] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 200), "{counts:?}");
}

/// Clause FP-7: a line of `eval`, by hand: the middle of clip space is the middle of the window, and y points up.
#[test]
fn the_middle_of_clip_space_is_the_middle_of_the_window() {
    let model = Model::new(&parse(&format!("{TOY}[viewport]\n")).unwrap()).unwrap();
    let line = r#"{"position":[[0,0,0,1],[2,2,0,2],[-0.5,-1,0,1]]}"#;
    let Primitive::Position(positions) = parse_line(line).unwrap().primitive else { panic!() };
    let triangle = model.position(&positions).unwrap();
    assert_eq!(triangle.xy, [[64, 64], [128, 0], [32, 128]]);
}

/// Clause FP-9: under a clamp a depth without end is that of a plane; what is not a number is refused all the same.
#[test]
fn a_depth_without_end_is_clamped_to_a_plane() {
    for transform in
        ["\"separate\"", "\"fused\"", "{ fixed = { fraction = 40, rounding = \"floor\" } }"]
    {
        let text = format!("clamp = \"vertex\"\ntransform = {transform}\nnear = 1.0\nfar = 0.25\n");
        let model = Model::new(&profile(&text)).unwrap();
        let z = |z: f32| {
            let at = |z| [0.0, 0.0, z, 1.0];
            let triangle = model.position(&Positioned([at(z), at(0.0), at(1.0)]));
            triangle.map(|triangle| triangle.z.unwrap()).map_err(|error| error.to_string())
        };
        // A quarter of 2^20 - 1, to nearest.
        let far = 262_144;
        assert_eq!(z(f32::INFINITY), Ok([far, 1_048_575, far]), "{transform}");
        assert_eq!(z(f32::NEG_INFINITY), Ok([1_048_575, 1_048_575, far]), "{transform}");
        assert_eq!(z(3e38).unwrap()[0], far, "{transform}");
        assert!(z(f32::NAN).unwrap_err().contains("position[0][2] is NaN"), "{transform}");
    }
}
