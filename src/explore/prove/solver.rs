//! Independent provers, where they are installed. Spec clause `B-11`.

use super::{Proof, gappa, smt};
use serde::Serialize;
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A prover that a claim is handed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// An SMT solver over the reals.
    Z3,
    /// Interval arithmetic with roundings.
    Gappa,
}

impl Solver {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Z3, Self::Gappa];

    /// The program's name on the search path, which is also its package's.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Z3 => "z3",
            Self::Gappa => "gappa",
        }
    }

    /// What it reads for one claim, if it takes that claim.
    fn input(self, proof: &Proof) -> Option<String> {
        match self {
            Self::Z3 => proof.formal.smt.as_ref().map(|_| smt([proof])),
            Self::Gappa => gappa([proof]),
        }
    }

    const fn arguments(self) -> &'static [&'static str] {
        match self {
            Self::Z3 => &["-smt2", "-in"],
            Self::Gappa => &[],
        }
    }
}

/// What a prover made of a claim.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// It agrees.
    Agrees,
    /// It says otherwise, or something else: its own words.
    Differs(String),
    /// It was stopped when its time was over.
    TimedOut,
    /// It is not on the search path.
    Missing,
}

/// One claim before one prover.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The claim.
    pub claim: String,
    /// What it was made for.
    pub place: String,
    /// Who was asked.
    pub solver: Solver,
    /// What came back.
    pub answer: Answer,
    /// How long it took.
    pub seconds: f64,
}

/// Hands a claim to a prover through its standard input; `None` if the prover does not take it.
///
/// The prover is looked up on the search path and killed when it runs longer than `limit`.
///
/// # Errors
/// Whatever goes wrong in running it, but that it is not installed.
pub fn check(solver: Solver, proof: &Proof, limit: Duration) -> std::io::Result<Option<Check>> {
    let Some(input) = solver.input(proof) else { return Ok(None) };
    let begun = Instant::now();
    let answer = match run(solver, &input, limit) {
        Ok(Some(ran)) => judge(solver, &input, &ran),
        Ok(None) => Answer::TimedOut,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Answer::Missing,
        Err(error) => return Err(error),
    };
    let (claim, place) = (proof.claim.clone(), proof.place.clone());
    Ok(Some(Check { claim, place, solver, answer, seconds: begun.elapsed().as_secs_f64() }))
}

/// What a prover printed and whether it ended well.
struct Ran {
    out: String,
    good: bool,
}

fn run(solver: Solver, input: &str, limit: Duration) -> std::io::Result<Option<Ran>> {
    let mut child = Command::new(solver.name())
        .args(solver.arguments())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let pipes = (child.stdin.take(), child.stdout.take(), child.stderr.take());
    std::thread::scope(|scope| {
        let (Some(mut to), Some(out), Some(err)) = pipes else { return Ok(None) };
        // A prover that has seen enough may close its input: its answer tells.
        scope.spawn(move || to.write_all(input.as_bytes()));
        let readers = [scope.spawn(move || drain(out)), scope.spawn(move || drain(err))];
        let status = wait(&mut child, limit)?;
        let mut text = String::new();
        for reader in readers {
            text += &reader.join().unwrap_or_default();
        }
        Ok(status.map(|good| Ran { out: text, good }))
    })
}

fn drain(mut from: impl Read) -> String {
    let mut bytes = Vec::new();
    // What was read until an error is still what it said.
    let _ = from.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Whether it ended well; `None` after killing it at the limit.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<Option<bool>> {
    let begun = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status.success()));
        }
        if begun.elapsed() >= limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn judge(solver: Solver, input: &str, ran: &Ran) -> Answer {
    let agrees = match solver {
        Solver::Gappa => ran.good,
        Solver::Z3 => {
            let expected = input.lines().filter_map(|line| line.strip_prefix("; expect: "));
            let answers = ran.out.lines().filter(|line| !line.contains("expect"));
            ran.good && expected.eq(answers)
        }
    };
    if agrees {
        return Answer::Agrees;
    }
    let said = ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
    Answer::Differs(if said.is_empty() { "no answer".to_owned() } else { said })
}
