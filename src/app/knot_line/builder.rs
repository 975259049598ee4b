//! The builder of section 4.1: one B-spline as the sum of two of lower degree, each times its linear factor,
//! `bᵈⱼ = γᵈⱼ bᵈ⁻¹ⱼ + (1 − γᵈⱼ₊₁) bᵈ⁻¹ⱼ₊₁`, from degree 0 up to `n`, with a slider that puts one part upon the other.

use eframe::egui::{
    Align2, Color32, FontId, Mesh, Pos2, Response, RichText, Role, Shape, Slider, Stroke, Ui, pos2, vec2,
};

use crate::app::BASIS_BUILDER;
use crate::app::hands::arrow_keys;
use crate::app::knot_line::hand::raised;
use crate::app::knot_line::pyramid::Pyramid;
use crate::app::knot_line::{Scene, plot};
use crate::app::lab::{BasisBuilder, Hovered, Lab};
use crate::app::number_text::compact;
use crate::app::painter::color32;

/// A function is under the pointer within this distance in points.
const REACH: f32 = 7.0;

/// `b` with degree above and index below.
fn name(degree: usize, index: usize) -> String {
    format!("b{}{}", raised(degree), lowered(index))
}

fn lowered(number: usize) -> String {
    let digit = |digit: u8| char::from_u32(0x2080 + u32::from(digit - b'0')).unwrap_or('?');
    number.to_string().bytes().map(digit).collect()
}

/// Opens or shuts the builder, which the document remembers with its panels.
pub(super) fn toggle(lab: &mut Lab) {
    let open = lab.knots.builder.is_none();
    lab.view.panels.insert(BASIS_BUILDER.to_owned(), open);
    follow_panel(lab);
}

/// Opens or shuts the builder as the panels of the document say.
pub(super) fn follow_panel(lab: &mut Lab) {
    let open = lab.view.panels.get(BASIS_BUILDER).copied().unwrap_or(false);
    if !open {
        lab.knots.builder = None;
    } else if lab.knots.builder.is_none() {
        lab.knots.builder = opened(lab);
    }
}

/// The builder as it opens: with the selected control point's B-spline, else with the largest at t.
fn opened(lab: &Lab) -> Option<BasisBuilder> {
    let (object, curve) = lab.selection.object.zip(lab.curve())?;
    let active = super::basis::active(curve, lab.parameter(object)?);
    let largest =
        active.coefficients.iter().zip(&active.values).max_by(|a, b| a.1.total_cmp(b.1)).map(|(&k, _)| k);
    let spline = lab.selection.points.first().copied().or(largest)?;
    Some(BasisBuilder { spline, degree: curve.degree(), part: 0, slide: 1.0 })
}

/// Brings the choices into the range that the curve has; one selected control point chooses its B-spline.
pub(super) fn tidy(lab: &mut Lab, scene: &Scene) {
    let selected = lab.selection.points.first().copied().filter(|_| lab.selection.points.len() == 1);
    let Some(builder) = &mut lab.knots.builder else { return };
    let space = scene.curve.space();
    builder.spline = selected.unwrap_or(builder.spline).min(space.dimension() - 1);
    builder.degree = builder.degree.min(space.degree());
    builder.part = builder.part.min(space.degree() - builder.degree);
    builder.slide = builder.slide.clamp(0.0, 1.0);
}

