//! Stimulus of the benches that are no triangles: directed classes and random tests.

use super::ShapeKind;
use crate::case::{Class, Words};
use crate::format::{Column, Role, WordFormat};
use crate::model::Model;
use crate::profile::Profile;

/// Extent of a random shape, in pixels.
const REACH: i64 = 24;

/// Classes with their tests, each the words of its vertices.
type Classes = Vec<(Class, Vec<Vec<i128>>)>;

/// The vertex columns of a kind.
pub(super) fn columns(kind: ShapeKind, model: &Model, has_depth: bool) -> Vec<Column> {
    let (profile, line) = (model.profile(), &model.line_ports().input);
    let field = &line[0];
    let depth = profile.depth.map_or(0, |depth| depth.integer);
    let w = profile.form.w_bits().filter(|_| kind == ShapeKind::Clip).map_or(0, |w| w + 1);
    let place = if w > 0 {
        WordFormat::signed(field.width + w + 1)
    } else if field.signed {
        WordFormat::signed(field.width)
    } else {
        WordFormat::unsigned(field.width)
    };
    let place = place.fraction(profile.vertex.sub_pixel);
    let z = if w > 0 { WordFormat::signed(depth + w + 1) } else { WordFormat::unsigned(depth) };
    let vertex = |n: usize| {
        let mut columns: Vec<Column> =
            [Role::VERTEX_X, Role::VERTEX_Y].map(|role| role.of(n, place)).to_vec();
        columns.extend(has_depth.then(|| Role::VERTEX_Z.of(n, z)));
        if w > 0 {
            for column in &mut columns {
                column.meaning = format!("{}, times W.", column.meaning.trim_end_matches('.'));
            }
            columns.push(Role::VERTEX_W.of(n, WordFormat::signed(w + 1)));
        }
        columns
    };
    (0..kind.vertices()).flat_map(vertex).collect()
}

/// Directed classes around the upper left part of the window; what does not fit the vertex field is left
/// out.
pub(super) fn directed(kind: ShapeKind, profile: &Profile, has_depth: bool) -> Classes {
    let one = 1i128 << profile.vertex.sub_pixel;
    let middle = [profile.window.width, profile.window.height]
        .map(|side| i128::from(side.min(20) / 2) * one + one / 2);
    let quarters: Vec<i128> = (0..=4).map(|part| part * one / 4 - one / 2).collect();
    let places: Vec<[i128; 2]> =
        quarters.iter().flat_map(|x| quarters.iter().map(move |y| [*x, *y])).collect();
    let at = |[x, y]: [i128; 2]| [middle[0] + x, middle[1] + y];
    let mut list = match kind {
        ShapeKind::Point => {
            let catches = "a floor for a ceiling, or another end of the pixel";
            let all = places.iter().map(|place| at(*place).to_vec());
            vec![(Class { tag: "borders", catches }, all.collect())]
        }
        ShapeKind::Line => lines(one, &places, at),
        ShapeKind::Quad => quads(profile, one, has_depth, at),
        ShapeKind::Clip => clips(profile, one, has_depth, at),
    };
    if kind != ShapeKind::Clip {
        let (low, high) = profile.vertex.range();
        let stride = if has_depth { 3 } else { 2 };
        for (_, tests) in &mut list {
            tests.retain(|words: &Vec<i128>| {
                words.chunks(stride).all(|v| v[..2].iter().all(|c| (low..=high).contains(c)))
            });
        }
    }
    list.retain(|(_, tests)| !tests.is_empty());
    list
}

fn lines(one: i128, places: &[[i128; 2]], at: impl Fn([i128; 2]) -> [i128; 2]) -> Classes {
    let line = |a: [i128; 2], b: [i128; 2]| [at(a), at(b)].concat();
    let steps = [[7, 0], [7, 3], [7, 7], [3, 7], [6, 2], [8, 4], [9, 1]];
    let signs = [[1, 1], [1, -1], [-1, 1], [-1, -1]];
    let octants = steps
        .iter()
        .flat_map(|[x, y]| signs.iter().flat_map(move |[a, b]| [[x * a, y * b], [y * b, x * a]]));
    let octants = octants.map(|[x, y]| line([0, 0], [x * one, y * one])).collect();
    let corners = places.iter().flat_map(|[x, y]| {
        [[one, 0], [one, one / 2], [one, one], [0, one], [-one / 2, one], [one / 4, 0]]
            .map(|[dx, dy]| line([*x, *y], [x + dx, y + dy]))
    });
    let points = places.iter().map(|place| line(*place, *place)).collect();
    let class = |tag, catches| Class { tag, catches };
    vec![
        (
            class(
                "octants",
                "an octant mirrored wrongly, a tie to the other side, a last pixel too many",
            ),
            octants,
        ),
        (
            class("diamond", "a corner or an edge of the diamond that belongs to the other pixel"),
            corners.collect(),
        ),
        (class("no-length", "a line without length that draws"), points),
    ]
}

