//! Chapter 1: polynomials.
//!
//! A polynomial of degree at most `n` on `[0, 1]` is given by its Bernstein coefficients `c₀ … cₙ`: `p = Σ cₖ bⁿₖ` with
//! `bⁿₖ(x) = C(n,k) (1 − x)ⁿ⁻ᵏ xᵏ`. Coefficients may be points, see [`Point`](crate::core::point::Point); then `p` is the Bezier
//! curve of chapter 2.
//!
//! | file | what |
//! |---|---|
//! | `bernstein` | 1.4, 1.5 values, derivatives and maxima of the Bernstein polynomials, evaluation matrix, Bernstein approximation |
//! | `conversion` | 1.4 monomial form and Bernstein form |
//! | `calculus` | 1.5 derivative, antiderivative, integral, degree elevation |
//! | `product` | 1.5 products, Gram matrix |
//! | `zeros` | 1.5 sign changes, intervals with the zeros |

mod bernstein;
mod calculus;
mod conversion;
mod error;
mod product;
mod zeros;

pub use bernstein::{
    BernsteinMaximum, bernstein, bernstein_approximation, bernstein_derivative, bernstein_matrix,
    bernstein_maximum, bernstein_values, write_bernstein_values,
};
pub use calculus::{antiderivative, derivative, elevate, integral};
pub use conversion::{bernstein_from_monomial, bernstein_to_monomial, conversion_matrix, monomial_growth};
pub use error::PolynomialError;
pub(in crate::core) use product::product_by;
pub use product::{bernstein_gram, bernstein_product};
pub use zeros::{ZeroInterval, ZeroKind, isolate_zeros, sign_changes};
