//! The frames of a run as one time series for ParaView.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::{Frame, OutputError, ResultDir, vtp, write_atomically};

const FOLDER: &str = "particles";
const LIST: &str = "particles.pvd";

/// Writes `particles/particles_000000.vtp`, ... and the list of them with their times,
/// `particles/particles.pvd`, which is the file to open.
///
/// A frame is listed only after it is complete, and the list is replaced in one step: a run may be
/// killed, or looked at while it goes on, at any moment.
#[derive(Debug)]
pub struct Series {
    folder: PathBuf,
    times: Vec<f64>,
    encoder: vtp::Encoder,
}

impl Series {
    /// Starts the series in the folder `particles` of the results.
    ///
    /// # Errors
    /// As [`ResultDir::folder`].
    pub fn create(results: &ResultDir) -> Result<Self, OutputError> {
        Ok(Self { folder: results.folder(FOLDER)?, times: Vec::new(), encoder: vtp::Encoder::default() })
    }

    /// Goes on with a series after its first frames, those at `times`, the last of them after so many steps: later ones are removed.
    ///
    /// # Errors
    /// As [`Series::check`], and [`OutputError::Write`].
    pub fn reopen(results: &ResultDir, times: Vec<f64>, last: Option<u64>) -> Result<Self, OutputError> {
        Self::check(results.path(), times.len())?;
        let series = Self { folder: results.path().join(FOLDER), times, encoder: vtp::Encoder::after(last) };
        // First the list: it must not name what is no longer there.
        write_atomically(&series.folder.join(LIST), series.list().as_bytes())?;
        for index in series.times.len().. {
            let path = series.folder.join(file_name(index));
            match fs::remove_file(&path) {
                Ok(()) => {}
                Err(cause) if cause.kind() == io::ErrorKind::NotFound => break,
                Err(cause) => return Err(OutputError::write(&path, cause)),
            }
        }
        Ok(series)
    }

    /// Whether the first frames of a series in the directory `results` are there, so many.
    ///
    /// # Errors
    /// [`OutputError::Read`] with the first that is missing.
    pub fn check(results: &Path, frames: usize) -> Result<(), OutputError> {
        let mut paths = (0..frames).map(|index| Self::file(results, index));
        match paths.find(|path| !path.is_file()) {
            Some(path) => Err(OutputError::read(&path, "it is missing")),
            None => Ok(()),
        }
    }

    /// The file of a frame in the directory `results`.
    pub fn file(results: &Path, index: usize) -> PathBuf {
        results.join(FOLDER).join(file_name(index))
    }

    /// Steps taken at the last frame.
    pub fn last_step(&self) -> Option<u64> {
        self.encoder.last()
    }

    /// Times of the frames, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Writes the next frame and lists it.
    ///
    /// # Errors
    /// [`OutputError::Write`]; [`OutputError::Inconsistent`] if an array does not fit the particles or
    /// the time is not later than that of the frame before. Frames written before stay readable.
    pub fn write(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let bytes = self.encode(frame)?;
        self.store(frame, &bytes)
    }

    /// The bytes of a frame's file: the part of [`Series::write`] that computes.
    ///
    /// # Errors
    /// [`OutputError::Inconsistent`] if an array does not fit the particles.
    pub fn encode(&mut self, frame: &Frame) -> Result<Vec<u8>, OutputError> {
        frame.check()?;
        let path = self.folder.join(file_name(self.times.len()));
        self.encoder.encode(frame).map_err(|cause| OutputError::write(&path, cause))
    }

    /// Writes the bytes of the next frame and lists it: the part of [`Series::write`] that waits for the disk.
    ///
    /// # Errors
    /// As [`Series::write`].
    pub fn store(&mut self, frame: &Frame, bytes: &[u8]) -> Result<(), OutputError> {
        if let Some(&last) = self.times.last().filter(|&&last| last >= frame.time) {
            let problem =
                format!("its time {} s is not after {last} s, that of the frame before", frame.time);
            return Err(OutputError::inconsistent(format!("frame {}", frame.step), problem));
        }
        let path = self.folder.join(file_name(self.times.len()));
        write_atomically(&path, bytes)?;
        self.times.push(frame.time);
        write_atomically(&self.folder.join(LIST), self.list().as_bytes())
    }

    /// How many frames have been written.
    pub fn frames(&self) -> usize {
        self.times.len()
    }

    fn list(&self) -> String {
        let mut xml = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for (index, time) in self.times.iter().enumerate() {
            let file = file_name(index);
            let _ = writeln!(xml, "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{file}\"/>");
        }
        xml + "</Collection>\n</VTKFile>\n"
    }
}

fn file_name(index: usize) -> String {
    format!("particles_{index:06}.vtp")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(time: f64) -> Frame {
        Frame { time, step: 0, points: vec![[0.0; 3]], arrays: vec![] }
    }

    #[test]
    fn times_must_grow_and_a_refused_frame_changes_nothing() {
        let scratch = tempfile::tempdir().unwrap();
        let mut series = Series::create(&ResultDir::create(scratch.path()).unwrap()).unwrap();
        series.write(&frame(0.1)).unwrap();
        for time in [0.1, 0.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(series.write(&frame(time)), Err(OutputError::Inconsistent { .. })), "{time}");
        }
        series.write(&frame(0.2)).unwrap();
        assert_eq!(series.frames(), 2);
        let list = fs::read_to_string(scratch.path().join("particles/particles.pvd")).unwrap();
        assert_eq!(list.matches("<DataSet").count(), 2);
        assert_eq!(fs::read_dir(scratch.path().join("particles")).unwrap().count(), 3);
    }

    #[test]
    fn a_series_goes_on_after_its_first_frames() {
        let scratch = tempfile::tempdir().unwrap();
        let results = ResultDir::create(scratch.path()).unwrap();
        let mut series = Series::create(&results).unwrap();
        for time in [0.0, 0.1, 0.2, 0.3] {
            series.write(&frame(time)).unwrap();
        }
        let mut series = Series::reopen(&results, vec![0.0, 0.1], Some(0)).unwrap();
        assert_eq!(fs::read_dir(scratch.path().join(FOLDER)).unwrap().count(), 3);
        series.write(&frame(0.2)).unwrap();
        assert_eq!(series.times(), [0.0, 0.1, 0.2]);
        let list = fs::read_to_string(scratch.path().join("particles/particles.pvd")).unwrap();
        assert_eq!(list.matches("<DataSet").count(), 3);
        let error = Series::reopen(&results, vec![0.0; 4], None).unwrap_err();
        assert!(error.to_string().contains("particles_000003.vtp"), "{error}");
    }

    #[test]
    fn a_folder_that_vanished_is_an_error_with_the_file() {
        let scratch = tempfile::tempdir().unwrap();
        let mut series = Series::create(&ResultDir::create(scratch.path()).unwrap()).unwrap();
        fs::remove_dir(scratch.path().join("particles")).unwrap();
        let error = series.write(&frame(0.0)).unwrap_err();
        assert!(error.to_string().contains("particles_000000.vtp"), "{error}");
        assert_eq!(series.frames(), 0);
    }
}
