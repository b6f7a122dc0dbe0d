//! The taut program, callable as a function.
