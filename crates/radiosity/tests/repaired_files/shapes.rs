//! Meshes of polygons, and nodes that they stand in.
use super::random::Random;
use radiosity::glam::{DMat4, DQuat, DVec3};

/// Outlines, counter-clockwise seen from the front, of a node's mesh.
pub(crate) type Outlines = Vec<Vec<DVec3>>;

/// A level rectangle that faces up.
pub(crate) fn level([x0, y0, x1, y1]: [f64; 4], z: f64) -> Vec<DVec3> {
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, z)).to_vec()
}

/// A box, turned out.
pub(crate) fn block(low: DVec3, high: DVec3) -> Outlines {
    let corner = |code: usize| {
        let pick = |axis: usize| if code >> axis & 1 == 1 { high[axis] } else { low[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.iter().map(|side| side.map(corner).to_vec()).collect()
}

/// Turned in any way, of a size from a millimetre to a kilometre, some sizes away from the origin.
pub(crate) fn pose(random: &mut Random) -> DMat4 {
    let turn = DQuat::from_scaled_axis(random.place(6.0));
    let size = 10_f64.powf(random.within(-3.0, 3.0));
    let way = random.place(8.0 * size);
    DMat4::from_scale_rotation_translation(DVec3::splat(size), turn, way)
}

/// A node with a mesh, in its own coordinates.
pub(crate) struct Node {
    pub(crate) pose: DMat4,
    pub(crate) mesh: Outlines,
}

/// Meshes somewhere, each in a node of its own, some of which are mirrored.
pub(crate) fn nodes(random: &mut Random, meshes: &[Outlines]) -> Vec<Node> {
    let all = pose(random);
    let mut node = |mesh: &Outlines| {
        let mirror = DVec3::new(if random.next() < 0.2 { -1.0 } else { 1.0 }, 1.0, 1.0);
        // About as large as the whole: what is a million times larger holds no such corners.
        let pose = all
            * DMat4::from_rotation_translation(DQuat::from_scaled_axis(random.place(6.0)), random.place(4.0))
            * DMat4::from_scale(mirror);
        let local = pose.inverse() * all;
        let turned = |outline: &Vec<DVec3>| {
            let points = outline.iter().map(|point| local.transform_point3(*point));
            if mirror.x < 0.0 { points.rev().collect() } else { points.collect::<Vec<DVec3>>() }
        };
        Node { pose, mesh: mesh.iter().map(turned).collect() }
    };
    meshes.iter().map(&mut node).collect()
}
