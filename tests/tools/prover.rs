//! The claims of `prove`, by provers that know nothing of this crate.

use crate::run::{Ran, run_in};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

const QUESTIONS: [&str; 5] = ["sgi-4k", "tiny", "d3d11", "--table", "channels.toml"];

/// Channels of every correction that has a bound, which `channels.toml` has besides `tiny`.
const CHANNELS: &str = r#"
[w]
guard = 1
integer = 7
interpolation = 6
rounding = "nearest-even"
clamp = "guard"
[[channel]]
name = "color"
components = ["r"]
guard = 1
integer = 3
interpolation = 3
rounding = "nearest-even"
clamp = "guard"
correction = "affine"
[[channel]]
name = "map"
components = ["s"]
guard = 1
integer = 3
interpolation = 12
rounding = "nearest-even"
clamp = "guard"
correction = { quotient = { rounding = "nearest-even" } }
[[channel]]
name = "normal"
components = ["x"]
guard = 1
integer = 3
interpolation = 12
signed = true
rounding = "floor"
clamp = "guard"
correction = { reciprocal = { rounding = "floor", unit = { operand = 8, index = 3, entry = 6, refine = { newton = { bits = [9] } } } } }
[[channel]]
name = "glow"
components = ["l"]
guard = 1
integer = 3
interpolation = 3
rounding = "nearest-even"
clamp = "guard"
correction = { barycentric = { bits = 8, rounding = "floor" } }
"#;

/// A folder with the profile `channels.toml`.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    let tiny = run_in(home.path(), "profile show tiny").ends(0).out;
    fs::write(home.path().join("channels.toml"), tiny + CHANNELS).unwrap();
    home
}

pub(crate) fn z3_agrees_with_every_claim(_: &str) {
    agrees("z3");
}

pub(crate) fn gappa_agrees_with_every_claim(_: &str) {
    agrees("gappa");
}

/// What `prove --check` says of each question; it asks both provers, and is asked once.
fn reports() -> &'static [(&'static str, serde_json::Value)] {
    static REPORTS: OnceLock<Vec<(&str, serde_json::Value)>> = OnceLock::new();
    REPORTS.get_or_init(|| {
        let home = home();
        let report = |question| {
            let ran = run_in(home.path(), &format!("prove {question} --check --json")).ends(0);
            (question, serde_json::from_str(&ran.out).unwrap())
        };
        QUESTIONS.map(report).into()
    })
}

/// A prover is asked about each claim that it takes, and doubts none.
fn agrees(prover: &str) {
    for (question, report) in reports() {
        let (rows, checks) = (report["rows"].as_array(), report["checks"].as_array());
        let claims = |list: Option<&Vec<serde_json::Value>>| -> Vec<String> {
            let names = list.unwrap().iter().map(|one| one["claim"].as_str().unwrap().to_owned());
            names.collect()
        };
        let mine: Vec<_> =
            checks.unwrap().iter().filter(|one| one["solver"] == prover).cloned().collect();
        assert!(mine.iter().all(|one| one["answer"] == "agrees"), "{question}: {mine:#?}");
        let mut asked = claims(rows);
        // Gappa's language has no products of unknowns.
        let taken = [
            "edge.full",
            "edge.stored",
            "depth.interpolation",
            "channel.color.interpolation",
            "channel.map.interpolation",
            "channel.normal.interpolation",
        ];
        asked.retain(|claim| prover == "z3" || taken.contains(&&**claim));
        assert!(asked.len() >= 3, "{question}: {asked:?}");
        assert_eq!(claims(Some(&mine)), asked, "{question}");
    }
}

/// Writes the claims, and gives the text and the bits of `edge.full`.
fn written(home: &Path, question: &str, option: &str) -> (String, u32) {
    let ran = run_in(home, &format!("prove {question} {option} claims --json")).ends(0);
    let report: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    let rows = report["rows"].as_array().unwrap();
    let full = rows.iter().find(|row| row["claim"] == "edge.full").unwrap();
    let bits = u32::try_from(full["bits"].as_u64().unwrap()).unwrap();
    (fs::read_to_string(home.join("claims")).unwrap(), bits)
}

