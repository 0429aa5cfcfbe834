//! What a polygon reflects and emits: the material bound to its symbol, through the effect.
use super::file::{File, XmlNode, child, children, descend};
use super::walk::{Instance, name_of};
use super::{
    images::Images,
    spectra::{own, spectra},
};
use crate::io::error::{Fault, FileError};
use crate::io::surface::finish::Finish;
use crate::scene::finding::Finding;

/// The reflectance of a surface that says nothing, or shows a texture.
const DEFAULT_REFLECTANCE: f64 = 0.5;

/// The finish that `instance`, an `<instance_geometry>`, binds to `symbol`.
pub(super) fn finish<'a>(
    file: &File<'a>,
    instance: XmlNode<'a>,
    symbol: Option<&str>,
    images: &mut Images,
    warnings: &mut Vec<Finding>,
) -> Result<Finish, FileError> {
    let mut plain = |what: &str| {
        Finding::note(warnings, file.place(instance), what, "give it a material with a diffuse colour");
        let reflectance = [DEFAULT_REFLECTANCE; 3];
        let name = symbol.unwrap_or_default().into();
        Ok(Finish { material: name, reflectance, emission: [0.0; 3], image: None, spectra: None })
    };
    let Some(symbol) = symbol else { return plain("polygons without a material have a reflectance of 0.5") };
    let Some(material) = bound(file, instance, symbol)? else {
        return plain("polygons whose material is not bound have a reflectance of 0.5");
    };
    let name = name_of(material, symbol).into();
    let effect = file.target(file.child(material, "instance_effect")?, "url", "effect")?;
    let spectra = spectra(file, effect)?;
    let Some(shader) = shader(effect) else {
        return plain("polygons whose effect has no common shader have a reflectance of 0.5");
    };
    let emission = match slot(effect, shader, "emission") {
        Slot::Texture(texture) => {
            let what = "emission textures are not read; emission 0 is taken";
            Finding::note(warnings, file.place(texture), what, "give it an emission colour");
            [0.0; 3]
        }
        other => other.colour(file)?,
    };
    match slot(effect, shader, "diffuse") {
        Slot::Texture(texture) => {
            let image = images.of_texture(file, effect, texture, warnings);
            let reflectance = if image.is_some() { tint(file, texture)? } else { [DEFAULT_REFLECTANCE; 3] };
            Ok(Finish { material: name, reflectance, emission, image, spectra })
        }
        other => {
            Ok(Finish { material: name, reflectance: other.colour(file)?, emission, image: None, spectra })
        }
    }
}

/// What the colours of a texture's picture are multiplied by.
fn tint<'a>(file: &File<'a>, texture: XmlNode<'a>) -> Result<[f64; 3], FileError> {
    own(texture).and_then(|own| child(own, "factor")).map_or(Ok([1.0; 3]), |factor| rgb(file, factor))
}

/// What a surface that reflects all light has it from.
pub(super) enum Dimmable<'a> {
    /// A diffuse colour.
    Colour(XmlNode<'a>),
    Spectrum,
    Neither,
}

/// What the reflectance of polygons with a symbol comes from.
pub(super) fn dimmable<'a>(
    file: &File<'a>,
    instance: XmlNode<'a>,
    symbol: Option<&str>,
) -> Result<Dimmable<'a>, FileError> {
    let material = symbol.map_or(Ok(None), |symbol| bound(file, instance, symbol))?;
    let Some(material) = material else { return Ok(Dimmable::Neither) };
    let effect = file.target(file.child(material, "instance_effect")?, "url", "effect")?;
    if spectra(file, effect)?.is_some() {
        return Ok(Dimmable::Spectrum);
    }
    Ok(match shader(effect).map(|shader| slot(effect, shader, "diffuse")) {
        Some(Slot::Colour(element)) => Dimmable::Colour(element),
        _ => Dimmable::Neither,
    })
}

