//! Set-up words of a module for all vertices: both sides as polynomials. Spec clause `J-10`.

mod trial;

use super::clauses::{Range, Vertex, Want, Wants, clauses};
use super::map::Wiring;
use super::netlist::{self, Bit};
use super::polynomial::{Algebra, Polynomial};
use super::words::{Control, Way, Words};
use super::work::{Device, Work};
use super::{EquivalenceError, Map, MapError, Question, Refutation, Verdict};
use crate::profile::Profile;
use crate::vector::write::Devices;
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::fmt::Write as _;
use trial::{CLOCKS, CORNERS, Trial};

/// Triangles whose words are worked out of the netlist, too.
const CASES: usize = 1000;
/// What a proof leaves behind.
const FORMS: &str = "polynomials.txt";

/// An output of the module: which word it has to be, and its bits.
#[derive(Clone, Copy)]
struct Output<'a> {
    name: &'static str,
    port: &'a str,
    range: Range,
}

/// Both sides of a question.
struct Sides<'a> {
    module: &'a str,
    algebra: Algebra,
    words: Words<'a>,
    /// The registers on the way of the outputs so far.
    way: Option<Way>,
    /// Both sides of each word, as text.
    forms: String,
    /// Words that differ, and in how many terms.
    differ: Vec<(&'static str, usize)>,
}

