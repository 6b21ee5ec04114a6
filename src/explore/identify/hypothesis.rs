//! Rasterizers that may be behind captures: the decisions of a profile, each with the values it may have.
//! Spec clauses `ID-1` and `ID-3`.

use crate::bits::Rounding;
use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule, SampleConfig, SampleGrid};
use crate::explore::field::{Field, Value};
use crate::explore::space::Axis;
use crate::model::Model;
use crate::profile::{Profile, neighbours};
use crate::setup::{CullConfig, Division, Winding};
use crate::value::{DepthConfig, StartBias};
use std::collections::BTreeSet;

/// Parts of a pixel at which samples are tried, on each axis, where they are on the grid of the vertices.
const PARTS: u32 = 8;
/// Other places `[x, y, of]` that real rasterizers have, on the grid or not.
const PLACES: [[u32; 3]; 3] = [[7, 7, 12], [7, 7, 16], [9, 9, 16]];
/// The most sub-pixel bits that are tried.
const MOST_SUB_PIXEL: u32 = 12;
/// The fewest bits of an edge word that are tried.
const LEAST_WIDTH: u32 = 12;
/// The most interpolation bits of depth that are tried.
const MOST_INTERPOLATION: u32 = 24;
/// Bits of a reciprocal that are tried.
const RECIPROCALS: std::ops::RangeInclusive<u32> = 8..=24;

/// Rasterizers that differ in nothing but their edge words, and in depth.
#[derive(Debug)]
pub(super) struct Root {
    /// The decisions, in words.
    pub(super) fields: Vec<(String, String)>,
    /// Whether it is one of the hypotheses. Others are told apart from them, so that a machine beside the
    /// space is not taken for one in it.
    pub(super) inside: bool,
    /// The machine without depth, with edge words that hold every value.
    pub(super) model: Model,
    /// The edge words that it may have; none where it has no such words.
    pub(super) words: Vec<EdgeWordConfig>,
}

/// What is varied.
#[derive(Clone, Debug)]
pub struct Hypotheses {
    base: Profile,
    axes: Vec<Axis>,
    changes: Option<u32>,
    culling: bool,
}

impl Hypotheses {
    /// Rasterizers of a base profile's machine in a window: sub-pixel bits, snapping, sample position, fill
    /// rule, storage and width of edge words, the words of depth if it has depth, and the axes given, which
    /// replace those of the same field.
    pub fn of(base: Profile, axes: Vec<Axis>) -> Self {
        Self { base, axes, changes: None, culling: false }
    }

    /// A base profile, and everything that differs from it in at most so many decisions of its machine: for
    /// machines that begin at registers.
    pub fn near(base: Profile, changes: u32) -> Self {
        Self { base, axes: Vec::new(), changes: Some(changes), culling: false }
    }

    /// Machines that leave out triangles of one winding, too.
    #[must_use]
    pub fn with_culling(self) -> Self {
        Self { culling: true, ..self }
    }

    /// The profile that is varied.
    pub const fn base(&self) -> &Profile {
        &self.base
    }

    /// The first field of the axes that is not varied here: guard, integer, clamp and format of depth are the base's.
    pub fn unfit(&self) -> Option<Field> {
        let bare = Profile { depth: None, ..self.base.clone() };
        let fits = |field: Field| {
            field == Field::FORM || OWN.contains(&field.name()) || field.read(&bare).is_some()
        };
        self.axes.iter().map(|axis| axis.field).find(|field| !fits(*field))
    }

    fn axis(&self, name: &str) -> Option<&Axis> {
        self.axes.iter().find(|axis| axis.field.name() == name)
    }

    /// Whether a field may have a value.
    fn allows(&self, name: &str, value: &Value) -> bool {
        self.axis(name).is_none_or(|axis| axis.values.contains(value))
    }

    fn numbers(&self, name: &str, all: impl Iterator<Item = u32>) -> Vec<u32> {
        match self.axis(name) {
            Some(axis) => axis.values.iter().filter_map(Value::bits).collect(),
            None => all.collect(),
        }
    }

    fn roundings(&self, name: &str) -> Vec<Rounding> {
        let allowed =
            |rounding: &Rounding| self.allows(name, &Value::Name(rounding.names().guardbit));
        Rounding::ALL.into_iter().filter(allowed).collect()
    }

