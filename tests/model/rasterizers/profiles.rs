//! The built-in profiles of real rasterizers: what a file of theirs has, what they draw through a host, and
//! what is refused.

use guardbit::model::{Drawing, Model, View};
use guardbit::profile::{BUILTIN, Form, load, parse};
use guardbit::scene::Triangle;
use guardbit::vector::bench::{Bench as _, RegisterBench, Source, TestAt};
use std::collections::BTreeSet;

/// Clause RG-21: each file is at most 60 lines and says what it was held against.
#[test]
fn files_are_short_and_name_their_oracle() {
    let mut real = 0;
    for (name, text) in BUILTIN {
        assert!(text.lines().count() <= 60, "{name}");
        let head: String = text.lines().take_while(|line| line.starts_with('#')).collect();
        let says = head.contains("Oracle: ") || head.contains("Source: ");
        real += u32::from(says);
        assert!(!matches!(load(name).unwrap().form, Form::Registers(_)) || says, "{name}");
    }
    assert_eq!(real, 22, "17 register machines, 4 of Vulkan, Larrabee");
}

/// Clause RG-4: through its host every machine draws every triangle, but for samples near an edge: what lies a
/// pixel and a half inside is there, what lies so far outside is not. A machine that draws lines draws the edges.
#[test]
fn a_host_draws_what_the_exact_triangle_covers() {
    let view = View { window: Some((64, 64)), ..View::default() };
    for (name, _) in BUILTIN {
        let profile = load(name).unwrap();
        if !matches!(profile.form, Form::Registers(_)) {
            continue;
        }
        let model = Model::with_view(&profile, view).unwrap();
        let mut words = guardbit::case::Words::new(3, 0, 0);
        let (lines, mut samples) = (name.ends_with("-line"), 0);
        // A line rounds, as do the edges of a fan, and filler pixels lie beside it.
        let near = if lines || name == "saturn-quad" { 40 } else { 24 };
        for case in 0..60 {
            // In 1/16 pixel.
            let xy: [[i128; 2]; 3] =
                std::array::from_fn(|_| std::array::from_fn(|_| words.between(0, 63 * 16)));
            let real = |value: i128| f64::from(i32::try_from(value).unwrap()) / 16.0;
            let triangle = Triangle::Real { xy: xy.map(|at| at.map(real)), z: None };
            let triangle = model.snap(&triangle).unwrap();
            let mut drawing = Drawing::default();
            model.draw(&triangle, &mut drawing).unwrap();
            let drawn: BTreeSet<(u32, u32)> = drawing
                .spans
                .iter()
                .flat_map(|span| (span.x0..span.x1).map(|x| (x, span.y)))
                .collect();
            samples += drawn.len();
            for (y, x) in (0..64).flat_map(|y| (0..64).map(move |x| (y, x))).step_by(3) {
                let centre = [x, y].map(|at| i128::from(at) * 16 + 8);
                let is_drawn = drawn.contains(&(x, y));
                assert!(
                    is_drawn != lines || !within(&xy, centre, near),
                    "{name}, case {case}: {x} {y} in the middle of {xy:?}"
                );
                assert!(
                    !is_drawn || within(&xy, centre, -near),
                    "{name}, case {case}: {x} {y} of {xy:?}"
                );
            }
        }
        assert!(samples > if lines { 4000 } else { 10_000 }, "{name}: {samples}");
    }
}

/// Whether a point lies on the inner side of all edges moved inward by so much, or more where they are
/// aslant; either winding.
fn within(xy: &[[i128; 2]; 3], at: [i128; 2], inward: i128) -> bool {
    let area = (xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1])
        - (xy[2][0] - xy[0][0]) * (xy[1][1] - xy[0][1]);
    (0..3).all(|k| {
        let (p, q) = (xy[k], xy[(k + 1) % 3]);
        let side = (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]);
        side * area.signum() >= inward * ((q[0] - p[0]).abs() + (q[1] - p[1]).abs())
    })
}

/// A change of a built-in profile, and the reason why it is refused; none if it is taken.
type Case = (&'static str, &'static str, &'static str, &'static str);

/// Each case is refused for its reason, at a place of the file, or taken.
pub(super) fn refused(cases: &[Case]) {
    for &(name, from, to, reason) in cases {
        let text = BUILTIN.iter().find(|(known, _)| *known == name).unwrap().1;
        assert!(text.contains(from), "{name}: {from}");
        let changed = parse(&text.replacen(from, to, 1), "changed.toml");
        match changed {
            Ok(_) => assert!(reason.is_empty(), "{name}: {to} was taken"),
            Err(error) => {
                let text = error.to_string();
                assert!(!reason.is_empty() && text.contains(reason), "{name}, {to}: {text}");
                assert!(text.starts_with("changed.toml:"), "{text}");
            }
        }
    }
}

