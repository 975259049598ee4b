//! Triangles in place of a surface.
//!
//! On a triangle with the legs `h_u`, `h_v` in the parameters, the distance to the surface at equal parameters is at most
//! `⅛ (h_u² M_uu + 2 h_u h_v M_uv + h_v² M_vv)` with bounds `M` of the second derivatives (J. Filip, R. Magedson, R. Markot, 1986).
//! The bounds come from the coefficients of derivative splines, so that they hold everywhere; rational surfaces use the quotient rule.

use glam::{DVec2, DVec3, DVec4};

use crate::core::surface::error::SurfaceError;
use crate::core::surface::nurbs_surface::NurbsSurface;

/// Most triangles that a tessellation may have.
pub const MAX_TRIANGLES: usize = 8_000_000;

/// A grid of triangles with the parameters of its corners.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceTriangles {
    /// Parameters `(u, v)` of the corners, u slowest.
    pub parameters: Vec<DVec2>,
    /// The corners.
    pub points: Vec<DVec3>,
    /// Unit normals; at singular points those of a neighbour, zero if that is singular as well.
    pub normals: Vec<DVec3>,
    /// Corners of the triangles, counterclockwise seen from the tip of the normal.
    pub triangles: Vec<[u32; 3]>,
    /// Numbers of grid lines: corner `(i, j)` is number `i · grid[1] + j`.
    pub grid: [usize; 2],
}

impl NurbsSurface {
    /// Triangles over a grid that cuts every knot interval of direction `ν` into `pieces[ν]` equal parts.
    ///
    /// # Errors
    ///
    /// `StepLimit` above [`MAX_TRIANGLES`] or for zero pieces.
    pub fn tessellate(&self, pieces: [usize; 2]) -> Result<SurfaceTriangles, SurfaceError> {
        let lines = |axis: usize| {
            let breaks = self.space().axes()[axis].breaks();
            let counts = vec![pieces[axis]; breaks.len() - 1];
            grid_lines(&breaks, &counts)
        };
        self.triangles(&lines(0)?, &lines(1)?)
    }

    /// Triangles within `tolerance` of the surface at equal parameters, apart from rounding; neighbouring cells share their grid lines.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` above [`MAX_TRIANGLES`].
    pub fn tessellate_within(&self, tolerance: f64) -> Result<SurfaceTriangles, SurfaceError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SurfaceError::InvalidTolerance { value: tolerance });
        }
        let bounds = self.second_derivative_bounds()?;
        let breaks = self.space().axes().each_ref().map(|axis| axis.breaks());
        let columns = breaks[1].len() - 1;
        // With N_ν pieces of the cell and 2/(N_u N_v) ≤ 1/N_u² + 1/N_v² the bound falls apart into one part for each direction, each of which
        // may be half of the tolerance. A strip takes the largest number of its cells.
        let mut counts = breaks.each_ref().map(|list| vec![1_usize; list.len() - 1]);
        for (cell, [uu, uv, vv]) in bounds.into_iter().enumerate() {
            let (row, column) = (cell / columns, cell % columns);
            let width = [breaks[0][row + 1] - breaks[0][row], breaks[1][column + 1] - breaks[1][column]];
            let mixed = uv * width[0] * width[1];
            for (axis, index, pure) in
                [(0, row, uu * width[0] * width[0]), (1, column, vv * width[1] * width[1])]
            {
                let needed = ((pure + mixed) / (4.0 * tolerance)).sqrt().ceil();
                counts[axis][index] = counts[axis][index].max(needed.min(MAX_TRIANGLES as f64) as usize);
            }
        }
        self.triangles(&grid_lines(&breaks[0], &counts[0])?, &grid_lines(&breaks[1], &counts[1])?)
    }

    fn triangles(&self, us: &[f64], vs: &[f64]) -> Result<SurfaceTriangles, SurfaceError> {
        let value = 2 * (us.len() - 1).saturating_mul(vs.len() - 1);
        if value > MAX_TRIANGLES {
            return Err(SurfaceError::StepLimit { what: "number of triangles", value, limit: MAX_TRIANGLES });
        }
        let mut points = vec![DVec3::ZERO; us.len() * vs.len()];
        let mut normals = points.clone();
        let singular = self.evaluate_grid(us, vs, &mut points, &mut normals)?;
        let parameters: Vec<DVec2> =
            us.iter().flat_map(|&u| vs.iter().map(move |&v| DVec2::new(u, v))).collect();
        if singular > 0 {
            for (normal, at) in normals.iter_mut().zip(&parameters) {
                if *normal == DVec3::ZERO {
                    *normal = self.normal_nearby(at.to_array()).unwrap_or(DVec3::ZERO);
                }
            }
        }
        let columns = vs.len() as u32;
        let corner = |i: usize, j: usize| i as u32 * columns + j as u32;
        let triangles = (1..us.len())
            .flat_map(|i| (1..vs.len()).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                let (a, b) = (corner(i - 1, j - 1), corner(i, j - 1));
                [[a, b, b + 1], [a, b + 1, a + 1]]
            })
            .collect();
        Ok(SurfaceTriangles { parameters, points, normals, triangles, grid: [us.len(), vs.len()] })
    }

    /// For every nonempty cell, row by row, upper bounds of `|r_uu|`, `|r_uv|`, `|r_vv|`.
    fn second_derivative_bounds(&self) -> Result<Vec<[f64; 3]>, SurfaceError> {
        let middle = self.points()[0];
        // Distances from a control point keep the quotient rule's bound independent of the position in space.
        let centred = self.transformed(|point| point - middle)?;
        let net = centred.homogeneous();
        let mut cells = Vec::new();
        for piece in net.bezier_form().map_err(SurfaceError::from)? {
            let [m, n] = piece.degrees;
            let width = piece.cell.map(|(a, b)| b - a);
            let at = |i: usize, j: usize| piece.points[i * (n + 1) + j];
            let largest =
                |rows: usize, columns: usize, difference: &dyn Fn(usize, usize) -> DVec4, factor: f64| {
                    let (mut p, mut w) = (0.0_f64, 0.0_f64);
                    for i in 0..rows {
                        for j in 0..columns {
                            let d = difference(i, j);
                            (p, w) = (p.max(d.truncate().length()), w.max(d.w.abs()));
                        }
                    }
                    (p * factor, w * factor)
                };
            let (u1, v1) = (m as f64 / width[0], n as f64 / width[1]);
            let (u2, v2) = (u1 * (m as f64 - 1.0) / width[0], v1 * (n as f64 - 1.0) / width[1]);
            let (p, _) = largest(m + 1, n + 1, &at, 1.0);
            let lowest = piece.points.iter().map(|point| point.w).fold(f64::INFINITY, f64::min);
            let (pu, wu) = largest(m, n + 1, &|i, j| at(i + 1, j) - at(i, j), u1);
            let (pv, wv) = largest(m + 1, n, &|i, j| at(i, j + 1) - at(i, j), v1);
            let (puu, wuu) = largest(m - 1, n + 1, &|i, j| at(i + 2, j) - at(i + 1, j) * 2.0 + at(i, j), u2);
            let (pvv, wvv) = largest(m + 1, n - 1, &|i, j| at(i, j + 2) - at(i, j + 1) * 2.0 + at(i, j), v2);
            let (puv, wuv) =
                largest(m, n, &|i, j| at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j), u1 * v1);
            let r = p / lowest;
            let (ru, rv) = ((pu + wu * r) / lowest, (pv + wv * r) / lowest);
            cells.push([
                (puu + 2.0 * wu * ru + wuu * r) / lowest,
                (puv + wu * rv + wv * ru + wuv * r) / lowest,
                (pvv + 2.0 * wv * rv + wvv * r) / lowest,
            ]);
        }
        Ok(cells)
    }
}

