//! The list of methods: shown or not, their settings, their errors.

use std::sync::Arc;

use eframe::egui::{Button, Frame, RichText, Role, Slider, Ui, WidgetInfo};

use crate::app::approximation::changes::{change, change_method, set};
use crate::app::lab::Lab;
use crate::app::number_field::{NumberEvent, NumberField};
use crate::app::number_text::{full, parse_list};
use crate::app::painter::color32;
use crate::app::text_field::TextField;
use crate::core::approximation::smoothing_by_cross_validation;
use crate::document::{
    Approximation, CubicEnds, DataError, KnotChoice, MAX_DEGREE, Method, ObjectId, Scheme,
};
use crate::figure::approximation::{Analysis, Fit, error_text};

/// Longest list of knots that is shown as text.
const MOST_KNOTS: usize = 200;
/// The logarithms of λ that the slider reaches.
const LOG_LAMBDA: std::ops::RangeInclusive<f64> = -9.0..=3.0;

/// Shows the list.
pub(super) fn show(
    approximation: &Approximation,
    analysis: &Analysis,
    lab: &mut Lab,
    ui: &mut Ui,
    object: ObjectId,
) {
    for (index, method) in approximation.methods().iter().enumerate() {
        let frame = Frame::group(ui.style()).inner_margin(6.0).fill(ui.visuals().faint_bg_color);
        frame.show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            head(index, method, lab, ui);
            match analysis.fits.get(index) {
                Some(Ok(fit)) => numbers(approximation, fit, ui),
                Some(Err(error)) => {
                    ui.colored_label(ui.visuals().error_fg_color, sentence(&error.to_string()));
                }
                None => {
                    ui.label(RichText::new("computing…").weak());
                }
            }
            ui.push_id(("method", object, index), |ui| {
                settings(approximation, index, method, lab, ui, object);
            });
        });
    }
    ui.menu_button("Add method", |ui| {
        for (text, scheme) in new_schemes(approximation) {
            if ui.button(text).clicked() {
                let color = approximation.free_color();
                change(lab, format!("Add {text}"), |all| all.with_method(Method::new(scheme, color)));
                ui.close();
            }
        }
    });
}

fn head(index: usize, method: &Method, lab: &mut Lab, ui: &mut Ui) {
    let title = method.scheme.title();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let mut visible = method.visible;
        let response = ui.checkbox(&mut visible, "");
        let label = format!("Show method {}: {title}", index + 1);
        response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, visible, &label));
        if response.clicked() {
            let word = if visible { "Show method" } else { "Hide method" };
            change_method(lab, index, word, |method| method.visible = visible);
        }
        let color = color32(lab.theme.basis_color(method.color));
        let (rect, chip) =
            ui.allocate_exact_size(eframe::egui::vec2(18.0, 14.0), eframe::egui::Sense::click());
        chip.widget_info(|| {
            WidgetInfo::labeled(Role::Button, true, format!("Colour of method {}", index + 1))
        });
        ui.painter().rect_filled(rect.shrink2(eframe::egui::vec2(0.0, 1.0)), 3.0, color);
        if chip.on_hover_text("Another colour").clicked() {
            let count = lab.theme.palette.len();
            change_method(lab, index, "Change colour", |method| method.color = (method.color + 1) % count);
        }
        let wide = (ui.available_width() - 28.0).max(40.0);
        ui.add_sized(
            [wide, 18.0],
            eframe::egui::Label::new(RichText::new(&title).strong())
                .truncate()
                .halign(eframe::egui::Align::Min),
        );
        let remove = ui.add(Button::new("×").small().frame_when_inactive(false));
        remove
            .widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Remove method {}", index + 1)));
        if remove.on_hover_text("Remove this method").clicked() {
            change(lab, format!("Remove {title}"), |all| all.without_method(index));
        }
    });
}

