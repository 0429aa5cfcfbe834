"""The functions of the package."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _polycsg
from ._expression import Csg
from ._polycsg import GeometryError
from ._prepared import PreparedRegion
from ._read import Features, Layer, read
from ._regions import Arrays, Frame, Region, Regions

#: Which points rings enclose: those that an odd number of them goes around; those around which the windings do not
#: add to 0; or add
#: to more than 0.
Fill: TypeAlias = Literal["evenodd", "nonzero", "positive"]


def union(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in ``a`` or in ``b``. Arrays go one by one; a single geometry goes with all of an array.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> union(square, square + 1).area
    7.0
    """
    return evaluate(Csg(a) | Csg(b), fill=fill)


def intersection(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in ``a`` and in ``b``. Geometries that only touch have nothing in common.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> intersection([square, square + 9], square + 1).area
    array([1., 0.])
    """
    return evaluate(Csg(a) & Csg(b), fill=fill)


def difference(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in ``a`` that are not in ``b``.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> difference(square, square + 1).area
    3.0
    """
    return evaluate(Csg(a) - Csg(b), fill=fill)


def symmetric_difference(a: object, b: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """All points in one of ``a`` and ``b`` but not in the other.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> symmetric_difference(square, square + 1).area
    6.0
    """
    return evaluate(Csg(a) ^ Csg(b), fill=fill)


def evaluate(expression: Csg, *, fill: Fill = "evenodd") -> Region | Regions:
    """The region of an expression, found in one arrangement: nothing is rounded in between. With arrays in it, one
    for each feature.

    >>> import numpy as np
    >>> from polycsg import Csg
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> evaluate((Csg(square) | Csg(square + 1)) - Csg(square + 0.5)).area
    3.5
    """
    operands, program = expression.postfix()
    layers = [read(operand) for operand in operands]
    arrays = _polycsg.evaluated([layer.features for layer in layers], program, fill)
    if all(layer.is_single for layer in layers):
        return Region(arrays)
    count = len(arrays[3]) - 1
    masks = [np.broadcast_to(layer.missing, count) for layer in layers if layer.missing is not None]
    return Regions(arrays, np.logical_or.reduce(masks) if masks else None, _frame(layers, count))


def _frame(layers: Sequence[Layer], count: int) -> Frame | None:
    """What all layers have in common: their index and their coordinates' system."""
    frames = [layer.frame for layer in layers if layer.frame is not None]
    systems = [frame.crs for frame in frames if frame.crs is not None]
    if any(crs != systems[0] for crs in systems):
        raise GeometryError("the coordinates' systems differ; convert one by to_crs")
    indexes = [frame.index for frame in frames if frame.index is not None and len(frame.index) == count]
    if any(not index.equals(indexes[0]) for index in indexes):
        raise GeometryError("the indexes differ; align one with the other, or drop both by reset_index")
    return Frame(indexes[0] if indexes else None, systems[0] if systems else None) if frames else None


def unary_union(geometries: object, *, fill: Fill = "evenodd") -> Region:
    """All points in any of the geometries, whatever their order: the bytes are the same. Missing ones are left out.

    >>> import numpy as np
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> unary_union([square, square + 1, square + 2]).area
    10.0
    """
    return Region(_polycsg.united(read(geometries).features, fill))


def make_valid(geometry: object, *, fill: Fill = "evenodd") -> Region | Regions:
    """What the rings enclose, as valid polygons.

    >>> import numpy as np
    >>> bow_tie = np.array([[0, 0], [2, 2], [2, 0], [0, 2]])
    >>> make_valid(bow_tie)
    <polycsg.Region of 2 polygons, 6 vertices>
    """
    layer = read(geometry)
    return _given(_polycsg.repaired(layer.features, fill), layer)


def _given(arrays: Arrays, layer: Layer) -> Region | Regions:
    return Region(arrays) if layer.is_single else Regions(arrays, layer.missing, layer.frame)


def is_valid(geometry: object) -> bool | npt.NDArray[np.bool_]:
    """Whether geometries are valid as they are, in the sense of OGC's simple features (:func:`shapely.is_valid` asks
    the same), decided exactly. A ring may be closed or not, and run either way. A missing geometry is not valid.

    >>> import numpy as np
    >>> is_valid(np.array([[0, 0], [2, 2], [2, 0], [0, 2]]))
    False
    """
    layer = read(geometry)
    valid = np.array([flaw is None for flaw in _polycsg.flaws(layer.features)], dtype=bool)
    if layer.missing is not None:
        valid &= ~layer.missing
    return bool(valid[0]) if layer.is_single else valid


def is_valid_reason(geometry: object) -> str | npt.NDArray[np.object_]:
    """Why a geometry is not valid, where: rings and vertices are counted from 0 through a geometry. "valid" if it is.

    >>> import numpy as np
    >>> is_valid_reason(np.array([[0, 0], [2, 2], [2, 0], [0, 2]]))
    'ring 0, vertex 0: the edge from there crosses or covers another edge'
    """
    layer = read(geometry)
    reasons = np.array([flaw or "valid" for flaw in _polycsg.flaws(layer.features)], dtype=object)
    if layer.missing is not None:
        reasons[layer.missing] = "missing"
    return str(reasons[0]) if layer.is_single else reasons


def area(geometry: object, *, fill: Fill = "evenodd") -> float | npt.NDArray[np.float64]:
    """The area of what the rings enclose; NaN where a geometry is missing.

    >>> import numpy as np
    >>> area(np.array([[0, 0], [2, 0], [2, 2], [0, 2]]))
    4.0
    """
    layer = read(geometry)
    areas = _polycsg.areas(layer.features, fill)
    if layer.missing is not None:
        areas[layer.missing] = np.nan
    return float(areas[0]) if layer.is_single else areas


def locate(geometry: object, points: npt.ArrayLike, *, fill: Fill = "evenodd") -> npt.NDArray[np.int8]:
    """Where points (n, 2) lie in one geometry, exactly: 1 inside, 0 on the boundary, -1 outside (also those that are
    not finite).

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


def triangulate(geometry: object, *, fill: Fill = "evenodd") -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Constrained Delaunay triangles (n, 3, 2), counter-clockwise, and the number of the geometry that each is of.

    >>> import numpy as np
    >>> triangles, owners = triangulate(np.array([[0, 0], [2, 0], [2, 2], [0, 2]]))
    >>> triangles.shape, owners
    ((2, 3, 2), array([0, 0]))
    """
    return _polycsg.triangles(read(geometry).features, fill)


def _single(geometry: object) -> Features:
    layer = read(geometry)
    if layer.size() != 1 or layer.missing is not None:
        raise GeometryError(f"one geometry is wanted, not {layer.size()}; unary_union makes one of many")
    return layer.features
