"""Regions: what the functions give back."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _polycsg

if TYPE_CHECKING:
    import shapely

Coordinates: TypeAlias = npt.NDArray[np.float64]
Offsets: TypeAlias = npt.NDArray[np.int64] | npt.NDArray[np.int32]
Arrays: TypeAlias = tuple[Coordinates, Offsets, Offsets, Offsets]


class Regions:
    """An array of regions: sets of points bounded by polygons with holes, some of them perhaps missing.

    The vertices are one array (n, 2). ``offsets`` says where rings begin in the vertices, polygons in the rings, and regions in the
    polygons: the layout of GeoArrow's multipolygons and of :func:`shapely.to_ragged_array`. Outer rings run counter-clockwise, holes
    clockwise, and each ends with its first vertex.
    """

    __slots__ = ("_arrays", "_missing")

    def __init__(self, arrays: Arrays, missing: npt.NDArray[np.bool_] | None = None) -> None:
        for array in arrays:
            array.flags.writeable = False
        self._arrays = arrays
        self._missing = missing

    @property
    def coordinates(self) -> Coordinates:
        """The vertices (n, 2), read-only."""
        return self._arrays[0]

    @property
    def offsets(self) -> tuple[Offsets, Offsets, Offsets]:
        """Where rings, polygons and regions begin, and where the last ends; read-only."""
        return self._arrays[1:]

    @property
    def missing(self) -> npt.NDArray[np.bool_]:
        """Which regions are missing: those made from a missing geometry."""
        return np.zeros(len(self), dtype=bool) if self._missing is None else self._missing

    @property
    def area(self) -> npt.NDArray[np.float64]:
        """The area of each region, NaN where it is missing."""
        areas = _polycsg.areas(self._arrays, "positive")
        areas[self.missing] = np.nan
        return areas

    def __len__(self) -> int:
        return len(self._arrays[3]) - 1

    def __getitem__(self, place: int) -> Region | None:
        count = len(self)
        if not -count <= place < count:
            raise IndexError(f"there are {count} regions, none has the number {place}")
        place %= count
        if self._missing is not None and self._missing[place]:
            return None
        coordinates, rings, polygons, regions = self._arrays
        first, last = regions[place], regions[place + 1]
        polygons = polygons[first : last + 1]
        rings = rings[polygons[0] : polygons[-1] + 1]
        arrays = (
            coordinates[rings[0] : rings[-1]],
            rings - rings[0],
            polygons - polygons[0],
            np.array([0, last - first]),
        )
        return Region(arrays)

    def __iter__(self) -> Iterator[Region | None]:
        return (self[place] for place in range(len(self)))

    def to_ragged(self) -> tuple[Coordinates, tuple[Offsets, Offsets, Offsets]]:
        """Vertices and offsets, as :func:`shapely.from_ragged_array` takes those of multipolygons. Nothing is copied."""
        return self.coordinates, self.offsets

    def to_shapely(self) -> npt.NDArray[np.object_]:
        """An array of shapely multipolygons, None where a region is missing."""
        import shapely

        kind = shapely.GeometryType.MULTIPOLYGON
        found: npt.NDArray[np.object_] = shapely.from_ragged_array(kind, self.coordinates, self.offsets)
        found[self.missing] = None
        return found

    def __repr__(self) -> str:
        return f"<polycsg.Regions: {len(self)}, with {len(self.coordinates)} vertices>"


class Region:
    """A set of points bounded by polygons with holes: one of :class:`Regions`."""

    __slots__ = ("_arrays",)

    def __init__(self, arrays: Arrays) -> None:
        for array in arrays:
            array.flags.writeable = False
        self._arrays = arrays

    @property
    def area(self) -> float:
        """The area."""
        return float(_polycsg.areas(self._arrays, "positive")[0])

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing in it."""
        return len(self._arrays[0]) == 0

    @property
    def polygons(self) -> list[list[Coordinates]]:
        """The rings of each polygon, the outer one first; each ends with its first vertex."""
        coordinates, rings, polygons, _ = self._arrays
        ring = [coordinates[first:last] for first, last in zip(rings, rings[1:], strict=False)]
        return [ring[first:last] for first, last in zip(polygons, polygons[1:], strict=False)]

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        polygons = tuple(
            tuple(tuple((float(x), float(y)) for x, y in ring) for ring in polygon) for polygon in self.polygons
        )
        if len(polygons) == 1:
            return {"type": "Polygon", "coordinates": polygons[0]}
        return {"type": "MultiPolygon", "coordinates": polygons}

    def to_shapely(self) -> shapely.Polygon | shapely.MultiPolygon:
        """A shapely polygon, or a multipolygon where there are none or several."""
        import shapely.geometry

        return shapely.geometry.shape(self.__geo_interface__)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Region):
            return NotImplemented
        return all(np.array_equal(mine, its) for mine, its in zip(self._arrays, other._arrays, strict=True))

    def __hash__(self) -> int:
        return hash(self._arrays[0].tobytes())

    def __bool__(self) -> bool:
        return not self.is_empty

    def __repr__(self) -> str:
        count, vertices = len(self.polygons), len(self._arrays[0]) - (len(self._arrays[1]) - 1)
        return f"<polycsg.Region of {count} polygon{'' if count == 1 else 's'}, {vertices} vertices>"
