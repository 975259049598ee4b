//! A binary tree of boxes over items of any kind: Bezier pieces, segments, triangles.
//!
//! The items are divided by medians of their centres along the longest side of the box of all centres, so that a node gets four children of equal size. The four boxes
//! stand side by side and are looked at together. A tree over `N` items takes memory linear in `N`, is built in `O(N log N)` and has depth `log₄ N` whatever
//! the items look like. All queries are one walk: a box is passed over if its key, which no item in it can undercut, reaches the limit, and the box with the
//! smallest key comes first, so that the limit falls early. Queries for one place do not allocate. J. Goldsmith, J. Salmon, *Automatic creation of object hierarchies
//! for ray tracing*, 1987, for trees of boxes; N. Roussopoulos, S. Kelley, F. Vincent, *Nearest neighbor queries*, 1995, for the walk.

use thiserror::Error;

/// Boxes of a node.
const WIDTH: usize = 4;
/// The walk keeps up to three waiting boxes for each level and the four of the last; a tree over fewer than 2³² items has at most 16 levels.
const MAX_WAITING: usize = 3 * 16 + WIDTH;

/// What can be wrong with boxes.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BoundingTreeError {
    /// No points.
    #[error("a box of no points")]
    Empty,
    /// A coordinate is infinite or not a number.
    #[error("coordinate {axis} is {value}, not a finite number")]
    NonFinite {
        /// The index of the coordinate.
        axis: usize,
        /// The number.
        value: f64,
    },
    /// The low corner is above the high one.
    #[error("the box reaches from {low} to {high} along axis {axis}")]
    EmptyInterval {
        /// The index of the coordinate.
        axis: usize,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// More items than indices.
    #[error("{value} items are above the limit {limit}")]
    StepLimit {
        /// The number of items.
        value: usize,
        /// The largest possible number.
        limit: usize,
    },
}

impl BoundingTreeError {
    /// The name of the error in the conventions of the course.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty => "Empty",
            Self::NonFinite { .. } => "NonFinite",
            Self::EmptyInterval { .. } => "EmptyInterval",
            Self::StepLimit { .. } => "StepLimit",
        }
    }
}

/// The points `x` with `low ≤ x ≤ high` in every coordinate, all finite; it may be flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox<const D: usize> {
    low: [f64; D],
    high: [f64; D],
}

impl<const D: usize> BoundingBox<D> {
    /// The box between two corners.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `EmptyInterval`.
    pub fn new(low: [f64; D], high: [f64; D]) -> Result<Self, BoundingTreeError> {
        for axis in 0..D {
            let (low, high) = (low[axis], high[axis]);
            if let Some(value) = [low, high].into_iter().find(|value| !value.is_finite()) {
                return Err(BoundingTreeError::NonFinite { axis, value });
            }
            if low > high {
                return Err(BoundingTreeError::EmptyInterval { axis, low, high });
            }
        }
        Ok(Self { low, high })
    }

    /// The smallest box that contains all `points`.
    ///
    /// # Errors
    ///
    /// `Empty`, `NonFinite`.
    pub fn of_points(points: impl IntoIterator<Item = [f64; D]>) -> Result<Self, BoundingTreeError> {
        let mut bounds: Option<Self> = None;
        for point in points {
            let point = Self::new(point, point)?;
            bounds = Some(bounds.map_or(point, |bounds| bounds.union(&point)));
        }
        bounds.ok_or(BoundingTreeError::Empty)
    }

    /// The corner with the smallest coordinates.
    pub fn low(&self) -> [f64; D] {
        self.low
    }

