"""Files that trimesh, meshio, pycollada, pygltflib and Assimp write. Run by make.py."""
import re
import subprocess
import tempfile
from importlib.metadata import version
from pathlib import Path

import collada as pycollada
import meshio
import numpy as np
import pygltflib
import trimesh

import scenes
from scenes import HERE, expect


def triangles(polygons):
    """Points and triangles, each polygon a fan."""
    points, faces = {}, []
    for polygon in polygons:
        corners = [points.setdefault(p, len(points)) for p in polygon]
        faces += [[corners[0], a, b] for a, b in zip(corners[1:], corners[2:])]
    return np.array(list(points), dtype=float), np.array(faces)


def trimesh_scene(parts):
    scene = trimesh.Scene()
    for each in parts:
        points, faces = triangles(each["polygons"])
        mesh = trimesh.Trimesh(points, faces, process=False)
        spec = each["material"]
        glow = np.array(spec.get("emission", (0, 0, 0)))
        material = trimesh.visual.material.PBRMaterial(
            name=spec["name"], baseColorFactor=[*spec["diffuse"], 1.0], emissiveFactor=glow, metallicFactor=0.0, roughnessFactor=1.0
        )
        mesh.visual = trimesh.visual.TextureVisuals(material=material)
        scene.add_geometry(mesh, node_name=each["name"], geom_name=each["name"])
    return scene


def trimesh_files():
    exporter = "trimesh " + version("trimesh")
    parts = scenes.room()
    scene = trimesh_scene(parts)
    scene.export(HERE / "trimesh-room.glb")
    expect("trimesh-room.glb", parts, exporter, note="z up in a format that says y")
    scene.export(HERE / "trimesh-room.obj", mtl_name="trimesh-room.mtl")
    expect("trimesh-room.obj", parts, exporter, lit=0, note="materials without Ke")
    whole = scene.to_geometry()
    whole.export(HERE / "trimesh-room.ply", encoding="binary")
    expect("trimesh-room.ply", parts, exporter, lit=0, note="binary")
    whole.export(HERE / "trimesh-room.stl")
    expect("trimesh-room.stl", parts, exporter, lit=0, notes=["no materials"], note="binary")
    whole.export(HERE / "trimesh-room.dae")
    expect("trimesh-room.dae", parts, exporter, lit=0, note="one geometry, by pycollada")


def meshio_files():
    exporter = "meshio " + version("meshio")
    parts = [each for each in scenes.room() if each["name"] != "lamp"]
    points, quads = {}, []
    for each in parts:
        quads += [[points.setdefault(p, len(points)) for p in polygon] for polygon in each["polygons"]]
    mesh = meshio.Mesh(np.array(list(points), dtype=float), [("quad", np.array(quads))])
    mesh.write(HERE / "meshio-room.ply", binary=False)
    expect("meshio-room.ply", parts, exporter, note="text, quads, doubles")
    mesh.write(HERE / "meshio-room.obj")
    expect("meshio-room.obj", parts, exporter, notes=["without a material"], note="faces without a material")
    points, faces = triangles([polygon for each in parts for polygon in each["polygons"]])
    meshio.Mesh(points, [("triangle", faces)]).write(HERE / "meshio-room.stl", binary=False)
    expect("meshio-room.stl", parts, exporter, notes=["no materials"], note="text, a solid without a name")


def pycollada_files():
    exporter = "pycollada " + version("pycollada")
    mesh = pycollada.Collada()
    mesh.assetInfo.upaxis = "Z_UP"
    mesh.assetInfo.unitname, mesh.assetInfo.unitmeter = "inch", 0.0254
    nodes, materials = [], {}
    for each in scenes.hall():
        spec = each["material"]
        if spec["name"] not in materials:
            glow = tuple(12 * band for band in spec["emission"]) if "emission" in spec else (0.0, 0.0, 0.0)
            effect = pycollada.material.Effect(spec["name"] + "-effect", [], "lambert", diffuse=(*spec["diffuse"], 1.0), emission=(*glow, 1.0))
            materials[spec["name"]] = pycollada.material.Material(spec["name"], spec["name"], effect)
            mesh.effects.append(effect)
            mesh.materials.append(materials[spec["name"]])
        points, places = {}, []
        for polygon in each["polygons"]:
            places.append(np.array([points.setdefault(p, len(points)) for p in polygon]))
        source = pycollada.source.FloatSource(each["name"] + "-points", np.array(list(points), dtype=float).ravel(), ("X", "Y", "Z"))
        geometry = pycollada.geometry.Geometry(mesh, each["name"] + "-mesh", each["name"], [source])
        inputs = pycollada.source.InputList()
        inputs.addInput(0, "VERTEX", "#" + each["name"] + "-points")
        geometry.primitives.append(geometry.createPolygons(places, inputs, "symbol"))
        mesh.geometries.append(geometry)
        bound = pycollada.scene.MaterialNode("symbol", materials[spec["name"]], inputs=[])
        nodes.append(pycollada.scene.Node(each["name"], children=[pycollada.scene.GeometryNode(geometry, [bound])]))
    scene = pycollada.scene.Scene("scene", nodes)
    mesh.scenes.append(scene)
    mesh.scene = scene
    mesh.write(str(HERE / "pycollada-hall.dae"))
    expect("pycollada-hall.dae", scenes.hall(), exporter, note="<polygons>, in inches")
    text = (HERE / "pycollada-hall.dae").read_text(encoding="utf-8")
    declared = text.replace("encoding='utf-8'", "encoding='utf-16'").replace('encoding="utf-8"', 'encoding="utf-16"')
    (HERE / "pycollada-hall-utf-16.dae").write_bytes(declared.encode("utf-16"))
    expect("pycollada-hall-utf-16.dae", scenes.hall(), exporter, note="the same, saved in UTF-16")


