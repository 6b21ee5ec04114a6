//! References of machines that begin at registers: in C, C++ and Python.

mod anchored;
mod engine;
mod language;
mod quads;
mod slopes;
mod sub_scanlines;

use super::choose::choose;

use super::{CASES, Language, stimulus};
use crate::bits::Rounding;
use crate::format::{Clamp, Layout};
use crate::machine::{Record, RegisterDevice, WiredEngine};
use crate::model::{MODEL_VERSION, Model};
use crate::profile::Profile;
use crate::value::Channel;
use crate::vector::bench::ready;
use crate::vector::device::grid;
use crate::vector::manifest::sha256;
use crate::vector::package::{comment, fill};
use anchored::Anchored;
use engine::EngineText;
use quads::Quads;
use slopes::Slopes;
use sub_scanlines::SubScanlines;

/// What a text of registers is written of.
pub(super) struct RegisterText<'a> {
    profile: &'a Profile,
    model: Model,
    engine: Box<dyn EngineText>,
    rounding: Option<Rounding>,
    /// The clamps that there are.
    clamps: Vec<Clamp>,
    channels: Vec<Channel>,
}

impl<'a> RegisterText<'a> {
    /// The text of a profile; `None` where it has no registers.
    pub(super) fn of(profile: &'a Profile) -> Result<Option<Self>, String> {
        let model = ready(profile, true);
        let Some(registers) = model.registers() else { return Ok(None) };
        let refused = || format!("the machine is {}", profile.form.engine());
        let mut parts = profile.form.channels().iter();
        if let Some(part) = parts.find_map(crate::value::ChannelConfig::beyond_plain) {
            return Err(format!("{}, with {part} of a channel", refused()));
        }
        let channels = profile.form.channels().iter().map(crate::value::ChannelConfig::channels);
        let channels: Vec<Channel> =
            channels.collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?.concat();
        let mut clamps: Vec<Clamp> = Vec::new();
        for channel in &channels {
            if !clamps.contains(&channel.read.clamp()) {
                clamps.push(channel.read.clamp());
            }
        }
        let signed = profile.vertex.signed;
        let mut rounding = None;
        let engine: Box<dyn EngineText> = match profile.form.register_device() {
            Some(RegisterDevice::Quads(device)) => Box::new(Quads::given(device)),
            Some(RegisterDevice::Wired(device)) => match device.engine {
                WiredEngine::VertexQuads => {
                    let sample = grid(&model).offset;
                    Box::new(Quads::of_vertices(&device, &registers.input, (signed, sample)))
                }
                WiredEngine::Anchored => {
                    rounding = Some(device.rounding.ok_or_else(refused)?);
                    if clamps.len() != 1 {
                        let why = "with no channels or with several clamps";
                        return Err(format!("{}, {why}", refused()));
                    }
                    Box::new(Anchored { device, channels: channels.clone(), signed })
                }
                WiredEngine::DividedSlopes | WiredEngine::GivenSlopes => {
                    if channels.is_empty() {
                        return Err(format!("{}, with no channels", refused()));
                    }
                    Box::new(Slopes::new(device, channels.clone(), &registers.input))
                }
                WiredEngine::SubScanlines => {
                    Box::new(SubScanlines { device, channels: channels.clone() })
                }
            },
            None => return Err(refused()),
        };
        Ok(Some(Self { profile, model, engine, rounding, clamps, channels }))
    }

    /// The digest of random registers.
    pub(super) fn digest(&self, seed: u64, cases: u64) -> u64 {
        let registers = self.engine.registers();
        stimulus::register::digest(self.profile, &self.model, &*registers, seed, cases)
    }

    /// The text in a language, or why there is none.
    pub(super) fn text(&self, language: Language) -> Result<String, String> {
        match language {
            Language::C | Language::Cpp => Ok(self.c(language == Language::Cpp)),
            Language::Python => Ok(self.python()),
            Language::Sv => Err(format!(
                "the machine is {}: there are no SystemVerilog functions of it, but {}.sv in hdl is its engine \
                 in synthesizable SystemVerilog",
                self.profile.form.engine(),
                self.engine.device()
            )),
        }
    }

