//! Weighted B-splines `Bₖ = w bₖ` on a uniform grid.
//!
//! `k` is *relevant* if some cell of the support of `bₖ` meets the domain, *inner* if some cell of the support
//! is an inner cell, *outer* if it is relevant and not inner. Then `grad Bₖ = w grad bₖ + bₖ grad w`.
//! Coefficients fill the whole array; irrelevant ones are 0.
//!
//! K. Höllig, U. Reif, J. Wipper, *Weighted extended B-spline approximation of Dirichlet problems*, 2001.
//! Course: section 9.2.

use glam::DVec2;

use crate::core::domain::{CellClass, Domain, Jet};
use crate::core::finite_element::assembly::{ElementSamples, ElementSource};
use crate::core::finite_element::cell_quadrature::{QuadratureTable, tensor_points};
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::grid::{CellBasis, Grid, check_degree};
use crate::core::finite_element::web_spline::{NodeArray, NodeClass};
use crate::core::finite_element::weight_function::Weight;
use crate::core::progress::Watcher;

/// The functions `w b` on the part of a grid in a domain; valid by construction.
#[derive(Clone, Debug)]
pub struct WeightedSpace {
    degree: usize,
    domain: Domain,
    weight: Weight,
    table: QuadratureTable,
    nodes: NodeArray<2>,
    /// The B-splines at the Gauss nodes of an inner cell, in one direction.
    gauss_basis: Vec<CellBasis>,
}

impl WeightedSpace {
    /// The space of `degree` with `gauss_points` in each direction of a cell's pieces; n + 3 keep all rates of
    /// convergence.
    ///
    /// # Errors
    ///
    /// `StepLimit` (degree, points), `Empty` (points), `EmptyDomain`, `DegenerateWeight`, `Stopped`.
    pub fn new(
        domain: Domain,
        weight: Weight,
        grid: Grid,
        degree: usize,
        gauss_points: usize,
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        check_degree(degree)?;
        let table = QuadratureTable::new(&domain, grid, gauss_points, watcher)?;
        check_slopes(&weight, &table)?;
        let nodes = NodeArray::new(grid.cells(), degree, |cell| table.class(cell));
        let gauss_basis = table.rule().nodes().iter().map(|t| CellBasis::new(degree, *t)).collect();
        Ok(Self { degree, domain, weight, table, nodes, gauss_basis })
    }

    /// The degree `n`.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The domain.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The weight function.
    pub fn weight(&self) -> &Weight {
        &self.weight
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        self.table.grid()
    }

    /// Cells and nodes of the quadrature.
    pub fn table(&self) -> &QuadratureTable {
        &self.table
    }

    /// The array of B-splines and their classes.
    pub fn nodes(&self) -> &NodeArray<2> {
        &self.nodes
    }

    /// Centre of the support of B-spline `k`, where its node is drawn.
    pub fn node_position(&self, k: [usize; 2]) -> DVec2 {
        let place = DVec2::new(k[0] as f64, k[1] as f64) + 0.5 * (1.0 - self.degree as f64);
        self.grid().bounds().lower + self.grid().width() * place
    }

    /// Value and gradient at `x` of the function with these coefficients, missing ones read as 0; `None`
    /// outside the domain or the grid.
    pub fn evaluate(&self, coefficients: &[f64], x: DVec2) -> Option<Jet> {
        let (cell, local) = self.grid().locate(x)?;
        if !self.domain.contains(x) {
            return None;
        }
        let width = self.grid().width();
        let basis = [CellBasis::new(self.degree, local.x), CellBasis::new(self.degree, local.y)];
        let mut spline = Jet::default();
        let columns = self.nodes.shape()[1];
        for i in 0..=self.degree {
            let first = (cell[0] + i) * columns + cell[1];
            let row = coefficients.get(first..=first + self.degree).unwrap_or(&[]);
            let (mut sum, mut slope) = (0.0, 0.0);
            for (j, c) in row.iter().enumerate() {
                sum += c * basis[1].values[j];
                slope += c * basis[1].derivatives[j];
            }
            spline.value += basis[0].values[i] * sum;
            spline.gradient += DVec2::new(basis[0].derivatives[i] * sum, basis[0].values[i] * slope);
        }
        spline.gradient /= width;
        Some(product(self.weight.at(x), spline))
    }

