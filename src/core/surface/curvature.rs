//! Fundamental forms and curvatures of a surface `r(u, v)` at one point.
//!
//! `ν = r_u × r_v/|r_u × r_v|`, first form `E, F, G = r_u·r_u, r_u·r_v, r_v·r_v`, second form `L, M, N = ν·r_uu, ν·r_uv, ν·r_vv`,
//! `K = (LN − M²)/(EG − F²)`, `H = (EN − 2FM + GL)/(2(EG − F²))`. A curvature is positive where the surface bends towards `ν`.
//!
//! M. do Carmo, *Differential Geometry of Curves and Surfaces*, 1976, chapter 3.

use glam::{DMat2, DVec2, DVec3};

use crate::core::surface::error::SurfaceError;

/// `|r_u × r_v|` below this multiple of `|r_u||r_v|` makes no tangent plane: its direction would be rounding alone.
const PARALLEL: f64 = 1e-13;

/// Curvatures that differ by less than this part of the larger one, or of `1/size`, count as equal.
const UMBILIC: f64 = 1e-9;

/// A point of a surface with its derivatives up to order two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceJet {
    /// The parameters.
    pub at: [f64; 2],
    /// `r`.
    pub point: DVec3,
    /// `r_u`.
    pub du: DVec3,
    /// `r_v`.
    pub dv: DVec3,
    /// `r_uu`.
    pub duu: DVec3,
    /// `r_uv`.
    pub duv: DVec3,
    /// `r_vv`.
    pub dvv: DVec3,
    /// Lengths up to which `r_u` and `r_v` are rounding errors of zero.
    pub noise: [f64; 2],
    /// Size of the surface; curvatures far below `1/size` count as zero.
    pub size: f64,
}

/// First form, second form and unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FundamentalForms {
    /// `[E, F, G]`.
    pub first: [f64; 3],
    /// `[L, M, N]`.
    pub second: [f64; 3],
    /// `ν`.
    pub normal: DVec3,
}

/// What the surface looks like near a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointKind {
    /// `K > 0`, curvatures differ.
    Elliptic,
    /// `K < 0`.
    Hyperbolic,
    /// One curvature is zero.
    Parabolic,
    /// Both curvatures are equal, not zero.
    Umbilic,
    /// Both curvatures are zero.
    Planar,
}

impl PointKind {
    /// Its name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Elliptic => "elliptic",
            Self::Hyperbolic => "hyperbolic",
            Self::Parabolic => "parabolic",
            Self::Umbilic => "umbilic",
            Self::Planar => "planar",
        }
    }
}

/// Gaussian, mean and principal curvatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvatures {
    /// `K = κ₁ κ₂`.
    pub gaussian: f64,
    /// `H = (κ₁ + κ₂)/2`.
    pub mean: f64,
    /// `κ₁ ≤ κ₂`.
    pub principal: [f64; 2],
    /// Parameter directions of `κ₁` and `κ₂`, of unit length on the surface; `None` at umbilic and planar points.
    pub directions: Option<[DVec2; 2]>,
    /// The kind of point.
    pub kind: PointKind,
}

impl SurfaceJet {
    /// The unit normal `r_u × r_v/|r_u × r_v|`.
    ///
    /// # Errors
    ///
    /// `SingularPoint` if a derivative vanishes or both are parallel.
    pub fn normal(&self) -> Result<DVec3, SurfaceError> {
        let normal = self.du.cross(self.dv);
        let (u, v, length) = (self.du.length(), self.dv.length(), normal.length());
        // Written so that numbers that are not comparable are singular as well.
        let regular = u > self.noise[0] && v > self.noise[1] && length > PARALLEL * u * v;
        if regular { Ok(normal / length) } else { Err(SurfaceError::SingularPoint { at: self.at }) }
    }

    /// Both fundamental forms.
    ///
    /// # Errors
    ///
    /// As [`Self::normal`].
    pub fn forms(&self) -> Result<FundamentalForms, SurfaceError> {
        let normal = self.normal()?;
        Ok(FundamentalForms {
            first: [self.du.dot(self.du), self.du.dot(self.dv), self.dv.dot(self.dv)],
            second: [normal.dot(self.duu), normal.dot(self.duv), normal.dot(self.dvv)],
            normal,
        })
    }

    /// Gaussian, mean and principal curvatures, with the directions of the latter.
    ///
    /// # Errors
    ///
    /// As [`Self::normal`].
    pub fn curvatures(&self) -> Result<Curvatures, SurfaceError> {
        Ok(self.forms()?.curvatures(self.size))
    }
}

