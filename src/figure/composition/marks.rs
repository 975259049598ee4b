//! What the marks of a curve say: control points, knots, inflections, extrema of the curvature, Bezier points, crossings, joints, symmetry.

use glam::DVec2;

use crate::core::bspline::Side;
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::{Meeting, Nurbs, SymmetryKind, VertexKind};
use crate::document::{CurveDisplay, Document, Object};
use crate::figure::composition::curve_layers::short_number;
use crate::figure::composition::looks::{MANY_FOR_LOOKS, bounds};
use crate::figure::composition::probe::{probe, probe_ends};

/// Knots of so many are not drawn.
const MANY_POINTS: usize = 2000;
/// More marks at one place are not told.
const MOST: usize = 6;

/// What a mark is, and its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkNote {
    /// Where it is.
    pub at: DVec2,
    /// What it is, and of which curve.
    pub title: String,
    /// Its numbers, a line each.
    pub facts: Vec<String>,
}

/// The marks that are drawn within `reach` of `place`, nearest first.
pub fn marks_near(document: &Document, place: DVec2, reach: f64) -> Vec<MarkNote> {
    let mut notes = Vec::new();
    for object in document.objects().iter().filter(|object| object.visible) {
        let Some((curve, display)) = object.curve().zip(object.curve_display()) else { continue };
        let (low, high) = bounds(curve);
        let size = (high - low).length();
        let mut marks = Marks { object, curve, place, reach, size, notes: &mut notes };
        if curve.points().len() <= MANY_FOR_LOOKS {
            marks.joints(document);
            marks.measured(display);
            marks.symmetry(display);
        }
        marks.points(display);
        marks.knots(display);
    }
    notes.sort_by(|a, b| a.at.distance(place).total_cmp(&b.at.distance(place)));
    notes.truncate(MOST);
    notes
}

struct Marks<'a> {
    object: &'a Object,
    curve: &'a Nurbs<DVec2>,
    place: DVec2,
    reach: f64,
    /// The size of the curve: much smaller numbers are rounding.
    size: f64,
    notes: &'a mut Vec<MarkNote>,
}

