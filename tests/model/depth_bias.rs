//! The depth bias of profiles against a plain twin: formats, machines, limits.
#![cfg(feature = "cli")]

use guardbit::bits::Rounding;
use guardbit::exact::{Rational, dyadic, integer, ratio, round};
use guardbit::explore::field::{Field, Value};
use guardbit::format::Unreduced;
use guardbit::machine::{DrawError, Sink, triangle_machines};
use guardbit::model::{Model, Raster};
use guardbit::profile::{Profile, WindowConfig, load, parse};
use guardbit::setup::{ClipTriangle, Plane, Polygon, Triangle};
use guardbit::value::{DepthBias, DepthFormat};
use num_traits::ToPrimitive;

/// A format by its table in Z-1: what is stored of v = z / (2^d - 1), and the fields of a float.
fn stored(format: Option<&DepthFormat>, v: &Rational) -> (Rational, Option<(u32, u32)>) {
    let one = integer(1);
    let object = |r: u32| v / (integer(r.into()) - v * integer(i128::from(r) - 1));
    match format {
        None | Some(DepthFormat::ZOverW { .. }) => (v.clone(), None),
        Some(DepthFormat::InverseZ { .. }) => (one - v, None),
        Some(DepthFormat::OneOverW { ratio: r, .. }) => {
            (one - v * integer(i128::from(*r) - 1) / integer((*r).into()), None)
        }
        Some(DepthFormat::ObjectZ { ratio, .. }) => (object(*ratio), None),
        Some(DepthFormat::FloatFarZero { exponent, mantissa }) => {
            (one - v, Some((*exponent, *mantissa)))
        }
        Some(DepthFormat::FloatNearZero { exponent, mantissa, ratio }) => {
            (object(*ratio), Some((*exponent, *mantissa)))
        }
    }
}

/// r of clause Z-7 in units of the plane, from the powers of two that the largest quantity lies between.
fn r(format: Option<&DepthFormat>, z: [i128; 3], bits: u32, fraction: u32) -> Rational {
    let whole = integer((1 << bits) - 1);
    let range = &whole * integer(1 << fraction);
    let Some(format) = format else { return integer(1 << fraction) };
    let quantities = z.map(|z| stored(Some(format), &(integer(z) / &whole)));
    let Some((exponent, mantissa)) = quantities[0].1 else {
        return range / integer((1i128 << format.bits()) - 1);
    };
    let largest = quantities.map(|(quantity, _)| quantity).into_iter().max().unwrap();
    // Halvings of 1/2, the least value of the largest exponent, that reach it; the last serves all below.
    let most = (1u32 << exponent) - 2;
    let halvings = (0..most).find(|n| largest >= dyadic(1, n + 1)).unwrap_or(most);
    range * dyadic(1, 1 + halvings + mantissa)
}

/// The bias by its formula, in units of the plane.
fn twin(bias: &DepthBias, r: &Rational, [dx, dy]: [i128; 2], f: u32, by: Rounding) -> i128 {
    let rounded = |exact: Rational| round(&exact, by).to_i128().unwrap();
    let constant = rounded(integer(bias.constant.into()) * integer(bias.unit.into()) * r);
    let steepest = if dx.abs() > dy.abs() { dx.abs() } else { dy.abs() };
    let sum = constant + rounded(integer(i128::from(bias.slope) * steepest) / integer(256));
    let limit = i128::from(bias.clamp) << f;
    if limit > 0 && sum > limit || limit < 0 && sum < limit { limit } else { sum }
}

fn formats() -> Vec<Option<DepthFormat>> {
    let mut list = vec![
        None,
        Some(DepthFormat::ZOverW { bits: 4 }),
        Some(DepthFormat::InverseZ { bits: 9 }),
        Some(DepthFormat::OneOverW { bits: 5, ratio: 10 }),
        Some(DepthFormat::ObjectZ { bits: 7, ratio: 3 }),
    ];
    for (exponent, mantissa) in [(1, 3), (2, 3), (3, 2), (5, 4)] {
        list.push(Some(DepthFormat::FloatFarZero { exponent, mantissa }));
        list.push(Some(DepthFormat::FloatNearZero { exponent, mantissa, ratio: 7 }));
    }
    list
}