/// Asks whether a module's words are the profile's. Gives what it takes for granted, too.
pub(super) fn prove(
    question: &Question<'_>,
    (devices, map, wiring): (&Devices, &Map, &Wiring),
    (work, device): (&Work<'_>, &Device),
) -> Result<(Verdict, Vec<String>), EquivalenceError> {
    let module = map.module.as_str();
    let wrong = |what: String| MapError { module: module.to_owned(), what };
    let design = |what: String| EquivalenceError::Design { module: module.to_owned(), what };
    work.words(device, module)?;
    let flat = netlist::flat(&work.read("words.json")?).map_err(design)?;
    let mut algebra = Algebra::default();
    let (inputs, vertices) = given(&mut algebra, question.profile, devices, map);
    let Wants { live, words: wants } = clauses(&mut algebra, devices, vertices);
    let forms =
        "# Written by guardbit prove --rtl: both sides of each word, in normal form.\n".to_owned();
    let net = |port: &str| flat.ports.get(port).and_then(|port| port.bits.first().copied());
    let reset = map.reset.as_ref();
    let corners = map.ports.iter().filter(|(signal, _)| signal.starts_with('v'));
    let data: Vec<&str> = corners.map(|(_, port)| port.as_str()).collect();
    let control = Control {
        clock: wiring.clock.as_deref().and_then(net),
        reset: reset.and_then(|reset| Some((net(&reset.port)?, reset.active_low))),
        data: &data,
    };
    let words = Words::new(&flat, &inputs, control);
    let mut sides = Sides { module, algebra, words, way: None, forms, differ: Vec::new() };
    let mut outputs = Vec::new();
    for want in &wants {
        let Some(name) = map.ports.get(want.name) else { continue };
        let bits = flat.ports.get(name).map(|port| &port.bits).or_else(|| flat.names.get(name));
        let bits = bits.ok_or_else(|| {
            wrong(format!("{}: the module has neither a port nor a wire {name}", want.name))
        })?;
        has_room(&sides.algebra, want, bits.len()).map_err(wrong)?;
        outputs.push((want, bits, Output { name: want.name, port: name, range: want.range }));
    }
    if outputs.is_empty() {
        return Err(wrong("[ports] has no output: nothing would be compared".to_owned()).into());
    }
    for (want, bits, _) in &outputs {
        match sides.compare(want, bits, &live) {
            // Where nothing is clocked, triangles may still show a difference.
            Err(error) if sides.algebra.is_spent() => {
                let outputs: Vec<Output<'_>> = outputs.iter().map(|(.., output)| *output).collect();
                let trial = Trial::new(question.profile, (devices, map), &outputs);
                let clocked = flat.cells.values().any(|cell| cell.kind.contains("dff"));
                let example =
                    if clocked { None } else { trial.differing(&flat, CASES).map_err(design)? };
                let verdict = match example {
                    Some(example) => Verdict::Refuted(Refutation::Triangle(example)),
                    None => Verdict::Undecided { words: error.to_string() },
                };
                return Ok((verdict, sides.assumed(question.profile, &outputs)));
            }
            other => other?,
        }
    }
    let outputs: Vec<Output<'_>> = outputs.into_iter().map(|(.., output)| output).collect();
    work.write(FORMS, &sides.forms)?;
    let stages = sides.way.as_ref().map_or(0, Vec::len);
    if sides.words.enables == 0 && stages != map.latency as usize {
        let latency = map.latency;
        return Err(
            wrong(format!("latency = {latency}, and the words come {stages} clocks late")).into()
        );
    }
    if sides.words.enables > 0 && map.latency > 0 {
        let what =
            "latency: registers load by enables, so no number of clocks is told: leave it out";
        return Err(wrong(what.to_owned()).into());
    }
    let assumed = sides.assumed(question.profile, &outputs);
    let trial = Trial::new(question.profile, (devices, map), &outputs);
    let clocked = netlist::flat(&work.read("clocked.json")?).map_err(design)?;
    let differing = trial.differing(&flat, CASES).map_err(design)?;
    let verdict = match (differing, sides.differ.first()) {
        (Some(example), _) => Verdict::Refuted(Refutation::Triangle(example)),
        (None, None)
            if sides.words.enables > 0 && !trial.flows(&clocked, wiring).map_err(design)? =>
        {
            Verdict::Undecided {
                words: format!(
                    "both sides of each word are equal, but with vertices that stand still the module does not show \
                     the words within {CLOCKS} clocks: give the inputs that let a record through in [constants]"
                ),
            }
        }
        (None, None) => Verdict::Proved {
            engine: "polynomials",
            words: format!(
                "{0} of {0} words have one normal form on both sides ({FORMS}); {1} triangles agree",
                outputs.len(),
                CASES + CORNERS
            ),
        },
        (None, Some((name, terms))) => Verdict::Undecided {
            words: format!(
                "{name} has another normal form, by {terms} terms ({FORMS}), and {} triangles show no difference",
                CASES + CORNERS
            ),
        },
    };
    Ok((verdict, assumed))
}

/// The vertices, and the module's inputs that are known.
fn given<'a>(
    algebra: &mut Algebra,
    profile: &Profile,
    devices: &Devices,
    map: &'a Map,
) -> (Vec<(&'a str, Polynomial)>, [Vertex; 3]) {
    let (low, high) = profile.vertex.range();
    let most = (1i128 << devices.depth.integer) - 1;
    let mut inputs: Vec<(&str, Polynomial)> = Vec::new();
    let mut input = |name: &str, low: i128, high: i128| {
        let value = algebra.input(name, low.into(), high.into());
        if let Some(port) = map.ports.get(name) {
            inputs.push((port.as_str(), value.clone()));
        }
        value
    };
    let vertices = [0, 1, 2].map(|k| Vertex {
        x: input(&format!("v{k}_x"), low, high),
        y: input(&format!("v{k}_y"), low, high),
        z: input(&format!("v{k}_z"), 0, most),
    });
    // No reset is under way.
    let level = |active_low| Polynomial::constant(u8::from(active_low));
    inputs.extend(map.reset.iter().map(|reset| (reset.port.as_str(), level(reset.active_low))));
    let constants = map.constants.iter();
    inputs.extend(constants.map(|(port, value)| (port.as_str(), Polynomial::constant(*value))));
    (inputs, vertices)
}

/// Whether a port holds every number that it has to.
fn has_room(algebra: &Algebra, want: &Want, width: usize) -> Result<(), String> {
    let name = want.name;
    let fits = |low: BigInt, high: BigInt| algebra.fits(&want.value, &low, &high);
    let room = match want.range {
        Range::Word(bits) if bits as usize == width => return Ok(()),
        Range::Word(bits) => {
            return Err(format!("{name}: {width} bits != {bits}, the width in the profile"));
        }
        Range::Unsigned => fits(BigInt::zero(), (BigInt::one() << width) - 1u32),
        Range::Signed => {
            let half = BigInt::one() << (width - 1);
            fits(-&half, half - 1u32)
        }
    };
    if room {
        Ok(())
    } else {
        Err(format!("{name}: {width} bits are too few for each value of it"))
    }
}

impl Sides<'_> {
    fn compare(
        &mut self,
        want: &Want,
        bits: &[Bit],
        live: &Polynomial,
    ) -> Result<(), EquivalenceError> {
        let (name, width) = (want.name, u32::try_from(bits.len()).unwrap_or(u32::MAX));
        let design = |module: &str, what: String| EquivalenceError::Design {
            module: module.to_owned(),
            what: format!("{name}: {what}"),
        };
        let got = self.words.joined(bits, &mut self.algebra);
        let got = got.map_err(|what| design(self.module, what))?;
        if let (Some(here), Some(there)) = (&self.way, &got.way)
            && here != there
        {
            let what =
                "it comes behind other registers than the words before it, or their enables differ";
            return Err(design(self.module, what.to_owned()));
        }
        self.way = self.way.take().or(got.way);
        let difference = &got.value - &want.value;
        let difference = match want.range {
            Range::Word(_) => difference,
            // Where there is no area, numerators are anything.
            Range::Unsigned | Range::Signed => self.algebra.product(live, &difference),
        };
        let difference = difference.reduced(width);
        let [left, right, rest] =
            [&got.value.reduced(width), &want.value.reduced(width), &difference]
                .map(|side| self.algebra.text(side));
        let _ = writeln!(
            self.forms,
            "\n{name} mod 2^{width}\n  module:     {left}\n  reference:  {right}\n  difference: {rest}"
        );
        if difference.len() > 0 {
            self.differ.push((name, difference.len()));
        }
        Ok(())
    }

    fn assumed(&self, profile: &Profile, outputs: &[Output<'_>]) -> Vec<String> {
        let (low, high) = profile.vertex.range();
        let mut list = vec![format!("each coordinate is in {low} to {high}, the profile's field")];
        if let Some(way) = self.way.as_ref().filter(|way| !way.is_empty()) {
            let stages =
                if way.len() == 1 { "1 stage".to_owned() } else { format!("{} stages", way.len()) };
            let registers = self.words.registers.len();
            list.push(format!(
                "no reset while a record is in the {registers} registers on its way, {stages}"
            ));
            if self.words.enables > 0 {
                list.push(
                    "words are looked at when these registers hold one record: valid and ready are not proved"
                        .to_owned(),
                );
            }
        }
        if outputs.iter().any(|output| !matches!(output.range, Range::Word(_))) {
            list.push(
                "area and plane numerators are looked at where the area is not zero".to_owned(),
            );
        }
        list
    }
}
