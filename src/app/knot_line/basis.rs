//! The B-splines of a curve as polylines, and their values at one parameter.

use glam::DVec2;

use crate::app::knot_line::axis::Axis;
use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::Nurbs;

/// More functions than this are not drawn: they would be a grey band. Only the active ones are then.
const MOST_FUNCTIONS: usize = 300;

/// Pixels between two samples, and most samples of one polynomial piece.
const SAMPLE_DISTANCE: f64 = 3.0;
const MOST_SAMPLES: usize = 48;

/// One B-spline, or rational basis function `wₖ bₖ/q`, over the visible part of D.
#[derive(Clone, Debug)]
pub(super) struct Graph {
    /// Index of its control point.
    pub(super) coefficient: usize,
    /// Parameters and values.
    pub(super) points: Vec<(f64, f64)>,
}

/// The values of the functions that are not zero at a parameter.
#[derive(Clone, Debug, Default)]
pub(super) struct Active {
    /// Indices of their control points, from left to right.
    pub(super) coefficients: Vec<usize>,
    /// Their values; they sum to 1.
    pub(super) values: Vec<f64>,
}

/// The basis functions of `curve` at `t`.
pub(super) fn active(curve: &Nurbs<DVec2>, t: f64) -> Active {
    let space = curve.space();
    let Ok(span) = space.span(t) else { return Active::default() };
    let mut values = Vec::new();
    values_in_span(curve, span, t, &mut values);
    let first = span - space.degree();
    Active { coefficients: (first..=span).map(|k| space.coefficient_index(k)).collect(), values }
}

/// The graphs of all functions that are seen on `axis`; of those active at `t` only if they are too many.
pub(super) fn graphs(curve: &Nurbs<DVec2>, axis: &Axis, t: f64) -> (Vec<Graph>, bool) {
    let space = curve.space();
    let n = space.degree();
    let (left, right) = space.parameter_interval();
    let (low, high) = axis.visible();
    // A periodic curve repeats at the edges, so the whole period is needed there.
    let (from, to) = if space.is_periodic() { (left, right) } else { (low.max(left), high.min(right)) };
    let (Ok(mut first), Ok(mut last)) = (space.span(from), space.span(to)) else {
        return (Vec::new(), false);
    };
    let too_many = last - first + n + 1 > MOST_FUNCTIONS;
    if too_many && let Ok(span) = space.span(t) {
        first = span.saturating_sub(n).max(n);
        last = (span + n).min(space.evaluation_dimension() - 1);
    }
    let mut graphs: Vec<Graph> = (first - n..=last)
        .map(|k| Graph { coefficient: space.coefficient_index(k), points: Vec::new() })
        .collect();
    let mut values = Vec::new();
    for span in first..=last {
        let (start, end) = (space.evaluation_knots()[span], space.evaluation_knots()[span + 1]);
        if start >= end {
            continue;
        }
        let steps = sample_count(space, start, end, axis);
        for step in 0..=steps {
            let t = if step == steps { end } else { start + (end - start) * (step as f64 / steps as f64) };
            values_in_span(curve, span, t, &mut values);
            for (j, &value) in values.iter().enumerate() {
                let points = &mut graphs[span - first + j].points;
                if points.last().is_none_or(|&(before, _)| before < t) {
                    points.push((t, value));
                }
            }
        }
    }
    if too_many && let Ok(span) = space.span(t) {
        let active = span - n..=span;
        let mut k = first - n;
        graphs.retain(|_| {
            k += 1;
            active.contains(&(k - 1))
        });
    }
    (graphs, too_many)
}

fn sample_count(space: &SplineSpace, start: f64, end: f64, axis: &Axis) -> usize {
    let pixels = ((end - start) / axis.per_pixel() / SAMPLE_DISTANCE).ceil();
    let fewest = if space.degree() == 1 { 1 } else { 3 };
    (pixels.clamp(0.0, MOST_SAMPLES as f64) as usize).max(fewest)
}

/// The values `bⁿₗ₋ₙ … bⁿₗ` at `t` in knot interval `span`, times weights over their sum if the curve is rational.
fn values_in_span(curve: &Nurbs<DVec2>, span: usize, t: f64, values: &mut Vec<f64>) {
    let space = curve.space();
    let (n, knots) = (space.degree(), space.evaluation_knots());
    values.clear();
    values.push(1.0);
    for degree in 1..=n {
        // From bᵈ⁻¹ to bᵈ: each function gives the share γ to itself and 1 − γ to its left neighbour.
        values.push(0.0);
        for j in (0..degree).rev() {
            let k = span + 1 + j - degree;
            let gamma = (t - knots[k]) / (knots[k + degree] - knots[k]);
            let value = values[j];
            values[j + 1] += gamma * value;
            values[j] = (1.0 - gamma) * value;
        }
    }
    if !curve.is_polynomial() {
        let mut sum = 0.0;
        for (j, value) in values.iter_mut().enumerate() {
            *value *= curve.weights()[space.coefficient_index(span - n + j)];
            sum += *value;
        }
        for value in values.iter_mut() {
            *value /= sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(weights: Vec<f64>) -> Nurbs<DVec2> {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 3.0, 4.0, 4.0, 5.0]).unwrap();
        let points = (0..5).map(|k| DVec2::new(f64::from(k), f64::from(k * k % 3))).collect();
        Nurbs::new(space, points, weights).unwrap()
    }

    #[test]
    fn values_sum_to_one_and_make_the_curve() {
        for weights in [vec![1.0; 5], vec![1.0, 4.0, 0.5, 2.0, 1.0]] {
            let curve = curve(weights);
            for t in [0.0, 0.3, 1.0, 2.9, 4.0] {
                let active = active(&curve, t);
                let sum: f64 = active.values.iter().sum();
                assert!((sum - 1.0).abs() < 1e-14, "sum {sum} at {t}");
                let mut point = DVec2::ZERO;
                for (&k, &value) in active.coefficients.iter().zip(&active.values) {
                    point += curve.points()[k] * value;
                }
                let expected = curve.evaluate(t).unwrap();
                assert!(point.distance(expected) < 1e-13, "{point} instead of {expected} at {t}");
            }
        }
    }
}
