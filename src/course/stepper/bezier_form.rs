//! Bezier form: every knot is inserted until it is `n`-fold, one insertion after the other.
//!
//! Then `n + 1` consecutive control points are those of a Bezier curve, and neighbours share one. Course: section 6.4.

use glam::{DVec2, DVec3};

use crate::core::bspline::Spline;
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::short_number;
use crate::course::stepper::entry::Parent;
use crate::course::stepper::narration::{
    Name, Shares, counted, mixture, multiplicity_word, overlap, range_of, sentence,
};
use crate::course::stepper::teller::{Net, Teller};
use crate::course::stepper::{Entry, Look, Stepper, StepperKind, Tie};
use crate::figure::composition::StepInk;

/// More insertions than this have no place in a table.
const MOST_INSERTIONS: usize = 150;

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    let net = Net::of(curve).map_err(|error| sentence(&error))?;
    let (n, space) = (curve.degree(), curve.space());
    let t = space.reduce(t).map_err(|error| sentence(&error))?;
    let mut breaks = space.breaks();
    if space.is_periodic() {
        // The end of the period is its start.
        breaks.pop();
    }
    let missing: Vec<(f64, usize)> = breaks
        .iter()
        .map(|&knot| (knot, n - space.multiplicity(knot).min(n)))
        .filter(|&(_, times)| times > 0)
        .collect();
    let count: usize = missing.iter().map(|&(_, times)| times).sum();
    if count == 0 {
        return Err(format!(
            "Every knot is {} knot already: the curve is in Bézier form.",
            multiplicity_word(n)
        ));
    }
    if count > MOST_INSERTIONS {
        return Err(format!("{count} insertions are needed; the table has room for {MOST_INSERTIONS}."));
    }
    let look = Look { joined: false, ..Look::default() };
    let mut teller = Teller { look, ..Teller::default() };
    let ties = teller.row((0..curve.points().len()).map(|k| net.control_point(k)).collect());
    let caption = format!(
        "{} of {} have to be raised to multiplicity {n}: {}.",
        counted(missing.len(), "knot"),
        breaks.len(),
        counted(count, "insertion")
    );
    teller.tell(caption, format!("n = {n}"), ties.clone(), ties);
    let mut spline = net.spline.clone();
    // Where each control point stands in the table.
    let mut owners: Vec<Tie> = teller.levels[0].iter().map(Entry::tie).collect();
    for knot in missing.into_iter().flat_map(|(knot, times)| std::iter::repeat_n(knot, times)) {
        let refined = insert(&mut teller, &net, &spline, &owners, knot)?;
        owners = new_owners(&teller, &spline, &owners, &refined);
        spline = refined;
        let polygon = net.polygon(&spline);
        teller.draw(|drawing| drawing.line(polygon, StepInk::Result, 2.0));
    }
    close(&mut teller, &net, curve);
    let last = teller.levels.len() - 1;
    Ok(teller.end(StepperKind::BezierForm, t, (last, 0)))
}

/// One insertion: a row with the new points, and a frame.
fn insert(
    teller: &mut Teller,
    net: &Net,
    spline: &Spline<DVec3>,
    owners: &[Tie],
    knot: f64,
) -> Result<Spline<DVec3>, String> {
    let (n, space) = (spline.degree(), spline.space());
    let scheme = spline.insertion_scheme(knot, 1).map_err(|error| sentence(&error))?;
    overlap(space, n - scheme.multiplicity)?;
    let first = scheme.span + 1 - n;
    let round = teller.levels.len();
    let new = scheme.triangle.levels().get(1).ok_or("The insertion has no new points.")?;
    let entry = |(j, &value): (usize, &DVec3)| {
        let k = first + j;
        let share = scheme.triangle.weights()[0][j];
        let parent = |k: usize, factor: f64| Parent { tie: owners[space.coefficient_index(k)], factor };
        Entry {
            share: Some(share),
            parents: vec![parent(k - 1, 1.0 - share), parent(k, share)],
            ..Entry::homogeneous(Name::new('c', space.coefficient_index(k), Some(round)), value, net.rational)
        }
    };
    let entries: Vec<Entry> = new.iter().enumerate().map(entry).collect();
    let ties = teller.row(entries);
    let row = &teller.levels[round];
    let parent = |i: usize| {
        let (level, position) = row[0].parents[i].tie;
        &teller.levels[level][position]
    };
    let knots = space.evaluation_knots();
    let shares = Shares::Fraction { at: knot, low: knots[first], high: knots[first + n] };
    let (_, formula) = mixture(&row[0], parent(0), parent(1), &shares);
    let caption = format!(
        "The knot {} becomes {} knot: {}, {}.",
        short_number(knot),
        multiplicity_word(scheme.multiplicity + 1),
        counted(row.len(), "new point"),
        range_of(row)
    );
    teller.tell(caption, formula, ties.clone(), ties);
    spline.insert_knot(knot).map_err(|error| sentence(&error))
}