    /// Every machine that is thought of, without depth.
    pub(super) fn roots(&self) -> Vec<Root> {
        let base = Profile {
            depth: None,
            channel: Vec::new(),
            w: None,
            multisample: None,
            ..self.base.clone()
        };
        if let Some(changes) = self.changes {
            let near = near(&base, changes).into_iter();
            return near.filter_map(root).collect();
        }
        let mut profiles = vec![(Vec::new(), base)];
        // The machine is chosen first: which other fields there are depends on it.
        let mut own: Vec<&Axis> =
            self.axes.iter().filter(|axis| !OWN.contains(&axis.field.name())).collect();
        own.sort_by_key(|axis| axis.field != Field::FORM);
        for axis in own {
            profiles = product(profiles, &axis.values, |value, profile| {
                axis.field
                    .write(profile, value)
                    .is_ok()
                    .then(|| (axis.field.name().to_owned(), value.to_string()))
            });
        }
        let asked = self.numbers("sub-pixel", 0..=MOST_SUB_PIXEL);
        let mut sub_pixels: Vec<u32> = (0..=MOST_SUB_PIXEL).collect();
        sub_pixels.extend(asked.iter().filter(|bits| **bits > MOST_SUB_PIXEL));
        profiles = product(profiles, &sub_pixels, |bits, profile| {
            // The sample is placed below.
            profile.sample = None;
            profile.vertex.sub_pixel = *bits;
            profile.vertex.lattice = None;
            Some(("sub-pixel".to_owned(), bits.to_string()))
        });
        profiles = product(profiles, &Rounding::ALL, |snap, profile| {
            profile.vertex.snap = *snap;
            Some(("snap".to_owned(), snap.to_string()))
        });
        profiles = product(profiles, &Self::samples(), |[x, y, of], profile| {
            let grid = SampleGrid::among([*x, *y], *of, profile.vertex.sub_pixel);
            profile.sample = Some(if grid.is_on_the_grid() {
                let [x, y] = grid.offset.map(|place| u32::try_from(place).ok());
                SampleConfig::sub_pixels(x?, y?)
            } else if *of == PARTS {
                return None;
            } else {
                SampleConfig { x: *x, y: *y, of: Some(*of) }
            });
            let [x, y] = [x, y].map(|part| self::part(*part, *of));
            Some(("sample".to_owned(), format!("({x}, {y}) of a pixel")))
        });
        let with_edges = profiles.iter().any(|(_, profile)| profile.form.edge().is_some());
        if with_edges {
            profiles = product(profiles, &FillRule::ALL, |rule, profile| {
                match profile.form.edge_mut() {
                    Some(edge) => edge.rule = *rule,
                    // A machine without edge words has its own rule: one of the two is enough.
                    None if *rule == FillRule::ALL[0] => {}
                    None => return None,
                }
                let name = match rule {
                    FillRule::TopLeft => "top-left",
                    FillRule::Shadow => "shadow",
                };
                Some(("rule".to_owned(), name.to_owned()))
            });
        }
        if self.culling {
            let windings = [None].into_iter().chain(Winding::ALL.map(Some));
            let windings: Vec<Option<Winding>> = windings.collect();
            profiles = product(profiles, &windings, |winding, profile| {
                let largest = profile.cull.and_then(|cull| cull.largest);
                let cull = CullConfig { winding: *winding, largest };
                profile.cull = (cull != CullConfig::default()).then_some(cull);
                let name = winding.map_or("none".to_owned(), |winding| winding.to_string());
                Some(("culled winding".to_owned(), name))
            });
        }
        let snaps = self.roundings("snap");
        let mut roots: Vec<Root> = profiles.into_iter().filter_map(root).collect();
        for root in &mut roots {
            let vertex = root.model.profile().vertex;
            root.inside = asked.contains(&vertex.sub_pixel) && snaps.contains(&vertex.snap);
            let exact = root.words.last().map(|words| words.width);
            let allowed = |words: &EdgeWordConfig| {
                self.allows("edge-width", &Value::Bits(words.width))
                    || Some(words.width) == exact
                        && self.allows("edge-width", &Value::Name("exact"))
            };
            let asked: Vec<EdgeWordConfig> =
                root.words.iter().copied().filter(|words| allowed(words)).collect();
            // One whose words are all others stays beside the space.
            if asked.is_empty() {
                root.inside &= root.words.is_empty();
            } else {
                root.words = asked;
            }
        }
        roots
    }

    /// The sample positions `[x, y, of]` that are tried; that of a base profile that places its sample elsewhere
    /// is not among them.
    fn samples() -> Vec<[u32; 3]> {
        let all = 0..PARTS;
        let eighths = all.clone().flat_map(|y| all.clone().map(move |x| [x, y, PARTS]));
        eighths.chain(PLACES).collect()
    }

