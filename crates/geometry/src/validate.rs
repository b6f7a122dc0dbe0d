//! What makes a shape meaningful.

use crate::point::{Dimension, Point, unit};
use crate::polygon;
use crate::problem::{ShapeError, ShapeProblem as Problem};
use crate::shape::Shape;
use Dimension::{Three, Two};

impl Shape {
    /// Holds the shape against what its kind and `dimension` demand: finite numbers, positive sizes, simple
    /// polygons, non-empty lists, and in 2D everything in the plane z = 0.
    ///
    /// # Errors
    /// The first problem found, with its place within the shape.
    pub fn validate(&self, dimension: Dimension) -> Result<(), ShapeError> {
        let name = self.name();
        own_problem(self, dimension).map_err(|problem| ShapeError { path: name.to_owned(), problem })?;
        parts(self).into_iter().try_for_each(|(place, part)| {
            let outer = |e: ShapeError| ShapeError { path: format!("{name}{place}.{}", e.path), ..e };
            part.validate(dimension).map_err(outer)
        })
    }
}

/// The shapes that `shape` is made of, and their places in it.
fn parts(shape: &Shape) -> Vec<(String, &Shape)> {
    let numbered = |(i, part)| (format!("[{i}]"), part);
    match shape {
        Shape::Union(shapes) | Shape::Intersection(shapes) => {
            shapes.iter().enumerate().map(numbered).collect()
        }
        Shape::Difference(first, cuts) => {
            std::iter::once(&**first).chain(cuts).enumerate().map(numbered).collect()
        }
        Shape::Translate { shape, .. } | Shape::Rotate { shape, .. } | Shape::Scale { shape, .. } => {
            vec![(String::new(), shape)]
        }
        _ => Vec::new(),
    }
}

fn own_problem(shape: &Shape, dimension: Dimension) -> Result<(), Problem> {
    let place = |name, x| point(name, x, dimension);
    match shape {
        Shape::Box { min, max } => {
            place("min", *min)?;
            place("max", *max)?;
            (0..dimension.axes()).try_for_each(|i| ordered(['x', 'y', 'z'][i], min[i], max[i]))
        }
        Shape::Ball { center, radius } => {
            place("center", *center)?;
            positive("radius", *radius)
        }
        Shape::Ring { center, inner, outer } => {
            place("center", *center)?;
            ring([*inner, *outer])
        }
        Shape::Cylinder { from, to, radius } => {
            (dimension == Three).then_some(()).ok_or(Problem::OnlyInSpace)?;
            place("from", *from)?;
            place("to", *to)?;
            positive("radius", *radius)?;
            if from == to { Err(Problem::NoLength) } else { Ok(()) }
        }
        Shape::Polygon { points, height } => {
            corners(points)?;
            prism(*height, dimension)
        }
        Shape::Stent(stent) => match stent.problem() {
            _ if dimension == Two => Err(Problem::OnlyInSpace),
            problem => problem.map_or(Ok(()), Err),
        },
        Shape::Mesh(_) if dimension == Two => Err(Problem::MeshInPlane),
        Shape::Mesh(_) => Ok(()),
        Shape::Union(shapes) | Shape::Intersection(shapes) if shapes.is_empty() => Err(Problem::Nothing),
        Shape::Union(_) | Shape::Intersection(_) | Shape::Difference(..) => Ok(()),
        Shape::Translate { by, .. } => place("by", *by),
        Shape::Rotate { angle, axis, about, .. } => {
            finite("angle", *angle)?;
            place("about", *about)?;
            rotation(*axis, dimension)
        }
        Shape::Scale { factor, about, .. } => {
            place("about", *about)?;
            positive("factor", *factor)
        }
    }
}

fn finite(name: &'static str, value: f64) -> Result<(), Problem> {
    if value.is_finite() { Ok(()) } else { Err(Problem::NotFinite { name, value }) }
}

