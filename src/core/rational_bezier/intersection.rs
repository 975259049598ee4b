//! Intersections of plane curves.
//!
//! Pairs of parts whose boxes or strips are apart are dropped. Where the directions of both parts are apart too there is at most one crossing, which Newton's
//! method finds; other pairs are halved. Pairs that stay until they are as small as the square root of the tolerance hold a contact along a
//! common tangent: where `(p − q)·p′ = 0` and `det(p′, q′) = 0`. Course: section 2.6.

use glam::DVec2;

use crate::core::bezier::{BezierCurve, BezierError};
use crate::core::point::Point as _;
use crate::core::rational_bezier::RationalBezier;
use crate::core::rational_bezier::error::RationalBezierError;

/// Most pairs of parts that are looked at.
const MAX_PAIRS: usize = 200_000;
/// Parameters in `[0, 1]` closer than this belong to one contact if its points agree.
const SAME: f64 = 1e-4;
/// A step of Newton's method in parameters of `[0, 1]` below which it has converged.
const CONVERGED: f64 = 1e-15;

/// How two curves meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// They cross.
    Crossing,
    /// They touch with a common tangent, within the tolerance.
    Tangent,
    /// They agree within the tolerance between these parameters of the first and of the second curve; the latter decrease for opposite directions.
    Overlap {
        /// Ends of the common part on the first curve.
        first: [f64; 2],
        /// The parameters of the same points on the second curve.
        second: [f64; 2],
    },
}

/// A common point of two curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The parameters on the first and the second curve; where an overlap begins.
    pub parameters: [f64; 2],
    /// The point, on the first curve.
    pub point: DVec2,
    /// How the curves meet there.
    pub contact: Contact,
}

impl RationalBezier<DVec2> {
    /// All common points with `other`, sorted by the parameter of this curve; contacts within `tolerance` count.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` if more than 200 000 pairs of parts are needed; those of [`RationalBezier::evaluate`].
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::rational_bezier::{Contact, circle};
    ///
    /// let (one, other) = (&circle(DVec2::ZERO, 1.0, 2, 4)?[0], &circle(DVec2::X, 1.0, 2, 4)?[1]);
    /// let found = one.intersections(other, 1e-10)?;
    /// assert_eq!(found.len(), 1);
    /// assert!((found[0].point - DVec2::new(0.5, 0.75_f64.sqrt())).length() < 1e-14);
    /// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
    /// ```
    pub fn intersections(
        &self,
        other: &Self,
        tolerance: f64,
    ) -> Result<Vec<Intersection>, RationalBezierError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(BezierError::InvalidTolerance { value: tolerance }.into());
        }
        let unit = |curve: &Self| Self::new(curve.points().to_vec(), curve.weights().to_vec());
        let search = Search { curves: [unit(self)?, unit(other)?], tolerance };
        let mut found = search.all()?;
        found.sort_by(|p, q| p.parameters[0].total_cmp(&q.parameters[0]));
        let ends = [self.interval(), other.interval()];
        let back = |j: usize, t: f64| ends[j].0.mix(ends[j].1, t);
        for hit in &mut found {
            hit.parameters = [back(0, hit.parameters[0]), back(1, hit.parameters[1])];
            if let Contact::Overlap { first, second } = &mut hit.contact {
                *first = first.map(|t| back(0, t));
                *second = second.map(|u| back(1, u));
            }
        }
        Ok(found)
    }
}

impl RationalBezier<DVec2> {
    /// Middle direction and half opening of the angle that holds all tangents, that is all chords; `None` if it is not below 90 degrees.
    pub(in crate::core) fn tangent_cone(&self) -> Option<(f64, f64)> {
        let points = self.points();
        // Edges of the polygon hold the tangents of a polynomial curve. Those of a rational one lie between chords of the polygon.
        let pairs: Vec<DVec2> = if self.has_equal_weights() {
            points.windows(2).map(|pair| pair[1] - pair[0]).collect()
        } else {
            (0..points.len())
                .flat_map(|i| (i + 1..points.len()).map(move |j| points[j] - points[i]))
                .collect()
        };
        let middle = points[points.len() - 1] - points[0];
        let angle = |way: DVec2| middle.perp_dot(way).atan2(middle.dot(way));
        let proper = pairs.into_iter().filter(|way| *way != DVec2::ZERO).map(angle);
        let widest = proper.fold(0.0_f64, |most, angle| most.max(angle.abs()));
        (middle != DVec2::ZERO && widest < std::f64::consts::FRAC_PI_2).then(|| (middle.to_angle(), widest))
    }
}

