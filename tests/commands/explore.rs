//! The commands that search budgets, as a user types them.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run;

use run::{Ran, run_in};
use serde_json::Value;
use tempfile::TempDir;

fn home() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn json(ran: &Ran) -> Value {
    serde_json::from_str(&ran.out).unwrap_or_else(|error| panic!("{error}: {}", ran.out))
}

/// A toy sweep that takes no time.
const TOY: &str = "tiny --scene triangle --vary interpolation=0..4 --vary guard=0..1";

#[test]
fn a_sweep_is_an_array_of_one_object_a_budget() {
    let home = home();
    let all = json(&run_in(home.path(), &format!("explore {TOY} --json")).ends(0));
    let all = all.as_array().unwrap();
    assert_eq!(all.len(), 10);
    for (n, record) in all.iter().enumerate() {
        assert_eq!(record["index"], n);
        assert_eq!(record["budget"]["interpolation"], n / 2);
        assert_eq!(record["budget"]["guard"], n % 2);
        assert_eq!(record["budget"]["depth-bits"], 3 + n / 2 + n % 2);
        for key in ["snap", "arithmetic"] {
            assert!(record["accuracy"][key]["depth"]["ulp"]["worst"].is_f64(), "{record}");
        }
        assert!(record["cost"]["ripple"]["area_um2"].as_f64().unwrap() > 0.0);
        assert!(record["speed"]["ns_per_sample"].as_f64().unwrap() > 0.0);
        assert!(record["pareto"].is_boolean());
    }
    // More interpolation bits cost more; more guard bits change no error here.
    let area = |n: usize| all[n]["cost"]["ripple"]["area_um2"].as_f64().unwrap();
    assert!(area(0) < area(2) && area(0) < area(1));
    assert_eq!(all[8]["accuracy"], all[9]["accuracy"]);
    assert!(all.iter().any(|record| record["pareto"] == true));
    assert!(all.iter().any(|record| record["pareto"] == false));
}

#[test]
fn without_times_two_runs_give_the_same_bytes() {
    let home = home();
    for form in ["--json", "--csv", "--all"] {
        let once = run_in(home.path(), &format!("explore {TOY} --no-speed {form}")).ends(0);
        let again =
            run_in(home.path(), &format!("explore {TOY} --no-speed {form} --threads 3")).ends(0);
        assert_eq!(once.out, again.out);
    }
}

#[test]
fn csv_and_json_say_the_same() {
    let home = home();
    let csv = run_in(home.path(), &format!("explore {TOY} --no-speed --csv")).ends(0).out;
    let all = json(&run_in(home.path(), &format!("explore {TOY} --no-speed --json")).ends(0));
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let column = |name: &str| head.iter().position(|known| *known == name).unwrap();
    let mut rows = 0;
    for (row, record) in lines.zip(all.as_array().unwrap()) {
        assert_eq!(row.len(), head.len());
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        let arithmetic = &record["accuracy"]["arithmetic"];
        assert_eq!(Some(number("depth-worst")), arithmetic["depth"]["ulp"]["worst"].as_f64());
        assert_eq!(Some(number("ties")), arithmetic["ties"].as_f64());
        let snap = &record["accuracy"]["snap"]["depth"]["world"]["rms"];
        assert_eq!(Some(number("snap-depth-rms-world")), snap.as_f64());
        assert_eq!(row[column("pareto")], record["pareto"].to_string());
        assert_eq!(row[column("ns")], "", "not timed");
        rows += 1;
    }
    assert_eq!(rows, 10);
}

