#!/usr/bin/env python3
"""The packages beside others, in one run: python python/benchmarks.py [polycsg] [nasty] [formfactor] >
python/benchmarks.md

Needs shapely 2 (GEOS), pyviewfactor, and for the maps `npm install --prefix python/target world-atlas@2.0.2`. Times
are CPU time of the process on one thread (what RAYON_NUM_THREADS=1 leaves of it), the least of several rounds taken
by turns.
"""

import json
import os
import sys
import time
from fractions import Fraction
from pathlib import Path

os.environ.setdefault("RAYON_NUM_THREADS", "1")
os.environ.setdefault("NUMBA_NUM_THREADS", "1")

import numpy as np
import shapely

import polycsg

ATLAS = Path(__file__).parent / "target/node_modules/world-atlas"


def by_turns(tasks, rounds=5, enough=60.0):
    """The least CPU time of each, and what each gives."""
    best, found = [float("inf")] * len(tasks), [None] * len(tasks)
    start = time.perf_counter()
    for _ in range(rounds):
        for i, task in enumerate(tasks):
            before = time.process_time()
            found[i] = task()
            best[i] = min(best[i], time.process_time() - before)
        if time.perf_counter() - start > enough:
            break
    return best, found


def milliseconds(seconds):
    return f"{seconds * 1e3:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"


# Workloads.


def parcels(side, seed=1):
    """A grid whose inner vertices are moved by up to 0.3 of a cell; neighbours share their edges."""
    rng = np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0), indexing="ij"), axis=-1)
    grid[1:-1, 1:-1] += rng.uniform(-0.3, 0.3, (side - 1, side - 1, 2))
    corners = [grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]]
    return np.stack(corners, axis=2).reshape(-1, 4, 2)


def octagons(count, seed=1):
    rng = np.random.default_rng(seed)
    angles = np.arange(8) * (np.pi / 4)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    return rng.uniform(0, 2 * count**0.5, (count, 1, 2)) + ring