    /// Writes the values at `columns × rows` points, from the lower corner of the grid's box to the upper one,
    /// x running fastest; NaN outside the domain.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless `values` has `columns·rows` places and there are as many coefficients as B-splines.
    pub fn write_values(
        &self,
        coefficients: &[f64],
        columns: usize,
        rows: usize,
        values: &mut [f64],
    ) -> Result<(), FiniteElementError> {
        self.check_coefficients(coefficients)?;
        let (expected, found) = (columns.saturating_mul(rows), values.len());
        if expected != found {
            return Err(FiniteElementError::SizeMismatch { what: "places for values", expected, found });
        }
        let bounds = self.grid().bounds();
        let step = bounds.size() / DVec2::new((columns.max(2) - 1) as f64, (rows.max(2) - 1) as f64);
        for (place, value) in values.iter_mut().enumerate() {
            let at = DVec2::new((place % columns) as f64, (place / columns) as f64);
            let x = (bounds.lower + step * at).min(bounds.upper);
            *value = self.evaluate(coefficients, x).map_or(f64::NAN, |jet| jet.value);
        }
        Ok(())
    }

    /// `SizeMismatch` unless there are as many coefficients as B-splines.
    pub(super) fn check_coefficients(&self, coefficients: &[f64]) -> Result<(), FiniteElementError> {
        let (expected, found) = (self.function_count(), coefficients.len());
        if expected == found {
            Ok(())
        } else {
            Err(FiniteElementError::SizeMismatch { what: "coefficients", expected, found })
        }
    }

    /// Appends the jets of all `w b` of a cell at `point`.
    fn push_jets(
        &self,
        samples: &mut ElementSamples,
        point: DVec2,
        basis: [&CellBasis; 2],
    ) -> Result<(), FiniteElementError> {
        let weight = self.weight.at(point);
        if !(weight.value.is_finite() && weight.gradient.is_finite()) {
            let value = weight.value + weight.gradient.x + weight.gradient.y;
            return Err(FiniteElementError::NonFinite { what: "the weight function", point, value });
        }
        if weight.value <= 0.0 {
            return Err(FiniteElementError::WeightNotPositive { point, value: weight.value });
        }
        let scale = self.grid().width().recip();
        let [first, second] = basis;
        for i in 0..=self.degree {
            let (value, slope) = (first.values[i], first.derivatives[i] * scale.x);
            for j in 0..=self.degree {
                let gradient = DVec2::new(slope * second.values[j], value * second.derivatives[j] * scale.y);
                samples.push_jet(product(weight, Jet { value: value * second.values[j], gradient }));
            }
        }
        Ok(())
    }
}

/// Part of the largest weight below which a weight, or its change over a cell, counts as zero.
const VANISHING: f64 = 1e-9;

/// `DegenerateWeight` at a point of the boundary where both the weight and its gradient vanish.
fn check_slopes(weight: &Weight, table: &QuadratureTable) -> Result<(), FiniteElementError> {
    if weight.is_one() {
        return Ok(());
    }
    let cells = 0..table.classes().len();
    let centers = cells.filter(|cell| table.classes()[*cell] != CellClass::Outer);
    let at_center = centers.map(|cell| weight.at(table.grid().cell(table.cell_of(cell)).center()).value);
    let vanishing = VANISHING * at_center.fold(0.0, |max: f64, value| max.max(value.abs()));
    for &point in table.boundary() {
        let jet = weight.at(point);
        let change = jet.gradient.length() * table.grid().width().max_element();
        if jet.value.abs() <= vanishing && change <= vanishing {
            return Err(FiniteElementError::DegenerateWeight { point });
        }
    }
    Ok(())
}

fn product(a: Jet, b: Jet) -> Jet {
    Jet { value: a.value * b.value, gradient: a.gradient * b.value + b.gradient * a.value }
}

impl ElementSource for WeightedSpace {
    fn element_count(&self) -> usize {
        self.grid().cell_count()
    }

    fn function_count(&self) -> usize {
        self.nodes.shape().iter().product()
    }

    fn write_element(&self, element: usize, samples: &mut ElementSamples) -> Result<(), FiniteElementError> {
        let class = self.table.classes()[element];
        if class == CellClass::Outer {
            return Ok(());
        }
        let cell = self.table.cell_of(element);
        let columns = self.nodes.shape()[1];
        for i in 0..=self.degree {
            let first = (cell[0] + i) * columns + cell[1];
            samples.indices.extend(first..=first + self.degree);
        }
        let bounds = self.grid().cell(cell);
        if class == CellClass::Inner {
            tensor_points(&bounds, self.table.rule(), |p| samples.push_point(p.point, p.weight));
            for p in 0..samples.points.len() {
                let point = samples.points[p];
                let count = self.gauss_basis.len();
                self.push_jets(samples, point, [&self.gauss_basis[p / count], &self.gauss_basis[p % count]])?;
            }
        } else {
            for p in self.table.cut_points(element) {
                let local = (p.point - bounds.lower) / self.grid().width();
                samples.push_point(p.point, p.weight);
                let basis = [CellBasis::new(self.degree, local.x), CellBasis::new(self.degree, local.y)];
                self.push_jets(samples, p.point, [&basis[0], &basis[1]])?;
            }
        }
        Ok(())
    }
}

