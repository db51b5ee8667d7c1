//! Jobs for the machines of a cluster.

use super::job::{Job, quoted};
use crate::CliError;
use imdp::files::Outputs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The script that hands all jobs to Slurm.
const SCRIPT: &str = "sweep.sbatch";
/// What each of them runs.
const RUN: &str = "run.sh";

/// Writes a script for an array of jobs; every job has one of its own.
///
/// # Errors
/// [`CliError`] if that fails.
pub(super) fn write(jobs: &[Job], below: &Path) -> Result<PathBuf, CliError> {
    let script = below.join(SCRIPT);
    let write = || -> io::Result<()> {
        let mut files = Outputs::default();
        for job in jobs {
            files.write(&job.directory.join(RUN), |out| out.write_all(job.line().as_bytes()))?;
        }
        let below = below.canonicalize()?.display().to_string();
        files.write(&script, |out| {
            writeln!(out, "#!/bin/sh")?;
            writeln!(out, "#SBATCH --job-name=dynabs-sweep")?;
            writeln!(out, "#SBATCH --array=1-{}", jobs.len())?;
            writeln!(out, "#SBATCH --output=/dev/null")?;
            writeln!(
                out,
                "# Time, memory and processors of one job: sbatch --time=… --mem=… --cpus-per-task=… {SCRIPT}"
            )?;
            writeln!(
                out,
                "cd {}/\"$(printf %04d \"$SLURM_ARRAY_TASK_ID\")\" && exec sh {RUN}",
                quoted(&below)
            )
        })?;
        files.commit()
    };
    write().map_err(|error| CliError::writing(&script, &error))?;
    Ok(script)
}