fn numbers(approximation: &Approximation, fit: &Arc<Fit>, ui: &mut Ui) {
    let mut parts = Vec::new();
    if let Some(error) = fit.from_function {
        parts.push(format!("max |p − f| = {} at {}", error_text(error.size), error_text(error.at)));
    }
    if let (Some(error), None) = (fit.from_data, fit.from_function) {
        parts.push(format!("max |p(xᵢ) − yᵢ| = {} at {}", error_text(error.size), error_text(error.at)));
    }
    if let Some(mean) = fit.root_mean_square.filter(|_| !approximation.is_empty()) {
        parts.push(format!("root mean square at the data {}", error_text(mean)));
    }
    if let Some(freedom) = fit.degrees_of_freedom {
        parts.push(format!("{} degrees of freedom", error_text(freedom)));
    }
    if let Some(roughness) = fit.roughness {
        parts.push(format!("roughness {}", error_text(roughness)));
    }
    for part in parts {
        ui.label(RichText::new(part).small());
    }
}

fn settings(
    approximation: &Approximation,
    index: usize,
    method: &Method,
    lab: &mut Lab,
    ui: &mut Ui,
    object: ObjectId,
) {
    match &method.scheme {
        Scheme::Cubic { ends } => cubic_ends(index, *ends, approximation, lab, ui),
        Scheme::Smoothing { sigma } => smoothing(index, *sigma, approximation, lab, ui, object),
        scheme => {
            if let Some((degree, knots)) = scheme.space() {
                degree_of(index, degree, scheme, knots, lab, ui);
                knots_of(index, degree, scheme, knots, approximation, lab, ui);
            }
            if matches!(scheme, Scheme::Schoenberg { .. }) && approximation.function().is_none() {
                ui.label(RichText::new("of the broken line through the data").small().weak());
            }
        }
    }
}

fn put(index: usize, label: &str, scheme: Scheme, lab: &mut Lab) {
    change_method(lab, index, label, |method| method.scheme = scheme);
}

fn cubic_ends(index: usize, ends: CubicEnds, approximation: &Approximation, lab: &mut Lab, ui: &mut Ui) {
    let (sites, values) = (approximation.sites(), approximation.values());
    // Slopes to begin with: those of the function, else of the outer pieces of the broken line.
    let slope = |first: bool| {
        let count = sites.len();
        if count < 2 {
            return 0.0;
        }
        let (a, b) = if first { (0, 1) } else { (count - 2, count - 1) };
        let secant = (values[b] - values[a]) / (sites[b] - sites[a]);
        let at = if first { sites[0] } else { sites[count - 1] };
        let h = 1e-6 * (sites[count - 1] - sites[0]);
        let central = approximation.function().map(|f| (f.value(at + h) - f.value(at - h)) / (2.0 * h));
        central.filter(|slope| slope.is_finite()).map_or(secant, |slope| (slope * 1e6).round() / 1e6)
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = eframe::egui::vec2(3.0, 3.0);
        for (text, is, new) in [
            ("Not-a-knot", matches!(ends, CubicEnds::NotAKnot), CubicEnds::NotAKnot),
            ("Natural", matches!(ends, CubicEnds::Natural), CubicEnds::Natural),
            (
                "Clamped",
                matches!(ends, CubicEnds::Clamped { .. }),
                CubicEnds::Clamped { start: slope(true), end: slope(false) },
            ),
            (
                "p″",
                matches!(ends, CubicEnds::SecondDerivatives { .. }),
                CubicEnds::SecondDerivatives { start: 0.0, end: 0.0 },
            ),
            ("Periodic", matches!(ends, CubicEnds::Periodic), CubicEnds::Periodic),
        ] {
            if ui.selectable_label(is, text).clicked() && !is {
                put(index, "Change end conditions", Scheme::Cubic { ends: new }, lab);
            }
        }
    });
    let (CubicEnds::Clamped { start, end } | CubicEnds::SecondDerivatives { start, end }) = ends else {
        return;
    };
    let (sign, name) = if matches!(ends, CubicEnds::Clamped { .. }) {
        ("p′", "Slope")
    } else {
        ("p″", "Second derivative")
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new(sign).italics());
        for (word, value, is_start) in [("start", start, true), ("end", end, false)] {
            let label = format!("{name} at the {word} of method {}", index + 1);
            let field = NumberField::new(&label, value).width(76.0).show(ui, ("end", is_start));
            if let Some(NumberEvent::Typed { to, .. }) = field.event {
                let (start, end) = if is_start { (to, end) } else { (start, to) };
                let ends = match ends {
                    CubicEnds::Clamped { .. } => CubicEnds::Clamped { start, end },
                    _ => CubicEnds::SecondDerivatives { start, end },
                };
                put(index, "Change end conditions", Scheme::Cubic { ends }, lab);
            }
        }
    });
}

