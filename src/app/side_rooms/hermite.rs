//! Ends of a cubic, the cubics that have them, and why there are so many.

use glam::DVec2;

use crate::core::bezier::{BezierError, EndData, GeometricHermite, geometric_hermite};
use crate::core::bspline::Side;
use crate::core::spline_curve::Nurbs;
use crate::document::Camera;
use crate::figure::picture::{Color, Item, Path, Picture, Stroke, Viewport};
use crate::figure::theme::Theme;

/// Places of a drawn cubic that are joined by lines.
const STEPS: u32 = 96;
/// Half the length in pt of the drawn arcs of curvature.
const ARC: f64 = 34.0;

/// Speeds beyond this, in chords, come from rounding.
const FASTEST: f64 = 1e8;

/// One end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The point.
    pub point: DVec2,
    /// The direction of the curve, in degrees from the x-axis.
    pub angle: f64,
    /// The signed curvature, positive in left turns.
    pub curvature: f64,
}

impl End {
    /// The unit tangent.
    pub fn direction(&self) -> DVec2 {
        // Quarter turns without rounding, so that parallel directions are parallel.
        let quarters = (self.angle / 90.0).round();
        let rest = DVec2::from_angle((self.angle - 90.0 * quarters).to_radians());
        match quarters.rem_euclid(4.0) as u8 {
            0 => rest,
            1 => rest.perp(),
            2 => -rest,
            _ => -rest.perp(),
        }
    }

    fn data(&self) -> EndData {
        EndData { point: self.point, direction: self.direction(), curvature: self.curvature }
    }
}

/// Both ends, and which cubic is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hermite {
    /// Start and end.
    pub ends: [End; 2],
    /// Index of the chosen solution.
    pub chosen: usize,
}

impl Default for Hermite {
    fn default() -> Self {
        Self::example(DVec2::ZERO, 1.0)
    }
}

/// The two equations `κ₀ α₀² = R₀ − 2 D α₁`, `κ₁ α₁² = R₁ − 2 D α₀` in units of the chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Equations {
    /// `κ` times the chord.
    pub(super) curvatures: [f64; 2],
    /// `R`.
    pub(super) right: [f64; 2],
    /// `D`, the sine of the angle from the first direction to the last.
    pub(super) turn: f64,
    /// The chord.
    pub(super) chord: f64,
}

impl Hermite {
    /// Data with three solutions, with lower left corner and size.
    pub fn example(corner: DVec2, size: f64) -> Self {
        let curvature = 0.6 / size;
        let end = corner + DVec2::splat(size);
        let ends = [End { point: corner, angle: 0.0, curvature }, End { point: end, angle: 90.0, curvature }];
        Self { ends, chosen: 0 }
    }

    /// [`Self::example`] in the middle of the view, with round coordinates.
    pub(super) fn example_in(camera: &Camera, canvas: DVec2) -> Self {
        let room = 0.6 * canvas.min_element() / camera.scale;
        let power = 10.0_f64.powf(room.log10().floor());
        let size = [5.0, 2.0, 1.0].into_iter().find(|step| step * power <= room).unwrap_or(1.0) * power;
        let step = 0.25 * size;
        let corner = ((camera.center - DVec2::splat(0.5 * size)) / step).round() * step;
        if corner.is_finite() && size > 0.0 { Self::example(corner, size) } else { Self::default() }
    }

    /// The ends of `curve`, unless it is closed or stands still there.
    pub(super) fn of(curve: &Nurbs<DVec2>) -> Option<Self> {
        let (left, right) = curve.space().parameter_interval();
        let end = |t, side| {
            let frame = curve.frame(t, side).ok()?;
            Some(End {
                point: frame.point,
                angle: frame.tangent.to_angle().to_degrees(),
                curvature: frame.curvature,
            })
        };
        Some(Self { ends: [end(left, Side::Right)?, end(right, Side::Left)?], chosen: 0 })
            .filter(|_| !curve.space().is_periodic())
    }

