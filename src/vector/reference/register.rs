//! References of machines that begin at registers: in C, C++ and Python.

mod language;

use super::choose::choose;

use super::{CASES, Language, stimulus};
use crate::bits::Rounding;
use crate::format::{Clamp, Layout};
use crate::machine::{Record, RegisterDevice, WiredDevice, WiredEngine};
use crate::model::{MODEL_VERSION, Model};
use crate::profile::Profile;
use crate::value::Channel;
use crate::vector::bench::ready;
use crate::vector::manifest::sha256;
use crate::vector::package::{comment, device_name, fill};

/// What a text of registers is written of.
pub(super) struct RegisterText<'a> {
    profile: &'a Profile,
    model: Model,
    device: WiredDevice,
    rounding: Rounding,
    clamp: Clamp,
    channels: Vec<Channel>,
}

/// A register of a text: its name in the profile, what it is in C and in Python.
struct Port {
    name: String,
    c: String,
    python: String,
    signed: bool,
}

impl<'a> RegisterText<'a> {
    /// The text of a profile; `None` where it has no registers.
    pub(super) fn of(profile: &'a Profile) -> Result<Option<Self>, String> {
        let model = ready(profile, true);
        if model.registers().is_none() {
            return Ok(None);
        }
        let refused = || format!("the machine is {}", profile.form.engine());
        let device = match profile.form.register_device() {
            Some(RegisterDevice::Wired(device)) if device.engine == WiredEngine::Anchored => device,
            _ => return Err(refused()),
        };
        let rounding = device.rounding.ok_or_else(refused)?;
        let channels = profile.form.channels().iter().map(crate::value::ChannelConfig::channels);
        let channels: Vec<Channel> =
            channels.collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?.concat();
        let clamp = channels.first().map_or(Clamp::Wrap, |channel| channel.read.clamp());
        if channels.is_empty() || channels.iter().any(|channel| channel.read.clamp() != clamp) {
            return Err(format!("{}, with no channels or with several clamps", refused()));
        }
        Ok(Some(Self { profile, model, device, rounding, clamp, channels }))
    }

    /// The digest of random registers.
    pub(super) fn digest(&self, seed: u64, cases: u64) -> u64 {
        let largest = ["LARGEST_X", "LARGEST_Y"].map(|name| self.value(name));
        stimulus::register::digest(
            self.profile,
            &self.model,
            (&self.channels, largest),
            seed,
            cases,
        )
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
                device_name(self.device.engine)
            )),
        }
    }

    fn input(&self) -> &Layout {
        let registers = self.model.registers();
        &registers.unwrap_or_else(|| unreachable!("it begins at registers")).input
    }

    fn record(&self) -> &Record {
        let records = self.model.registers().and_then(|registers| registers.records.first());
        records.unwrap_or_else(|| unreachable!("a valid profile has records"))
    }

    /// A parameter of the device.
    fn value(&self, name: &str) -> i128 {
        self.device.values.iter().find(|(known, _)| *known == name).map_or(0, |(_, value)| *value)
    }

    /// The registers that the engine reads.
    fn ports(&self) -> Vec<Port> {
        let mut ports = Vec::new();
        for n in 0..3 {
            for (axis, name) in ["x", "y"].into_iter().enumerate() {
                ports.push(Port {
                    name: format!("{name}{n}"),
                    c: format!("r.v[{n}].{name}"),
                    python: format!("self.v[{n}][{axis}]"),
                    signed: self.profile.vertex.signed,
                });
            }
        }
        for (c, channel) in self.channels.iter().enumerate() {
            ports.extend((0..3).map(|n| Port {
                name: format!("{}{n}", channel.name),
                c: format!("r.value[{c}][{n}]"),
                python: format!("self.value[{c}][{n}]"),
                signed: false,
            }));
        }
        ports.extend(["left", "top", "right", "bottom"].map(|name| Port {
            name: name.to_owned(),
            c: format!("r.{name}"),
            python: format!("self.{name}"),
            signed: false,
        }));
        ports
    }

    /// The values of a record, as C and Python have them.
    fn values(&self) -> Vec<(String, String)> {
        let channel = |c: usize| (format!("value[{c}]"), format!("value[{c}]"));
        let pixel = ["x", "y"].map(|name| (format!("(uint64_t){name}"), name.to_owned()));
        pixel.into_iter().chain((0..self.channels.len()).map(channel)).collect()
    }

    fn fill(&self, template: &str, parts: [&str; 3], own: &[(&str, &str)]) -> String {
        let [engine, random, quotient] = parts;
        let template = template.replace("@ENGINE@\n", engine).replace("@RANDOM@\n", random);
        let mut flags = vec!["anchored", "rich"];
        flags.extend((self.clamp != Clamp::Wrap).then_some("clamped"));
        for (flag, name) in [("first_match", "FIRST_MATCH"), ("sorted", "SORTED")] {
            flags.extend((self.value(name) != 0).then_some(flag));
        }
        let (low, high) = self.profile.vertex.range();
        let (window, input, record) = (&self.profile.window, self.input(), self.record());
        let names: Vec<&str> = self.channels.iter().map(|channel| &*channel.name).collect();
        let records = record.layout.word_names();
        let quotient = fill(
            quotient,
            &[
                ("NAME", "divide"),
                ("CLAUSE", "RG-10"),
                ("OWN_ROUNDING", &self.rounding.to_string()),
            ],
        );
        let sort = if self.value("FIRST_MATCH") != 0 {
            "the first order of a list in which y does not fall"
        } else {
            "those of the same y stay as they came"
        };
        let shared = [
            ("DIVIDES", quotient.trim_end_matches('\n').to_owned()),
            ("SORT", sort.to_owned()),
            ("SET", comment(&self.profile.name)),
            ("GUARDBIT", env!("CARGO_PKG_VERSION").to_owned()),
            ("VERSION", MODEL_VERSION.to_string()),
            ("DIGEST", sha256(self.profile.to_toml().as_bytes())),
            ("CLAMP", self.clamp.name().to_owned()),
            ("COUNT", input.len().to_string()),
            ("LENGTH", record.layout.len().to_string()),
            ("WORD_NAMES", comment(&input.word_names().join(" "))),
            ("RECORD_NAMES", comment(&records.join(" "))),
            ("CHANNEL_NAMES", names.join(" ")),
            ("CHANNELS", names.len().to_string()),
            ("WIDTH", window.width.to_string()),
            ("HEIGHT", window.height.to_string()),
            ("S", self.profile.vertex.sub_pixel.to_string()),
            ("LOW", low.to_string()),
            ("HIGH", high.to_string()),
            ("LARGEST_X", self.value("LARGEST_X").to_string()),
            ("LARGEST_Y", self.value("LARGEST_Y").to_string()),
            ("CASES", CASES.to_string()),
        ];
        let shared = shared.iter().map(|(key, value)| (*key, value.as_str()));
        // The quotient has keys of its own, and so has what is filled in.
        let values = shared.clone().take(1).chain(own.iter().copied()).chain(shared.skip(1));
        fill(&choose(&template, &flags), &values.collect::<Vec<_>>())
    }

    /// Guard, integer and interpolation bits of the channels between these brackets.
    fn formats(&self, open: char, close: char) -> String {
        let one = |channel: &Channel| {
            let read = channel.read;
            format!("{open}{}, {}, {}{close}", read.guard(), read.integer(), read.fraction())
        };
        self.channels.iter().map(one).collect::<Vec<_>>().join(", ")
    }
}
