//! Reading shapes: the combinations, and regions called by name.

use std::collections::HashMap;

use super::scope::Scope;
use super::shape::ShapeSpec;
use super::shape_solids::solid;
use crate::diagnostic::{Diagnostic, Problems, did_you_mean, listed};
use crate::keys::{region, shape};
use crate::source::Place;
use crate::written::{Node, Section, Table, Value, named};

/// Deepest nesting of shapes, regions included.
const DEEPEST: usize = 32;

/// Most shapes of one case, regions counted at each use.
const MOST: usize = 10_000;

fn kinds() -> Vec<&'static str> {
    shape::KINDS.iter().map(|(name, ..)| *name).collect()
}

/// Reads shapes, and remembers regions.
pub(crate) struct ShapeReader<'a> {
    pub scope: &'a Scope,
    regions: HashMap<&'a str, &'a Node>,
    /// Regions being read: coming back to one of them is a circle.
    open: Vec<&'a str>,
    count: usize,
}

impl<'a> ShapeReader<'a> {
    /// With the regions of the case.
    pub(crate) fn new(scope: &'a Scope, root: &'a Table, problems: &mut Problems) -> Self {
        let mut regions = HashMap::new();
        for (name, section) in named(root, "region", problems) {
            section.only(region::TABLE.keys, problems);
            if let Some(shape) = problems.keep(section.need(region::SHAPE.name)) {
                regions.insert(name, shape);
            }
        }
        Self { scope, regions, open: Vec::new(), count: 0 }
    }

    /// All regions that are right, by name in alphabetical order.
    pub(crate) fn all_regions(&mut self, problems: &mut Problems) -> Vec<(String, ShapeSpec)> {
        let names = self.region_names();
        let regions = names.into_iter().filter_map(|name| {
            let node = *self.regions.get(name)?;
            self.open.push(name);
            let shape = problems.keep(self.nested(node, 0));
            self.open.pop();
            Some((name.to_string(), shape?))
        });
        regions.collect()
    }

