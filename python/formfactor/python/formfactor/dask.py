"""Matrices by a cluster: rows found by Dask's workers, in files, never a matrix in one place.

A block of rows of the upper triangle goes to a file as soon as it is found (:class:`formfactor.ExchangeRows`); once
all are there, the full rows of each block are put together from them, in files again. Files are whole or not there:
what a worker that died leaves behind counts for nothing, and a run that is started again goes on with what there is.
All workers see the same folder.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._enclosure import Enclosure, Tolerance
from ._matrix import RowHash
from ._read import Polygons
from ._shards import Rows, claim, save


def matrix(
    client: Any,
    enclosure: Enclosure,
    folder: str | os.PathLike[str],
    tolerance: float | Tolerance = 1e-4,
    blocks: int = 64,
) -> list[Path]:
    """Finds the form factors between all polygons on the workers of a ``distributed.Client``; gives the files of
    their rows, in order, for :func:`rows` and :func:`sha256`.

    ``folder`` is one that all workers see. A block of k rows of n takes a worker up to some 110 k n bytes; some times
    as many blocks as workers keep all of them busy to the end. The numbers do not depend on blocks, workers and
    restarts, bit for bit.
    """
    root = Path(folder).absolute()
    claim(root, enclosure.fingerprint(tolerance))
    save(root / "scene.npz", enclosure.polygons._asdict())
    ends = _ends(len(enclosure), blocks)
    (root / f"{len(ends) - 1}-blocks").mkdir(exist_ok=True)
    numbers = range(len(ends) - 1)
    client.gather([client.submit(_find, root, ends, block, tolerance, pure=False) for block in numbers])
    files: list[Path] = client.gather(
        [client.submit(_put_together, root, ends, block, pure=False) for block in numbers]
    )
    return files


def _find(root: Path, ends: list[int], block: int, tolerance: float | Tolerance) -> None:
    """The rows of the upper triangle of one block, in parts by the blocks that their columns are of."""
    path = _file(root, "triangle", ends, block)
    if path.exists():
        return
    found = _scene(root).exchange_rows(ends[block], ends[block + 1], tolerance)
    entries = np.empty(len(found.to), dtype=_ENTRY)
    entries["row"] = np.repeat(np.arange(found.first, found.last), np.diff(found.starts))
    entries["column"], entries["area"], entries["error"] = found.to, found.area, found.error
    of = np.searchsorted(ends, found.to, side="right") - 1
    save(path, {str(other): entries[of == other] for other in range(block, len(ends) - 1)})


def _put_together(root: Path, ends: list[int], block: int) -> Path:
    """The full rows of one block: what it found, and what those before it found with it."""
    path = _file(root, "rows", ends, block)
    if path.exists():
        return path
    first, last, areas = ends[block], ends[block + 1], _scene(root).areas
    with np.load(_file(root, "triangle", ends, block), allow_pickle=False) as own:
        there = np.concatenate([own[part] for part in own.files])
        back = [own[str(block)]]
    for before in range(block):
        with np.load(_file(root, "triangle", ends, before), allow_pickle=False) as other:
            back.append(other[str(block)])
    turned = np.concatenate(back)
    turned["row"], turned["column"] = turned["column"], turned["row"].copy()
    entries = np.concatenate([there, turned])
    entries = entries[np.lexsort((entries["column"], entries["row"]))]
    starts = np.searchsorted(entries["row"], np.arange(first, last + 1))
    values = np.clip(entries["area"] / areas[entries["row"]], 0.0, 1.0)
    errors = entries["error"] / areas[entries["row"]]
    save(path, Rows(first, starts, np.ascontiguousarray(entries["column"]), values, errors)._asdict())
    return path


#: What two polygons exchange, 24 bytes.
_ENTRY = np.dtype([("row", "<u4"), ("column", "<u4"), ("area", "<f8"), ("error", "<f8")])


def _file(root: Path, what: str, ends: list[int], block: int) -> Path:
    return root / f"{len(ends) - 1}-blocks" / f"{what}-{block:06}.npz"


@functools.lru_cache(1)
def _scene(root: Path) -> Enclosure:
    with np.load(root / "scene.npz", allow_pickle=False) as file:
        return Enclosure._of(Polygons(file["vertices"], file["loops"], file["polygons"]))


def _ends(count: int, blocks: int) -> list[int]:
    """Where blocks of as many rows begin and end. The first have the most pairs: the longest work comes first."""
    blocks = max(1, min(blocks, count))
    return sorted({count * block // blocks for block in range(blocks + 1)})


def rows(files: Sequence[Path]) -> Iterator[Rows]:
    """The full rows, block after block: ``csr_array((block.values, block.columns, block.starts))`` of each is part of
    the matrix."""
    for file in files:
        yield Rows.load(file)


def sha256(files: Sequence[Path]) -> str:
    """A fingerprint of all rows, bit for bit: that of :meth:`formfactor.FactorMatrix.sha256`."""
    found = RowHash()
    for block in rows(files):
        found.add(block.starts, block.columns, block.values, block.errors)
    return found.hexdigest()
