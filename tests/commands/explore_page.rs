//! The files that `explore` writes: a page and a chart.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run;

use run::{guardbit, run_in};
use serde_json::Value;
use std::path::Path;

const SPACE: &str = "explore sgi-4k --scene fan --window 96x64 --vary sub-pixel=4,8 \
                     --vary interpolation=3..5 --no-speed";

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// What stands between two texts.
fn between<'a>(text: &'a str, open: &str, close: &str) -> &'a str {
    let (_, rest) = text.split_once(open).unwrap_or_else(|| panic!("no {open}"));
    rest.split_once(close).unwrap().0
}

fn data(page: &str) -> Value {
    let block = between(page, "<script type=\"application/json\" id=\"data\">", "</script>");
    serde_json::from_str(block).unwrap()
}

/// Fails unless every element is closed in its turn and every attribute is quoted.
fn well_formed(text: &str) {
    let mut open: Vec<&str> = Vec::new();
    for part in text.split('<').skip(1) {
        let (tag, _) = part.split_once('>').unwrap();
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name.trim()));
            continue;
        }
        let name = tag.split([' ', '\n', '/']).next().unwrap();
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        for (n, outside) in tag[name.len()..].split('"').enumerate().filter(|(n, _)| n % 2 == 0) {
            let key = outside.trim().trim_end_matches('/').trim_end();
            assert!(key.is_empty() || key.ends_with('='), "{n}: {tag}");
        }
        if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    for entity in text.split('&').skip(1) {
        let (name, _) = entity.split_once(';').unwrap();
        assert!(["amp", "lt", "gt", "quot", "apos"].contains(&name) || name.starts_with('#'));
    }
}

#[test]
fn a_page_holds_every_budget_and_the_output_is_as_without() {
    let home = tempfile::tempdir().unwrap();
    let plain = run_in(home.path(), &format!("{SPACE} --json")).ends(0).out;
    let ran = run_in(home.path(), &format!("{SPACE} --json --html a.html --maps 2")).ends(0);
    assert_eq!(ran.out, plain);
    assert_eq!(names(home.path()), ["a.html"]);
    let page = std::fs::read_to_string(home.path().join("a.html")).unwrap();
    let (data, records) = (data(&page), serde_json::from_str::<Vec<Value>>(&plain).unwrap());
    let (budgets, metrics) =
        (data["budgets"].as_array().unwrap(), data["metrics"].as_array().unwrap());
    assert_eq!((budgets.len(), records.len()), (6, 6));
    let at = |name: &str| metrics.iter().position(|metric| metric["name"] == name).unwrap();
    let (rms, snapped) = (at("depth-rms-world"), at("snap-misclassified"));
    for (budget, record) in budgets.iter().zip(&records) {
        assert_eq!(budget["fields"], record["budget"]);
        assert_eq!(budget["pareto"], record["pareto"]);
        let accuracy = &record["accuracy"];
        let arithmetic = accuracy["arithmetic"]["depth"]["world"]["rms"].as_f64();
        assert!(arithmetic.is_some_and(|rms| rms > 0.0));
        assert_eq!(budget["figures"][rms].as_f64(), arithmetic);
        let snap = accuracy["snap"]["misclassified"].as_f64();
        assert_eq!(budget["figures"][snapped].as_f64(), snap);
    }
    assert_eq!([&metrics[rms]["group"], &metrics[snapped]["group"]], ["arithmetic", "snap"]);
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 2, "maps");
    // Without a script there is a row for each budget of the front.
    let front = records.iter().filter(|record| record["pareto"] == true).count();
    assert!(front > 0);
    assert_eq!(between(&page, "<tbody>", "</tbody>").matches("<tr>").count(), front);
    // Nothing of it comes from elsewhere, or from when and where it was made.
    for foreign in ["http://", "https://", "src=\"/", "url(", "@import"] {
        let ours = "http://www.w3.org/2000/svg";
        assert!(!page.replace(ours, "").contains(foreign), "{foreign}");
    }
    for place in
        [env!("CARGO_MANIFEST_DIR"), home.path().to_str().unwrap(), env!("CARGO_BIN_EXE_guardbit")]
    {
        assert!(!page.contains(place), "{place}");
    }
    run_in(home.path(), &format!("{SPACE} --json --html b.html --maps 2")).ends(0);
    let again = std::fs::read_to_string(home.path().join("b.html")).unwrap();
    assert_eq!(again.replace("--html b.html", "--html a.html"), page, "the same bytes again");
}

