//! Several samples a pixel, against the exact truth at each of them.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::{Event, Rounding};
use guardbit::case::Words;
use guardbit::cover::{DepthAt, FillRule, MultisampleConfig};
use guardbit::exact::{Rule, covers, plane_at, round};
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Profile, WindowConfig, load, triangle_machines};
use guardbit::setup::Triangle;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// The standard positions, written down from the Direct3D 11 documentation: offsets from the centre.
const FROM_CENTRE: [(u32, &[[i128; 2]]); 4] = [
    (2, &[[4, 4], [-4, -4]]),
    (4, &[[-2, -6], [6, -2], [-6, 2], [2, 6]]),
    (8, &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]]),
    (
        16,
        &[
            [1, 1],
            [-1, -3],
            [-3, 2],
            [4, -1],
            [-5, -2],
            [2, 5],
            [5, 3],
            [3, -5],
            [-2, 6],
            [0, -7],
            [-4, -6],
            [-6, 4],
            [-8, 0],
            [7, -4],
            [6, 7],
            [-7, -8],
        ],
    ),
];

fn profile(samples: u32, depth: DepthAt, rule: FillRule) -> Profile {
    let mut profile = load("sgi-4k").unwrap();
    profile.window = WindowConfig { width: 5, height: 4 };
    profile.vertex.sub_pixel = 4;
    profile.multisample = Some(MultisampleConfig::standard(samples, depth));
    profile.form.edge_mut().unwrap().rule = rule;
    profile
}

fn drawn(profile: &Profile, triangle: &Triangle) -> Drawing {
    let mut drawing = Drawing::default();
    let model = Model::new(profile).unwrap();
    model.draw(&model.place(*triangle).unwrap(), &mut drawing).unwrap();
    drawing
}

