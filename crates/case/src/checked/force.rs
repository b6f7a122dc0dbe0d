//! `[[load]]`: forces on particles and surfaces.

use super::field::{FieldExpression, VectorField};
use super::history::{self, History};
use super::load::LoadReader;
use super::shape::ShapeSpec;
use crate::diagnostic::{Diagnostic, Problems};
use crate::keys::load as keys;
use crate::source::Place;
use crate::written::{Node, Section};

/// A load.
#[derive(Debug, Clone)]
pub struct Load {
    /// What acts.
    pub kind: LoadKind,
    /// Where.
    pub site: Site,
    /// Number of the body; `None` for all.
    pub body: Option<usize>,
    /// Factor over time; `None` for 1.
    pub history: Option<History>,
    /// Its header in the case file.
    pub place: Place,
}

/// Where a load acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Site {
    /// Around a point of the undeformed body, m.
    Point([f64; 3]),
    /// On what is in here.
    Region(ShapeSpec),
}

/// What acts.
#[derive(Debug, Clone)]
pub enum LoadKind {
    /// Total force, N.
    Force(VectorField),
    /// Force per area of the undeformed surface, Pa.
    Traction(VectorField),
    /// Pressure on the deformed surface, Pa.
    Pressure(FieldExpression),
}

impl LoadKind {
    /// Its key.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Force(_) => keys::KINDS[0].name,
            Self::Traction(_) => keys::KINDS[1].name,
            Self::Pressure(_) => keys::KINDS[2].name,
        }
    }

    /// So many times it.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        match self {
            Self::Force(field) => Self::Force(field.times(factor)),
            Self::Traction(field) => Self::Traction(field.times(factor)),
            Self::Pressure(field) => Self::Pressure(field.times(factor)),
        }
    }

    fn fields(&self) -> &[FieldExpression] {
        match self {
            Self::Force(field) | Self::Traction(field) => &field.components,
            Self::Pressure(field) => std::slice::from_ref(field),
        }
    }
}

impl Load {
    /// Whether it may change with time or with the motion of the body.
    pub fn changes(&self) -> bool {
        let follows = matches!(self.kind, LoadKind::Pressure(_));
        follows || self.history.is_some() || self.kind.fields().iter().any(FieldExpression::depends_on_time)
    }

    /// The factor at time `t`, s.
    pub fn factor(&self, t: f64) -> f64 {
        self.history.as_ref().map_or(1.0, |history| history.at(t))
    }

    /// A part that is no number at `x` when the run starts.
    pub fn nonsense(&self, x: [f64; 3]) -> Option<&FieldExpression> {
        self.kind.fields().iter().find(|field| !field.eval(x, 0.0).is_finite())
    }
}

impl LoadReader<'_, '_> {
    /// One load.
    pub(crate) fn load(&mut self, section: &Section<'_>, problems: &mut Problems) -> Option<Load> {
        section.only(keys::TABLE.keys, problems);
        let body = problems.keep(self.body(section));
        let kind = problems.keep(self.kind(section));
        let force = !matches!(kind, Some(LoadKind::Traction(_) | LoadKind::Pressure(_)));
        let site = problems.keep(self.site(section, force));
        let history = section.get(keys::HISTORY.name).map(|node| history::read(self.scope, node));
        let history = problems.keep(history.transpose());
        Some(Load { kind: kind?, site: site?, body: body?, history: history?, place: section.place })
    }

    fn kind(&self, section: &Section<'_>) -> Result<LoadKind, Diagnostic> {
        let given: Vec<(usize, &Node)> =
            keys::KINDS.iter().enumerate().filter_map(|(k, key)| Some((k, section.get(key.name)?))).collect();
        match given.as_slice() {
            [(0, node)] => Ok(LoadKind::Force(self.scope.vector_field(node, &keys::KINDS[0])?)),
            [(1, node)] => Ok(LoadKind::Traction(self.scope.vector_field(node, &keys::KINDS[1])?)),
            [(_, node)] => Ok(LoadKind::Pressure(self.scope.field(node, &keys::KINDS[2])?)),
            _ => {
                let names: Vec<&str> = given.iter().map(|&(k, _)| keys::KINDS[k].name).collect();
                let found = if names.is_empty() { "none".to_string() } else { names.join(", ") };
                let place = given.last().map_or(section.place, |(_, node)| node.place);
                Err(Diagnostic::at(place, format!("a load is exactly one thing, found {found}"))
                    .help("give one of force = [..], traction = [..], pressure = .."))
            }
        }
    }

    fn site(&mut self, section: &Section<'_>, force: bool) -> Result<Site, Diagnostic> {
        match (section.get(keys::AT.name), section.get(keys::REGION.name)) {
            (Some(node), None) if force => Ok(Site::Point(self.scope.vector(node, &keys::AT)?)),
            (Some(node), None) => Err(Diagnostic::at(node.place, "only a `force` can act at a point")
                .help("give the `region` that the loaded faces lie in")),
            (None, Some(node)) => Ok(Site::Region(self.shapes.shape(node)?)),
            (None, None) => Err(Diagnostic::at(section.place, "missing key `region`: where the load acts")
                .help("for example region = { box = { min = [0, 0], max = [1, 1] } }; a `force` may have at = [..] instead")),
            (Some(node), Some(_)) => {
                Err(Diagnostic::at(node.place, "a load acts in one place, found both `at` and `region`"))
            }
        }
    }
}