    /// The corner with the largest coordinates.
    pub fn high(&self) -> [f64; D] {
        self.high
    }

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let mut both = *self;
        for axis in 0..D {
            both.low[axis] = both.low[axis].min(other.low[axis]);
            both.high[axis] = both.high[axis].max(other.high[axis]);
        }
        both
    }

    /// The squared distance of a point, 0 inside.
    pub fn distance_squared(&self, point: &[f64; D]) -> f64 {
        let outside =
            |axis: usize| (self.low[axis] - point[axis]).max(point[axis] - self.high[axis]).max(0.0);
        (0..D).map(|axis| outside(axis) * outside(axis)).sum()
    }

    /// Whether no coordinate keeps the boxes further apart than `gap`.
    pub fn is_near(&self, other: &Self, gap: f64) -> bool {
        (0..D)
            .all(|axis| self.low[axis] - other.high[axis] <= gap && other.low[axis] - self.high[axis] <= gap)
    }

    /// The smallest `s ≥ 0` for which `origin + s·direction` is in the box; infinite if the ray misses it.
    pub fn entry(&self, origin: &[f64; D], direction: &[f64; D]) -> f64 {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..D {
            if direction[axis] == 0.0 {
                if origin[axis] < self.low[axis] || origin[axis] > self.high[axis] {
                    return f64::INFINITY;
                }
                continue;
            }
            let [a, b] = [self.low[axis], self.high[axis]].map(|x| (x - origin[axis]) / direction[axis]);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        if enter <= leave { enter } else { f64::INFINITY }
    }

    fn centre(&self, axis: usize) -> f64 {
        0.5 * self.low[axis] + 0.5 * self.high[axis]
    }
}

/// Four boxes side by side, so that their keys are computed together. A lane without a box has an empty one, infinitely far from everything.
#[derive(Clone, Debug)]
struct Node<const D: usize> {
    low: [Lanes; D],
    high: [Lanes; D],
    links: [Link; WIDTH],
}

/// One number for each box of a node.
type Lanes = [f64; WIDTH];

/// What stands in a lane of a node: another node or an item.
#[derive(Clone, Copy, Debug)]
enum Link {
    Node(u32),
    Item(u32),
}

impl<const D: usize> Node<D> {
    const EMPTY: Self = Self {
        low: [[f64::INFINITY; WIDTH]; D],
        high: [[f64::NEG_INFINITY; WIDTH]; D],
        links: [Link::Item(u32::MAX); WIDTH],
    };

    fn put(&mut self, lane: usize, bounds: &BoundingBox<D>, link: Link) {
        for axis in 0..D {
            self.low[axis][lane] = bounds.low[axis];
            self.high[axis][lane] = bounds.high[axis];
        }
        self.links[lane] = link;
    }

    fn bounds(&self, lane: usize) -> BoundingBox<D> {
        BoundingBox { low: self.low.map(|lanes| lanes[lane]), high: self.high.map(|lanes| lanes[lane]) }
    }

    /// Which boxes are not further than `gap` from `other` in any coordinate; empty ones are near nothing.
    #[inline(always)]
    fn near(&self, other: &BoundingBox<D>, gap: f64) -> [bool; WIDTH] {
        let mut is_near = [true; WIDTH];
        for axis in 0..D {
            let (low, high) = (other.low[axis] - gap, other.high[axis] + gap);
            for (lane, near) in is_near.iter_mut().enumerate() {
                *near &= (self.low[axis][lane] <= high) & (self.high[axis][lane] >= low);
            }
        }
        is_near
    }

    /// The number of boxes.
    fn count(&self) -> usize {
        let is_free = |link: &Link| matches!(link, Link::Item(u32::MAX));
        self.links.iter().position(is_free).unwrap_or(WIDTH)
    }

    /// A number for each box, infinite for lanes without one.
    fn keys(&self, key: impl Fn(&BoundingBox<D>) -> f64) -> Lanes {
        let mut keys = [f64::INFINITY; WIDTH];
        for lane in 0..self.count() {
            keys[lane] = key(&self.bounds(lane));
        }
        keys
    }

