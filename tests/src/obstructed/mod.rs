//! Pairs of plates with something in between, each a function of its seed alone, and their form factors by ways that use
//! nothing of `formfactor`: [`Plates`] in closed form, [`Prisms`] by quadrature over two variables with closed forms inside.
mod families;
mod plates;
mod prisms;
mod profile;

pub use families::{FAMILIES, pair};
pub use plates::{Plate, Plates};
pub use prisms::{Prism, Prisms};

use glam::{DMat3, DVec2, DVec3};

/// A pair and how it lies in space.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Family and seed.
    pub name: String,
    /// The family.
    pub family: &'static str,
    /// What it is made of.
    pub setting: Setting,
    /// From the axes of the setting to those of space.
    pub pose: (DMat3, DVec3),
}

/// What a pair is made of.
#[derive(Clone, Debug)]
pub enum Setting {
    /// All parallel.
    Plates(Plates),
    /// Any outlines across.
    Prisms(Prisms),
}

impl Pair {
    /// Plates as they are.
    pub fn upright(name: String, plates: Plates) -> Pair {
        let pose = (DMat3::IDENTITY, DVec3::ZERO);
        Pair { name, family: "", setting: Setting::Plates(plates), pose }
    }

    /// The form factor from the first polygon to the second.
    pub fn form_factor(&self) -> f64 {
        match &self.setting {
            Setting::Plates(plates) => plates.form_factor(),
            Setting::Prisms(prisms) => prisms.form_factor(),
        }
    }

    /// What [`Pair::form_factor`] may be off by.
    pub fn uncertainty(&self) -> f64 {
        match self.setting {
            Setting::Plates(_) => 1e-13,
            Setting::Prisms(_) => 1e-11,
        }
    }

    /// Source, target, and what is in between, one loop each.
    pub fn polygons(&self) -> Vec<Vec<DVec3>> {
        let prisms = match &self.setting {
            Setting::Plates(plates) => &Prisms::from(plates),
            Setting::Prisms(prisms) => prisms,
        };
        let faces = [&prisms.source, &prisms.target].into_iter().chain(&prisms.blockers).flat_map(faces);
        let (turn, shift) = self.pose;
        faces.map(|face| face.into_iter().map(|p| turn * p + shift).collect()).collect()
    }
}

impl From<&Plates> for Prisms {
    fn from(plates: &Plates) -> Prisms {
        let flat = |plate: &Plate| Prism {
            outline: plate.x.map(|x| DVec2::new(x, plate.height)).to_vec(),
            y: plate.y,
        };
        let mut target = flat(&plates.target);
        target.outline.reverse();
        Prisms { source: flat(&plates.source), target, blockers: plates.blockers.iter().map(flat).collect() }
    }
}

/// The faces of a prism; of a plate one, seen from its front.
fn faces(prism: &Prism) -> Vec<Vec<DVec3>> {
    let at = |p: &DVec2, y: f64| DVec3::new(p.x, y, p.y);
    let [near, far] = prism.y;
    let around = prism.outline.iter().zip(prism.outline.iter().cycle().skip(1));
    let side = |(a, b): (&DVec2, &DVec2)| vec![at(a, near), at(b, near), at(b, far), at(a, far)];
    if prism.outline.len() == 2 {
        return around.take(1).map(side).collect();
    }
    let ends = prism.y.map(|y| prism.outline.iter().map(|p| at(p, y)).collect());
    around.map(side).chain(ends).collect()
}
