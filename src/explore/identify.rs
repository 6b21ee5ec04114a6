//! Which rasterizers are behind captures of an unknown one: all that agree with every case, exactly. Spec
//! clauses `ID-1` to `ID-6`.

mod agree;
mod case;
mod conflict;
mod deep;
mod hypothesis;
mod narrow;
mod picture;
mod probe;

pub use case::{Answer, Case, CaseError, Pixels, Reading};
pub use hypothesis::Hypotheses;
pub use picture::{Capture, Picture};
pub use probe::{Next, Probe};

use crate::cover::EdgeWordConfig;
use crate::model::Model;
use crate::profile::Profile;
use crate::value::DepthConfig;
use agree::{agrees, flat};
use case::Undone;
use deep::{Deep, depth_agrees};
use hypothesis::Root;
use narrow::Boxed;
use std::collections::BTreeMap;

/// The search for an unknown rasterizer.
#[derive(Debug)]
pub struct Identifier {
    captures: Vec<Capture>,
    /// How many cases may be wrong.
    wrong: u8,
    depths: Vec<DepthConfig>,
    left: Vec<Left>,
    /// Hypotheses at the start: machines with their edge words, and words of depth.
    counts: [u64; 2],
    /// Cases whose depth waits until few machines are left.
    waiting: Vec<Case>,
    /// Cases taken, and those that told of depth.
    taken: [u64; 2],
}

/// Depth is looked at when no more machines are left than this: for each there are thousands of words.
const FEW: usize = 256;

/// A root, and what of it is left.
#[derive(Debug)]
struct Left {
    root: Root,
    /// Cases that failed, by edge words and then capture.
    fails: Vec<u8>,
    /// The same by words of depth.
    depth_fails: Vec<u8>,
}

/// A rasterizer that agrees with the cases.
#[derive(Clone, Debug)]
pub struct Found {
    /// The profile.
    pub profile: Profile,
    /// What the capture did to its pictures.
    pub capture: Capture,
}

/// A decision, and the values that it has among the rasterizers that are left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decided {
    /// The decision.
    pub name: String,
    /// Its values.
    pub values: Vec<String>,
}

impl Identifier {
    /// Everything is possible. Each case can have gone through one of the captures, the same for all cases, and
    /// so many cases can be wrong.
    pub fn new(hypotheses: &Hypotheses, captures: Vec<Capture>, wrong: u8) -> Self {
        let (roots, depths) = (hypotheses.roots(), hypotheses.depths());
        let variants = |root: &Root| root.words.len().max(1);
        let inside = roots.iter().filter(|root| root.inside);
        let machines = inside.map(|root| variants(root) as u64).sum();
        let left = roots.into_iter().map(|root| Left {
            fails: vec![0; variants(&root) * captures.len()],
            depth_fails: Vec::new(),
            root,
        });
        let left: Vec<Left> = left.collect();
        let counts = [machines, depths.len() as u64];
        Self { captures, wrong, depths, left, counts, waiting: Vec::new(), taken: [0; 2] }
    }

    /// Hypotheses at the start: machines with their edge words, and words of depth for each.
    pub const fn counts(&self) -> [u64; 2] {
        self.counts
    }

    /// Machines with their edge words, times captures, that are left; words of depth come on top.
    pub fn left(&self) -> u64 {
        let alive = |left: &Left| left.fails.iter().filter(|fails| **fails <= self.wrong).count();
        self.inside().map(|left| alive(left) as u64).sum()
    }

    /// What is left of the hypotheses.
    fn inside(&self) -> impl Iterator<Item = &Left> {
        self.left.iter().filter(|left| left.root.inside)
    }

    /// Words of depth that are left, over all machines that are; 0 as long as no case told of depth.
    pub fn depths_left(&self) -> u64 {
        let told = self.inside().filter(|left| !left.depth_fails.is_empty());
        told.map(|left| left.depths(&self.depths, self.wrong).len() as u64).sum()
    }

