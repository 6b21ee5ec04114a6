//! The search for the bits of channels, against measuring everything, and the measure against the exact
//! values. Clauses M-9, Q-1, Q-4, Q-8, H-5 and H-6.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::case::Words;
use guardbit::exact::{Rational, edge_value, integer};
use guardbit::explore::field::{Field, Value};
use guardbit::explore::fit::{Lesser, Request, exhaustive, fit};
use guardbit::explore::metric::Metric;
use guardbit::explore::space::{Axis, Space};
use guardbit::explore::sweep::{Found, Sweep};
use guardbit::explore::tolerance::Tolerance;
use guardbit::machine::Input;
use guardbit::measure::accuracy::{Reference, What};
use guardbit::measure::cost::estimate;
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Profile, load, parse};
use guardbit::scene::{self, Attributes, Scene, Shading};
use num_traits::ToPrimitive;
use std::sync::Mutex;

/// 8 x 8 pixels, a channel of two components.
fn toy(correction: &str) -> Profile {
    let mut profile = load("tiny").unwrap();
    profile.window = guardbit::profile::WindowConfig { width: 8, height: 8 };
    (profile.vertex.integer, profile.vertex.sub_pixel) = (3, 2);
    Field::EDGE_WIDTH.write(&mut profile, &Value::Name("exact")).unwrap();
    let w = "[w]\nguard = 1\ninteger = 5\ninterpolation = 6\nrounding = \"nearest-even\"\nclamp = \"guard\"\n";
    let channel = format!(
        "[[channel]]\nname = \"c\"\ncomponents = [\"a\", \"b\"]\nguard = 1\ninteger = 4\n\
         interpolation = 6\nrounding = \"nearest-even\"\nclamp = \"guard\"\ncorrection = {correction}\n"
    );
    let w = if correction == "\"affine\"" { "" } else { w };
    parse(&(profile.to_toml() + w + &channel), "toy.toml").unwrap()
}

const CORRECTIONS: [&str; 5] = [
    "{ quotient = { rounding = \"nearest-even\" } }",
    "\"affine\"",
    "{ reciprocal = { rounding = \"floor\", unit = { operand = 6, index = 3, entry = 5, refine = { newton = { bits = [9] } } } } }",
    "{ barycentric = { bits = 6, rounding = \"nearest-even\" } }",
    "{ constant-w = { rounding = \"floor\" } }",
];

/// Triangles with codes, or with reals.
fn scene(words: &mut Words) -> Scene {
    let mut triangles = Vec::new();
    let mut shadings = Vec::new();
    for n in 0..8 {
        let mut point = || [(); 2].map(|()| words.between(0, 32));
        let xy = [point(), point(), point()];
        triangles.push(scene::Triangle::Lattice { xy, z: Some([1, 4, 6]) });
        let mut three = |low, high| [(); 3].map(|()| words.between(low, high));
        let name = "c".to_owned();
        shadings.push(Some(if n % 2 == 0 {
            let channels = vec![(name, vec![three(0, 15), three(0, 15)])];
            Shading::Codes { channels, inverse_w: Some(three(1, 31)) }
        } else {
            let mut real = |low, high, whole: f64| {
                three(low, high).map(|n| f64::from(i32::try_from(n).unwrap()) / whole)
            };
            let channels = vec![(name, vec![real(0, 64, 64.0), real(0, 64, 64.0)])];
            Shading::Reals { channels, w: Some(real(8, 32, 8.0)) }
        }));
    }
    Scene { attributes: Attributes::Lines(shadings), ..Scene::new("case", triangles) }
}

fn sweep(base: &Profile, axes: &[&str], scene: Scene) -> Sweep {
    let axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
    let scenes = vec![Reference::new(scene, base)];
    Sweep { space: Space::new(base.clone(), axes).unwrap(), scenes }
}

fn request<'a>(sweep: &'a Sweep, tolerances: &[&str]) -> Request<'a> {
    let tolerance = |text: &&str| {
        let (name, limit) = text.split_once('=').unwrap();
        Tolerance { metric: Metric::find(name).unwrap(), limit: limit.parse().unwrap() }
    };
    Request {
        sweep,
        tolerances: tolerances.iter().map(tolerance).collect(),
        cost: Metric::find("area").unwrap(),
        robust: false,
        numbers: 0..sweep.space.len(),
    }
}

