//! The polynomial piece of a curve at one parameter in Bezier form, which de Casteljau's algorithm works on.

use glam::{DVec2, DVec3};

use crate::core::spline_curve::Nurbs;
use crate::core::triangular_scheme::TriangularScheme;
use crate::course::number_text::{formula_number, short_number};
use crate::course::stepper::Entry;
use crate::course::stepper::narration::{Name, difference, range_of, sentence};
use crate::course::stepper::teller::{Net, Teller};

/// One piece and where the parameter lies in it.
pub(super) struct BezierPiece {
    /// Its parameter interval.
    pub(super) interval: (f64, f64),
    /// The parameter, reduced into one period for closed curves.
    pub(super) parameter: f64,
    /// The parameter in the interval from 0 to 1.
    pub(super) share: f64,
    /// Whether the piece is the whole curve and its control points are those of the curve.
    pub(super) is_whole: bool,
    pub(super) net: Net,
    points: Vec<DVec3>,
}

impl BezierPiece {
    /// The piece of `curve` at `t`, that on the right of a knot.
    pub(super) fn at(curve: &Nurbs<DVec2>, t: f64) -> Result<Self, String> {
        let net = Net::of(curve).map_err(|error| sentence(&error))?;
        let parameter = curve.space().reduce(t).map_err(|error| sentence(&error))?;
        let pieces = net.spline.bezier_pieces();
        let found = pieces.iter().filter(|((left, _), _)| *left <= parameter).last();
        let (interval, points) = found.or_else(|| pieces.iter().next()).ok_or("The curve has no pieces.")?;
        let share = ((parameter - interval.0) / (interval.1 - interval.0)).clamp(0.0, 1.0);
        let points = points.to_vec();
        let is_whole = !curve.space().is_periodic() && points == net.spline.coefficients();
        Ok(Self { interval, parameter, share, is_whole, net, points })
    }

    /// De Casteljau's scheme at the parameter.
    pub(super) fn scheme(&self) -> TriangularScheme<DVec3> {
        TriangularScheme::run(self.points.clone(), self.points.len() - 1, |_, _| self.share)
    }

    /// The table of de Casteljau's scheme.
    pub(super) fn table(&self) -> Teller {
        let mut teller = Teller::default();
        let given = |(k, &value): (usize, &DVec3)| {
            if self.is_whole {
                return self.net.control_point(k);
            }
            Entry::homogeneous(Name::new('q', k, None), value, self.net.rational)
        };
        teller.row(self.points.iter().enumerate().map(given).collect());
        teller.scheme(&self.scheme(), self.net.rational, |level, position| Name::of_level(position, level));
        teller
    }

    /// Where the parameter lies, and what the points of row 0 are; with a formula.
    pub(super) fn opening(&self, row: &[Entry]) -> (String, String) {
        let (left, right) = self.interval;
        let t = short_number(self.parameter);
        let points = range_of(row);
        let caption = if self.is_whole {
            format!("The curve is a Bézier curve with the control points {points}; t = {t}.")
        } else {
            format!(
                "t = {t} lies in [{}, {}]; there the curve is a polynomial piece with the Bézier points {points}.",
                short_number(left),
                short_number(right)
            )
        };
        let formula = if (left, right) == (0.0, 1.0) {
            format!("s = t = {}", formula_number(self.share))
        } else {
            format!(
                "s = \\frac{{{}}}{{{}}} = {}",
                difference(self.parameter, left),
                difference(right, left),
                formula_number(self.share)
            )
        };
        (caption, formula)
    }

    /// What is special at an end of the piece.
    pub(super) fn note(&self) -> Option<String> {
        let at_end = self.share <= 0.0 || self.share >= 1.0;
        at_end.then(|| {
            format!("t = {} is an end of the piece: no step is needed.", short_number(self.parameter))
        })
    }
}
