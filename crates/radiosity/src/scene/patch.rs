//! Patches.
use super::texture::Texture;
use crate::plane::slack;
use formfactor::PlanarPolygon;
use glam::DVec3;
use std::sync::Arc;

/// A planar surface that reflects diffusely and may emit, on its front side.
#[derive(Clone, Debug)]
pub struct Patch {
    /// A unique name: that of the file's node, with `.k` when the node holds several polygons, `.k.m` for pieces of a split one.
    pub name: String,
    /// The shape. The front, where the outline is counter-clockwise, sends and receives light; both sides block it.
    pub polygon: PlanarPolygon,
    /// Diffuse reflectance per band, 0 to below 1.
    pub reflectance: Vec<f64>,
    /// Emitted radiance L per band, W/m²/sr; the emitted radiosity is E = πL.
    pub emission: Vec<f64>,
    /// A picture on the patch: the reflectance of each point. `reflectance` is then its mean.
    pub texture: Option<Texture>,
    /// The name of its material in the file; empty where it has none.
    pub material: Arc<str>,
    /// The smoothing group: patches of one object with the same number are facets of one curved surface and share their light
    /// where they meet. `None` for a flat surface.
    pub smoothing: Option<usize>,
    /// Whether the patch only blocks light: it sends none and its own light is of no interest.
    pub only_blocks: bool,
    /// Whether it is the second side of a surface that the file calls double-sided; its first side is the patch before it.
    pub is_back: bool,
    /// How far from their places the file's numbers may leave its vertices: what lies so near each other is meant as one. 0 without a
    /// file; rounding of doubles counts in any case.
    pub rounding: f64,
    /// The place in the file.
    pub origin: Origin,
}

impl Patch {
    /// A patch without texture and without a file.
    ///
    /// ```
    /// use radiosity::{Patch, formfactor::PlanarPolygon};
    ///
    /// let square = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
    /// let lamp = Patch::new("lamp", square, vec![0.5], vec![10.0]); // one band; radiance 10, so 10 pi W/m² are emitted
    /// assert_eq!(lamp.polygon.normal().z, 1.0);
    /// # Ok::<(), radiosity::formfactor::Error>(())
    /// ```
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        polygon: PlanarPolygon,
        reflectance: Vec<f64>,
        emission: Vec<f64>,
    ) -> Patch {
        let name = name.into();
        let (texture, smoothing, only_blocks, is_back, origin) =
            (None, None, false, false, Origin::default());
        let material = Arc::from("");
        Patch {
            name,
            polygon,
            reflectance,
            emission,
            texture,
            material,
            smoothing,
            only_blocks,
            is_back,
            rounding: 0.0,
            origin,
        }
    }

    /// The reflectance per band of a triangle on the patch: the patch's own, or the mean of the texture over the triangle.
    #[must_use]
    pub fn reflectance_over(&self, corners: [DVec3; 3]) -> Vec<f64> {
        match &self.texture {
            None => self.reflectance.clone(),
            Some(texture) => {
                let mean = texture.mean(corners);
                (0..self.reflectance.len()).map(|band| mean[band.min(2)]).collect()
            }
        }
    }

    /// The mean reflectance per band of a convex polygon on the patch, and the standard deviation there.
    pub(crate) fn reflectance_within(&self, corners: &[DVec3]) -> [Vec<f64>; 2] {
        let Some(texture) = &self.texture else {
            return [self.reflectance.clone(), vec![0.0; self.reflectance.len()]];
        };
        let fan = corners.windows(2).skip(1).map(|ends| [corners[0], ends[0], ends[1]]);
        let areas: Vec<f64> = fan.clone().map(|[a, b, c]| (b - a).cross(c - a).length()).collect();
        let whole: f64 = areas.iter().sum();
        let mut sums = [[0.0; 3]; 2];
        for (triangle, area) in fan.zip(areas) {
            let moments = texture.moments(triangle);
            let all = sums.iter_mut().flatten().zip(moments.iter().flatten());
            all.for_each(|(sum, moment)| *sum += moment * area / whole);
        }
        let [mean, square] = sums;
        let deviation = |band: usize| (square[band] - mean[band] * mean[band]).max(0.0).sqrt();
        let bands = || (0..self.reflectance.len()).map(|band| band.min(2));
        [bands().map(|band| mean[band]).collect(), bands().map(deviation).collect()]
    }

    /// How far off still counts as on: its vertices' rounding in the file and in doubles.
    pub(crate) fn slack(&self) -> f64 {
        let points: Vec<DVec3> = self.polygon.loops().flatten().copied().collect();
        slack(&points).max(self.rounding)
    }

    /// Whether the patch emits light in some band.
    #[must_use]
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&radiance| radiance > 0.0)
    }
}

/// The place of a patch in its file, so that a writer can put the result back there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Which geometry instance, counted in the order in which the reader met them.
    pub instance: usize,
    /// Which primitive element (`polylist`, `triangles`, …) of that geometry.
    pub primitive: usize,
    /// Which polygon of that primitive.
    pub polygon: usize,
}

impl Origin {
    /// Of a patch that is no geometry of its file, such as a lamp's.
    pub(crate) const NOWHERE: Origin = Origin { instance: usize::MAX, primitive: 0, polygon: 0 };
}
