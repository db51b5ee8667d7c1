//! Refusing what cannot fit before it is allocated.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// More memory would be needed than there is.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: found {available_mib} MiB of memory available ({limit}); expected about {needed_mib} MiB")]
pub struct MemoryError {
    /// What would be allocated.
    pub what: String,
    /// The estimate, in MiB.
    pub needed_mib: u64,
    /// What can still be allocated, in MiB.
    pub available_mib: u64,
    /// Whose limit that is.
    pub limit: MemoryLimit,
}

/// Who limits the memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MemoryLimit {
    /// What the machine has.
    Machine,
    /// What the control group of this process may use.
    ControlGroup,
    /// What this process may use (`ulimit -v`, `ulimit -d`).
    Process,
    /// What was given to [`limit_memory`].
    Given,
}

/// What was given to [`limit_memory`].
static GIVEN: AtomicU64 = AtomicU64::new(u64::MAX);

/// From now on this process is to use so many bytes at most: what would need more is refused.
pub fn limit_memory(bytes: u64) {
    GIVEN.store(bytes, Ordering::Relaxed);
}

/// What was given to [`limit_memory`].
pub fn given_memory() -> Option<u64> {
    Some(GIVEN.load(Ordering::Relaxed)).filter(|&bytes| bytes < u64::MAX)
}

/// The most memory that this process has had at a time, in bytes; `None` where the system does not tell.
pub fn peak_memory() -> Option<u64> {
    field(&fs::read_to_string("/proc/self/status").ok()?, "VmHWM:")
}

impl std::fmt::Display for MemoryLimit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Machine => "the machine's",
            Self::ControlGroup => "the control group's limit",
            Self::Process => "the limit of this process, see ulimit",
            Self::Given => "the limit that was given",
        })
    }
}

/// The memory that can still be allocated, in bytes, and who limits it; `None` where the system does not tell.
///
/// The least of the machine's available memory and what is left of the limits of all control groups (versions 1 and 2)
/// around this process and of its own.
pub fn available_memory() -> Option<(u64, MemoryLimit)> {
    let read = |path: &str| fs::read_to_string(path).ok();
    let machine = read("/proc/meminfo").and_then(|text| field(&text, "MemAvailable:"));
    let groups =
        read("/proc/self/cgroup").and_then(|groups| of_control_groups(Path::new("/sys/fs/cgroup"), &groups));
    let status = read("/proc/self/status");
    let process = read("/proc/self/limits")
        .zip(status.as_ref())
        .and_then(|(limits, status)| of_process(&limits, status));
    let given = given_memory();
    let used = status.as_ref().and_then(|status| field(status, "VmRSS:")).unwrap_or(0);
    let named = [
        machine.map(|bytes| (bytes, MemoryLimit::Machine)),
        groups.map(|bytes| (bytes, MemoryLimit::ControlGroup)),
        process.map(|bytes| (bytes, MemoryLimit::Process)),
        given.map(|bytes| (bytes.saturating_sub(used), MemoryLimit::Given)),
    ];
    named.into_iter().flatten().min()
}

/// Fails if `bytes` more than the available memory would be needed for `what`.
///
/// # Errors
/// [`MemoryError`] with the estimate.
pub fn require_memory(what: impl Into<String>, bytes: u64) -> Result<(), MemoryError> {
    match available_memory() {
        Some((available, limit)) if bytes > available => Err(MemoryError {
            what: what.into(),
            needed_mib: bytes.div_ceil(1 << 20),
            available_mib: available >> 20,
            limit,
        }),
        _ => Ok(()),
    }
}

/// Memory for something that grows step by step, asked for in leaps: asking takes as long as a small step.
#[derive(Clone, Debug)]
pub struct GrowingMemory {
    what: &'static str,
    approved: u64,
}

impl GrowingMemory {
    /// For `what`, of which there is nothing yet.
    pub fn new(what: &'static str) -> Self {
        Self { what, approved: 0 }
    }

    /// Makes sure that there is room for `next` bytes beside the `used` ones.
    ///
    /// # Errors
    /// [`MemoryError`] if there may be none.
    pub fn make_room(&mut self, used: u64, next: u64) -> Result<(), MemoryError> {
        let needed = used.saturating_add(next);
        if needed > self.approved {
            let wanted = self.approved.saturating_mul(2).max(needed);
            // A leap may be too far where a step is not.
            let granted = match require_memory(self.what, wanted - used) {
                Ok(()) => wanted,
                Err(_) => require_memory(self.what, next).map(|()| needed)?,
            };
            self.approved = granted;
        }
        Ok(())
    }
}

