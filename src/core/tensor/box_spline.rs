//! Box splines of the plane by their recurrence.
//!
//! For directions `u₁ … u_s` that span the plane and `x = Σ tᵢ uᵢ`
//!
//! ```text
//! (s − 2) B(x | U) = Σᵢ tᵢ B(x | U∖uᵢ) + (1 − tᵢ) B(x − uᵢ | U∖uᵢ),
//! ```
//!
//! and two directions make the characteristic function of their half-open parallelogram, divided by its area.
//! C. de Boor, K. Höllig, *B-splines from parallelepipeds*, 1982. Course: section 7.3.

use glam::DVec2;

use crate::core::tensor::error::TensorError;

/// The recurrence takes `s!` time, so it ends here.
const MAX_DIRECTIONS: usize = 9;

/// Shift off the mesh lines, where the discontinuous parts of the recurrence do not add up; far below the accuracy of 1e-6.
const OFF_THE_LINES: DVec2 = DVec2::new(1e-10, 0.618_033_988_749_894_9e-10);

/// The box spline with the given directions at `x`, to about 1e-9: averages along `directions`, integral 1.
///
/// # Errors
///
/// `NonFinite`, `Degenerate` unless the directions span the plane, `StepLimit` for more than nine.
pub fn box_spline(directions: &[DVec2], x: DVec2) -> Result<f64, TensorError> {
    for (index, value) in directions.iter().chain([&x]).flat_map(|v| v.to_array()).enumerate() {
        if !value.is_finite() {
            return Err(TensorError::NonFinite { what: "coordinate", index, value });
        }
    }
    if directions.len() > MAX_DIRECTIONS {
        let value = directions.len();
        return Err(TensorError::StepLimit { what: "number of directions", value, limit: MAX_DIRECTIONS });
    }
    if !spans(directions) {
        return Err(TensorError::Degenerate { what: "the box spline of directions on one line" });
    }
    Ok(recurrence(directions, x + OFF_THE_LINES))
}

fn spans(directions: &[DVec2]) -> bool {
    directions.iter().enumerate().any(|(i, u)| directions[i + 1..].iter().any(|v| u.perp_dot(*v) != 0.0))
}

fn recurrence(directions: &[DVec2], x: DVec2) -> f64 {
    if let [u, v] = directions {
        let area = u.perp_dot(*v);
        let (s, t) = (x.perp_dot(*v) / area, u.perp_dot(x) / area);
        let inside = (0.0..1.0).contains(&s) && (0.0..1.0).contains(&t);
        return if inside { area.abs().recip() } else { 0.0 };
    }
    // The shortest parameters with x = Σ tᵢ uᵢ: tᵢ = uᵢ·y, where (Σ uᵢ uᵢᵀ) y = x.
    let (mut a, mut b, mut c) = (0.0, 0.0, 0.0);
    for u in directions {
        (a, b, c) = (a + u.x * u.x, b + u.x * u.y, c + u.y * u.y);
    }
    let y = DVec2::new(c * x.x - b * x.y, a * x.y - b * x.x) / (a * c - b * b);
    let mut sum = 0.0;
    for (i, u) in directions.iter().enumerate() {
        let rest: Vec<DVec2> = [&directions[..i], &directions[i + 1..]].concat();
        // Directions on one line leave a measure on that line, which vanishes almost everywhere.
        if spans(&rest) {
            let t = u.dot(y);
            sum += t * recurrence(&rest, x) + (1.0 - t) * recurrence(&rest, x - *u);
        }
    }
    sum / (directions.len() - 2) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::uniform_evaluate;

    #[test]
    fn axis_directions_give_products_of_uniform_b_splines() {
        let directions = [DVec2::X, DVec2::Y, DVec2::X, DVec2::X, DVec2::Y];
        for (x, y) in [(0.3, 0.4), (1.5, 1.2), (2.5, 0.9), (3.2, 1.0)] {
            let expected = uniform_evaluate(2, x) * uniform_evaluate(1, y);
            let found = box_spline(&directions, DVec2::new(x, y)).unwrap();
            assert!((found - expected).abs() < 1e-8, "at {x}, {y}: {found}, expected {expected}");
        }
    }

    #[test]
    fn the_zwart_powell_element_has_integral_one_and_translates_sum_to_one() {
        let directions = [DVec2::X, DVec2::Y, DVec2::ONE, DVec2::new(-1.0, 1.0)];
        let mut sum = 0.0;
        for i in -3..4 {
            for j in -3..4 {
                let x = DVec2::new(0.3 + f64::from(i), 0.8 + f64::from(j));
                sum += box_spline(&directions, x).unwrap();
            }
        }
        assert!((sum - 1.0).abs() < 1e-8, "the sum is {sum}");
        let flat = box_spline(&[DVec2::X, DVec2::X], DVec2::ZERO);
        assert_eq!(flat.unwrap_err().name(), "Degenerate", "directions on a line");
    }
}
