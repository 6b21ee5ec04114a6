//! Progress on standard error, and Ctrl-C.

use guardbit::vector::write::Monitor;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// The monitor that Ctrl-C cancels: one for the process, which has one handler.
pub(crate) fn monitor() -> Arc<Monitor> {
    static MONITOR: OnceLock<Arc<Monitor>> = OnceLock::new();
    let monitor = MONITOR.get_or_init(|| {
        let monitor = Arc::new(Monitor::default());
        let handle = Arc::clone(&monitor);
        // Without a handler Ctrl-C ends the process at once: worse, but no reason to refuse the
        // work.
        let _ = ctrlc::set_handler(move || {
            if let Some(message) = *AT_ONCE.lock().unwrap_or_else(PoisonError::into_inner) {
                eprintln!("error: {message}");
                std::process::exit(130);
            }
            handle.cancel.store(true, Ordering::Relaxed);
        });
        monitor
    });
    Arc::clone(monitor)
}

/// What Ctrl-C says as it ends the process, while there is nothing to tidy up.
static AT_ONCE: Mutex<Option<&'static str>> = Mutex::new(None);

/// Runs work that writes nothing, so that Ctrl-C and SIGTERM may end it at any moment: one picture of a large
/// window takes minutes.
pub(crate) fn at_once<T>(message: &'static str, work: impl FnOnce() -> T) -> T {
    let say = |what| *AT_ONCE.lock().unwrap_or_else(PoisonError::into_inner) = what;
    say(Some(message));
    let result = work();
    say(None);
    result
}

/// Runs `work` while its time and a byte counter show, if standard error is a terminal.
pub(crate) fn watch<T>(what: &'static str, monitor: &Monitor, work: impl FnOnce() -> T) -> T {
    if !std::io::stderr().is_terminal() {
        return work();
    }
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed} {bytes}") {
        bar.set_style(style);
    }
    bar.set_message(what);
    show(&bar, || monitor.bytes.load(Ordering::Relaxed), work)
}

/// Runs `work` while a counter shows against its end, if standard error is a terminal.
pub(crate) fn count<T>(whole: u64, done: &AtomicU64, work: impl FnOnce() -> T) -> T {
    if !std::io::stderr().is_terminal() {
        return work();
    }
    let bar = ProgressBar::with_draw_target(Some(whole), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {elapsed} left {eta}") {
        bar.set_style(style);
    }
    show(&bar, || done.load(Ordering::Relaxed), work)
}

/// Runs `work` while a bar follows a position.
fn show<T>(bar: &ProgressBar, position: impl Fn() -> u64 + Sync, work: impl FnOnce() -> T) -> T {
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                bar.set_position(position());
                std::thread::sleep(Duration::from_millis(80));
            }
        });
        let result = work();
        done.store(true, Ordering::Relaxed);
        bar.finish_and_clear();
        result
    })
}
