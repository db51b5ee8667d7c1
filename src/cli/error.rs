//! Errors as the tools report them, and their exit codes.

use dynabs::Diagnostic;
use dynabs::abstraction::AbstractionError;
use dynabs::explain::GroupingTable;
use dynabs::run::RunDirectoryError;
use dynabs::system::GroupingTrial;
use imdp::files::{is_fault_of_input, is_interruption};
use std::io;
use std::path::Path;

/// Why a tool stopped.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The input is wrong (exit code 2).
    #[error("{0}")]
    Input(String),
    /// The system or this program failed (exit code 4).
    #[error("{0}")]
    Failure(String),
    /// The user ended it before there was anything to say (exit code 3).
    #[error("interrupted")]
    Interrupted,
}

impl From<Diagnostic> for CliError {
    fn from(error: Diagnostic) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<RunDirectoryError> for CliError {
    fn from(error: RunDirectoryError) -> Self {
        match error {
            RunDirectoryError::Io { error, .. } if is_interruption(&error) => Self::Interrupted,
            RunDirectoryError::Io { .. } => Self::Failure(error.to_string()),
            RunDirectoryError::Raced { .. } | RunDirectoryError::DiskFull { .. } => {
                Self::Failure(format!("{error}{}", remedy(&error)))
            }
            _ => Self::Input(format!("{error}{}", remedy(&error))),
        }
    }
}

/// What to type about an output directory: the library knows no options.
fn remedy(error: &RunDirectoryError) -> &'static str {
    match error {
        RunDirectoryError::Foreign { .. } => {
            "\n  Choose another name with -o; --force replaces only directories written by dynabs-compile."
        }
        RunDirectoryError::Exists { .. } => "\n  Choose another name with -o, or replace it with --force.",
        RunDirectoryError::Raced { .. } => " Run it again, with --force if the other output may go.",
        RunDirectoryError::DiskFull { .. } => {
            "\n  Leave out the explicit files with --no-tra, or choose another disk with -o."
        }
        RunDirectoryError::Format(_) => {
            "\n  Leave out the explicit files with --no-tra, or use --encoding rows, a coarser partition, or a smaller U or U'."
        }
        _ => "",
    }
}

impl CliError {
    /// A file that cannot be read: the wrong one, or the system failed.
    pub fn reading(path: &Path, error: &io::Error) -> Self {
        let text = format!("{}: {error}", path.display());
        if is_fault_of_input(error) { Self::Input(text) } else { Self::Failure(text) }
    }

    /// A file that cannot be written.
    pub fn writing(path: &Path, error: &io::Error) -> Self {
        if is_interruption(error) {
            return Self::Interrupted;
        }
        Self::Failure(format!("{}: {error}", path.display()))
    }

    /// An abstraction that failed, about the model file `file`.
    pub fn of_abstraction(error: &AbstractionError, file: &str) -> Self {
        let diagnostic = match error {
            AbstractionError::NothingEnabled { stabilized: true, .. } => Diagnostic::at(
                "/stabilizer/abstract_input",
                "a lower layer with which no action is enabled in any cell",
                "at least one cell and target such that u = −K(x − x̄) + u′ stays in U with u′ in U′",
            )
            .remedy("Enlarge U′ or U, penalise the input more (a larger R), or use smaller cells."),
            AbstractionError::NothingEnabled { stabilized: false, grouping } => Diagnostic::at(
                "/input",
                "inputs with which no action is enabled in any cell",
                "at least one cell from all of which one target can be reached with u in U",
            )
            .remedy(steering_remedy(grouping)),
            AbstractionError::NothingPlanned => Diagnostic::at(
                "/stabilizer/track",
                "a problem in which no cell can come nearer to what is wanted, and headings that no enabled action is near",
                "a plan that something can follow",
            )
            .remedy("Leave \"stabilizer\" out and see what `dynabs-check explain` says."),
            AbstractionError::NothingClear { group_steps } => Diagnostic::at(
                "/task/unsafe",
                format!(
                    "unsafe regions that every action in every cell may meet at a step between grouped instants, {group_steps} \
                     steps apart"
                ),
                "at least one action that keeps clear of them with the noise of the samples",
            )
            .remedy(
                "Group fewer steps, or enlarge U; {\"check\": \"grouped\"} in /task promises nothing for the steps in between.",
            ),
            AbstractionError::TooFewSamples { samples, needed, unseen } => Diagnostic::at(
                "/noise",
                format!("{samples} samples, which leave up to {unseen:.3} of the probability unseen"),
                format!("at least {needed} samples for this confidence"),
            )
            .remedy("Collect more samples or lower the confidence."),
            AbstractionError::Memory(error) => error.into(),
            AbstractionError::Foreign => {
                return Self::Input(format!(
                    "{file}: found another problem's model; expected the one compiled from it\n  Compile it again."
                ));
            }
            AbstractionError::Budget(_)
            | AbstractionError::Invalid(_)
            | AbstractionError::Scout(_)
            | AbstractionError::NotSteerable => {
                return Self::Failure(format!(
                    "{file}: {error}\n  This is a mistake in dynabs; please report it."
                ));
            }
        };
        diagnostic.in_file(file).into()
    }
}

/// What to change where nothing is enabled, by which factor.
fn steering_remedy(grouping: &[GroupingTrial]) -> String {
    let general = "Enlarge U, use smaller cells, or group more steps";
    let listed = GroupingTable(grouping);
    let inputs = "\n  With \"actions\": \"inputs\" nothing needs to be steered to a point.";
    match grouping.iter().min_by(|one, other| one.share.total_cmp(&other.share)) {
        Some(best) if best.share > 1.0 => format!(
            "{general}: with {} steps, cells {:.4} times smaller or a range of input {} so many times larger would do.{listed}{inputs}",
            best.steps,
            best.share,
            best.input + 1
        ),
        _ => format!("{general}.{listed}{inputs}"),
    }
}
