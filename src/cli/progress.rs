//! Progress on standard error, and Ctrl-C.

use guardbit::vector::write::Monitor;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

/// The monitor that Ctrl-C cancels: one for the process, which has one handler.
pub(crate) fn monitor() -> Arc<Monitor> {
    static MONITOR: OnceLock<Arc<Monitor>> = OnceLock::new();
    let monitor = MONITOR.get_or_init(|| {
        let monitor = Arc::new(Monitor::default());
        let handle = Arc::clone(&monitor);
        // Without a handler Ctrl-C ends the process at once: worse, but no reason to refuse the
        // work.
        let _ = ctrlc::set_handler(move || handle.cancel.store(true, Ordering::Relaxed));
        monitor
    });
    Arc::clone(monitor)
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
