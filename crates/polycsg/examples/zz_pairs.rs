use polycsg::{Csg, FillRule, Scratch};
use std::time::Instant;
type R = Vec<[f64; 2]>;
struct Rng(u64);
impl Rng {
    fn f(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0.wrapping_mul(0x2545F4914F6CDD1D) >> 11) as f64 / (1u64 << 53) as f64
    }
}
fn outline(g: &mut Rng, n: usize, noise: f64, c: [f64; 2]) -> R {
    let k: Vec<[f64; 3]> =
        (2..=6).map(|k| [k as f64, g.f() * 0.25 / k as f64, g.f() * std::f64::consts::TAU]).collect();
    (0..n)
        .map(|i| {
            let t = std::f64::consts::TAU * i as f64 / n as f64;
            let mut r = 1.0 + k.iter().map(|k| k[1] * (k[0] * t + k[2]).cos()).sum::<f64>();
            if noise > 0.0 {
                r += noise * (2.0 * g.f() - 1.0);
            }
            [c[0] + r * t.cos(), c[1] + r * t.sin()]
        })
        .collect()
}
fn neighbours(g: &mut Rng, n: usize) -> [R; 2] {
    let m = n / 2;
    let path: R = (0..m).map(|y| [0.1 * g.f() - 0.05, y as f64]).collect();
    let mut side = |x: f64| -> R {
        (0..n - m)
            .map(|i| [x, (m - 1) as f64 * (1.0 - i as f64 / (n - m - 1).max(1) as f64)])
            .map(|p| [p[0] + 0.1 * g.f(), p[1]])
            .collect()
    };
    let right = side(5.0);
    let left = side(-5.0);
    let mut a: R = path.clone();
    a.extend(left);
    a.reverse();
    let mut b: R = path;
    b.extend(right);
    b.reverse();
    [b, a.into_iter().rev().collect()]
}
fn board(n: usize, d: f64, odd: usize) -> Vec<R> {
    (0..n * n)
        .filter(|k| (k / n + k % n) % 2 == odd)
        .map(|k| {
            let (x, y) = ((k / n) as f64 + d, (k % n) as f64 + d);
            vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]
        })
        .collect()
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: usize = a[2].parse().unwrap();
    let pairs: usize = a.get(3).map_or(20000 / n, |s| s.parse().unwrap()).max(1);
    let mut g = Rng(88172645463325252);
    let one = |r: R| vec![r];
    let ops: Vec<[Vec<R>; 2]> = (0..pairs)
        .map(|_| {
            let c = [0.8 * (2.0 * g.f() - 1.0), 0.8 * (2.0 * g.f() - 1.0)];
            match a[1].as_str() {
                "smooth" | "smoothu" => {
                    [one(outline(&mut g, n, 0.0, [0.0; 2])), one(outline(&mut g, n, 0.0, c))]
                }
                "ragged" => [one(outline(&mut g, n, 0.05, [0.0; 2])), one(outline(&mut g, n, 0.05, c))],
                "tile" => {
                    let s = 0.8 + g.f();
                    let o = outline(&mut g, n, 0.0, [0.0; 2]);
                    [
                        one(o),
                        one(vec![[c[0], c[1]], [c[0] + s, c[1]], [c[0] + s, c[1] + s], [c[0], c[1] + s]]),
                    ]
                }
                "neighbours" => neighbours(&mut g, n).map(one),
                "boards" => [board(n, 0.0, 0), board(n, 0.5, 0)],
                "complementary" => [board(n, 0.0, 0), board(n, 0.0, 1)],
                "sqtri" => [
                    one(vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]),
                    one(vec![[1.0, -1.0], [5.0, 2.0], [2.0, 5.0]]),
                ],
                _ => panic!(),
            }
        })
        .collect();
    let mut s = Scratch::default();
    let rounds = a.get(4).map_or(10, |s| s.parse().unwrap());
    let mut best = f64::MAX;
    let mut area = 0.0;
    for _ in 0..rounds {
        area = 0.0;
        let t = Instant::now();
        for [p, q] in &ops {
            let (p, q) = (
                Csg::from_rings(p, FillRule::NonZero).unwrap(),
                Csg::from_rings(q, FillRule::NonZero).unwrap(),
            );
            let c = match a[1].as_str() {
                "smooth" | "ragged" | "tile" => p & q,
                "sqtri" => p - q,
                "boards" => p & q,
                _ => p | q,
            };
            area += c.evaluate_with(&mut s).area();
        }
        best = best.min(t.elapsed().as_secs_f64());
    }
    println!("{} {} {:.3} us/pair area {}", a[1], n, best * 1e6 / pairs as f64, area);
}
