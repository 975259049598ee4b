//! What lies under a point of the page.

use glam::{DVec2, DVec3};

use crate::figure::scene::{EyeView, Points, Ray, Scene, SceneItem, Triangles};

/// A ray that makes a smaller angle (its sine) with a triangle's plane passes it.
const EDGE_ON: f64 = 1e-12;

/// A point near a place of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointHit {
    /// Its index.
    pub index: usize,
    /// Distance on the page in pt.
    pub distance: f64,
    /// Depth in world units.
    pub depth: f64,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Index of the triangle.
    pub triangle: usize,
    /// Weights of its corners at the point met; their sum is 1.
    pub weights: [f64; 3],
    /// Distance along the ray in world units.
    pub distance: f64,
    /// The point met.
    pub point: DVec3,
}

/// A thing of a scene that was hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneHit<T> {
    /// Index of the layer.
    pub layer: usize,
    /// Index of the item in its layer.
    pub item: usize,
    /// Where.
    pub hit: T,
}

/// The point whose picture is nearest to `page`, at most `within` pt away; the one in front if two are equally near.
pub fn nearest_point(view: &EyeView, points: &[DVec3], page: DVec2, within: f64) -> Option<PointHit> {
    let seen = points.iter().enumerate().filter_map(|(index, &point)| {
        let seen = view.project(point)?;
        Some(PointHit { index, distance: seen.page.distance(page), depth: seen.depth })
    });
    seen.filter(|hit| hit.distance <= within).min_by(before)
}

fn before(a: &PointHit, b: &PointHit) -> std::cmp::Ordering {
    a.distance.total_cmp(&b.distance).then(a.depth.total_cmp(&b.depth))
}

impl Ray {
    /// Where the ray meets a triangle, from either side: distance along the ray and weights of the corners (T. Möller,
    /// B. Trumbore, 1997).
    pub fn triangle(&self, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
        let (first, second) = (b - a, c - a);
        let across = self.direction.cross(second);
        let determinant = first.dot(across);
        if determinant.abs() <= EDGE_ON * first.length() * second.length() {
            return None;
        }
        let from_corner = self.origin - a;
        let u = from_corner.dot(across) / determinant;
        let other = from_corner.cross(first);
        let v = self.direction.dot(other) / determinant;
        let distance = second.dot(other) / determinant;
        let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance.is_finite();
        is_inside.then_some((distance, [1.0 - u - v, u, v]))
    }
}

impl Triangles {
    /// The nearest triangle under a place of the page; every triangle is asked.
    pub fn pick(&self, view: &EyeView, page: DVec2) -> Option<TriangleHit> {
        let ray = view.ray(page);
        let hits = (0..self.triangles().len()).filter_map(|triangle| {
            let (distance, weights) = ray.triangle(self.corners(triangle))?;
            let point = ray.origin + ray.direction * distance;
            // In parallel projection things behind the eye are seen too.
            let is_seen = view.eye.state().orthographic || view.eye.depth(point) > view.eye.near();
            is_seen.then_some(TriangleHit { triangle, weights, distance, point })
        });
        hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// The vertex whose picture is nearest to `page`, at most `within` pt away.
    pub fn pick_vertex(&self, view: &EyeView, page: DVec2, within: f64) -> Option<PointHit> {
        nearest_point(view, self.positions(), page, within)
    }
}

impl Scene {
    /// The nearest surface under a place of the page.
    pub fn pick_triangle(&self, view: &EyeView, page: DVec2) -> Option<SceneHit<TriangleHit>> {
        let hits = self.items().filter_map(|(layer, item, thing)| match thing {
            SceneItem::Triangles(triangles) => {
                triangles.pick(view, page).map(|hit| SceneHit { layer, item, hit })
            }
            _ => None,
        });
        hits.min_by(|a, b| a.hit.distance.total_cmp(&b.hit.distance))
    }

    /// The mark nearest to a place of the page, its rim at most `within` pt away. Marks that surfaces hide count too.
    pub fn pick_mark(&self, view: &EyeView, page: DVec2, within: f64) -> Option<SceneHit<PointHit>> {
        let reach = |points: &Points| within + 0.5 * points.size.max(0.0);
        let hits = self.items().filter_map(|(layer, item, thing)| match thing {
            SceneItem::Points(points) => nearest_point(view, points.points(), page, reach(points))
                .map(|hit| SceneHit { layer, item, hit }),
            _ => None,
        });
        hits.min_by(|a, b| before(&a.hit, &b.hit))
    }