/// Clause RE-10: parts of edge functions without a meaning together, and numbers that do not fit.
#[test]
fn parts_without_a_meaning_are_refused() {
    let cases = [
        ("rasterix", "{ given = {} }\nbox", "{ vertices = {} }\nbox", "needs a register \"x0\""),
        ("rasterix", "width = 32\n", "width = 65\n", "width = 65: an edge word has 2 to 64 bits"),
        ("rasterix", "width = 32\n", "width = 32\nwinding = \"both\"\n", "given edges have none"),
        (
            "rasterix",
            "width = 32\n",
            "width = 32\nwithout-area = \"skip\"\n",
            "given edges have none",
        ),
        ("rasterix", "width = 32\n", "width = 32\nrule = \"truncated-side\"\n", "edges are given"),
        (
            "rasterix",
            "box = { given = \"half-open\" }",
            "box = { vertices = {} }",
            "and edges are given",
        ),
        ("rasterix", "values = { given = {} }", "", "say where channels come from with `values`"),
        (
            "rasterix",
            "values = { given = {} }",
            "values = { planes = { divide = { quotient = \"floor\" } } }",
            "values are set up from vertices, and edges are given",
        ),
        ("rasterix", "left:11", "left:11 left[11]:5@11 left[16]:1@27", "at most 16 are possible"),
        ("rasterix", "\"s\"], guard", "\"e1\"], guard", "the engine has a value of this name"),
        ("graphite", "bits = 12, ", "", "a pixel number has 1 to 17 bits; give `bits`"),
        ("graphite", "size = [128, 128]", "size = [128, 0]", "1 to 65536 pixels"),
        ("graphite", "product-cut = 14 }", "product-cut = 41 }", "product-cut + cut = 41 <= 40"),
        (
            "picogs",
            "integer = 10",
            "integer = 9",
            "has 10 bits, and a vertex integer + sub-pixel = 9",
        ),
        ("graphite", "scale = 63", "scale = 0", "1 <= scale = 0 <= 2^16"),
        ("graphite", "scale = 63", "slope-width = 9", "no effect on weighted values"),
        ("graphite", "scale = 63", "drop = 1", "drop and shift-along are for slopes"),
        ("graphite", "scale = 63", "correction = 1", "no effect without sub-scanlines"),
        ("graphite", "numerator = 29", "numerator = 61", "numerator = 61 <= 60"),
        (
            "graphite",
            "{ reciprocal = { numerator = 29, drop = 7, zero = 0x400000 } }",
            "{ quotient = \"floor\" }",
            "no effect on an exact quotient",
        ),
        (
            "graphite",
            "fraction = 14",
            "fraction = 90",
            "weight + register + shift + 1 = 133 <= 126",
        ),
        ("picogs", "limit = \"exponent-registers\", ", "", "hold-both = true has no effect"),
        ("picogs", "product = 47", "product = 129", "2 <= product <= 128"),
        ("picogs", "fraction = 16", "fraction = 7", "interpolation = 8 <= fraction = 7"),
        ("picogs", "index = 9", "index = 0", "index = 0 from 1 to 16"),
        ("picogs", "fraction = 16", "start = \"vertex\", fraction = 16", "slope-width needs start"),
        ("picogs", "slope-width = 16", "slope-width = 25", "slope-width = 25 <= width = 24"),
        ("picogs", "replicate = 12", "replicate = 7", "integer = 8 <= replicate = 7"),
        ("picogs", "tiles = { width = 4", "tiles = { width = 0", "1 to 1024 pixels"),
        ("virge", "start = \"zero\"", "slope-width = 9", "as wide as its accumulator"),
    ];
    refused(&cases);
}

