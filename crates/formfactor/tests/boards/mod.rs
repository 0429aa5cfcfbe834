//! Boards between a floor and a lamp above it, as they come and turned.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::DQuat;
use formfactor::{DVec3, PlanarPolygon};
use proptest::prelude::*;

/// A triangle, a quadrangle or a frame anywhere between the floor and the lamp: its middle, two half axes, and which of the three it is.
pub(crate) type Board = ([f64; 3], [[f64; 3]; 2], usize);

pub(crate) fn board() -> impl Strategy<Value = Board> {
    let free = prop::array::uniform3(-1.0..1.0);
    let even = prop::array::uniform3((-2i32..=2).prop_map(|half| f64::from(half) / 2.0));
    let axis = prop_oneof![free, even];
    (prop::array::uniform3(-1.5..1.5), prop::array::uniform2(axis), 0usize..3)
}

pub(crate) fn polygon(pose: &Pose, (middle, axes, kind): &Board) -> Option<PlanarPolygon> {
    let [u, v] = axes.map(DVec3::from);
    let middle = DVec3::from(*middle) + DVec3::Z * 2.0;
    let ring = |size: f64| {
        let [u, v] = [u * size, v * size];
        [middle - u - v, middle + u - v, middle + u + v, middle - u + v].map(|corner| pose.place(corner))
    };
    let loops = match kind {
        0 => vec![ring(1.0)[..3].to_vec()],
        1 => vec![ring(1.0).to_vec()],
        _ => vec![ring(1.0).to_vec(), ring(-0.5).iter().rev().copied().collect()],
    };
    PlanarPolygon::new(loops).ok()
}

/// How all is turned and enlarged: what lies in a plane does so but for roundings.
#[derive(Debug)]
pub(crate) struct Pose {
    pub(crate) turn: DQuat,
    size: f64,
}

pub(crate) fn pose() -> impl Strategy<Value = Pose> {
    let turn = prop_oneof![Just([0.0; 3]), prop::array::uniform3(-3.0..3.0)];
    let size = prop_oneof![Just(1.0), Just(1e-6), Just(39.37), Just(1e5)];
    (turn, size).prop_map(|(turn, size)| Pose { turn: DQuat::from_scaled_axis(turn.into()), size })
}

impl Pose {
    pub(crate) fn place(&self, point: DVec3) -> DVec3 {
        self.turn * point * self.size
    }
}

/// A rectangle of the lamp, which faces down, between two corners.
pub(crate) fn part(pose: &Pose, [low, high]: [[f64; 2]; 2]) -> PlanarPolygon {
    let corners = [[low[0], low[1]], [low[0], high[1]], [high[0], high[1]], [high[0], low[1]]];
    on_lamp(pose, corners.to_vec())
}

/// That without a quarter: it is not convex.
pub(crate) fn corner(pose: &Pose, [low, high]: [[f64; 2]; 2]) -> PlanarPolygon {
    let [x, y] = [0, 1].map(|axis| low[axis].midpoint(high[axis]));
    let [[left, near], [right, far]] = [low, high];
    on_lamp(pose, vec![[left, near], [left, far], [x, far], [x, y], [right, y], [right, near]])
}

fn on_lamp(pose: &Pose, corners: Vec<[f64; 2]>) -> PlanarPolygon {
    let corners: Vec<DVec3> = corners.into_iter().map(|[x, y]| pose.place(DVec3::new(x, y, 4.0))).collect();
    PlanarPolygon::new([corners]).unwrap()
}
