//! Pictures on patches: reflectance that varies from point to point.
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The finest lattice of samples along a side of a triangle.
const MAX_SAMPLES: usize = 64;

/// A picture: its file, so that it can be written again, and its colours as reflectances.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The name in the scene's file.
    pub name: String,
    /// The bytes of the picture's file.
    pub bytes: Vec<u8>,
    /// `image/png` or `image/jpeg`.
    pub mime: &'static str,
    /// Width in texels.
    pub width: usize,
    /// Linear red, green and blue, row by row from the top.
    pub texels: Vec<[f64; 3]>,
}

/// An image laid over a patch.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The picture, shared by all patches that show it.
    pub image: Arc<Image>,
    /// What its colours are multiplied by.
    pub factor: [f64; 3],
    /// Triangles in space with texture coordinates at their corners: u to the right, v down, both 0 to 1 over the picture,
    /// which repeats beyond. A point outside of all triangles belongs to the nearest one.
    pub map: Vec<[(DVec3, DVec2); 3]>,
}

impl Image {
    /// The texel that holds a point; the picture repeats.
    pub(crate) fn texel(&self, place: DVec2) -> [f64; 3] {
        let height = self.texels.len() / self.width;
        let row = index(place.y, height);
        self.texels[row * self.width + index(place.x, self.width)]
    }
}

/// Which of `count` equal parts of the unit interval, repeated, holds a number.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the parts")]
fn index(place: f64, count: usize) -> usize {
    let part = ((place - place.floor()) * count as f64) as usize;
    part.min(count - 1)
}

impl Texture {
    /// The texture coordinates at a point of the patch.
    #[must_use]
    pub fn place(&self, point: DVec3) -> DVec2 {
        let weights = self.map.iter().map(|corners| (weights(corners, point), corners));
        let inside = |weights: &[f64; 3]| weights.iter().copied().fold(f64::INFINITY, f64::min);
        let best = weights.reduce(|a, b| if inside(&b.0) > inside(&a.0) { b } else { a });
        best.map_or(DVec2::ZERO, |(weights, corners)| {
            (0..3).map(|corner| weights[corner] * corners[corner].1).sum()
        })
    }

    /// The mean colour over a triangle of the patch.
    pub(super) fn mean(&self, corners: [DVec3; 3]) -> [f64; 3] {
        self.moments(corners)[0]
    }

    /// The means of the colour and of its square over a triangle of the patch: samples at the middles of the cells of a lattice as fine as
    /// the texels.
    pub(super) fn moments(&self, corners: [DVec3; 3]) -> [[f64; 3]; 2] {
        let places = corners.map(|corner| self.place(corner));
        let cells = self.cells(places);
        let [a, b, c] = corners;
        let mut sums = [[0.0; 3]; 2];
        let mut add = |colour: [f64; 3]| {
            for (band, share) in colour.into_iter().enumerate() {
                sums[0][band] += share;
                sums[1][band] += share * share;
            }
        };
        for i in 0..cells {
            for j in 0..cells - i {
                let at = |shift: f64| {
                    let (s, t) = ((i as f64 + shift) / cells as f64, (j as f64 + shift) / cells as f64);
                    self.image.texel(self.place(a + (b - a) * s + (c - a) * t))
                };
                add(at(1.0 / 3.0));
                if i + j + 1 < cells {
                    add(at(2.0 / 3.0));
                }
            }
        }
        let samples = (cells * cells) as f64;
        let factors = [self.factor, self.factor.map(|factor| factor * factor)];
        std::array::from_fn(|power| {
            std::array::from_fn(|band| factors[power][band] * sums[power][band] / samples)
        })
    }

    /// The mean over all that it covers.
    pub(crate) fn overall(&self) -> [f64; 3] {
        let (mut sum, mut weight) = ([0.0; 3], 0.0);
        for corners in self.map.iter().map(|corners| corners.map(|(point, _)| point)) {
            let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
            let mean = self.mean(corners);
            sum = std::array::from_fn(|band| sum[band] + area * mean[band]);
            weight += area;
        }
        if weight > 0.0 { sum.map(|band| band / weight) } else { self.factor }
    }

    /// how many cells along a side give each texel some samples of its own.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    fn cells(&self, [a, b, c]: [DVec2; 3]) -> usize {
        let height = self.image.texels.len() / self.image.width;
        let size = DVec2::new(self.image.width as f64, height as f64);
        let longest =
            [b - a, c - b, a - c].map(|side| (side * size).length()).into_iter().fold(0.0, f64::max);
        (4.0 * longest).ceil().clamp(8.0, MAX_SAMPLES as f64) as usize
    }
}

/// Barycentric weights of the point of the triangle's plane below `point`.
fn weights(corners: &[(DVec3, DVec2); 3], point: DVec3) -> [f64; 3] {
    let [a, b, c] = corners.map(|(corner, _)| corner);
    let normal = (b - a).cross(c - a);
    let part = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) / normal.length_squared();
    [part(b, c), part(c, a), part(a, b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two texels beside each other on a unit square.
    fn halves() -> Texture {
        let texels = vec![[0.0; 3], [1.0; 3]];
        let image = Image { name: "halves".into(), bytes: Vec::new(), mime: "image/png", width: 2, texels };
        let corner = |x: f64, y: f64| (DVec3::new(x, y, 0.0), DVec2::new(x, 1.0 - y));
        let map = vec![
            [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0)],
            [corner(0.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
        ];
        Texture { image: Arc::new(image), factor: [1.0, 0.5, 0.25], map }
    }

    #[test]
    fn a_triangle_within_a_texel_has_its_colour() {
        let corners = [[0.6, 0.1, 0.0], [0.9, 0.1, 0.0], [0.9, 0.8, 0.0]].map(DVec3::from);
        assert_eq!(halves().moments(corners), [[1.0, 0.5, 0.25], [1.0, 0.25, 0.0625]]);
    }

    #[test]
    fn a_square_has_the_mean_of_its_triangles() {
        let [a, b, c, d] =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]].map(DVec3::from);
        let texture = halves();
        let (lower, upper) = (texture.mean([a, b, c])[0], texture.mean([a, c, d])[0]);
        assert!((lower - 0.75).abs() < 0.05 && (upper - 0.25).abs() < 0.05, "{lower} {upper}");
        assert!((lower + upper - 1.0).abs() < 1e-12);
    }

    #[test]
    fn coordinates_go_on_beyond_the_triangles() {
        assert!(halves().place(DVec3::new(2.0, 0.0, 0.0)).distance(DVec2::new(2.0, 1.0)) < 1e-12);
    }
}
