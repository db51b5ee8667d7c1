//! What happens when the system or the user wants the program to end.

use super::{Bars, CliError, warn};
use std::sync::{Arc, Mutex, PoisonError};

/// How long a signal that no user sent from the keyboard waits for a clean end.
#[cfg(unix)]
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(10);

/// Who is asked to end cleanly; without anybody, the program ends at once.
static LISTENER: Mutex<Option<Arc<Bars>>> = Mutex::new(None);

impl Bars {
    /// Takes Ctrl-C from now on: the first one asks the work to end cleanly, the second one ends the program.
    pub fn catch_interrupts(self: &Arc<Self>) {
        *LISTENER.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(self));
    }
}

/// Takes signals from now on: whatever ends the program leaves nothing behind and gives a documented exit code.
///
/// A write beyond the limit on the size of files (`XFSZ`) becomes an error of that write, and an abort, which is what
/// happens when memory runs out, exit code 4. A signal that the caller has the program ignore stays ignored.
///
/// # Errors
/// [`CliError::Failure`] if the system does not let us.
#[cfg(unix)]
pub(crate) fn watch() -> Result<(), CliError> {
    use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGXFSZ};
    use std::sync::atomic::AtomicBool;
    let failure = |error| {
        CliError::Failure(format!(
            "signals: found {error}; expected that they can be caught and that a thread can wait for them"
        ))
    };
    let always = Arc::new(AtomicBool::new(true));
    signal_hook::flag::register_conditional_shutdown(SIGABRT, 4, Arc::clone(&always)).map_err(failure)?;
    signal_hook::flag::register(SIGXFSZ, always).map_err(failure)?;
    let ending = [SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU];
    let wanted = ending.into_iter().filter(|&signal| !is_ignored(signal));
    let mut signals = signal_hook::iterator::Signals::new(wanted).map_err(failure)?;
    let wait = move || {
        for signal in signals.forever() {
            ask();
            // Who waits for a pipe that nobody reads does not notice that it is asked; at the keyboard one asks again.
            if signal != SIGINT {
                let patience = || {
                    std::thread::sleep(PATIENCE);
                    end();
                };
                // Without a thread for it, a second signal ends the program.
                let _ = std::thread::Builder::new().name("patience".into()).spawn(patience);
            }
        }
    };
    std::thread::Builder::new().name("signals".into()).spawn(wait).map_err(failure)?;
    Ok(())
}

#[cfg(not(unix))]
pub(crate) fn watch() -> Result<(), CliError> {
    Ok(())
}

/// Asks for a clean end; if that was done before, ends the program.
#[cfg(unix)]
fn ask() {
    let listener = LISTENER.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let asked_before = listener.is_none_or(|bars| bars.interrupt());
    if asked_before {
        end();
    }
}

/// Ends the program, and leaves nothing behind.
#[cfg(unix)]
fn end() {
    imdp::files::abandon_all();
    warn("error: interrupted\n");
    std::process::exit(3);
}

/// Whether the program was started with a signal ignored, as `nohup` does.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}
