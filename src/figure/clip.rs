//! What of a line or a path lies in a box.

use glam::DVec2;

use crate::core::point::Point as _;
use crate::figure::picture::Segment;

/// A cubic is cut into halves at most so often.
const MOST_HALVINGS: u32 = 60;

/// The parts of a polyline inside a box.
pub fn polyline_in_box(line: &[DVec2], low: DVec2, high: DVec2) -> Vec<Vec<DVec2>> {
    let mut parts: Vec<Vec<DVec2>> = Vec::new();
    let mut continues = false;
    for ends in line.windows(2) {
        let Some((start, end)) = segment_in_box(ends[0], ends[1], low, high) else {
            continues = false;
            continue;
        };
        match parts.last_mut() {
            Some(part) if continues && start == ends[0] => part.push(end),
            _ => parts.push(vec![start, end]),
        }
        continues = end == ends[1];
    }
    parts
}

/// The part of a segment inside a box, by the method of Liang and Barsky; `None` if it is outside.
pub fn segment_in_box(a: DVec2, b: DVec2, low: DVec2, high: DVec2) -> Option<(DVec2, DVec2)> {
    let along = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (speed, room) in
        [(-along.x, a.x - low.x), (along.x, high.x - a.x), (-along.y, a.y - low.y), (along.y, high.y - a.y)]
    {
        if speed > 0.0 {
            to = to.min(room / speed);
        } else if speed < 0.0 {
            from = from.max(room / speed);
        } else if room < 0.0 {
            return None;
        }
    }
    let start = if from > 0.0 { a + along * from } else { a };
    let end = if to < 1.0 { a + along * to } else { b };
    (from <= to).then_some((start, end))
}

/// The parts of an open, unfilled path that come near a box: at most its width and height away.
///
/// What is dropped lies outside the box; lines are cut, cubics are halved, which changes no place of what is kept. Programs that
/// count in single precision can draw the result where they could not draw the whole, millions of times the box.
pub fn path_near_box(segments: &[Segment], low: DVec2, high: DVec2) -> Vec<Segment> {
    let extent = high - low;
    let (low, high) = (low - extent, high + extent);
    let mut near = NearPath { low, high, segments: Vec::new(), end: None };
    let (mut start, mut from) = (DVec2::ZERO, DVec2::ZERO);
    for &segment in segments {
        match segment {
            Segment::Move(to) => {
                (start, from) = (to, to);
                continue;
            }
            Segment::Line(to) => near.line(from, to),
            Segment::Cubic(a, b, to) => near.cubic([from, a, b, to]),
            Segment::Close => near.line(from, start),
        }
        from = match segment {
            Segment::Move(to) | Segment::Line(to) | Segment::Cubic(_, _, to) => to,
            Segment::Close => start,
        };
    }
    near.segments
}

struct NearPath {
    low: DVec2,
    high: DVec2,
    segments: Vec<Segment>,
    end: Option<DVec2>,
}

impl NearPath {
    fn go_on(&mut self, from: DVec2, segment: Segment, to: DVec2) {
        if self.end != Some(from) {
            self.segments.push(Segment::Move(from));
        }
        self.segments.push(segment);
        self.end = Some(to);
    }

    fn line(&mut self, from: DVec2, to: DVec2) {
        if let Some((a, b)) = segment_in_box(from, to, self.low, self.high) {
            self.go_on(a, Segment::Line(b), b);
        }
    }

    fn cubic(&mut self, whole: [DVec2; 4]) {
        // The first part on top.
        let mut parts = vec![(whole, 0)];
        while let Some((points, halvings)) = parts.pop() {
            let [a, b, c, d] = points;
            let (least, greatest) = (a.min(b).min(c).min(d), a.max(b).max(c).max(d));
            let is_outside = greatest.cmplt(self.low).any() || least.cmpgt(self.high).any();
            let is_small = (greatest - least).cmple(self.high - self.low).all();
            if is_outside {
                continue;
            }
            if is_small || halvings >= MOST_HALVINGS {
                self.go_on(a, Segment::Cubic(b, c, d), d);
                continue;
            }
            let (ab, bc, cd) = (a.mix(b, 0.5), b.mix(c, 0.5), c.mix(d, 0.5));
            let (abc, bcd) = (ab.mix(bc, 0.5), bc.mix(cd, 0.5));
            let middle = abc.mix(bcd, 0.5);
            parts.push(([middle, bcd, cd, d], halvings + 1));
            parts.push(([a, ab, abc, middle], halvings + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clipping_keeps_what_is_inside() {
        let (low, high) = (DVec2::ZERO, DVec2::ONE);
        let line = [
            DVec2::new(-1.0, 0.5),
            DVec2::new(0.5, 0.5),
            DVec2::new(0.5, 2.0),
            DVec2::new(0.75, 2.0),
            DVec2::new(0.75, 0.0),
        ];
        let parts = polyline_in_box(&line, low, high);
        let expected = vec![
            vec![DVec2::new(0.0, 0.5), DVec2::new(0.5, 0.5), DVec2::new(0.5, 1.0)],
            vec![DVec2::new(0.75, 1.0), DVec2::new(0.75, 0.0)],
        ];
        assert_eq!(parts, expected, "in at the left, out and in again above");
    }

    #[test]
    fn what_is_near_stays_and_what_is_far_goes() {
        let (low, high) = (DVec2::ZERO, DVec2::splat(100.0));
        let inside = [
            Segment::Move(DVec2::ZERO),
            Segment::Cubic(DVec2::X, DVec2::ONE, DVec2::splat(50.0)),
            Segment::Line(DVec2::splat(60.0)),
        ];
        assert_eq!(path_near_box(&inside, low, high), inside, "all of it is near");
        let outside = [Segment::Move(DVec2::splat(1e9)), Segment::Line(DVec2::splat(2e9)), Segment::Close];
        assert_eq!(path_near_box(&outside, low, high), [], "none of it is near");
    }

    #[test]
    fn the_near_part_of_a_huge_cubic_is_the_same_curve() {
        let size = 1e9;
        let cubic =
            [DVec2::new(-1.0, 0.2), DVec2::new(-0.4, -0.3), DVec2::new(0.4, 0.3), DVec2::new(1.0, -0.2)];
        let cubic = cubic.map(|point| point * size);
        let path = [Segment::Move(cubic[0]), Segment::Cubic(cubic[1], cubic[2], cubic[3])];
        let near = path_near_box(&path, DVec2::splat(-200.0), DVec2::splat(200.0));
        assert!(near.len() > 1 && near.len() < 12, "{} steps", near.len());
        let mut from = DVec2::ZERO;
        for segment in near {
            match segment {
                Segment::Move(to) => from = to,
                Segment::Cubic(a, b, to) => {
                    assert!(a.abs().max_element().max(b.abs().max_element()) < 3e3, "{segment:?}");
                    // The curve is odd: its derivative at the origin is 3/2 of the sum of its last two control points.
                    let slope = (cubic[3].y + cubic[2].y) / (cubic[3].x + cubic[2].x);
                    let error = (to.y - from.y) - slope * (to.x - from.x);
                    assert!(error.abs() < 1e-2, "{error} beside the tangent");
                    from = to;
                }
                other => panic!("{other:?}"),
            }
        }
    }
}
