//! Progress bars for people who wait.

use super::output::is_muted;
use super::phases::{Phase, Phases, shown};
use imdp::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Notes change no faster than people read.
const NOTE_INTERVAL: Duration = Duration::from_millis(100);
/// Work whose end is known.
const BAR: &str = "{prefix:20} {bar:30} {percent:>3} %  {msg}";
/// Iterations until bounds are close enough.
const SPINNER: &str = "{spinner} {prefix}, {msg}";
/// What iterations are called among the phases.
pub(super) const SOLVING: &str = "solving";

/// Progress bars on stderr; none if it is not a terminal or `quiet`.
#[derive(Debug)]
pub struct Bars {
    quiet: bool,
    begun: Instant,
    interrupt: AtomicBool,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    phases: Phases,
    current: Option<Current>,
}

#[derive(Debug)]
struct Current {
    bar: ProgressBar,
    since: Instant,
    /// When the last note was shown, counted from `since`.
    noted: Option<Duration>,
    shown: bool,
}

impl Current {
    fn new(total: Option<u64>, template: &str) -> Self {
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template(template);
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, since: Instant::now(), noted: None, shown: false }
    }

    fn show_after_a_while(&mut self, quiet: bool) {
        if !self.shown && !quiet && self.since.elapsed() > PATIENCE {
            // indicatif draws nothing where stderr is not a terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.shown = true;
        }
    }

    /// Shows a note, unless people still read the last one; `text` is only made then.
    fn note(&mut self, text: impl FnOnce(&ProgressBar)) {
        let elapsed = self.since.elapsed();
        if self.shown && self.noted.is_none_or(|noted| elapsed > noted + NOTE_INTERVAL) {
            self.noted = Some(elapsed);
            text(&self.bar);
        }
    }
}

impl Bars {
    /// Bars, unless `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self {
            quiet: quiet || is_muted(),
            begun: Instant::now(),
            interrupt: AtomicBool::new(false),
            state: Mutex::default(),
        }
    }

    /// Says which phases there will be.
    pub(super) fn expect(&self, plan: Vec<Phase>) {
        self.with(|state| state.phases = Phases::new(plan));
    }

    /// Asks the work to end; returns whether that was asked before.
    pub(super) fn interrupt(&self) -> bool {
        self.interrupt.swap(true, Ordering::Relaxed)
    }

    fn with(&self, action: impl FnOnce(&mut State)) {
        action(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// The time until all phases are over; of the current one alone, where only that can be told.
    fn left(&self, phases: &Phases, bar: &ProgressBar) -> String {
        let done = bar.position() as f64 / bar.length().unwrap_or(0).max(1) as f64;
        let left = phases.left(self.begun.elapsed(), done).unwrap_or_else(|| bar.eta());
        format!("{} left", shown(left))
    }
}

impl Progress for Bars {
    fn start(&self, phase: &str, total: u64) {
        self.with(|State { phases, current }| {
            phases.begin(phase);
            let begun = Current::new(Some(total), BAR);
            begun.bar.set_prefix(format!("{}{phase}", phases.number()));
            *current = Some(begun);
        });
    }

    fn advance(&self, units: u64) {
        self.with(|State { phases, current }| {
            let Some(current) = current else { return };
            current.bar.inc(units);
            current.show_after_a_while(self.quiet);
            current.note(|bar| bar.set_message(self.left(phases, bar)));
        });
    }

    fn iterate(&self, iterations: u64, of: Option<u64>, distance: f64) {
        self.with(|State { phases, current }| {
            let current = current.get_or_insert_with(|| {
                phases.begin(SOLVING);
                Current::new(of, if of.is_some() { BAR } else { SPINNER })
            });
            current.show_after_a_while(self.quiet);
            current.note(|bar| {
                let number = phases.number();
                match of {
                    Some(of) => {
                        bar.set_length(of);
                        bar.set_position(iterations);
                        bar.set_prefix(format!("{number}iteration {iterations}/{of}"));
                        bar.set_message(self.left(phases, bar));
                    }
                    None => {
                        bar.set_prefix(format!("{number}iteration {iterations}"));
                        bar.set_message(format!("{distance:.1e} apart"));
                        bar.tick();
                    }
                }
            });
        });
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    fn finish(&self) {
        self.with(|state| {
            if let Some(current) = state.current.take() {
                current.bar.finish_and_clear();
            }
        });
    }
}
