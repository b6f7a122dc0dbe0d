//! Pictures of particles and plots of probes.