    /// The squared distances of a point, infinite for lanes without a box.
    fn distances_squared(&self, point: &[f64; D]) -> Lanes {
        let mut keys = [0.0; WIDTH];
        for axis in 0..D {
            let (low, high, x) = (&self.low[axis], &self.high[axis], point[axis]);
            for lane in 0..WIDTH {
                let outside = larger(larger(low[lane] - x, x - high[lane]), 0.0);
                keys[lane] += outside * outside;
            }
        }
        keys
    }
}

/// The larger number, `b` if one is none; one instruction, unlike `f64::max`.
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A tree over boxes, which are known by their index in the list it was built from.
#[derive(Clone, Debug)]
pub struct BoundingTree<const D: usize> {
    /// The first is the root.
    nodes: Vec<Node<D>>,
    len: usize,
    bounds: Option<BoundingBox<D>>,
}

impl<const D: usize> BoundingTree<D> {
    /// The tree over `boxes`; none give a tree in which nothing is found.
    ///
    /// # Errors
    ///
    /// `StepLimit` for 2³² boxes or more.
    pub fn new(boxes: &[BoundingBox<D>]) -> Result<Self, BoundingTreeError> {
        let limit = u32::MAX as usize;
        if boxes.len() > limit {
            return Err(BoundingTreeError::StepLimit { value: boxes.len(), limit });
        }
        let mut items: Vec<(u32, BoundingBox<D>)> = (0_u32..).zip(boxes.iter().copied()).collect();
        let bounds = boxes.iter().copied().reduce(|all, item| all.union(&item));
        let mut tree = Self { nodes: Vec::with_capacity(boxes.len() / 2), len: boxes.len(), bounds };
        if !items.is_empty() {
            tree.grow(&mut items);
        }
        Ok(tree)
    }

    /// Adds the node over `items` and everything below it; returns its index.
    fn grow(&mut self, items: &mut [(u32, BoundingBox<D>)]) -> u32 {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        // Full children: only the last one has less than a power of four.
        let mut share = 1;
        while WIDTH * share < items.len() {
            share *= WIDTH;
        }
        let (left, right) = divide(items, 2 * share);
        let (quarters, others) = (divide(left, share), divide(right, share));
        for (lane, part) in [quarters.0, quarters.1, others.0, others.1].into_iter().enumerate() {
            let Some(first) = part.first() else { continue };
            let bounds = part.iter().fold(first.1, |all, (_, item)| all.union(item));
            let link = if part.len() == 1 { Link::Item(first.0) } else { Link::Node(self.grow(part)) };
            self.nodes[index].put(lane, &bounds, link);
        }
        index as u32
    }

    /// The number of items.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no items.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The box of all items.
    pub fn bounds(&self) -> Option<BoundingBox<D>> {
        self.bounds
    }

    /// Visits the items whose boxes are nearer to `point` than the square root of the limit, near ones early. `visit` is given an item and the limit, the square of a
    /// distance, and returns the new limit: the squared distance of the item if that is smaller. The last limit is returned.
    ///
    /// ```
    /// use spline_lab::core::bounding_tree::{BoundingBox, BoundingTree};
    ///
    /// let places = [[0.0, 0.0], [3.0, 1.0], [5.0, 5.0]];
    /// let boxes = places.map(|place| BoundingBox::new(place, place).expect("finite"));
    /// let tree = BoundingTree::new(&boxes)?;
    /// let mut nearest = None;
    /// let squared = tree.nearest([4.0, 1.0], f64::INFINITY, |item, limit| {
    ///     let squared = boxes[item].distance_squared(&[4.0, 1.0]);
    ///     if squared < limit {
    ///         nearest = Some(item);
    ///     }
    ///     squared.min(limit)
    /// });
    /// assert_eq!((nearest, squared), (Some(1), 1.0));
    /// # Ok::<(), spline_lab::core::bounding_tree::BoundingTreeError>(())
    /// ```
    pub fn nearest(&self, point: [f64; D], limit: f64, visit: impl FnMut(usize, f64) -> f64) -> f64 {
        self.walk(|node| node.distances_squared(&point), limit, visit)
    }

