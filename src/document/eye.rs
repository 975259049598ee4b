//! How a scene was looked at: the numbers of an orbit camera, saved with the view.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// An eye on a sphere around its target. Right-handed coordinates, z up; angles in radians.
///
/// The eye stands at `target + distance·(cos pitch·cos yaw, cos pitch·sin yaw, sin pitch)` and looks at the target. Yaw −π/2
/// and pitch 0 look along +y with +x to the right. At the depth of the target the page shows a height of
/// `2·distance·tan(field_of_view/2)`, in both projections. The mathematics is in `figure::scene::Eye`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct EyeState {
    /// The point in the middle of the page, about which the eye turns.
    pub target: DVec3,
    /// Longitude of the eye as seen from the target, from +x towards +y.
    pub yaw: f64,
    /// Latitude, from −π/2 (seen from below) to π/2 (from above).
    pub pitch: f64,
    /// Distance of the eye from the target.
    pub distance: f64,
    /// Vertical angle of view.
    pub field_of_view: f64,
    /// Whether parallel lines stay parallel.
    pub orthographic: bool,
}

/// A number of an [`EyeState`] that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the eye's {field} is {value}; it must be between {low} and {high}")]
pub struct EyeError {
    /// The field.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// The least possible value.
    pub low: f64,
    /// The largest possible value.
    pub high: f64,
}

impl EyeState {
    /// Coordinates of the target have at most this size.
    pub const FARTHEST_TARGET: f64 = 1e9;
    /// The least distance.
    pub const MIN_DISTANCE: f64 = 1e-9;
    /// The largest distance.
    pub const MAX_DISTANCE: f64 = 1e9;
    /// The smallest angle of view.
    pub const MIN_FIELD_OF_VIEW: f64 = 0.01;
    /// The largest angle of view.
    pub const MAX_FIELD_OF_VIEW: f64 = 2.8;

    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// [`EyeError`] with the name of the field, its value and the range.
    pub fn check(&self) -> Result<(), EyeError> {
        let far = -Self::FARTHEST_TARGET..=Self::FARTHEST_TARGET;
        for (field, value, range) in [
            ("target.x", self.target.x, far.clone()),
            ("target.y", self.target.y, far.clone()),
            ("target.z", self.target.z, far),
            ("yaw", self.yaw, -1e6..=1e6),
            ("pitch", self.pitch, -FRAC_PI_2..=FRAC_PI_2),
            ("distance", self.distance, Self::MIN_DISTANCE..=Self::MAX_DISTANCE),
            ("field_of_view", self.field_of_view, Self::MIN_FIELD_OF_VIEW..=Self::MAX_FIELD_OF_VIEW),
        ] {
            if !range.contains(&value) {
                return Err(EyeError { field, value, low: *range.start(), high: *range.end() });
            }
        }
        Ok(())
    }
}

impl Default for EyeState {
    /// From above, front and right, with a long lens.
    fn default() -> Self {
        Self {
            target: DVec3::ZERO,
            yaw: -FRAC_PI_4,
            pitch: 0.5,
            distance: 8.0,
            field_of_view: 0.6,
            orthographic: false,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;

    #[test]
    fn eyes_come_back_from_json_bit_for_bit() {
        let eye = EyeState { yaw: 0.1 + 0.2, distance: 1.0 / 3.0, orthographic: true, ..EyeState::default() };
        let text = serde_json::to_string(&eye).unwrap();
        assert_eq!(serde_json::from_str::<EyeState>(&text).unwrap(), eye, "{text}");
    }

    #[test]
    fn impossible_numbers_are_named() {
        let eye = EyeState::default();
        assert_eq!(eye.check(), Ok(()), "the default");
        for (field, bad) in [
            ("distance", EyeState { distance: 0.0, ..eye }),
            ("pitch", EyeState { pitch: 1.6, ..eye }),
            ("yaw", EyeState { yaw: f64::NAN, ..eye }),
            ("target.z", EyeState { target: DVec3::new(0.0, 0.0, f64::INFINITY), ..eye }),
            ("field_of_view", EyeState { field_of_view: -1.0, ..eye }),
        ] {
            let error = bad.check().unwrap_err();
            assert_eq!(error.field, field, "{error}");
        }
    }
}