fn positive(name: &'static str, value: f64) -> Result<(), Problem> {
    finite(name, value)?;
    if value > 0.0 { Ok(()) } else { Err(Problem::NotPositive { name, value }) }
}

fn point(name: &'static str, x: Point, dimension: Dimension) -> Result<(), Problem> {
    x.into_iter().try_for_each(|value| finite(name, value))?;
    if dimension == Two && x[2] != 0.0 { Err(Problem::OutOfPlane { name, z: x[2] }) } else { Ok(()) }
}

fn ordered(axis: char, low: f64, high: f64) -> Result<(), Problem> {
    if low < high { Ok(()) } else { Err(Problem::Inverted { axis, low, high }) }
}

fn ring([inner, outer]: [f64; 2]) -> Result<(), Problem> {
    finite("inner", inner)?;
    positive("outer", outer)?;
    if inner <= 0.0 {
        return Err(Problem::NoHole(inner));
    }
    if inner < outer { Ok(()) } else { Err(Problem::NoWall { inner, outer }) }
}

fn rotation(axis: Point, dimension: Dimension) -> Result<(), Problem> {
    axis.into_iter().try_for_each(|value| finite("axis", value))?;
    unit(axis).ok_or(Problem::NoAxis)?;
    let leaves = dimension == Two && (axis[0] != 0.0 || axis[1] != 0.0);
    if leaves { Err(Problem::AxisInPlane) } else { Ok(()) }
}

fn prism(height: Option<[f64; 2]>, dimension: Dimension) -> Result<(), Problem> {
    match (height, dimension) {
        (None, Two) => Ok(()),
        (Some(_), Two) => Err(Problem::HeightInPlane),
        (None, Three) => Err(Problem::NoHeight),
        (Some([low, high]), Three) => {
            finite("height", low)?;
            finite("height", high)?;
            ordered('z', low, high)
        }
    }
}

/// An area below this share of the squared perimeter is that of a line: rounding leaves the area uncertain by
/// about 1e-16 of the squared perimeter, and a strip 1e11 times as long as wide is no body.
const LEAST_AREA: f64 = 1e-12;