/// Clause Z-7 over a toy: every slope and bias of a few bits, and r of all depths of 3 bits in all formats.
#[test]
fn bias_and_r_are_those_of_the_twin() {
    const F: u32 = 2;
    let mut profile = load("tiny").unwrap();
    let depth = profile.depth.as_mut().unwrap();
    (depth.integer, depth.interpolation) = (3, F);
    for format in formats() {
        depth.format = format;
        for n in 0..512 {
            let z = [n & 7, n >> 3 & 7, n >> 6];
            let (top, under) = depth.resolvable(z);
            assert_eq!(ratio(top, under).unwrap(), r(format.as_ref(), z, 3, F), "{format:?} {z:?}");
        }
    }
    let terms = [-300, -128, -1, 0, 1, 77, 256];
    for (dx, dy, constant, slope) in (-5..=5)
        .flat_map(|dx| (-5..=5).map(move |dy| (dx, dy)))
        .flat_map(|(dx, dy)| (-2..=2).map(move |constant| (dx, dy, constant)))
        .flat_map(|(dx, dy, constant)| terms.map(|slope| (dx, dy, constant, slope)))
    {
        let [start, x, y] = [9, dx, dy].map(|raw| Unreduced::new(raw, F));
        let plane = Plane::new(start, x, y).unwrap();
        for (unit, clamp, by) in
            [(1, 0, Rounding::Floor), (2, 1, Rounding::NearestEven), (3, -1, Rounding::Ceiling)]
        {
            let bias = DepthBias { constant, unit, slope, clamp };
            let expected = twin(&bias, &ratio(28, 15).unwrap(), [dx, dy], F, by);
            assert_eq!(bias.of(&plane, (28, 15), by).raw(), expected, "{bias:?} {dx} {dy} {by}");
        }
    }
}

/// Keeps depth accumulators and codes.
#[derive(Default)]
struct Kept {
    held: Vec<i128>,
    codes: Vec<u64>,
}

impl Sink for Kept {
    fn span(&mut self, _: u32, _: u32, _: u32, depth: &[u64]) {
        self.codes.extend_from_slice(depth);
    }

    fn wants_held(&self) -> bool {
        true
    }

    fn held(&mut self, _: u32, _: u32, accumulators: &[i128]) {
        self.held.extend_from_slice(accumulators);
    }
}

fn kept(profile: &Profile, triangle: Triangle) -> Kept {
    let model = Model::new(profile).unwrap();
    let mut kept = Kept::default();
    model.draw(&model.place(triangle).unwrap(), &mut kept).unwrap();
    kept
}

fn toy() -> Profile {
    let mut profile = load("tiny").unwrap();
    profile.window = WindowConfig { width: 12, height: 12 };
    profile.vertex.integer = 4;
    let depth = profile.depth.as_mut().unwrap();
    (depth.guard, depth.integer, depth.interpolation) = (3, 8, 5);
    profile.form.edge_mut().unwrap().width = 20;
    profile
}

