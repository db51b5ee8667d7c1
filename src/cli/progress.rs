//! Progress bars for people who wait.

use crate::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// Progress bars on stderr; none if it is not a terminal or `quiet`.
#[derive(Debug)]
pub struct Bars {
    quiet: bool,
    current: Mutex<Option<Current>>,
}

#[derive(Debug)]
struct Current {
    bar: ProgressBar,
    since: Instant,
    shown: bool,
}

impl Bars {
    /// Bars, unless `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self { quiet, current: Mutex::new(None) }
    }

    fn with(&self, action: impl FnOnce(&mut Option<Current>)) {
        action(&mut self.current.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

impl Progress for Bars {
    fn start(&self, phase: &str, total: u64) {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg:16} {bar:40} {percent:>3} %  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_message(phase.to_owned());
        self.with(|current| *current = Some(Current { bar, since: Instant::now(), shown: false }));
    }

    fn advance(&self, units: u64) {
        self.with(|current| {
            let Some(current) = current else { return };
            current.bar.inc(units);
            if !current.shown && !self.quiet && current.since.elapsed() > PATIENCE {
                // indicatif draws nothing where stderr is not a terminal.
                current.bar.set_draw_target(ProgressDrawTarget::stderr());
                current.shown = true;
            }
        });
    }

    fn finish(&self) {
        self.with(|current| {
            if let Some(current) = current.take() {
                current.bar.finish_and_clear();
            }
        });
    }
}
