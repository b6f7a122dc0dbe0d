//! Memory of this program, where the system tells it (Linux).

/// The most it has held, bytes.
pub fn peak() -> Option<f64> {
    status("VmHWM:")
}

/// What it holds now, bytes.
pub fn present() -> Option<f64> {
    status("VmRSS:")
}

fn status(name: &str) -> Option<f64> {
    let table = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = table.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse::<f64>().ok().map(|kilobytes| 1024.0 * kilobytes)
}

#[cfg(test)]
#[cfg(target_os = "linux")]
mod tests {
    use super::*;

    #[test]
    fn what_is_held_is_seen() {
        let before = present().expect("Linux");
        let held = vec![1_u8; 100 << 20];
        let after = peak().expect("Linux");
        assert!(after - before > 90e6, "{before} to {after}, {}", held[5]);
    }
}
