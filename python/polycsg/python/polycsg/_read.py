"""Geometries in the forms that people have, as ragged arrays."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _polycsg
from ._polycsg import GeometryError, HeldFeatures, no_polygon
from ._regions import Frame, Offsets, Region, Regions

#: Vertices, and offsets of rings, polygons and features; none where each is of one. Or what is held beyond the
#: border.
Features: TypeAlias = tuple[npt.NDArray[np.float64], Offsets, Offsets | None, Offsets | None] | HeldFeatures

#: Doubles hold all integers up to this.
_EXACT = 2**53


class Layer(NamedTuple):
    """Geometries as read."""

    features: Features
    #: Whether it was one geometry, not an array of them.
    is_single: bool = False
    #: Which are missing; none if none is.
    missing: npt.NDArray[np.bool_] | None = None
    frame: Frame | None = None

    def size(self) -> int:
        """How many there are."""
        if isinstance(self.features, HeldFeatures):
            return len(self.features)
        return next(len(offsets) - 1 for offsets in reversed(self.features[1:]) if offsets is not None)


def read(geometry: object) -> Layer:
    """Reads one geometry or an array of them."""
    if isinstance(geometry, Region):
        return Layer(geometry._arrays, is_single=True)
    if isinstance(geometry, Regions):
        return Layer(geometry._arrays, missing=geometry._missing, frame=geometry._frame)
    if isinstance(geometry, np.ndarray):
        return _of_objects(geometry) if geometry.dtype == object else _of_numbers(geometry)
    if _is_ragged(geometry):
        return _of_ragged(*geometry)  # type: ignore[misc]
    if isinstance(geometry, bytes):
        return _of_held(_polycsg.of_wkb([geometry]))._replace(is_single=True)
    if _is_shapely(geometry):
        return _of_shapely(_objects([geometry]), np.zeros(1, dtype=bool))._replace(is_single=True)
    if hasattr(geometry, "iloc") and hasattr(geometry, "to_numpy"):
        return _of_pandas(geometry)
    if hasattr(geometry, "__arrow_c_array__") or hasattr(geometry, "__arrow_c_stream__"):
        return _of_held(_polycsg.of_arrow(geometry))
    if isinstance(geometry, Mapping) or hasattr(geometry, "__geo_interface__"):
        try:
            return _of_interface(geometry)
        except (KeyError, IndexError, TypeError) as error:
            raise GeometryError(f"this is no GeoJSON: {error!r}") from None
    if hasattr(geometry, "__array__"):
        return read(np.asarray(geometry))
    if isinstance(geometry, Iterable) and not isinstance(geometry, str):
        values = list(geometry)
        return _of_numbers(_stacked(values)) if _is_ring(values) else _of_objects(_objects(values))
    raise GeometryError(f"a {type(geometry).__name__} is no geometry that can be read")


def doubles(coordinates: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Coordinates as doubles, the same numbers; they are not copied if they are that already."""
    if np.ma.is_masked(coordinates):
        raise GeometryError("coordinates are masked; leave out what is missing")
    if coordinates.shape[-1:] != (2,):
        raise GeometryError(f"coordinates have the shape (n, 2), not {coordinates.shape}")
    if coordinates.dtype.kind not in "fiu" or coordinates.dtype.itemsize > 8:
        raise GeometryError(f"coordinates are numbers that fit in doubles, not {coordinates.dtype}")
    is_long = coordinates.dtype.kind != "f" and coordinates.dtype.itemsize == 8
    if is_long and coordinates.size and (coordinates.max() > _EXACT or coordinates.min() < -_EXACT):
        raise GeometryError("an integer coordinate lies beyond 2**53, where doubles leave numbers out")
    return np.ascontiguousarray(coordinates, dtype=np.float64)


def points(values: object) -> npt.NDArray[np.float64]:
    """Points (n, 2), also from shapely's."""
    array = values if isinstance(values, np.ndarray) else np.asarray(values)
    if array.dtype == object:
        import shapely

        if not all(_is_shapely(value) and value.geom_type == "Point" for value in array):
            raise GeometryError("points are an array (n, 2) or shapely's points")
        count = len(array)
        array = shapely.get_coordinates(array)
        if len(array) != count:
            raise GeometryError("a point is empty")
    array = doubles(array)
    if array.ndim != 2:
        raise GeometryError(f"points have the shape (n, 2), not {array.shape}")
    return array