    /// All cubics.
    pub(super) fn solutions(&self) -> Result<Vec<GeometricHermite>, BezierError> {
        let mut found = geometric_hermite(self.ends[0].data(), self.ends[1].data())?;
        // Where directions are parallel up to rounding the equations have zeros near infinity.
        let chord = self.ends[0].point.distance(self.ends[1].point);
        found.retain(|solution| solution.speeds.iter().all(|&speed| speed < FASTEST * chord));
        if found.is_empty() {
            return Err(BezierError::NoSolution {
                reason: "no speeds of ordinary size give these curvatures",
            });
        }
        Ok(found)
    }

    /// The equations of the speeds; `None` for a chord of length 0.
    pub(super) fn equations(&self) -> Option<Equations> {
        let [start, end] = self.ends;
        let chord = start.point.distance(end.point);
        let along = (end.point - start.point).try_normalize()?;
        Some(Equations {
            curvatures: [start.curvature * chord, end.curvature * chord],
            right: [6.0 * start.direction().perp_dot(along), 6.0 * along.perp_dot(end.direction())],
            turn: start.direction().perp_dot(end.direction()),
            chord,
        })
    }

    /// How many cubics there are, and why.
    pub(super) fn verdict(&self) -> (String, String) {
        let solutions = self.solutions();
        let count = solutions.as_ref().map_or(0, Vec::len);
        let headline = match count {
            0 => "No cubic has these ends".to_owned(),
            1 => "One cubic has these ends".to_owned(),
            2 => "Two cubics have these ends".to_owned(),
            3 => "Three cubics have these ends".to_owned(),
            more => format!("{more} cubics have these ends"),
        };
        let Some(equations) = self.equations() else {
            return (headline, "The two end points are the same.".to_owned());
        };
        let no_solution = matches!(solutions, Err(BezierError::NoSolution { .. }));
        if let (Err(error), false) = (&solutions, no_solution) {
            return (headline, format!("The data are refused: {error}."));
        }
        (headline, equations.reason(count))
    }

    /// Draws every cubic, the chosen one strongest, and the arcs of curvature at the ends.
    pub(super) fn draw(&self, theme: &Theme, viewport: &Viewport, picture: &mut Picture) {
        let (mut items, mut lines) = (Vec::new(), Vec::new());
        for end in &self.ends {
            let arc = Stroke::solid(theme.warning.with_opacity(0.8), 1.6 * theme.stroke_scale);
            items.push(Item::Path(Path::polyline(&curvature_arc(end, ARC / viewport.scale), arc)));
        }
        for (k, solution) in self.solutions().unwrap_or_default().iter().enumerate() {
            let ink = color(theme, k);
            let places: Vec<DVec2> = (0..=STEPS)
                .filter_map(|step| solution.curve.evaluate(f64::from(step) / f64::from(STEPS)).ok())
                .collect();
            if k == self.chosen {
                let polygon = Stroke::dashed(theme.polygon, theme.stroke_scale, 5.0, 4.0);
                items.push(Item::Path(Path::polyline(solution.curve.points(), polygon)));
                // A band, so that cubics near by are seen on it.
                let band = Stroke::solid(ink.with_opacity(0.35), 8.0 * theme.stroke_scale);
                items.push(Item::Path(Path::polyline(&places, band)));
            }
            lines.push(Item::Path(Path::polyline(&places, Stroke::solid(ink, 1.8 * theme.stroke_scale))));
        }
        items.append(&mut lines);
        picture.push_layer("geometric Hermite interpolation", items);
    }
}

/// The colour of a solution on canvas, list and chart.
pub(super) fn color(theme: &Theme, k: usize) -> Color {
    theme.palette[k % 3]
}

/// The circle of curvature near an end.
fn curvature_arc(end: &End, half: f64) -> Vec<DVec2> {
    let (direction, normal, curvature) = (end.direction(), end.direction().perp(), end.curvature);
    let half = if curvature == 0.0 { half } else { half.min(2.5 / curvature.abs()) };
    (-16..=16)
        .map(|step| {
            let s = half * f64::from(step) / 16.0;
            let angle = curvature * s;
            // (sin κs, 1 − cos κs)/κ without a division by 0.
            let sinc = if angle.abs() < 1e-9 { 1.0 } else { angle.sin() / angle };
            let half_sinc = if angle.abs() < 1e-9 { 1.0 } else { (0.5 * angle).sin() / (0.5 * angle) };
            end.point + direction * (s * sinc) + normal * (0.5 * curvature * s * s * half_sinc * half_sinc)
        })
        .collect()
}

