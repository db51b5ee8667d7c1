//! Why a file is no certificate.

use crate::model::MemoryError;

/// A file that is not a certificate, or no longer the one that was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CertificateError {
    /// The file cannot be read.
    #[error("cannot read the certificate: {0}")]
    Io(#[from] std::io::Error),
    /// The first line is another one.
    #[error("found `{found}` in the first line, so this is not a certificate; expected `{expected}`")]
    NotACertificate {
        /// The first line, or its beginning.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// The last line is missing or incomplete.
    #[error(
        "found a certificate that is truncated, without a line `end <sha256>` at its end; expected all of it; copy it anew"
    )]
    Truncated,
    /// Something was changed.
    #[error(
        "found a certificate that is damaged: the SHA-256 in its last line is not that of what stands before it; expected it as \
         it was written; copy it anew"
    )]
    Digest,
    /// A line is not what it should be.
    #[error("line {line} of the certificate: found `{found}`; expected {expected}")]
    Line {
        /// The line, counted from 1.
        line: usize,
        /// What stands there, or its beginning.
        found: String,
        /// What should.
        expected: String,
    },
    /// The certificate does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}
