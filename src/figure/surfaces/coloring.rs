//! Curvatures as colours.

use crate::document::SurfaceColoring;
use crate::figure::color_map::{ColorMap, ColorScale};
use crate::figure::picture::Color;
use crate::figure::surfaces::Legend;
use crate::figure::theme::Theme;

/// This part of the values lies within the scale: near singular points curvatures grow without bound.
const SHARE: f64 = 0.97;

/// The colours of `values` and their scale, symmetric about 0 and up to `limit`; 0 lets the values decide. A value that is not a
/// number gets the colour of nets.
pub(super) fn colors(
    values: &[f64],
    coloring: SurfaceColoring,
    limit: f64,
    theme: &Theme,
) -> (Vec<Color>, Option<Legend>) {
    let limit = if limit > 0.0 { limit } else { typical_size(values) };
    let Ok(scale) = ColorScale::new(-limit, limit, ColorMap::Diverging) else {
        return (vec![theme.polygon; values.len()], None);
    };
    let color = |&value: &f64| if value.is_nan() { theme.polygon } else { scale.color(value) };
    (values.iter().map(color).collect(), Some(Legend { scale, title: coloring.name() }))
}

/// The size that most values stay below; 1 if all are zero.
fn typical_size(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> =
        values.iter().map(|value| value.abs()).filter(|size| size.is_finite()).collect();
    if sizes.is_empty() {
        return 1.0;
    }
    let place = ((sizes.len() - 1) as f64 * SHARE) as usize;
    let (_, &mut size, _) = sizes.select_nth_unstable_by(place, f64::total_cmp);
    // Rounding errors of a plane are no curvature.
    if size > 1e-9 { size } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_reaches_as_far_to_both_sides_and_ignores_what_is_no_number() {
        let values: Vec<f64> = (0..100).map(f64::from).chain([f64::NAN, f64::INFINITY]).collect();
        let (colors, legend) = colors(&values, SurfaceColoring::Mean, 0.0, &Theme::light());
        let scale = legend.map(|legend| legend.scale);
        let (low, high) = scale.map_or((0.0, 0.0), |scale| (scale.low(), scale.high()));
        assert!(low == -high && (95.0..=97.0).contains(&high), "from {low} to {high}");
        assert_eq!(colors[100], Theme::light().polygon, "no number");
        assert_eq!(typical_size(&[1e-17, 0.0]), 1.0, "a plane");
    }
}
