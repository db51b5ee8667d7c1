//! File formats of interval MDPs.

pub mod bmdp;
pub mod drn;
mod encoding;
mod format;
mod hashing;
mod import;
mod names;
pub mod native;
pub mod netcdf;
pub mod prism;
pub mod row_states;
pub mod umb;
mod writer;

pub use encoding::Encoding;
pub use format::Format;
pub use hashing::{HashingWriter, sha256_hex, sha256_of_file};
pub use import::{ImportError, Imported, Place, Position, Warning};
pub use names::{ChangedName, NameError, Names, identifiers};
pub use writer::{ModelWriter, WriteError};
