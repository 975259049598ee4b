//! Fewer triangles for the moment: what a processor that plays GPU draws while the eye moves.
//!
//! Vertices in the same cell of a cubic lattice become one of them (vertex clustering, J. Rossignac and P. Borrel, 1993). What
//! was closed stays closed, and no vertex moves by more than a cell.

use std::collections::HashMap;

use glam::{UVec3, Vec3};

/// Cells along the longest side of the box around everything.
const CELLS: f32 = 96.0;

/// The corners of those `triangles`, three each, that keep three different vertices, each vertex replaced by the first of its
/// cell.
pub(super) fn coarse(places: &[Vec3], triangles: &[u32]) -> Vec<u32> {
    let (low, high) = places
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &place| (low.min(place), high.max(place)));
    let side = (high - low).max_element();
    if !(side.is_finite() && side > 0.0) {
        return triangles.to_vec();
    }
    let cell = |place: Vec3| ((place - low) * (CELLS / side)).as_uvec3();
    let mut first: HashMap<UVec3, u32> = HashMap::new();
    let instead: Vec<u32> =
        (0u32..).zip(places).map(|(k, &place)| *first.entry(cell(place)).or_insert(k)).collect();
    let corners = triangles.as_chunks::<3>().0.iter().map(|corners| corners.map(|k| instead[k as usize]));
    corners.filter(|[a, b, c]| a != b && b != c && c != a).flatten().collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    /// A square sheet of `2·n²` triangles, a little bent.
    fn sheet(n: u32) -> (Vec<Vec3>, Vec<u32>) {
        let row = n + 1;
        let place = |k: u32| Vec3::new((k % row) as f32, (k / row) as f32, 0.1 * (k % row) as f32) / n as f32;
        let cells = (0..n * n).map(|k| k / n * row + k % n);
        let triangles = cells.flat_map(|k| [k, k + 1, k + row, k + 1, k + row + 1, k + row]).collect();
        ((0..row * row).map(place).collect(), triangles)
    }

    #[test]
    fn few_triangles_stay_as_they_are() {
        let (places, triangles) = sheet(20);
        assert_eq!(coarse(&places, &triangles), triangles, "no two vertices share a cell");
        let point = vec![Vec3::ONE; 3];
        assert_eq!(coarse(&point, &[0, 1, 2]), [0, 1, 2], "a box without a side");
        assert!(coarse(&[], &[]).is_empty(), "nothing");
    }

    #[test]
    fn many_become_few_without_gaps() {
        let (places, triangles) = sheet(500);
        let found = coarse(&places, &triangles);
        let most = 2 * 3 * (CELLS as usize + 1).pow(2);
        assert!(found.len() < most && found.len() > most / 3, "{} corners", found.len());
        // An edge inside the sheet belongs to two triangles, one in each direction.
        let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
        for [a, b, c] in found.as_chunks::<3>().0 {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((*from.min(to), *from.max(to))).or_default() += if from < to { 1 } else { -1 };
            }
        }
        let is_rim = |k: u32| {
            let place = places[k as usize];
            [place.x, place.y].iter().any(|part| !(0.02..=0.98).contains(part))
        };
        let open = edges.iter().filter(|(_, sum)| **sum != 0);
        let gap = open.clone().find(|((a, b), _)| !is_rim(*a) || !is_rim(*b));
        assert!(gap.is_none(), "{gap:?}");
        assert!(open.count() > 100, "the rim is open");
    }
}
