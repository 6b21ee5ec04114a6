//! `guardbit envelope` as a process.

use crate::run::{Ran, run_in};
use serde_json::Value;
use std::path::Path;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn run(line: &str) -> Ran {
    run_in(Path::new(ROOT), line)
}

fn json(line: &str) -> Value {
    serde_json::from_str(&run(&format!("{line} --json")).ends(0).out).unwrap()
}

/// Clauses EN-2, EN-3 and EN-7: a triangle around one sample, which the grids of few bits lose, and a repair that
/// holds from 6 bits on. By hand: in units of 2^-b pixels the corners are off the sample by 0.007 2^b and 0.015 2^b,
/// which nearest rounds to 0 up to 6 and up to 5 bits.
#[test]
fn a_sliver_that_a_device_of_few_bits_loses_is_flagged() {
    let scene = "envelope --scene examples/webgpu-sliver.jsonl --window 8x8";
    for (bits, want) in [(4, [0, 0]), (5, [0, 0]), (6, [0, 1]), (7, [1, 1]), (8, [1, 1])] {
        let report = json(&format!("{scene} --api webgpu --bits {bits} --snap nearest-even"));
        let must: Vec<&Value> =
            report["triangles"].as_array().unwrap().iter().map(|count| &count[0]).collect();
        assert_eq!(must, [want[0], want[1]], "{bits} bits");
        assert_eq!(report["may"], 0);
    }
    let report = json(&format!("{scene} --api webgpu --robust"));
    assert_eq!(
        (&report["must"], &report["may"], &report["must_not"]),
        (&0.into(), &1.into(), &63.into())
    );
    for listed in report["listed"].as_array().unwrap() {
        assert_eq!(listed["pixels"][0]["x"], 3);
        let robust = &listed["robust"];
        assert_eq!(robust["found"], true, "{listed}");
        // The repaired triangle is decided, and covers the pixel.
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("moved.jsonl");
        std::fs::write(&path, format!("{{\"f\": {}}}\n", robust["f"])).unwrap();
        let moved = json(&format!("envelope --api webgpu --window 8x8 --scene {}", path.display()));
        assert_eq!((&moved["must"], &moved["may"]), (&1.into(), &0.into()), "{listed}");
    }
    // Direct3D has 8 bits, which are enough.
    assert_eq!(json(&format!("{scene} --api d3d11"))["must"], 1);
}

/// The README shows the command with its output.
#[test]
fn the_readme_shows_the_sliver() {
    let readme = std::fs::read_to_string(Path::new(ROOT).join("README.md")).unwrap();
    let (_, rest) = readme.split_once("$ guardbit envelope").expect("the README has an example");
    let (line, output) = rest.split_once("```").unwrap().0.split_once('\n').unwrap();
    assert_eq!(run(&format!("envelope{line}")).ends(0).out, output);
}

