//! The whole curve in numbers, and the joint with its nearest neighbour.

use std::collections::HashMap;
use std::sync::Arc;

use eframe::egui::{Grid, Id, RichText, Ui};
use glam::DVec2;

use crate::app::inspector::Subject;
use crate::app::inspector::measurements::copyable;
use crate::app::lab::Lab;
use crate::core::bspline::Side;
use crate::core::quadrature::gauss_legendre;
use crate::core::spline_curve::{ArcLength, Joint, Nurbs};
use crate::document::Object;
use crate::figure::composition::{MANY_FOR_LOOKS, probe, probe_ends};

/// A name, a hint, and numbers or a sentence.
type Row = (&'static str, String, Result<Vec<f64>, String>);

/// What was measured of a curve, and where it meets which others: an object that is edited is another one, and only what it has part in is measured again.
#[derive(Clone)]
struct Measured {
    object: Arc<Object>,
    rows: Arc<[Row]>,
    joints: Arc<[(Arc<Object>, Option<Joint>)]>,
}

impl Measured {
    /// The numbers of `object` beside `objects`, taken from `known` where that still holds.
    fn new(object: &Arc<Object>, objects: &[Arc<Object>], known: Option<Self>) -> Option<Self> {
        let (curve, display) = (object.curve()?, object.curve_display()?);
        let known = known.filter(|known| Arc::ptr_eq(&known.object, object));
        let others = || objects.iter().filter(|other| other.id != object.id && other.visible);
        if let Some(known) = &known
            && known.joints.len() == others().count()
            && known.joints.iter().zip(others()).all(|((a, _), b)| Arc::ptr_eq(a, b))
        {
            return Some(known.clone());
        }
        let before: HashMap<*const Object, Option<Joint>> = known
            .iter()
            .flat_map(|known| known.joints.iter())
            .map(|(other, joint)| (Arc::as_ptr(other), *joint))
            .collect();
        let joint = |other: &Arc<Object>| {
            before
                .get(&Arc::as_ptr(other))
                .copied()
                .unwrap_or_else(|| other.curve().and_then(|other| curve.joint(other).ok()?))
        };
        let joints = others().map(|other| (Arc::clone(other), joint(other))).collect();
        let rows = known.map_or_else(
            || {
                let mut rows = rows(curve);
                if display.probe_line
                    && let Ok(found) = probe(curve, probe_ends(curve, display))
                {
                    let hint = "Crossings of the probe line with curve and control polygon".to_owned();
                    let counts = vec![found.curve.len() as f64, found.polygon as f64];
                    rows.push(("Probe line", hint, Ok(counts)));
                }
                rows.into()
            },
            |known| known.rows,
        );
        Some(Self { object: Arc::clone(object), rows, joints })
    }
}

/// Shows the numbers; they are measured anew only when an object has changed.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    if subject.curve.points().len() > MANY_FOR_LOOKS {
        let sentence = format!("Not measured for more than {MANY_FOR_LOOKS} control points.");
        ui.label(RichText::new(sentence).weak());
        return;
    }
    let id = Id::unique("whole curve").with(subject.object);
    let document = lab.history.document();
    let known = ui.data(|data| data.get_temp::<Measured>(id));
    let measured =
        document.object(subject.object).and_then(|object| Measured::new(object, document.objects(), known));
    let Some(measured) = measured else { return };
    ui.data_mut(|data| data.insert_temp(id, measured.clone()));
    Grid::new("whole curve").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for (name, hint, numbers) in measured.rows.iter().chain(&joint_rows(&measured.joints)) {
            ui.label(*name).on_hover_text(hint);
            match numbers {
                Ok(numbers) => copyable(lab, ui, name, numbers),
                Err(reason) => {
                    ui.label(RichText::new(reason).weak());
                }
            }
            ui.end_row();
        }
    });
}

