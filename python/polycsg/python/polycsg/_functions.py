"""The functions of the package."""

from __future__ import annotations

from typing import Literal, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from . import _polycsg
from ._expression import Csg
from ._polycsg import GeometryError
from ._prepared import PreparedRegion
from ._read import Layer, read
from ._regions import Arrays, Region, Regions

#: Which points rings enclose: those that an odd number of them goes around; those around which the windings do not add to 0; or add
#: to more than 0.
Fill: TypeAlias = Literal["evenodd", "nonzero", "positive"]


def union(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in ``a`` or in ``b``. Arrays go one by one; a single geometry goes with all of an array.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> union(square, square + 1).area
    7.0
    """
    return _overlay("union", a, b, fill)


def intersection(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in ``a`` and in ``b``. Geometries that only touch have nothing in common.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> intersection([square, square + 9], square + 1).area
    array([1., 0.])
    """
    return _overlay("intersection", a, b, fill)


def difference(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in ``a`` that are not in ``b``.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> difference(square, square + 1).area
    3.0
    """
    return _overlay("difference", a, b, fill)


def symmetric_difference(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in one of ``a`` and ``b`` but not in the other.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> symmetric_difference(square, square + 1).area
    6.0
    """
    return _overlay("symmetric_difference", a, b, fill)


def _overlay(operation: str, a: object, b: object, fill: Fill) -> Region | Regions:
    one, other = read(a), read(b)
    arrays = _polycsg.overlay(operation, one.arrays, other.arrays, fill)
    if one.is_single and other.is_single:
        return Region(arrays)
    missing = [layer.missing for layer in (one, other) if layer.missing is not None]
    if not missing:
        return Regions(arrays)
    count = len(arrays[3]) - 1
    return Regions(arrays, np.logical_or.reduce([np.broadcast_to(mask, count) for mask in missing]))


def evaluate(expression: Csg, *, fill: Fill = "evenodd") -> Region:
    """The region of an expression of single geometries, found in one arrangement: nothing is rounded in between.

    >>> import numpy as np
    >>> from polycsg import Csg
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> evaluate((Csg(square) | Csg(square + 1)) - Csg(square + 0.5)).area
    3.5
    """
    operands, program = expression.postfix()
    return Region(_polycsg.evaluated([_single(operand) for operand in operands], program, fill))


def unary_union(geometries: object, *, fill: Fill = "evenodd") -> Region:
    """All points in any of the geometries, whatever their order: the bytes are the same. Missing ones are left out.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> unary_union([square, square + 1, square + 2]).area
    10.0
    """
    return Region(_polycsg.united(read(geometries).arrays, fill))


@overload
def make_valid(geometry: Region, *, fill: Fill = "evenodd") -> Region: ...
@overload
def make_valid(geometry: object, *, fill: Fill = "evenodd") -> Region | Regions: ...
def make_valid(geometry: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """What the rings enclose, as valid polygons.

    >>> import numpy as np
    >>> bow_tie = np.array([[0, 0], [2, 2], [2, 0], [0, 2]])
    >>> make_valid(bow_tie)
    <polycsg.Region of 2 polygons, 6 vertices>
    """
    layer = read(geometry)
    arrays = _polycsg.repaired(layer.arrays, fill)
    return Region(arrays) if layer.is_single else Regions(arrays, layer.missing)


def area(geometry: object, *, fill: Fill = "evenodd") -> float | npt.NDArray[np.float64]:
    """The area of what the rings enclose; NaN where a geometry is missing.

    >>> import numpy as np
    >>> area(np.array([[0, 0], [2, 0], [2, 2], [0, 2]]))
    4.0
    """
    layer = read(geometry)
    areas = _polycsg.areas(layer.arrays, fill)
    if layer.is_single:
        return float(areas[0])
    if layer.missing is not None:
        areas[layer.missing] = np.nan
    return areas


def locate(geometry: object, points: npt.ArrayLike, *, fill: Fill = "evenodd") -> npt.NDArray[np.int8]:
    """Where points (n, 2) lie in one geometry, exactly: 1 inside, 0 on the boundary, -1 outside (also those that are not finite).

    >>> import numpy as np
    >>> locate(np.array([[0, 0], [2, 0], [2, 2], [0, 2]]), [[1, 1], [2, 1], [3, 1]])
    array([ 1,  0, -1], dtype=int8)
    """
    return prepare(geometry, fill=fill).locate(points)


def prepare(geometry: object, *, fill: Fill = "evenodd") -> PreparedRegion:
    """One geometry with what makes many questions about it fast.

    >>> import numpy as np
    >>> clip = prepare(np.array([[0, 0], [9, 0], [9, 9], [0, 9]]))
    >>> tile = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> clip.clip([tile + 1, tile + 8, tile + 20]).area
    array([4., 1., 0.])
    """
    return PreparedRegion(_polycsg.Prepared(_single(geometry), fill))


def triangulate(
    geometry: object, *, fill: Fill = "evenodd"
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Constrained Delaunay triangles (n, 3, 2), counter-clockwise, and the number of the geometry that each is of.

    >>> import numpy as np
    >>> triangles, owners = triangulate(np.array([[0, 0], [2, 0], [2, 2], [0, 2]]))
    >>> triangles.shape, owners
    ((2, 3, 2), array([0, 0]))
    """
    return _polycsg.triangles(read(geometry).arrays, fill)


def _single(geometry: object) -> Arrays:
    layer: Layer = read(geometry)
    if not layer.is_single and len(layer.arrays[3]) != 2:
        raise GeometryError(f"one geometry is wanted, not {len(layer.arrays[3]) - 1}")
    return layer.arrays
