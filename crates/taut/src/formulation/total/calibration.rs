//! What kernel sums over a lattice miss.

use crate::kernel::Kernel;

/// M = sum_b V_b |W'| / r X_ab,1^2 over the neighbours b on a lattice of this spacing (m): the moment matrix of Eq. (21) inside a lattice is
/// M times the unit matrix. 1 in the continuum; 0.968 in 2D and 0.994 in 3D for h = 1.15 dp.
pub fn lattice_moment<const D: usize>(kernel: &Kernel, spacing: f64) -> f64 {
    let reach = (kernel.support() / spacing).ceil() as i32;
    let side = 2 * reach + 1;
    let volume = spacing.powi(D as i32);
    let cell = |k: i32| -> [i32; D] { std::array::from_fn(|i| k / side.pow(i as u32) % side - reach) };
    let term = |cell: [i32; D]| {
        let r = cell.iter().map(|&c| f64::from(c * c)).sum::<f64>().sqrt() * spacing;
        if r > 0.0 { -kernel.dw(r) / r * (f64::from(cell[0]) * spacing).powi(2) * volume } else { 0.0 }
    };
    (0..side.pow(D as u32)).map(|k| term(cell(k))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Shape;

    /// B = 1/M is 1.0332 in 2D and 1.0059 in 3D.
    #[test]
    fn the_papers_lattice() {
        for (moment, b) in [
            (lattice_moment::<2>(&Kernel::new(Shape::WendlandC2, 1.15, 2), 1.0), 1.0332),
            (lattice_moment::<3>(&Kernel::new(Shape::WendlandC2, 1.15, 3), 1.0), 1.0059),
        ] {
            assert!((1.0 / moment - b).abs() < 5e-5, "{moment}");
        }
    }
}
