//! Pictures of particles and plots of probes.
//!
//! [`picture`] draws one [`output::Frame`] without a window system or a graphics card; [`plot_probe`] draws
//! a probe table as SVG. Both take whatever a run produced, also an empty or a broken one (NaN, one sample,
//! no particles), and draw what can be drawn.

mod audit;
mod colours;
mod error;
mod image;
mod layout;
mod legend;
mod palette;
mod picture;
mod plot;
mod scale;
mod splat;
mod view;

pub use audit::plot_audit;
pub use error::ReportError;
pub use image::{Image, write_png};
pub use picture::{Picture, picture};
pub use plot::plot_probe;
pub use view::{View, Window};
