//! Indexed triangles of a surface.

use glam::DVec3;

use crate::figure::error::{FigureError, check_count, check_finite, check_triangles};
use crate::figure::picture::Color;

/// A surface of triangles, seen from both sides.
///
/// Corners run counterclockwise on the front side. Without normals every triangle is flat; with them light varies over it.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangles {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<DVec3>,
    colors: Vec<Color>,
    /// Colour where there is none per vertex.
    pub color: Color,
    /// Colour of the back; that of the front if `None`.
    pub back_color: Option<Color>,
    /// Whether light falls on it; if not, colours appear as they are (for colour maps to be read off).
    pub is_lit: bool,
}

impl Triangles {
    /// Lit triangles of one colour with flat faces, as triples of indices of `positions`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `IndexOutOfRange`.
    pub fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>, color: Color) -> Result<Self, FigureError> {
        check_finite("position", positions.iter().map(|position| position.to_array()))?;
        check_triangles(positions.len(), &triangles)?;
        let (normals, colors) = (Vec::new(), Vec::new());
        Ok(Self { positions, triangles, normals, colors, color, back_color: None, is_lit: true })
    }

    /// The same surface with a normal for each position, of any length, on the front side. Where one is zero (a singular point)
    /// the face's own stands in.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`, `NonFinite`.
    pub fn with_normals(self, normals: Vec<DVec3>) -> Result<Self, FigureError> {
        check_count("normals", self.positions.len(), normals.len())?;
        check_finite("normal", normals.iter().map(|normal| normal.to_array()))?;
        let normals = normals.into_iter().map(DVec3::normalize_or_zero).collect();
        Ok(Self { normals, ..self })
    }

    /// The same surface with a colour for each position.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`.
    pub fn with_colors(self, colors: Vec<Color>) -> Result<Self, FigureError> {
        check_count("colours", self.positions.len(), colors.len())?;
        Ok(Self { colors, ..self })
    }

    /// The vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The triangles, as indices of positions.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Unit normals (or zero) of the vertices; empty if there are none.
    pub fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// Colours of the vertices; empty if there are none.
    pub fn colors(&self) -> &[Color] {
        &self.colors
    }

    /// The corners of triangle number `index`, which must be below the number of triangles, here and in the following.
    pub(crate) fn corners(&self, index: usize) -> [DVec3; 3] {
        self.triangles[index].map(|vertex| self.positions[vertex as usize])
    }

    /// Unit normal of a face, zero if it has no area.
    pub(crate) fn face_normal(&self, index: usize) -> DVec3 {
        let [a, b, c] = self.corners(index);
        // Sides are scaled, so that neither tiny nor huge triangles lose their direction.
        let size = (b - a).abs().max((c - a).abs()).max_element();
        if size > 0.0 { ((b - a) / size).cross((c - a) / size).normalize_or_zero() } else { DVec3::ZERO }
    }

    /// The normals at the corners of a face: those of its vertices, its own where they are missing.
    pub(crate) fn corner_normals(&self, index: usize) -> [DVec3; 3] {
        let face = self.face_normal(index);
        self.triangles[index].map(|vertex| {
            let normal = self.normals.get(vertex as usize).copied().unwrap_or_default();
            if normal == DVec3::ZERO { face } else { normal }
        })
    }

    /// The colours at the corners of a face on its front or back side.
    pub(crate) fn corner_colors(&self, index: usize, is_front: bool) -> [Color; 3] {
        let back = self.back_color.filter(|_| !is_front);
        self.triangles[index]
            .map(|vertex| back.or_else(|| self.colors.get(vertex as usize).copied()).unwrap_or(self.color))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn right_triangle(size: f64) -> Triangles {
        let positions = vec![DVec3::ZERO, DVec3::X * size, DVec3::Y * size];
        Triangles::new(positions, vec![[0, 1, 2]], Color::hex(0x80_80_80)).unwrap()
    }

    #[test]
    fn hostile_triangles_get_errors_with_their_index() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let error = Triangles::new(positions, vec![[0, 1, 2], [2, 1, 7]], Color::hex(0)).unwrap_err();
        let expected = FigureError::IndexOutOfRange { triangle: 1, corner: 2, vertex: 7, count: 3 };
        assert_eq!(error, expected, "{error}");
        let hole = vec![DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.0, f64::NAN)];
        let error = Triangles::new(hole, Vec::new(), Color::hex(0)).unwrap_err();
        assert!(matches!(error, FigureError::NonFinite { what: "position", index: 2, .. }), "{error}");
        let error = right_triangle(1.0).with_normals(vec![DVec3::Z, DVec3::Z, DVec3::NAN]).unwrap_err();
        assert!(matches!(error, FigureError::NonFinite { what: "normal", index: 2, .. }), "{error}");
        let error = right_triangle(1.0).with_colors(vec![Color::hex(0)]).unwrap_err();
        assert_eq!(error, FigureError::SizeMismatch { what: "colours", expected: 3, found: 1 }, "{error}");
    }

    #[test]
    fn counterclockwise_faces_look_up_at_any_size() {
        for size in [1e-200, 1.0, 1e200] {
            assert_eq!(right_triangle(size).face_normal(0), DVec3::Z, "size {size:e}");
        }
        assert_eq!(right_triangle(0.0).face_normal(0), DVec3::ZERO, "no area");
    }

    #[test]
    fn missing_normals_are_those_of_the_face() {
        let tilted = DVec3::new(0.0, 1.0, 1.0);
        let surface = right_triangle(1.0).with_normals(vec![tilted, DVec3::ZERO, DVec3::Z]).unwrap();
        assert_eq!(surface.corner_normals(0), [tilted.normalize(), DVec3::Z, DVec3::Z], "at the corners");
    }
}
