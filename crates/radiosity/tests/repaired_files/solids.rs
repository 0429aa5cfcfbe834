//! Closed solids that pass through each other, touch, hold each other, or are one.
use super::random::Random;
use super::shapes::{Outlines, block};
use radiosity::glam::DVec3;
use std::f64::consts::TAU;

/// Two or three solids, each by itself or all in one mesh.
pub(crate) fn solids(random: &mut Random) -> Vec<Outlines> {
    let count = if random.next() < 0.5 { 2 } else { 3 };
    let mut solids: Vec<Outlines> = (0..count).map(|_| solid(random)).collect();
    for solid in &mut solids {
        if random.next() < 0.25 {
            solid.iter_mut().for_each(|outline| outline.reverse());
        }
    }
    // Turned the same way: with its double inside out it is closed only when that is gone.
    if random.next() < 0.2 {
        solids[1] = solids[0].clone();
    }
    if random.next() < 0.25 { vec![solids.concat()] } else { solids }
}

/// On the ground, or with corners on a grid, so that many faces of two are in one plane.
fn solid(random: &mut Random) -> Outlines {
    let kind = random.next();
    if kind < 0.4 {
        let [low, high] =
            [[0.0; 3], [1.0; 3]].map(|least| least.map(|least| least + (3.0 * random.next()).floor()));
        return block(DVec3::from(low), DVec3::from(high).max(DVec3::from(low) + 1.0));
    }
    let middle = DVec3::new(3.0 * random.next(), 3.0 * random.next(), 0.0);
    let corners = [3_u32, 4, 5, 6].into_iter().find(|_| random.next() < 0.4).unwrap_or(3);
    let (turn, size) = (TAU * random.next(), 0.3 + 1.5 * random.next());
    let corner = |k| {
        let angle = turn + TAU * f64::from(k) / f64::from(corners);
        middle + size * DVec3::new(angle.cos(), angle.sin(), 0.0)
    };
    let foot: Vec<DVec3> = (0..corners).map(corner).collect();
    if kind < 0.7 {
        prism(&foot, (1.0 + 2.0 * random.next()).floor())
    } else {
        pyramid(&foot, middle + (0.5 + random.next()) * DVec3::Z)
    }
}

/// From a foot on the ground, counter-clockwise seen from above.
fn prism(foot: &[DVec3], height: f64) -> Outlines {
    let up = height * DVec3::Z;
    let mut faces: Outlines = edges(foot).map(|[a, b]| vec![a, b, b + up, a + up]).collect();
    faces.push(foot.iter().rev().copied().collect());
    faces.push(foot.iter().map(|corner| *corner + up).collect());
    faces
}

fn pyramid(foot: &[DVec3], top: DVec3) -> Outlines {
    let mut faces: Outlines = edges(foot).map(|[a, b]| vec![a, b, top]).collect();
    faces.push(foot.iter().rev().copied().collect());
    faces
}

fn edges(ring: &[DVec3]) -> impl Iterator<Item = [DVec3; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
}
