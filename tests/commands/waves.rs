//! Waves of `trace`, as a viewer reads them.
#![cfg(feature = "cli")]

use crate::command::home;
use crate::run::run_in;
use crate::set::tv_rows;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Signals by name with their widths, and the values of all at each time at which one changes.
type Waves = (Vec<(String, u32)>, Vec<(u64, BTreeMap<String, String>)>);

fn waves(path: &Path) -> Waves {
    let mut parser = vcd::Parser::new(BufReader::new(File::open(path).unwrap()));
    let header = parser.parse_header().unwrap();
    assert_eq!(header.timescale, Some((1, vcd::TimescaleUnit::NS)));
    let mut names = BTreeMap::new();
    let mut list = Vec::new();
    let module = header.items.iter().find_map(|item| match item {
        vcd::ScopeItem::Scope(scope) => Some(scope),
        _ => None,
    });
    for item in &module.unwrap().items {
        if let vcd::ScopeItem::Var(var) = item {
            names.insert(var.code, var.reference.clone());
            list.push((var.reference.clone(), var.size));
        }
    }
    let (mut now, mut state, mut samples) = (0, BTreeMap::new(), Vec::new());
    for command in parser {
        match command.unwrap() {
            vcd::Command::Timestamp(time) => {
                if !state.is_empty() {
                    samples.push((now, state.clone()));
                }
                now = time;
            }
            vcd::Command::ChangeScalar(id, value) => {
                state.insert(names[&id].clone(), value.to_string());
            }
            vcd::Command::ChangeVector(id, value) => {
                state.insert(names[&id].clone(), value.to_string());
            }
            other => panic!("{other:?}"),
        }
    }
    (list, samples)
}

#[test]
fn waves_hold_the_rows_of_the_test() {
    let home = home();
    for (profile, test) in [
        ("tiny", "dda/guard-boundary/3"),
        ("sgi-4k", "dda/random/2"),
        ("tiny", "edge/widest-slopes/1"),
    ] {
        let arguments =
            format!("trace {profile} --scene fan --test {test} --vcd a.vcd --fst a.fst");
        let text = run_in(home.path(), &arguments).ends(0).out;
        assert!(text.starts_with(&format!("{test}: a walk from ")), "{text}");
        let only = format!("vectors {profile} --scene fan --only {test}");
        let only = run_in(home.path(), &only).ends(0).out;
        let rows = |end: &str| -> Vec<Vec<u128>> {
            let lines = only.lines().filter_map(|line| line.split_once(&format!("{end}: ")));
            tv_rows(&lines.map(|(_, row)| row).collect::<Vec<_>>().join("\n"))
        };
        let (cfg, exp) = (rows("cfg.tv"), rows("exp.tv"));
        assert!(cfg.len() == 1 && exp.len() >= 8, "{only}");
        assert_eq!(text.lines().filter(|line| line.contains("  op=")).count(), exp.len());
        let (signals, samples) = waves(&home.path().join("a.vcd"));
        let names: Vec<&str> = signals.iter().map(|(name, _)| name.as_str()).collect();
        let expected = if test.starts_with("dda") {
            ["clk", "init", "dx", "dy", "op", "acc", "out_v"]
        } else {
            ["clk", "e0", "ea", "eb", "op", "e", "in_v"]
        };
        assert_eq!(names, expected);
        // One clock a row: up at its start, down in its middle.
        let up: Vec<_> = samples.iter().filter(|(_, state)| state["clk"] == "1").collect();
        assert_eq!(up.len(), exp.len());
        for (n, ((time, state), row)) in up.into_iter().zip(&exp).enumerate() {
            assert_eq!(*time, 10 * n as u64);
            let words = cfg[0].iter().chain(row);
            for ((name, width), word) in signals[1..].iter().zip(words) {
                let bits = &state[name];
                assert_eq!(bits.len(), *width as usize, "{name}");
                assert_eq!(u128::from_str_radix(bits, 2).unwrap(), *word, "{test} {n} {name}");
            }
        }
        // An FST begins with its header block: kind 0, 329 bytes long.
        let fst = std::fs::read(home.path().join("a.fst")).unwrap();
        assert!(fst.len() > 400);
        assert_eq!(fst[..9], [0, 0, 0, 0, 0, 0, 0, 1, 0x49]);
        run_in(home.path(), &arguments).ends(0);
        assert_eq!(std::fs::read(home.path().join("a.fst")).unwrap(), fst, "the same again");
    }
    // Triangles have a text, too.
    for test in ["setup/random/3", "triangle/random/1"] {
        let ran = run_in(home.path(), &format!("trace tiny --scene fan --test {test}")).ends(0);
        assert!(ran.out.starts_with(&format!("{test}: triangle (")), "{}", ran.out);
    }
    run_in(home.path(), "trace tiny --test none").complains(2, &["no test \"none\""]);
    // Without a test, the first one of a profile that has no walk.
    assert!(run_in(home.path(), "trace ps1").ends(0).out.starts_with("words/"));
    for wave in ["--vcd none/a", "--fst none/a"] {
        run_in(home.path(), &format!("trace tiny --scene fan {wave}")).complains(3, &["none/a"]);
    }
}
