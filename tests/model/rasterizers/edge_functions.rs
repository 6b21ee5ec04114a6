//! Edge functions made of parts: combinations at random and one by one, against a plain twin of the clauses.

mod twin;

use super::{records, toy, word};
use guardbit::case::Words;
use guardbit::model::Model;
use twin::{Divide, Limit, Parts, Shape, Source, Values};

/// A choice of a list.
fn pick<T: Copy>(words: &mut Words, list: &[T]) -> T {
    list[usize::try_from(words.below(list.len() as u64)).unwrap()]
}

const ROUNDINGS: [&str; 4] = ["floor", "toward-zero", "nearest-even", "ceiling"];

fn divide(words: &mut Words) -> Divide {
    match words.below(3) {
        0 => Divide::Quotient(pick(words, &ROUNDINGS)),
        1 => Divide::Reciprocal {
            numerator: pick(words, &[6, 14, 29]),
            drop: pick(words, &[0, 0, 1, 3]),
            zero: pick(words, &[0, 77]),
        },
        _ => Divide::Table {
            index: pick(words, &[1, 3, 9]),
            between: pick(words, &[0, 2, 9]),
            seed: pick(words, &[3, 9, 17]),
        },
    }
}

/// Parts at random; those without a meaning together are not among them.
fn parts(words: &mut Words) -> Parts {
    let sub = pick(words, &[0, 1, 2]);
    let sample = [0; 2].map(|_| u32::try_from(words.below(1 << sub)).unwrap());
    let given = words.below(4) == 0;
    let rules = [
        "both",
        "strict",
        "top-left",
        "top-right",
        "bottom-left",
        "bottom-right",
        "truncated-side",
    ];
    let windings = ["one", "either", "both", "negate", "swap"];
    let limits = [
        Limit::None,
        Limit::Size([3, 4]),
        Limit::Registers,
        Limit::Exponents,
        Limit::Rectangle("half-open"),
        Limit::Rectangle("closed"),
    ];
    let limit = pick(words, &limits);
    let source = if given {
        Source::Given { at: pick(words, &["box", "window"]) }
    } else {
        Source::Vertices {
            sense: pick(words, &["positive", "negative"]),
            product_cut: pick(words, &[0, 0, 1, 3]),
            cut: pick(words, &[0, 0, 2]),
        }
    };
    let from_registers = given || words.below(4) == 0;
    let shape = if from_registers {
        Shape::Given(pick(words, &["half-open", "closed"]))
    } else {
        Shape::Vertices {
            bits: pick(words, &[None, Some(2), Some(3)]),
            limit,
            hold_both: limit != Limit::None && words.below(2) == 0,
            try_first: words.below(2) == 0,
        }
    };
    let values = match if given { 0 } else { words.below(4) } {
        0 => Values::Given { at: pick(words, &["box", "window"]) },
        1 => Values::Weights {
            divide: divide(words),
            fraction: pick(words, &[4, 9]),
            product_cut: pick(words, &[0, 3]),
            product: pick(words, &[64, 11]),
        },
        n => Values::Planes {
            divide: divide(words),
            at_vertex: n == 2,
            extra: pick(words, &[0, 3]),
            width: pick(words, &[64, 16]),
            product: pick(words, &[128, 20]),
            half: words.below(2) == 0,
        },
    };
    let orders = [
        "\"rows\"",
        "\"serpentine\"",
        "\"zigzag\"",
        "{ tiles = { width = 2, height = 3 } }",
        "{ tiles = { width = 4, height = 2, place = \"box\", reject-corners = true } }",
        "{ tiles = { width = 2, height = 2, place = \"box-counted-by-grid\", beyond-box = true } }",
        "{ tiles = { width = 4, height = 4, reject-corners = true, beyond-box = true } }",
    ];
    Parts {
        sub,
        sample,
        width: pick(words, &[5, 8, 16, 33, 64]),
        winding: windings[usize::try_from(words.below(if given { 2 } else { 5 })).unwrap()],
        rule: rules[usize::try_from(words.below(if given { 6 } else { 7 })).unwrap()],
        skip: !given && words.below(4) == 0,
        source,
        shape,
        order: pick(words, &orders),
        values,
        zero_extended: words.below(2) == 0,
        slope_width: words.below(3) == 0,
    }
}

/// Clauses RE-1, RE-2, RE-3, RE-4, RE-5, RE-6, RE-7, RE-8 and RE-9: parts at random, each combination with a few
/// lists of registers, against the twin.
#[test]
fn parts_combine() {
    let (mut drawn, mut seen) = (0, 0);
    for n in 0..900 {
        let mut words = Words::new(28, 0, n);
        let mut parts = parts(&mut words);
        if matches!(parts.values, Values::Weights { .. } | Values::Planes { at_vertex: true, .. }) {
            parts.slope_width = false;
        }
        if let Values::Weights { divide: Divide::Quotient(_), product_cut, .. } = &mut parts.values
        {
            *product_cut = 0;
        }
        let text = parts.toml();
        let model = Model::new(&toy(8, parts.sub, parts.sample, &text)).unwrap();
        for _ in 0..12 {
            let values = parts.registers(&mut words);
            let registers: Vec<u32> = values.iter().map(|value| word(*value)).collect();
            let got: Vec<Vec<i64>> =
                records(&model, &registers).into_iter().map(|record| record.1).collect();
            let expected = parts.draw(&values);
            assert_eq!(got, expected, "{n}: {values:?}\n{text}");
            drawn += got.len();
            seen += u32::from(!got.is_empty());
        }
    }
    assert!(drawn > 20_000 && seen > 3000, "{drawn} {seen}");
}