/// Whether a coefficient belongs to the space.
pub(super) fn is_relevant(class: NodeClass) -> bool {
    class != NodeClass::Irrelevant
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::domain::Bounds;
    use crate::core::progress::Unwatched;

    fn space(weight: Weight, degree: usize) -> Result<WeightedSpace, FiniteElementError> {
        let disc = Domain::disc(DVec2::ZERO, 1.0).unwrap();
        let grid = Grid::new(Bounds::new(DVec2::splat(-1.1), DVec2::splat(1.1)), [7, 6]).unwrap();
        WeightedSpace::new(disc, weight, grid, degree, degree + 2, &Unwatched)
    }

    fn disc_weight() -> Weight {
        Weight::OfDomain(Domain::disc(DVec2::ZERO, 1.0).unwrap())
    }

    #[test]
    fn equal_coefficients_give_the_weight_itself() {
        for degree in 1..=5 {
            let space = space(disc_weight(), degree).unwrap();
            let ones = vec![1.0; space.function_count()];
            for x in [DVec2::new(0.3, -0.4), DVec2::new(-0.9, 0.1), DVec2::ZERO] {
                let (got, wanted) = (space.evaluate(&ones, x).unwrap(), space.weight().at(x));
                assert!((got.value - wanted.value).abs() < 1e-14, "degree {degree}, value at {x}");
                assert!((got.gradient - wanted.gradient).length() < 1e-13, "degree {degree}, slope at {x}");
            }
            assert_eq!(space.evaluate(&ones, DVec2::new(0.8, 0.8)), None, "outside");
        }
    }

    #[test]
    fn samples_of_an_element_are_the_functions_evaluated() {
        let space = space(disc_weight(), 3).unwrap();
        let coefficients: Vec<f64> =
            (0..space.function_count()).map(|k| ((k * k) % 7) as f64 - 3.0).collect();
        let mut samples = ElementSamples::default();
        for element in 0..space.element_count() {
            samples.clear();
            space.write_element(element, &mut samples).unwrap();
            for (p, &x) in samples.points.iter().enumerate() {
                let (got, wanted) =
                    (samples.combine(p, &coefficients), space.evaluate(&coefficients, x).unwrap());
                assert!((got.value - wanted.value).abs() < 1e-13, "value at {x}");
                assert!((got.gradient - wanted.gradient).length() < 1e-12, "gradient at {x}");
            }
        }
    }

    #[test]
    fn values_on_a_lattice_are_those_at_its_points() {
        let space = space(disc_weight(), 2).unwrap();
        let coefficients: Vec<f64> = (0..space.function_count()).map(|k| k as f64).collect();
        let mut values = vec![0.0; 15];
        space.write_values(&coefficients, 5, 3, &mut values).unwrap();
        assert!(values[0].is_nan(), "a corner of the box is outside");
        let middle = space.evaluate(&coefficients, DVec2::ZERO).unwrap().value;
        assert!((values[7] - middle).abs() < 1e-12, "middle: {} and {middle}", values[7]);
        assert_eq!(
            space.write_values(&coefficients, 5, 4, &mut values).unwrap_err().name(),
            "SizeMismatch",
            "15 places"
        );
    }

    #[test]
    fn weights_that_are_not_positive_or_have_no_slope_are_named() {
        let square = |x: DVec2| {
            let d = 1.0 - x.length_squared();
            Jet { value: d * d, gradient: -4.0 * d * x }
        };
        assert_eq!(space(Weight::function(square), 2).unwrap_err().name(), "DegenerateWeight", "double zero");
        let negative = Weight::function(|x| Jet { value: x.x - 0.1, gradient: DVec2::X });
        let space = space(negative, 2).unwrap();
        let mut samples = ElementSamples::default();
        let names: Vec<_> = (0..space.element_count())
            .filter_map(|element| space.write_element(element, &mut samples).err())
            .map(|error| error.name())
            .collect();
        assert!(!names.is_empty() && names.iter().all(|name| *name == "WeightNotPositive"), "{names:?}");
    }
}