def _objects(values: Sequence[object]) -> npt.NDArray[np.object_]:
    found = np.empty(len(values), dtype=object)
    for place, value in enumerate(values):
        found[place] = value
    return found


def _is_shapely(value: object) -> bool:
    return type(value).__module__.partition(".")[0] == "shapely"


def _is_missing(value: object) -> bool:
    is_nan = isinstance(value, float) and value != value
    return value is None or is_nan or type(value).__name__ in ("NAType", "NaTType")


def _is_ragged(value: object) -> bool:
    if not isinstance(value, tuple) or len(value) not in (2, 3):
        return False
    return isinstance(value[-2], np.ndarray) and isinstance(value[-1], tuple)


def _is_ring(values: list[Any]) -> bool:
    def is_point(value: Any) -> bool:
        is_row = isinstance(value, list | tuple | np.ndarray) and len(value) > 0
        return is_row and all(isinstance(x, int | float | np.number) for x in value)

    return len(values) > 0 and is_point(values[0])


def _stacked(values: list[Any]) -> npt.NDArray[Any]:
    try:
        return np.array(values)
    except ValueError as error:
        raise GeometryError(f"points of a ring are pairs of numbers: {error}") from None


def _of_numbers(rings: npt.NDArray[Any]) -> Layer:
    """One ring (n, 2), or many alike (k, n, 2)."""
    if rings.ndim not in (2, 3):
        raise GeometryError(f"a ring has the shape (n, 2), many have (k, n, 2), not {rings.shape}")
    single = rings.ndim == 2
    count, length = (1, len(rings)) if single else rings.shape[:2]
    return Layer((doubles(rings).reshape(-1, 2), np.arange(count + 1) * length, None, None), is_single=single)


def _of_held(held: HeldFeatures) -> Layer:
    crs = json.loads(held.metadata).get("crs") if held.metadata else None
    return Layer(held, missing=held.missing(), frame=Frame(None, crs) if crs else None)


def _of_ragged(*parts: Any) -> Layer:
    coordinates, offsets = parts[-2:]
    kind = getattr(parts[0], "name", "POLYGON") if len(parts) == 3 else "POLYGON"
    if kind not in ("POLYGON", "MULTIPOLYGON"):
        raise GeometryError(no_polygon(kind))
    if len(offsets) not in (2, 3):
        raise GeometryError(f"polygons have 2 arrays of offsets and multipolygons 3, not {len(offsets)}")
    if coordinates.ndim == 2 and coordinates.shape[1] in (3, 4):
        coordinates = coordinates[:, :2]
    if coordinates.ndim != 2:
        raise GeometryError(f"coordinates have the shape (n, 2), not {coordinates.shape}")
    rings, polygons, *rest = [_integers(np.asarray(array)) for array in offsets]
    return Layer((doubles(coordinates), rings, polygons, rest[0] if rest else None))


def _integers(offsets: npt.NDArray[Any]) -> Offsets:
    if offsets.ndim != 1 or offsets.dtype.kind not in "iu":
        raise GeometryError(f"offsets are one row of integers, not {offsets.dtype} of shape {offsets.shape}")
    if offsets.dtype == np.int32:
        return np.ascontiguousarray(offsets)
    if offsets.dtype == np.uint64 and offsets.size and offsets.max() > np.iinfo(np.int64).max:
        raise GeometryError("an offset lies beyond 2**63")
    return np.ascontiguousarray(offsets, dtype=np.int64)


def _of_shapely(values: npt.NDArray[np.object_], missing: npt.NDArray[np.bool_]) -> Layer:
    import shapely

    if missing.any():
        values = np.where(missing, shapely.Polygon(), values)
    kinds = shapely.get_type_id(values)
    are_polygons = kinds == shapely.GeometryType.POLYGON
    others = ~are_polygons & (kinds != shapely.GeometryType.MULTIPOLYGON)
    if others.any():
        feature = int(np.flatnonzero(others)[0])
        raise GeometryError(f"feature {feature}: {no_polygon(values[feature].geom_type)}")
    if are_polygons.all() and not shapely.get_num_interior_rings(values).any():
        # The same as below, sooner.
        rings = _ends([shapely.get_num_coordinates(values)])
        layer = Layer((doubles(shapely.get_coordinates(values)), rings, None, None))
    else:
        layer = _of_ragged(*shapely.to_ragged_array(values, include_z=False)[1:])
    return layer._replace(missing=missing if missing.any() else None)


