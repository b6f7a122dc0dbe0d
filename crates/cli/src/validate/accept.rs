//! `accept.toml`: which runs a benchmark consists of, and what must hold of them.

use super::path::Path;
use serde::Deserialize;

/// The runs of a benchmark and what must hold of them.
#[derive(Clone, Debug)]
pub struct Accept {
    /// Built-in case that all runs start from.
    pub case: String,
    /// The runs.
    pub runs: Vec<Run>,
    /// What must hold.
    pub checks: Vec<Check>,
}

/// One run.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Name, unique in the file.
    pub name: String,
    /// Overrides, as behind `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Formulation, if not that of the case.
    pub formulation: Option<String>,
    /// Whether only `--full` has the patience for it.
    #[serde(default)]
    pub full: bool,
    /// A negative control: it may diverge, and what it had until then is looked at.
    #[serde(default)]
    pub may_diverge: bool,
}

/// One thing that must hold of one run.
#[derive(Clone, Debug)]
pub struct Check {
    /// What is looked at, in words.
    pub quantity: String,
    /// Index of the run.
    pub run: usize,
    /// Where the number stands.
    pub value: Path,
    /// What it is divided by: run and place.
    pub over: Option<(usize, Path)>,
    /// What it is then multiplied with.
    pub scale: f64,
    /// Unit of the result.
    pub unit: String,
    /// What it is held against.
    pub target: Target,
    /// Paper and table or figure, or where else the expectation comes from.
    pub source: String,
    /// Why this, and why this tolerance.
    pub why: String,
}

/// What a number is held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A value, and how far from it the number may be.
    Near(Expected, Tolerance),
    /// It must be less.
    Below(f64),
    /// It must be more.
    Above(f64),
}

/// A value and who says so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// A paper.
    Published(f64),
    /// A formula.
    Analytic(f64),
    /// Another computation, or a property that needs no source.
    Reference(f64),
}

impl Expected {
    /// The value.
    pub fn value(self) -> f64 {
        let (Self::Published(value) | Self::Analytic(value) | Self::Reference(value)) = self;
        value
    }
}

/// How far off is near enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Difference over the expected value.
    Relative(f64),
    /// Difference, in the unit of the quantity.
    Absolute(f64),
}

/// The file as written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    case: String,
    run: Vec<Run>,
    check: Vec<WrittenCheck>,
}

/// A check as written: of several runs, with everything optional.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCheck {
    quantity: String,
    runs: Vec<String>,
    value: Path,
    over: Option<Path>,
    over_run: Option<String>,
    scale: Option<f64>,
    #[serde(default = "one")]
    unit: String,
    published: Option<Values>,
    analytic: Option<Values>,
    reference: Option<Values>,
    relative: Option<f64>,
    absolute: Option<f64>,
    below: Option<f64>,
    above: Option<f64>,
    source: String,
    why: String,
}

/// One value for all runs of a check, or one for each.
#[derive(Clone, Deserialize)]
#[serde(untagged)]
enum Values {
    Same(f64),
    Each(Vec<f64>),
}

impl Values {
    fn of(&self, index: usize, runs: usize) -> Result<f64, String> {
        match self {
            Self::Same(value) => Ok(*value),
            Self::Each(values) if values.len() == runs => Ok(values[index]),
            Self::Each(values) => Err(format!("{} values for {runs} runs", values.len())),
        }
    }
}

fn one() -> String {
    "1".to_string()
}

impl Accept {
    /// Reads and checks the text of an `accept.toml`; the error says what is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let written: Written = toml::from_str(text).map_err(|error| error.to_string())?;
        let runs = written.run;
        for (i, run) in runs.iter().enumerate() {
            if runs[..i].iter().any(|earlier| earlier.name == run.name) {
                return Err(format!("two runs are called `{}`", run.name));
            }
        }
        let mut checks = Vec::new();
        for check in &written.check {
            for index in 0..check.runs.len() {
                let of_run = check.of(index, &runs);
                checks.push(of_run.map_err(|what| format!("check `{}`: {what}", check.quantity))?);
            }
        }
        Ok(Self { case: written.case, runs, checks })
    }

    /// The runs that a check needs.
    pub fn needs(check: &Check) -> impl Iterator<Item = usize> + use<> {
        let over = check.over.as_ref().map(|(run, _)| *run);
        std::iter::once(check.run).chain(over)
    }

    /// Whether a check needs a run that only `--full` makes.
    pub fn is_full(&self, check: &Check) -> bool {
        Self::needs(check).any(|run| self.runs[run].full)
    }
}

