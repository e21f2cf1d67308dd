//! Opening what is to be read: a file of any size that fits into memory, or a limited part of what may have no end.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::memory;

/// The name that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Bytes read at the most from what is no regular file: a pipe or a device may go on for ever.
const FROM_PIPES: u64 = 256 << 20;

/// A reader that ends in an error beyond its limit.
pub struct Limited {
    source: Box<dyn Read>,
    left: u64,
    length: Option<u64>,
}

impl Limited {
    /// At most this many bytes of a source.
    pub fn new(source: impl Read + 'static, most: u64) -> Limited {
        Limited { source: Box::new(source), left: most, length: None }
    }

    /// Bytes in all, where that is known.
    pub fn length(&self) -> Option<u64> {
        self.length
    }
}

impl Read for Limited {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left == 0 && !buffer.is_empty() {
            // One byte more would be one too many; none is the end.
            return match self.source.read(&mut buffer[..1])? {
                0 => Ok(0),
                _ => Err(io::Error::new(io::ErrorKind::FileTooLarge, "it goes on beyond what is read; has it an end?")),
            };
        }
        let most = buffer.len().min(usize::try_from(self.left).unwrap_or(usize::MAX));
        let count = self.source.read(&mut buffer[..most])?;
        self.left -= count as u64;
        Ok(count)
    }
}

/// Opens a file, or standard input by the name `-`. Regular files must fit into memory; of anything else a limited part is read.
///
/// # Errors
/// What the system says; a directory; a file that is larger than the memory there is.
pub fn open(path: &Path) -> io::Result<Limited> {
    if path.as_os_str() == STANDARD_INPUT {
        return Ok(Limited::new(io::stdin(), FROM_PIPES));
    }
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        return Ok(Limited::new(file, FROM_PIPES));
    }
    let refuse = |cause| io::Error::new(io::ErrorKind::FileTooLarge, cause);
    memory::fits(metadata.len() as f64).map_err(|cause| refuse(format!("it is too large: {cause}")))?;
    Ok(Limited { source: Box::new(file), left: u64::MAX, length: Some(metadata.len()) })
}

/// All of a file, as [`open`] opens it.
///
/// # Errors
/// Those of [`open`] and of reading.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_is_read_to_its_limit_and_not_beyond() {
        let mut text = Vec::new();
        Limited::new(&b"abc"[..], 3).read_to_end(&mut text).unwrap();
        assert_eq!(text, b"abc");
        let error = Limited::new(io::repeat(7), 1 << 20).read_to_end(&mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
    }

    #[cfg(unix)]
    #[test]
    fn a_device_without_end_is_no_file_of_any_length() {
        let opened = open(Path::new("/dev/zero")).unwrap();
        assert_eq!((opened.left, opened.length()), (FROM_PIPES, None));
        assert_eq!(open(Path::new("/")).err().unwrap().kind(), io::ErrorKind::IsADirectory);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_larger_than_memory_is_refused_with_both_sizes() {
        let file = tempfile::NamedTempFile::new().unwrap();
        // A hole takes no room on the disk.
        if file.as_file().set_len(1 << 43).is_ok() {
            let message = open(file.path()).err().unwrap().to_string();
            assert!(message.contains("8.8 TB") && message.contains("there are"), "{message}");
        }
    }
}
