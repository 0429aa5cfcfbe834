//! How light climbs and bends along an axis of a tile.
//!
//! ```text
//! |*                       A line passes through the three points of an axis: they say that light is linear. From the round of a peak to
//! |     x                  its tail it turns instead, on one side above the line, on the other below. Where light climbs as much as
//! |       .                here and bends less than an exponential does, one more look, at x, tells.
//! |        *
//! |          .
//! |              .  *
//! +-----------------------
//! ```

/// Where a cubic through zero at the tips and in the middle is largest, in axes from the middle: 1/√3.
const TURN: f64 = 0.577_350_269_189_625_8;

/// What climbs by less than this share of its mean from the middle to a tip hardly turns.
const STEEP: f64 = 0.3;

/// The light e^(-ax) bends by so many times b²/g where it climbs by b.
const EXPONENTIAL: f64 = 0.5;

/// How many times its distance from the parabola a turn bends. The mean of each half is off by it, as by no parabola, and in all that see a tile the
/// same way, as parts of a lamp do, with one sign: of the scene `emission`, its plane cut along its sides, at 1 %, 52, 63 and 99 % of the patches
/// were within their estimates with 1, 2 and 3, looked at ahead, not on the bright side.
const HALVES: f64 = 3.0;

/// What is seen from the points of an axis, as the parabola through them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parabola {
    middle: f64,
    climb: f64,
    /// How far the tips are above the middle in the mean.
    pub(super) bend: f64,
}

impl Parabola {
    pub(super) fn through([back, middle, ahead]: [f64; 3]) -> Parabola {
        Parabola { middle, climb: (ahead - back) / 2.0, bend: (ahead + back) / 2.0 - middle }
    }

    /// Whether it climbs much and hardly bends, where so much is seen in the mean.
    pub(super) fn may_turn(&self, mean: f64) -> bool {
        let square = self.climb * self.climb;
        self.climb.abs() > STEEP * mean && self.bend.abs() * mean < EXPONENTIAL * square
    }

    /// Where to look: on the bright side.
    pub(super) fn turn(&self) -> f64 {
        TURN.copysign(self.climb)
    }

    /// How much it bends where so much is seen there.
    pub(super) fn bend_with(&self, seen: f64) -> f64 {
        let turn = HALVES * (seen - self.middle - (self.climb + self.bend * self.turn()) * self.turn());
        if turn.abs() > self.bend.abs() { turn } else { self.bend }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(light: impl Fn(f64) -> f64) -> (bool, [f64; 2]) {
        let parabola = Parabola::through([-1.0, 0.0, 1.0].map(&light));
        let mean = parabola.middle + parabola.bend / 2.0;
        (parabola.may_turn(mean), [parabola.bend, parabola.bend_with(light(parabola.turn()))])
    }

    /// Below a small lamp light falls off as 1/(1 + x²)²: where it turns, its three points are on a line.
    #[test]
    fn light_that_turns_bends_though_three_points_are_on_a_line() {
        let (may_turn, [by_points, bend]) = along(|x| (1.0 + (0.55 + 0.6 * x).powi(2)).powi(-2));
        assert!(may_turn && by_points.abs() < 0.005 && bend.abs() > 0.1, "{by_points} {bend}");
    }

    #[test]
    fn no_more_is_looked_at_what_falls_off_or_hardly_climbs() {
        assert!(!along(|x| (2.0 + x).powi(-2)).0);
        assert!(!along(|x| (-0.9 * x).exp()).0);
        assert!(!along(|x| 1.0 + 0.2 * x).0);
        assert!(!along(|_| 0.0).0);
    }

    #[test]
    fn what_is_linear_or_a_parabola_stays_so() {
        for (bend, light) in [(0.0, [1.0, 0.9, 0.0]), (-0.3, [1.0, 0.9, -0.3])] {
            let (_, [by_points, found]) = along(|x| light[0] + light[1] * x + light[2] * x * x);
            assert!((by_points - bend).abs() < 1e-15 && (found - bend).abs() < 1e-15, "{found}");
        }
    }
}
