//! What a run shows while it runs: a bar on a terminal, plain lines otherwise, nothing when quiet.

use crate::check::duration;
use case::Case;
use case::run::{Observer, Progress};
use indicatif::{ProgressBar, ProgressStyle};
use output::Frame;
use std::io::IsTerminal;
use taut::simulation::Increment;

/// Where progress goes.
enum Shown {
    Nothing,
    /// The next tenth that gets a line.
    Lines(u32),
    Bar(ProgressBar),
}

/// Watches a run: shows progress, and keeps the frames that become pictures.
pub struct Watcher {
    shown: Shown,
    half: f64,
    /// First, middle and last frame.
    pub kept: Vec<Frame>,
}

impl Watcher {
    /// A watcher that shows something, or nothing.
    pub fn new(quiet: bool) -> Self {
        let shown = match quiet {
            true => Shown::Nothing,
            false if std::io::stderr().is_terminal() => Shown::Bar(ProgressBar::new(1000)),
            false => Shown::Lines(1),
        };
        Self { shown, half: 0.0, kept: Vec::new() }
    }

    fn line(&self, text: &str) {
        match &self.shown {
            Shown::Nothing => {}
            Shown::Lines(_) => complain!("{text}"),
            Shown::Bar(bar) => bar.suspend(|| complain!("{text}")),
        }
    }

    /// The run is over.
    pub fn finish(&self) {
        if let Shown::Bar(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }
}

impl Observer for Watcher {
    fn started(&mut self, case: &Case, particles: usize, threads: usize) {
        self.half = 0.5 * case.time.end;
        if let Shown::Bar(bar) = &self.shown {
            let style = ProgressStyle::with_template("{bar:40} {percent:>3}%  {msg}  ETA {eta}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        }
        self.line(&format!("{}: {particles} particles, {threads} threads", case.name));
    }

    fn warned(&mut self, warning: &str) {
        self.line(&format!("warning: {warning}"));
    }

    fn stepped(&mut self, p: &Progress) {
        let share = (p.time / p.end).min(1.0);
        match &mut self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar) => {
                bar.set_position((share * 1000.0) as u64);
                // Formatting for every step would cost more than small steps do.
                if p.step.is_multiple_of(50) {
                    bar.set_message(format!("t = {:.4e} s, step {}", p.time, p.step));
                }
            }
            Shown::Lines(next) if share * 10.0 >= f64::from(*next) => {
                *next = (share * 10.0) as u32 + 1;
                let left = p.wall * (1.0 - share) / share;
                complain!(
                    "{:>3.0} %  t = {:.4e} s  step {}  {} left",
                    share * 100.0,
                    p.time,
                    p.step,
                    duration(left)
                );
            }
            Shown::Lines(_) => {}
        }
    }

    fn settled(&mut self, i: &Increment, of: u32) {
        let how = if i.converged { "at rest" } else { "NOT at rest" };
        self.line(&format!(
            "increment {}/{of}  t = {:.4e} s  {how} after {} steps, unbalanced {:.1e}, motion {:.1e}",
            i.number, i.time, i.steps, i.balance.force, i.balance.motion
        ));
    }

    fn framed(&mut self, frame: Frame) {
        let middle = |f: &Frame| (f.time - self.half).abs();
        match self.kept.len() {
            0..=2 => self.kept.push(frame),
            _ => {
                if middle(&self.kept[2]) < middle(&self.kept[1]) {
                    self.kept.swap(1, 2);
                }
                self.kept[2] = frame;
            }
        }
    }
}
