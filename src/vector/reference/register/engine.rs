//! What the text of an engine has of its own.

use crate::vector::reference::stimulus::register::Registers;

/// An engine as a text has it.
pub(super) trait EngineText {
    /// The module in `hdl` that draws as it does.
    fn device(&self) -> &'static str;

    /// Its part of the text, in C and in Python.
    fn templates(&self) -> [&'static str; 2];

    /// The flags of its lines.
    fn flags(&self) -> Vec<&'static str>;

    /// What is filled in, in C or in Python.
    fn keys(&self, c: bool) -> Vec<(&'static str, String)>;

    /// The registers that it reads.
    fn ports(&self) -> Vec<Port>;

    /// The values of a record of a kind, as C and Python have them.
    fn values(&self, kind: usize) -> Vec<(String, String)>;

    /// What the self test writes into its registers.
    fn registers(&self) -> Box<dyn Registers + '_>;
}

/// A register of a text: its name in the profile, what it is in C and in Python.
pub(super) struct Port {
    pub(super) name: String,
    pub(super) c: String,
    pub(super) python: String,
    pub(super) signed: bool,
}

impl Port {
    /// A number without a sign.
    pub(super) fn plain(name: &str) -> Self {
        let (c, python) = (format!("r.{name}"), format!("self.{name}"));
        Self { name: name.to_owned(), c, python, signed: false }
    }

    /// Entry `n` of a list.
    pub(super) fn entry(name: String, list: &str, n: usize, signed: bool) -> Self {
        let (c, python) = (format!("r.{list}[{n}]"), format!("self.{list}[{n}]"));
        Self { name, c, python, signed }
    }

    /// A number with a sign.
    pub(super) fn signed(name: &str) -> Self {
        Self { signed: true, ..Self::plain(name) }
    }

    /// The three vertices.
    pub(super) fn vertices(signed: bool) -> Vec<Self> {
        let mut ports = Vec::new();
        for n in 0..3 {
            for (axis, name) in ["x", "y"].into_iter().enumerate() {
                ports.push(Self {
                    name: format!("{name}{n}"),
                    c: format!("r.v[{n}].{name}"),
                    python: format!("self.v[{n}][{axis}]"),
                    signed,
                });
            }
        }
        ports
    }
}

/// The x and y of a record.
pub(super) fn pixel() -> [(String, String); 2] {
    ["x", "y"].map(|name| (format!("(uint64_t){name}"), name.to_owned()))
}
