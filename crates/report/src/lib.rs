//! Pictures of particles and plots of probes.
//!
//! [`picture`] draws one [`output::Frame`] without a window system or a graphics card; [`plot_probe`] draws
//! a probe table as SVG, [`write_gif`] makes an animation. All take whatever a run produced, also an empty or a broken one (NaN, one sample,
//! no particles), and draw what can be drawn.

mod animation;
mod audit;
mod colours;
mod corner;
mod error;
mod field;
mod image;
mod layout;
mod legend;
mod occlusion;
mod palette;
mod picture;
mod plot;
mod range;
mod scale;
mod splat;
mod view;

pub use animation::write_gif;
pub use audit::plot_audit;
pub use error::ReportError;
pub use field::{components, split_field};
pub use image::{Image, encoded, write_png};
pub use picture::{Picture, picture, typical_range};
pub use plot::{plot_over, plot_probe};
pub use range::Range;
pub use view::{View, Window};
