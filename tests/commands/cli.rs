//! The command as others call it: exit statuses, help, and the conventions of `eval`.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use serde_json::Value;
use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Command, Stdio};

/// Exit status, standard output, standard error.
type Answer = (i32, String, String);

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_guardbit"));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn guardbit(arguments: &[&str], input: &[u8]) -> Answer {
    let mut child = command(arguments).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    // A command that stops early closes the pipe; that is its business.
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code().unwrap(), out, err)
}

/// One error line on standard error, nothing on standard output.
fn refused(arguments: &[&str], status: i32, says: &str) {
    let (code, out, err) = guardbit(arguments, b"");
    assert_eq!((code, out.as_str()), (status, ""), "{arguments:?}\n{err}");
    assert!(err.starts_with("error: ") && err.contains(says), "{arguments:?}\n{err}");
    assert_eq!(err.matches("error: ").count(), 1, "{err}");
    assert!(!err.contains('\u{1b}'), "no colour away from a terminal: {err}");
}

#[test]
fn every_command_has_help() {
    let (code, help, _) = guardbit(&["--help"], b"");
    assert_eq!(code, 0);
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    for known in ["budget", "eval", "profile", "speed"] {
        assert!(names.contains(&known), "{names:?}");
    }
    for name in names.into_iter().filter(|name| *name != "help") {
        let (code, text, err) = guardbit(&[name, "--help"], b"");
        assert_eq!((code, err.as_str()), (0, ""), "{name}");
        assert!(text.contains(&format!("Usage: guardbit {name}")), "{text}");
        assert!(text.lines().next().unwrap().len() > 20, "{name} says what it does: {text}");
    }
    assert_eq!(guardbit(&["--version"], b"").0, 0);
}

#[test]
fn usage_errors_end_with_2() {
    for arguments in [
        &[][..],
        &["--nonsense"],
        &["evil"],
        &["eval", "tiny", "--nonsense"],
        &["profile"],
        &["profile", "show"],
    ] {
        let (code, out, err) = guardbit(arguments, b"");
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}");
        assert!(err.contains("Usage: guardbit"), "{arguments:?}: {err}");
    }
    refused(
        &["eval", "nope"],
        2,
        "no profile \"nope\": give the path of a TOML file, or one of the built-in profiles sgi-4k, ",
    );
    refused(&["budget", "nope"], 2, "no profile \"nope\"");
    refused(&["profile", "show", "nope"], 2, "no profile \"nope\"");
    refused(&["eval", "./no-such.toml"], 3, "./no-such.toml: ");
    refused(&["speed", "--repeats", "0"], 2, "1..=10000");
}

#[test]
fn absurd_windows_are_refused() {
    for window in ["0x5", "5x0", "65537x1", "1x70000"] {
        refused(&["eval", "tiny", "--window", window], 2, "a window has 1 to 65536 pixels");
    }
    for window in ["", "5", "5x", "x5", "-1x5", "99999999999x1", "4x4x4", "1.5x2"] {
        refused(&["eval", "tiny", &format!("--window={window}")], 2, "a size is WIDTHxHEIGHT");
    }
    for scissor in ["", "1,2,3", "1,2,3,4,5", "3,0,1,1", "0,0,-1,1", "a,0,1,1"] {
        refused(
            &["eval", "tiny", &format!("--scissor={scissor}")],
            2,
            "a rectangle is X0,Y0,X1,Y1",
        );
    }
}

