//! `guardbit prove`: how few bits are enough for a whole window, with proofs.

use super::Outcome;
use super::failure::Failure;
use super::output::{Output, write_text};
use guardbit::explore::prove::{self, Answer, Check, Overrides, Proof, Question, Solver, Witness};
use guardbit::profile;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Duration;

/// Prove how few bits are enough for a whole window and guard band.
///
/// For each claim, the command prints a bound, and a counterexample for one bit fewer: a triangle that the
/// model draws wrong. The depth of machines without a plane (gouraud, barycentric) has a bound and no counterexample.
/// Of channels it also says how far a code is off at most. Exit status 1 if the profile has too few bits for a claim,
/// or if a prover disagrees.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// Prove only the claims whose name begins with PREFIX, for example `edge.` or `depth.interpolation`.
    #[arg(long, value_name = "PREFIX", default_value = "")]
    claim: String,
    /// Print a table of edge widths for the usual windows, instead of the claims of a profile.
    #[arg(long, conflicts_with_all = ["profile", "window", "guard_band", "sub_pixel", "depth_bits", "w_ratio"])]
    table: bool,
    /// Window as WIDTHxHEIGHT; replaces the window of the profile.
    #[arg(long, value_name = "WxH", value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// Guard band: vertices are at most this number of pixels outside the window. Replaces the limits of
    /// the vertex field of the profile.
    #[arg(long, value_name = "PIXELS")]
    guard_band: Option<u32>,
    /// Number of sub-pixel bits; replaces the value of the profile.
    #[arg(long, value_name = "BITS")]
    sub_pixel: Option<u32>,
    /// Number of depth bits; replaces the value of the profile.
    #[arg(long, value_name = "BITS")]
    depth_bits: Option<u32>,
    /// The largest w of a triangle is at most R times its smallest; for channels that are divided by 1/w.
    #[arg(long, value_name = "R", default_value_t = prove::W_RATIO,
          value_parser = clap::value_parser!(u32).range(1..))]
    w_ratio: u32,
    /// Write the claims to this file as SMT-LIB 2.6.
    #[arg(long, value_name = "FILE")]
    smt: Option<PathBuf>,
    /// Write the claims to this file as a Gappa script.
    #[arg(long, value_name = "FILE")]
    gappa: Option<PathBuf>,
    /// Check the claims with z3 and gappa, if they are installed.
    #[arg(long)]
    check: bool,
    /// Stop a prover after this time for one claim.
    #[arg(long, value_name = "SECONDS", default_value_t = 60,
          value_parser = clap::value_parser!(u64).range(1..=86_400))]
    limit: u64,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    equivalence: super::equivalence::Options,
}

/// The first claim asked for, and all of them.
#[derive(Serialize)]
struct Report<'a> {
    profile: Option<&'a str>,
    claim: &'a str,
    bits: Option<u32>,
    sufficient: bool,
    witness: Option<&'a Witness>,
    rows: &'a [Proof],
    #[serde(skip_serializing_if = "Option::is_none")]
    checks: Option<&'a [Check]>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if !arguments.equivalence.rtl.is_empty() {
        return super::equivalence::run(
            &arguments.profile,
            arguments.limit,
            &arguments.equivalence,
        );
    }
    let (about, proofs) = ask(arguments)?;
    write_files(arguments, &proofs)?;
    let checks = if arguments.check { Some(check(&proofs, arguments.limit)?) } else { None };
    let mut output = Output::new();
    if arguments.json {
        let first = &proofs[0];
        output.json(&Report {
            profile: (!arguments.table).then_some(&arguments.profile),
            claim: &first.claim,
            bits: first.bits,
            sufficient: first.sufficient,
            witness: first.witness.as_ref(),
            rows: &proofs,
            checks: checks.as_deref(),
        })?;
    } else {
        output.line(about)?;
        if arguments.table {
            print_table(&mut output, &proofs)?;
        } else {
            print_proofs(&mut output, &proofs)?;
        }
        print_checks(&mut output, checks.as_deref().unwrap_or_default())?;
        output.flush()?;
    }
    let met = proofs.iter().all(|proof| proof.sufficient);
    let agreed = checks
        .iter()
        .flatten()
        .all(|check| matches!(check.answer, Answer::Agrees | Answer::Missing));
    Ok(if met && agreed { Outcome::Good } else { Outcome::Mismatch })
}

