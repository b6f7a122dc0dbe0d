//! Connected components, by union and find.

/// Number of components of `n` particles that `links` connect; `parent` is room for n entries.
pub(super) fn pieces(n: usize, links: impl Iterator<Item = [u32; 2]>, parent: &mut Vec<u32>) -> usize {
    parent.clear();
    parent.extend(0..n as u32);
    let mut count = n;
    for [i, j] in links {
        let (one, other) = (root(parent, i), root(parent, j));
        if one != other {
            // The smaller index leads, so that the outcome does not depend on the order of links.
            parent[one.max(other) as usize] = one.min(other);
            count -= 1;
        }
    }
    count
}

/// The particle that leads the component of `i`; halves the way there for the next time.
fn root(parent: &mut [u32], mut i: u32) -> u32 {
    while parent[i as usize] != i {
        let above = parent[parent[i as usize] as usize];
        parent[i as usize] = above;
        i = above;
    }
    i
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_components() {
        let mut parent = Vec::new();
        let mut count = |n, links: &[[u32; 2]]| pieces(n, links.iter().copied(), &mut parent);
        assert_eq!(count(0, &[]), 0);
        assert_eq!(count(5, &[]), 5);
        assert_eq!(count(5, &[[0, 1], [3, 4], [1, 0]]), 3);
        assert_eq!(count(6, &[[4, 5], [2, 3], [0, 1], [1, 2], [3, 4]]), 1);
        let chain: Vec<[u32; 2]> = (0..9999).rev().map(|k| [k, k + 1]).collect();
        assert_eq!(count(10_000, &chain), 1);
        assert_eq!(count(10_000, &chain[1..]), 2);
    }
}
