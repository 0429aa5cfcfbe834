//! Exact arithmetic on finite `f64` numbers, for geometric predicates and for sums that cancel.
//!
//! A geometric predicate asks for the sign of a polynomial in coordinates. It computes the polynomial in `f64` with a bound
//! on its error first, and asks this crate where the bound does not decide.
//!
//! | for | type or function | right | speed |
//! | --- | --- | --- | --- |
//! | sums and products with 106 bits | [`DoubleDouble`] | within 2^-100 of itself, barring over- and underflow | some 10 to 30 operations |
//! | the determinants of three points in the plane, or four in space | [`orient2d`], [`orient3d`] | always | expansions, else integers |
//! | any polynomial of coordinates that share a scale | [`fixed`] | always, or it says that they do not | no allocation |
//! | a polynomial of coordinates of any exponents | [`Wide`] | within its bound, 125 bits | no allocation |
//! | any polynomial of coordinates | [`integers`], [`scaled_integers`] | always | allocates |
//! | a quotient of polynomials | [`Ratio`] | always; rounds to the nearest `f64` | allocates |
//!
//! All work on the whole range of finite numbers, from 5e-324 to 1.7e308. The crate knows no geometry: which polynomial
//! answers which question is up to the caller.
//!
//! ```
//! use exactfloat::{DoubleDouble, orient2d};
//! // 0.1 * 10 is not 1, and a double-double shows by how much.
//! let product = DoubleDouble::product(0.1, 10.0);
//! assert_eq!((product.hi, product.lo), (1.0, 5.551115123125783e-17));
//! // Three points that lie on a line but for the last bit of one.
//! let turn = orient2d([0.0, 0.0], [0.1, 0.1], [0.3, 0.3 + f64::EPSILON / 4.0]);
//! assert!(turn > 0.0);
//! ```
//!
//! [`Integer`] is `dashu_int::IBig`, so that a new major version of dashu-int is a new major version of this crate.

mod determinant;
mod double_double;
pub mod fixed;
mod integers;
mod ratio;
mod wide;

pub use dashu_int::IBig as Integer;
pub use determinant::{orient2d, orient3d};
pub use double_double::DoubleDouble;
pub use integers::{integers, lowest_exponent, multiple, scaled_integers, sign};
pub use ratio::{Ratio, nearest};
pub use wide::Wide;
