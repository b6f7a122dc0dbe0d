//! From full colour to 256 colours chosen for the picture: a third of the file size, no difference to see.

/// Colours per picture, as many as one byte can tell apart.
const MOST: usize = 256;
/// Bits per channel within which colours count as the same while the palette is chosen.
const BITS: u32 = 6;

/// An image as a list of colours and, for each pixel, which of them.
pub(crate) struct Indexed {
    /// Red, green, blue of each colour.
    pub(crate) palette: Vec<u8>,
    /// One byte per pixel.
    pub(crate) indices: Vec<u8>,
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
    /// How much would be gained by splitting the group: pixels times the square of that difference.
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
        let spread = if bins.len() > 1 { count as f64 * ranges[widest].powi(2) } else { 0.0 };
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

/// Chooses the colours by median cut (Heckbert 1982): the group that would gain most is cut in two until
/// there are enough.
pub(crate) fn indexed(pixels: &[u8]) -> Indexed {
    let mut bins = vec![Bin::default(); 1 << (3 * BITS)];
    for pixel in pixels.chunks_exact(3) {
        let bin = &mut bins[key(pixel)];
        bin.count += 1;
        for (sum, &channel) in bin.sum.iter_mut().zip(pixel) {
            *sum += u64::from(channel);
        }
    }
    let used: Vec<(usize, Bin)> = bins.into_iter().enumerate().filter(|(_, bin)| bin.count > 0).collect();
    let mut groups = vec![Group::new(used)];
    while groups.len() < MOST {
        let best = (0..groups.len()).max_by(|&a, &b| groups[a].spread.total_cmp(&groups[b].spread));
        let Some(best) = best.filter(|&best| groups[best].spread > 0.0) else { break };
        let halves = groups.swap_remove(best).split();
        groups.extend(halves);
    }
    let mut index_of = vec![0u8; 1 << (3 * BITS)];
    for (index, group) in groups.iter().enumerate() {
        for (key, _) in &group.bins {
            index_of[*key] = index as u8;
        }
    }
    Indexed {
        palette: groups.iter().flat_map(Group::colour).collect(),
        indices: pixels.chunks_exact(3).map(|pixel| index_of[key(pixel)]).collect(),
    }
}

fn key(pixel: &[u8]) -> usize {
    pixel.iter().fold(0, |key, &channel| (key << BITS) | usize::from(channel >> (8 - BITS)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn restored(pixels: &[u8]) -> Vec<u8> {
        let image = indexed(pixels);
        assert!(image.palette.len() <= 3 * MOST);
        image.indices.iter().flat_map(|&i| &image.palette[3 * usize::from(i)..][..3]).copied().collect()
    }

    #[test]
    fn few_colours_stay_exact() {
        let pixels = [[255, 255, 255], [0, 0, 0], [200, 30, 60], [255, 255, 255]].concat();
        assert_eq!(restored(&pixels), pixels);
        assert!(restored(&[]).is_empty());
    }

    #[test]
    fn many_colours_stay_close() {
        let pixels: Vec<u8> =
            (0..60_000u32).flat_map(|i| [(i / 240) as u8, (i % 240) as u8, (i / 480) as u8]).collect();
        let far = restored(&pixels).iter().zip(&pixels).map(|(a, b)| a.abs_diff(*b)).max();
        // 256 colours for a sheet of 250 x 240 x 125: cells of about 16 a side, cut unevenly by at most 2.
        assert!(far <= Some(20), "{far:?}");
    }
}
