//! What lies under the pointer.

use glam::DVec2;

use crate::document::Approximation;
use crate::figure::approximation::Layout;

/// Points within which a datum or a knot is taken.
const REACH: f64 = 10.0;
/// Half the height of a line of knots.
const ROW_REACH: f64 = 9.0;
/// More data than so many near the pointer are not searched one by one.
const MOST_NEAR: usize = 20_000;

/// The thing under the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Target {
    /// Nothing to take.
    #[default]
    Nothing,
    /// A datum.
    Datum(usize),
    /// A knot of a method: index of the method, of the knot in its list.
    Knot(usize, usize),
    /// The line of knots of a method whose knots can be changed, at a number.
    Row(usize, f64),
    /// A knot of a line that follows from the data, or that can only become movable by taking it.
    FixedRow(usize),
}

/// The target at a place of the page.
pub(super) fn target_at(approximation: &Approximation, layout: &Layout, page: DVec2) -> Target {
    for row in &layout.rows {
        if (page.y - row.y).abs() > ROW_REACH || page.x < layout.main.low.x - REACH {
            continue;
        }
        let has_knots = approximation.methods().get(row.method).is_some_and(|m| m.scheme.space().is_some());
        if !has_knots {
            return Target::FixedRow(row.method);
        }
        let (at, _) = layout.main.numbers(page);
        let reach = REACH * layout.main.per_point().x;
        let first = row.knots.partition_point(|&knot| knot < at - reach);
        let near = row.knots[first..].iter().take_while(|&&knot| knot <= at + reach).enumerate();
        let nearest = near.min_by(|a, b| (a.1 - at).abs().total_cmp(&(b.1 - at).abs()));
        return match nearest {
            Some((index, _)) => Target::Knot(row.method, first + index),
            None => Target::Row(row.method, at),
        };
    }
    nearest_datum(approximation, layout, page).map_or(Target::Nothing, Target::Datum)
}

fn nearest_datum(approximation: &Approximation, layout: &Layout, page: DVec2) -> Option<usize> {
    let main = &layout.main;
    let (at, _) = main.numbers(page);
    let reach = REACH * main.per_point().x;
    let (sites, values) = (approximation.sites(), approximation.values());
    let first = sites.partition_point(|&site| site < at - reach);
    let last = sites.partition_point(|&site| site <= at + reach);
    let near = first..last.min(first + MOST_NEAR);
    let distance = |index: usize| main.place(sites[index], values[index]).distance(page);
    let near = near.map(|index| (index, distance(index))).filter(|(_, distance)| *distance <= REACH);
    near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
}