fn quads(
    profile: &Profile,
    one: i128,
    has_depth: bool,
    at: impl Fn([i128; 2]) -> [i128; 2],
) -> Classes {
    let top = i128::from(profile.depth_max());
    let quad = |corners: [[i128; 2]; 4]| {
        let depths = [0, top, top / 3, top / 2];
        let vertex = |(corner, z): ([i128; 2], i128)| {
            let mut words = at(corner.map(|c| c * one / 2)).to_vec();
            words.extend(has_depth.then_some(z));
            words
        };
        corners.into_iter().zip(depths).flat_map(vertex).collect::<Vec<i128>>()
    };
    let convex = vec![
        quad([[-8, -8], [8, -8], [8, 8], [-8, 8]]),
        quad([[0, -9], [9, 0], [0, 9], [-9, 0]]),
        quad([[-9, -3], [7, -8], [9, 5], [-5, 9]]),
        quad([[-5, 9], [9, 5], [7, -8], [-9, -3]]),
    ];
    let concave =
        vec![quad([[-9, -9], [0, -2], [9, -9], [0, 9]]), quad([[9, 9], [2, 0], [9, -9], [-9, 1]])];
    let crossed =
        vec![quad([[-8, -8], [8, 8], [8, -8], [-8, 8]]), quad([[-9, 0], [9, 1], [-9, 7], [8, -6]])];
    let flat = vec![
        quad([[0, 0]; 4]),
        quad([[-8, 0], [0, 0], [8, 0], [3, 0]]),
        quad([[-8, -8], [8, -8], [8, -8], [-8, 8]]),
        quad([[-8, -8], [0, 0], [8, 8], [-8, 8]]),
    ];
    let class = |tag, catches| Class { tag, catches };
    vec![
        (class("convex", "regions between vertices in the wrong order, or one left out"), convex),
        (class("concave", "a second span of a row that is lost, or joined to the first"), concave),
        (class("crossed", "sides that change places between two rows"), crossed),
        (class("degenerate", "repeated and collinear points that draw, or divide by zero"), flat),
    ]
}

fn clips(
    profile: &Profile,
    one: i128,
    has_depth: bool,
    at: impl Fn([i128; 2]) -> [i128; 2],
) -> Classes {
    let top = i128::from(profile.depth_max());
    // A window position, a part of the depth range in halves, and W.
    let clip = |vertices: [([i128; 2], i128, i128); 3]| {
        let vertex = |(place, z, w): ([i128; 2], i128, i128)| {
            let [x, y] = at(place.map(|c| c * one / 2));
            // With a W of zero it is a direction from the middle of the window's upper left part.
            let scale = if w == 0 { 1 } else { w };
            let mut words = vec![x * scale, y * scale];
            words.extend(has_depth.then_some(z * top / 2 * scale));
            words.push(w);
            words
        };
        vertices.into_iter().flat_map(vertex).collect::<Vec<i128>>()
    };
    let (a, b, c) = ([-9, -7], [8, -5], [-3, 9]);
    let front = vec![
        clip([(a, 0, 1), (b, 1, 1), (c, 2, 1)]),
        clip([(a, 0, 1), (b, 1, 2), (c, 2, 1)]),
        clip([(c, 2, 2), (b, 1, 1), (a, 0, 1)]),
    ];
    let behind = vec![
        clip([(a, 0, 1), (b, 1, 1), (c, 2, -1)]),
        clip([(a, 0, -1), (b, 1, 1), (c, 2, -1)]),
        clip([(a, 0, -1), (b, 1, -1), (c, 2, -1)]),
    ];
    let beside =
        vec![clip([(a, 0, 1), (b, 1, 1), (c, 2, 0)]), clip([(a, 0, 0), (b, 1, 1), (c, 2, 0)])];
    let planes = vec![
        clip([(a, -1, 1), (b, 1, 1), (c, 2, 1)]),
        clip([(a, 0, 1), (b, 3, 1), (c, 2, 1)]),
        clip([(a, -1, 1), (b, -2, 1), (c, -1, 1)]),
    ];
    let class = |tag, catches| Class { tag, catches };
    let mut list = vec![
        (class("in-front", "a weight by W left out, or a determinant of the wrong sign"), front),
        (
            class("behind", "the image of what is behind the eye, drawn as if it were in front"),
            behind,
        ),
        (class("w-zero", "a division by a W of zero"), beside),
    ];
    if has_depth {
        list.push((
            class("clip-planes", "samples before the near or beyond the far plane"),
            planes,
        ));
    }
    list
}

/// A random test around a random place of the window.
pub(super) fn random(
    kind: ShapeKind,
    profile: &Profile,
    has_depth: bool,
    seed: u64,
    index: u64,
) -> Vec<i128> {
    let (class, vertices) = match kind {
        ShapeKind::Line => (5, 2),
        ShapeKind::Point => (6, 1),
        ShapeKind::Quad => (7, 4),
        ShapeKind::Clip => (8, 3),
    };
    let mut words = Words::new(seed, class, index);
    let (low, high) = profile.vertex.range();
    let pixel = 1i64 << profile.vertex.sub_pixel;
    let window = [profile.window.width, profile.window.height];
    let from = window.map(|side| words.between(-pixel, (i64::from(side) + 1) * pixel));
    // Depth codes of 64 bits are drawn from the lower half of their range.
    let top = profile.depth_max().min(i64::MAX.cast_unsigned()).cast_signed();
    let most = profile.form.w_bits().map_or(1, |w| (1i64 << w.min(8)) - 1);
    let mut test = Vec::new();
    for n in 0..vertices {
        let reach = if n == 0 { 0 } else { REACH * pixel };
        let place = from.map(|c| (c + words.between(-reach, reach)).clamp(low, high));
        // Now and then a vertex behind the eye.
        let w = if kind == ShapeKind::Clip { words.between(-(most / 4), most) } else { 1 };
        let scale = if w == 0 { 1 } else { w };
        test.extend(place.map(|c| c * scale));
        test.extend(has_depth.then(|| words.between(0, top) * scale));
        if kind == ShapeKind::Clip {
            test.push(w);
        }
    }
    test
}
