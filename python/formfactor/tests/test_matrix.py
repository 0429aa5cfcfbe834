"""Form factors between polygons: laws, known values, checkpoints, Ctrl-C."""

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import box

import formfactor
from formfactor import Enclosure, FactorMatrix, Tolerance

UNIT = 0.1998248956983874


@pytest.fixture(scope="module")
def matrix(room):
    return Enclosure(room).matrix(1e-4)


def test_laws(room, matrix):
    factors, errors = matrix.to_scipy(), matrix.errors_to_scipy()
    assert abs(factors.sum(axis=1) - 1).max() < 1e-4
    exchange = factors.multiply(matrix.areas[:, None]).tocsr()
    assert abs(exchange - exchange.T).max() < 1e-14
    assert factors.nnz == errors.nnz and (errors.data >= 0).all()
    np.testing.assert_allclose(matrix.defects, 1 - factors.sum(axis=1), atol=1e-14)


def test_known_values():
    cube = Enclosure(box((0, 0, 0), (1, 1, 1), 1, True))
    assert cube.area_form_factor(0, 1, 1e-10).value == pytest.approx(UNIT, abs=1e-10)
    assert cube.area_form_factor(0, 2, 1e-10).value == pytest.approx((1 - UNIT) / 4, abs=1e-10)


def test_bounds(room):
    scene = Enclosure(room)
    found = [scene.area_form_factor(4, to, 1e-8) for to in range(60)]
    hardest = max(range(60), key=lambda to: found[to].evaluations)
    bounded = scene.area_form_factor(4, hardest, 1e-3, bounded=True)
    assert abs(found[hardest].value - bounded.value) <= bounded.error <= 1e-3
    assert scene.area_form_factor(4, hardest, 1e-8, evaluations=10).error >= found[hardest].error


def test_tolerances(room):
    scene = Enclosure(room)
    loose = scene.matrix(Tolerance(1e-2, row=1e-1))
    assert abs(loose.to_scipy() - scene.matrix(1e-5).to_scipy()).max() < 1e-2
    for bad in (0, -1, float("nan"), (0.0, 0.0, 1.0)):
        with pytest.raises(ValueError, match="tolerance is not positive"):
            scene.matrix(bad)


def test_rows_in_any_blocks(room, matrix):
    scene = Enclosure(room)
    for ends in ([0, 30, 60], [0, 1, 2, 59, 60], [0, 60]):
        rows = [scene.exchange_rows(first, last) for first, last in zip(ends, ends[1:])]
        assert FactorMatrix.from_rows(scene.areas, rows[::-1]).sha256() == matrix.sha256()
    with pytest.raises(ValueError, match="there are 60 rows"):
        scene.exchange_rows(0, 61)


def test_one_row(room, matrix):
    row = Enclosure(room).area_row(57)
    wanted = slice(*matrix.starts[57:59])
    np.testing.assert_array_equal(row.columns, matrix.columns[wanted])
    np.testing.assert_allclose(row.values, matrix.values[wanted], rtol=1e-15)
    with pytest.raises(formfactor.GeometryError, match="none has the number 60"):
        Enclosure(room).area_row(60)


def test_what_is_no_row(room):
    scene = Enclosure(room)
    rows = scene.exchange_rows(0, 2)
    wrong = [
        rows._replace(first=59),
        rows._replace(starts=rows.starts[::-1].copy()),
        rows._replace(to=rows.to[:-1]),
        rows._replace(to=np.full_like(rows.to, 60)),
        rows._replace(to=np.zeros_like(rows.to)),
    ]
    for some in wrong:
        with pytest.raises(ValueError):
            FactorMatrix.from_rows(scene.areas, [some])


def test_an_open_room(room):
    scene = Enclosure(room[9:])
    escapes = scene.matrix(1e-5)
    with_space = escapes.with_space()
    assert with_space.to_scipy().shape == (51, 52)
    np.testing.assert_allclose(with_space.to_scipy().sum(axis=1), 1, atol=1e-12)
    assert with_space.without_below(0.01).grouped(np.zeros(51, int)).to_scipy().shape == (1, 2)
    assert with_space.with_space() is with_space
    with pytest.raises(ValueError, match="not closed"):
        escapes.closed()


