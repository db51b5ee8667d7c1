//! Running a program to its end, or to ours.

use super::EngineFailure;
use super::process_group::Group;
use crate::progress::Progress;
use std::io::{self, Read};
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// How often a running program is looked at.
const POLL: Duration = Duration::from_millis(20);
/// How much of a program's output is kept, at least: its end.
const KEPT: usize = 1 << 16;

/// What a program may use.
#[derive(Clone, Copy)]
pub struct RunLimits<'a> {
    /// How long each question may take.
    pub timeout: Duration,
    /// The memory, in MiB.
    pub memory_mib: u64,
    /// Ends everything when it is interrupted.
    pub progress: &'a dyn Progress,
}

/// How a program ended by itself.
#[derive(Debug)]
pub(super) struct Ended {
    /// What it wrote to standard output and standard error, without the beginning if it was much.
    pub stdout: String,
    pub stderr: String,
    pub time: Duration,
    /// The most memory it and its children had, where the system tells.
    pub peak_mib: Option<u64>,
}

/// Runs a program in a process group of its own, of which nothing is left afterwards.
///
/// The time starts anew whenever `progress` changes. `may_exceed_memory` leaves the memory to the program, which
/// was told about the limit.
pub(super) fn run(
    command: &mut Command,
    limits: &RunLimits<'_>,
    may_exceed_memory: bool,
    progress: impl Fn() -> usize,
) -> Result<Ended, EngineFailure> {
    let start = Instant::now();
    let is_interrupted = || limits.progress.is_interrupted();
    if is_interrupted() {
        return Err(EngineFailure::Interrupted);
    }
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut group = Group::spawn(command).map_err(|error| {
        let command = PathBuf::from(command.get_program());
        EngineFailure::Start { command, error }
    })?;
    let start_failed = |error| EngineFailure::Start { command: PathBuf::from(command.get_program()), error };
    let outputs = [
        group.stdout().map(collect).transpose().map_err(start_failed)?,
        group.stderr().map(collect).transpose().map_err(start_failed)?,
    ];

    let mut peak_mib = None;
    let (mut since, mut seen) = (start, progress());
    let outcome = loop {
        peak_mib = peak_mib.max(group.memory_mib());
        match group.has_ended() {
            Ok(true) => break Ok(()),
            Ok(false) => {}
            Err(error) => {
                break Err(EngineFailure::Start { command: PathBuf::from(command.get_program()), error });
            }
        }
        let now = progress();
        if now != seen {
            (since, seen) = (Instant::now(), now);
        }
        if is_interrupted() {
            break Err(EngineFailure::Interrupted);
        }
        if since.elapsed() >= limits.timeout {
            break Err(EngineFailure::Timeout { seconds: limits.timeout.as_secs_f64() });
        }
        if let Some(used_mib) = peak_mib.filter(|&used| used > limits.memory_mib && !may_exceed_memory) {
            break Err(EngineFailure::Memory { used_mib, given_mib: limits.memory_mib });
        }
        thread::sleep(POLL);
    };
    let time = start.elapsed();
    // Children that outlive the program would keep its output open.
    let status = group.end();
    let [stdout, stderr] =
        outputs.map(|output| output.and_then(|thread| thread.join().ok()).unwrap_or_default());
    outcome?;
    let ended = Ended { stdout, stderr, time, peak_mib };
    match status {
        Ok(status) if status.success() => Ok(ended),
        Ok(status) => Err(ended.failure(status)),
        Err(error) => Err(EngineFailure::Start { command: PathBuf::from(command.get_program()), error }),
    }
}

/// Reads to the end in a thread of its own.
fn collect(mut from: impl Read + Send + 'static) -> io::Result<thread::JoinHandle<String>> {
    thread::Builder::new().spawn(move || {
        let (mut kept, mut piece) = (Vec::new(), [0; 4096]);
        while let Ok(length @ 1..) = from.read(&mut piece) {
            kept.extend_from_slice(&piece[..length]);
            if kept.len() > 2 * KEPT {
                kept.drain(..kept.len() - KEPT);
            }
        }
        String::from_utf8_lossy(&kept).into_owned()
    })
}

impl Ended {
    fn failure(&self, status: ExitStatus) -> EngineFailure {
        let said = self.said();
        #[cfg(unix)]
        if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
            return EngineFailure::Signal { signal, said };
        }
        EngineFailure::Exit { code: status.code().unwrap_or(-1), said }
    }

    /// The program's own error: the lines from the first one that says `Error`, or else the last lines.
    pub(super) fn said(&self) -> String {
        const LINES: usize = 12;
        let all = || self.stdout.lines().chain(self.stderr.lines()).filter(|line| !line.trim().is_empty());
        let is_error = |line: &&str| line.starts_with("Error") || line.starts_with("ERROR");
        let skipped = all().position(|line| is_error(&line)).unwrap_or(all().count().saturating_sub(LINES));
        all().skip(skipped).take(LINES).collect::<Vec<_>>().join("\n    ")
    }
}