impl Marks<'_> {
    fn number(&self, length: f64) -> String {
        short_number(if length.abs() <= 1e-12 * self.size { 0.0 } else { length })
    }

    fn pair(&self, at: DVec2) -> String {
        format!("({}, {})", self.number(at.x), self.number(at.y))
    }

    /// Adds a mark if it is near enough.
    fn add(&mut self, at: DVec2, title: String, facts: impl FnOnce(&Self) -> Vec<String>) {
        if at.distance(self.place) <= self.reach {
            let title = format!("{title} of {}", self.object.name);
            let facts = facts(self);
            self.notes.push(MarkNote { at, title, facts });
        }
    }

    /// Adds a mark on the curve: its parameter, its place and what else there is to say.
    fn add_on_curve(&mut self, parameter: f64, title: &str, more: Vec<String>) {
        if let Ok(at) = self.curve.evaluate(parameter) {
            let facts = |marks: &Self| {
                let mut facts =
                    vec![format!("t = {}", short_number(parameter)), format!("at {}", marks.pair(at))];
                facts.extend(more);
                facts
            };
            self.add(at, title.to_owned(), facts);
        }
    }

    fn curvature(&self, parameter: f64, side: Side) -> Option<f64> {
        let values = self.curve.derivatives(parameter, 2, side).ok()?;
        let speed = values[1].length();
        let curvature = (values[1] / speed).perp_dot(values[2]) / speed / speed;
        curvature.is_finite().then_some(curvature)
    }

    fn points(&mut self, display: &CurveDisplay) {
        if !display.points {
            return;
        }
        let (curve, n) = (self.curve, self.curve.degree());
        for (k, (&at, &weight)) in curve.points().iter().zip(curve.weights()).enumerate() {
            self.add(at, format!("Control point {k}"), |marks| {
                let knots = (k + 1..=k + n).filter_map(|j| curve.space().knot(j as isize)).map(short_number);
                let knots = knots.collect::<Vec<_>>().join(", ");
                vec![
                    format!("at {}", marks.pair(at)),
                    format!("weight {}", short_number(weight)),
                    format!("blossom [{knots}]"),
                ]
            });
        }
    }

    fn knots(&mut self, display: &CurveDisplay) {
        let (curve, n) = (self.curve, self.curve.degree());
        let distinct = curve.space().distinct_knots();
        if !display.knots || distinct.len() > MANY_POINTS {
            return;
        }
        for knot in distinct {
            let copies = knot.multiplicity;
            let smooth = match copies {
                copies if copies <= n => format!("multiplicity {copies}, C{}", raised(n - copies)),
                copies => format!("multiplicity {copies}"),
            };
            let curvature = self.curvature(knot.value, Side::Right);
            let curvature = curvature.map(|curvature| format!("κ = {}", short_number(curvature)));
            self.add_on_curve(knot.value, "Knot", [smooth].into_iter().chain(curvature).collect());
        }
    }

    fn measured(&mut self, display: &CurveDisplay) {
        let curve = self.curve;
        if display.inflections
            && let Ok(found) = curve.inflections()
        {
            for parameter in found.parameters {
                self.add_on_curve(parameter, "Inflection", vec!["the curvature changes its sign".to_owned()]);
            }
        }
        if display.vertices
            && let Ok(found) = curve.vertices()
        {
            for vertex in found.vertices.iter().filter(|vertex| vertex.kind != VertexKind::End) {
                let [left, right] = vertex.curvatures;
                let title = match vertex.kind {
                    VertexKind::Maximum => "Maximum of the curvature",
                    VertexKind::Minimum => "Minimum of the curvature",
                    VertexKind::Knot | VertexKind::End => "Curvature at a knot",
                };
                let facts = if (left - right).abs() <= 1e-6 * left.abs().max(right.abs()) {
                    vec![
                        format!("κ = {}", short_number(left)),
                        format!("radius {}", short_number(left.abs().recip())),
                    ]
                } else {
                    vec![format!("κ = {} before, {} after", short_number(left), short_number(right))]
                };
                self.add_on_curve(vertex.parameter, title, facts);
            }
        }
        if display.bezier_points {
            for (piece, ((a, b), lifted)) in curve.homogeneous().bezier_pieces().iter().enumerate() {
                for (j, &lifted) in lifted.iter().enumerate() {
                    let (at, weight) = DVec2::project(lifted);
                    self.add(at, format!("Bezier point {j} of piece {piece}"), |marks| {
                        vec![
                            format!("at {}", marks.pair(at)),
                            format!("weight {}", short_number(weight)),
                            format!("piece over [{}, {}]", short_number(a), short_number(b)),
                        ]
                    });
                }
            }
        }
        if display.probe_line
            && let Ok(found) = probe(curve, probe_ends(curve, display))
        {
            for crossing in found.curve {
                let title = if crossing.meeting == Meeting::Crossing { "Crossing" } else { "Contact" };
                self.add_on_curve(crossing.parameter, &format!("{title} of the probe line"), Vec::new());
            }
        }
    }

    fn symmetry(&mut self, display: &CurveDisplay) {
        if !display.symmetry {
            return;
        }
        let Ok([best, _]) = self.curve.symmetries() else { return };
        let off = format!("largest deviation {}", self.number(best.deviation));
        match best.kind {
            SymmetryKind::Axis { through, direction } => {
                let foot = through + direction * (self.place - through).dot(direction);
                let angle = direction.y.atan2(direction.x).to_degrees().rem_euclid(180.0);
                let facts = |marks: &Self| {
                    vec![
                        format!("through {}", marks.pair(through)),
                        format!("angle {}°", short_number(angle)),
                        off,
                    ]
                };
                self.add(foot, "Nearest axis of symmetry".to_owned(), facts);
            }
            SymmetryKind::Center(center) => {
                let facts = |marks: &Self| vec![format!("at {}", marks.pair(center)), off];
                self.add(center, "Nearest centre of symmetry".to_owned(), facts);
            }
        }
    }

    /// The ends that touch the end of another curve.
    fn joints(&mut self, document: &Document) {
        let curve = self.curve;
        if curve.space().is_periodic() {
            return;
        }
        let (left, right) = curve.space().parameter_interval();
        for other in document.objects().iter().filter(|other| other.visible && other.id > self.object.id) {
            let Some(Ok(Some(joint))) = other.curve().map(|other| curve.joint(other)) else { continue };
            let Ok(at) = curve.evaluate(if joint.at_end { right } else { left }) else { continue };
            if joint.gap > self.reach {
                continue;
            }
            if at.distance(self.place) > self.reach {
                continue;
            }
            let told = |number: Option<f64>| number.map_or_else(|| "undefined".to_owned(), short_number);
            let facts = vec![
                format!("G⁰ distance {}", self.number(joint.gap)),
                format!("G¹ angle {}°", told(joint.angle.map(f64::to_degrees))),
                format!("G² difference of κ {}", told(joint.curvature)),
            ];
            let title = format!("Joint of {} with {}", self.object.name, other.name);
            self.notes.push(MarkNote { at, title, facts });
        }
    }
}

