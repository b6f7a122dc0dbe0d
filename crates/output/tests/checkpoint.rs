//! Checkpoints come back bit by bit; whatever else a file holds is refused with a reason, without a panic, and with little memory.
//!
//! Alone in its program, because it counts what the whole program allocates.

use output::checkpoint::{About, Checkpoint, Damage, Draft, Keeper, Numbers, Packed, kept, set_aside};
use output::{Manifest, ResultDir, manifest::Machine};
use proptest::prelude::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use xxhash_rust::xxh3::xxh3_128;

/// The allocator of the system, counted.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
/// One test measures at a time.
static ALONE: Mutex<()> = Mutex::new(());

// SAFETY: every call is handed on to the system as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        PEAK.fetch_max(held, Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn about(step: u64) -> About {
    let manifest = Manifest::new("name = \"a\"", Machine::here("avx2"), 2, "double");
    About { step, time: 0.1 + 0.2, wall_seconds: 3.5, ..About::of(&manifest) }
}

/// The bytes of a checkpoint with a large column and a small one.
fn file(large: &Numbers<'_>, small: &[f64]) -> Vec<u8> {
    let mut draft = Draft::new(vec![("solver-0/Velocity-0".to_string(), Packed::planes(large))]);
    draft.add("clock", small);
    let mut bytes = Vec::new();
    draft.write(&about(7), &serde_json::json!({ "tables": [1, 2] }), &mut bytes).expect("memory takes it");
    bytes
}

