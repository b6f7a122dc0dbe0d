//! From full colour to 256 colours chosen for the picture: a third of the file size, no difference to see.

/// Colours per picture, as many as one byte can tell apart.
pub(crate) const MOST: usize = 256;
/// Bits per channel within which colours count as the same.
const BITS: u32 = 6;

/// A few colours that stand for all.
pub(crate) struct Palette {
    /// Red, green, blue of each colour.
    pub(crate) colours: Vec<u8>,
    /// Which of them stands for each colour of [`BITS`] bits; `None` until it is asked for.
    index_of: Vec<Option<u8>>,
}

/// Pixels of nearly the same colour.
#[derive(Clone, Copy, Default)]
struct Bin {
    count: u64,
    sum: [u64; 3],
}

impl Bin {
    fn mean(&self, channel: usize) -> f64 {
        self.sum[channel] as f64 / self.count as f64
    }
}

/// Bins (with their keys) that will share a colour.
struct Group {
    bins: Vec<(usize, Bin)>,
    /// Channel in which they differ most.
    widest: usize,
    /// How much would be gained by splitting the group: the square of that difference, times the root of the number of pixels, so
    /// that small things (a colour bar) get colours too.
    spread: f64,
}

impl Group {
    fn new(bins: Vec<(usize, Bin)>) -> Self {
        let range = |channel: usize| {
            let means = bins.iter().map(|(_, bin)| bin.mean(channel));
            let (low, high) =
                means.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            high - low
        };
        let ranges = [range(0), range(1), range(2)];
        let widest = (0..3).max_by(|&a, &b| ranges[a].total_cmp(&ranges[b])).unwrap_or(0);
        let count: u64 = bins.iter().map(|(_, bin)| bin.count).sum();
        let spread = if bins.len() > 1 { (count as f64).sqrt() * ranges[widest].powi(2) } else { 0.0 };
        Self { bins, widest, spread }
    }

    /// Cuts the group in two of about equal numbers of pixels.
    fn split(mut self) -> [Self; 2] {
        let channel = self.widest;
        self.bins.sort_by(|(_, a), (_, b)| a.mean(channel).total_cmp(&b.mean(channel)));
        let half = self.bins.iter().map(|(_, bin)| bin.count).sum::<u64>() / 2;
        let mut passed = 0;
        let middle = self.bins.iter().position(|(_, bin)| {
            passed += bin.count;
            passed > half
        });
        let upper = self.bins.split_off(middle.unwrap_or(0).clamp(1, self.bins.len() - 1));
        [Self::new(self.bins), Self::new(upper)]
    }

    fn colour(&self) -> [u8; 3] {
        let total = |pick: &dyn Fn(&Bin) -> u64| self.bins.iter().map(|(_, bin)| pick(bin)).sum::<u64>();
        let count = total(&|bin| bin.count).max(1);
        [0, 1, 2].map(|channel| ((total(&|bin| bin.sum[channel]) + count / 2) / count) as u8)
    }
}

impl Palette {
    /// Chooses at most `most` colours for the pixels of these pictures, by median cut (Heckbert 1982): the group that would gain
    /// most is cut in two until there are enough.
    pub(crate) fn new<'a>(pictures: impl IntoIterator<Item = &'a [u8]>, most: usize) -> Self {
        let mut bins = vec![Bin::default(); 1 << (3 * BITS)];
        for pixel in pictures.into_iter().flat_map(|pixels| pixels.chunks_exact(3)) {
            let bin = &mut bins[key(pixel)];
            bin.count += 1;
            for (sum, &channel) in bin.sum.iter_mut().zip(pixel) {
                *sum += u64::from(channel);
            }
        }
        let used: Vec<(usize, Bin)> = bins.into_iter().enumerate().filter(|(_, bin)| bin.count > 0).collect();
        let mut groups = vec![Group::new(used)];
        while groups.len() < most {
            let best = (0..groups.len()).max_by(|&a, &b| groups[a].spread.total_cmp(&groups[b].spread));
            let Some(best) = best.filter(|&best| groups[best].spread > 0.0) else { break };
            let halves = groups.swap_remove(best).split();
            groups.extend(halves);
        }
        let mut index_of = vec![None; 1 << (3 * BITS)];
        for (index, group) in groups.iter().enumerate() {
            for (key, _) in &group.bins {
                index_of[*key] = Some(index as u8);
            }
        }
        Self { colours: groups.iter().flat_map(Group::colour).collect(), index_of }
    }

    /// The number of the colour of each pixel; the nearest one for colours that the palette was not made for.
    pub(crate) fn indices(&mut self, pixels: &[u8]) -> Vec<u8> {
        let index = |pixel: &[u8]| {
            let key = key(pixel);
            self.index_of[key].unwrap_or_else(|| {
                let nearest = nearest(&self.colours, pixel);
                self.index_of[key] = Some(nearest);
                nearest
            })
        };
        pixels.chunks_exact(3).map(index).collect()
    }
}

fn nearest(colours: &[u8], pixel: &[u8]) -> u8 {
    let far = |colour: &[u8]| -> u32 {
        colour.iter().zip(pixel).map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
    };
    let best = colours.chunks_exact(3).enumerate().min_by_key(|(_, colour)| far(colour));
    best.map_or(0, |(index, _)| index as u8)
}

fn key(pixel: &[u8]) -> usize {
    pixel.iter().fold(0, |key, &channel| (key << BITS) | usize::from(channel >> (8 - BITS)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn restored(palette: &mut Palette, pixels: &[u8]) -> Vec<u8> {
        assert!(palette.colours.len() <= 3 * MOST);
        let indices = palette.indices(pixels);
        indices.iter().flat_map(|&i| &palette.colours[3 * usize::from(i)..][..3]).copied().collect()
    }

    #[test]
    fn few_colours_stay_exact() {
        let pixels = [[255, 255, 255], [0, 0, 0], [200, 30, 60], [255, 255, 255]].concat();
        let mut palette = Palette::new([&pixels[..]], MOST);
        assert_eq!(restored(&mut palette, &pixels), pixels);
        assert!(restored(&mut palette, &[]).is_empty());
        assert_eq!(restored(&mut palette, &[190, 40, 70]), [200, 30, 60], "a colour of another picture");
    }

    #[test]
    fn many_colours_stay_close() {
        let pixels: Vec<u8> =
            (0..60_000u32).flat_map(|i| [(i / 240) as u8, (i % 240) as u8, (i / 480) as u8]).collect();
        let mut palette = Palette::new([&pixels[..]], MOST);
        let far = restored(&mut palette, &pixels).iter().zip(&pixels).map(|(a, b)| a.abs_diff(*b)).max();
        // 256 colours for a sheet of 250 x 240 x 125: cells of about 16 a side, cut unevenly by at most 2.
        assert!(far <= Some(20), "{far:?}");
    }
}