/// Clause Q-8: what the search leaves out does not change its answer.
#[test]
fn a_search_for_bits_of_channels_has_the_answer_of_measuring_everything() {
    let (mut found, mut none) = (0, 0);
    for (n, correction) in CORRECTIONS.iter().enumerate() {
        let base = toy(correction);
        let axes: &[&str] = match n {
            0 => &["c.interpolation=0..5", "w.interpolation=2..6", "c.guard=0..1"],
            1 => &["c.interpolation=0..6", "interpolation=3..5", "c.rounding=floor,nearest-even"],
            2 => &["c.interpolation=1..5", "c.entry=2..5", "c.step=6..9"],
            3 => &["c.coordinate=1..8", "guard=0..1"],
            _ => &["c.interpolation=2..6", "w.integer=4..6"],
        };
        for tolerances in [
            &["c-worst=1"][..],
            &["c-worst=2.5", "c-rms=0.8"],
            &["c-mean=0.1", "depth-worst=0.6"],
            &["c-rms-world=0.05"],
            &["c-worst@64=9", "misclassified=0"],
        ] {
            for number in 0..3 {
                let sweep = sweep(&base, axes, scene(&mut Words::new(16, 0, number)));
                let request = request(&sweep, tolerances);
                let fit = fit(&request, &|| true).unwrap().unwrap();
                assert_eq!(fit.effort.evaluated + fit.effort.pruned(), fit.budgets);
                let best = fit.best.as_ref().map(|best| best.index);
                let wanted = exhaustive(&request, 2).unwrap();
                assert_eq!(best, wanted, "{correction}: {tolerances:?}, scene {number}");
                if best.is_some() { found += 1 } else { none += 1 }
            }
        }
    }
    assert!(found > 15 && none > 5, "{found} found, {none} without");
}

/// The exact value of a component at the centre of a pixel, by areas and 1/w, in units of code 1.
fn exact(xy: [[i128; 2]; 3], [x, y]: [i128; 2], u: [&Rational; 3], q: [&Rational; 3]) -> Rational {
    let point = [4 * x + 2, 4 * y + 2];
    let share = |k: usize| edge_value(xy[(k + 1) % 3], xy[(k + 2) % 3], point) * q[k];
    let below = share(0) + share(1) + share(2);
    (share(0) * u[0] + share(1) * u[1] + share(2) * u[2]) / below
}

/// Clause M-9: worst, mean and RMS are those of every code that is drawn.
#[test]
fn errors_are_those_of_every_code_against_its_exact_value() {
    // Multiples of 1/64.
    let rational = |value: f64| integer((value * 64.0).to_i128().unwrap()) / integer(64);
    let real = |value: Rational| value.numer().to_f64().unwrap() / value.denom().to_f64().unwrap();
    for (n, correction) in CORRECTIONS.iter().enumerate() {
        let base = toy(correction);
        let scene = scene(&mut Words::new(17, 0, n as u64));
        let model = Model::new(&base).unwrap();
        let (mut errors, mut samples) = (Vec::new(), 0);
        for (number, triangle) in scene.triangles.iter().enumerate() {
            let scene::Triangle::Lattice { xy, .. } = *triangle else { unreachable!() };
            let values = model.scene_values(&scene.attributes, number).unwrap();
            let Attributes::Lines(lines) = &scene.attributes else { unreachable!() };
            let (u, q): (Vec<[Rational; 3]>, [Rational; 3]) = match lines[number].as_ref().unwrap()
            {
                Shading::Codes { channels, inverse_w } => {
                    let codes = channels[0].1.iter().map(|codes| codes.map(integer));
                    (codes.collect(), inverse_w.unwrap().map(integer))
                }
                Shading::Reals { channels, w } => {
                    let reals = channels[0].1.iter();
                    let codes = reals.map(|u| u.map(|u| rational(u) * integer(15)));
                    (codes.collect(), w.unwrap().map(|w| integer(1) / rational(w)))
                }
            };
            let mut drawing = Drawing::default();
            let snapped = model.snap(triangle).unwrap();
            model.draw(Input::Shaded(&snapped, &values), &mut drawing).unwrap();
            let pixels = drawing.spans.iter().flat_map(|run| (run.x0..run.x1).map(|x| [x, run.y]));
            samples += pixels.clone().count();
            let codes = drawing.channels.first().map_or(&[][..], |codes| codes);
            for (pixel, codes) in pixels.zip(codes.chunks(2)) {
                for (code, u) in codes.iter().zip(&u) {
                    let truth = exact(xy, pixel.map(i128::from), u.each_ref(), q.each_ref());
                    errors.push(real(integer((*code).into()) - truth));
                }
            }
        }
        let sweep = sweep(&base, &["guard=2"], scene);
        let found = Mutex::new(None);
        let keep = |one: Found| {
            if let Found::Measured(record) = one {
                *found.lock().unwrap() = Some(*record);
            }
            true
        };
        sweep.run(1, &|_| true, &keep).unwrap();
        let record = found.into_inner().unwrap().unwrap();
        let count = f64::from(u32::try_from(errors.len()).unwrap());
        let worst = errors.iter().fold(0.0f64, |worst, error| worst.max(error.abs()));
        let mean = errors.iter().sum::<f64>() / count;
        let squares = errors.iter().map(|error| error * error).sum::<f64>();
        let [error] = &record.accuracy.channels[..] else { panic!("one channel") };
        assert!(samples > 10, "{correction}: {samples} samples");
        for (got, wanted) in [
            (error.ulp.worst, worst),
            (error.ulp.mean, mean),
            (error.ulp.rms, (squares / count).sqrt()),
        ] {
            assert!((got - wanted).abs() < 1e-9, "{correction}: {got} and {wanted}");
        }
        let texels = Metric::find("c-worst@64").unwrap().of_accuracy(&record.accuracy).unwrap();
        assert!((texels - worst / 15.0 * 64.0).abs() < 1e-9);
    }
}

