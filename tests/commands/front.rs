//! Sets of profiles whose front of the pipe leaves triangles or samples out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run::run_in;

const TOY: &str = r#"
schema = 1
name = "toy"
window = { width = 8, height = 8 }
vertex = { integer = 3, sub-pixel = 4, signed = false, closed = true, snap = "nearest-even", source = "f64", endless = "refuse" }
form = { edge-function = { rule = "top-left", storage = "shifted", width = 24 } }
"#;

/// Clause FP-10: in a set the flag of no area is set for each triangle that is left out, and it has no runs.
#[test]
fn a_set_flags_the_triangles_that_are_culled() {
    let home = tempfile::tempdir().unwrap();
    let text = format!("{TOY}cull = {{ winding = \"counter-clockwise\" }}\n");
    std::fs::write(home.path().join("toy.toml"), text).unwrap();
    run_in(home.path(), "vectors toy.toml --out set --count 400 --scene fan").ends(0);
    run_in(home.path(), "verify set --recompute").ends(0);
    let read = |name: &str| std::fs::read_to_string(home.path().join("set").join(name)).unwrap();
    let word = |text: &str| i64::from_str_radix(text, 16).unwrap();
    let (mut culled, mut drawn) = (0, 0);
    for (given, made) in read("setup.cfg.tv").lines().zip(read("setup.exp.tv").lines()) {
        let at: Vec<i64> = given.split('_').map(word).collect();
        let area = (at[2] - at[0]) * (at[5] - at[1]) - (at[4] - at[0]) * (at[3] - at[1]);
        let flag = made.rsplit('_').next().map(word);
        assert_eq!(flag, Some(i64::from(area <= 0)), "{given}: {made}");
        *(if area < 0 { &mut culled } else { &mut drawn }) += 1;
    }
    assert!(culled > 50 && drawn > 50, "{culled} {drawn}");
}

/// Clauses FP-1, FP-4 and FP-5: sets of samples between the sub-pixels, and of a mask, are made again alike.
#[test]
fn sets_of_samples_at_any_place_are_made_again() {
    let home = tempfile::tempdir().unwrap();
    for (name, table) in [
        ("one", "sample = { x = 7, y = 7, of = 12 }\n"),
        (
            "three",
            "multisample = { samples = 3, positions = [[1, 3], [5, 7], [11, 2]], of = 12, depth = \"centre\", mask = 5 }\n",
        ),
    ] {
        std::fs::write(home.path().join(format!("{name}.toml")), format!("{TOY}{table}")).unwrap();
        run_in(home.path(), &format!("vectors {name}.toml --out {name} --count 300")).ends(0);
        run_in(home.path(), &format!("verify {name} --recompute")).ends(0);
    }
    let masks = std::fs::read_to_string(home.path().join("three/mask.exp.tv")).unwrap();
    let seen: std::collections::BTreeSet<&str> =
        masks.lines().filter_map(|line| line.rsplit('_').next()).collect();
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), ["1", "4", "5"]);
}
