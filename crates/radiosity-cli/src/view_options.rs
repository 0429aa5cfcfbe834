//! View options: exposure, width, camera.
use crate::failure::Failure;
use crate::parse::positive;
use clap::Args;
use radiosity::expose::Exposure;
use radiosity::glam::DVec3;
use radiosity::picture::framing;
use radiosity::{Camera, Record, Scene};

/// The options of every command that writes pictures.
#[derive(Args, Clone, Debug)]
pub(crate) struct ViewOptions {
    /// The exposure K: intensity is 1 - exp(-K B) [default: chosen from what the camera sees]
    #[arg(short = 'k', visible_short_alias = 'K', long, value_name = "K", value_parser = positive)]
    pub(crate) exposure: Option<f64>,
    /// The width of a picture in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 800, value_parser = clap::value_parser!(u32).range(1..=16384))]
    pub(crate) width: u32,
    /// The camera of a picture: the name of a camera of the scene, or X,Y,Z,TX,TY,TZ[,DEGREES]: the eye, the target and the
    /// vertical field of view [default: the scene's first camera, or one that sees everything]
    #[arg(long, value_name = "CAMERA", allow_hyphen_values = true)]
    pub(crate) camera: Option<String>,
}

impl ViewOptions {
    /// As asked, or chosen from what the camera sees.
    pub(crate) fn exposure(&self, record: &Record, camera: &Camera) -> Exposure {
        self.exposure.and_then(Exposure::new).unwrap_or_else(|| record.exposure_for(camera))
    }

    /// As asked; where there is no such camera, what there is instead.
    pub(crate) fn camera(&self, record: &Record) -> Result<Camera, Failure> {
        let framed = || record.camera(None).expect("a record frames what it holds");
        self.camera_among(&record.cameras, record.asset.up, framed)
    }

    /// As [`camera`](Self::camera), before a scene is solved.
    pub(crate) fn camera_of(&self, scene: &Scene) -> Result<Camera, Failure> {
        let up = scene.asset.up;
        self.camera_among(&scene.cameras, up, || framing(scene.extent(), up))
    }

    fn camera_among(
        &self,
        cameras: &[Camera],
        up: DVec3,
        framed: impl FnOnce() -> Camera,
    ) -> Result<Camera, Failure> {
        let Some(asked) = self.camera.as_deref() else {
            return Ok(cameras.first().cloned().unwrap_or_else(framed));
        };
        if let Some(view) = numbers(asked) {
            return given(&view, up);
        }
        cameras.iter().find(|camera| camera.name == asked).cloned().ok_or_else(|| {
            let names: Vec<&str> = cameras.iter().map(|camera| camera.name.as_str()).collect();
            let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            Failure::usage(format!(
                "no camera is named {asked}; the scene has {known}; or give X,Y,Z,TX,TY,TZ"
            ))
        })
    }
}

/// Finite numbers with commas between them.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let numbers: Vec<f64> = text.split(',').map(|word| word.trim().parse().ok()).collect::<Option<_>>()?;
    numbers.iter().all(|number| number.is_finite()).then_some(numbers)
}

/// Eye, target and field of view, upright.
fn given(view: &[f64], up: DVec3) -> Result<Camera, Failure> {
    let (&[x, y, z, tx, ty, tz] | &[x, y, z, tx, ty, tz, _]) = view else {
        let count = view.len();
        return Err(Failure::usage(format!("--camera: {count} numbers where 6 or 7 are needed")));
    };
    let degrees = view.get(6).copied().unwrap_or(40.0);
    let (position, direction) = (DVec3::new(x, y, z), DVec3::new(tx - x, ty - y, tz - z));
    if direction.cross(up).try_normalize().is_none() {
        let message =
            "--camera: the view has no direction, or points straight up or down; move the eye or the target";
        return Err(Failure::usage(message));
    }
    if !(degrees > 0.0 && degrees < 180.0) {
        return Err(Failure::usage(format!(
            "--camera: the field of view {degrees} is not between 0 and 180 degrees"
        )));
    }
    let (name, vertical_fov) = ("given".to_owned(), degrees.to_radians());
    Ok(Camera { name, position, direction, up, vertical_fov, aspect: 4.0 / 3.0 })
}