    /// Visits the items whose boxes the ray `origin + s·direction`, `s ≥ 0`, enters before the limit, near ones early. `visit` is given an item and the limit and
    /// returns the new limit: the `s` at which the ray hits the item if that is smaller. The last limit is returned.
    pub fn along_ray(
        &self,
        origin: [f64; D],
        direction: [f64; D],
        limit: f64,
        visit: impl FnMut(usize, f64) -> f64,
    ) -> f64 {
        self.walk(|node| node.keys(|bounds| bounds.entry(&origin, &direction)), limit, visit)
    }

    /// Visits the items whose boxes are not further than `gap` from `bounds` in any coordinate, in no order.
    pub fn near(&self, bounds: &BoundingBox<D>, gap: f64, mut visit: impl FnMut(usize)) {
        if !self.is_empty() {
            self.near_below(0, bounds, gap, &mut visit);
        }
    }

    /// Those of the items below a node.
    fn near_below(&self, node: u32, bounds: &BoundingBox<D>, gap: f64, mut visit: impl FnMut(usize)) {
        self.each_below(node, |node| node.near(bounds, gap), &mut visit);
    }

    /// Visits the items below a node in the lanes that `is_wanted`, the first lane first.
    #[inline(always)]
    fn each_below(
        &self,
        node: u32,
        is_wanted: impl Fn(&Node<D>) -> [bool; WIDTH],
        mut visit: impl FnMut(usize),
    ) {
        let mut waiting = [0; MAX_WAITING];
        waiting[0] = node;
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = &self.nodes[waiting[count] as usize];
            let is_wanted = is_wanted(node);
            for lane in (0..WIDTH).rev().filter(|&lane| is_wanted[lane]) {
                match node.links[lane] {
                    Link::Node(index) => {
                        waiting[count] = index;
                        count += 1;
                    }
                    // The empty boxes of lanes without an item may reach everywhere.
                    Link::Item(u32::MAX) => {}
                    Link::Item(item) => visit(item as usize),
                }
            }
        }
    }

    /// Visits the items whose boxes contain `point`, in no order.
    pub fn containing(&self, point: [f64; D], mut visit: impl FnMut(usize)) {
        self.walk(
            |node| node.distances_squared(&point),
            f64::MIN_POSITIVE,
            |item, limit| {
                visit(item);
                limit
            },
        );
    }

    /// Visits the items whose boxes have points within `gap` of the hyperplane `normal·x = offset`, where `normal` has length 1, in no order.
    pub fn near_plane(&self, normal: [f64; D], offset: f64, gap: f64, mut visit: impl FnMut(usize)) {
        if self.is_empty() {
            return;
        }
        let is_near = |node: &Node<D>| {
            let (mut low, mut high) = ([-offset; WIDTH], [-offset; WIDTH]);
            for axis in 0..D {
                let factor = normal[axis];
                let (from, to) = (&node.low[axis], &node.high[axis]);
                let (from, to) = if factor < 0.0 { (to, from) } else { (from, to) };
                for lane in 0..WIDTH {
                    low[lane] += factor * from[lane];
                    high[lane] += factor * to[lane];
                }
            }
            std::array::from_fn(|lane| (low[lane] <= gap) & (high[lane] >= -gap))
        };
        self.each_below(0, is_near, &mut visit);
    }

    /// All items whose boxes have a key below the limit, which `visit` may lower.
    fn walk(
        &self,
        keys: impl Fn(&Node<D>) -> Lanes,
        mut limit: f64,
        mut visit: impl FnMut(usize, f64) -> f64,
    ) -> f64 {
        if self.nodes.is_empty() {
            return limit;
        }
        let mut waiting = [(f64::NEG_INFINITY, Link::Node(0)); MAX_WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (least, link) = waiting[count];
            if least >= limit {
                continue;
            }
            match link {
                Link::Item(item) => limit = visit(item as usize, limit),
                Link::Node(index) => {
                    let node = &self.nodes[index as usize];
                    let first = count;
                    for (key, link) in keys(node).into_iter().zip(node.links) {
                        if key < limit {
                            // Larger keys below smaller ones.
                            let mut place = count;
                            while place > first && waiting[place - 1].0 < key {
                                waiting[place] = waiting[place - 1];
                                place -= 1;
                            }
                            waiting[place] = (key, link);
                            count += 1;
                        }
                    }
                }
            }
        }
        limit
    }

    /// Visits every pair of an item of this tree and one of `other` whose boxes are not further apart than `gap` in any coordinate, in no order.
    pub fn pairs(&self, other: &Self, gap: f64, mut visit: impl FnMut(usize, usize)) {
        if self.is_empty() || other.is_empty() {
            return;
        }
        let mut waiting = Vec::with_capacity(2 * MAX_WAITING);
        waiting.push([0, 0]);
        while let Some([mine, theirs]) = waiting.pop() {
            let (mine, theirs) = (&self.nodes[mine as usize], &other.nodes[theirs as usize]);
            for lane in 0..mine.count() {
                let bounds = mine.bounds(lane);
                for (facing, is_near) in theirs.near(&bounds, gap).into_iter().enumerate() {
                    if !is_near {
                        continue;
                    }
                    match (mine.links[lane], theirs.links[facing]) {
                        (Link::Item(a), Link::Item(b)) => visit(a as usize, b as usize),
                        (Link::Node(a), Link::Node(b)) => waiting.push([a, b]),
                        (Link::Item(a), Link::Node(b)) => {
                            other.near_below(b, &bounds, gap, |b| visit(a as usize, b));
                        }
                        (Link::Node(a), Link::Item(b)) => {
                            self.near_below(a, &theirs.bounds(facing), gap, |a| visit(a, b as usize));
                        }
                    }
                }
            }
        }
    }
}

