//! Undo and redo are exact, whatever was done.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use glam::{DMat2, DVec2};
use spline_lab::core::bspline::SplineSpace;
use spline_lab::core::spline_curve::{KnotRule, Nurbs};
use spline_lab::document::{
    CurveDisplay, Document, Edit, History, ObjectId, PointLabels, View, first_scene, to_json,
};

/// Xorshift, G. Marsaglia 2003: the same numbers on every machine.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }

    /// In [0, 1).
    fn number(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self) -> DVec2 {
        DVec2::new(self.number() * 10.0 - 5.0, self.number() * 8.0 - 4.0)
    }

    fn indices(&mut self, count: usize) -> Vec<usize> {
        (0..=self.below(3)).map(|_| self.below(count + 1)).collect()
    }

    fn curve(&mut self) -> Nurbs<DVec2> {
        let degree = 1 + self.below(4);
        let count = degree + 1 + self.below(6);
        let points = (0..count).map(|_| self.point()).collect();
        let weights = (0..count).map(|_| 0.25 + self.number()).collect();
        let space = if self.below(2) == 0 {
            SplineSpace::periodic(degree, count as f64, (0..count).map(|k| k as f64).collect())
        } else {
            SplineSpace::new(degree, (0..=count + degree).map(|k| k as f64).collect())
        };
        Nurbs::new(space.unwrap(), points, weights).unwrap()
    }

    /// An edit, one in four or so impossible.
    fn edit(&mut self, document: &Document, depth: usize) -> Edit {
        let object = match document.objects().get(self.below(document.len() + 1)) {
            Some(object) if self.below(40) > 0 => object.id,
            _ => ObjectId(self.next() % 50),
        };
        let curve = document.curve(object);
        let count = curve.map_or(3, |curve| curve.points().len());
        let (left, right) = curve.map_or((0.0, 1.0), |curve| curve.space().parameter_interval());
        let knots = curve.map_or(vec![0.0, 1.0], |curve| curve.space().knots().to_vec());
        let at = left + (right - left) * (self.number() * 1.1 - 0.05);
        let old = knots[self.below(knots.len())];
        // Documents that only grow make the test slow.
        let mut kind = self.below(34);
        if count > 40 && (kind == 13 || kind == 17) {
            kind = 22;
        }
        if document.len() > 12 && (kind == 0 || kind == 2) {
            kind = 1;
        }
        match kind {
            0 => Edit::AddCurve {
                name: format!("Curve {}", self.below(100)),
                curve: self.curve(),
                display: CurveDisplay::default(),
            },
            1 => Edit::RemoveObjects { objects: vec![object] },
            2 => Edit::DuplicateObject { object },
            3 => Edit::RenameObject { object, name: ["Kite", "Fish", "", "Boat"][self.below(4)].to_owned() },
            4 => Edit::ReorderObject { object, to: self.below(document.len() + 1) },
            5 => Edit::SetVisible { object, visible: self.below(2) == 0 },
            6 => {
                let width = self.number() * 4.0 - 0.5;
                Edit::SetDisplay {
                    object,
                    display: CurveDisplay { width, labels: PointLabels::Weight, ..CurveDisplay::default() },
                }
            }
            7 => Edit::MovePoints { object, points: self.indices(count), delta: self.point() },
            8 => Edit::SetPoint { object, point: self.below(count + 1), position: self.point() },
            9 => Edit::SetPoints { object, positions: (0..count).map(|_| self.point()).collect() },
            10 => Edit::SetWeight { object, point: self.below(count), weight: self.number() * 3.0 - 0.3 },
            11 => Edit::SetWeights { object, weights: (0..count).map(|_| self.number() + 0.1).collect() },
            12 => Edit::InsertKnot { object, at },
            13 => Edit::RefineUniformly { object },
            14 => Edit::RemoveKnot { object, at: old },
            15 => Edit::MoveKnot { object, knot: self.below(knots.len() + 1), to: at },
            16 => Edit::MoveDistinctKnot { object, at: old, to: old + self.number() - 0.5 },
            17 => Edit::ElevateDegree { object },
            18 => Edit::ReduceDegree { object },
            19 => Edit::SetDegree { object, degree: self.below(8) },
            20 => Edit::SetClosed { object, closed: self.below(2) == 0 },
            21 => Edit::InsertPoint { object, before: self.below(count + 2), position: self.point() },
            22 => Edit::DeletePoints { object, points: self.indices(count) },
            23 => Edit::AppendPoint { object, position: self.point() },
            24 => Edit::Reverse { object },
            25 => Edit::TransformPoints {
                object,
                points: self.indices(count),
                matrix: DMat2::from_angle(self.number()),
                about: self.point(),
            },
            26 => Edit::ReplaceCurve { object, curve: self.curve(), label: "Draw again".to_owned() },
            27 => Edit::SetKnots { object, knots: knots.iter().map(|knot| 2.0 * knot).collect() },
            28 => Edit::GenerateKnots { object, rule: KnotRule::ALL[self.below(5)] },
            29 => Edit::RemoveKnotsWithin { object, tolerance: self.number() - 0.1 },
            30 => {
                let edit = Edit::MoveKnot { object, knot: self.below(knots.len()), to: at };
                Edit::KeepCurve { edit: Box::new(edit) }
            }
            31 => Edit::MoveCurveAt { object, at, delta: self.point() },
            32 => Edit::MoveEditPoint { object, point: self.below(count + 1), delta: self.point() },
            _ if depth < 2 => {
                let edits = (0..self.below(4)).map(|_| self.edit(document, depth + 1)).collect();
                Edit::Batch { label: "Several".to_owned(), edits }
            }
            _ => Edit::AppendPoint { object, position: self.point() },
        }
    }
}

