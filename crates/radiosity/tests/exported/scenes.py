"""The scenes that are exported, and what is known of them: areas, boxes and lamps come from here, not from reading a file."""
import json
import math
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).parent
EXPECTED = HERE / "expected.json"

WHITE = {"name": "white", "diffuse": (0.8, 0.8, 0.75)}
RED = {"name": "red", "diffuse": (0.6, 0.1, 0.1)}
LAMP = {"name": "lamp", "diffuse": (0.5, 0.5, 0.5), "emission": (1.0, 0.9, 0.7), "strength": 12.0}
TILES = {"name": "tiles", "diffuse": (1.0, 1.0, 1.0), "texture": "tiles.png"}


def part(name, polygons, material, smooth=False):
    """An object: polygons, each a list of points, counter-clockwise seen from the front."""
    return {"name": name, "polygons": polygons, "material": material, "smooth": smooth}


def box(low, high, inward=False):
    """The six sides of a box."""
    (a, b, c), (d, e, f) = low, high
    v = lambda i: ((a, d)[i & 1], (b, e)[i >> 1 & 1], (c, f)[i >> 2])
    sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return [[v(i) for i in (reversed(side) if inward else side)] for side in sides]


def panel(low, high, z):
    """A rectangle that faces down."""
    (a, b), (c, d) = low, high
    return [[(a, b, z), (a, d, z), (c, d, z), (c, b, z)]]


def room():
    """A room of 4 by 3 by 2.5 with a lamp, a table and a crate, none of which touch anything."""
    return [
        part("room", box((0, 0, 0), (4, 3, 2.5), inward=True), WHITE),
        part("lamp", panel((1.5, 1.25), (2.5, 1.75), 2.375), LAMP),
        part("table", box((1, 1, 0.75), (2.25, 2, 0.8125)), RED),
        part("crate", box((3, 0.5, 0.125), (3.5, 1, 0.625)), WHITE),
    ]


def hall():
    """A hall with an L as its floor: polygons of six corners, not convex."""
    outline = [(0, 0), (5, 0), (5, 2), (2, 2), (2, 4), (0, 4)]
    height = 3
    walls = []
    for (a, b), (c, d) in zip(outline, outline[1:] + outline[:1]):
        walls.append([(a, b, height), (c, d, height), (c, d, 0), (a, b, 0)])
    floor = [(x, y, 0) for x, y in outline]
    ceiling = [(x, y, height) for x, y in reversed(outline)]
    return [
        part("hall", walls + [floor, ceiling], WHITE),
        part("lamp", panel((0.5, 0.5), (1.5, 1), 2.75), LAMP),
        part("second-lamp", panel((3, 0.5), (4, 1), 2.75), LAMP),
    ]


def sphere(centre, radius, segments=12, rings=6):
    """A sphere of trapezia and triangles."""
    def point(ring, segment):
        theta, phi = math.pi * ring / rings, 2 * math.pi * segment / segments
        x, y, z = math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)
        return tuple(c + radius * u for c, u in zip(centre, (x, y, z)))
    polygons = []
    for ring in range(rings):
        for segment in range(segments):
            a, b = point(ring, segment), point(ring + 1, segment)
            c, d = point(ring + 1, (segment + 1) % segments), point(ring, (segment + 1) % segments)
            if ring == 0:
                polygons.append([a, b, c])
            elif ring == rings - 1:
                polygons.append([a, b, d])
            else:
                polygons.append([a, b, c, d])
    return polygons


def octahedron(centre, radius):
    """Eight triangles."""
    tips = [(radius, 0, 0), (0, radius, 0), (-radius, 0, 0), (0, -radius, 0)]
    move = lambda p: tuple(c + u for c, u in zip(centre, p))
    top, bottom = move((0, 0, radius)), move((0, 0, -radius))
    around = [move(tip) for tip in tips]
    pairs = list(zip(around, around[1:] + around[:1]))
    return [[a, b, top] for a, b in pairs] + [[b, a, bottom] for a, b in pairs]


def ball():
    """A smooth ball and a lamp of eight triangles over a floor."""
    return [
        part("floor", [[(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]], WHITE),
        part("ball", sphere((0, 0, 1), 0.75), RED, smooth=True),
        part("star", octahedron((1, 1, 2.5), 0.25), LAMP),
    ]


def tiled():
    """A floor with a picture on it, under a lamp; the picture repeats twice along each side."""
    return [
        part("floor", [[(0, 0, 0), (3, 0, 0), (3, 3, 0), (0, 3, 0)]], TILES),
        part("lamp", panel((1, 1), (2, 2), 2), LAMP),
    ]


def picture():
    """Eight by eight texels, half of them white and half of them black, as a PNG."""
    rows = b"".join(b"\0" + b"".join(b"\xff\xff\xff" if (x + y) % 2 else b"\0\0\0" for x in range(8)) for y in range(8))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", 8, 8, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def transformed(parts, matrix):
    """The same parts elsewhere; a mirror turns the polygons so that the front stays in front."""
    rows = [matrix[0:4], matrix[4:8], matrix[8:12]]
    move = lambda p: tuple(sum(r[i] * p[i] for i in range(3)) + r[3] for r in rows)
    return [{**each, "polygons": [[move(p) for p in polygon] for polygon in each["polygons"]]} for each in parts]


def area(polygon):
    """Half the length of the vector sum of cross products."""
    total = [0.0, 0.0, 0.0]
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        total[0] += p[1] * q[2] - p[2] * q[1]
        total[1] += p[2] * q[0] - p[0] * q[2]
        total[2] += p[0] * q[1] - p[1] * q[0]
    return math.sqrt(sum(t * t for t in total)) / 2


def y_up(point):
    """The same point where y is up."""
    x, y, z = point
    return (x, z, -y)


def expect(file, parts, exporter, up="z", scale=1.0, lit=None, notes=(), error=None, lights=0, cameras=0, coarse=False, note=""):
    """Keeps what is known of a file. `lit` counts planar faces that emit; `notes` are words of the warning, `error` those of a
    refusal; coordinates of a `coarse` file are rounded to some thousandths."""
    known = json.loads(EXPECTED.read_text()) if EXPECTED.exists() else {}
    polygons = [polygon for each in parts for polygon in each["polygons"]]
    turn = y_up if up == "y" else (lambda p: p)
    points = [tuple(scale * c for c in turn(p)) for polygon in polygons for p in polygon]
    lamps = sum(len(each["polygons"]) for each in parts if "emission" in each["material"])
    known[file] = {
        "exporter": exporter,
        "area": scale * scale * sum(map(area, polygons)),
        "low": [min(p[i] for p in points) for i in range(3)],
        "high": [max(p[i] for p in points) for i in range(3)],
        "lit": lamps if lit is None else lit,
        "cameras": cameras,
        "lights": lights,
        "coarse": coarse,
        "notes": list(notes),
        "error": error,
        "shows": note,
    }
    EXPECTED.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n")
