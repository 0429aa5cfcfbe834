#!/usr/bin/env python3
"""polycsg's functions in DataFusion beside SedonaDB, shapely and GeoPandas, and DuckDB where its extension is, in one
run: python engines/benchmarks.py [WORD IN A TITLE ...] > engines/benchmarks.md

Needs of the package index sedonadb 0.5, geoarrow-pyarrow, geopandas, and duckdb with duckdb-extensions and
duckdb-extension-spatial of its version; `npm install --prefix engines/target us-atlas world-atlas`; and
`cargo build --release --features join --example query` in engines/datafusion (QUERY names the program, ATLASES the packages).
Times are CPU time of a process on one thread, the least of several rounds, taken by turns. Each library has warm rounds, in which its process has
answered the query before.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

for name in ("RAYON_NUM_THREADS", "TOKIO_WORKER_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import geopandas
import numpy as np
import pyarrow as pa
import shapely

HERE = Path(__file__).parent
QUERY = os.environ.get("QUERY", HERE / "datafusion/target/release/examples/query")
ATLASES = Path(os.environ.get("ATLASES", HERE / "target/node_modules"))
ENOUGH = 30.0  # seconds; who would take longer for ten times as much, by the square of what it took, is not asked
ROUNDS = 3


# Workloads.


def octagons(count, seed=1):
    """Overlapping octagons of radius 1."""
    rng = np.random.default_rng(seed)
    angles = np.arange(8) * (np.pi / 4)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    return shapely.polygons(rng.uniform(0, 2 * count**0.5, (count, 1, 2)) + ring)


def parcels(count, seed=1):
    """A grid whose inner vertices are moved by up to 0.3 of a cell; neighbours share their edges."""
    side, rng = round(count**0.5), np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0), indexing="ij"), axis=-1)
    grid[1:-1, 1:-1] += rng.uniform(-0.3, 0.3, (side - 1, side - 1, 2))
    corners = [grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]]
    return shapely.polygons(np.stack(corners, axis=2).reshape(-1, 4, 2))


def atlas(file, layer):
    """Ids and geometries of a TopoJSON file, made valid."""
    topology = json.loads((ATLASES / file).read_text())
    scale, shift = topology["transform"]["scale"], topology["transform"]["translate"]
    arcs = [np.cumsum(arc, axis=0) * scale + shift for arc in topology["arcs"]]

    def ring(indices):
        parts = [arcs[i] if i >= 0 else arcs[~i][::-1] for i in indices]
        return np.concatenate([parts[0]] + [part[1:] for part in parts[1:]])

    def geometry(it):
        polygons = {"Polygon": [it.get("arcs")], "MultiPolygon": it.get("arcs")}.get(it["type"], [])
        rings = [[it for it in map(ring, polygon) if len(it) > 3] for polygon in polygons]  # others have no area
        return shapely.MultiPolygon([shapely.Polygon(it[0], it[1:]) for it in rings if it])

    items = [it for it in topology["objects"][layer]["geometries"] if it["type"]]
    valid = shapely.make_valid(np.array([geometry(it) for it in items]), method="structure", keep_collapsed=False)
    return np.array([str(it.get("id", i)) for i, it in enumerate(items)]), valid


# The libraries. Each takes tables and gives geometries.


def table(keys, geometries):
    metadata = {"ARROW:extension:name": "geoarrow.wkb", "ARROW:extension:metadata": "{}"}
    field = pa.field("geom", pa.binary(), metadata=metadata)
    columns = [pa.array([str(key) for key in keys]), pa.array(shapely.to_wkb(geometries), pa.binary())]
    return pa.table(columns, schema=pa.schema([pa.field("key", pa.string()), field]))


def timed(call):
    start = time.process_time()
    found = call()
    return time.process_time() - start, found


def read(tab):
    return shapely.from_wkb([value.as_py() for value in tab["geom"]])


def ours(tables, sql, folder):
    files = []
    for name, rows in tables.items():
        file = folder / f"{name}.arrow"
        with pa.ipc.new_file(file, rows.schema) as writer:
            writer.write_table(rows, max_chunksize=8192)
        files.append(f"{name}={file}")
    result = folder / "result.arrow"
    done = subprocess.run([QUERY, sql, result, str(ROUNDS), *files], check=True, stderr=subprocess.PIPE, text=True)
    return float(done.stderr), read(pa.ipc.open_file(result).read_all())


def sedona(tables, sql, _):
    import sedonadb

    context = sedonadb.connect()
    context.sql("SET datafusion.execution.target_partitions = 1").execute()
    for name, rows in tables.items():
        context.create_data_frame(rows).to_view(name, overwrite=True)
    seconds, found = timed(lambda: context.sql(sql).to_arrow_table())
    return seconds, read(found)


def duck(tables, sql, _):
    import duckdb

    connection = duckdb.connect()
    connection.execute("SET threads = 1")
    connection.execute("LOAD spatial")
    for name, rows in tables.items():
        connection.register(f"{name}_wkb", rows.cast(pa.schema([("key", pa.string()), ("geom", pa.binary())])))
        connection.execute(f"CREATE TABLE {name} AS SELECT key, ST_GeomFromWKB(geom) AS geom FROM {name}_wkb")
    for name in ("st_intersection(", "st_union_agg("):
        if name in sql:
            sql = sql.replace(name, f"ST_AsWKB({name}").replace(" AS geom", ") AS geom")
    seconds, found = timed(lambda: connection.execute(sql).to_arrow_table())
    return seconds, read(found)


def frames(tables):
    parts = {name: read(rows) for name, rows in tables.items()}
    return {name: geopandas.GeoDataFrame({"key": tables[name]["key"].to_pylist()}, geometry=it) for name, it in parts.items()}


def pandas_dissolve(tables, *_):
    frame = frames(tables)["t"]
    return timed(lambda: frame.dissolve(by="key").geometry.to_numpy())


def pandas_overlay(tables, *_):
    both = frames(tables)
    return timed(lambda: geopandas.overlay(both["a"], both["b"], keep_geom_type=True).geometry.to_numpy())


def shapely_dissolve(tables, *_):
    geometries = read(tables["t"])
    return timed(lambda: np.array([shapely.union_all(geometries)]))


# What is asked.

DISSOLVE = "SELECT key, st_union_agg(geom) AS geom FROM t GROUP BY key"
OVERLAY = "SELECT st_intersection(a.geom, b.geom) AS geom FROM a JOIN b ON st_intersects(a.geom, b.geom)"


def dissolves():
    for name, make in (("octagons", octagons), ("parcels", parcels)):
        for count in (1000, 10_000, 100_000):
            geometries = make(count)
            yield f"{len(geometries)} {name}", name, {"t": table(np.zeros(len(geometries), int), geometries)}
    ids, counties = atlas("us-atlas/counties-10m.json", "counties")
    yield "3231 counties of the US into states", "counties", {"t": table([i[:2] for i in ids], counties)}
    ids, countries = atlas("world-atlas/countries-10m.json", "countries")
    yield "countries of the Earth (1:10m) into one", "countries", {"t": table(["all"] * len(ids), countries)}


def overlays():
    for scale in ("110m", "50m"):
        _, countries = atlas(f"world-atlas/countries-{scale}.json", "countries")
        shifted = shapely.transform(countries, lambda p: p + [1.7, 0.9])
        numbers = np.arange(len(countries))
        tables = {"a": table(numbers, countries), "b": table(numbers, shifted)}
        yield f"countries (1:{scale}) and themselves, shifted", f"countries {scale}", tables
    layers = [atlas(f"world-atlas/countries-{scale}.json", "countries") for scale in ("110m", "50m")]
    tables = {name: table(*layer) for name, layer in zip("ab", layers)}
    yield "countries (1:110m) and countries (1:50m)", "countries of two scales", tables
    tables = {name: table(*atlas("us-atlas/counties-10m.json", layer)) for name, layer in zip("ab", ("states", "counties"))}
    yield "states and counties of the US", "states and counties", tables
    for count in (1024, 10_000):
        a, b = parcels(count), shapely.transform(parcels(count, seed=2), lambda p: p + 0.5)
        tables = {"a": table(np.arange(len(a)), a), "b": table(np.arange(len(b)), b)}
        yield f"{len(a)} parcels and as many others", "parcels", tables


def measured(geometries):
    kept = [g for g in geometries if g is not None and not g.is_empty]
    valid = all(shapely.is_valid(kept))
    return float(np.sum(shapely.area(kept))), valid


def row(title, tables, sql, libraries, slow, kind):
    best, found = {}, {}
    for _ in range(ROUNDS):
        for name, call in libraries.items():
            if name in best and (best[name] is None or best[name] > ENOUGH / 10):
                continue
            if name not in best and (name, kind) in slow:
                continue
            with tempfile.TemporaryDirectory() as folder:
                try:
                    seconds, geometries = call(tables, sql, Path(folder))
                except Exception as error:  # a library that cannot do it says so in the table
                    best[name], found[name] = None, str(error).splitlines()[0][:60]
                    slow.add((name, kind))
                    continue
            best[name] = min(seconds, best.get(name, np.inf))
            found[name] = measured(geometries)
            if 100 * seconds > ENOUGH and name in ("SedonaDB", "DuckDB") and sql == DISSOLVE:
                slow.add((name, kind))
    return title, best, found


def told(name, best, found, area):
    if name not in best:
        return "not asked: over 30 s by its growth"
    if best[name] is None:
        return f"fails: {found[name]}"
    off = abs(found[name][0] - area) / area
    flaws = ("" if found[name][1] else ", not valid") + ("" if off < 1e-9 else f", area off by {off:.0e}")
    seconds = best[name]
    return (f"{seconds * 1e3:.3g} ms" if seconds < 1 else f"{seconds:.3g} s") + flaws


def main():
    duck_there = True
    try:
        import duckdb
        from duckdb_extensions import import_extension

        import_extension("spatial")
        duckdb.connect().execute("LOAD spatial")
    except Exception:
        duck_there = False
    dissolvers = {"polycsg": ours, "SedonaDB": sedona, "shapely or GeoPandas": None}
    overlayers = {"polycsg": ours, "SedonaDB": sedona, "GeoPandas": pandas_overlay}
    if duck_there:
        dissolvers["DuckDB"] = overlayers["DuckDB"] = duck
    print("# Engines side by side\n")
    print("By `python engines/benchmarks.py`: CPU time on one thread, the least of rounds by turns. The ratio is to the fastest other.")
    print("`shapely.union_all` where there is one group, `GeoDataFrame.dissolve` where there are more.")
    print(f"Versions: shapely {shapely.__version__} (GEOS {shapely.geos_version_string}), geopandas {geopandas.__version__}.")
    if not duck_there:
        print("DuckDB's spatial extension is not on the package index, so DuckDB is not here.")
    for heading, works, sql, libraries in (
        ("Dissolve", dissolves(), DISSOLVE, dissolvers),
        ("Overlay join", overlays(), OVERLAY, overlayers),
    ):
        print(f"\n## {heading}: `{sql}`\n")
        print("| workload | " + " | ".join(libraries) + " | ratio |")
        print("| --- |" + " --- |" * (len(libraries) + 1))
        slow = set()
        for title, kind, tables in works:
            if len(sys.argv) > 1 and not any(word in title for word in sys.argv[1:]):
                continue
            if "shapely or GeoPandas" in libraries:
                one = len(set(tables["t"]["key"].to_pylist())) == 1
                libraries["shapely or GeoPandas"] = shapely_dissolve if one else pandas_dissolve
            title, best, found = row(title, tables, sql, libraries, slow, kind)
            area = found["polycsg"][0]
            others = [seconds for name, seconds in best.items() if name != "polycsg" and seconds]
            ratio = f"{best['polycsg'] / min(others):.2g}" if others and best["polycsg"] else ""
            cells = [told(name, best, found, area) for name in libraries]
            print(f"| {title} | " + " | ".join(cells) + f" | {ratio} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