/// The choices, in a row.
pub(super) fn controls(lab: &mut Lab, ui: &mut Ui, count: usize, degree: usize) {
    let Some(mut builder) = lab.knots.builder.clone() else { return };
    let before = builder.spline;
    ui.label("B-spline");
    for (text, label, by) in [("\u{25c0}", "B-spline before", -1_isize), ("\u{25b6}", "Next B-spline", 1)] {
        if by > 0 {
            ui.label(RichText::new(builder.spline.to_string()).strong());
        }
        let next = builder.spline.checked_add_signed(by).filter(|&k| k < count);
        let button = ui.add_enabled(next.is_some(), eframe::egui::Button::new(text).small());
        button.widget_info(|| eframe::egui::WidgetInfo::labeled(Role::Button, next.is_some(), label));
        if let Some(next) = next.filter(|_| button.on_hover_text(label).clicked()) {
            builder.spline = next;
        }
    }
    ui.label("degree");
    ui.spacing_mut().item_spacing.x = 2.0;
    for level in 0..=degree {
        let button = ui.selectable_label(builder.degree == level, level.to_string());
        button.widget_info(|| {
            let on = builder.degree == level;
            eframe::egui::WidgetInfo::selected(
                Role::RadioButton,
                true,
                on,
                format!("Degree {level} of the builder"),
            )
        });
        if button.on_hover_text("Click a curve to see what it is made of").clicked() {
            builder.part = builder.part.min(degree - level);
            builder.degree = level;
        }
    }
    ui.spacing_mut().item_spacing.x = 8.0;
    if builder.degree > 0 {
        ui.label("slide");
        ui.spacing_mut().slider_width = 70.0;
        let slider = Slider::new(&mut builder.slide, 0.0..=1.0).show_value(false);
        ui.add(slider)
            .accessible_name("Slide together")
            .on_hover_text("Left: both parts stand on the axis; right: one upon the other, which is the sum");
    }
    if builder.spline != before {
        lab.selection.points.clear();
        builder.part = 0;
    }
    lab.knots.builder = Some(builder);
}

/// Arrow keys, while no point and no knot is selected: up and down change the degree, left and right the function.
pub(super) fn keys(lab: &mut Lab, ui: &Ui, count: usize, degree: usize) {
    if !lab.selection.points.is_empty() || lab.selection.knot.is_some() {
        return;
    }
    let Some(builder) = &mut lab.knots.builder else { return };
    for (direction, _) in arrow_keys(ui) {
        let step = |value: usize, by: f64, last: usize| value.saturating_add_signed(by as isize).min(last);
        builder.degree = step(builder.degree, direction.y, degree);
        if builder.degree < degree {
            builder.part = step(builder.part, direction.x, degree - builder.degree);
        } else {
            builder.spline = step(builder.spline, direction.x, count - 1);
        }
    }
}

/// Shows the builder in place of the basis.
pub(super) fn show(lab: &Lab, ui: &Ui, scene: &Scene) {
    let Some(builder) = lab.knots.builder.clone() else { return };
    let pyramid = Pyramid::new(scene.curve.space(), builder.spline);
    if pyramid.knots.len() < pyramid.degree + 2 {
        return;
    }
    let colors = Colors::new(lab, builder.spline);
    others(lab, ui, scene, &pyramid, &builder);
    if builder.degree == 0 {
        let muted = color32(lab.theme.muted_text);
        let text =
            format!("{} = 1 on its knot interval, 0 elsewhere", name(0, builder.spline + builder.part));
        curve(ui, scene, &pyramid, (0, builder.part), Stroke::new(colors.width * 2.2, colors.sum));
        line_of_text(lab, ui, scene, pyramid.support(), 0, &[(text, muted)]);
    } else {
        decomposition(lab, ui, scene, &pyramid, &builder, &colors);
    }
}

/// One colour for the sum, the one that the B-spline has everywhere, and two for its parts.
struct Colors {
    sum: Color32,
    parts: [Color32; 2],
    width: f32,
}

impl Colors {
    fn new(lab: &Lab, spline: usize) -> Self {
        // Neighbours in the palette are told apart by everybody.
        let parts = [1, 2].map(|step| Scene::color(lab, spline + step));
        Self { sum: Scene::color(lab, spline), parts, width: lab.theme.stroke_scale as f32 }
    }
}

/// All functions of the degree, pale.
fn others(lab: &Lab, ui: &Ui, scene: &Scene, pyramid: &Pyramid, builder: &BasisBuilder) {
    let pale =
        Stroke::new(1.2 * lab.theme.stroke_scale as f32, color32(lab.theme.muted_text).gamma_multiply(0.45));
    for i in 0..=pyramid.degree - builder.degree {
        if i != builder.part {
            curve(ui, scene, pyramid, (builder.degree, i), pale);
        }
    }
}