    /// Takes a case: what does not agree with it, and has failed too often, is gone. Depth is looked at as soon
    /// as few machines are left.
    pub fn observe(&mut self, case: &Case) {
        let undone = Undone::of(&case.answer, &self.captures);
        for left in &mut self.left {
            left.observe(case, &undone, self.wrong);
        }
        let wrong = self.wrong;
        self.left.retain(|left| left.fails.iter().any(|fails| *fails <= wrong));
        if matches!(&case.answer, Answer::Picture { depth, .. } if !depth.is_empty()) {
            self.waiting.push(case.clone());
            self.taken[1] += 1;
        }
        self.taken[0] += 1;
        if self.left.len() > FEW || self.depths.is_empty() {
            return;
        }
        for case in std::mem::take(&mut self.waiting) {
            for left in &mut self.left {
                left.observe_depth(&case, &self.depths, wrong);
            }
            self.left.retain(|left| left.depth_fails.iter().any(|fails| *fails <= wrong));
        }
    }

    /// Whether depth is asked about: not where cases came and none of them told of it.
    fn asks_depth(&self) -> bool {
        !self.depths.is_empty() && (self.taken[0] == 0 || self.taken[1] > 0)
    }

    /// How many captures each picture can have gone through.
    pub const fn captures(&self) -> usize {
        self.captures.len()
    }

    /// How many cases may be wrong.
    pub const fn wrong(&self) -> u8 {
        self.wrong
    }

    /// Whether depth was not looked at, because too many machines are left.
    pub fn depth_waits(&self) -> bool {
        !self.waiting.is_empty() && !self.depths.is_empty()
    }

    /// What is left, one by one, at most so many; of each machine, the widest words first: they are right for
    /// triangles that reach beyond the window, too. As long as no case told of depth, the words of depth are all that
    /// are thought of.
    pub fn found(&self, most: usize) -> Vec<Found> {
        let mut found = Vec::new();
        for left in self.inside() {
            let alive: Vec<_> = left.alive(self.captures.len(), self.wrong).collect();
            for (variant, capture) in alive.into_iter().rev() {
                for depth in left.depths(&self.depths, self.wrong) {
                    if found.len() == most {
                        return found;
                    }
                    let words = left.root.words.get(variant).copied();
                    let mut profile = left.root.profile(words, depth);
                    "identified".clone_into(&mut profile.name);
                    "Agrees with the captures of an unknown rasterizer."
                        .clone_into(&mut profile.about);
                    found.push(Found { profile, capture: self.captures[capture] });
                }
            }
        }
        found
    }

    /// The decisions with the values that are left of them: one value is decided, several are not.
    pub fn decided(&self) -> Vec<Decided> {
        let mut decided: Vec<Decided> = Vec::new();
        let mut note = |name: &str, value: String| match decided
            .iter_mut()
            .find(|decided| decided.name == name)
        {
            Some(decided) if decided.values.contains(&value) => {}
            Some(decided) => decided.values.push(value),
            None => decided.push(Decided { name: name.to_owned(), values: vec![value] }),
        };
        for left in self.inside() {
            for (name, value) in &left.root.fields {
                note(name, value.clone());
            }
            for (variant, capture) in left.alive(self.captures.len(), self.wrong) {
                if let Some(EdgeWordConfig { storage, width, .. }) = left.root.words.get(variant) {
                    let storage = format!("{storage:?}").to_lowercase();
                    note(&format!("width, {storage}"), width.to_string());
                }
                if self.captures.len() > 1 {
                    note("picture", self.captures[capture].to_string());
                }
            }
            let depths = left.depths(&self.depths, self.wrong).into_iter().flatten();
            for depth in depths.filter(|_| !left.depth_fails.is_empty()) {
                note("depth.interpolation", depth.interpolation.to_string());
                note("depth.rounding", depth.rounding.to_string());
                note("depth.start-bias", format!("{:?}", depth.start_bias).to_lowercase());
                note(
                    "depth.division",
                    match depth.division {
                        crate::setup::Division::Quotient => "quotient".to_owned(),
                        crate::setup::Division::Reciprocal { bits } => {
                            format!("a reciprocal of {bits} bits")
                        }
                    },
                );
            }
        }
        decided
    }