/// Clause Z-7 on every machine: each accumulator is the one without the bias, moved by the twin's bias, wrapped
/// into the guard range and clamped; and the code is that of the accumulator.
#[test]
fn a_biased_drawing_is_the_drawing_moved() {
    let (mut state, mut moved, mut clamped) = (7u64, 0, 0);
    let mut next = |below: u64| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i128::from((state >> 33) % below)
    };
    let small = |value: i128| i64::try_from(value).unwrap();
    for kind in triangle_machines() {
        let base = toy().with_machine(kind.name).unwrap();
        for round_of in 0..40 {
            let mut plain = base.clone();
            let depth = plain.depth.as_mut().unwrap();
            depth.rounding = Rounding::ALL[round_of % Rounding::ALL.len()];
            depth.format = formats()[round_of % formats().len()];
            let (format, by) = (depth.format, depth.rounding);
            let s = plain.vertex.sub_pixel;
            let xy = [(); 3].map(|()| [(); 2].map(|()| next(12 << s)));
            // Far from both ends: without a bias nothing is clamped.
            let z = [(); 3].map(|()| 64 + next(128));
            let [a, b, c] = xy;
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            let float = format.is_some_and(|format| stored(Some(&format), &integer(0)).1.is_some());
            let far = next(3);
            let bias = DepthBias {
                constant: if float { small(next(9)) - 4 } else { small(next(13)) - 6 },
                unit: 1 + u32::from(far == 2),
                slope: small(next(1200)) - 600,
                clamp: [0, 9, -9][usize::try_from(next(3)).unwrap()],
            };
            let mut biased = plain.clone();
            biased.depth.as_mut().unwrap().bias = Some(bias);
            if kind.name == "homogeneous" && float && bias.constant != 0 {
                let text = biased.validate().unwrap_err().to_string();
                assert!(text.contains("use constant = 0"), "{text}");
                continue;
            }
            let triangle = Triangle { xy, z: Some(z) };
            let (before, after) = (kept(&plain, triangle), kept(&biased, triangle));
            if area == 0 {
                assert!(after.codes.is_empty());
                continue;
            }
            // Slopes a pixel, rounded as the profile says, by the determinants of P-1.
            let (z1, z2) = (z[1] - z[0], z[2] - z[0]);
            let gx = z1 * (c[1] - a[1]) - z2 * (b[1] - a[1]);
            let gy = (b[0] - a[0]) * z2 - (c[0] - a[0]) * z1;
            let slope = |g: i128| {
                let exact = integer(g) / integer(area) * integer(1 << (s + 5));
                round(&exact, by).to_i128().unwrap()
            };
            let r = r(format.as_ref(), z, 8, 5);
            let gain = twin(&bias, &r, [slope(gx), slope(gy)], 5, by);
            // 3 guard, 8 integer, 5 fraction bits: the range of G-3.
            let (low, all) = ((1 << 12) - (1 << 15), 1 << 16);
            let expected: Vec<i128> = before
                .held
                .iter()
                .map(|held| (low + (held + gain - low).rem_euclid(all)).clamp(0, (1 << 13) - 1))
                .collect();
            assert_eq!(after.held, expected, "{} {xy:?} {z:?} {bias:?} {format:?}", kind.name);
            let codes = expected.iter().map(|held| match format {
                None => u64::try_from(held >> 5).unwrap(),
                Some(format) => format.convert(*held, 8, 5, Rounding::NearestEven),
            });
            assert_eq!(after.codes, codes.collect::<Vec<_>>(), "{}", kind.name);
            moved += usize::from(before.codes != after.codes);
            clamped += expected.iter().filter(|held| [0, (1 << 13) - 1].contains(held)).count();
        }
    }
    assert!(moved > 100 && clamped > 20, "{moved} {clamped}");
}

/// Clause Z-7: what cannot be says which inequality, in which line and field.
#[test]
fn a_bias_that_cannot_be_is_refused() {
    let text = toy().to_toml();
    for (table, place, want) in [
        ("unit = 0", "depth.bias.unit", "unit >= 1 is needed"),
        ("constant = 256", "depth.bias.constant", "256 * 1 = 256 >= 2^8"),
        ("constant = -128\nunit = 2", "depth.bias.constant", "128 * 2 = 256 >= 2^8"),
        ("clamp = -256", "depth.bias.clamp", "|clamp| = 256 >= 2^integer = 2^8"),
        ("constant = 1.5", "depth.bias.constant", "invalid type: floating point"),
        ("slope = \"1\"", "depth.bias.slope", "invalid type: string"),
        ("slop = 1", "depth.bias.slop", "unknown field"),
    ] {
        let whole = format!("{text}\n[depth.bias]\n{table}\n");
        let error = parse(&whole, "own.toml").unwrap_err().to_string();
        let key = place.rsplit('.').next().unwrap();
        let line = 1 + whole
            .lines()
            .collect::<Vec<_>>()
            .iter()
            .rposition(|line| line.starts_with(key))
            .unwrap();
        assert!(error.starts_with(&format!("own.toml:{line}: {place}: ")), "{table}: {error}");
        assert!(error.contains(want), "{table}: {error}");
    }
    let refused = |change: &dyn Fn(&mut Profile)| {
        let mut profile = toy();
        profile.depth.as_mut().unwrap().bias =
            Some(DepthBias { constant: 16, ..DepthBias::default() });
        change(&mut profile);
        profile.validate().unwrap_err().to_string()
    };
    // A fraction of 3 bits has 4 bits of precision.
    let format = DepthFormat::FloatFarZero { exponent: 2, mantissa: 3 };
    let text = refused(&|profile| profile.depth.as_mut().unwrap().format = Some(format));
    assert!(text.contains("16 * 1 = 16 >= 2^4"), "{text}");
    let text = refused(&|profile| {
        let depth = profile.depth.as_mut().unwrap();
        (depth.interpolation, depth.bias.as_mut().unwrap().slope) = (65, i64::MAX);
    });
    assert!(text.contains("63 + 8 +") && text.contains("> 120"), "{text}");
    let mut registers = load("voodoo").unwrap();
    registers.depth = toy().depth;
    assert!(registers.validate().unwrap_err().to_string().contains("depth"));
}

