//! Documents that come with the program.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec2;

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::spline_curve::Nurbs;
use crate::document::contents::Document;
use crate::document::display::{CurveDisplay, PointLabels};
use crate::document::edit::Edit;
use crate::document::edit_error::EditError;
use crate::document::object::ObjectId;
use crate::document::view::{Camera, View};

/// The first scene: an open cubic with its comb and de Boor's construction, a closed cubic, and a circle with its weights.
pub fn first_scene() -> (Document, View) {
    // The data are constants, and a test builds the scene.
    compose().unwrap_or_default()
}

fn compose() -> Result<(Document, View), EditError> {
    let mut document = Document::new();
    let plain = CurveDisplay::default();
    let wave = CurveDisplay { comb: true, comb_scale: 0.3, construction: true, ..plain.clone() };
    let pebble = CurveDisplay { color: 1, pieces: true, ..plain.clone() };
    let circle = CurveDisplay { color: 2, labels: PointLabels::Weight, ..plain };
    add(&mut document, "Circle", self::circle(DVec2::new(3.8, -2.2), 1.1)?, circle)?;
    add(&mut document, "Pebble", self::pebble()?, pebble)?;
    let wave = add(&mut document, "Wave", self::wave()?, wave)?;
    let view = View {
        camera: Camera { center: DVec2::ZERO, scale: 80.0 },
        parameters: BTreeMap::from([(wave, 2.4)]),
        selected_object: Some(wave),
        ..View::default()
    };
    Ok((document, view))
}

fn add(
    document: &mut Document,
    name: &str,
    curve: Nurbs<DVec2>,
    display: CurveDisplay,
) -> Result<ObjectId, EditError> {
    let id = document.next_id();
    document.apply(&Edit::AddCurve { name: name.to_owned(), curve, display })?;
    Ok(id)
}

fn wave() -> Result<Nurbs<DVec2>, SplineError> {
    let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.0, 5.0, 6.0];
    let points = [
        (-5.4, -1.4),
        (-4.4, 1.6),
        (-2.6, 3.0),
        (-1.6, -0.8),
        (0.4, -3.0),
        (1.8, 0.6),
        (3.6, 3.0),
        (5.4, 0.4),
    ];
    Nurbs::polynomial(SplineSpace::new(3, knots)?, points.map(DVec2::from).to_vec())
}

fn pebble() -> Result<Nurbs<DVec2>, SplineError> {
    let space = SplineSpace::periodic(3, 6.0, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0])?;
    let points = [(-0.6, 1.2), (0.8, 0.9), (2.0, 1.7), (1.6, 3.2), (0.2, 3.5), (-0.9, 2.6)];
    Nurbs::polynomial(space, points.map(DVec2::from).to_vec())
}

/// The circle as a closed quadratic with double knots at the quarters. Course: section 6.1.
fn circle(center: DVec2, radius: f64) -> Result<Nurbs<DVec2>, SplineError> {
    let space = SplineSpace::periodic(2, 4.0, vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0])?;
    let corners = [(1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
    let points = corners.map(|(x, y)| center + DVec2::new(f64::from(x), f64::from(y)) * radius);
    let weights = (0..8).map(|k| if k % 2 == 0 { FRAC_1_SQRT_2 } else { 1.0 }).collect();
    Nurbs::new(space, points.to_vec(), weights)
}