/// Where the control points of `refined` stand: in the last row, or where they stood before. Those that stay keep their bits.
fn new_owners(teller: &Teller, before: &Spline<DVec3>, owners: &[Tie], refined: &Spline<DVec3>) -> Vec<Tie> {
    let last = teller.levels.len() - 1;
    let kept = before.coefficients().iter().zip(owners);
    let kept: Vec<(DVec3, Tie)> = kept.map(|(&value, &tie)| (value, tie)).collect();
    let row = teller.levels[last].iter().map(|entry| {
        let weight = entry.weight.unwrap_or(1.0);
        let [x, y] = [entry.coordinates[0], entry.coordinates[1]];
        (DVec3::new(x * weight, y * weight, weight), entry.tie())
    });
    let known: Vec<(DVec3, Tie)> = kept.into_iter().chain(row).collect();
    let nearest = |value: &DVec3| {
        let far = |known: &(DVec3, Tie)| known.0.distance_squared(*value);
        known.iter().min_by(|a, b| far(a).total_cmp(&far(b))).map_or((0, 0), |found| found.1)
    };
    refined.coefficients().iter().map(nearest).collect()
}

/// The pieces, in two colours in turn.
fn close(teller: &mut Teller, net: &Net, curve: &Nurbs<DVec2>) {
    let n = curve.degree();
    let pieces = net.spline.bezier_pieces();
    let count = pieces.iter().len();
    let of = if count == 1 { "the only piece".to_owned() } else { format!("one of the {count} pieces") };
    let caption = format!(
        "All knots are {n}-fold: {} points in a row are the Bézier points of {of}, and neighbours share one.",
        n + 1
    );
    teller.tell(
        caption,
        format!("P[a, \\ldots, a, b, \\ldots, b], \\quad n = {n}"),
        Vec::new(),
        Vec::<Tie>::new(),
    );
    for (i, (_, points)) in pieces.iter().enumerate() {
        let places: Vec<DVec2> = points.iter().map(|&value| net.place(value)).collect();
        let ink = if i % 2 == 0 { StepInk::First } else { StepInk::Second };
        let (start, inner) = (places[0], places[1..].to_vec());
        teller.draw(|drawing| {
            let drawing = drawing.line(places, ink, 2.6).dot(start, StepInk::Result, 9.0, None);
            inner.into_iter().fold(drawing, |drawing, at| drawing.dot(at, ink, 6.0, None))
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::stepper::samples::{all_curves, bezier};

    #[test]
    fn the_last_polygon_is_made_of_the_bezier_points_of_all_pieces() {
        for curve in all_curves() {
            let stepper = match story(&curve, curve.space().parameter_interval().0) {
                Ok(stepper) => stepper,
                Err(reason) => {
                    let space = curve.space();
                    let full = space.breaks().iter().all(|&knot| space.multiplicity(knot) == curve.degree());
                    let overlaps = space.is_periodic() && curve.degree() > curve.points().len();
                    assert!(full || overlaps, "degree {}: {reason}", curve.degree());
                    continue;
                }
            };
            let frames = stepper.frames();
            let polygon = &frames[frames.len() - 2].drawing.lines[0].points;
            let mut found = 0;
            for segment in curve.bezier_form() {
                for point in &segment.points {
                    let near = polygon.iter().any(|other| other.distance(*point) < 1e-8);
                    assert!(near, "degree {}: {point} is not in the polygon", curve.degree());
                }
                found += curve.degree();
            }
            assert_eq!(polygon.len(), found + 1, "pieces share their ends");
        }
    }

    #[test]
    fn every_row_holds_the_new_points_of_one_insertion() {
        for curve in all_curves() {
            let Ok(stepper) = story(&curve, curve.space().parameter_interval().0) else { continue };
            for (row, frame) in stepper.levels().iter().zip(stepper.frames()).skip(1) {
                assert!(!row.is_empty() && row.len() <= curve.degree(), "at most n new points");
                let polygon = &frame.drawing.lines[0].points;
                let inside = row.iter().filter(|entry| polygon.contains(&entry.at.unwrap())).count();
                assert!(inside + 1 >= row.len(), "at an end one of the new points is dropped with its knot");
            }
        }
    }

    #[test]
    fn a_bezier_curve_is_in_bezier_form() {
        assert!(story(&bezier(), 0.5).unwrap_err().contains("Bézier form"), "nothing to do");
    }
}
