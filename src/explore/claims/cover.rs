//! Coverage: edges shared without holes, and a figure-sized example.

use super::edge_word::inside;
use super::statement::Statement;
use crate::exact::{Rule, classify, covers};
use crate::setup::Triangle;

/// Direct3D-sized example: triangles in quarter pixels, and the pixels each covers.
const FIGURE: [([[i128; 2]; 3], usize); 14] = [
    ([[4, 4], [24, 8], [8, 16]], 7),
    ([[21, 5], [25, 1], [25, 5]], 0),
    ([[26, 6], [30, 2], [30, 6]], 0),
    ([[39, 3], [31, 10], [47, 10]], 2),
    ([[31, 10], [47, 10], [38, 21]], 8),
    ([[4, 24], [28, 16], [20, 24]], 4),
    ([[28, 16], [20, 24], [32, 28]], 5),
    ([[28, 16], [38, 22], [32, 28]], 3),
    ([[46, 18], [50, 22], [46, 26]], 1),
    ([[60, 0], [54, 6], [58, 10]], 3),
    ([[54, 6], [58, 10], [58, 18]], 0),
    ([[54, 22], [62, 22], [54, 30]], 3),
    ([[62, 22], [62, 30], [54, 30]], 1),
    ([[38, 30], [42, 30], [38, 38]], 2),
];

pub(super) fn statements() -> Vec<Statement> {
    let expected: Vec<String> = FIGURE.iter().map(|(_, n)| n.to_string()).collect();
    let row = format!("{}; 39 in all", expected.join(" "));
    let by_edges = |xy, p| inside(&Triangle { xy, z: None }, p);
    let by_crossings = |xy, p: [i128; 2]| covers(xy, p, Rule::TopLeft);
    vec![
        Statement::exact(
            "cover.offset-grid",
            "an offset of the sample grid keeps samples off the vertices but not off the edges: \
             sample (1/2, 1/2) lies on an edge of triangle (0,0) (1,1) (0,1)",
            "OnEdge",
            || format!("{:?}", classify([[0, 0], [2, 2], [0, 2]], [1, 1])),
        ),
        Statement::exact(
            "cover.figure",
            "number of pixels of 14 triangles with quarter-pixel vertices and the top-left rule, \
             computed with biased edge functions",
            &row,
            move || counts(by_edges),
        ),
        Statement::exact(
            "cover.figure-exact",
            "number of pixels of the same triangles, computed with exact row crossings",
            &row,
            move || counts(by_crossings),
        )
        .slow(),
        Statement::exact(
            "cover.shared-edge",
            "two triangles on the two sides of a shared edge cover each centre strictly between the \
             ends of the edge exactly once; tested for every such pair on a 5 x 5 half-pixel \
             lattice and each winding; number of holes + double hits",
            "0 + 0",
            shared_edges,
        )
        .slow(),
    ]
}

fn counts(covered: impl Fn([[i128; 2]; 3], [i128; 2]) -> bool) -> String {
    let counts = FIGURE.map(|(xy, _)| {
        // Sixteen by ten pixels of four quarters, centres at 2.
        (0..160).filter(|n| covered(xy, [4 * (n % 16) + 2, 4 * (n / 16) + 2])).count()
    });
    let texts = counts.map(|n| n.to_string());
    format!("{}; {} in all", texts.join(" "), counts.iter().sum::<usize>())
}

fn shared_edges() -> String {
    let lattice = || (0..25_i128).map(|n| [n % 5, n / 5]);
    let (mut holes, mut doubles) = (0, 0);
    let area = |xy| Triangle { xy, z: None }.area2();
    for a in lattice() {
        for b in lattice() {
            // Odd lattice points are centres; only those on the edge itself are in question.
            let on_edge: Vec<[i128; 2]> = lattice()
                .filter(|[x, y]| x % 2 == 1 && y % 2 == 1)
                .filter(|p| area([a, b, *p]) == 0 && strictly_between(a, *p, b))
                .collect();
            if on_edge.is_empty() {
                continue;
            }
            for c in lattice().filter(|c| area([a, b, *c]) > 0) {
                for d in lattice().filter(|d| area([a, b, *d]) < 0) {
                    for (other, p) in [[a, b, d], [b, a, d]]
                        .into_iter()
                        .flat_map(|other| on_edge.iter().map(move |p| (other, *p)))
                    {
                        let hits = [[a, b, c], other]
                            .into_iter()
                            .filter(|xy| inside(&Triangle { xy: *xy, z: None }, p))
                            .count();
                        holes += usize::from(hits == 0);
                        doubles += usize::from(hits > 1);
                    }
                }
            }
        }
    }
    format!("{holes} + {doubles}")
}

fn strictly_between(a: [i128; 2], p: [i128; 2], b: [i128; 2]) -> bool {
    let [u, v] = [a, b].map(|end| [end[0] - p[0], end[1] - p[1]]);
    u[0] * v[0] + u[1] * v[1] < 0
}
