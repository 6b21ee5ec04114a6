//! The engine `slopes` as a text. Spec clauses `RG-11` to `RG-14`.

use super::engine::{EngineText, Port, pixel};
use crate::format::Layout;
use crate::machine::WiredDevice;
use crate::value::{Channel, Extension};
use crate::vector::package::device_name;
use crate::vector::reference::stimulus::register::{self, Registers};

/// Registers that a machine may lack, and the flag of those that have one.
const OPTIONAL: [(&str, &str); 3] = [("clip", "clips"), ("adjust", "adjust"), ("flip", "flip")];

pub(super) struct Slopes {
    device: WiredDevice,
    channels: Vec<Channel>,
    /// Bits of x below its pixel.
    fraction: u32,
    /// The register of the direction, and what it holds for rows to the left.
    direction: (&'static str, bool),
    /// The registers of [`OPTIONAL`] that there are.
    optional: Vec<(&'static str, &'static str)>,
}

impl Slopes {
    pub(super) fn new(device: WiredDevice, channels: Vec<Channel>, input: &Layout) -> Self {
        let direction = match input.find("leftward") {
            Some(_) => ("leftward", true),
            None => ("rightward", false),
        };
        let has = |(name, _): &(&str, &str)| input.find(name).is_some();
        let optional = OPTIONAL.into_iter().filter(has).collect();
        let fraction = u32::try_from(device.fact("FRACTION")).unwrap_or(0);
        Self { device, channels, fraction, direction, optional }
    }

    fn is_given(&self) -> bool {
        self.device.fact("DOWN") != 0
    }

    fn has_depth(&self) -> bool {
        self.device.fact("DEPTH") != 0
    }
}

impl EngineText for Slopes {
    fn device(&self) -> &'static str {
        device_name(self.device.engine)
    }

    fn templates(&self) -> [&'static str; 2] {
        [include_str!("../slopes.c.in"), include_str!("../slopes.py.in")]
    }

    fn flags(&self) -> Vec<&'static str> {
        let mut flags = vec!["slopes", "scaled"];
        flags.extend(self.optional.iter().map(|(_, flag)| *flag));
        flags.extend(self.is_given().then_some("given"));
        flags.extend((self.device.fact("PART") != 0).then_some("at_edge"));
        flags.extend(self.has_depth().then_some("w_depth"));
        flags
    }

    fn keys(&self, c: bool) -> Vec<(&'static str, String)> {
        let [open, close] = if c { ['{', '}'] } else { ['(', ')'] };
        let shape = |channel: &Channel| {
            let Channel { width, shift, shift_along, drop, .. } = channel;
            format!("{open}{width}, {shift}, {shift_along}, {drop}{close}")
        };
        let mut shapes = self.channels.iter().map(shape).collect::<Vec<_>>().join(", ");
        shapes += if c { "" } else { "," };
        let left = match (self.direction.1, c) {
            (true, _) => "!= 0",
            (false, _) => "== 0",
        };
        let names = [
            ("SHAPES", shapes),
            ("IS_LEFTWARD", left.to_owned()),
            ("SAYS_LEFT", u8::from(self.direction.1).to_string()),
        ];
        let facts = ["ROW_BIAS", "PIXEL_BIAS", "DOWN", "PART", "CLOSED", "INTEGER_AT", "W_AT"];
        let facts = facts.map(|name| (name, self.device.fact(name).to_string()));
        names.into_iter().chain(facts).chain([("FRACTION", self.fraction.to_string())]).collect()
    }

    fn ports(&self) -> Vec<Port> {
        let mut ports = Vec::new();
        if self.is_given() {
            ports.extend(["x", "y", "x_step"].map(Port::signed));
            for (n, part) in ["01", "12"].into_iter().enumerate() {
                ports.push(Port::entry(format!("end{part}"), "end", n, true));
                ports.push(Port::entry(format!("end{part}_step"), "end_step", n, true));
                ports.push(Port::entry(format!("rows{part}"), "rows", n, false));
            }
        } else {
            let vertices = Port::vertices(true)
                .into_iter()
                .zip(["a", "b", "c"].into_iter().flat_map(|n| [n; 2]));
            ports.extend(
                vertices.map(|(port, n)| Port { name: format!("{}{n}", &port.name[..1]), ..port }),
            );
        }
        let toward = Port::plain("toward");
        ports.push(Port { name: self.direction.0.to_owned(), ..toward });
        ports.extend(["clip_left", "clip_right", "clip_top", "clip_bottom"].map(Port::plain));
        ports.extend(self.optional.iter().map(|(name, _)| Port::plain(name)));
        if self.optional.iter().any(|(name, _)| *name == "flip") {
            ports.push(Port::plain("height"));
        }
        if self.has_depth() {
            ports.extend(["w_buffer", "depth_biased"].map(Port::plain));
            ports.push(Port::signed("depth_bias"));
        }
        for (n, channel) in self.channels.iter().enumerate() {
            let is_signed = channel.start == Extension::Sign;
            ports.push(Port::entry(channel.name.clone(), "start", n, is_signed));
            ports.push(Port::entry(format!("{}_dx", channel.name), "dx", n, true));
            ports.push(Port::entry(format!("{}_dy", channel.name), "dy", n, true));
        }
        ports
    }

    fn values(&self, _: usize) -> Vec<(String, String)> {
        let channel = |c: usize| (format!("value[{c}]"), format!("value[{c}]"));
        let own = ["w_float", "depth"].map(|name| (name.to_owned(), name.to_owned()));
        let own = own.into_iter().filter(|_| self.has_depth());
        pixel().into_iter().chain((0..self.channels.len()).map(channel)).chain(own).collect()
    }

    fn registers(&self) -> Box<dyn Registers + '_> {
        Box::new(register::Slopes {
            fraction: self.fraction,
            bias: self.device.fact("PIXEL_BIAS"),
            down: self.is_given().then(|| self.device.fact("DOWN")),
            direction: self.direction,
            channels: self.channels.iter().map(|channel| &*channel.name).collect(),
        })
    }
}
