//! Double-double arithmetic: about 106 bits.

/// An unevaluated sum of two doubles with |lo| at most half an ulp of hi.
///
/// The operations are Dekker's and Knuth's; each is right to a relative 2^-100, with room to spare, where nothing
/// over- or underflows (Joldes, Muller & Popescu, "Tight and rigorous error bounds", 2017).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Double {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

impl Double {
    #[inline]
    pub(crate) fn sum(a: f64, b: f64) -> Double {
        let hi = a + b;
        let t = hi - a;
        Double { hi, lo: (a - (hi - t)) + (b - t) }
    }

    #[inline]
    pub(crate) fn product(a: f64, b: f64) -> Double {
        let split = |x: f64| {
            let t = 134_217_729.0 * x;
            let high = t - (t - x);
            (high, x - high)
        };
        let hi = a * b;
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        Double { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
    }

    #[inline]
    pub(crate) fn plus(self, other: Double) -> Double {
        let (s, t) = (Double::sum(self.hi, other.hi), Double::sum(self.lo, other.lo));
        let v = Double::sum(s.hi, s.lo + t.hi);
        Double::sum(v.hi, t.lo + v.lo)
    }

    #[inline]
    pub(crate) fn minus(self, other: Double) -> Double {
        self.plus(Double { hi: -other.hi, lo: -other.lo })
    }

    #[inline]
    pub(crate) fn times(self, other: Double) -> Double {
        let p = Double::product(self.hi, other.hi);
        Double::sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}
