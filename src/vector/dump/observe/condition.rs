//! Conditions that may tell rows that differ from rows that agree.

use super::Row;
use crate::format::{Column, Role};
use crate::setup::Triangle;
use crate::vector::bench::{Coverage, FileSpec};

/// A condition of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Condition {
    /// The operation of a walk has this code.
    Op(u128),
    /// The operation of the row before had it.
    AfterOp(u128),
    /// A column has this value.
    Is(usize, u128),
    /// A signed column is negative.
    Negative(usize),
    /// A number of rows, columns or samples is this or more: a power of two.
    AtLeast(usize, u128),
    /// The row is the first of its test, or is not.
    First(bool),
    /// The slopes of the test lie in this octant: columns of the configuration.
    Octant([usize; 2], usize),
    /// The area of the test's triangle is negative, or positive: columns of its vertices.
    Winding([[usize; 2]; 3], bool),
    /// The sample is the last of its row of the box: x, and the configuration's end of the box.
    AtRightSide(usize, usize),
}

/// Powers of two that a coordinate is held against.
const POWERS: std::ops::Range<u32> = 3..16;

const OPS: [&str; 4] = ["a load", "a step right", "a step down", "a hold"];

impl Condition {
    /// Those that the rows of a file can have.
    pub(super) fn all(file: &FileSpec, cfg: &FileSpec) -> Vec<Self> {
        let mut list = vec![Self::First(true), Self::First(false)];
        let place = |columns: &[Column], role: Role| {
            columns.iter().position(|column| column.name == role.pattern)
        };
        for (k, column) in file.columns.iter().enumerate() {
            if column.name == Role::OP.pattern {
                list.extend((0..4).map(Self::Op));
                list.extend((0..4).map(Self::AfterOp));
            } else if column.width == 1 {
                list.extend([Self::Is(k, 0), Self::Is(k, 1)]);
            } else if column.signed {
                list.extend([Self::Negative(k), Self::Is(k, 0)]);
            } else if k < file.key && column.name != Role::TEST.pattern {
                list.extend(POWERS.map(|power| Self::AtLeast(k, 1 << power)));
            } else {
                list.push(Self::Is(k, 0));
            }
        }
        let slopes = [
            [Role::DX, Role::DY],
            [Role::WALKED_EDGE_DX, Role::WALKED_EDGE_DY],
            [Role::DEPTH_DX, Role::DEPTH_DY],
        ];
        let slopes = slopes
            .into_iter()
            .find_map(|[dx, dy]| Some([place(&cfg.columns, dx)?, place(&cfg.columns, dy)?]));
        list.extend(slopes.into_iter().flat_map(|at| (0..8).map(move |n| Self::Octant(at, n))));
        let vertex = |k: usize| {
            let at = |role: Role| cfg.columns.iter().position(|column| column.name == role.name(k));
            Some([at(Role::VERTEX_X)?, at(Role::VERTEX_Y)?])
        };
        if let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(vertex) {
            list.extend([true, false].map(|negative| Self::Winding([a, b, c], negative)));
        }
        let right = place(&file.columns, Role::X).zip(place(&cfg.columns, Role::BOX_X_END));
        list.extend(right.map(|(x, end)| Self::AtRightSide(x, end)));
        list
    }

    /// Whether a row has it.
    pub(super) fn holds(&self, columns: &[Column], cfg: &[Column], row: &Row<'_>) -> bool {
        match self {
            Self::Op(code) => row.want[0] == *code,
            Self::AfterOp(code) => row.n > 0 && row.before.is_some_and(|row| row[0] == *code),
            Self::Is(k, value) => row.want[*k] == *value,
            Self::Negative(k) => row.want[*k] >> (columns[*k].width - 1) & 1 == 1,
            Self::AtLeast(k, value) => row.want[*k] >= *value,
            Self::First(first) => (row.n == 0) == *first,
            Self::Octant([dx, dy], octant) => {
                let slope = |k: usize| crate::vector::dump::value(&cfg[k], row.stimulus[k]);
                Coverage::octant(slope(*dx), slope(*dy)) == *octant
            }
            Self::Winding(vertices, negative) => {
                let word = |k: usize| crate::vector::dump::value(&cfg[k], row.stimulus[k]);
                let xy = vertices.map(|[x, y]| [word(x), word(y)]);
                let area = Triangle { xy, z: None }.area2();
                if *negative { area < 0 } else { area > 0 }
            }
            Self::AtRightSide(x, end) => row.want[*x] + 1 == row.stimulus[*end],
        }
    }

    /// In words.
    pub(super) fn text(&self, columns: &[Column]) -> String {
        let op = |code: u128| usize::try_from(code).ok().and_then(|code| OPS.get(code)).copied();
        match self {
            Self::Op(code) => format!("on {}", op(*code).unwrap_or("no operation")),
            Self::AfterOp(code) => format!("after {}", op(*code).unwrap_or("no operation")),
            Self::Is(k, value) => format!("where {} is {value}", columns[*k].name),
            Self::Negative(k) => format!("where {} is negative", columns[*k].name),
            Self::AtLeast(k, value) => format!("where {} is {value} or more", columns[*k].name),
            Self::First(true) => "in the first row of a test".to_owned(),
            Self::First(false) => "after the first row of a test".to_owned(),
            Self::Octant(_, octant) => {
                format!("with slopes in the octant {}", Coverage::OCTANTS[*octant])
            }
            Self::Winding(_, true) => "where the triangle's area is negative".to_owned(),
            Self::Winding(_, false) => "where the triangle's area is positive".to_owned(),
            Self::AtRightSide(..) => "at the right side of the box".to_owned(),
        }
    }
}
