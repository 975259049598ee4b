//! Points and unit normals of a surface on a grid of parameters.
//!
//! For each parameter u the net is contracted to one line of points and one of u-derivatives; along v eight parameters of one knot interval
//! run side by side. Coordinates are kept apart, so that every loop is the same for all lanes and the compiler can use wide registers.

use glam::DVec3;

use crate::core::surface::error::SurfaceError;
use crate::core::surface::nurbs_surface::NurbsSurface;
use crate::core::tensor::{AxisTable, TensorError};

/// Parameters that run side by side: one 512-bit register, or two of 256 bits.
const LANES: usize = 8;

/// `|r_u × r_v|²` up to this multiple of `|r_u|²|r_v|²` makes no tangent plane, as in a jet.
const PARALLEL_SQUARED: f64 = 1e-26;

/// One number for each of the parameters side by side.
type Lanes = [f64; LANES];

impl NurbsSurface {
    /// Writes `r(u, v)` and the unit normal `r_u × r_v/|r_u × r_v|` for all parameters, u slowest, and returns the number of singular points.
    ///
    /// Where there is no tangent plane the normal is written as zero; [`Self::normal_nearby`] has a substitute. At knots the
    /// derivatives are those from the right, at the right end from the left. Apart from tables of the size of `us` and `vs` nothing is allocated.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless both buffers have one place for each grid point; `NonFinite`, `OutsideInterval` with the axis.
    pub fn evaluate_grid(
        &self,
        us: &[f64],
        vs: &[f64],
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) -> Result<usize, SurfaceError> {
        let expected = us.len() * vs.len();
        for found in [points.len(), normals.len()] {
            if found != expected {
                return Err(
                    TensorError::SizeMismatch { what: "places for grid points", expected, found }.into()
                );
            }
        }
        let [u_space, v_space] = self.space().axes();
        let u_table = AxisTable::new(u_space, us, 1).map_err(SurfaceError::on_axis(0))?;
        let v_table =
            VTable::new(&AxisTable::new(v_space, vs, 1).map_err(SurfaceError::on_axis(1))?, v_space.degree());
        if expected == 0 {
            return Ok(0);
        }
        // The unrolled net, one plane for each homogeneous coordinate.
        let columns = v_space.evaluation_dimension();
        let rows = u_space.evaluation_dimension();
        let rational = !self.is_polynomial();
        let mut planes = vec![0.0; 4 * rows * columns];
        for row in 0..rows {
            for column in 0..columns {
                let k = [u_space.coefficient_index(row), v_space.coefficient_index(column)];
                let place = self.space().flat_index(k);
                let point = self.points()[place];
                let w = if rational { self.weights()[place] } else { 1.0 };
                for (plane, value) in [point.x * w, point.y * w, point.z * w, w].into_iter().enumerate() {
                    planes[(plane * rows + row) * columns + column] = value;
                }
            }
        }
        let grid = Grid { planes: &planes, rows, columns, noise: self.noise().map(|noise| noise * noise) };
        let mut singular = 0;
        let mut line = vec![0.0; 8 * columns];
        for (i, (points, normals)) in
            points.chunks_exact_mut(vs.len()).zip(normals.chunks_exact_mut(vs.len())).enumerate()
        {
            singular += pulp::Arch::new().dispatch(
                #[inline(always)]
                || match (v_table.width, rational) {
                    (3, false) => grid.row::<3, 3>(&u_table, i, &v_table, &mut line, points, normals),
                    (3, true) => grid.row::<3, 4>(&u_table, i, &v_table, &mut line, points, normals),
                    (4, false) => grid.row::<4, 3>(&u_table, i, &v_table, &mut line, points, normals),
                    (4, true) => grid.row::<4, 4>(&u_table, i, &v_table, &mut line, points, normals),
                    (_, false) => grid.row::<0, 3>(&u_table, i, &v_table, &mut line, points, normals),
                    (_, true) => grid.row::<0, 4>(&u_table, i, &v_table, &mut line, points, normals),
                },
            );
        }
        Ok(singular)
    }
}

