//! perf PATTERN N [op] [peer]: builds operands, evaluates, prints time and size of the result.
use polycsg::{Csg, FillRule, Region, Scratch};
use std::time::Instant;
type R = Vec<[f64; 2]>;
struct Rng(u64);
impl Rng {
    fn u(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545F4914F6CDD1D)
    }
    fn f(&mut self) -> f64 {
        (self.u() >> 11) as f64 / (1u64 << 53) as f64
    }
    fn i(&mut self, n: u64) -> f64 {
        (self.u() % n) as f64
    }
}
fn sq(x: f64, y: f64, w: f64, h: f64) -> R {
    vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
}
fn spiral(n: usize, turns: f64, phase: f64, c: [f64; 2]) -> R {
    let half = n / 2;
    let p = |i: usize, w: f64| {
        let t = i as f64 / half as f64;
        let a = t * turns * std::f64::consts::TAU + phase;
        let r = 0.05 + t + w / turns;
        [c[0] + r * a.cos(), c[1] + r * a.sin()]
    };
    (0..half).map(|i| p(i, 0.0)).chain((0..half).rev().map(|i| p(i, 0.5))).collect()
}
fn zigzag(n: usize, vertical: bool) -> R {
    // a band of n/2 teeth, long edges
    let m = n / 2;
    let mut v = Vec::new();
    let w = 0.3 / m as f64;
    for i in 0..m {
        let t = i as f64 / m as f64;
        v.push(if i % 2 == 0 { [t, -0.1] } else { [t, 1.1] });
    }
    for i in (0..m).rev() {
        let t = i as f64 / m as f64 + w;
        v.push(if i % 2 == 0 { [t, -0.1] } else { [t, 1.1] });
    }
    if vertical {
        v.iter_mut().for_each(|p| p.swap(0, 1));
        v.reverse();
    }
    v
}
fn hilbert(order: u32) -> Vec<[f64; 2]> {
    let n = 1u64 << order;
    (0..n * n)
        .map(|d| {
            let (mut x, mut y, mut t) = (0u64, 0u64, d);
            let mut s = 1;
            while s < n {
                let rx = 1 & (t / 2);
                let ry = 1 & (t ^ rx);
                if ry == 0 {
                    if rx == 1 {
                        x = s - 1 - x;
                        y = s - 1 - y;
                    }
                    std::mem::swap(&mut x, &mut y);
                }
                x += s * rx;
                y += s * ry;
                t /= 4;
                s *= 2;
            }
            [x as f64, y as f64]
        })
        .collect()
}
/// operands: each a list of rings with a rule
fn build(name: &str, n: usize) -> (Vec<(Vec<R>, FillRule)>, String) {
    use FillRule::*;
    let mut g = Rng(88172645463325252 + n as u64);
    let tau = std::f64::consts::TAU;
    let one = |v: Vec<R>| (v, NonZero);
    let (ops, op): (Vec<(Vec<R>, FillRule)>, &str) = match name {
        "spirals" => (
            vec![
                one(vec![spiral(n / 2, (n as f64).sqrt() / 4.0, 0.0, [0.0, 0.0])]),
                one(vec![spiral(n / 2, (n as f64).sqrt() / 4.0, 1.0, [0.01, 0.02])]),
            ],
            "xor",
        ),
        "spirals-near" => (
            vec![
                one(vec![spiral(n / 2, 20.0, 0.0, [0.0, 0.0])]),
                one(vec![spiral(n / 2, 20.0, 1e-15, [0.0, 0.0])]),
            ],
            "xor",
        ),
        "zigzags" => (vec![one(vec![zigzag(n / 2, false)]), one(vec![zigzag(n / 2, true)])], "and"),
        "hilbert-ulp" => {
            let o = ((n as f64 / 4.0).log2() / 2.0).round() as u32;
            let h = hilbert(o);
            let s = |e: f64| -> Vec<R> {
                h.windows(2)
                    .map(|w| {
                        let (a, b) = (w[0], w[1]);
                        let x = a[0].min(b[0]) + 0.1;
                        let y = a[1].min(b[1]) + 0.1;
                        sq(x + e * x, y + e * y, (a[0] - b[0]).abs() + 0.3, (a[1] - b[1]).abs() + 0.3)
                    })
                    .collect()
            };
            (vec![one(s(0.0)), one(s(f64::EPSILON * 2.0))], "xor")
        }
        "walk" => (vec![one(vec![(0..n).map(|_| [g.f(), g.f()]).collect()])], "or"),
        "walk-eo" => (vec![(vec![(0..n).map(|_| [g.f(), g.f()]).collect()], EvenOdd)], "or"),
        "walk-short" => {
            let (mut x, mut y) = (0.0, 0.0);
            (
                vec![one(vec![
                    (0..n)
                        .map(|_| {
                            x += g.f() - 0.5;
                            y += g.f() - 0.5;
                            [x, y]
                        })
                        .collect(),
                ])],
                "or",
            )
        }
        "walk-lattice" => (vec![one(vec![(0..n).map(|_| [g.i(64), g.i(64)]).collect()])], "or"),
        "walk-ulps" => (
            vec![one(vec![
                (0..n).map(|_| [4503599627370496.0 + g.i(64), 4503599627370496.0 + g.i(64)]).collect(),
            ])],
            "or",
        ),
        "walk-ulps-sub" => {
            (vec![one(vec![(0..n).map(|_| [g.i(64) * 5e-324, g.i(64) * 5e-324]).collect()])], "or")
        }
        "walk-ulps-eo" => (
            vec![(
                vec![
                    (0..n)
                        .map(|_| [4503599627370496.0 + g.i(1024), 4503599627370496.0 + g.i(1024)])
                        .collect(),
                ],
                EvenOdd,
            )],
            "or",
        ),
        "star-nk" => {
            let k = n / 2 - 1 + (n % 2);
            (
                vec![one(vec![
                    (0..n)
                        .map(|i| {
                            let a = tau * ((i * k) % n) as f64 / n as f64;
                            [a.cos(), a.sin()]
                        })
                        .collect(),
                ])],
                "or",
            )
        }
        "star-nk-eo" => {
            let k = n / 2 - 1 + (n % 2);
            (
                vec![(
                    vec![
                        (0..n)
                            .map(|i| {
                                let a = tau * ((i * k) % n) as f64 / n as f64;
                                [a.cos(), a.sin()]
                            })
                            .collect(),
                    ],
                    EvenOdd,
                )],
                "or",
            )
        }
        "baseline" => (
            (0..n / 4)
                .map(|i| one(vec![sq(i as f64, 0.0, (n / 2 - 2 * i) as f64, 1.0 + i as f64)]))
                .collect(),
            "or",
        ),
        "baseline-random" => (
            (0..n / 4)
                .map(|_| {
                    let a = g.f();
                    let b = g.f();
                    one(vec![sq(a.min(b), 0.0, (a - b).abs(), g.f())])
                })
                .collect(),
            "or",
        ),
        "baseline-vertical" => (
            (0..n / 4)
                .map(|_| {
                    let a = g.f();
                    let b = g.f();
                    one(vec![sq(0.0, a.min(b), g.f(), (a - b).abs())])
                })
                .collect(),
            "or",
        ),
        "diagonal-overlap" => (
            (0..n / 3)
                .map(|_| {
                    let a = g.i(1 << 30);
                    let b = g.i(1 << 30);
                    let (a, b) = (a.min(b), a.max(b));
                    one(vec![vec![[a, a], [b, b], [a, b]]])
                })
                .collect(),
            "or",
        ),
        "same-but-one" => (
            (0..n / 5)
                .map(|_| one(vec![vec![[0.0, 0.0], [g.f(), 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]]))
                .collect(),
            "or",
        ),
        "concurrent" => {
            let m = n as i64 / 2;
            let v: R = (0..m)
                .flat_map(|i| {
                    let p = [(i + 1) as f64, (m - i) as f64];
                    [p, [-p[0], -p[1]]]
                })
                .collect();
            (vec![(vec![v], EvenOdd)], "or")
        }
        "concurrent-float" => {
            let m = n / 2;
            let c = [1.0 / 3.0, 1.0 / 7.0];
            let v: R = (0..m)
                .flat_map(|i| {
                    let a = tau * i as f64 / n as f64;
                    let d = [a.cos(), a.sin()];
                    [[c[0] + d[0], c[1] + d[1]], [c[0] - d[0], c[1] - d[1]]]
                })
                .collect();
            (vec![(vec![v], EvenOdd)], "or")
        }
        "flower" => {
            let m = n / 3;
            let v: R = (0..m)
                .flat_map(|i| {
                    let a = tau * i as f64 / m as f64;
                    let b = tau * (i as f64 + 0.5) / m as f64;
                    [[0.0, 0.0], [a.cos(), a.sin()], [b.cos(), b.sin()]]
                })
                .collect();
            (vec![one(vec![v])], "or")
        }
        "nested" => (
            vec![(
                (0..n / 4).map(|i| sq(i as f64, i as f64, (n - 2 * i) as f64, (n - 2 * i) as f64)).collect(),
                EvenOdd,
            )],
            "or",
        ),
        "nested-touch" => (
            vec![(
                (0..n / 4)
                    .map(|i| {
                        let s = (n - 2 * i) as f64;
                        vec![[0.0, 0.0], [s, i as f64 + 1.0], [s, s], [i as f64 + 1.0, s]]
                    })
                    .collect(),
                EvenOdd,
            )],
            "or",
        ),
        "nested-chevrons" => (
            vec![(
                (0..n / 6)
                    .map(|i| {
                        let y = i as f64;
                        vec![
                            [0.0, y],
                            [1e6, y + 1e6],
                            [2e6, y],
                            [2e6, y + 0.5],
                            [1e6, y + 1e6 + 0.5],
                            [0.0, y + 0.5],
                        ]
                    })
                    .collect(),
                NonZero,
            )],
            "or",
        ),
        "holes-column" => {
            let mut v = vec![sq(-1.0, -1.0, 3.0, n as f64 + 2.0)];
            v.extend((0..n / 4).map(|i| sq(0.0, 4.0 * i as f64, 1.0, 1.0)));
            (vec![(v, EvenOdd), one(vec![sq(0.5, -5.0, 10.0, n as f64 * 2.0)])], "sub")
        }
        "strips" | "strips-near" => {
            let d = if name == "strips" { 1.0 / n as f64 } else { f64::EPSILON * 2.0 };
            let mk = |o: f64| {
                (0..n / 8)
                    .map(|i| {
                        let y = (2.0 * i as f64 + o) * 2.0 * d;
                        vec![[0.0, y], [1.0, 1.0 + y], [1.0, 1.0 + y + d], [0.0, y + d]]
                    })
                    .collect::<Vec<R>>()
            };
            (vec![one(mk(0.0)), one(mk(1.0))], "or")
        }
        "strips-cross-ulp" => {
            let mk = |s: f64| {
                (0..n / 8)
                    .map(|i| {
                        let y = i as f64 * 8.0 * f64::EPSILON;
                        vec![
                            [0.0, y * s],
                            [1.0, 1.0 + y],
                            [1.0, 1.0 + y + 4.0 * f64::EPSILON],
                            [0.0, y * s + 4.0 * f64::EPSILON],
                        ]
                    })
                    .collect::<Vec<R>>()
            };
            (vec![one(mk(1.0)), one(mk(-1.0))], "or")
        }
        "fold-xor" | "fold-or" | "fold-sub" | "fold-right" => (
            (0..n / 4)
                .map(|i| {
                    one(vec![sq(
                        2.0 * (i % 300) as f64 + 0.001 * (i / 300) as f64,
                        2.0 * (i / 300) as f64,
                        1.0,
                        1.0,
                    )])
                })
                .collect(),
            name,
        ),
        "fold-alt" | "fold-alt-right" => (
            (0..n / 4)
                .map(|i| one(vec![sq(2.0 * (i % 300) as f64, 2.0 * (i / 300) as f64, 1.0, 1.0)]))
                .collect(),
            name,
        ),
        "fold-alt-over" | "fold-alt-right-over" => (
            (0..n / 4).map(|i| one(vec![sq(i as f64, i as f64 * 0.5, 2.5, 2.5)])).collect(),
            if name == "fold-alt-over" { "fold-alt" } else { "fold-alt-right" },
        ),
        "bundle" => (
            vec![(
                (0..n / 4)
                    .map(|_| {
                        let (y, m) = (g.f() * 1e-14 + 1.0, g.f() * 1e-14 + 2.0);
                        vec![[0.0, y], [1.0, m], [1.0, m + 4e-16], [0.0, y + 4e-16]]
                    })
                    .collect(),
                EvenOdd,
            )],
            "or",
        ),
        "touch-chain" => {
            let m = n / 4;
            (
                vec![one((0..m)
                    .map(|i| {
                        let x = i as f64;
                        vec![[x, 0.0], [x + 1.0, -1.0], [x + 2.0, 0.0], [x + 1.0, 1.0]]
                    })
                    .collect())],
                "or",
            )
        }
        "big-box-many-touch" => {
            let m = n / 3;
            let mut v: Vec<R> = vec![sq(0.0, 0.0, m as f64, 10.0)];
            v.extend((0..m).map(|i| vec![[i as f64, 0.0], [i as f64 + 0.5, 0.0], [i as f64 + 0.25, 5.0]]));
            (vec![(v, EvenOdd)], "or")
        }
        "fan-copy" => {
            let m = n / 6;
            let c = [500123.25, 4649776.5];
            let mk = |e: f64| -> Vec<R> {
                (0..m)
                    .map(|i| {
                        let p = |i: usize| {
                            let a = tau * i as f64 / m as f64 + e;
                            [c[0] + 100.0 * a.cos(), c[1] + 100.0 * a.sin()]
                        };
                        vec![c, p(i), p(i + 1)]
                    })
                    .collect()
            };
            (vec![one(mk(0.0)), one(mk(1e-11))], "xor")
        }
        "pie-copy" => {
            let m = n / 6;
            let mk = |e: f64| -> Vec<R> {
                (0..m)
                    .map(|i| {
                        let p = |i: usize| {
                            let a = tau * i as f64 / m as f64;
                            [0.3 + e + a.cos(), 0.7 + e + a.sin()]
                        };
                        vec![[0.3 + e, 0.7 + e], p(i), p(i + 1)]
                    })
                    .collect()
            };
            (vec![one(mk(0.0)), one(mk(1e-15))], "xor")
        }
        "skyline" => (
            (0..n / 4)
                .map(|_| {
                    let x = g.f() * 1000.0;
                    one(vec![sq(
                        (x * 100.0).round() / 100.0,
                        0.0,
                        ((g.f() * 100.0 + 1.0) * 100.0).round() / 100.0,
                        (g.f() * 5000.0).round() / 100.0,
                    )])
                })
                .collect(),
            "or",
        ),
        "fold-xor-over" | "fold-or-over" | "fold-right-over" => (
            (0..n / 4).map(|i| one(vec![sq(i as f64, i as f64 * 0.5, 2.5, 2.5)])).collect(),
            match name {
                "fold-xor-over" => "fold-xor",
                "fold-or-over" => "fold-or",
                _ => "fold-right",
            },
        ),
        "incremental" => (
            (0..n / 4).map(|_| one(vec![sq(g.f() * 100.0, g.f() * 100.0, 1.0, 1.0)])).collect(),
            "incremental",
        ),
        "nary" => ((0..n / 4).map(|_| one(vec![sq(g.f() * 100.0, g.f() * 100.0, 1.0, 1.0)])).collect(), "or"),
        "discs" => (
            (0..n / 64)
                .map(|_| {
                    let (x, y) = (g.f(), g.f());
                    one(vec![
                        (0..64)
                            .map(|i| {
                                let a = tau * i as f64 / 64.0;
                                [x + 0.5 * a.cos(), y + 0.5 * a.sin()]
                            })
                            .collect(),
                    ])
                })
                .collect(),
            "or",
        ),
        "exponents" => {
            let mut s = |m: usize| -> R {
                (0..m)
                    .map(|i| {
                        let a = tau * i as f64 / m as f64;
                        let r = 10f64.powf(g.f() * 600.0 - 300.0);
                        [r * a.cos(), r * a.sin()]
                    })
                    .collect()
            };
            let (a, b) = (s(n / 2), s(n / 2));
            (vec![one(vec![a]), one(vec![b])], "xor")
        }
        "exponents-tri" => (
            (0..n / 3)
                .map(|_| {
                    one(vec![
                        (0..3)
                            .map(|_| {
                                let mut c = || {
                                    let v = 10f64.powf(g.f() * 600.0 - 300.0);
                                    if g.f() < 0.5 { v } else { -v }
                                };
                                [c(), c()]
                            })
                            .collect(),
                    ])
                })
                .collect(),
            "or",
        ),
        "star-1e15" => {
            let mut s = || -> R {
                (0..n / 2)
                    .map(|i| {
                        let a = tau * i as f64 / (n / 2) as f64;
                        let r = 1000.0 * (0.5 + 0.5 * g.f());
                        [(1e15 + r * a.cos()).round(), (1e15 + r * a.sin()).round()]
                    })
                    .collect()
            };
            let (a, b) = (s(), s());
            (vec![one(vec![a]), one(vec![b])], "xor")
        }
        "slivers-shared" => {
            let m = n / 6;
            let mut s = |e: f64| -> Vec<R> {
                (0..m)
                    .map(|i| {
                        let (x, y) = (i as f64 / m as f64, 1.0 / 3.0);
                        let j = |g: &mut Rng| e * (g.f() - 0.5);
                        vec![[x, j(&mut g)], [x + 1.0 / m as f64, j(&mut g)], [0.5, y + j(&mut g)]]
                    })
                    .collect()
            };
            let (a, b) = (s(0.0), s(1e-15));
            (vec![one(a), one(b)], "xor")
        }
        "rot-grid" => {
            let m = ((n / 8) as f64).sqrt() as usize;
            let mk = |t: f64| {
                (0..m * m)
                    .map(|k| {
                        let (i, j) = ((k % m) as f64, (k / m) as f64);
                        sq(i, j, 0.9, 0.9)
                            .iter()
                            .map(|p| [p[0] * t.cos() - p[1] * t.sin(), p[0] * t.sin() + p[1] * t.cos()])
                            .collect()
                    })
                    .collect::<Vec<R>>()
            };
            (vec![one(mk(0.0)), one(mk(1e-15))], "xor")
        }
        "needles-fan" => {
            let m = n / 6;
            let mut s = || -> Vec<R> {
                (0..m)
                    .map(|_| {
                        let y = g.f();
                        vec![[0.0, g.f() * 1e-12], [1.0, y], [1.0, y + 1e-9]]
                    })
                    .collect()
            };
            let (a, b) = (s(), s());
            (vec![one(a), one(b)], "and")
        }
        "needles-opp" => {
            let m = n / 6;
            let s = |o: f64| -> Vec<R> {
                (0..m)
                    .map(|i| {
                        let y = (i as f64 + o) / m as f64;
                        vec![[0.0, y], [1.0, 0.5], [0.0, y + 0.3 / m as f64]]
                    })
                    .collect()
            };
            let a = s(0.0);
            let b = a.iter().map(|r| r.iter().rev().map(|p| [1.5 - p[0], p[1]]).collect()).collect();
            (vec![one(a), one(b)], "and")
        }
        "lines-in-ulp-box" => {
            let m = n / 3;
            (
                (0..m)
                    .map(|_| {
                        let a = tau * g.f();
                        let o = (g.f() - 0.5) * 1e-14;
                        let d = [a.cos(), a.sin()];
                        let w = 1e-15;
                        let p = [1.0 - d[1] * o, 1.0 + d[0] * o];
                        one(vec![vec![
                            [p[0] - d[0], p[1] - d[1]],
                            [p[0] + d[0], p[1] + d[1]],
                            [p[0] + d[0] - d[1] * w * 4.0, p[1] + d[1] + d[0] * w * 4.0],
                        ]])
                    })
                    .collect(),
                "or",
            )
        }
        "parcels-jitter" => {
            let m = ((n / 4) as f64).sqrt() as usize;
            let h: Vec<[f64; 2]> = (0..(m + 1) * (m + 1))
                .map(|k| [(k % (m + 1)) as f64 + 0.3 * g.f(), (k / (m + 1)) as f64 + 0.3 * g.f()])
                .collect();
            (
                (0..m * m)
                    .map(|k| {
                        let (i, j) = (k % m, k / m);
                        let id = |a: usize, b: usize| h[b * (m + 1) + a];
                        one(vec![
                            [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]
                                .iter()
                                .map(|p| [p[0] * (1.0 + 2e-16 * g.i(3)), p[1] * (1.0 + 2e-16 * g.i(3))])
                                .collect(),
                        ])
                    })
                    .collect(),
                "or",
            )
        }
        other => panic!("{other}"),
    };
    (ops, op.to_string())
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: usize = a[2].parse().unwrap();
    let (operands, op) = build(&a[1], n);
    let edges: usize = operands.iter().flat_map(|o| o.0.iter()).map(|r| r.len()).sum();
    let csgs: Vec<Csg> = operands.iter().map(|(r, f)| Csg::from_rings(r, *f).unwrap()).collect();
    let t = Instant::now();
    let mut s = Scratch::default();
    let r = match op.as_str() {
        "or" if std::env::var("REGIONS").is_ok() => {
            let r: Vec<Region> = csgs.iter().map(|c| c.evaluate_with(&mut s)).collect();
            let t = Instant::now();
            let u = Csg::union(&r).evaluate_with(&mut s);
            println!("regions {:.3}s", t.elapsed().as_secs_f64());
            u
        }
        "or" => Csg::union(csgs).evaluate_with(&mut s),
        "and" => Csg::intersection(csgs).evaluate_with(&mut s),
        "xor" => Csg::symmetric_difference(csgs).evaluate_with(&mut s),
        "sub" => {
            let mut i = csgs.into_iter();
            let f = i.next().unwrap();
            (f - Csg::union(i.collect::<Vec<_>>())).evaluate_with(&mut s)
        }
        "fold-xor" => csgs.into_iter().reduce(|x, y| x ^ y).unwrap().evaluate_with(&mut s),
        "fold-or" => csgs.into_iter().reduce(|x, y| x | y).unwrap().evaluate_with(&mut s),
        "fold-sub" => csgs.into_iter().reduce(|x, y| x - y).unwrap().evaluate_with(&mut s),
        "fold-right" => csgs.into_iter().rev().reduce(|x, y| y - x).unwrap().evaluate_with(&mut s),
        "fold-alt" => csgs
            .into_iter()
            .enumerate()
            .reduce(|(_, x), (i, y)| {
                (
                    i,
                    match i % 3 {
                        0 => x - y,
                        1 => x | y,
                        _ => x ^ y,
                    },
                )
            })
            .unwrap()
            .1
            .evaluate_with(&mut s),
        "fold-alt-right" => csgs
            .into_iter()
            .rev()
            .enumerate()
            .reduce(|(_, x), (i, y)| {
                (
                    i,
                    match i % 3 {
                        0 => y - x,
                        1 => y | x,
                        _ => y ^ x,
                    },
                )
            })
            .unwrap()
            .1
            .evaluate_with(&mut s),
        "incremental" => {
            let mut acc = Region::default();
            for c in &csgs {
                acc = acc.union(&c.evaluate_with(&mut s));
            }
            acc
        }
        _ => unreachable!(),
    };
    let dt = t.elapsed().as_secs_f64();
    if let Ok(limits) = std::env::var("LIMITS") {
        let mk = || -> Vec<Csg> { operands.iter().map(|(r, f)| Csg::from_rings(r, *f).unwrap()).collect() };
        for l in limits.split(',') {
            let c = match op.as_str() {
                "or" => Csg::union(mk()),
                "and" => Csg::intersection(mk()),
                _ => Csg::symmetric_difference(mk()),
            };
            let t = Instant::now();
            let r = c.try_evaluate_with(&mut s, l.parse::<usize>().unwrap());
            println!("   within {l}: {:?} in {:?}", r.map(|_| ()), t.elapsed());
        }
    }
    let v = if std::env::var("VALIDATE").is_ok() { format!("{:?}", r.validate()) } else { String::new() };
    println!(
        "{} n={} edges={} polycsg {:.3}s polygons {} rings {} vertices {} area {:.6e} {}",
        a[1],
        n,
        edges,
        dt,
        r.polygons().count(),
        r.rings().count(),
        r.rings().map(|x| x.len()).sum::<usize>(),
        r.area(),
        v
    );
}
