//! Lines of equal value of a piecewise linear field, by marching triangles.
//!
//! Ends of pieces are named, not compared by place: a vertex on the level, or the edge that the line crosses. So a line that runs
//! through vertices or along edges is one line, without gaps and without copies.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use crate::core::point::Point as _;
use crate::figure::picture::{Path, Segment, Stroke};

/// A line of equal value.
#[derive(Clone, Debug, PartialEq)]
pub struct Isoline {
    /// Its points, at least two, neighbours apart from each other; the first is not repeated.
    pub points: Vec<DVec2>,
    /// Whether the last point is joined to the first.
    pub is_closed: bool,
}

impl Isoline {
    /// The line as a path.
    pub fn path(&self, stroke: Stroke) -> Path {
        let mut path = Path::polyline(&self.points, stroke);
        if self.is_closed {
            path.segments.push(Segment::Close);
        }
        path
    }
}

/// Where a line enters or leaves a triangle: `(i, i)` is vertex i, `(i, j)` with `i < j` a crossing of that edge.
type Node = (u32, u32);

/// The lines on which the field over `triangles`, linear on each and with `values` at `points`, has the value `level`,
/// as [`crate::figure::field::Field::isolines`] describes them. Indices must be valid, as those of a field are.
pub(crate) fn isolines(points: &[DVec2], values: &[f64], triangles: &[[u32; 3]], level: f64) -> Vec<Isoline> {
    let mut neighbours: BTreeMap<Node, BTreeSet<Node>> = BTreeMap::new();
    for &corners in triangles {
        if let Some((from, to)) = piece(corners, values, level) {
            neighbours.entry(from).or_default().insert(to);
            neighbours.entry(to).or_default().insert(from);
        }
    }
    let place = |(i, j): Node| {
        let (a, b) = (i as usize, j as usize);
        // Halves of the values have a difference that does not overflow.
        let (before, run) = (0.5 * level - 0.5 * values[a], 0.5 * values[b] - 0.5 * values[a]);
        if a == b { points[a] } else { points[a].mix(points[b], before / run) }
    };
    // Lines start at loose ends and where an odd number of pieces meets; what then is left are loops.
    let odd: Vec<Node> =
        neighbours.iter().filter(|(_, others)| others.len() % 2 == 1).map(|(&node, _)| node).collect();
    let all: Vec<Node> = neighbours.keys().copied().collect();
    let mut lines = Vec::new();
    for start in odd.into_iter().chain(all) {
        while neighbours.get(&start).is_some_and(|others| !others.is_empty()) {
            lines.extend(line_from(&trail(start, &mut neighbours, place), place));
        }
    }
    lines
}

/// Follows pieces from `start` as long as there are any, and takes them away.
fn trail(
    start: Node,
    neighbours: &mut BTreeMap<Node, BTreeSet<Node>>,
    place: impl Fn(Node) -> DVec2,
) -> Vec<Node> {
    let mut nodes = vec![start];
    let (mut node, mut direction) = (start, DVec2::ZERO);
    loop {
        let here = place(node);
        let straightness = |other: &Node| direction.dot((place(*other) - here).normalize_or_zero());
        let others = neighbours.get(&node).into_iter().flatten().copied();
        let Some(next) = others.max_by(|a, b| straightness(a).total_cmp(&straightness(b))) else {
            return nodes;
        };
        for (from, to) in [(node, next), (next, node)] {
            if let Some(others) = neighbours.get_mut(&from) {
                others.remove(&to);
            }
        }
        direction = (place(next) - here).normalize_or(direction);
        nodes.push(next);
        node = next;
    }
}

fn line_from(nodes: &[Node], place: impl Fn(Node) -> DVec2) -> Option<Isoline> {
    let is_closed = nodes.len() > 3 && nodes.first() == nodes.last();
    let nodes = if is_closed { &nodes[1..] } else { nodes };
    let mut points: Vec<DVec2> = nodes.iter().map(|&node| place(node)).collect();
    // Crossings beside a vertex may round to its place.
    points.dedup();
    if is_closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    (points.len() > 1).then_some(Isoline { points, is_closed })
}

