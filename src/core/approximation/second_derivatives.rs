//! The second derivatives `Mᵢ = p″(xᵢ)` of a cubic spline through given points, from the tridiagonal system
//!
//! ```text
//! hᵢ₋₁ Mᵢ₋₁ + 2 (hᵢ₋₁ + hᵢ) Mᵢ + hᵢ Mᵢ₊₁ = 6 (sᵢ − sᵢ₋₁),   hᵢ = xᵢ₊₁ − xᵢ,  sᵢ = (yᵢ₊₁ − yᵢ)/hᵢ
//! ```
//!
//! and one equation at each end. Whatever happens at one site is at most half as large at the next, for any spacing. Long systems are therefore solved window by window, each
//! with [`MARGIN`] rows more on both sides than are kept: what is neglected is smaller than rounding. Several windows advance together, because each step waits for a division.

use crate::core::point::Point;

/// Rows beyond a window: 2⁻⁶⁴ is far below rounding.
pub(super) const MARGIN: usize = 64;
/// Rows of a window that are kept.
const WINDOW: usize = 1024;
/// Windows that advance together.
const LANES: usize = 4;

/// The equation `factor·M_neighbour + diagonal·M_end = right` at one end of the system.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndRow<P> {
    pub(super) factor: f64,
    pub(super) diagonal: f64,
    pub(super) right: P,
}

impl<P: Point> EndRow<P> {
    /// `M_end = value`.
    pub(super) fn value(value: P) -> Self {
        Self { factor: 0.0, diagonal: 1.0, right: value }
    }
}

/// Writes `Mᵢ` for all sites into `moments`; the ends of the system are the first and the last site.
pub(super) fn solve<P: Point>(
    sites: &[f64],
    values: &[P],
    start: EndRow<P>,
    end: EndRow<P>,
    moments: &mut [P],
) {
    let (size, length) = (sites.len(), WINDOW + 2 * MARGIN);
    if size < LANES * length {
        return sweep([0], size, sites, values, start, end, moments);
    }
    // The last window starts where it ends with the system.
    let windows = (size - 2 * MARGIN).div_ceil(WINDOW).next_multiple_of(LANES);
    let first = |window: usize| (window * WINDOW).min(size - length);
    for group in (0..windows).step_by(LANES) {
        let starts: [usize; LANES] = std::array::from_fn(|lane| first(group + lane));
        sweep(starts, length, sites, values, start, end, moments);
    }
}

/// Solves the windows of `length` rows that begin at `starts`, with zero beyond their ends unless the system ends there, and hands over the rows that are exact.
#[inline(always)]
fn sweep<P: Point, const L: usize>(
    starts: [usize; L],
    length: usize,
    sites: &[f64],
    values: &[P],
    start: EndRow<P>,
    end: EndRow<P>,
    moments: &mut [P],
) {
    let zero = EndRow::value(P::ZERO);
    let x: [&[f64]; L] = std::array::from_fn(|lane| &sites[starts[lane]..][..length]);
    let y: [&[P]; L] = std::array::from_fn(|lane| &values[starts[lane]..][..length]);
    let at_end: [bool; L] = std::array::from_fn(|lane| starts[lane] + length == sites.len());
    // Mᵢ = value − ratio Mᵢ₊₁ after elimination.
    let mut eliminated = Vec::with_capacity(length);
    let (mut ratio, mut value) = ([0.0; L], [P::ZERO; L]);
    let (mut width, mut slope) = ([0.0; L], [P::ZERO; L]);
    for lane in 0..L {
        let row = if starts[lane] == 0 { start } else { zero };
        (ratio[lane], value[lane]) = (row.factor / row.diagonal, row.right * row.diagonal.recip());
        width[lane] = x[lane][1] - x[lane][0];
        slope[lane] = (y[lane][1] - y[lane][0]) * width[lane].recip();
    }
    eliminated.push((ratio, value));
    for i in 1..length - 1 {
        for lane in 0..L {
            let next_width = x[lane][i + 1] - x[lane][i];
            let next_slope = (y[lane][i + 1] - y[lane][i]) * (1.0 / next_width);
            let pivot = 1.0 / (2.0 * (width[lane] + next_width) - width[lane] * ratio[lane]);
            value[lane] = ((next_slope - slope[lane]) * 6.0 - value[lane] * width[lane]) * pivot;
            ratio[lane] = next_width * pivot;
            (width[lane], slope[lane]) = (next_width, next_slope);
        }
        eliminated.push((ratio, value));
    }
    let mut moment = [P::ZERO; L];
    for lane in 0..L {
        if at_end[lane] {
            let pivot = (end.diagonal - end.factor * ratio[lane]).recip();
            moment[lane] = (end.right - value[lane] * end.factor) * pivot;
        }
    }
    // Rows to keep, counted in the window; neighbouring windows overlap in what they keep where the last ones were moved.
    let low: [usize; L] = std::array::from_fn(|lane| if starts[lane] == 0 { 0 } else { MARGIN });
    let high: [usize; L] = std::array::from_fn(|lane| if at_end[lane] { length } else { length - MARGIN });
    // The moments take the places of the eliminated values.
    eliminated.push((ratio, moment));
    for (ratio, value) in eliminated[..length - 1].iter_mut().rev() {
        for lane in 0..L {
            moment[lane] = value[lane] - moment[lane] * ratio[lane];
        }
        *value = moment;
    }
    for lane in 0..L {
        let kept = &eliminated[low[lane]..high[lane]];
        let places = &mut moments[starts[lane]..][low[lane]..high[lane]];
        places.iter_mut().zip(kept).for_each(|(place, (_, moment))| *place = moment[lane]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Elimination in one go.
    fn plain(x: &[f64], y: &[f64], start: EndRow<f64>, end: EndRow<f64>) -> Vec<f64> {
        let mut moments = vec![0.0; x.len()];
        sweep([0], x.len(), x, y, start, end, &mut moments);
        moments
    }

    #[test]
    fn windows_agree_with_one_elimination_on_wild_spacings() {
        for (size, spread) in [(4608, 0), (5000, 3), (20_001, 9)] {
            let mut x = vec![0.0];
            for i in 1..size {
                // Neighbouring intervals differ by up to 10^spread.
                let step = 10_f64.powi(-((i * i * 7 + i / 3) as i32 % (spread + 1)));
                x.push(x[i - 1] + step);
            }
            let y: Vec<f64> = (0..size).map(|i| ((i * i) % 17) as f64).collect();
            let start = EndRow { factor: 1.0, diagonal: 2.0, right: 3.0 };
            let end = EndRow { factor: -0.3, diagonal: 1.5, right: -2.0 };
            let expected = plain(&x, &y, start, end);
            let mut moments = vec![f64::NAN; size];
            solve(&x, &y, start, end, &mut moments);
            let local = |i: usize| {
                let near = &expected[i.saturating_sub(3)..(i + 4).min(size)];
                near.iter().fold(0.0_f64, |size, value| size.max(value.abs()))
            };
            for i in 0..size {
                let error = (moments[i] - expected[i]).abs();
                assert!(
                    error <= 1e-13 * local(i),
                    "size {size}, row {i}: {} and {}",
                    moments[i],
                    expected[i]
                );
            }
        }
    }
}
