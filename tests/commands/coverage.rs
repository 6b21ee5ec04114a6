//! The cells of a set: hit, unreachable with a bound, or open.

use crate::set;
use guardbit::profile::{Profile, WindowConfig};
use guardbit::vector::manifest::CoverageEntry;
use set::{options, profile, write_set};
use std::collections::BTreeSet;

fn coverage<'m>(made: &'m set::Set, bench: &str) -> &'m CoverageEntry {
    made.manifest.coverage.iter().find(|entry| entry.bench == bench).unwrap()
}

// Clause N-5
#[test]
fn the_default_sets_leave_no_cell_open() {
    for guard in 1..=4 {
        let mut profile = profile("sgi-4k");
        profile.depth.iter_mut().for_each(|depth| depth.guard = guard);
        let made = write_set(&profile, "knot", &options(100_000));
        for entry in &made.manifest.coverage {
            assert_eq!(entry.open, [""; 0], "{guard} guard bits, {}", entry.bench);
        }
        let hit = |cell: &str| {
            let entry = coverage(&made, "triangle");
            entry.cells.iter().any(|hit| hit.cell == cell && hit.rows > 0)
        };
        // What vertices cannot reach, and words do.
        assert!(hit("run.x.4096") && hit("run.y.4096") && hit("cut.left") && hit("E-SE.above.tie"));
        let top = "1".repeat(guard as usize);
        assert!(hit(&format!("N-NE.guard-{top}")));
        let clamped: u128 = made.rows("triangle.exp.tv").iter().map(|row| row[4]).sum();
        assert!(clamped > 40, "{clamped} samples above the range");
    }
}

// Clause X-2
#[test]
fn a_core_of_a_thousand_rows_comes_first_and_no_seed_decides_it() {
    let of = |seed: u64| {
        let options = guardbit::vector::write::Options { seed, ..options(20_000) };
        write_set(&profile("sgi-4k"), "knot", &options)
    };
    let (one, other) = (of(1), of(2));
    for (bench, file) in [("dda", "dda.exp.tv"), ("edge", "edge.exp.tv"), ("setup", "setup.exp.tv")]
    {
        let core = one.manifest.groups.iter().find(|group| group.bench == bench).unwrap();
        assert_eq!(core.tag, "core");
        assert!((400..=1000).contains(&core.rows), "{bench}: {} rows", core.rows);
        let head = |made: &set::Set| {
            made.text(file).lines().take(1000).map(str::to_owned).collect::<Vec<_>>()
        };
        let rows = usize::try_from(core.rows).unwrap();
        assert_eq!(head(&one)[..rows], head(&other)[..rows]);
        // A first record with all bits in use.
        let cfg = one.rows(&file.replace("exp", "cfg")).remove(0);
        assert!(cfg.iter().all(|word| word.count_ones() > 4), "{bench}: {cfg:x?}");
    }
}

/// A toy whose every triangle can be drawn: vertices of 5 x 5, depths of 2 bits.
fn toy(interpolation: u32) -> Profile {
    let mut toy = profile("tiny");
    toy.window = WindowConfig { width: 2, height: 2 };
    toy.vertex.integer = 1;
    toy.depth
        .iter_mut()
        .for_each(|depth| (depth.integer, depth.interpolation) = (2, interpolation));
    toy.validate().unwrap();
    toy
}

/// Ties of the quotients of every triangle, by the names of their cells.
fn every_tie(interpolation: u32) -> BTreeSet<String> {
    let (fraction, sub_pixel, centre) = (interpolation, 1, 1i128);
    let points: Vec<[i128; 2]> = (0..=4).flat_map(|y| (0..=4).map(move |x| [x, y])).collect();
    let mut ties = BTreeSet::new();
    for a in &points {
        for b in &points {
            for c in &points {
                let (bx, by) = (b[0] - a[0], b[1] - a[1]);
                let (cx, cy) = (c[0] - a[0], c[1] - a[1]);
                let area = bx * cy - cx * by;
                if area == 0 {
                    continue;
                }
                for depths in 0..64i128 {
                    let z = [depths & 3, depths >> 2 & 3, depths >> 4];
                    let (zb, zc) = (z[1] - z[0], z[2] - z[0]);
                    let (right, down) = (zb * cy - zc * by, bx * zc - cx * zb);
                    let start = z[0] * area + right * (centre - a[0]) + down * (centre - a[1]);
                    for (name, numerator, scale) in [
                        ("depth_init", start, fraction),
                        ("depth_dx", right, fraction + sub_pixel),
                        ("depth_dy", down, fraction + sub_pixel),
                    ] {
                        let numerator = (numerator * area.signum()) << scale;
                        let (n, d) = (numerator.abs(), area.abs());
                        if 2 * (n % d) == d {
                            let sign = if numerator < 0 { "negative" } else { "positive" };
                            ties.insert(format!("tie.{name}.{sign}.q{}", n / d % 4));
                        }
                    }
                }
            }
        }
    }
    ties
}

// Clause N-5
#[test]
fn of_a_toy_every_triangle_says_the_same() {
    for interpolation in [0, 1, 4] {
        let made = write_set(&toy(interpolation), "triangle", &options(20_000));
        let entry = coverage(&made, "setup");
        let ties: BTreeSet<String> = every_tie(interpolation);
        let mine = |cells: &mut dyn Iterator<Item = &String>| -> BTreeSet<String> {
            cells.filter(|cell| cell.starts_with("tie.")).cloned().collect()
        };
        let hit = mine(&mut entry.cells.iter().map(|cell| &cell.cell));
        let unreachable = mine(&mut entry.unreachable.iter().map(|cell| &cell.cell));
        let open = mine(&mut entry.open.iter());
        assert_eq!(hit, ties, "{interpolation}: what can be hit is hit");
        assert!(open.union(&unreachable).all(|cell| !ties.contains(cell)), "{interpolation}");
        assert_eq!(hit.len() + open.len() + unreachable.len(), 24, "{interpolation}");
        if interpolation == 4 {
            // 2^6 divides no area of at most 16.
            assert!(unreachable.contains("tie.depth_dx.positive.q0"), "{unreachable:?}");
        }
    }
}
