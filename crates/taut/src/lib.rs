//! The numerics of Taut: no input or output, no file format, no clock.
