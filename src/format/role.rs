//! What the columns of vector files are called: one name a thing, one order, in one table. Spec clause
//! `N-16`.
//!
//! Machines and benches name their columns by these roles; manifest, packages, testbenches, waves and
//! the specification derive from the columns. Registers and records of real machines are no matter of
//! this table: their words carry the names that the hardware's own manual gives them.

use super::Column;

/// A kind of column: the pattern of its name, and what it holds.
///
/// A pattern may have one `{k}`: the number of a vertex, an edge, a side or a share, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role {
    /// The name, such as `edge{k}_init`.
    pub pattern: &'static str,
    /// One sentence for people, with the same `{k}`.
    pub meaning: &'static str,
}

/// Columns of a file come in the order of this table, those of one vertex or edge together.
macro_rules! roles {
    ($($name:ident $pattern:literal $meaning:literal)*) => {
        impl Role {
            $(#[doc = concat!("`", $pattern, "`: ", $meaning)]
            pub const $name: Self = Self { pattern: $pattern, meaning: $meaning };)*

            /// Every role, in the order in which columns come.
            pub const ALL: &[Self] = &[$(Self::$name),*];
        }
    };
}

roles! {
    TEST "test" "Number of the test, from 0."
    Y "y" "Row."
    X "x" "Column."
    SAMPLE "sample" "Number of the sample in its pixel."
    X_BEGIN "x_begin" "First covered column."
    X_END "x_end" "One past the last covered column."
    OP "op" "0 load, 1 step by dx, 2 step by dy, 3 hold."
    BEFORE "before" "Accumulator before the clock edge, 0 for a load."
    ADDEND "addend" "What is added."
    AFTER "after" "Accumulator after the clock edge."
    INIT "init" "Accumulator that the load takes."
    DX "dx" "Slope per pixel to the right."
    DY "dy" "Slope per row downward."
    ACC "acc" "Accumulator after the clock edge."
    OUT "out" "Read-out after the clamp."
    WALKED_EDGE_INIT "e0" "Edge word that the load takes, bias and shift done."
    WALKED_EDGE_DX "ea" "Step per pixel to the right."
    WALKED_EDGE_DY "eb" "Step per row downward."
    WALKED_EDGE "e" "Edge word after the clock edge."
    INSIDE "in" "1 when the sign bit of e is clear."
    FLAGS "flags" "Bit 0 wrap, 1 clamped above, 2 clamped below, 3 inexact."
    SPANS "spans" "Maximal runs of covered samples."
    SAMPLES "samples" "Covered samples."
    WRAP "wrap" "Covered samples whose depth left the guard range."
    CLAMP_ABOVE "clamp_above" "Covered samples held at the maximum."
    CLAMP_BELOW "clamp_below" "Covered samples held at zero."
    INEXACT "inexact" "Covered samples whose read-out dropped a fraction."
    VERTEX_X "v{k}_x" "Vertex {k}, x in sub-pixels."
    VERTEX_Y "v{k}_y" "Vertex {k}, y in sub-pixels."
    VERTEX_Z "v{k}_z" "Vertex {k}, depth code."
    VERTEX_W "v{k}_w" "Vertex {k}, W: zero or negative beside or behind the eye."
    EDGE_INIT "edge{k}_init" "Edge {k} at pixel (0, 0), biased and stored."
    EDGE_DX "edge{k}_dx" "Edge {k}, step per pixel to the right."
    EDGE_DY "edge{k}_dy" "Edge {k}, step per row downward."
    EDGE_X_INIT "edge{k}_x_init" "Edge {k}, x at its first row."
    EDGE_X_DY "edge{k}_x_dy" "Edge {k}, change of x per row."
    EDGE_Y_BEGIN "edge{k}_y_begin" "Edge {k}, first row; both rows are 0 when it crosses none."
    EDGE_Y_END "edge{k}_y_end" "Edge {k}, row past its last."
    EDGE_DEPTH_INIT "edge{k}_depth_init" "Edge {k}, depth at its first row."
    EDGE_DEPTH_DY "edge{k}_depth_dy" "Edge {k}, change of depth per row."
    SIDE_X "side{k}_x" "Side {k}, x of its upper end in sub-pixels."
    SIDE_Y "side{k}_y" "Side {k}, y of its upper end in sub-pixels."
    SIDE_RUN "side{k}_run" "Side {k}, change of x from its upper end to its lower one, in sub-pixels."
    SIDE_RISE "side{k}_rise" "Side {k}, change of y on that way; 0 cuts no row."
    SHARE_INIT "share{k}_init" "Share of vertex {k} at pixel (0, 0)."
    SHARE_DX "share{k}_dx" "Share of vertex {k}, change per pixel to the right."
    SHARE_DY "share{k}_dy" "Share of vertex {k}, change per row downward."
    DEPTH_BASE "depth_base" "Depth code of vertex 0 of the normalised triangle."
    DEPTH_RISE "depth_rise{k}" "Depth of vertex {k} less that of vertex 0."
    DEPTH_INIT "depth_init" "Depth accumulator at pixel (0, 0)."
    DEPTH_DX "depth_dx" "Depth slope per pixel to the right."
    DEPTH_DY "depth_dy" "Depth slope per row downward."
    ZERO_AREA "zero_area" "1 when the triangle has no area and draws nothing."
    BOX_Y_BEGIN "box_y_begin" "First row of the bounding box in the window."
    BOX_Y_END "box_y_end" "One past its last row."
    BOX_X_BEGIN "box_x_begin" "First column of the bounding box."
    BOX_X_END "box_x_end" "One past its last column."
    DEPTH "depth" "Depth read-out after the clamp."
    MASK "mask" "Covered samples of the pixel, sample 0 in the lowest bit."
}

