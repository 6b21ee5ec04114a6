//! Samples at any place of a pixel, against the exact triangle at that place.

use super::toy::{TOY, parse};
use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::{SampleConfig, SampleGrid};
use guardbit::exact::{
    Point, Rational, Rule, covers, integer, plane_at, plane_slopes, ratio, round,
};
use guardbit::model::{Drawing, Model};
use guardbit::profile::Profile;
use guardbit::scene::lines::parse_line;
use guardbit::setup::Triangle;

/// 2 x 2 pixels of two sub-pixels, as `tail` says.
fn toy(place: [u32; 2], of: u32, storage: &str, machine: &str) -> Profile {
    let words = format!("rule = \"top-left\"\nstorage = \"{storage}\"\nwidth = 12\n");
    let machine = match machine {
        "tiles" => format!("[form.tiles]\ntile = 8\n[form.tiles.edge]\n{words}"),
        _ => format!("[form.{machine}]\n{words}"),
    };
    let text = format!(
        "schema = 1\nname = \"toy\"\n[window]\nwidth = 2\nheight = 2\n[vertex]\ninteger = 3\n\
         sub-pixel = 1\nsigned = true\nclosed = false\nsnap = \"floor\"\nsource = \"f64\"\n\
         endless = \"refuse\"\n[sample]\nx = {}\ny = {}\nof = {of}\n{machine}",
        place[0], place[1]
    );
    parse(&text).unwrap()
}

/// The sample of a pixel, in sub-pixels.
fn sample([x, y]: [i128; 2], place: [u32; 2], of: u32, sub_pixel: u32) -> Point {
    let at = |pixel: i128, place: u32| {
        ratio((pixel * i128::from(of) + i128::from(place)) << sub_pixel, of.into()).unwrap()
    };
    Point { x: at(x, place[0]), y: at(y, place[1]) }
}

fn pixels(drawing: &Drawing) -> Vec<[i128; 2]> {
    let spans = drawing.spans.iter();
    let row = |y: u32, x0: u32, x1: u32| (x0..x1).map(move |x| [x.into(), y.into()]);
    spans.flat_map(|span| row(span.y, span.x0, span.x1)).collect()
}

/// Clauses FP-1 and FP-2: all triangles of a small grid, at places of thirds, fifths, sevenths and twelfths:
/// a pixel is covered where the exact triangle covers its sample.
#[test]
fn a_sample_between_the_sub_pixels_is_covered_where_the_triangle_is() {
    let mut tried = [0u32; 2];
    for (place, of, storage, machine) in [
        ([7, 7], 12, "full", "edge-function"),
        ([1, 2], 3, "shifted", "edge-function"),
        ([4, 0], 5, "shifted", "tiles"),
        ([6, 1], 7, "full", "edge-function"),
    ] {
        let model = Model::new(&toy(place, of, storage, machine)).unwrap();
        let mut drawing = Drawing::default();
        let points: Vec<[i128; 2]> = (-1..4).flat_map(|y| (-1..4).map(move |x| [x, y])).collect();
        for (n, a) in points.iter().enumerate() {
            // Turning a triangle moves no bit (clause T-1), so its least vertex may come first.
            for (m, b) in points.iter().enumerate().skip(n + 1) {
                for c in points.iter().skip(m + 1) {
                    let triangle = Triangle { xy: [*a, *b, *c], z: None };
                    drawing.clear();
                    model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
                    let got = pixels(&drawing);
                    for pixel in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                        let at = sample(pixel, place, of, 1);
                        let wanted = covers(triangle.xy, at, Rule::TopLeft);
                        assert_eq!(got.contains(&pixel), wanted, "{triangle:?} {pixel:?} {of}");
                        tried[usize::from(wanted)] += 1;
                    }
                }
            }
        }
    }
    assert!(tried.iter().all(|count| *count > 2000), "{tried:?}");
}

