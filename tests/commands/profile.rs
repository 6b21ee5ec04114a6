//! Profiles as files: built-ins, schema, neighbours, and errors that name line and field.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::Rounding;
use guardbit::format::Clamp;
use guardbit::profile::{BUILTIN, Profile, load, neighbours, parse, schema};
use guardbit::setup::Division;
use serde_json::Value;
use std::collections::BTreeSet;

fn builtins() -> Vec<Profile> {
    BUILTIN.iter().map(|(name, text)| parse(text, name).unwrap()).collect()
}

// Clauses F-4, F-5
#[test]
fn built_in_profiles_are_valid_and_survive_a_round_trip() {
    for (profile, (name, _)) in builtins().iter().zip(BUILTIN) {
        assert_eq!(profile.name, name);
        assert!(!profile.about.is_empty());
        assert_eq!(profile.validate(), Ok(()));
        let text = profile.to_toml();
        let again = parse(&text, "again").unwrap();
        assert_eq!((&again, again.to_toml()), (profile, text));
        assert_eq!(&load(name).unwrap(), profile);
    }
}

/// Dotted names of all keys of a TOML table.
fn keys(prefix: &str, table: &toml::Table, out: &mut BTreeSet<String>) {
    for (key, value) in table {
        let name = format!("{prefix}{key}");
        if let toml::Value::Table(inner) = value {
            keys(&format!("{name}."), inner, out);
        }
        out.insert(name);
    }
}

/// The schema node of a `$ref`, or the node itself.
fn resolve<'a>(root: &'a Value, node: &'a Value) -> Vec<&'a Value> {
    let mut all = vec![node];
    if let Some(path) = node["$ref"].as_str() {
        all.extend(resolve(root, root.pointer(path.trim_start_matches('#')).unwrap()));
    }
    for list in ["anyOf", "oneOf", "allOf"] {
        for child in node[list].as_array().into_iter().flatten() {
            all.extend(resolve(root, child));
        }
    }
    all
}

/// Whether the schema knows a dotted name.
fn knows(root: &Value, node: &Value, name: &str) -> bool {
    let (key, rest) = name.split_once('.').map_or((name, None), |(key, rest)| (key, Some(rest)));
    resolve(root, node).into_iter().any(|node| match (&node["properties"][key], rest) {
        (Value::Null, _) => false,
        (_, None) => true,
        (child, Some(rest)) => knows(root, child, rest),
    })
}

/// Every object of the schema that has properties.
fn objects<'a>(node: &'a Value, out: &mut Vec<&'a Value>) {
    match node {
        Value::Object(map) => {
            if map.contains_key("properties") && map.get("type") == Some(&"object".into()) {
                out.push(node);
            }
            map.values().for_each(|child| objects(child, out));
        }
        Value::Array(list) => list.iter().for_each(|child| objects(child, out)),
        _ => {}
    }
}

// Clause F-5
#[test]
fn the_schema_names_every_field_and_denies_others() {
    let schema: Value = serde_json::from_str(&schema()).unwrap();
    let mut used = BTreeSet::new();
    for (_, text) in BUILTIN {
        keys("", &text.parse().unwrap(), &mut used);
    }
    // What no built-in uses, but files may.
    let more = ["sample.x", "sample.y", "depth.division.reciprocal.bits"].map(str::to_owned);
    for name in used.iter().chain(&more) {
        assert!(knows(&schema, &schema, name), "{name} is not in the schema");
    }
    assert!(!knows(&schema, &schema, "depth.gard") && !knows(&schema, &schema, "sample.z"));
    let mut all = Vec::new();
    objects(&schema, &mut all);
    assert!(all.len() >= 7, "profile, window, vertex, sample, two forms, depth: {}", all.len());
    for object in all {
        assert_eq!(object["additionalProperties"], false, "{object}");
    }
}

