//! Classical mutation operators, at every place of a module where they fit. They know the language
//! and nothing of what a module computes.

use super::source::{Assignment, Kind, Module};
use std::collections::BTreeMap;
use std::ops::Range;

/// One change of one module.
#[derive(Clone, Debug)]
pub(super) struct Mutant {
    pub(super) module: String,
    pub(super) operator: &'static str,
    /// Line of the change, counted from the head of the module.
    pub(super) line: usize,
    /// Bytes of the module's text that give way, ascending.
    pub(super) edits: Vec<(Range<usize>, String)>,
    /// What it does, in words.
    pub(super) what: String,
}

/// Mutants of a module by operator and place.
pub(super) type Places = BTreeMap<&'static str, BTreeMap<usize, Vec<Mutant>>>;

struct Found<'a> {
    module: &'a Module,
    places: Places,
}

pub(super) fn mutants(module: &Module) -> Places {
    let mut found = Found { module, places: Places::new() };
    for expression in &module.expressions {
        found.marks(&expression.at);
        found.literals(&expression.at);
        found.selects(&expression.at);
        found.operands(&expression.at, expression.scope);
        found.choices(&expression.at);
        found.casts(&expression.at);
    }
    found.conditions();
    found.assignments();
    found.delays();
    found.widths();
    found.places
}

/// Operators that can stand in each other's place.
const FAMILIES: [(&str, &[&str]); 6] = [
    ("arithmetic", &["+", "-", "*", "/", "%"]),
    ("relation", &["<", "<=", ">", ">="]),
    ("relation", &["==", "!="]),
    ("logic", &["&&", "||"]),
    ("logic", &["&", "|", "^"]),
    ("shift", &["<<", ">>", ">>>"]),
];

