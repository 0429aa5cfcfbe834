//! What a key is: a configuration, its exact value, and what others say of it.
use crate::contours::Loops;
use formfactor::DVec3;

/// A row of the page.
pub(crate) struct Key {
    pub(crate) name: String,
    /// How the exact value comes about.
    pub(crate) derivation: &'static str,
    pub(crate) setup: Setup,
    /// The form factor, and what it may be off by.
    pub(crate) exact: f64,
    pub(crate) slack: f64,
    /// What the page's numbers are multiplied by, and its name.
    pub(crate) unit: (f64, &'static str),
    pub(crate) published: Option<Published>,
}

pub(crate) enum Setup {
    /// From a point along a normal to the first polygon past all others.
    Point { position: DVec3, normal: DVec3, polygons: Vec<Loops> },
    /// From the first polygon to the second past all others.
    Area { polygons: Vec<Loops>, tolerance: f64 },
}

/// A value of somebody else, in the page's unit.
pub(crate) struct Published {
    pub(crate) text: &'static str,
    pub(crate) source: &'static str,
    pub(crate) is_right: bool,
}

/// What a sum of a few dozen terms of the size of 1 may be off by.
const ROUNDING: f64 = 1e-13;

impl Key {
    pub(crate) fn point(
        name: impl Into<String>,
        derivation: &'static str,
        [position, normal]: [[f64; 3]; 2],
        polygons: Vec<Loops>,
        exact: f64,
    ) -> Key {
        let [position, normal] = [position, normal].map(DVec3::from);
        Key::new(name, derivation, Setup::Point { position, normal, polygons }, exact)
    }

    pub(crate) fn area(
        name: impl Into<String>,
        derivation: &'static str,
        polygons: Vec<Loops>,
        exact: f64,
    ) -> Key {
        Key::new(name, derivation, Setup::Area { polygons, tolerance: 1e-10 }, exact)
    }

    fn new(name: impl Into<String>, derivation: &'static str, setup: Setup, exact: f64) -> Key {
        let (name, unit) = (name.into(), (1.0, ""));
        Key { name, derivation, setup, exact, slack: ROUNDING, unit, published: None }
    }

    /// Right to the last digit, or one off.
    pub(crate) fn published(self, text: &'static str, source: &'static str) -> Key {
        Key { published: Some(Published { text, source, is_right: true }), ..self }
    }

    /// Wrong.
    pub(crate) fn wrong(self, text: &'static str, source: &'static str) -> Key {
        Key { published: Some(Published { text, source, is_right: false }), ..self }
    }

    pub(crate) fn unit(self, factor: f64, name: &'static str) -> Key {
        Key { unit: (factor, name), ..self }
    }

    pub(crate) fn within(self, slack: f64) -> Key {
        Key { slack, ..self }
    }

    pub(crate) fn tolerance(mut self, asked: f64) -> Key {
        if let Setup::Area { tolerance, .. } = &mut self.setup {
            *tolerance = asked;
        }
        self
    }
}

/// A polygon of one loop.
pub(crate) fn ring(points: &[[f64; 3]]) -> Loops {
    vec![points.iter().map(|p| DVec3::from(*p)).collect()]
}

/// A rectangle at a height, its front up.
pub(crate) fn up([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> Loops {
    ring(&[[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]])
}

/// A rectangle at a height, its front down.
pub(crate) fn down(x: [f64; 2], y: [f64; 2], z: f64) -> Loops {
    turned(up(x, y, z))
}

/// A wall at an x, its front towards smaller x.
pub(crate) fn wall(x: f64, [y0, y1]: [f64; 2], [z0, z1]: [f64; 2]) -> Loops {
    ring(&[[x, y0, z0], [x, y0, z1], [x, y1, z1], [x, y1, z0]])
}

/// The other side.
pub(crate) fn turned(mut loops: Loops) -> Loops {
    loops.iter_mut().for_each(|l| l.reverse());
    loops
}
