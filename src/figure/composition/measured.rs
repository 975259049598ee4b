//! What has been measured on curves, kept as long as they stay the same: a picture is composed far more often than a curve changes.

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use glam::DVec2;

use crate::core::spline_curve::{CurveInflections, Nurbs, PolygonDistance, Symmetry, Vertices};
use crate::document::{Document, Object, ObjectId};
use crate::figure::composition::probe::{Bracket, Probe, brackets, probe};

/// The measurements on the curves of a document, each made when it is first asked for.
#[derive(Debug, Default)]
pub struct Measurements(RefCell<HashMap<ObjectId, Rc<Measured>>>);

/// The measurements on one curve; `None` where there are none to be had.
#[derive(Debug)]
pub(super) struct Measured {
    object: Arc<Object>,
    inflections: OnceCell<Option<CurveInflections>>,
    vertices: OnceCell<Option<Vertices>>,
    symmetry: OnceCell<Option<Symmetry>>,
    distances: OnceCell<Option<Vec<PolygonDistance>>>,
    crossings: RefCell<Option<Rc<Crossings>>>,
}

/// What a probe line has in common with the curve.
#[derive(Debug)]
pub(super) struct Crossings {
    ends: [DVec2; 2],
    pub(super) probe: Option<Probe>,
    pub(super) brackets: Vec<Bracket>,
}

impl Measurements {
    /// What is known of the curve `object`: nothing yet if it has changed. Changes of name and display count as none.
    pub(super) fn of(&self, object: &Arc<Object>) -> Rc<Measured> {
        let mut known = self.0.borrow_mut();
        let found = known
            .get(&object.id)
            .filter(|known| Arc::ptr_eq(&known.object, object) || known.object.curve() == object.curve());
        if let Some(found) = found {
            return Rc::clone(found);
        }
        let fresh = Rc::new(Measured::new(object));
        known.insert(object.id, Rc::clone(&fresh));
        fresh
    }

    /// Forgets the objects that `document` no longer has.
    pub(super) fn tidy(&self, document: &Document) {
        let mut known = self.0.borrow_mut();
        if !known.is_empty() {
            let there: std::collections::HashSet<_> =
                document.objects().iter().map(|object| object.id).collect();
            known.retain(|id, _| there.contains(id));
        }
    }
}

impl Measured {
    pub(super) fn new(object: &Arc<Object>) -> Self {
        Self {
            object: Arc::clone(object),
            inflections: OnceCell::new(),
            vertices: OnceCell::new(),
            symmetry: OnceCell::new(),
            distances: OnceCell::new(),
            crossings: RefCell::new(None),
        }
    }

    fn curve(&self) -> Option<&Nurbs<DVec2>> {
        self.object.curve()
    }

    pub(super) fn inflections(&self) -> Option<&CurveInflections> {
        self.inflections.get_or_init(|| self.curve()?.inflections().ok()).as_ref()
    }

    pub(super) fn vertices(&self) -> Option<&Vertices> {
        self.vertices.get_or_init(|| self.curve()?.vertices().ok()).as_ref()
    }

    /// The nearest symmetry.
    pub(super) fn symmetry(&self) -> Option<&Symmetry> {
        let nearest = || self.curve()?.symmetries().ok().map(|[nearest, _]| nearest);
        self.symmetry.get_or_init(nearest).as_ref()
    }

    /// The distances from the control polygon, without weights.
    pub(super) fn distances(&self) -> Option<&[PolygonDistance]> {
        let distances = || self.curve()?.without_weights().polygon_distances().ok();
        self.distances.get_or_init(distances).as_deref()
    }

    /// What the line through `ends` has in common with the curve.
    pub(super) fn crossings(&self, ends: [DVec2; 2]) -> Option<Rc<Crossings>> {
        let mut last = self.crossings.borrow_mut();
        if let Some(known) = last.as_ref().filter(|known| known.ends == ends) {
            return Some(Rc::clone(known));
        }
        let curve = self.curve()?;
        let fresh =
            Rc::new(Crossings { ends, probe: probe(curve, ends).ok(), brackets: brackets(curve, ends) });
        *last = Some(Rc::clone(&fresh));
        Some(fresh)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::document::{CurveDisplay, Edit};

    #[test]
    fn a_curve_is_measured_again_when_it_changes_and_not_before() {
        let points = [[0.0, 0.0], [1.0, 3.0], [2.0, -3.0], [3.0, 0.0]].map(DVec2::from).to_vec();
        let space = SplineSpace::from_breaks(3, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let curve = Nurbs::polynomial(space, points).unwrap();
        let mut document = Document::new();
        let display = CurveDisplay::default();
        document.apply(&Edit::AddCurve { name: "wave".to_owned(), curve, display }).unwrap();
        let object = document.objects()[0].id;
        let measurements = Measurements::default();
        let of = |document: &Document| measurements.of(document.object(object).unwrap());
        let first = of(&document);
        assert_eq!(first.inflections().unwrap().parameters, [0.5], "the wave");
        document.apply(&Edit::RenameObject { object, name: "Wave".to_owned() }).unwrap();
        assert!(Rc::ptr_eq(&first, &of(&document)), "a name is nothing that is measured");
        document.apply(&Edit::SetPoint { object, point: 2, position: DVec2::new(2.0, 3.0) }).unwrap();
        assert_eq!(of(&document).inflections().unwrap().parameters, [0.0; 0], "the arch");
        measurements.tidy(&Document::new());
        assert!(measurements.0.borrow().is_empty(), "gone with its object");
    }

    #[test]
    fn another_line_has_other_crossings() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let mut document = Document::new();
        let display = CurveDisplay::default();
        document.apply(&Edit::AddCurve { name: "circle".to_owned(), curve: circle, display }).unwrap();
        let measured = Measured::new(&document.objects()[0]);
        let found = |y: f64| {
            let ends = [DVec2::new(-2.0, y), DVec2::new(2.0, y)];
            measured.crossings(ends).unwrap().probe.as_ref().unwrap().curve.len()
        };
        assert_eq!((found(0.3), found(0.3), found(3.0), found(0.4)), (2, 2, 0, 2), "crossings");
    }
}
