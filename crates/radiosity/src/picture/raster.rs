//! Triangles to samples, without clipping: a sample's ray meets a triangle where three planes through the eye say so.
//!
//! With the corners v0, v1, v2 as seen from the eye, the ray of direction d lies inside when d·(v2×v1), d·(v0×v2) and
//! d·(v1×v0) are all at least 0; these are also its perspective-correct barycentric weights, and their sum, over the
//! volume −v0·(v1×v2), is 1 / depth (Olano and Greer 1997). Corners behind the eye need no care. Neighbours share the
//! plane through their edge to the last bit, so that no ray passes between them.
use super::painting::Painting;
use crate::scene::{camera::Camera, texture::Image};
use glam::{DVec2, DVec3};
use std::ops::Range;

/// Samples per pixel.
pub(super) const SAMPLES: usize = SIDE * SIDE;
const SIDE: usize = 4;

/// A camera's rays: through the picture's point (x, y), in pixels from the top left, runs `corner + x·right + y·down`.
pub(super) struct Eye {
    position: DVec3,
    forward: DVec3,
    corner: DVec3,
    right: DVec3,
    down: DVec3,
    width: usize,
    height: usize,
}

/// A triangle that faces the eye.
pub(super) struct Triangle<'p> {
    /// For each corner the plane through the eye and the opposite edge: its value at pixel (0, 0), per pixel to the right,
    /// per pixel down.
    planes: [[f64; 3]; 3],
    volume: f64,
    colours: [[f64; 3]; 3],
    /// The picture that the colours fall on, and where in it the corners lie.
    cloth: Option<(&'p Image, [DVec2; 3])>,
    columns: Range<usize>,
    rows: Range<usize>,
}

impl Eye {
    pub(super) fn new(camera: &Camera, width: usize, height: usize) -> Self {
        let forward = camera.direction.normalize();
        let right = forward.cross(camera.up).normalize();
        let down = forward.cross(right);
        let half_height = (camera.vertical_fov / 2.0).tan();
        let half_width = half_height * camera.aspect;
        let corner = forward - half_width * right - half_height * down;
        let right = right * (2.0 * half_width / width as f64);
        let down = down * (2.0 * half_height / height as f64);
        Self { position: camera.position, forward, corner, right, down, width, height }
    }

    /// The triangles that face the eye and may be in the picture.
    pub(super) fn triangles<'p>(&self, painting: &Painting<'p>) -> Vec<Triangle<'p>> {
        let seen = painting.mesh.elements.iter().filter_map(|element| {
            let corners = element.corners.map(|corner| painting.mesh.vertices[corner] - self.position);
            let colours = element.corners.map(|corner| painting.light[corner]);
            let image = painting.images.get(element.patch).copied().flatten();
            let cloth = image.map(|image| (image, element.corners.map(|corner| painting.places[corner])));
            self.triangle(corners, colours, cloth)
        });
        seen.collect()
    }

    fn triangle<'p>(
        &self,
        corners: [DVec3; 3],
        colours: [[f64; 3]; 3],
        cloth: Option<(&'p Image, [DVec2; 3])>,
    ) -> Option<Triangle<'p>> {
        let [a, b, c] = corners;
        let normals = [c.cross(b), a.cross(c), b.cross(a)];
        let volume = a.dot(normals[0]);
        let (columns, rows) = self.extent(corners)?;
        let plane = |normal: DVec3| [self.corner, self.right, self.down].map(|axis| axis.dot(normal));
        let planes = normals.map(plane);
        (volume > 0.0).then_some(Triangle { planes, volume, colours, cloth, columns, rows })
    }

    /// The pixels that the corners span; all when a corner is not in front of the eye, none when no corner is.
    fn extent(&self, corners: [DVec3; 3]) -> Option<(Range<usize>, Range<usize>)> {
        let depths = corners.map(|corner| corner.dot(self.forward));
        if depths.iter().all(|depth| *depth <= 0.0) {
            return None;
        }
        if depths.iter().any(|depth| *depth <= 0.0) {
            return Some((0..self.width, 0..self.height));
        }
        let along = |axis: DVec3| {
            let places = corners.map(|corner| corner / corner.dot(self.forward) - self.corner);
            places.map(|place| place.dot(axis) / axis.length_squared())
        };
        let (columns, rows) = (span(along(self.right), self.width), span(along(self.down), self.height));
        (!columns.is_empty() && !rows.is_empty()).then_some((columns, rows))
    }
}

