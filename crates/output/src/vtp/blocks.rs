//! Numbers as VTK's compressed blocks: a head of counts, then zlib streams.
//!
//! The head: number of blocks, size of a block, size of the last one if it is a part of one (else 0), then the compressed
//! size of each; all `UInt64`, little endian.

use std::io::{self, Read as _, Write as _};

use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};

/// Bytes per block before compression: a multiple of every number's size.
pub(super) const BLOCK: usize = 1 << 20;

/// Deflate makes no more than so many bytes out of one (<https://zlib.net/zlib_tech.html>).
pub(super) const MOST_RATIO: u64 = 1032;

/// Head and blocks of `bytes`.
pub(super) fn compress(bytes: &[u8], level: Compression) -> io::Result<Vec<u8>> {
    let mut header = vec![bytes.len().div_ceil(BLOCK), BLOCK, bytes.len() % BLOCK];
    let mut body = Vec::new();
    for block in bytes.chunks(BLOCK) {
        let start = body.len();
        let mut encoder = ZlibEncoder::new(&mut body, level);
        encoder.write_all(block)?;
        encoder.finish()?;
        header.push(body.len() - start);
    }
    let mut all: Vec<u8> = header.iter().flat_map(|&n| (n as u64).to_le_bytes()).collect();
    all.append(&mut body);
    Ok(all)
}

/// The bytes of the blocks that begin `data`, which must be `expected` of them. Asks for memory only as far as blocks hold what
/// they promise.
pub(super) fn decompress(data: &[u8], expected: u64) -> Result<Vec<u8>, String> {
    let mut rest = data;
    let [blocks, size, partial] = [number(&mut rest)?, number(&mut rest)?, number(&mut rest)?];
    let last = if partial == 0 { size } else { partial };
    let total = match blocks {
        0 => Some(0),
        _ => (blocks - 1).checked_mul(size).and_then(|whole| whole.checked_add(last)),
    };
    if total != Some(expected) {
        return Err(format!("its blocks promise other than {expected} bytes"));
    }
    if blocks > rest.len() as u64 / 8 {
        return Err("it ends within the sizes of its blocks".to_string());
    }
    let mut sizes = rest;
    rest = &rest[8 * blocks as usize..];
    let mut bytes = Vec::with_capacity(expected.min(MOST_RATIO.saturating_mul(rest.len() as u64)) as usize);
    for block in 0..blocks {
        let compressed = take(&mut rest, number(&mut sizes)?)?;
        let wanted = if block + 1 == blocks { last } else { size };
        let before = bytes.len() as u64;
        ZlibDecoder::new(compressed)
            .take(wanted.saturating_add(1))
            .read_to_end(&mut bytes)
            .map_err(|cause| format!("block {block}: {cause}"))?;
        if bytes.len() as u64 - before != wanted {
            return Err(format!("block {block} does not hold {wanted} bytes"));
        }
    }
    Ok(bytes)
}

/// The bytes behind a byte count, which must be `expected`: an array of a file without a compressor.
pub(super) fn plain(data: &[u8], expected: u64) -> Result<Vec<u8>, String> {
    let mut rest = data;
    let length = number(&mut rest)?;
    if length != expected {
        return Err(format!("it has {length} bytes instead of {expected}"));
    }
    Ok(take(&mut rest, length)?.to_vec())
}

fn number(rest: &mut &[u8]) -> Result<u64, String> {
    let (head, tail) = rest.split_first_chunk().ok_or("it ends too soon")?;
    *rest = tail;
    Ok(u64::from_le_bytes(*head))
}

fn take<'a>(rest: &mut &'a [u8], length: u64) -> Result<&'a [u8], String> {
    let length = usize::try_from(length).ok().filter(|&length| length <= rest.len());
    let (head, tail) = rest.split_at(length.ok_or("it ends too soon")?);
    *rest = tail;
    Ok(head)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_counts_full_and_partial_blocks() {
        for (length, expected) in
            [(0, [0, 0]), (5, [1, 5]), (BLOCK, [1, 0]), (BLOCK + 8, [2, 8]), (2 * BLOCK, [2, 0])]
        {
            let bytes = compress(&vec![7; length], Compression::fast()).unwrap();
            let number = |i: usize| u64::from_le_bytes(bytes[8 * i..8 * i + 8].try_into().unwrap());
            assert_eq!([number(0), number(2)], expected, "{length} bytes");
            let blocks: u64 = (0..number(0)).map(|block| number(3 + block as usize)).sum();
            assert_eq!(bytes.len() as u64, 8 * (3 + number(0)) + blocks);
            assert_eq!(decompress(&bytes, length as u64).unwrap(), vec![7; length]);
        }
    }

    #[test]
    fn heads_that_lie_are_refused_without_asking_for_what_they_promise() {
        let head = |numbers: &[u64]| numbers.iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<_>>();
        for numbers in [
            &[u64::MAX, u64::MAX, 0, 1][..],
            &[1 << 40, 1 << 20, 0],
            &[1, 1 << 60, 0, 8],
            &[2, 1 << 59, 0, 8, u64::MAX],
            &[1, 0, 1 << 60, u64::MAX],
            &[1],
            &[],
        ] {
            for expected in [0, 8, 1 << 60, u64::MAX] {
                assert!(decompress(&head(numbers), expected).is_err(), "{numbers:?} for {expected}");
                assert!(plain(&head(numbers), expected).is_err(), "{numbers:?}");
            }
        }
    }
}