def test_threshold_and_closure(room, matrix):
    sparse = matrix.without_below(0.004)
    assert len(sparse.values) < len(matrix.values)
    np.testing.assert_allclose(sparse.to_scipy().sum(axis=1), matrix.to_scipy().sum(axis=1), atol=1e-14)
    closed = sparse.closed()
    assert closed.defect < 1e-2 and closed.change < 0.004
    np.testing.assert_allclose(closed.matrix.to_scipy().sum(axis=1), 1, atol=1e-13)
    exchange = closed.matrix.to_scipy().multiply(matrix.areas[:, None]).tocsr()
    assert abs(exchange - exchange.T).max() < 1e-14
    with pytest.raises(ValueError, match="NaN"):
        matrix.without_below(float("nan"))


def test_groups_and_gray_surfaces(room, matrix):
    walls = np.concatenate([np.repeat(np.arange(6), 9), np.full(6, 6)])
    grouped = matrix.grouped(walls)
    assert len(grouped) == 7 and grouped.areas[0] == pytest.approx(9)
    for bad in (walls[:-1], walls - 1, walls * 2, walls + 0.5):
        with pytest.raises(ValueError):
            matrix.grouped(bad)
    gray = grouped.closed().matrix.with_emittances(np.linspace(0.2, 0.8, 7))
    np.testing.assert_allclose(gray.to_scipy().sum(axis=1), np.linspace(0.2, 0.8, 7), atol=1e-12)
    with pytest.raises(ValueError, match="surface 0: its emittance"):
        grouped.with_emittances(np.zeros(7))


def test_empty():
    nothing = Enclosure([]).matrix()
    assert nothing.to_scipy().shape == (0, 0) and len(nothing.with_space()) == 0


def test_progress(room):
    seen = []
    Enclosure(room).matrix(1e-3, progress=lambda done, all: seen.append((done, all)))
    assert seen[-1] == (1770, 1770) and [done for done, _ in seen] == sorted(done for done, _ in seen)

    def give_up(done, all):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        Enclosure(room).matrix(1e-3, progress=give_up)


def test_checkpoints(room, matrix, tmp_path, monkeypatch):
    monkeypatch.setattr("formfactor._enclosure._BLOCK", 13)
    scene, folder = Enclosure(room), tmp_path / "rows"

    def stop_after_half(done, all):
        if done > all / 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        scene.matrix(checkpoint=folder, progress=stop_after_half)
    before = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    assert 2 <= len(before) < 6
    (folder / ".rows.npz.x.tmp").write_bytes(b"cut short")
    seen = []
    assert scene.matrix(checkpoint=folder, progress=lambda *now: seen.append(now)).sha256() == matrix.sha256()
    assert seen[0][0] >= 13 * 59 - 78 and seen[-1] == (1770, 1770)
    after = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    assert before.items() <= after.items()
    with pytest.raises(ValueError, match="another scene, tolerance or version"):
        scene.matrix(1e-3, checkpoint=folder)


def crowd(count):
    """Triangles anywhere: a matrix of them takes long."""
    corners = np.random.default_rng(0).uniform(-1, 1, (count, 1, 3))
    return corners + np.random.default_rng(1).uniform(-0.5, 0.5, (count, 3, 3))


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c(interruptible):
    scene = Enclosure(crowd(400))
    for long in (lambda: scene.matrix(1e-8), lambda: scene.rows(np.zeros((100_000, 3)), [0, 0, 1])):
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        start = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            long()
        assert time.monotonic() - start < 5


def test_threads_at_once(room, matrix):
    scene = Enclosure(room)
    with ThreadPoolExecutor(4) as pool:
        assert all(found.sha256() == matrix.sha256() for found in pool.map(lambda _: scene.matrix(), range(4)))


def test_the_same_for_any_number_of_threads(room, matrix, tmp_path):
    np.save(tmp_path / "room.npy", room)
    room = f"numpy.load({str(tmp_path / 'room.npy')!r})"
    code = f"import formfactor, numpy; print(formfactor.Enclosure({room}).matrix().sha256())"
    for threads in "13":
        environment = {**os.environ, "RAYON_NUM_THREADS": threads}
        found = subprocess.check_output([sys.executable, "-c", code], env=environment, text=True)
        assert found.strip() == matrix.sha256()


def test_no_heavy_package_is_imported():
    code = "import formfactor, sys; print(*sys.modules)"
    modules = subprocess.check_output([sys.executable, "-c", code], text=True).split()
    assert not {"scipy", "dask", "distributed", "trimesh", "pyvista"} & set(modules)


def test_results_are_read_only(matrix):
    for array in (matrix.areas, matrix.starts, matrix.columns, matrix.values, matrix.errors):
        with pytest.raises(ValueError):
            array[0] = 1