#[cfg(unix)]
#[test]
fn the_command_line_can_be_pasted() {
    let home = tempfile::tempdir().unwrap();
    std::fs::create_dir(home.path().join("it's here")).unwrap();
    let mut command = guardbit();
    command.current_dir(home.path()).args(SPACE.split_whitespace());
    command.args(["--html", "it's here/<a> & b.html"]);
    assert!(command.output().unwrap().status.success());
    let path = home.path().join("it's here/<a> & b.html");
    let page = std::fs::read_to_string(&path).unwrap();
    let shown = between(&page, "<code id=\"command\">", "</code>");
    let shown = shown.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
    let line = shown.replace("&amp;", "&");
    std::fs::remove_file(&path).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_guardbit")).parent().unwrap();
    let search = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = std::process::Command::new("sh");
    let ran = shell.args(["-c", &line]).current_dir(home.path()).env("PATH", search).output();
    assert!(ran.unwrap().status.success(), "{line}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), page);
}

#[test]
fn a_chart_has_a_point_a_budget() {
    let home = tempfile::tempdir().unwrap();
    let chart = |more: &str| {
        run_in(home.path(), &format!("{SPACE} --svg a.svg {more}")).ends(0);
        assert_eq!(names(home.path()), ["a.svg"]);
        let text = std::fs::read_to_string(home.path().join("a.svg")).unwrap();
        well_formed(&text);
        text
    };
    let text = chart("");
    // Six budgets, and two marks in the legend of the first varied field.
    assert_eq!(text.matches("<circle").count(), 6 + 2);
    for part in ["sub-pixel 4", "sub-pixel 8", "cell area", "arithmetic error", "96 x 64", "fan"] {
        assert!(text.contains(part), "{part}");
    }
    let other = chart("--x register-bits --y snap-depth-rms-world");
    assert!(other.contains("snap error") && other.contains("register bits of all units"));
    assert!(!other.contains("arithmetic error"));
}

#[test]
fn rings_are_beaten_and_discs_are_the_front() {
    let home = tempfile::tempdir().unwrap();
    // By area alone one budget beats the others: fewest bits of everything.
    run_in(home.path(), &format!("{SPACE} --objective area --svg a.svg")).ends(0);
    let text = std::fs::read_to_string(home.path().join("a.svg")).unwrap();
    let rings = text.split("<circle").skip(1);
    let rings = rings.filter(|circle| between(circle, "", ">").contains("fill=\"none\"")).count();
    assert_eq!(rings, 5, "{text}");
}

#[test]
fn parts_and_their_join_write_files_as_well() {
    let home = tempfile::tempdir().unwrap();
    for part in ["0/2", "1/2"] {
        let name = &part[..1];
        let files = format!("--save {name}.jsonl --html {name}.html --svg {name}.svg");
        run_in(home.path(), &format!("{SPACE} --shard {part} {files}")).ends(0);
        let page = std::fs::read_to_string(home.path().join(format!("{name}.html"))).unwrap();
        assert_eq!(data(&page)["budgets"].as_array().unwrap().len(), 3);
        assert!(page.contains("3 of 6 combinations"));
    }
    run_in(home.path(), &format!("{SPACE} --merge 0.jsonl 1.jsonl --html all.html --svg all.svg"))
        .ends(0);
    let page = std::fs::read_to_string(home.path().join("all.html")).unwrap();
    assert_eq!(data(&page)["budgets"].as_array().unwrap().len(), 6);
    well_formed(&std::fs::read_to_string(home.path().join("all.svg")).unwrap());
}

#[test]
fn maps_are_as_many_as_asked_for_and_as_large_as_the_window() {
    let home = tempfile::tempdir().unwrap();
    let records = run_in(home.path(), &format!("{SPACE} --json")).ends(0).out;
    let records: Vec<Value> = serde_json::from_str(&records).unwrap();
    let front = records.iter().filter(|record| record["pareto"] == true).count();
    assert!((2..=6).contains(&front));
    for (maps, scenes, window, size, drawn) in [
        (0, "", "96x64", [96, 64], 0),
        (1, "", "96x64", [96, 64], 1),
        // No more than there are budgets on the front.
        (16, "", "96x64", [96, 64], front),
        (1, "", "800x300", [267, 100], 1),
        (2, "--scene knot", "96x64", [96, 64], 4),
    ] {
        let space = SPACE.replace("96x64", window);
        let arguments = format!("{space} {scenes} --html a.html --maps {maps}");
        run_in(home.path(), &arguments).ends(0);
        let page = std::fs::read_to_string(home.path().join("a.html")).unwrap();
        assert_eq!(page.matches("src=\"data:image/png").count(), drawn, "{arguments}");
        let of_size = format!("width=\"{}\" height=\"{}\"", size[0], size[1]);
        assert_eq!(page.matches(&of_size).count(), drawn, "{arguments}");
    }
}

#[test]
fn a_budget_without_a_map_gets_one_by_the_command_shown() {
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), &format!("{SPACE} --html a.html --maps 0")).ends(0);
    let all = data(&std::fs::read_to_string(home.path().join("a.html")).unwrap());
    let wanted = &all["budgets"][4];
    // What the page's script appends: each varied field at the budget's value.
    let mut line = all["single"].as_str().unwrap().strip_prefix("guardbit ").unwrap().to_owned();
    for name in all["varied"].as_array().unwrap() {
        let name = name.as_str().unwrap();
        line = format!("{line} --vary {name}={}", wanted["fields"][name]);
    }
    run_in(home.path(), &format!("{line} --no-speed --maps 1 --html one.html")).ends(0);
    let page = std::fs::read_to_string(home.path().join("one.html")).unwrap();
    let one = data(&page);
    assert_eq!(one["budgets"].as_array().unwrap().len(), 1);
    assert_eq!(one["budgets"][0]["fields"], wanted["fields"]);
    assert_eq!(one["budgets"][0]["figures"], wanted["figures"], "the same scene and window");
    assert_eq!(page.matches("src=\"data:image/png").count(), 1);
}