def pygltflib_files():
    """Strips, a fan, lines and points, and a sparse accessor: no exporter with a window writes these."""
    exporter = "pygltflib " + version("pygltflib")
    floor = [(0, 0, 0), (0, 0, 2), (2, 0, 0), (2, 0, 2), (4, 0, 0), (4, 0, 2)]
    wall = [(0, 0, 0), (4, 0, 0), (4, 1, 0), (2, 2, 0), (0, 1, 0)]
    points = np.array(floor + wall, dtype="<f4")
    blob = points.tobytes()
    blob += np.array([3], dtype="<u2").tobytes() + b"\0\0"
    blob += np.array([(2, 0, 3)], dtype="<f4").tobytes()
    view = lambda start, length: pygltflib.BufferView(buffer=0, byteOffset=start, byteLength=length)
    moved = pygltflib.Sparse(
        count=1,
        indices=pygltflib.AccessorSparseIndices(bufferView=2, byteOffset=0, componentType=5123),
        values=pygltflib.AccessorSparseValues(bufferView=3, byteOffset=0),
    )
    accessor = lambda view, rows, sparse=None: pygltflib.Accessor(
        bufferView=view, componentType=5126, count=len(rows), type="VEC3", min=[0, 0, 0], max=[4, 2, 3], sparse=sparse
    )
    primitive = lambda accessor, mode: pygltflib.Primitive(attributes=pygltflib.Attributes(POSITION=accessor), mode=mode)
    gltf = pygltflib.GLTF2(
        scene=0,
        scenes=[pygltflib.Scene(nodes=[0])],
        nodes=[pygltflib.Node(name="modes", mesh=0)],
        meshes=[pygltflib.Mesh(primitives=[primitive(0, 5), primitive(1, 6), primitive(1, 3), primitive(1, 0)])],
        accessors=[accessor(0, floor, moved), accessor(1, wall)],
        bufferViews=[view(0, 72), view(72, 60), view(132, 2), view(136, 12)],
        buffers=[pygltflib.Buffer(byteLength=len(blob))],
    )
    gltf.set_binary_blob(blob)
    gltf.save(str(HERE / "pygltflib-modes.glb"))
    floor[3] = (2, 0, 3)
    strip = [[floor[i], floor[i + 1], floor[i + 2]] for i in range(4)]
    parts = [scenes.part("modes", strip + [wall], scenes.WHITE)]
    expect("pygltflib-modes.glb", parts, exporter, notes=["lines and points"], note="a strip, a fan, lines, points; a sparse accessor")


def assimp_files():
    """What Assimp makes of Blender's OBJ file."""
    exporter = subprocess.run(["assimp", "version"], capture_output=True, text=True).stdout
    exporter = "Assimp " + re.search(r"Version ([0-9.]+)", exporter)[1]
    with tempfile.TemporaryDirectory() as folder:
        for kind, name, lit, notes, error in [
            ("collada", "assimp-room.dae", None, [], None),
            ("obj", "assimp-room.obj", None, [], None),
            ("ply", "assimp-room.ply", 0, [], None),
            ("stl", "assimp-room.stl", 0, ["no materials"], None),
            ("glb2", "assimp-room.glb", None, ["KHR_materials_pbrSpecularGlossiness"], None),
            ("gltf", "assimp-room-1.0.gltf", None, [], "glTF 1.0"),
        ]:
            target = Path(folder) / name
            subprocess.run(["assimp", "export", str(HERE / "blender-room.obj"), str(target), "-f" + kind], check=True, capture_output=True)
            for made in Path(folder).iterdir():
                made.replace(HERE / made.name)
            expect(name, scenes.room(), exporter, up="y", lit=lit, notes=notes, error=error, note="Blender's OBJ file, converted")


if __name__ == "__main__":
    trimesh_files()
    meshio_files()
    pycollada_files()
    pygltflib_files()
    assimp_files()
