//! Certificates: honest ones are accepted, false ones are not.
mod command_line;
mod derivations;
mod falsified;
mod files;
mod oracle;
mod random;
mod shipped;
