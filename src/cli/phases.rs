//! The phases of a command, and how long all of them take.

use std::time::Duration;

/// The phase in which files are written, each of which is announced by its own name.
pub(super) const FILES: &str = "files";

/// A phase, and the part of the time that it takes as a rule: only the ratios count.
pub(super) type Phase = (&'static str, f64);

/// The phases that a command has, in their order, and which of them is under way.
#[derive(Debug, Default)]
pub(super) struct Phases {
    plan: Vec<Phase>,
    current: Option<usize>,
}

impl Phases {
    /// None of these has begun.
    pub(super) fn new(plan: Vec<Phase>) -> Self {
        Self { plan, current: None }
    }

    /// Begins the phase of this name: what work calls itself, or a file.
    pub(super) fn begin(&mut self, name: &str) {
        let next = self.current.map_or(0, |current| current + 1);
        let is_it = |phase: &str| phase == name || phase == FILES && name.contains('.');
        // What nobody planned, or only once, belongs to the phase before it.
        let found = self.plan.iter().skip(next).position(|&(phase, _)| is_it(phase));
        self.current = found.map(|ahead| next + ahead).or(self.current);
    }

    /// `3/5 `; nothing where one phase is all.
    pub(super) fn number(&self) -> String {
        match (self.current, self.plan.len()) {
            (Some(current), 2..) => format!("{}/{} ", current + 1, self.plan.len()),
            _ => String::new(),
        }
    }

    /// The time until all phases are over, if `elapsed` have led to the part `done` of the current one; none where that is
    /// too little to tell.
    pub(super) fn left(&self, elapsed: Duration, done: f64) -> Option<Duration> {
        let current = self.current?;
        let of = |phases: &[Phase]| phases.iter().map(|(_, part)| part).sum::<f64>();
        let (before, all) = (of(&self.plan[..current]), of(&self.plan));
        let done = (before + self.plan[current].1 * done.clamp(0.0, 1.0)) / all;
        (done > 0.02).then(|| elapsed.mul_f64((1.0 - done) / done))
    }
}

/// A time for people who wait.
pub(super) fn shown(time: Duration) -> String {
    match time.as_secs() {
        seconds @ ..60 => format!("{} s", seconds + 1),
        seconds @ 60..3600 => format!("{} min", seconds.div_ceil(60)),
        seconds => format!("{:.1} h", seconds as f64 / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_counted_and_time_is_shared_out() {
        let mut phases = Phases::new(vec![("actions", 1.0), ("rows", 2.0), ("solving", 1.0), (FILES, 1.0)]);
        assert_eq!((phases.number(), phases.left(Duration::from_secs(1), 0.5)), (String::new(), None));
        phases.begin("actions");
        assert_eq!(phases.number(), "1/4 ");
        assert_eq!(phases.left(Duration::from_secs(1), 1.0), Some(Duration::from_secs(4)));
        // Nothing is foretold from nothing.
        assert_eq!(phases.left(Duration::from_secs(1), 0.0), None);
        // So much of all is done when these begin.
        let begun = [
            ("rows", "2/4 ", 1),
            ("choice of windows", "2/4 ", 1),
            ("solving", "3/4 ", 3),
            ("model.tra", "4/4 ", 4),
        ];
        for (name, number, done) in begun {
            phases.begin(name);
            assert_eq!(phases.number(), number, "{name}");
            assert_eq!(
                phases.left(Duration::from_secs(done), 0.0),
                Some(Duration::from_secs(5 - done)),
                "{name}"
            );
        }
        assert_eq!(phases.left(Duration::from_secs(9), 1.0), Some(Duration::ZERO));
    }

    #[test]
    fn times_are_short() {
        let times = [(0, "1 s"), (59, "60 s"), (60, "1 min"), (61, "2 min"), (5400, "1.5 h")];
        for (seconds, text) in times {
            assert_eq!(shown(Duration::from_secs(seconds)), text);
        }
    }
}
