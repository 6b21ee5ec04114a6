//! The words of a set: each is what a plain stepper, or exact numbers rounded once, give.

use super::{rule, zoo};
use crate::device::{Drawer, Reader, Stepper, walks};
use crate::set::{options, signed, source, write_set};
use guardbit::cover::{EdgeStorage, FillRule};
use guardbit::exact::{self, Point};
use guardbit::format::Clamp;
use guardbit::profile::{Form, Profile};
use guardbit::setup::{Division, Triangle};
use guardbit::vector::bench::{TriangleBench, locate};

// Clause N-2
#[test]
fn walks_are_what_a_plain_stepper_gives() {
    for profile in zoo() {
        // Enough for every class of every profile.
        let set = write_set(&profile, "triangle", &options(6000));
        let mut steppers = vec![("dda", Stepper::depth(Reader::of(&profile)))];
        if let Form::EdgeFunction(edges) = profile.form {
            steppers.push(("edge", Stepper::edge(edges.width)));
        }
        for (stem, stepper) in steppers {
            let (cfg, exp) =
                (set.rows(&format!("{stem}.cfg.tv")), set.rows(&format!("{stem}.exp.tv")));
            let walks = walks(&exp);
            assert_eq!(walks.len(), cfg.len(), "{} {stem}", profile.name);
            let mut zones = [0; 2];
            for (n, (words, walk)) in cfg.iter().zip(walks).enumerate() {
                let ops: Vec<u128> = walk.iter().map(|row| row[0]).collect();
                let rows = stepper.walk(words, &ops);
                assert!(
                    rows.iter().zip(walk).all(|(a, b)| a[..] == b[..]),
                    "{} {stem} walk {n}: {walk:x?} is {rows:x?}",
                    profile.name
                );
                for row in &rows {
                    zones[0] += u64::from(row[2] == 0);
                    zones[1] += u64::from(row[2] != 0);
                }
            }
            assert!(zones.iter().all(|rows| *rows > 100), "{} {stem}: {zones:?}", profile.name);
        }
    }
}

/// The depth plane of a triangle from the exact truth: start and slopes, unreduced.
fn exact_plane(profile: &Profile, xy: [[i128; 2]; 3], z: [i128; 3]) -> [i128; 3] {
    let (depth, grid) = (profile.depth.unwrap(), profile.grid().unwrap());
    let f = depth.interpolation;
    let start = exact::plane_word(xy, z, grid.offset, f, depth.rounding).unwrap();
    let half = i128::from(profile.name == "d3d11") << f >> 1;
    let slopes = exact::plane_slopes(xy, z).unwrap().map(|slope| {
        let scaled = slope * exact::integer(1 << (grid.sub_pixel + f));
        i128::try_from(exact::round(&scaled, depth.rounding)).unwrap()
    });
    [start + half, slopes[0], slopes[1]]
}

/// What set-up makes of a triangle with area, by the exact truth where there is one.
fn exact_setup(profile: &Profile, xy: [[i128; 2]; 3], z: [i128; 3]) -> Vec<i128> {
    let grid = profile.grid().unwrap();
    let area = exact::edge_value(xy[0], xy[1], xy[2]);
    let (v, w) = if area > exact::integer(0) {
        (xy, z)
    } else {
        ([xy[0], xy[2], xy[1]], [z[0], z[2], z[1]])
    };
    let mut words = Vec::new();
    for k in 0..3 {
        let (p, q) = (v[k], v[(k + 1) % 3]);
        match &profile.form {
            Form::EdgeFunction(edges) => {
                // Values at three samples give the start and both steps.
                let at = |x, y| {
                    let value = exact::edge_value(p, q, grid.position(x, y));
                    i128::try_from(value.to_integer()).unwrap()
                };
                let level = q[1] == p[1];
                let owns = match edges.rule {
                    FillRule::TopLeft => q[1] < p[1] || (level && q[0] > p[0]),
                    FillRule::Shadow => q[1] > p[1] || (level && q[0] > p[0]),
                };
                let first = at(0, 0) - i128::from(!owns);
                let s = if edges.storage == EdgeStorage::Shifted { grid.sub_pixel } else { 0 };
                let steps = [at(1, 0) - at(0, 0), at(0, 1) - at(0, 0)].map(|step| step >> s);
                words.extend([first >> s, steps[0], steps[1]]);
            }
            Form::EdgeWalk(walk) => {
                let (top, bottom) = if q[1] < p[1] { (q, p) } else { (p, q) };
                let pixel = 1 << grid.sub_pixel;
                let reached = |y: i128| (y - grid.offset[1] + pixel - 1).div_euclid(pixel);
                let (first, end) = (reached(top[1]), reached(bottom[1]));
                if first >= end {
                    words.extend([0; 4]);
                    continue;
                }
                let unit = exact::dyadic(1 << walk.fraction, grid.sub_pixel);
                let x = |row: i128| {
                    let y = grid.position(0, row)[1];
                    exact::edge_x(top, bottom, y).unwrap() * &unit
                };
                let word = |value| i128::try_from(exact::round(&value, walk.rounding)).unwrap();
                words.extend([word(x(first)), word(x(first + 1) - x(first)), first, end]);
            }
            other => panic!("no exact set-up of {} here", other.name()),
        }
    }
    if let Some(Division::Reciprocal { .. }) = profile.depth.map(|depth| depth.division) {
        // The exact truth has no reciprocal: the plain device stands in.
        let triangle = Triangle { xy, z: Some(z) };
        words.extend(&Drawer::of(profile).set_up(&triangle).setup[9..]);
    } else {
        words.extend(exact_plane(profile, v, w));
    }
    words
}

