//! Places for labels beside their marks, so that no label lies on another, on a mark or off the page.
//!
//! Every label has 8 directions around its anchor at two distances. The labels are placed one after the other, those of higher priority first, each at its
//! first place that is free and not crossed by a line, or else free; a label that finds none is left out, or put anywhere on the page if it is a sentence. Boxes and lines are looked
//! up in a grid, so that the time grows with the number of labels and not with its square. The same labels always get the same places; while something is
//! dragged, a label keeps its former direction as long as that is free.

use glam::DVec2;

use crate::figure::clip::segment_in_box;

/// Side of a cell of the grid in pt.
const CELL: f64 = 40.0;
/// Free room between a mark and its label in pt: near, far, and for labels that may stand anywhere also farther.
const GAPS: [f64; 6] = [3.0, 13.0, 28.0, 48.0, 74.0, 110.0];
/// How many of them labels have that may be left out.
const GAPS_OF_MOST: usize = 2;
/// Least room between a label and the edge of the page in pt.
const EDGE: f64 = 2.0;

/// Instead of a distance: a place that has nothing to do with the direction.
const ANYWHERE: u8 = u8::MAX;

/// The directions counterclockwise from the right.
const DIRECTIONS: [(f64, f64); 8] =
    [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (-1.0, 0.0), (-1.0, -1.0), (0.0, -1.0), (1.0, -1.0)];

/// A rectangle on the page in pt, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageBox {
    /// Lower left corner.
    pub low: DVec2,
    /// Upper right corner.
    pub high: DVec2,
}

impl PageBox {
    /// The square around `center`.
    pub fn around(center: DVec2, half: f64) -> Self {
        Self { low: center - half, high: center + half }
    }

    /// Whether both have inner points in common.
    pub fn meets(&self, other: &Self) -> bool {
        self.low.cmplt(other.high).all() && other.low.cmplt(self.high).all()
    }
}

/// A label that wants a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The place on the page that it belongs to.
    pub anchor: DVec2,
    /// Its width and height.
    pub size: DVec2,
    /// Half the size of the mark at the anchor.
    pub reach: f64,
    /// The direction in which it would like to stand.
    pub wish: DVec2,
    /// Labels of smaller numbers are placed first.
    pub priority: u8,
    /// Whether it may stand at any distance rather than be left out.
    pub stays: bool,
    /// Where it stood before, while something is dragged.
    pub former: Option<Spot>,
}

/// A place beside an anchor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Spot {
    direction: u8,
    gap: u8,
}

/// A label in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Lower left corner of its box.
    pub low: DVec2,
    /// Which of the places it is.
    pub spot: Spot,
    /// Whether a line runs through it.
    pub is_crossed: bool,
}

/// A page with everything that labels keep away from.
#[derive(Debug)]
pub struct Page {
    size: DVec2,
    columns: usize,
    boxes: Vec<PageBox>,
    lines: Vec<[DVec2; 2]>,
    /// For each cell the boxes and the lines in it.
    cells: Vec<[Vec<u32>; 2]>,
}

impl Page {
    /// An empty page of `size` pt.
    pub fn new(size: DVec2) -> Self {
        // A page of many metres gets no finer grid.
        let count = |length: f64| ((length / CELL).ceil() as usize).clamp(1, 500);
        let (columns, rows) = (count(size.x), count(size.y));
        Self {
            size,
            columns,
            boxes: Vec::new(),
            lines: Vec::new(),
            cells: vec![Default::default(); columns * rows],
        }
    }

    /// Nothing may lie on this box.
    pub fn block(&mut self, area: PageBox) {
        if area.low.is_finite() && area.high.is_finite() {
            let number = self.boxes.len() as u32;
            self.boxes.push(area);
            self.visit(area, |cell| cell[0].push(number));
        }
    }

    /// Labels would rather not lie on this polyline.
    pub fn avoid(&mut self, line: &[DVec2]) {
        for ends in line.windows(2) {
            let Some((a, b)) = segment_in_box(ends[0], ends[1], DVec2::ZERO, self.size) else { continue };
            // The ends of a line from very far away are rounded off the page.
            let [a, b] = [a, b].map(|end| end.max(DVec2::ZERO).min(self.size));
            if !(b - a).is_finite() {
                continue;
            }
            let number = self.lines.len() as u32;
            self.lines.push([a, b]);
            // Long lines are entered piece by piece, or a diagonal would be in every cell.
            let pieces = ((b - a).length() / CELL).ceil().clamp(1.0, 1000.0) as usize;
            for piece in 0..pieces {
                let at = |k: usize| a + (b - a) * (k as f64 / pieces as f64);
                let (from, to) = (at(piece), at(piece + 1));
                self.visit(PageBox { low: from.min(to), high: from.max(to) }, |cell| cell[1].push(number));
            }
        }
    }