/// Clauses U-1 and U-2: every sample of every pixel, by every machine that is exact, is covered where
/// the exact triangle covers its position.
#[test]
fn masks_are_the_exact_coverage_of_every_sample() {
    let mut bits = [0u32; 2];
    for (samples, offsets) in FROM_CENTRE {
        for (rule, exact) in [(FillRule::TopLeft, Rule::TopLeft), (FillRule::Shadow, Rule::Shadow)]
        {
            let base = profile(samples, DepthAt::Centre, rule);
            for (n, machine) in triangle_machines().map(|kind| kind.name).enumerate() {
                let profile = Profile { depth: None, ..base.clone() };
                let profile = profile.with_machine(machine).unwrap();
                if !profile.covers_exactly() {
                    continue;
                }
                for index in 0..60 {
                    // Vertices on eighths of pixels meet samples and edges through samples.
                    let mut words = Words::new(3, 7, index + 100 * n as u64);
                    let mut at = || [words.between(0, 40) * 2, words.between(0, 32) * 2];
                    let triangle = Triangle { xy: [at(), at(), at()], z: None };
                    let drawing = drawn(&profile, &triangle);
                    let mut masks = vec![0; 20];
                    let mut given = drawing.masks.iter();
                    for span in &drawing.spans {
                        for x in span.x0..span.x1 {
                            masks[(span.y * 5 + x) as usize] = *given.next().unwrap();
                        }
                    }
                    assert!(given.next().is_none());
                    for (place, mask) in (0i128..).zip(&masks) {
                        let centre = [place % 5 * 16 + 8, place / 5 * 16 + 8];
                        for (n, offset) in offsets.iter().enumerate() {
                            let at = [centre[0] + offset[0], centre[1] + offset[1]];
                            let wanted = covers(triangle.xy, at, exact);
                            assert_eq!(mask >> n & 1 == 1, wanted, "{machine} {triangle:?} {at:?}");
                            bits[usize::from(wanted)] += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(bits.iter().all(|count| *count > 10_000), "{bits:?}");
}

/// Clause U-3: depth at the centre is the plane's there, at samples the plane's at each.
#[test]
fn depth_is_that_of_the_centre_or_of_each_sample() {
    for (samples, offsets) in FROM_CENTRE {
        for at in [DepthAt::Centre, DepthAt::Sample] {
            let mut profile = profile(samples, at, FillRule::TopLeft);
            let depth = profile.depth.as_mut().unwrap();
            // Enough fraction that no rounding reaches the code, and nothing near a whole code.
            depth.interpolation = 40;
            depth.rounding = Rounding::Floor;
            let triangle = Triangle {
                xy: [[3, 1], [75, 9], [20, 60]],
                z: Some([1_000_003, 9_000_017, 5_000_011]),
            };
            let drawing = drawn(&profile, &triangle);
            let code = |x: i128, y: i128| {
                let exact = plane_at(triangle.xy, triangle.z.unwrap(), [x, y]).unwrap();
                u64::try_from(round(&exact, Rounding::Floor)).unwrap()
            };
            let mut wanted = Vec::new();
            let pixels = drawing
                .spans
                .iter()
                .flat_map(|s| (s.x0..s.x1).map(|x| (x, s.y)).collect::<Vec<_>>());
            for ((x, y), mask) in pixels.zip(&drawing.masks) {
                let centre = [i128::from(x) * 16 + 8, i128::from(y) * 16 + 8];
                match at {
                    DepthAt::Centre => wanted.push(code(centre[0], centre[1])),
                    DepthAt::Sample => {
                        for (_, [dx, dy]) in
                            offsets.iter().enumerate().filter(|(n, _)| mask >> n & 1 == 1)
                        {
                            wanted.push(code(centre[0] + dx, centre[1] + dy));
                        }
                    }
                }
            }
            assert!(wanted.len() > 8);
            assert_eq!(drawing.depth, wanted, "{samples} {at:?}");
        }
    }
}

/// Clause U-4: a sliver over the whole range, a sample at its far end and the centre half a pixel on:
/// two guard bits are enough down to a third of a pixel.
#[test]
fn extrapolation_to_the_centre_wraps_below_a_third_of_a_pixel() {
    let mut profile = load("sgi-4k").unwrap();
    profile.window = WindowConfig { width: 8, height: 2 };
    let wraps = |profile: &Profile, width: i128| {
        // The tip lies one sub-pixel right of sample 12 of pixel (4, 0), at its left border.
        let tip = [4 * 1024 + 1, 512];
        let z = Some([0, 0, (1 << 24) - 1]);
        let xy = [[tip[0] - width, 0], [tip[0] - width, 1024], tip];
        let drawing = drawn(profile, &Triangle { xy, z });
        assert!(drawing.masks.iter().any(|mask| mask >> 12 & 1 == 1), "the sample is covered");
        drawing.events.total.count(Event::Wrap)
    };
    for (at, below, above) in [(DepthAt::Centre, 1, 0), (DepthAt::Sample, 0, 0)] {
        profile.multisample = Some(MultisampleConfig::standard(16, at));
        assert_eq!(wraps(&profile, 1024 / 3 - 12), below, "{at:?}");
        assert_eq!(wraps(&profile, 1024 / 3 + 12), above, "{at:?}");
    }
}

/// What eval answers of a profile with four samples: masks beside rows.
#[test]
fn eval_answers_masks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("four.toml");
    let mut four = load("d3d11").unwrap();
    four.multisample = Some(MultisampleConfig::standard(4, DepthAt::Centre));
    std::fs::write(&path, four.to_toml()).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_guardbit"))
        .args(["eval", path.to_str().unwrap()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // Left half of pixel (0, 0) and all of its height: samples 0 (6,2) and 2 (2,10).
    let line = b"{\"id\": 1, \"v\": [[0,0],[128,0],[0,131072]]}\n";
    child.stdin.take().unwrap().write_all(line).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("[0, 0, 1]") && text.contains("\"masks\": [5, 5, "), "{text}");
}

#[test]
fn positions_off_the_grid_and_other_counts_are_refused() {
    let refused = |change: &dyn Fn(&mut Profile)| {
        let mut profile = profile(4, DepthAt::Sample, FillRule::TopLeft);
        change(&mut profile);
        profile.validate().unwrap_err().to_string()
    };
    let text = refused(&|p| p.multisample.as_mut().unwrap().samples = 3);
    assert!(text.contains("samples = 3"), "{text}");
    let text = refused(&|p| p.vertex.sub_pixel = 3);
    assert!(text.contains("sub-pixel = 3 < 4"), "{text}");
    let text = refused(&|p| p.sample = Some(guardbit::cover::SampleConfig::sub_pixels(1, 1)));
    assert!(text.contains("[sample]"), "{text}");
    let text = refused(&|p| *p = p.with_machine("gouraud").unwrap());
    assert!(text.contains("gouraud"), "{text}");
}