/// Width, sign and fraction bits of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WordFormat {
    width: u32,
    signed: bool,
    fraction: u32,
}

impl WordFormat {
    /// An unsigned integer of so many bits.
    pub const fn unsigned(width: u32) -> Self {
        Self { width, signed: false, fraction: 0 }
    }

    /// A two's complement word of so many bits.
    pub const fn signed(width: u32) -> Self {
        Self { width, signed: true, fraction: 0 }
    }

    /// With its lowest bits below the binary point.
    #[must_use]
    pub const fn fraction(self, fraction: u32) -> Self {
        Self { fraction, ..self }
    }

    /// Its bits.
    pub const fn width(self) -> u32 {
        self.width
    }

    /// A column of such words.
    pub fn column(self, name: impl Into<String>, meaning: impl Into<String>) -> Column {
        let Self { width, signed, fraction } = self;
        let (name, meaning) = (name.into(), meaning.into());
        Column { name, width, signed, fraction, meaning }
    }
}

impl Role {
    /// The number of a test.
    pub const TEST_WORD: WordFormat = WordFormat::unsigned(32);
    /// A row or column of pixels: 0 to 2^16, the end of a run included.
    pub const PIXEL_WORD: WordFormat = WordFormat::unsigned(17);
    /// A count of samples.
    pub const COUNT_WORD: WordFormat = WordFormat::unsigned(32);

    /// The name of the column of vertex, edge, side or share `k`.
    pub fn name(self, k: usize) -> String {
        numbered(self.pattern, k)
    }

    /// The column of this role.
    pub fn column(self, word: WordFormat) -> Column {
        word.column(self.pattern.to_owned(), self.meaning.to_owned())
    }

    /// The column of vertex, edge, side or share `k`.
    pub fn of(self, k: usize, word: WordFormat) -> Column {
        word.column(self.name(k), numbered(self.meaning, k))
    }

    /// The role of a column by its name, and the number in it. Columns of sample `n` of a pixel have
    /// `_n` after the name of their role.
    pub fn find(name: &str) -> Option<RoleOf> {
        let find = |name: &str, sample| {
            let mut ranked = Self::ALL.iter().enumerate();
            ranked.find_map(|(rank, role)| {
                let k = match role.pattern.split_once("{k}") {
                    None => (name == role.pattern).then_some(0),
                    Some((before, after)) => {
                        name.strip_prefix(before)?.strip_suffix(after)?.parse().ok()
                    }
                }?;
                Some(RoleOf { rank, role: *role, k, sample })
            })
        };
        find(name, None).or_else(|| {
            let (name, sample) = name.rsplit_once('_')?;
            find(name, Some(sample.parse().ok()?))
        })
    }
}

/// A pattern with a number in it. Every model makes its columns, so this is quicker than a search for `{k}`.
fn numbered(pattern: &str, k: usize) -> String {
    let Some(at) = pattern.bytes().position(|byte| byte == b'{') else { return pattern.to_owned() };
    let mut text = String::with_capacity(pattern.len());
    text.push_str(&pattern[..at]);
    match u8::try_from(k) {
        Ok(digit @ 0..10) => text.push(char::from(b'0' + digit)),
        _ => text.push_str(&k.to_string()),
    }
    text.push_str(&pattern[at + "{k}".len()..]);
    text
}

/// The role of a column of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RoleOf {
    /// The place of the role in [`Role::ALL`].
    pub rank: usize,
    /// The role.
    pub role: Role,
    /// Which vertex, edge, side or share; 0 where the role has no number.
    pub k: usize,
    /// Which sample of a pixel, for a column that each sample has one of.
    pub sample: Option<usize>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_one_role() {
        let mut names: Vec<String> =
            Role::ALL.iter().map(|role| role.of(1, WordFormat::unsigned(1)).name).collect();
        for (rank, name) in names.iter().enumerate() {
            let found = Role::find(name).unwrap();
            assert_eq!((found.rank, found.sample), (rank, None), "{name}");
            let found = Role::find(&format!("{name}_3")).unwrap();
            assert_eq!((found.rank, found.sample), (rank, Some(3)), "{name}");
        }
        names.sort();
        names.dedup();
        assert_eq!(names.len(), Role::ALL.len());
        assert_eq!(
            Role::find("edge12_dx").map(|found| (found.role, found.k)),
            Some((Role::EDGE_DX, 12))
        );
        assert_eq!(Role::find("edge_dx"), None);
        assert_eq!(Role::find("z"), None);
    }
}
