//! The words that `trace` shows behind codes are the words that make them.

use super::{Case, case, corrections, draw, held, with};
use guardbit::cover::{
    ConservativeConfig, ConservativeDepth, ConservativeMode, Degenerate, DepthAt, MultisampleConfig,
};
use guardbit::exact::{ratio, round};
use guardbit::machine::{ComponentWords, triangle_machines};
use guardbit::model::{Drawing, Model};
use guardbit::profile::Profile;
use guardbit::setup::Triangle;
use guardbit::value::{Correction, Corrector, EvaluatedAt, Provoking};

/// The code that the words of a component come to.
fn code(profile: &Profile, corrector: &Corrector, words: ComponentWords, u: [i128; 3]) -> i128 {
    let channel = &profile.channel[0];
    match words {
        ComponentWords::Flat => {
            let first = channel.correction == Correction::Flat { provoking: Provoking::First };
            u[if first { 0 } else { 2 }]
        }
        ComponentWords::Affine(word) => held(word, 4, 9, channel.signed) >> 9,
        ComponentWords::Divided([over, inverse]) => match channel.correction {
            Correction::Quotient { rounding } | Correction::ConstantW { rounding } => {
                let [low, high] = if channel.signed { [-8, 7] } else { [0, 15] };
                let (p, q) = (held(over, 4, 9, channel.signed), held(inverse, 5, 9, false));
                let far = if p < 0 { low } else { high };
                ratio(p << 14, q << 9).map_or(far, |exact| {
                    i128::try_from(round(&exact, rounding)).unwrap().clamp(low, high)
                })
            }
            _ => corrector.divided(over, inverse).into(),
        },
        ComponentWords::Weighed(coordinates) => corrector.weighed(coordinates, u).into(),
    }
}

/// Compares every code of a drawing; returns their number.
fn compare(model: &Model, case: &Case, turned: [[i128; 3]; 2], drawing: &Drawing) -> u32 {
    let values = model.values_in_order(&case.codes, Some(case.q)).unwrap();
    let (placed, channels) = (model.place(case.triangle).unwrap(), model.channels().unwrap());
    let corrector = channels.corrector(0).unwrap();
    let flat = matches!(model.profile().channel[0].correction, Correction::Flat { .. });
    let own = if flat { case.codes } else { turned };
    let by_sample = channels.ports()[0].by_sample;
    let (mut codes, mut masks, mut seen) = (drawing.channels[0].iter(), drawing.masks.iter(), 0);
    for span in &drawing.spans {
        for x in span.x0..span.x1 {
            let mask = masks.next().map_or(1, |mask| *mask);
            let samples = (0..4).filter(|n| mask >> n & 1 == 1).map(Some);
            let samples: Vec<_> = if by_sample { samples.collect() } else { vec![None] };
            for sample in samples {
                let words = model.channel_words(&placed, &values, 0, ([x, span.y], sample));
                for (words, u) in words.unwrap().into_iter().zip(own) {
                    let want = i128::from(*codes.next().unwrap());
                    assert_eq!(code(model.profile(), corrector, words, u), want, "{words:?}");
                    seen += 1;
                }
            }
        }
    }
    assert!(codes.next().is_none());
    seen
}

/// Clauses CH-2, CH-3, CH-5, CH-6 and CH-7: on every machine and at every place, the words behind a code make that code.
#[test]
fn the_words_behind_a_code_make_it() {
    let four = MultisampleConfig::standard(4, DepthAt::Centre);
    let places = [EvaluatedAt::Centre, EvaluatedAt::Centroid, EvaluatedAt::Sample];
    let mut seen = 0;
    for (n, correction) in corrections().into_iter().enumerate() {
        let base = with(correction, n % 2 == 1);
        let mut profiles: Vec<Profile> =
            triangle_machines().map(|kind| base.with_machine(kind.name).unwrap()).collect();
        profiles.extend(places.map(|at| {
            let mut profile = base.clone();
            (profile.multisample, profile.channel[0].at) = (Some(four), at);
            profile
        }));
        for profile in profiles {
            let model = Model::new(&profile).unwrap();
            for index in 0..12 {
                let case = case(3000 + index, n % 2 == 1);
                let (_, turned, _) = super::normalised(&case);
                let drawing = draw(&model, &case);
                if !drawing.spans.is_empty() {
                    seen += compare(&model, &case, turned, &drawing);
                }
            }
        }
    }
    assert!(seen > 1500, "{seen}");
    let nowhere = case(3000, false);
    let model = Model::new(&with(Correction::Affine, false)).unwrap();
    let values = model.values_in_order(&nowhere.codes, None).unwrap();
    let placed = model.place(nowhere.triangle).unwrap();
    assert_eq!(model.channel_words(&placed, &values, 0, ([70, 70], None)), None);
    assert_eq!(model.channel_words(&placed, &values, 1, ([1, 1], None)), None);
}

/// Clauses CH-3, CH-5 and CR-4: a triangle without area that is drawn has words behind its codes, too.
#[test]
fn a_triangle_without_area_has_words_where_it_is_drawn() {
    for correction in [corrections()[0].clone(), corrections()[3].clone()] {
        let mut profile = with(correction, false);
        profile.form.edge_mut().unwrap().conservative = Some(ConservativeConfig {
            mode: ConservativeMode::Outer,
            grow: 0,
            degenerate: Degenerate::Draw,
            depth: ConservativeDepth::Centre,
        });
        let model = Model::new(&profile).unwrap();
        let flat = Triangle { xy: [[10, 10], [90, 50], [50, 30]], z: Some([1, 2, 3]) };
        let case = Case { triangle: flat, ..case(3000, false) };
        let drawing = draw(&model, &case);
        assert!(compare(&model, &case, case.codes, &drawing) > 8);
    }
}
