//! Reading profiles, with errors that point at file, line and field.

use super::{BUILTIN, InvalidProfile, Profile, builtin, read_at_most};
use toml::de::{DeTable, DeValue};

/// The most bytes of a profile that are read: the built-in ones have a few thousand.
const LARGEST: u64 = 1 << 20;

/// A profile that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ProfileError {
    /// Neither a built-in nor a file.
    #[error(
        "no profile {name:?}: give the path of a TOML file, or one of the built-in profiles {known}"
    )]
    Unknown {
        /// What was asked for.
        name: String,
        /// The built-in names.
        known: String,
    },
    /// The file cannot be read.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// The file is no UTF-8 text.
    #[error(
        "{path}: byte {at} is not UTF-8, but a profile is a TOML text file; save the file as UTF-8"
    )]
    Encoding {
        /// The file.
        path: String,
        /// Offset of the first bad byte.
        at: usize,
    },
    /// No TOML, or a field of the wrong name or type.
    #[error("{path}:{line}: {field}{message}")]
    Syntax {
        /// The file or built-in.
        path: String,
        /// Line, from 1.
        line: usize,
        /// The dotted field and a colon, or nothing.
        field: String,
        /// What is wrong.
        message: String,
    },
    /// The TOML text is well-formed, but the profile fails validation.
    #[error("{path}:{line}: {field}: {source}")]
    Invalid {
        /// The file or built-in.
        path: String,
        /// Line, from 1.
        line: usize,
        /// The dotted field.
        field: String,
        /// The violated inequality.
        source: Box<InvalidProfile>,
    },
}

impl ProfileError {
    /// Whether reading failed rather than the contents.
    pub fn is_io(&self) -> bool {
        matches!(self, Self::Io { .. })
    }
}

/// Loads a built-in profile by name, or a TOML file by path.
///
/// # Errors
/// [`ProfileError`] with file, line, field and what to do.
pub fn load(source: &str) -> Result<Profile, ProfileError> {
    if let Some(profile) = builtin(source) {
        return profile;
    }
    let looks_like_file =
        source.contains(['/', '\\', '.']) || std::path::Path::new(source).exists();
    if !looks_like_file {
        let known: Vec<&str> = BUILTIN.iter().map(|(name, _)| *name).collect();
        return Err(ProfileError::Unknown { name: source.to_owned(), known: known.join(", ") });
    }
    let bytes = read_at_most(std::path::Path::new(source), LARGEST)
        .map_err(|error| ProfileError::Io { path: source.to_owned(), source: error })?;
    let text = String::from_utf8(bytes).map_err(|error| ProfileError::Encoding {
        path: source.to_owned(),
        at: error.utf8_error().valid_up_to(),
    })?;
    parse(&text, source)
}

/// Parses and validates a profile; `path` is only named in errors.
///
/// # Errors
/// [`ProfileError`] with line and field.
pub fn parse(text: &str, path: &str) -> Result<Profile, ProfileError> {
    let profile: Profile = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        ProfileError::Syntax {
            path: path.to_owned(),
            line: line_of(text, at),
            field: field_at(text, at).map(|field| format!("{field}: ")).unwrap_or_default(),
            message: error.message().replace('\n', " "),
        }
    })?;
    match profile.validate() {
        Ok(()) => Ok(profile),
        Err(source) => Err(ProfileError::Invalid {
            path: path.to_owned(),
            line: line_of(text, offset_of(text, source.field())),
            field: source.field().join("."),
            source: Box::new(source),
        }),
    }
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.as_bytes().iter().take(offset).filter(|byte| **byte == b'\n').count()
}

/// Where the deepest part of a dotted path that the text has begins.
fn offset_of(text: &str, path: &[&str]) -> usize {
    let Ok(root) = DeTable::parse(text) else { return 0 };
    let mut table = root.get_ref();
    let mut at = 0;
    for name in path {
        let Some((key, value)) = table.iter().find(|(key, _)| key.get_ref() == name) else { break };
        at = key.span().start;
        let DeValue::Table(inner) = value.get_ref() else { break };
        table = inner;
    }
    at
}

/// The dotted name of the innermost key or value around an offset.
fn field_at(text: &str, offset: usize) -> Option<String> {
    fn search(table: &DeTable<'_>, offset: usize, prefix: &str) -> Option<String> {
        table.iter().find_map(|(key, value)| {
            let name = if prefix.is_empty() {
                key.get_ref().to_string()
            } else {
                format!("{prefix}.{}", key.get_ref())
            };
            if let DeValue::Table(inner) = value.get_ref()
                && let Some(found) = search(inner, offset, &name)
            {
                return Some(found);
            }
            let hit = key.span().contains(&offset) || value.span().contains(&offset);
            hit.then_some(name)
        })
    }
    search(DeTable::parse(text).ok()?.get_ref(), offset, "")
}