/// What was asked, in a line, and the claims that answer it; at least one.
fn ask(arguments: &Arguments) -> Result<(String, Vec<Proof>), Failure> {
    let (about, mut proofs) = if arguments.table {
        let rows = prove::table().map_err(Failure::input)?;
        let proofs = rows.into_iter().flat_map(|row| [row.stored, row.full]).collect();
        ("Number of bits for the whole edge function (full), and without its low s bits (stored):".to_owned(), proofs)
    } else {
        let profile = profile::load(&arguments.profile)?;
        let Arguments { window, guard_band, sub_pixel, depth_bits, w_ratio, .. } = *arguments;
        let w_ratio = Some(w_ratio);
        let overrides = Overrides { window, guard_band, sub_pixel, depth_bits, w_ratio };
        let question = Question::new(&profile, overrides).map_err(Failure::input)?;
        let about = format!("{}: {}", question.profile.name, question.place());
        (about, prove::prove(&question))
    };
    let mut names: Vec<String> = proofs.iter().map(|proof| proof.claim.clone()).collect();
    names.sort_unstable();
    names.dedup();
    proofs.retain(|proof| proof.claim.starts_with(&arguments.claim));
    if proofs.is_empty() {
        let message =
            format!("--claim {:?}: the name of no claim begins with this text", arguments.claim);
        return Err(Failure::input(message).hint(&format!("the claims are {}", names.join(", "))));
    }
    Ok((about, proofs))
}

fn write_files(arguments: &Arguments, proofs: &[Proof]) -> Result<(), Failure> {
    if arguments.smt.is_some() && arguments.smt == arguments.gappa {
        return Err(Failure::input("--smt and --gappa name the same file: give two file names"));
    }
    let gappa = match &arguments.gappa {
        Some(path) => Some((
            path,
            prove::gappa(proofs).ok_or_else(|| {
                Failure::input("--gappa: Gappa cannot check any of the selected claims")
                    .hint("Gappa can check edge.full, edge.stored, depth.interpolation and channel.NAME.interpolation")
            })?,
        )),
        None => None,
    };
    if let Some(path) = &arguments.smt {
        write_text(path, &prove::smt(proofs))?;
    }
    if let Some((path, text)) = gappa {
        write_text(path, &text)?;
    }
    Ok(())
}

/// Hands every claim to every prover that is there; one that is not is said once.
fn check(proofs: &[Proof], limit: u64) -> Result<Vec<Check>, Failure> {
    let mut checks = Vec::new();
    for solver in Solver::ALL {
        for proof in proofs {
            let made = prove::check(solver, proof, Duration::from_secs(limit))
                .map_err(|error| Failure::io(solver.name(), &error))?;
            let Some(made) = made else { continue };
            if made.answer == Answer::Missing {
                eprintln!(
                    "note: {0} is not on the search path, so no claim is checked with {0}; install the \
                     package {0} (Debian, Homebrew and others)",
                    solver.name()
                );
                break;
            }
            checks.push(made);
        }
    }
    Ok(checks)
}

fn print_proofs(output: &mut Output, proofs: &[Proof]) -> Result<(), Failure> {
    for proof in proofs {
        let unit = proof.unit;
        let bits =
            proof.bits.map_or("no number of bits is enough".to_owned(), |bits| count(bits, unit));
        let given = proof.given.map_or(String::new(), |given| format!(", the profile has {given}"));
        output.line("")?;
        output.line(format!(
            "{}: {bits}{given} -> {}  ({})",
            proof.claim,
            proof.verdict(),
            proof.clause
        ))?;
        output.text(wrap(&proof.statement))?;
        output.text(wrap(&format!("bound: {}", proof.bound)))?;
        let none = "counterexample: none known, so the bound may not be tight";
        output.text(match (&proof.witness, proof.bits) {
            (Some(witness), _) => wrap(&describe(witness, unit)),
            (None, Some(0)) => wrap("counterexample: not possible, 0 bits are enough"),
            (None, Some(_)) => wrap(none),
            (None, None) => wrap("counterexample: none known"),
        })?;
    }
    Ok(())
}

