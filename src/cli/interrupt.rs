//! Ctrl-C: where a run watches for it, once, and the run stops with its best point; else, or twice, the process ends.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static WATCHED: AtomicBool = AtomicBool::new(false);

/// The exit code of an interrupted run.
const EXIT_INTERRUPTED: i32 = 5;

/// Installs the handler, before anything else: from then on Ctrl-C ends every command with the exit code docs/verdict.md states.
pub fn install() {
    let handler = || {
        let again = INTERRUPTED.swap(true, Ordering::SeqCst);
        if again || !WATCHED.load(Ordering::SeqCst) {
            std::process::exit(EXIT_INTERRUPTED);
        }
    };
    // Without a handler Ctrl-C still ends the process; logs hold whole rows all the same.
    let _ = ctrlc::set_handler(handler);
}

/// Nothing watches for Ctrl-C any more: the next one ends the process.
pub fn release() {
    WATCHED.store(false, Ordering::SeqCst);
}

/// The exit code of a command, or that of an interrupted one where Ctrl-C came in between.
pub fn code(otherwise: u8) -> u8 {
    if INTERRUPTED.load(Ordering::SeqCst) { EXIT_INTERRUPTED as u8 } else { otherwise }
}

/// The flag Ctrl-C sets, from now on watched by a run. To be called when everything is read: what waits for a file or a
/// terminal looks at no flag.
pub fn flag() -> &'static AtomicBool {
    WATCHED.store(true, Ordering::SeqCst);
    &INTERRUPTED
}
