//! The machine `edge-walk` as a profile configures it, and what walked edges share. Spec clauses `K-1` to
//! `K-5`.

use super::{EdgeWalk, EdgeWalkConfig};
use crate::bits::Rounding;
use crate::cover::FillRule;
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{Clamp, Decision, Level, Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, Face, FormError, Intake, Kind, Machine, Operations, Polygons,
    RasterState, Rasterizer, Site, Step, Steps, Unit, Word, corners, edge_words, near, plane_bound,
    signed_bits, steps_below_half,
};
use crate::setup::{rounding, roundings};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "edge-walk",
    known_as: "VGX",
    clause: "K-1",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: EdgeWalkConfig::DECISIONS,
    adopt: |from, state| Some(EdgeWalkConfig::adopted(from, state).into()),
};

/// What a walked x may stand for.
const CLAMPS: [Clamp; 4] = [Clamp::Guard, Clamp::Sign, Clamp::Wrap, Clamp::Error];

fn clamps() -> Vec<&'static str> {
    CLAMPS.map(Clamp::name).to_vec()
}

impl EdgeWalkConfig {
    /// Fraction bits of x.
    pub const FRACTION: Decision =
        Decision::bits("walk-fraction", Level::Coverage, "K-1", [0, 119]);
    /// Integer bits of x.
    pub const INTEGER: Decision = Decision::bits("walk-integer", Level::Coverage, "K-1", [1, 64]);
    /// Guard bits of x.
    pub const GUARD: Decision = Decision::bits("walk-guard", Level::Coverage, "K-1", [0, 119]);
    /// Rounding of start and slope.
    pub const ROUNDING: Decision =
        Decision::words("walk-rounding", Level::Coverage, "K-3", roundings);
    /// What a word stands for.
    pub const CLAMP: Decision = Decision::words("walk-clamp", Level::Coverage, "K-3", clamps);
    /// Its decisions that a search may vary.
    pub const DECISIONS: &[Decision] =
        &[Self::FRACTION, Self::INTEGER, Self::GUARD, Self::ROUNDING, Self::CLAMP];

    /// The walk of another machine; or one guard bit, the integer bits of the vertex field and as many bits
    /// as an edge word in all.
    pub(in crate::machine) fn adopted(from: &crate::machine::Form, state: &RasterState) -> Self {
        from.walk().copied().unwrap_or_else(|| {
            let (guard, integer) = (1, state.vertex.integer);
            let width = edge_words::adopted(from, state).width;
            let fraction = width.saturating_sub(guard + integer);
            Self { guard, integer, fraction, rounding: Rounding::NearestEven, clamp: Clamp::Guard }
        })
    }

    /// Bits of x.
    pub const fn width(&self) -> u32 {
        self.guard + self.integer + self.fraction
    }

    /// Checks the word of a machine of this kind.
    pub(in crate::machine) fn check_word(
        &self,
        kind: &Kind,
        state: &RasterState,
    ) -> Result<crate::format::ReadOut, FormError> {
        self.validate(&state.vertex).map_err(|error| FormError::own(kind, &[], error))
    }

    /// The word of a budget.
    pub(in crate::machine) fn word(&self, state: &RasterState) -> Word {
        let whole = self.fraction.saturating_sub(state.vertex.sub_pixel);
        let rows = steps_below_half(whole, self.rounding);
        Word::new(
            "edge",
            [("guard", self.guard), ("integer", self.integer), ("fraction", self.fraction)],
            [
                ("range", self.range_text(state)),
                ("resolution", format!("2^-{} pixel", self.fraction)),
                ("rounding", self.rounding.to_string()),
                ("half a sub-pixel", format!("after {rows} rows")),
            ],
        )
    }

    /// The range of x in pixels, and whether it holds the vertex field: an edge lies between its two ends.
    fn range_text(&self, state: &RasterState) -> String {
        let Ok(read) = self.validate(&state.vertex) else { return "none".to_owned() };
        let ((low, limit), (from, to)) = (read.range(), state.vertex.range());
        let pixels = |x: i128, bits: u32| {
            let (whole, part) = (x >> bits, x & ((1 << bits) - 1));
            if part == 0 { whole.to_string() } else { format!("{whole} + {part}/2^{bits}") }
        };
        let (f, s) = (self.fraction, state.vertex.sub_pixel);
        let text = format!("{} <= x < {} pixels", pixels(low, f), pixels(limit, f));
        // Both on a grid that holds both.
        let inside = from << f >= low << s && to << f < limit << s;
        if inside {
            return text;
        }
        let needed = (0..=119u32).find(|guard| {
            let wider = Self { guard: *guard, ..*self }.validate(&state.vertex);
            wider.is_ok_and(|read| {
                let (low, limit) = read.range();
                from << f >= low << s && to << f < limit << s
            })
        });
        let field = format!("{} to {}", pixels(from, s), pixels(to, s));
        let help = match needed {
            Some(guard) => format!("guard = {guard} holds them"),
            None => "no guard bits hold them under this clamp".to_owned(),
        };
        format!("{text}; vertices reach {field}: {help}")
    }

    /// Two of three edges are walked at a time; the third waits in set-up.
    pub(in crate::machine) const fn unit(&self) -> Unit {
        Unit::linear("edge", self.width()).times(2)
    }