impl Equations {
    fn reason(&self, count: usize) -> String {
        let flat = |value: f64| value.abs() <= 1e-12;
        let ends = ["start", "end"];
        if self.curvatures.iter().chain(&self.right).all(|&value| flat(value)) {
            return "Directions and curvatures are those of the chord: every pair of speeds gives the segment; this one has constant speed.".to_owned();
        }
        if flat(self.turn) {
            let bad: Vec<&str> = (0..2)
                .filter(|&k| {
                    self.right[k] / self.curvatures[k] <= 0.0
                        || !(self.right[k] / self.curvatures[k]).is_finite()
                })
                .map(|k| ends[k])
                .collect();
            let first = "The directions are parallel: each speed has an equation of its own, \u{3ba}\u{3b1}\u{b2} = R, solved if \u{3ba} and R have the same sign.";
            return if bad.is_empty() {
                first.to_owned()
            } else {
                format!("{first} At the {} they have not.", bad.join(" and the "))
            };
        }
        // One equation alone may contradict positive speeds: κ α² + 2 D β = R with no positive term on the side of R.
        let impossible = |k: usize| {
            let terms = [self.curvatures[k], self.turn, -self.right[k]];
            terms.iter().all(|&term| term >= 0.0) || terms.iter().all(|&term| term <= 0.0)
        };
        if count == 0
            && let Some(k) = (0..2).find(|&k| impossible(k))
        {
            return format!(
                "The data of the {} exclude each other: its equation has no solution with positive speeds.",
                ends[k]
            );
        }
        let places = match count {
            0 => "no common point with positive coordinates",
            1 => "one common point with positive coordinates",
            2 => "two common points with positive coordinates",
            _ => "three common points with positive coordinates, the most that is possible",
        };
        format!(
            "The speeds \u{3b1}\u{2080}, \u{3b1}\u{2081} satisfy two quadratic equations: two parabolas, here with {places}."
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::RationalBezier;

    fn with(angles: [f64; 2], curvatures: [f64; 2]) -> Hermite {
        let end = |k: usize| End { point: DVec2::X * k as f64, angle: angles[k], curvature: curvatures[k] };
        Hermite { ends: [end(0), end(1)], chosen: 0 }
    }

    #[test]
    fn the_first_data_have_three_cubics() {
        let hermite = Hermite::default();
        assert_eq!(hermite.solutions().unwrap().len(), 3, "three");
        assert!(hermite.verdict().0.starts_with("Three"), "{:?}", hermite.verdict());
    }

    #[test]
    fn every_verdict_has_its_reason() {
        let said = |hermite: Hermite| hermite.verdict().1;
        assert!(said(with([0.0, 0.0], [0.0, 0.0])).contains("segment"), "straight");
        assert!(said(with([30.0, 30.0], [1.0, 1.0])).contains("parallel"), "parallel");
        assert!(said(with([-60.0, 60.0], [-1.0, 2.0])).contains("parabolas"), "general");
        assert!(said(with([60.0, 120.0], [1.0, 1.0])).contains("exclude"), "to the left first, then right");
        let mut point = with([0.0, 40.0], [0.0, 0.0]);
        point.ends[1].point = DVec2::ZERO;
        assert!(said(point).contains("same"), "one point");
    }

    #[test]
    fn the_ends_of_a_solution_are_the_data() {
        let hermite = Hermite::default();
        for solution in hermite.solutions().unwrap() {
            let curve =
                Nurbs::from_rational_bezier_curves(&[RationalBezier::polynomial(&solution.curve)]).unwrap();
            let back = Hermite::of(&curve).unwrap();
            for (end, wanted) in back.ends.iter().zip(hermite.ends) {
                assert!(end.point.distance(wanted.point) < 1e-12, "point");
                assert!(
                    (end.angle - wanted.angle).abs() < 1e-9,
                    "angle {} is not {}",
                    end.angle,
                    wanted.angle
                );
                assert!((end.curvature - wanted.curvature).abs() < 1e-9, "curvature {}", end.curvature);
            }
        }
    }
}
