use super::*;

fn triangle(line: &str) -> Triangle {
    match parse_line(line).unwrap().primitive {
        Primitive::Triangle(triangle) => triangle,
        other => panic!("{other:?}"),
    }
}

fn message(line: &str) -> String {
    parse_line(line).unwrap_err().to_string()
}

#[test]
fn the_extremes_of_128_bits_survive() {
    let max = i128::MAX;
    let min = i128::MIN;
    for q in ["", "\""] {
        let line = format!(r#"{{"v":[[{q}{max}{q},{q}{min}{q},1],[0,-0,2],[5,6,{q}{max}{q}]]}}"#);
        let want = Triangle::Lattice { xy: [[max, min], [0, 0], [5, 6]], z: Some([1, 2, max]) };
        assert_eq!(triangle(&line), want);
    }
    let line = r#"{"v":[[170141183460469231731687303715884105728,0],[0,0],[0,0]]}"#;
    assert!(message(line).contains("2^127 - 1") && message(line).contains("`v[0][0]`"));
}

#[test]
fn an_integer_is_never_rounded() {
    for wrong in [
        "1.5", "1e3", "1.0", "\"0x10\"", "\"\"", "\"-\"", "\"+1\"", "\" 1\"", "null", "true", "[1]",
    ] {
        let line = format!(r#"{{"id":7,"v":[[0,0],[{wrong},0],[0,1]]}}"#);
        let error = parse_line(&line).unwrap_err();
        assert_eq!(error.place, "field `v[1][0]`", "{wrong}");
        assert!(matches!(error.fault, Fault::NotInteger(_)), "{wrong}: {error}");
        assert_eq!(error.id.as_deref(), Some("7"));
    }
}

#[test]
fn reals_are_rounded_once_and_patterns_are_kept() {
    let line = r#"{"f":[[0.1,1e-310,{"bits":"7fc00001"}],[-0.0,2,{"bits":"ff800000"}],
        [9007199254740993,3,{"bits":"7ff0000000000001"}]]}"#;
    let Triangle::Real { xy, z } = triangle(line) else { panic!() };
    let z = z.unwrap();
    assert_eq!(
        xy.map(|v| v.map(f64::to_bits)),
        [[0.1, 1e-310], [-0.0, 2.0], [9_007_199_254_740_992.0, 3.0]].map(|v| v.map(f64::to_bits))
    );
    assert_eq!(z[0].to_bits(), 0x7ff8_0000_2000_0000);
    assert_eq!(z[1].to_bits(), f64::NEG_INFINITY.to_bits());
    assert_eq!(z[2].to_bits(), 0x7ff0_0000_0000_0001);
    for bits in 0..=0xffff_u32 {
        let bits = bits << 16 | bits;
        let line = format!(r#"{{"f":[[{{"bits":"{bits:08x}"}},0],[0,0],[0,0]]}}"#);
        let Triangle::Real { xy: [[x, _], ..], .. } = triangle(&line) else { panic!() };
        let f = f32::from_bits(bits);
        assert_eq!(x.is_nan(), f.is_nan());
        assert!(f.is_nan() || x.to_bits() == f64::from(f).to_bits());
    }
}

#[test]
fn real_errors_name_the_field() {
    for (wrong, place) in [
        ("1e999", "`f[2][1]`"),
        ("\"1\"", "`f[2][1]`"),
        (r#"{"bits":"7fc"}"#, "`f[2][1].bits`"),
        (r#"{"bits":"+fc00000"}"#, "`f[2][1].bits`"),
        (r#"{"bits":5}"#, "`f[2][1].bits`"),
        (r#"{"bit":"7fc00000"}"#, "`f[2][1].bit`"),
        ("{}", "`f[2][1]`"),
        (r#"{"bits":"7fc00000","bits":"7fc00000"}"#, "`f[2][1]`"),
    ] {
        let text = message(&format!(r#"{{"f":[[0,0],[0,0],[0,{wrong}]]}}"#));
        assert!(text.contains(place), "{wrong}: {text}");
    }
}

#[test]
fn words_lines_and_points() {
    let read = |line| parse_line(line).unwrap().primitive;
    assert_eq!(
        read(r#"{"words":["0ff","-1"]}"#),
        Primitive::Words(vec!["0ff".into(), "-1".into()])
    );
    assert_eq!(read(r#"{"line":[[1,2],["-3",4]]}"#), Primitive::Line([[1, 2], [-3, 4]]));
    assert_eq!(read(r#"{"point":[1,2]}"#), Primitive::Point([1, 2]));
    assert!(message(r#"{"words":["1",2]}"#).contains("`words[1]`"));
    assert!(message(r#"{"line":[[1,2],[3,4,5]]}"#).contains("`line[1]`"));
    assert!(message(r#"{"line":[[1,2]]}"#).contains("got 1"));
    assert!(message(r#"{"point":[1,2.5]}"#).contains("`point[1]`"));
    assert!(message(r#"{"point":7}"#).contains("a list"));
}

#[test]
fn the_id_comes_back_as_it_was() {
    for id in [
        "7",
        "\"a\\u0041\"",
        "null",
        "1e400",
        "[1, {\"a\":  2}]",
        "340282366920938463463374607431768211455",
    ] {
        let good = parse_line(&format!(r#"{{"point":[1,2], "id": {id} }}"#)).unwrap();
        assert_eq!(good.id.as_deref(), Some(id));
        let bad = parse_line(&format!(r#"{{"pont":[1,2], "id": {id} }}"#)).unwrap_err();
        assert_eq!(bad.id.as_deref(), Some(id));
        assert!(bad.to_string().contains("`pont`") && bad.to_string().contains("unknown key"));
    }
    assert_eq!(parse_line(r#"{"point":[1,2]}"#).unwrap().id, None);
    assert_eq!(parse_line(r#"{"id":7,"point":[1,2]"#).unwrap_err().id, None);
}

#[test]
fn the_shape_is_checked() {
    for (line, want) in [
        (r#"{"v":[[0,0],[1,1]]}"#, "3 vertices are needed, got 2"),
        (r#"{"v":[[0,0],[1,1],[2]]}"#, "field `v[2]`: 2 or 3 coordinates"),
        (r#"{"v":[[0,0,1],[1,1],[2,1,3]]}"#, "field `v[1]`: 2 coordinates, but vertex 0 has 3"),
        (r#"{"v":[[0,0],[1,1],[2,1,3]]}"#, "field `v[2]`: 3 coordinates, but vertex 0 has 2"),
        (r#"{"f":[[0,0],[1,1,1],[2,1,3]]}"#, "field `f[1]`: 3 coordinates, but vertex 0 has 2"),
        (r#"{"v":[[0,0],[1,1],[2,1]],"f":[]}"#, "field `f`: exactly one of"),
        (r#"{"point":[0,0],"point":[0,0]}"#, "field `point`: the key is given twice"),
        (r#"{"id":1,"point":[0,0],"id":1}"#, "field `id`: the key is given twice"),
        (r#"{"id":7}"#, "nothing to draw"),
        (r"[1,2]", "line: a JSON object is needed, got [1,2]"),
        (r#"{"point":[0,0]} x"#, "column 17: not JSON: trailing characters"),
        (r"", "not JSON"),
    ] {
        let got = message(line);
        assert!(got.contains(want), "{line}: {got}");
        assert!(!got.contains("line 1"), "{got}");
    }
    let deep = format!(r#"{{"id":{},"point":[0,0]}}"#, "[".repeat(100_000));
    assert!(message(&deep).contains("not JSON"));
}

#[test]
fn a_scene_holds_triangles_only() {
    let (line, error) =
        parse_scene("\u{feff}{\"v\":[[0,0],[1,0],[0,1]]}\n\n{\"point\":[0,0]}").unwrap_err();
    assert_eq!((line, error.place.as_str(), error.fault), (3, "field `point`", Fault::NotTriangle));
}

#[test]
fn a_line_written_is_the_line_read() {
    let lattice = Triangle::Lattice {
        xy: [[i128::MIN, i128::MAX], [0, -1], [1 << 100, 7]],
        z: Some([0, i128::MAX, -5]),
    };
    let real =
        Triangle::Real { xy: [[0.1, -0.0], [1e300, 5e-324], [f64::MAX, 1.0 / 3.0]], z: None };
    for want in [lattice, real] {
        let line = to_line(u64::MAX, &want, None);
        assert!(!line.contains('\n'));
        let got = parse_line(&line).unwrap();
        assert_eq!(got.id.unwrap(), u64::MAX.to_string());
        assert_eq!(got.primitive, Primitive::Triangle(want));
    }
    let odd = Triangle::Real {
        xy: [[0.0; 2]; 3],
        z: Some([f64::from_bits(0x7ff0_0000_0000_0001), f64::INFINITY, f64::NEG_INFINITY]),
    };
    let Triangle::Real { z: Some(z), .. } = triangle(&to_line(0, &odd, None)) else { panic!() };
    assert_eq!(z.map(f64::to_bits), [0x7ff0_0000_0000_0001, 0x7ff0 << 48, 0xfff0 << 48]);
}

#[test]
fn channels_stand_beside_vertices() {
    let v = r#""v":[[0,0],[1,0],[0,1]]"#;
    let f = r#""f":[[0,0],[1,0],[0,1]]"#;
    let line = format!(r#"{{{v},"q":[3,"2",1],"channels":{{"c":[[1,2],[3,4],[5,-6]]}}}}"#);
    let channels = vec![("c".to_owned(), vec![[1, 3, 5], [2, 4, -6]])];
    let want = Shading::Codes { channels, inverse_w: Some([3, 2, 1]) };
    assert_eq!(parse_line(&line).unwrap().shading, Some(want));
    let line = format!(r#"{{{f},"channels":{{"c":[[0.5],[1],[2e0]]}},"w":[1,2,3.5]}}"#);
    let channels = vec![("c".to_owned(), vec![[0.5, 1.0, 2.0]])];
    let want = Shading::Reals { channels, w: Some([1.0, 2.0, 3.5]) };
    assert_eq!(parse_line(&line).unwrap().shading, Some(want));
    assert_eq!(parse_line(&format!("{{{v}}}")).unwrap().shading, None);
    for (tail, want) in [
        (format!(r#"{v},"w":[1,1,1],"channels":{{}}"#), "field `w`: beside `v`, w is given as `q`"),
        (format!(r#"{f},"q":[1,1,1],"channels":{{}}"#), "field `q`: beside `f`, w is given as `w`"),
        (format!(r#"{v},"q":[1,1,1]"#), "field `q`: w is given, but no `channels`"),
        (format!(r#"{v},"q":[1,1],"channels":{{}}"#), "field `q`: 3 values are needed"),
        (r#""point":[0,0],"channels":{}"#.to_owned(), "field `channels`: only triangles"),
        (format!(r#"{v},"channels":[]"#), "field `channels`"),
        (format!(r#"{v},"channels":{{"c":[[1],[2]]}}"#), "field `channels.c`: 3 vertices"),
        (
            format!(r#"{v},"channels":{{"c":[[1],[2],[3,4]]}}"#),
            "field `channels.c[2]`: 2 components",
        ),
        (format!(r#"{v},"channels":{{"c":[[1],[2],[0.5]]}}"#), "field `channels.c[2][0]`: 0.5"),
        (
            format!(r#"{v},"channels":{{"c":[[1],[2],[3]],"c":[[1],[2],[3]]}}"#),
            "field `channels.c`: the key is given twice",
        ),
    ] {
        let got = message(&format!("{{{tail}}}"));
        assert!(got.contains(want), "{tail}: {got}");
    }
}

#[test]
fn channels_written_are_the_channels_read() {
    let codes = vec![("a \"b\"".to_owned(), vec![[i128::MIN, 0, 7], [1, 2, i128::MAX]])];
    let lattice = Triangle::Lattice { xy: [[0, 0], [1, 0], [0, 1]], z: None };
    let reals = vec![("n".to_owned(), vec![[0.1, -1e300, 5e-324]]), ("none".to_owned(), vec![])];
    let real = Triangle::Real { xy: [[0.0; 2]; 3], z: Some([1.0; 3]) };
    for (triangle, shading) in [
        (&lattice, Shading::Codes { channels: codes.clone(), inverse_w: Some([1, 2, 3]) }),
        (&lattice, Shading::Codes { channels: codes, inverse_w: None }),
        (&real, Shading::Reals { channels: reals, w: Some([0.5, 1.0, 1e9]) }),
    ] {
        let line = format!("\n{}\n", to_line(3, triangle, Some(&shading)));
        let want = SceneLine { line: 2, triangle: triangle.clone(), shading: Some(shading) };
        assert_eq!(parse_scene(&line).unwrap(), [want]);
    }
}
