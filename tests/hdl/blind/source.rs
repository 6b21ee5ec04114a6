//! A light reader of SystemVerilog: tokens, and where a module has its declarations, expressions,
//! conditions and assignments. It knows the subset that `hdl/` is written in.

use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Word,
    Number,
    Mark,
}

#[derive(Clone, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    /// Bytes of the text.
    pub(super) at: Range<usize>,
}

/// Longest first.
const MARKS: [&str; 14] =
    ["<<<", ">>>", "===", "!==", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "+:", "-:"];

const KEYWORDS: [&str; 26] = [
    "always_comb",
    "always_ff",
    "assign",
    "automatic",
    "begin",
    "case",
    "default",
    "else",
    "end",
    "endcase",
    "endfunction",
    "enum",
    "function",
    "if",
    "input",
    "int",
    "integer",
    "localparam",
    "logic",
    "output",
    "parameter",
    "posedge",
    "reg",
    "signed",
    "typedef",
    "wire",
];

/// The tokens of a text; blanks and comments are left out.
pub(super) fn tokens(text: &str) -> Vec<Token> {
    let bytes = text.as_bytes();
    let word = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'$');
    let run = |from: usize| from + bytes[from..].iter().take_while(|byte| word(**byte)).count();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text[at..];
        let (kind, end) = if bytes[at].is_ascii_whitespace() {
            at += 1;
            continue;
        } else if rest.starts_with("//") {
            at += rest.find('\n').unwrap_or(rest.len());
            continue;
        } else if rest.starts_with("/*") {
            at += rest.find("*/").map_or(rest.len(), |end| end + 2);
            continue;
        } else if bytes[at].is_ascii_digit() || bytes[at] == b'\'' {
            // 12, 2'd0, '0; in 32'(x) the number ends at the tick.
            let digits = run(at);
            let based = bytes.get(digits) == Some(&b'\'')
                && bytes.get(digits + 1).copied().is_some_and(word);
            match (based, digits > at) {
                (true, _) => (Kind::Number, run(digits + 1)),
                (false, true) => (Kind::Number, digits),
                (false, false) => (Kind::Mark, at + 1),
            }
        } else if word(bytes[at]) {
            (Kind::Word, run(at))
        } else {
            let mark = MARKS.iter().find(|mark| rest.starts_with(**mark));
            (Kind::Mark, at + mark.map_or(1, |mark| mark.len()))
        };
        found.push(Token { kind, at: at..end });
        at = end;
    }
    found
}

/// What a name stands for. Names of one class can replace each other.
#[derive(Clone, Debug)]
pub(super) struct Name {
    pub(super) text: String,
    /// Packed range, and dimensions, as they are written; `const` and `enum` for constants.
    pub(super) class: String,
    pub(super) signed: bool,
    /// 0 the module, else a function of it.
    pub(super) scope: usize,
}

/// Where an expression stands. All ranges of this module are of token indices.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    pub(super) at: Range<usize>,
    pub(super) scope: usize,
}

#[derive(Clone, Debug)]
pub(super) struct Condition {
    pub(super) at: Range<usize>,
    pub(super) clocked: bool,
    pub(super) has_else: bool,
}

#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) whole: Range<usize>,
    pub(super) target: Range<usize>,
    pub(super) value: Range<usize>,
    pub(super) clocked: bool,
    /// An `assign` of the module.
    pub(super) continuous: bool,
    /// Assignments of one block, next to each other, have the same number.
    pub(super) block: usize,
}

/// A wire declared with a value.
#[derive(Clone, Debug)]
pub(super) struct Wire {
    pub(super) statement: Range<usize>,
    /// `signed [D-1:0]`
    pub(super) kind: Range<usize>,
    /// `x01 = x[1] - x[0]`
    pub(super) declarator: Range<usize>,
    pub(super) value: Range<usize>,
}

/// A module's text and what is in it.
#[derive(Debug)]
pub(super) struct Module {
    pub(super) name: String,
    pub(super) text: String,
    pub(super) tokens: Vec<Token>,
    /// The bracket that closes or opens the bracket at an index.
    pub(super) partner: Vec<usize>,
    pub(super) names: Vec<Name>,
    pub(super) expressions: Vec<Expression>,
    pub(super) conditions: Vec<Condition>,
    pub(super) assignments: Vec<Assignment>,
    pub(super) wires: Vec<Wire>,
    /// Packed ranges of declarations inside the module, and values of its integer constants.
    pub(super) ranges: Vec<Range<usize>>,
    pub(super) constants: Vec<Range<usize>>,
    at: usize,
    scope: usize,
    blocks: usize,
}