/// Clause Q-8: the counterexample of one bit fewer is drawn by the model as it says.
#[test]
fn the_counterexample_of_a_channel_is_what_the_model_draws() {
    let base = toy(CORRECTIONS[0]);
    let scene = scene(&mut Words::new(16, 0, 1));
    let sweep = sweep(&base, &["c.interpolation=0..9", "w.interpolation=6"], scene.clone());
    let request = request(&sweep, &["c-worst=1.2"]);
    let best = fit(&request, &|| true).unwrap().unwrap().best.unwrap();
    let [Lesser::Fails(field, witness), ..] = &best.lesser[..] else { panic!("{:?}", best.lesser) };
    assert_eq!(field.name(), "c.interpolation");
    let mut lesser = best.profile.clone();
    field.write(&mut lesser, &witness.value).unwrap();
    let model = Model::new(&lesser).unwrap();
    let place = witness.place.unwrap();
    let values = model.scene_values(&scene.attributes, place.triangle).unwrap();
    let snapped = model.snap(&scene.triangles[place.triangle]).unwrap();
    let mut drawing = Drawing::default();
    model.draw(Input::Shaded(&snapped, &values), &mut drawing).unwrap();
    let pixels = drawing.spans.iter().flat_map(|run| (run.x0..run.x1).map(|x| [x, run.y]));
    let at = pixels.zip(drawing.channels[0].chunks(2)).find(|(at, _)| *at == [place.x, place.y]);
    let codes = at.unwrap().1;
    let says = |(n, name): (usize, &str)| {
        witness.finding.starts_with(&format!("{name} of c is {} but", codes[n]))
    };
    assert!(says((0, "a")) || says((1, "b")), "{}: {codes:?}", witness.finding);
    let What::Ulp(error) = place.what else { panic!("{place:?}") };
    assert!(error.abs() > 1.2 && (error.abs() - witness.figure).abs() < 1e-9);
}

/// Clause Q-1: fields of channels are found, read and written by name; a profile without has none.
#[test]
fn fields_of_channels_have_their_names() {
    let mut profile = toy(CORRECTIONS[2]);
    let names: Vec<&str> = Field::of_profile(&profile).iter().map(|field| field.name()).collect();
    for name in ["c.integer", "c.entry", "c.step", "w.interpolation"] {
        assert!(names.contains(&name), "{names:?}");
        let field = Field::find(name).unwrap();
        field.write(&mut profile, &Value::Bits(4)).unwrap();
        assert_eq!(field.read(&profile), Some(Value::Bits(4)));
    }
    assert!(!names.contains(&"c.coordinate"));
    assert!(Field::find("c.colour").is_none() && Field::find("w.entry").is_none());
    let plain = load("tiny").unwrap();
    assert!(Field::find("c.guard").unwrap().read(&plain).is_none());
    for name in ["c-worst@0", "c-worst@", "-worst", "c-best", "c-worst-world@4"] {
        assert!(Metric::find(name).is_none(), "{name}");
    }
}

/// Clauses H-5 and H-6: a channel costs what depth of its words costs, a divider more than a table, and a
/// division by a shared reciprocal takes area and saves clocks.
#[test]
fn channels_and_set_up_have_a_cost() {
    let area = |profile: &Profile| estimate(profile).unwrap().ripple.area_um2;
    let affine = toy(CORRECTIONS[1]);
    let mut plain = affine.clone();
    plain.channel.clear();
    let depth = plain.depth.as_mut().unwrap();
    (depth.guard, depth.integer, depth.interpolation) = (1, 4, 6);
    let mut coverage = plain.clone();
    coverage.depth = None;
    let one = area(&plain) - area(&coverage);
    plain.depth = affine.depth;
    assert!((area(&affine) - area(&plain) - 2.0 * one).abs() < 1e-6);
    let quotient = estimate(&toy(CORRECTIONS[0])).unwrap();
    let corrected = &quotient.channels[1];
    assert_eq!((quotient.channels[0].name.as_str(), corrected.name.as_str()), ("w", "c"));
    // Two dividers of 5 rows, 12 columns.
    assert!((corrected.correction_um2 - 2.0 * 60.0 * 8.49).abs() < 1e-6);
    let mut shared = load("sgi-4k").unwrap();
    let exact = estimate(&shared).unwrap().set_up;
    shared.depth.as_mut().unwrap().division = guardbit::setup::Division::Reciprocal { bits: 12 };
    let shared = estimate(&shared).unwrap().set_up;
    // Three quotients of 39 bits; one reciprocal of 12 and three products.
    assert_eq!((exact.cycles, shared.cycles), (3 * 39, 12 + 3));
    assert!(shared.area_um2 > exact.area_um2);
}