    /// The numbers of the cells that a box lies in; what lies off the page lies in none.
    fn cells_of(&self, area: PageBox) -> impl Iterator<Item = usize> + use<> {
        let rows = self.cells.len() / self.columns;
        let range = |low: f64, high: f64, count: usize| {
            let first = (low / CELL).floor().max(0.0) as usize;
            let last = (high / CELL).floor().min(count as f64 - 1.0);
            if last < 0.0 { 0..0 } else { first..last as usize + 1 }
        };
        let columns = self.columns;
        let across = range(area.low.x, area.high.x, columns);
        range(area.low.y, area.high.y, rows)
            .flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }

    fn visit(&mut self, area: PageBox, mut enter: impl FnMut(&mut [Vec<u32>; 2])) {
        for cell in self.cells_of(area) {
            enter(&mut self.cells[cell]);
        }
    }

    fn is_on_page(&self, area: &PageBox) -> bool {
        area.low.cmpge(DVec2::splat(EDGE)).all() && area.high.cmple(self.size - EDGE).all()
    }

    /// Whether nothing that is blocked lies in `area`.
    pub fn is_free(&self, area: &PageBox) -> bool {
        self.cells_of(*area)
            .all(|cell| !self.cells[cell][0].iter().any(|&number| self.boxes[number as usize].meets(area)))
    }

    /// How many blocked boxes and lines lie in `area`.
    pub fn content(&self, area: &PageBox) -> usize {
        let distinct = |kind: usize| {
            let mut numbers: Vec<u32> =
                self.cells_of(*area).flat_map(|cell| self.cells[cell][kind].iter().copied()).collect();
            numbers.sort_unstable();
            numbers.dedup();
            numbers
        };
        let boxes = distinct(0).into_iter().filter(|&number| self.boxes[number as usize].meets(area)).count();
        let crosses = |&number: &u32| {
            let [a, b] = self.lines[number as usize];
            segment_in_box(a, b, area.low, area.high).is_some()
        };
        boxes + distinct(1).iter().filter(|&number| crosses(number)).count()
    }

    fn is_clean(&self, area: &PageBox) -> bool {
        self.cells_of(*area).all(|cell| {
            !self.cells[cell][1].iter().any(|&number| {
                let [a, b] = self.lines[number as usize];
                segment_in_box(a, b, area.low, area.high).is_some()
            })
        })
    }

    /// Places all labels, `None` for those that are left out; what is placed is blocked from then on.
    pub fn place(&mut self, requests: &[Request]) -> Vec<Option<Placed>> {
        let mut order: Vec<usize> = (0..requests.len()).collect();
        order.sort_by_key(|&index| requests[index].priority);
        let mut placed = vec![None; requests.len()];
        for index in order {
            let request = &requests[index];
            placed[index] = self.find(request);
            if let Some(Placed { low, .. }) = placed[index] {
                self.block(PageBox { low, high: low + request.size });
            }
        }
        placed
    }

    fn find(&self, request: &Request) -> Option<Placed> {
        let area_of = |spot: Spot| {
            let low = request.corner(spot);
            PageBox { low, high: low + request.size }
        };
        let fits = |spot: &Spot| {
            let area = area_of(*spot);
            self.is_on_page(&area) && self.is_free(&area)
        };
        let placed = |spot: Spot| {
            let is_crossed = !self.is_clean(&area_of(spot));
            Some(Placed { low: request.corner(spot), spot, is_crossed })
        };
        if let Some(former) = request.former.filter(|spot| spot.gap != ANYWHERE).filter(&fits) {
            return placed(former);
        }
        let gaps = if request.stays { GAPS.len() } else { GAPS_OF_MOST };
        let mut free = None;
        for spot in request.spots(gaps) {
            if fits(&spot) {
                if self.is_clean(&area_of(spot)) {
                    return placed(spot);
                }
                // Far away is worse than on a line.
                if spot.gap as usize >= GAPS_OF_MOST && free.is_some() {
                    break;
                }
                free.get_or_insert(spot);
            }
        }
        if let Some(spot) = free {
            return placed(spot);
        }
        if request.stays { self.anywhere(request) } else { None }
    }

