//! `dynabs init`: a model file to start from.

use crate::extensions::require_extension;
use crate::{CliError, print};
use dynabs::model_file::starter_model;
use imdp::files::Outputs;
use std::io::{self, Write};
use std::path::Path;

/// The file in which editors look for the schema: what `$schema` of the starter says.
const SCHEMA: &str = "dynabs-problem.schema.json";

/// Writes a model file to start from.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub(super) fn write_starter(file: &Path, quiet: bool) -> Result<(), CliError> {
    let shown = file.display();
    require_extension("--init", file, &["json"])?;
    let mut files = Outputs::default();
    let written = files.write(file, |out| out.write_all(starter_model().as_bytes()));
    written.and_then(|()| files.commit_new()).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => CliError::Input(format!(
            "{shown}: found a file; expected a new name, since --init never overwrites"
        )),
        io::ErrorKind::NotFound => {
            CliError::Input(format!("{shown}: found no such directory; expected one that exists"))
        }
        _ => CliError::writing(file, &error),
    })?;
    if !quiet {
        print(&format!(
            "Wrote {shown}. Try it:\n  dynabs-compile {shown} --dry-run\nFor editors that complete and check:\n  dynabs schema \
             problem > {schema}\n",
            schema = file.with_file_name(SCHEMA).display()
        ))?;
    }
    Ok(())
}
