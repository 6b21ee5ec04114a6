//! The live model for Python. What each thing is, is in `guardbit/__init__.pyi`.

use guardbit::dda::Op;
use guardbit::model::{Drawing, Records};
use guardbit::profile;
use guardbit::scene::{self, Named, Primitive, Shading};
use guardbit::setup::{ClipTriangle, Polygon};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use std::collections::BTreeMap;

/// A refusal as Python's ValueError.
fn refuse(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// x, y of three vertices and, of all or none, z.
fn triangle<T: Copy>(
    name: &str,
    vertices: &[Vec<T>],
    has_depth: bool,
    make: fn([[T; 2]; 3], Option<[T; 3]>) -> scene::Triangle,
) -> PyResult<Primitive> {
    let wrong = || refuse(format!("{name}: x, y or x, y, z of three vertices are needed"));
    let [a, b, c] = vertices else { return Err(wrong()) };
    let (xy, z) = match (a.as_slice(), b.as_slice(), c.as_slice()) {
        ([x0, y0], [x1, y1], [x2, y2]) => ([[*x0, *y0], [*x1, *y1], [*x2, *y2]], None),
        ([x0, y0, z0], [x1, y1, z1], [x2, y2, z2]) => {
            ([[*x0, *y0], [*x1, *y1], [*x2, *y2]], Some([*z0, *z1, *z2]))
        }
        _ => return Err(wrong()),
    };
    Ok(Primitive::Triangle(make(xy, z.filter(|_| has_depth))))
}

fn integers(xy: [[i128; 2]; 3], z: Option<[i128; 3]>) -> scene::Triangle {
    scene::Triangle::Lattice { xy, z }
}

fn reals(xy: [[f64; 2]; 3], z: Option<[f64; 3]>) -> scene::Triangle {
    scene::Triangle::Real { xy, z }
}

fn polygon(vertices: &[Vec<i128>]) -> PyResult<Primitive> {
    let size = vertices.first().map_or(0, Vec::len);
    let alike = vertices.iter().all(|vertex| vertex.len() == size);
    if vertices.len() < 3 || !alike || !(2..=3).contains(&size) {
        let text = "polygon: x, y or x, y, z of three or more vertices are needed, alike for all";
        return Err(refuse(text));
    }
    let z = (size == 3).then(|| vertices.iter().map(|vertex| vertex[2]).collect());
    let xy = vertices.iter().map(|vertex| [vertex[0], vertex[1]]).collect();
    Ok(Primitive::Polygon(Polygon { xy, z }))
}

fn clip(vertices: &[Vec<i128>]) -> PyResult<Primitive> {
    let wrong = || refuse("clip: X, Y, W or X, Y, Z, W of three vertices are needed");
    let [a, b, c] = vertices else { return Err(wrong()) };
    let size = a.len();
    if !(3..=4).contains(&size) || b.len() != size || c.len() != size {
        return Err(wrong());
    }
    let xyw = [a, b, c].map(|vertex| [vertex[0], vertex[1], vertex[size - 1]]);
    let z = (size == 4).then(|| [a, b, c].map(|vertex| vertex[2]));
    Ok(Primitive::Clip(ClipTriangle { xyw, z }))
}

/// Values by name, components by vertex as they are given, turned to one list a component.
fn named<T: Copy>(channels: BTreeMap<String, Vec<Vec<T>>>) -> PyResult<Named<T>> {
    let channel = |(name, vertices): (String, Vec<Vec<T>>)| {
        let [a, b, c] = vertices.as_slice() else {
            let got = vertices.len();
            return Err(refuse(format!("channels.{name}: 3 vertices are needed, got {got}")));
        };
        let first = a.len();
        if let Some(n) = vertices.iter().position(|vertex| vertex.len() != first) {
            let got = vertices[n].len();
            return Err(refuse(format!(
                "channels.{name}[{n}]: {got} components, but vertex 0 has {first}; give the same components for all vertices"
            )));
        }
        let components = a.iter().zip(b).zip(c).map(|((a, b), c)| [*a, *b, *c]);
        Ok((name, components.collect()))
    };
    channels.into_iter().map(channel).collect()
}

/// A number for each vertex.
fn three<T: Copy>(name: &str, values: &[T]) -> PyResult<[T; 3]> {
    values.try_into().map_err(|_| {
        let got = values.len();
        refuse(format!("{name}: 3 values are needed, one for each vertex, got {got}"))
    })
}

/// What the vertices bring for channels, if anything: codes beside `vertices`, reals beside `real`.
fn shading(
    key: &str,
    channels: Option<Bound<'_, PyAny>>,
    q: Option<&[i128]>,
    w: Option<&[f64]>,
) -> PyResult<Option<Shading>> {
    let text = match (key, &channels, q, w) {
        (_, None, None, None) => return Ok(None),
        ("vertices", _, _, Some(_)) => {
            "w: beside vertices, give q: it has codes of 1/w, and w has distances from the eye"
        }
        ("real", _, Some(_), _) => {
            "q: beside real, give w: it has distances from the eye, and q has codes of 1/w"
        }
        ("vertices" | "real", None, ..) => {
            "q or w is given, but no channels; give the channels that need it, or leave it out"
        }
        ("vertices" | "real", ..) => "",
        _ => "channels, q, w: only triangles under vertices or real have channels",
    };
    let Some(channels) = channels.filter(|_| text.is_empty()) else { return Err(refuse(text)) };
    // Any mapping will do.
    let given = PyDict::new(channels.py());
    given.update(channels.cast::<PyMapping>()?)?;
    Ok(Some(if key == "vertices" {
        let inverse_w = q.map(|q| three("q", q)).transpose()?;
        Shading::Codes { channels: named(given.extract()?)?, inverse_w }
    } else {
        let w = w.map(|w| three("w", w)).transpose()?;
        Shading::Reals { channels: named(given.extract()?)?, w }
    }))
}

#[pyclass(frozen)]
struct Model(guardbit::model::Model);

/// What drawing a triangle gave.
#[pyclass(frozen, get_all, name = "Drawing")]
struct Answer {
    rows: Vec<(u32, u32, u32)>,
    z: Vec<u64>,
    channels: Py<PyDict>,
    setup: Vec<(String, u128)>,
    zero_area: bool,
}

#[pymethods]
impl Model {
    #[new]
    fn new(name: &str) -> PyResult<Self> {
        let profile = profile::load(name).map_err(refuse)?;
        Ok(Self(guardbit::model::Model::new(&profile).map_err(refuse)?))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.profile().name
    }

    /// Components by the names of the channels.
    #[getter]
    fn channels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let channels = PyDict::new(py);
        for channel in &self.0.profile().channel {
            channels.set_item(&channel.name, &channel.components)?;
        }
        Ok(channels)
    }

    #[pyo3(signature = (
        vertices=None, *, real=None, line=None, point=None, polygon=None, clip=None,
        channels=None, q=None, w=None,
    ))]
    #[expect(clippy::too_many_arguments, reason = "each is a keyword of Python")]
    fn draw(
        &self,
        py: Python<'_>,
        vertices: Option<Vec<Vec<i128>>>,
        real: Option<Vec<Vec<f64>>>,
        line: Option<[[i128; 2]; 2]>,
        point: Option<[i128; 2]>,
        polygon: Option<Vec<Vec<i128>>>,
        clip: Option<Vec<Vec<i128>>>,
        channels: Option<Bound<'_, PyAny>>,
        q: Option<Vec<i128>>,
        w: Option<Vec<f64>>,
    ) -> PyResult<Answer> {
        // Depth of a triangle is ignored without depth, as it always was; elsewhere it is refused.
        let has_depth = self.0.depth().is_some();
        let given = [
            ("vertices", vertices.map(|v| triangle("vertices", &v, has_depth, integers))),
            ("real", real.map(|v| triangle("real", &v, has_depth, reals))),
            ("line", line.map(|ends| Ok(Primitive::Line(ends)))),
            ("point", point.map(|point| Ok(Primitive::Point(point)))),
            ("polygon", polygon.map(|v| self::polygon(&v))),
            ("clip", clip.map(|v| self::clip(&v))),
        ];
        let mut given = given.into_iter().filter_map(|(key, made)| Some((key, made?)));
        let (Some((key, primitive)), None) = (given.next(), given.next()) else {
            let text = "exactly one of vertices, real, line, point, polygon, clip is needed";
            return Err(refuse(text));
        };
        let primitive = self.0.prepare(&primitive?).map_err(refuse)?;
        let shading = shading(key, channels, q.as_deref(), w.as_deref())?;
        let primitive = match &shading {
            Some(shading) => self.0.shade(primitive, shading).map_err(refuse)?,
            None => primitive,
        };
        let mut drawing = Drawing::default();
        self.0.draw(&primitive, &mut drawing).map_err(refuse)?;
        let ports = self.0.ports();
        // A primitive without area, or of a machine that needs no set-up, has no words.
        let words = match drawing.setup.as_slice() {
            [] => Vec::new(),
            values => ports.words(values).map_err(refuse)?,
        };
        let codes = PyDict::new(py);
        for (n, port) in ports.channels.iter().enumerate().filter(|_| shading.is_some()) {
            // A triangle that covers nothing has no codes.
            let held = drawing.channels.get(n).map_or(&[][..], Vec::as_slice);
            let places: Vec<&[i64]> = held.chunks(port.components.len()).collect();
            codes.set_item(&port.name, places)?;
        }
        let names = ports.setup.iter().map(|column| column.name.clone());
        let setup = names.zip(words.into_iter().map(|word| word.to_bits()));
        Ok(Answer {
            rows: drawing.spans.iter().map(|span| (span.y, span.x0, span.x1)).collect(),
            setup: setup.collect(),
            z: drawing.depth,
            channels: codes.unbind(),
            zero_area: drawing.zero_area,
        })
    }

    fn words(&self, words: Vec<u32>) -> PyResult<Vec<(char, Vec<u32>)>> {
        let registers = self.0.registers();
        let registers = registers
            .ok_or_else(|| refuse("this profile's machine draws primitives, not registers"))?;
        let mut records = Records::up_to(Records::MOST);
        self.0.draw(words.as_slice(), &mut records).map_err(refuse)?;
        if !records.is_whole() {
            let (total, most) = (records.total, Records::MOST);
            return Err(refuse(format!(
                "{total} records are drawn, and an answer has at most {most}"
            )));
        }
        let answer = records.kept.iter().map(|(kind, values)| {
            let record = &registers.records[*kind];
            (record.letter, record.words(values).collect())
        });
        Ok(answer.collect())
    }

    fn depth_walk(&self) -> PyResult<Walk> {
        self.0.depth_walk().map(Walk).ok_or_else(|| refuse("this profile has no depth"))
    }

    fn edge_walk(&self) -> PyResult<Walk> {
        self.0.edge_walk().map(Walk).ok_or_else(|| refuse("this profile has no edge words"))
    }

    #[pyo3(signature = (channel=None))]
    fn interpolator_walk(&self, channel: Option<&str>) -> PyResult<Walk> {
        let number = channel.map(|name| self.number(name)).transpose()?;
        self.0.interpolator_walk(number).map(Walk).ok_or_else(|| {
            let what = channel.unwrap_or("1/w");
            refuse(format!("{what} is not walked by start and slopes in this profile"))
        })
    }

    fn divide(&self, channel: &str, acc: i128, acc_w: i128) -> PyResult<i64> {
        let divided = self.0.divide(self.number(channel)?, [acc, acc_w]);
        let divided = divided.ok_or_else(|| refuse(format!("{channel} is not divided by 1/w")))?;
        Ok(divided.code)
    }
}

impl Model {
    /// The number of a channel in the profile.
    fn number(&self, name: &str) -> PyResult<usize> {
        let ports = &self.0.ports().channels;
        ports.iter().position(|port| port.name == name).ok_or_else(|| {
            let names: Vec<&str> = ports.iter().map(|port| &*port.name).collect();
            refuse(format!("no channel {name:?}: the profile has {}", names.join(", ")))
        })
    }
}

#[pyclass]
struct Walk(guardbit::model::Walk);

#[pymethods]
impl Walk {
    #[getter]
    fn width(&self) -> u32 {
        self.0.width()
    }

    fn clock(&mut self, op: u64, init: i128, dx: i128, dy: i128) -> PyResult<(u128, u64)> {
        if op > 3 {
            let text = format!("op = {op}: 0 load, 1 step by dx, 2 step by dy, 3 hold");
            return Err(refuse(text));
        }
        Ok(self.0.clock(Op::from_code(op), [init, dx, dy]))
    }
}

#[pymodule]
fn _guardbit(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Model>()?;
    module.add_class::<Answer>()?;
    module.add_class::<Walk>()
}
