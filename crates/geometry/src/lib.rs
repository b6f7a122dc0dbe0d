//! Shapes, their signed distances and combinations, and how they are filled with particles.
