//! A divider of several clocks against long division, in step. Spec clause `J-11`.
//!
//! No solver multiplies a quotient of 117 bits by a divisor. So nothing is multiplied: the reference divides by
//! hand, as many bits a clock as the module, and what the registers of the module mean is said in lemmas over the
//! reference's own. They are proved with the answer, by induction over two clocks.

mod text;

use super::map::Steps;
use super::netlist;
use super::simulate::Simulation;
use super::work::Work;
use super::{Asked, EquivalenceError, Map, MapError, Refutation, Verdict};
use crate::bits::Rounding;
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// Divisions that are worked through, clock by clock.
const CASES: u64 = 30;
/// Induction over two clocks, with its beginning.
const INDUCTION: &str = "scorr; bmc3 -F 4; ind -F 2";

/// A divider's bits, and the clocks that it takes.
struct Division<'a> {
    numerator: u32,
    divisor: u32,
    rounding: Rounding,
    steps: &'a Steps,
}

impl Division<'_> {
    /// Clocks with a step.
    fn clocks(&self) -> u32 {
        self.numerator.div_ceil(self.steps.bits_per_clock)
    }
}

/// Asks whether a module divides as the profile does.
pub(super) fn prove(
    asked: &Asked<'_>,
    work: &Work<'_>,
) -> Result<(Verdict, Vec<String>), EquivalenceError> {
    let Asked { devices, map, wiring, module, .. } = *asked;
    let width = |signal: &str| {
        let port = &map.ports[signal];
        module.ports.iter().find(|other| other.name == *port).map_or(1, |port| port.width)
    };
    let wrong = |what: String| MapError { module: map.module.clone(), what };
    let steps = map.division.clone().unwrap_or_default();
    let division = Division {
        numerator: width("numerator"),
        divisor: width("divisor"),
        rounding: devices.depth.rounding,
        steps: &steps,
    };
    let Division { numerator, divisor, .. } = division;
    let Steps { bits_per_clock, lead, .. } = steps;
    if width("quotient") != numerator {
        let quotient = width("quotient");
        return Err(wrong(format!(
            "quotient: {quotient} bits != {numerator}, those of the numerator"
        ))
        .into());
    }
    if !(2..=126).contains(&numerator) || divisor > 126 {
        let what = format!(
            "numerator and divisor have {numerator} and {divisor} bits: 2 to 126 and 1 to 126"
        );
        return Err(wrong(what).into());
    }
    if !(1..=numerator).contains(&bits_per_clock) {
        let what = format!("[division] bits-per-clock = {bits_per_clock}: 1 to {numerator}");
        return Err(wrong(what).into());
    }
    if lead > 63 {
        return Err(wrong(format!("[division] lead = {lead}: 0 to 63 clocks")).into());
    }
    let assumed = assumed(map);
    // A wire of a name that the text has already would be another one.
    let plain = Division { steps: &Steps { lemmas: Vec::new(), ..steps.clone() }, ..division };
    let plain = plain.miter(map, wiring, &[]);
    let names: Vec<&str> = plain.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    if let Some(name) = steps.wires.keys().find(|name| names.contains(&name.as_str())) {
        return Err(wrong(format!(
            "[division.wires] {name}: the reference has this name, take another"
        ))
        .into());
    }
    let wires = work.opened(module, map, &steps)?;
    work.write("miter.sv", &division.miter(map, wiring, &wires))?;
    work.netlist("read_rtlil opened.il", &map.module)?;
    let undecided = |words: String| Verdict::Undecided { words };
    let cases = match simulate(asked, &division, work)? {
        Worked::Right(cases) => cases,
        Worked::Wrong(example) => {
            return Ok((Verdict::Refuted(Refutation::Division(example)), assumed));
        }
        Worked::Against { lemma, numerator, divisor, clock } => {
            let lemma = &steps.lemmas[lemma];
            let words = format!(
                "the lemma {lemma:?} does not hold {clock} clocks after the start of {numerator} / {divisor}"
            );
            return Ok((undecided(words), assumed));
        }
    };
    if cases == 0 {
        let words = "in no division the module came to its end".to_owned();
        return Ok((undecided(words), assumed));
    }
    work.gates("bad", "compared")?;
    let induced = work.abc("bad", INDUCTION)?;
    if let Some(ran) = induced.filter(|ran| {
        ran.good()
            && ran.says("No output asserted in 4 frames")
            && ran.says("Networks are equivalent")
    }) {
        let engine = "yosys-abc scorr and induction over 2 clocks";
        return Ok((Verdict::Proved { engine, words: ran.last() }, assumed));
    }
    let verdict = match work.abc("bad", "scorr; pdr")? {
        Some(ran) if ran.good() && ran.says("Property proved.") => {
            Verdict::Proved { engine: "yosys-abc scorr and pdr", words: ran.last() }
        }
        Some(ran) => undecided(format!(
            "yosys-abc: {}; {cases} divisions show no difference; a lemma may not hold at each clock, or one is \
             missing",
            ran.last()
        )),
        None => undecided(format!(
            "yosys-abc ran longer than {} s; {cases} divisions show no difference; say more of the module's \
             registers in lemmas",
            work.limit.as_secs()
        )),
    };
    Ok((verdict, assumed))
}

