"""Regions: what the functions give back."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from . import _polycsg

if TYPE_CHECKING:
    import geopandas
    import shapely

Coordinates: TypeAlias = npt.NDArray[np.float64]
Offsets: TypeAlias = npt.NDArray[np.int64] | npt.NDArray[np.int32]
Arrays: TypeAlias = tuple[Coordinates, Offsets, Offsets, Offsets]


class Frame(NamedTuple):
    """What a GeoSeries has beside its geometries."""

    index: Any
    #: The coordinates' system, as pyproj or PROJJSON has it.
    crs: Any


class Regions:
    """An array of regions: sets of points bounded by polygons with holes, some of them perhaps missing.

    The vertices are one array (n, 2). ``offsets`` says where rings begin in the vertices, polygons in the rings, and
    regions in the polygons: the layout of GeoArrow's multipolygons and of :func:`shapely.to_ragged_array`. Outer
    rings run counter-clockwise, holes clockwise, and each ends with its first vertex.
    """

    __slots__ = ("_arrays", "_frame", "_missing")

    def __init__(
        self, arrays: Arrays, missing: npt.NDArray[np.bool_] | None = None, frame: Frame | None = None
    ) -> None:
        for array in arrays:
            array.flags.writeable = False
        self._arrays = arrays
        self._missing = missing
        self._frame = frame

    def __reduce__(self) -> tuple[type[Regions], tuple[object, ...]]:
        return Regions, (self._arrays, self._missing, self._frame)

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

    @overload
    def __getitem__(self, place: int) -> Region | None: ...
    @overload
    def __getitem__(self, place: slice | npt.NDArray[Any] | list[Any]) -> Regions: ...
    def __getitem__(self, place: int | slice | npt.NDArray[Any] | list[Any]) -> Region | Regions | None:
        chosen = np.arange(len(self))[place]
        if chosen.ndim == 1:
            missing = None if self._missing is None else self._missing[chosen]
            frame = self._frame
            if frame is not None and frame.index is not None:
                frame = frame._replace(index=frame.index[chosen])
            return Regions(self._of(chosen), missing, frame)
        if self._missing is not None and self._missing[chosen]:
            return None
        return Region(self._of(chosen.reshape(1)))

    def _of(self, places: npt.NDArray[np.int64]) -> Arrays:
        """The arrays of some of them, in any order."""
        coordinates, rings, polygons, regions = self._arrays
        found = []
        for offsets in (regions, polygons, rings):
            counts = np.diff(offsets)[places]
            ends = np.concatenate([[0], np.cumsum(counts)])
            # From where each part begins on, one by one.
            places = np.repeat(offsets[places] - ends[:-1], counts) + np.arange(ends[-1])
            found.append(ends)
        return coordinates[places], found[2], found[1], found[0]

    def __iter__(self) -> Iterator[Region | None]:
        return (self[place] for place in range(len(self)))

    def to_ragged(self) -> tuple[Coordinates, tuple[Offsets, Offsets, Offsets]]:
        """Vertices and offsets, as :func:`shapely.from_ragged_array` takes those of multipolygons. Nothing is
        copied."""
        return self.coordinates, self.offsets

    def to_shapely(self) -> npt.NDArray[np.object_]:
        """An array of shapely multipolygons, None where a region is missing."""
        import shapely

        kind = shapely.GeometryType.MULTIPOLYGON
        found: npt.NDArray[np.object_] = shapely.from_ragged_array(kind, self.coordinates, self.offsets)
        found[self.missing] = None
        return found

    def to_wkb(self) -> list[bytes | None]:
        """Each region as well-known binary, None where it is missing."""
        found = _polycsg.to_wkb(self._arrays)
        return [None if gone else bytes for bytes, gone in zip(found, self.missing, strict=True)]

    def to_geopandas(self) -> geopandas.GeoSeries:
        """A GeoSeries, with the index and the coordinates' system of the one that the regions were made from."""
        import geopandas

        frame = self._frame or Frame(None, None)
        return geopandas.GeoSeries(self.to_shapely(), index=frame.index, crs=frame.crs)

    def __arrow_c_array__(self, requested_schema: object | None = None) -> tuple[object, object]:
        """GeoArrow's multipolygons, for whatever reads Arrow; of a wish for another schema nothing is heard, as the
        interface allows."""
        crs: Any = self._frame.crs if self._frame else None
        if hasattr(crs, "to_json_dict"):
            crs = crs.to_json_dict()
        metadata = json.dumps({"crs": crs, "crs_type": "projjson"}) if crs else None
        present = None if self._missing is None else ~self._missing
        schema, array = _polycsg.to_arrow(self._arrays, present, metadata)
        return schema, array

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Regions):
            return NotImplemented
        mine, its = (*self._arrays, self.missing), (*other._arrays, other.missing)
        return all(map(np.array_equal, mine, its))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<polycsg.Regions: {len(self)}, with {len(self.coordinates)} vertices>"


class Region:
    """A set of points bounded by polygons with holes: one of :class:`Regions`."""

    __slots__ = ("_arrays",)

    def __init__(self, arrays: Arrays) -> None:
        for array in arrays:
            array.flags.writeable = False
        self._arrays = arrays

    def __reduce__(self) -> tuple[type[Region], tuple[object, ...]]:
        return Region, (self._arrays,)

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
        import shapely

        kind = shapely.GeometryType.MULTIPOLYGON
        whole = shapely.from_ragged_array(kind, self._arrays[0], self._arrays[1:])[0]
        return whole.geoms[0] if len(whole.geoms) == 1 else whole

    def to_wkb(self) -> bytes:
        """Well-known binary: a multipolygon."""
        return _polycsg.to_wkb(self._arrays)[0]

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
