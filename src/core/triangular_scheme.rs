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

#[cfg(test)]
mod tests {
    use super::*;

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