/// Clauses RE-1, RE-2, RE-5, RE-6, RE-7, RE-8 and RE-9: two cases of each machine's own RTL, by the count of records and the
/// digest of all their words in order: h = (h ^ word) 0x100000001b3, mod 2^64.
#[test]
fn cases_of_the_hardware() {
    let cases: [(&str, &str, usize, u64); 6] = [
        (
            "rasterix",
            "1fc0070 20d007a 227ef ffffd4a0 ffffdd40 fffdc9e5 3ee0 23c0 acbc ffffec80 ffffff00 c9459995 9d2a4db 680f102 d80237 fffc4a4f fffc6141 10bb58c ffece729 fff69fbf c7d213 2abd2 fff4b25f ba80802a ea467c53 f7f37a7a",
            18,
            0x8492_f9e0_2345_24a6,
        ),
        (
            "rasterix",
            "1a0003 470037 22c4d0 ffffea40 ffff34c0 31a4 b120 ffffffa0 33c0 ffff64a0 cba0 207099af bba546 ff7449b8 50ebfa 11601 24fc2 7d3045 fffdd339 307 b7df22 ffff7398 14581 db7919fe fffb1ced e3c9c8",
            1136,
            0xb20b_e4ae_9411_6ed5,
        ),
        (
            "picogs",
            "9 9 0 1e00 a7b2 6094563 50 1e20 c202 dd36d66d 30 1e50 88f1 eeb9a81",
            12,
            0xaf34_2a03_e86b_e9ca,
        ),
        (
            "picogs",
            "9 9 51 1dfa d18f a00d0723 25 1e1e 83a9 e853dd01 3ff9 1e42 ed32 5007fc4f",
            788,
            0xabae_ff4f_4529_52d7,
        ),
        (
            "graphite",
            "1bc000 20000 1374 1b8000 ffffc000 2f11 1b4000 c000 d6e 3877 2950 176d d39 2ec3 d2b 840 1905 1a6b",
            8,
            0x0628_25ca_011d_118d,
        ),
        (
            "graphite",
            "105000 130000 2e4b 16d000 e0000 222a fb000 df000 727 3841 1d21 3c64 1ded 3b67 167d 14ac 211e 2f14",
            298,
            0x75ea_8a9b_93ac_e6a6,
        ),
    ];
    for (name, text, count, digest) in cases {
        let model = Model::new(&guardbit::profile::load(name).unwrap()).unwrap();
        let registers = model.registers().unwrap();
        let words = registers.parse(&text.split(' ').collect::<Vec<_>>()).unwrap();
        let drawn = records(&model, &words);
        let words = drawn.iter().flat_map(|(kind, values)| registers.records[*kind].words(values));
        let got = words.fold(0xcbf2_9ce4_8422_2325u64, |held, word| {
            (held ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3)
        });
        assert_eq!((drawn.len(), got), (count, digest), "{name}");
    }
}

/// Parts of one winding over whole pixels, with nothing special.
fn plain(rule: &'static str, winding: &'static str) -> Parts {
    Parts {
        sub: 1,
        sample: [1, 0],
        width: 16,
        winding,
        rule,
        skip: false,
        source: Source::Vertices { sense: "positive", product_cut: 0, cut: 0 },
        shape: Shape::Vertices {
            bits: None,
            limit: Limit::None,
            hold_both: false,
            try_first: false,
        },
        order: "\"rows\"",
        values: Values::Given { at: "box" },
        zero_extended: false,
        slope_width: false,
    }
}