#[test]
fn several_scenes_are_counted_together() {
    let home = home();
    let record = |scenes: &str| {
        let command = format!("explore tiny {scenes} --vary guard=1 --no-speed --json");
        json(&run_in(home.path(), &command).ends(0))[0]["accuracy"].clone()
    };
    let [one, other] = ["--scene triangle", "--scene fan"].map(record);
    let both = record("--scene triangle --scene fan");
    let samples = |of: &Value| of["samples"].as_u64().unwrap();
    assert_eq!(samples(&both), samples(&one) + samples(&other));
    let worst = |of: &Value| of["arithmetic"]["depth"]["ulp"]["worst"].as_f64().unwrap();
    assert_eq!(worst(&both).to_bits(), worst(&one).max(worst(&other)).to_bits());
}

#[test]
fn the_table_names_the_front_and_the_help_names_everything() {
    let home = home();
    let table = run_in(home.path(), &format!("explore {TOY} --no-speed")).ends(0).out;
    assert!(table.contains("interpolation  guard"), "{table}");
    assert!(table.contains("10 budgets, "), "{table}");
    assert!(table.lines().filter(|line| line.ends_with('*')).count() >= 1);
    let help = run_in(home.path(), "explore --vary help").ends(0).out;
    for name in ["sub-pixel", "reciprocal", "nearest-even", "snap-misclassified", "area-prefix"] {
        assert!(help.contains(name), "{name}");
    }
    assert_eq!(run_in(home.path(), "fit --vary help").ends(0).out, help);
}

#[test]
fn a_profile_without_depth_has_no_depth_figures() {
    let home = home();
    let shown = run_in(home.path(), "profile show tiny").ends(0).out;
    let flat = shown.split("# 1 guard").next().unwrap();
    assert!(!flat.contains("[depth]"));
    std::fs::write(home.path().join("flat.toml"), flat).unwrap();
    let command = "explore flat.toml --scene fan --vary edge-width=3..7 --no-speed --json";
    let all = json(&run_in(home.path(), command).ends(0));
    assert_eq!(all.as_array().unwrap().len(), 5);
    assert!(all[0]["accuracy"]["arithmetic"]["depth"].is_null());
    assert!(all[4]["accuracy"]["arithmetic"]["misclassified"] == 0);
    let fitted =
        "fit flat.toml --scene triangle --vary edge-width=2..7 --within misclassified=0 --json";
    let fitted = json(&run_in(home.path(), fitted).ends(0));
    assert_eq!(fitted["witness"]["edge-width"]["fails"], true);
    let none = run_in(home.path(), "explore flat.toml --vary guard=0..1");
    none.complains(2, &["guard", "the profile does not have this field"]);
}

const FIT: &str = "fit sgi-4k --scene knot --window 64x64 --vary edge-width=10..24 \
                   --vary interpolation=0..10 --vary guard=0..2";

#[test]
fn a_fit_has_its_budget_cost_and_witnesses() {
    let home = home();
    let fit = json(&run_in(home.path(), &format!("{FIT} --json")).ends(0));
    for key in ["budget", "cost", "witness", "evaluated", "pruned"] {
        assert!(!fit[key].is_null(), "{key}");
    }
    assert_eq!(fit["evaluated"].as_u64().unwrap() + fit["pruned"].as_u64().unwrap(), 15 * 11 * 3);
    for field in ["edge-width", "interpolation"] {
        let witness = &fit["witness"][field];
        assert_eq!(witness["fails"], true, "{fit}");
        assert_eq!(witness["value"], fit["budget"][field].as_u64().unwrap() - 1);
        assert!(witness["figure"].as_f64() > witness["limit"].as_f64());
        assert!(witness["triangle"].is_u64() && witness["vertices"].is_array());
        assert!(witness["pixel"].is_array());
    }
    // The same budget, measured by a sweep, costs and does the same.
    let value = |field: &str| fit["budget"][field].clone();
    let command = format!(
        "explore sgi-4k --scene knot --window 64x64 --vary edge-width={} --vary interpolation={} \
         --vary guard={} --no-speed --json",
        value("edge-width"),
        value("interpolation"),
        value("guard")
    );
    let swept = json(&run_in(home.path(), &command).ends(0))[0].clone();
    assert_eq!(swept["cost"]["ripple"]["area_um2"], fit["cost"]);
    assert_eq!(
        swept["accuracy"]["arithmetic"]["depth"]["ulp"]["worst"],
        fit["within"]["depth-worst"]["value"]
    );
    assert_eq!(swept["budget"], fit["budget"]);
    // And everything measured gives the same answer.
    let all = json(&run_in(home.path(), &format!("{FIT} --exhaustive --json")).ends(0));
    assert_eq!((&all["index"], &all["budget"]), (&fit["index"], &fit["budget"]));
}

