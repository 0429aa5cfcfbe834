"""One geometry that is asked often."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _polycsg
from ._read import points as _points
from ._read import read
from ._regions import Region, Regions


class PreparedRegion:
    """One geometry with what makes many questions about it fast, from :func:`polycsg.prepare`."""

    __slots__ = ("_prepared",)

    def __init__(self, prepared: _polycsg.Prepared) -> None:
        self._prepared = prepared

    def clip(self, geometry: object, *, fill: str = "evenodd") -> Region | Regions:
        """What geometries have in common with it: what :func:`polycsg.intersection` gives, bit for bit."""
        layer = read(geometry)
        arrays = self._prepared.clip(layer.features, fill)
        return Region(arrays) if layer.is_single else Regions(arrays, layer.missing, layer.frame)

    def locate(self, points: npt.ArrayLike) -> npt.NDArray[np.int8]:
        """Where points (n, 2) lie, exactly: 1 inside, 0 on the boundary, -1 outside."""
        return self._prepared.locate(_points(points))