/// The table of one direction with parameters side by side.
struct VTable {
    /// `n + 1`.
    width: usize,
    blocks: Vec<Block>,
    /// For each block the values of the `n + 1` active B-splines, then their derivatives; lanes without a parameter repeat the last.
    lanes: Vec<Lanes>,
}

/// Up to eight consecutive parameters of one knot interval.
struct Block {
    /// Number of the first parameter.
    start: usize,
    count: usize,
    /// First active B-spline.
    first: usize,
}

impl VTable {
    fn new(table: &AxisTable, degree: usize) -> Self {
        let width = degree + 1;
        let (mut blocks, mut lanes): (Vec<Block>, Vec<Lanes>) = (Vec::new(), Vec::new());
        for j in 0..table.len() {
            let first = table.first(j);
            match blocks.last_mut() {
                Some(block) if block.first == first && block.count < LANES => block.count += 1,
                _ => {
                    blocks.push(Block { start: j, count: 1, first });
                    lanes.resize(lanes.len() + 2 * width, [0.0; LANES]);
                }
            }
            let lane = blocks[blocks.len() - 1].count - 1;
            let start = lanes.len() - 2 * width;
            for order in 0..2 {
                for (entry, &value) in lanes[start + order * width..].iter_mut().zip(table.row(j, order)) {
                    entry[lane..].fill(value);
                }
            }
        }
        Self { width, blocks, lanes }
    }
}

struct Grid<'a> {
    /// `planes[(coordinate · rows + row) · columns + column]`.
    planes: &'a [f64],
    rows: usize,
    columns: usize,
    /// Squared lengths up to which the first derivatives are rounding.
    noise: [f64; 2],
}

impl Grid<'_> {
    /// One row of the grid; `W` is `n + 1` in v, or 0 if known at run time only, `C` the number of homogeneous coordinates.
    #[inline(always)]
    fn row<const W: usize, const C: usize>(
        &self,
        u_table: &AxisTable,
        i: usize,
        v_table: &VTable,
        line: &mut [f64],
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) -> usize {
        let columns = self.columns;
        line.fill(0.0);
        for order in 0..2 {
            for (j, &weight) in u_table.row(i, order).iter().enumerate() {
                for coordinate in 0..C {
                    let start = (coordinate * self.rows + u_table.first(i) + j) * columns;
                    let source = &self.planes[start..start + columns];
                    let target = &mut line[(order * 4 + coordinate) * columns..][..columns];
                    for (value, &coefficient) in target.iter_mut().zip(source) {
                        *value += weight * coefficient;
                    }
                }
            }
        }
        let width = if W == 0 { v_table.width } else { W };
        let mut singular = 0;
        for (block, table) in v_table.blocks.iter().zip(v_table.lanes.chunks_exact(2 * width)) {
            let (values, slopes) = table.split_at(width);
            // r, r_u, r_v of the homogeneous surface.
            let (mut p, mut du, mut dv) = ([[0.0; LANES]; C], [[0.0; LANES]; C], [[0.0; LANES]; C]);
            for coordinate in 0..C {
                let along = &line[coordinate * columns + block.first..][..width];
                let across = &line[(4 + coordinate) * columns + block.first..][..width];
                [p[coordinate], du[coordinate], dv[coordinate]] = sums(along, across, values, slopes);
            }
            if C == 4 {
                let mut inverse = [0.0; LANES];
                for lane in 0..LANES {
                    inverse[lane] = 1.0 / p[3][lane];
                }
                for coordinate in 0..3 {
                    for lane in 0..LANES {
                        p[coordinate][lane] *= inverse[lane];
                        du[coordinate][lane] =
                            (du[coordinate][lane] - du[C - 1][lane] * p[coordinate][lane]) * inverse[lane];
                        dv[coordinate][lane] =
                            (dv[coordinate][lane] - dv[C - 1][lane] * p[coordinate][lane]) * inverse[lane];
                    }
                }
            }
            let mut normal = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let (a, b) =
                    ([du[0][lane], du[1][lane], du[2][lane]], [dv[0][lane], dv[1][lane], dv[2][lane]]);
                let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
                let square = |v: [f64; 3]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
                let (uu, vv, nn) = (square(a), square(b), square(n));
                let regular = (uu > self.noise[0]) & (vv > self.noise[1]) & (nn > PARALLEL_SQUARED * uu * vv);
                let scale = if regular { 1.0 / nn.sqrt() } else { 0.0 };
                for coordinate in 0..3 {
                    normal[coordinate][lane] = n[coordinate] * scale;
                }
            }
            let (points, normals) =
                (&mut points[block.start..][..block.count], &mut normals[block.start..][..block.count]);
            for (lane, (point, place)) in points.iter_mut().zip(normals).enumerate().take(LANES) {
                *point = DVec3::new(p[0][lane], p[1][lane], p[2][lane]);
                *place = DVec3::new(normal[0][lane], normal[1][lane], normal[2][lane]);
                singular +=
                    usize::from(normal[0][lane] == 0.0 && normal[1][lane] == 0.0 && normal[2][lane] == 0.0);
            }
        }
        singular
    }
}

