//! Elastic moduli of an isotropic solid.

/// Density and moduli; everything else follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    /// Density of the undeformed material, kg/m^3.
    pub density: f64,
    /// Bulk modulus K = E / (3 (1 - 2 nu)), Pa, in 2D too.
    pub bulk: f64,
    /// Shear modulus G = E / (2 (1 + nu)), Pa. (TL Eq. 6 prints 1 + 2 nu, a misprint.)
    pub shear: f64,
}

impl Moduli {
    /// From Young's modulus and Poisson's ratio.
    #[must_use]
    pub fn from_young(density: f64, young: f64, poisson: f64) -> Self {
        Self { density, bulk: young / (3.0 * (1.0 - 2.0 * poisson)), shear: young / (2.0 * (1.0 + poisson)) }
    }

    /// Young's modulus 9 K G / (3 K + G), Pa.
    #[must_use]
    pub fn young(&self) -> f64 {
        9.0 * self.bulk * self.shear / (3.0 * self.bulk + self.shear)
    }

    /// First Lamé constant K - 2G/3, Pa.
    #[must_use]
    pub fn lambda(&self) -> f64 {
        self.bulk - self.shear * 2.0 / 3.0
    }

    /// Bulk sound speed sqrt(K/rho0), m/s: the c of both papers.
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        (self.bulk / self.density).sqrt()
    }

    /// Speed of longitudinal waves sqrt((K + 4G/3)/rho0), m/s.
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        ((self.bulk + self.shear * 4.0 / 3.0) / self.density).sqrt()
    }

    /// Poisson's ratio.
    #[must_use]
    pub fn poisson(&self) -> f64 {
        (3.0 * self.bulk - 2.0 * self.shear) / (6.0 * self.bulk + 2.0 * self.shear)
    }
}

#[cfg(test)]
mod tests {
    use super::Moduli;

    #[test]
    fn moduli_of_the_bending_column() {
        let m = Moduli::from_young(1100.0, 17e6, 0.45);
        assert!((m.bulk - 17e6 / 0.3).abs() < 1.0);
        assert!((m.poisson() - 0.45).abs() < 1e-12);
        assert!((m.young() - 17e6).abs() < 1.0);
        assert!((m.lambda() - 17e6 * 0.45 / (1.45 * 0.1)).abs() < 1.0);
    }
}
