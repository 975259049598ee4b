//! The light of all scenes: it moves with the eye, so that what one looks at is never dark.
//!
//! Three parts: light from everywhere, a lamp at the eye, a weaker one above the left shoulder; and a highlight where the
//! surface mirrors the second lamp into the eye (B. T. Phong, 1975, with the half vector of J. F. Blinn, 1977). Light acts on
//! sRGB values as they are, here and on a GPU.

use glam::DVec3;

use crate::figure::picture::Color;

/// Direction to the second lamp along the axes of the view (right, up, towards the eye); a unit vector.
const FILL_DIRECTION: DVec3 = DVec3::new(-3.0 / 7.0, 6.0 / 7.0, 2.0 / 7.0);
/// The larger, the smaller the highlight.
const SHININESS: i32 = 32;

/// How strong the parts of the light are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// From everywhere.
    pub ambient: f64,
    /// From the eye.
    pub head: f64,
    /// From above the left shoulder.
    pub fill: f64,
    /// Share of white added in the middle of the highlight.
    pub shine: f64,
}

impl Light {
    /// Direction to the second lamp along the axes of the view (right, up, towards the eye); a unit vector.
    pub const fn fill_direction() -> DVec3 {
        FILL_DIRECTION
    }

    /// The colour of a surface with this unit `normal` seen from the unit vector `to_eye`, both along the axes of the view.
    pub fn shade(&self, color: Color, normal: DVec3, to_eye: DVec3) -> Color {
        let facing = normal.dot(to_eye).max(0.0);
        let lit = self.ambient + self.head * facing + self.fill * normal.dot(FILL_DIRECTION).max(0.0);
        let mirrored = normal.dot((FILL_DIRECTION + to_eye).normalize_or_zero()).max(0.0);
        let white = 255.0 * self.shine * mirrored.powi(SHININESS);
        let seen = |part: u8| (f64::from(part) * lit + white).round().clamp(0.0, 255.0) as u8;
        Color { r: seen(color.r), g: seen(color.g), b: seen(color.b), a: color.a }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_that_face_the_eye_are_brightest_without_a_second_lamp() {
        let light = Light { ambient: 0.25, head: 0.75, fill: 0.0, shine: 0.0 };
        let grey = Color::hex(0x80_80_80);
        assert_eq!(light.shade(grey, DVec3::Z, DVec3::Z), grey, "facing the eye");
        let edge = light.shade(grey, DVec3::X, DVec3::Z);
        assert_eq!(edge, Color::hex(0x20_20_20), "edge on: a quarter");
        // Lambert's cosine: 0.25 + 0.75/2 at 60°.
        let tilted = light.shade(grey, DVec3::new(0.75f64.sqrt(), 0.0, 0.5), DVec3::Z);
        assert_eq!(tilted.r, 80, "0.625 · 128");
    }

    #[test]
    fn the_highlight_is_where_the_mirror_is_and_never_overflows() {
        assert!((FILL_DIRECTION.length() - 1.0).abs() < 1e-15, "a unit vector");
        let light = Light { ambient: 0.9, head: 0.9, fill: 0.9, shine: 0.5 };
        let mirror = (FILL_DIRECTION + DVec3::Z).normalize();
        assert_eq!(light.shade(Color::hex(0xFF_FF_FF), mirror, DVec3::Z), Color::hex(0xFF_FF_FF), "full");
        let dim = Light { ambient: 0.0, head: 0.0, fill: 0.0, shine: 0.5 };
        assert_eq!(dim.shade(Color::hex(0), mirror, DVec3::Z).r, 128, "half of white");
        assert!(dim.shade(Color::hex(0), DVec3::Z, DVec3::Z).r < 60, "beside it");
    }
}
