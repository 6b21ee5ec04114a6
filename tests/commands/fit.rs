//! The search for the cheapest budget, against a search that measures everything.
//! Clauses.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::case::Words;
use guardbit::cover::{Order, TraversalConfig};
use guardbit::explore::field::Level;
use guardbit::explore::fit::{Lesser, Request, exhaustive, fit, least};
use guardbit::explore::metric::Metric;
use guardbit::explore::pareto;
use guardbit::explore::record::Record;
use guardbit::explore::space::{Axis, Point, Space, SpaceError};
use guardbit::explore::sweep::{Found, Sweep};
use guardbit::explore::tolerance::Tolerance;
use guardbit::measure::accuracy::{Reference, What};
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Profile, WindowConfig, load, parse, triangle_machines};
use guardbit::scene::{self, Scene};
use num_traits::ToPrimitive;
use std::sync::Mutex;

fn sweep(base: &Profile, axes: &[&str], triangles: Vec<scene::Triangle>) -> Sweep {
    let axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
    let scene = Scene::new("case", triangles);
    let scenes = vec![Reference::new(scene, base)];
    Sweep { space: Space::new(base.clone(), axes).unwrap(), scenes }
}

fn builtin(base: &Profile, axes: &[&str], name: &str) -> Sweep {
    let model = Model::new(base).unwrap();
    let scene = scene::load(name, &model.viewport()).unwrap();
    let mut sweep = sweep(base, axes, vec![]);
    sweep.scenes = vec![Reference::new(scene, base)];
    sweep
}

fn tolerance(text: &str) -> Tolerance {
    let (name, limit) = text.split_once('=').unwrap();
    Tolerance { metric: Metric::find(name).unwrap(), limit: limit.parse().unwrap() }
}

fn request<'a>(sweep: &'a Sweep, tolerances: &[&str], cost: &str) -> Request<'a> {
    Request {
        sweep,
        tolerances: tolerances.iter().map(|text| tolerance(text)).collect(),
        cost: Metric::find(cost).unwrap(),
        robust: false,
        numbers: 0..sweep.space.len(),
    }
}

fn answer(request: &Request<'_>) -> Option<u64> {
    let fit = fit(request, &|| true).unwrap().unwrap();
    assert_eq!(fit.effort.evaluated + fit.effort.pruned(), fit.budgets, "{:?}", fit.effort);
    fit.best.map(|best| best.index)
}

/// A toy of 8 x 8 pixels.
fn toy() -> Profile {
    let mut profile = load("tiny").unwrap();
    profile.window = WindowConfig { width: 8, height: 8 };
    profile.vertex.integer = 3;
    profile.vertex.sub_pixel = 2;
    profile
}

fn random_triangles(words: &mut Words, profile: &Profile) -> Vec<scene::Triangle> {
    let high = 8 << profile.vertex.sub_pixel;
    (0..5)
        .map(|_| {
            let mut point = || [(); 2].map(|()| words.between(0, high));
            let xy = [point(), point(), point()];
            scene::Triangle::Lattice { xy, z: Some([(); 3].map(|()| words.between(0, 7))) }
        })
        .collect()
}

const SPACES: [&[&str]; 5] = [
    &["interpolation=0..6", "guard=0..2"],
    &["edge-width=4..12", "interpolation=1..4", "clamp=wrap,guard,sign,saturate"],
    &["form=edge-function,edge-walk", "walk-fraction=2..6", "interpolation=2..4", "guard=0..1"],
    &["sub-pixel=1..3", "integer=3..4", "interpolation=0..5", "rounding=floor,nearest-even"],
    &["reciprocal=3..8,quotient", "interpolation=2..6", "start-bias=none,half"],
];

const TOLERANCES: [&[&str]; 8] = [
    &["misclassified=0", "wraps=0", "depth-worst=0.5"],
    &["depth-rms=0.2", "clamps=2"],
    &["depth-mean=0.05", "ties=3"],
    &["inversions=0", "depth-worst=1.5"],
    &["attribute-worst=0.6", "attribute-rms=0.25", "wraps=1"],
    &["snap-misclassified=2", "misclassified=1", "depth-worst=0.75"],
    &["depth-worst-world=0.07", "holes=0", "double-hits=0"],
    &["snap-depth-worst=0.4", "depth-rms-world=0.04"],
];

