//! The layers of a solution.

use glam::DVec2;

use crate::core::domain::{Bounds, CellClass};
use crate::core::finite_element::{IsogeometricSolution, NodeClass, PlanePatch, WeightedSolution};
use crate::document::MembraneDisplay;
use crate::figure::color_map::ColorScale;
use crate::figure::elements::{Solution, Solved};
use crate::figure::field::Field;
use crate::figure::picture::{Item, Marker, MarkerShape, Path};
use crate::figure::theme::Theme;

/// Points of a curved knot line.
const LINE_POINTS: usize = 48;
/// More marks than this are not drawn: they would be one stain.
const MOST_MARKS: usize = 20_000;
/// Length and half width of an arrow of a stream line, as parts of the line.
const ARROW: (f64, f64) = (0.012, 0.004);

/// Lines of equal value between the ends of the scale; without colours each in the colour of its level.
pub(super) fn isolines(
    field: &Field,
    scale: &ColorScale,
    display: &MembraneDisplay,
    theme: &Theme,
) -> Vec<Item> {
    let count = display.isolines;
    let level =
        |k: usize| scale.low() + (scale.high() - scale.low()) * (k as f64 + 1.0) / (count as f64 + 1.0);
    let lines = (0..count).map(level).flat_map(|level| {
        let color = if display.fill { theme.background.with_opacity(0.75) } else { scale.color(level) };
        let stroke = theme.stroke(color, 1.0);
        field.isolines(level).into_iter().map(move |line| Item::Path(line.path(stroke.clone())))
    });
    lines.collect()
}

/// The cells that matter, cut ones with a stronger line; of a patch the images of the knot lines.
pub(super) fn cells(solved: &Solved, display: &MembraneDisplay, theme: &Theme) -> Vec<Item> {
    if !display.cells {
        return Vec::new();
    }
    let ink = if display.fill { theme.background } else { theme.axis };
    let fine = theme.stroke(ink.with_opacity(0.45), 0.6);
    match &solved.solution {
        Solution::Weighted(solution) => weighted_cells(solution, &fine, theme),
        _ => solved.on_patch().map_or_else(Vec::new, |solution| knot_lines(solution, &fine)),
    }
}

fn weighted_cells(
    solution: &WeightedSolution,
    fine: &crate::figure::picture::Stroke,
    theme: &Theme,
) -> Vec<Item> {
    let table = solution.space.table();
    let cut = theme.stroke(theme.warning.with_opacity(0.9), 0.9);
    let of_class = |class: CellClass| {
        let cells = table.classes().iter().enumerate().filter(move |(_, found)| **found == class);
        cells.map(|(index, _)| table.grid().cell(table.cell_of(index)))
    };
    let square = |cell: Bounds, stroke: &crate::figure::picture::Stroke| {
        Item::Path(Path::polygon(&cell.corners(), Some(stroke.clone()), None))
    };
    let inner = of_class(CellClass::Inner).map(|cell| square(cell, fine));
    inner.chain(of_class(CellClass::Cut).map(|cell| square(cell, &cut))).take(MOST_MARKS).collect()
}

fn knot_lines(solution: &IsogeometricSolution, stroke: &crate::figure::picture::Stroke) -> Vec<Item> {
    let patch = solution.space().patch();
    let [low, high] = patch.parameter_rectangle();
    let mut items = Vec::new();
    for axis in 0..2 {
        let along = 1 - axis;
        for knot in solution.space().spaces()[axis].breaks() {
            let point = |step: usize| {
                let mut t = DVec2::ZERO;
                t[axis] = knot;
                t[along] = low[along] + (high[along] - low[along]) * step as f64 / LINE_POINTS as f64;
                patch.evaluate(t.min(high)).ok()
            };
            let points: Vec<DVec2> = (0..=LINE_POINTS).filter_map(point).collect();
            items.push(Item::Path(Path::polyline(&points, stroke.clone())));
        }
    }
    items
}

/// The nodes of the quadrature.
pub(super) fn quadrature(solved: &Solved, display: &MembraneDisplay, theme: &Theme) -> Vec<Item> {
    let Solution::Weighted(solution) = &solved.solution else { return Vec::new() };
    if !display.quadrature {
        return Vec::new();
    }
    let ink = theme.accent.with_opacity(0.85);
    let mut items = Vec::new();
    solution.space.table().for_each_point(|point| {
        if items.len() < MOST_MARKS {
            let (shape, fill) = (MarkerShape::Disc, Some(ink));
            items.push(Item::Marker(Marker { at: point.point, shape, size: 2.0, fill, stroke: None }));
        }
    });
    items
}

