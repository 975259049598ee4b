//! Domains of several patches: coefficients on common sides are identified, so that functions are continuous.
//!
//! Sides that are the same curve are found, in all eight positions of two patches towards each other. Knots must be
//! n-fold there, so that functions of the interior vanish, and degrees and knots along the side must agree.
//! Course: section 9.3.

mod interface;

use glam::DVec2;

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::error_norm::{ErrorNorms, ErrorSums};
use crate::core::finite_element::form::{EllipticForm, Jet};
use crate::core::finite_element::geometry::{PatchSide, PlanePatch};
use crate::core::finite_element::isogeometric::{
    IsogeometricSolution, IsogeometricSpace, IsogeometricSystem, SolutionJet, finite,
};
use crate::core::linear_system::{
    DiagonalPreconditioner, IterationLimits, LinearOperator, conjugate_gradients,
};
use crate::core::progress::{Part, Watcher};
pub use interface::Interface;

/// Spaces of several patches with common numbers for their coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct MultiPatch {
    spaces: Vec<IsogeometricSpace>,
    interfaces: Vec<Interface>,
    /// For each patch and coefficient its number; those of fixed functions come last.
    numbers: Vec<Vec<usize>>,
    unknowns: usize,
    coefficients: usize,
}

/// Which outer sides are fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixedSides<'a> {
    /// All sides that are no interfaces.
    All,
    /// Patch numbers and sides.
    These(&'a [(usize, PatchSide)]),
}

impl MultiPatch {
    /// Joins spaces without fixed sides, and fixes outer sides.
    ///
    /// # Errors
    ///
    /// `Empty`, `InterfaceMismatch`, `KnotMismatch`; `DirichletSideUnknown` for a side that is an interface or does not
    /// exist, or whose knots are not n-fold.
    pub fn new(spaces: Vec<IsogeometricSpace>, fixed: FixedSides<'_>) -> Result<Self, FiniteElementError> {
        if spaces.is_empty() {
            return Err(FiniteElementError::EmptyDomain);
        }
        let interfaces = interface::detect(&spaces)?;
        let mut classes = Classes::new(&spaces);
        for Interface { first, second, reversed } in &interfaces {
            let one = side_coefficients(&spaces[first.0], first.1);
            let mut other = side_coefficients(&spaces[second.0], second.1);
            if *reversed {
                other.reverse();
            }
            for (a, b) in one.into_iter().zip(other) {
                classes.join(classes.starts[first.0] + a, classes.starts[second.0] + b);
            }
        }
        let is_interface =
            |side: (usize, PatchSide)| interfaces.iter().any(|i| i.first == side || i.second == side);
        let all: Vec<(usize, PatchSide)>;
        let wanted = match fixed {
            FixedSides::These(sides) => sides,
            FixedSides::All => {
                let sides = (0..spaces.len()).flat_map(|patch| PatchSide::ALL.map(|side| (patch, side)));
                all = sides.filter(|side| !is_interface(*side)).collect();
                &all
            }
        };
        let mut is_fixed = vec![false; classes.parents.len()];
        for &(patch, side) in wanted {
            let unknown = FiniteElementError::DirichletSideUnknown { patch, side };
            let Some(space) = spaces.get(patch) else { return Err(unknown) };
            let across = &space.spaces()[side.axis()];
            let (left, right) = across.parameter_interval();
            let end = if side.at_end() { right } else { left };
            if is_interface((patch, side)) || across.multiplicity(end) < across.degree() {
                return Err(unknown);
            }
            for k in side_coefficients(space, side) {
                let root = classes.root(classes.starts[patch] + k);
                is_fixed[root] = true;
            }
        }
        for (patch, space) in spaces.iter().enumerate() {
            if let Some(side) = PatchSide::ALL.into_iter().find(|side| space.is_fixed(*side)) {
                return Err(FiniteElementError::DirichletSideUnknown { patch, side });
            }
        }
        let (numbers, unknowns, coefficients) = classes.number(&spaces, &is_fixed);
        Ok(Self { spaces, interfaces, numbers, unknowns, coefficients })
    }

    /// Splines of one degree on all patches, every knot interval divided into `divisions` parts.
    ///
    /// # Errors
    ///
    /// Those of [`IsogeometricSpace::refined`], which name the patch, and of [`Self::new`].
    pub fn refined(
        patches: &[PlanePatch],
        degree: usize,
        divisions: usize,
        fixed: FixedSides<'_>,
    ) -> Result<Self, FiniteElementError> {
        let space = |(number, patch): (usize, &PlanePatch)| {
            IsogeometricSpace::refined(patch, degree, [divisions; 2], &[])
                .map_err(|error| error.of_patch(number))
        };
        Self::new(patches.iter().enumerate().map(space).collect::<Result<_, _>>()?, fixed)
    }