impl BezierCurve<DVec2> {
    /// All common points with `other`, see [`RationalBezier::intersections`].
    ///
    /// # Errors
    ///
    /// As there.
    pub fn intersections(
        &self,
        other: &Self,
        tolerance: f64,
    ) -> Result<Vec<Intersection>, RationalBezierError> {
        RationalBezier::polynomial(self).intersections(&RationalBezier::polynomial(other), tolerance)
    }
}

/// Two curves over `[0, 1]`.
struct Search {
    curves: [RationalBezier<DVec2>; 2],
    tolerance: f64,
}

/// A part of a curve with its interval and what its control polygon says.
#[derive(Clone)]
struct Part {
    curve: RationalBezier<DVec2>,
    low: DVec2,
    high: DVec2,
}

impl Part {
    fn new(curve: RationalBezier<DVec2>) -> Self {
        let low = curve.points().iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = curve.points().iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        Self { curve, low, high }
    }

    fn size(&self) -> f64 {
        (self.high - self.low).max_element()
    }

    fn halves(&self) -> Result<[Self; 2], RationalBezierError> {
        let (a, b) = self.curve.interval();
        let (left, right) = self.curve.split(0.5 * (a + b))?;
        Ok([Self::new(left), Self::new(right)])
    }

    /// Whether `other` is more than `gap` away: beside the box, or beside the strip along the chord that holds our control points.
    fn is_apart(&self, other: &Self, gap: f64) -> bool {
        if (self.low - other.high).max_element() > gap || (other.low - self.high).max_element() > gap {
            return true;
        }
        let points = self.curve.points();
        let Some(normal) = (points[points.len() - 1] - points[0]).perp().try_normalize() else {
            return false;
        };
        let range = |points: &[DVec2]| {
            let at = points.iter().map(|point| normal.dot(*point - self.low));
            at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let (mine, theirs) = (range(points), range(other.curve.points()));
        mine.0 - theirs.1 > gap || theirs.0 - mine.1 > gap
    }

    /// Whether no tangent of `self` is parallel to one of `other`.
    fn directions_differ(&self, other: &Self) -> bool {
        let (Some((a, p)), Some((b, q))) = (self.curve.tangent_cone(), other.curve.tangent_cone()) else {
            return false;
        };
        let turn = (a - b).rem_euclid(std::f64::consts::PI);
        turn.min(std::f64::consts::PI - turn) > p + q
    }
}

impl Search {
    /// Everything that the curves have in common.
    fn all(&self) -> Result<Vec<Intersection>, RationalBezierError> {
        let [p, q] = [0, 1].map(|j| Part::new(self.curves[j].clone()));
        if p.is_apart(&q, self.tolerance) || q.is_apart(&p, self.tolerance) {
            return Ok(Vec::new());
        }
        // Where no tangents are parallel there is no common part, and one crossing at most.
        let differ = p.directions_differ(&q);
        if differ {
            let found = self.polished(&p, &q, false)?;
            if !found.is_empty() {
                return Ok(found);
            }
        }
        let mut found = if differ { Vec::new() } else { self.overlaps()? };
        let covered: Vec<_> = found.iter().map(|hit| hit.contact).collect();
        found.extend(self.contacts(&covered)?);
        Ok(found)
    }

    /// Size of the parts below which a pair that is left holds a contact.
    fn smallest(&self) -> f64 {
        let size = self.curves.iter().map(|curve| curve.without_weights().extent()).fold(0.0, f64::max);
        (self.tolerance * size).sqrt().max(self.tolerance)
    }

