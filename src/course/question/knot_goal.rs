//! Goals about knots: multiplicity and smoothness.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::short_number;
use crate::course::question::Verdict;

/// `once`, `twice`, `5 times`.
pub(super) fn times(count: usize) -> String {
    match count {
        0 => "not at all".to_owned(),
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        more => format!("{more} times"),
    }
}

/// Judges how often the knot `at` is there; measured is the number of copies.
pub(super) fn check_multiplicity(curve: &Nurbs<DVec2>, at: f64, wanted: usize, feedback: &str) -> Verdict {
    // A knot that was typed or snapped may miss the value by a rounding error.
    let (left, right) = curve.space().parameter_interval();
    let close = 1e-9 * (right - left);
    let found = curve.space().evaluation_knots().iter().filter(|&&knot| (knot - at).abs() <= close).count();
    if found == wanted {
        return Verdict::right(found as f64, feedback);
    }
    let message =
        format!("The knot {} is there {}; {} is asked for.", short_number(at), times(found), times(wanted));
    Verdict::wrong(Some(found as f64), message)
}

/// Judges whether `order` derivatives are continuous at all inner knots; measured is how many are.
pub(super) fn check_smooth(curve: &Nurbs<DVec2>, order: usize, feedback: &str) -> Verdict {
    let space = curve.space();
    let (left, right) = space.parameter_interval();
    let inner = space.distinct_knots().into_iter();
    let inner = inner.filter(|knot| space.is_periodic() || (left < knot.value && knot.value < right));
    let n = space.degree();
    match inner.max_by_key(|knot| knot.multiplicity) {
        Some(knot) if n < order + knot.multiplicity => {
            let continuous = n - knot.multiplicity.min(n);
            let message = format!(
                "The knot {} is there {}, so that only {} of the derivatives {} continuous: $n-\\mu = {continuous}$.",
                short_number(knot.value),
                times(knot.multiplicity),
                continuous,
                if continuous == 1 { "is" } else { "are" }
            );
            Verdict::wrong(Some(continuous as f64), message)
        }
        Some(knot) => Verdict::right((n - knot.multiplicity) as f64, feedback),
        None if n < order => Verdict::wrong(None, "The degree is too low."),
        None => Verdict::right(n as f64, feedback),
    }
}