    /// The spaces of the patches.
    pub fn spaces(&self) -> &[IsogeometricSpace] {
        &self.spaces
    }

    /// The common sides.
    pub fn interfaces(&self) -> &[Interface] {
        &self.interfaces
    }

    /// Number of coefficients after identification, fixed ones counted.
    pub fn coefficient_count(&self) -> usize {
        self.coefficients
    }

    /// Number of coefficients that are not fixed.
    pub fn dimension(&self) -> usize {
        self.unknowns
    }

    /// The common number of coefficient `k` of a patch; fixed ones have numbers from [`Self::dimension`] on.
    pub fn number(&self, patch: usize, k: usize) -> Option<usize> {
        self.numbers.get(patch)?.get(k).copied()
    }

    /// Solves `−div(A grad u) + c u = f` with `u = 0` on the fixed sides and natural conditions elsewhere.
    ///
    /// # Errors
    ///
    /// `SingularSystem` if no side is fixed and `c = 0`; errors of the assembly, which name the patch; `NotConverged`.
    pub fn solve(
        &self,
        form: &EllipticForm<'_>,
        watcher: &dyn Watcher,
    ) -> Result<MultiPatchSolution, FiniteElementError> {
        if self.unknowns == self.coefficients && form.kills_constants() {
            return Err(FiniteElementError::SingularSystem);
        }
        let count = self.spaces.len() as f64;
        let mut systems = Vec::with_capacity(self.spaces.len());
        let (mut right_side, mut diagonal) = (vec![0.0; self.unknowns], vec![0.0; self.unknowns]);
        for (patch, space) in self.spaces.iter().enumerate() {
            let [from, to] = [patch, patch + 1].map(|done| 0.5 * done as f64 / count);
            let part = Part { whole: watcher, from, to };
            let system = IsogeometricSystem::assemble(space.clone(), form, &[], &part)
                .map_err(|error| error.of_patch(patch))?;
            self.gather(patch, system.right_side(), &mut right_side);
            self.gather(patch, &system.matrix().diagonal(), &mut diagonal);
            systems.push(system);
        }
        let preconditioner = DiagonalPreconditioner::new(&diagonal)?;
        let operator = Operator { domain: self, systems: &systems };
        let limits = IterationLimits { relative_tolerance: 1e-12, max_steps: 20_000 };
        let rest = Part { whole: watcher, from: 0.5, to: 1.0 };
        let run = conjugate_gradients(&operator, &right_side, None, &preconditioner, limits, &rest)?;
        let solutions = systems.into_iter().enumerate().map(|(patch, system)| {
            let mut coefficients = vec![0.0; system.right_side().len()];
            self.spread(patch, &run.solution, &mut coefficients);
            system.into_solution(coefficients, Vec::new())
        });
        Ok(MultiPatchSolution { patches: solutions.collect(), residuals: run.residuals })
    }

    /// Adds the numbers of a patch to those of the domain.
    fn gather(&self, patch: usize, local: &[f64], global: &mut [f64]) {
        for (number, value) in self.numbers[patch].iter().zip(local) {
            if let Some(sum) = global.get_mut(*number) {
                *sum += value;
            }
        }
    }

    /// Copies the numbers of the domain to those of a patch; fixed ones become 0.
    fn spread(&self, patch: usize, global: &[f64], local: &mut [f64]) {
        for (number, value) in self.numbers[patch].iter().zip(local) {
            *value = global.get(*number).copied().unwrap_or(0.0);
        }
    }
}

/// The sum of the matrices of all patches.
struct Operator<'a> {
    domain: &'a MultiPatch,
    systems: &'a [IsogeometricSystem],
}

impl LinearOperator for Operator<'_> {
    fn size(&self) -> usize {
        self.domain.unknowns
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for (patch, system) in self.systems.iter().enumerate() {
            let mut local = vec![0.0; system.right_side().len()];
            let mut local_product = local.clone();
            self.domain.spread(patch, x, &mut local);
            system.matrix().apply(&local, &mut local_product);
            self.domain.gather(patch, &local_product, product);
        }
    }
}

/// The solution on all patches.
#[derive(Clone, Debug)]
pub struct MultiPatchSolution {
    patches: Vec<IsogeometricSolution>,
    residuals: Vec<f64>,
}

impl MultiPatchSolution {
    /// The parts on the patches.
    pub fn patches(&self) -> &[IsogeometricSolution] {
        &self.patches
    }

    /// Norms of the residuals of conjugate gradients, first that of the start.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// `∫ u`.
    ///
    /// # Errors
    ///
    /// As [`IsogeometricSolution::integral`].
    pub fn integral(&self) -> Result<f64, FiniteElementError> {
        self.patches.iter().map(IsogeometricSolution::integral).sum()
    }

