//! Operators and relations, right or in the place of another.

/// An operator of two words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::vector::suspect) enum Operator {
    Add,
    Subtract,
    /// The second less the first.
    Reversed,
    And,
    Or,
    Xor,
    First,
    Second,
    Multiply,
}

impl Operator {
    pub(super) const SUMS: [Self; 9] = [
        Self::Add,
        Self::Subtract,
        Self::Reversed,
        Self::And,
        Self::Or,
        Self::Xor,
        Self::First,
        Self::Second,
        Self::Multiply,
    ];
    pub(super) const PRODUCTS: [Self; 4] = [Self::Add, Self::Subtract, Self::First, Self::Second];

    pub(super) fn apply(self, a: i128, b: i128) -> i128 {
        match self {
            Self::Add => a.wrapping_add(b),
            Self::Subtract => a.wrapping_sub(b),
            Self::Reversed => b.wrapping_sub(a),
            Self::And => a & b,
            Self::Or => a | b,
            Self::Xor => a ^ b,
            Self::First => a,
            Self::Second => b,
            Self::Multiply => a.wrapping_mul(b),
        }
    }

    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Add => "adds",
            Self::Subtract => "subtracts",
            Self::Reversed => "subtracts the other way round",
            Self::And => "is a bitwise and",
            Self::Or => "is a bitwise or",
            Self::Xor => "is an exclusive or (no carries)",
            Self::First => "leaves out its second operand",
            Self::Second => "leaves out its first operand",
            Self::Multiply => "multiplies",
        }
    }
}

/// A relation of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::vector::suspect) enum Relation {
    Less,
    LessOrEqual,
    Equal,
    Unequal,
    GreaterOrEqual,
    Greater,
}

impl Relation {
    pub(super) const ALL: [Self; 6] = [
        Self::Less,
        Self::LessOrEqual,
        Self::Equal,
        Self::Unequal,
        Self::GreaterOrEqual,
        Self::Greater,
    ];

    pub(super) fn holds(self, a: i128, b: i128) -> bool {
        match self {
            Self::Less => a < b,
            Self::LessOrEqual => a <= b,
            Self::Equal => a == b,
            Self::Unequal => a != b,
            Self::GreaterOrEqual => a >= b,
            Self::Greater => a > b,
        }
    }

    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Equal => "==",
            Self::Unequal => "!=",
            Self::GreaterOrEqual => ">=",
            Self::Greater => ">",
        }
    }
}