    fn items(&self) -> impl Iterator<Item = (usize, usize, &SceneItem)> {
        self.layers.iter().enumerate().flat_map(|(layer, things)| {
            things.items.iter().enumerate().map(move |(item, thing)| (layer, item, thing))
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::figure::picture::{Color, MarkerShape};
    use crate::figure::scene::Eye;

    fn view(orthographic: bool) -> EyeView {
        EyeView { eye: Eye::default().with_orthographic(orthographic), size: DVec2::new(400.0, 300.0) }
    }

    fn squares(heights: &[f64]) -> Triangles {
        let positions = heights.iter().flat_map(|&z| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, z))
        });
        let triangles =
            (0..heights.len() as u32).flat_map(|k| [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| i + 4 * k)));
        Triangles::new(positions.collect(), triangles.collect(), Color::hex(0)).unwrap()
    }

    #[test]
    fn rays_through_a_point_of_a_triangle_hit_it_there() {
        let squares = squares(&[0.0, 1.0, -1.0]);
        for orthographic in [false, true] {
            let view = view(orthographic);
            let point = DVec3::new(0.25, -0.5, 1.0);
            let page = view.project(point).unwrap().page;
            let hit = squares.pick(&view, page).unwrap();
            assert!(hit.point.distance(point) < 1e-12, "{hit:?}");
            assert_eq!(hit.triangle, 2, "the upper square is in front, and x > y is its first half");
            let corners = squares.corners(hit.triangle);
            let mixed: DVec3 = (0..3).map(|i| corners[i] * hit.weights[i]).sum();
            assert!(mixed.distance(point) < 1e-12, "{mixed}");
            assert_eq!(squares.pick(&view, DVec2::ZERO), None, "beside");
        }
    }

    #[test]
    fn triangles_behind_the_eye_are_not_hit_in_perspective() {
        let (perspective, parallel) = (view(false), view(true));
        let middle = perspective.size * 0.5;
        let behind = squares(&[100.0]);
        let eye_above = |view: EyeView| EyeView { eye: view.eye.orbited(0.0, 3.0), ..view };
        assert_eq!(behind.pick(&eye_above(perspective), middle), None, "perspective");
        assert!(behind.pick(&eye_above(parallel), middle).is_some(), "parallel");
    }

    #[test]
    fn the_nearest_mark_within_reach_is_picked() {
        let view = view(false);
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::ZERO + view.eye.axes().towards];
        let marks = Points::new(points.clone(), MarkerShape::Disc, 6.0, Color::hex(0)).unwrap();
        let mut scene = Scene::new(None);
        scene.push_layer("net", vec![SceneItem::Triangles(squares(&[0.0])), SceneItem::Points(marks)]);
        let at = view.project(DVec3::X).unwrap().page + DVec2::new(3.0, 4.0);
        let found = scene.pick_mark(&view, at, 2.5).unwrap();
        assert_eq!((found.layer, found.item, found.hit.index), (0, 1, 1), "{found:?}");
        assert!((found.hit.distance - 5.0).abs() < 1e-9, "{found:?}");
        assert_eq!(scene.pick_mark(&view, at, 1.5), None, "5 pt are more than 1.5 and the radius");
        let middle = scene.pick_mark(&view, view.size * 0.5, 1.0).unwrap();
        assert!([0, 2].contains(&middle.hit.index), "one of the two in the middle");
        let vertex =
            squares(&[0.0]).pick_vertex(&view, view.project(DVec3::new(1.0, 1.0, 0.0)).unwrap().page, 1.0);
        assert_eq!(vertex.map(|hit| hit.index), Some(2), "a corner");
        assert_eq!(nearest_point(&view, &points, DVec2::NAN, 1e9), None, "no place");
    }

    proptest! {
        /// Weights that are positive give a point that every ray through it finds; one negative weight, a miss.
        #[test]
        fn a_triangle_is_hit_exactly_inside(
            u in 0.01f64..0.49, v in 0.01f64..0.49, from in prop::array::uniform3(-5.0f64..5.0),
        ) {
            let corners = [DVec3::ZERO, DVec3::new(2.0, 0.5, 0.0), DVec3::new(-0.5, 1.5, 1.0)];
            let at = |u: f64, v: f64| corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v;
            let origin = DVec3::from_array(from) + (corners[1].cross(corners[2])).normalize() * 20.0;
            let ray = |to: DVec3| Ray { origin, direction: (to - origin).normalize() };
            let (distance, weights) = ray(at(u, v)).triangle(corners).unwrap();
            prop_assert!((weights[1] - u).abs() + (weights[2] - v).abs() < 1e-9, "{weights:?}");
            prop_assert!((distance - at(u, v).distance(origin)).abs() < 1e-9, "{distance}");
            for outside in [at(-u, v), at(u, -v), at(1.0 - u, u + v)] {
                prop_assert!(ray(outside).triangle(corners).is_none(), "{outside}");
            }
        }
    }
}
