"""Mean irradiance of patches by Mitsuba 3: a scene as JSON on stdin, what each patch receives as JSON on stdout.

In: {"paths": [...], "patches": [{"triangles": [[[x, y, z], ...], ...], "reflectance": [r, g, b], "radiance": [r, g, b]}, ...]}
Out: {"version": "...", "runs": [{"seconds": s, "irradiance": [[r, g, b], ...]}, ...]}, a run for each number of paths, with the seconds of
CPU that it took.
"""
import json
import sys
import time

import mitsuba

mitsuba.set_variant("scalar_rgb")


def colour(bands):
    return {"type": "rgb", "value": bands}


def film():
    return {"type": "hdrfilm", "width": 1, "height": 1, "pixel_format": "rgb", "component_format": "float32", "rfilter": {"type": "box"}}


def shape(patch, name):
    corners = [corner for triangle in patch["triangles"] for corner in triangle]
    mesh = mitsuba.Mesh(name, vertex_count=len(corners), face_count=len(corners) // 3, props=properties(patch))
    parameters = mitsuba.traverse(mesh)
    parameters["vertex_positions"] = [ordinate for corner in corners for ordinate in corner]
    parameters["faces"] = list(range(len(corners)))
    parameters.update()
    return mesh


def properties(patch):
    told = mitsuba.Properties()
    told["bsdf"] = mitsuba.load_dict({"type": "diffuse", "reflectance": colour(patch["reflectance"])})
    if any(patch["radiance"]):
        told["emitter"] = mitsuba.load_dict({"type": "area", "radiance": colour(patch["radiance"])})
    told["sensor"] = mitsuba.load_dict({"type": "irradiancemeter", "film": film()})
    return told


def main():
    asked = json.load(sys.stdin)
    parts = {f"patch-{index}": shape(patch, f"patch-{index}") for index, patch in enumerate(asked["patches"])}
    scene = mitsuba.load_dict({"type": "scene", "integrator": {"type": "path", "max_depth": -1}, **parts})
    sensors = {name: mesh.sensor() for name, mesh in parts.items()}
    runs = []
    for paths in asked["paths"]:
        start = time.process_time()
        found = []
        for index, sensor in enumerate(sensors.values()):
            picture = mitsuba.render(scene, sensor=sensor, spp=paths, seed=index)
            found.append([float(picture.array[band]) for band in range(3)])
        runs.append({"seconds": time.process_time() - start, "irradiance": found})
    json.dump({"version": mitsuba.__version__, "runs": runs}, sys.stdout)


main()
