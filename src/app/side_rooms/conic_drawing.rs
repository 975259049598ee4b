//! The complete conic of a piece on the canvas: dotted, with centre, axes and foci, and the arc of the negative weight.

use glam::DVec2;

use crate::app::lab::Lab;
use crate::app::side_rooms::CONIC;
use crate::app::side_rooms::conic::{Piece, piece};
use crate::core::rational_bezier::{Conic, ConicKind, ExtendedParameter};
use crate::figure::picture::{Item, Marker, MarkerShape, Path, Picture, Stroke, Viewport};
use crate::figure::theme::Theme;

/// Places of the complementary arc that are joined by lines.
const STEPS: u32 = 400;

/// Adds the conic of the selected curve to the picture.
pub(super) fn draw(lab: &Lab, viewport: &Viewport, picture: &mut Picture) {
    let Some((object, curve)) = lab.selection.object.zip(lab.curve()) else { return };
    let Some(piece) = lab.parameter(object).and_then(|t| piece(curve, t).ok()) else { return };
    let Ok(conic) = piece.extended.implicit() else { return };
    if lab.rooms.whole_conic {
        picture.push_layer(CONIC, whole(&conic, viewport, &lab.theme));
        picture.push_layer("axes and foci", marks(&conic, viewport, &lab.theme));
    }
    if lab.rooms.complement {
        picture.push_layer("complementary arc", complement(&piece, viewport, &lab.theme));
    }
}

fn view_box(viewport: &Viewport) -> (DVec2, DVec2) {
    let half = viewport.size * (0.5 / viewport.scale);
    (viewport.center - half, viewport.center + half)
}

fn whole(conic: &Conic, viewport: &Viewport, theme: &Theme) -> Vec<Item> {
    let (low, high) = view_box(viewport);
    let stroke = Stroke::dashed(theme.accent, 1.6 * theme.stroke_scale, 1.5, 4.0);
    let arcs = conic.arcs_in_box(low, high).unwrap_or_default();
    let lines = arcs.iter().filter_map(|arc| arc.tessellate(0.2 / viewport.scale).ok());
    lines
        .map(|line| {
            let places: Vec<DVec2> = line.iter().map(|place| place.point).collect();
            Item::Path(Path::polyline(&places, stroke.clone()))
        })
        .collect()
}

fn marks(conic: &Conic, viewport: &Viewport, theme: &Theme) -> Vec<Item> {
    let mut items = Vec::new();
    let ink = theme.accent;
    if let Ok(axes) = conic.axes() {
        let stroke = Stroke::dashed(ink.with_opacity(0.55), theme.stroke_scale, 6.0, 4.0);
        for (length, direction) in axes.lengths.into_iter().zip(axes.directions) {
            let way = direction * length;
            items.push(Item::Path(Path::polyline(&[axes.center - way, axes.center + way], stroke.clone())));
        }
        // The lines that a hyperbola comes near to.
        if conic.kind() == ConicKind::Hyperbola {
            let stroke = Stroke::dashed(ink.with_opacity(0.35), theme.stroke_scale, 2.0, 5.0);
            let far = viewport.size.length() / viewport.scale + (viewport.center - axes.center).length();
            for side in [1.0, -1.0] {
                let [a, b] = axes.lengths;
                let way =
                    (axes.directions[0] * a + axes.directions[1] * (side * b)).normalize_or_zero() * far;
                items.push(Item::Path(Path::polyline(
                    &[axes.center - way, axes.center + way],
                    stroke.clone(),
                )));
            }
        }
        items.push(mark(axes.center, MarkerShape::Cross, theme));
    }
    items.extend(conic.foci().unwrap_or_default().into_iter().map(|at| mark(at, MarkerShape::Disc, theme)));
    items
}

fn mark(at: DVec2, shape: MarkerShape, theme: &Theme) -> Item {
    let stroke = Some(Stroke::solid(theme.accent, 1.6 * theme.stroke_scale));
    Item::Marker(Marker { at, shape, size: 8.0 * theme.stroke_scale, fill: Some(theme.background), stroke })
}

/// What the arc of weight −w runs through, interrupted at infinity.
fn complement(piece: &Piece, viewport: &Viewport, theme: &Theme) -> Vec<Item> {
    let arc = piece.extended.complement();
    let stroke = Stroke::dashed(theme.warning, 2.6 * theme.stroke_scale, 9.0, 4.0);
    let far = 4.0 * viewport.size.length() / viewport.scale;
    let mut lines: Vec<Vec<DVec2>> = vec![Vec::new()];
    for step in 0..=STEPS {
        let t = f64::from(step) / f64::from(STEPS);
        match arc.evaluate(ExtendedParameter::Finite(t)) {
            Ok(at) if at.distance(viewport.center) < far => {
                // Between two places on opposite sides the arc goes through infinity.
                if let Some(line) = lines.last_mut() {
                    if line.last().is_some_and(|last| crosses_infinity(&arc.poles(), t, step) && *last != at)
                    {
                        lines.push(vec![at]);
                    } else {
                        line.push(at);
                    }
                }
            }
            _ => lines.push(Vec::new()),
        }
    }
    let lines = lines.into_iter().filter(|line| line.len() > 1);
    lines.map(|line| Item::Path(Path::polyline(&line, stroke.clone()))).collect()
}

fn crosses_infinity(poles: &[ExtendedParameter], t: f64, step: u32) -> bool {
    let before = f64::from(step.saturating_sub(1)) / f64::from(STEPS);
    poles.iter().any(|pole| matches!(pole, ExtendedParameter::Finite(at) if before < *at && *at <= t))
}
