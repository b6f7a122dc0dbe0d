//! Frames come back from their files as they were written; files that are damaged or made to do harm are errors.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use output::{Array, Frame, FrameFile, ResultDir, Series, Values};
use proptest::prelude::*;

fn frame(n: usize) -> Frame {
    let real = |i: usize| (i as f64 * 0.7).sin() * 1e5;
    let tensor = [1.0, f64::NAN, 3., 4., 5., 6., 7., 8., 9.];
    Frame {
        time: 0.1 + 0.2,
        step: 12,
        points: (0..n).map(|i| [1e6 + real(i), real(i + 1), -0.0]).collect(),
        arrays: vec![
            Array::scalar("Pressure", "Pa", Values::F64((0..n).map(real).collect())),
            Array::scalar("Density", "a<b & \"c\"", Values::F32((0..n).map(|i| real(i) as f32).collect())),
            Array::tensor("CauchyStress", "Pa", vec![tensor; n]),
            Array::scalar("ParticleSpacing", "m", Values::Shared(Arc::new(vec![0.1; n]))),
            Array::scalar("ParticleId", "1", Values::Whole(Arc::new((0..n as i32).collect()))),
            Array::scalar("Big", "1", Values::I64((0..n as i64).map(|i| i64::MAX - i).collect())),
        ],
    }
}

fn written(frame: &Frame) -> (tempfile::TempDir, Vec<u8>) {
    let scratch = tempfile::tempdir().expect("a folder");
    let results = ResultDir::create(scratch.path()).expect("a result directory");
    Series::create(&results).and_then(|mut series| series.write(frame)).expect("a frame");
    let bytes = fs::read(scratch.path().join("particles/particles_000000.vtp")).expect("its file");
    (scratch, bytes)
}

/// Whether two numbers are the same in single precision, bit by bit.
fn same(one: f64, other: f64) -> bool {
    (one as f32).to_bits() == (other as f32).to_bits()
}

#[test]
fn every_number_comes_back() {
    for n in [0, 1, 3, 50_000] {
        let frame = frame(n);
        let (scratch, _) = written(&frame);
        let file = FrameFile::open(&scratch.path().join("particles/particles_000000.vtp")).expect("a frame");
        assert_eq!((file.time(), file.particles()), (frame.time, n as u64));
        let read = file.frame(|_| true).expect("its numbers");
        assert_eq!((&read.points, read.step), (&frame.points, frame.step));
        for (read, written) in read.arrays.iter().zip(&frame.arrays) {
            assert_eq!(
                (&read.name, &read.unit, read.components),
                (&written.name, &written.unit, written.components)
            );
            if let Values::I64(written) = &written.values {
                assert_eq!(read.values, Values::I64(written.clone()));
            }
            let (read, written) = (read.values.to_f64(), written.values.to_f64());
            assert!(read.len() == written.len() && read.iter().zip(written).all(|(&a, b)| same(a, b)));
        }
        let some = file.frame(|name| name == "Pressure").expect("its numbers");
        assert_eq!(some.arrays.iter().map(|array| array.name.as_str()).collect::<Vec<_>>(), ["Pressure"]);
    }
}

#[test]
fn what_is_no_frame_is_said_to_be_none() {
    let scratch = tempfile::tempdir().expect("a folder");
    let path = scratch.path().join("a.vtp");
    for (text, words) in [
        ("", "no whole .vtp file"),
        ("<AppendedData encoding=\"raw\">_", "head is damaged"),
        ("<VTKFile><AppendedData encoding=\"raw\">", "binary section is missing"),
        ("<VTKFile type=\"ImageData\"><AppendedData encoding=\"raw\">_", "no .vtp file of Taut"),
    ] {
        fs::write(&path, text).expect("a file");
        let error = FrameFile::open(&path).expect_err("no frame").to_string();
        assert!(error.contains(words) && error.contains("a.vtp"), "{error}");
    }
    for path in [Path::new("/nowhere/a.vtp"), scratch.path()] {
        assert!(FrameFile::open(path).is_err());
    }
}

/// A head that promises more than the file can hold must be refused before anything is asked for.
#[test]
fn promises_that_no_file_can_keep_are_refused() {
    let (scratch, bytes) = written(&frame(3));
    let path = scratch.path().join("particles/particles_000000.vtp");
    let text = |from: &str, to: &str| {
        let at = bytes.windows(from.len()).position(|w| w == from.as_bytes()).expect("the words");
        [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()
    };
    for (from, to) in [
        ("NumberOfPoints=\"3\"", "NumberOfPoints=\"18446744073709551615\""),
        ("NumberOfPoints=\"3\"", "NumberOfPoints=\"100000\""),
        ("Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"9\""),
        ("offset=\"0\"", "offset=\"18446744073709551615\""),
        ("vtkZLibDataCompressor", "vtkLZMADataCompressor"),
    ] {
        fs::write(&path, text(from, to)).expect("a file");
        let read = FrameFile::open(&path).and_then(|file| file.frame(|_| true));
        assert!(read.is_err(), "{to}");
    }
}

proptest! {
    /// Bits flipped, bytes cut off: an error or some frame, never a panic. Numbers that still decode have the right count.
    #[test]
    fn damaged_files_do_no_harm(
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..8), 0..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let (scratch, mut bytes) = written(&frame(40));
        let path = scratch.path().join("particles/particles_000000.vtp");
        for (place, bit) in flips {
            let place = place.index(bytes.len());
            bytes[place] ^= 1 << bit;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        fs::write(&path, &bytes).expect("a file");
        if let Ok(frame) = FrameFile::open(&path).and_then(|file| file.frame(|_| true)) {
            for array in &frame.arrays {
                prop_assert_eq!(array.values.len(), array.components * frame.points.len());
            }
        }
    }
}
