"""Threads, forks, Ctrl-C, memory and imports."""

import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
import tracemalloc

import numpy as np
import pytest

import polycsg

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])


def octagons(count, seed=0):
    angles = np.arange(8) * np.pi / 4
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.random.default_rng(seed).uniform(0, count**0.5, (count, 1, 2)) + ring


def combs(count):
    """Two combs across each other: count² crossings."""
    at = np.arange(count) * 2.0
    teeth = [np.array([[x, -1], [x + 1, -1], [x + 1, 2 * count], [x, 2 * count]]) for x in at]
    return np.array(teeth), np.array(teeth)[:, :, ::-1]


def test_threads_at_once():
    shapes = octagons(2000)
    wanted = polycsg.unary_union(shapes)
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert all(found == wanted for found in pool.map(lambda _: polycsg.unary_union(shapes), range(16)))
        small = list(pool.map(lambda i: polycsg.union(SQUARE + i, SQUARE + i + 1).area, range(1000)))
    assert small == [7.0] * 1000


def test_the_interpreter_is_free_meanwhile():
    upright, level = combs(400)
    done = threading.Event()

    def work():
        polycsg.unary_union([*upright, *level])
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    longest, last = 0.0, time.perf_counter()
    while not done.is_set():
        time.sleep(0.001)
        longest, last = max(longest, time.perf_counter() - last), time.perf_counter()
    worker.join()
    assert longest < 0.5


def area_in_child(shapes):
    return polycsg.unary_union(shapes).area


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_after_a_fork():
    shapes = octagons(2000)
    wanted = polycsg.unary_union(shapes).area
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(area_in_child, [shapes] * 4).get(60) == [wanted] * 4


def one(shapes):
    return shapes.reshape(-1, 2)


LONG = {
    "two at once": lambda: polycsg.symmetric_difference(*map(one, combs(1500))),
    "many as one": lambda: polycsg.unary_union(np.concatenate(combs(1500))),
    "one with an array": lambda: polycsg.union(
        np.stack([SQUARE, SQUARE]), np.concatenate(combs(1500)).reshape(1, -1, 2)
    ),
    "each": lambda: polycsg.is_valid(octagons(1_000_000)),
    "points": lambda: polycsg.locate(SQUARE, np.random.default_rng(0).random((30_000_000, 2))),
}


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize("long", LONG)
def test_ctrl_c(long, interruptible):
    threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while time.monotonic() - start < 20:
            LONG[long]()
    assert time.monotonic() - start < 20


def test_the_same_for_any_number_of_threads():
    code = """
import hashlib, numpy, polycsg
angles = numpy.arange(8) * numpy.pi / 4
ring = numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])
shapes = numpy.random.default_rng(0).uniform(0, 141, (20000, 1, 2)) + ring
print(hashlib.sha256(polycsg.unary_union(shapes).to_wkb()).hexdigest())
"""
    found = {
        subprocess.check_output([sys.executable, "-c", code], env={**os.environ, "RAYON_NUM_THREADS": count})
        for count in "127"
    }
    assert len(found) == 1


def test_no_heavy_package_is_imported():
    code = "import polycsg, sys; polycsg.area([(0, 0), (1, 0), (0, 1)]); print(*sys.modules)"
    modules = subprocess.check_output([sys.executable, "-c", code], text=True).split()
    assert not {"shapely", "geopandas", "pandas", "pyarrow"} & set(modules)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_what_is_only_read_is_not_copied():
    code = """
import numpy, polycsg, resource
shapes = 100_000
vertices = numpy.random.default_rng(0).random((shapes * 100, 2))
angles = numpy.arange(100) * (2 * numpy.pi / 100)
vertices.reshape(shapes, 100, 2)[:] = numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])
rings, polygons = numpy.arange(shapes + 1, dtype=numpy.int32) * 100, numpy.arange(shapes + 1, dtype=numpy.int32)
READ
polycsg.area(given)
def peak(): return int(next(line for line in open("/proc/self/status") if line.startswith("VmHWM")).split()[1]) * 1024
polycsg.area((vertices[:100_000], (rings[:1001], polygons[:1001])))
before = peak()
assert abs(polycsg.area(given).sum() / shapes - 3.1395) < 1e-4
print((peak() - before) / vertices.nbytes)
"""
    numpy = "given = (vertices, (rings, polygons))"
    arrow = """
import geopandas, shapely
import pyarrow
numbers = pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(vertices.reshape(-1)), 2)
lists = pyarrow.ListArray.from_arrays(rings, numbers)
given = pyarrow.ListArray.from_arrays(polygons, lists)
"""
    for read in (numpy, arrow):
        code_now = code.replace("READ", read).replace("\npolycsg.area(given)\n", "\n", 1)
        grown = float(subprocess.check_output([sys.executable, "-c", code_now], text=True))
        assert grown < 0.1, read


def test_nothing_leaks():
    shapes = octagons(1000)
    for _ in range(3):
        polycsg.union(shapes, SQUARE)
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(20):
        polycsg.union(shapes, SQUARE)
    assert tracemalloc.get_traced_memory()[0] - before < 100_000
    tracemalloc.stop()
