//! The right name for a mistyped one.

/// Names longer than this are not compared: nobody mistypes them by a letter or two.
const LONGEST: usize = 64;

/// A hint that names the nearest right name, or else lists all of them.
pub(crate) fn did_you_mean<'a>(wrong: &str, right: impl IntoIterator<Item = &'a str>) -> String {
    let right: Vec<&str> = right.into_iter().collect();
    match nearest(wrong, &right) {
        Some(name) => format!("did you mean `{name}`?"),
        None if right.is_empty() => "there are none here".to_string(),
        None => format!("known here: {}", listed(&right)),
    }
}

/// `a, b, c`, cut after twenty names.
pub(crate) fn listed(names: &[&str]) -> String {
    let shown = names.iter().take(20).map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
    if names.len() > 20 { format!("{shown}, ... ({} in all)", names.len()) } else { shown }
}

/// The name that takes the fewest edits, if that is few enough to be a slip of the finger.
fn nearest<'a>(wrong: &str, right: &[&'a str]) -> Option<&'a str> {
    if wrong.chars().count() > LONGEST {
        return None;
    }
    let (edits, name) = right
        .iter()
        .filter(|name| name.chars().count() <= LONGEST)
        .map(|name| (edits(&wrong.to_lowercase(), &name.to_lowercase()), *name))
        .min_by_key(|(edits, _)| *edits)?;
    let allowed = (wrong.chars().count().max(name.chars().count()) / 3).max(1);
    let whole = edits >= name.chars().count();
    (edits <= allowed && !whole).then_some(name)
}

/// Number of single-letter edits (insert, delete, change, swap of neighbours) between two words.
fn edits(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let mut table = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            table[i][j] = if i == 0 || j == 0 { i + j } else { step(&table, (&a, &b), i, j) };
        }
    }
    table[a.len()][b.len()]
}

/// One entry of the table of edits, from its neighbours.
fn step(table: &[Vec<usize>], (a, b): (&[char], &[char]), i: usize, j: usize) -> usize {
    let change = usize::from(a[i - 1] != b[j - 1]);
    let best = (table[i - 1][j] + 1).min(table[i][j - 1] + 1).min(table[i - 1][j - 1] + change);
    let swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
    if swapped { best.min(table[i - 2][j - 2] + 1) } else { best }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_count_each_kind_of_slip_once() {
        for (a, b, n) in
            [("abc", "abc", 0), ("abc", "abd", 1), ("abc", "ab", 1), ("ab", "ba", 1), ("", "xy", 2)]
        {
            assert_eq!(edits(a, b), n, "{a} {b}");
        }
    }

    #[test]
    fn only_near_names_are_proposed() {
        assert_eq!(did_you_mean("densty", ["density", "model"]), "did you mean `density`?");
        assert_eq!(did_you_mean("colour", ["density", "model"]), "known here: `density`, `model`");
        assert_eq!(did_you_mean("q", ["x", "y"]), "known here: `x`, `y`");
    }
}
