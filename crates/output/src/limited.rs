//! Reading a file that somebody else wrote, without trusting its length.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The longest case file, or table of a user's, that is read, bytes.
pub const LONGEST_TEXT: u64 = 16 << 20;
/// The longest summary or table of a run that is read, bytes.
pub const LONGEST_RESULT: u64 = 1 << 30;

/// The bytes of a file of at most `most` bytes. Devices and pipes, which have no length, are read up to there as well.
///
/// # Errors
/// What the system says, and [`io::ErrorKind::FileTooLarge`] for more bytes than that.
pub fn read_bytes(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let message = format!("it has more than {most} bytes, the most that is read of such a file");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

/// The text of a file of at most `most` bytes.
///
/// # Errors
/// As [`read_bytes`], and [`io::ErrorKind::InvalidData`] with the line for bytes that are no UTF-8.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    String::from_utf8(read_bytes(path, most)?).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
        io::Error::new(io::ErrorKind::InvalidData, format!("line {line} is not text in UTF-8"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_up_to_the_limit_and_not_beyond() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("text");
        std::fs::write(&path, "four").unwrap();
        assert_eq!(read_text(&path, 4).unwrap(), "four");
        let refused = read_text(&path, 3).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::FileTooLarge);
        assert!(refused.to_string().contains("more than 3 bytes"), "{refused}");
        assert_eq!(read_text(&scratch.path().join("none"), 3).unwrap_err().kind(), io::ErrorKind::NotFound);
        assert!(read_bytes(scratch.path(), 3).is_err());
    }

    #[test]
    fn what_is_no_text_is_refused_with_its_line() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("bytes");
        std::fs::write(&path, b"a\nb\xff\n").unwrap();
        assert!(read_text(&path, 100).unwrap_err().to_string().contains("line 2"));
    }

    #[cfg(unix)]
    #[test]
    fn a_device_without_end_is_no_trap() {
        assert_eq!(
            read_bytes(Path::new("/dev/zero"), 1 << 20).unwrap_err().kind(),
            io::ErrorKind::FileTooLarge
        );
    }
}
