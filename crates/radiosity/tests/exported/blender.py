"""Files that Blender writes: COLLADA, glTF, OBJ, PLY and STL. Run by make.py with the wheel bpy 4.5."""
import math
import shutil
import tempfile
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

import scenes
from scenes import HERE, expect

EXPORTER = "Blender " + bpy.app.version_string
# Light sources of files: counted by whoever reads them.
PICTURE = Path(tempfile.mkdtemp()) / "tiles.png"
PICTURE.write_bytes(scenes.picture())


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def material(spec, double_sided=True):
    known = bpy.data.materials.get(spec["name"])
    if known:
        return known
    new = bpy.data.materials.new(spec["name"])
    new.use_nodes = True
    new.use_backface_culling = not double_sided
    surface = new.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*spec["diffuse"], 1)
    if "emission" in spec:
        surface.inputs["Emission Color"].default_value = (*spec["emission"], 1)
        surface.inputs["Emission Strength"].default_value = spec["strength"]
    if "texture" in spec:
        image = new.node_tree.nodes.new("ShaderNodeTexImage")
        image.image = bpy.data.images.load(str(PICTURE))
        new.node_tree.links.new(image.outputs["Color"], surface.inputs["Base Color"])
    return new


def add(spec, parent=None, double_sided=True):
    mesh = bpy.data.meshes.new(spec["name"])
    points, faces = {}, []
    for polygon in spec["polygons"]:
        faces.append([points.setdefault(p, len(points)) for p in polygon])
    mesh.from_pydata(list(points), [], faces)
    mesh.materials.append(material(spec["material"], double_sided))
    if spec["smooth"]:
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if "texture" in spec["material"]:
        layer = mesh.uv_layers.new()
        for loop in mesh.loops:
            x, y, _ = mesh.vertices[loop.vertex_index].co
            layer.data[loop.index].uv = (2 * x / 3, 2 * y / 3)
    mesh.update()
    return link(bpy.data.objects.new(spec["name"], mesh), parent)


def link(thing, parent=None):
    bpy.context.scene.collection.objects.link(thing)
    thing.parent = parent
    return thing


def camera():
    lens = bpy.data.cameras.new("camera")
    eye = link(bpy.data.objects.new("camera", lens))
    eye.location = (3.5, 0.5, 1.75)
    eye.rotation_euler = (Vector((1.5, 2, 1)) - eye.location).to_track_quat("-Z", "Y").to_euler()


def light(kind, **values):
    data = bpy.data.lights.new(kind.lower(), kind)
    for key, value in values.items():
        setattr(data, key, value)
    thing = link(bpy.data.objects.new(kind.lower(), data))
    thing.location = (2, 1.5, 2.25)
    return thing


def build(parts, **options):
    clear()
    return [add(each, **options) for each in parts]


def collada(name, **options):
    bpy.ops.wm.collada_export(filepath=str(HERE / name), **options)


def gltf(name, **options):
    form = "GLTF_SEPARATE" if name.endswith(".gltf") else "GLB"
    bpy.ops.export_scene.gltf(filepath=str(HERE / name), export_format=form, **options)


def table_group():
    """A crate on its own and three more of it: a linked twin, one in a turned and stretched parent, one mirrored."""
    crate = scenes.part("crate", scenes.box((0, 0, 0.125), (0.5, 0.5, 0.625)), scenes.RED)
    first = add(crate)
    parts = [crate]

    def twin(matrix, parent=None):
        copy = link(bpy.data.objects.new("twin", first.data), parent)
        copy.matrix_local = matrix
        return copy

    twin(Matrix.Translation((1, 0, 0)))
    parent = link(bpy.data.objects.new("group", None))
    parent.matrix_local = Matrix.Translation((0, 2, 0)) @ Matrix.Rotation(math.pi / 2, 4, "Z")
    inner = link(bpy.data.objects.new("inner", None), parent)
    inner.matrix_local = Matrix.Diagonal((2, 1, 1, 1))
    twin(Matrix.Translation((0.25, 0, 0)), inner)
    twin(Matrix.Translation((2, 2, 0)) @ Matrix.Diagonal((-1, 1, 1, 1)))
    bpy.context.view_layer.update()
    matrices = [each.matrix_world for each in bpy.data.objects if each.data == first.data and each != first]
    for matrix in matrices:
        parts += scenes.transformed([crate], [v for row in matrix for v in row])
    return parts


