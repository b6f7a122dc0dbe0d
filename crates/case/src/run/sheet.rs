//! The sheets that go from the run to its writer and back.
//!
//! ```text
//!   run                                        writer
//!   fills a sheet ------------- full --------> disorder, frames, tables
//!   takes an empty one <------- blank -------- hands it back
//! ```
//!
//! There are two sheets, so memory is bounded: while one is written down the other is filled, and a run that is
//! faster than its disk waits for a blank one.

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::Duration;
use taut::integrator::Impulse;
use taut::simulation::{Snapshot, Totals};

/// So many samples of probes make a full sheet, even if nothing else is due.
const FULL: usize = 4096;

/// How long a run that has nothing to do waits before it looks again.
const PAUSE: Duration = Duration::from_micros(100);

/// A sample of a probe.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Which probe.
    pub probe: usize,
    /// Time, s.
    pub time: f64,
    /// Value, by axis.
    pub value: [f64; 3],
}

/// What the run tells its writer at once.
#[derive(Debug, Default)]
pub struct Sheet {
    /// Samples of probes, in the order in which they were taken.
    pub samples: Vec<Sample>,
    /// All particles; means something if one of the next two is set.
    pub snapshot: Snapshot,
    /// Energies and momenta, likewise.
    pub totals: Totals,
    /// Mean force and moment of every boundary since the sheet before that had particles on it; none at the first.
    pub reactions: Vec<Impulse>,
    /// Steps taken.
    pub step: u64,
    /// Whether to note the energies, and whether bodies touch.
    pub look: bool,
    /// Whether to measure disorder as well.
    pub measure: bool,
    /// Whether to write a frame.
    pub frame: bool,
}

impl Sheet {
    fn is_due(&self) -> bool {
        self.look || self.frame || self.samples.len() >= FULL
    }

    fn is_empty(&self) -> bool {
        self.samples.is_empty() && !self.look && !self.frame
    }

    fn wipe(&mut self) {
        self.samples.clear();
        self.reactions.clear();
        (self.look, self.measure, self.frame) = (false, false, false);
    }
}

/// The writer has stopped; why, it says itself.
#[derive(Debug)]
pub struct WriterGone;

/// The run's end: a sheet to fill.
#[derive(Debug)]
pub struct Outbox {
    /// The sheet that is being filled.
    pub sheet: Sheet,
    full: Sender<Sheet>,
    blank: Receiver<Sheet>,
}

/// The writer's end.
#[derive(Debug)]
pub struct Inbox {
    full: Receiver<Sheet>,
    blank: Sender<Sheet>,
}

/// Both ends, with two sheets between them.
pub fn sheets() -> (Outbox, Inbox) {
    let ((full, to_write), (blank, to_fill)) = (channel(), channel());
    // Cannot fail: the other end is here.
    let _ = blank.send(Sheet::default());
    let outbox = Outbox { sheet: Sheet::default(), full, blank: to_fill };
    (outbox, Inbox { full: to_write, blank })
}

impl Outbox {
    /// Hands the sheet over if something on it is due; waits for a blank one.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn post(&mut self) -> Result<(), WriterGone> {
        if self.sheet.is_due() { self.send() } else { Ok(()) }
    }

    /// Hands over whatever is on the last sheet.
    ///
    /// # Errors
    /// If the writer has stopped.
    pub fn last(mut self) -> Result<(), WriterGone> {
        if self.sheet.is_empty() { Ok(()) } else { self.send() }
    }

    fn send(&mut self) -> Result<(), WriterGone> {
        let blank = self.wait()?;
        self.full.send(std::mem::replace(&mut self.sheet, blank)).map_err(|_| WriterGone)
    }
}

impl Outbox {
    /// The next blank sheet. The writer computes on the threads of the run, so this one helps while it waits.
    fn wait(&self) -> Result<Sheet, WriterGone> {
        loop {
            match self.blank.try_recv() {
                Ok(sheet) => return Ok(sheet),
                Err(TryRecvError::Disconnected) => return Err(WriterGone),
                Err(TryRecvError::Empty) => {}
            }
            if rayon::yield_now() != Some(rayon::Yield::Executed) {
                std::thread::sleep(PAUSE);
            }
        }
    }
}

impl Inbox {
    /// The next sheet; `None` when the run is over.
    pub fn next(&self) -> Option<Sheet> {
        self.full.recv().ok()
    }

    /// Hands a sheet back.
    pub fn back(&self, mut sheet: Sheet) {
        sheet.wipe();
        // A run that is over needs no more sheets.
        let _ = self.blank.send(sheet);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(time: f64) -> Sample {
        Sample { probe: 0, time, value: [0.0; 3] }
    }

    #[test]
    fn sheets_come_in_order_and_none_is_lost() {
        let (mut outbox, inbox) = sheets();
        let writer = std::thread::spawn(move || {
            let mut times = Vec::new();
            while let Some(sheet) = inbox.next() {
                times.extend(sheet.samples.iter().map(|s| s.time));
                inbox.back(sheet);
            }
            times
        });
        for i in 0..3 * FULL + 5 {
            outbox.sheet.samples.push(sample(i as f64));
            outbox.post().expect("the writer is there");
        }
        outbox.last().expect("the writer is there");
        let times = writer.join().expect("no panic");
        assert_eq!(times, (0..3 * FULL + 5).map(|i| i as f64).collect::<Vec<_>>());
    }

    #[test]
    fn there_are_two_sheets_and_no_third() {
        let (mut outbox, inbox) = sheets();
        outbox.sheet.frame = true;
        outbox.post().expect("a blank sheet is there");
        assert!(outbox.blank.try_recv().is_err(), "the run would wait");
        inbox.back(inbox.next().expect("a sheet"));
        assert!(outbox.blank.try_recv().is_ok_and(|sheet| !sheet.frame));
    }

    #[test]
    fn a_writer_that_stops_stops_the_run() {
        let (mut outbox, inbox) = sheets();
        drop(inbox);
        outbox.post().expect("nothing is due");
        outbox.sheet.look = true;
        assert!(outbox.post().is_err());
    }
}