impl FundamentalForms {
    /// The curvatures; those far below `1/size` count as zero.
    pub fn curvatures(&self, size: f64) -> Curvatures {
        let ([e, f, g], [l, m, n]) = (self.first, self.second);
        // With I = C Cᵀ the generalised problem II x = κ I x becomes the symmetric C⁻¹ II C⁻ᵀ y = κ y, x = C⁻ᵀ y.
        let a = e.sqrt();
        let b = f / a;
        let c = (g - b * b).sqrt();
        let inverse = DMat2::from_cols(DVec2::new(1.0 / a, -b / (a * c)), DVec2::new(0.0, 1.0 / c));
        let second = DMat2::from_cols(DVec2::new(l, m), DVec2::new(m, n));
        let shape = inverse * second * inverse.transpose();
        let (p, q, r) = (shape.x_axis.x, 0.5 * (shape.x_axis.y + shape.y_axis.x), shape.y_axis.y);
        let (mean, radius) = (0.5 * (p + r), (0.5 * (p - r)).hypot(q));
        let principal = [mean - radius, mean + radius];
        let gaussian = p * r - q * q;
        let largest = principal[0].abs().max(principal[1].abs());
        let zero = UMBILIC / size;
        let kind = if largest <= zero {
            PointKind::Planar
        } else if radius <= UMBILIC * largest {
            PointKind::Umbilic
        } else if principal[0].abs().min(principal[1].abs()) <= UMBILIC * largest {
            PointKind::Parabolic
        } else if gaussian > 0.0 {
            PointKind::Elliptic
        } else {
            PointKind::Hyperbolic
        };
        let directions = (!matches!(kind, PointKind::Planar | PointKind::Umbilic)).then(|| {
            // The eigenvector of κ₂, from the larger of its two formulas.
            let y = if p >= r {
                DVec2::new(0.5 * (p - r) + radius, q)
            } else {
                DVec2::new(q, 0.5 * (r - p) + radius)
            };
            let y = y.normalize();
            [inverse.transpose() * DVec2::new(y.y, -y.x), inverse.transpose() * y]
        });
        Curvatures { gaussian, mean, principal, directions, kind }
    }

    /// Curvature of the normal section in the parameter direction `(du, dv)`; not a number for the zero direction.
    pub fn normal_curvature(&self, direction: DVec2) -> f64 {
        let form = |[a, b, c]: [f64; 3]| {
            a * direction.x * direction.x
                + 2.0 * b * direction.x * direction.y
                + c * direction.y * direction.y
        };
        form(self.second) / form(self.first)
    }

    /// The parameter directions without normal curvature, of unit length on the surface; `None` where `K > 0` or all directions are such.
    pub fn asymptotic_directions(&self, size: f64) -> Option<[DVec2; 2]> {
        let curvatures = self.curvatures(size);
        let ([low, high], [d1, d2]) = (curvatures.principal, curvatures.directions?);
        if low > 0.0 && high > 0.0 || low < 0.0 && high < 0.0 {
            return None;
        }
        // Euler: κ₁ cos²φ + κ₂ sin²φ = 0.
        let (cos, sin) = ((high / (high - low)).sqrt(), (low / (low - high)).sqrt());
        Some([d1 * cos + d2 * sin, d1 * cos - d2 * sin])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn jet(derivatives: [DVec3; 5]) -> SurfaceJet {
        let [du, dv, duu, duv, dvv] = derivatives;
        let (at, point, noise, size) = ([0.0; 2], DVec3::ZERO, [0.0; 2], 1.0);
        SurfaceJet { at, point, du, dv, duu, duv, dvv, noise, size }
    }

    fn vector() -> impl Strategy<Value = DVec3> {
        (-2.0..2.0_f64, -2.0..2.0_f64, -2.0..2.0_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn swapping_the_parameters_turns_the_signs_and_scaling_divides(
            du in vector(), dv in vector(), duu in vector(), duv in vector(), dvv in vector(), phi in 0.0..6.0_f64,
        ) {
            prop_assume!(du.cross(dv).length() > 0.1);
            let forms = jet([du, dv, duu, duv, dvv]).forms().unwrap();
            let a = forms.curvatures(1.0);
            let swapped = jet([dv, du, dvv, duv, duu]).curvatures().unwrap();
            let scaled = jet([du, dv, duu, duv, dvv].map(|v| v * 2.0)).curvatures().unwrap();
            let size = 1.0 + a.mean.abs() * a.mean.abs();
            prop_assert!((a.gaussian - swapped.gaussian).abs() < 1e-9 * size, "{:?} {:?}", a, swapped);
            prop_assert!((a.mean + swapped.mean).abs() < 1e-9 * size, "{:?} {:?}", a, swapped);
            prop_assert!((a.gaussian / 4.0 - scaled.gaussian).abs() < 1e-9 * size, "{:?} {:?}", a, scaled);
            let Some([d1, d2]) = a.directions else { return Ok(()) };
            let space = |d: DVec2| du * d.x + dv * d.y;
            prop_assert!(space(d1).dot(space(d2)).abs() < 1e-9, "principal directions are orthogonal in space");
            for (d, kappa) in [(d1, a.principal[0]), (d2, a.principal[1])] {
                let error = (forms.normal_curvature(d) - kappa).abs();
                prop_assert!(error < 1e-8 * size, "their normal curvature is off by {}", error);
            }
            let euler = a.principal[0] * phi.cos().powi(2) + a.principal[1] * phi.sin().powi(2);
            let error = (forms.normal_curvature(d1 * phi.cos() + d2 * phi.sin()) - euler).abs();
            prop_assert!(error < 1e-8 * size, "Euler's formula is off by {}", error);
            for d in forms.asymptotic_directions(1.0).into_iter().flatten() {
                prop_assert!(forms.normal_curvature(d).abs() < 1e-7 * size, "asymptotic direction {}", d);
            }
        }
    }

    #[test]
    fn parallel_and_vanishing_derivatives_are_singular() {
        for (du, dv) in [(DVec3::X, DVec3::X * 2.0), (DVec3::ZERO, DVec3::Y), (DVec3::NAN, DVec3::Y)] {
            let error = jet([du, dv, DVec3::Z, DVec3::Z, DVec3::Z]).curvatures().unwrap_err();
            assert_eq!(error.name(), "SingularPoint", "{du} and {dv}");
        }
    }
}