    /// `a(u, u)`.
    pub fn energy(&self) -> f64 {
        self.patches.iter().map(IsogeometricSolution::energy).sum()
    }

    /// Number of the patch, value and gradient at a point of the plane; `None` outside all patches.
    pub fn jet_at(&self, place: DVec2) -> Option<(usize, SolutionJet)> {
        self.patches.iter().enumerate().find_map(|(patch, solution)| Some((patch, solution.jet_at(place)?)))
    }

    /// Norms of the difference to the function `exact`.
    ///
    /// # Errors
    ///
    /// As [`IsogeometricSolution::error_norms`].
    pub fn error_norms(&self, exact: impl Fn(DVec2) -> Jet + Sync) -> Result<ErrorNorms, FiniteElementError> {
        let mut total = ErrorSums::default();
        for solution in &self.patches {
            total.merge(&solution.error_sums(&exact)?);
        }
        finite(total.norms())
    }
}

/// Indices of the coefficients that do not vanish on a side, in the order of the side's parameter.
fn side_coefficients(space: &IsogeometricSpace, side: PatchSide) -> Vec<usize> {
    let sizes = space.sizes();
    let across = if side.at_end() { sizes[side.axis()] - 1 } else { 0 };
    let index = |k: usize| if side.axis() == 0 { across * sizes[1] + k } else { k * sizes[1] + across };
    (0..sizes[1 - side.axis()]).map(index).collect()
}

/// Coefficients of all patches in classes of those that are identified.
struct Classes {
    parents: Vec<usize>,
    /// Where the coefficients of each patch start.
    starts: Vec<usize>,
}

impl Classes {
    fn new(spaces: &[IsogeometricSpace]) -> Self {
        let mut count = 0;
        let mut starts = Vec::with_capacity(spaces.len());
        for space in spaces {
            starts.push(count);
            count += space.coefficient_count();
        }
        Self { parents: (0..count).collect(), starts }
    }

    fn root(&mut self, mut k: usize) -> usize {
        while self.parents[k] != k {
            self.parents[k] = self.parents[self.parents[k]];
            k = self.parents[k];
        }
        k
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }

    /// Numbers in the order of the patches, the classes that are fixed last; numbers of unknowns and of classes.
    fn number(mut self, spaces: &[IsogeometricSpace], is_fixed: &[bool]) -> (Vec<Vec<usize>>, usize, usize) {
        let mut of_class = vec![usize::MAX; self.parents.len()];
        let mut next = 0;
        let mut unknowns = 0;
        for fixed in [false, true] {
            for k in 0..self.parents.len() {
                if self.parents[k] == k && is_fixed[k] == fixed {
                    of_class[k] = next;
                    next += 1;
                }
            }
            if !fixed {
                unknowns = next;
            }
        }
        let starts = self.starts.clone();
        let numbers = spaces.iter().zip(starts).map(|(space, start)| {
            (start..start + space.coefficient_count()).map(|k| of_class[self.root(k)]).collect()
        });
        (numbers.collect(), unknowns, next)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::core::finite_element::form::Coefficient;
    use crate::core::finite_element::isogeometric::solve_patch;
    use crate::core::finite_element::sample_geometries as sample;
    use crate::core::progress::Unwatched;

    fn form() -> EllipticForm<'static> {
        EllipticForm::poisson(Coefficient::Constant(1.0))
    }

