//! Progress bars for people who wait.

use super::output::is_muted;
use imdp::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Notes change no faster than people read.
const NOTE_INTERVAL: Duration = Duration::from_millis(100);

/// Progress bars on stderr; none if it is not a terminal or `quiet`.
#[derive(Debug)]
pub struct Bars {
    quiet: bool,
    interrupt: AtomicBool,
    current: Mutex<Option<Current>>,
}

#[derive(Debug)]
struct Current {
    bar: ProgressBar,
    since: Instant,
    /// When the last note was shown, counted from `since`.
    noted: Duration,
    shown: bool,
}

impl Current {
    fn show_after_a_while(&mut self, quiet: bool) {
        if !self.shown && !quiet && self.since.elapsed() > PATIENCE {
            // indicatif draws nothing where stderr is not a terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.shown = true;
        }
    }
}

impl Bars {
    /// Bars, unless `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self { quiet: quiet || is_muted(), interrupt: AtomicBool::new(false), current: Mutex::new(None) }
    }

    /// Asks the work to end; returns whether that was asked before.
    pub(super) fn interrupt(&self) -> bool {
        self.interrupt.swap(true, Ordering::Relaxed)
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
        self.with(|current| {
            *current = Some(Current { bar, since: Instant::now(), noted: Duration::ZERO, shown: false })
        });
    }

    fn advance(&self, units: u64) {
        self.with(|current| {
            let Some(current) = current else { return };
            current.bar.inc(units);
            current.show_after_a_while(self.quiet);
        });
    }

    fn iterate(&self, iterations: u64, distance: f64) {
        self.with(|current| {
            let current = current.get_or_insert_with(|| {
                let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
                bar.set_style(ProgressStyle::default_spinner());
                Current { bar, since: Instant::now(), noted: Duration::ZERO, shown: false }
            });
            current.show_after_a_while(self.quiet);
            if current.shown && current.since.elapsed() > current.noted + NOTE_INTERVAL {
                current.noted = current.since.elapsed();
                current.bar.set_message(format!("iteration {iterations}, {distance:.1e} apart"));
                current.bar.tick();
            }
        });
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    fn finish(&self) {
        self.with(|current| {
            if let Some(current) = current.take() {
                current.bar.finish_and_clear();
            }
        });
    }
}