def collada_files():
    build(scenes.room())
    camera()
    collada("blender-room.dae")
    expect("blender-room.dae", scenes.room(), EXPORTER, cameras=1, note="a room, z up, in metres")

    clear()
    bpy.context.scene.unit_settings.scale_length = 0.01
    bigger = scenes.transformed(scenes.room(), [100, 0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0])
    for each in bigger:
        add(each)
    collada("blender-centimetres.dae")
    expect("blender-centimetres.dae", bigger, EXPORTER, note="the same in centimetres")

    build(scenes.hall())
    collada("blender-hall.dae", triangulate=False)
    expect("blender-hall.dae", scenes.hall(), EXPORTER, note="polygons of six corners that are not convex")

    dark = [each for each in scenes.room() if each["name"] != "lamp"]
    build(dark)
    light("POINT", energy=60)
    light("SPOT", energy=80, spot_size=1.0)
    light("SUN", energy=2)
    light("AREA", energy=40, shape="RECTANGLE", size=1.0, size_y=0.5)
    collada("blender-lights.dae")
    expect("blender-lights.dae", dark, EXPORTER, lights=4, note="a point light, a spot, a sun and an area light; no lamp of polygons")

    clear()
    parts = table_group()
    collada("blender-instances.dae")
    expect("blender-instances.dae", parts, EXPORTER, note="instances, nested and stretched transforms, a mirror")

    build(scenes.ball())
    colours = bpy.data.objects["floor"].data.color_attributes.new("colour", "BYTE_COLOR", "CORNER")
    for datum in colours.data:
        datum.color = (0.2, 0.9, 0.4, 1)
    collada("blender-ball.dae")
    expect("blender-ball.dae", scenes.ball(), EXPORTER, note="smooth shading, vertex colours", notes=["vertex colours"])

    build(scenes.tiled())
    collada("blender-tiled.dae", use_texture_copies=True)
    expect("blender-tiled.dae", scenes.tiled(), EXPORTER, note="a picture beside the file")

    build(scenes.room())
    wire = bpy.data.meshes.new("wire")
    wire.from_pydata([(0.5, 0.5, 1), (1, 1, 2), (1.5, 1, 2)], [(0, 1), (1, 2)], [])
    link(bpy.data.objects.new("wire", wire))
    skinned(scenes.part("sleeve", scenes.box((3, 2, 0.25), (3.25, 2.25, 1.25)), scenes.RED))
    collada("blender-armature.dae")
    expect("blender-armature.dae", scenes.room(), EXPORTER, notes=["skinned", "lines"], note="an armature and loose edges, which are left out")


def skinned(spec):
    body = add(spec)
    bones = bpy.data.armatures.new("bones")
    rig = link(bpy.data.objects.new("rig", bones))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = bones.edit_bones.new("bone")
    bone.head, bone.tail = (3, 2, 0.25), (3, 2, 1.25)
    bpy.ops.object.mode_set(mode="OBJECT")
    group = body.vertex_groups.new(name="bone")
    group.add(list(range(len(body.data.vertices))), 1.0, "REPLACE")
    body.modifiers.new("rig", "ARMATURE").object = rig
    body.parent = rig
    return body


