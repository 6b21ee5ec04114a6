//! A device on a pipe, which may hang.

use crate::cli::failure::Failure;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// Longest answer that is read.
const LONGEST: u64 = 1 << 24;

/// A command that answers each line with a line.
pub(super) struct Device {
    child: Child,
    input: Option<ChildStdin>,
    answers: Receiver<Result<String, String>>,
}

impl Device {
    /// Starts it, by the shell.
    pub(super) fn start(command: &str) -> Result<Self, Failure> {
        let mut shell = Command::new("sh");
        shell.args(["-c", command]).stdin(Stdio::piped()).stdout(Stdio::piped());
        // A group of its own, so that whatever the command started can be stopped with it.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut shell, 0);
        let mut child =
            shell.spawn().map_err(|error| Failure::io(&format!("--device {command}"), &error))?;
        let (send, answers) = channel();
        let output = child.stdout.take();
        std::thread::spawn(move || -> Option<()> {
            let mut output = BufReader::new(output?);
            loop {
                let mut line = String::new();
                let read = std::io::Read::take(&mut output, LONGEST).read_line(&mut line);
                let answer = match read {
                    Ok(0) => return None,
                    Ok(_) => Ok(line),
                    Err(error) => Err(error.to_string()),
                };
                send.send(answer).ok()?;
            }
        });
        let input = child.stdin.take();
        Ok(Self { child, input, answers })
    }

    /// Its answer to a line.
    pub(super) fn ask(&mut self, line: &str, patience: Duration) -> Result<String, String> {
        let written = match &mut self.input {
            Some(input) => writeln!(input, "{line}").and_then(|()| input.flush()),
            None => Ok(()),
        };
        written.map_err(|error| format!("the device does not read: {error}"))?;
        match self.answers.recv_timeout(patience) {
            Ok(answer) => answer.map(|line| line.trim().to_owned()),
            Err(RecvTimeoutError::Timeout) => {
                Err(format!("no answer within {} seconds", patience.as_secs()))
            }
            Err(RecvTimeoutError::Disconnected) => Err("the device ended".to_owned()),
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // The end of its input is the end of its work; what hangs is stopped.
        self.input = None;
        for _ in 0..20 {
            if matches!(self.child.try_wait(), Ok(Some(_))) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let group = format!("kill -s KILL -- -{}", self.child.id());
        let _ = Command::new("sh").args(["-c", &group]).stderr(Stdio::null()).status();
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