def _sorted_out(values: npt.NDArray[np.object_]) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Which values are shapely's geometries, and which are missing."""
    shapely: Any = sys.modules.get("shapely")
    are_known = shapely.is_geometry(values) if shapely else np.zeros(len(values), dtype=bool)
    missing = np.zeros(len(values), dtype=bool)
    for place in np.flatnonzero(~are_known):
        missing[place] = _is_missing(values[place])
    return are_known, missing


def _of_pandas(values: Any) -> Layer:
    """GeoDataFrames, GeoSeries, and series of objects."""
    if hasattr(values, "columns"):
        if not hasattr(values, "geometry"):
            raise GeometryError("a table without geometries; give a GeoDataFrame or a series")
        values = values.geometry
    layer = _of_objects(values.to_numpy(dtype=object))
    return layer._replace(frame=Frame(values.index, getattr(values, "crs", None)))


def _of_objects(values: npt.NDArray[np.object_]) -> Layer:
    if values.ndim != 1:
        raise GeometryError(f"an array of geometries has one dimension, not {values.ndim}")
    are_known, missing = _sorted_out(values)
    if are_known.any() and (are_known | missing).all():
        return _of_shapely(values, missing)
    present = values[~missing]
    if len(present) and all(isinstance(value, bytes) for value in present):
        whole: Any = [None if is_missing else value for value, is_missing in zip(values, missing, strict=True)]
        return _of_held(_polycsg.of_wkb(whole))
    parts = []
    for feature, value in enumerate(values):
        try:
            part = read(np.empty((0, 2)) if missing[feature] else value)
        except GeometryError as error:
            raise GeometryError(f"feature {feature}: {error}") from None
        if not part.is_single:
            raise GeometryError(f"feature {feature} is itself an array of geometries; give one list of all")
        parts.append(part.features.arrays() if isinstance(part.features, HeldFeatures) else part.features)
    return _joined(parts)._replace(missing=missing if missing.any() else None)


def _joined(parts: Sequence[tuple[Any, ...]]) -> Layer:
    """One feature of each part."""
    coordinates = np.concatenate([np.empty((0, 2)), *(part[0] for part in parts)])
    rings = [np.diff(part[1]) for part in parts]
    polygons = [
        np.ones(len(ring), int) if part[2] is None else np.diff(part[2])
        for ring, part in zip(rings, parts, strict=True)
    ]
    return Layer((coordinates, _ends(rings), _ends(polygons), _ends([[len(part)] for part in polygons])))


def _ends(counts: Sequence[Any]) -> npt.NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(np.concatenate([np.zeros(0, np.int64), *counts]))]).astype(np.int64)


def _of_interface(value: object) -> Layer:
    mapping: Any = value if isinstance(value, Mapping) else value.__geo_interface__  # type: ignore[attr-defined]
    kind = mapping.get("type")
    if kind == "Feature":
        return read(mapping["geometry"])
    if kind == "FeatureCollection":
        return _of_objects(_objects([feature["geometry"] for feature in mapping["features"]]))
    if kind == "Polygon":
        return _of_polygons([mapping["coordinates"]])
    if kind == "MultiPolygon":
        return _of_polygons(mapping["coordinates"])
    raise GeometryError(no_polygon(kind))


def _of_polygons(polygons: Sequence[Sequence[Any]]) -> Layer:
    rings: list[npt.NDArray[np.float64]] = []
    counts = []
    for polygon in polygons:
        for ring in polygon:
            points = _stacked([point[:2] for point in ring]).reshape(-1, 2)
            rings.append(doubles(points))
        counts.append(len(polygon))
    coordinates = np.concatenate([np.empty((0, 2)), *rings])
    ends = _ends([[len(ring) for ring in rings]])
    return Layer((coordinates, ends, _ends([counts]), np.array([0, len(counts)])), is_single=True)