/// Whether an `<extra>` says that a primitive has two sides: its own, or else that of its effect or of the geometry, as exporters say it.
pub(super) fn is_double_sided<'a>(
    file: &File<'a>,
    instance: &Instance<'a>,
    primitive: XmlNode<'a>,
) -> Result<bool, FileError> {
    if let Some(flag) = children(primitive, "extra").find_map(|extra| flags(extra).next()) {
        return Ok(flag);
    }
    let symbol = primitive.attribute("material");
    let material = symbol.map_or(Ok(None), |symbol| bound(file, instance.element, symbol))?;
    let effect = material.and_then(|material| child(material, "instance_effect"));
    let effect = effect.and_then(|effect| file.target(effect, "url", "effect").ok());
    let told = effect.into_iter().chain(children(instance.geometry, "extra"));
    Ok(told.flat_map(flags).any(|flag| flag))
}

/// What is said within an element about having two sides.
fn flags<'a>(element: XmlNode<'a>) -> impl Iterator<Item = bool> {
    let told = element.descendants().filter(|node| node.tag_name().name() == "double_sided");
    told.filter_map(|node| node.text()).map(|flag| matches!(flag.trim(), "1" | "true"))
}

/// The `<instance_material>` of that symbol, or, since some exporters bind nothing, the material of that id.
fn bound<'a>(file: &File<'a>, instance: XmlNode<'a>, symbol: &str) -> Result<Option<XmlNode<'a>>, FileError> {
    let common = descend(instance, &["bind_material", "technique_common"]);
    let mut bindings = common.into_iter().flat_map(|common| children(common, "instance_material"));
    match bindings.find(|binding| binding.attribute("symbol") == Some(symbol)) {
        Some(binding) => file.target(binding, "target", "material").map(Some),
        None => Ok(file.by_id(symbol, "material")),
    }
}

fn shader(effect: XmlNode<'_>) -> Option<XmlNode<'_>> {
    let technique = descend(effect, &["profile_COMMON", "technique"])?;
    ["lambert", "phong", "blinn", "constant"].iter().find_map(|name| child(technique, name))
}

/// What a shader says of one of its colours.
enum Slot<'a> {
    Nothing,
    Colour(XmlNode<'a>),
    Texture(XmlNode<'a>),
}

fn slot<'a>(effect: XmlNode<'a>, shader: XmlNode<'a>, name: &'static str) -> Slot<'a> {
    let Some(slot) = child(shader, name) else { return Slot::Nothing };
    match child(slot, "color").or_else(|| parameter(effect, slot)) {
        Some(element) => Slot::Colour(element),
        None => child(slot, "texture").map_or(Slot::Nothing, Slot::Texture),
    }
}

impl<'a> Slot<'a> {
    /// The colour; 0 where there is none.
    fn colour(&self, file: &File<'a>) -> Result<[f64; 3], FileError> {
        match self {
            Slot::Colour(element) => rgb(file, *element),
            _ => Ok([0.0; 3]),
        }
    }
}

/// The `<float3>` or `<float4>` of the `<newparam>` that a `<param ref="…">` names.
fn parameter<'a>(effect: XmlNode<'a>, slot: XmlNode<'a>) -> Option<XmlNode<'a>> {
    let name = child(slot, "param")?.attribute("ref")?;
    let places = [Some(effect), child(effect, "profile_COMMON")];
    let mut parameters = places.into_iter().flatten().flat_map(|place| children(place, "newparam"));
    let parameter = parameters.find(|parameter| parameter.attribute("sid") == Some(name))?;
    child(parameter, "float3").or_else(|| child(parameter, "float4"))
}

/// Three numbers, or four, of which the last is opacity and left out.
fn rgb<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<[f64; 3], FileError> {
    let numbers = file.numbers(element)?;
    let &[red, green, blue, ref rest @ ..] = numbers.as_slice() else {
        return Err(file.fault(element, Fault::Count { found: numbers.len(), wanted: 4 }));
    };
    if rest.len() > 1 {
        return Err(file.fault(element, Fault::Count { found: numbers.len(), wanted: 4 }));
    }
    let colour = [red, green, blue];
    match colour.into_iter().find(|value| *value < 0.0) {
        Some(value) => Err(file.fault(element, Fault::Negative { what: "colour", value })),
        None => Ok(colour),
    }
}
