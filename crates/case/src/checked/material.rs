//! `[material.NAME]`.

use super::choices::word;
use super::elastic::Elastic;
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::{Words, material as keys};
use crate::source::Place;
use crate::written::{Section, Table, choice, named};

/// What a body is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name in the case file.
    pub name: String,
    /// The law of stress.
    pub model: Model,
    /// Reference density, kg/m^3.
    pub density: f64,
    /// The elastic constants.
    pub elastic: Elastic,
    /// Where the model is named in the case file.
    pub place: Place,
}

impl Material {
    /// Speed of the longitudinal wave, sqrt((K + 4G/3)/rho), m/s.
    pub fn wave_speed(&self) -> f64 {
        let e = &self.elastic;
        ((e.bulk_modulus + e.shear_modulus * 4.0 / 3.0) / self.density).sqrt()
    }
}

/// A law of stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Model {
    /// Neo-Hookean with the volume part K/2 (J^2 - 1) (total Lagrangian paper, Eqs. 10-14).
    NeoHookean,
    /// Neo-Hookean with the volume part lambda ln J (total Lagrangian paper, Eqs. 7-8).
    NeoHookeanLog,
    /// Saint Venant-Kirchhoff: linear in the Green-Lagrange strain.
    SaintVenantKirchhoff,
    /// Linear in the rate of deformation.
    LinearElastic,
}

impl Words for Model {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        (
            "neo-hookean",
            Self::NeoHookean,
            "neo-Hookean with the volume part K/2 (J^2 - 1): rubber; in ul-generalised with the pressure c0^2 (rho - rho0)",
        ),
        ("neo-hookean-log", Self::NeoHookeanLog, "neo-Hookean with the volume part lambda ln J"),
        (
            "saint-venant-kirchhoff",
            Self::SaintVenantKirchhoff,
            "linear in the Green-Lagrange strain: large turns, small strains",
        ),
        (
            "linear-elastic",
            Self::LinearElastic,
            "linear in the rate of deformation: what updated Lagrangian formulations take; its shear stress falls again where shear is beyond 1.6",
        ),
    ];
}

impl Model {
    /// The name in case files.
    pub fn name(self) -> &'static str {
        word(self)
    }
}

/// All materials that are right, in the order of the file.
pub(crate) fn read(root: &Table, scope: &Scope, problems: &mut Problems) -> Vec<Material> {
    let sections = named(root, "material", problems);
    let materials =
        sections.iter().filter_map(|(name, section)| material(name, section, scope, problems)).collect();
    if root.get("material").is_none() {
        problems.0.push(
            Diagnostic::at(Place::START, "missing table `[material.NAME]`: what the bodies are made of")
                .help("for example [material.rubber] with model, density, youngs_modulus and poisson_ratio"),
        );
    }
    materials
}

fn material(name: &str, section: &Section<'_>, scope: &Scope, problems: &mut Problems) -> Option<Material> {
    section.only(keys::TABLE.keys, problems);
    let model = problems.keep(section.need(keys::MODEL.name).and_then(|node| {
        let model = choice(node, keys::MODEL.name, Model::WORDS)?;
        Ok((model, node.place))
    }));
    let density = problems.keep(scope.need(section, &keys::DENSITY));
    let elastic = problems.keep(Elastic::read(section, scope));
    let (model, place) = model?;
    Some(Material { name: name.to_string(), model, density: density?, elastic: elastic?, place })
}
