//! File formats of interval MDPs.

pub mod bmdp;
pub mod drn;
mod encoding;
mod format;
mod hashing;
mod held;
mod import;
pub(crate) mod json_number;
mod names;
pub mod native;
pub mod netcdf;
mod policy_entry;
pub mod prism;
pub mod row_states;
mod state_values;
mod text_line;
pub mod umb;
mod writer;

pub use encoding::Encoding;
pub use format::Format;
pub use hashing::{HashingWriter, sha256_hex, sha256_of_file};
pub use held::Held;
pub use import::{ImportError, Imported, Place, Position, Warning};
pub use names::{ChangedName, NameError, Names, identifiers};
pub use policy_entry::PolicyEntry;
pub use state_values::StateValues;
pub use text_line::LineError;
pub use writer::{ModelWriter, WriteError};
