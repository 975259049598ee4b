//! The lines of knots under the plot.

use glam::DVec2;

use crate::core::approximation::ApproximationError;
use crate::document::Approximation;
use crate::figure::approximation::analysis::Analysis;
use crate::figure::approximation::layout::{KnotRow, Layout};
use crate::figure::picture::{Anchor, Item, Label, Marker, MarkerShape, Path, Picture};
use crate::figure::theme::Theme;

/// Diameter of a knot that can be moved, in pt.
const KNOT: f64 = 8.0;
/// Knots closer than so many pt to the one drawn before are not drawn.
const LEAST_DISTANCE: f64 = 1.0;

/// Adds the lines.
pub(super) fn push(
    picture: &mut Picture,
    approximation: &Approximation,
    analysis: &Analysis,
    layout: &Layout,
    theme: &Theme,
) {
    for row in &layout.rows {
        let Some(method) = approximation.methods().get(row.method) else { continue };
        let mut items = line(row, layout, theme);
        let error = analysis.fits.get(row.method).and_then(|fit| fit.as_ref().err());
        items.extend(error.and_then(|error| support(error, row, layout, theme)));
        items.extend(knots(row, theme.basis_color(method.color), layout, theme));
        picture.push_layer(format!("knots: {}", method.scheme.title()), items);
    }
}

fn on_row(row: &KnotRow, layout: &Layout, x: f64) -> DVec2 {
    DVec2::new(layout.main.place(x, layout.main.y[0]).x, row.y)
}

fn line(row: &KnotRow, layout: &Layout, theme: &Theme) -> Vec<Item> {
    let (left, right) = (layout.main.low.x, layout.main.high.x);
    let ends = [DVec2::new(left, row.y), DVec2::new(right, row.y)];
    let mut items = vec![Item::Path(Path::polyline(&ends, theme.stroke(theme.grid_major, 1.0)))];
    for end in row.ends.into_iter().flat_map(|(left, right)| [left, right]) {
        let at = on_row(row, layout, end);
        if (left..=right).contains(&at.x) {
            let tick = [at - DVec2::Y * 4.0, at + DVec2::Y * 4.0];
            items.push(Item::Path(Path::polyline(&tick, theme.stroke(theme.axis, 1.25))));
        }
    }
    items
}

/// The support in which a site is missing.
fn support(error: &ApproximationError, row: &KnotRow, layout: &Layout, theme: &Theme) -> Option<Item> {
    let (ApproximationError::SchoenbergWhitney { left, right, .. }
    | ApproximationError::RankDeficient { left, right, .. }) = *error
    else {
        return None;
    };
    let bound = |x: f64| on_row(row, layout, x).x.clamp(layout.main.low.x, layout.main.high.x);
    let ends = [DVec2::new(bound(left), row.y), DVec2::new(bound(right), row.y)];
    Some(Item::Path(Path::polyline(&ends, theme.stroke(theme.error.with_opacity(0.6), 4.0))))
}

fn knots(row: &KnotRow, color: crate::figure::picture::Color, layout: &Layout, theme: &Theme) -> Vec<Item> {
    let (left, right) = (layout.main.low.x, layout.main.high.x);
    let mut items = Vec::new();
    let mut last = f64::NEG_INFINITY;
    let mut rest = row.knots.as_slice();
    while let Some(&knot) = rest.first() {
        let copies = rest.partition_point(|&other| other <= knot);
        rest = &rest[copies.max(1)..];
        let at = on_row(row, layout, knot);
        if !(left - 1e-6..=right + 1e-6).contains(&at.x) || at.x - last < LEAST_DISTANCE {
            continue;
        }
        last = at.x;
        if row.movable {
            let stroke = Some(theme.stroke(theme.background, 1.0));
            let (shape, fill) = (MarkerShape::Diamond, Some(color));
            items.push(Item::Marker(Marker { at, shape, size: KNOT, fill, stroke }));
        } else {
            let tick = [at - DVec2::Y * 3.5, at + DVec2::Y * 3.5];
            items.push(Item::Path(Path::polyline(&tick, theme.stroke(color, 1.5))));
        }
        if copies > 1 {
            items.push(Item::Label(Label {
                at,
                offset: DVec2::new(7.0, 1.0),
                text: format!("\u{d7}{copies}"),
                size: 8.5 * theme.text_scale,
                color: theme.muted_text,
                anchor: Anchor::Start,
                math: false,
            }));
        }
    }
    items
}
