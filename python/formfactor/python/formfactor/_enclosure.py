"""Form factors from points, and between the polygons of an enclosure."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _formfactor
from ._matrix import FactorMatrix
from ._read import Polygons, doubles, integers, joined, read, read_polygon
from ._shards import ExchangeRows, claim, save, shard

#: So many rows go into one file of a checkpoint.
_BLOCK = 256

Progress: TypeAlias = Callable[[int, int], object]


class FormFactor(NamedTuple):
    """A form factor from a point."""

    value: float
    #: |value - exact| is at most this.
    error_bound: float


class AreaFormFactor(NamedTuple):
    """A form factor between polygons."""

    value: float
    #: An estimate of the error; a bound on it, if one was asked for.
    error: float
    #: The number of point form factors, or of cells, that it took.
    evaluations: int


class PointRows(NamedTuple):
    """Form factors from points (rows) to polygons (columns): arrays, or scipy's sparse ones."""

    values: Any
    #: Bounds on the errors.
    error_bounds: Any

    def sky(self) -> npt.NDArray[np.float64]:
        """What each row lacks of 1: what reaches no front of a polygon, as the sky does above a town of closed
        buildings."""
        return np.clip(1.0 - np.asarray(self.values.sum(axis=1)), 0.0, 1.0)


class AreaRow(NamedTuple):
    """Form factors from one polygon to those that it sees."""

    #: The numbers of those.
    columns: npt.NDArray[np.uint32]
    values: npt.NDArray[np.float64]
    #: Estimates of the errors.
    errors: npt.NDArray[np.float64]


class Tolerance(NamedTuple):
    """What form factors between polygons may err by: each within ``absolute`` or within ``relative`` of itself, and
    the root of the sum of the squares of a row's within ``row``."""

    absolute: float
    relative: float = 0.0
    row: float = float("inf")


def form_factor(position: npt.ArrayLike, normal: npt.ArrayLike, to: object, occluders: object = ()) -> FormFactor:
    """The form factor from a point to a polygon, past others.

    >>> lamp = [(-1, 1, 2), (1, 1, 2), (1, -1, 2), (-1, -1, 2)]
    >>> round(form_factor((0, 0, 0), (0, 0, 1), lamp).value, 12)
    0.239456470461
    """
    place, target = _place(position, normal), read_polygon(to)
    return FormFactor(*_formfactor.form_factor(*place, target, read(occluders)))


def unoccluded_complement(position: npt.ArrayLike, normal: npt.ArrayLike, to: object) -> FormFactor:
    """1 - F for a polygon with nothing in between, with all digits, where F is nearly 1.

    >>> sky = [(-1e9, 1e9, 1), (1e9, 1e9, 1), (1e9, -1e9, 1), (-1e9, -1e9, 1)]
    >>> 0 < unoccluded_complement((0, 0, 0), (0, 0, 1), sky).value < 1e-17
    True
    """
    return FormFactor(*_formfactor.unoccluded_complement(*_place(position, normal), read_polygon(to)))


def visible_part(
    position: npt.ArrayLike, normal: npt.ArrayLike, to: object, occluders: object = ()
) -> list[npt.NDArray[np.float64]]:
    """The rings (n, 3) of the part of a polygon that a point sees past others: outer ones counter-clockwise seen from
    the front, holes clockwise.

    >>> lamp = [(-1, 1, 2), (1, 1, 2), (1, -1, 2), (-1, -1, 2)]
    >>> board = [(-0.25, -0.25, 1), (0.25, -0.25, 1), (0.25, 0.25, 1), (-0.25, 0.25, 1)]
    >>> [ring.shape for ring in visible_part((0, 0, 0), (0, 0, 1), lamp, [board])]
    [(4, 3), (4, 3)]
    """
    place, target = _place(position, normal), read_polygon(to)
    return _formfactor.visible_part(*place, target, read(occluders))


