"""Draws the picture of the README: python examples/picture.py > docs/picture.svg"""

import numpy as np

import polycsg


def disk(x, y, radius, corners=120):
    angles = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    return np.array([x, y]) + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def star(x, y, radius):
    return disk(x, y, radius, 5)[[0, 2, 4, 1, 3]]


def path(geometry, style):
    rings = [ring for polygon in polycsg.make_valid(geometry).polygons for ring in polygon]
    data = " ".join("M" + "L".join(f"{x:.2f} {-y:.2f}" for x, y in ring[:-1]) + "Z" for ring in rings)
    return f'<path d="{data}" {style}/>'


disks = [disk(x, 2 * (x % 2), 1.5) for x in range(5)]
stars = [star(x, 1, 0.6) for x in range(5)]
left = polycsg.unary_union(disks)
right = polycsg.evaluate(polycsg.Csg.union(disks) - polycsg.Csg.union(stars))
outline = 'fill="none" stroke="#888" stroke-width="0.03"'
filled = 'fill="#7aa6d8" fill-rule="evenodd" stroke="#234" stroke-width="0.04"'
given = "".join(path(shape, outline) for shape in disks + stars)
panels = [given, path(left, filled), path(right, filled)]
print('<svg xmlns="http://www.w3.org/2000/svg" viewBox="-2 -4 24 6.2" width="960">')
for number, panel in enumerate(panels):
    print(f'<g transform="translate({8 * number} 0)">{panel}</g>')
print("</svg>")