/// A file whose checksum is right, with this head and body.
fn forged(head: &[u8], body: &[u8]) -> Vec<u8> {
    let length = (24 + head.len() + body.len() + 16) as u64;
    let sizes =
        [&1_u32.to_le_bytes()[..], &(head.len() as u32).to_le_bytes(), &length.to_le_bytes()].concat();
    let mut bytes = [b"\x89TAUTck\n", &sizes[..], head, body].concat();
    let sum = xxh3_128(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// Reads all that there is, as a run would that has a hundred particles: no panic, and no more memory than a few times the file.
fn digest(bytes: Vec<u8>) -> Result<(), String> {
    let _alone = ALONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let (length, before) = (bytes.len(), HELD.load(Ordering::Relaxed));
    PEAK.store(before, Ordering::Relaxed);
    let read = Checkpoint::of(bytes).map_err(|damage| damage.to_string());
    let taken = read.and_then(|checkpoint| {
        checkpoint.take("solver-0/Velocity-0", 100)?;
        checkpoint.numbers("clock").map(drop)
    });
    // JSON takes at most some 100 bytes for a byte of text (an empty list in a list); numbers 8 or 16 for each byte of a plane; and each
    // of eight planes has a decoder with its window, about 48 kB.
    let taken_up = PEAK.load(Ordering::Relaxed) - before;
    assert!(taken_up < 200 * length + 500_000, "{taken_up} bytes for a file of {length}");
    taken
}

fn bits(numbers: &Numbers<'_>) -> Vec<u64> {
    match numbers {
        Numbers::F64(v) => v.iter().map(|x| x.to_bits()).collect(),
        Numbers::F32(v) => v.iter().map(|x| u64::from(x.to_bits())).collect(),
        Numbers::U32(v) => v.iter().map(|&x| u64::from(x)).collect(),
    }
}

fn numbers() -> impl Strategy<Value = Numbers<'static>> {
    prop_oneof![
        prop::collection::vec(any::<u64>().prop_map(f64::from_bits), 0..200)
            .prop_map(|v| Numbers::F64(v.into())),
        prop::collection::vec(any::<u32>().prop_map(f32::from_bits), 0..200)
            .prop_map(|v| Numbers::F32(v.into())),
        prop::collection::vec(0_u32..300, 0..200).prop_map(|v| Numbers::U32(v.into())),
        (any::<f64>(), 0_usize..20_000).prop_map(|(x, n)| Numbers::F64(vec![x; n].into())),
    ]
}

proptest! {
    #[test]
    fn every_bit_comes_back(large in numbers(), small in prop::collection::vec(any::<u64>(), 0..20)) {
        let small: Vec<f64> = small.into_iter().map(f64::from_bits).collect();
        let read = Checkpoint::of(file(&large, &small)).expect("it is whole");
        prop_assert_eq!(&read.about, &about(7));
        prop_assert_eq!(&read.notes, &serde_json::json!({ "tables": [1, 2] }));
        let back = read.take("solver-0/Velocity-0", large.len()).expect("it is there");
        prop_assert_eq!(bits(&back), bits(&large));
        prop_assert_eq!(std::mem::discriminant(&back), std::mem::discriminant(&large));
        let back = read.numbers("clock").expect("it is there");
        prop_assert_eq!(bits(&Numbers::F64(back.into())), bits(&Numbers::F64(small.into())));
        if !large.is_empty() {
            prop_assert!(read.take("solver-0/Velocity-0", large.len() - 1).is_err());
        }
    }

    #[test]
    fn a_bit_that_changed_is_seen(large in numbers(), place in any::<prop::sample::Index>(), bit in 0_u8..8) {
        let mut bytes = file(&large, &[1.0, 2.0]);
        let place = place.index(bytes.len());
        bytes[place] ^= 1 << bit;
        prop_assert!(Checkpoint::of(bytes).is_err());
    }

    #[test]
    fn a_file_that_was_cut_off_is_seen(large in numbers(), place in any::<prop::sample::Index>()) {
        let bytes = file(&large, &[1.0, 2.0]);
        let left = place.index(bytes.len());
        let damage = Checkpoint::of(bytes[..left].to_vec()).expect_err("cut off");
        let told = matches!(damage, Damage::CutOff { .. }) || (1..8).contains(&left);
        prop_assert!(told, "{left} bytes: {damage}");
    }

    #[test]
    fn bytes_after_the_end_are_seen(more in prop::collection::vec(any::<u8>(), 1..40)) {
        let bytes = [file(&Numbers::U32(vec![1].into()), &[1.0]), more].concat();
        prop_assert_eq!(Checkpoint::of(bytes).expect_err("longer"), Damage::Checksum);
    }

    /// Heads that were made to deceive: the checksum is right, and a piece of the head or the body is not.
    #[test]
    fn a_head_that_lies_takes_no_memory(
        (kind, planes) in (prop::sample::select(&["f64", "f32", "u32", "i8"][..]), any::<bool>()),
        count in prop_oneof![0_u64..300, any::<u64>()],
        stated in prop_oneof![0_u64..300, any::<u64>()],
        body in prop::collection::vec(any::<u8>(), 0..300),
        twice in any::<bool>(),
    ) {
        let entry = format!(
            "{{\"name\":\"solver-0/Velocity-0\",\"kind\":\"{kind}\",\"count\":{count},\"planes\":{planes},\"bytes\":{stated}}}"
        );
        let entries = if twice { format!("{entry},{entry}") } else { entry };
        let about = serde_json::to_string(&about(1)).expect("JSON");
        let head = format!("{{\"about\":{about},\"notes\":null,\"columns\":[{entries}]}}");
        let _ = digest(forged(head.as_bytes(), &body));
    }

    #[test]
    fn any_head_and_any_body(
        head in prop::collection::vec(any::<u8>(), 0..200),
        body in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        prop_assert!(digest(forged(&head, &body)).is_err());
        prop_assert!(digest([head, body].concat()).is_err());
    }

    /// A piece of a real file is replaced, and the checksum made right again.
    #[test]
    fn a_file_that_was_changed_on_purpose(
        place in any::<prop::sample::Index>(),
        piece in prop::collection::vec(any::<u8>(), 1..20),
    ) {
        let whole = file(&Numbers::F64((0..100).map(f64::from).collect()), &[1.0, 2.0]);
        let mut bytes = whole[..whole.len() - 16].to_vec();
        let start = place.index(bytes.len());
        let end = bytes.len().min(start + piece.len());
        bytes[start..end].copy_from_slice(&piece[..end - start]);
        let sum = xxh3_128(&bytes);
        bytes.extend(sum.to_le_bytes());
        let _ = digest(bytes);
    }
}

/// A plane that would inflate to a thousand times its size stops where the column ends.
#[test]
fn a_plane_that_swells_is_stopped() {
    let zeros = Packed::planes(&Numbers::F64(vec![0.0; 3_000_000].into()));
    let mut bytes = Vec::new();
    Draft::new(vec![("solver-0/Velocity-0".to_string(), zeros)])
        .write(&about(1), &serde_json::Value::Null, &mut bytes)
        .expect("memory takes it");
    let text = String::from_utf8_lossy(&bytes[24..]).split("]}").next().expect("a head").to_string() + "]}";
    for count in [100, 99] {
        let head = text.replace("3000000", &count.to_string());
        let body = &bytes[24 + text.len()..bytes.len() - 16];
        let error = digest(forged(head.as_bytes(), body)).expect_err("too long");
        assert!(error.contains("not as long"), "{error}");
    }
    assert!(digest(bytes).expect_err("too many for this run").contains("3000000 numbers instead of 100"));
}

#[test]
fn what_is_no_checkpoint_is_told_from_what_is_damaged() {
    let whole = file(&Numbers::U32(vec![1, 2].into()), &[1.0]);
    assert_eq!(Checkpoint::of(b"name = \"block\"".to_vec()).expect_err("text"), Damage::Other);
    let mut later = whole.clone();
    later[8] = 2;
    assert_eq!(Checkpoint::of(later).expect_err("a later format"), Damage::Format(2));
    let scratch = tempfile::tempdir().expect("a folder");
    assert_eq!(Checkpoint::read(scratch.path()).expect_err("a folder"), Damage::Other);
    assert!(matches!(Checkpoint::read(&scratch.path().join("none")), Err(Damage::Unreadable(_))));
    let manifest = Manifest::new("name = \"a\"", Machine::here("avx2"), 2, "double");
    assert_eq!(about(1).foreign(&manifest), None);
    let other = |m: Manifest, word: &str| assert!(about(1).foreign(&m).expect("foreign").contains(word));
    other(Manifest { case: "name = \"b\"".to_string(), ..manifest.clone() }, "another case");
    other(Manifest { precision: "single".to_string(), ..manifest.clone() }, "precision");
    let old = About { taut: "0.0.1".to_string(), ..about(1) };
    assert!(old.foreign(&manifest).expect("another version").contains("taut 0.0.1"));
}

#[test]
fn the_last_two_are_kept() {
    let scratch = tempfile::tempdir().expect("a folder");
    let results = ResultDir::create(scratch.path()).expect("it is empty");
    let keeper = Keeper::new(&results);
    assert!(kept(scratch.path()).is_empty());
    for step in [5, 900, 1000, 20_000_000_000] {
        let path = keeper.keep(&Draft::default(), &about(step), &serde_json::Value::Null).expect("written");
        assert_eq!(Checkpoint::read(&path).expect("whole").about.step, step);
        assert_eq!(kept(scratch.path())[0], path);
    }
    let names =
        || kept(scratch.path()).iter().map(|p| p.file_name().expect("a name").to_owned()).collect::<Vec<_>>();
    assert_eq!(names(), ["step-20000000000.taut", "step-000001000.taut"]);
    let aside = set_aside(&kept(scratch.path())[0]).expect("renamed");
    assert!(aside.exists() && names() == ["step-000001000.taut"]);
}
