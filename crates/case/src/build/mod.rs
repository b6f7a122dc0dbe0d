//! From a checked case to a simulation: one match over formulations and materials, one over dimensions.

mod afford;
mod apart;
mod bodies;
mod doubts;
mod drives;
mod gap;
mod loads;
mod observe;
mod saved;
mod shapes;
mod solvers;
mod statics;
mod stock;
mod surface;
mod thickness;
mod touch;

pub use afford::{available_memory, reckon};
pub use observe::{ProbePoint, Watch};
pub(crate) use shapes::{bounds, shape as shape_of};
pub(crate) use solvers::interior;
pub(crate) use statics::increments;
pub use stock::{Stock, particles, surfaces};

use crate::{Case, CaseError};
use taut::contact::Contact;
use taut::simulation::{Damping, Drive, Grip, InSpace, Numbers, Point, Solver};

/// Everything a run needs.
pub struct Built {
    /// The bodies.
    pub solvers: Vec<Box<dyn Solver>>,
    /// What they do to each other, if they touch.
    pub contact: Option<Contact>,
    /// What drives them.
    pub drives: Vec<Box<dyn Drive>>,
    /// Who is held by each boundary.
    pub grips: Vec<Grip>,
    /// What damps all motion.
    pub damping: Option<Box<dyn Damping>>,
    /// Where each probe reads.
    pub probes: Vec<ProbePoint>,
    /// The measure of disorder.
    pub watch: Box<dyn Watch>,
    /// Index of the body of every particle, in the order of ids.
    pub body: Vec<u32>,
    /// What the solvers compute with.
    pub numbers: Numbers,
    /// What is doubtful about the particles.
    pub warnings: Vec<String>,
    /// Particles across the thinnest part of each body.
    pub across: Vec<usize>,
}

impl Built {
    /// How many particles.
    #[must_use]
    pub fn particles(&self) -> usize {
        self.body.len()
    }
}

/// Builds the particles, formulations, drives and probes of a case, to be computed with these numbers.
///
/// # Errors
/// What shows only now: a body without particles, a boundary that holds nobody, a probe outside of its body.
pub fn build(case: &Case, numbers: Numbers) -> Result<Built, CaseError> {
    match case.dimension {
        2 => in_dimension::<2>(case, numbers),
        _ => in_dimension::<3>(case, numbers),
    }
}

fn in_dimension<const D: usize>(case: &Case, numbers: Numbers) -> Result<Built, CaseError>
where
    Point<D>: InSpace,
{
    afford::check::<D>(case)?;
    let mut groups = bodies::groups::<D>(case)?;
    bodies::initial(case, &mut groups)?;
    let driven = drives::prescribe(case, &mut groups)?;
    let loads = loads::loads(case, &mut groups, &driven.pulled())?;
    let solver = |group| solvers::solver(case, group, numbers);
    let mut solvers = groups.iter().map(solver).collect::<Result<Vec<_>, _>>()?;
    let tools = touch::tools::<D>(case)?;
    solvers.extend(case.tools.iter().zip(&tools).map(|(tool, points)| touch::rigid(case, tool, points)));
    let grips = driven.grips(case);
    // Loads add to what the others set.
    let drives = driven.drives().into_iter().chain(loads).collect();
    let probes = observe::probes(case, &groups)?;
    let (watch, body) = observe::disorder(case, (&groups, &tools))?;
    let across = thickness::across(case, &groups);
    let warnings = doubts::warnings(case, (&groups, &tools), &across);
    let (contact, damping) = (touch::contact(case), statics::damping(case, &groups));
    Ok(Built { solvers, contact, drives, grips, damping, probes, watch, body, numbers, warnings, across })
}