#[test]
fn a_fitted_profile_is_one_to_go_on_with() {
    let home = home();
    let text = run_in(home.path(), &format!("{FIT} --profile-out fitted.toml")).ends(0).out;
    assert!(text.contains("one bit fewer:") && text.contains("fails: depth-worst"), "{text}");
    assert!(text.contains("answer    the cheapest"), "{text}");
    let budget = json(&run_in(home.path(), "budget fitted.toml --json").ends(0));
    assert_eq!(budget["profile"], "sgi-4k-fit");
    run_in(home.path(), "vectors fitted.toml --scene knot --size smoke --out set").ends(0);
    run_in(home.path(), "verify set").ends(0);
}

#[test]
fn what_a_scene_requires_stands_beside_the_words() {
    let home = home();
    let report = json(&run_in(home.path(), "budget tiny --scene fan --json").ends(0));
    assert_eq!(report["profile"], "tiny");
    let requires = &report["requires"];
    assert_eq!(requires["scene"], "fan");
    assert!(requires["bits"].as_array().unwrap().iter().any(|b| b["field"] == "guard"));
    let text = run_in(home.path(), "budget tiny --scene fan").ends(0).out;
    assert!(text.contains("depth test") && text.contains("no sample is covered twice"), "{text}");
    let plain = json(&run_in(home.path(), "budget tiny --json").ends(0));
    assert!(plain.get("requires").is_none());
    run_in(home.path(), "budget tiny --window 8x8").ends(2);
}

#[test]
fn the_extremes_break_where_they_have_to() {
    let home = home();
    let rows = json(&run_in(home.path(), "explore sgi-4k --extremes --json").ends(0));
    let breaks = |quantity: &str| {
        let row = rows.as_array().unwrap().iter().find(|row| row["quantity"] == quantity);
        row.unwrap_or_else(|| panic!("{quantity}"))["breaks"]["value"].clone()
    };
    // The lectures' 35 and 39 bits, one less of each; one guard bit; sticky accumulators.
    assert_eq!(breaks("window to its corners"), 34);
    assert_eq!(breaks("walk to its longest"), 12);
    assert_eq!(breaks("z to both ends"), 0);
    assert_eq!(breaks("slopes to their largest"), "saturate");
    // Two surfaces 1/256 of the far distance apart, far over near 2^16: 2^d codes of which one
    // is worth 2^16 / 2^d of the distance there. 24 bits just hold them apart.
    assert!(breaks("w toward zero").as_u64().unwrap() < 24);
    let walk = run_in(home.path(), "explore sgi-4k-walk --extremes").ends(0).out;
    assert!(walk.contains("holds   at no value of walk-fraction"), "{walk}");
    run_in(home.path(), "explore tiny --extremes --vary guard=1").complains(2, &["--extremes"]);
    run_in(home.path(), "explore tiny --extremes --window 0x4").complains(2, &["65536"]);
}