    /// The cases that the first rasterizer left does not agree with, by their place: those that are wrong, if it
    /// is the machine.
    pub fn disagreeing(&self, cases: &[Case]) -> Vec<usize> {
        let Some(first) = self.inside().next() else { return Vec::new() };
        let Some((variant, capture)) = first.alive(self.captures.len(), self.wrong).next() else {
            return Vec::new();
        };
        let depth = first.depths(&self.depths, self.wrong).first().copied().flatten();
        let wrong = cases.iter().enumerate().filter(|(_, case)| {
            let undone = Undone::of(&case.answer, &self.captures[capture..=capture]);
            let words = first.root.words.get(variant).copied();
            let covers = Model::new(&first.root.profile(words, None))
                .is_ok_and(|model| agrees(&model, case, &undone)[0]);
            let deep = depth.is_none_or(|depth| depth_agrees(&first.root, depth, case));
            !(covers && deep)
        });
        wrong.map(|(n, _)| n).collect()
    }
}

impl Left {
    /// What is left of edge words and captures.
    fn alive(&self, captures: usize, wrong: u8) -> impl Iterator<Item = (usize, usize)> {
        let alive = self.fails.iter().enumerate().filter(move |(_, fails)| **fails <= wrong);
        alive.map(move |(n, _)| (n / captures, n % captures))
    }

    /// What is left of the words of depth; one without where there are none.
    fn depths(&self, depths: &[DepthConfig], wrong: u8) -> Vec<Option<DepthConfig>> {
        if depths.is_empty() {
            return vec![None];
        }
        if self.depth_fails.is_empty() {
            return depths.iter().copied().map(Some).collect();
        }
        let alive = depths.iter().zip(&self.depth_fails).filter(|(_, fails)| **fails <= wrong);
        alive.map(|(depth, _)| Some(*depth)).collect()
    }

    fn observe(&mut self, case: &Case, undone: &Undone, wrong: u8) {
        let captures = undone.pictures.len().max(1);
        let model = &self.root.model;
        let triangle = flat(&case.primitive).and_then(|shape| model.snap(&shape).ok());
        let boxed = triangle.and_then(|triangle| Boxed::new(model, &triangle));
        let mut widest = None;
        let mut needed = BTreeMap::new();
        for (variant, fails) in self.fails.chunks_mut(captures).enumerate() {
            if fails.iter().all(|fails| *fails > wrong) {
                continue;
            }
            let words = self.root.words.get(variant);
            let own = boxed.as_ref().zip(words).and_then(|(boxed, words)| {
                // Words that hold every value that a triangle meets draw what the widest draw.
                let bits =
                    needed.entry(words.fraction(1)).or_insert_with(|| boxed.needed(model, *words));
                if *bits <= words.width { None } else { boxed.words(model, *words) }
            });
            if let Some(narrow) = own {
                for (fails, picture) in fails.iter_mut().zip(&undone.pictures) {
                    let agrees = narrow.agrees(&picture.shown, picture.count);
                    *fails = fails.saturating_add(u8::from(!agrees));
                }
                continue;
            }
            // A machine that has words and does not look at a box is made for each of them.
            let made = words
                .filter(|_| boxed.is_none())
                .and_then(|words| Model::new(&self.root.profile(Some(*words), None)).ok());
            let made = made.map(|model| agrees(&model, case, undone));
            let agree = match &made {
                Some(own) => own,
                None => widest.get_or_insert_with(|| agrees(model, case, undone)),
            };
            for (fails, agrees) in fails.iter_mut().zip(agree) {
                *fails = fails.saturating_add(u8::from(!agrees));
            }
        }
    }

    fn observe_depth(&mut self, case: &Case, depths: &[DepthConfig], wrong: u8) {
        self.depth_fails.resize(depths.len(), 0);
        let Answer::Picture { depth: expected, .. } = &case.answer else { return };
        let deep = Deep::new(&self.root, &case.primitive, depths);
        for (depth, fails) in depths.iter().zip(&mut self.depth_fails) {
            if *fails <= wrong {
                let codes = deep.as_ref().and_then(|deep| deep.codes(*depth, expected.keys()));
                let agrees = codes.is_some_and(|codes| codes.eq(expected.values().copied()));
                *fails = fails.saturating_add(u8::from(!agrees));
            }
        }
    }
}