/// The number behind a name in a file like `/proc/meminfo`, in bytes.
fn field(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find(|line| line.starts_with(name))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok()?.checked_mul(1024)
}

/// What is left of a process's soft limits on its address space and its data.
fn of_process(limits: &str, status: &str) -> Option<u64> {
    let left = |limit: &str, used: &str| {
        let line = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        let limit = line.split_whitespace().next()?.parse::<u64>().ok()?;
        Some(limit.saturating_sub(field(status, used)?))
    };
    let both = [left("Max address space", "VmSize:"), left("Max data size", "VmData:")];
    both.into_iter().flatten().min()
}

/// What is left of the limits of the groups that `/proc/self/cgroup` names and all groups around them.
fn of_control_groups(root: &Path, groups: &str) -> Option<u64> {
    let of_line = |line: &str| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, path) = (parts.next()?, parts.next()?);
        let (root, files) = if controllers.is_empty() {
            (root.to_path_buf(), ["memory.max", "memory.current", "inactive_file "])
        } else if controllers.split(',').any(|name| name == "memory") {
            let files = ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file "];
            (root.join("memory"), files)
        } else {
            return None;
        };
        // In a container the path may be that of the host, of which nothing but the root can be seen.
        let around: Vec<PathBuf> =
            Path::new(path.trim_start_matches('/')).ancestors().map(|group| root.join(group)).collect();
        around.iter().filter_map(|group| of_control_group(group, files)).min()
    };
    groups.lines().filter_map(of_line).min()
}

/// What is left of the limit of one group; files that the system would drop do not count as used.
fn of_control_group(group: &Path, [limit, used, droppable]: [&str; 3]) -> Option<u64> {
    let read = |name: &str| fs::read_to_string(group.join(name)).ok();
    let number = |name: &str| read(name)?.trim().parse::<u64>().ok();
    let cache = read("memory.stat").and_then(|text| {
        let line = text.lines().find_map(|line| line.strip_prefix(droppable))?;
        line.trim().parse::<u64>().ok()
    });
    let used = number(used).unwrap_or(0).saturating_sub(cache.unwrap_or(0));
    Some(number(limit)?.saturating_sub(used))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_the_process() {
        let limits = "Limit                     Soft Limit           Hard Limit           Units     \n\
                      Max data size             unlimited            unlimited            bytes     \n\
                      Max address space         8000000              unlimited            bytes     \n";
        let status = "Name:\tdynabs\nVmSize:\t    1000 kB\nVmData:\t     500 kB\n";
        assert_eq!(of_process(limits, status), Some(8_000_000 - 1_024_000));
        assert_eq!(of_process(&limits.replace("8000000", "10"), status), Some(0));
        assert_eq!(of_process(&limits.replace("8000000", "unlimited"), status), None);
        let data = limits.replace("size             unlimited", "size             600000   ");
        assert_eq!(of_process(&data, status), Some(600_000 - 512_000));
    }

    #[test]
    fn growing_is_refused_when_there_is_no_room() {
        let mut memory = GrowingMemory::new("a list");
        assert_eq!(memory.make_room(0, 1000), Ok(()));
        let error = memory.make_room(1000, u64::MAX / 2).unwrap_err();
        let text = error.to_string();
        assert!(text.starts_with("a list: found ") && text.contains("expected about"), "{error}");
    }

    /// Directories as the kernel shows them, version by version.
    #[test]
    fn limits_of_control_groups() {
        let scratch = tempfile::tempdir().unwrap();
        let put = |path: &str, text: &str| {
            let path = scratch.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        let left = |groups: &str| of_control_groups(scratch.path(), groups);
        assert_eq!(left("0::/a/b\n"), None);
        put("a/b/memory.max", "max\n");
        put("a/memory.max", "5000\n");
        put("a/memory.current", "1000\n");
        assert_eq!(left("0::/a/b\n"), Some(4000));
        put("a/memory.stat", "anon 1\ninactive_file 300\n");
        assert_eq!(left("0::/a/b\n"), Some(4300));
        put("a/b/memory.max", "2000\n");
        assert_eq!(left("0::/a/b\n"), Some(2000));
        // Version 1, seen from a container: the path is the host's.
        put("memory/memory.limit_in_bytes", "900\n");
        put("memory/memory.usage_in_bytes", "500\n");
        assert_eq!(left("5:cpu,memory:/docker/x\n4:pids:/\n0::/\n"), Some(400));
    }
}
