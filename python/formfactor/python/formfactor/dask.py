"""Matrices by a cluster: rows found by Dask's workers, in files, never a matrix in one place.

A block of rows of the upper triangle goes to a file as soon as it is found (:class:`formfactor.ExchangeRows`); once all are there, the full
rows of each block are put together from them, in files again. Files are whole or not there: what a worker that died leaves behind counts for
nothing, and a run that is started again goes on with what there is. All workers see the same folder.
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
from ._shards import ExchangeRows, Rows, claim, save, shard


def matrix(
    client: Any,
    enclosure: Enclosure,
    folder: str | os.PathLike[str],
    tolerance: float | Tolerance = 1e-4,
    blocks: int = 64,
) -> list[Path]:
    """Finds the form factors between all polygons on the workers of a ``distributed.Client``; gives the files of their rows, in order, for
    :func:`rows` and :func:`sha256`.

    ``folder`` is one that all workers see. Blocks are cut so that each has as many pairs; some times the number of workers keeps all of
    them busy to the end. The numbers do not depend on blocks, workers and restarts, bit for bit.
    """
    root = Path(folder).absolute()
    claim(root, enclosure.fingerprint(tolerance))
    save(root / "scene.npz", enclosure.polygons._asdict())
    ends = _ends(len(enclosure), blocks)
    spans = list(zip(ends, ends[1:], strict=False))
    client.gather([client.submit(_find, root, *span, tolerance, pure=False) for span in spans])
    files = client.gather([client.submit(_put_together, root, *span, spans, pure=False) for span in spans])
    return [Path(file) for file in files]


def _find(root: Path, first: int, last: int, tolerance: float | Tolerance) -> None:
    """The rows of the upper triangle of one block."""
    path = shard(root, first, last)
    if not path.exists():
        save(path, _scene(root).exchange_rows(first, last, tolerance)._asdict())


def _put_together(root: Path, first: int, last: int, spans: Sequence[tuple[int, int]]) -> str:
    """The full rows of one block, from the triangle's rows up to its end."""
    path = root / f"matrix-{first:09}-{last:09}.npz"
    if not path.exists():
        areas = _scene(root).areas
        parts = [_between(first, last, shard(root, *span)) for span in spans if span[0] < last]
        row, column, area, error = (np.concatenate(part) for part in zip(*parts, strict=True))
        order = np.lexsort((column, row))
        row, column, area, error = row[order], column[order], area[order], error[order]
        starts = np.searchsorted(row, np.arange(first, last + 1))
        values = np.clip(area / areas[row], 0.0, 1.0)
        save(path, Rows(first, starts, column.astype(np.uint32), values, error / areas[row])._asdict())
    return str(path)


def _between(first: int, last: int, path: Path) -> tuple[Any, Any, Any, Any]:
    """What a file has for the rows of a block, in both directions."""
    found = ExchangeRows.load(path)
    one = np.repeat(np.arange(found.first, found.last), np.diff(found.starts))
    other = found.to.astype(np.int64)
    there, back = ((side >= first) & (side < last) for side in (one, other))
    chosen = [(one, other), (other, one), (found.area, found.area), (found.error, found.error)]
    row, column, area, error = (np.concatenate([a[there], b[back]]) for a, b in chosen)
    return row, column, area, error


@functools.lru_cache(1)
def _scene(root: Path) -> Enclosure:
    with np.load(root / "scene.npz", allow_pickle=False) as file:
        return Enclosure._of(Polygons(file["vertices"], file["loops"], file["polygons"]))


def _ends(count: int, blocks: int) -> list[int]:
    """Where blocks of as many pairs begin and end: the k-th of n rows has n - 1 - k."""
    shares = np.linspace(0, 1, max(1, min(blocks, count)) + 1)
    ends = {round(count * (1 - (1 - share) ** 0.5)) for share in shares}
    return sorted(ends | {0, count})


def rows(files: Sequence[Path]) -> Iterator[Rows]:
    """The full rows, block after block: ``csr_array((block.values, block.columns, block.starts))`` of each is part of the matrix."""
    for file in files:
        yield Rows.load(file)


def sha256(files: Sequence[Path]) -> str:
    """A fingerprint of all rows, bit for bit: that of :meth:`formfactor.FactorMatrix.sha256`."""
    found = RowHash()
    for block in rows(files):
        found.add(block.starts, block.columns, block.values, block.errors)
    return found.hexdigest()