/// The piece of the line in a triangle.
fn piece(corners: [u32; 3], values: &[f64], level: f64) -> Option<(Node, Node)> {
    let sides = corners.map(|vertex| values[vertex as usize].partial_cmp(&level));
    let on_level = |i: usize| sides[i] == Some(std::cmp::Ordering::Equal);
    let mut ends = (0..3).filter(|&i| on_level(i)).map(|i| (corners[i], corners[i]));
    let (first, second, third) = (ends.next(), ends.next(), ends.next());
    let mut crossings = (0..3).filter_map(|i| {
        let j = (i + 1) % 3;
        let crosses = !on_level(i) && !on_level(j) && sides[i].is_some() && sides[i] != sides[j];
        crosses.then(|| (corners[i].min(corners[j]), corners[i].max(corners[j])))
    });
    match (first, second, third) {
        (Some(a), Some(b), None) if a != b => Some((a, b)),
        (Some(a), None, None) => Some((a, crossings.next()?)),
        (None, None, None) => Some((crossings.next()?, crossings.next()?)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::field::Field;

    /// The function over [-1, 1]² on a grid of `2·half` cells per side.
    fn field(half: i32, function: impl Fn(DVec2) -> f64) -> Field {
        let side = -half..=half;
        let points: Vec<DVec2> = side
            .clone()
            .flat_map(|j| side.clone().map(move |i| DVec2::new(f64::from(i), f64::from(j)) / f64::from(half)))
            .collect();
        let values = points.iter().map(|&point| function(point)).collect();
        let count = (2 * half + 1) as usize;
        Field::on_grid(count, count, points, values).unwrap()
    }

    fn length(line: &Isoline) -> f64 {
        let open: f64 = line.points.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
        let last = line.points[line.points.len() - 1];
        open + if line.is_closed { last.distance(line.points[0]) } else { 0.0 }
    }

    #[test]
    fn isolines_of_linear_fields_are_straight_and_whole() {
        let gradient = DVec2::new(2.0, 1.0);
        let field = field(4, |point| gradient.dot(point));
        // The levels 0 and 0.5 run through vertices, 0.3 between them.
        for level in [0.0, 0.5, 0.3, -0.85] {
            let lines = field.isolines(level);
            let [line] = lines.as_slice() else { panic!("level {level}: {} lines", lines.len()) };
            let across = line.points.iter().map(|point| (gradient.dot(*point) - level).abs());
            assert!(across.fold(0.0, f64::max) < 1e-14, "level {level}: on the line");
            // From y = -1 to y = 1, x = (level − y)/2.
            assert!((length(line) - 5f64.sqrt()).abs() < 1e-13 && !line.is_closed, "level {level}: {line:?}");
        }
        assert!(field.isolines(3.5).is_empty() && field.isolines(f64::NAN).is_empty(), "no such value");
    }

    #[test]
    fn a_line_along_edges_is_found_once() {
        for fold in [|x: f64| x, |x: f64| x.abs(), |x: f64| -x.abs()] {
            let lines = field(3, |point| fold(point.x)).isolines(0.0);
            assert_eq!(lines.len(), 1, "{lines:?}");
            assert!((length(&lines[0]) - 2.0).abs() < 1e-14, "from edge to edge: {lines:?}");
        }
    }

    #[test]
    fn circles_are_closed_and_near_with_the_square_of_the_mesh_width() {
        let mut last = f64::INFINITY;
        for half in [8, 16, 32, 64] {
            // Radius 1/2 runs through vertices of every grid.
            let lines = field(half, |point| point.length_squared()).isolines(0.25);
            assert!(lines.len() == 1 && lines[0].is_closed, "{} lines", lines.len());
            let h = 1.0 / f64::from(half);
            let error = lines[0].points.iter().map(|point| (point.length() - 0.5).abs()).fold(0.0, f64::max);
            // Interpolation of r² errs by at most h²·2/8·2 (the diagonal), the radius by 1/(2r) of it.
            assert!(error <= 0.5 * h * h + 1e-15 && error > 0.0, "h = {h}: {error:e}");
            assert!(last / error > 3.5, "quarters with the mesh width: {last:e}, {error:e}");
            last = error;
            let circumference = length(&lines[0]);
            assert!((circumference - std::f64::consts::PI).abs() < 2.0 * h * h * 4.0, "{circumference}");
        }
    }

    #[test]
    fn crossing_lines_go_straight_on() {
        // x² = y²: two lines that cross in a vertex, one along edges, one across.
        let lines = field(3, |point| point.x * point.x - point.y * point.y).isolines(0.0);
        assert_eq!(lines.len(), 2, "{lines:?}");
        for line in &lines {
            let ends = [line.points[0], line.points[line.points.len() - 1]];
            assert!((ends[0].distance(ends[1]) - 8f64.sqrt()).abs() < 1e-14, "{line:?}");
            assert!((length(line) - 8f64.sqrt()).abs() < 1e-14, "{line:?}");
        }
    }

    #[test]
    fn a_plateau_has_one_rim() {
        let lines = field(4, |point| (point.abs().max_element() - 0.5).max(0.0)).isolines(0.0);
        assert!(lines.len() == 1 && lines[0].is_closed, "{lines:?}");
        assert!((length(&lines[0]) - 4.0).abs() < 1e-14, "a square of side 1");
    }

    #[test]
    fn huge_values_do_not_overflow() {
        let lines = field(2, |point| point.x * f64::MAX).isolines(0.25 * f64::MAX);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(lines[0].points.iter().all(|point| (point.x - 0.25).abs() < 1e-15), "{lines:?}");
    }
}