    /// A rectangle whose first direction, second direction or both may run backwards, or be exchanged.
    fn rectangle(low: DVec2, high: DVec2, position: usize) -> PlanePatch {
        let corner = |i: usize, j: usize| {
            let (i, j) = if position & 4 == 0 { (i, j) } else { (j, i) };
            let (i, j) = (i ^ (position & 1), j ^ (position >> 1 & 1));
            DVec2::new([low.x, high.x][i], [low.y, high.y][j])
        };
        let points = vec![corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
        PlanePatch::polynomial(sample::unit_square().spaces().clone(), points).unwrap()
    }

    #[test]
    fn two_patches_in_any_position_are_one_patch_with_a_kink() {
        let whole = rectangle(DVec2::ZERO, DVec2::new(2.0, 1.0), 0);
        let kinked = SplineSpace::from_breaks(2, &[0.0, 0.25, 0.5, 0.5, 0.75, 1.0], EndKnots::Interpolating);
        let other = SplineSpace::from_breaks(2, &[0.0, 0.5, 1.0], EndKnots::Interpolating).unwrap();
        let space = IsogeometricSpace::new(whole, [kinked.unwrap(), other], &PatchSide::ALL).unwrap();
        let unknowns = space.dimension();
        let single = solve_patch(space, &form(), &[], &Unwatched).unwrap();
        for position in 0..8 {
            let patches =
                [rectangle(DVec2::ZERO, DVec2::ONE, 0), rectangle(DVec2::X, DVec2::new(2.0, 1.0), position)];
            let domain = MultiPatch::refined(&patches, 2, 2, FixedSides::All).unwrap();
            assert_eq!(domain.interfaces().len(), 1, "position {position}: {:?}", domain.interfaces());
            assert_eq!(domain.dimension(), unknowns, "position {position}");
            let joined = domain.solve(&form(), &Unwatched).unwrap();
            let difference = joined.integral().unwrap() - single.integral().unwrap();
            assert!(difference.abs() < 1e-12, "position {position}: {difference}");
            let place = DVec2::new(1.3, 0.4);
            let (patch, jet) = joined.jet_at(place).unwrap();
            assert_eq!(patch, 1, "position {position}: the right one");
            let value = single.jet_at(place).unwrap().value;
            assert!((jet.value - value).abs() < 1e-12, "position {position}: {} and {value}", jet.value);
        }
    }

    #[test]
    fn a_ring_of_four_quarters_is_closed_and_has_the_radial_solution() {
        // −Δu = 1 with u = 0 at r = 1 and r = 2: u = (1 − r²)/4 + 3 ln r / (4 ln 2).
        let exact = |x: DVec2| {
            let (r, c) = (x.length(), 0.75 / 2.0_f64.ln());
            Jet { value: 0.25 * (1.0 - r * r) + c * r.ln(), gradient: x * (c / (r * r) - 0.5) }
        };
        let ring = sample::annulus(1.0, 2.0).unwrap();
        let domain = MultiPatch::refined(&ring, 3, 6, FixedSides::All).unwrap();
        assert_eq!(domain.interfaces().len(), 4, "each quarter meets two others");
        let norms = domain.solve(&form(), &Unwatched).unwrap().error_norms(exact).unwrap();
        assert!(norms.relative_l2() < 1e-4, "{norms:?}");
    }

    #[test]
    fn what_does_not_fit_is_named() {
        let square = rectangle(DVec2::ZERO, DVec2::ONE, 0);
        let bulged = PlanePatch::bezier(
            [2, 1],
            DVec2::ONE,
            [[0.0, 0.0], [0.0, -1.0], [0.5, 0.1], [0.5, -1.0], [1.0, 0.0], [1.0, -1.0]]
                .map(DVec2::from)
                .to_vec(),
            vec![1.0; 6],
        );
        let mismatch = MultiPatch::refined(&[square.clone(), bulged.unwrap()], 2, 2, FixedSides::All);
        match mismatch.unwrap_err() {
            FiniteElementError::InterfaceMismatch { first, second, distance } => {
                assert_eq!((first, second), ((0, PatchSide::Bottom), (1, PatchSide::Bottom)), "the sides");
                assert!((distance - 0.05).abs() < 1e-12, "half of the middle point's offset: {distance}");
            }
            other => panic!("{other}"),
        }
        let below = rectangle(DVec2::NEG_Y, DVec2::X, 0);
        let spaces = [(&square, 2), (&below, 3)]
            .map(|(patch, divisions)| IsogeometricSpace::refined(patch, 2, [divisions; 2], &[]).unwrap());
        let error = MultiPatch::new(spaces.to_vec(), FixedSides::All).unwrap_err();
        assert_eq!(error.name(), "KnotMismatch", "two and three intervals");
        let pair = [square.clone(), below];
        let fix = |sides: &[(usize, PatchSide)]| {
            MultiPatch::refined(&pair, 2, 2, FixedSides::These(sides))
                .and_then(|domain| domain.solve(&form(), &Unwatched))
                .map(|_| ())
                .map_err(|error| error.name())
        };
        assert_eq!(fix(&[(2, PatchSide::Top)]), Err("DirichletSideUnknown"), "no third patch");
        assert_eq!(fix(&[(0, PatchSide::Bottom)]), Err("DirichletSideUnknown"), "an interface");
        assert_eq!(fix(&[]), Err("SingularSystem"), "nothing fixed");
        assert_eq!(fix(&[(1, PatchSide::Bottom)]), Ok(()), "one side fixed");
        let folded = square.with_point(3, DVec2::new(0.1, 0.1)).unwrap();
        match MultiPatch::refined(&[square, folded], 2, 2, FixedSides::All).unwrap_err() {
            FiniteElementError::FoldedParametrisation { patch, .. } => {
                assert_eq!(patch, 1, "the second patch");
            }
            other => panic!("{other}"),
        }
        assert_eq!(
            MultiPatch::new(Vec::new(), FixedSides::All).unwrap_err().name(),
            "EmptyDomain",
            "no patch"
        );
    }
}