fn count(number: u32, unit: Option<&str>) -> String {
    match unit {
        Some(unit) => format!("{number} {unit}"),
        None if number == 1 => "1 bit".to_owned(),
        None => format!("{number} bits"),
    }
}

/// A witness in words; coordinates are sub-pixels.
fn describe(witness: &Witness, unit: Option<&str>) -> String {
    let points = |list: &[[i128; 2]]| {
        let texts: Vec<String> = list.iter().map(|[x, y]| format!("({x}, {y})")).collect();
        texts.join(" ")
    };
    let mut text = format!("counterexample with {}:", count(witness.bits, unit));
    if !witness.triangle.is_empty() {
        let _ = write!(text, " triangle {} in sub-pixels", points(&witness.triangle));
    }
    if let Some([a, b, c]) = witness.depths {
        let _ = write!(text, ", depths {a} {b} {c}");
    }
    if let Some([a, b, c]) = witness.codes {
        let _ = write!(text, ", codes {a} {b} {c}");
    }
    if let Some(edge) = witness.edge.filter(|_| witness.triangle.is_empty()) {
        let _ = write!(text, " edge {} in sub-pixels", points(&edge));
    }
    if let Some(pixel) = witness.pixel {
        let _ = write!(text, ", pixel {}", points(&[pixel]));
    }
    let by = if witness.by == "model" { "the model draws" } else { "a word of this width gives" };
    text + &format!(". Exactly: {}; {by}: {}", witness.expected, witness.got)
}

fn print_table(output: &mut Output, proofs: &[Proof]) -> Result<(), Failure> {
    output.line(format!(
        "{:<16} {:<12} {:>4}  {}",
        "row", "claim", "bits", "counterexample for one bit fewer, in sub-pixels"
    ))?;
    for proof in proofs {
        let fewer =
            proof.witness.as_ref().map_or("no counterexample known".to_owned(), |witness| {
                let sample = witness.sample.unwrap_or_default();
                let [from, to] = witness.edge.unwrap_or_default();
                format!("edge {from:?} to {to:?} at {sample:?}: {}", witness.got)
            });
        let row = proof.row.as_deref().unwrap_or_default();
        let bits = proof.bits.map_or("none".to_owned(), |bits| bits.to_string());
        output.line(format!("{row:<16} {:<12} {bits:>4}  {fewer}", proof.claim))?;
    }
    Ok(())
}

fn print_checks(output: &mut Output, checks: &[Check]) -> Result<(), Failure> {
    if !checks.is_empty() {
        output.line("")?;
    }
    for check in checks {
        let answer = match &check.answer {
            Answer::Agrees => "agrees".to_owned(),
            Answer::Differs(said) => format!("DISAGREES: {said}"),
            Answer::TimedOut => "STOPPED at the time limit".to_owned(),
            Answer::Missing => "is not installed".to_owned(),
        };
        let (name, claim, seconds) = (check.solver.name(), &check.claim, check.seconds);
        output.line(format!("{name:<6} {claim:<24} {seconds:>6.2} s  {answer}"))?;
    }
    Ok(())
}

/// The text in indented lines of at most 100 characters.
fn wrap(text: &str) -> String {
    let (mut out, mut line) = (String::new(), String::new());
    for word in text.split_whitespace() {
        if !line.is_empty() && line.len() + 1 + word.len() > 98 {
            let _ = writeln!(out, "  {line}");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line += word;
    }
    out + &format!("  {line}\n")
}
