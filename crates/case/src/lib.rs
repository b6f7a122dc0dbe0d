//! Case files: as written, then checked and in SI, then built; and the one time loop.
