"""Matrices by workers: the same bits for any blocks and workers, workers that are killed, and restarts."""

import os
import signal
import threading
import time

import formfactor.dask
import pytest
import scipy.sparse

from formfactor import Enclosure

distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def client():
    with distributed.LocalCluster(2, processes=True, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            yield client


def shards(folder):
    return {path.name: path.stat().st_mtime_ns for path in folder.glob("*/triangle-*.npz")}


@pytest.mark.parametrize("blocks", [1, 2, 7])
def test_any_blocks(client, room, tmp_path, blocks):
    scene = Enclosure(room)
    files = formfactor.dask.matrix(client, scene, tmp_path, blocks=blocks)
    assert len(files) == blocks
    assert formfactor.dask.sha256(files) == scene.matrix().sha256()
    found = list(formfactor.dask.rows(files))
    assert [block.first for block in found] == formfactor.dask._ends(len(scene), blocks)[:-1]
    matrix = scipy.sparse.vstack(
        [
            scipy.sparse.csr_array((block.values, block.columns, block.starts), (len(block.starts) - 1, 60))
            for block in found
        ]
    )
    assert (matrix != scene.matrix().to_scipy()).nnz == 0


def test_a_worker_that_is_killed(client, room, tmp_path):
    scene, tolerance = Enclosure(room), 1e-7
    workers, killed = client.run(os.getpid), []

    def kill_one():
        while not shards(tmp_path):
            time.sleep(0.005)
        os.kill(next(iter(workers.values())), signal.SIGKILL)
        killed.append(len(shards(tmp_path)))

    killer = threading.Thread(target=kill_one)
    killer.start()
    files = formfactor.dask.matrix(client, scene, tmp_path, tolerance, blocks=20)
    killer.join()
    assert 1 <= killed[0] < 20
    assert len(shards(tmp_path)) == 20
    assert formfactor.dask.sha256(files) == scene.matrix(tolerance).sha256()


def test_a_restart(client, room, tmp_path):
    scene = Enclosure(room)
    files = formfactor.dask.matrix(client, scene, tmp_path, blocks=7)
    wanted, before = formfactor.dask.sha256(files), shards(tmp_path)
    for lost in [*list(tmp_path.glob("*/triangle-*"))[:3], *tmp_path.glob("*/rows-*")]:
        lost.unlink()
    kept = shards(tmp_path)
    assert formfactor.dask.sha256(formfactor.dask.matrix(client, scene, tmp_path, blocks=7)) == wanted
    after = shards(tmp_path)
    assert after.keys() == before.keys() and kept.items() <= after.items()
    with pytest.raises(ValueError, match="another scene"):
        formfactor.dask.matrix(client, scene, tmp_path, 1e-3)


def test_blocks_have_as_many_rows():
    assert formfactor.dask._ends(1000, 7) == [0, 142, 285, 428, 571, 714, 857, 1000]
    assert formfactor.dask._ends(0, 4) == [0] and formfactor.dask._ends(3, 9) == [0, 1, 2, 3]
