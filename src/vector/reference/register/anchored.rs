//! The engine `anchored` as a text. Spec clauses `RG-8` to `RG-10`.

use super::engine::{EngineText, Port, pixel};
use crate::machine::WiredDevice;
use crate::value::Channel;
use crate::vector::package::device_name;
use crate::vector::reference::stimulus::register::{self, Registers};

pub(super) struct Anchored {
    pub(super) device: WiredDevice,
    pub(super) channels: Vec<Channel>,
    /// Whether vertices have a sign.
    pub(super) signed: bool,
}

impl EngineText for Anchored {
    fn device(&self) -> &'static str {
        device_name(self.device.engine)
    }

    fn templates(&self) -> [&'static str; 2] {
        [include_str!("../anchored.c.in"), include_str!("../anchored.py.in")]
    }

    fn flags(&self) -> Vec<&'static str> {
        let mut flags = vec!["anchored"];
        for (flag, name) in [("first_match", "FIRST_MATCH"), ("sorted", "SORTED")] {
            flags.extend((self.device.value(name) != 0).then_some(flag));
        }
        flags
    }

    fn keys(&self, c: bool) -> Vec<(&'static str, String)> {
        let sort = if self.device.value("FIRST_MATCH") != 0 {
            "the first order of a list in which y does not fall"
        } else {
            "those of the same y stay as they came"
        };
        let lower_first = match (self.device.value("UPPER_FIRST") != 0, c) {
            (true, true) => "0",
            (true, false) => "False",
            (false, _) => "anchor > 0",
        };
        vec![
            ("SORT", sort.to_owned()),
            ("LOWER_FIRST", lower_first.to_owned()),
            ("LARGEST_X", self.device.value("LARGEST_X").to_string()),
            ("LARGEST_Y", self.device.value("LARGEST_Y").to_string()),
        ]
    }

    fn ports(&self) -> Vec<Port> {
        let mut ports = Port::vertices(self.signed);
        for (c, channel) in self.channels.iter().enumerate() {
            ports.extend((0..3).map(|n| Port {
                name: format!("{}{n}", channel.name),
                c: format!("r.value[{c}][{n}]"),
                python: format!("self.value[{c}][{n}]"),
                signed: false,
            }));
        }
        ports.extend(["left", "top", "right", "bottom"].map(Port::plain));
        ports
    }

    fn values(&self, _: usize) -> Vec<(String, String)> {
        let channel = |c: usize| (format!("value[{c}]"), format!("value[{c}]"));
        pixel().into_iter().chain((0..self.channels.len()).map(channel)).collect()
    }

    fn registers(&self) -> Box<dyn Registers + '_> {
        let largest = ["LARGEST_X", "LARGEST_Y"].map(|name| self.device.value(name));
        Box::new(register::Anchored { channels: &self.channels, largest })
    }
}
