//! Conservative coverage: the widths of its words, and the growth that pays for the snap. Spec clauses `CR-5` and
//! `CR-8`.

use super::domain::Question;
use super::edge::misread;
use super::edge_coefficient::{coefficient, constant};
use super::formal::Formal;
use super::plane::{self, Subject};
use super::snap_witness;
use super::text::bits as count;
use super::{Proof, guard, slope};
use crate::cover::{
    ConservativeConfig, ConservativeDepth, ConservativeMode, Degenerate, EdgeStorage,
    EdgeWordConfig,
};
use crate::exact::Square;
use crate::explore::corner::{at_corners, signed_bits};
use crate::setup::{Division, EdgeCoefficients, Triangle};

/// What a snap is measured in.
const HALVES: &str = "halves of a sub-pixel";

/// The claims on a profile with conservative coverage; the stored width comes first.
pub(super) fn proofs(question: &Question, config: ConservativeConfig) -> Vec<Proof> {
    let mut proofs = vec![
        word(question, config, EdgeStorage::Shifted),
        word(question, config, EdgeStorage::Full),
        coefficient(question),
        constant(question),
        snap(question, config),
    ];
    proofs.extend(depth(question, config));
    proofs
}

/// What a word gains on the way to the corner that decides. Spec clause `CR-3`.
fn gain(question: &Question, config: ConservativeConfig, edge: &EdgeCoefficients) -> i128 {
    ((edge.a.abs() + edge.b.abs()) * config.reach(question.sub_pixel())) >> 1
}

/// The width of one storage.
fn word(question: &Question, config: ConservativeConfig, storage: EdgeStorage) -> Proof {
    let shift = if storage == EdgeStorage::Shifted { question.sub_pixel() } else { 0 };
    let values: Vec<i128> = at_corners(question.vertex_area(), question.sample_area())
        .map(|(edge, e)| (e + gain(question, config, &edge)) >> shift)
        .collect();
    let bits = signed_bits(values.iter().copied());
    let [low, high] = [values.iter().min(), values.iter().max()].map(|v| v.copied().unwrap_or(0));
    let given = question.profile.form.edge().filter(|edges| edges.storage == storage);
    let given = given.map(|edges| edges.width);
    let (rule, conservative) = (question.rule(), Some(config));
    let edges = EdgeWordConfig { rule, storage, width: bits, conservative };
    let witness =
        misread(question, edges, &|edge| gain(question, config, edge), &|triangle, pixel| {
            covers(question, config, triangle, pixel)
        });
    let sign = if config.mode == ConservativeMode::Outer { '+' } else { '-' };
    let half = config.reach(question.sub_pixel()).abs();
    let word = format!("floor(E {sign} (|A| + |B|) {half}/2)");
    let (name, what) = match storage {
        EdgeStorage::Shifted => ("edge.stored", format!("{word} >> {shift}")),
        EdgeStorage::Full => ("edge.full", word),
    };
    let fewer = if witness.is_some() {
        format!(", but with {} one pixel is wrong", count(bits - 1))
    } else {
        String::new()
    };
    Proof {
        claim: name.to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} are enough for {what}, for every edge of the vertex box and the square of every pixel of the \
             window{fewer}.",
            count(bits)
        ),
        error: None,
        bits: Some(bits),
        given,
        sufficient: given.is_none_or(|given| given >= bits),
        bound: format!(
            "-2^{0} <= {low} and {high} <= 2^{0} - 1 over the 64 corners of vertex box and centres",
            bits - 1
        ),
        clause: "CR-8",
        formal: Formal::default(),
        witness,
    }
}

/// The square of a pixel, in halves of a sub-pixel.
fn square(question: &Question, config: ConservativeConfig, pixel: [i128; 2]) -> Square {
    let half_side = config.reach(question.sub_pixel()).abs();
    Square { middle: question.sample(pixel).map(|at| 2 * at), half_side }
}

/// What the clause says of a pixel.
fn covers(
    question: &Question,
    config: ConservativeConfig,
    triangle: &Triangle,
    pixel: [i128; 2],
) -> bool {
    let (square, halves) =
        (square(question, config, pixel), triangle.xy.map(|v| v.map(|at| 2 * at)));
    match config.mode {
        ConservativeMode::Outer => square.touches(halves),
        ConservativeMode::Inner => square.lies_in(halves),
    }
}

/// The growth that pays for the snap.
fn snap(question: &Question, config: ConservativeConfig) -> Proof {
    let rounding = question.profile.vertex.snap;
    let (needed, most) = if rounding.is_nearest() { (1, "1/2") } else { (2, "less than 1") };
    let loses_flat =
        config.mode == ConservativeMode::Outer && config.degenerate == Degenerate::Cull;
    let enough = config.grow >= needed;
    let promise = match config.mode {
        ConservativeMode::Outer => {
            "every pixel that the triangle touches before the snap is covered"
        }
        ConservativeMode::Inner => "every covered pixel lies in the triangle before the snap",
    };
    let mut statement = format!(
        "The snap {rounding} moves a coordinate of the profile's source by {most} sub-pixel{}, so with grow = {needed} {promise}.",
        if needed == 1 { " at most" } else { "" }
    );
    if loses_flat {
        statement += " But degenerate = \"cull\" drops a triangle that the snap leaves without area, whatever it \
                      touched: write degenerate = \"draw\".";
    }
    let tried = if enough && loses_flat { config.grow } else { config.grow.min(needed - 1) };
    let witness = if enough && loses_flat {
        snap_witness::flattened(question, config)
    } else {
        snap_witness::lost(question, ConservativeConfig { grow: tried, ..config }, needed)
    };
    let relation = if enough { "<=" } else { ">" };
    Proof {
        claim: "conservative.snap".to_owned(),
        row: None,
        unit: Some(HALVES),
        place: question.place(),
        statement,
        error: None,
        bits: Some(needed),
        given: Some(config.grow),
        sufficient: enough && !loses_flat,
        bound: format!(
            "the snap moves by {needed}/2 {relation} grow / 2 = {}/2 sub-pixels",
            config.grow
        ),
        clause: "CR-5",
        formal: Formal::default(),
        witness,
    }
}

/// The claims on depth that hold for squares.
fn depth(question: &Question, config: ConservativeConfig) -> Vec<Proof> {
    let Some(depth) = question.profile.depth else { return Vec::new() };
    let subject = Subject::depth();
    let mut proofs = Vec::new();
    // The bound of a walk knows no triangle; that of a reciprocal does.
    if config.depth == ConservativeDepth::Centre && depth.division == Division::Quotient {
        proofs.extend(plane::proofs(question, &subject));
    }
    match config.mode {
        ConservativeMode::Inner => proofs.extend(guard::proof(question, &subject)),
        ConservativeMode::Outer => proofs.push(Proof {
            claim: "depth.guard".to_owned(),
            row: None,
            unit: None,
            place: question.place(),
            statement: "A covered pixel can have its centre outside the triangle. The plane goes on there, so the \
                        depth can leave its range by more than any number of guard bits holds (U-4)."
                .to_owned(),
            error: None,
            bits: None,
            given: Some(depth.guard),
            sufficient: false,
            bound: "none: the distance beyond the triangle, as a part of its own size, has no limit".to_owned(),
            clause: "CR-8",
            formal: Formal::default(),
            witness: None,
        }),
    }
    proofs.extend(slope::proof(question));
    proofs
}
