//! What is known about the budgets of one grid.

use super::channel::Channels;
use crate::cover::{EdgeWordConfig, SampleConfig};
use crate::explore::field::Level;
use crate::explore::metric::{Cause, Subject};
use crate::explore::sweep;
use crate::explore::tolerance::{Tolerance, exceeded};
use crate::format::{Clamp, ReadOut};
use crate::measure::accuracy::{Accuracy, Drawn, Reach, Stage, Tally, Values, needed_width};
use crate::profile::{Form, InvalidProfile, Profile, WindowConfig};
use crate::setup::VertexConfig;
use crate::value::{AttributeConfig, DepthConfig};

/// What two profiles share that share a stage.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StageKey {
    vertex: VertexConfig,
    window: WindowConfig,
    sample: Option<SampleConfig>,
    rule: crate::exact::Rule,
    depth_bits: Option<u32>,
    /// The code of 1 of each channel.
    units: Vec<i128>,
}

impl StageKey {
    pub(super) fn new(profile: &Profile) -> Self {
        Self {
            vertex: profile.vertex,
            window: profile.window,
            sample: profile.sample,
            rule: crate::measure::error::exact_rule(&profile.form),
            depth_bits: profile.depth.map(|depth| depth.integer),
            units: profile.channel.iter().map(AttributeConfig::unit).collect(),
        }
    }
}

/// A scene on a grid, and what is known about budgets on it.
pub(super) struct Group {
    pub(super) key: StageKey,
    pub(super) stages: Vec<Stage>,
    /// What snapping did, over all scenes.
    snap: Tally,
    needs: Vec<(EdgeWordConfig, u32)>,
    pub(super) coverages: Vec<Coverage>,
    /// Faces that refuted a budget, the last one first.
    pub(super) hot: Vec<(usize, usize)>,
}

/// A coverage form on a group.
pub(super) struct Coverage {
    form: Form,
    /// What it draws in each scene; `None` when that alone fails.
    pub(super) drawn: Option<Vec<Drawn>>,
    pub(super) tally: Tally,
    /// Samples that depth errors are counted at.
    pub(super) samples: u64,
    pub(super) planes: Vec<Plane>,
    pub(super) channels: Channels,
}

/// A depth budget on a coverage, but for its guard bits.
pub(super) struct Plane {
    config: DepthConfig,
    /// Accumulators seen, on all samples or not.
    pub(super) depth: Reach,
    pub(super) attribute: Reach,
    /// Accumulators that decided an order of surfaces, at samples that were drawn or not.
    pub(super) order: Reach,
    /// The figures of every number of guard bits that holds all accumulators.
    pub(super) whole: Option<Tally>,
}

impl Plane {
    pub(super) fn widen(&mut self, values: &Values) {
        self.depth.widen(values.depth_extent);
        self.attribute.widen(values.attribute_extent);
    }

    /// Whether a read-out tells all accumulators that were seen apart.
    pub(super) fn held_by(&self, read: ReadOut) -> bool {
        [&self.depth, &self.attribute, &self.order].into_iter().all(|r| r.within(read.range()))
    }
}

impl Coverage {
    /// The plane of a depth budget, guard bits left out.
    pub(super) fn plane(&mut self, config: DepthConfig) -> &mut Plane {
        // A sticky accumulator is loaded and stepped by words: its guard bits do count.
        let sticky = config.clamp == Clamp::Saturate;
        let config = DepthConfig { guard: if sticky { config.guard } else { 0 }, ..config };
        let at = self.planes.iter().position(|plane| plane.config == config);
        let at = at.unwrap_or_else(|| {
            let none = Reach::default();
            let plane = Plane { config, depth: none, attribute: none, order: none, whole: None };
            self.planes.push(plane);
            self.planes.len() - 1
        });
        &mut self.planes[at]
    }
}

impl Group {
    pub(super) fn new(key: StageKey, stages: Vec<Stage>) -> Self {
        let mut snap = Tally::default();
        for stage in &stages {
            snap.merge(&stage.snap);
        }
        Self { key, stages, snap, needs: Vec::new(), coverages: Vec::new(), hot: Vec::new() }
    }

    /// The report of an arithmetic tally on this grid.
    pub(super) fn report(&self, arithmetic: &Tally) -> Accuracy {
        sweep::accuracy(&self.stages, &self.snap, arithmetic)
    }

    /// The edge width that holds every word any face needs: from there on all widths are alike.
    fn need(&mut self, edges: EdgeWordConfig) -> u32 {
        let shape = EdgeWordConfig { width: 2, ..edges };
        if let Some((_, need)) = self.needs.iter().find(|(known, _)| *known == shape) {
            return *need;
        }
        let faces = self.stages.iter().flat_map(|s| s.faces.iter().map(move |face| (s, face)));
        let need = faces.map(|(stage, face)| needed_width(stage, face, shape)).max().unwrap_or(2);
        self.needs.push((shape, need));
        need
    }

    /// The coverage of a profile's form: measured once, and not to its end if it fails before.
    pub(super) fn coverage(
        &mut self,
        profile: &Profile,
        tolerances: &[Tolerance],
    ) -> Result<usize, InvalidProfile> {
        let mut profile = profile.clone();
        let boxed = profile.form.visits_the_box() && profile.traversal.is_none();
        if let Some(edges) = profile.form.edge_mut().filter(|_| boxed) {
            // All widths that hold every edge word of the bounding boxes draw the exact picture, on a machine
            // that looks nowhere else.
            edges.width = edges.width.min(self.need(*edges).max(2));
        }
        if let Some(known) = self.coverages.iter().position(|known| known.form == profile.form) {
            return Ok(known);
        }
        let limits = tolerances.iter().filter(|t| {
            (t.metric.cause, t.metric.subject) == (Cause::Arithmetic, Subject::Misclassified)
        });
        let limit = limits.map(|t| t.limit).fold(f64::INFINITY, f64::min);
        let (mut tally, mut all) = (Tally::default(), Vec::with_capacity(self.stages.len()));
        for stage in &self.stages {
            let before = tally.missing + tally.extra;
            let drawn = Drawn::until(stage, &profile, &mut |_, so_far| {
                #[allow(clippy::cast_precision_loss, reason = "compared with a limit")]
                let wrong = (before + so_far.missing + so_far.extra) as f64;
                wrong <= limit
            })?;
            let Ok(drawn) = drawn else { break };
            tally.merge(&drawn.tally);
            all.push(drawn);
        }
        let whole = all.len() == self.stages.len();
        let good = whole && exceeded(tolerances, &self.report(&tally), Level::Coverage).is_none();
        let samples = all.iter().zip(&self.stages).map(|(d, stage)| d.depth_samples(stage)).sum();
        let (form, drawn, channels) = (profile.form, good.then_some(all), Channels::default());
        self.coverages.push(Coverage { form, drawn, tally, samples, planes: Vec::new(), channels });
        Ok(self.coverages.len() - 1)
    }
}
