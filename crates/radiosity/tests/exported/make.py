#!/usr/bin/env python3
"""Makes all files of this folder anew, with real exporters.

    python3.11 -m venv venv
    venv/bin/pip install bpy==4.5.15 trimesh==5.2.0 meshio==5.3.5 pycollada==0.9.3 pygltflib==1.16.5 scipy
    apt-get install assimp-utils
    npm install three@0.187.0 @gltf-transform/core@4.5.1 @gltf-transform/extensions@4.5.1 @gltf-transform/functions@4.5.1 meshoptimizer@1.3.0
    venv/bin/python make.py

bpy 4.5 needs Python 3.11. The npm packages are looked for in the current folder. `expected.json` keeps what the recipe knows of each file.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import scenes
from scenes import HERE, expect


def node_files():
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "scenes.json"
        data.write_text(json.dumps({"room": scenes.room(), "ball": scenes.ball()}))
        # Packages are looked for beside the script.
        script = Path("radiosity-node.mjs")
        script.write_text((HERE / "node.mjs").read_text())
        subprocess.run(["node", str(script), str(data), str(HERE)], check=True)
        script.unlink()
    version = lambda name: json.loads(Path("node_modules", name, "package.json").read_text())["version"]
    three, transform = "three.js " + version("three"), "glTF-Transform " + version("@gltf-transform/core")
    room = scenes.room()
    dark = [each for each in room if each["name"] != "lamp"]
    copies = [scenes.transformed([room[3]], [1, 0, 0, i, 0, 1, 0, 0, 0, 0, 1, 0])[0] for i in range(3)]
    expect("three-room.glb", room, three, cameras=1, note="a camera; z up in a format that says y")
    expect("three-room.obj", room, three, lit=0, notes=["without a material"], note="materials that no file holds")
    expect("three-room.stl", room, three, lit=0, notes=["no materials"], note="binary")
    expect("three-room.ply", room, three, lit=0, note="binary, most significant byte first")
    expect("three-lights.glb", dark, three, lights=3, note="KHR_lights_punctual, double-sided")
    expect("three-instanced.glb", room[:3] + copies, three, error="EXT_mesh_gpu_instancing", note="EXT_mesh_gpu_instancing: refused by name")
    expect("transform-quantized.glb", scenes.ball(), transform, coarse=True, note="KHR_mesh_quantization")
    expect("transform-meshopt.glb", room, transform, error="meshopt", note="EXT_meshopt_compression: refused by name")
    expect("transform-embedded.gltf", room, transform, note="the buffer in a data: address")


if __name__ == "__main__":
    scenes.EXPECTED.unlink(missing_ok=True)
    for script in ["blender.py", "others.py"]:
        subprocess.run([sys.executable, str(HERE / script)], check=True)
    node_files()
