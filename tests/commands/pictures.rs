//! Pictures of `render`.
#![cfg(feature = "cli")]

use crate::command::home;
use crate::run::run_in;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Width, height and pixels of a PNG.
fn picture(path: &Path) -> (u32, u32, Vec<[u8; 3]>) {
    let decoder = png::Decoder::new(BufReader::new(File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let pixels = bytes.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
    (info.width, info.height, pixels)
}

#[test]
fn every_picture_has_its_size_and_more_than_one_colour() {
    let home = home();
    let mut pictures = BTreeSet::new();
    for show in ["image", "depth", "coverage", "error"] {
        for profile in ["sgi-4k", "sgi-4k-walk"] {
            let out = format!("{show}-{profile}.png");
            let arguments = format!(
                "render {profile} --scene terrain --window 60x40 --zoom 3 --show {show} --out {out}"
            );
            let ran = run_in(home.path(), &arguments).ends(0);
            assert!(
                ran.out.starts_with(&format!("{out}: 180 x 120, 2048 triangles")),
                "{}",
                ran.out
            );
            let (width, height, pixels) = picture(&home.path().join(&out));
            assert_eq!((width, height), (180, 120));
            let colours: BTreeSet<&[u8; 3]> = pixels.iter().collect();
            assert!(colours.len() >= 3, "{out}: {colours:?}");
            // Each pixel is a block of three by three.
            for (n, pixel) in pixels.iter().enumerate() {
                let (x, y) = (n % 180 / 3 * 3, n / 180 / 3 * 3);
                assert_eq!(*pixel, pixels[y * 180 + x]);
            }
            pictures.insert(pixels);
        }
    }
    assert!(pictures.len() >= 4, "different things look different: {}", pictures.len());
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 8, "nothing else is left");
}

#[test]
fn the_walked_edge_shows_its_errors_and_the_exact_machine_has_none() {
    let home = home();
    let summary = |profile: &str| {
        let arguments = format!("render {profile} --scene fan --window 64x64 --show error");
        run_in(home.path(), &arguments).ends(0).out
    };
    let exact = summary("sgi-4k");
    assert!(exact.contains(", 0 missing, 0 extra, depth error worst 0."), "{exact}");
    assert!(home.path().join("guardbit.png").is_file());
    // A window cut to one corner draws that corner only.
    let arguments = "render sgi-4k --scene fan --window 64x64 --scissor 0,0,32,64 --show coverage";
    run_in(home.path(), arguments).ends(0);
    let (width, _, pixels) = picture(&home.path().join("guardbit.png"));
    let drawn = |right: bool| {
        let mine = pixels.iter().enumerate();
        let mine = mine.filter(|(n, _)| (n % width as usize >= width as usize / 2) == right);
        mine.map(|(_, pixel)| pixel).collect::<BTreeSet<_>>().len()
    };
    assert_eq!((drawn(true), drawn(false) > 1), (1, true));
}

#[test]
fn pictures_that_cannot_be_are_refused() {
    let home = home();
    for (window, about) in [
        ("0x5", "0 x 5: a window has 1 to 65536"),
        ("5x0", "1 to 65536"),
        ("70000x5", "70000 x 5"),
        ("5", "a size is WIDTHxHEIGHT"),
        ("axb", "a size is WIDTHxHEIGHT"),
        ("", "a size is WIDTHxHEIGHT"),
        ("99999999999x5", "a size is WIDTHxHEIGHT"),
        ("65536x65536", "at most 2^26 pixels"),
        ("4096x4096 --zoom 256", "at most 2^26 pixels"),
        ("8x8 --zoom 0", "0"),
        ("8x8 --scissor 3,0,2,8", "X0 <= X1"),
        ("8x8 --scissor 3,0,2", "X0 <= X1"),
    ] {
        run_in(home.path(), &format!("render tiny --scene fan --window={window}"))
            .complains(2, &[about]);
    }
    run_in(home.path(), "render tiny --scene fan --out none/a.png").complains(3, &["none/a.png"]);
    run_in(home.path(), "render tiny --scene fan --out .").complains(3, &["."]);
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0, "nothing is left behind");
}
