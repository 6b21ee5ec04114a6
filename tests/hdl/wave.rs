//! The waves of `guardbit trace` and those of a bench: the same scopes, names, widths and words.

// Clause J-4.
use crate::run::run_in;
use crate::set::{Set, build_icarus, good};
use std::collections::BTreeMap;
use std::path::Path;
use vcd::{Command, Parser, ScopeItem, Value};

/// A signal's width and its words at the rising edges of `clk`, as text.
type Signals = BTreeMap<String, (u32, Vec<String>)>;

/// The signals of one scope. A word is what stands just before the falling edge: there benches
/// compare, and a trace shows the row of its clock.
fn signals(path: &Path, scope: &[&str]) -> Signals {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut parser = Parser::new(file);
    let header = parser.parse_header().unwrap();
    // Icarus opens the outer scope anew for each inner one.
    let mut items: Vec<&ScopeItem> = header.items.iter().collect();
    for name in scope {
        let scopes = items.into_iter().filter_map(|item| match item {
            ScopeItem::Scope(scope) if scope.identifier == *name => Some(&scope.items),
            _ => None,
        });
        items = scopes.flatten().collect();
    }
    assert!(!items.is_empty(), "no scope {scope:?}");
    let mut names = BTreeMap::new();
    let mut found = Signals::new();
    for item in items {
        if let ScopeItem::Var(var) = item {
            names.insert(var.code, var.reference.clone());
            found.insert(var.reference.clone(), (var.size, Vec::new()));
        }
    }
    let mut now: BTreeMap<String, String> = BTreeMap::new();
    let mut falls = false;
    let mut before = now.clone();
    for command in parser {
        match command.unwrap() {
            Command::Timestamp(_) => {
                if falls {
                    for (name, (_, words)) in &mut found {
                        words.push(before.get(name).cloned().unwrap_or_default());
                    }
                }
                falls = false;
                before.clone_from(&now);
            }
            Command::ChangeScalar(code, value) => {
                let Some(name) = names.get(&code) else { continue };
                falls |= name == "clk" && value == Value::V0 && now.contains_key("clk");
                now.insert(name.clone(), value.to_string());
            }
            Command::ChangeVector(code, value) => {
                if let Some(name) = names.get(&code) {
                    // Leading zeros may be left out.
                    let text = value.to_string();
                    let text = text.trim_start_matches('0');
                    now.insert(name.clone(), if text.is_empty() { "0" } else { text }.to_owned());
                }
            }
            _ => {}
        }
    }
    found
}

pub(crate) fn lines_up(_: &str) {
    let set = Set::new("sgi-4k --count 300 --scene triangle");
    build_icarus(&set.folder);
    good(&set.folder, "vvp", &["-n", "sim.vvp", "+vcd=bench.vcd"]);
    // The first walk of the bench; its class is the first of the set.
    let manifest: serde_json::Value = serde_json::from_str(&set.read("manifest.json")).unwrap();
    let both = |bench: &str, scope: &str| {
        let groups = manifest["groups"].as_array().unwrap();
        let first = groups.iter().find(|group| group["bench"] == bench).unwrap();
        let test = format!("{bench}/{}/0", first["tag"].as_str().unwrap());
        let trace =
            format!("trace sgi-4k --scene triangle --count 300 --test {test} --vcd trace.vcd");
        run_in(&set.folder, &trace).ends(0);
        let theirs = signals(&set.folder.join("bench.vcd"), &["tb", scope]);
        (theirs, signals(&set.folder.join("trace.vcd"), &[scope]))
    };
    for (bench, scope) in [("dda", "dda"), ("edge", "edge_v")] {
        let (theirs, ours) = both(bench, scope);
        assert!(ours.len() >= 6, "{ours:?}");
        let rows = ours["op"].1.len();
        assert!(rows > 3);
        // The bench resets first: the walk begins at its first load.
        let load = theirs["op"].1.iter().position(|op| op == "0").unwrap();
        for (name, (width, words)) in &ours {
            let (their_width, their_words) = theirs.get(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!(width, their_width, "{name}");
            assert_eq!(their_words[load..][..rows], words[..], "{bench} {name}");
        }
    }
    // Streams keep their own time: the words of a record stand together when it is answered, and those of
    // samples come in the trace's order.
    for (bench, key) in [("setup", "edge0_init"), ("triangle", "depth")] {
        let (theirs, ours) = both(bench, bench);
        assert!(ours.len() >= 12 && ours.contains_key(key), "{ours:?}");
        for (name, (width, words)) in ours.iter().filter(|(name, _)| *name != "clk") {
            // The number of a test is the bench's own, and no device counts the events of unwrapped values.
            if ["test", "wrap", "clamp_above", "clamp_below", "inexact"].contains(&name.as_str()) {
                continue;
            }
            let (their_width, their_words) = theirs.get(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!(width, their_width, "{bench} {name}");
            let mut left = their_words.iter();
            assert!(
                words.iter().all(|word| left.any(|their| their == word)),
                "{bench} {name}: {words:?}"
            );
        }
    }
}
