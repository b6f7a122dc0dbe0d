//! The largest frequency of a body about its undeformed state: what an explicit step has to resolve.

/// What a body does against a small displacement: acceleration = -K u, component by component. Held components neither move nor answer.
pub trait Stiffness {
    /// Numbers of a displacement: particles, in the order in which they are stored, times axes.
    fn len(&self) -> usize;
    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Acceleration, m/s^2, by a displacement, m.
    fn apply(&mut self, u: &[f64], a: &mut [f64]);
    /// 2 or 3.
    fn dimension(&self) -> usize;
    /// The weights of the product sum_i w_i a_i b_i in which the operator is symmetric, if it is: masses, kg.
    fn weights(&self) -> Vec<f64>;
}

/// The largest eigenvalue of -`operator`, 1/s^2, which has to be symmetric, after so many Lanczos steps. From below; the error falls with the
/// square of their number: 40 leave less than 0.2 per cent of the frequency, whatever the size of the body.
pub fn highest(operator: &mut dyn Stiffness, steps: usize) -> f64 {
    let weights = operator.weights();
    let dot = |a: &[f64], b: &[f64]| weights.iter().zip(a).zip(b).map(|((w, a), b)| w * a * b).sum::<f64>();
    let n = operator.len();
    let mut now = scattered(n);
    let mut image = vec![0.0; n];
    // A first application takes out what is held.
    operator.apply(&now.clone(), &mut now);
    let mut before = vec![0.0; n];
    let (mut diagonal, mut beside) = (Vec::new(), Vec::<f64>::new());
    let mut length = dot(&now, &now).sqrt();
    for _ in 0..steps.min(n) {
        if length.is_nan() || length <= 1e-12 * diagonal.iter().fold(0.0, |m: f64, x: &f64| m.max(x.abs())) {
            break;
        }
        now.iter_mut().for_each(|x| *x /= length);
        operator.apply(&now, &mut image);
        let along = -dot(&now, &image);
        let last = beside.last().copied().unwrap_or(0.0);
        for i in 0..n {
            let next = -image[i] - along * now[i] - last * before[i];
            before[i] = now[i];
            now[i] = next;
        }
        length = dot(&now, &now).sqrt();
        diagonal.push(along);
        beside.push(length);
    }
    top(&diagonal, &beside)
}

/// Numbers between -1 and 1 without order, always the same.
pub fn scattered(n: usize) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..n).map(|_| next()).collect()
}

/// The largest eigenvalue of a symmetric tridiagonal matrix, by bisection with Sturm's sequence.
fn top(diagonal: &[f64], beside: &[f64]) -> f64 {
    let off = |i: usize| if i < diagonal.len().saturating_sub(1) { beside[i].abs() } else { 0.0 };
    let row = |i: usize| off(i) + if i > 0 { off(i - 1) } else { 0.0 };
    let bound = |sign: f64| {
        let rows = diagonal.iter().enumerate().map(|(i, d)| sign * d + row(i));
        sign * rows.fold(f64::NEG_INFINITY, f64::max)
    };
    if diagonal.is_empty() {
        return 0.0;
    }
    let (mut low, mut high) = (bound(-1.0), bound(1.0));
    while high - low > 1e-14 * high.abs().max(low.abs()) {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        // Whether an eigenvalue is larger: then a pivot of T - x is positive.
        let mut pivot = diagonal[0] - middle;
        let mut larger = pivot > 0.0;
        for i in 1..diagonal.len() {
            let safe = if pivot == 0.0 { f64::MIN_POSITIVE } else { pivot };
            pivot = diagonal[i] - middle - off(i - 1).powi(2) / safe;
            larger |= pivot > 0.0;
        }
        if larger { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of `n` masses between walls: omega^2 = 4 sin^2(k pi / (2 (n + 1))).
    struct Chain(usize);

    impl Stiffness for Chain {
        fn len(&self) -> usize {
            self.0
        }
        fn apply(&mut self, u: &[f64], a: &mut [f64]) {
            for i in 0..self.0 {
                let left = if i > 0 { u[i - 1] } else { 0.0 };
                let right = u.get(i + 1).copied().unwrap_or(0.0);
                a[i] = left - 2.0 * u[i] + right;
            }
        }
        fn dimension(&self) -> usize {
            2
        }
        fn weights(&self) -> Vec<f64> {
            vec![1.0; self.0]
        }
    }

    #[test]
    fn a_chain_has_the_frequency_that_it_has() {
        let exact = |n: usize| 4.0 * (std::f64::consts::FRAC_PI_2 * n as f64 / (n + 1) as f64).sin().powi(2);
        assert!((highest(&mut Chain(10), 10) / exact(10) - 1.0).abs() < 1e-10);
        // Kaniel's bound for the top of a dense spectrum: (pi / (2 steps))^2 and less.
        for n in [100, 3000] {
            let found = highest(&mut Chain(n), 40);
            assert!(found <= exact(n) * (1.0 + 1e-12) && found > 0.998 * exact(n), "{n}: {found}");
        }
        assert_eq!(highest(&mut Chain(0), 5), 0.0);
    }
}