fn degree_of(index: usize, degree: usize, scheme: &Scheme, knots: &KnotChoice, lab: &mut Lab, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label("Degree");
        for (text, new, word) in [("−", degree.wrapping_sub(1), "Lower"), ("+", degree + 1, "Raise")] {
            let possible = (1..=MAX_DEGREE).contains(&new);
            let button = ui.add_enabled(possible, Button::new(text).min_size(eframe::egui::vec2(22.0, 0.0)));
            let label = format!("{word} degree of method {}", index + 1);
            button.widget_info(|| WidgetInfo::labeled(Role::Button, possible, &label));
            if button.clicked() {
                put(index, "Change degree", scheme.with_space(new, knots.clone()), lab);
            }
            if text == "−" {
                ui.label(RichText::new(degree.to_string()).strong());
            }
        }
    });
}

fn knots_of(
    index: usize,
    degree: usize,
    scheme: &Scheme,
    knots: &KnotChoice,
    approximation: &Approximation,
    lab: &mut Lab,
    ui: &mut Ui,
) {
    let choose = |lab: &mut Lab, label: &str, knots: KnotChoice| {
        put(index, label, scheme.with_space(degree, knots), lab);
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label("Knots");
        if matches!(scheme, Scheme::Interpolation { .. }) {
            let averaged = matches!(knots, KnotChoice::Averaged);
            let hint = "Averages of the sites: interpolation is always possible";
            if ui.selectable_label(averaged, "Averaged").on_hover_text(hint).clicked() && !averaged {
                choose(lab, "Averaged knots", KnotChoice::Averaged);
            }
        } else {
            let interval = match approximation.function() {
                Some(function) if matches!(scheme, Scheme::Schoenberg { .. }) => Some(function.interval()),
                _ => approximation.data_interval(),
            };
            for (text, exponent) in [("Equidistant", 1.0), ("Graded", 4.0)] {
                let hint =
                    if text == "Graded" { "(j/N)⁴: crowded at the left end" } else { "Equal intervals" };
                let possible = interval.is_some();
                let button = ui.add_enabled(possible, Button::new(text).small()).on_hover_text(hint);
                if let (true, Some((a, b))) = (button.clicked(), interval) {
                    let count = knots.given().len() + 1;
                    let breaks = crate::core::approximation::graded_breaks(a, b, count, exponent);
                    let inner = breaks.map(|breaks| breaks[1..count].to_vec()).unwrap_or_default();
                    choose(lab, &format!("{text} knots"), KnotChoice::Inner(inner));
                }
            }
        }
    });
    let given = knots.given();
    if matches!(knots, KnotChoice::Averaged) {
        ui.label(RichText::new("Drag one on its line to make them your own").small().weak());
        return;
    }
    if given.len() > MOST_KNOTS {
        ui.label(RichText::new(format!("{} knots", given.len())).weak());
        return;
    }
    let text = given.iter().map(|&knot| full(knot)).collect::<Vec<_>>().join("  ");
    let label = match knots {
        KnotChoice::All(_) => format!("All knots of method {}", index + 1),
        _ => format!("Inner knots of method {}", index + 1),
    };
    let read = |typed: &str| -> Result<KnotChoice, String> {
        let choice = knots.with(parse_list(typed)?);
        let scheme = scheme.with_space(degree, choice.clone());
        Method::new(scheme, 0).check().map_err(|error: DataError| error.to_string())?;
        Ok(choice)
    };
    let field = TextField::new(&label, &text).hint("no inner knots");
    if let Some(typed) = field.show(ui, "knots", |typed| read(typed).map(|_| ()))
        && let Ok(choice) = read(&typed)
    {
        choose(lab, "Set knots", choice);
    }
}

