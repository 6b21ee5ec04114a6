//! Orders of visits: what depends on them, and what does not. Spec clauses `O-2` to `O-5`.

use super::draw;
use guardbit::case::Words;
use guardbit::cover::{Order, Stamp, TraversalConfig};
use guardbit::format::Clamp;
use guardbit::model::Model;
use guardbit::profile::load;
use guardbit::scene;
use guardbit::setup::Triangle;

/// Takes down which stamps are visited, in order, over a primitive that is everywhere.
struct Visited(Vec<[u32; 2]>);

impl guardbit::cover::Visitor for Visited {
    fn stamp(&mut self, x: u32, y: u32) -> guardbit::cover::Outside {
        self.0.push([x, y]);
        guardbit::cover::Outside { left: false, right: false }
    }

    fn block(&mut self, _: u32, _: u32, _: u32) -> guardbit::cover::Block {
        guardbit::cover::Block::Partly
    }
}

/// Clause O-4: an accumulator that holds what leaves its range reads by its path; one that wraps
/// does not.
#[test]
fn a_sticky_accumulator_depends_on_the_order() {
    let mut base = load("sgi-4k").unwrap();
    base.window = guardbit::profile::WindowConfig { width: 16, height: 16 };
    // The plane leaves the range right of the diagonal and comes back further down.
    let triangle = Triangle {
        xy: [[0, 0], [16 << 10, 2 << 10], [3 << 10, 16 << 10]],
        z: Some([16_777_215, 16_777_000, 3]),
    };
    let depths = |clamp: Clamp| {
        let seen = |order: Order| {
            let mut profile = base.clone();
            profile.traversal = Some(TraversalConfig { order, stamp: Stamp::One });
            profile.depth.iter_mut().for_each(|depth| depth.clamp = clamp);
            draw(&Model::new(&profile).unwrap(), &triangle).depth
        };
        Order::ALL.map(seen)
    };
    let wrapped = depths(Clamp::Guard);
    assert!(wrapped.iter().all(|depth| *depth == wrapped[0] && depth.len() > 50));
    let sticky = depths(Clamp::Saturate);
    assert!(sticky.iter().any(|depth| *depth != sticky[0]), "some order reads otherwise");
}

/// Clause O-4: an edge walk entered at another row is rounded there, and not where it was walked to.
#[test]
fn a_walked_edge_depends_on_where_it_is_entered() {
    let base = load("sgi-4k").unwrap();
    let (grid, walked) = (base.grid().unwrap(), base.with_machine("edge-walk").unwrap());
    let walk = walked.form.walk().unwrap();
    let mut differ = 0;
    for index in 0..200 {
        let mut words = Words::new(6, 1, index);
        let to = [words.between(0, 1 << 22), words.between(1 << 21, 1 << 22)];
        let edge = walk.edge([512, 0], to, &grid).unwrap();
        let row = edge.first_row + 100;
        let entered = guardbit::exact::edge_x([512, 0], to, grid.position(0, row)[1]).unwrap();
        let scale = guardbit::exact::dyadic(1, grid.sub_pixel);
        let unit = guardbit::exact::integer(1 << walk.fraction);
        let entered = guardbit::exact::round(&(entered * scale * unit), walk.rounding);
        differ += u32::from(entered != (edge.start + edge.slope * 100).into());
    }
    assert!(differ > 100, "{differ}");
}

/// Clauses O-2 and O-3: every order visits every stamp of a box that is covered everywhere, the plain
/// one row by row, the curves by their definition.
#[test]
fn orders_visit_what_they_are_defined_to() {
    for stamp in Stamp::ALL {
        let [width, height] = stamp.size();
        for order in Order::ALL {
            let mut visited = Visited(Vec::new());
            TraversalConfig { order, stamp }.visit([5, 3, 21, 19], &mut visited);
            let mut once = visited.0.clone();
            once.sort_unstable_by_key(|[x, y]| (*y, *x));
            once.dedup();
            let rows = (3 / height..19u32.div_ceil(height)).map(|y| y * height);
            let all: Vec<[u32; 2]> = rows
                .flat_map(|y| (5 / width..21u32.div_ceil(width)).map(move |x| [x * width, y]))
                .collect();
            assert_eq!(once, all, "{order:?} {stamp:?}");
            if order == Order::BoundingBox {
                assert_eq!(visited.0, all);
            }
        }
    }
    let path = |order| {
        let mut visited = Visited(Vec::new());
        TraversalConfig { order, stamp: Stamp::One }.visit([0, 0, 16, 16], &mut visited);
        visited.0
    };
    let hilbert = path(Order::Hilbert);
    assert_eq!((hilbert[0], hilbert[255]), ([0, 0], [15, 0]));
    let near = |w: &[[u32; 2]]| w[0][0].abs_diff(w[1][0]) + w[0][1].abs_diff(w[1][1]) == 1;
    assert!(hilbert.windows(2).all(near), "each next to the one before");
    for (n, [x, y]) in path(Order::Morton).into_iter().enumerate() {
        let interleaved = (0..4).fold(0, |sum, bit| {
            sum | (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1)
        });
        assert_eq!(n as u32, interleaved);
    }
    let zigzag = path(Order::Zigzag);
    assert!(zigzag.windows(2).all(near), "nothing is gone back over");
}

/// Clause O-5: bins one after another, each with all triangles, leave the depth buffer and the
/// drawing order of every pixel as triangles one after another do.
#[test]
fn bins_over_a_scene_end_in_the_same_depth_buffer() {
    let mut profile = load("sgi-4k").unwrap();
    profile.window = guardbit::profile::WindowConfig { width: 96, height: 64 };
    let whole = Model::new(&profile).unwrap();
    let scene = scene::load("knot", &whole.viewport()).unwrap();
    let triangles: Vec<Triangle> =
        scene.triangles.iter().map(|triangle| *whole.snap(triangle).unwrap()).collect();
    let render = |bins: &[guardbit::cover::Rect]| {
        let mut pixels = vec![(u64::MAX, usize::MAX); 96 * 64];
        for bin in bins {
            let view = guardbit::model::View { scissor: Some(*bin), ..Default::default() };
            let model = Model::with_view(&profile, view).unwrap();
            for (n, triangle) in triangles.iter().enumerate() {
                let drawing = draw(&model, triangle);
                let mut depths = drawing.depth.iter();
                for span in &drawing.spans {
                    for x in span.x0..span.x1 {
                        let z = *depths.next().unwrap();
                        let pixel = &mut pixels[(span.y * 96 + x) as usize];
                        if z < pixel.0 {
                            *pixel = (z, n);
                        }
                    }
                }
            }
        }
        pixels
    };
    let bins: Vec<guardbit::cover::Rect> = (0..2)
        .flat_map(|y| (0..3).map(move |x| (x * 32, y * 32)))
        .map(|(x, y)| guardbit::cover::Rect { x0: x, y0: y, x1: x + 32, y1: y + 32 })
        .collect();
    let one = render(&[profile.window().unwrap()]);
    assert!(one.iter().filter(|(_, n)| *n != usize::MAX).count() > 1000);
    assert_eq!(render(&bins), one);
}