/// The pixels around three places, within the picture; one more on each side makes up for rounding.
fn span(places: [f64; 3], len: usize) -> Range<usize> {
    let low = places.into_iter().fold(f64::INFINITY, f64::min) - 1.0;
    let high = places.into_iter().fold(f64::NEG_INFINITY, f64::max) + 2.0;
    let kept = |place: f64| {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and len")]
        let kept = place.clamp(0.0, len as f64) as usize;
        kept
    };
    kept(low)..kept(high)
}

/// The nearest triangle's radiosity at every sample of some rows: [`SAMPLES`] for each pixel, row after row.
pub(super) fn raster(triangles: &[Triangle<'_>], rows: Range<usize>, width: usize) -> Vec<[f64; 3]> {
    let count = rows.len() * width * SAMPLES;
    let mut samples = Samples { colours: vec![[0.0; 3]; count], nearness: vec![0.0; count] };
    for triangle in triangles {
        for row in triangle.rows.start.max(rows.start)..triangle.rows.end.min(rows.end) {
            for column in triangle.columns_of(row) {
                let first = ((row - rows.start) * width + column) * SAMPLES;
                samples.cover(triangle, first, column, row);
            }
        }
    }
    samples.colours
}

/// What is seen, and 1 / depth of it: 0 where nothing is.
struct Samples {
    colours: Vec<[f64; 3]>,
    nearness: Vec<f64>,
}

impl Samples {
    /// Draws a triangle into one pixel, whose samples start at `first`.
    fn cover(&mut self, triangle: &Triangle<'_>, first: usize, column: usize, row: usize) {
        for sample in 0..SAMPLES {
            let (x, y) = place(sample);
            let (x, y) = (column as f64 + x, row as f64 + y);
            let weights = triangle.planes.map(|[start, right, down]| start + x * right + y * down);
            if weights.iter().any(|weight| *weight < 0.0) {
                continue;
            }
            let sum: f64 = weights.iter().sum();
            let nearness = sum / triangle.volume;
            if nearness > self.nearness[first + sample] {
                self.nearness[first + sample] = nearness;
                self.colours[first + sample] = triangle.colour(weights.map(|weight| weight / sum));
            }
        }
    }
}

/// Where a sample lies within its pixel: a grid sheared both ways, so that no two share a row or a column.
fn place(sample: usize) -> (f64, f64) {
    let (i, j) = ((sample % SIDE) as f64, (sample / SIDE) as f64);
    let side = SIDE as f64;
    ((i + (j + 0.5) / side) / side, (j + (i + 0.5) / side) / side)
}

/// A plane's value at a sample errs by less than this share of what it is the sum of.
const ROUNDING: f64 = 1e-12;

impl Triangle<'_> {
    /// The pixels of a row that may have a sample inside: a triangle that reaches behind the eye spans all columns, and a long one many
    /// in which it is not.
    fn columns_of(&self, row: usize) -> Range<usize> {
        let [mut low, mut high] = [self.columns.start as f64, self.columns.end as f64];
        for [start, right, down] in self.planes {
            let [top, bottom] = [row, row + 1].map(|y| y as f64 * down);
            let size = start.abs() + right.abs() * self.columns.end as f64 + top.abs().max(bottom.abs());
            // All samples inside lie where this, and x to the right, are at least 0. A pixel more on each side makes up for rounding.
            let most = start + top.max(bottom) + ROUNDING * size;
            let edge = -most / right;
            // Neither for a plane along the row, whose zero may have either sign.
            if right > 0.0 {
                low = low.max(edge - 2.0);
            } else if right < 0.0 {
                high = high.min(edge + 2.0);
            }
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two columns")]
        let [low, high] = [low.floor() as usize, high.max(0.0).ceil() as usize];
        low..high
    }

    /// The colour at barycentric weights: interpolated, and multiplied with the picture where there is one.
    fn colour(&self, weights: [f64; 3]) -> [f64; 3] {
        let mixed = |band: usize| (0..3).map(|corner| weights[corner] * self.colours[corner][band]).sum();
        let light: [f64; 3] = std::array::from_fn(mixed);
        match self.cloth {
            None => light,
            Some((image, places)) => {
                let place: DVec2 = (0..3).map(|corner| weights[corner] * places[corner]).sum();
                let texel = image.texel(place);
                std::array::from_fn(|band| light[band] * texel[band])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::element::{Element, Mesh};

    /// Triangles all around the eye, most of which reach behind it, each of another colour.
    fn around_the_eye() -> (Mesh, Vec<[f64; 3]>) {
        let way = |k: usize| DVec2::from_angle(2.4 * k as f64);
        let place = |k: usize| way(k).extend(0.3 * (k % 7) as f64 - 1.0) * (1.0 + (k % 5) as f64);
        let vertices: Vec<DVec3> = (0..90).map(place).collect();
        let triangle = |k: usize| [3 * k, 3 * k + 1, 3 * k + 2];
        let both = (0..30).flat_map(|k| [triangle(k), [3 * k, 3 * k + 2, 3 * k + 1]]);
        let elements = both.map(|corners| Element { patch: 0, corners }).collect();
        let light = (0..90).map(|k| [1.0 + (k / 3) as f64, 1.0, 1.0]).collect();
        (Mesh { vertices, elements }, light)
    }

    /// Squares that face the eye, in two triangles each: their edges run along rows and columns of pixels.
    fn before_the_eye() -> (Mesh, Vec<[f64; 3]>) {
        let corner = |k: usize| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][k % 4].map(|x: f64| x * 1.3);
        let place = |k: usize| {
            let [y, z] = corner(k);
            DVec3::new(3.0, y - 2.0 + (k / 4) as f64, z - 2.0 + (k / 8) as f64)
        };
        let square = |k: usize| [[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]];
        let both = (0..4).flat_map(square).flat_map(|[a, b, c]| [[a, b, c], [a, c, b]]);
        let elements = both.map(|corners| Element { patch: 0, corners }).collect();
        let mesh = Mesh { vertices: (0..16).map(place).collect(), elements };
        (mesh, (0..16).map(|k| [1.0 + k as f64, 1.0, 1.0]).collect())
    }

    #[test]
    fn no_sample_is_lost_where_triangles_reach_behind_the_eye() {
        let (mesh, light) = around_the_eye();
        let wide = assert_all_is_drawn(&mesh, &light, DVec3::new(0.1, -0.2, 0.05));
        assert!(wide > 5, "only {wide}");
    }

    #[test]
    fn no_sample_is_lost_where_edges_run_along_rows() {
        let (mesh, light) = before_the_eye();
        assert_all_is_drawn(&mesh, &light, DVec3::ZERO);
    }

    /// That pictures have every sample that a triangle covers; how many triangles span all columns.
    fn assert_all_is_drawn(mesh: &Mesh, light: &[[f64; 3]], position: DVec3) -> usize {
        let camera = Camera {
            name: String::new(),
            position,
            direction: DVec3::X,
            up: DVec3::Z,
            vertical_fov: 1.5,
            aspect: 1.5,
        };
        let painting = Painting { mesh, light, places: &[], images: &[] };
        let triangles = Eye::new(&camera, 60, 40).triangles(&painting);
        let mut all =
            Samples { colours: vec![[0.0; 3]; 2400 * SAMPLES], nearness: vec![0.0; 2400 * SAMPLES] };
        for (triangle, pixel) in triangles.iter().flat_map(|t| (0..2400).map(move |pixel| (t, pixel))) {
            all.cover(triangle, pixel * SAMPLES, pixel % 60, pixel / 60);
        }
        assert!(all.nearness.iter().any(|nearness| *nearness > 0.0));
        assert_eq!(raster(&triangles, 0..40, 60), all.colours);
        triangles.iter().filter(|triangle| triangle.columns == (0..60)).count()
    }
}
