"""The irradiance of the faces of a scene by Mitsuba's path tracer: JSON in, JSON out.

In: {"faces": [shape, ...], "others": [shape, ...], "paths": [count, ...]}, where a shape has "corners" (triangles, 9 numbers
each), "reflectance" and "emission". Out: for each count {"irradiance": [[r, g, b], ...], "cpu": seconds, "wall": seconds}.
"""
import json
import sys
import time

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
given = json.load(sys.stdin)
# How far before a face its sensor is, as a share of the size of the scene.
BEFORE = 1e-5


def colour(values):
    return {"type": "rgb", "value": values}


def mesh(name, corners, properties):
    """Triangles, three corners each of their own."""
    corners = np.asarray(corners, dtype=np.float32).reshape(-1, 3)
    made = mi.Mesh(name, vertex_count=len(corners), face_count=len(corners) // 3, props=properties)
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = corners.ravel()
    parameters["faces"] = np.arange(len(corners), dtype=np.uint32)
    parameters.update()
    return made


def surface(name, shape):
    """A diffuse mesh that may emit."""
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict({"type": "diffuse", "reflectance": colour(shape["reflectance"])})
    if max(shape["emission"]) > 0.0:
        properties["emitter"] = mi.load_dict({"type": "area", "radiance": colour(shape["emission"])})
    return mesh(name, shape["corners"], properties)


def meter(name, face):
    """A sensor of what the front of a face receives: on a copy before it that is no part of the scene, as rays that start on the face itself
    meet it by rounding."""
    film = {
        "type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}, "pixel_format": "rgb",
        "component_format": "float32",
    }
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict({"type": "diffuse"})
    properties["sensor"] = mi.load_dict({"type": "irradiancemeter", "film": film})
    corners = np.array(face["corners"], dtype=float).reshape(-1, 3, 3)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return mesh(name, corners + BEFORE * size * normals[:, None, :], properties)


faces, others = given["faces"], given["others"]
everything = np.concatenate([np.array(shape["corners"]).reshape(-1, 3) for shape in faces + others])
size = np.ptp(everything, axis=0).max()
shapes = {f"surface{k}": surface(f"surface{k}", shape) for k, shape in enumerate(faces + others)}
scene = mi.load_dict({"type": "scene", "integrator": {"type": "path", "max_depth": -1}, **shapes})
copies = [meter(f"meter{k}", face) for k, face in enumerate(faces)]
meters = [copy.sensor() for copy in copies]
for seed, paths in enumerate(given["paths"]):
    cpu, wall = time.process_time(), time.perf_counter()
    found = [
        np.array(mi.render(scene, sensor=meter, spp=paths, seed=1000 * seed + k)).reshape(-1)[:3].tolist()
        for k, meter in enumerate(meters)
    ]
    spent = {"cpu": time.process_time() - cpu, "wall": time.perf_counter() - wall}
    print(json.dumps({"irradiance": found, **spent}), flush=True)
