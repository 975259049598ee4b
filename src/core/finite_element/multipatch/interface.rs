//! Where patches meet: sides that are the same curve, in the same or in the opposite direction.

use glam::DVec2;

use crate::core::bspline::SplineSpace;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::geometry::{PatchSide, PlanePatch};
use crate::core::finite_element::isogeometric::IsogeometricSpace;

/// Sides are compared at this many parameters.
const SAMPLES: usize = 17;
/// Points this close, relative to the size of all patches, are the same.
const SAME: f64 = 1e-9;
/// Sides with common ends that differ by more than this part of their length bound different things, such as the two
/// halves of a hole; those that differ by less were meant to fit.
const MEANT_TO_FIT: f64 = 0.25;

/// Two sides that are one curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interface {
    /// Number of a patch, and its side.
    pub first: (usize, PatchSide),
    /// Number of a patch, and its side; later than the first in the order of patches and sides.
    pub second: (usize, PatchSide),
    /// Whether the parameters of the sides run in opposite directions.
    pub reversed: bool,
}

/// All interfaces.
///
/// # Errors
///
/// `InterfaceMismatch`: common ends, but slightly different curves (or parametrisations); `KnotMismatch`: different
/// degrees or knots, or a side where functions of the interior do not vanish.
pub(super) fn detect(spaces: &[IsogeometricSpace]) -> Result<Vec<Interface>, FiniteElementError> {
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    let mut sides = Vec::with_capacity(4 * spaces.len());
    for (patch, space) in spaces.iter().enumerate() {
        let bounds = space.patch().bounds();
        (low, high) = (low.min(bounds.0), high.max(bounds.1));
        for side in PatchSide::ALL {
            sides.push(((patch, side), sample_side(space.patch(), side)?));
        }
    }
    let same = SAME * (high - low).max_element();
    let mut interfaces = Vec::new();
    for (index, (first, curve)) in sides.iter().enumerate() {
        for (second, other) in &sides[index + 1..] {
            for reversed in [false, true] {
                let at = |i: usize| other[if reversed { SAMPLES - 1 - i } else { i }];
                let ends_meet = [0, SAMPLES - 1].into_iter().all(|i| curve[i].distance(at(i)) <= same);
                let (start, end) = (curve[0], curve[SAMPLES - 1]);
                // A closed side meets another at its only end in both directions; its samples decide.
                if !ends_meet || (reversed && start.distance(end) <= same) {
                    continue;
                }
                let distance = (0..SAMPLES).map(|i| curve[i].distance(at(i))).fold(0.0, f64::max);
                let length: f64 = curve.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
                if distance > MEANT_TO_FIT * length {
                    continue;
                }
                if distance > same {
                    let (first, second) = (*first, *second);
                    return Err(FiniteElementError::InterfaceMismatch { first, second, distance });
                }
                let fits = fits(&spaces[first.0], first.1, &spaces[second.0], second.1, reversed);
                if !fits {
                    return Err(FiniteElementError::KnotMismatch { first: *first, second: *second });
                }
                interfaces.push(Interface { first: *first, second: *second, reversed });
            }
        }
    }
    Ok(interfaces)
}

fn sample_side(patch: &PlanePatch, side: PatchSide) -> Result<Vec<DVec2>, FiniteElementError> {
    let (left, right) = patch.spaces()[1 - side.axis()].parameter_interval();
    let at = |i: usize| {
        let part = i as f64 / (SAMPLES - 1) as f64;
        patch.evaluate(patch.side_parameter(side, left * (1.0 - part) + right * part))
    };
    (0..SAMPLES).map(at).collect()
}

/// Whether the traces on both sides are the same functions of the points, in corresponding order.
fn fits(
    first: &IsogeometricSpace,
    first_side: PatchSide,
    second: &IsogeometricSpace,
    second_side: PatchSide,
    reversed: bool,
) -> bool {
    let interpolates = |space: &IsogeometricSpace, side: PatchSide| {
        let across = &space.spaces()[side.axis()];
        let (left, right) = across.parameter_interval();
        across.multiplicity(if side.at_end() { right } else { left }) == across.degree()
    };
    let along = |space: &IsogeometricSpace, side: PatchSide| relative_knots(&space.spaces()[1 - side.axis()]);
    let (one, mut other) = (along(first, first_side), along(second, second_side));
    if reversed {
        other = other.into_iter().rev().map(|knot| 1.0 - knot).collect();
    }
    let degree = |space: &IsogeometricSpace, side: PatchSide| space.spaces()[1 - side.axis()].degree();
    interpolates(first, first_side)
        && interpolates(second, second_side)
        && degree(first, first_side) == degree(second, second_side)
        && one.len() == other.len()
        && one.iter().zip(&other).all(|(a, b)| (a - b).abs() <= 1e-12)
}

/// The knots that influence the parameter interval, as parts of it; the two outermost have no influence.
fn relative_knots(space: &SplineSpace) -> Vec<f64> {
    let (left, right) = space.parameter_interval();
    let knots = space.knots();
    knots[1..knots.len() - 1].iter().map(|knot| (knot - left) / (right - left)).collect()
}
