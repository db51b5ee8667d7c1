//! A program together with everything that it starts.

use std::io;
use std::process::{Child, ChildStderr, ChildStdout, Command, ExitStatus};

/// A running program and its children; dropping it ends them.
#[derive(Debug)]
pub(super) struct Group {
    leader: Child,
    ended: bool,
}

impl Group {
    /// Starts a program as the leader of a group of its own: Ctrl-C in a terminal reaches us and not it.
    pub(super) fn spawn(command: &mut Command) -> io::Result<Self> {
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        Ok(Self { leader: command.spawn()?, ended: false })
    }

    /// Its standard output, once.
    pub(super) fn stdout(&mut self) -> Option<ChildStdout> {
        self.leader.stdout.take()
    }

    /// Its standard error, once.
    pub(super) fn stderr(&mut self) -> Option<ChildStderr> {
        self.leader.stderr.take()
    }

    /// Whether the leader has ended. It stays known to the system, so that its number is not given away.
    #[cfg(unix)]
    pub(super) fn has_ended(&mut self) -> io::Result<bool> {
        use rustix::process::{WaitId, WaitIdOptions, waitid};
        let Some(leader) = self.pid() else { return Ok(true) };
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT | WaitIdOptions::NOHANG;
        Ok(waitid(WaitId::Pid(leader), options)?.is_some())
    }

    /// Whether the program has ended.
    #[cfg(not(unix))]
    pub fn has_ended(&mut self) -> io::Result<bool> {
        Ok(self.leader.try_wait()?.is_some())
    }

    /// Ends whatever still runs and tells how the leader ended.
    pub(super) fn end(&mut self) -> io::Result<ExitStatus> {
        // What has ended already cannot be ended: no error.
        #[cfg(unix)]
        if let Some(leader) = self.pid().filter(|_| !self.ended) {
            let _ = rustix::process::kill_process_group(leader, rustix::process::Signal::KILL);
        }
        #[cfg(not(unix))]
        let _ = self.leader.kill();
        self.ended = true;
        self.leader.wait()
    }

    /// The most memory that leader and children had so far, where the system tells.
    pub(super) fn memory_mib(&self) -> Option<u64> {
        memory_kib(self.leader.id()).map(|kib| kib.div_ceil(1024))
    }

    #[cfg(unix)]
    fn pid(&self) -> Option<rustix::process::Pid> {
        i32::try_from(self.leader.id()).ok().and_then(rustix::process::Pid::from_raw)
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        if !self.ended {
            // Nobody is left to be told.
            let _ = self.end();
        }
    }
}

fn memory_kib(pid: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let own: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    let children = std::fs::read_to_string(format!("/proc/{pid}/task/{pid}/children")).unwrap_or_default();
    let children = children.split_whitespace().filter_map(|child| memory_kib(child.parse().ok()?));
    Some(own + children.sum::<u64>())
}
