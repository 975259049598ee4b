//! The triangular scheme behind Aitken-Neville, de Casteljau, de Boor and knot insertion.
//!
//! ```text
//! p⁰₀  p⁰₁  p⁰₂ … p⁰ₙ
//!    p¹₀  p¹₁ … p¹ₙ₋₁          pⁱ⁺¹ⱼ = (1 − gⁱⱼ) pⁱⱼ + gⁱⱼ pⁱⱼ₊₁
//!       …
//!         pⁿ₀
//! ```

use crate::core::point::Point;

/// All levels of a triangular scheme with the weights that made them.
///
/// `levels[0]` holds the given points, `levels[i]` has `i` points fewer;
/// `levels[i + 1][j] = (1 − weights[i][j])·levels[i][j] + weights[i][j]·levels[i][j + 1]`.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangularScheme<P> {
    levels: Vec<Vec<P>>,
    weights: Vec<Vec<f64>>,
}

impl<P: Point> TriangularScheme<P> {
    /// Runs `steps` steps on `points`; `weight(i, j)` is the share of the right parent of entry `j` of level `i + 1`.
    ///
    /// At most `points.len() − 1` steps are possible; more are not taken. No points give an empty scheme.
    pub fn run(points: Vec<P>, steps: usize, mut weight: impl FnMut(usize, usize) -> f64) -> Self {
        let steps = steps.min(points.len().saturating_sub(1));
        let mut levels = Vec::with_capacity(steps + 1);
        let mut weights = Vec::with_capacity(steps);
        levels.push(points);
        for i in 0..steps {
            let below = &levels[i];
            let row: Vec<f64> = (0..below.len() - 1).map(|j| weight(i, j)).collect();
            let next = row.iter().enumerate().map(|(j, &g)| below[j].mix(below[j + 1], g)).collect();
            levels.push(next);
            weights.push(row);
        }
        Self { levels, weights }
    }

    /// The levels; level 0 are the given points.
    pub fn levels(&self) -> &[Vec<P>] {
        &self.levels
    }

    /// The weights: `weights()[i][j]` is the share of the right parent of `levels()[i + 1][j]`.
    pub fn weights(&self) -> &[Vec<f64>] {
        &self.weights
    }

    /// Number of steps taken.
    pub fn steps(&self) -> usize {
        self.weights.len()
    }

    /// First entry of the last level: the apex of a full triangle. `None` for an empty scheme.
    pub fn result(&self) -> Option<P> {
        self.levels.last().and_then(|level| level.first()).copied()
    }

    /// The same scheme with every point mapped, for example from homogeneous to Cartesian points.
    pub fn map<Q>(&self, mut change: impl FnMut(P) -> Q) -> TriangularScheme<Q> {
        TriangularScheme {
            levels: self
                .levels
                .iter()
                .map(|level| level.iter().map(|&point| change(point)).collect())
                .collect(),
            weights: self.weights.clone(),
        }
    }
}

/// The apex of the scheme with the constant weight `t`, in place: the point `Σ C(n,k) (1 − t)ⁿ⁻ᵏ tᵏ points[k]`.
///
/// Afterwards `points` holds the last diagonal `pⁿ⁻ʲⱼ`: the control points of the part over `[t, 1]`. No points give
/// the origin.
pub fn collapse<P: Point>(points: &mut [P], t: f64) -> P {
    for count in (1..points.len()).rev() {
        for j in 0..count {
            points[j] = points[j].mix(points[j + 1], t);
        }
    }
    points.first().copied().unwrap_or(P::ZERO)
}

/// As [`collapse`]; `first` receives the first diagonal `pʲ₀`, the control points of the part over `[0, t]`.
///
/// `first` must not be shorter than `points`; what is longer stays.
pub fn collapse_both<P: Point>(points: &mut [P], t: f64, first: &mut [P]) {
    let n = points.len();
    for (step, place) in first.iter_mut().enumerate().take(n) {
        *place = points[0];
        for j in 0..n - 1 - step {
            points[j] = points[j].mix(points[j + 1], t);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_diagonals_of_the_scheme_are_left_in_place() {
        let mut points = [8.0, 0.0, 16.0, 8.0];
        let scheme = TriangularScheme::run(points.to_vec(), 3, |_, _| 0.25);
        let mut first = [0.0; 4];
        collapse_both(&mut points, 0.25, &mut first);
        for j in 0..4 {
            assert_eq!(first[j], scheme.levels()[j][0], "first diagonal, entry {j}");
            assert_eq!(points[j], scheme.levels()[3 - j][j], "last diagonal, entry {j}");
        }
        assert_eq!(collapse::<f64>(&mut [], 0.5), 0.0, "no points");
    }

    #[test]
    fn constant_weights_give_the_bernstein_sum() {
        let scheme = TriangularScheme::run(vec![8.0, 0.0, 16.0, 8.0], 3, |_, _| 0.5);
        assert_eq!(scheme.levels()[1], [4.0, 8.0, 12.0], "first level");
        assert_eq!(scheme.result(), Some(8.0), "apex");
    }

    #[test]
    fn no_more_steps_than_points_allow() {
        let scheme = TriangularScheme::run(vec![1.0, 3.0], 9, |_, _| 0.25);
        assert_eq!(scheme.steps(), 1, "two points");
        assert_eq!(TriangularScheme::<f64>::run(Vec::new(), 3, |_, _| 0.5).result(), None, "no points");
    }
}
