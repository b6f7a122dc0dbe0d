//! Reads `.vtp` files back with a reader of its own (head, offsets, zlib blocks) and compares exactly.

use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;
use output::{Array, Frame, ResultDir, Series, Values};

/// A `.vtp` file cut into its XML head and its binary section.
struct Vtp {
    head: String,
    data: Vec<u8>,
}

impl Vtp {
    fn open(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let marker = b"<AppendedData encoding=\"raw\">\n_";
        let start = bytes.windows(marker.len()).position(|window| window == marker).unwrap();
        let head = String::from_utf8(bytes[..start].to_vec()).unwrap();
        Self { head, data: bytes[start + marker.len()..].to_vec() }
    }

    /// The attribute of the array called `name`.
    fn attribute(&self, name: &str, attribute: &str) -> String {
        let line = self.head.lines().find(|line| line.contains(&format!("Name=\"{name}\""))).unwrap();
        let (_, rest) = line.split_once(&format!(" {attribute}=\"")).unwrap();
        rest.split('"').next().unwrap().to_string()
    }

    fn number(&self, at: usize) -> usize {
        u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap()) as usize
    }

    /// The inflated bytes of the array called `name`.
    fn bytes(&self, name: &str) -> Vec<u8> {
        let offset: usize = self.attribute(name, "offset").parse().unwrap();
        let (blocks, size, partial) =
            (self.number(offset), self.number(offset + 8), self.number(offset + 16));
        let mut at = offset + 8 * (3 + blocks);
        let mut all = Vec::new();
        for block in 0..blocks {
            let compressed = self.number(offset + 8 * (3 + block));
            let mut inflated = Vec::new();
            ZlibDecoder::new(&self.data[at..at + compressed]).read_to_end(&mut inflated).unwrap();
            let last_is_partial = block + 1 == blocks && partial > 0;
            assert_eq!(inflated.len(), if last_is_partial { partial } else { size });
            all.extend(inflated);
            at += compressed;
        }
        all
    }

    fn f64s(&self, name: &str) -> Vec<f64> {
        self.bytes(name).chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn f32s(&self, name: &str) -> Vec<f32> {
        self.bytes(name).chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn i32s(&self, name: &str) -> Vec<i32> {
        self.bytes(name).chunks(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn i64s(&self, name: &str) -> Vec<i64> {
        self.bytes(name).chunks(8).map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
    }
}

fn frame(n: usize) -> Frame {
    let real = |i: usize| (i as f64 * 0.7).sin() * 1e5;
    Frame {
        time: 0.1 + 0.2,
        step: 12,
        points: (0..n).map(|i| [1e6 + real(i), real(i + 1), -0.0]).collect(),
        arrays: vec![
            Array::scalar("Pressure", "Pa", Values::F64((0..n).map(real).collect())),
            Array::tensor(
                "CauchyStress",
                "a<b & \"c\"",
                vec![[1.0, f64::NAN, 3., 4., 5., 6., 7., 8., 9.]; n],
            ),
            Array::scalar("ParticleId", "1", Values::I64((0..n as i64).map(|i| i64::MAX - i).collect())),
            Array::scalar("Body", "1", Values::Whole((0..n as i32).rev().collect::<Vec<_>>().into())),
            Array::scalar("ParticleSpacing", "m", Values::Shared(vec![0.1; n].into())),
        ],
    }
}

fn written(frame: &Frame) -> Vtp {
    let scratch = tempfile::tempdir().unwrap();
    let mut series = Series::create(&ResultDir::create(scratch.path()).unwrap()).unwrap();
    series.write(frame).unwrap();
    Vtp::open(&scratch.path().join("particles/particles_000000.vtp"))
}

#[test]
fn every_number_comes_back() {
    // 50 000 particles make 1.2 MB of positions: one full block and a part of one.
    for n in [1, 3, 50_000] {
        let frame = frame(n);
        let vtp = written(&frame);
        assert_eq!(vtp.f64s("Points"), frame.points.as_flattened());
        assert_eq!(vtp.attribute("Points", "type"), "Float64");
        assert_eq!(vtp.i32s("connectivity"), (0..n as i32).collect::<Vec<_>>());
        assert_eq!(vtp.i32s("offsets"), (1..=n as i32).collect::<Vec<_>>());
        for array in &frame.arrays {
            assert_eq!(vtp.attribute(&array.name, "NumberOfComponents"), array.components.to_string());
            match &array.values {
                Values::I64(values) => assert_eq!(&vtp.i64s(&array.name), values),
                Values::Whole(values) => assert_eq!(&vtp.i32s(&array.name), &**values),
                real => {
                    let expected: Vec<u32> = real.to_f64().iter().map(|&x| (x as f32).to_bits()).collect();
                    let found: Vec<u32> = vtp.f32s(&array.name).into_iter().map(f32::to_bits).collect();
                    assert_eq!(found, expected);
                }
            }
        }
    }
}

#[test]
fn a_frame_without_particles_is_a_file_too() {
    let vtp = written(&frame(0));
    assert!(vtp.f64s("Points").is_empty());
    assert!(vtp.head.contains("NumberOfPoints=\"0\""));
}

#[test]
fn time_and_units_are_in_the_head() {
    let vtp = written(&frame(2));
    assert!(
        vtp.head.contains("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.30000000000000004<")
    );
    assert!(vtp.head.contains(">a&lt;b &amp; &quot;c&quot;</InformationKey>"));
}

#[test]
fn the_list_has_every_frame_with_its_time() {
    let scratch = tempfile::tempdir().unwrap();
    let mut series = Series::create(&ResultDir::create(scratch.path()).unwrap()).unwrap();
    let times = [0.0, 1e-9, 0.30000000000000004, 1e20];
    for (index, time) in times.into_iter().enumerate() {
        series.write(&Frame { time, ..frame(2) }).unwrap();
        let list = std::fs::read_to_string(scratch.path().join("particles/particles.pvd")).unwrap();
        let listed: Vec<(f64, String)> = list.lines().filter_map(entry).collect();
        assert_eq!(listed.len(), index + 1);
        for (i, (listed_time, file)) in listed.iter().enumerate() {
            assert_eq!(*listed_time, times[i]);
            assert!(scratch.path().join("particles").join(file).is_file());
        }
    }
}

/// Time and file of a line of the list that names a frame.
fn entry(line: &str) -> Option<(f64, String)> {
    let value = |name: &str| line.split_once(&format!("{name}=\""))?.1.split('"').next();
    Some((value("timestep")?.parse().ok()?, value("file")?.to_string()))
}
