//! How much memory there is, so that what cannot fit is refused with a number instead of ended by the system.

use std::fs;

/// Bytes this process may still take, as far as the system tells: free memory, a limit on the address space, a limit of its
/// group. `None` where none of them can be read.
pub fn available() -> Option<u64> {
    let free = number(&fs::read_to_string("/proc/meminfo").unwrap_or_default(), "MemAvailable:").map(|kilobytes| kilobytes << 10);
    let space = number(&fs::read_to_string("/proc/self/limits").unwrap_or_default(), "Max address space");
    let group = fs::read_to_string("/sys/fs/cgroup/memory.max").ok().and_then(|text| text.trim().parse().ok());
    [free, space, group].into_iter().flatten().min()
}

/// The first number behind a word; `None` for `unlimited`.
fn number(text: &str, word: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(word))?;
    line.split_whitespace().next()?.parse().ok()
}

/// What is wrong with a size of this many bytes, if it is more than there is.
///
/// # Errors
/// A sentence with both numbers.
///
/// ```
/// assert!(ribopt::files::memory::fits(1.0).is_ok());
/// ```
pub fn fits(bytes: f64) -> Result<(), String> {
    match available() {
        Some(there) if bytes > there as f64 => {
            Err(format!("that takes about {} of memory, and there are {}", size(bytes), size(there as f64)))
        }
        _ => Ok(()),
    }
}

/// `3.2 GB`, by thousands.
///
/// ```
/// assert_eq!(ribopt::files::memory::size(3.25e9), "3.2 GB");
/// assert_eq!(ribopt::files::memory::size(12.0), "12 B");
/// ```
pub fn size(bytes: f64) -> String {
    let units = ["B", "kB", "MB", "GB", "TB", "PB"];
    let power = if bytes >= 1.0 { ((bytes.log10() / 3.0) as usize).min(units.len() - 1) } else { 0 };
    let value = bytes / 1000f64.powi(power as i32);
    if power == 0 || value >= 100.0 { format!("{value:.0} {}", units[power]) } else { format!("{value:.1} {}", units[power]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_read_where_there_are_any() {
        assert_eq!(
            number("Max address space        8192000000           unlimited            bytes\n", "Max address space"),
            Some(8_192_000_000)
        );
        assert_eq!(
            number("Max address space        unlimited            unlimited            bytes\n", "Max address space"),
            None
        );
        assert!(fits(1e30).is_err() || available().is_none());
    }
}