#[test]
fn what_cannot_be_is_refused_before_anything_is_measured() {
    let home = tempfile::tempdir().unwrap();
    for (more, status, about) in [
        ("--html none/a.html", 3, "none/a.html: "),
        ("--svg none/a.svg", 3, "none/a.svg: "),
        ("--html .", 3, ".: "),
        ("--html a.html --maps 99", 2, "--maps"),
        ("--html a.html --maps=-1", 2, "--maps"),
        ("--svg a.svg --x beauty", 2, "there is no metric of this name"),
        ("--svg a.svg --y area,delay", 2, "there is no metric of this name"),
        ("--x area", 2, "--svg"),
        ("--maps 2", 2, "--html"),
    ] {
        let ran = run_in(home.path(), &format!("{SPACE} {more}")).complains(status, &[about]);
        assert_eq!(ran.out, "", "{more}");
        assert_eq!(names(home.path()), [""; 0], "{more}");
    }
}

#[test]
fn a_missing_synthesis_tool_says_how_to_get_it() {
    let home = tempfile::tempdir().unwrap();
    let mut command = guardbit();
    command.current_dir(home.path()).args(SPACE.split_whitespace()).arg("--synth");
    let ran = run::Ran::from(command.env("PATH", home.path()).output().unwrap());
    ran.complains(2, &["yosys is not installed", "install yosys", "hint: "]);
}
