//! The live model for Python. What each thing is, is in `guardbit/__init__.pyi`.

use guardbit::dda::Op;
use guardbit::model::{Drawing, Records};
use guardbit::profile;
use guardbit::scene;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A refusal as Python's ValueError.
fn refuse(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pyclass(frozen)]
struct Model(guardbit::model::Model);

/// What drawing a triangle gave.
#[pyclass(frozen, get_all, name = "Drawing")]
struct Answer {
    rows: Vec<(u32, u32, u32)>,
    z: Vec<u64>,
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

    fn draw(&self, vertices: [[i64; 3]; 3]) -> PyResult<Answer> {
        let xy = vertices.map(|[x, y, _]| [i128::from(x), i128::from(y)]);
        let z = Some(vertices.map(|[.., z]| i128::from(z)));
        let triangle = self.0.snap(&scene::Triangle::Lattice { xy, z }).map_err(refuse)?;
        let mut drawing = Drawing::default();
        self.0.draw(&triangle, &mut drawing).map_err(refuse)?;
        let setup = self.0.ports().setup.iter().zip(&drawing.setup).map(|(column, word)| {
            let mask = u128::MAX >> (128 - column.width);
            (column.name.clone(), word.cast_unsigned() & mask)
        });
        Ok(Answer {
            rows: drawing.spans.iter().map(|span| (span.y, span.x0, span.x1)).collect(),
            setup: setup.collect(),
            z: drawing.depth,
            zero_area: drawing.zero_area,
        })
    }

    fn words(&self, words: Vec<u32>) -> PyResult<Vec<(char, Vec<u32>)>> {
        let registers = self.0.registers();
        let registers = registers
            .ok_or_else(|| refuse("this profile's machine draws primitives, not registers"))?;
        let mut records = Records::up_to(Records::MOST);
        self.0.draw_words(&words, &mut records).map_err(refuse)?;
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
