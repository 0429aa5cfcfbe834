"""How much sky the ground and the walls of a town see, with pyvista: python examples/town.py docs/picture.png"""

import sys

import numpy as np
import pyvista

import formfactor

rng = np.random.default_rng(4)
houses = []
ground = pyvista.Plane(i_size=60, j_size=60, i_resolution=120, j_resolution=120)
for x in range(-20, 21, 10):
    for y in range(-20, 21, 10):
        (dx, dy), height = rng.integers(4, 9, 2) / 2, rng.uniform(4, 16)
        houses.append(pyvista.Box((x - dx, x + dx, y - dy, y + dy, 0, height), quads=True, level=11))
        inside = (abs(ground.cell_centers().points - [x, y, 0]) < [dx, dy, 1]).all(axis=1)
        ground = ground.remove_cells(inside)

# What hides are whole boxes and a wide ground; what is coloured are the squares of their faces.
far = 1e5 * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
town = formfactor.Enclosure([far], *(pyvista.Box(house.bounds) for house in houses))
plotter = pyvista.Plotter(off_screen=True, window_size=(1200, 800))
for mesh in [ground, *houses]:
    normals = mesh.cell_normals.astype(float)
    centers = mesh.cell_centers().points.astype(float) + 1e-6 * normals
    mesh["sky"] = town.rows(centers, normals).sky()
    plotter.add_mesh(mesh, scalars="sky", cmap="cividis", clim=(0, 1), lighting=False, show_scalar_bar=mesh is ground)
plotter.camera_position = [(62, -66, 62), (0, 0, 2), (0, 0, 1)]
plotter.screenshot(sys.argv[1])