/// Hands a text to a prover's program.
fn ask(home: &Path, prover: &str, text: &str, limit: Duration) -> Ran {
    fs::write(home.join("asked"), text).unwrap();
    let begin = Instant::now();
    let mut command = Command::new(prover);
    let output = command.arg(home.join("asked")).stdin(Stdio::null()).output().unwrap();
    assert!(begin.elapsed() < limit, "{prover} took {:?}", begin.elapsed());
    output.into()
}

/// What z3 was to say about each claim, and what it said.
fn answers(ran: &Ran) -> Vec<(&str, &str, &str)> {
    let lines: Vec<&str> = ran.out.lines().collect();
    lines
        .chunks(2)
        .map(|pair| {
            let (claim, expected) = pair[0].split_once(", expect ").unwrap();
            (claim, expected, pair[1])
        })
        .collect()
}

/// The text with one number changed, the first after a place.
fn spoiled(text: &str, place: &str, from: &str, to: &str) -> String {
    let at = text.find(place).unwrap_or_else(|| panic!("{place:?} is not in {text}"));
    let (before, after) = text.split_at(at);
    assert!(after.contains(from), "{from} is not in {after}");
    before.to_owned() + &after.replacen(from, to, 1)
}

pub(crate) fn z3_reads_the_file_and_refutes_a_spoiled_one(z3: &str) {
    let home = home();
    let home = home.path();
    for question in QUESTIONS {
        let (text, bits) = written(home, question, "--smt");
        let ran = ask(home, z3, &text, Duration::from_secs(10)).ends(0);
        let good = answers(&ran);
        assert_eq!(good.len(), text.matches("(check-sat)").count(), "{question}");
        assert_eq!(good.len(), text.matches("; expect: ").count(), "{question}");
        for (claim, expected, answer) in &good {
            assert_eq!(answer, expected, "{question} {claim}");
        }
        for wanted in ["sat", "unsat"] {
            assert!(good.iter().any(|one| one.1 == wanted), "{question}: no {wanted} is expected");
        }
        // Half of the most that the word holds: as if one bit less were claimed to be enough.
        let most = |bits: u32| format!("{}.0)", (1_u128 << (bits - 1)) - 1);
        let text = spoiled(&text, "; edge.full", &most(bits), &most(bits - 1));
        let ran = ask(home, z3, &text, Duration::from_secs(10)).ends(0);
        let wrong: Vec<_> =
            answers(&ran).into_iter().filter(|(_, expected, answer)| answer != expected).collect();
        let claim = format!("edge.full with {bits} bits");
        assert_eq!(wrong, [(&*claim, "unsat", "sat")], "{question}");
    }
}

pub(crate) fn gappa_reads_the_file_and_refuses_a_spoiled_one(gappa: &str) {
    let home = home();
    let home = home.path();
    for question in QUESTIONS {
        let (text, bits) = written(home, question, "--gappa");
        let ran = ask(home, gappa, &text, Duration::from_mins(1)).ends(0);
        assert!(!ran.err.contains("Error"), "{question}: {}", ran.err);
        // In a table's hundreds of claims it looks for better proofs for too long.
        if question == "--table" {
            continue;
        }
        let most = |bits: u32| format!(", {}]", (1_u128 << (bits - 1)) - 1);
        let text = spoiled(&text, "{ ", &most(bits), &most(bits - 1));
        let ran = ask(home, gappa, &text, Duration::from_mins(1));
        assert_eq!(ran.status, Some(1), "{question}: {}", ran.err);
        // It read the file, and found no proof.
        let found = ["properties were not satisfied", "no contradiction was found"];
        assert!(found.iter().any(|text| ran.err.contains(text)), "{question}: {}", ran.err);
    }
}