/// A small number as an exponent.
fn raised(number: usize) -> String {
    let digit = |letter: char| match letter {
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        other => char::from_u32(0x2070 + other.to_digit(10).unwrap_or(0)).unwrap_or(other),
    };
    number.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::document::Edit;

    #[test]
    fn every_kind_of_mark_tells_its_numbers() {
        let points = [[0.0, 0.0], [1.0, 3.0], [2.0, -3.0], [3.0, 0.0]].map(DVec2::from).to_vec();
        let space = SplineSpace::from_breaks(3, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let wave = Nurbs::polynomial(space.clone(), points).unwrap();
        let straight = [3.0, 4.0, 5.0, 6.0].map(|x| DVec2::new(x, 9.0 - 3.0 * x)).to_vec();
        let line = Nurbs::polynomial(space, straight).unwrap();
        let display = CurveDisplay {
            inflections: true,
            vertices: true,
            symmetry: true,
            probe_line: true,
            bezier_points: true,
            ..CurveDisplay::default()
        };
        let mut document = Document::new();
        for (name, curve) in [("Wave", &wave), ("Line", &line)] {
            let edit =
                Edit::AddCurve { name: name.to_owned(), curve: curve.clone(), display: display.clone() };
            document.apply(&edit).unwrap();
        }
        let told = |at: DVec2| -> String {
            let notes = marks_near(&document, at, 1e-6);
            notes.into_iter().map(|note| format!("{}: {}; ", note.title, note.facts.join(", "))).collect()
        };
        let middle = told(DVec2::new(1.5, 0.0));
        for words in [
            "Inflection of Wave: t = 0.5, at (1.5, 0)",
            "Nearest centre of symmetry of Wave: at (1.5, 0), largest deviation 0",
            "Crossing of the probe line of Wave: t = 0.5",
        ] {
            assert!(middle.contains(words), "{words} in {middle}");
        }
        let second = told(DVec2::new(1.0, 3.0));
        assert!(
            second.contains("Control point 1 of Wave: at (1, 3), weight 1, blossom [0, 0, 1]"),
            "{second}"
        );
        assert!(second.contains("Bezier point 1 of piece 0 of Wave"), "{second}");
        let end = told(DVec2::new(3.0, 0.0));
        assert!(end.contains("Joint of Wave with Line: G⁰ distance 0, G¹ angle "), "{end}");
        assert!(end.contains("Knot of Wave: t = 1, at (3, 0), multiplicity 3, C⁰"), "{end}");
        let top = wave
            .vertices()
            .unwrap()
            .vertices
            .iter()
            .find(|v| v.kind == VertexKind::Maximum)
            .copied()
            .unwrap();
        let extremum = told(wave.evaluate(top.parameter).unwrap());
        assert!(extremum.contains("Maximum of the curvature of Wave: t = "), "{extremum}");
        assert!(told(DVec2::new(40.0, 40.0)).is_empty(), "nothing far away");
    }
}