fn curve(ui: &Ui, scene: &Scene, pyramid: &Pyramid, (degree, i): (usize, usize), pen: Stroke) {
    let points = pyramid.samples(i, i + degree + 1).into_iter();
    let line = points.map(|x| at(scene, x, pyramid.value(degree, i, x))).collect();
    painter(ui, scene).add(Shape::line(line, pen));
}

fn at(scene: &Scene, x: f64, value: f64) -> Pos2 {
    pos2(scene.axis.x(x), scene.y(value))
}

fn painter(ui: &Ui, scene: &Scene) -> eframe::egui::Painter {
    ui.painter_at(scene.plot.expand2(vec2(0.0, 2.0)))
}

fn decomposition(
    lab: &Lab,
    ui: &Ui,
    scene: &Scene,
    pyramid: &Pyramid,
    builder: &BasisBuilder,
    colors: &Colors,
) {
    let (d, i) = (builder.degree, builder.part);
    let painter = painter(ui, scene);
    let samples = pyramid.samples(i, i + d + 1);
    let lift = |x: f64| builder.slide * pyramid.parts(d, i, x)[0];
    let zero = |_: f64| 0.0;
    band(
        &painter,
        scene,
        &samples,
        zero,
        |x| pyramid.parts(d, i, x)[0],
        colors.parts[0].gamma_multiply(0.45),
    );
    band(
        &painter,
        scene,
        &samples,
        lift,
        |x| lift(x) + pyramid.parts(d, i, x)[1],
        colors.parts[1].gamma_multiply(0.45),
    );
    for (part, color) in colors.parts.iter().enumerate() {
        let (lower, upper) = (pyramid.knots[i + part], pyramid.knots[i + part + d]);
        curve(ui, scene, pyramid, (d - 1, i + part), Stroke::new(1.3 * colors.width, *color));
        if lower < upper {
            // The factor: from 0 to 1 over the support, or from 1 to 0.
            let values = if part == 0 { [0.0, 1.0] } else { [1.0, 0.0] };
            let ends = [at(scene, lower, values[0]), at(scene, upper, values[1])];
            painter.extend(Shape::dashed_line(&ends, Stroke::new(1.1 * colors.width, *color), 5.0, 4.0));
        }
    }
    curve(ui, scene, pyramid, (d, i), Stroke::new(2.4 * colors.width, colors.sum));
    words(lab, ui, scene, pyramid, builder, colors);
}