/// Cells that a set calls unreachable, asked of z3 from the manifest alone: the numbers of the profile
/// go in, the bound of the text does not.
pub(crate) fn z3_finds_no_way_to_unreachable_cells(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let tiles = run_in(home.path(), "profile show sgi-4k --machine tiles").ends(0).out;
    fs::write(home.path().join("tiles.toml"), tiles).unwrap();
    let fine = run_in(home.path(), "profile show tiny").ends(0).out;
    fs::write(
        home.path().join("fine.toml"),
        fine.replace("interpolation = 3", "interpolation = 6"),
    )
    .unwrap();
    let mut asked = std::collections::BTreeSet::new();
    for set in ["sgi-4k", "tiles.toml", "fine.toml"] {
        run_in(home.path(), &format!("vectors {set} --out set --force --size smoke")).ends(0);
        let text = fs::read_to_string(home.path().join("set/manifest.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_str(&text).unwrap();
        for entry in manifest["coverage"].as_array().unwrap() {
            for cell in entry["unreachable"].as_array().unwrap() {
                let name = cell["cell"].as_str().unwrap();
                let clause = cell["clause"].as_str().unwrap();
                let question = question(&manifest["profile"], clause, name);
                // One question for all octants and quotients.
                if asked.insert(question.clone()) {
                    let ran = ask(home.path(), "z3", &question, Duration::from_mins(1));
                    assert_eq!(ran.out.trim(), "unsat", "{set} {name}: {question}");
                }
            }
        }
    }
    assert!(asked.len() >= 6, "{asked:#?}");
}

/// Whether a cell can be hit, for z3.
fn question(profile: &serde_json::Value, clause: &str, cell: &str) -> String {
    let number = |path: &str| -> i128 {
        profile.pointer(path).and_then(serde_json::Value::as_i64).unwrap_or_default().into()
    };
    let (width, height) = (number("/window/width"), number("/window/height"));
    let (sub_pixel, fraction) = (number("/vertex/sub-pixel"), number("/depth/interpolation"));
    // The fields of these profiles have no sign, and a closed end.
    let high = 1i128 << (number("/vertex/integer") + sub_pixel);
    let assert = match clause {
        "T-1" => {
            let (side, beyond) = match cell {
                "beyond.right" => (width, true),
                "beyond.bottom" => (height, true),
                _ => (0, false),
            };
            let side = side << sub_pixel;
            let reach = if beyond { format!("(> v {side})") } else { "(< v 0)".to_owned() };
            format!("(declare-const v Int) (assert (and (<= 0 v {high}) {reach}))")
        }
        "B-5" => {
            let (top, unit) = (1i128 << number("/depth/integer"), 1i128 << fraction);
            let reach = if cell.contains(".above.") {
                format!("(>= v {})", top * unit)
            } else {
                format!("(<= v (/ (- {unit}) 2.0))")
            };
            format!(
                "(declare-const z Real) (declare-const x Real) (declare-const y Real) (declare-const v Real)
                 (declare-const e0 Real) (declare-const ex Real) (declare-const ey Real)
                 (assert (and (<= 0 z {}) (<= 0 x {}) (<= 0 y {})))
                 (assert (and (<= -0.5 e0 0.5) (<= -0.5 ex 0.5) (<= -0.5 ey 0.5)))
                 (assert (= v (+ (* z {unit}) e0 (* x ex) (* y ey))))
                 (assert {reach})",
                top - 1,
                width - 1,
                height - 1
            )
        }
        "P-3" => {
            let scale = if cell.contains("depth_init") { fraction } else { fraction + sub_pixel };
            // Twice the numerator, scaled, is an odd number of divisors: in 32 bits nothing wraps.
            let most = high * high;
            format!(
                "(declare-const n (_ BitVec 32)) (declare-const d (_ BitVec 32)) (declare-const q (_ BitVec 32))
                 (assert (and (bvuge d #x00000001) (bvule d (_ bv{most} 32)) (bvule n (_ bv4096 32)) (bvule q (_ bv65536 32))))
                 (assert (= (bvshl n (_ bv{} 32)) (bvmul (bvadd (bvshl q #x00000001) #x00000001) d)))",
                scale + 1
            )
        }
        other => panic!("no question for clause {other}: {cell}"),
    };
    format!("{assert}\n(check-sat)\n")
}