/// Clause FP-1: on the grid of the vertices, parts of a pixel say what sub-pixels say.
#[test]
fn parts_of_a_pixel_on_the_grid_are_sub_pixels() {
    let of = |x, y, of| SampleGrid::new(Some(SampleConfig { x, y, of: Some(of) }), 4);
    assert_eq!(of(3, 9, 12).unwrap(), SampleGrid::at([4, 12], 4));
    assert_eq!(of(1, 1, 2).unwrap(), SampleGrid::new(None, 4).unwrap());
    assert!(!of(7, 7, 12).unwrap().is_on_the_grid());
    for (bad, text) in [
        (of(12, 0, 12), "x = 12: a sample must lie in its pixel, 0 <= x < of = 12"),
        (of(0, 0, 0), "of = 0: a pixel has 1 <= of <= 256 parts on a side"),
        (of(0, 0, 257), "of = 257"),
    ] {
        assert!(bad.unwrap_err().to_string().starts_with(text));
    }
}

/// Clause FP-3: the start of the plane is the exact value at the sample, rounded once; a slope is that of any
/// sample.
#[test]
fn a_plane_starts_at_the_sample_between_the_sub_pixels() {
    let (fraction, scale) = (6, integer(1 << 6));
    let depth = "[depth]\nguard = 4\ninteger = 8\ninterpolation = 6\nrounding = \"nearest-even\"\n\
                 division = \"quotient\"\nclamp = \"wrap\"\nstart-bias = \"none\"\n";
    let place = [7, 5];
    let text = format!("{TOY}[sample]\nx = {}\ny = {}\nof = 12\n{depth}", place[0], place[1]);
    let model = Model::new(&parse(&text).unwrap()).unwrap();
    let mut drawing = Drawing::default();
    let mut samples = 0;
    for index in 0..300 {
        let mut words = Words::new(9, 3, index);
        let mut at = || [words.between(0, 128), words.between(0, 128)];
        let xy = [at(), at(), at()];
        let z = [(); 3].map(|()| words.between(0, 255));
        let triangle = Triangle { xy, z: Some(z) };
        drawing.clear();
        model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
        let Some(start) = plane_at(xy, z, sample([0, 0], place, 12, 4)) else { continue };
        let slopes = plane_slopes(xy, z).unwrap();
        let word = |value: &Rational| {
            i128::try_from(round(&(value * &scale), Rounding::NearestEven)).unwrap()
        };
        let [dx, dy] = slopes.map(|slope| word(&(slope * integer(16))));
        let start = word(&start);
        for ([x, y], code) in pixels(&drawing).into_iter().zip(&drawing.depth) {
            let value = start + x * dx + y * dy;
            assert_eq!(i128::from(*code), value >> fraction & 0xff, "{triangle:?}");
            samples += 1;
        }
    }
    assert!(samples > 1000, "{samples}");
}

/// Clauses FP-4 and FP-5: each sample of one's own at its place; a sample that the mask leaves out is covered
/// by nothing, and a pixel without others is not drawn.
#[test]
fn samples_of_ones_own_and_a_mask() {
    let list = [[1, 3], [5, 7], [11, 2]];
    let table = "[multisample]\nsamples = 3\npositions = [[1, 3], [5, 7], [11, 2]]\nof = 12\n\
                 depth = \"sample\"\n";
    let mut seen = [0u32; 3];
    for mask in [None, Some(0b101)] {
        let mask_line = mask.map_or(String::new(), |mask: u32| format!("mask = {mask}\n"));
        let profile = parse(&format!("{TOY}{table}{mask_line}")).unwrap();
        assert_eq!(parse(&profile.to_toml()).unwrap(), profile);
        let model = Model::new(&profile).unwrap();
        let drawn = mask.unwrap_or(0b111);
        for index in 0..120 {
            let mut words = Words::new(9, 4, index);
            let mut at = || [words.between(0, 128), words.between(0, 128)];
            let triangle = Triangle { xy: [at(), at(), at()], z: None };
            let mut drawing = Drawing::default();
            model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
            let mut got: Vec<_> = pixels(&drawing).into_iter().zip(&drawing.masks).collect();
            for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
                let covered =
                    |place| covers(triangle.xy, sample([x, y], place, 12, 4), Rule::TopLeft);
                let wanted = (0..3).filter(|n| covered(list[*n])).fold(0, |all, n| all | 1 << n);
                let wanted = wanted & drawn;
                if wanted == 0 {
                    continue;
                }
                let first = got.remove(0);
                assert_eq!((first.0, *first.1), ([x, y], wanted), "{triangle:?}");
                seen[usize::from(wanted == drawn) + usize::from(mask.is_some())] += 1;
            }
            assert!(got.is_empty(), "{triangle:?} {got:?}");
        }
    }
    assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
}

