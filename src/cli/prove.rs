//! `guardbit prove`: how few bits are enough for a whole window, and how that is known.

use super::Outcome;
use super::failure::Failure;
use super::output::{Output, write_text};
use guardbit::explore::prove::{self, Answer, Check, Overrides, Proof, Question, Solver, Witness};
use guardbit::profile;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Duration;

/// How few bits are enough for a whole window and guard band: bounds, and for one bit fewer a
/// triangle that the model draws wrong.
///
/// Exit status 1 when the profile has too few bits for a claim, or a prover disagrees.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// Only claims whose name begins so, such as `edge.` or `depth.interpolation`.
    #[arg(long, value_name = "PREFIX", default_value = "")]
    claim: String,
    /// Edge widths of the usual windows instead of a profile's claims.
    #[arg(long, conflicts_with_all = ["profile", "window", "guard_band", "sub_pixel", "depth_bits"])]
    table: bool,
    /// Window size instead of the profile's.
    #[arg(long, value_name = "WxH", value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// Vertices lie within this many pixels of the window, whatever the profile's field.
    #[arg(long, value_name = "PIXELS")]
    guard_band: Option<u32>,
    /// Sub-pixel bits instead of the profile's.
    #[arg(long, value_name = "BITS")]
    sub_pixel: Option<u32>,
    /// Depth bits instead of the profile's.
    #[arg(long, value_name = "BITS")]
    depth_bits: Option<u32>,
    /// Write the claims as SMT-LIB 2.6.
    #[arg(long, value_name = "FILE")]
    smt: Option<PathBuf>,
    /// Write the claims as a Gappa script.
    #[arg(long, value_name = "FILE")]
    gappa: Option<PathBuf>,
    /// Ask z3 and gappa, where they are installed.
    #[arg(long)]
    check: bool,
    /// Stop a prover that takes longer over one claim.
    #[arg(long, value_name = "SECONDS", default_value_t = 60,
          value_parser = clap::value_parser!(u64).range(1..=86_400))]
    limit: u64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
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
        ("Bits that hold an edge function, whole and without its low s bits:".to_owned(), proofs)
    } else {
        let profile = profile::load(&arguments.profile)?;
        let Arguments { window, guard_band, sub_pixel, depth_bits, .. } = *arguments;
        let overrides = Overrides { window, guard_band, sub_pixel, depth_bits };
        let question = Question::new(&profile, overrides).map_err(Failure::input)?;
        let about = format!("{}: {}", question.profile.name, question.place());
        (about, prove::prove(&question))
    };
    let mut names: Vec<String> = proofs.iter().map(|proof| proof.claim.clone()).collect();
    names.sort_unstable();
    names.dedup();
    proofs.retain(|proof| proof.claim.starts_with(&arguments.claim));
    if proofs.is_empty() {
        let message = format!("--claim {:?}: no claim's name begins so", arguments.claim);
        return Err(Failure::input(message).hint(&format!("there are {}", names.join(", "))));
    }
    Ok((about, proofs))
}

fn write_files(arguments: &Arguments, proofs: &[Proof]) -> Result<(), Failure> {
    if arguments.smt.is_some() && arguments.smt == arguments.gappa {
        return Err(Failure::input("--smt and --gappa name the same file"));
    }
    let gappa = match &arguments.gappa {
        Some(path) => Some((
            path,
            prove::gappa(proofs).ok_or_else(|| {
                Failure::input("--gappa: none of these claims is one that Gappa takes")
                    .hint("edge.full, edge.stored and depth.interpolation are")
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
                    "note: {0} is not on the search path, so its checks are left out; it is the \
                     package {0} of Debian, Homebrew and others",
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
        let bits = proof.bits.map_or("no number of bits".to_owned(), count);
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
        let none = "witness: none known, so the bound is not known to be tight";
        output.text(match (&proof.witness, proof.bits) {
            (Some(witness), _) => wrap(&describe(witness)),
            (None, Some(0)) => wrap("witness: there are no fewer bits"),
            (None, Some(_)) => wrap(none),
            (None, None) => wrap("witness: none known"),
        })?;
    }
    Ok(())
}

fn count(bits: u32) -> String {
    if bits == 1 { "1 bit".to_owned() } else { format!("{bits} bits") }
}

/// A witness in words; coordinates are sub-pixels.
fn describe(witness: &Witness) -> String {
    let points = |list: &[[i128; 2]]| {
        let texts: Vec<String> = list.iter().map(|[x, y]| format!("({x}, {y})")).collect();
        texts.join(" ")
    };
    let mut text = format!("witness, {}:", count(witness.bits));
    if !witness.triangle.is_empty() {
        let _ = write!(text, " triangle {} in sub-pixels", points(&witness.triangle));
    }
    if let Some([a, b, c]) = witness.depths {
        let _ = write!(text, ", depths {a} {b} {c}");
    }
    if let Some(edge) = witness.edge.filter(|_| witness.triangle.is_empty()) {
        let _ = write!(text, " edge {} in sub-pixels", points(&edge));
    }
    if let Some(pixel) = witness.pixel {
        let _ = write!(text, ", pixel {}", points(&[pixel]));
    }
    let by = if witness.by == "model" { "the model draws" } else { "a word of them reads" };
    text + &format!(". Exactly: {}; {by}: {}", witness.expected, witness.got)
}

fn print_table(output: &mut Output, proofs: &[Proof]) -> Result<(), Failure> {
    output.line(format!(
        "{:<16} {:<12} {:>4}  {}",
        "row", "claim", "bits", "one bit fewer, in sub-pixels"
    ))?;
    for proof in proofs {
        let fewer = proof.witness.as_ref().map_or("not known to fail".to_owned(), |witness| {
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
            Answer::TimedOut => "STOPPED at its limit".to_owned(),
            Answer::Missing => "is not there".to_owned(),
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
