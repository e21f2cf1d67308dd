//! Ctrl-C: once, the run stops with its best point; twice, the process ends.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// The exit code of an interrupted run.
const EXIT_INTERRUPTED: i32 = 5;

/// Installs the handler and hands out the flag it sets.
pub fn flag() -> &'static AtomicBool {
    let handler = || {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_INTERRUPTED);
        }
    };
    // Without a handler Ctrl-C still ends the process; logs hold whole rows all the same.
    let _ = ctrlc::set_handler(handler);
    &INTERRUPTED
}