/// Stream lines, each with an arrow, of neighbours in turn at one third and at two thirds.
pub(super) fn stream_lines(solved: &Solved, display: &MembraneDisplay, theme: &Theme) -> Vec<Item> {
    let ink = if display.fill { theme.background } else { theme.basis_color(0) };
    let stroke = theme.stroke(ink.with_opacity(0.9), 1.2);
    let mut items = Vec::new();
    for (index, line) in solved.stream_lines(display.stream_lines).into_iter().enumerate() {
        let length: f64 = line.windows(2).map(|edge| edge[0].distance(edge[1])).sum();
        let mut left = [1.0 / 3.0, 2.0 / 3.0][index % 2] * length;
        for edge in line.windows(2) {
            let way = edge[0].distance(edge[1]);
            if left <= way {
                let along = (edge[1] - edge[0]).normalize_or_zero();
                let tip = edge[0] + along * (left + 0.5 * ARROW.0 * length);
                let back = tip - along * (ARROW.0 * length);
                let side = along.perp() * (ARROW.1 * length);
                items.push(Item::Path(Path::polygon(&[tip, back + side, back - side], None, Some(ink))));
                break;
            }
            left -= way;
        }
        items.push(Item::Path(Path::polyline(&line, stroke.clone())));
    }
    items
}

/// The boundary of the domain.
pub(super) fn outline(solved: &Solved, theme: &Theme) -> Vec<Item> {
    let stroke = theme.stroke(theme.text, 1.5);
    solved.samples.outline.iter().map(|line| Item::Path(Path::polyline(line, stroke.clone()))).collect()
}

/// The nodes of the B-splines: inner ones and free ones filled, outer ones and those that are dropped hollow.
pub(super) fn nodes(solved: &Solved, display: &MembraneDisplay, theme: &Theme) -> Vec<Item> {
    if !display.nodes {
        return Vec::new();
    }
    let node = |at: DVec2, is_filled: bool| {
        let stroke = Some(theme.stroke(if is_filled { theme.background } else { theme.basis_color(1) }, 1.1));
        let fill = Some(if is_filled { theme.basis_color(1) } else { theme.background });
        Item::Marker(Marker { at, shape: MarkerShape::Disc, size: 6.0 * theme.stroke_scale, fill, stroke })
    };
    match &solved.solution {
        Solution::Weighted(solution) => {
            let space = &solution.space;
            let of_class = |class: NodeClass| {
                let of_class = space.nodes().of_class(class).into_iter();
                of_class.map(move |k| node(space.node_position(k), class == NodeClass::Inner))
            };
            of_class(NodeClass::Inner).chain(of_class(NodeClass::Outer)).take(MOST_MARKS).collect()
        }
        _ => {
            let Some(solution) = solved.on_patch() else { return Vec::new() };
            let space = solution.space();
            let ([m1, m2], free) = (space.sizes(), space.free());
            let all = (0..m1).flat_map(|i| (0..m2).map(move |j| [i, j]));
            all.filter_map(|k| {
                let is_free = free[0].contains(&k[0]) && free[1].contains(&k[1]);
                Some(node(space.node(k)?, is_free))
            })
            .take(MOST_MARKS)
            .collect()
        }
    }
}

/// The control net of a patch with its points.
pub(super) fn control_net(patch: &PlanePatch, theme: &Theme) -> Vec<Item> {
    let [m1, m2] = patch.spaces().each_ref().map(|space| space.dimension());
    let stroke = theme.stroke(theme.polygon, 1.2);
    let at = |i: usize, j: usize| patch.points()[i * m2 + j];
    let rows = (0..m1).map(|i| (0..m2).map(|j| at(i, j)).collect::<Vec<_>>());
    let columns = (0..m2).map(|j| (0..m1).map(|i| at(i, j)).collect::<Vec<_>>());
    let lines = rows.chain(columns).map(|line| Item::Path(Path::polyline(&line, stroke.clone())));
    let points = patch.points().iter().map(|&at| {
        let (fill, stroke) = (Some(theme.background), Some(theme.stroke(theme.polygon, 1.5)));
        let size = 8.0 * theme.stroke_scale;
        Item::Marker(Marker { at, shape: MarkerShape::Square, size, fill, stroke })
    });
    lines.chain(points).collect()
}
