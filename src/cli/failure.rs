//! How the command reports an error: one `error:` line, a hint, an exit status.

use guardbit::profile::ProfileError;
use guardbit::scene::SceneError;
use std::process::ExitCode;

/// Why a command stopped.
#[derive(Debug)]
pub(crate) struct Failure {
    status: u8,
    message: String,
    hint: Option<String>,
}

impl Failure {
    /// Usage or bad input: exit status 2.
    #[allow(clippy::needless_pass_by_value, reason = "so that it serves as a function for map_err")]
    pub(crate) fn input(message: impl ToString) -> Self {
        Self { status: 2, message: message.to_string(), hint: None }
    }

    /// Input or output failed: exit status 3.
    pub(crate) fn io(what: &str, error: &std::io::Error) -> Self {
        if error.kind() == std::io::ErrorKind::BrokenPipe {
            // Whoever read us has seen enough: a quiet, good end.
            return Self { status: 0, message: String::new(), hint: None };
        }
        Self { status: 3, message: format!("{what}: {error}"), hint: None }
    }

    /// Stopped by Ctrl-C: exit status 130, as shells expect.
    pub(crate) fn interrupted(message: &str) -> Self {
        Self { status: 130, message: message.to_owned(), hint: None }
    }

    /// Adds what to do about it.
    pub(crate) fn hint(mut self, hint: &str) -> Self {
        self.hint = Some(hint.to_owned());
        self
    }

    /// Prints and converts to the exit status.
    pub(crate) fn report(self) -> ExitCode {
        if !self.message.is_empty() {
            eprintln!("error: {}", self.message);
        }
        if let Some(hint) = self.hint {
            eprintln!("hint: {hint}");
        }
        ExitCode::from(self.status)
    }
}

impl From<ProfileError> for Failure {
    fn from(error: ProfileError) -> Self {
        let status = if error.is_io() { 3 } else { 2 };
        Self { status, message: error.to_string(), hint: None }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let status = if matches!(error, SceneError::Io { .. }) { 3 } else { 2 };
        Self { status, message: error.to_string(), hint: None }
    }
}
