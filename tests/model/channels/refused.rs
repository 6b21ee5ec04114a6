//! What vertices and profiles may say of channels, and what is refused with its numbers.

use super::{toy, with};
use guardbit::format::Clamp;
use guardbit::machine::{DrawError, Input};
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Profile, load, parse};
use guardbit::scene::Shading;
use guardbit::setup::Triangle;
use guardbit::value::{Correction, EvaluatedAt};

/// Clauses CH-2 and CH-4: codes of reals, and of 1/w from distances.
#[test]
fn reals_become_codes() {
    let model = Model::new(&toy()).unwrap();
    let codes = |w: [f64; 3], a: [f64; 3]| {
        let channels = vec![("c".to_owned(), vec![a, [0.0; 3]])];
        model.shading(&Shading::Reals { channels, w: Some(w) })
    };
    let inverse = |w| codes(w, [0.0; 3]).unwrap().inverse_w().unwrap();
    assert_eq!(inverse([1.0, 2.0, 4.0]), [31, 16, 8]);
    assert_eq!(inverse([3e300, 3.0, 3.0]), [1, 31, 31]);
    // The largest code is 15: 0.5 comes to 7.5, the even neighbour is 8.
    assert_eq!(codes([1.0; 3], [0.5, 0.1, 1.0]).unwrap().components()[0], [8, 2, 15]);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = codes([1.0, bad, 1.0], [0.0; 3]).unwrap_err().to_string();
        assert!(error.contains("vertex 1") && error.contains("0 < w"), "{error}");
    }
    let error = codes([1.0; 3], [0.0, 0.0, f64::NAN]).unwrap_err().to_string();
    assert!(error.contains("vertex 2: NaN is not finite"), "{error}");
    let error = codes([1.0; 3], [0.0, 1.1, 0.0]).unwrap_err().to_string();
    assert!(error.contains("vertex 1: a = 16: 0 <= a <= 15"), "{error}");
}

/// Clauses CH-1, CH-2 and CH-8: what cannot be is refused with its numbers.
#[test]
fn malformed_channels_are_named() {
    let text = toy().to_toml();
    let faults = [
        ("components = [\"a\", \"b\"]", "components = []", "1 <= components <= 4"),
        ("components = [\"a\", \"b\"]", "components = [\"a\", \"a\"]", "given twice"),
        ("name = \"c\"", "name = \"C\"", "a-z"),
        ("name = \"c\"", "name = \"setup\"", "stands for"),
        ("name = \"c\"\n", "name = \"c\"\nunit = 16\n", "1 <= unit <= 15"),
        ("name = \"c\"\n", "name = \"c\"\nstart-bias = \"half\"\n", "affine"),
        (
            "name = \"c\"\n",
            "name = \"c\"\ndivision = { reciprocal = { bits = 9 } }\n",
            "division = \"quotient\"",
        ),
    ];
    for (from, to, want) in faults {
        assert!(text.contains(from), "{text}");
        let error = parse(&text.replacen(from, to, 1), "c.toml").unwrap_err().to_string();
        assert!(error.contains(want) && error.contains("c.toml:"), "{want}: {error}");
    }
    let refused = |change: fn(&mut Profile), want: &str| {
        let mut profile = toy();
        change(&mut profile);
        let error = profile.validate().unwrap_err().to_string();
        assert!(error.contains(want), "{want}: {error}");
    };
    refused(|p| p.w = None, "[w]");
    refused(|p| p.channel[0].correction = Correction::Affine, "[w] is given, but no channel");
    refused(|p| p.channel[0].integer = 33, "1 <= integer <= 32");
    refused(|p| p.channel[0].interpolation = 100, "> 126");
    refused(|p| p.channel[0].clamp = Clamp::Saturate, "wrap, guard or sign");
    refused(|p| p.channel.push(p.channel[0].clone()), "given twice");
    refused(
        |p| *p = Profile { channel: p.channel.clone(), w: p.w, ..load("voodoo").unwrap() },
        "no means for [[channel]]",
    );
    refused(
        |p| {
            *p = p.with_machine("gouraud").unwrap();
            p.channel[0].at = EvaluatedAt::Corner;
        },
        "at its own sample only",
    );
}

/// Clause CH-2: values that another model made are refused, not drawn.
#[test]
fn values_of_other_channels_are_refused() {
    let model = Model::new(&toy()).unwrap();
    let one = {
        let mut profile = with(Correction::Affine, false);
        profile.channel[0].components.pop();
        Model::new(&profile).unwrap()
    };
    let wide = {
        let mut profile = toy();
        profile.channel[0].integer = 8;
        Model::new(&profile).unwrap()
    };
    let named = |codes: &[[i128; 3]]| [("c".to_owned(), codes.to_vec())];
    let foreign = [
        one.values(&named(&[[1, 2, 3]]), None).unwrap(),
        wide.values(&named(&[[200, 2, 3], [0; 3]]), Some([1; 3])).unwrap(),
    ];
    let placed = model.place(Triangle { xy: [[0, 0], [99, 0], [0, 99]], z: None }).unwrap();
    for values in foreign {
        let drawn = model.draw(Input::Shaded(&placed, &values), &mut Drawing::default());
        assert_eq!(drawn, Err(DrawError::ForeignValues));
    }
    // The same codes of its own.
    let own = model.values(&named(&[[15, 2, 3], [0; 3]]), Some([1; 3])).unwrap();
    assert_eq!(model.draw(Input::Shaded(&placed, &own), &mut Drawing::default()), Ok(()));
}

/// Clauses CH-1 and CH-7: words of one name, and centres where there are none.
#[test]
fn names_and_places_that_cannot_be() {
    let mut profile = toy();
    let mut other = profile.channel[0].clone();
    (other.name, other.components) = ("c_a".to_owned(), vec!["dx".to_owned()]);
    other.correction = Correction::Flat { provoking: guardbit::value::Provoking::First };
    profile.channel.push(other);
    let error = Model::new(&profile).unwrap_err().to_string();
    assert!(error.contains("\"c_a_dx\""), "{error}");
    let mut profile = load("ps1").unwrap().with_machine("edge-function").unwrap();
    assert_eq!(profile.vertex.sub_pixel, 0);
    profile.channel = with(Correction::Affine, false).channel;
    profile.channel[0].at = EvaluatedAt::Centre;
    let error = profile.validate().unwrap_err().to_string();
    assert!(error.contains("sub-pixel = 0"), "{error}");
    profile.channel[0].at = EvaluatedAt::Corner;
    assert_eq!(profile.validate(), Ok(()));
}