/// The sums of one coordinate: values, derivatives in u, derivatives in v.
#[inline(always)]
fn sums(along: &[f64], across: &[f64], values: &[Lanes], slopes: &[Lanes]) -> [Lanes; 3] {
    let (mut p, mut du, mut dv) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for (((&along, &across), value), slope) in along.iter().zip(across).zip(values).zip(slopes) {
        for lane in 0..LANES {
            p[lane] += along * value[lane];
            du[lane] += across * value[lane];
            dv[lane] += along * slope[lane];
        }
    }
    [p, du, dv]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::surface::nurbs_surface::tests::bumpy;
    use crate::core::surface::samples;

    #[test]
    fn the_grid_holds_the_points_and_normals_of_the_surface() {
        let quintic =
            bumpy().elevate_degree(1).unwrap().elevate_degree(1).unwrap().elevate_degree(1).unwrap();
        for surface in [bumpy(), bumpy().elevate_degree(1).unwrap(), quintic, samples::torus().into()] {
            let us: Vec<f64> = (0..=13).map(|i| f64::from(i) / 3.25).collect();
            let vs = [0.0, 0.1, 4.0, 0.5, 3.9, 3.8, 3.7, 3.6, 3.5, 3.4, 3.3, 3.2, 3.1, 3.05, 3.01];
            let mut points = vec![DVec3::NAN; 14 * 15];
            let mut normals = points.clone();
            assert_eq!(
                surface.evaluate_grid(&us, &vs, &mut points, &mut normals),
                Ok(0),
                "no singular point"
            );
            for (place, (point, normal)) in points.into_iter().zip(normals).enumerate() {
                let at = [us[place / 15], vs[place % 15]];
                let error = (point - surface.evaluate(at).unwrap()).length();
                assert!(error < 1e-13, "point at {at:?}: off by {error}");
                let error = (normal - surface.normal(at).unwrap()).length();
                assert!(error < 1e-11, "normal at {at:?}: off by {error}");
            }
        }
    }

    #[test]
    fn singular_points_are_counted() {
        let octant = samples::sphere_octant();
        let (mut points, mut normals) = ([DVec3::ZERO; 6], [DVec3::ONE; 6]);
        let singular = octant.evaluate_grid(&[0.0, 0.4, 1.0], &[0.0, 0.5], &mut points, &mut normals);
        assert_eq!(singular, Ok(3), "the pole in three parameters");
        assert_eq!(normals[2], DVec3::ZERO, "written as zero");
        let short = octant.evaluate_grid(&[0.0], &[0.0], &mut points, &mut normals);
        assert_eq!(short.unwrap_err().name(), "SizeMismatch", "buffers too long");
    }
}
