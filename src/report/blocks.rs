//! Long lists written in blocks that are rendered side by side: millions of lines, the same bytes as one by one.

use std::io::{self, Write};
use std::ops::Range;

use rayon::prelude::*;

/// Entries rendered by one thread at a time.
const BLOCK: usize = 4096;
/// Blocks in memory at a time.
const AT_ONCE: usize = 64;

/// Renders entries `0..count` and writes them in order.
///
/// # Errors
/// Whatever the writer or `render` says.
pub(super) fn write(
    out: &mut dyn Write,
    count: usize,
    render: impl Fn(Range<usize>) -> io::Result<Vec<u8>> + Sync,
) -> io::Result<()> {
    let starts: Vec<usize> = (0..count).step_by(BLOCK).collect();
    for starts in starts.chunks(AT_ONCE) {
        let blocks: Vec<_> = starts.par_iter().map(|&first| render(first..count.min(first + BLOCK))).collect();
        for block in blocks {
            out.write_all(&block?)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_come_in_order_and_leave_nothing_out() {
        let count = 3 * BLOCK + 5;
        let render = |range: Range<usize>| Ok(range.flat_map(|at| format!("{at}\n").into_bytes()).collect());
        let mut out = Vec::new();
        write(&mut out, count, render).unwrap();
        let lines = String::from_utf8(out).unwrap();
        assert!(lines.lines().map(|line| line.parse::<usize>().unwrap()).eq(0..count));
    }

    #[test]
    fn an_error_of_one_block_ends_it() {
        let mut out = Vec::new();
        let failed = write(&mut out, 1, |_| Err(io::Error::other("no value")));
        assert_eq!(failed.unwrap_err().to_string(), "no value");
    }
}
