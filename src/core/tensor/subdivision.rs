//! Uniform midpoint refinement of a control net: products of the masks `s_j = 2⁻ⁿ C(n+1, j)`.
//!
//! `c̃_k = Σ s_{k−2i} c_i`, a repeated point followed by `n` averages of neighbours (J. Lane, R. Riesenfeld, 1980). Course: section 8.3.

use crate::core::point::Point;
use crate::core::tensor::error::TensorError;

/// A rectangular net, rows one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Net<P> {
    /// Numbers of rows and columns.
    pub shape: [usize; 2],
    /// The points, row by row.
    pub points: Vec<P>,
}

/// One refinement of a net of degree `n` in both directions, periodic or open in each.
///
/// A periodic direction keeps its start: point `2k` replaces point `k` for degree 3. An open one loses the points without a complete
/// mask: `m` become `2m − n`.
///
/// # Errors
///
/// `SizeMismatch` unless the points fill the shape and every open direction has more than `degree` points; `StepLimit` for a degree above 25.
pub fn subdivide_net<P: Point>(
    net: &Net<P>,
    degree: usize,
    periodic: [bool; 2],
) -> Result<Net<P>, TensorError> {
    let [rows, columns] = net.shape;
    let expected = rows.saturating_mul(columns);
    if net.points.len() != expected || expected == 0 {
        let found = net.points.len();
        return Err(TensorError::SizeMismatch { what: "points", expected: expected.max(1), found });
    }
    if degree > crate::core::bspline::MAX_DEGREE {
        let limit = crate::core::bspline::MAX_DEGREE;
        return Err(TensorError::StepLimit { what: "degree", value: degree, limit });
    }
    for (axis, &found) in net.shape.iter().enumerate() {
        if !periodic[axis] && found <= degree {
            return Err(TensorError::SizeMismatch {
                what: "points of an open direction",
                expected: degree + 1,
                found,
            });
        }
    }
    let refined_rows: Vec<Vec<P>> =
        net.points.chunks(columns).map(|row| refine(row.to_vec(), degree, periodic[1])).collect();
    let width = refined_rows[0].len();
    let refined_columns: Vec<Vec<P>> = (0..width)
        .map(|j| refine(refined_rows.iter().map(|row| row[j]).collect(), degree, periodic[0]))
        .collect();
    let height = refined_columns[0].len();
    let points = (0..height).flat_map(|i| refined_columns.iter().map(move |column| column[i])).collect();
    Ok(Net { shape: [height, width], points })
}

fn refine<P: Point>(line: Vec<P>, degree: usize, periodic: bool) -> Vec<P> {
    let mut line: Vec<P> = line.into_iter().flat_map(|point| [point, point]).collect();
    for step in 0..degree {
        let count = line.len();
        if periodic {
            // Averages alternately with the right and the left neighbour, so that the start stays where it is.
            let previous = if step % 2 == 0 { 1 } else { count - 1 };
            line = (0..count).map(|i| (line[i] + line[(i + previous) % count]) * 0.5).collect();
        } else {
            line = line.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect();
        }
    }
    line
}
