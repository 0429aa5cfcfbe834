//! Approximate methods by their names.
use crate::error::wrong;
use formfactor::approx::{
    Baum, Disk, Division, Exact, Hemicube, Method, MonteCarlo, Paraboloid, Pietrek, Rotation, Sampling,
    SinglePlane, VisibilityIndex, Wallace,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::cell::RefCell;

/// What finds rows, on any thread.
pub(crate) type Comparator = Box<dyn Method + Send + Sync>;

/// Parameters by name, each with what it is by default.
struct Parameters<'a, 'py> {
    given: &'a Bound<'py, PyDict>,
    known: RefCell<Vec<&'static str>>,
}

impl<'py> Parameters<'_, 'py> {
    fn get<T: for<'a> FromPyObject<'a, 'py>>(&self, name: &'static str, default: T) -> PyResult<T> {
        self.known.borrow_mut().push(name);
        match self.given.get_item(name)? {
            Some(value) => {
                value.extract().map_err(|_| wrong(format!("{name} is not what {value} can be read as")))
            }
            None => Ok(default),
        }
    }

    fn check(&self, method: &str) -> PyResult<()> {
        let known = self.known.borrow();
        for name in self.given.keys() {
            let name: String = name.extract()?;
            if !known.contains(&name.as_str()) {
                return Err(wrong(format!("{method} has no parameter {name}, but {}", known.join(", "))));
            }
        }
        Ok(())
    }

    /// Into n x n parts, or by size and depth if a size is given.
    fn division(&self) -> PyResult<Division> {
        let (parts, size, depth) =
            (self.get("parts", 8)?, self.get("size", None::<f64>)?, self.get("depth", 6)?);
        Ok(size.map_or(Division::Uniform(parts), |size| Division::Adaptive { size, depth }))
    }

    fn hemicube(&self) -> PyResult<Hemicube> {
        let hemicube = Hemicube::new(self.get("resolution", 128)?);
        let turn = self.get("random_turns", None::<u64>)?;
        Ok(turn.map_or(hemicube.clone(), |seed| hemicube.rotated(Rotation::Random(seed))))
    }
}

/// The method with a name.
pub(crate) fn comparator(name: &str, given: &Bound<'_, PyDict>) -> PyResult<Comparator> {
    let p = Parameters { given, known: RefCell::default() };
    let found: Comparator = match name {
        "exact" => Box::new(Exact),
        "disk" => Box::new(Disk),
        "wallace" => Box::new(Wallace { division: p.division()? }),
        "pietrek" => Box::new(Pietrek { division: p.division()?, near: p.get("near", 0.5)? }),
        "visibility_index" => Box::new(VisibilityIndex {
            near: p.get("near", 0.5)?,
            samples: p.get("samples", 4)?,
            depth: p.get("depth", 4)?,
        }),
        "hemicube" => Box::new(p.hemicube()?),
        "baum" => Box::new(Baum {
            hemicube: p.hemicube()?,
            near: p.get("near", 0.5)?,
            divisions: p.get("divisions", 4)?,
        }),
        "single_plane" => Box::new(SinglePlane {
            half_width: p.get("half_width", 10.0)?,
            smallest: p.get("smallest", 1e-5)?,
        }),
        "monte_carlo" => Box::new(MonteCarlo {
            rays: p.get("rays", 4096)?,
            sampling: match p.get("stratified", true)? {
                true => Sampling::Stratified,
                false => Sampling::Random,
            },
            seed: p.get("seed", 0)?,
        }),
        "paraboloid" => Box::new(Paraboloid::new(p.get("resolution", 128)?)),
        _ => return Err(wrong(format!("no method has the name {name:?}"))),
    };
    p.check(name)?;
    Ok(found)
}
