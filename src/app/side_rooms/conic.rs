//! The quadratic piece of a curve at a parameter and what is known of its conic.

use glam::DVec2;

use crate::app::number_text::short;
use crate::core::rational_bezier::{Conic, ConicKind, ExtendedConic};
use crate::core::spline_curve::Nurbs;
use crate::document::{Edit, ObjectId};

/// Relative difference up to which two points or lengths count as equal.
const SAME: f64 = 1e-9;

/// A quadratic piece.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// It and its conic.
    pub(super) extended: ExtendedConic,
    /// Where it begins and ends.
    pub(super) interval: (f64, f64),
    /// The control points of the curve that are those of the piece; `None` if it is bounded by simple knots.
    pub(super) indices: Option<[usize; 3]>,
}

/// The piece of `curve` at `t`.
///
/// # Errors
///
/// A sentence that says why there is no conic.
pub(super) fn piece(curve: &Nurbs<DVec2>, t: f64) -> Result<Piece, String> {
    if curve.degree() != 2 {
        return Err(format!(
            "The pieces of a curve of degree 2 are arcs of conics; this one has degree {}.",
            curve.degree()
        ));
    }
    let pieces = curve.rational_bezier_curves().map_err(|error| error.to_string())?;
    let holds = |(left, right): (f64, f64)| left <= t && t <= right;
    // At a knot the piece to the right, as everywhere.
    let found = pieces.iter().rev().find(|piece| holds(piece.interval())).or(pieces.last());
    let found = found.ok_or("The curve has no piece.")?;
    let extended = ExtendedConic::try_from(found).map_err(|error| error.to_string())?;
    let (left, right) = found.interval();
    let indices = curve.space().span(left + 0.5 * (right - left)).ok().and_then(|span| {
        let indices =
            [span.checked_sub(2)?, span.checked_sub(1)?, span].map(|k| curve.space().coefficient_index(k));
        let reach =
            SAME * extended.points().iter().map(|p| p.distance(extended.points()[1])).fold(0.0, f64::max);
        let same = |(k, at): (&usize, DVec2)| curve.points().get(*k).is_some_and(|p| p.distance(at) <= reach);
        indices.iter().zip(extended.points()).all(same).then_some(indices)
    });
    Ok(Piece { extended, interval: (left, right), indices })
}

impl Piece {
    /// The middle weight when the outer ones are made 1.
    pub(super) fn standard_weight(&self) -> f64 {
        let [first, middle, last] = self.extended.weights();
        middle / first.sqrt() / last.sqrt()
    }

    /// Gives the piece this middle weight in standard form; its outer weights stay.
    pub(super) fn edit(&self, object: ObjectId, curve: &Nurbs<DVec2>, standard: f64) -> Option<Edit> {
        let [first, middle, last] = self.indices?;
        let weights = curve.weights();
        Some(Edit::SetWeight {
            object,
            point: middle,
            weight: standard * weights[first].sqrt() * weights[last].sqrt(),
        })
    }

    /// Inserts the knots that make the control points of the piece those of the curve; the shape stays.
    pub(super) fn separation(&self, object: ObjectId, curve: &Nurbs<DVec2>) -> Edit {
        let (left, right) = self.interval;
        let missing = |at: f64| {
            let multiplicity = curve.space().multiplicity(at);
            (multiplicity..2).map(move |_| Edit::InsertKnot { object, at })
        };
        let edits = missing(left).chain(missing(right)).collect();
        Edit::Batch { label: "Separate the piece".to_owned(), edits }
    }

    /// The weight that makes the arc one of a circle, or the middle point that makes it possible.
    pub(super) fn circle(&self) -> Result<f64, DVec2> {
        let [a, b, c] = self.extended.points();
        let (to_middle, chord) = (b - a, c - a);
        let (one, other) = (to_middle.length(), (c - b).length());
        if (one - other).abs() <= SAME * (one + other) && chord.length() > 0.0 {
            Ok(to_middle.dot(chord) / (one * chord.length()))
        } else {
            // On the perpendicular bisector of the chord, at the same height.
            let across = chord.perp().normalize_or_zero();
            Err(a + chord * 0.5 + across * to_middle.dot(across))
        }
    }
}

/// A quantity of a conic.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fact {
    /// Its name.
    pub(super) name: &'static str,
    /// What it means.
    pub(super) hint: &'static str,
    /// Its numbers.
    pub(super) numbers: Vec<f64>,
}

/// What is known of a conic in numbers.
pub(super) fn facts(conic: &Conic) -> Vec<Fact> {
    let mut facts = Vec::new();
    let mut say = |name, hint, numbers: Vec<f64>| facts.push(Fact { name, hint, numbers });
    say(
        "Discriminant",
        "a\u{2081}\u{2081} a\u{2082}\u{2082} \u{2212} a\u{2081}\u{2082}\u{b2}: positive for an ellipse, 0 for a parabola",
        vec![conic.discriminant()],
    );
    if let Ok(center) = conic.center() {
        say("Centre", "Centre of symmetry", vec![center.x, center.y]);
    }
    let axes = conic.axes().ok();
    if let Some(axes) = &axes {
        say("Half axes", "Through the foci first", axes.lengths.to_vec());
        let angle = axes.directions[0].to_angle().to_degrees();
        say(
            "Direction",
            "Of the axis through the foci, in degrees from the x-axis",
            vec![if angle.abs() < 1e-12 { 0.0 } else { angle }],
        );
    }
    if let Ok(foci) = conic.foci() {
        for (focus, name) in
            foci.iter().zip(if foci.len() == 1 { ["Focus", ""] } else { ["Focus 1", "Focus 2"] })
        {
            say(name, "Focus", vec![focus.x, focus.y]);
        }
    }
    if let Some(eccentricity) = eccentricity(conic) {
        say("Eccentricity", "0 for a circle, 1 for a parabola, more for a hyperbola", vec![eccentricity]);
    }
    facts
}

