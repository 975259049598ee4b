//! The conic of the quadratic piece at the parameter: its equation, its kind, its centre, axes and foci, and the middle weight of a single arc.

use eframe::egui::{Grid, RichText, Ui};
use glam::DVec2;

use crate::app::inspector::Subject;
use crate::app::inspector::measurements::copyable;
use crate::app::lab::Lab;
use crate::app::number_field::{self, Drag, NumberField, positive};
use crate::core::rational_bezier::{Conic, ConicKind, RationalBezier};
use crate::core::spline_curve::Nurbs;
use crate::document::Edit;

/// Longer curves are not divided into pieces in every frame.
const MOST_POINTS: usize = 600;

/// A name, a hint, numbers.
type Row = (&'static str, &'static str, Vec<f64>);

/// The quadratic piece of the curve at `t`; `None` for other degrees, and for very long curves.
pub(super) fn piece(curve: &Nurbs<DVec2>, t: f64) -> Option<RationalBezier<DVec2>> {
    if curve.degree() != 2 || curve.points().len() > MOST_POINTS {
        return None;
    }
    let pieces = curve.rational_bezier_curves().ok()?;
    let found = pieces.iter().position(|piece| t < piece.interval().1).unwrap_or(pieces.len() - 1);
    pieces.into_iter().nth(found)
}

/// Shows what is known of the conic.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject, piece: &RationalBezier<DVec2>) {
    weight(lab, ui, subject);
    let conic = match piece.conic() {
        Ok(conic) => conic.normalised(),
        Err(error) => {
            ui.label(RichText::new(format!("No conic: {error}.")).weak());
            return;
        }
    };
    ui.horizontal(|ui| {
        ui.label("Kind");
        ui.label(RichText::new(conic.kind().label()).strong());
    });
    Grid::new("conic").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for (name, hint, numbers) in rows(&conic) {
            ui.label(name).on_hover_text(hint);
            if numbers.len() > 2 {
                // Three numbers to a line.
                ui.vertical(|ui| numbers.chunks(3).for_each(|part| copyable(lab, ui, name, part)));
            } else {
                copyable(lab, ui, name, &numbers);
            }
            ui.end_row();
        }
    });
}

/// The middle weight of a single arc in standard form, `w₁/√(w₀w₂)`, to be typed and dragged.
fn weight(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let (object, curve) = (subject.object, subject.curve);
    let (&[a, b, c], &[u, v, w]) = (curve.points(), curve.weights()) else { return };
    if curve.space().is_periodic() {
        return;
    }
    let scale = (u * w).sqrt();
    let set = move |standard: f64| Edit::SetWeight { object, point: 1, weight: standard * scale };
    ui.horizontal_wrapped(|ui| {
        ui.label("Middle weight").on_hover_text("w₁/√(w₀w₂): below 1 ellipse, 1 parabola, above 1 hyperbola");
        let field = NumberField::new("Middle weight in standard form", v / scale).width(64.0);
        let field = field.drag(Drag::Factor).check(positive).show(ui, ("standard weight", object));
        number_field::apply(lab, field.event, "Change middle weight", |_, standard| set(standard));
        if ui.button("Parabola").on_hover_text("Middle weight 1").clicked() {
            lab.edit(set(1.0));
        }
        if let Some(circle) = circle_weight(a, b, c)
            && ui.button("Circle").on_hover_text("The cosine of half the angle of the arc").clicked()
        {
            lab.edit(set(circle));
        }
    });
}

/// The standard middle weight that makes the arc a circle; `None` unless both legs are equally long and turn.
fn circle_weight(a: DVec2, b: DVec2, c: DVec2) -> Option<f64> {
    let (first, second) = (a.distance(b), b.distance(c));
    let weight = 0.5 * a.distance(c) / first;
    let is_isosceles = (first - second).abs() <= 1e-9 * first.max(second);
    (is_isosceles && (1e-9..1.0 - 1e-12).contains(&weight)).then_some(weight)
}