#[test]
fn every_toy_space_has_the_answer_of_a_search_that_measures_everything() {
    let (mut found, mut none) = (0, 0);
    for (n, space) in SPACES.iter().enumerate() {
        for (m, tolerances) in TOLERANCES.iter().enumerate() {
            for scene in 0..3 {
                let mut words = Words::new(n as u64, m as u64, scene);
                let base = toy();
                let sweep = sweep(&base, space, random_triangles(&mut words, &base));
                for cost in ["area", "adder-bits", "delay-prefix"] {
                    let request = request(&sweep, tolerances, cost);
                    let wanted = exhaustive(&request, 2).unwrap();
                    assert_eq!(answer(&request), wanted, "{space:?} {tolerances:?} {cost} {scene}");
                    found += u32::from(wanted.is_some());
                    none += u32::from(wanted.is_none());
                }
            }
        }
    }
    assert!(found > 100 && none > 20, "both ends are met: {found} {none}");
}

/// Machines that look beyond the bounding box need wider words than it does.
#[test]
fn every_machine_of_edge_words_has_the_answer_of_measuring_everything() {
    let mut found = 0;
    for kind in triangle_machines() {
        let mut base = toy().with_machine(kind.name).unwrap();
        if base.form.edge().is_none() || !base.form.walks_a_plane() {
            continue;
        }
        let orders =
            if base.form.visits_the_box() { &[None, Some(Order::Tiles)][..] } else { &[None] };
        for order in orders {
            base.traversal =
                order.map(|order| TraversalConfig { order, stamp: guardbit::cover::Stamp::One });
            for scene in 0..4 {
                let mut words = Words::new(31, 4, scene);
                let axes = ["edge-width=4..12", "interpolation=1..3"];
                let sweep = sweep(&base, &axes, random_triangles(&mut words, &base));
                let request = request(&sweep, &["misclassified=0"], "adder-bits");
                let wanted = exhaustive(&request, 2).unwrap();
                assert_eq!(answer(&request), wanted, "{} {order:?} {scene}", kind.name);
                found += u32::from(wanted.is_some());
            }
        }
    }
    assert!(found >= 12, "{found}");
}

/// Clause Q-9: the search measures planes, and refuses machines that make depth by other means.
#[test]
fn machines_without_a_plane_are_refused() {
    for name in ["gouraud", "barycentric"] {
        let base = toy().with_machine(name).unwrap();
        let mut words = Words::new(31, 5, 0);
        let sweep = sweep(&base, &["interpolation=3..8"], random_triangles(&mut words, &base));
        let request = request(&sweep, &["depth-worst=0.6"], "area");
        let errors = [fit(&request, &|| true).err(), least(&request).err()];
        for error in errors {
            assert_eq!(
                error.unwrap().to_string(),
                format!(
                    "form = {name}: this machine does not walk a depth plane, but the proofs of fit are about planes"
                )
            );
        }
    }
}

#[test]
fn meshes_have_the_same_answer_and_hardly_any_whole_measurement() {
    let mut base = load("sgi-4k").unwrap();
    base.window = WindowConfig { width: 64, height: 48 };
    let axes =
        ["edge-width=14..23", "interpolation=3..12", "guard=0..2", "rounding=floor,nearest-even"];
    for scene in ["knot", "slivers", "fan"] {
        let sweep = builtin(&base, &axes, scene);
        let request = request(&sweep, &["misclassified=0", "wraps=0", "depth-worst=0.5"], "area");
        assert_eq!(answer(&request), exhaustive(&request, 2).unwrap(), "{scene}");
        let fit = fit(&request, &|| true).unwrap().unwrap();
        assert!(fit.effort.evaluated <= 6, "{scene}: {:?}", fit.effort);
    }
}

#[test]
fn all_tolerances_at_once_and_one_by_one_the_least_is_what_can_be_met() {
    let base = toy();
    let mut words = Words::new(3, 3, 3);
    let sweep = sweep(&base, SPACES[0], random_triangles(&mut words, &base));
    let asked = request(&sweep, &["depth-worst=0.001", "wraps=0"], "area");
    assert_eq!(answer(&asked), None);
    for least in least(&asked).unwrap() {
        // Exactly that much can be met, and nothing less.
        let at = [Tolerance { metric: least.metric, limit: least.value }];
        let under = [Tolerance { limit: least.value.next_down(), ..at[0] }];
        let request =
            |tolerances: &[Tolerance]| Request { tolerances: tolerances.to_vec(), ..asked.clone() };
        assert!(answer(&request(&at)).is_some(), "{least:?}");
        assert_eq!(exhaustive(&request(&at), 1).unwrap(), answer(&request(&at)));
        if least.value > 0.0 {
            assert_eq!(answer(&request(&under)), None, "{least:?}");
        }
    }
}