def gltf_files():
    build(scenes.room())
    camera()
    gltf("blender-room.glb", export_cameras=True)
    expect("blender-room.glb", scenes.room(), EXPORTER, up="y", cameras=1, note="double-sided materials, emission of strength 12")

    build(scenes.hall(), double_sided=False)
    gltf("blender-hall.gltf")
    expect("blender-hall.gltf", scenes.hall(), EXPORTER, up="y", note="one-sided materials, the buffer in a file of its own")

    dark = [each for each in scenes.room() if each["name"] != "lamp"]
    build(dark)
    light("POINT", energy=60)
    light("SPOT", energy=80, spot_size=1.0)
    light("SUN", energy=2)
    gltf("blender-lights.glb", export_lights=True)
    expect("blender-lights.glb", dark, EXPORTER, up="y", lights=3, notes=["683 lm"], note="KHR_lights_punctual: a point light, a spot, a sun")

    clear()
    parts = table_group()
    gltf("blender-instances.glb")
    expect("blender-instances.glb", parts, EXPORTER, up="y", note="meshes that nodes share, nested and stretched, a mirror")

    build(scenes.ball())
    star = bpy.data.objects["star"]
    star.shape_key_add(name="basis")
    star.shape_key_add(name="bigger").data[0].co.z += 0.5
    mover = bpy.data.objects["floor"]
    mover.keyframe_insert("location", frame=1)
    mover.location.z -= 1
    mover.keyframe_insert("location", frame=20)
    mover.location.z += 1
    bpy.context.scene.frame_set(1)
    gltf("blender-ball.glb")
    expect("blender-ball.glb", scenes.ball(), EXPORTER, up="y", notes=["morphs", "animations"], note="smooth normals, a morph, an animation")

    build(scenes.tiled())
    nodes = bpy.data.materials["tiles"].node_tree
    mapping, place = nodes.nodes.new("ShaderNodeMapping"), nodes.nodes.new("ShaderNodeUVMap")
    mapping.inputs["Scale"].default_value = (2, 2, 1)
    mapping.inputs["Location"].default_value = (0.25, 0.5, 0)
    nodes.links.new(place.outputs["UV"], mapping.inputs["Vector"])
    nodes.links.new(mapping.outputs["Vector"], nodes.nodes["Image Texture"].inputs["Vector"])
    gltf("blender-tiled.glb")
    expect("blender-tiled.glb", scenes.tiled(), EXPORTER, up="y", note="KHR_texture_transform")

    clear()
    for each in scenes.room():
        add(each)
    metal = bpy.data.materials["red"].node_tree.nodes["Principled BSDF"]
    metal.inputs["Metallic"].default_value = 1
    glass = bpy.data.materials["white"].node_tree.nodes["Principled BSDF"]
    glass.inputs["Transmission Weight"].default_value = 1
    glass.inputs["Coat Weight"].default_value = 1
    gltf("blender-glass.glb")
    expect("blender-glass.glb", scenes.room(), EXPORTER, up="y", notes=["KHR_materials_transmission", "KHR_materials_clearcoat", "shine"], note="glass, varnish and metal")

    build(scenes.room())
    gltf("blender-draco.glb", export_draco_mesh_compression_enable=True)
    expect("blender-draco.glb", scenes.room(), EXPORTER, up="y", error="Draco", note="KHR_draco_mesh_compression: refused by name")


def others():
    build(scenes.room())
    bpy.ops.wm.obj_export(filepath=str(HERE / "blender-room.obj"))
    expect("blender-room.obj", scenes.room(), EXPORTER, up="y", note="quads with normals and materials")
    bpy.ops.wm.ply_export(filepath=str(HERE / "blender-room.ply"), ascii_format=True)
    expect("blender-room.ply", scenes.room(), EXPORTER, lit=0, note="text, with normals")
    bpy.ops.wm.stl_export(filepath=str(HERE / "blender-room.stl"))
    expect("blender-room.stl", scenes.room(), EXPORTER, lit=0, notes=["no materials"], note="binary")
    bpy.ops.wm.stl_export(filepath=str(HERE / "blender-room-text.stl"), ascii_format=True)
    expect("blender-room-text.stl", scenes.room(), EXPORTER, lit=0, notes=["no materials"], note="text")

    build(scenes.ball())
    colours = bpy.data.objects["ball"].data.color_attributes.new("colour", "FLOAT_COLOR", "POINT")
    for datum in colours.data:
        datum.color = (0.5, 0.25, 0.125, 1)
    bpy.ops.wm.obj_export(filepath=str(HERE / "blender-ball.obj"), export_colors=True, export_smooth_groups=True, forward_axis="Y", up_axis="Z")
    expect("blender-ball.obj", scenes.ball(), EXPORTER, notes=["vertex colours"], note="smoothing groups, vertex colours, z up")
    bpy.ops.wm.ply_export(filepath=str(HERE / "blender-ball.ply"), export_colors="SRGB")
    expect("blender-ball.ply", scenes.ball(), EXPORTER, lit=0, note="binary, with vertex colours")

    build(scenes.tiled())
    bpy.ops.wm.obj_export(filepath=str(HERE / "blender-tiled.obj"), path_mode="COPY", export_triangulated_mesh=True)
    expect("blender-tiled.obj", scenes.tiled(), EXPORTER, up="y", note="a picture beside the file, triangles")


if __name__ == "__main__":
    collada_files()
    gltf_files()
    others()
    shutil.rmtree(PICTURE.parent)
