//! The x of a walked edge at the ends of its word, by every clamp.

use super::toy::parse;
use guardbit::exact::{Rule, covers};
use guardbit::model::{Drawing, Model};
use guardbit::setup::Triangle;

fn walk(vertex: &str, window: [u32; 2], walk: &str) -> Model {
    let text = format!(
        "schema = 1\nname = \"walk\"\n[window]\nwidth = {}\nheight = {}\n[vertex]\n{vertex}signed = true\n\
         closed = false\nsnap = \"floor\"\nsource = \"f64\"\nendless = \"refuse\"\n[form.edge-walk]\n{walk}",
        window[0], window[1]
    );
    Model::new(&parse(&text).unwrap()).unwrap()
}

fn drawn(model: &Model, xy: [[i128; 2]; 3]) -> Result<Drawing, String> {
    let mut drawing = Drawing::default();
    let triangle = model.place(Triangle { xy, z: None }).unwrap();
    model.draw(&triangle, &mut drawing).map_err(|error| error.to_string())?;
    Ok(drawing)
}

/// The number of the range `low..low + 2^bits` that equals x mod 2^bits.
fn representative(x: i128, low: i128, bits: u32) -> i128 {
    (low..low + (1 << bits)).find(|value| (value - x) % (1 << bits) == 0).unwrap()
}

/// Clauses K-3 and V-2: every left and right x of a row, by every clamp of every small word, in quarters of a
/// pixel: the word's representative decides the pixel, and an x outside the range is a wrap.
#[test]
fn a_walked_x_is_what_its_clamp_says() {
    let mut seen = [0u32; 3];
    for (guard, integer) in [(0u32, 3u32), (1, 2), (1, 3), (2, 2)] {
        for clamp in ["guard", "sign", "wrap", "error"] {
            let word = format!(
                "guard = {guard}\ninteger = {integer}\nfraction = 2\nrounding = \"floor\"\nclamp = \"{clamp}\"\n"
            );
            let model = walk("integer = 5\nsub-pixel = 1\n", [8, 1], &word);
            let (top, bits) = (1i128 << (integer + 2), guard + integer + 2);
            let (low, bits) = match clamp {
                "sign" => (-(1 << (bits - 1)), bits),
                "wrap" => (0, integer + 2),
                // The signed range, half of the integers up.
                _ => (top / 2 - (1 << (bits - 1)), bits),
            };
            for (x, far) in (-32..32).flat_map(|x| (x + 1..32).map(move |far| (x, far))) {
                // The row's sample is half a pixel down: there the right edge is half way.
                let got = drawn(&model, [[x, 0], [far, 0], [x, 2]]);
                let ends = [2 * x, x + far];
                let read = ends.map(|x| representative(x, low, bits));
                let wraps = (0..2).filter(|n| read[*n] != ends[*n]).count() as u64;
                if clamp == "error" && wraps > 0 {
                    assert!(got.is_err(), "{x} {far}");
                    seen[2] += 1;
                    continue;
                }
                let got = got.unwrap();
                // ceil(x - 1/2), and the window.
                let pixel = |x: i128| (x - 2 + 3).div_euclid(4).clamp(0, 8);
                let [from, to] = read.map(pixel);
                let spans: Vec<[i128; 2]> =
                    got.spans.iter().map(|span| [span.x0.into(), span.x1.into()]).collect();
                let wanted = if from < to { vec![[from, to]] } else { Vec::new() };
                assert_eq!(spans, wanted, "{clamp} {guard}+{integer} {x} {far}");
                let counted: u64 = got.event_counts().map(|(_, count)| count).sum();
                assert_eq!(counted, wraps, "{clamp} {guard}+{integer} {x} {far}");
                seen[usize::from(wraps > 0)] += 1;
            }
        }
    }
    assert!(seen.iter().all(|count| *count > 1000), "{seen:?}");
}

/// Clauses K-3 and K-6: a vertex at -40000 and a word of 16.16: lost without a sign, and told; in two's complement
/// with a guard bit it is drawn as the exact triangle is.
#[test]
fn a_vertex_far_to_the_left_is_drawn_in_twos_complement() {
    let vertex = "integer = 17\nsub-pixel = 4\n";
    let word = |guard, clamp| {
        format!(
            "guard = {guard}\ninteger = 16\nfraction = 16\nrounding = \"nearest-even\"\nclamp = \"{clamp}\"\n"
        )
    };
    let xy = [[-640_000, 3], [900, 3], [900, 997]];
    let lost = drawn(&walk(vertex, [64, 64], &word(0, "guard")), xy).unwrap();
    assert!(lost.event_counts().any(|(name, count)| name == "wrap" && count > 0));
    let model = walk(vertex, [64, 64], &word(1, "sign"));
    let got = drawn(&model, xy).unwrap();
    assert_eq!(got.event_counts().count(), 0);
    for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let at = [i128::from(x) * 16 + 8, i128::from(y) * 16 + 8];
        let is_in = |s: &guardbit::model::Span| s.y == y && (s.x0..s.x1).contains(&x);
        assert_eq!(got.spans.iter().any(is_in), covers(xy, at, Rule::TopLeft), "{x} {y}");
    }
    assert!(lost.samples() < got.samples(), "{} {}", lost.samples(), got.samples());
    // What a budget says of both.
    let range = |model: &Model| {
        let words = model.profile().form.words(&model.profile().state());
        let facts = words.into_iter().flat_map(|word| word.facts);
        facts.filter(|fact| fact.name == "range").map(|fact| fact.value).collect::<String>()
    };
    let text = range(&walk(vertex, [64, 64], &word(0, "guard")));
    assert!(text.contains("0 <= x < 65536 pixels; vertices reach -65536"), "{text}");
    assert_eq!(range(&model), "-65536 <= x < 65536 pixels");
}