    fn region_names(&self) -> Vec<&'a str> {
        let mut names: Vec<&str> = self.regions.keys().copied().collect();
        names.sort_unstable();
        names
    }

    /// The shape that a node describes, or the region that it names.
    pub(crate) fn shape(&mut self, node: &Node) -> Result<ShapeSpec, Diagnostic> {
        self.nested(node, 0)
    }

    fn nested(&mut self, node: &Node, depth: usize) -> Result<ShapeSpec, Diagnostic> {
        self.count += 1;
        if depth > DEEPEST || self.count > MOST {
            let limit = if depth > DEEPEST { "nested too deeply" } else { "made of too many parts" };
            return Err(Diagnostic::at(node.place, format!("the shape is {limit}")));
        }
        match &node.value {
            Value::Text(name) => self.named(name, node.place, depth),
            Value::Table(table) => self.described(node, table, depth),
            _ => Err(Diagnostic::at(node.place, format!("a shape is expected, found {}", node.found()))
                .help("write { box = { min = [..], max = [..] } }, or the name of a region in quotes")),
        }
    }

    fn named(&mut self, name: &str, place: Place, depth: usize) -> Result<ShapeSpec, Diagnostic> {
        let Some((&name, &node)) = self.regions.get_key_value(name) else {
            return Err(Diagnostic::at(place, format!("unknown region `{name}`"))
                .help(did_you_mean(name, self.region_names())));
        };
        if self.open.contains(&name) {
            return Err(Diagnostic::at(place, format!("region `{name}` is made of itself")));
        }
        self.open.push(name);
        let shape = self.nested(node, depth + 1);
        self.open.pop();
        shape
    }

    /// A table with one key, the kind of the shape.
    fn described(&mut self, node: &Node, table: &Table, depth: usize) -> Result<ShapeSpec, Diagnostic> {
        let [entry] = table.entries.as_slice() else {
            let count = table.entries.len();
            return Err(Diagnostic::at(
                node.place,
                format!("a shape is a table with one key, found {count}"),
            )
            .help(format!("the key is one of {}", listed(&kinds()))));
        };
        let kind = entry.key.as_str();
        let title = format!("the shape `{kind}`");
        match kind {
            "union" => Ok(ShapeSpec::Union(self.list(&entry.node, &title, depth)?)),
            "intersection" => Ok(ShapeSpec::Intersection(self.list(&entry.node, &title, depth)?)),
            "difference" => Ok(ShapeSpec::Difference(self.list(&entry.node, &title, depth)?)),
            "translate" => self.translate(&Section::of(&entry.node, title)?, depth),
            "rotate" => self.rotate(&Section::of(&entry.node, title)?, depth),
            "scale" => self.scale(&Section::of(&entry.node, title)?, depth),
            _ if kinds().contains(&kind) => {
                solid(self.scope, kind, entry.place, &Section::of(&entry.node, title)?)
            }
            _ => Err(Diagnostic::at(entry.place, format!("unknown shape `{kind}`"))
                .help(did_you_mean(kind, kinds()))),
        }
    }

    fn list(&mut self, node: &Node, title: &str, depth: usize) -> Result<Vec<ShapeSpec>, Diagnostic> {
        match &node.value {
            Value::Array(items) if !items.is_empty() => {
                items.iter().map(|item| self.nested(item, depth + 1)).collect()
            }
            _ => Err(Diagnostic::at(
                node.place,
                format!("{title} has to be a list of shapes, found {}", node.found()),
            )),
        }
    }

    /// The shape inside a transformation.
    fn inner(&mut self, section: &Section<'_>, depth: usize) -> Result<Box<ShapeSpec>, Diagnostic> {
        Ok(Box::new(self.nested(section.need(shape::SHAPE.name)?, depth + 1)?))
    }

    fn translate(&mut self, section: &Section<'_>, depth: usize) -> Result<ShapeSpec, Diagnostic> {
        section.only_of(shape::keys("translate"))?;
        let by = self.scope.vector(section.need(shape::BY.name)?, &shape::BY)?;
        Ok(ShapeSpec::Translate { by, shape: self.inner(section, depth)? })
    }

    fn rotate(&mut self, section: &Section<'_>, depth: usize) -> Result<ShapeSpec, Diagnostic> {
        section.only_of(shape::keys("rotate"))?;
        let angle = self.scope.need(section, &shape::ANGLE)?;
        let axis = self.axis(section)?;
        let about = self.about(section)?;
        Ok(ShapeSpec::Rotate { angle, axis, about, shape: self.inner(section, depth)? })
    }

    fn scale(&mut self, section: &Section<'_>, depth: usize) -> Result<ShapeSpec, Diagnostic> {
        section.only_of(shape::keys("scale"))?;
        let factor = self.scope.need(section, &shape::FACTOR)?;
        let about = self.about(section)?;
        Ok(ShapeSpec::Scale { factor, about, shape: self.inner(section, depth)? })
    }

    /// The point that stays; the origin if none is given.
    fn about(&self, section: &Section<'_>) -> Result<[f64; 3], Diagnostic> {
        section.get(shape::ABOUT.name).map_or(Ok([0.0; 3]), |node| self.scope.vector(node, &shape::ABOUT))
    }

    /// The unit vector of a rotation: given in 3D, z in 2D.
    pub(crate) fn axis(&self, section: &Section<'_>) -> Result<[f64; 3], Diagnostic> {
        if self.scope.dimension == 2 {
            return match section.get(shape::AXIS.name) {
                None => Ok([0.0, 0.0, 1.0]),
                Some(node) => Err(Diagnostic::at(node.place, "a rotation in 2D has no `axis`")),
            };
        }
        let node = section.need(shape::AXIS.name)?;
        let axis = self.scope.vector(node, &shape::AXIS)?;
        let largest = axis.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
        if largest == 0.0 {
            return Err(Diagnostic::at(node.place, "the axis of a rotation cannot be zero"));
        }
        // Divided by its largest component first, so that squares neither overflow nor vanish.
        let axis = axis.map(|c| c / largest);
        let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
        Ok(axis.map(|c| c / length))
    }
}
