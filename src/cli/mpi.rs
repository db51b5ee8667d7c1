//! Processes that talk by MPI: those that `mpirun` or `srun` started together.

use super::output::{mute, warn};
use super::together::exchanged_since;
use super::{CliError, exit_with};
use imdp::ranks::{self, Notice, Ranks};
use mpi::datatype::PartitionMut;
use mpi::environment::Universe;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Equivalence};
use std::fmt;
use std::process::ExitCode;
use std::rc::Rc;
use std::time::Instant;

/// How many numbers are sent at once: MPI counts in 31 bits, and what is sent stands in memory twice.
const AT_ONCE: usize = 1 << 24;

/// The exit code of processes that were ended because they no longer did the same.
const ASTRAY: u8 = 4;

/// All processes of a job.
pub(super) struct Crew {
    world: Rc<World>,
    /// MPI, until it is dropped.
    _universe: Universe,
}

struct World {
    communicator: SimpleCommunicator,
    rank: usize,
    size: usize,
}

impl Crew {
    /// Finds the other processes.
    pub(super) fn assemble() -> Result<Self, CliError> {
        // Only the main thread talks to others.
        let started = mpi::initialize_with_threading(mpi::Threading::Funneled);
        let Some((universe, _)) = started else {
            return Err(CliError::Failure(
                "MPI: found it initialized already; expected it not to be".to_owned(),
            ));
        };
        let communicator = universe.world();
        let (rank, size) = (communicator.rank() as usize, communicator.size() as usize);
        mute(rank > 0);
        Ok(Self { world: Rc::new(World { communicator, rank, size }), _universe: universe })
    }

    /// Runs a tool whose work is shared.
    pub(super) fn work(
        &self,
        tool: impl FnOnce() -> Result<ExitCode, CliError>,
    ) -> Result<ExitCode, CliError> {
        let ranks: Rc<dyn Ranks> = Rc::<World>::clone(&self.world);
        ranks::join(ranks);
        let outcome = tool();
        ranks::leave();
        outcome
    }

    /// Ends together with the others; where one fails and others do not, all are ended.
    pub(super) fn part(&self, outcome: Result<ExitCode, CliError>) -> ExitCode {
        let world = &self.world;
        if world.size == 1 {
            return exit_with(outcome);
        }
        let own = Notice::End { failure: outcome.as_ref().map_or_else(CliError::exit_code, |_| 0) };
        let notices = world.notices(own);
        // What the first one says and returns, the others need not: a job ends with the first code that is not 0.
        let follows = world.rank > 0 && (outcome.is_ok() || notices[0] == own);
        mute(follows);
        let of_rank = |text| if world.rank == 0 { text } else { format!("rank {}: {text}", world.rank) };
        let code = exit_with(outcome.map_err(|error| match error {
            CliError::Input(text) => CliError::Input(of_rank(text)),
            CliError::Failure(text) => CliError::Failure(of_rank(text)),
            CliError::Interrupted => CliError::Interrupted,
        }));
        if notices.iter().all(|notice| matches!(notice, Notice::End { .. })) {
            return if follows { ExitCode::SUCCESS } else { code };
        }
        world.disband(&notices)
    }
}

impl World {
    fn complete<T: Equivalence + Copy>(&self, array: &mut [T], ends: &[usize]) {
        let start = Instant::now();
        let begin = |rank: usize| rank.checked_sub(1).map_or(0, |before| ends[before]);
        for from in (0..array.len()).step_by(AT_ONCE) {
            let window = from..(from + AT_ONCE).min(array.len());
            let within = |place: usize| place.clamp(window.start, window.end) - window.start;
            let starts: Vec<i32> = (0..self.size).map(|rank| within(begin(rank)) as i32).collect();
            let counts: Vec<i32> =
                (0..self.size).map(|rank| within(ends[rank]) as i32 - starts[rank]).collect();
            let window = &mut array[window];
            let first = starts[self.rank] as usize;
            let own = window[first..first + counts[self.rank] as usize].to_vec();
            let mut parts = PartitionMut::new(window, counts, starts);
            self.communicator.all_gather_varcount_into(&own[..], &mut parts);
        }
        exchanged_since(start, size_of_val(array));
    }
}

impl Ranks for World {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn notices(&self, own: Notice) -> Vec<Notice> {
        let start = Instant::now();
        let mut words = vec![0; self.size];
        self.communicator.all_gather_into(&own.word(), &mut words[..]);
        exchanged_since(start, size_of_val(&words[..]));
        words.into_iter().map(Notice::of_word).collect()
    }

    fn complete_doubles(&self, array: &mut [f64], ends: &[usize]) {
        self.complete(array, ends);
    }

    fn complete_integers(&self, array: &mut [u32], ends: &[usize]) {
        self.complete(array, ends);
    }

    fn disband(&self, notices: &[Notice]) -> ! {
        let failures = notices.iter().filter_map(|notice| match notice {
            Notice::End { failure } => Some(*failure),
            _ => None,
        });
        let failure = failures.max().filter(|&code| code > 0);
        if failure.is_none() {
            let have_read = notices.iter().all(|notice| matches!(notice, Notice::Input { .. }));
            let found = if have_read { "have read different input" } else { "no longer do the same" };
            warn(&format!(
                "error: found processes that {found}; expected the same program and the same files on all machines\n"
            ));
        }
        // What was said is out before everybody is ended.
        self.communicator.all_gather_into(&0u64, &mut vec![0u64; self.size][..]);
        self.communicator.abort(failure.unwrap_or(ASTRAY).into())
    }
}

impl fmt::Debug for World {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "process {} of {}", self.rank, self.size)
    }
}