    /// Common parts: they end where an end of one curve is on the other.
    fn overlaps(&self) -> Result<Vec<Intersection>, RationalBezierError> {
        let mut ends: Vec<[f64; 2]> = Vec::new();
        for (j, other) in [(0, 1), (1, 0)] {
            for t in [0.0, 1.0] {
                let foot = self.curves[other].closest_point(self.curves[j].evaluate(t)?)?;
                let pair = if j == 0 { [t, foot.parameter] } else { [foot.parameter, t] };
                let is_new = ends.iter().all(|end| end.iter().zip(&pair).any(|(a, b)| (a - b).abs() > SAME));
                if foot.distance <= self.tolerance && is_new {
                    ends.push(pair);
                }
            }
        }
        ends.sort_by(|p, q| p[0].total_cmp(&q[0]));
        // As many points as different curves cannot have in common.
        let count = self.curves[0].degree() * self.curves[1].degree() + 1;
        let mut found = Vec::new();
        for pair in ends.windows(2) {
            let is_on = |i: usize| {
                let t = pair[0][0].mix(pair[1][0], i as f64 / (count + 1) as f64);
                let foot = self.curves[1].closest_point(self.curves[0].evaluate(t)?)?;
                Ok::<_, RationalBezierError>(foot.distance <= self.tolerance)
            };
            let mut all = pair[1][0] - pair[0][0] > SAME;
            for i in 1..=count {
                all = all && is_on(i)?;
            }
            if all {
                let contact =
                    Contact::Overlap { first: [pair[0][0], pair[1][0]], second: [pair[0][1], pair[1][1]] };
                found.push(Intersection {
                    parameters: pair[0],
                    point: self.curves[0].evaluate(pair[0][0])?,
                    contact,
                });
            }
        }
        Ok(found)
    }

    /// Crossings and tangential contacts outside the common parts.
    fn contacts(&self, covered: &[Contact]) -> Result<Vec<Intersection>, RationalBezierError> {
        let mut starts = vec![Part::new(self.curves[0].clone())];
        for contact in covered {
            let Contact::Overlap { first, .. } = *contact else { continue };
            let mut left = Vec::new();
            for part in starts {
                let (a, b) = part.curve.interval();
                for (from, to) in [(a, first[0].min(b)), (first[1].max(a), b)] {
                    if to - from > SAME {
                        left.push(Part::new(part.curve.restricted(from, to)?));
                    }
                }
            }
            starts = left;
        }
        let whole = Part::new(self.curves[1].clone());
        let mut waiting: Vec<(Part, Part)> = starts.into_iter().map(|part| (part, whole.clone())).collect();
        let smallest = self.smallest();
        let mut found: Vec<Intersection> = Vec::new();
        let mut pairs = 0;
        while let Some((p, q)) = waiting.pop() {
            pairs += 1;
            if pairs > MAX_PAIRS {
                let limit = MAX_PAIRS;
                return Err(BezierError::StepLimit { what: "pairs of parts", value: pairs, limit }.into());
            }
            if p.is_apart(&q, self.tolerance) || q.is_apart(&p, self.tolerance) {
                continue;
            }
            let is_small = p.size().max(q.size()) <= smallest;
            if is_small || p.directions_differ(&q) {
                let hits = self.polished(&p, &q, is_small)?;
                let is_settled = is_small || !hits.is_empty();
                hits.into_iter().for_each(|hit| self.report(&mut found, hit, covered));
                if is_settled {
                    continue;
                }
            }
            // The larger one is halved.
            if p.size() >= q.size() {
                waiting.extend(p.halves()?.map(|half| (half, q.clone())));
            } else {
                waiting.extend(q.halves()?.map(|half| (p.clone(), half)));
            }
        }
        Ok(found)
    }

    /// The contacts that Newton's method finds in a pair: one crossing, or, in small pairs, what is there.
    fn polished(&self, p: &Part, q: &Part, is_small: bool) -> Result<Vec<Intersection>, RationalBezierError> {
        let (a, b) = (p.curve.interval(), q.curve.interval());
        let inside = |[t, u]: [f64; 2], slack: f64| {
            let within = |x: f64, (low, high): (f64, f64)| {
                let room = slack * (high - low);
                (low - room..=high + room).contains(&x)
            };
            within(t, a) && within(u, b) && (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)
        };
        let middle = [0.5 * (a.0 + a.1), 0.5 * (b.0 + b.1)];
        let mut found = Vec::new();
        if is_small
            && let Some(hit) = self.newton(middle, true)?
            && inside(hit.parameters, 1.0)
        {
            return Ok(vec![hit]);
        }
        let corners = [[a.0, b.0], [a.0, b.1], [a.1, b.0], [a.1, b.1]];
        let starts = if is_small { 5 } else { 1 };
        for start in [middle].into_iter().chain(corners).take(starts) {
            if let Some(hit) = self.newton(start, false)?
                && inside(hit.parameters, if is_small { 1.0 } else { 1e-9 })
            {
                found.push(hit);
            }
        }
        Ok(found)
    }

