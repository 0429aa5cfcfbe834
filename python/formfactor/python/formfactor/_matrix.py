"""Matrices of form factors between polygons."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _formfactor
from ._read import integers
from ._shards import ExchangeRows

if TYPE_CHECKING:
    from scipy.sparse import csr_array


class FactorMatrix:
    """Form factors between polygons, as compressed sparse rows: row i has the factors from polygon i; what is not
    seen has no entry.

    :meth:`Enclosure.matrix` finds one. Of the methods that change something each gives a new matrix.
    """

    __slots__ = ("_has_space", "_matrix", "_parts")

    def __init__(self, matrix: _formfactor.Matrix, has_space: bool = False) -> None:
        self._matrix = matrix
        self._has_space = has_space
        self._parts = matrix.parts()
        for array in self._parts:
            array.flags.writeable = False

    @classmethod
    def from_rows(cls, areas: npt.NDArray[np.float64], rows: Sequence[ExchangeRows]) -> FactorMatrix:
        """The matrix of polygons with these areas from rows in any order. Of rows that are missing nothing is known
        but what others say."""
        shards = [(some.first, some.starts, some.to, some.area, some.error) for some in rows]
        return cls(_formfactor.Matrix(np.ascontiguousarray(areas, dtype=np.float64), shards))

    @property
    def areas(self) -> npt.NDArray[np.float64]:
        """Each polygon's area."""
        return self._parts[0]

    @property
    def starts(self) -> npt.NDArray[np.int64]:
        """Where each row begins in the other arrays, and where the last one ends."""
        return self._parts[1]

    @property
    def columns(self) -> npt.NDArray[np.uint32]:
        """The receivers, row after row."""
        return self._parts[2]

    @property
    def values(self) -> npt.NDArray[np.float64]:
        """The factors, row after row."""
        return self._parts[3]

    @property
    def errors(self) -> npt.NDArray[np.float64]:
        """Estimates of the factors' errors, row after row."""
        return self._parts[4]

    def __len__(self) -> int:
        return len(self.areas)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        raise TypeError("a FactorMatrix is not pickled; keep its rows, or to_scipy()")

    @property
    def defects(self) -> npt.NDArray[np.float64]:
        """What each row lacks of 1: in a closed room an error, elsewhere what escapes."""
        return self._matrix.defects()

    def to_scipy(self) -> csr_array:
        """The factors as a sparse array."""
        return self._sparse(self.values)

    def errors_to_scipy(self) -> csr_array:
        """The estimates of the errors as a sparse array, with entries where the factors have them."""
        return self._sparse(self.errors)

    def _sparse(self, numbers: npt.NDArray[np.float64]) -> csr_array:
        from scipy.sparse import csr_array

        shape = (len(self), len(self) + self._has_space)
        return csr_array((numbers, self.columns.astype(np.int64), self.starts), shape=shape)

    def with_space(self) -> FactorMatrix:
        """With one more receiver, the last: space, or the sky, to which all that escapes goes. So the rows of open
        scenes add to 1."""
        if self._has_space:
            return self
        return FactorMatrix(self._matrix.with_space(), has_space=True)

    def without_below(self, threshold: float) -> FactorMatrix:
        """Without factors below a threshold; the sums of the rows stay. :meth:`closed` brings reciprocity back."""
        return FactorMatrix(self._matrix.without_below(threshold), self._has_space)

    def closed(self) -> Closure:
        """Of a closed room: the matrix with rows that add to 1 and A_i F_ij = A_j F_ji that differs least, by least
        squares."""
        matrix, defect, change = self._matrix.closed()
        return Closure(FactorMatrix(matrix), defect, change)

    def grouped(self, groups: npt.ArrayLike) -> FactorMatrix:
        """Of groups of polygons, named by a number for each polygon, from 0 without a gap: the sides of a plate, the
        parts of a wall."""
        return FactorMatrix(self._matrix.grouped(integers(groups, "groups")), self._has_space)

    def with_emittances(self, emittances: npt.ArrayLike) -> FactorMatrix:
        """Hottel's total exchange factors of gray surfaces: what i emits and j absorbs, directly or by reflections,
        as a share of what i would emit if it were black. The matrix is full."""
        return FactorMatrix(self._matrix.with_emittances(np.ascontiguousarray(emittances, dtype=np.float64)))

    def sha256(self) -> str:
        """A fingerprint of all rows, bit for bit, whatever blocks they were found in: :func:`formfactor.dask.sha256`
        gives the same."""
        found = RowHash()
        found.add(self.starts, self.columns, self.values, self.errors)
        return found.hexdigest()

    def __repr__(self) -> str:
        return f"<formfactor.FactorMatrix: {len(self)} rows, {len(self.values)} factors>"


class Closure(NamedTuple):
    """What :meth:`FactorMatrix.closed` gives."""

    matrix: FactorMatrix
    #: The largest defect of a row before.
    defect: float
    #: The largest change of a factor.
    change: float


class RowHash:
    """A hash of rows that does not depend on how many are added at once."""

    def __init__(self) -> None:
        self._parts = [hashlib.sha256() for _ in range(4)]

    def add(
        self,
        starts: npt.NDArray[np.int64],
        columns: npt.NDArray[np.uint32],
        values: npt.NDArray[np.float64],
        errors: npt.NDArray[np.float64],
    ) -> None:
        """Adds the rows that come next."""
        counts = np.diff(starts)
        for part, array, kind in zip(
            self._parts, (counts, columns, values, errors), ("<i8", "<u4", "<f8", "<f8"), strict=True
        ):
            part.update(np.ascontiguousarray(array, dtype=kind).tobytes())

    def hexdigest(self) -> str:
        """The fingerprint."""
        return hashlib.sha256(b"".join(part.digest() for part in self._parts)).hexdigest()