/// The breaks with `counts[i] − 1` parameters between break `i` and the next.
fn grid_lines(breaks: &[f64], counts: &[usize]) -> Result<Vec<f64>, SurfaceError> {
    let total = counts.iter().fold(0_usize, |sum, &count| sum.saturating_add(count));
    if total > MAX_TRIANGLES || counts.contains(&0) {
        let (what, limit) = ("number of grid lines", MAX_TRIANGLES);
        return Err(SurfaceError::StepLimit { what, value: total, limit });
    }
    let mut lines = vec![breaks[0]];
    for (pair, &count) in breaks.windows(2).zip(counts) {
        lines.extend((1..count).map(|i| pair[0] + (pair[1] - pair[0]) * (i as f64 / count as f64)));
        lines.push(pair[1]);
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::nurbs_surface::tests::bumpy;
    use crate::core::surface::samples;

    /// Largest distance to the surface at equal parameters, sampled in every triangle.
    fn deviation(surface: &NurbsSurface, mesh: &SurfaceTriangles) -> f64 {
        let mut largest = 0.0_f64;
        for triangle in &mesh.triangles {
            for share in [[1.0 / 3.0; 3], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]] {
                let (mut at, mut point) = (DVec2::ZERO, DVec3::ZERO);
                for (&corner, share) in triangle.iter().zip(share) {
                    at += mesh.parameters[corner as usize] * share;
                    point += mesh.points[corner as usize] * share;
                }
                largest = largest.max(point.distance(surface.evaluate(at.to_array()).unwrap()));
            }
        }
        largest
    }

    #[test]
    fn triangles_stay_within_the_tolerance_and_do_not_waste_much() {
        for surface in [bumpy(), samples::torus().into(), samples::sphere_octant()] {
            for tolerance in [0.1, 0.01] {
                let mesh = surface.tessellate_within(tolerance).unwrap();
                let found = deviation(&surface, &mesh);
                assert!(found <= tolerance, "{found} for the tolerance {tolerance}");
                assert!(found > tolerance / 200.0, "{found} is far below {tolerance}");
            }
        }
        let error = bumpy().tessellate_within(1e-14).unwrap_err();
        assert_eq!(error.name(), "StepLimit", "{error}");
        assert_eq!(bumpy().tessellate([0, 1]).unwrap_err().name(), "StepLimit", "no pieces");
        assert_eq!(bumpy().tessellate_within(f64::NAN).unwrap_err().name(), "InvalidTolerance", "no number");
    }

    #[test]
    fn triangles_turn_with_their_normals() {
        let surface = samples::sphere_octant();
        let mesh = surface.tessellate([6, 5]).unwrap();
        assert_eq!(mesh.triangles.len(), 60, "two for each piece");
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|corner| mesh.points[corner as usize]);
            let area = (b - a).cross(c - a);
            // Triangles at the pole have no area.
            assert!(area.dot(mesh.normals[triangle[0] as usize]) > -1e-15, "{triangle:?}");
        }
        assert!(
            mesh.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-12),
            "all normals have length 1"
        );
    }
}
