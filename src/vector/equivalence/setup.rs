//! Set-up words of a module for all vertices: both sides as polynomials. Spec clause `J-10`.

mod trial;

use super::clauses::{Range, Vertex, Want, Wants, clauses};
use super::netlist::{self, Bit};
use super::polynomial::{Algebra, Polynomial};
use super::words::{Control, Way, Words};
use super::work::Work;
use super::{Asked, EquivalenceError, MapError, Refutation, Verdict};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::fmt::Write as _;
use trial::{CLOCKS, CORNERS, Trial};

/// Triangles whose words are worked out of the netlist, too.
const CASES: usize = 1000;
/// What a proof leaves behind.
const FORMS: &str = "polynomials.txt";

/// An output of the module: the word that it has to be.
struct Output<'a> {
    want: &'a Want,
    /// A port of the module, or a wire.
    port: &'a str,
    bits: &'a [Bit],
}

/// Both sides of a question.
struct Sides<'a> {
    asked: &'a Asked<'a>,
    algebra: Algebra,
    words: Words<'a>,
    /// The registers on the way of the outputs so far.
    way: Option<Way>,
    /// Both sides of each word, as text.
    forms: String,
    /// Words that differ, and in how many terms.
    differ: Vec<(&'static str, usize)>,
}

/// Asks whether a module's words are the profile's.
pub(super) fn prove(
    asked: &Asked<'_>,
    work: &Work<'_>,
) -> Result<(Verdict, Vec<String>), EquivalenceError> {
    let Asked { map, wiring, module, .. } = *asked;
    let wrong = |what: String| MapError { module: map.module.clone(), what };
    work.words(module, &map.module)?;
    let flat = |name| netlist::flat(&work.read(name)?).map_err(|what| asked.design(what));
    let (flat, clocked) = (flat("words.json")?, flat("clocked.json")?);
    let mut algebra = Algebra::default();
    let (inputs, vertices) = given(&mut algebra, asked);
    let Wants { live, words: wants } = clauses(&mut algebra, asked.devices, vertices);
    let net = |port: &str| flat.ports.get(port).and_then(|port| port.bits.first().copied());
    let reset = map.reset.as_ref();
    let corners = map.ports.iter().filter(|(signal, _)| signal.starts_with('v'));
    let data: Vec<&str> = corners.map(|(_, port)| port.as_str()).collect();
    let control = Control {
        clock: wiring.clock.as_deref().and_then(net),
        reset: reset.and_then(|reset| Some((net(&reset.port)?, reset.active_low))),
        data: &data,
    };
    let mut outputs = Vec::new();
    for want in &wants {
        let Some(port) = map.ports.get(want.name) else { continue };
        let bits = flat.wire(port).ok_or_else(|| {
            wrong(format!("{}: the module has neither a port nor a wire {port}", want.name))
        })?;
        has_room(&algebra, want, bits.len()).map_err(wrong)?;
        outputs.push(Output { want, port, bits });
    }
    let forms =
        "# Written by guardbit prove --rtl: both sides of each word, in normal form.\n".to_owned();
    let words = Words::new(&flat, &inputs, control);
    let mut sides = Sides { asked, algebra, words, way: None, forms, differ: Vec::new() };
    let trial = Trial::new(asked, &outputs);
    let refuted = |example| Verdict::Refuted(Refutation::Triangle(example));
    for output in &outputs {
        match sides.compare(output, &live) {
            // Where nothing is clocked, triangles may still show a difference.
            Err(error) if sides.algebra.is_spent() => {
                let example =
                    if flat.is_clocked() { None } else { trial.differing(&flat, CASES)? };
                let words = error.to_string();
                let verdict = example.map_or(Verdict::Undecided { words }, refuted);
                return Ok((verdict, sides.assumed(&outputs)));
            }
            other => other?,
        }
    }
    work.write(FORMS, &sides.forms)?;
    sides.has_latency().map_err(wrong)?;
    let assumed = sides.assumed(&outputs);
    let agree = format!("{} triangles", CASES + CORNERS);
    let undecided = |words| Verdict::Undecided { words };
    let verdict = if let Some(example) = trial.differing(&flat, CASES)? {
        refuted(example)
    } else if let Some((name, terms)) = sides.differ.first() {
        undecided(format!(
            "{name} has another normal form, by {terms} terms ({FORMS}), and {agree} show no difference"
        ))
    } else if sides.words.enabled && !trial.flows(&clocked)? {
        undecided(format!(
            "both sides of each word are equal, but with vertices that stand still the module does not show the \
             words within {CLOCKS} clocks: give the inputs that let a record through in [constants]"
        ))
    } else {
        let words = format!(
            "{0} of {0} words have one normal form on both sides ({FORMS}); {agree} agree",
            outputs.len()
        );
        Verdict::Proved { engine: "polynomials", words }
    };
    Ok((verdict, assumed))
}

/// The vertices, and the module's inputs that are known.
fn given<'a>(
    algebra: &mut Algebra,
    asked: &Asked<'a>,
) -> (Vec<(&'a str, Polynomial)>, [Vertex; 3]) {
    let Asked { profile, devices, map, .. } = *asked;
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
    fn compare(&mut self, output: &Output<'_>, live: &Polynomial) -> Result<(), EquivalenceError> {
        let Output { want, bits, .. } = *output;
        let (name, width) = (want.name, u32::try_from(bits.len()).unwrap_or(u32::MAX));
        let asked = self.asked;
        let design = |what: &str| asked.design(format!("{name}: {what}"));
        let got = self.words.joined(bits, &mut self.algebra).map_err(|what| design(&what))?;
        if let (Some(here), Some(there)) = (&self.way, &got.way)
            && here != there
        {
            return Err(design(
                "it comes behind other registers than the words before it, or their enables differ",
            ));
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

    /// Whether the words come as late as the map says.
    fn has_latency(&self) -> Result<(), String> {
        let latency = self.asked.map.latency;
        let stages = self.way.as_ref().map_or(0, Vec::len);
        if self.words.enabled && latency > 0 {
            return Err(
                "latency: registers load by enables, so no number of clocks is told: leave it out"
                    .to_owned(),
            );
        }
        if !self.words.enabled && stages != latency as usize {
            return Err(format!("latency = {latency}, and the words come {stages} clocks late"));
        }
        Ok(())
    }

    fn assumed(&self, outputs: &[Output<'_>]) -> Vec<String> {
        let (low, high) = self.asked.profile.vertex.range();
        let mut list = vec![format!("each coordinate is in {low} to {high}, the profile's field")];
        if let Some(way) = self.way.as_ref().filter(|way| !way.is_empty()) {
            let stages =
                if way.len() == 1 { "1 stage".to_owned() } else { format!("{} stages", way.len()) };
            let registers = self.words.registers.len();
            list.push(format!(
                "no reset while a record is in the {registers} registers on its way, {stages}"
            ));
            if self.words.enabled {
                list.push(
                    "words are looked at when these registers hold one record: valid and ready are not proved"
                        .to_owned(),
                );
            }
        }
        if outputs.iter().any(|output| !matches!(output.want.range, Range::Word(_))) {
            list.push(
                "area and plane numerators are looked at where the area is not zero".to_owned(),
            );
        }
        list
    }
}