    /// Newton's method for a crossing `p = q`, or for a tangential contact; `None` unless it ends within the tolerance. Parameters are kept in `[0, 1]`.
    fn newton(&self, start: [f64; 2], is_tangent: bool) -> Result<Option<Intersection>, RationalBezierError> {
        let [mut t, mut u] = start;
        for _ in 0..30 {
            let (p, q) = (self.curves[0].derivatives(t, 2)?, self.curves[1].derivatives(u, 2)?);
            let gap = p[0] - q[0];
            let (step_t, step_u) = if is_tangent {
                // (p − q)·p′ = 0 and det(p′, q′) = 0.
                let (f, g) = (gap.dot(p[1]), p[1].perp_dot(q[1]));
                let (ft, fu) = (p[1].dot(p[1]) + gap.dot(p[2]), -q[1].dot(p[1]));
                let (gt, gu) = (p[2].perp_dot(q[1]), p[1].perp_dot(q[2]));
                let determinant = ft * gu - fu * gt;
                ((f * gu - fu * g) / determinant, (ft * g - f * gt) / determinant)
            } else {
                let determinant = p[1].perp_dot(q[1]);
                (gap.perp_dot(q[1]) / determinant, gap.perp_dot(p[1]) / determinant)
            };
            if !(step_t.is_finite() && step_u.is_finite()) {
                break;
            }
            let next = [(t - step_t).clamp(0.0, 1.0), (u - step_u).clamp(0.0, 1.0)];
            let moved = (next[0] - t).abs().max((next[1] - u).abs());
            [t, u] = next;
            if moved <= CONVERGED {
                break;
            }
        }
        let (p, q) = (self.curves[0].derivatives(t, 1)?, self.curves[1].derivatives(u, 1)?);
        let sine = p[1].perp_dot(q[1]).abs() / (p[1].length() * q[1].length());
        // A tangent at a clamped end is none unless the directions agree.
        let fits = !is_tangent || sine <= 1e-6;
        let contact = if is_tangent { Contact::Tangent } else { Contact::Crossing };
        let is_near = p[0].distance(q[0]) <= self.tolerance;
        Ok((is_near && fits).then_some(Intersection { parameters: [t, u], point: p[0], contact }))
    }