/// The ground between two graphs.
fn band(
    painter: &eframe::egui::Painter,
    scene: &Scene,
    samples: &[f64],
    low: impl Fn(f64) -> f64,
    high: impl Fn(f64) -> f64,
    color: Color32,
) {
    let mut mesh = Mesh::default();
    for (index, &x) in samples.iter().enumerate() {
        mesh.colored_vertex(at(scene, x, low(x)), color);
        mesh.colored_vertex(at(scene, x, high(x)), color);
        if index > 0 {
            let first = 2 * index as u32 - 2;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// The recurrence with its names, and with its numbers at t.
fn words(lab: &Lab, ui: &Ui, scene: &Scene, pyramid: &Pyramid, builder: &BasisBuilder, colors: &Colors) {
    let (d, i) = (builder.degree, builder.part);
    let index = builder.spline + i;
    let ink = color32(lab.theme.text);
    let formula = [
        (name(d, index), colors.sum),
        (" = ".to_owned(), ink),
        (format!("\u{3b3}{}\u{b7}{}", lowered(index), name(d - 1, index)), colors.parts[0]),
        (" + ".to_owned(), ink),
        (
            format!("(1 \u{2212} \u{3b3}{})\u{b7}{}", lowered(index + 1), name(d - 1, index + 1)),
            colors.parts[1],
        ),
    ];
    line_of_text(lab, ui, scene, pyramid.support(), 0, &formula);
    let t = scene.t;
    if t < pyramid.knots[i] || t > pyramid.knots[i + d + 1] {
        return;
    }
    let factors = [pyramid.factor(d, i, t), 1.0 - pyramid.factor(d, i + 1, t)];
    let lower = [pyramid.value(d - 1, i, t), pyramid.value(d - 1, i + 1, t)];
    let product = |part: usize| format!("{}\u{b7}{}", compact(factors[part]), compact(lower[part]));
    let numbers = [
        (compact(pyramid.value(d, i, t)), colors.sum),
        (" = ".to_owned(), ink),
        (product(0), colors.parts[0]),
        (" + ".to_owned(), ink),
        (product(1), colors.parts[1]),
        ("   at t".to_owned(), color32(lab.theme.muted_text)),
    ];
    line_of_text(lab, ui, scene, pyramid.support(), 1, &numbers);
    let painter = painter(ui, scene);
    let parts = pyramid.parts(d, i, t);
    let rim = Stroke::new(1.2, color32(lab.theme.background));
    painter.circle(at(scene, t, parts[0]), 3.5, colors.parts[0], rim);
    painter.circle(at(scene, t, builder.slide * parts[0] + parts[1]), 3.5, colors.parts[1], rim);
    painter.circle(at(scene, t, parts[0] + parts[1]), 4.5, colors.sum, rim);
}

/// Coloured words in a row, at the upper corner of the plot that the B-spline leaves more room.
fn line_of_text(
    lab: &Lab,
    ui: &Ui,
    scene: &Scene,
    support: [f64; 2],
    row: usize,
    words: &[(String, Color32)],
) {
    let painter = painter(ui, scene);
    let scale = lab.theme.text_scale as f32;
    let mut job = eframe::egui::text::LayoutJob::default();
    for (word, color) in words {
        let format = eframe::egui::TextFormat {
            font_id: FontId::proportional(13.0 * scale),
            color: *color,
            ..Default::default()
        };
        job.append(word, 0.0, format);
    }
    let galley = painter.layout_job(job);
    let down = 4.0 + 19.0 * scale * row as f32;
    let [before, after] =
        [scene.axis.x(support[0]) - scene.plot.left(), scene.plot.right() - scene.axis.x(support[1])];
    let place = if before > after {
        Align2::LEFT_TOP.anchor_size(scene.plot.left_top() + vec2(10.0, down), galley.size())
    } else {
        Align2::RIGHT_TOP.anchor_size(scene.plot.right_top() + vec2(-10.0, down), galley.size())
    };
    painter.rect_filled(place.expand2(vec2(4.0, 1.0)), 3.0, ui.visuals().panel_fill.gamma_multiply(0.85));
    painter.galley(place.min, galley, ui.visuals().text_color());
}

/// A click on a function of the degree chooses it; elsewhere it sets t as on the basis. `response` is the area of the whole knot line.
pub(super) fn interact(lab: &mut Lab, scene: &Scene, response: &Response) {
    let Some(builder) = lab.knots.builder.clone() else { return };
    let pyramid = Pyramid::new(scene.curve.space(), builder.spline);
    let pointer = response.hover_pos().filter(|&at| scene.plot.contains(at));
    let near = pointer.and_then(|pointer| {
        let x = scene.axis.parameter(pointer.x);
        let distance = |i: usize| (scene.y(pyramid.value(builder.degree, i, x)) - pointer.y).abs();
        (0..=pyramid.degree - builder.degree)
            .filter(|&i| pyramid.value(builder.degree, i, x) > 0.01 && distance(i) <= REACH)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
    });
    if near.is_some() && response.hovered() {
        lab.hovering = Hovered::Point(scene.object, builder.spline);
    }
    match near {
        Some(part) if response.clicked() => {
            lab.knots.builder = Some(BasisBuilder { part, ..builder });
        }
        _ => plot::set_t(lab, scene, response),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_their_degree_above_and_their_index_below() {
        assert_eq!(name(3, 12), "b\u{b3}\u{2081}\u{2082}", "a cubic");
    }
}
