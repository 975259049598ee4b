//! The signs of a piecewise polynomial, and the places at which they change.
//!
//! Each piece in Bernstein form has the zeros of [`bernstein_zeros`]; the sign between two of them is that of the value half way. At a joint, where the
//! function may jump, the signs of both sides stand side by side, so that a zero at a knot is found once. Course: beyond, sections B.5 and B.7.

use crate::core::point::Point as _;
use crate::core::root_finding::{Zeros, bernstein_zeros};
use crate::core::triangular_scheme::collapse;

/// Zeros closer to an end of a piece than this part of it are at that end.
const AT_END: f64 = 1e-9;

/// A place at which a sign may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SignPlace {
    pub(super) parameter: f64,
    /// The sign before: −1, 0 or 1; 0 where the function is 0 throughout and at the start of an open curve.
    pub(super) before: i8,
    /// The sign behind, in the same way.
    pub(super) after: i8,
    /// Whether the function vanishes there, at least on one side.
    pub(super) is_zero: bool,
    /// The number of the piece, the one that begins there at a joint; at the end of an open curve the number of pieces.
    pub(super) piece: usize,
    /// Whether a piece begins or ends there.
    pub(super) is_joint: bool,
}

/// The signs of one piece.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PieceSigns {
    /// Inner zeros in `(0, 1)`, with the signs on both sides.
    pub(super) zeros: Vec<(f64, i8, i8)>,
    /// The signs at the start and at the end; 0 if the piece vanishes throughout.
    pub(super) ends: [i8; 2],
    /// Whether the function is 0 at the start, at the end.
    pub(super) vanishes: [bool; 2],
}

impl PieceSigns {
    /// The signs of `Σ c[k]·bⁿₖ`, whose coefficients are known up to `noise`.
    pub(super) fn new(c: &[f64], noise: f64) -> Self {
        let zeros = match bernstein_zeros(c, noise) {
            Zeros::Everywhere => return Self { zeros: Vec::new(), ends: [0; 2], vanishes: [true; 2] },
            Zeros::Isolated(zeros) => zeros,
        };
        let mut nodes = vec![0.0];
        nodes.extend(zeros.iter().map(|zero| zero.at).filter(|at| (AT_END..=1.0 - AT_END).contains(at)));
        nodes.push(1.0);
        let sign = |t: f64| {
            let value = collapse(&mut c.to_vec(), t);
            i8::from(value > 0.0) - i8::from(value < 0.0)
        };
        let signs: Vec<i8> = nodes.windows(2).map(|pair| sign(pair[0].mix(pair[1], 0.5))).collect();
        let inner = nodes[1..nodes.len() - 1].iter().zip(signs.windows(2));
        let vanishes = [0.0, 1.0].map(|end: f64| zeros.iter().any(|zero| (zero.at - end).abs() < AT_END));
        Self {
            zeros: inner.map(|(&at, pair)| (at, pair[0], pair[1])).collect(),
            ends: [signs[0], signs[signs.len() - 1]],
            vanishes,
        }
    }

    /// Whether the piece is 0 throughout.
    pub(super) fn is_zero(&self) -> bool {
        self.ends == [0; 2] && self.vanishes == [true; 2]
    }
}

/// All places and the parts on which the function is 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PiecewiseSign {
    /// Increasing; joints and ends among them, the seam of a closed curve at its start.
    pub(super) places: Vec<SignPlace>,
    /// Neighbours in one.
    pub(super) zero: Vec<[f64; 2]>,
}

impl PiecewiseSign {
    /// From the intervals of the pieces and their signs, left to right.
    pub(super) fn new(pieces: &[((f64, f64), PieceSigns)], is_closed: bool) -> Self {
        let mut result = Self::default();
        let Some((_, last)) = pieces.last() else { return result };
        let outside = PieceSigns { zeros: Vec::new(), ends: [0; 2], vanishes: [false; 2] };
        let mut previous = if is_closed { last } else { &outside };
        let joint = |parameter, piece, before: &PieceSigns, after: &PieceSigns| SignPlace {
            parameter,
            before: before.ends[1],
            after: after.ends[0],
            is_zero: before.vanishes[1] || after.vanishes[0],
            piece,
            is_joint: true,
        };
        for (piece, ((a, b), signs)) in pieces.iter().enumerate() {
            result.places.push(joint(*a, piece, previous, signs));
            result.places.extend(signs.zeros.iter().map(|&(at, before, after)| SignPlace {
                parameter: a.mix(*b, at),
                before,
                after,
                is_zero: true,
                piece,
                is_joint: false,
            }));
            if signs.is_zero() {
                match result.zero.last_mut() {
                    Some(part) if part[1] >= *a => part[1] = *b,
                    _ => result.zero.push([*a, *b]),
                }
            }
            previous = signs;
        }
        if !is_closed {
            result.places.push(joint(pieces[pieces.len() - 1].0.1, pieces.len(), last, &outside));
        }
        result
    }

    /// The parameters at which the sign changes from one to the other.
    pub(super) fn changes(&self) -> impl Iterator<Item = &SignPlace> {
        self.places.iter().filter(|place| place.before * place.after < 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signs(coefficients: &[&[f64]], is_closed: bool) -> PiecewiseSign {
        let pieces: Vec<_> = coefficients
            .iter()
            .enumerate()
            .map(|(i, c)| ((i as f64, i as f64 + 1.0), PieceSigns::new(c, 0.0)))
            .collect();
        PiecewiseSign::new(&pieces, is_closed)
    }

    #[test]
    fn a_zero_at_a_joint_is_one_place_and_jumps_are_seen() {
        let through = signs(&[&[-1.0, 0.0], &[0.0, 1.0]], false);
        let changes: Vec<_> = through.changes().map(|place| (place.parameter, place.is_zero)).collect();
        assert_eq!(changes, [(1.0, true)], "{through:?}");
        let jump = signs(&[&[-1.0, -2.0], &[3.0, -1.0]], false);
        let changes: Vec<_> = jump.changes().map(|place| (place.parameter, place.is_zero)).collect();
        assert_eq!(changes, [(1.0, false), (1.75, true)], "{jump:?}");
        let touch = signs(&[&[1.0, 0.0], &[0.0, 1.0]], false);
        assert_eq!(touch.changes().count(), 0, "{touch:?}");
    }

    #[test]
    fn the_seam_of_a_closed_curve_joins_the_last_piece_to_the_first() {
        let seam = signs(&[&[1.0, 2.0], &[-1.0, -1.0]], true);
        assert_eq!(seam.changes().map(|place| place.parameter).collect::<Vec<_>>(), [0.0, 1.0], "{seam:?}");
        assert_eq!(signs(&[&[1.0, 2.0], &[-1.0, -1.0]], false).changes().count(), 1, "no seam");
    }

    #[test]
    fn parts_on_which_all_is_zero_become_one() {
        let flat = signs(&[&[1.0, 0.0], &[0.0, 0.0], &[0.0, 0.0], &[0.0, -1.0]], false);
        assert_eq!(flat.zero, [[1.0, 3.0]], "{flat:?}");
        assert_eq!(flat.changes().count(), 0, "no single place: {flat:?}");
        assert_eq!(PiecewiseSign::new(&[], true), PiecewiseSign::default(), "no pieces");
    }
}