// Clause F-4
#[test]
fn neighbours_are_valid_and_differ_in_one_decision() {
    for profile in builtins() {
        let neighbours = neighbours(&profile);
        assert!(neighbours.len() > 7, "{}: {}", profile.name, neighbours.len());
        let mut seen: Vec<Profile> = Vec::new();
        let mut named = BTreeSet::new();
        for neighbour in neighbours {
            assert_eq!(neighbour.profile.validate(), Ok(()), "{}", neighbour.change);
            assert_ne!(neighbour.profile, profile, "{}", neighbour.change);
            assert!(!seen.contains(&neighbour.profile), "twice: {}", neighbour.change);
            assert!(named.insert(neighbour.change.clone()), "twice: {}", neighbour.change);
            assert!(neighbour.change.contains(" instead of "), "{}", neighbour.change);
            // One decision: one line of TOML, or one table, of six lines at most.
            let [old, new]: [BTreeSet<String>; 2] = [&profile, &neighbour.profile]
                .map(|p| p.to_toml().lines().map(str::to_owned).collect());
            assert!(old.difference(&new).count() <= 6, "{}", neighbour.change);
            seen.push(neighbour.profile);
        }
    }
    // Every rounding and clamp is tried.
    let sgi = load("sgi-4k").unwrap();
    let found = neighbours(&sgi);
    let depths: Vec<_> = found.iter().filter_map(|n| n.profile.depth).collect();
    for rounding in Rounding::ALL {
        assert!(depths.iter().any(|depth| depth.rounding == rounding), "{rounding}");
    }
    // But no device can refuse: `error` answers as `guard` does.
    for clamp in Clamp::ALL.into_iter().filter(|clamp| *clamp != Clamp::Error) {
        assert!(depths.iter().any(|depth| depth.clamp == clamp), "{}", clamp.name());
    }
    assert!(depths.iter().any(|depth| depth.division == Division::Reciprocal { bits: 24 }));
}

/// The message for the tiny profile with one replacement.
fn message(from: &str, to: &str) -> String {
    let text = BUILTIN[3].1;
    assert_eq!(text.matches(from).count(), 1, "{from}");
    parse(&text.replace(from, to), "p.toml").unwrap_err().to_string()
}

fn line_of(text: &str) -> usize {
    1 + BUILTIN[3].1.lines().position(|line| line.starts_with(text)).unwrap()
}

// Clause F-4
#[test]
fn errors_name_file_line_and_field() {
    for (from, to, field, says) in [
        ("schema = 1", "schema = 2", "schema", "schema 1"),
        ("name = \"tiny\"", "name = \"../tiny\"", "name", "a-z A-Z 0-9"),
        ("\nwidth = 4", "\nwidth = 0", "window", "1 to 65536"),
        ("integer = 2", "integer = 40", "vertex", "40 + 1 = 41"),
        ("integer = 2", "integer = -2", "vertex.integer", "-2"),
        ("sub-pixel = 1", "sub-pixel = \"1\"", "vertex.sub-pixel", "string"),
        ("snap = \"nearest-even\"", "snap = \"round\"", "vertex.snap", "round"),
        ("width = 6", "width = 121", "form.edge-function.width", "121"),
        ("rule = \"top-left\"", "rule = \"bottom\"", "form.edge-function.rule", "shadow"),
        ("interpolation = 3", "interpolation = 118", "depth", "at most 120"),
        ("interpolation = 3", "interpolation = 110", "depth.interpolation", "> 126"),
        (
            "division = \"quotient\"",
            "division = { reciprocal = { bits = 1 } }",
            "depth.division",
            "2 to 40",
        ),
        ("integer = 3", "integer = 65", "depth.integer", "1 to 64"),
        ("guard = 1", "gard = 1", "depth.gard", "guard"),
    ] {
        let message = message(from, to);
        let line = line_of(from.trim_start());
        // A sum has no line of its own: it is reported at its table.
        let place = if ["window", "vertex", "depth"].contains(&field) {
            format!("p.toml:{}: {field}: ", line_of(&format!("[{field}]")))
        } else {
            format!("p.toml:{line}: {field}: ")
        };
        assert!(message.starts_with(&place), "{message}\nis not {place}");
        assert!(message.contains(says), "{message}\nlacks {says}");
        assert!(!message.contains('\n'), "{message}");
    }
    let missing = message("snap = \"nearest-even\"\n", "");
    let place = format!("p.toml:{}: vertex: ", line_of("[vertex]"));
    assert!(missing.starts_with(&place) && missing.contains("snap"), "{missing}");
    let nothing = parse("", "p.toml").unwrap_err().to_string();
    assert!(nothing.starts_with("p.toml:1: ") && nothing.contains("schema"), "{nothing}");
    let broken = parse("schema = 1\nname = \n", "p.toml").unwrap_err().to_string();
    assert!(broken.starts_with("p.toml:2: "), "{broken}");
}

#[test]
fn unknown_names_list_the_known_ones() {
    let message = load("sgi").unwrap_err().to_string();
    assert!(BUILTIN.iter().all(|(name, _)| message.contains(name)), "{message}");
    let missing = load("./no-such.toml").unwrap_err();
    assert!(missing.is_io() && missing.to_string().starts_with("./no-such.toml: "), "{missing}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.toml");
    std::fs::write(&path, b"schema = 1\n\xff").unwrap();
    let message = load(path.to_str().unwrap()).unwrap_err().to_string();
    assert!(message.contains("byte 11 is not UTF-8"), "{message}");
}