impl Module {
    /// Reads `module NAME ... endmodule`.
    pub(super) fn read(text: &str) -> Self {
        let tokens = tokens(text);
        let mut partner = vec![usize::MAX; tokens.len()];
        let mut open = Vec::new();
        for (n, token) in tokens.iter().enumerate() {
            match &text[token.at.clone()] {
                "(" | "[" | "{" => open.push(n),
                ")" | "]" | "}" => {
                    let begin: usize = open.pop().expect("a bracket that opens");
                    (partner[n], partner[begin]) = (begin, n);
                }
                _ => {}
            }
        }
        assert!(open.is_empty(), "a bracket that closes");
        let mut module = Self {
            name: text[tokens[1].at.clone()].to_owned(),
            text: text.to_owned(),
            tokens,
            partner,
            names: Vec::new(),
            expressions: Vec::new(),
            conditions: Vec::new(),
            assignments: Vec::new(),
            wires: Vec::new(),
            ranges: Vec::new(),
            constants: Vec::new(),
            at: 0,
            scope: 0,
            blocks: 0,
        };
        module.header();
        while module.word(module.at) != "endmodule" {
            module.item();
        }
        module
    }

    pub(super) fn word(&self, n: usize) -> &str {
        self.tokens.get(n).map_or("", |token| &self.text[token.at.clone()])
    }

    pub(super) fn bytes(&self, at: &Range<usize>) -> Range<usize> {
        self.tokens[at.start].at.start..self.tokens[at.end - 1].at.end
    }

    pub(super) fn written(&self, at: &Range<usize>) -> &str {
        if at.is_empty() { "" } else { &self.text[self.bytes(at)] }
    }

    pub(super) fn is_name(&self, n: usize) -> bool {
        self.tokens[n].kind == Kind::Word
            && !KEYWORDS.contains(&self.word(n))
            && !self.word(n).starts_with('$')
    }

    /// Line of a token, counted from the head of the module.
    pub(super) fn line(&self, n: usize) -> usize {
        1 + self.text[..self.tokens[n].at.start].matches('\n').count()
    }

    /// The first of these marks from here on, outside brackets.
    pub(super) fn find(&self, from: usize, marks: &[&str]) -> usize {
        let mut n = from;
        while !marks.contains(&self.word(n)) {
            assert!(n < self.tokens.len(), "{}: one of {marks:?}", self.name);
            n = if matches!(self.word(n), "(" | "[" | "{") { self.partner[n] + 1 } else { n + 1 };
        }
        n
    }

    fn expression(&mut self, at: Range<usize>) {
        if !at.is_empty() {
            self.expressions.push(Expression { at, scope: self.scope });
        }
    }

    /// `#( parameters ) ( ports );`
    fn header(&mut self) {
        self.at = 2;
        if self.word(self.at) == "#" {
            let end = self.partner[self.at + 1];
            self.declarators(self.at + 2, end, true);
            self.at = end + 1;
        }
        let end = self.partner[self.at];
        self.declarators(self.at + 1, end, true);
        self.at = end + 2;
        self.expressions.clear();
        self.ranges.clear();
        self.constants.clear();
        self.wires.clear();
    }

    /// Declarations separated by commas; the type holds until the next one.
    fn declarators(&mut self, begin: usize, end: usize, header: bool) {
        let (mut signed, mut range, mut constant) = (false, 0..0, false);
        let mut is_int = false;
        let mut at = begin;
        while at < end {
            let kind = at;
            let mut typed = false;
            while KEYWORDS.contains(&self.word(at)) || self.word(at) == "[" {
                if !typed {
                    (signed, range, is_int) = (false, 0..0, false);
                }
                typed = true;
                match self.word(at) {
                    "signed" => signed = true,
                    "int" | "integer" => is_int = true,
                    "parameter" | "localparam" => constant = true,
                    "[" => {
                        range = at..self.partner[at] + 1;
                        self.ranges.push(range.clone());
                        at = self.partner[at];
                    }
                    _ => {}
                }
                at += 1;
            }
            let types = kind..at;
            let name = at;
            let stop = self.find(at, &[",", "=", ";", ")"]).min(end);
            let dimension = self.written(&(name + 1..stop)).to_owned();
            let width = if is_int { "int" } else { self.written(&range) };
            let class = format!("{}{width} {dimension}", if constant { "const " } else { "" });
            self.names.push(Name {
                text: self.word(name).to_owned(),
                class,
                signed,
                scope: self.scope,
            });
            at = stop;
            if self.word(stop) == "=" {
                at = self.find(stop, &[",", ";", ")"]).min(end);
                let value = stop + 1..at;
                self.expression(value.clone());
                if constant && is_int {
                    self.constants.push(value);
                } else if !constant && self.scope == 0 && !header {
                    let first = self.wires.iter().find(|wire| wire.statement.start == begin);
                    let kind = first.map_or(types, |wire| wire.kind.clone());
                    self.wires.push(Wire {
                        statement: begin..end,
                        kind,
                        declarator: name..at,
                        value,
                    });
                }
            }
            at += 1;
        }
    }