def _place(
    position: npt.ArrayLike, normal: npt.ArrayLike
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    (x, y, z), (u, v, w) = doubles([position])[0].tolist(), doubles([normal])[0].tolist()
    return (x, y, z), (u, v, w)


class Enclosure:
    """Polygons that see and hide each other: those of some meshes, one mesh after the other.

    A mesh is anything with ``vertices`` and ``faces`` (trimesh), with ``points`` and ``faces`` (pyvista) or ``cells``
    (meshio), a pair of arrays (vertices, faces), an array (k, n, 3), or a sequence of polygons. A polygon is a loop
    (n, 3), or a tuple of loops of which the first is the outer one. Polygons are numbered from 0. Four corners and
    more must lie in a plane.

    >>> import numpy as np
    >>> corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    >>> inward = np.array([[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]])
    >>> room = Enclosure((corners, inward))
    >>> round(room.area_form_factor(0, 1, 1e-9).value, 9)
    0.199824896
    >>> room.matrix(1e-6).to_scipy().sum(axis=1).round(5)
    array([1., 1., 1., 1., 1., 1.])
    """

    __slots__ = ("_enclosure", "_polygons")

    def __init__(self, *meshes: object) -> None:
        parts = [read(mesh) for mesh in meshes]
        self._polygons = parts[0] if len(parts) == 1 else joined(parts)
        self._enclosure = _formfactor.Enclosure(self._polygons)

    @classmethod
    def _of(cls, polygons: Polygons) -> Enclosure:
        found = cls.__new__(cls)
        found._polygons = polygons
        found._enclosure = _formfactor.Enclosure(polygons)
        return found

    def __reduce__(self) -> tuple[object, tuple[Polygons]]:
        return Enclosure._of, (self._polygons,)

    def __len__(self) -> int:
        return len(self._enclosure)

    @property
    def polygons(self) -> Polygons:
        """The polygons' vertices (n, 3), and where loops and polygons begin."""
        return self._polygons

    @property
    def areas(self) -> npt.NDArray[np.float64]:
        """The polygons' areas."""
        return self._enclosure.areas()

    @property
    def normals(self) -> npt.NDArray[np.float64]:
        """The polygons' unit normals (n, 3), to their fronts."""
        return self._enclosure.normals()

    def rows(
        self,
        positions: npt.ArrayLike,
        normals: npt.ArrayLike,
        owners: npt.ArrayLike | None = None,
        *,
        to: npt.ArrayLike | None = None,
        sparse: bool = False,
        progress: Progress | None = None,
    ) -> PointRows:
        """Form factors from points (n, 3) with normals (n, 3), or one for all, to polygons, all if none are named.

        Name the polygons that points lie on (-1 for none) as ``owners``: those never hide anything, though rounding
        may have moved a point through its polygon. If ``sparse``, the results are scipy's sparse arrays. ``progress``
        is called with the number of points done and of all.
        """
        places = _points(positions, normals, owners)
        ids = _ids(to)
        starts, columns, *numbers = self._enclosure.rows(places, ids, progress)
        shape = (len(starts) - 1, len(self) if ids is None else len(ids))
        if sparse:
            from scipy.sparse import csr_array

            return PointRows(*(csr_array((some, columns.astype(np.int64), starts), shape=shape) for some in numbers))
        full = np.zeros((2, *shape))
        rows = np.repeat(np.arange(shape[0]), np.diff(starts))
        for which, some in enumerate(numbers):
            full[which, rows, columns] = some
        return PointRows(*full)

    def approximate_rows(
        self,
        method: str,
        positions: npt.ArrayLike,
        normals: npt.ArrayLike,
        owners: npt.ArrayLike | None = None,
        *,
        to: npt.ArrayLike | None = None,
        **parameters: object,
    ) -> npt.NDArray[np.float64]:
        """:meth:`rows` by a method to compare with: ``"disk"``, ``"wallace"``, ``"pietrek"``, ``"visibility_index"``,
        ``"hemicube"`` (``resolution=128``), ``"baum"``, ``"single_plane"``, ``"monte_carlo"`` (``rays=4096,
        stratified=True, seed=0``) or ``"paraboloid"`` (``resolution=128``). A parameter that is not one is answered
        with those that are."""
        return self._enclosure.approximate_rows(method, parameters, _points(positions, normals, owners), _ids(to))

    def area_form_factor(
        self,
        first: int,
        to: int,
        tolerance: float | Tolerance = 1e-4,
        *,
        evaluations: int | None = None,
        bounded: bool = False,
    ) -> AreaFormFactor:
        """The form factor from one polygon to another, past all others. If ``bounded``, its error is a bound that
        holds, which takes some 50 times as long. ``evaluations`` is the most that it may take; the error says how far
        that went."""
        return AreaFormFactor(*self._enclosure.area_form_factor(first, to, _tolerance(tolerance), evaluations, bounded))

    def area_row(self, first: int, tolerance: float | Tolerance = 1e-4, *, evaluations: int | None = None) -> AreaRow:
        """The form factors from one polygon to all that it sees: a row of :meth:`matrix`."""
        _, columns, values, errors = self._enclosure.area_row(first, _tolerance(tolerance), evaluations)
        return AreaRow(columns, values, errors)

    def exchange_rows(
        self,
        first: int = 0,
        last: int | None = None,
        tolerance: float | Tolerance = 1e-4,
        *,
        evaluations: int | None = None,
        progress: Progress | None = None,
    ) -> ExchangeRows:
        """What each polygon from ``first`` to before ``last`` exchanges with those of higher numbers: part of a
        matrix, for :meth:`FactorMatrix.from_rows`. Its bits depend on the enclosure and the tolerance alone.
        ``progress`` is called with the number of pairs done and of all."""
        span = (first, len(self) if last is None else last)
        return ExchangeRows(first, *self._enclosure.exchange_rows(span, _tolerance(tolerance), evaluations, progress))

    def matrix(
        self,
        tolerance: float | Tolerance = 1e-4,
        *,
        checkpoint: str | os.PathLike[str] | None = None,
        evaluations: int | None = None,
        progress: Progress | None = None,
    ) -> FactorMatrix:
        """The form factors between all polygons. With a folder as ``checkpoint``, rows are written there as they are
        found, and a run that was ended goes on. ``progress`` is called with the number of pairs done and of all;
        Ctrl-C ends the call."""
        if checkpoint is None:
            rows = [self.exchange_rows(0, None, tolerance, evaluations=evaluations, progress=progress)]
        else:
            rows = self._resumed(Path(checkpoint), tolerance, evaluations, progress)
        return FactorMatrix.from_rows(self.areas, rows)

    def _resumed(
        self, folder: Path, tolerance: float | Tolerance, evaluations: int | None, progress: Progress | None
    ) -> list[ExchangeRows]:
        claim(folder, self.fingerprint(tolerance, evaluations))
        count, rows = len(self), []

        def pairs(row: int) -> int:
            return row * (2 * count - row - 1) // 2

        for first in range(0, count, _BLOCK):
            last = min(first + _BLOCK, count)
            path = shard(folder, first, last)

            def report(done: int, _: int, before: int = pairs(first)) -> None:
                if progress:
                    progress(before + done, pairs(count))

            if not path.exists():
                save(
                    path, self.exchange_rows(first, last, tolerance, evaluations=evaluations, progress=report)._asdict()
                )
            rows.append(ExchangeRows.load(path))
        return rows

    def fingerprint(self, tolerance: float | Tolerance = 1e-4, evaluations: int | None = None) -> str:
        """What rows depend on: the polygons, the tolerance and the version, as a SHA-256."""
        found = hashlib.sha256(repr((_formfactor.VERSION, _tolerance(tolerance), evaluations)).encode())
        for array, kind in zip(self._polygons, ("<f8", "<i8", "<i8"), strict=True):
            found.update(np.ascontiguousarray(array, dtype=kind).tobytes())
        return found.hexdigest()

    def __repr__(self) -> str:
        return f"<formfactor.Enclosure of {len(self)} polygons>"


def _tolerance(tolerance: float | Tolerance) -> float | tuple[float, float, float]:
    if isinstance(tolerance, tuple):
        absolute, relative, row = Tolerance(*tolerance)
        return float(absolute), float(relative), float(row)
    return float(tolerance)


def _ids(numbers: npt.ArrayLike | None) -> list[int] | None:
    if numbers is None:
        return None
    ids = integers(np.atleast_1d(np.asarray(numbers)), "numbers of polygons")
    if (ids < 0).any():
        raise ValueError("polygons are counted from 0")
    return [int(number) for number in ids]


def _points(
    positions: npt.ArrayLike, normals: npt.ArrayLike, owners: npt.ArrayLike | None
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.int64] | None]:
    places = doubles(np.atleast_2d(np.asarray(positions)))
    directions = doubles(np.atleast_2d(np.asarray(normals)))
    if len(directions) == 1:
        directions = np.repeat(directions, len(places), axis=0)
    if owners is None:
        return places, directions, None
    numbers = integers(np.atleast_1d(np.asarray(owners)), "owners")
    return places, directions, np.repeat(numbers, len(places)) if len(numbers) == 1 else numbers
