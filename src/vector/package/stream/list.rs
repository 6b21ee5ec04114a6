//! The streams of a set, and the devices behind them.

use super::Stream;
use super::answer::Answer;
use crate::format::Role;
use crate::machine::{QuadDevice, RegisterDevice, WiredDevice};
use crate::vector::package::record::{Field, Record};
use crate::vector::package::rtl::{self, Source, Values};
use crate::vector::package::{
    EngineParameters, Interface, SetupParameters, UnitDevice, unit, wired,
};

/// What the summary's events look at is wider than any word of the engine: they are not compared.
const EVENTS: [Role; 4] = [Role::WRAP, Role::CLAMP_ABOVE, Role::CLAMP_BELOW, Role::INEXACT];

/// Names of columns of three vertices or edges.
fn three(roles: [Role; 3]) -> Vec<String> {
    (0..3).flat_map(|k| roles.map(|role| role.name(k))).collect()
}

/// Names of columns.
fn names(roles: &[Role]) -> Vec<String> {
    roles.iter().map(|role| role.name(0)).collect()
}

/// The streams that the set has all files for, and whose device this crate has.
pub(in crate::vector::package) fn streams<'a>(
    interface: &Interface,
    records: &'a [Record<'a>],
) -> Vec<Stream<'a>> {
    let clamp = Values::of_clamp(&interface.clamp);
    let setup = interface.setup.as_ref().ok().and_then(|known| setup(records, &clamp, known));
    let engine = interface.engine.as_ref().ok().and_then(|known| engine(records, &clamp, *known));
    let registers = interface.registers.as_ref().ok().and_then(|known| match known {
        RegisterDevice::Quads(known) => quads(records, known),
        RegisterDevice::Wired(device) => wired_stream(records, device),
    });
    let units = interface.units.iter().filter(|unit| unit.module != unit::INTERPOLATOR);
    let units = units.filter_map(|unit| unit_stream(records, unit));
    setup.into_iter().chain(engine).chain(registers).chain(units).collect()
}

/// The stream of a unit of channels: the columns are those of its files.
fn unit_stream<'a>(records: &'a [Record<'a>], unit: &UnitDevice) -> Option<Stream<'a>> {
    let exp = format!("{}.exp", unit.bench);
    let inputs = columns(records, &format!("{}.cfg", unit.bench))?;
    let answers = [(exp.as_str(), "o_", 0, columns(records, &exp)?)];
    stream(records, &unit.bench, (&unit.device(), &[]), &inputs, &answers)
}

/// The names of the columns of a file.
fn columns(records: &[Record], stem: &str) -> Option<Vec<String>> {
    let record = records.iter().find(|record| record.file.name == format!("{stem}.tv"))?;
    Some(record.fields.iter().map(|field| field.column.name.clone()).collect())
}

/// Set-up words of edge functions and a depth plane.
fn words() -> Vec<String> {
    let plane = [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY, Role::ZERO_AREA];
    [three([Role::EDGE_INIT, Role::EDGE_DX, Role::EDGE_DY]), names(&plane)].concat()
}

/// The stream of the set-up.
fn setup<'a>(
    records: &'a [Record<'a>],
    clamp: &Values,
    known: &SetupParameters,
) -> Option<Stream<'a>> {
    let vertices = three([Role::VERTEX_X, Role::VERTEX_Y, Role::VERTEX_Z]);
    let answers = [("setup.exp", "o_", 0, words())];
    let mut stream = stream(records, "setup", SETUP, &vertices, &answers)?;
    stream.values = clamp.clone().and_setup(known);
    stream.entities = SETUP_VHDL;
    stream.width("VW", &Role::VERTEX_X)?;
    stream.width("M", &Role::EDGE_INIT)?;
    let x = stream.column(&Role::VERTEX_X)?;
    stream.of_files.push(("VS", format!("{x}_SIGNED")));
    Some(stream)
}

/// The stream of the engine.
fn engine<'a>(
    records: &'a [Record<'a>],
    clamp: &Values,
    known: EngineParameters,
) -> Option<Stream<'a>> {
    let sides = [Role::BOX_Y_BEGIN, Role::BOX_Y_END, Role::BOX_X_BEGIN, Role::BOX_X_END];
    let inputs = [names(&[Role::TEST]), words(), names(&sides)].concat();
    let summary =
        [&[Role::TEST, Role::SPANS, Role::SAMPLES][..], &EVENTS, &[Role::ZERO_AREA]].concat();
    let answers = [
        ("span.exp", "span_", 4, names(&[Role::TEST, Role::Y, Role::X_BEGIN, Role::X_END])),
        ("depth.exp", "sample_", 3, names(&[Role::TEST, Role::Y, Role::X, Role::DEPTH])),
        ("triangle.exp", "triangle_", 1, names(&summary)),
    ];
    let mut stream = stream(records, "triangle", ENGINE, &inputs, &answers)?;
    stream.values = clamp.clone();
    stream.entities = ENGINE_VHDL;
    stream.any_order = known.any_order;
    stream.width("C", &Role::BOX_X_BEGIN)?;
    stream.width("M", &Role::EDGE_INIT)?;
    Some(stream)
}