    fn declaration(&mut self) {
        let end = self.find(self.at, &[";"]);
        self.declarators(self.at, end, false);
        self.at = end + 1;
    }

    fn item(&mut self) {
        match self.word(self.at) {
            "localparam" | "wire" | "logic" | "reg" | "integer" => self.declaration(),
            "typedef" => {
                let end = self.find(self.at, &[";"]);
                let open = self.find(self.at, &["{"]);
                for n in (open + 1..self.partner[open]).step_by(2) {
                    let text = self.word(n).to_owned();
                    let class = "enum".to_owned();
                    self.names.push(Name { text, class, signed: false, scope: 0 });
                }
                self.at = end + 1;
            }
            "assign" => {
                let begin = self.at;
                self.at += 1;
                self.assignment(begin, false, true);
            }
            "always_ff" => {
                self.at = self.partner[self.at + 2] + 1;
                self.statement(true);
            }
            "always_comb" => {
                self.at += 1;
                self.statement(false);
            }
            "function" => self.function(),
            // type variable;
            _ if self.tokens[self.at + 1].kind == Kind::Word && self.word(self.at + 2) == ";" => {
                let class = self.word(self.at).to_owned();
                let text = self.word(self.at + 1).to_owned();
                self.names.push(Name { text, class, signed: false, scope: 0 });
                self.at += 3;
            }
            _ => self.instance(),
        }
    }

    fn function(&mut self) {
        self.scope = 1 + self.names.iter().map(|name| name.scope).max().unwrap_or(0);
        let open = self.find(self.at, &["("]);
        let (ranges, names) = (self.ranges.len(), self.names.len());
        self.declarators(open + 1, self.partner[open], true);
        // Ports of a function are as wide as its callers say.
        self.ranges.truncate(ranges);
        assert!(self.names.len() > names);
        self.at = self.partner[open] + 2;
        while self.word(self.at) != "endfunction" {
            self.statement(false);
        }
        self.at += 1;
        self.scope = 0;
    }

    /// `module #(.P(p)) name (.port(expression), ...);`
    fn instance(&mut self) {
        let end = self.find(self.at, &[";"]);
        let open = self.partner[end - 1];
        let mut n = open + 1;
        while n < end - 1 {
            assert_eq!(self.word(n), ".", "{}: a port by name", self.name);
            let begin = n + 2;
            self.expression(begin + 1..self.partner[begin]);
            n = self.partner[begin] + 2;
        }
        self.at = end + 1;
    }

    fn assignment(&mut self, begin: usize, clocked: bool, continuous: bool) {
        let target = self.at;
        let equals = self.find(target, &["<=", "="]);
        let end = self.find(equals, &[";"]);
        self.expression(equals + 1..end);
        self.assignments.push(Assignment {
            whole: begin..end + 1,
            target: target..equals,
            value: equals + 1..end,
            clocked,
            continuous,
            block: self.blocks,
        });
        self.at = end + 1;
    }

    fn statement(&mut self, clocked: bool) {
        match self.word(self.at) {
            ";" => self.at += 1,
            "begin" => {
                self.at += 1;
                self.blocks += 1;
                while self.word(self.at) != "end" {
                    self.statement(clocked);
                }
                self.blocks += 1;
                self.at += 1;
            }
            "if" => {
                let condition = self.at + 2..self.partner[self.at + 1];
                self.at = condition.end + 1;
                self.expression(condition.clone());
                let index = self.conditions.len();
                self.conditions.push(Condition { at: condition, clocked, has_else: false });
                self.blocks += 1;
                self.statement(clocked);
                if self.word(self.at) == "else" {
                    self.conditions[index].has_else = true;
                    self.at += 1;
                    self.blocks += 1;
                    self.statement(clocked);
                }
                self.blocks += 1;
            }
            "case" => {
                let close = self.partner[self.at + 1];
                self.expression(self.at + 2..close);
                self.at = close + 1;
                while self.word(self.at) != "endcase" {
                    let colon = self.find(self.at, &[":"]);
                    if self.word(self.at) != "default" {
                        self.expression(self.at..colon);
                    }
                    self.at = colon + 1;
                    self.blocks += 1;
                    self.statement(clocked);
                }
                self.blocks += 1;
                self.at += 1;
            }
            "logic" | "reg" | "integer" => self.declaration(),
            _ => self.assignment(self.at, clocked, false),
        }
    }
}