// Clause F-4
#[test]
fn a_malformed_profile_names_file_line_and_field() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let path = path.to_str().unwrap();
    let (_, text, _) = guardbit(&["profile", "show", "tiny"], b"");
    let line = 1 + text.lines().position(|line| line.starts_with("clamp")).unwrap();
    for (to, says) in [
        ("clamp = \"guards\"", format!("mine.toml:{line}: depth.clamp: ")),
        ("clam = \"guard\"", format!("mine.toml:{line}: depth.clam: ")),
        ("clamp = 3", format!("mine.toml:{line}: depth.clamp: ")),
        ("clamp = ", format!("mine.toml:{line}: ")),
    ] {
        std::fs::write(path, text.replace("clamp = \"guard\"", to)).unwrap();
        refused(&["eval", path], 2, &says);
        refused(&["budget", path], 2, &says);
    }
    std::fs::write(path, &text).unwrap();
    let triangle = br#"{"v":[[0,0,0],[8,0,7],[0,8,0]]}"#;
    let (mine, builtin) =
        (guardbit(&["eval", path], triangle), guardbit(&["eval", "tiny"], triangle));
    assert_eq!(mine, builtin);
    assert_eq!(mine.0, 0);
}

/// Lines in, lines out.
fn eval(arguments: &[&str], lines: &[&str]) -> (i32, Vec<String>) {
    let arguments: Vec<&str> = ["eval"].iter().chain(arguments).copied().collect();
    let (code, out, err) = guardbit(&arguments, (lines.join("\n") + "\n").as_bytes());
    assert_eq!(err, "");
    (code, out.lines().map(str::to_owned).collect())
}