/// Clause FP-1: what cannot be is refused, with the key.
#[test]
fn samples_that_no_machine_takes_are_refused_by_key() {
    let sample = "[sample]\nx = 7\ny = 7\nof = 12\n";
    let several = "[multisample]\ndepth = \"centre\"\n";
    let walk = TOY.replace(
        "[form.edge-function]\nrule = \"top-left\"\nstorage = \"shifted\"\nwidth = 24\n",
        "[form.homogeneous]\nrule = \"top-left\"\nw = 4\n",
    );
    let reciprocal = "[depth]\nguard = 2\ninteger = 8\ninterpolation = 6\nrounding = \"floor\"\n\
                      division = { reciprocal = { bits = 12 } }\nclamp = \"wrap\"\nstart-bias = \"none\"\n";
    for (text, wanted) in [
        (format!("{walk}{sample}"), "the machine homogeneous has no means for that"),
        (format!("{TOY}{sample}{reciprocal}"), "[depth] is divided by a reciprocal"),
        (format!("{TOY}{several}samples = 3\n"), "give `positions` for another count"),
        (format!("{TOY}{several}samples = 2\nof = 12\n"), "give `positions`, or leave `of` out"),
        (format!("{TOY}{several}samples = 2\npositions = [[0, 0]]\n"), "has 1 places"),
        (format!("{TOY}{several}samples = 0\npositions = []\n"), "0 positions"),
        (format!("{TOY}{several}samples = 1\npositions = [[0, 16]]\n"), "positions[0] = [0, 16]"),
        (format!("{TOY}{several}samples = 2\nmask = 4\n"), "mask = 0b100"),
        (format!("{TOY}{several}samples = 2\nmask = 0\n"), "1 <= mask < 2^samples = 4"),
    ] {
        let error = parse(&text).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
}

/// Clause FP-3: coordinates of the triangle, which correct a channel, are those of the sample.
#[test]
fn a_channel_is_weighed_at_the_sample_between_the_sub_pixels() {
    let channel = "[sample]\nx = 7\ny = 7\nof = 12\n[w]\nguard = 1\ninteger = 5\ninterpolation = 9\n\
                   rounding = \"floor\"\nclamp = \"guard\"\n[[channel]]\nname = \"c\"\ncomponents = [\"c\"]\n\
                   guard = 1\ninteger = 8\ninterpolation = 12\nrounding = \"floor\"\n\
                   clamp = \"guard\"\n\
                   correction = { barycentric = { bits = 20, rounding = \"nearest-even\" } }\n";
    let model = Model::new(&parse(&format!("{TOY}{channel}")).unwrap()).unwrap();
    let line = r#"{"v":[[0,0],[128,0],[0,128]],"channels":{"c":[[0],[240],[0]]},"q":[9,9,9]}"#;
    let request = parse_line(line).unwrap();
    let primitive = model.prepare(&request.primitive).unwrap();
    let primitive = model.shade(primitive, &request.shading.unwrap()).unwrap();
    let mut drawing = Drawing::default();
    model.draw(&primitive, &mut drawing).unwrap();
    // c = 240 x / 8 pixels, at x = n + 7/12: 30 n + 17.5. At a sub-pixel below, 9/16, it would be 16.875.
    let first: Vec<i64> = drawing.channels[0][..4].to_vec();
    assert_eq!(first, [17, 47, 77, 107]);
}

/// Clauses E-5 and FP-12: the words of the profiles with a field of their own hold every edge value.
#[test]
fn the_edge_words_of_the_consoles_hold_every_value() {
    for name in ["gamecube", "nv2a"] {
        let profile = guardbit::profile::load(name).unwrap();
        let width = profile.form.edge().unwrap().width;
        assert_eq!(profile.exact_edge_width(), Some(width), "{name}");
    }
}