impl WrittenCheck {
    /// The check of one of its runs.
    fn of(&self, index: usize, runs: &[Run]) -> Result<Check, String> {
        let find = |name: &str| {
            runs.iter().position(|run| run.name == name).ok_or_else(|| format!("there is no run `{name}`"))
        };
        let run = find(&self.runs[index])?;
        let over = match (&self.over_run, &self.over) {
            (None, None) => None,
            (None, Some(path)) => Some((run, path.clone())),
            (Some(other), path) => Some((find(other)?, path.clone().unwrap_or_else(|| self.value.clone()))),
        };
        Ok(Check {
            quantity: self.quantity.clone(),
            run,
            value: self.value.clone(),
            over,
            scale: self.scale.unwrap_or(1.0),
            unit: self.unit.clone(),
            target: self.target(index)?,
            source: self.source.clone(),
            why: self.why.clone(),
        })
    }

    fn target(&self, index: usize) -> Result<Target, String> {
        let value = |values: &Values| values.of(index, self.runs.len());
        let expected = match (&self.published, &self.analytic, &self.reference) {
            (Some(values), None, None) => Some(Expected::Published(value(values)?)),
            (None, Some(values), None) => Some(Expected::Analytic(value(values)?)),
            (None, None, Some(values)) => Some(Expected::Reference(value(values)?)),
            (None, None, None) => None,
            _ => return Err("only one of `published`, `analytic`, `reference`".to_string()),
        };
        match (expected, self.relative, self.absolute, self.below, self.above) {
            (Some(e), Some(_), None, None, None) if e.value() == 0.0 => {
                Err("nothing is near 0 by a share of it: say `absolute`".to_string())
            }
            (Some(e), Some(share), None, None, None) => Ok(Target::Near(e, Tolerance::Relative(share))),
            (Some(e), None, Some(distance), None, None) => Ok(Target::Near(e, Tolerance::Absolute(distance))),
            (None, None, None, Some(limit), None) => Ok(Target::Below(limit)),
            (None, None, None, None, Some(limit)) => Ok(Target::Above(limit)),
            _ => Err("say either a value and `relative` or `absolute`, or `below`, or `above`".to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RUNS: &str = "case = 'ul-rings'\n[[run]]\nname = 'a'\n[[run]]\nname = 'b'\nfull = true\n";

    fn with(check: &str) -> Result<Accept, String> {
        let common = "quantity = 'q'\nruns = ['a']\nvalue = 'measured.q'\nsource = 's'\nwhy = 'w'";
        Accept::parse(&format!("{RUNS}[[check]]\n{common}\n{check}\n"))
    }

    #[test]
    fn a_check_becomes_one_for_every_run_and_is_as_long_as_its_longest_run() {
        let text = format!(
            "{RUNS}[[check]]\nquantity = 'q'\nruns = ['a', 'b']\nvalue = 'measured.q'\nbelow = 1\nsource = ''\nwhy = ''"
        );
        let accept = Accept::parse(&text).unwrap();
        let full: Vec<bool> = accept.checks.iter().map(|check| accept.is_full(check)).collect();
        assert_eq!(full, [false, true]);
        let ratio = with("over_run = 'b'\nabove = 10").unwrap();
        assert!(ratio.is_full(&ratio.checks[0]));
        assert_eq!(ratio.checks[0].over, Some((1, ratio.checks[0].value.clone())));
    }

    #[test]
    fn values_may_differ_from_run_to_run() {
        let common = "quantity = 'q'\nvalue = 'measured.q'\nsource = 's'\nwhy = 'w'\nrelative = 0.1";
        let parse = |rest: &str| Accept::parse(&format!("{RUNS}[[check]]\n{common}\n{rest}\n"));
        let accept = parse("runs = ['a', 'b']\npublished = [1.0, 2.0]").unwrap();
        let values: Vec<Target> = accept.checks.iter().map(|check| check.target).collect();
        let near = |value| Target::Near(Expected::Published(value), Tolerance::Relative(0.1));
        assert_eq!(values, [near(1.0), near(2.0)]);
        assert!(parse("runs = ['a', 'b']\npublished = [1.0]").unwrap_err().contains("1 values for 2 runs"));
    }

    #[test]
    fn targets() {
        let target = |check: &str| with(check).map(|accept| accept.checks[0].target);
        let near = Target::Near(Expected::Published(2.0), Tolerance::Relative(0.01));
        assert_eq!(target("published = 2\nrelative = 0.01"), Ok(near));
        assert_eq!(target("below = 3"), Ok(Target::Below(3.0)));
        for wrong in [
            "",
            "published = 2",
            "relative = 0.1",
            "published = 2\nanalytic = 2\nrelative = 0.1",
            "published = 2\nbelow = 3",
            "below = 3\nabove = 2",
            "published = 0\nrelative = 0.1",
        ] {
            assert!(target(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn unknown_names_are_refused() {
        assert!(with("below = 1\nbelwo = 2").unwrap_err().contains("belwo"));
        assert!(with("below = 1\nover_run = 'c'").unwrap_err().contains("no run `c`"));
        assert!(Accept::parse("case = 'x'\n[[run]]\nname = 'a'\n[[run]]\nname = 'a'\n[[check]]\n").is_err());
    }
}