    fn input(&self) -> &Layout {
        let registers = self.model.registers();
        &registers.unwrap_or_else(|| unreachable!("it begins at registers")).input
    }

    /// The kinds of records.
    fn records(&self) -> &[Record] {
        self.model.registers().map_or(&[], |registers| &registers.records)
    }

    /// Words of a record of each kind; where there are several, the kind is a word before the others.
    fn lengths(&self) -> Vec<usize> {
        let kind = usize::from(self.records().len() > 1);
        self.records().iter().map(|record| kind + record.layout.len()).collect()
    }

    /// What a record consists of.
    fn record_names(&self) -> String {
        let names: Vec<String> =
            self.records().iter().map(|record| record.layout.word_names().join(" ")).collect();
        let [names] = &*names else { return format!("its kind, and 0: {}", names.join("; 1: ")) };
        names.clone()
    }

    fn fill(&self, template: &str, parts: [&str; 3], own: &[(&str, &str)]) -> String {
        let [engine, random, quotient] = parts;
        let template = template.replace("@ENGINE@\n", engine).replace("@RANDOM@\n", random);
        let mut flags = self.engine.flags();
        flags.extend(["rich", "registers"]);
        flags.extend((self.clamps != [Clamp::Wrap]).then_some("clamped"));
        flags.extend((self.clamps.len() > 1).then_some("mixed"));
        flags.extend((!self.channels.is_empty()).then_some("channels"));
        let (low, high) = self.profile.vertex.range();
        let (window, input) = (&self.profile.window, self.input());
        let lengths = self.lengths();
        let names: Vec<&str> = self.channels.iter().map(|channel| &*channel.name).collect();
        let quotient = fill(
            quotient,
            &[
                ("NAME", "divide"),
                ("CLAUSE", "RG-10"),
                (
                    "OWN_ROUNDING",
                    &self.rounding.map_or_else(String::new, |rounding| rounding.to_string()),
                ),
            ],
        );
        let shared = [
            ("DIVIDES", quotient.trim_end_matches('\n').to_owned()),
            ("SET", comment(&self.profile.name)),
            ("GUARDBIT", env!("CARGO_PKG_VERSION").to_owned()),
            ("VERSION", MODEL_VERSION.to_string()),
            ("DIGEST", sha256(self.profile.to_toml().as_bytes())),
            (
                "CLAMP",
                self.clamps.iter().map(|clamp| clamp.name()).collect::<Vec<_>>().join(" or "),
            ),
            ("COLUMNS", if self.clamps.len() > 1 { "4" } else { "3" }.to_owned()),
            ("COUNT", input.len().to_string()),
            ("LENGTH", lengths.iter().max().map_or(0, |length| *length).to_string()),
            ("LENGTHS", lengths.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
            ("WORD_NAMES", comment(&input.word_names().join(" "))),
            ("RECORD_NAMES", comment(&self.record_names())),
            ("CHANNEL_NAMES", names.join(" ")),
            ("CHANNELS", names.len().to_string()),
            ("WIDTH", window.width.to_string()),
            ("HEIGHT", window.height.to_string()),
            ("S", self.profile.vertex.sub_pixel.to_string()),
            ("LOW", low.to_string()),
            ("HIGH", high.to_string()),
            ("CASES", CASES.to_string()),
        ];
        let shared = shared.iter().map(|(key, value)| (*key, value.as_str()));
        // The quotient has keys of its own, and so has what is filled in.
        let values = shared.clone().take(1).chain(own.iter().copied()).chain(shared.skip(1));
        fill(&choose(&template, &flags), &values.collect::<Vec<_>>())
    }

    /// Guard, integer and interpolation bits of the channels between these brackets, and the number of the clamp
    /// where there are several.
    fn formats(&self, open: char, close: char) -> String {
        let one = |channel: &Channel| {
            let read = channel.read;
            let several = self.clamps.len() > 1;
            let clamp = if several { format!(", {}", read.clamp().code()) } else { String::new() };
            let (guard, integer, fraction) = (read.guard(), read.integer(), read.fraction());
            format!("{open}{guard}, {integer}, {fraction}{clamp}{close}")
        };
        self.channels.iter().map(one).collect::<Vec<_>>().join(", ")
    }
}