/// Clauses RE-3 and RE-4: every quadrilateral of 16 places cut along its diagonal, by the rules that give an edge one
/// owner, the halves in any winding: a sample of both halves is on no side of the diagonal but one.
#[test]
fn both_windings_draw_a_shared_edge_once() {
    for rule in ["top-left", "top-right", "bottom-left", "bottom-right"] {
        for winding in ["both", "negate", "swap"] {
            let parts = plain(rule, winding);
            let model = Model::new(&toy(8, 1, parts.sample, &parts.toml())).unwrap();
            let draw = |v: [[i128; 2]; 3]| -> Vec<[i64; 2]> {
                let mut words: Vec<u32> = v.iter().flatten().map(|at| word(*at)).collect();
                words.resize(6 + 6, 0);
                records(&model, &words).into_iter().map(|(_, at)| [at[0], at[1]]).collect()
            };
            let area = |[a, b, c]: [[i128; 2]; 3]| {
                (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
            };
            let place = |n: u32| [i128::from(n % 4) * 2 - 1, i128::from(n / 4) * 2];
            let (mut once, mut on_edge) = (0, 0);
            for n in (0..65536u32).step_by(11) {
                let [a, b, c, d] = [n & 15, n >> 4 & 15, n >> 8 & 15, n >> 12].map(place);
                let halves = [[a, b, c], [c, a, d]];
                // On either side of the diagonal.
                if area(halves[0]) * area([a, c, d]) <= 0 {
                    continue;
                }
                let [first, second] = halves.map(draw);
                assert!(first.iter().all(|at| !second.contains(at)), "{rule} {winding} {halves:?}");
                // Samples within the diagonal belong to one of the two.
                for x in -1..4 {
                    for y in 0..4 {
                        let at = [2 * x + 1, 2 * y];
                        let between = |axis: usize| {
                            a[axis].min(c[axis]) < at[axis] && at[axis] < a[axis].max(c[axis])
                        };
                        if area([a, c, at]) == 0 && (between(0) || between(1)) {
                            let at = at.map(|value| i64::try_from(value.div_euclid(2)).unwrap());
                            assert!(first.contains(&at) || second.contains(&at), "{halves:?}");
                            on_edge += 1;
                        }
                    }
                }
                once += first.len() + second.len();
            }
            assert!(once > 1000 && on_edge > 100, "{once} {on_edge}");
        }
    }
}

/// Clause RE-4: given edges of 5 bits, every value and every pair of changes of one edge that fits 4 bits, by each rule
/// over 4 x 4 pixels.
#[test]
fn one_given_edge() {
    for rule in ["both", "strict", "top-left", "bottom-right"] {
        let mut parts = plain(rule, "one");
        parts.width = 5;
        parts.source = Source::Given { at: "box" };
        parts.shape = Shape::Given("half-open");
        let model = Model::new(&toy(8, 1, parts.sample, &parts.toml())).unwrap();
        let mut drawn = 0;
        for n in (0..32 * 16 * 16).step_by(3) {
            let (value, right, down) = (n % 32 - 16, n / 32 % 16 - 8, n / 512 - 8);
            let mut values = vec![0; 9];
            // What the others have is inside by every rule.
            values[..3].copy_from_slice(&[value, right, down]);
            (values[3], values[6]) = (1, 1);
            values.extend([0, 0, 4, 4, 0, 0, 0, 0, 0, 0]);
            let registers: Vec<u32> = values.iter().map(|value| word(*value)).collect();
            let got: Vec<Vec<i64>> = records(&model, &registers).into_iter().map(|r| r.1).collect();
            assert_eq!(got, parts.draw(&values), "{rule} {value} {right} {down}");
            drawn += got.len();
        }
        assert!(drawn > 10_000, "{drawn}");
    }
}

/// Clause RE-10: every part of a built-in machine has neighbours for the diagnosis, and a refused one is none of them.
#[test]
fn every_part_has_neighbours() {
    for (name, fields) in [
        ("rasterix", ["width", "winding", "rule", "edges.at", "box.given", "order", "values.at"]),
        (
            "graphite",
            [
                "edges.sense",
                "edges.product-cut",
                "box.bits",
                "box.try-first",
                "values.divide.drop",
                "values.fraction",
                "values.product-cut",
            ],
        ),
        (
            "picogs",
            [
                "without-area",
                "box.hold-both",
                "order.place",
                "order.beyond-box",
                "values.divide.between",
                "values.fraction",
                "values.half",
            ],
        ),
    ] {
        let profile = guardbit::profile::load(name).unwrap();
        let found = guardbit::profile::neighbours(&profile);
        for field in fields {
            let field = format!("form.registers.engine.edge-functions.{field} is ");
            let steps = found.iter().filter(|step| step.change.starts_with(&field));
            let changed = steps.filter(|step| step.profile != profile);
            assert!(changed.count() > 0, "{name} {field}");
        }
    }
}

/// Clause RE-9: every code of three bits, repeated, and a scale, against the bits of the clause.
#[test]
fn codes_are_scaled_and_repeated() {
    let channel = |more: &str| {
        let text = format!(
            "radix = 16\ninput = [\"left\", \"top\", \"right\", \"bottom\"]\nrecords = []\n\
             channels = [{{ names = [\"c\"], guard = 1, integer = 3, interpolation = 2, clamp = \"sign\", {more} }}]\n"
        );
        let table: toml::Value = toml::from_str(&text).unwrap();
        let config: guardbit::value::ChannelConfig =
            table["channels"][0].clone().try_into().unwrap();
        config.channels().unwrap().remove(0)
    };
    let [repeated, scaled] = ["replicate = 8", "scale = 7"].map(channel);
    for held in -32..32i64 {
        let code = |held: i64| (held.clamp(0, 31)) >> 2;
        let bits = format!("{:03b}", code(held)).repeat(3);
        assert_eq!(repeated.value(held), i64::from_str_radix(&bits[..8], 2).unwrap(), "{held}");
        // The product has the 6 bits of the read-out.
        let product = (7 * held + 32).rem_euclid(64) - 32;
        assert_eq!(scaled.value(held), code(product), "{held}");
    }
}