/// Every bit of a document: the file's text tells all numbers apart, −0 and 0 too.
fn text(document: &Document) -> String {
    to_json(document, &View::default())
}

#[test]
fn ten_thousand_edits_and_undos_return_to_the_start_exactly() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let (start, _) = first_scene();
    let mut history = History::new(start.clone()).with_budget(usize::MAX);
    let (mut done, mut refused, mut undone) = (0, 0, 0);
    for step in 0..10_000 {
        if random.below(5) == 0 {
            let before = text(history.document());
            if history.undo().is_some() {
                undone += 1;
                // Half of the steps are done again: exactly.
                if random.below(2) == 0 {
                    history.redo();
                    assert!(text(history.document()) == before, "step {step}: undo and redo");
                }
            }
            continue;
        }
        let before = history.document().clone();
        let edit = random.edit(&before, 0);
        let interaction = random.below(4) == 0;
        if interaction {
            history.begin("Drag");
            // What was tried on the way leaves no trace.
            let _ = history.update(random.edit(&before, 0));
        }
        let result = if interaction { history.update(edit.clone()) } else { history.apply(edit.clone()) };
        match result {
            Ok(_) => done += 1,
            Err(error) => {
                refused += 1;
                if interaction {
                    history.cancel();
                }
                assert!(
                    text(history.document()) == text(&before),
                    "step {step}: {edit:?} failed with {error}"
                );
            }
        }
        history.commit();
    }
    assert!(done > 4000 && refused > 500 && undone > 1000, "{done} done, {refused} refused, {undone} undone");
    let end = text(history.document());
    let (steps, _) = history.steps();
    while history.undo().is_some() {}
    assert!(text(history.document()) == text(&start), "back at the start after {steps} steps");
    for _ in 0..steps {
        history.redo();
    }
    assert!(text(history.document()) == end, "at the end again after {steps} steps");
}

fn scene() -> (History, ObjectId) {
    let (document, _) = first_scene();
    let object = document.objects()[0].id;
    (History::new(document), object)
}

fn place(object: ObjectId, x: f64) -> Edit {
    Edit::SetPoint { object, point: 0, position: DVec2::new(x, 0.0) }
}

#[test]
fn a_drag_is_one_step_and_starts_from_its_beginning() {
    let (mut history, object) = scene();
    let before = history.document().curve(object).unwrap().points()[0];
    history.begin("Move point");
    for k in 1..=5 {
        let delta = DVec2::new(f64::from(k), 0.0);
        history.update(Edit::MovePoints { object, points: vec![0], delta }).unwrap();
    }
    assert!(history.is_interacting(), "not yet released");
    history.commit();
    let after = history.document().curve(object).unwrap().points()[0];
    assert_eq!(after, before + DVec2::new(5.0, 0.0), "the last update counts, updates do not add up");
    assert_eq!(history.steps(), (1, 0), "one step");
    assert_eq!(history.undo().as_deref(), Some("Move point"), "its name");
    assert_eq!(history.document().curve(object).unwrap().points()[0], before, "back");
}

#[test]
fn what_changes_nothing_is_no_step() {
    let (mut history, object) = scene();
    let here = history.document().curve(object).unwrap().points()[0];
    let revision = history.revision();
    history.apply(Edit::SetPoint { object, point: 0, position: here }).unwrap();
    history.begin("Drag");
    history.update(place(object, 9.0)).unwrap();
    history.update(Edit::MovePoints { object, points: vec![0], delta: DVec2::ZERO }).unwrap();
    history.commit();
    assert_eq!(history.steps(), (0, 0), "nothing to undo");
    assert!(!history.is_modified(), "nothing to save");
    assert!(history.revision() > revision, "the drag was visible for a moment");
}

#[test]
fn a_cancelled_drag_leaves_no_trace_and_keeps_what_can_be_redone() {
    let (mut history, object) = scene();
    history.apply(place(object, 1.0)).unwrap();
    history.undo();
    let before = text(history.document());
    history.begin("Drag");
    history.update(place(object, 2.0)).unwrap();
    history.cancel();
    assert_eq!(text(history.document()), before, "as before");
    assert_eq!(history.redo_name(), Some("Move point 0"), "redo survives");
}

#[test]
fn undoing_back_to_the_saved_state_counts_as_saved() {
    let (mut history, object) = scene();
    history.apply(place(object, 1.0)).unwrap();
    history.mark_saved();
    assert!(!history.is_modified(), "just saved");
    history.apply(place(object, 2.0)).unwrap();
    assert!(history.is_modified(), "moved");
    history.undo();
    assert!(!history.is_modified(), "back at the saved state");
    history.undo();
    assert!(history.is_modified(), "before the saved state");
}

#[test]
fn the_byte_budget_forgets_the_oldest_steps_only() {
    let (history, object) = scene();
    let mut history = history.with_budget(20_000);
    for k in 0..1000 {
        history.apply(place(object, f64::from(k))).unwrap();
    }
    let (done, _) = history.steps();
    assert!((2..200).contains(&done), "{done} steps of about 1 kB in 20 kB");
    for k in (0..999).rev().take(done) {
        history.undo();
        let x = history.document().curve(object).unwrap().points()[0].x;
        assert_eq!(x, f64::from(k), "step by step back");
    }
    let mut tiny = scene().0.with_budget(0);
    tiny.apply(place(object, 1.0)).unwrap();
    tiny.apply(place(object, 2.0)).unwrap();
    assert_eq!(tiny.steps(), (1, 0), "the last step can always be undone");
}