/// The first `count` items along the longest side of the box of all centres, and the others.
fn divide<const D: usize>(
    items: &mut [(u32, BoundingBox<D>)],
    count: usize,
) -> (&mut [(u32, BoundingBox<D>)], &mut [(u32, BoundingBox<D>)]) {
    if count >= items.len() {
        return (items, &mut []);
    }
    let spread = |axis: usize| {
        let centres = || items.iter().map(|(_, item)| item.centre(axis));
        centres().fold(f64::NEG_INFINITY, f64::max) - centres().fold(f64::INFINITY, f64::min)
    };
    let axis = (0..D).max_by(|&a, &b| spread(a).total_cmp(&spread(b))).unwrap_or(0);
    items.select_nth_unstable_by(count, |a, b| a.1.centre(axis).total_cmp(&b.1.centre(axis)));
    items.split_at_mut(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn boxes(count: usize) -> impl Strategy<Value = Vec<BoundingBox<2>>> {
        let corner = prop::array::uniform2(-9.0..9.0_f64);
        // Coordinates on a coarse grid now and then, so that centres coincide.
        let grid = any::<bool>();
        let one = (corner, prop::array::uniform2(0.0..3.0_f64), grid).prop_map(|(low, size, grid)| {
            let low = if grid { low.map(f64::round) } else { low };
            BoundingBox::new(low, [low[0] + size[0], low[1] + size[1]]).unwrap()
        });
        prop::collection::vec(one, 0..count)
    }

    fn sorted(mut list: Vec<usize>) -> Vec<usize> {
        list.sort_unstable();
        list
    }

    proptest! {
        #[test]
        fn queries_agree_with_looking_at_every_box(
            boxes in boxes(60), point in prop::array::uniform2(-12.0..12.0_f64), direction in prop::array::uniform2(-1.0..1.0_f64),
        ) {
            let tree = BoundingTree::new(&boxes).unwrap();
            let all = |keep: &dyn Fn(&BoundingBox<2>) -> bool| (0..boxes.len()).filter(|&i| keep(&boxes[i])).collect::<Vec<_>>();
            let squared = tree.nearest(point, f64::INFINITY, |i, limit| boxes[i].distance_squared(&point).min(limit));
            let slow = boxes.iter().map(|b| b.distance_squared(&point)).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(squared, slow, "nearest");
            let hit = tree.along_ray(point, direction, f64::INFINITY, |i, limit| boxes[i].entry(&point, &direction).min(limit));
            let slow = boxes.iter().map(|b| b.entry(&point, &direction)).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(hit, slow, "ray");
            let mut found = Vec::new();
            tree.containing(point, |i| found.push(i));
            prop_assert_eq!(sorted(found), all(&|b| b.distance_squared(&point) == 0.0), "containing");
            let (normal, gap) = ([0.6, -0.8], 0.3);
            let mut found = Vec::new();
            tree.near_plane(normal, point[0], gap, |i| found.push(i));
            let reach = |b: &BoundingBox<2>| {
                let corners = [b.low(), b.high(), [b.low()[0], b.high()[1]], [b.high()[0], b.low()[1]]];
                corners.map(|x| normal[0] * x[0] + normal[1] * x[1] - point[0])
            };
            let meets = |b: &BoundingBox<2>| reach(b).iter().any(|h| *h >= -gap) && reach(b).iter().any(|h| *h <= gap);
            prop_assert_eq!(sorted(found), all(&meets), "plane");
            let window = BoundingBox::new(point, point.map(|x| x + 2.0)).unwrap();
            let mut found = Vec::new();
            tree.near(&window, 0.5, |i| found.push(i));
            prop_assert_eq!(sorted(found), all(&|b| b.is_near(&window, 0.5)), "window");
        }

        #[test]
        fn pairs_are_those_of_all_against_all(mine in boxes(40), theirs in boxes(40), gap in 0.0..1.0_f64) {
            let trees = [&mine, &theirs].map(|boxes| BoundingTree::new(boxes).unwrap());
            let mut found = Vec::new();
            trees[0].pairs(&trees[1], gap, |i, j| found.push((i, j)));
            found.sort_unstable();
            let slow: Vec<_> = (0..mine.len())
                .flat_map(|i| (0..theirs.len()).map(move |j| (i, j)))
                .filter(|&(i, j)| mine[i].is_near(&theirs[j], gap))
                .collect();
            prop_assert_eq!(found, slow);
        }
    }

    #[test]
    fn depth_and_memory_stay_small_even_if_all_items_are_one() {
        let point = BoundingBox::new([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]).unwrap();
        let tree = BoundingTree::new(&vec![point; 100_000]).unwrap();
        assert!(tree.nodes.len() < 100_000 / 3 + 16, "{} nodes", tree.nodes.len());
        let mut visited = 0;
        tree.containing([1.0, 2.0, 3.0], |_| visited += 1);
        assert_eq!((visited, tree.len()), (100_000, 100_000), "every item once");
    }

    #[test]
    fn impossible_boxes_are_refused() {
        assert_eq!(
            BoundingBox::new([0.0, 1.0], [1.0, 0.0]).unwrap_err().name(),
            "EmptyInterval",
            "upside down"
        );
        assert_eq!(BoundingBox::new([f64::NAN], [1.0]).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(
            BoundingBox::of_points([[0.0], [f64::INFINITY]]).unwrap_err().name(),
            "NonFinite",
            "infinity"
        );
        assert_eq!(BoundingBox::<2>::of_points([]).unwrap_err().name(), "Empty", "no points");
        let empty = BoundingTree::<2>::new(&[]).unwrap();
        assert_eq!(empty.nearest([0.0, f64::NAN], 7.0, |_, _| 0.0), 7.0, "nothing to visit");
        assert!(empty.bounds().is_none() && empty.is_empty(), "an empty tree");
    }
}
