//! Several pictures of one size as an animated GIF.

use std::path::Path;

use gif::{DisposalMethod, Encoder, Repeat};

use crate::ReportError;
use crate::image::Image;
use crate::palette::{MOST, Palette};

/// How long a picture stays, hundredths of a second.
const DELAY: u16 = 8;
/// How long the last one stays.
const LAST: u16 = 150;
/// Pictures that the colours are chosen from.
const SAMPLES: usize = 6;

/// Writes `count` pictures of one size, which `picture` draws one after the other, as an animation that repeats for ever. Pictures
/// are drawn when they are due (a few of them twice), so memory does not grow with their number.
///
/// # Errors
/// What `picture` fails with; [`ReportError::Draw`] if pictures differ in size, [`ReportError::Write`].
pub fn write_gif<E: From<ReportError>>(
    count: usize,
    mut picture: impl FnMut(usize) -> Result<Image, E>,
    path: &Path,
) -> Result<(), E> {
    let failed = |cause: String| E::from(ReportError::Draw { what: path.display().to_string(), cause });
    if count == 0 {
        return Err(failed("there are no pictures".to_string()));
    }
    let few = SAMPLES.min(count);
    let chosen =
        (0..few).map(|k| picture(k * (count - 1) / (few - 1).max(1))).collect::<Result<Vec<_>, E>>()?;
    // One number is left for "as it was".
    let mut palette = Palette::new(chosen.iter().map(Image::pixels), MOST - 1);
    let size = [chosen[0].width(), chosen[0].height()];
    let mut bytes = Vec::new();
    let [width, height] = size.map(|side| side as u16);
    let mut encoder =
        Encoder::new(&mut bytes, width, height, &palette.colours).map_err(|e| failed(e.to_string()))?;
    encoder.set_repeat(Repeat::Infinite).map_err(|e| failed(e.to_string()))?;
    let mut before = None;
    for number in 0..count {
        let image = picture(number)?;
        if [image.width(), image.height()] != size {
            return Err(failed(format!("picture {number} has another size than the first")));
        }
        let indices = palette.indices(image.pixels());
        let delay = if number + 1 == count { LAST } else { DELAY };
        encoder
            .write_frame(&changed(&indices, before.as_deref(), size, delay))
            .map_err(|e| failed(e.to_string()))?;
        before = Some(indices);
    }
    drop(encoder);
    Ok(output::write_atomically(path, &bytes).map_err(ReportError::from)?)
}

/// The picture as a frame: what is as it was before is transparent.
fn changed(now: &[u8], before: Option<&[u8]>, size: [usize; 2], delay: u16) -> gif::Frame<'static> {
    const AS_IT_WAS: u8 = (MOST - 1) as u8;
    let buffer: Vec<u8> = match before {
        None => now.to_vec(),
        Some(before) => {
            now.iter().zip(before).map(|(now, old)| if now == old { AS_IT_WAS } else { *now }).collect()
        }
    };
    gif::Frame {
        width: size[0] as u16,
        height: size[1] as u16,
        delay,
        dispose: DisposalMethod::Keep,
        transparent: before.map(|_| AS_IT_WAS),
        buffer: buffer.into(),
        ..gif::Frame::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_come_back_from_the_file() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("a.gif");
        let picture = |number: usize| {
            let mut image = Image::white(30, 20);
            image.fill([3 * number, 5], [3, 3], [200, 0, 20 * number as u8]);
            Ok::<_, ReportError>(image)
        };
        write_gif(4, picture, &path).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::Indexed);
        let mut decoder = options.read_info(std::fs::File::open(&path).unwrap()).unwrap();
        let colours = decoder.global_palette().unwrap().to_vec();
        let mut seen = vec![0; 30 * 20];
        for number in 0..4 {
            let frame = decoder.read_next_frame().unwrap().unwrap();
            assert_eq!(frame.delay, if number == 3 { LAST } else { DELAY });
            for (seen, new) in seen.iter_mut().zip(frame.buffer.iter()) {
                *seen = if frame.transparent == Some(*new) { *seen } else { *new };
            }
            let pixels: Vec<u8> =
                seen.iter().flat_map(|&i| colours[3 * usize::from(i)..][..3].to_vec()).collect();
            assert_eq!(pixels, picture(number).unwrap().pixels(), "picture {number}");
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
    }

    #[test]
    fn no_pictures_and_pictures_of_two_sizes_are_errors() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("a.gif");
        let picture = |number| Ok::<_, ReportError>(Image::white(10 + number, 10));
        assert!(write_gif(0, picture, &path).is_err());
        assert!(write_gif(2, picture, &path).unwrap_err().to_string().contains("another size"));
        assert!(!path.exists());
    }
}
