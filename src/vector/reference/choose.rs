//! Lines of a template that only some profiles have.

/// The template with the lines that apply. A line `@?FLAG` opens lines for profiles with a flag, `@!FLAG` for
/// those without it, and `@.` closes them; such lines nest.
pub(super) fn choose(template: &str, flags: &[&str]) -> String {
    let mut open: Vec<bool> = Vec::new();
    let mut text = String::new();
    for line in template.split_inclusive('\n') {
        let (sign, flag) = line.trim_end().split_at(line.trim_end().len().min(2));
        match sign {
            "@?" => open.push(flags.contains(&flag)),
            "@!" => open.push(!flags.contains(&flag)),
            "@." if flag.is_empty() => {
                open.pop();
            }
            _ if open.iter().all(|applies| *applies) => text += line,
            _ => {}
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::choose;

    #[test]
    fn lines_come_and_go_by_flags() {
        let template = "a\n@?x\nb\n@!y\nc\n@.\n@.\n@!x\nd\n@.\n@KEY@ e";
        assert_eq!(choose(template, &["x"]), "a\nb\nc\n@KEY@ e");
        assert_eq!(choose(template, &["x", "y"]), "a\nb\n@KEY@ e");
        assert_eq!(choose(template, &["y"]), "a\nd\n@KEY@ e");
    }

    #[test]
    fn each_template_closes_what_it_opens() {
        let known = [
            "depth",
            "edges",
            "tiles",
            "plain_edges",
            "walk",
            "words",
            "quotients",
            "several",
            "centre",
            "at_samples",
            "rich",
            "stepped",
            "anchored",
            "first_match",
            "sorted",
            "clamped",
            "channels",
            "quads",
            "given",
            "truncated",
            "descent",
            "masks",
            "registers",
            "mixed",
            "scaled",
            "slopes",
            "clips",
            "adjust",
            "flip",
            "at_edge",
            "w_depth",
            "kinds",
            "resize",
            "signed_distance",
            "long_sign",
        ];
        let templates = [
            include_str!("c.in"),
            include_str!("py.in"),
            include_str!("sv.in"),
            include_str!("random.c.in"),
            include_str!("random.py.in"),
            include_str!("register.c.in"),
            include_str!("register.py.in"),
            include_str!("anchored.c.in"),
            include_str!("anchored.py.in"),
            include_str!("quads.c.in"),
            include_str!("quads.py.in"),
            include_str!("slopes.c.in"),
            include_str!("slopes.py.in"),
            include_str!("sub-scanlines.c.in"),
            include_str!("sub-scanlines.py.in"),
        ];
        for template in templates {
            let mut open = 0;
            for line in template.lines() {
                if let Some(flag) = line.strip_prefix("@?").or_else(|| line.strip_prefix("@!")) {
                    assert!(known.contains(&flag), "{flag}");
                    open += 1;
                } else if line == "@." {
                    assert!(open > 0, "closed once too often");
                    open -= 1;
                }
            }
            assert_eq!(open, 0);
        }
    }
}