/// Clause Z-7: a polygon has no plane.
#[test]
fn a_polygon_with_depth_has_no_bias() {
    let mut profile = toy().with_machine("gouraud").unwrap();
    let square = |z: Option<Vec<i128>>| Polygon { xy: vec![[0, 0], [9, 0], [9, 9], [0, 9]], z };
    let draw = |profile: &Profile, polygon: Polygon| {
        let model = Model::new(profile).unwrap();
        let prepared = model.prepare(&guardbit::scene::Primitive::Polygon(polygon)).unwrap();
        let mut kept = Kept::default();
        model.draw(&prepared, &mut kept).map(|()| kept.codes.len())
    };
    assert!(draw(&profile, square(Some(vec![5; 4]))).unwrap() > 9);
    profile.depth.as_mut().unwrap().bias = Some(DepthBias::default());
    assert_eq!(draw(&profile, square(Some(vec![5; 4]))), Err(DrawError::PolygonBias));
    assert_eq!(draw(&profile, square(None)), Ok(0));
}

/// Clause Z-7 on the other ways to a depth: several samples a pixel, an order of visits, memory, vertices that are
/// not projected. A flat triangle of depth 100 gains 3 codes, no slope.
#[test]
fn every_way_to_a_depth_has_the_bias() {
    let bias = Some(DepthBias { constant: 3, slope: 256, ..DepthBias::default() });
    let biased = |mut profile: Profile| {
        profile.depth.as_mut().unwrap().bias = bias;
        profile
    };
    let all = |codes: &[u64]| !codes.is_empty() && codes.iter().all(|code| *code == 103);
    let triangle = Triangle { xy: [[0, 0], [18, 0], [0, 18]], z: Some([100; 3]) };
    let profile = biased(toy());
    assert!(all(&kept(&profile, triangle).codes));
    let mut many = profile.clone();
    many.multisample = load("vulkan-8bit-4x").unwrap().multisample;
    many.vertex.sub_pixel = 4;
    many.form.edge_mut().unwrap().width = 30;
    let large = Triangle { xy: triangle.xy.map(|v| v.map(|at| 8 * at)), ..triangle };
    assert!(all(&kept(&many, large).codes));
    let mut ordered = profile.clone();
    Field::find("traversal").unwrap().write(&mut ordered, &Value::Name("morton")).unwrap();
    assert!(all(&kept(&ordered, triangle).codes));
    let model = Model::new(&profile).unwrap();
    let mut raster = Raster::new(profile.window().unwrap());
    model.fill(&model.place(triangle).unwrap(), &mut raster).unwrap();
    assert!((0..8).all(|y| raster.depth(y)[0] == 103), "{raster:?}");
    let homogeneous = biased(toy().with_machine("homogeneous").unwrap());
    // Twice as far: X, Y and Z are over W = 2.
    let xyw = triangle.xy.map(|[x, y]| [2 * x, 2 * y, 2]);
    let clip = ClipTriangle { xyw, z: Some([200; 3]) };
    let mut kept_clip = Kept::default();
    Model::new(&homogeneous).unwrap().draw(&clip, &mut kept_clip).unwrap();
    assert!(all(&kept_clip.codes));
}