impl Found<'_> {
    fn add(
        &mut self,
        operator: &'static str,
        place: usize,
        edits: Vec<(Range<usize>, String)>,
        what: String,
    ) {
        let module = self.module;
        if edits.iter().all(|(at, new)| module.text[at.clone()] == **new) {
            return;
        }
        let line = module.line(place);
        let mutant = Mutant { module: module.name.clone(), operator, line, edits, what };
        self.places.entry(operator).or_default().entry(place).or_default().push(mutant);
    }

    /// Replaces tokens by a text.
    fn replace(&mut self, operator: &'static str, at: &Range<usize>, new: &str, what: String) {
        let bytes = self.module.bytes(at);
        self.add(operator, at.start, vec![(bytes, new.to_owned())], what);
    }

    /// Whether the mark stands between two operands.
    fn is_binary(&self, n: usize, inside: &Range<usize>) -> bool {
        let module = self.module;
        n > inside.start
            && (module.is_name(n - 1)
                || module.tokens[n - 1].kind == Kind::Number
                || matches!(module.word(n - 1), ")" | "]" | "}"))
    }

    /// Operators swapped, operators of one operand taken out, operands exchanged.
    fn marks(&mut self, inside: &Range<usize>) {
        let module = self.module;
        for n in inside.clone().filter(|n| module.tokens[*n].kind == Kind::Mark) {
            let mark = module.word(n);
            if !self.is_binary(n, inside) {
                if matches!(mark, "!" | "~" | "-") {
                    let operator = if mark == "-" { "arithmetic" } else { "logic" };
                    self.replace(operator, &(n..n + 1), "", format!("`{mark}` is left out"));
                }
                continue;
            }
            let Some((operator, family)) = FAMILIES.iter().find(|(_, f)| f.contains(&mark)) else {
                continue;
            };
            for other in family.iter().filter(|other| **other != mark) {
                self.replace(
                    operator,
                    &(n..n + 1),
                    other,
                    format!("`{other}` instead of `{mark}`"),
                );
            }
            if matches!(mark, "-" | "/" | "%" | "<" | "<=" | ">" | ">=" | "<<" | ">>" | ">>>") {
                let (left, right) = (self.before(n), self.after(n));
                if inside.start <= left.start && right.end <= inside.end {
                    let [a, b] = [&left, &right].map(|at| module.written(at).to_owned());
                    let what = format!("the operands `{a}` and `{b}` of `{mark}` are exchanged");
                    let edits = vec![(module.bytes(&left), b), (module.bytes(&right), a)];
                    self.add("exchange", n, edits, what);
                }
            }
        }
    }

    /// The operand that ends before a mark: a name or a number with what belongs to it.
    fn before(&self, n: usize) -> Range<usize> {
        let module = self.module;
        let mut at = n - 1;
        loop {
            if matches!(module.word(at), ")" | "]" | "}") {
                at = module.partner[at];
            }
            let prior = module.word(at - 1);
            let selected = module.word(at) == "[" && (module.is_name(at - 1) || prior == "]");
            let called =
                module.word(at) == "(" && (module.is_name(at - 1) || prior.starts_with('$'));
            let cast = module.word(at) == "(" && prior == "'";
            if selected || called {
                at -= 1;
            } else if cast {
                at -= 2;
            } else {
                return at..n;
            }
            if !matches!(module.word(at), ")" | "]" | "}") {
                return at..n;
            }
        }
    }

    /// The operand that begins after a mark.
    fn after(&self, n: usize) -> Range<usize> {
        let module = self.module;
        let mut at = n + 1;
        while matches!(module.word(at), "-" | "!" | "~" | "&" | "|") {
            at += 1;
        }
        if matches!(module.word(at), "(" | "{") {
            at = module.partner[at];
        }
        at += 1;
        loop {
            at = match module.word(at) {
                "[" | "(" => module.partner[at] + 1,
                "'" => at + 1,
                _ => return n + 1..at,
            }
        }
    }

    fn literals(&mut self, inside: &Range<usize>) {
        let module = self.module;
        let mut n = inside.start;
        while n < inside.end {
            if module.word(n) == "[" {
                n = module.partner[n];
            } else if module.tokens[n].kind == Kind::Number && module.word(n + 1) != "'" {
                let old = module.word(n);
                for new in neighbours(old) {
                    self.replace(
                        "constant",
                        &(n..n + 1),
                        &new,
                        format!("the constant {new} instead of {old}"),
                    );
                }
            }
            n += 1;
        }
    }

    /// Bits and slices beside the right ones.
    fn selects(&mut self, inside: &Range<usize>) {
        let module = self.module;
        for open in inside.clone().filter(|n| module.word(*n) == "[") {
            let close = module.partner[open];
            let colon = module.find(open + 1, &[":", "]"]);
            let bounds = [open + 1..colon, colon + 1..close];
            for at in bounds.iter().filter(|at| at.start < at.end) {
                let old = module.written(at).to_owned();
                for new in [format!("{old}+1"), format!("{old}-1")] {
                    let what = format!("the bit or bound {new} instead of {old}");
                    self.replace("slice", at, &new, what);
                }
            }
        }
    }

    /// Another signal of the same class, and concatenations turned round.
    fn operands(&mut self, inside: &Range<usize>, scope: usize) {
        let module = self.module;
        for n in inside.clone() {
            if module.word(n) == "{" && module.word(n + 1) != "{" && self.module.word(n + 2) != "{"
            {
                let comma = module.find(n + 1, &[",", "}"]);
                let close = module.partner[n];
                let (first, rest) = (n + 1..comma, comma + 1..close);
                if comma < close && module.find(comma + 1, &[",", "}"]) == close {
                    let [a, b] = [&first, &rest].map(|at| module.written(at).to_owned());
                    let what =
                        format!("the parts `{a}` and `{b}` of a concatenation are exchanged");
                    let edits = vec![(module.bytes(&first), b), (module.bytes(&rest), a)];
                    self.add("exchange", n, edits, what);
                }
            }
            if !module.is_name(n) {
                continue;
            }
            let here = |s: usize| s == 0 || s == scope;
            let word = module.word(n);
            let Some(name) =
                module.names.iter().rev().find(|name| name.text == word && here(name.scope))
            else {
                continue;
            };
            let others = module.names.iter().filter(|other| {
                other.class == name.class && other.text != name.text && here(other.scope)
            });
            for other in others {
                let what = format!("`{}` is read instead of `{word}`", other.text);
                self.replace("operand", &(n..n + 1), &other.text, what);
            }
        }
    }

    /// Conditions of `?:`.
    fn choices(&mut self, inside: &Range<usize>) {
        let module = self.module;
        for mark in inside.clone().filter(|n| module.word(*n) == "?") {
            let mut begin = mark;
            while begin > inside.start {
                let prior = module.word(begin - 1);
                if matches!(prior, "(" | "{" | "[" | "," | "?" | ":") {
                    break;
                }
                begin = match prior {
                    ")" | "]" | "}" => module.partner[begin - 1],
                    _ => begin - 1,
                };
            }
            self.stuck(&(begin..mark), "condition");
        }
    }

    fn stuck(&mut self, at: &Range<usize>, operator: &'static str) {
        let old = self.module.written(at).to_owned();
        self.replace(
            operator,
            at,
            &format!("!({old})"),
            format!("the condition `{old}` is turned round"),
        );
        self.replace(operator, at, "1'b1", format!("the condition `{old}` is always true"));
        self.replace(operator, at, "1'b0", format!("the condition `{old}` is never true"));
    }

    fn casts(&mut self, inside: &Range<usize>) {
        let module = self.module;
        for n in inside.clone() {
            if module.word(n) == "$signed" {
                self.replace("sign", &(n..n + 1), "", "`$signed` is left out".to_owned());
            }
            if !module.is_name(n) || module.word(n + 1) == "(" {
                continue;
            }
            let Some(name) = module.names.iter().find(|name| name.text == module.word(n)) else {
                continue;
            };
            let operand =
                if module.word(n + 1) == "[" { n..module.partner[n + 1] + 1 } else { n..n + 1 };
            let edge =
                |n: usize| FAMILIES.iter().any(|(_, family)| family.contains(&module.word(n)));
            let beside = (n > inside.start && edge(n - 1))
                || (operand.end < inside.end && edge(operand.end));
            if beside && name.class.contains('[') {
                let cast = if name.signed { "$unsigned" } else { "$signed" };
                let old = module.written(&operand).to_owned();
                let what = format!("`{old}` goes through `{cast}`");
                self.replace("sign", &operand, &format!("{cast}({old})"), what);
            }
        }
    }

    fn conditions(&mut self) {
        for condition in &self.module.conditions {
            let old = self.module.written(&condition.at).to_owned();
            if old == "rst" {
                self.replace("reset", &condition.at, "1'b0", "the reset does nothing".to_owned());
                self.replace(
                    "reset",
                    &condition.at,
                    "!rst",
                    "the reset is turned round".to_owned(),
                );
            } else {
                self.stuck(&condition.at, "condition");
                if condition.clocked && !condition.has_else {
                    let what = format!("the enable `{old}` is always on");
                    self.replace("enable", &condition.at, "1'b1", what);
                }
            }
        }
        for wire in &self.module.wires {
            if !self.module.written(&wire.kind).contains('[') {
                self.stuck(&wire.value, "condition");
            }
        }
    }

    fn assignments(&mut self) {
        let module = self.module;
        for assignment in &module.assignments {
            let text = module.written(&assignment.whole).to_owned();
            let under_reset = self.is_reset(assignment);
            let operator = if under_reset { "reset" } else { "drop" };
            self.replace(operator, &assignment.whole, ";", format!("`{text}` is left out"));
        }
        for pair in module
            .assignments
            .windows(2)
            .filter(|pair| pair[0].block == pair[1].block && pair[0].clocked && !pair[0].continuous)
        {
            let [a, b] = [&pair[0].target, &pair[1].target];
            let [old, other] = [a, b].map(|at| module.written(at).to_owned());
            let what = format!("`{old}` and `{other}` take each other's values");
            let edits = vec![(module.bytes(a), other), (module.bytes(b), old)];
            self.add("target", a.start, edits, what);
        }
    }

    /// In the branch of `if (rst)`, as far as that is a block or a statement right behind it.
    fn is_reset(&self, assignment: &Assignment) -> bool {
        let module = self.module;
        let blocks = module.assignments.iter().filter(|other| other.block == assignment.block);
        let first = blocks.map(|other| other.whole.start).min().expect("itself");
        let head = first - usize::from(module.word(first - 1) == "begin");
        head >= 3 && module.word(head - 1) == ")" && module.word(head - 2) == "rst"
    }

    /// A value that comes a clock later.
    fn delays(&mut self) {
        let module = self.module;
        if !module.names.iter().any(|name| name.text == "clk") {
            return;
        }
        for assignment in module.assignments.iter().filter(|assignment| assignment.continuous) {
            let [target, value] =
                [&assignment.target, &assignment.value].map(|at| module.written(at));
            let what = format!("`{target}` comes a clock later");
            let new = format!("always_ff @(posedge clk) {target} <= {value};");
            self.replace("delay", &assignment.whole, &new, what);
        }
        for wire in &module.wires {
            let name = module.word(wire.declarator.start).to_owned();
            let kind = module.written(&wire.kind).trim_start_matches("wire").trim().to_owned();
            let others = module.wires.iter().filter(|other| {
                other.statement == wire.statement && other.declarator != wire.declarator
            });
            let others: Vec<&str> = others.map(|other| module.written(&other.declarator)).collect();
            let rest = if others.is_empty() {
                String::new()
            } else {
                format!(" wire {kind} {};", others.join(", "))
            };
            let value = module.written(&wire.value);
            let new =
                format!("logic {kind} {name};{rest} always_ff @(posedge clk) {name} <= {value}");
            let bytes = module.bytes(&wire.statement);
            let what = format!("`{name}` comes a clock later");
            self.add("delay", wire.declarator.start, vec![(bytes, new)], what);
        }
    }

    /// Words that are a bit too narrow, and signs of declarations.
    fn widths(&mut self) {
        let module = self.module;
        for at in &module.constants {
            let old = module.written(at).to_owned();
            let name = module.word(at.start - 2);
            self.replace(
                "width",
                at,
                &format!("({old}) - 1"),
                format!("the constant {name} is one less"),
            );
        }
        for at in &module.ranges {
            let high = at.start + 1..module.find(at.start + 1, &[":"]);
            let old = module.written(&high).to_owned();
            let what = format!("words declared `{}` are a bit narrower", module.written(at));
            self.replace("width", &high, &format!("{old}-1"), what);
        }
        for n in (0..module.tokens.len()).filter(|n| module.word(*n) == "signed") {
            self.replace("sign", &(n..n + 1), "", "a declaration is not signed".to_owned());
        }
    }
}

/// One more, one less, zero and all ones, in the form of the old constant.
fn neighbours(old: &str) -> Vec<String> {
    let Some((width, digits)) = old.split_once('\'') else {
        let value: u64 = old.parse().expect("a decimal number");
        let mut new = vec![format!("{}", value + 1), "0".to_owned()];
        new.extend(value.checked_sub(1).map(|less| less.to_string()));
        new.dedup();
        return new;
    };
    let Ok(bits) = width.parse::<u32>() else {
        return vec![if digits == "0" { "'1" } else { "'0" }.to_owned()];
    };
    let radix = match &digits[..1] {
        "b" => 2,
        "d" => 10,
        "h" => 16,
        other => panic!("a radix: {other}"),
    };
    let value = u64::from_str_radix(&digits[1..], radix).expect("digits of the radix");
    let ones = (1 << bits) - 1;
    let mut new = [value.wrapping_add(1) & ones, value.wrapping_sub(1) & ones, 0, ones];
    new.sort_unstable();
    let mut texts: Vec<String> = new.iter().map(|value| format!("{bits}'d{value}")).collect();
    texts.dedup();
    texts.retain(|text| *text != format!("{bits}'d{value}"));
    texts
}
