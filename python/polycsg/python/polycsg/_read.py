"""Geometries in the forms that people have, as ragged arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._polycsg import GeometryError
from ._regions import Arrays, Region, Regions

#: What stands for a geometry that is not there.
_MISSING = (None, "nan")


class Layer(NamedTuple):
    """Geometries as read."""

    arrays: Arrays
    #: Whether it was one geometry, not an array of them.
    is_single: bool
    missing: npt.NDArray[np.bool_] | None


def read(geometry: object) -> Layer:
    """Reads one geometry or an array of them."""
    if isinstance(geometry, Region):
        return Layer(geometry._arrays, True, None)
    if isinstance(geometry, Regions):
        return Layer(geometry._arrays, False, geometry._missing)
    if isinstance(geometry, np.ndarray) and geometry.dtype != object:
        return _of_ring(geometry)
    if _is_ragged(geometry):
        return _of_ragged(geometry)  # type: ignore[arg-type]
    if _is_shapely(geometry):
        return _of_shapely(np.array([geometry], dtype=object))._replace(is_single=True)
    if hasattr(geometry, "geometry") and hasattr(geometry, "crs"):
        geometry = geometry.geometry  # a GeoDataFrame's, or a GeoSeries itself
    if hasattr(geometry, "__array__") or isinstance(geometry, np.ndarray):
        return _of_objects(np.asarray(geometry, dtype=object))
    if isinstance(geometry, Mapping) or hasattr(geometry, "__geo_interface__"):
        return _of_interface(geometry)
    if isinstance(geometry, Iterable) and not isinstance(geometry, str | bytes):
        return _of_objects(_objects(list(geometry)))
    raise GeometryError(f"a {type(geometry).__name__} is no geometry that can be read")


def _objects(values: Sequence[object]) -> npt.NDArray[np.object_]:
    found = np.empty(len(values), dtype=object)
    for place, value in enumerate(values):
        found[place] = value
    return found


def _is_shapely(value: object) -> bool:
    return type(value).__module__.partition(".")[0] == "shapely"


def _is_missing(value: object) -> bool:
    return value is None or (isinstance(value, float) and value != value)


def _is_ragged(value: object) -> bool:
    if not isinstance(value, tuple) or len(value) != 2:
        return False
    coordinates, offsets = value
    return isinstance(coordinates, np.ndarray) and isinstance(offsets, tuple)


def _doubles(coordinates: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    if coordinates.ndim != 2 or coordinates.shape[1] != 2:
        raise GeometryError(f"coordinates have the shape (n, 2), not {coordinates.shape}")
    if coordinates.dtype.kind not in "fiu":
        raise GeometryError(f"coordinates are numbers, not {coordinates.dtype}")
    return np.ascontiguousarray(coordinates, dtype=np.float64)


def _of_ring(ring: npt.NDArray[Any]) -> Layer:
    ring = _doubles(ring)
    one = np.array([0, 1])
    return Layer((ring, np.array([0, len(ring)]), one, one), True, None)


def _of_ragged(value: tuple[npt.NDArray[Any], tuple[npt.NDArray[Any], ...]]) -> Layer:
    coordinates, offsets = value
    if len(offsets) not in (2, 3):
        raise GeometryError(f"polygons have 2 arrays of offsets and multipolygons 3, not {len(offsets)}")
    rings, polygons, *rest = [_integers(np.asarray(array)) for array in offsets]
    features = rest[0] if rest else np.arange(len(polygons))
    return Layer((_doubles(coordinates), rings, polygons, features), False, None)


def _integers(offsets: npt.NDArray[Any]) -> npt.NDArray[np.int64] | npt.NDArray[np.int32]:
    if offsets.ndim != 1 or offsets.dtype.kind not in "iu":
        raise GeometryError(f"offsets are one row of integers, not {offsets.dtype} of shape {offsets.shape}")
    if offsets.dtype == np.int32:
        return np.ascontiguousarray(offsets)
    return np.ascontiguousarray(offsets, dtype=np.int64)


def _of_shapely(values: npt.NDArray[np.object_]) -> Layer:
    import shapely

    missing = np.array([_is_missing(value) for value in values])
    kinds = shapely.get_type_id(values)
    wanted = [shapely.GeometryType.POLYGON, shapely.GeometryType.MULTIPOLYGON]
    others = ~missing & ~np.isin(kinds, wanted)
    if others.any():
        feature = int(np.flatnonzero(others)[0])
        raise GeometryError(f"feature {feature}: a {values[feature].geom_type} has no area; give polygons")
    if missing.any():
        values = np.where(missing, shapely.Polygon(), values)
    if len(values) == 0:
        return _joined([], None)
    _, coordinates, offsets = shapely.to_ragged_array(values, include_z=False)
    layer = _of_ragged((coordinates, offsets))
    return layer._replace(missing=missing if missing.any() else None)


def _of_objects(values: npt.NDArray[np.object_]) -> Layer:
    if values.ndim != 1:
        raise GeometryError(f"an array of geometries has one dimension, not {values.ndim}")
    if all(_is_missing(value) or _is_shapely(value) for value in values) and any(map(_is_shapely, values)):
        return _of_shapely(values)
    missing = np.array([_is_missing(value) for value in values], dtype=bool)
    parts = []
    for feature, value in enumerate(values):
        try:
            part = _joined([], None) if missing[feature] else read(value)
        except GeometryError as error:
            raise GeometryError(f"feature {feature}: {error}") from None
        parts.append(part.arrays)
    return _joined(parts, missing if missing.any() else None)


def _joined(parts: Sequence[Arrays], missing: npt.NDArray[np.bool_] | None) -> Layer:
    """One feature of each part."""
    coordinates = np.concatenate([np.empty((0, 2)), *(part[0] for part in parts)])

    def chained(level: int) -> npt.NDArray[np.int64]:
        found, end = [np.zeros(1, dtype=np.int64)], 0
        for part in parts:
            offsets = part[level].astype(np.int64)
            found.append(offsets[1:] + end)
            end += int(offsets[-1])
        return np.concatenate(found)

    rings, polygons = chained(1), chained(2)
    counts = [len(part[2]) - 1 for part in parts]
    features = np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(counts, dtype=np.int64)])
    return Layer((coordinates, rings, polygons, features), False, missing)


def _of_interface(value: object) -> Layer:
    mapping: Any = value if isinstance(value, Mapping) else value.__geo_interface__  # type: ignore[attr-defined]
    kind = mapping.get("type")
    if kind == "Feature":
        return _of_interface(mapping["geometry"])
    if kind == "FeatureCollection":
        return _of_objects(_objects([feature["geometry"] for feature in mapping["features"]]))
    if kind == "Polygon":
        return _of_polygons([mapping["coordinates"]])
    if kind == "MultiPolygon":
        return _of_polygons(mapping["coordinates"])
    raise GeometryError(f"a {kind} has no area; give a Polygon or a MultiPolygon")


def _of_polygons(polygons: Sequence[Sequence[Any]]) -> Layer:
    rings = [_doubles(np.array([point[:2] for point in ring], dtype=float)) for polygon in polygons for ring in polygon if len(ring)]
    ends = np.cumsum([0, *map(len, rings)])
    counts = [sum(1 for ring in polygon if len(ring)) for polygon in polygons]
    coordinates = np.concatenate([np.empty((0, 2)), *rings])
    return Layer((coordinates, ends, np.cumsum([0, *counts]), np.array([0, len(polygons)])), True, None)