    /// The free place on the page that is nearest to the anchor.
    fn anywhere(&self, request: &Request) -> Option<Placed> {
        let spot = Spot { direction: 0, gap: ANYWHERE };
        let on_page = |low: DVec2| low.min(self.size - EDGE - request.size).max(DVec2::splat(EDGE));
        let wanted = on_page(request.corner(Spot { gap: 0, ..spot }));
        let room = (self.size - request.size - 2.0 * EDGE).max(DVec2::ZERO);
        let step = (room / 40.0).max(DVec2::new(12.0, 4.0));
        let count = (room / step).floor();
        if !(count.is_finite() && request.size.is_finite()) {
            return None;
        }
        // From the wanted place outwards, in rows and in each row, so that few places are tried.
        let outwards = |count: f64, step: f64, wanted: f64| {
            let mut places: Vec<f64> = (0..=count as u32).map(|i| EDGE + step * f64::from(i)).collect();
            places.sort_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()));
            places
        };
        let (xs, ys) = (outwards(count.x, step.x, wanted.x), outwards(count.y, step.y, wanted.y));
        let mut nearest: Option<(f64, DVec2)> = None;
        for &y in &ys {
            let is_nearer = |low: DVec2| nearest.is_none_or(|(best, _)| low.distance(wanted) < best);
            if !is_nearer(DVec2::new(wanted.x, y)) {
                break;
            }
            let mut row = xs.iter().map(|&x| DVec2::new(x, y)).take_while(|&low| is_nearer(low));
            let free = |low: &DVec2| {
                let area = PageBox { low: *low, high: *low + request.size };
                self.is_on_page(&area) && self.is_free(&area)
            };
            if let Some(low) = row.find(free) {
                nearest = Some((low.distance(wanted), low));
            }
        }
        let nearest = nearest.map(|(_, low)| low);
        nearest.map(|low| {
            let is_crossed = !self.is_clean(&PageBox { low, high: low + request.size });
            Placed { low, spot, is_crossed }
        })
    }
}

impl Request {
    /// All places, nearest first, at each distance beginning with the wish and going away from it to both sides.
    fn spots(&self, gaps: usize) -> impl Iterator<Item = Spot> + use<> {
        let turn = self.wish.y.atan2(self.wish.x) / std::f64::consts::FRAC_PI_4;
        let wish = if turn.is_finite() { turn.round() as i32 } else { 0 };
        let around = [0, 1, -1, 2, -2, 3, -3, 4].map(|by| (wish + by).rem_euclid(8) as u8);
        (0..gaps as u8).flat_map(move |gap| around.map(|direction| Spot { direction, gap }))
    }