/// Clause RG-1: a combination without a meaning is refused, with the field and the reason.
#[test]
fn what_has_no_meaning_is_refused() {
    let cases = [
        (
            "vortex",
            "rule = \"both\"",
            "rule = \"truncated-side\"",
            "looks at vertices, and edges are given",
        ),
        ("vortex", "descent = { tile = 32, block = 4 }", "", "count from a tile's origin"),
        ("vortex", "block = 4", "block = 64", "2 <= block <= tile <= 1024"),
        ("psp", "width = 32", "width = 40", "an edge word has 2 to 32 bits"),
        ("psp", "\"x0:16\"", "\"x9:16\"", "needs a register \"x0\""),
        (
            "psp",
            "\"e2\"",
            "\"e3\"",
            "there is no value \"e3\"; the values of this record are x, y, e0, e1, e2",
        ),
        ("ps1", "sub-pixel = 0", "sub-pixel = 2", "planes are anchored at whole pixels"),
        ("ps1", "\"left:11\"", "\"left:11 upper:3@11\"", "has no register \"upper\""),
        ("ps1", "clamp = \"wrap\"", "clamp = \"saturate\"", "cannot saturate its accumulator"),
        ("voodoo", "\"adjust\"", "\"-\"", ""),
        (
            "voodoo",
            "plane = { at-vertex = {} }",
            "plane = { at-edge = { fraction = 5 } }",
            "at-vertex",
        ),
        (
            "voodoo",
            "w-float = \"w\"",
            "w-float = \"q\"",
            "depth takes channel \"q\", and there is none",
        ),
        (
            "voodoo",
            "\"z\"], guard = 4, integer = 16, interpolation = 12",
            "\"z\"], guard = 0, integer = 33, interpolation = 12",
            "depth takes channel \"z\": integer = 33 <= 32 is needed",
        ),
        ("voodoo", "\"r:24\"", "\"r:24@16\"", "must lie in bits 0 to 31"),
        ("virge", "rightward:1@31", "leftward:1@31", ""),
        ("virge", "rightward:1@31", "-:1@31", "exactly one of `leftward` and `rightward`"),
        (
            "virge",
            "pixel-bias = 0xfffff",
            "pixel-bias = 0x100000",
            "pixel-bias = 1048576 < 2^fraction",
        ),
        ("n64", "depth = \"z\"", "depth = \"s\"", "18 integer bits"),
        ("n64", "correction = 3", "correction = 14", "correction = 14 <= interpolation = 13"),
        ("n64", "radix = 16", "radix = 8", "radix of words is 10 or 16"),
        ("n64", "letter = \"S\"", "letter = \"SS\"", "expected a character"),
        ("vulkan-4bit", "lattice = 8", "lattice = 4", "sub-pixel = 4 < lattice"),
    ];
    refused(&cases);
    let depth = "\n[depth]\nguard = 0\ninteger = 8\ninterpolation = 4\nrounding = \"floor\"\ndivision = \"quotient\"\nclamp = \"wrap\"\nstart-bias = \"none\"\n";
    let text = BUILTIN.iter().find(|(name, _)| *name == "psp").unwrap().1.to_owned() + depth;
    let error = parse(&text, "changed.toml").unwrap_err().to_string();
    assert!(error.contains("[depth] has no effect with [form.registers]"), "{error}");
}

/// Clause RG-2: records beyond a number are counted and not kept.
#[test]
fn records_are_kept_up_to_a_number() {
    let model = Model::new(&load("psp").unwrap()).unwrap();
    // Right-angled, two pixels a side: three of them.
    let words = [64, 64, 96, 64, 64, 96, 48, 48, 127, 127];
    for (most, kept, whole) in [(2, 2, false), (3, 3, true), (9, 3, true)] {
        let mut records = guardbit::model::Records::up_to(most);
        model.draw(words.as_slice(), &mut records).unwrap();
        assert_eq!((records.kept.len(), records.total, records.is_whole()), (kept, 3, whole));
    }
}

/// Clause RG-20: the words of a machine, taken apart: an edge's own, and those that channels share.
#[test]
fn budgets_name_the_words_of_a_machine() {
    let words = |name: &str| -> Vec<(String, u32)> {
        let report = guardbit::measure::budget::report(&load(name).unwrap()).unwrap();
        for word in &report.words {
            let sum: u32 = word.fields.iter().map(|field| field.bits).sum();
            assert_eq!(sum, word.width, "{name} {}", word.name);
        }
        report.words.into_iter().map(|word| (word.name, word.width)).collect()
    };
    let list = |words: &[(&str, u32)]| -> Vec<(String, u32)> {
        words.iter().map(|(name, bits)| ((*name).to_owned(), *bits)).collect()
    };
    // As each oracle's registers have them: 28 bits of x, 32 of an attribute; 20 of a PlayStation's.
    let n64 = [("vertex", 13), ("edge", 28), ("r, g, b, a", 32), ("s, t, w", 32), ("z", 32)];
    assert_eq!(words("n64"), list(&n64));
    assert_eq!(words("ps1"), list(&[("vertex", 11), ("r, g, b, u, v", 20)]));
    assert_eq!(words("psp"), list(&[("vertex", 16), ("edge", 32)]));
}

/// Clause RG-4: a host turns a triangle to the side that the edge functions know. The hardware draws 780 pixels of
/// this one in either order of its vertices.
#[test]
fn a_psp_triangle_is_drawn_from_either_side() {
    let model = Model::new(&load("psp").unwrap()).unwrap();
    for xy in [[[60, 50], [60, 10], [100, 50]], [[60, 10], [60, 50], [100, 50]]] {
        let xy = xy.map(|at| at.map(|pixel| pixel * 16));
        let mut drawing = Drawing::default();
        model.draw(&model.snap(&Triangle::Lattice { xy, z: None }).unwrap(), &mut drawing).unwrap();
        assert_eq!(drawing.samples(), 780);
    }
}