/// A triangle whose worst error grows with one more bit: with s = 2 and the plane taken from the
/// first pixel of its bounding box it reads .374 at F = 1 and .590 at F = 2. Moved by whole pixels
/// so that this pixel is (0, 0): the samples keep their places in the triangle.
fn not_monotone() -> Sweep {
    let mut base = toy();
    base.vertex.integer = 5;
    base.vertex.signed = true;
    base.window = WindowConfig { width: 16, height: 16 };
    base.depth.as_mut().unwrap().integer = 7;
    let given: [[i128; 3]; 3] = [[12, 62, 14], [49, 55, 1], [57, 34, 117]];
    // Its covered samples begin in column 5, row 9.
    let xy = given.map(|[x, y, _]| [x - 4 * 5, y - 4 * 9]);
    let z = Some(given.map(|[_, _, z]| z));
    sweep(&base, &["interpolation=0..6"], vec![scene::Triangle::Lattice { xy, z }])
}

fn records(sweep: &Sweep, threads: usize) -> Vec<Record> {
    let found = Mutex::new(Vec::new());
    sweep
        .run(threads, &|_| true, &|one| {
            if let Found::Measured(record) = one {
                found.lock().unwrap().push(*record);
            }
            true
        })
        .unwrap();
    let mut records = found.into_inner().unwrap();
    records.sort_by_key(|record| record.index);
    records
}

#[test]
fn one_more_bit_can_be_worse() {
    let sweep = not_monotone();
    let metric = Metric::find("depth-worst").unwrap();
    let worst: Vec<f64> =
        records(&sweep, 1).iter().map(|record| metric.of(record).unwrap()).collect();
    assert_eq!(format!("{:.3} {:.3}", worst[1], worst[2]), "0.374 0.590");
    let mut asked = request(&sweep, &["depth-worst=0.4"], "area");
    let cheapest = fit(&asked, &|| true).unwrap().unwrap().best.unwrap();
    assert_eq!(cheapest.index, 1);
    assert_eq!(cheapest.larger.failed.unwrap().index, 2, "it says that a larger one fails");
    asked.robust = true;
    let robust = fit(&asked, &|| true).unwrap().unwrap().best.unwrap();
    let wanted = (0..worst.len()).rev().take_while(|n| worst[*n] <= 0.4).last().unwrap();
    assert_eq!(robust.index, wanted as u64);
    assert!(robust.larger.failed.is_none() && robust.index > 2);
}

#[test]
fn a_robust_answer_is_the_cheapest_whose_larger_ones_all_meet_the_tolerances() {
    for scene in 0..4 {
        let mut words = Words::new(8, 8, scene);
        let base = toy();
        let axes = ["interpolation=0..6", "guard=0..2", "edge-width=5..11"];
        let sweep = sweep(&base, &axes, random_triangles(&mut words, &base));
        let mut asked = request(&sweep, &["misclassified=0", "wraps=0", "depth-worst=0.6"], "area");
        asked.robust = true;
        let all = records(&sweep, 2);
        let meets = |record: &Record| {
            asked.tolerances.iter().all(|t| t.metric.of(record).unwrap() <= t.limit)
        };
        let bits = |record: &Record, name: &str| {
            record.budget.iter().find(|(n, _)| *n == name).unwrap().1.clone()
        };
        let names = ["interpolation", "guard", "edge-width"];
        let robust = |record: &&Record| {
            let larger = |other: &&Record| names.iter().all(|n| bits(other, n) >= bits(record, n));
            all.iter().filter(larger).all(meets)
        };
        let key = |record: &Record| (record.cost.ripple.area_um2, record.index);
        let wanted = all
            .iter()
            .filter(robust)
            .min_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.cmp(&key(b).1)));
        assert_eq!(answer(&asked), wanted.map(|record| record.index), "scene {scene}");
    }
}

