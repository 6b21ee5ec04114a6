//! A command line as text that a shell takes back.

/// The command line of this process. The program goes by its name: where it lies on this machine
/// is nobody's business.
pub(crate) fn command_line() -> String {
    let arguments = std::env::args_os().skip(1);
    let words = arguments.map(|word| quoted(&word.to_string_lossy()));
    std::iter::once("guardbit".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// A word, in quotes where a shell would make something else of it.
pub(crate) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./,:=+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    // Inside single quotes everything stands for itself, but for the quote.
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_are_quoted_where_they_must_be() {
        let same = ["explore", "--vary", "interpolation=3..13", "a/b-c_d.obj", "rounding=floor,x"];
        for word in same {
            assert_eq!(quoted(word), word);
        }
        for (word, text) in [
            ("", "''"),
            ("a b", "'a b'"),
            ("it's", r"'it'\''s'"),
            ("$HOME", "'$HOME'"),
            ("~", "'~'"),
        ] {
            assert_eq!(quoted(word), text);
        }
    }
}
