//! Fonts, and the theme as egui's style.

use std::sync::Arc;

use eframe::egui::{
    self, Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Stroke, TextStyle, Visuals,
    vec2,
};

use crate::app::painter::color32;
use crate::figure::theme::Theme;

/// Family of the font with mathematical letters and signs.
pub(crate) const MATH: &str = "math";

/// Family of the heavier text font.
pub(crate) const SEMIBOLD: &str = "semibold";

/// The fonts of the lab: Inter for text, STIX Two Math for mathematics, egui's own behind them.
pub(crate) fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    let mut add = |name: &str, bytes: &'static [u8]| {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
    };
    add("Inter", include_bytes!("../../assets/fonts/Inter-Regular.otf"));
    add("Inter SemiBold", include_bytes!("../../assets/fonts/Inter-SemiBold.otf"));
    add("STIX Two Math", include_bytes!("../../assets/fonts/STIXTwoMath-Regular.ttf"));
    let fallback = fonts.families.get(&FontFamily::Proportional).cloned().unwrap_or_default();
    let with = |first: &[&str]| {
        let mut names: Vec<String> = first.iter().map(|&name| name.to_owned()).collect();
        names.extend(fallback.iter().cloned());
        names
    };
    fonts.families.insert(FontFamily::Proportional, with(&["Inter", "STIX Two Math"]));
    fonts.families.insert(FontFamily::Name(SEMIBOLD.into()), with(&["Inter SemiBold", "STIX Two Math"]));
    fonts.families.insert(FontFamily::Name(MATH.into()), with(&["STIX Two Math", "Inter"]));
    if let Some(monospace) = fonts.families.get_mut(&FontFamily::Monospace) {
        monospace.push("STIX Two Math".to_owned());
    }
    fonts
}

/// Makes egui look like `theme`.
pub(crate) fn apply(theme: &Theme, ctx: &egui::Context) {
    let dark = theme.is_dark;
    ctx.set_theme(if dark { egui::Theme::Dark } else { egui::Theme::Light });
    let mut visuals = if dark { Visuals::dark() } else { Visuals::light() };
    let text = color32(theme.text);
    let (panel, ground, line) = (color32(theme.panel), color32(theme.background), color32(theme.grid_major));
    let accent = color32(theme.selection);
    visuals.panel_fill = panel;
    visuals.window_fill = panel;
    visuals.extreme_bg_color = ground;
    visuals.text_edit_bg_color = Some(ground);
    visuals.faint_bg_color = text.gamma_multiply(0.045);
    visuals.weak_text_color = Some(color32(theme.muted_text));
    visuals.window_stroke = Stroke::new(1.0, line);
    visuals.selection.bg_fill = accent.gamma_multiply(if dark { 0.55 } else { 0.28 });
    visuals.selection.stroke = Stroke::new(1.0, text);
    visuals.hyperlink_color = accent;
    visuals.error_fg_color = color32(theme.error);
    visuals.warn_fg_color = color32(theme.warning);
    let widgets = &mut visuals.widgets;
    for (state, fill) in [
        (&mut widgets.noninteractive, 0.0),
        (&mut widgets.inactive, 0.07),
        (&mut widgets.hovered, 0.13),
        (&mut widgets.active, 0.20),
        (&mut widgets.open, 0.10),
    ] {
        state.corner_radius = CornerRadius::same(5);
        state.fg_stroke = Stroke::new(1.0, text);
        state.bg_fill = text.gamma_multiply(fill);
        state.weak_bg_fill = text.gamma_multiply(fill);
        state.bg_stroke = Stroke::new(1.0, if fill == 0.0 { line } else { Color32::TRANSPARENT });
        state.expansion = 0.0;
    }
    widgets.hovered.bg_stroke = Stroke::new(1.0, accent.gamma_multiply(0.6));
    widgets.active.bg_stroke = Stroke::new(1.0, accent);
    let scale = theme.text_scale as f32;
    ctx.global_style_mut(|style| {
        style.visuals = visuals;
        style.spacing.item_spacing = vec2(8.0, 6.0);
        style.spacing.button_padding = vec2(8.0, 3.0);
        style.spacing.interact_size = vec2(36.0, 22.0) * scale;
        style.spacing.menu_margin = egui::Margin::same(6);
        for (text_style, family, size) in [
            (TextStyle::Small, FontFamily::Proportional, 11.0),
            (TextStyle::Body, FontFamily::Proportional, 13.0),
            (TextStyle::Button, FontFamily::Proportional, 13.0),
            (TextStyle::Monospace, FontFamily::Monospace, 12.5),
            (TextStyle::Heading, FontFamily::Name(SEMIBOLD.into()), 15.0),
        ] {
            style.text_styles.insert(text_style, FontId::new(size * scale, family));
        }
    });
}