fn rows(conic: &Conic) -> Vec<Row> {
    let mut rows: Vec<Row> = vec![
        (
            "Equation",
            "a₁₁ x² + 2a₁₂ xy + 2a₁₃ x + a₂₂ y² + 2a₂₃ y + a₃₃ = 0: a₁₁, a₁₂, a₁₃, a₂₂, a₂₃, a₃₃",
            conic.coefficients().to_vec(),
        ),
        (
            "Discriminant",
            "a₁₁a₂₂ − a₁₂²: positive for ellipses, 0 for parabolas, negative for hyperbolas",
            vec![conic.discriminant()],
        ),
    ];
    if let Ok(axes) = conic.axes() {
        let [long, short] = axes.lengths;
        rows.push(("Centre", "The point of symmetry", axes.center.to_array().to_vec()));
        rows.push((
            "Half axes",
            "Of an ellipse the longer one first, of a hyperbola that between the vertices",
            vec![long, short],
        ));
        let ratio = short / long;
        let eccentricity = match conic.kind() {
            ConicKind::Ellipse => Some((1.0 - ratio * ratio).max(0.0).sqrt()),
            ConicKind::Hyperbola => Some((1.0 + ratio * ratio).sqrt()),
            _ => None,
        };
        rows.extend(eccentricity.map(|value| {
            ("Eccentricity", "0 for a circle, below 1 for ellipses, above 1 for hyperbolas", vec![value])
        }));
    }
    if let Ok(foci) = conic.foci() {
        let names = ["Focus", "Other focus"];
        rows.extend(
            names.iter().zip(foci).map(|(&name, at)| (name, "Where the rays meet", at.to_array().to_vec())),
        );
    }
    rows
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::app::test_bench;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::document::{CurveDisplay, Edit};

    fn lab_with(points: [[f64; 2]; 3], weights: [f64; 3]) -> Lab {
        let mut lab = test_bench::lab();
        let space = SplineSpace::from_breaks(2, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let curve = Nurbs::new(space, points.map(DVec2::from).to_vec(), weights.to_vec()).unwrap();
        let add = Edit::AddCurve { name: "Arc".to_owned(), curve, display: CurveDisplay::default() };
        lab.selection.object = lab.edit(add).unwrap().created.first().copied();
        lab
    }

    fn kind(lab: &Lab) -> ConicKind {
        piece(lab.curve().unwrap(), 0.5).unwrap().conic().unwrap().kind()
    }

    #[test]
    fn a_typed_weight_changes_the_kind_and_the_button_makes_a_circle() {
        let lab = lab_with([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [2.0, 1.0, 2.0]);
        assert_eq!(kind(&lab), ConicKind::Ellipse, "weight 1/2 in standard form");
        let mut window = test_bench::window(lab, (280.0, 1400.0), crate::app::inspector::show);
        assert!(window.query_by_label("ellipse").is_some(), "the kind is told");
        test_bench::type_into(&mut window, "Middle weight in standard form", "2");
        assert_eq!(window.state().curve().unwrap().weights(), [2.0, 4.0, 2.0], "w₁ = 2 √(w₀w₂)");
        assert_eq!(kind(window.state()), ConicKind::Hyperbola, "above 1");
        window.get_by_label("Circle").click();
        window.run();
        let curve = window.state().curve().unwrap();
        let worst = (0..=20).map(|i| curve.evaluate(f64::from(i) / 20.0).unwrap().length() - 1.0);
        assert!(worst.map(f64::abs).fold(0.0, f64::max) < 1e-14, "a circle about the origin");
        window.get_by_label("Parabola").click();
        window.run();
        assert_eq!(kind(window.state()), ConicKind::Parabola, "weight 1");
    }

    #[test]
    fn an_ellipse_has_its_centre_axes_and_foci() {
        let lab = lab_with([[5.0, 0.0], [5.0, 3.0], [0.0, 3.0]], [1.0, 0.5_f64.sqrt(), 1.0]);
        let conic = piece(lab.curve().unwrap(), 0.5).unwrap().conic().unwrap().normalised();
        let rows = rows(&conic);
        let row = |name: &str| rows.iter().find(|row| row.0 == name).unwrap().2.clone();
        let near = |found: Vec<f64>, expected: &[f64]| {
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        assert!(near(row("Centre"), &[0.0, 0.0]) && near(row("Half axes"), &[5.0, 3.0]), "{rows:?}");
        assert!(near(row("Eccentricity"), &[0.8]) && row("Focus")[0].abs() - 4.0 < 1e-12, "{rows:?}");
        assert_eq!(
            circle_weight(DVec2::X, DVec2::ONE, DVec2::new(0.0, 3.0)),
            None,
            "legs of different lengths"
        );
    }
}
