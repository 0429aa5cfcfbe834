//! MTL: what the materials of an OBJ file reflect and emit.
use super::statements::Statement;
use crate::image_file;
use crate::io::error::{Fault, Wrong};
use crate::io::surface::finish::Finish;
use crate::scene::{finding::Finding, texture::Image};
use glam::DVec2;
use std::{collections::HashMap, path::Path, sync::Arc};

/// The reflectance of a surface that says nothing.
const DEFAULT_REFLECTANCE: f64 = 0.5;

/// A material as patches need it.
#[derive(Clone, Debug)]
pub(super) struct Mtl {
    pub(super) finish: Finish,
    /// What a place in the picture is multiplied by, and what is added then.
    pub(super) scale: DVec2,
    pub(super) offset: DVec2,
}

impl Default for Mtl {
    fn default() -> Mtl {
        let reflectance = [DEFAULT_REFLECTANCE; 3];
        let (material, emission) = ("".into(), [0.0; 3]);
        let finish = Finish { material, reflectance, emission, image: None, spectra: None };
        Mtl { finish, scale: DVec2::ONE, offset: DVec2::ZERO }
    }
}

/// The materials of one MTL file, by name; `file` names it in messages, pictures are in its `folder`.
pub(super) fn materials(
    file: &str,
    text: &str,
    folder: Option<&Path>,
    warnings: &mut Vec<Finding>,
) -> Result<HashMap<String, Mtl>, Wrong> {
    let (mut all, mut name) = (HashMap::new(), None);
    let mut pictures = HashMap::new();
    for statement in Statement::all(text) {
        if statement.keyword == "newmtl" {
            let mut material = Mtl::default();
            material.finish.material = statement.name().into();
            all.insert(statement.name(), material);
            name = Some(statement.name());
            continue;
        }
        let place = format!("{file}:{}", statement.line);
        let Some(material) = name.as_ref().and_then(|name| all.get_mut(name)) else { continue };
        match statement.keyword {
            "Kd" => material.finish.reflectance = colour(&statement)?,
            "Ke" => material.finish.emission = colour(&statement)?,
            "map_Kd" => {
                let (scale, offset, picture) = map(&statement)?;
                (material.scale, material.offset) = (scale, offset);
                let read = pictures
                    .entry(picture.clone())
                    .or_insert_with(|| image_file::fetch(&picture, folder).map(Arc::new));
                material.finish.image = shown(read, place, warnings);
            }
            _ => unread(&statement, place, warnings),
        }
    }
    all.values_mut().for_each(brighten);
    Ok(all)
}

/// Many exporters write a black colour under a picture; they mean the picture.
fn brighten(material: &mut Mtl) {
    if material.finish.image.is_some() && material.finish.reflectance == [0.0; 3] {
        material.finish.reflectance = [1.0; 3];
    }
}

fn shown(
    read: &Result<Arc<Image>, String>,
    place: String,
    warnings: &mut Vec<Finding>,
) -> Option<Arc<Image>> {
    if let Err(reason) = read {
        let what = "a texture cannot be read; the material's colour alone is taken";
        let repair = "put the picture beside the file, as PNG or JPEG";
        Finding::note(warnings, format!("{place}: {reason}"), what, repair);
    }
    read.as_ref().ok().cloned()
}

/// Red, green and blue; one number stands for all three.
fn colour(statement: &Statement<'_>) -> Result<[f64; 3], Wrong> {
    if let Some(&word @ ("spectral" | "xyz")) = statement.words.first() {
        let fault = Fault::Word { found: word.to_owned(), wanted: "a colour in red, green and blue" };
        return Err((statement.line, fault));
    }
    let colour = match statement.words.len() {
        1 => [statement.number(0)?; 3],
        _ => statement.vector()?.to_array(),
    };
    match colour.into_iter().find(|value| *value < 0.0) {
        Some(value) => Err((statement.line, Fault::Negative { what: "colour", value })),
        None => Ok(colour),
    }
}

/// Scale, offset and name of a picture: options with up to three numbers or a word, then the name.
fn map(statement: &Statement<'_>) -> Result<(DVec2, DVec2, String), Wrong> {
    let (mut scale, mut offset, mut at) = (DVec2::ONE, DVec2::ZERO, 0);
    while let Some(option) = statement.words.get(at).filter(|word| word.starts_with('-')) {
        at += 1;
        let most = match *option {
            "-s" | "-o" | "-t" => 3,
            "-mm" => 2,
            _ => 1,
        };
        let is_value = |word: &&&str| most == 1 || word.parse::<f64>().is_ok();
        let count = statement.words[at..].iter().take(most).take_while(is_value).count();
        let number = |place: usize, otherwise: f64| {
            if place < count { statement.number(at + place) } else { Ok(otherwise) }
        };
        match *option {
            "-s" => scale = DVec2::new(number(0, 1.0)?, number(1, 1.0)?),
            "-o" => offset = DVec2::new(number(0, 0.0)?, number(1, 0.0)?),
            _ => {}
        }
        at += count;
    }
    let name = statement.words[at.min(statement.words.len())..].join(" ");
    Ok((scale, offset, name.trim_matches('"').to_owned()))
}

/// Notes what would change the light and is not read.
fn unread(statement: &Statement<'_>, place: String, warnings: &mut Vec<Finding>) {
    let number = statement.number(0).unwrap_or_default();
    let (what, repair) = match statement.keyword {
        "Pm" if number > 0.0 => {
            ("shine is left out; surfaces reflect diffusely", "check that the light is what you mean")
        }
        // Models from 3 on mirror; the highlights of model 2 are what every exporter writes.
        "illum" if number >= 3.0 => {
            ("shine is left out; surfaces reflect diffusely", "check that the light is what you mean")
        }
        "d" | "Tr" if is_clear(statement) => (
            "transparency is left out; the surface is opaque",
            "remove surfaces that should let light through",
        ),
        "map_d" | "map_Tr" => (
            "transparency is left out; the surface is opaque",
            "remove surfaces that should let light through",
        ),
        "map_Ke" => (
            "emission textures are not read; the emission colour alone is taken",
            "give it an emission colour",
        ),
        "bump" | "map_bump" | "map_Bump" | "norm" | "disp" => {
            ("bumps are left out", "make them geometry where they matter")
        }
        _ => return,
    };
    Finding::note(warnings, place, what, repair);
}

fn is_clear(statement: &Statement<'_>) -> bool {
    let opaque = if statement.keyword == "d" { 1.0 } else { 0.0 };
    statement.number(0).is_ok_and(|share| share != opaque)
}
