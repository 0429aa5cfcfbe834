//! Fixed-point numbers with 384 bits after the point, and the few functions that Lambert's sum needs.
use super::space::{Vector, cross, dot};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

const BITS: u64 = 384;

/// A multiple of 2^-384, within some hundred of them of what it stands for.
#[derive(Clone, Debug)]
pub(super) struct Fixed(BigInt);

impl Fixed {
    pub(super) fn zero() -> Fixed {
        Fixed(BigInt::zero())
    }

    fn one() -> Fixed {
        Fixed(BigInt::one() << BITS)
    }

    pub(super) fn ratio(&self) -> BigRational {
        BigRational::new(self.0.clone(), BigInt::one() << BITS)
    }

    pub(super) fn plus(&self, other: &Fixed) -> Fixed {
        Fixed(&self.0 + &other.0)
    }

    pub(super) fn minus(&self, other: &Fixed) -> Fixed {
        Fixed(&self.0 - &other.0)
    }

    pub(super) fn times(&self, other: &Fixed) -> Fixed {
        Fixed((&self.0 * &other.0) >> BITS)
    }

    pub(super) fn by(&self, other: &Fixed) -> Fixed {
        Fixed((&self.0 << BITS) / &other.0)
    }

    /// The root of a quotient that is not negative.
    fn root(top: &BigInt, bottom: &BigInt) -> Fixed {
        Fixed(((top << (2 * BITS)) / bottom).sqrt())
    }

    /// The cosine of the angle between two vectors.
    pub(super) fn cosine(a: &Vector, b: &Vector) -> Fixed {
        let product = dot(a, b);
        let size = Fixed::root(&(&product * &product), &(dot(a, a) * dot(b, b)));
        if product.is_negative() { Fixed(-size.0) } else { size }
    }

    /// The angle between two vectors: twice the arc tangent of sin / (1 + cos).
    pub(super) fn angle(a: &Vector, b: &Vector) -> Fixed {
        let across = cross(a, b);
        let sine = Fixed::root(&dot(&across, &across), &(dot(a, a) * dot(b, b)));
        let cosine = Fixed::cosine(a, b);
        let acute = Fixed(sine.by(&Fixed::one().plus(&Fixed(cosine.0.abs()))).arc_tangent().0 * 2);
        if cosine.0.is_negative() { Fixed(Fixed::tau().0 >> 1u32).minus(&acute) } else { acute }
    }

    /// 2 pi = 8 atan 1.
    pub(super) fn tau() -> Fixed {
        Fixed(Fixed::one().arc_tangent().0 * 8)
    }

    /// Of a number in [0, 1]: tan(x / 2) = t / (1 + sqrt(1 + t^2)), until the series is short.
    fn arc_tangent(&self) -> Fixed {
        const HALVINGS: u32 = 12;
        let one = Fixed::one();
        let mut t = self.clone();
        for _ in 0..HALVINGS {
            let square = one.plus(&t.times(&t));
            t = t.by(&one.plus(&Fixed((square.0 << BITS).sqrt())));
        }
        let square = t.times(&t);
        let (mut power, mut sum, mut odd) = (t.clone(), t, 1);
        while !power.0.is_zero() {
            odd += 2;
            power = Fixed(-power.times(&square).0);
            sum = Fixed(sum.0 + &power.0 / odd);
            if power.0.bits() < 2 {
                break;
            }
        }
        Fixed(sum.0 << HALVINGS)
    }
}
