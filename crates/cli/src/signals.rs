//! Ctrl-C, being asked to end, and the end of the terminal: the first time the run writes a checkpoint and stops, the second time it ends at once.

use case::run::Stop;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What signals have asked for.
pub struct Signals {
    /// Set by the first of them.
    pub stop: Stop,
    /// Which it was.
    which: Arc<AtomicUsize>,
}

/// Watches for signals from now on. Where they cannot be watched, they end the program as they always do.
pub fn watch() -> Signals {
    let signals = Signals { stop: Stop::default(), which: Arc::default() };
    for signal in [SIGINT, SIGTERM].into_iter().chain(end_of_terminal()) {
        // In this order: the second signal finds the flag that the first has set.
        let _ = flag::register_conditional_shutdown(signal, status(signal), signals.stop.flag());
        let _ = flag::register_usize(signal, Arc::clone(&signals.which), signal as usize);
        let _ = flag::register(signal, signals.stop.flag());
    }
    signals
}

/// The signal of a terminal that is closed, unless it is ignored (`nohup`). It is left alone where the system does not tell.
fn end_of_terminal() -> Option<i32> {
    #[cfg(unix)]
    {
        let status = std::fs::read_to_string("/proc/self/status").ok()?;
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        let ignored = u64::from_str_radix(mask.trim(), 16).ok()?;
        let signal = signal_hook::consts::SIGHUP;
        (ignored >> (signal - 1) & 1 == 0).then_some(signal)
    }
    #[cfg(not(unix))]
    None
}

/// What a shell makes of a signal.
fn status(signal: i32) -> i32 {
    128 + signal
}

impl Signals {
    /// The exit status of a run that was stopped.
    pub fn status(&self) -> u8 {
        u8::try_from(status(self.which.load(Ordering::Relaxed) as i32)).unwrap_or(1)
    }
}
