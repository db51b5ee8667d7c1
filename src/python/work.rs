//! Long work: other threads of Python go on, and Ctrl-C ends it.

use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How often Python is asked whether a signal has come.
const PATIENCE: Duration = Duration::from_millis(50);

/// Runs work that looks at a flag from time to time, without holding the interpreter.
///
/// # Errors
/// What a signal raises, such as `KeyboardInterrupt`: the flag is set then, and what the work came to is dropped.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    py.detach(|| {
        std::thread::scope(|scope| {
            let (done, ended) = channel::<()>();
            let flag = &stop;
            let worker = scope.spawn(move || {
                let result = work(flag);
                drop(done);
                result
            });
            let mut signal = Ok(());
            while ended.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                if signal.is_ok() {
                    signal = Python::attach(|py| py.check_signals());
                    stop.store(signal.is_err(), Ordering::Relaxed);
                }
            }
            match worker.join() {
                Ok(result) => signal.map(|()| result),
                // PyO3 makes an exception of it.
                Err(panic) => std::panic::resume_unwind(panic),
            }
        })
    })
}
