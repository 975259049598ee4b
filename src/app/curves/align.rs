//! Selected control points into line: one x, one y, the grid, equal steps.

use glam::DVec2;

use crate::app::command::Command;
use crate::app::hands::{fine_step, viewport_of};
use crate::app::lab::Lab;
use crate::document::Edit;

/// Carries out an aligning command; `false` if `command` is another one or there is nothing to align.
pub(super) fn execute(command: Command, lab: &mut Lab) -> bool {
    let (Some(object), Some(curve)) = (lab.selection.object, lab.curve()) else { return false };
    let chosen: Vec<usize> =
        lab.selection.points.iter().copied().filter(|&k| k < curve.points().len()).collect();
    let mut positions = curve.points().to_vec();
    let places: Vec<DVec2> = chosen.iter().map(|&k| positions[k]).collect();
    let step = fine_step(&viewport_of(&lab.view.camera, lab.canvas_size));
    let Some(aligned) = aligned(command, &places, step) else { return false };
    for (&k, place) in chosen.iter().zip(aligned) {
        positions[k] = place;
    }
    let label = command.text().0.to_owned();
    lab.edit(Edit::Batch { label, edits: vec![Edit::SetPoints { object, positions }] });
    true
}

/// The places after `command`; `step` is the distance of the grid's lines.
fn aligned(command: Command, places: &[DVec2], step: f64) -> Option<Vec<DVec2>> {
    let (&first, &last) = (places.first()?, places.last()?);
    let mean = first + places.iter().map(|&place| (place - first) / places.len() as f64).sum::<DVec2>();
    let change = |change: &dyn Fn(usize, DVec2) -> DVec2| {
        Some(places.iter().enumerate().map(|(k, &place)| change(k, place)).collect())
    };
    match command {
        Command::AlignX => change(&|_, place| DVec2::new(mean.x, place.y)),
        Command::AlignY => change(&|_, place| DVec2::new(place.x, mean.y)),
        Command::AlignGrid => change(&|_, place| (place / step).round() * step),
        Command::Distribute => {
            let steps = (places.len() - 1).max(1) as f64;
            change(&|k, _| first.lerp(last, k as f64 / steps))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_come_into_line() {
        let places = [[0.0, 0.1], [1.2, 3.0], [6.0, 2.0]].map(DVec2::from);
        let x = aligned(Command::AlignX, &places, 0.5).unwrap();
        assert!(x.iter().all(|place| (place.x - 2.4).abs() < 1e-15), "{x:?}");
        assert_eq!(x[1].y, 3.0, "y stays");
        let y = aligned(Command::AlignY, &places, 0.5).unwrap();
        assert!(y.iter().all(|place| (place.y - 1.7).abs() < 1e-15) && y[2].x == 6.0, "{y:?}");
        let grid = aligned(Command::AlignGrid, &places, 0.5).unwrap();
        assert_eq!(grid, [[0.0, 0.0], [1.0, 3.0], [6.0, 2.0]].map(DVec2::from), "the grid");
        let even = aligned(Command::Distribute, &places, 0.5).unwrap();
        assert_eq!((even[0], even[2]), (places[0], places[2]), "the ends stay");
        assert!(even[1].distance(places[0].midpoint(places[2])) < 1e-15, "in the middle");
    }
}