#[test]
fn a_witness_is_a_triangle_that_the_model_draws_wrong() {
    let mut base = load("sgi-4k").unwrap();
    base.window = WindowConfig { width: 64, height: 64 };
    let sweep = builtin(&base, &["edge-width=10..25", "interpolation=0..10", "guard=0..2"], "knot");
    let request = request(&sweep, &["misclassified=0", "wraps=0", "depth-worst=0.5"], "area");
    let best = fit(&request, &|| true).unwrap().unwrap().best.unwrap();
    let mut fields = Vec::new();
    for lesser in &best.lesser {
        let (field, witness) = match lesser {
            Lesser::Fails(field, witness) => (field, witness),
            Lesser::Impossible(field, _) => {
                assert_eq!(field.name(), "guard", "no other field is down to nothing");
                continue;
            }
            Lesser::Meets(field) => panic!("{}: cheaper, and it meets", field.name()),
        };
        fields.push(field.name());
        let place = witness.place.unwrap();
        let profile = sweep.space.with(&best.profile, *field, &witness.value).unwrap();
        let model = Model::new(&profile).unwrap();
        let triangle = model.snap(&sweep.scenes[0].triangle(place.triangle, &profile)).unwrap();
        let mut drawing = Drawing::default();
        model.draw(&triangle, &mut drawing).unwrap();
        let row = drawing.spans.iter().filter(|span| span.y == place.y);
        let is_drawn = row.clone().any(|span| (span.x0..span.x1).contains(&place.x));
        let at = profile.grid().unwrap().position(place.x.into(), place.y.into());
        let belongs = guardbit::exact::covers(triangle.xy, at, guardbit::exact::Rule::TopLeft);
        match place.what {
            What::Missing => assert!(belongs && !is_drawn),
            What::Extra => assert!(!belongs && is_drawn),
            What::Ulp(ulp) => {
                assert!(belongs && is_drawn && ulp.abs() > 0.5);
                // The accumulator was off by that much, so the code it is cut to is, but for 1.
                let exact = guardbit::exact::plane_at(triangle.xy, triangle.z.unwrap(), at);
                let exact = exact.unwrap();
                let exact = exact.numer().to_f64().unwrap() / exact.denom().to_f64().unwrap();
                let before =
                    drawing.spans.iter().take_while(|span| (span.y, span.x1) <= (place.y, place.x));
                let skipped: u32 = before.map(|span| span.x1 - span.x0).sum();
                let first = row.clone().find(|span| span.x1 > place.x).unwrap().x0;
                let code = drawing.depth[(skipped + place.x - first) as usize];
                #[allow(clippy::cast_precision_loss, reason = "a depth code of 24 bits")]
                let off = code as f64 - exact;
                assert!(off <= ulp + 1e-9 && off > ulp - 1.0 - 1e-9, "{off} {ulp}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(fields, ["edge-width", "interpolation"]);
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let base = toy();
    let mut words = Words::new(5, 5, 5);
    for space in SPACES {
        let sweep = sweep(&base, space, random_triangles(&mut words, &base));
        let text = |threads| serde_json::to_string(&records(&sweep, threads)).unwrap();
        assert_eq!(text(1), text(2));
        assert_eq!(text(1), text(5));
    }
}

#[test]
fn a_front_is_what_nobody_beats() {
    let base = toy();
    let mut words = Words::new(6, 6, 6);
    let sweep = sweep(&base, SPACES[3], random_triangles(&mut words, &base));
    let mut all = records(&sweep, 2);
    let objectives: Vec<Metric> = ["area", "depth-rms", "snap-misclassified"]
        .into_iter()
        .map(|name| Metric::find(name).unwrap())
        .collect();
    pareto::mark(&mut all, &objectives);
    let figures = |record: &Record| -> Vec<f64> {
        objectives.iter().map(|metric| metric.of(record).unwrap()).collect()
    };
    for record in &all {
        let own = figures(record);
        let beaten = all.iter().map(figures).any(|other| {
            let pairs = || other.iter().zip(&own);
            pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
        });
        assert_eq!(record.pareto, !beaten, "{own:?}");
    }
    assert!(all.iter().any(|r| r.pareto) && all.iter().any(|r| !r.pareto));
}

#[test]
fn numbers_and_choices_are_each_others_inverse_and_groups_share_the_space_out() {
    let sweep = sweep(&toy(), SPACES[2], vec![]);
    let space = &sweep.space;
    assert_eq!(space.len(), 2 * 5 * 3 * 2);
    for index in 0..space.len() {
        assert_eq!(space.index(&space.choices(index)), index);
    }
    // Under an edge function the fraction of a walk is no field: its further values are no budgets.
    let again = (0..space.len()).filter(|n| matches!(space.point(*n).unwrap(), Point::Again));
    assert_eq!(again.count(), 4 * 3 * 2);
    let mut seen: Vec<u64> = space
        .groups(Level::Stage)
        .into_iter()
        .flat_map(|group| space.members(group, Level::Stage, Level::Coverage))
        .flat_map(|group| space.members(group, Level::Coverage, Level::Value))
        .collect();
    seen.sort_unstable();
    assert_eq!(seen, (0..space.len()).collect::<Vec<_>>());
}

#[test]
fn an_edge_width_follows_the_grid_unless_it_is_varied() {
    let widths = |axes: &[&str]| -> Vec<String> {
        let sweep = sweep(&toy_exact(), axes, vec![]);
        let budgets = (0..sweep.space.len()).map(|n| match sweep.space.point(n).unwrap() {
            Point::Budget(profile) => *profile,
            other => panic!("{other:?}"),
        });
        budgets
            .map(|p| guardbit::explore::field::Field::EDGE_WIDTH.read(&p).unwrap().to_string())
            .collect()
    };
    // 2k + s + 1 for k = 3.
    assert_eq!(widths(&["sub-pixel=1..4"]), ["8", "9", "10", "11"]);
    assert_eq!(widths(&["edge-width=7,exact", "sub-pixel=1,2"]), ["7", "7", "8", "9"]);
}

/// [`toy`] with the edge width that its grid and window need.
fn toy_exact() -> Profile {
    let text = toy().to_toml().replace("width = 6", "width = 9");
    let profile = parse(&text, "toy").unwrap();
    assert_eq!(profile.exact_edge_width(), Some(9));
    profile
}

#[test]
fn what_is_no_space_says_why() {
    let parsed = |text: &str| Axis::parse(text).unwrap_err().to_string();
    assert!(parsed("interpolation=9..3").contains("interpolation=3..9"));
    assert!(parsed("interpolaton=3").contains("interpolation"));
    assert!(parsed("rounding=up").contains("nearest-even"));
    assert!(parsed("guard").contains("interpolation=8..14"));
    assert!(parsed("guard=").contains("an axis is FIELD=VALUES"));
    assert!(parsed("guard=0..4000000000").contains("256"));
    assert!(parsed("guard=-1").contains("number of bits"));
    let space = |axes: &[&str]| {
        let axes = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
        Space::new(toy(), axes)
    };
    assert_eq!(space(&["guard=1", "guard=2"]), Err(SpaceError::Twice("guard")));
    let message = space(&["walk-fraction=1..3"]).unwrap_err().to_string();
    assert!(message.contains("does not have this field"), "{message}");
    let message = space(&["interpolation=119..125"]).unwrap_err().to_string();
    assert!(message.contains("none of the 7 budgets") && message.contains("120"), "{message}");
    // What is invalid in part is searched in part.
    assert!(space(&["interpolation=3,125"]).is_ok());
}

/// Fourteen triangles in half pixels: an edge walk of one fraction bit loses samples at which depth
/// leaves its range, and no sample that it draws does.
const UNDRAWN: [[[i128; 3]; 3]; 14] = [
    [[7, 8, 7], [0, 0, 7], [8, 8, 7]],
    [[1, 7, 3], [2, 8, 7], [2, 8, 3]],
    [[2, 0, 5], [0, 4, 7], [2, 1, 0]],
    [[5, 5, 0], [0, 3, 0], [0, 7, 3]],
    [[2, 0, 0], [5, 2, 0], [4, 4, 7]],
    [[4, 7, 7], [8, 0, 0], [1, 6, 7]],
    [[7, 4, 0], [4, 0, 0], [5, 3, 0]],
    [[8, 5, 7], [0, 1, 5], [4, 2, 7]],
    [[4, 7, 7], [5, 8, 7], [6, 1, 0]],
    [[8, 2, 7], [6, 7, 1], [6, 6, 3]],
    [[4, 7, 3], [7, 8, 5], [6, 3, 0]],
    [[2, 4, 7], [0, 6, 7], [3, 6, 3]],
    [[6, 6, 0], [4, 2, 0], [3, 0, 0]],
    [[5, 4, 3], [5, 6, 0], [0, 1, 7]],
];

/// The order of surfaces counts at samples that are not drawn, too: guard bits that hold every value
/// drawn are not alike when they do not hold those.
#[test]
fn guard_bits_decide_the_order_at_samples_that_are_not_drawn() {
    let triangle = |v: [[i128; 3]; 3]| scene::Triangle::Lattice {
        xy: v.map(|[x, y, _]| [x, y]),
        z: Some(v.map(|[.., z]| z)),
    };
    let base = load("tiny").unwrap();
    let swept = |guard: &str| {
        let axes = ["form=edge-walk", "walk-fraction=1", "interpolation=0", guard];
        sweep(&base, &axes, UNDRAWN.map(triangle).to_vec())
    };
    let inversions = |sweep: &Sweep| -> Vec<u64> {
        let of = |record: &Record| record.accuracy.arithmetic.inversions;
        records(sweep, 1).iter().map(of).collect()
    };
    let each: Vec<u64> =
        ["guard=0", "guard=1", "guard=2"].iter().flat_map(|g| inversions(&swept(g))).collect();
    assert!(each[0] > each[1], "{each:?}");
    let all = swept("guard=0..2");
    assert_eq!(inversions(&all), each);
    let limit = format!("inversions={}", each[1]);
    assert_eq!(answer(&request(&all, &[&limit], "area")), Some(1));
}
