//! How thick a body is where a particle stands.

use super::wall::Walls;
use crate::point::{Dimension, Point, add, dot, scale};
use crate::shape::Shape;

/// Shortest step through a body, in spacings.
const LEAST: f64 = 0.125;

/// The way through a body from the surface that is nearest to `x`, straight in, in m: `None` for a particle that is farther than a spacing
/// from the surface, infinite if the body is thicker than `most`.
pub fn thickness(shape: &Shape, x: Point, (spacing, most): (f64, f64), dimension: Dimension) -> Option<f64> {
    let walls = Walls::new(shape, spacing, dimension);
    let wall = walls.at(x);
    if wall.distance < -spacing || dot(wall.normal, wall.normal) == 0.0 {
        return None;
    }
    let mut way = -wall.distance;
    while way < most {
        let depth = -shape.distance(add(x, scale(wall.normal, -wall.distance - way)));
        if depth <= 0.0 {
            return Some(way);
        }
        way += depth.max(LEAST * spacing);
    }
    Some(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_through_a_wall_is_its_thickness_also_at_its_edge() {
        let sheet = Shape::Box { min: [0.0; 3], max: [5.0, 5.0, 0.4] };
        for x in [[2.0, 2.0, 0.05], [0.3, 2.0, 0.06], [0.3, 0.3, 0.35]] {
            let way = thickness(&sheet, x, (0.1, 2.0), Dimension::Three).unwrap();
            // The last step may lead an eighth of a spacing beyond.
            assert!((0.4 - 1e-9..0.4125 + 1e-9).contains(&way), "{way}");
        }
        assert_eq!(thickness(&sheet, [2.0, 2.0, 0.2], (0.1, 2.0), Dimension::Three), None);
        assert_eq!(thickness(&sheet, [0.05, 2.0, 0.2], (0.1, 2.0), Dimension::Three), Some(f64::INFINITY));
    }
}