fn corners(points: &[[f64; 2]]) -> Result<(), Problem> {
    points.iter().flatten().try_for_each(|&value| finite("points", value))?;
    let count = points.len();
    if count < 3 {
        return Err(Problem::FewCorners(count));
    }
    if let Some(i) = (0..count).find(|&i| points[i] == points[(i + 1) % count]) {
        return Err(Problem::RepeatedCorner(i, (i + 1) % count));
    }
    if polygon::area(points).abs() <= LEAST_AREA * polygon::perimeter(points).powi(2) {
        return Err(Problem::NoArea);
    }
    polygon::crossing(points).map_or(Ok(()), |(i, j)| Err(Problem::Crossing(i, j)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BALL: Shape = Shape::Ball { center: [0.0; 3], radius: 1.0 };

    fn problem(shape: &Shape, dimension: Dimension) -> Option<Problem> {
        shape.validate(dimension).err().map(|e| e.problem)
    }

    fn boxed(min: Point, max: Point) -> Shape {
        Shape::Box { min, max }
    }

    fn plane_polygon(points: &[[f64; 2]]) -> Shape {
        Shape::Polygon { points: points.to_vec(), height: None }
    }

    #[test]
    fn sizes_must_be_positive_and_finite() {
        let ball = |radius| Shape::Ball { center: [0.0; 3], radius };
        assert_eq!(problem(&ball(1.0), Two), None);
        assert_eq!(problem(&ball(0.0), Two), Some(Problem::NotPositive { name: "radius", value: 0.0 }));
        assert!(matches!(problem(&ball(f64::NAN), Three), Some(Problem::NotFinite { .. })));
        let ring = |inner, outer| Shape::Ring { center: [0.0; 3], inner, outer };
        assert_eq!(problem(&ring(1.0, 1.0), Two), Some(Problem::NoWall { inner: 1.0, outer: 1.0 }));
        assert_eq!(problem(&ring(0.0, 1.0), Two), Some(Problem::NoHole(0.0)));
        let scaled = Shape::Scale { factor: -1.0, about: [0.0; 3], shape: Box::new(BALL) };
        assert_eq!(problem(&scaled, Two), Some(Problem::NotPositive { name: "factor", value: -1.0 }));
    }

    #[test]
    fn a_box_needs_extent_along_the_axes_of_its_dimension() {
        assert_eq!(problem(&boxed([0.0; 3], [1.0, 1.0, 0.0]), Two), None);
        let flat = Some(Problem::Inverted { axis: 'z', low: 0.0, high: 0.0 });
        assert_eq!(problem(&boxed([0.0; 3], [1.0, 1.0, 0.0]), Three), flat);
        let thick = Some(Problem::OutOfPlane { name: "max", z: 1.0 });
        assert_eq!(problem(&boxed([0.0; 3], [1.0; 3]), Two), thick);
        assert!(matches!(
            problem(&boxed([2.0; 3], [1.0; 3]), Three),
            Some(Problem::Inverted { axis: 'x', .. })
        ));
    }

    #[test]
    fn cylinders_and_prisms_are_of_space() {
        let cylinder = |to| Shape::Cylinder { from: [0.0; 3], to, radius: 1.0 };
        assert_eq!(problem(&cylinder([1.0, 0.0, 0.0]), Three), None);
        assert_eq!(problem(&cylinder([1.0, 0.0, 0.0]), Two), Some(Problem::OnlyInSpace));
        assert_eq!(problem(&cylinder([0.0; 3]), Three), Some(Problem::NoLength));
        let triangle = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let prism = |height| Shape::Polygon { points: triangle.clone(), height };
        assert_eq!(problem(&prism(None), Two), None);
        assert_eq!(problem(&prism(None), Three), Some(Problem::NoHeight));
        assert_eq!(problem(&prism(Some([0.0, 1.0])), Three), None);
        assert_eq!(problem(&prism(Some([0.0, 1.0])), Two), Some(Problem::HeightInPlane));
        assert!(matches!(
            problem(&prism(Some([1.0, 1.0])), Three),
            Some(Problem::Inverted { axis: 'z', .. })
        ));
    }

    #[test]
    fn polygons_are_simple_and_have_area() {
        let closed = plane_polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]);
        assert_eq!(problem(&closed, Two), Some(Problem::RepeatedCorner(3, 0)));
        assert_eq!(problem(&plane_polygon(&[[0.0, 0.0], [1.0, 0.0]]), Two), Some(Problem::FewCorners(2)));
        let line = plane_polygon(&[[0.0, 0.0], [1.0, 0.1], [2.0, 0.2]]);
        assert_eq!(problem(&line, Two), Some(Problem::NoArea));
        let crossed = plane_polygon(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 3.0]]);
        assert_eq!(problem(&crossed, Two), Some(Problem::Crossing(0, 2)));
    }

    #[test]
    fn rotations_have_an_axis_and_stay_in_the_plane() {
        let turn = |axis| Shape::Rotate { angle: 1.0, axis, about: [0.0; 3], shape: Box::new(BALL) };
        assert_eq!(problem(&turn([0.0, 0.0, -2.0]), Two), None);
        assert_eq!(problem(&turn([1.0, 0.0, 0.0]), Two), Some(Problem::AxisInPlane));
        assert_eq!(problem(&turn([1.0, 0.0, 0.0]), Three), None);
        assert_eq!(problem(&turn([0.0; 3]), Three), Some(Problem::NoAxis));
    }

    #[test]
    fn the_error_names_the_place() {
        let bad = Shape::Translate { by: [0.0; 3], shape: Box::new(Shape::Union(vec![])) };
        let shape = Shape::Difference(Box::new(BALL), vec![BALL, bad]);
        let message = shape.validate(Two).unwrap_err().to_string();
        assert_eq!(message, "difference[2].translate.union: it has no shapes; list at least one");
    }
}
