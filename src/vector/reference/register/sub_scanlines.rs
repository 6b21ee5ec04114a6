//! The engine `sub-scanlines` as a text. Spec clauses `RG-15` to `RG-19`.

use super::engine::{EngineText, Port};
use crate::machine::WiredDevice;
use crate::value::Channel;
use crate::vector::package::device_name;
use crate::vector::reference::stimulus::register::{self, Registers};

pub(super) struct SubScanlines {
    pub(super) device: WiredDevice,
    pub(super) channels: Vec<Channel>,
}

impl EngineText for SubScanlines {
    fn device(&self) -> &'static str {
        device_name(self.device.engine)
    }

    fn templates(&self) -> [&'static str; 2] {
        [include_str!("../sub-scanlines.c.in"), include_str!("../sub-scanlines.py.in")]
    }

    fn flags(&self) -> Vec<&'static str> {
        let mut flags = vec!["scaled", "kinds"];
        for (flag, name) in [
            ("resize", "RESIZE"),
            ("signed_distance", "SIGNED_DISTANCE"),
            ("long_sign", "LONG_SIGN"),
        ] {
            flags.extend((self.device.value(name) != 0).then_some(flag));
        }
        flags
    }

    fn keys(&self, c: bool) -> Vec<(&'static str, String)> {
        let [open, close] = if c { ['{', '}'] } else { ['(', ')'] };
        let shape =
            |channel: &Channel| format!("{open}{}, {}{close}", channel.drop, channel.correction);
        let mut shapes = self.channels.iter().map(shape).collect::<Vec<_>>().join(", ");
        shapes += if c { "" } else { "," };
        vec![("SHAPES", shapes), ("DEPTH_AT", self.device.fact("DEPTH_AT").to_string())]
    }

    fn ports(&self) -> Vec<Port> {
        let listed = |name: String, list: &str, n: usize| Port::entry(name, list, n, true);
        let mut ports = vec![Port::plain("rightward")];
        ports.extend(["yh", "ym", "yl"].map(Port::signed));
        for (n, name) in ["xh", "xm", "xl"].into_iter().enumerate() {
            ports.push(listed(name.to_owned(), "x", n));
            ports.push(listed(format!("{name}_step"), "x_step", n));
        }
        ports.extend((self.device.value("LONG_SIGN") != 0).then(|| Port::plain("long_sign")));
        let scissor = ["scissor_xh", "scissor_yh", "scissor_xl", "scissor_yl"];
        ports.extend(scissor.map(Port::plain));
        for (n, channel) in self.channels.iter().enumerate() {
            ports.push(listed(channel.name.clone(), "start", n));
            for slope in ["dx", "de", "dy"] {
                ports.push(listed(format!("{}_{slope}", channel.name), slope, n));
            }
        }
        ports
    }

    fn values(&self, kind: usize) -> Vec<(String, String)> {
        let own: &[&str] = if kind == 0 {
            &["y", "last", "first", "edge_x"]
        } else {
            &["x", "y", "coverage", "slope_code", "depth_code"]
        };
        let mut values: Vec<String> = own.iter().map(|name| (*name).to_owned()).collect();
        values.extend((0..self.channels.len()).map(|c| format!("value[{c}]")));
        for list in ["long_x", "short_x", "invalid"].into_iter().filter(|_| kind == 0) {
            values.extend((0..4).map(|n| format!("{list}[{n}]")));
        }
        values.into_iter().map(|value| (format!("(uint64_t){value}"), value)).collect()
    }

    fn registers(&self) -> Box<dyn Registers + '_> {
        let channels = self.channels.iter().map(|channel| &*channel.name).collect();
        Box::new(register::SubScanlines { channels })
    }
}