#[test]
fn what_cannot_be_searched_is_said_with_the_nearest_that_can() {
    let home = home();
    let complains = |command: &str, about: &[&str]| {
        run_in(home.path(), command).complains(2, about);
    };
    complains("explore tiny --vary interpolation=4..2", &["interpolation=2..4"]);
    complains("explore tiny --vary interpolaton=1", &["interpolaton", "interpolation"]);
    complains("explore tiny --vary guard=1 --vary guard=2", &["guard is varied twice"]);
    complains("explore tiny --vary interpolation=118..120", &["none of the 3", "120"]);
    complains("explore tiny --vary rounding=sideways", &["nearest-even"]);
    complains("explore tiny --scene nowhere", &["nowhere", "knot"]);
    complains("explore nowhere", &["sgi-4k"]);
    complains("explore tiny --objective beauty", &["depth-rms-world"]);
    complains("fit tiny --cost depth-worst", &["area-prefix"]);
    complains("fit tiny --within area=3", &["--cost"]);
    complains("fit tiny --within depth-worst=-1", &["finite number >= 0"]);
    complains("fit tiny --within depth-worst=NaN", &["finite number >= 0"]);
    complains("fit tiny --within depth-worst", &["METRIC=LIMIT"]);
    complains("explore tiny --window 99999x2", &["65536"]);
    complains("explore tiny --shard 4/4 --vary guard=1", &["0 <= I < N"]);
    // Out of reach: the least that is possible, and where; allowed exactly that much, it is met.
    let fit = "fit tiny --scene triangle --vary interpolation=0..2 --within";
    let ran = run_in(home.path(), &format!("{fit} depth-worst=0.001")).complains(
        2,
        &["depth-worst <= 0.001: the smallest value in the space is", "interpolation=2"],
    );
    let least = ran
        .err
        .split("the smallest value in the space is ")
        .nth(1)
        .unwrap()
        .split_whitespace()
        .next()
        .unwrap();
    run_in(home.path(), &format!("{fit} depth-worst={least}")).ends(0);
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let home = home();
    let place = "missing/folder/file";
    for option in ["--html", "--svg", "--save"] {
        let ran = run_in(home.path(), &format!("explore {TOY} --no-speed {option} {place}"));
        ran.complains(3, &["missing/folder"]);
    }
    for option in ["--save", "--profile-out"] {
        let command = format!("fit {TOY} --within wraps=9 {option} {place}");
        run_in(home.path(), &command).complains(3, &["missing/folder"]);
    }
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
}

#[test]
fn an_answer_that_draws_nothing_is_no_answer() {
    let home = home();
    let write = |name: &str, text: &str| std::fs::write(home.path().join(name), text).unwrap();
    write("one.jsonl", "{\"v\":[[1,1,0],[7,2,7],[2,7,3]]}\n");
    write("far.jsonl", "{\"v\":[[1,1,0],[99999999999,2,7],[2,7,3]]}\n");
    write("flat.jsonl", "{\"v\":[[1,1],[7,2],[2,7]]}\n");
    // A field that refuses the triangle is cheap, and out of the question unless it is allowed.
    let space = "fit tiny --scene one.jsonl --vary vertex-integer=0..3 --vary interpolation=0..3";
    let fit = json(&run_in(home.path(), &format!("{space} --json")).ends(0));
    assert_eq!(fit["budget"]["vertex-integer"], 2);
    assert_eq!(fit["witness"]["vertex-integer"]["metric"], "snap-refused");
    let allowed = run_in(home.path(), &format!("{space} --within snap-refused=1"));
    allowed.complains(2, &["no sample"]);
    // Naming one tolerance gives up none of the others.
    let named = format!("{space} --within depth-worst=2 --json");
    assert_eq!(json(&run_in(home.path(), &named).ends(0))["within"]["misclassified"]["limit"], 0.0);
    let none = run_in(home.path(), "fit tiny --scene far.jsonl --vary interpolation=0..3");
    none.complains(2, &["snap-refused <= 0: the smallest value in the space is 1"]);
    let flat = run_in(home.path(), "fit tiny --scene flat.jsonl --vary interpolation=0..3").ends(0);
    assert!(flat.err.contains("note: depth-worst <= 0.5 is not checked"), "{}", flat.err);
    let table = run_in(home.path(), "explore tiny --scene far.jsonl --no-speed").ends(0).out;
    assert!(table.contains("snap-refused"), "{table}");
}
