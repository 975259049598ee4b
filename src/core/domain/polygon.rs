//! Polygons as Boolean trees of half planes.
//!
//! A convex polygon is the intersection of the half planes of its sides. Any other one is the intersection for its convex hull minus its pockets:
//! a pocket lies between a side of the hull that is not a side of the polygon and the chain of sides that it skips, and is a polygon again, whose side
//! on the hull needs no half plane of its own. Every side of the polygon enters exactly once.
//!
//! S. Tor, A. Middleditch, *Convex decomposition of simple polygons*, 1984.

use glam::DVec2;

use crate::core::domain::boolean::Domain;
use crate::core::domain::error::DomainError;
use crate::core::domain::primitive::check_finite;

impl Domain {
    /// The inside of the polygon with these vertices, in either direction of turn.
    ///
    /// # Errors
    ///
    /// `TooFewData` below 3 vertices, `NonFinite` (index of the coordinate), `Degenerate` (a side without length, or no area), `NoSolution` when two sides
    /// meet elsewhere than at a common end.
    pub fn polygon(vertices: &[DVec2]) -> Result<Self, DomainError> {
        let count = vertices.len();
        if count < 3 {
            return Err(DomainError::TooFewData { found: count });
        }
        check_finite("coordinate", &vertices.iter().flat_map(|v| v.to_array()).collect::<Vec<_>>())?;
        let side = |i: usize| (vertices[i], vertices[(i + 1) % count]);
        if (0..count).any(|i| side(i).0 == side(i).1) {
            return Err(DomainError::Degenerate { what: "side of the polygon" });
        }
        for first in 0..count {
            for second in first + 1..count {
                let neighbours = second == first + 1 || (first == 0 && second == count - 1);
                let (a, b) = (side(first), side(second));
                let meet = match neighbours {
                    // A side that folds back on its neighbour.
                    true if second == first + 1 => folds_back(a.0, a.1, b.1),
                    true => folds_back(b.0, b.1, a.1),
                    false => segments_meet(a, b),
                };
                if meet {
                    return Err(DomainError::NoSolution { first, second });
                }
            }
        }
        let area: f64 = (0..count).map(|i| (side(i).0 - vertices[0]).perp_dot(side(i).1 - vertices[0])).sum();
        if area == 0.0 {
            return Err(DomainError::Degenerate { what: "area of the polygon" });
        }
        let mut chain = vertices.to_vec();
        if area < 0.0 {
            chain.reverse();
        }
        let on_hull = convex_hull(&chain)[0];
        chain.rotate_left(on_hull);
        let mut corners = convex_hull(&chain);
        chain.push(chain[0]);
        corners.push(count);
        left_of_chain(&chain, &corners)
    }
}

/// The points to the left of a chain with the given corners of its convex hull, correct on the hull's side of its ends.
fn left_of_chain(chain: &[DVec2], corners: &[usize]) -> Result<Domain, DomainError> {
    let mut region: Option<Domain> = None;
    for pair in corners.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let direction = chain[to] - chain[from];
        let mut part = Domain::half_plane(chain[from], direction.perp())?;
        let skipped = &chain[from + 1..to];
        if skipped.iter().any(|v| direction.perp_dot(*v - chain[from]) != 0.0) {
            // Seen from the pocket the chain runs the other way.
            let pocket: Vec<DVec2> = chain[from..=to].iter().rev().copied().collect();
            let corners = convex_hull(&pocket);
            part = part.difference(left_of_chain(&pocket, &corners)?);
        }
        region = Some(match region {
            Some(region) => region.intersection(part),
            None => part,
        });
    }
    region.ok_or(DomainError::TooFewData { found: chain.len() })
}