// Clause N-2
#[test]
fn set_up_words_are_the_exact_ones_rounded_once() {
    // Set-up knows no clamp, and one number of guard bits is as good as another.
    let has_own_clamp = |p: &Profile| Clamp::ALL.iter().any(|c| p.name.starts_with(c.name()));
    for profile in zoo().into_iter().filter(|profile| !has_own_clamp(profile)) {
        let set = write_set(&profile, "knot", &options(1600));
        let columns = |name: &str| {
            let entry = set.manifest.files.iter().find(|file| file.name == name).unwrap();
            entry.columns.clone()
        };
        let (input, output) = (columns("setup.cfg.tv"), columns("setup.exp.tv"));
        let plain = rule(&profile).map(|_| Drawer::of(&profile));
        let mut flat = 0;
        let rows = set.rows("setup.cfg.tv").into_iter().zip(set.rows("setup.exp.tv"));
        for (n, (cfg, exp)) in rows.enumerate() {
            let value = |n: usize| {
                if input[n].signed { signed(cfg[n], input[n].width) } else { cfg[n].cast_signed() }
            };
            let xy: [[i128; 2]; 3] = [0, 1, 2].map(|n| [value(3 * n), value(3 * n + 1)]);
            let z = [value(2), value(5), value(8)];
            let degenerate = exact::edge_value(xy[0], xy[1], xy[2]) == exact::integer(0);
            // Rationals are slow: where a plain device can say it too, they judge each third row.
            let mut words = match &plain {
                Some(plain) if n % 3 > 0 => plain.set_up(&Triangle { xy, z: Some(z) }).setup,
                _ if degenerate => vec![0; output.len() - 1],
                _ => exact_setup(&profile, xy, z),
            };
            words.push(i128::from(degenerate));
            flat += u64::from(degenerate);
            let patterns: Vec<u128> = words
                .iter()
                .zip(&output)
                .map(|(word, column)| word.cast_unsigned() & (u128::MAX >> (128 - column.width)))
                .collect();
            assert_eq!(exp, patterns, "{} {xy:?} {z:?}", profile.name);
        }
        assert!(flat >= 6, "{}: triangles without area are tested", profile.name);
    }
}