/// The stream of an engine of given edge functions.
fn quads<'a>(records: &'a [Record<'a>], known: &QuadDevice) -> Option<Stream<'a>> {
    let list = |names: &str| names.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let inputs = list("test tile_x tile_y x_min x_max y_min y_max a0 b0 c0 a1 b1 c1 a2 b2 c2");
    let places = (0..3).flat_map(|k| (0..4).map(move |place| format!("e{k}_{place}")));
    let outputs = list("test x y mask").into_iter().chain(places).collect();
    let answers = [("words-q.exp", "q_", 0, outputs)];
    let mut stream = stream(records, "words", QUADS, &inputs, &answers)?;
    stream.values = Values::of_quads(known);
    stream.of_files.push(("C", "QUAD_COORDINATE_BITS".to_owned()));
    Some(stream)
}

/// The stream of a device that is wired for a built-in profile: the columns are those of its words.
fn wired_stream<'a>(records: &'a [Record<'a>], device: &WiredDevice) -> Option<Stream<'a>> {
    let columns = |stem: &str| columns(records, stem);
    let kinds = [("words-s.exp", "span_"), ("words-p.exp", "p_")];
    let answers = kinds.map(|(stem, prefix)| Some((stem, prefix, 0, columns(stem)?)));
    let answers: Vec<Wanted<'_>> = answers.into_iter().flatten().collect();
    let mut stream =
        stream(records, "words", wired::device(device.engine), &columns("words.cfg")?, &answers)?;
    stream.values = Values::listed(&device.values);
    // Without a register for the sign of the long side, its word is named after the step alone.
    stream.renamed =
        Some(("long_sign_xh_step", "xh_step")).filter(|(_, new)| stream.cfg.field(new).is_some());
    Some(stream)
}

/// A device of `hdl` behind streams, and the modules that it is made of, itself last.
type Device<'n> = (&'n str, &'static [&'static Source]);

const SETUP: Device<'static> = ("triangle_setup", &[&rtl::SETUP_DIVIDER, &rtl::TRIANGLE_SETUP]);
/// The same in VHDL.
const SETUP_VHDL: &[&Source] = &[&rtl::SETUP_DIVIDER_VHDL, &rtl::TRIANGLE_SETUP_VHDL];
const ENGINE_VHDL: &[&Source] = &[&rtl::DDA_VHDL, &rtl::TRIANGLE_ENGINE_VHDL];
const ENGINE: Device<'static> = (
    "triangle_engine",
    &[
        &rtl::DDA,
        &rtl::EDGE_STEPPER,
        &rtl::EDGE_EVALUATOR,
        &rtl::DEPTH_EVALUATOR,
        &rtl::TRIANGLE_ENGINE,
    ],
);

const QUADS: Device<'static> = ("quad_engine", &[&rtl::QUAD_ENGINE]);

/// A file that a device answers: its stem, what the names of the ports begin with, how many columns are
/// its key, its columns.
type Wanted<'n> = (&'n str, &'static str, usize, Vec<String>);

/// The stream of that name, if the set has its files with just these columns.
fn stream<'a>(
    records: &'a [Record<'a>],
    name: &str,
    (device, parts): Device<'_>,
    inputs: &[String],
    answers: &[Wanted<'_>],
) -> Option<Stream<'a>> {
    let find = |stem: &str, columns: &[String]| {
        let record = records.iter().find(|record| record.file.name == format!("{stem}.tv"))?;
        let same = record.fields.iter().map(|field| &field.column.name).eq(columns);
        (same && record.file.rows > 0).then_some(record)
    };
    let cfg = find(&format!("{name}.cfg"), inputs)?;
    let answers = answers.iter().map(|(stem, prefix, key, columns)| {
        let exp = find(stem, columns)?;
        let skipped = |field: &Field| EVENTS.iter().any(|role| role.pattern == field.column.name);
        let fields = exp.fields.iter().map(|field| (field, !skipped(field))).collect();
        Some(Answer { prefix, exp, key: *key, fields })
    });
    let answers: Vec<Answer> = answers.collect::<Option<_>>()?;
    let (values, of_files) = (Values::default(), Vec::new());
    let (any_order, renamed) = (false, None);
    Some(Stream {
        name: name.to_owned(),
        device: device.to_owned(),
        parts,
        entities: &[],
        values,
        of_files,
        any_order,
        renamed,
        cfg,
        answers,
    })
}