    /// The dividend of an edge walk's start: x times the height plus the part of the first row times
    /// the width, over a sub-pixel more, scaled by the fraction.
    pub(in crate::machine) fn setup_bits(&self, state: &RasterState) -> u32 {
        let first_row = [0, (1 << state.vertex.sub_pixel) - 1];
        let dividend = corners::<4>(&state.vertex)
            .flat_map(|[ax, ay, bx, by]| {
                first_row.map(|below| (ax * (by - ay) + below * (bx - ax)).abs())
            })
            .max();
        dividend.map_or(1, signed_bits) + self.fraction
    }

    /// Operations of coverage.
    pub(in crate::machine) fn operations() -> Operations {
        let direction = Count::TEST;
        let differences = Count::new(2, 0, 0, 0);
        // The lower end is left out, so a subtraction before; none left is no edge.
        let rows = Count::new(1, 0, 0, 0) + Count::PIXELS + Count::TEST;
        let below_top = Count::new(2, 0, 0, 0);
        let start_and_slope = Count::new(1, 2, 2, 0);
        let edge = direction + differences + rows + below_top + start_and_slope;
        // Whether the edge crosses the row, its step, the sample's offset taken off.
        let side = Count::TEST.times(2) + Count::STEP + Count::new(1, 0, 0, 0);
        Operations {
            triangle: Count::AREA + Count::EXTENT + Count::PIXELS + Count::CLIP + edge.times(3),
            row: side.times(2) + Count::CLIP + Count::TEST,
            ..Operations::default()
        }
    }

    /// Whether a sample lies nearer to an edge, along its row, than the walked x can be off.
    pub(in crate::machine) fn near_an_edge(&self, face: &Face<'_>, at: [i128; 2]) -> bool {
        let (v, s) = (face.triangle.xy, face.grid.sub_pixel);
        (0..3).any(|k| {
            let (a, b) = (v[k], v[(k + 1) % 3]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let off = ((at[0] - a[0]) * dy - (at[1] - a[1]) * dx).abs();
            let rows = (dy.abs() >> s) + 2;
            off << self.fraction <= (rows * dy.abs()) << s
        })
    }

    /// Changes of the walk.
    pub(in crate::machine) fn steps<C: Clone>(
        &self,
        steps: &mut Steps<'_, C>,
        of: fn(&mut C) -> &mut Self,
    ) {
        for got in Rounding::ALL {
            steps.add("rounding", &got, &self.rounding, |config| of(config).rounding = got);
        }
        for got in near(self.fraction) {
            steps.add("fraction", &got, &self.fraction, |config| of(config).fraction = got);
        }
        // A device cannot refuse: under `error` it answers as under `guard`.
        for got in CLAMPS.into_iter().filter(|clamp| *clamp != Clamp::Error) {
            steps.add("clamp", &got.name(), &self.clamp.name(), |config| of(config).clamp = got);
        }
        for got in near(self.guard) {
            steps.add("guard", &got, &self.guard, |config| of(config).guard = got);
        }
    }

    /// What the decision of this name is set to.
    pub(in crate::machine) fn walk_decision(&self, name: &str) -> Option<Value> {
        Some(match name {
            "walk-fraction" => Value::Bits(self.fraction),
            "walk-integer" => Value::Bits(self.integer),
            "walk-guard" => Value::Bits(self.guard),
            "walk-rounding" => Value::Name(self.rounding.names().guardbit),
            "walk-clamp" => Value::Name(self.clamp.name()),
            _ => return None,
        })
    }

    /// Sets a decision.
    pub(in crate::machine) fn walk_decide(
        &mut self,
        name: &str,
        value: &Value,
    ) -> Result<(), Refused> {
        match name {
            "walk-fraction" => self.fraction = Refused::unless(value.bits())?,
            "walk-integer" => self.integer = Refused::unless(value.bits())?,
            "walk-guard" => self.guard = Refused::unless(value.bits())?,
            "walk-rounding" => self.rounding = rounding(value)?,
            "walk-clamp" => {
                self.clamp = Refused::unless(value.choose(&CLAMPS, Clamp::name))?;
            }
            _ => return Err(Refused::Absent),
        }
        Ok(())
    }
}

impl Rasterizer for EdgeWalkConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        self.check_word(&KIND, state).map(|_| ())
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, .. } = site;
        let word = self.check_word(&KIND, state)?;
        Ok(Box::new(EdgeWalk::new(*self, word, depth, &state.vertex, target)))
    }

    /// A walked edge's left end owns its pixel.
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
        vec![self.word(state)]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        let mut units = vec![self.unit()];
        units.extend(state.depth.as_ref().map(Unit::depth));
        let operations = Self::operations().with_plane(state.depth.as_ref());
        Some(Datapath { units, setup_bits: self.setup_bits(state), operations })
    }

    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        _: &PlaneNumerator,
    ) -> Option<Rational> {
        plane_bound(state, face)
    }

    fn may_misplace(&self, face: &Face<'_>, at: [i128; 2]) -> Option<bool> {
        Some(self.near_an_edge(face, at))
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        EdgeWalkConfig::steps(self, &mut steps, |config| config);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::Anywhere
    }

    fn decision(&self, name: &str) -> Option<Value> {
        self.walk_decision(name)
    }

    fn decide(&mut self, name: &str, value: &Value, _: &RasterState) -> Result<(), Refused> {
        self.walk_decide(name, value)
    }

    fn walk(&self) -> Option<&EdgeWalkConfig> {
        Some(self)
    }

    fn walk_mut(&mut self) -> Option<&mut EdgeWalkConfig> {
        Some(self)
    }
}
