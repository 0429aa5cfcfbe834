//! The visual scene, walked: every geometry and camera with its transform.
use super::file::{File, XmlNode, child, children};
use super::transform;
use crate::io::error::{Fault, FileError};
use crate::scene::finding::Finding;
use glam::DMat4;

/// Nodes entered while walking; instances of instances can multiply without bound.
const MAX_NODES: usize = 1_000_000;
/// `<instance_node>` within `<instance_node>`.
const MAX_NESTING: usize = 64;

/// A node entered: itself, its transform to the world, and the `<instance_node>`s that led here, outermost first.
#[derive(Clone)]
pub(super) struct Visit<'a> {
    pub(super) node: XmlNode<'a>,
    pub(super) world: DMat4,
    pub(super) via: Vec<XmlNode<'a>>,
}

/// An `<instance_geometry>` met on the way.
pub(super) struct Instance<'a> {
    pub(super) visit: Visit<'a>,
    pub(super) element: XmlNode<'a>,
    pub(super) geometry: XmlNode<'a>,
}

/// An `<instance_camera>` met on the way.
pub(super) struct CameraInstance<'a> {
    pub(super) visit: Visit<'a>,
    pub(super) camera: XmlNode<'a>,
}

/// An `<instance_light>` met on the way.
pub(super) struct LightInstance<'a> {
    pub(super) visit: Visit<'a>,
    pub(super) light: XmlNode<'a>,
}

/// What the walk met, in the order of the file, and what it had to say.
#[derive(Default)]
pub(super) struct Walk<'a> {
    pub(super) instances: Vec<Instance<'a>>,
    pub(super) camera_instances: Vec<CameraInstance<'a>>,
    pub(super) light_instances: Vec<LightInstance<'a>>,
    pub(super) warnings: Vec<Finding>,
}

/// Walks the scene's nodes in document order.
pub(super) fn walk<'a>(file: &File<'a>) -> Result<Walk<'a>, FileError> {
    let mut walk = Walk::default();
    let scene = visual_scene(file, &mut walk.warnings)?;
    let mut stack: Vec<Visit> = Vec::new();
    let mut entered = 0;
    push_nodes(scene, &DMat4::IDENTITY, &[], &mut stack);
    while let Some(Visit { node, world, via }) = stack.pop() {
        entered += 1;
        if entered > MAX_NODES {
            return Err(file.fault(node, Fault::TooMany { what: "nodes", limit: MAX_NODES }));
        }
        if node.tag_name().name() == "instance_node" {
            stack.push(enter(file, node, world, via)?);
            continue;
        }
        let world = world * transform::local(file, node)?;
        if !world.is_finite() {
            return Err(file.fault(node, Fault::Overflow));
        }
        meet(file, &Visit { node, world, via: via.clone() }, &mut walk)?;
        push_nodes(node, &world, &via, &mut stack);
    }
    Ok(walk)
}

/// The visual scene that `<scene>` instances; where it instances none, the first. One of several draws a warning.
fn visual_scene<'a>(file: &File<'a>, warnings: &mut Vec<Finding>) -> Result<XmlNode<'a>, FileError> {
    let libraries = children(file.root, "library_visual_scenes");
    let all: Vec<XmlNode> = libraries.flat_map(|library| children(library, "visual_scene")).collect();
    let instance = child(file.root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
    let scene = match instance {
        Some(instance) => file.target(instance, "url", "visual_scene")?,
        None => *all.first().ok_or_else(|| file.fault(file.root, Fault::Child("library_visual_scenes")))?,
    };
    if all.len() > 1 {
        let which = if instance.is_some() { "the one that <scene> instances" } else { "the first" };
        let count = all.len();
        let what = format!("the file has {count} visual scenes; {which} is taken, the others are left");
        Finding::note(warnings, file.place(scene), &what, "let <scene> instance the one you want");
    }
    Ok(scene)
}

fn push_nodes<'a>(parent: XmlNode<'a>, world: &DMat4, via: &[XmlNode<'a>], stack: &mut Vec<Visit<'a>>) {
    let below = |child: &XmlNode| matches!(child.tag_name().name(), "node" | "instance_node");
    let inner = parent.children().rev().filter(below);
    stack.extend(inner.map(|node| Visit { node, world: *world, via: via.to_vec() }));
}

/// Steps through an `<instance_node>`: endless nesting must pass one of them twice.
fn enter<'a>(
    file: &File<'a>,
    door: XmlNode<'a>,
    world: DMat4,
    mut via: Vec<XmlNode<'a>>,
) -> Result<Visit<'a>, FileError> {
    if via.contains(&door) {
        return Err(file.fault(door, Fault::Cycle));
    }
    if via.len() == MAX_NESTING {
        return Err(file.fault(door, Fault::Nesting(MAX_NESTING)));
    }
    via.push(door);
    Ok(Visit { node: file.target(door, "url", "node")?, world, via })
}

fn meet<'a>(file: &File<'a>, visit: &Visit<'a>, walk: &mut Walk<'a>) -> Result<(), FileError> {
    for element in visit.node.children().filter(XmlNode::is_element) {
        match element.tag_name().name() {
            "instance_geometry" => {
                let geometry = file.target(element, "url", "geometry")?;
                walk.instances.push(Instance { visit: visit.clone(), element, geometry });
            }
            "instance_camera" => match file.target(element, "url", "camera") {
                Ok(camera) => walk.camera_instances.push(CameraInstance { visit: visit.clone(), camera }),
                Err(error) => {
                    let what = "a camera that is not in the file is left out";
                    Finding::note(&mut walk.warnings, error.to_string(), what, "add it, or give --camera");
                }
            },
            "instance_controller" => {
                let (place, what) = (file.place(element), "skinned and morphed geometry is left out");
                Finding::note(&mut walk.warnings, place, what, "bake it into plain geometry");
            }
            "instance_light" => match file.target(element, "url", "light") {
                Ok(light) => walk.light_instances.push(LightInstance { visit: visit.clone(), light }),
                Err(error) => {
                    let what = "a light that is not in the file is left out";
                    Finding::note(&mut walk.warnings, error.to_string(), what, "add it, or give --emit");
                }
            },
            _ => {}
        }
    }
    Ok(())
}

/// The name of a node: its name, else its id, else `otherwise`.
pub(super) fn name_of<'a>(node: XmlNode<'a>, otherwise: &'a str) -> &'a str {
    let named = |attribute| node.attribute(attribute).map(str::trim).filter(|name| !name.is_empty());
    named("name").or_else(|| named("id")).unwrap_or(otherwise)
}