    /// The lower left corner of its box at `spot`.
    fn corner(&self, spot: Spot) -> DVec2 {
        let (x, y) = DIRECTIONS[usize::from(spot.direction) % DIRECTIONS.len()];
        let gap = self.reach + GAPS[usize::from(spot.gap).min(GAPS.len() - 1)];
        // A corner of the box comes nearer to the mark than a side, and so looks as near.
        let way = if x == 0.0 || y == 0.0 { gap } else { 0.6 * gap };
        self.anchor + DVec2::new(x, y) * (way + self.size * 0.5) - self.size * 0.5
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use proptest::prelude::*;

    const PAGE: DVec2 = DVec2::new(400.0, 300.0);

    fn request(anchor: DVec2, priority: u8) -> Request {
        let (size, wish) = (DVec2::new(40.0, 10.0), DVec2::ONE);
        Request { anchor, size, reach: 4.0, wish, priority, stays: false, former: None }
    }

    fn area(request: &Request, placed: &Placed) -> PageBox {
        PageBox { low: placed.low, high: placed.low + request.size }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn no_label_lies_on_another_or_on_a_mark_or_off_the_page(
            anchors in prop::collection::vec((-20.0..420.0_f64, -20.0..320.0_f64), 1..60),
        ) {
            let mut page = Page::new(PAGE);
            let requests: Vec<Request> =
                anchors.iter().enumerate().map(|(k, &at)| request(at.into(), k as u8 % 3)).collect();
            let marks: Vec<PageBox> = requests.iter().map(|wanted| PageBox::around(wanted.anchor, 4.0)).collect();
            marks.iter().for_each(|&mark| page.block(mark));
            let placed = page.place(&requests);
            let areas: Vec<PageBox> =
                requests.iter().zip(&placed).filter_map(|(wanted, found)| Some(area(wanted, found.as_ref()?))).collect();
            for (k, found) in areas.iter().enumerate() {
                prop_assert!(found.low.min_element() >= 0.0 && found.high.cmple(PAGE).all(), "{found:?} off the page");
                prop_assert!(!areas[..k].iter().any(|other| other.meets(found)), "{found:?} on another label");
                prop_assert!(!marks.iter().any(|mark| mark.meets(found)), "{found:?} on a mark");
            }
        }

        #[test]
        fn what_was_free_stays_in_its_direction(
            anchors in prop::collection::vec((80.0..320.0_f64, 60.0..240.0_f64), 1..20),
            step in (-1.5..1.5_f64, -1.5..1.5_f64),
        ) {
            let place = |requests: &[Request]| Page::new(PAGE).place(requests);
            let mut requests: Vec<Request> = anchors.iter().map(|&at| request(at.into(), 0)).collect();
            let before = place(&requests);
            for (wanted, found) in requests.iter_mut().zip(&before) {
                wanted.former = found.map(|found| found.spot);
                wanted.anchor += DVec2::from(step);
            }
            // All moved alike, and far from the edge of the page, where one that has to turn could push others: nothing has a reason to jump.
            for (before, after) in before.iter().zip(place(&requests)) {
                if let (Some(before), Some(after)) = (before, after) {
                    prop_assert_eq!(before.spot, after.spot, "{:?} became {:?}", before, after);
                }
            }
        }
    }

    #[test]
    fn the_wish_is_granted_where_there_is_room_and_the_more_important_choose_first() {
        let at = DVec2::new(200.0, 150.0);
        let alone = Page::new(PAGE).place(&[request(at, 0)])[0].unwrap();
        assert!(alone.low.cmpgt(at).all(), "upper right: {}", alone.low);
        let both = Page::new(PAGE).place(&[request(at, 5), request(at, 1)]);
        assert_eq!(both[1].unwrap(), alone, "the more important one, although it comes second");
        assert_ne!(both[0].unwrap().spot, alone.spot, "the other elsewhere");
    }

    #[test]
    fn a_label_leaves_a_line_alone_if_it_can() {
        let at = DVec2::new(200.0, 150.0);
        let mut page = Page::new(PAGE);
        page.avoid(&[at, at + DVec2::new(100.0, 100.0)]);
        let found = page.place(&[request(at, 0)])[0].unwrap();
        let [a, b] = [at, at + DVec2::new(100.0, 100.0)];
        assert!(segment_in_box(a, b, found.low, found.low + DVec2::new(40.0, 10.0)).is_none(), "{found:?}");
    }

    #[test]
    fn where_there_is_no_room_the_unimportant_go_and_sentences_stay() {
        let at = DVec2::new(200.0, 150.0);
        let many: Vec<Request> = (0..40).map(|_| request(at, 1)).collect();
        let mut page = Page::new(PAGE);
        let placed = page.place(&many);
        let count = placed.iter().flatten().count();
        assert!((4..=16).contains(&count), "{count} labels around one place");
        assert_eq!(placed, Page::new(PAGE).place(&many), "always the same ones");
        let sentence = Request { stays: true, size: DVec2::new(150.0, 12.0), ..request(at, 2) };
        let found = page.place(&[sentence])[0].unwrap();
        assert!(found.low.min_element() >= 0.0 && (found.low + sentence.size).cmple(PAGE).all(), "{found:?}");
        let outside = Request { anchor: DVec2::new(-50.0, 500.0), ..sentence };
        let found = Page::new(PAGE).place(&[outside])[0].unwrap();
        assert!((found.low + outside.size).cmple(PAGE).all(), "kept on the page: {found:?}");
    }

    #[test]
    fn ten_thousand_labels_and_strange_numbers_are_placed() {
        let mut page = Page::new(DVec2::new(2000.0, 1000.0));
        let anchors = (0..10_000).map(|k| DVec2::new(f64::from(k % 200) * 10.0, f64::from(k / 200) * 20.0));
        let requests: Vec<Request> = anchors.map(|at| request(at, 0)).collect();
        requests.iter().for_each(|wanted| page.block(PageBox::around(wanted.anchor, 2.0)));
        assert!(page.place(&requests).iter().flatten().count() > 100, "those that have room");
        for bad in [DVec2::NAN, DVec2::INFINITY, DVec2::splat(1e300), DVec2::splat(-1e300)] {
            let mut page = Page::new(PAGE);
            page.block(PageBox::around(bad, 1.0));
            page.avoid(&[bad, DVec2::ZERO]);
            let strange = Request { anchor: bad, stays: true, wish: bad, ..request(DVec2::ZERO, 0) };
            page.place(&[strange]);
            assert_eq!(Page::new(bad).place(&[request(DVec2::ZERO, 0)]).len(), 1, "a page of {bad}");
        }
    }
}
