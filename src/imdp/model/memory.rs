//! Refusing what cannot fit before it is allocated.

/// More memory would be needed than there is.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what} needs about {needed_mib} MiB of memory, {available_mib} MiB are available")]
pub struct MemoryError {
    /// What would be allocated.
    pub what: String,
    /// The estimate, in MiB.
    pub needed_mib: u64,
    /// What the system has available, in MiB.
    pub available_mib: u64,
}

/// The memory that can still be allocated, in bytes; `None` where the system does not tell.
///
/// The lesser of the machine's available memory and what is left of the control group's limit.
pub fn available_memory() -> Option<u64> {
    let machine = std::fs::read_to_string("/proc/meminfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
        Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
    });
    let number = |path: &str| std::fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let group = number("/sys/fs/cgroup/memory.max")
        .map(|limit| limit.saturating_sub(number("/sys/fs/cgroup/memory.current").unwrap_or(0)));
    match (machine, group) {
        (Some(machine), Some(group)) => Some(machine.min(group)),
        (one, other) => one.or(other),
    }
}

/// Fails if `bytes` more than the available memory would be needed for `what`.
///
/// # Errors
/// [`MemoryError`] with the estimate.
pub fn require_memory(what: impl Into<String>, bytes: u64) -> Result<(), MemoryError> {
    match available_memory() {
        Some(available) if bytes > available => Err(MemoryError {
            what: what.into(),
            needed_mib: bytes.div_ceil(1 << 20),
            available_mib: available >> 20,
        }),
        _ => Ok(()),
    }
}
