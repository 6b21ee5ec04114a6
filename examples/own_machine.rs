//! A rasterizer of your own, and the whole command around it.
//!
//! The machine is `conservative`: it covers every pixel whose box touches the triangle, not only those whose
//! centre lies inside, with a box of 2^-margin pixels on a side. The command knows it beside the built-in
//! machines:
//!
//! ```text
//! cargo run --example own_machine -- profile show sgi-4k --machine conservative > own.toml
//! cargo run --example own_machine -- vectors own.toml --out set --size smoke
//! cargo run --example own_machine -- verify set --recompute
//! cargo run --example own_machine -- compare --scene fan --machines conservative,scanline
//! cargo run --example own_machine -- explore own.toml --scene fan --vary margin=0..4
//! ```

use guardbit::cover::FillRule;
use guardbit::exact::{PlaneNumerator, Rational};
use guardbit::format::{Decision, Level, Refused, Role, Unreduced, Value, WordFormat};
use guardbit::machine::{
    Count, Datapath, DrawError, Face, Form, FormError, Input, Intake, Kind, Machine, Operations,
    Own, Painter, Polygons, Ports, RasterState, Rasterizer, Sink, Site, Step, Steps, Target, Unit,
    Word, Work, drawable, near, plane_bound,
};
use guardbit::setup::{EdgeCoefficients, edges};
use guardbit::value::Depth;
use serde::{Deserialize, Serialize};

static KIND: Kind = Kind {
    name: "conservative",
    known_as: "an example",
    clause: "examples/own_machine.rs",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: &[Decision::bits("margin", Level::Coverage, "examples/own_machine.rs", [0, 16])],
    adopt: |_, _| Some(Form::own(Conservative { margin: 0 })),
};

/// The table `[form.conservative]` of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Conservative {
    /// The box of a pixel has 2^-margin pixels on a side.
    margin: u32,
}

/// The machine, ready to draw.
#[derive(Debug)]
struct Boxes {
    /// Half the side of the box, in sub-pixels.
    half: i128,
    depth: Option<Depth>,
    target: Target,
    ports: Ports,
}

impl Machine for Boxes {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(input.triangle()?, out) else { return Ok(()) };
        let edges = edges(&triangle);
        let mut painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        // E counts sub-pixels squared, its steps sub-pixels.
        let s = self.target.grid.sub_pixel;
        let words = edges.iter().flat_map(|edge| {
            [(edge.c, 2 * s), (edge.a, s), (edge.b, s)].map(|(raw, s)| Unreduced::new(raw, s))
        });
        painter.announce(|| words.collect(), out);
        let [x0, y0, x1, y1] = self.target.bounds(&triangle);
        for y in y0..y1 {
            let covers = |x: u32| {
                let [px, py] = self.target.grid.position(x.into(), y.into());
                // The highest value over the box is at one of its corners.
                let reach = |e: &EdgeCoefficients| (e.a.abs() + e.b.abs()) * self.half;
                edges.iter().all(|edge| edge.at(px, py) + reach(edge) >= 0)
            };
            let mut x = x0;
            while let Some(start) = (x..x1).find(|x| covers(*x)) {
                x = (start..x1).find(|x| !covers(*x)).unwrap_or(x1);
                painter.span(y, start, x, out)?;
            }
        }
        let (rows, visits) = (u64::from(y1 - y0), u64::from(y1 - y0) * u64::from(x1 - x0));
        out.work(&Work { rows, visits, steps: visits, tiles: 0 });
        Ok(())
    }
}

impl Rasterizer for Conservative {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, _: &RasterState) -> Result<(), FormError> {
        let message = || format!("margin = {} <= 16 is needed", self.margin);
        if self.margin <= 16 { Ok(()) } else { Err(FormError::own(&KIND, &["margin"], message())) }
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let (s, whole) = (state.vertex.sub_pixel, 2 * state.vertex.difference_bits() + 2);
        let column =
            |role: Role, k, fraction| role.of(k, WordFormat::signed(whole).fraction(fraction));
        let of = |k| {
            [(Role::EDGE_INIT, 2 * s), (Role::EDGE_DX, s), (Role::EDGE_DY, s)]
                .map(|(role, fraction)| column(role, k, fraction))
        };
        let ports = Ports::triangle(&state.vertex, (0..3).flat_map(of).collect(), site.depth);
        let half = (1 << s) >> (self.margin + 1);
        Ok(Box::new(Boxes { half, depth: site.depth, target: site.target, ports }))
    }

    fn rule(&self) -> FillRule {
        FillRule::TopLeft
    }

    fn covers_exactly(&self, _: &RasterState) -> bool {
        false
    }

    fn walks_a_plane(&self) -> bool {
        true
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        vec![Word::exact_edge(2 * state.vertex.difference_bits() + 2)]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        let setup_bits = 2 * state.vertex.difference_bits() + 2;
        let mut units = vec![Unit::planar("edge", setup_bits).times(3)];
        units.extend(state.depth.as_ref().map(Unit::depth));
        let edge = Count::edge_setup(self.rule()) + Count::new(3, 1, 0, 2);
        let coverage = Operations {
            triangle: Count::AREA + Count::bounds() + edge.times(3),
            visit: Count::sample(),
            ..Operations::default()
        };
        let operations = coverage.with_plane(state.depth.as_ref());
        Some(Datapath { units, setup_bits, operations })
    }

    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        _: &PlaneNumerator,
    ) -> Option<Rational> {
        plane_bound(state, face)
    }

    /// No bound of coverage is stated, and `compare` says so.
    fn may_misplace(&self, _: &Face<'_>, _: [i128; 2]) -> Option<bool> {
        None
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Form::own);
        for margin in near(self.margin) {
            steps.add("margin", &margin, &self.margin, |own| own.margin = margin);
        }
        steps.found()
    }

    fn decision(&self, name: &str) -> Option<Value> {
        (name == "margin").then_some(Value::Bits(self.margin))
    }

    fn decide(&mut self, name: &str, value: &Value, _: &RasterState) -> Result<(), Refused> {
        if name != "margin" {
            return Err(Refused::Absent);
        }
        self.margin = Refused::unless(value.bits())?;
        Ok(())
    }
}

fn main() -> std::process::ExitCode {
    guardbit::cli::main(&[Own::of::<Conservative>(&KIND)])
}