/// Indices of the corners of the convex hull, turning left, from the smallest index on (Andrew's monotone chains).
///
/// Along a simple polygon that turns left the indices increase.
fn convex_hull(points: &[DVec2]) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..points.len()).collect();
    sorted.sort_by(|&i, &j| points[i].x.total_cmp(&points[j].x).then(points[i].y.total_cmp(&points[j].y)));
    let half = |indices: &mut dyn Iterator<Item = usize>| {
        let mut hull: Vec<usize> = Vec::new();
        for i in indices {
            while let [.., a, b] = hull[..] {
                if (points[b] - points[a]).perp_dot(points[i] - points[b]) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(i);
        }
        hull.pop();
        hull
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    let smallest = (0..hull.len()).min_by_key(|&place| hull[place]).unwrap_or(0);
    hull.rotate_left(smallest);
    hull
}

/// Whether `bc` runs back along `ab`.
fn folds_back(a: DVec2, b: DVec2, c: DVec2) -> bool {
    (b - a).perp_dot(c - b) == 0.0 && (b - a).dot(c - b) < 0.0
}

/// Whether two closed segments have a common point.
fn segments_meet((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let within = |p: DVec2, q: DVec2, r: DVec2| (r.cmpge(p.min(q)) & r.cmple(p.max(q))).all();
    let (sc, sd, sa, sb) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    (sc * sd < 0.0 && sa * sb < 0.0)
        || (sc == 0.0 && within(a, b, c))
        || (sd == 0.0 && within(a, b, d))
        || (sa == 0.0 && within(c, d, a))
        || (sb == 0.0 && within(c, d, b))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
        list.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
    }

    /// The rule of odd crossings, by definition.
    fn inside(vertices: &[DVec2], x: DVec2) -> bool {
        let mut odd = false;
        for i in 0..vertices.len() {
            let (a, b) = (vertices[i], vertices[(i + 1) % vertices.len()]);
            if (a.y > x.y) != (b.y > x.y) {
                odd ^= x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x);
            }
        }
        odd
    }

    #[test]
    fn the_tree_contains_what_odd_crossings_say() {
        let shapes = [
            points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 2.0), (2.0, 4.0), (0.0, 4.0)]),
            // A pocket that is wider inside than at its mouth, with a spike in it.
            points(&[
                (0.0, 0.0),
                (4.0, 0.0),
                (4.0, 4.0),
                (2.2, 4.0),
                (3.0, 1.0),
                (2.0, 2.0),
                (1.0, 1.0),
                (1.8, 4.0),
                (0.0, 4.0),
            ]),
            // A spiral.
            points(&[
                (0.0, 0.0),
                (4.0, 0.0),
                (4.0, 4.0),
                (1.0, 4.0),
                (1.0, 1.5),
                (2.5, 1.5),
                (2.5, 3.0),
                (2.0, 3.0),
                (2.0, 2.0),
                (1.5, 2.0),
                (1.5, 3.5),
                (3.5, 3.5),
                (3.5, 0.5),
                (0.0, 0.5),
            ]),
            // A vertex on a straight side.
            points(&[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (2.0, 3.0)]),
        ];
        for (number, mut vertices) in shapes.into_iter().enumerate() {
            for turn in 0..2 * vertices.len() {
                let domain = Domain::polygon(&vertices).unwrap();
                for i in 0..45 {
                    for j in 0..45 {
                        let x = DVec2::new(f64::from(i) - 2.0, f64::from(j) - 2.0) * 0.103;
                        let wanted = inside(&vertices, x);
                        assert_eq!(domain.contains(x), wanted, "shape {number}, turn {turn}, {x}");
                    }
                }
                vertices.rotate_left(1);
                if turn + 1 == vertices.len() {
                    vertices.reverse();
                }
            }
        }
    }

    #[test]
    fn impossible_polygons_are_refused() {
        let name = |list: &[(f64, f64)]| Domain::polygon(&points(list)).unwrap_err().name();
        assert_eq!(name(&[(0.0, 0.0), (1.0, 0.0)]), "TooFewData", "two vertices");
        assert_eq!(name(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]), "Degenerate", "a side without length");
        assert_eq!(name(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]), "NoSolution", "crossing sides");
        assert_eq!(name(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.0)]), "NoSolution", "sides fold back");
        assert_eq!(name(&[(0.0, 0.0), (1.0, f64::NAN), (0.5, 0.0)]), "NonFinite", "NaN");
    }
}