    /// The words of depth that are thought of; none where the base has no depth.
    pub(super) fn depths(&self) -> Vec<DepthConfig> {
        let Some(base) = self.base.depth else { return Vec::new() };
        // A field that an axis names has its values, whatever the usual ones are.
        let reciprocals = self.numbers("reciprocal", RECIPROCALS).into_iter();
        let quotient = self.allows("reciprocal", &Value::Name("quotient"));
        let divisions = quotient.then_some(Division::Quotient).into_iter();
        let divisions: Vec<Division> =
            divisions.chain(reciprocals.map(|bits| Division::Reciprocal { bits })).collect();
        let mut depths = Vec::new();
        for division in divisions {
            for interpolation in self.numbers("interpolation", 0..=MOST_INTERPOLATION) {
                for rounding in self.roundings("rounding") {
                    for (start_bias, name) in [(StartBias::None, "none"), (StartBias::Half, "half")]
                    {
                        // Without a fraction there is no half.
                        let can_be = interpolation > 0 || start_bias == StartBias::None;
                        if can_be && self.allows("start-bias", &Value::Name(name)) {
                            depths.push(DepthConfig {
                                interpolation,
                                rounding,
                                division,
                                start_bias,
                                ..base
                            });
                        }
                    }
                }
            }
        }
        depths
    }
}

/// Fields that this room varies in its own way.
const OWN: [&str; 7] =
    ["sub-pixel", "snap", "edge-width", "interpolation", "rounding", "start-bias", "reciprocal"];

type Described = (Vec<(String, String)>, Profile);

/// Each profile with each value that it takes.
fn product<T>(
    profiles: Vec<Described>,
    values: &[T],
    set: impl Fn(&T, &mut Profile) -> Option<(String, String)>,
) -> Vec<Described> {
    let mut all = Vec::with_capacity(profiles.len() * values.len());
    for (fields, profile) in profiles {
        for value in values {
            let mut changed = profile.clone();
            if let Some(field) = set(value, &mut changed) {
                all.push((fields.iter().cloned().chain([field]).collect(), changed));
            }
        }
    }
    all
}

/// A profile and its neighbours, and theirs.
fn near(base: &Profile, changes: u32) -> Vec<Described> {
    let named = |changes: &[String]| {
        let text = if changes.is_empty() { "none".to_owned() } else { changes.join("; ") };
        vec![("changes".to_owned(), text)]
    };
    let mut seen = BTreeSet::from([base.to_toml()]);
    let mut all = vec![(named(&[]), base.clone())];
    let mut last = vec![(Vec::new(), base.clone())];
    for _ in 0..changes {
        let mut next = Vec::new();
        for (before, profile) in &last {
            for neighbour in neighbours(profile) {
                if seen.insert(neighbour.profile.to_toml()) {
                    let mut changes: Vec<String> = before.clone();
                    changes.push(neighbour.change);
                    all.push((named(&changes), neighbour.profile.clone()));
                    next.push((changes, neighbour.profile));
                }
            }
        }
        last = next;
    }
    all
}

/// A profile, ready to draw; none where it is not valid.
fn root((fields, mut profile): Described) -> Option<Root> {
    let mut words = Vec::new();
    if let Some(own) = profile.form.edge().copied() {
        for storage in [EdgeStorage::Shifted, EdgeStorage::Full] {
            profile.form.edge_mut()?.storage = storage;
            // Words that are wider draw the same.
            let widest = profile.exact_edge_width()?.min(120);
            let width = |width| EdgeWordConfig { storage, width, ..own };
            words.extend((LEAST_WIDTH.min(widest)..=widest).map(width));
        }
        // The last is full and holds every value.
        *profile.form.edge_mut()? = *words.last()?;
    }
    let model = Model::new(&profile).ok()?;
    Some(Root { fields, inside: true, model, words })
}

/// A part of a pixel, as people write it: of eighths in lowest terms.
fn part(part: u32, of: u32) -> String {
    if part == 0 {
        return "0".to_owned();
    }
    let twos = part.trailing_zeros().min(of.trailing_zeros());
    format!("{}/{}", part >> twos, of >> twos)
}

impl Root {
    /// The profile with some edge words.
    pub(super) fn profile(
        &self,
        words: Option<EdgeWordConfig>,
        depth: Option<DepthConfig>,
    ) -> Profile {
        let mut profile = Profile { depth, ..self.model.profile().clone() };
        if let (Some(own), Some(words)) = (profile.form.edge_mut(), words) {
            own.storage = words.storage;
            own.width = words.width;
        }
        profile
    }
}