/// Clause RG-23: each engine says how long its words take, before it takes that long.
#[test]
fn words_that_draw_nothing_for_minutes_are_refused() {
    let of = |name: &str| BUILTIN.iter().find(|(known, _)| *known == name).unwrap().1.to_owned();
    // 2^28 - 1 by 2^28 - 1 pixels and more, in sixteenths.
    let range = of("psp").replace("\"right:17\", \"bottom:17\"", "\"right\", \"bottom\"");
    // 2^32 - 1 rows twice.
    let rows = of("virge").replace("rows01:11@16 rows12:11", "-a:11@16").replacen(
        "\"-\", \"-\"",
        "\"rows01\", \"rows12\"",
        1,
    );
    let wide = of("rasterix").replace(
        "left:11 top:11@16\", \"right:11 bottom:11@16",
        "left:16 top:16@16\", \"right:16 bottom:16@16",
    );
    let ends = of("n64")
        .replace("yh:14 ym:14@16", "-yh0:14 ym:14@16")
        .replace("\"z\", \"z_dx\"", "\"yh\", \"z_dx\"");
    let ends = ends.replace("\"z_dy\",", "\"z_dy\", \"z\",");
    for (name, text, set, steps) in [
        ("psp", range, vec![("right", -1), ("bottom", -1)], (1u128 << 28).pow(2)),
        ("rasterix", wide, vec![("right", -1), ("bottom", -1)], ((1u128 << 16) - 1).pow(2)),
        ("virge", rows, vec![("rows01", -1), ("rows12", -1)], (1 << 33) - 2),
        // From sub-scanline -2^31 to 3.
        ("n64", ends, vec![("yh", -1 << 31)], (1 << 31) + 4),
    ] {
        let model = Model::new(&parse(&text, name).unwrap_or_else(|e| panic!("{e}"))).unwrap();
        let input = &model.registers().unwrap().input;
        let mut words = vec![0; input.len()];
        for (register, value) in set {
            input.find(register).unwrap().scatter(value, &mut words);
        }
        let mut records = guardbit::model::Records::up_to(u64::MAX);
        let error = model.draw(words.as_slice(), &mut records).unwrap_err().to_string();
        let expected =
            format!("the words take up to {steps} steps, but at most {} are allowed", 1 << 28);
        assert_eq!((error, records.total), (expected, 0), "{name}");
    }
}

/// Clause RG-26: a condition is read, kept to by the words of a set, and broken in one class.
#[test]
fn legal_words_are_conditions_of_registers() {
    let text = BUILTIN.iter().find(|(name, _)| *name == "psp").unwrap().1;
    let legal = |conditions: &str| {
        parse(
            &text.replace("radix = 10\n", &format!("radix = 10\nlegal = {conditions}\n")),
            "legal.toml",
        )
    };
    let profile = legal("[\"left <= right\", \"signed x0 != -3\", \"12 > top\"]").unwrap();
    let model = Model::new(&profile).unwrap();
    let registers = model.registers().unwrap();
    let broken = |words: [u32; 10]| -> Vec<String> {
        registers.illegal(&words).map(|legal| legal.text().to_owned()).collect()
    };
    assert_eq!(broken([0, 0, 0, 0, 0, 0, 5, 11, 5, 0]), [""; 0]);
    assert_eq!(
        broken([0xfffd, 0, 0, 0, 0, 0, 5, 12, 4, 0]),
        ["left <= right", "signed x0 != -3", "12 > top"]
    );
    for wrong in ["left < nowhere", "left", "left = right", "signed 5 < top", "5.5 < top"] {
        let error = legal(&format!("[\"{wrong}\"]")).unwrap_err().to_string();
        assert!(error.contains(wrong) && error.contains("is not a condition"), "{error}");
    }
    let (scene, values) = Default::default();
    let source = Source { profile, scene, values, count: 4000, seed: 1 };
    let bench = RegisterBench::new(&source).unwrap();
    let mut seen = 0;
    for (n, group) in bench.groups().iter().enumerate() {
        for index in 0..group.tests {
            let text = bench.describe(TestAt { group: n, index, test: 0 });
            let words = text.strip_prefix("registers ").unwrap().split(' ');
            let words: Vec<u32> =
                words.map(|word| u32::from_str_radix(word, 16).unwrap()).collect();
            let is_legal = registers.illegal(&words).next().is_none();
            let breaks = group.class.tag == "register-illegal";
            assert!(is_legal != breaks, "{} {index}: {text}", group.class.tag);
            seen += u64::from(breaks);
        }
    }
    assert!(seen >= 20, "{seen}");
}