/// The numerical eccentricity.
pub(super) fn eccentricity(conic: &Conic) -> Option<f64> {
    if conic.kind() == ConicKind::Parabola {
        return Some(1.0);
    }
    let [a, b] = conic.axes().ok()?.lengths;
    let ratio = b / a;
    Some(match conic.kind() {
        ConicKind::Ellipse => ((1.0 - ratio) * (1.0 + ratio)).max(0.0).sqrt(),
        _ => ratio.hypot(1.0),
    })
}

/// `conic` in words: a circle is an ellipse with equal axes.
pub(super) fn kind_text(conic: &Conic) -> String {
    let is_circle = eccentricity(conic).is_some_and(|eccentricity| eccentricity < 1e-7);
    let label = if is_circle { "circle" } else { conic.kind().label() };
    let mut letters = label.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The equation with its numbers, to be typeset.
pub(super) fn equation(conic: &Conic) -> String {
    let [a, b, d, c, e, f] = conic.coefficients();
    let terms = [(a, "x^2"), (2.0 * b, "x y"), (c, "y^2"), (2.0 * d, "x"), (2.0 * e, "y"), (f, "")];
    let mut text = String::new();
    for (factor, monomial) in terms.into_iter().filter(|(factor, _)| factor.abs() > 1e-12) {
        let sign = match (factor < 0.0, text.is_empty()) {
            (true, _) => "-",
            (false, true) => "",
            (false, false) => "+",
        };
        let size = typeset_number(factor.abs());
        let size = if size == "1" && !monomial.is_empty() { String::new() } else { size };
        text.push_str(&format!(" {sign} {size} {monomial}"));
    }
    format!("{} = 0", text.trim())
}

/// A positive number with four digits as a formula.
fn typeset_number(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        let digits = (3.0 - value.log10().floor()).clamp(0.0, 6.0) as usize;
        let text = format!("{value:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        let exponent = value.log10().floor();
        format!("{:.2} \\cdot 10^{{{exponent}}}", value / 10_f64.powf(exponent))
    }
}

/// The size of the weight in words.
pub(super) fn weight_text(weight: f64) -> String {
    let kind = if (weight - 1.0).abs() <= SAME {
        ": an arc of a parabola"
    } else if weight < 1.0 {
        ", less than 1: an arc of an ellipse"
    } else {
        ", more than 1: an arc of a hyperbola"
    };
    format!("w = {}{kind}", short(weight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    fn arc(weight: f64) -> Nurbs<DVec2> {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        Nurbs::new(space, vec![DVec2::X, DVec2::ONE, DVec2::Y], vec![2.0, 2.0 * weight, 2.0]).unwrap()
    }

    #[test]
    fn the_quarter_circle_is_found_with_its_equation_and_weight() {
        let piece = piece(&arc(0.3), 0.5).unwrap();
        assert!((piece.standard_weight() - 0.3).abs() < 1e-15, "standard form");
        assert_eq!(piece.indices, Some([0, 1, 2]), "all three points");
        let weight = piece.circle().unwrap();
        assert!((weight - 0.5_f64.sqrt()).abs() < 1e-15, "cos 45\u{b0}, got {weight}");
        let circle = self::piece(&arc(weight), 0.5).unwrap().extended.implicit().unwrap().normalised();
        assert_eq!(equation(&circle), "x^2 +  y^2 - 1 = 0", "the unit circle");
        assert_eq!(kind_text(&circle), "Circle", "its type");
    }

    #[test]
    fn every_type_has_its_eccentricity() {
        for (weight, kind) in [(0.4, "Ellipse"), (1.0, "Parabola"), (2.5, "Hyperbola")] {
            let conic = piece(&arc(weight), 0.2).unwrap().extended.implicit().unwrap();
            assert_eq!(kind_text(&conic), kind, "type for w = {weight}");
            let eccentricity = eccentricity(&conic).unwrap();
            assert_eq!(eccentricity.total_cmp(&1.0), weight.total_cmp(&1.0), "eccentricity {eccentricity}");
        }
    }

    #[test]
    fn a_piece_between_simple_knots_is_separated_without_a_change() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 4.0]).unwrap();
        let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0), (6.0, 1.0)];
        let curve = Nurbs::polynomial(space, points.map(DVec2::from).to_vec()).unwrap();
        let found = piece(&curve, 1.5).unwrap();
        assert_eq!(found.indices, None, "bounded by simple knots");
        let mut document = crate::document::Document::new();
        let add = Edit::AddCurve { name: "T".to_owned(), curve: curve.clone(), display: Default::default() };
        let object = document.apply(&add).unwrap().created[0];
        document.apply(&found.separation(object, &curve)).unwrap();
        let after = document.curve(object).unwrap();
        let separate = piece(after, 1.5).unwrap();
        assert_eq!(separate.indices, Some([2, 3, 4]), "now its points are there");
        let (was, is) = (curve.evaluate(1.2).unwrap(), after.evaluate(1.2).unwrap());
        assert!(was.distance(is) < 1e-14, "the shape stays");
    }
}