    /// Adds a contact unless it is known or at the end of a common part.
    fn report(&self, found: &mut Vec<Intersection>, hit: Intersection, covered: &[Contact]) {
        let near = |a: f64, b: f64| (a - b).abs() <= SAME;
        let at_overlap = covered.iter().any(|contact| match *contact {
            Contact::Overlap { first, second } => {
                (0..2).any(|j| near(hit.parameters[0], first[j]) && near(hit.parameters[1], second[j]))
            }
            _ => false,
        });
        let reach = 4.0 * self.tolerance;
        let known = found.iter_mut().find(|old| {
            let close =
                near(old.parameters[0], hit.parameters[0]) && near(old.parameters[1], hit.parameters[1]);
            let tangent = old.contact == Contact::Tangent || hit.contact == Contact::Tangent;
            close && (old.point.distance(hit.point) <= reach || tangent)
        });
        match known {
            Some(old) if hit.contact == Contact::Tangent => *old = hit,
            None if !at_overlap => found.push(hit),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::curve::tests::curves;
    use proptest::prelude::*;

    fn curve(points: &[[f64; 2]]) -> BezierCurve<DVec2> {
        BezierCurve::new(points.iter().copied().map(DVec2::from).collect()).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn planted_crossings_are_found_in_either_order(one in curves(), other in curves(), s in prop::array::uniform2(0.1..0.9_f64)) {
            prop_assume!(one.degree() > 0 && other.degree() > 0);
            let x = s.map(|s| (-1.0).mix(2.0, s));
            let (p, q) = (one.frame(x[0]), other.frame(x[1]));
            let (Ok(p), Ok(q)) = (p, q) else { return Ok(()) };
            prop_assume!(p.tangent.perp_dot(q.tangent).abs() > 0.05);
            let moved = other.transformed(|c| c + (p.point - q.point)).unwrap();
            let found = one.intersections(&moved, 1e-9).unwrap();
            let is_planted = |hit: &Intersection| (0..2).all(|j| (hit.parameters[j] - x[j]).abs() < 1e-6);
            prop_assert!(found.iter().any(is_planted), "{x:?} is not among {found:?}");
            prop_assert!(found.len() <= 2 * one.degree() * other.degree(), "{} points", found.len());
            for hit in &found {
                let gap = one.evaluate(hit.parameters[0]).unwrap().distance(moved.evaluate(hit.parameters[1]).unwrap());
                prop_assert!(gap <= 1e-9, "gap {gap}");
            }
            let swapped = moved.intersections(&one, 1e-9).unwrap();
            prop_assert_eq!(swapped.len(), found.len(), "{:?} and {:?}", found, swapped);
        }
    }

    #[test]
    fn tangents_are_told_from_crossings() {
        let up = curve(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]]);
        let down = curve(&[[0.0, 2.0], [1.0, 0.0], [2.0, 2.0]]);
        let found = up.intersections(&down, 1e-10).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].contact, Contact::Tangent, "they touch");
        assert!((found[0].parameters[0] - 0.5).abs() < 1e-12, "in the middle: {found:?}");
        let lower = down.transformed(|p| p - DVec2::new(0.0, 1e-3)).unwrap();
        let found = up.intersections(&lower, 1e-10).unwrap();
        assert_eq!(
            found.iter().map(|hit| hit.contact).collect::<Vec<_>>(),
            [Contact::Crossing; 2],
            "they cross"
        );
        let upper = down.transformed(|p| p + DVec2::new(0.0, 1e-3)).unwrap();
        assert_eq!(up.intersections(&upper, 1e-10).unwrap(), [], "they miss");
    }

    #[test]
    fn nine_points_of_two_cubics_and_no_more() {
        let one = curve(&[[-1.0, -1.0], [-1.0 / 3.0, 5.0], [1.0 / 3.0, -5.0], [1.0, 1.0]]);
        let other = curve(&[[-1.0, -1.0], [5.0, -1.0 / 3.0], [-5.0, 1.0 / 3.0], [1.0, 1.0]]);
        let found = one.intersections(&other, 1e-10).unwrap();
        let x: Vec<f64> = found.iter().map(|hit| hit.point.x).collect();
        assert_eq!(x.len(), 9, "{x:?}");
        // Of (x, T₃(x)) and its mirror image: T₉ = x.
        for x in x {
            let angle = x.clamp(-1.0, 1.0).acos();
            assert!(((9.0 * angle).cos() - x).abs() < 1e-8, "{x}");
        }
    }

    #[test]
    fn common_parts_are_overlaps() {
        let cubic = curve(&[[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]]);
        let (one, other) = (cubic.restricted(0.0, 0.75).unwrap(), cubic.restricted(0.25, 1.0).unwrap());
        for (other, ends) in [(other.clone(), [0.25, 0.75]), (other.reversed(), [1.0, 0.5])] {
            let found = one.intersections(&other, 1e-10).unwrap();
            assert_eq!(found.len(), 1, "{found:?}");
            let Contact::Overlap { first, second } = found[0].contact else {
                panic!("no overlap: {found:?}")
            };
            assert!((first[0] - 0.25).abs() + (first[1] - 0.75).abs() < 1e-9, "{first:?}");
            assert!((second[0] - ends[0]).abs() + (second[1] - ends[1]).abs() < 1e-9, "{second:?}");
        }
        assert_eq!(one.intersections(&other, 0.0).unwrap_err().name(), "InvalidTolerance", "zero tolerance");
        let itself = cubic.intersections(&cubic, 1e-9).unwrap();
        assert_eq!(itself.len(), 1, "a curve and itself: {itself:?}");
    }
}