/// What a proof takes for granted.
fn assumed(map: &Map) -> Vec<String> {
    let mut list =
        vec!["all state changes at the rising edge of one clock, or at a reset".to_owned()];
    list.push("the first clock is a reset; resets may come at any later clock".to_owned());
    list.push("the divisor is not zero".to_owned());
    if map.ports.contains_key("busy") {
        list.push("the quotient is looked at while the module is not busy".to_owned());
    } else {
        list.push("start comes after done, and the quotient is looked at with done".to_owned());
    }
    list.push("that the module ends is not proved, only that it ends right".to_owned());
    list.extend(
        map.constants.iter().map(|(port, value)| format!("{port} is {value} at every clock")),
    );
    list
}

/// A division that goes wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongDivision {
    /// The numerator, signed.
    pub numerator: i128,
    /// The divisor.
    pub divisor: i128,
    /// The module's quotient, as a pattern.
    pub got: BigInt,
    /// The quotient, as a pattern.
    pub want: BigInt,
}

/// What became of divisions that were worked through.
enum Worked {
    /// So many came to an end, and rightly.
    Right(u64),
    /// This one did not.
    Wrong(WrongDivision),
    /// A lemma did not hold.
    Against { lemma: usize, numerator: i128, divisor: i128, clock: u32 },
}

/// Works divisions through, clock by clock.
fn simulate(
    asked: &Asked<'_>,
    division: &Division<'_>,
    work: &Work<'_>,
) -> Result<Worked, EquivalenceError> {
    let design = |what: String| asked.design(what);
    let flat = netlist::flat(&work.read("clocked.json")?).map_err(design)?;
    let mut simulation = Simulation::new(&flat).clocked();
    let output = |simulation: &mut Simulation<'_>, port: &str| {
        let number = flat.names.get(port).and_then(|bits| simulation.number(bits));
        number.ok_or_else(|| design(format!("{port}: a cell before it has no plain reading here")))
    };
    let limit = 2 * division.numerator + division.steps.lead + 64;
    let mut numbers = Numbers(1);
    let (mut ended, mut against) = (0, None);
    simulation.set([("rst", 1)]);
    simulation.clock();
    for n in 0..CASES {
        let (numerator, divisor) = numbers.operands(division, n);
        let given = [("start", 1), ("numerator", numerator), ("divisor", divisor)];
        // Now and then one is broken off by a reset.
        for clock in 0..if n % 4 == 3 { n } else { 0 } {
            simulation.set(
                given
                    .into_iter()
                    .filter(|_| clock == 0)
                    .chain([("rst", i128::from(clock + 1 == n))]),
            );
            simulation.clock();
        }
        for clock in 0..limit {
            simulation.set(given.into_iter().filter(|_| clock == 0));
            for lemma in 0..division.steps.lemmas.len() {
                // A quotient that is wrong says more.
                if against.is_none()
                    && output(&mut simulation, &format!("lemma_{lemma}"))?.is_zero()
                {
                    against = Some(Worked::Against { lemma, numerator, divisor, clock });
                }
            }
            let compared = clock > 0 && !output(&mut simulation, "compared")?.is_zero();
            let got = output(&mut simulation, "got_quotient")?;
            simulation.clock();
            if !compared {
                continue;
            }
            let Some((want, _)) = division.rounding.divide(numerator, divisor) else { break };
            let want = BigInt::from(want) & ((BigInt::one() << division.numerator) - 1u32);
            if got != want {
                return Ok(Worked::Wrong(WrongDivision { numerator, divisor, got, want }));
            }
            ended += 1;
            break;
        }
    }
    Ok(against.unwrap_or(Worked::Right(ended)))
}

/// Numbers from a linear congruence.
struct Numbers(u64);

impl Numbers {
    fn word(&mut self, bits: u32) -> i128 {
        let mut word = 0u128;
        for _ in 0..4 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            word = word << 32 | u128::from(self.0 >> 32);
        }
        (word >> (128 - bits)).cast_signed()
    }

    /// A number of any length up to so many bits.
    fn short(&mut self, bits: u32) -> i128 {
        let length = 1 + u32::try_from(self.word(16)).unwrap_or(0) % bits;
        self.word(length)
    }

    /// Operands of all lengths, and those whose quotients are exact, ties, or at the ends of their range.
    fn operands(&mut self, division: &Division<'_>, n: u64) -> (i128, i128) {
        let magnitude = division.numerator - 1;
        let most = (1 << division.divisor) - 1;
        let divisor = match n % 5 {
            0 => most,
            1 => 1,
            2 => self.word(division.divisor),
            _ => self.short(division.divisor),
        }
        .max(1);
        let numerator = match n / 5 {
            0 => -(1 << magnitude),
            1 => (1 << magnitude) - 1,
            // An odd number of halves of an even divisor, on both sides of zero.
            2 | 3 if magnitude >= 6 && most >= 2 => {
                let half = (divisor >> 1).max(1).min(1 << (magnitude / 2));
                let odd = 2 * self.short(magnitude / 2 - 1) + 1;
                let tie = half * odd;
                return (if n.is_multiple_of(2) { tie } else { -tie }, 2 * half);
            }
            4 => self.short(magnitude) / divisor * divisor,
            _ => -self.short(magnitude),
        };
        (numerator, divisor)
    }
}
