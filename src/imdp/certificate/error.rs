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
    #[error("this is not a certificate: found `{found}` in the first line; expected `{expected}`")]
    NotACertificate {
        /// The first line, or its beginning.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// The last line is missing or incomplete.
    #[error("the certificate is truncated: found no line `end <sha256>` at its end; copy it anew")]
    Truncated,
    /// Something was changed.
    #[error("the certificate is damaged: the SHA-256 in its last line is not that of what stands before it")]
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
