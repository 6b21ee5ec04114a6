//! The entity that checks a device behind streams.

use super::{Answer, Stream};
use crate::format::Role;
use crate::vector::package::record::Field;
use crate::vector::package::template::fill;

const ORDER_HELP: &str =
    "-- With ANY_ORDER the rows of a test come in any order, each matched by its key.
";

const NOISE: &str =
    "            noise := noise(14 downto 0) & (noise(15) xor noise(13) xor noise(12) xor noise(10));
";

const FIND: &str = "if ANY_ORDER then
                    @ANSWER@find;
                els";

const COMPLETE_ANY: &str = "not @ANSWER@ahead and @ANSWER@open = null";

const MISSING: &str = "                    if @ANSWER@open /= null then
                        mismatch(\"(@STEM@.tv line \" & decimal(@ANSWER@open.number)
                            & \"): this row and maybe others of the tests so far are missing\");
                    end if;
";

const VARIABLES: &str = "        file @ANSWER@file, @ANSWER@dump : text;
        variable @ANSWER@line : count_t := (others => '0');
        variable @ANSWER@bits : std_logic_vector(@EXP@_BITS - 1 downto 0);
        variable @ANSWER@want : @EXP_ID@_t;
        variable @ANSWER@held : boolean := false;
        variable @ANSWER@kept : std_logic_vector(@NOW_TOP@ downto 0);
";

const LIST: &str = "        -- Rows of tests that have begun and that no answer has matched yet, each with its line.
        type @ANSWER@node;
        type @ANSWER@link is access @ANSWER@node;
        type @ANSWER@node is record
            number    : count_t;
            bits      : std_logic_vector(@EXP@_BITS - 1 downto 0);
            following : @ANSWER@link;
        end record @ANSWER@node;
        variable @ANSWER@open, @ANSWER@last : @ANSWER@link;
        variable @ANSWER@ahead : boolean := false;  -- @ANSWER@bits is of a later test, and not among them
";

const OPEN: &str = "        open_file(@ANSWER@file, \"@STEM@.tv\");
        if DUMP then
            file_open(@ANSWER@dump, \"@STEM@.dut.tv\", write_mode);
        end if;
";

const WATCH: &str = "            if rst = '1' then
                @ANSWER@held := false;
            else
                @ANSWER@watch;
            end if;
";

const READY: &str = "            @ANSWER@ready <= '0' when stalls or cutting else '1';
";

/// A word as it stands in a port: that of a flag is a single wire.
fn port(field: &Field, name: &str) -> String {
    let flag = field.column.name == Role::ZERO_AREA.name(0);
    name.to_owned() + if flag { "(0)" } else { "" }
}

/// A signal of each name.
fn signal(field: &Field, name: &str) -> String {
    format!("    signal {name} : std_logic_vector({} downto 0);\n", field.column.width - 1)
}

impl Answer<'_> {
    /// What its ports carry, one beside the other.
    fn now(&self) -> (String, u32) {
        let names: Vec<String> =
            self.ports().map(|field| format!("{}{}", self.prefix, field.id)).collect();
        (names.join(" & "), self.ports().map(|field| field.column.width).sum())
    }

    /// A row of a dump. What has no port is written as zeros, and a mask tells it.
    fn words(&self) -> String {
        let words = self.fields.iter().map(|(field, port)| {
            if *port {
                format!("to_hstring({}{})", self.prefix, field.id)
            } else {
                format!("\"{}\"", "0".repeat(field.column.digits()))
            }
        });
        let words = words.collect::<Vec<_>>().join(" & \"_\" & ");
        if self.fields.iter().all(|(_, port)| *port) {
            return words;
        }
        let masks = self.fields.iter();
        let masks = masks.map(|(f, port)| if *port { "0" } else { "f" }.repeat(f.column.digits()));
        format!("{words} & \"_{}\"", masks.collect::<String>())
    }

    fn procedures(&self) -> String {
        let (now, bits) = self.now();
        let stem = self.exp.file.name.trim_end_matches(".tv");
        let compare = self.ports().map(|field| {
            let (prefix, id, name) = (self.prefix, &field.id, &field.column.name);
            format!(
                "            compare(\"{stem}.tv\", number, \"{name}\", {prefix}want.{id}, {prefix}{id});\n"
            )
        });
        let text = fill(
            include_str!("../tb.answer.vhd.in"),
            &[
                ("COMPARE", &compare.collect::<String>()),
                ("ANY_ORDER", &self.search()),
                ("NOW", &now),
                ("NOW_TOP", &(bits - 1).to_string()),
                ("WORDS", &self.words()),
                ("FIND", &self.keyed(FIND)),
                ("EXP_SHAPE", self.exp.shape().trim_end()),
            ],
        );
        self.fill(&text)
    }

    /// The procedure that finds the row of an answer's key.
    fn search(&self) -> String {
        let key: Vec<&str> =
            self.fields[..self.key].iter().map(|(field, _)| field.id.as_str()).collect();
        let Some(test) = key.first() else { return String::new() };
        let list = |between: &str, text: &dyn Fn(&str) -> String| {
            key.iter().map(|id| text(id)).collect::<Vec<_>>().join(between)
        };
        let prefix = self.prefix;
        let said = |id: &str| format!("{id} \" & decimal(unsigned({prefix}{id}))");
        let text = fill(
            include_str!("../tb.any.vhd.in"),
            &[
                ("SAME_KEY", &list(" and ", &|id| format!("{prefix}{id} = {prefix}want.{id}"))),
                ("KEY", &list(" & \", ", &said)),
                ("TEST", test),
            ],
        );
        self.fill(&text)
    }

    fn variables(&self) -> String {
        let top = (self.now().1 - 1).to_string();
        self.fill(&fill(VARIABLES, &[("NOW_TOP", &top)])) + &self.keyed(LIST)
    }

    fn signals(&self) -> String {
        let wires =
            self.ports().map(|field| signal(field, &format!("{}{}", self.prefix, field.id)));
        let hands = format!(
            "    signal {0}valid : std_logic;\n    signal {0}ready : std_logic := '0';\n",
            self.prefix
        );
        wires.collect::<String>() + &hands
    }

    fn ports_of_vhdl(&self) -> Vec<String> {
        let words = self.ports().map(|field| {
            let name = format!("{}{}", self.prefix, field.id);
            format!("{name} => {}", port(field, &name))
        });
        let hands =
            ["valid", "ready"].map(|id| format!("{} => {}{id}", self.port(id), self.prefix));
        words.chain(hands).collect()
    }

    fn complete(&self) -> String {
        let any = if self.key > 0 { format!(" and {COMPLETE_ANY}") } else { String::new() };
        self.fill(&format!("@ANSWER@line >= @EXP@_ROWS{any}"))
    }
}

impl Stream<'_> {
    /// Whether its answers may come in any order.
    pub(in crate::vector::package) fn keyed(&self) -> bool {
        self.answers.iter().any(|answer| answer.key > 0)
    }

    /// The entity that checks this device.
    pub(in crate::vector::package) fn vhdl(&self) -> String {
        let each =
            |text: &dyn Fn(&Answer) -> String| self.answers.iter().map(text).collect::<String>();
        let fields =
            |text: &dyn Fn(&Field) -> String| self.cfg.fields.iter().map(text).collect::<String>();
        let all = |between: &str, text: &dyn Fn(&Answer) -> String| {
            self.answers.iter().map(text).collect::<Vec<_>>().join(between)
        };
        let inputs = self
            .cfg
            .fields
            .iter()
            .map(|field| format!("{} => {}", field.id, port(field, &field.id)));
        let outputs = self.answers.iter().flat_map(Answer::ports_of_vhdl);
        let ports: Vec<String> =
            inputs.chain(outputs).map(|port| format!("            {port}")).collect();
        let inverted = |fields: &mut dyn Iterator<Item = &Field>| {
            let line =
                |field: &Field| format!("                    cfg.{0} := not cfg.{0};\n", field.id);
            fields.map(line).collect::<Vec<_>>().concat()
        };
        let text = fill(
            include_str!("../tb.stream.vhd.in"),
            &[
                ("ORDER_HELP", if self.keyed() { ORDER_HELP } else { "" }),
                (
                    "GENERICS",
                    if self.keyed() { "DUMP, ANY_ORDER : boolean" } else { "DUMP : boolean" },
                ),
                (
                    "SIGNALS",
                    &(fields(&|field| signal(field, &field.id))
                        + &each(&|answer| answer.signals())),
                ),
                ("PORTS", &ports.join(",\n")),
                ("VARIABLES", &each(&|answer| answer.variables())),
                ("PROCEDURES", &each(&|answer| answer.procedures())),
                ("OPEN", &each(&|answer| answer.fill(OPEN))),
                ("WATCH", &each(&|answer| answer.fill(WATCH))),
                ("READY", &each(&|answer| answer.fill(READY) + NOISE)),
                ("SPOIL", &inverted(&mut self.cfg.fields.iter())),
                ("CUT", &inverted(&mut self.cut_fields())),
                ("COMPLETE", &all(" and ", &|answer| answer.complete())),
                ("VALID", &all(" or ", &|answer| format!("{}valid = '1'", answer.prefix))),
                ("MISSING", &each(&|answer| answer.keyed(MISSING))),
                ("DRIVE", &fields(&|field| format!("            {0} <= cfg.{0};\n", field.id))),
                (
                    "LAST",
                    &each(&|answer| {
                        answer.fill("        last_row(@ANSWER@file, \"@STEM@.tv\", @EXP@_ROWS, @ANSWER@line);\n")
                    }),
                ),
            ],
        );
        self.fill(&text)
    }

    /// The device in VHDL, and its parts, if this crate has it.
    pub(in crate::vector::package) fn has_entity(&self) -> bool {
        !self.entities.is_empty()
    }
}