// Clause N-2 and Clause N-5
#[test]
fn drawings_are_the_exact_coverage_under_the_rounded_plane() {
    for profile in zoo() {
        let (Some(rule), true) = (rule(&profile), profile.name != "reciprocal") else { continue };
        // A sticky accumulator has a path, and a refused triangle no rows: the spec's own matter.
        if matches!(profile.depth.unwrap().clamp, Clamp::Saturate | Clamp::Error) {
            continue;
        }
        let count = 3000;
        let set = write_set(&profile, "fan", &options(count));
        let bench = TriangleBench::new(&source(&profile, "fan", count));
        let (reader, grid) = (Reader::of(&profile), profile.grid().unwrap());
        let window = [profile.window.width, profile.window.height].map(i128::from);
        let (setups, exp) = (set.rows("triangle.cfg.tv"), set.rows("triangle.exp.tv"));
        let (mut spans, mut depths) =
            (set.rows("span.exp.tv").into_iter(), { set.rows("depth.exp.tv").into_iter() });
        let groups = guardbit::vector::bench::Bench::groups(&bench).to_vec();
        let (mut covered, mut worded) = (0, 0);
        for (test, (cfg, exp)) in setups.iter().zip(&exp).enumerate() {
            let triangle = bench.triangle_at(locate(&groups, test as u64).unwrap());
            let place = format!("{} test {test} {triangle:?}", profile.name);
            // Words of their own: what the row of the set says they are, sign by sign.
            let words = |first: usize, width: u32| {
                let word =
                    |k: usize| (cfg[first + k] << (128 - width)).cast_signed() >> (128 - width);
                [0, 1, 2].map(word)
            };
            let (zero_area, plane) = if let Some(Triangle { xy, z }) = &triangle {
                let zero_area = exact::edge_value(xy[0], xy[1], xy[2]) == exact::integer(0);
                let plane = || exact_plane(&profile, *xy, z.unwrap());
                (zero_area, if zero_area { [0; 3] } else { plane() })
            } else {
                worded += 1;
                let depth = profile.depth.unwrap();
                (cfg[13] == 1, words(10, depth.guard + depth.integer + depth.interpolation))
            };
            let inside = |x: i128, y: i128| match &triangle {
                Some(triangle) => {
                    exact::covers(triangle.xy, Point::from(grid.position(x, y)), rule)
                }
                None => (0..3).all(|k| {
                    let width = profile.form.edge().unwrap().width;
                    let [e, a, b] = words(1 + 3 * k, width);
                    cfg[13] == 0 && (e + a * x + b * y) >> (width - 1) & 1 == 0
                }),
            };
            // wrap, clamp_above, clamp_below, inexact.
            let (mut counts, mut runs, mut samples) = ([0u128; 4], 0, 0);
            let range = |axis: usize| {
                let Some(triangle) = &triangle else {
                    let [.., y0, y1, x0, x1] = cfg[..] else { unreachable!() };
                    let sides = if axis == 0 { [x0, x1] } else { [y0, y1] };
                    return sides.map(u128::cast_signed);
                };
                let (low, high) = grid.pixels(axis, triangle.extent(axis));
                [low.max(0), high.min(window[axis])]
            };
            let ([x0, x1], [y0, y1]) = (range(0), range(1));
            let bounds = [y0, y1.max(y0), x0, x1.max(x0)].map(i128::cast_unsigned);
            if x0 < x1 && y0 < y1 {
                assert_eq!(cfg[cfg.len() - 4..], bounds, "{place}");
            }
            let line = |rows: &mut dyn Iterator<Item = Vec<u128>>, words: &[i128]| {
                let words: Vec<u128> =
                    [test as i128].iter().chain(words).map(|word| word.cast_unsigned()).collect();
                assert_eq!(rows.next(), Some(words), "{place}");
            };
            for y in y0..y1 {
                let mut start = None;
                for x in x0..=x1 {
                    let inside = x < x1 && inside(x, y);
                    match (inside, start) {
                        (true, None) => start = Some(x),
                        (false, Some(from)) => {
                            line(&mut spans, &[y, from, x]);
                            runs += 1;
                            start = None;
                        }
                        _ => {}
                    }
                    if inside {
                        samples += 1;
                        let value = plane[0] + plane[1] * x + plane[2] * y;
                        line(&mut depths, &[y, x, reader.read(value)]);
                        for (count, hit) in counts.iter_mut().zip(events(reader, value)) {
                            *count += u128::from(hit);
                        }
                    }
                }
            }
            let [wrap, above, below, inexact] = counts;
            let zero = u128::from(zero_area);
            let expected = [test as u128, runs, samples, wrap, above, below, inexact, zero];
            assert_eq!(exp[..], expected, "{place}");
            covered += samples;
        }
        assert_eq!((spans.next(), depths.next()), (None, None), "{}", profile.name);
        assert!(covered > 80, "{}: {covered} samples", profile.name);
        assert_eq!(worded > 300, profile.plain_edges().is_some(), "{}: {worded}", profile.name);
    }
}

/// Events of the unwrapped value: wrap, clamped above, clamped below, inexact.
fn events(reader: Reader, value: i128) -> [bool; 4] {
    let (one, top) = (1i128 << reader.fraction, 1i128 << (reader.integer + reader.fraction));
    let half = 1i128 << (reader.width() - 1);
    let up = top / 2;
    let (low, high) = match reader.clamp {
        Clamp::Guard | Clamp::Error => (up - half, up + half),
        Clamp::Sign => (-half, half),
        Clamp::Wrap => (0, top),
        Clamp::Saturate => (i128::MIN, i128::MAX),
    };
    let clamps = reader.clamp != Clamp::Wrap;
    let wrapped = value < low || value >= high;
    [wrapped, clamps && value >= top, clamps && value < 0, value.rem_euclid(one) != 0]
}