/// Clause EN-6: a PNG and the answers of `eval` are judged alike.
#[test]
fn a_picture_is_legal_or_the_pixel_and_the_clause_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    // Corner at the origin, edges away from samples but for the hypotenuse, which is 1/4 pixel off.
    std::fs::write(at("s.jsonl"), "{\"f\": [[0, 0], [3.25, 0], [0, 3.25]]}\n").unwrap();
    let check = |picture: &str| {
        let line = format!("envelope --api vulkan --window 4x4 --scene s.jsonl --check {picture}");
        run_in(folder.path(), &line)
    };
    let rows = "{\"rows\": [[0, 0, 3], [1, 0, 2], [2, 0, 1]]}";
    std::fs::write(at("good.jsonl"), format!("{rows}\n")).unwrap();
    let good = check("good.jsonl").ends(0).out;
    assert!(good.contains("LEGAL: drawn with 4 bits, floor, top-left; 90 of 90 ways"), "{good}");
    std::fs::write(at("bad.jsonl"), rows.replace("[1, 0, 2]", "[1, 1, 3]")).unwrap();
    let bad = check("bad.jsonl").ends(1).out;
    assert!(
        bad.contains("  (0, 1) is not covered, but every rasterizer covers it (EN-4)\n"),
        "{bad}"
    );
    assert!(bad.contains("  (2, 1) is covered, but no rasterizer covers it (EN-4)\n"), "{bad}");
    assert!(bad.contains("NOT LEGAL: 2 pixels are not as Vulkan 1.3 asks"), "{bad}");
    // The same as pictures: grey, and colours with an alpha that does not matter.
    for (name, colour, pixel) in [
        ("grey.png", png::ColorType::Grayscale, &[1u8][..]),
        ("rgba.png", png::ColorType::Rgba, &[0, 0, 9, 0]),
    ] {
        let covered = |n: usize| n % 4 + n / 4 < 3;
        let black = vec![0; pixel.len() - usize::from(pixel.len() == 4)];
        let black = [&black[..], &[255][..usize::from(pixel.len() == 4)]].concat();
        let bytes: Vec<u8> =
            (0..16).flat_map(|n| if covered(n) { pixel.to_vec() } else { black.clone() }).collect();
        let mut encoder = png::Encoder::new(std::fs::File::create(at(name)).unwrap(), 4, 4);
        encoder.set_color(colour);
        encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
        let ran = check(name).ends(0).out;
        assert!(ran.contains("90 of 90 ways"), "{name}: {ran}");
    }
    let line = "envelope --api vulkan --window 5x4 --scene s.jsonl --check grey.png";
    run_in(folder.path(), line).complains(2, &["4 x 4 pixels", "5 x 4", "--window 4x4"]);
    // The window as a picture: MUST is green where the window is enlarged to 256 pixels.
    let line = "envelope --api vulkan --window 4x4 --scene s.jsonl --png out.png";
    let ran = run_in(folder.path(), line).ends(0).out;
    assert!(ran.contains("out.png: 256 x 256; green: MUST, yellow: MAY, dark: MUST NOT"), "{ran}");
    let file = std::io::BufReader::new(std::fs::File::open(at("out.png")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    let at = |x: usize, y: usize| &bytes[(y * 256 + x) * 3..][..3];
    assert_eq!((at(0, 0), at(130, 63), at(130, 64)), (at(63, 63), at(0, 0), at(255, 255)));
    assert_ne!(at(0, 0), at(255, 255));
}

#[test]
fn what_cannot_be_asked_is_said() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("s.jsonl", "{\"v\": [[0,0],[64,0],[0,64]]}\n"),
        ("far.jsonl", "{\"v\": [[0,0],[64,0],[0,64]]}\n{\"f\": [[0,0],[1,40000.5],[2,2]]}\n"),
        ("nan.jsonl", "{\"f\": [[0,0],[1,{\"bits\": \"7fc00000\"}],[2,2]]}\n"),
        ("empty.jsonl", "\n"),
        ("text.jsonl", "{\"rows\": 7}\n"),
        ("out.jsonl", "{\"rows\": [[0, 0, 65]]}\n"),
        ("error.jsonl", "{\"id\": 1, \"error\": \"no\"}\n"),
        ("broken.png", "\u{89}PNG"),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    std::fs::write(folder.path().join("broken.png"), b"\x89PNG\r\n\x1a\nnothing").unwrap();
    for (line, says) in [
        ("--api metal --scene s.jsonl", &["`metal` is not known", "vulkan (Vulkan 1.3)"][..]),
        ("--api vulkan-1.0 --scene s.jsonl", &["`vulkan-1.0` is not known"]),
        ("--api vulkan --scene s.jsonl --bits 8..4", &["--bits 8..4: low <= high"]),
        ("--api vulkan --scene s.jsonl --bits 3..4", &["4 <= sub-pixel bits <= 16"]),
        ("--api vulkan --scene s.jsonl --bits many", &["4..12 or 8"]),
        ("--api d3d11 --scene s.jsonl --bits 4..8", &["8 <= sub-pixel bits <= 8", "exactly"]),
        ("--api d3d11 --scene s.jsonl --snap floor", &["--snap floor", "nearest-even"]),
        ("--api vulkan --scene s.jsonl --within 0.3", &["multiple of 1/16"]),
        ("--api vulkan --scene s.jsonl --window 0x4", &["viewport 0 x 4"]),
        ("--api vulkan --scene s.jsonl --window 65536x65536", &["2^24"]),
        ("--api vulkan --scene far.jsonl", &["line 2: vertex 1", "y <= 32767", "40000.5"]),
        ("--api d3d11 --scene nan.jsonl", &["line 1: vertex 1, y is NaN"]),
        ("--api vulkan --scene empty.jsonl", &["no triangles"]),
        ("--api vulkan --scene s.jsonl --check text.jsonl", &["text.jsonl: line 1"]),
        ("--api vulkan --scene s.jsonl --check out.jsonl", &["[0, 0, 65] is not in the window"]),
        ("--api vulkan --scene s.jsonl --check error.jsonl", &["answered an error: no"]),
        ("--api vulkan --scene s.jsonl --check empty.jsonl", &["there is no picture"]),
        ("--api vulkan --scene s.jsonl --check broken.png", &["broken.png: "]),
    ] {
        run_in(folder.path(), &format!("envelope {line}")).complains(2, says);
    }
    run_in(folder.path(), "envelope --api vulkan --scene s.jsonl --check none.png")
        .complains(3, &["none.png"]);
}
