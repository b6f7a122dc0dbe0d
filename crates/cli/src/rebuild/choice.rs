//! What the options of `taut report` choose: frames, a direction, a range.

use output::Listed;
use report::View;
use std::str::FromStr;

/// Frames of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frames {
    All,
    Start,
    Middle,
    End,
    /// Numbers, both ends included.
    Numbers(usize, usize),
}

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| {
            text.parse().map_err(|_| {
                format!("`{text}` is none of start, middle, end, all, a number, a range such as 3-7")
            })
        };
        match text {
            "all" => Ok(Self::All),
            "start" => Ok(Self::Start),
            "middle" => Ok(Self::Middle),
            "end" => Ok(Self::End),
            _ => match text.split_once('-') {
                Some((first, last)) => Ok(Self::Numbers(number(first)?, number(last)?)),
                None => number(text).map(|n| Self::Numbers(n, n)),
            },
        }
    }
}

impl Frames {
    /// Names and numbers of the frames of this list, whose run should end at a time (s); none where it has no such frame.
    pub fn of(self, list: &[Listed], end: f64) -> Vec<(String, usize)> {
        let Some(last) = list.len().checked_sub(1) else { return Vec::new() };
        let name = |number: usize| (format!("frame-{number:06}"), number);
        match self {
            Self::All => (0..=last).map(name).collect(),
            Self::Start => vec![("start".to_string(), 0)],
            Self::Middle => vec![("middle".to_string(), middle(list, end))],
            Self::End => vec![("end".to_string(), last)],
            Self::Numbers(first, end) => (first..=end.min(last)).map(name).collect(),
        }
    }
}

impl Frames {
    /// Says that there are no such frames, if they are given by number.
    pub fn missing(self, list: &[Listed]) -> Option<String> {
        let (Self::Numbers(first, _), Some(last)) = (self, list.len().checked_sub(1)) else { return None };
        Some(format!("there is no frame {first}: the frames are 0 to {last}"))
    }
}

/// The number of the frame nearest to half of the time that the run should have got to, or got to.
fn middle(list: &[Listed], end: f64) -> usize {
    let half = 0.5 * list.last().map_or(0.0, |frame| frame.time.min(end));
    let far = |number: &usize| (list[*number].time - half).abs();
    (0..list.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
}

/// A direction to look from: a name, or azimuth and elevation in degrees.
pub fn view(text: &str) -> Result<View, String> {
    let named = match text {
        "front" => Some((-90.0, 0.0)),
        "back" => Some((90.0, 0.0)),
        "right" => Some((0.0, 0.0)),
        "left" => Some((180.0, 0.0)),
        "top" => Some((-90.0, 90.0)),
        "bottom" => Some((-90.0, -90.0)),
        "oblique" => Some((View::default().azimuth, View::default().elevation)),
        _ => None,
    };
    let wrong = || {
        "expected front, back, left, right, top, bottom, oblique, or AZIMUTH,ELEVATION in degrees".to_string()
    };
    let (azimuth, elevation) = named.or_else(|| pair(text)).ok_or_else(wrong)?;
    if !(-90.0..=90.0).contains(&elevation) {
        return Err(format!("the elevation is {elevation} degrees, and not from -90 to 90"));
    }
    Ok(View { azimuth, elevation })
}

/// The values at the ends of the colours.
pub fn range(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = pair(text).ok_or("expected LOW,HIGH in SI units, for instance 0,2e6")?;
    if low < high { Ok([low, high]) } else { Err(format!("{low} is not below {high}")) }
}

fn pair(text: &str) -> Option<(f64, f64)> {
    let (one, other) = text.split_once(',')?;
    let number = |text: &str| text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    Some((number(one)?, number(other)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_chosen_by_name_number_and_range() {
        let list: Vec<Listed> =
            [0.0, 0.1, 0.45, 0.9].map(|time| Listed { time, path: "a.vtp".into() }).into_iter().collect();
        let numbers = |text: &str| -> Vec<usize> {
            let frames: Frames = text.parse().expect("a choice");
            frames.of(&list, 1.0).into_iter().map(|(_, number)| number).collect()
        };
        for (text, expected) in [
            ("all", &[0, 1, 2, 3][..]),
            ("middle", &[2]),
            ("end", &[3]),
            ("1-9", &[1, 2, 3]),
            ("7", &[]),
            ("3-1", &[]),
        ] {
            assert_eq!(numbers(text), expected, "{text}");
        }
        assert!(Frames::End.of(&[], 1.0).is_empty());
        for text in ["", "last", "-1", "1-", "1-2-3", "1.5"] {
            assert!(text.parse::<Frames>().is_err(), "{text}");
        }
    }

    #[test]
    fn directions_and_ranges() {
        assert_eq!(view("-60,22"), Ok(View::default()));
        assert_eq!(view("top"), Ok(View::PLANE));
        assert_eq!(range("-1,2e6"), Ok([-1.0, 2e6]));
        assert!(["", "up", "1", "0,91", "nan,0", "1,2,3"].iter().all(|text| view(text).is_err()));
        assert!(["", "2,1", "1,1", "0,inf"].iter().all(|text| range(text).is_err()));
    }
}