fn smoothing(
    index: usize,
    sigma: f64,
    approximation: &Approximation,
    lab: &mut Lab,
    ui: &mut Ui,
    object: ObjectId,
) {
    let log_of = |sigma: f64| (sigma / (1.0 - sigma)).log10().clamp(*LOG_LAMBDA.start(), *LOG_LAMBDA.end());
    ui.horizontal(|ui| {
        ui.label(RichText::new("σ").italics());
        let label = format!("Sigma of method {}", index + 1);
        let field = NumberField::new(&label, sigma).width(76.0).check(|sigma| {
            if (0.0..=1.0).contains(&sigma) { Ok(()) } else { Err(format!("{sigma} is not between 0 and 1")) }
        });
        if let Some(NumberEvent::Typed { to, .. }) = field.show(ui, "sigma").event {
            put(index, "Change σ", Scheme::Smoothing { sigma: to }, lab);
        }
        ui.spacing_mut().slider_width = (ui.available_width() - 12.0).max(60.0);
        let mut log = log_of(sigma);
        let slider = ui.add(Slider::new(&mut log, LOG_LAMBDA).show_value(false));
        let name = format!("Smoothing of method {}", index + 1);
        slider.widget_info(|| WidgetInfo::slider(true, log, &name));
        if slider.changed() {
            let lambda = 10.0_f64.powf(log);
            let method = approximation.methods().get(index).map(|method| Method {
                scheme: Scheme::Smoothing { sigma: lambda / (1.0 + lambda) },
                ..method.clone()
            });
            if let Some(Ok(changed)) = method.map(|method| approximation.replacing_method(index, method)) {
                lab.begin("Change σ");
                lab.update(set(object, changed, "Change σ"));
            }
        }
        if slider.drag_stopped() || (slider.changed() && !slider.dragged()) {
            lab.commit();
        }
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (text, sigma, hint) in [
            ("Interpolate", 0.0, "σ = 0: the natural spline through the data"),
            ("Line", 1.0, "σ = 1: the least squares line"),
        ] {
            if ui.small_button(text).on_hover_text(hint).clicked() {
                put(index, "Change σ", Scheme::Smoothing { sigma }, lab);
            }
        }
        let hint = "The σ with the smallest generalized cross-validation score";
        if ui.small_button("Cross-validation").on_hover_text(hint).clicked() {
            let (sites, values) = (approximation.sites(), approximation.values());
            match smoothing_by_cross_validation(sites, values, approximation.weights()) {
                Ok(choice) => put(index, "Choose σ", Scheme::Smoothing { sigma: choice.sigma }, lab),
                Err(error) => lab.problem(sentence(&error.to_string())),
            }
        }
    });
}

/// The methods that can be added, with settings that suit the data.
fn new_schemes(approximation: &Approximation) -> Vec<(&'static str, Scheme)> {
    let inner = |count: u32| {
        let interval = approximation.data_interval().or_else(|| approximation.interval());
        let (left, right) = interval.unwrap_or((0.0, 1.0));
        let at = |k: u32| left + (right - left) * (f64::from(k) / f64::from(count + 1));
        KnotChoice::Inner((1..=count).map(at).collect())
    };
    let few = if approximation.len() >= 12 { 3 } else { 1 };
    let degree = approximation.len().saturating_sub(1).clamp(1, 3);
    vec![
        ("Cubic interpolation", Scheme::Cubic { ends: CubicEnds::NotAKnot }),
        ("Interpolation of any degree", Scheme::Interpolation { degree, knots: KnotChoice::Averaged }),
        ("Least squares", Scheme::LeastSquares { degree: 3, knots: inner(few) }),
        ("Smoothing", Scheme::Smoothing { sigma: 1e-3 }),
        ("Schoenberg's scheme", Scheme::Schoenberg { degree: 3, knots: inner(7) }),
    ]
}

/// With a capital letter.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