def outlines(count, vertices, seed):
    """r = 1 + sums of cosines, each moved by up to 0.8 each way."""
    rng = np.random.default_rng(seed)
    angles = np.arange(vertices) * (2 * np.pi / vertices)
    radii = np.ones((count, vertices))
    for k in range(2, 7):
        radii += rng.uniform(0, 0.25 / k, (count, 1)) * np.cos(k * angles + rng.uniform(0, 2 * np.pi, (count, 1)))
    rings = radii[..., None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return rings + rng.uniform(-0.8, 0.8, (count, 1, 2))


def atlas(name, layer):
    """Geometries of a TopoJSON file, made valid."""
    file = json.loads((ATLAS / f"{name}.json").read_text())
    scale, shift = file["transform"]["scale"], file["transform"]["translate"]
    arcs = [np.cumsum(arc, axis=0) * scale + shift for arc in file["arcs"]]

    def ring(numbers):
        parts = [arcs[n] if n >= 0 else arcs[~n][::-1] for n in numbers]
        return np.concatenate([parts[0], *(part[1:] for part in parts[1:])])

    def rings(shape):
        polygons = {"Polygon": [shape.get("arcs")], "MultiPolygon": shape.get("arcs")}.get(shape["type"], [])
        return {"type": "MultiPolygon", "coordinates": [[ring(r) for r in polygon] for polygon in polygons]}

    top = file["objects"][layer]
    shapes = polycsg.make_valid([rings(shape) for shape in top.get("geometries", [top])]).to_shapely()
    return np.array([shape for shape in shapes if not shape.is_empty])


def ragged(shapes):
    _, coordinates, offsets = shapely.to_ragged_array(shapes)
    return coordinates, offsets


def beside_shapely():
    print("## polycsg beside shapely\n")
    print(
        "| workload | vertices | polycsg | shapely | ratio | greatest difference in area |\n| --- | --- | --- | --- | --- | --- |"
    )

    def row(name, shapes, mine, its, area=lambda shape: shape.area):
        vertices = sum(int(shapely.get_num_coordinates(some).sum()) for some in shapes)
        (a, b), (found, wanted) = by_turns([mine, its])
        areas = np.atleast_1d(found.area), np.atleast_1d(area(wanted))
        off = abs(areas[0] - areas[1]).max() / max(areas[1].max(), 1e-300)
        print(f"| {name} | {vertices} | {milliseconds(a)} | {milliseconds(b)} | {a / b:.2f} | {off:.0e} |", flush=True)

    for name, rings in (("parcels", parcels(100)), ("octagons", octagons(10_000))):
        shapes = shapely.polygons(rings)
        row(
            f"`unary_union` of 10 000 {name}, from geometries",
            [shapes],
            lambda: polycsg.unary_union(shapes),
            lambda: shapely.union_all(shapes),
        )
        given = ragged(shapes)
        row(
            "the same, from ragged arrays",
            [shapes],
            lambda: polycsg.unary_union(given),
            lambda: shapely.union_all(shapes),
        )
    pairs = [shapely.polygons(outlines(100_000, 100, seed)) for seed in (1, 2)]
    given = [ragged(some) for some in pairs]
    get_area = shapely.area
    for name in ("intersection", "union"):
        ours, theirs = getattr(polycsg, name), getattr(shapely, name)
        row(
            f"`{name}` of 1e5 pairs of 100 vertices, from geometries",
            pairs,
            lambda: ours(*pairs),
            lambda: theirs(*pairs),
            get_area,
        )
        row("the same, from ragged arrays", pairs, lambda: ours(*given), lambda: theirs(*pairs), get_area)
    clip = shapely.Polygon(outlines(1, 10_000, 3)[0])
    small = shapely.polygons(octagons(100_000) * 0.006 - 1.9)
    row(
        "1e5 octagons clipped by one of 10 000 vertices",
        [small],
        lambda: polycsg.prepare(clip).clip(small),
        lambda: shapely.intersection(small, clip),
        get_area,
    )
    if not ATLAS.exists():
        print("\nThe maps are missing: `npm install --prefix python/target world-atlas@2.0.2`.")
        return
    land, countries = atlas("land-10m", "land"), atlas("countries-10m", "countries")
    moved = shapely.transform(land, lambda points: points + [1.0, 0.5])
    for name in ("intersection", "union", "difference"):
        ours, theirs = getattr(polycsg, name), getattr(shapely, name)
        row(
            f"`{name}` of Natural Earth's land (1:10m) and itself, shifted",
            [land, moved],
            lambda: ours(land[0], moved[0]),
            lambda: theirs(land[0], moved[0]),
        )
    row(
        "`unary_union` of its countries",
        [countries],
        lambda: polycsg.unary_union(countries),
        lambda: shapely.union_all(countries),
    )
    row(
        "its countries less the shifted land",
        [countries, moved],
        lambda: polycsg.difference(countries, moved[0]),
        lambda: shapely.difference(countries, moved[0]),
        get_area,
    )
    print()


# Nasty input, and exact areas to judge by.


def exact_area(a, b, keep):
    """The area where `keep(in a, in b)` under the even-odd rule, in rational numbers, slab by slab."""

    def edges(ring, which):
        points = [tuple(map(Fraction, point)) for point in ring.tolist()]
        return [(*sorted([p, q]), which) for p, q in zip(points, points[1:] + points[:1]) if p[0] != q[0]]

    def height(edge, x):
        (px, py), (qx, qy), _ = edge
        return py + (qy - py) * (x - px) / (qx - px)

    all_edges = edges(a, 0) + edges(b, 1)
    cuts = {end[0] for edge in all_edges for end in edge[:2]}
    for i, one in enumerate(all_edges):
        for other in all_edges[:i]:
            low, high = max(one[0][0], other[0][0]), min(one[1][0], other[1][0])
            if low < high:
                before, after = (height(one, x) - height(other, x) for x in (low, high))
                if before * after < 0:
                    cuts.add(low + (high - low) * before / (before - after))
    total, cuts = Fraction(0), sorted(cuts)
    for low, high in zip(cuts, cuts[1:]):
        middle = (low + high) / 2
        across = sorted(
            (height(edge, middle), edge[2]) for edge in all_edges if edge[0][0] <= low and edge[1][0] >= high
        )
        inside, last = [False, False], None
        for at, which in across:
            if last is not None and keep(*inside):
                total += (at - last) * (high - low)
            inside[which] = not inside[which]
            last = at
    return float(total)


def regular(rng, corners, radius=1.0):
    angles = rng.uniform(0, 7) + np.arange(corners) * 2 * np.pi / corners
    return rng.uniform(-1, 1, 2) + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def turned(ring, angle):
    c, s = np.cos(angle), np.sin(angle)
    return ring @ np.array([[c, s], [-s, c]])


def star(rng, corners=5):
    return regular(rng, corners)[np.arange(corners) * 2 % corners]


def lattice(rng, corners=7):
    return rng.integers(0, 4, (corners, 2)).astype(float)


NASTY = {
    "general position": lambda rng: (regular(rng, 7), regular(rng, 6)),
    "bow-ties": lambda rng: (rng.uniform(-1, 1, (4, 2)), rng.uniform(-1, 1, (4, 2))),
    "pentagrams": lambda rng: (star(rng), star(rng)),
    "small lattices": lambda rng: (lattice(rng), lattice(rng)),
    "turned by 1e-9": lambda rng: (ring := regular(rng, 8), turned(ring, 1e-9)),
    "turned by 1e-15": lambda rng: (ring := regular(rng, 8), turned(ring, 1e-15)),
    "slivers 1e-12": lambda rng: (ring := regular(rng, 6), ring + rng.uniform(-1e-12, 1e-12, ring.shape)),
    "offset 1e15": lambda rng: (np.round(regular(rng, 6, 9) + 1e15), np.round(regular(rng, 6, 9) + 1e15)),
    "scale 1e150": lambda rng: (regular(rng, 6) * 1e150, regular(rng, 6) * 1e150),
    "scale 1e-150": lambda rng: (regular(rng, 6) * 1e-150, regular(rng, 6) * 1e-150),
    "1e-9 beside 1e9": lambda rng: (regular(rng, 6, 1e9), regular(rng, 6, 1e-9)),
    "shared edges": lambda rng: (ring := regular(rng, 8), np.vstack([ring[:4], regular(rng, 3)])),
    "random walks": lambda rng: (
        np.cumsum(rng.integers(-2, 3, (12, 2)), axis=0) / 7.0,
        np.cumsum(rng.integers(-2, 3, (12, 2)), axis=0) / 7.0,
    ),
    "needles": lambda rng: (ring := rng.uniform(-1, 1, (3, 2)) * [1, 1e-13], ring[::-1] + [0, 3e-14]),
}

#: Kinds whose rings cross themselves. shapely counts edges that cover one another once: only rings that both read
#: alike are taken.
CROSSING = ("bow-ties", "pentagrams", "small lattices", "shared edges", "random walks")


def drawn(name, make, rng):
    while True:
        pair = make(rng)
        areas = [
            (exact_area(ring, ring, KEEP["union"]), shapely.make_valid(shapely.Polygon(ring)).area) for ring in pair
        ]
        if name not in CROSSING or all(abs(exact - its) <= 1e-9 * (1 + exact) for exact, its in areas):
            return pair


KEEP = {
    "union": lambda a, b: a or b,
    "intersection": lambda a, b: a and b,
    "difference": lambda a, b: a and not b,
    "symmetric_difference": lambda a, b: a != b,
}


def nasty(count=100):
    print(f"## Nasty input: {count} pairs of each kind, 4 operations each\n")
    print(
        "Wrong is an area off by more than 1e-9 of that of the box around both, and by more than the last bits of coordinates allow,"
    )
    print(
        "judged by rational numbers. shapely takes what `shapely.make_valid` makes of each ring; of rings that cross themselves, those that both read alike.\n"
    )
    print(
        "| kind | polycsg: wrong, raised, not valid to shapely | shapely: wrong, raised, not valid |\n| --- | --- | --- |"
    )
    for name, make in NASTY.items():
        rng, counts = np.random.default_rng(5), np.zeros((2, 3), int)
        for _ in range(count):
            a, b = drawn(name, make, rng)
            both = np.vstack([a, b])
            width, height = np.ptp(both, axis=0)
            # Vertices of results are doubles.
            allowed = 1e-9 * (width * height or 1e-300) + 8 * (width + height) * np.spacing(abs(both).max())
            for operation, keep in KEEP.items():
                wanted = exact_area(a, b, keep)

                def its():
                    return getattr(shapely, operation)(*(shapely.make_valid(shapely.Polygon(ring)) for ring in (a, b)))

                for which, task in enumerate([lambda: getattr(polycsg, operation)(a, b).to_shapely(), its]):
                    try:
                        shape = task()
                    except (shapely.errors.GEOSException, ValueError):
                        counts[which, 1] += 1
                        continue
                    area = shape.area if which else getattr(polycsg, operation)(a, b).area
                    counts[which, 0] += not abs(area - wanted) <= allowed
                    counts[which, 2] += not shape.is_valid
        print(f"| {name} | {', '.join(map(str, counts[0]))} | {', '.join(map(str, counts[1]))} |", flush=True)
    print()


# formfactor beside pyViewFactor.


def sides(middle, half, parts, inward):
    quads = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (-1, 1):
            steps = np.linspace(-1, 1, parts + 1)
            for i in range(parts):
                for j in range(parts):
                    quad = np.empty((4, 3))
                    quad[:, axis] = end
                    quad[:, u] = steps[[i, i + 1, i + 1, i]]
                    quad[:, v] = steps[[j, j, j + 1, j + 1]]
                    quads.append((quad if (end > 0) != inward else quad[::-1]) * half + middle)
    return quads


def room(parts, boxes, seed=3):
    rng = np.random.default_rng(seed)
    quads = sides(np.full(3, 5.0), np.full(3, 5.0), parts, True)
    placed = []
    while len(placed) < boxes:
        middle, half = rng.uniform(1, 9, 3), rng.uniform(0.3, 0.7, 3)
        if all((abs(middle - m) > half + h).any() for m, h in placed):
            placed.append((middle, half))
            quads += sides(middle, half, 1, False)
    return np.array(quads)


def beside_pyviewfactor():
    import pyviewfactor
    import pyvista

    import formfactor

    print("## formfactor beside pyViewFactor\n")
    print("Errors are differences from factors at 1e-7. pyViewFactor sees a pair whole or not at all.\n")
    print(
        "| surfaces | formfactor, 1e-3 and rows 8e-3 | pyViewFactor by centroids | by all pairs of vertices | greatest error of each | of rows from 1 |\n| --- | --- | --- | --- | --- | --- |"
    )
    for parts, boxes in ((4, 2), (6, 8), (12, 20)):
        quads = room(parts, boxes)
        count = len(quads)
        faces = np.column_stack([np.full(count, 4), np.arange(4 * count).reshape(-1, 4)])
        mesh = pyvista.PolyData(quads.reshape(-1, 3), faces.ravel())
        scene = formfactor.Enclosure(quads)
        tolerance = formfactor.Tolerance(1e-3, row=8e-3)

        def its(strict):
            return pyviewfactor.compute_viewfactor_matrix(
                mesh, obstacles=[mesh], strict_obstruction=strict, verbose=False
            ).T

        its(False)  # compiled once
        tasks = [lambda: scene.matrix(tolerance).to_scipy().toarray(), lambda: its(False), lambda: its(True)]
        times, found = by_turns(tasks[: 3 if count < 200 else 2], 3, 60)
        exact = scene.matrix(1e-7).to_scipy().toarray()
        errors = ", ".join(f"{abs(some - exact).max():.1e}" for some in found)
        rows = ", ".join(f"{abs(some.sum(axis=1) - 1).max():.1e}" for some in found)
        print(
            f"| {count} | {' | '.join(map(milliseconds, times))} |{' – |' * (3 - len(times))} {errors} | {rows} |",
            flush=True,
        )
    print()


if __name__ == "__main__":
    chosen = sys.argv[1:] or ["polycsg", "nasty", "formfactor"]
    print("# The Python packages beside others\n")
    print(
        f"By `{Path(sys.argv[0]).name}`: CPU time on one thread, the least of rounds by turns, on a machine that others used at the same time. Python {sys.version.split()[0]}, shapely {shapely.__version__} (GEOS {shapely.geos_version_string}), numpy {np.__version__}.\n"
    )
    if "polycsg" in chosen:
        beside_shapely()
    if "nasty" in chosen:
        nasty()
    if "formfactor" in chosen:
        beside_pyviewfactor()