// Clauses S-2, T-3
#[test]
fn bad_lines_do_not_stop_the_rest() {
    let good = r#"{"id": 9, "v": [[1,1],[3,1],[1,3]]}"#;
    let answer = r#"{"id": 9, "rows": [[0, 0, 1]]}"#;
    for (bad, id, says) in [
        ("nonsense", "null", "column 2: not JSON"),
        ("[]", "null", "a JSON object is needed"),
        (r#"{"id": 1}"#, "1", "exactly one of v, f, words, line, point, polygon, clip"),
        (r#"{"id": 1, "v": [[0,0],[8,0]]}"#, "1", "field `v`: 3 vertices are needed, got 2"),
        (r#"{"id": 1, "v": [[0,0],[8],[0,8]]}"#, "1", "field `v[1]`"),
        (r#"{"id": 1, "v": [[0,0],[8,0,0],[0,8]]}"#, "1", "field `v[1]`"),
        (r#"{"id": 1, "v": [[0,0],[8,0],[0,8.0]]}"#, "1", "field `v[2][1]`: 8.0 is not an integer"),
        (r#"{"id": 1, "v": [[0,0],[8,0],[0,"x"]]}"#, "1", "field `v[2][1]`"),
        (r#"{"id": 1, "v": [[0,0],[9,0],[0,8]]}"#, "1", "v[1][0] = 9 is outside"),
        (r#"{"id": 1, "v": [[0,0],[8,0],[0,8]], "k": 0}"#, "1", "field `k`: unknown key"),
        (
            r#"{"id": 1, "v": [[0,0],[8,0],[0,8]], "v": []}"#,
            "1",
            "field `v`: the key is given twice",
        ),
        (
            r#"{"id": 1, "id": 2, "v": [[0,0],[8,0],[0,8]]}"#,
            "1",
            "field `id`: the key is given twice",
        ),
        (r#"{"id": 1, "v": [[0,0],[8,0],[0,8]], "f": []}"#, "1", "but `v` is given, too"),
        (
            r#"{"id": 1, "f": [[0,0],[1e400,0],[0,1]]}"#,
            "1",
            "field `f[1][0]`: 1e400 is out of range",
        ),
        (r#"{"id": 1, "f": [[0,0],[{"bits": "7f8"},0],[0,1]]}"#, "1", "field `f[1][0].bits`"),
        (r#"{"id": 1, "f": [[0,0],[{"bits": "7fc00000"},0],[0,1]]}"#, "1", "f[1][0] is NaN"),
        (r#"{"id": 1, "line": [[0,0],[1,1,1]]}"#, "1", "field `line[1]`"),
        (r#"{"id": 1, "point": [0,99]}"#, "1", "point[1] = 99"),
        (r#"{"id": 1, "clip": [[0,0,1],[8,0,1],[0,8,1]]}"#, "1", "field `clip`"),
        (r#"{"id": 1, "words": ["00"]}"#, "1", "field `words`"),
    ] {
        let (code, out) = eval(&["tiny"], &[good, bad, "", good]);
        assert_eq!((code, out.len()), (2, 3), "{bad}: {out:?}");
        assert_eq!([&out[0], &out[2]], [answer; 2], "{bad}");
        let start = format!("{{\"id\": {id}, \"error\": \"line 2: ");
        assert!(out[1].starts_with(&start), "{bad}: {}", out[1]);
        let parsed: Value = serde_json::from_str(&out[1]).unwrap();
        let message = parsed["error"].as_str().unwrap();
        assert!(message.contains(says), "{bad}: {message}");
    }
    assert_eq!(eval(&["tiny"], &[good, good]), (0, vec![answer.to_owned(); 2]));
    // Bytes that are no text, and a last line without an end.
    let (code, out, _) =
        guardbit(&["eval", "tiny"], b"\xff\xfe\n{\"id\": 9, \"v\": [[1,1],[3,1],[1,3]]}");
    assert_eq!(code, 2);
    assert!(out.starts_with("{\"id\": null, \"error\": \"line 1: the line is not UTF-8"), "{out}");
    assert_eq!(out.lines().nth(1), Some(answer));
    // Nothing at all is good.
    assert_eq!(guardbit(&["eval", "tiny"], b""), (0, String::new(), String::new()));
    // Lines may end as they do elsewhere.
    let (code, out, _) = guardbit(&["eval", "tiny"], format!("{good}\r\n{good}\r\n").as_bytes());
    assert_eq!((code, out), (0, format!("{answer}\n{answer}\n")));
}

#[test]
fn ids_come_back_as_they_were() {
    for id in [
        "7",
        "-0.50e3",
        "340282366920938463463374607431768211455",
        "\"a\\u00e9 \\\"b\\\"\"",
        "[1, {\"b\":  2}]",
        "null",
        "true",
        "{}",
    ] {
        let good = format!("{{\"v\": [[1,1],[3,1],[1,3]], \"id\":   {id} }}");
        let bad = format!("{{\"v\": 1, \"id\":   {id} }}");
        let (code, out) = eval(&["tiny"], &[&good, &bad]);
        assert_eq!(code, 2);
        assert_eq!(out[0], format!("{{\"id\": {id}, \"rows\": [[0, 0, 1]]}}"));
        assert!(out[1].starts_with(&format!("{{\"id\": {id}, \"error\": ")), "{}", out[1]);
    }
    let (_, out) = eval(&["tiny"], &[r#"{"v": [[1,1],[3,1],[1,3]]}"#]);
    assert_eq!(out, [r#"{"id": null, "rows": [[0, 0, 1]]}"#]);
}

// Clause S-2
#[test]
fn big_integers_are_read_exactly() {
    // Numbers or strings, up to 128 bits; 2^64 + 3 must not pass for 3, nor 2^53 + 1 for 2^53.
    let ask = |x: &str| {
        let (code, out) = eval(&["tiny"], &[&format!("{{\"id\":0,\"v\":[[1,1],[{x},1],[1,3]]}}")]);
        (code, out[0].clone())
    };
    let good = (0, r#"{"id": 0, "rows": [[0, 0, 1]]}"#.to_owned());
    assert_eq!(ask("3"), good);
    assert_eq!(ask("\"3\""), good);
    for wide in [
        "9007199254740993",
        "18446744073709551619",
        "-170141183460469231731687303715884105728",
        "170141183460469231731687303715884105727",
    ] {
        for text in [wide.to_owned(), format!("\"{wide}\"")] {
            let (code, answer) = ask(&text);
            assert_eq!(code, 2);
            assert!(answer.contains(&format!("v[1][0] = {wide} is outside")), "{answer}");
        }
    }
    let (code, answer) = ask("170141183460469231731687303715884105728");
    assert!(code == 2 && answer.contains("out of range"), "{answer}");
    let (code, answer) = ask(&"9".repeat(5000));
    assert!(code == 2 && answer.contains("out of range") && answer.len() < 400, "{answer}");
}

// Clauses S-3, V-2
#[test]
fn reals_are_snapped_and_events_are_told() {
    // In pixels: 1/2 is sub-pixel 1; 0.75 is a tie between 1 and 2 and goes to the even one.
    let (code, out) = eval(
        &["tiny"],
        &[
            r#"{"id": 1, "f": [[0.5,0.5],[1.5,0.5],[0.5,1.5]]}"#,
            r#"{"id": 2, "f": [[0.75,0.5],[1.5,0.5],[0.5,1.5]]}"#,
            r#"{"id": 3, "f": [[{"bits":"3f000000"},5e-1],[{"bits":"3ff8000000000000"},0.5],[0.5,1.5]]}"#,
        ],
    );
    assert_eq!(code, 0);
    assert_eq!(out[0], r#"{"id": 1, "rows": [[0, 0, 1]]}"#);
    assert_eq!(out[1], r#"{"id": 2, "rows": []}"#);
    assert_eq!(out[2], r#"{"id": 3, "rows": [[0, 0, 1]]}"#);
    // Direct3D takes NaN for 0 and an infinity for the end of its field.
    let (code, out) = eval(
        &["d3d11", "--window", "3x3"],
        &[r#"{"id": 1, "f": [[{"bits":"7fc00000"},0],[{"bits":"7f800000"},0],[0,3]]}"#],
    );
    // The far edge runs from (32767 255/256, 0) to (0, 3): right of the window down to row 2.
    assert_eq!((code, &*out[0]), (0, r#"{"id": 1, "rows": [[0, 0, 3], [1, 0, 3], [2, 0, 3]]}"#));
}

// Clause C-6
#[test]
fn scissors_and_windows_take_away() {
    let triangle = r#"{"id": 1, "v": [[0,0,0],[8,0,7],[0,8,0]]}"#;
    for (arguments, rows, z) in [
        (&["--scissor", "1,0,3,2"][..], "[[0, 1, 3], [1, 1, 2]]", "[2, 4, 2]"),
        (
            &["--scissor", "0,0,4294967295,4294967295"],
            "[[0, 0, 3], [1, 0, 2], [2, 0, 1]]",
            "[0, 2, 4, 0, 2, 0]",
        ),
        (&["--scissor", "2,2,2,9"], "[]", "[]"),
        (&["--window", "2x1"], "[[0, 0, 2]]", "[0, 2]"),
        (&["--window", "2X3", "--scissor", "1,1,9,9"], "[[1, 1, 2]]", "[2]"),
    ] {
        let arguments: Vec<&str> = ["tiny"].iter().chain(arguments).copied().collect();
        let (code, out) = eval(&arguments, &[triangle]);
        assert_eq!(code, 0);
        let start = format!("{{\"id\": 1, \"rows\": {rows}, \"z\": {z}");
        assert!(out[0].starts_with(&start), "{arguments:?}: {}", out[0]);
    }
}

#[test]
fn answers_come_line_by_line() {
    let mut child = command(&["eval", "tiny"]).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    for id in 0..3 {
        writeln!(input, "{{\"id\": {id}, \"v\": [[1,1],[3,1],[1,3]]}}").unwrap();
        input.flush().unwrap();
        // The pipe stays open: without a flush this would wait for ever.
        let mut line = String::new();
        output.read_line(&mut line).unwrap();
        assert_eq!(line, format!("{{\"id\": {id}, \"rows\": [[0, 0, 1]]}}\n"));
    }
    drop(input);
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_broken_pipe_is_a_quiet_end() {
    for arguments in [
        &["profile", "schema"][..],
        &["profile", "list"],
        &["budget"],
        &["--help"],
        &["eval", "tiny"],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut child = command(arguments).stdout(writer).spawn().unwrap();
        let mut input = child.stdin.take().unwrap();
        let _ = input.write_all(b"{\"v\": [[1,1],[3,1],[1,3]]}\n");
        drop(input);
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), err.as_str()), (Some(0), ""), "{arguments:?}");
    }
}

#[cfg(unix)]
#[test]
fn failing_input_ends_with_3() {
    let folder = std::fs::File::open(env!("CARGO_MANIFEST_DIR")).unwrap();
    let output = command(&["eval", "tiny"]).stdin(folder).output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{err}");
    assert!(err.starts_with("error: standard input: "), "{err}");
}

#[test]
fn a_line_without_end_does_not_fill_the_memory() {
    let mut input = vec![b'['; (1 << 24) + 5];
    input.extend_from_slice(b"\n{\"id\": 1, \"v\": [[1,1],[3,1],[1,3]]}\n");
    let (code, out, _) = guardbit(&["eval", "tiny"], &input);
    let lines: Vec<&str> = out.lines().collect();
    let refusal = r#"{"id": null, "error": "line 1: the line is longer than 16777216 bytes"}"#;
    // The rest goes on.
    assert_eq!((code, lines), (2, vec![refusal, r#"{"id": 1, "rows": [[0, 0, 1]]}"#]));
}

// Clauses F-3, E-5, D-2
#[test]
fn budgets_are_the_lectures() {
    let (code, text, _) = guardbit(&["budget"], b"");
    assert_eq!(code, 0);
    for line in [
        "vertex: 12 integer + 10 sub-pixel = 22 bits",
        "edge: 35 edge = 35 bits",
        "depth: 2 guard + 24 integer + 13 interpolation = 39 bits",
    ] {
        assert!(text.lines().any(|l| l == line), "{line}\n{text}");
    }
    let fact = |name: &str| {
        let line = text.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
        line.trim_start()[name.len()..].trim().to_owned()
    };
    assert_eq!(fact("exact in this window"), "35 bits: exactly enough");
    // 8191 roundings of 2^-14 are below 1/2: one start and 8190 steps, corner to corner.
    assert_eq!(fact("below half an ULP"), "for 8190 steps");
    assert_eq!(fact("longest walk"), "8190 steps");
    for (name, _) in guardbit::profile::BUILTIN {
        let (code, json, _) = guardbit(&["budget", name, "--json"], b"");
        let report: Value = serde_json::from_str(&json).unwrap();
        assert_eq!((code, report["profile"].as_str()), (0, Some(name)));
        for word in report["words"].as_array().unwrap() {
            let fields = word["fields"].as_array().unwrap();
            let sum: u64 = fields.iter().map(|field| field["bits"].as_u64().unwrap()).sum();
            assert_eq!(word["width"].as_u64(), Some(sum), "{name}: {word}");
        }
    }
}

// Clauses F-4, F-5
#[test]
fn profiles_are_listed_shown_and_described() {
    let (code, list, _) = guardbit(&["profile", "list"], b"");
    assert_eq!(code, 0);
    let names: Vec<&str> = list.lines().map(|l| l.split_whitespace().next().unwrap()).collect();
    assert_eq!(names, guardbit::profile::BUILTIN.map(|(name, _)| name));
    for name in names {
        let (code, text, _) = guardbit(&["profile", "show", name], b"");
        assert_eq!(code, 0);
        assert_eq!(
            guardbit::profile::parse(&text, name).unwrap(),
            guardbit::profile::load(name).unwrap()
        );
    }
    let (code, schema, _) = guardbit(&["profile", "schema"], b"");
    let schema: Value = serde_json::from_str(&schema).unwrap();
    assert_eq!((code, &schema["additionalProperties"]), (0, &Value::Bool(false)));
}

#[test]
fn speed_reports_ratios() {
    let (code, json, err) = guardbit(&["speed", "--repeats", "1", "--json"], b"");
    assert_eq!((code, err.as_str()), (0, ""));
    let report: Value = serde_json::from_str(&json).unwrap();
    for kernel in ["depth_walk", "depth_walk_logged", "edges_exact"] {
        assert!(report["ratios"][kernel].as_f64().unwrap() > 0.0, "{report}");
    }
    let rows = report["rows"].as_array().unwrap();
    assert!(rows.len() >= 3 && rows.len().is_multiple_of(3), "three kernels a level: {report}");
}
