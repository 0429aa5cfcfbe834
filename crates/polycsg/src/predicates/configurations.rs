//! Points on which predicates go wrong: any exponents, common lines, common points, common coordinates. For tests and
//! for fuzzing; each choice is a word of 64 bits, so that a fuzzer can make it.

use glam::DVec2;

/// Six points, whatever a predicate makes of them.
pub(super) type Configuration = [DVec2; 6];

/// Six points from a stream of words.
pub(super) fn configuration(word: &mut impl FnMut() -> u64) -> Configuration {
    let kind = word() % 6;
    let points = match kind {
        0 => free(word),
        1 => one_size(word),
        2 => near_a_line(word),
        3 => near_a_point(word),
        4 => on_an_edge(word),
        _ => few_coordinates(word),
    };
    points.map(|p| p.clamp(DVec2::splat(f64::MIN), DVec2::splat(f64::MAX)))
}

/// A small integer, an ordinary number, one of any exponent from -1000 to 1000, or an extreme one.
fn number(word: &mut impl FnMut() -> u64) -> f64 {
    let bits = word();
    let (choice, rest) = (bits % 8, bits >> 3);
    match choice {
        0..=2 => integer(rest),
        3..=4 => unit(rest),
        5..=6 => unit(rest) * power(word()),
        _ => [f64::MAX, f64::MIN, 5e-324, -5e-324, f64::MIN_POSITIVE, 0.0, -0.0, 1.0][(rest % 8) as usize],
    }
}

/// From -8 to 8.
fn integer(bits: u64) -> f64 {
    f64::from((bits % 17) as u8) - 8.0
}

/// From -1 to 1, with as many bits as a double has.
fn unit(bits: u64) -> f64 {
    let mantissa = f64::from_bits(1.0_f64.to_bits() | (bits >> 9) & ((1 << 52) - 1)) - 1.0;
    if bits & 1 == 0 { mantissa } else { -mantissa }
}

/// 2^-1000 to 2^1000.
fn power(bits: u64) -> f64 {
    f64::from_bits((23 + bits % 2001) << 52)
}

fn array<T>(mut item: impl FnMut() -> T) -> [T; 6] {
    std::array::from_fn(|_| item())
}

fn free(word: &mut impl FnMut() -> u64) -> Configuration {
    array(|| DVec2::new(number(word), number(word)))
}

fn one_size(word: &mut impl FnMut() -> u64) -> Configuration {
    let size = power(word());
    array(|| DVec2::new(unit(word()), unit(word())) * size)
}

/// Further from zero by so many ulps, or nearer by as many; never beyond either end of the range.
pub(super) fn stepped(v: f64, ulps: i64) -> f64 {
    let magnitude = v.abs().to_bits().saturating_add_signed(ulps).min(f64::MAX.to_bits());
    f64::from_bits(magnitude).copysign(v)
}

/// Moved by -2 to 2 ulps in each coordinate.
fn nudged(p: DVec2, bits: u64) -> DVec2 {
    let ulps = |bits: u64| i64::from((bits % 5) as u8) - 2;
    // A point that overflowed is back in the range here.
    let p = p.clamp(DVec2::splat(f64::MIN), DVec2::splat(f64::MAX));
    DVec2::new(stepped(p.x, ulps(bits)), stepped(p.y, ulps(bits / 5)))
}

/// The first two are free; the others lie on their line but for roundings and nudges.
fn near_a_line(word: &mut impl FnMut() -> u64) -> Configuration {
    let size = power(word());
    let mut end = || DVec2::new(number(word), number(word)) * if number(word) < 0.0 { size } else { 1.0 };
    let (a, b) = (end(), end());
    let mut on_line = || {
        let t = unit(word()) * 2.0;
        let p = a * (1.0 - t) + b * t;
        nudged(if p.is_nan() { a } else { p }, word())
    };
    [a, b, on_line(), on_line(), on_line(), on_line()]
}

/// Three edges through nearly or exactly one point.
fn near_a_point(word: &mut impl FnMut() -> u64) -> Configuration {
    let (size, kind) = (power(word()), word());
    let centre = if kind % 2 == 0 { DVec2::new(0.3, 0.7) } else { DVec2::new(3.0, 5.0) };
    let mut edge = || {
        let bits = word();
        let direction = if kind / 2 % 2 == 0 {
            DVec2::new(integer(bits), integer(bits >> 32))
        } else {
            DVec2::new(unit(bits), unit(word()))
        };
        let stretch = if kind / 4 % 2 == 0 { 0.75 } else { 1.0 };
        let nudges = if kind / 8 % 2 == 0 { word() } else { 12 };
        [
            nudged((centre - direction) * size, nudges),
            nudged((centre + direction * stretch) * size, nudges / 25),
        ]
    };
    let [e, f, g] = [edge(), edge(), edge()];
    [e[0], e[1], f[0], f[1], g[0], g[1]]
}

/// The fifth halves the first two, where no bit is lost; the third and fourth lie about it.
fn on_an_edge(word: &mut impl FnMut() -> u64) -> Configuration {
    let (size, bits) = (power(word() % 1990), word());
    let mut lattice = || DVec2::new(integer(word()), integer(word()));
    let (middle, run, across, along) = (lattice(), lattice(), lattice(), lattice());
    let shift = if bits % 3 == 0 { along / 1024.0 } else { DVec2::ZERO };
    let points = [
        middle - run,
        middle + run,
        nudged(middle + shift - across, bits >> 8),
        middle + shift + across,
        middle,
        along,
    ];
    points.map(|p| p * size)
}

fn few_coordinates(word: &mut impl FnMut() -> u64) -> Configuration {
    let pool: [f64; 6] = array(|| number(word));
    let mut pick = || pool[(word() % 6) as usize];
    array(|| DVec2::new(pick(), pick()))
}
