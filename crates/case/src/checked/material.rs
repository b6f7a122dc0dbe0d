//! `[material.NAME]`.

use super::elastic::Elastic;
use super::scope::Scope;
use crate::diagnostic::{Diagnostic, Problems};
use crate::source::Place;
use crate::units::Dimension;
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

impl Model {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("neo-hookean", Self::NeoHookean),
        ("neo-hookean-log", Self::NeoHookeanLog),
        ("saint-venant-kirchhoff", Self::SaintVenantKirchhoff),
        ("linear-elastic", Self::LinearElastic),
    ];

    /// The name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::NeoHookean => "neo-hookean",
            Self::NeoHookeanLog => "neo-hookean-log",
            Self::SaintVenantKirchhoff => "saint-venant-kirchhoff",
            Self::LinearElastic => "linear-elastic",
        }
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
    let moduli = Elastic::KEYS;
    section.only(&["model", "density", moduli[0], moduli[1], moduli[2], moduli[3]], problems);
    let model = problems.keep(section.need("model").and_then(|node| {
        let model = choice(node, "model", Model::NAMES)?;
        Ok((model, node.place))
    }));
    let density =
        section.need("density").and_then(|node| scope.positive(node, "`density`", Dimension::DENSITY));
    let density = problems.keep(density);
    let elastic = problems.keep(Elastic::read(section, scope));
    let (model, place) = model?;
    Some(Material { name: name.to_string(), model, density: density?, elastic: elastic?, place })
}
