//! The distances of mathematical typesetting, as the font prescribes them.

use crate::figure::font_metrics::FontFace;

/// The constants that the font's MATH table gives, in em.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Constants {
    pub(super) script_scale: f64,
    pub(super) script_script_scale: f64,
    pub(super) axis_height: f64,
    pub(super) accent_base_height: f64,
    pub(super) subscript_shift_down: f64,
    pub(super) subscript_top_max: f64,
    pub(super) subscript_baseline_drop_min: f64,
    pub(super) superscript_shift_up: f64,
    pub(super) superscript_bottom_min: f64,
    pub(super) superscript_baseline_drop_max: f64,
    pub(super) sub_superscript_gap_min: f64,
    pub(super) superscript_bottom_max_with_subscript: f64,
    pub(super) space_after_script: f64,
    pub(super) upper_limit_gap_min: f64,
    pub(super) upper_limit_baseline_rise_min: f64,
    pub(super) lower_limit_gap_min: f64,
    pub(super) lower_limit_baseline_drop_min: f64,
    pub(super) rule_thickness: f64,
    /// Shifts and gaps of numerator and denominator, displayed and in text.
    pub(super) fraction: [[f64; 4]; 2],
    pub(super) stack_gap_min: [f64; 2],
    pub(super) radical_gap: [f64; 2],
    pub(super) radical_rule_thickness: f64,
    pub(super) radical_extra_ascender: f64,
    pub(super) overbar_gap: f64,
}

impl Constants {
    pub(super) fn read() -> Self {
        let Some(face) = FontFace::Math.face() else { return Self::default() };
        let Some(table) = face.tables().math.and_then(|math| math.constants) else { return Self::default() };
        let em = f64::from(face.units_per_em());
        let of = |value: ttf_parser::math::MathValue<'_>| f64::from(value.value) / em;
        Self {
            script_scale: f64::from(table.script_percent_scale_down()) / 100.0,
            script_script_scale: f64::from(table.script_script_percent_scale_down()) / 100.0,
            axis_height: of(table.axis_height()),
            accent_base_height: of(table.accent_base_height()),
            subscript_shift_down: of(table.subscript_shift_down()),
            subscript_top_max: of(table.subscript_top_max()),
            subscript_baseline_drop_min: of(table.subscript_baseline_drop_min()),
            superscript_shift_up: of(table.superscript_shift_up()),
            superscript_bottom_min: of(table.superscript_bottom_min()),
            superscript_baseline_drop_max: of(table.superscript_baseline_drop_max()),
            sub_superscript_gap_min: of(table.sub_superscript_gap_min()),
            superscript_bottom_max_with_subscript: of(table.superscript_bottom_max_with_subscript()),
            space_after_script: of(table.space_after_script()),
            upper_limit_gap_min: of(table.upper_limit_gap_min()),
            upper_limit_baseline_rise_min: of(table.upper_limit_baseline_rise_min()),
            lower_limit_gap_min: of(table.lower_limit_gap_min()),
            lower_limit_baseline_drop_min: of(table.lower_limit_baseline_drop_min()),
            rule_thickness: of(table.fraction_rule_thickness()),
            fraction: [
                [
                    of(table.fraction_numerator_display_style_shift_up()),
                    of(table.fraction_denominator_display_style_shift_down()),
                    of(table.fraction_num_display_style_gap_min()),
                    of(table.fraction_denom_display_style_gap_min()),
                ],
                [
                    of(table.fraction_numerator_shift_up()),
                    of(table.fraction_denominator_shift_down()),
                    of(table.fraction_numerator_gap_min()),
                    of(table.fraction_denominator_gap_min()),
                ],
            ],
            stack_gap_min: [of(table.stack_display_style_gap_min()), of(table.stack_gap_min())],
            radical_gap: [of(table.radical_display_style_vertical_gap()), of(table.radical_vertical_gap())],
            radical_rule_thickness: of(table.radical_rule_thickness()),
            radical_extra_ascender: of(table.radical_extra_ascender()),
            overbar_gap: of(table.overbar_vertical_gap()),
        }
    }
}
