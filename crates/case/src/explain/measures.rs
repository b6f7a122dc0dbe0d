//! Named results in plain words.

use super::{short, time};
use crate::{Case, Compared, Comparison, Feature, MeasureKind, Statistic};

pub(super) fn measure(case: &Case, kind: &MeasureKind) -> String {
    match kind {
        MeasureKind::Probe { probe, axis, feature, over } => {
            let probe = &case.probes[*probe];
            // Of moments in the plane there is only the last.
            let first = probe.quantity.axes(case.dimension).start;
            let name = probe.quantity.components(case.dimension)[axis.index() - first];
            let what = featured(feature, &format!("{name} of probe {}", probe.name));
            over.map_or(what.clone(), |over| format!("{what}, over {}", short(over)))
        }
        MeasureKind::Turns { probe, axis, feature } => {
            let axis = ["x", "y", "z"][axis.index()];
            let probe = &case.probes[*probe].name;
            featured(feature, &format!("turns of probe {probe} around the {axis} axis"))
        }
        MeasureKind::Field(field) => compared(field),
        MeasureKind::KineticRatio => "kinetic energy at the end over that at the start".into(),
        MeasureKind::ContactStart => "when bodies first touch".into(),
        MeasureKind::VolumeRatio { body } => {
            format!("volume of {} at the end over that at rest", case.bodies[*body].name)
        }
        MeasureKind::ReboundSpeed { body } => format!("speed of {} at the end", case.bodies[*body].name),
    }
}

fn compared(c: &Comparison) -> String {
    let (field, against) = match &c.field {
        Compared::Displacement(to) => {
            let parts =
                to.as_ref().map(|to| to.components.each_ref().map(|c| c.text().to_string()).join(", "));
            ("displacement", parts)
        }
        Compared::VonMises(to) => ("von Mises stress", to.as_ref().map(|to| to.text().to_string())),
    };
    let against = against.unwrap_or_default();
    match c.statistic {
        Statistic::ErrorMax => format!(
            "the largest difference of the {field} from ({against}) at the end, over the largest of it"
        ),
        Statistic::ErrorRms => format!(
            "the difference of the {field} from ({against}) at the end, root mean square over the largest of it"
        ),
        Statistic::Ratio => format!("mean {field} at the end over that of ({against})"),
        Statistic::Largest => format!("the largest {field} at the end"),
    }
}

fn featured(feature: &Feature, of: &str) -> String {
    match feature {
        Feature::FirstCrossing => format!("when {of} first crosses zero"),
        Feature::SecondCrossing => format!("when {of} crosses zero the second time"),
        Feature::Frequency => format!("the frequency at which {of} moves most"),
        Feature::Duration => format!("for how long {of} is larger than half of its largest value"),
        Feature::Maximum => format!("the largest {of}"),
        Feature::Minimum => format!("the smallest {of}"),
        Feature::TurningPoint { extremum, index, .. } => {
            format!("{extremum:?} number {index} of {of}").to_lowercase()
        }
        Feature::ValueAt { time: at } => format!("{of} at {}", time(*at)),
    }
}
