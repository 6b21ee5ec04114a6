//! Charts of difficult data.

use super::*;

fn chart(points: &[(f64, f64)], log: bool) -> Chart {
    Chart {
        title: "a title".to_owned(),
        x_label: "error, ULP".to_owned(),
        y_label: "time, ns".to_owned(),
        log_x: log,
        log_y: log,
        series: vec![Series { name: "s".to_owned(), points: points.to_vec(), ..Series::default() }],
        line: true,
        caption: "a caption".to_owned(),
    }
}

fn circles(svg: &str) -> usize {
    svg.matches("<circle").count()
}

#[test]
fn every_point_that_has_a_place_is_drawn_and_no_other() {
    let points = [(1.0, 2.0), (0.0, 3.0), (f64::NAN, 1.0), (2.0, f64::INFINITY), (4.0, -1.0)];
    assert_eq!(circles(&svg(&chart(&points, false))), 3);
    assert_eq!(circles(&svg(&chart(&points, true))), 1);
    for (points, drawn) in [(&points[..1], 1), (&points[2..3], 0), (&[], 0)] {
        for log in [false, true] {
            let text = svg(&chart(points, log));
            assert_eq!((circles(&text), text.contains("no data")), (drawn, drawn == 0));
            assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
    }
}

#[test]
fn words_are_there_and_escaped() {
    let mut chart = chart(&[(1.0, 1.0), (2.0, 3.0)], false);
    chart.title = "a < b & c".to_owned();
    chart.series[0].labels = vec!["first".to_owned()];
    let text = svg(&chart);
    for part in ["a &lt; b &amp; c", "error, ULP", "time, ns", "a caption", "first"] {
        assert!(text.contains(part), "{part}");
    }
    // One series needs no legend, two do.
    assert!(!text.contains(">\ns\n<"));
    chart.series.push(Series { name: "other series".to_owned(), ..Series::default() });
    assert!(svg(&chart).contains("other series"));
}

#[test]
fn the_legend_stands_right_of_every_point() {
    let mut chart = chart(&[(1.0, 1.0), (1000.0, 3.0)], true);
    let name = "a series with quite a long name";
    chart.series.push(Series { name: name.to_owned(), ..Series::default() });
    let left = SIZE.0.cast_signed() - legend_width(&chart.series);
    let text = svg(&chart);
    let mut right_of = 0;
    for circle in text.split("<circle cx=\"").skip(1) {
        let x: i32 = circle.split('"').next().unwrap().parse().unwrap();
        right_of += u32::from(x > left);
    }
    assert_eq!(right_of, 2, "the marks of the legend, and no point of the data");
    assert!(characters(legend_width(&chart.series) - 48, TEXT) >= name.chars().count());
}

#[test]
fn long_captions_are_wrapped() {
    assert_eq!(wrap("one two three", 7), ["one two", "three"]);
    assert_eq!(wrap("", 7), [""; 0]);
    assert_eq!(wrap("unbreakable", 3), ["unbreakable"]);
}

#[test]
fn many_series_keep_their_order_and_their_legend_its_room() {
    let mut chart = chart(&[(1.0, 1.0)], false);
    chart.series =
        (0..40).map(|n| Series { name: format!("series {n}."), ..Series::default() }).collect();
    let text = svg(&chart);
    assert!(text.contains("series 16.") && !text.contains("series 17."));
    assert!(text.contains("and 23 more"), "17 of 40 are named");
    for count in [8, 11, 40] {
        let light = |n| colour(n, count).to_rgba().rgb();
        let sum = |(r, g, b): (u8, u8, u8)| u32::from(r) + 2 * u32::from(g) + u32::from(b);
        assert!((1..count).all(|n| sum(light(n)) > sum(light(n - 1))), "{count}");
    }
}

#[test]
fn rings_and_dots_are_told_apart() {
    let mut chart = chart(&[(1.0, 1.0), (2.0, 2.0), (3.0, 3.0)], false);
    chart.series[0].hollow = vec![true, false];
    let text = svg(&chart);
    let rings = text.split("<circle").skip(1).filter(|circle| circle.contains("fill=\"none\""));
    assert_eq!((rings.count(), circles(&text)), (1, 3));
}