fn rows(curve: &Nurbs<DVec2>) -> Vec<Row> {
    let size = curve.points().iter().map(|point| point.length()).fold(1e-300, f64::max);
    let words = |error: crate::core::bspline::SplineError| error.to_string();
    let length = ArcLength::new(curve, 1e-10 * size).map(|length| vec![length.total()]);
    let tight = curve.tight_box();
    let corner = |choice: fn(&crate::core::spline_curve::TightBox) -> &Vec<f64>| {
        tight.clone().map(|tight| choice(&tight).clone()).map_err(words)
    };
    let mut rows: Vec<Row> = vec![
        ("Length", "Arc length".to_owned(), length.map_err(words)),
        ("Box from", "Lower left corner of the tight box".to_owned(), corner(|tight| &tight.low)),
        ("Box to", "Upper right corner of the tight box".to_owned(), corner(|tight| &tight.high)),
    ];
    if curve.space().is_periodic() {
        let hint = "Positive if the curve runs counterclockwise".to_owned();
        rows.push(("Signed area", hint, Ok(vec![signed_area(curve)])));
    }
    let count = |count: usize| vec![count as f64];
    let inflections = curve.inflections().map(|found| count(found.parameters.len()));
    let vertices = curve.vertices().map(|found| count(found.vertices.len()));
    rows.push(("Inflections", "Changes of the sign of the curvature".to_owned(), inflections.map_err(words)));
    rows.push((
        "Vertices",
        "Extrema of the curvature, with ends and knots".to_owned(),
        vertices.map_err(words),
    ));
    rows
}

/// `½∮ det(r, r′)`, exact up to rounding for polynomial curves; rational ones by 25 points in each interval.
fn signed_area(curve: &Nurbs<DVec2>) -> f64 {
    let Ok(rule) = gauss_legendre(25) else { return f64::NAN };
    let origin = curve.points()[0];
    let density = |t: f64| {
        curve.derivatives(t, 1, Side::Right).map_or(f64::NAN, |r| 0.5 * (r[0] - origin).perp_dot(r[1]))
    };
    curve.space().breaks().windows(2).map(|ends| rule.integrate(ends[0], ends[1], density)).sum()
}

/// The joint with the open curve whose end is nearest.
fn joint_rows(joints: &[(Arc<Object>, Option<Joint>)]) -> Vec<Row> {
    let joints = joints.iter().filter_map(|(other, joint)| Some((&other.name, (*joint)?)));
    let Some((name, joint)) = joints.min_by(|a, b| a.1.gap.total_cmp(&b.1.gap)) else { return Vec::new() };
    let Joint { at_end, at_other_end, gap, angle, curvature, first, second } = joint;
    let word = |at_end: bool| if at_end { "end" } else { "start" };
    let undefined = || "undefined: the speed is 0".to_owned();
    let angle = angle.map(|angle| vec![angle.to_degrees()]).ok_or_else(undefined);
    let curvature = curvature.map(|curvature| vec![curvature]).ok_or_else(undefined);
    let meeting = format!("{} with the {} of {name}", word(at_end), word(at_other_end));
    vec![
        ("Joint", "The nearest end of another curve".to_owned(), Err(meeting)),
        ("G\u{2070} distance", "Between the ends".to_owned(), Ok(vec![gap])),
        ("G\u{b9} angle \u{b0}", "From tangent to tangent".to_owned(), angle),
        ("G\u{b2} curvature", "Difference of the curvatures".to_owned(), curvature),
        ("C\u{b9} difference", "Of the first derivatives".to_owned(), Ok(vec![first])),
        ("C\u{b2} difference", "Of the second derivatives".to_owned(), Ok(vec![second])),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_has_its_length_box_and_area() {
        let circle = Nurbs::circle(DVec2::new(3.0, 1.0), 2.0).unwrap();
        let rows = rows(&circle);
        let number = |name: &str| rows.iter().find(|row| row.0 == name).unwrap().2.clone().unwrap();
        let pi = std::f64::consts::PI;
        assert!((number("Length")[0] - 4.0 * pi).abs() < 1e-8, "{:?}", number("Length"));
        assert!((number("Signed area")[0] - 4.0 * pi).abs() < 1e-9, "{:?}", number("Signed area"));
        assert!((number("Box to")[0] - 5.0).abs() < 1e-12, "{:?}", number("Box to"));
        assert_eq!(number("Inflections"), [0.0], "a circle turns one way");
    }
}
