"""How open each face of a trimesh lies, drawn by matplotlib: python examples/exposure.py exposure.png"""

import sys

import matplotlib.pyplot as plt
import trimesh
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import formfactor

mesh = trimesh.util.concatenate(
    [
        trimesh.creation.torus(2, 0.7, major_sections=36, minor_sections=18),
        trimesh.creation.icosphere(2, 0.9),
        trimesh.creation.cylinder(0.3, 4, sections=24, transform=trimesh.transformations.translation_matrix([0, 2, 0])),
    ]
)
scene = formfactor.Enclosure(mesh)
exposure = scene.rows(mesh.triangles_center, mesh.face_normals, range(len(mesh.faces))).sky()

axes = plt.figure(figsize=(8, 6)).add_subplot(projection="3d", computed_zorder=False)
axes.add_collection3d(Poly3DCollection(mesh.triangles, facecolors=plt.cm.cividis(exposure)))
axes.auto_scale_xyz(*mesh.bounds.T)
axes.set_box_aspect(tuple(mesh.extents), zoom=1.6)
axes.set_axis_off()
plt.savefig(sys.argv[1], dpi=120)
